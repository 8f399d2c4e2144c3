// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// Energy and repetition as the user of `slambench run` meets them.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/small_recording.h"
#include "support/fake_machine.h"
#include "support/program.h"

namespace slambench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

class MetersTest : public ::testing::Test {
 protected:
  void SetUp() override { program_.folder().write("small.raw", testing::small_raw(8)); }

  testing::Outcome run(const std::vector<std::string>& more) {
    auto arguments = testing::small_run();
    arguments.insert(arguments.end(), {"--sysfs-root", system_.root(), "--nvml-library", "none"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return program_.run(arguments);
  }
  std::string file(const std::string& name) const {
    return testing::Program::contents(program_.folder().path("out/" + name));
  }
  Json record() const { return Json::parse(file("record.json")); }
  static void expect_80_columns(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  }

  testing::FakeMachine system_;
  testing::Program program_{SLAMBENCH_PROGRAM};
};

TEST_F(MetersTest, ARunShowsTheEnergyOfAnOdroid) {
  for (const bool mainline : {false, true}) {
    system_.remove("/sys");
    mainline ? system_.odroid_mainline() : system_.odroid_old();
    const testing::Outcome outcome = run({"--force", "--idle", "0.1"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    expect_80_columns(outcome.out);
    EXPECT_THAT(outcome.out, AllOf(HasSubstr("energy      over "), HasSubstr("  A15 "),
                                   HasSubstr("  total "), HasSubstr("idle baseline of 0.1 s")));
    const Json energy = record().at("energy");
    EXPECT_EQ(energy.at("rails").size(), 4u);
    EXPECT_EQ(energy.at("frames"), 8);
    EXPECT_NEAR(energy.at("total").at("mean_w").get<double>(), 2, 1e-9);
    EXPECT_NEAR(energy.at("total").at("joules").get<double>(),
                2 * energy.at("seconds").get<double>(), 1e-9);
    EXPECT_NEAR(energy.at("total").at("joules_above_idle").get<double>(), 0, 1e-9);
    EXPECT_THAT(file("samples.csv"), HasSubstr("A15,W,"));
    EXPECT_GT(record().at("sampling").at("cpu_s").get<double>(), 0);
  }
}

TEST_F(MetersTest, WithoutASensorTheReasonIsShown) {
  const testing::Outcome outcome = run({});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("energy      not measured: no sensor"));
  EXPECT_FALSE(record().contains("energy"));
  EXPECT_THAT(record().at("absent").at("energy").get<std::string>(), HasSubstr("no sensor"));
  EXPECT_EQ(record().at("absent").at("memory.device_bytes"), "computes in host memory");
}

TEST_F(MetersTest, RepeatedRunsHaveIntervals) {
  system_.odroid_old();
  const testing::Outcome outcome = run({"--repeat", "3", "--warmup", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  expect_80_columns(outcome.out);
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("over 3 runs"), HasSubstr("95 % interval"), HasSubstr("raycast ms"),
                    HasSubstr("energy J/frame"), HasSubstr("frames/s of computation"),
                    Not(HasSubstr("another trajectory"))));
  const Json repetition = record().at("repetition");
  EXPECT_EQ(repetition.at("runs"), 3);
  EXPECT_EQ(repetition.at("warmup_runs"), 1);
  EXPECT_EQ(repetition.at("same_trajectory"), true);
  for (const char* place :
       {"time.computation_s.mean", "time.kernels.raycast.seconds_per_frame",
        "time.stages.track.seconds_per_frame", "time.fps_wall", "energy.total.joules_per_frame",
        "memory.peak_resident_bytes", "time.total_s.mean"}) {
    const Json figure = repetition.at("figures").at(place);
    EXPECT_EQ(figure.at("values").size(), 3u) << place;
    EXPECT_LE(figure.at("low"), figure.at("median")) << place;
    EXPECT_LE(figure.at("median"), figure.at("high")) << place;
  }
  EXPECT_EQ(record().at("frames").at("processed"), 8) << "of one run";
}

TEST_F(MetersTest, ListTellsOfEveryMeterWhetherItIsThere) {
  system_.intel_server();
  system_.remove("/sys/class/powercap/intel-rapl:1:1/energy_uj");
  const std::vector<std::string> list = {"list",           "--sysfs-root", system_.root(),
                                         "--nvml-library", "none",         "--json"};
  const Json meters = Json::parse(program_.run(list).out).at("meters");
  EXPECT_EQ(meters.at(0).at("name"), "powercap");
  EXPECT_EQ(meters.at(0).at("available"), true);
  EXPECT_EQ(meters.at(0).at("sensors").size(), 5u);
  EXPECT_EQ(meters.at(0).at("refused").at(0).at("name"), "package-1/dram");
  EXPECT_EQ(meters.at(2).at("name"), "ina231");
  EXPECT_EQ(meters.at(2).at("available"), false);
  EXPECT_FALSE(meters.at(2).at("reason").get<std::string>().empty());
  const testing::Outcome text = program_.run({list.begin(), list.end() - 1});
  EXPECT_THAT(text.out, AllOf(HasSubstr("package-0: powercap intel-rapl:0"),
                              HasSubstr("not package-1/dram:"), HasSubstr("nvml")));
}

}  // namespace
}  // namespace slambench
