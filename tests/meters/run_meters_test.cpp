// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/run_meters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "fakes.h"
#include "support/fake_clock.h"
#include "support/fake_machine.h"

namespace slambench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The runs are so short in real time that the thread takes no reading: the first and the last one
/// are all there is, at the times of the fake clock.
class RunMetersTest : public ::testing::Test {
 protected:
  RunMetersTest() { parameters_.meter_rate = 0.001; }

  void make() {
    const MeterContext context{SystemFiles(system_.root()), &perf_, "/nowhere"};
    meters_ = std::make_unique<RunMeters>(parameters_, context, clock_);
  }
  Measurements run(double seconds, int frames) {
    meters_->begin();
    clock_.advance(seconds);
    return meters_->end(frames);
  }
  static const RailEnergy& rail(const Measurements& m, const std::string& name) {
    for (const RailEnergy& one : m.energy->rails) {
      if (one.name == name) return one;
    }
    throw std::runtime_error("no rail " + name);
  }

  testing::FakeMachine system_;
  testing::FakePerfEvents perf_;
  testing::FakeClock clock_;
  MeterParameters parameters_;
  std::unique_ptr<RunMeters> meters_;
};

/// Nardi et al. 2015: 2.1 W at 5.46 frames a second are 0.385 J a frame, and 880 frames 337 to 339
/// J.
TEST_F(RunMetersTest, GivesThePapersFiguresOfAnOdroid) {
  for (const bool mainline : {false, true}) {
    SCOPED_TRACE(mainline);
    for (const char* folder : {"/sys/class/hwmon", "/sys/bus/i2c"}) system_.remove(folder);
    const std::vector<std::string> addresses(std::begin(testing::FakeMachine::odroid_addresses),
                                             std::end(testing::FakeMachine::odroid_addresses));
    const std::vector<double> watts = {1.2, 0.1, 0.5, 0.3};
    mainline ? system_.odroid_mainline() : system_.odroid_old();
    for (std::size_t i = 0; i < addresses.size(); ++i) {
      if (mainline) {
        system_.set(fmt::format("/sys/class/hwmon/hwmon{}/power1_input", i), watts[i] * 1e6);
      } else {
        system_.odroid_old_power(addresses[i], fmt::format("{}", watts[i]));
      }
    }
    make();
    const Measurements m = run(880 / 5.46, 880);
    ASSERT_TRUE(m.energy && m.energy->total);
    const EnergyFigures& total = *m.energy->total;
    EXPECT_NEAR(total.mean_w, 2.1, 1e-9);
    EXPECT_NEAR(total.joules_per_frame, 2.1 / 5.46, 1e-9);
    EXPECT_NEAR(total.joules_per_frame, 0.385, 0.0005);
    EXPECT_NEAR(total.joules, 880 * 2.1 / 5.46, 1e-6);
    EXPECT_NEAR(total.joules, 337, 0.005 * 337) << "the paper rounded the power";
    EXPECT_NEAR(*total.frames_per_joule, 5.46 / 2.1, 1e-9);
    EXPECT_NEAR(total.energy_delay_js, 2.1 / 5.46 / 5.46, 1e-9);
    EXPECT_FALSE(total.peak_w) << "peaks of rails need not fall together";
    EXPECT_NEAR(rail(m, "A15").figures.joules, 1.2 * 880 / 5.46, 1e-6);
    EXPECT_NEAR(*rail(m, "A15").figures.peak_w, 1.2, 1e-12);
  }
}

TEST_F(RunMetersTest, SubtractsTheIdleBaseline) {
  system_.odroid_old();
  parameters_.idle = 10;
  make();
  meters_->measure_idle(parameters_.idle, [] { return true; });
  for (const char* address : testing::FakeMachine::odroid_addresses) {
    system_.odroid_old_power(address, "2");
  }
  const Measurements m = run(4, 8);
  EXPECT_NEAR(*m.energy->idle_seconds, 10, 1e-6);
  const EnergyFigures& a7 = rail(m, "A7").figures;
  EXPECT_DOUBLE_EQ(a7.joules, 8);
  EXPECT_NEAR(*a7.idle_w, 0.5, 1e-9);
  EXPECT_NEAR(*a7.joules_above_idle, 6, 1e-9);
  EXPECT_NEAR(*m.energy->total->joules_above_idle, 24, 1e-9);
}

TEST_F(RunMetersTest, AnIdleBaselineCanBeInterrupted) {
  system_.odroid_old();
  make();
  int asked = 0;
  meters_->measure_idle(3600, [&] { return ++asked < 3; });
  EXPECT_NEAR(*run(1, 1).energy->idle_seconds, 0.1, 1e-6);
}

TEST_F(RunMetersTest, WithoutASensorThereIsNoFigureButAReason) {
  make();
  const Measurements m = run(1, 10);
  EXPECT_FALSE(m.energy);
  EXPECT_FALSE(m.sampling);
  EXPECT_THAT(m.absent.at("energy"), HasSubstr("no sensor"));
  EXPECT_EQ(m.absent.at("counters"), "not asked for: --counters");
}

TEST_F(RunMetersTest, WhatIsNotReadIsAbsent) {
  system_.odroid_old();
  parameters_.meter_rate = 0;
  make();
  meters_->measure_idle(1, [] { return true; });
  const Measurements m = run(1, 10);
  EXPECT_FALSE(m.energy);
  EXPECT_EQ(m.absent.at("energy"), "sensors are not read: --meter-rate 0");
}

TEST_F(RunMetersTest, ARailThatVanishesIsAbsentAndTheTotalToo) {
  system_.odroid_old();
  make();
  meters_->begin();
  clock_.advance(2);
  system_.remove("/sys/bus/i2c/drivers/INA231/4-0044");
  Measurements m = meters_->end(4);
  EXPECT_EQ(m.energy->rails.size(), 3u);
  EXPECT_THAT(m.absent.at("energy.rails.GPU"), HasSubstr("4-0044/sensor_W: No such file"));
  EXPECT_FALSE(m.energy->total);
  EXPECT_EQ(m.absent.at("energy.total"), "GPU was not measured");

  system_.odroid_old();
  m = run(2, 4);
  EXPECT_EQ(m.energy->rails.size(), 4u) << "the next run is measured again";
  EXPECT_TRUE(m.energy->total);
}

TEST_F(RunMetersTest, WithoutARailThatCannotBeReadThereIsNoTotal) {
  system_.odroid_old();
  system_.write("/sys/bus/i2c/drivers/INA231/4-0045/enable", "0");
  make();
  const Measurements m = run(2, 4);
  EXPECT_EQ(m.energy->rails.size(), 3u);
  EXPECT_THAT(m.absent.at("energy.rails.A7"), HasSubstr("switched off"));
  EXPECT_FALSE(m.energy->total);
  EXPECT_EQ(m.absent.at("energy.total"), "A7 was not measured");
}

TEST_F(RunMetersTest, RailsOfUnknownPurposeAreNotAdded) {
  system_.write("/sys/class/hwmon/hwmon0/name", "acpitz");
  system_.write("/sys/class/hwmon/hwmon0/power1_input", "3000000");
  make();
  const Measurements m = run(2, 4);
  EXPECT_DOUBLE_EQ(rail(m, "acpitz").figures.joules, 6);
  EXPECT_FALSE(m.energy->total);
  EXPECT_TRUE(m.absent.contains("energy.total"));
}

TEST_F(RunMetersTest, ARunWithoutFramesHasNoEnergyAFrame) {
  system_.odroid_old();
  make();
  const Measurements m = run(2, 0);
  EXPECT_FALSE(m.energy);
  EXPECT_EQ(m.absent.at("energy"), "no frame was processed");
}

TEST_F(RunMetersTest, TellsItsOwnCostAndWhatItRead) {
  system_.amd_desktop();
  make();
  const Measurements m = run(2, 4);
  EXPECT_EQ(m.sampling->samples, 2);
  EXPECT_DOUBLE_EQ(m.sampling->interval_s, 1000);
  EXPECT_GT(m.sampling->cpu_s, 0);
  EXPECT_DOUBLE_EQ(m.sampling->share_of_run, m.sampling->cpu_s / 2);
  std::vector<std::string> series;
  for (const SampleSeries& one : m.sampling->series) series.push_back(one.name + " " + one.unit);
  EXPECT_THAT(series, ElementsAre("amdgpu PPT W", "cpu frequency Hz", "Tctl degree C"))
      << "the package's counter did not move";
  EXPECT_THAT(m.absent.at("energy.rails.package-0"), HasSubstr("did not move"));
  EXPECT_DOUBLE_EQ(m.conditions.cpu_frequency_hz->mean, 3.5e9);
  EXPECT_DOUBLE_EQ(m.conditions.temperature_c.at("Tctl").max, 60.5);
  EXPECT_EQ(m.conditions.governor, "powersave");
  EXPECT_THAT(m.conditions.noise, ElementsAre(HasSubstr("the frequency governor is powersave")));
}

TEST_F(RunMetersTest, CountsTheProcessorTimeOfOthersAndThrottling) {
  const auto stat = [&](int busy_ticks) {
    system_.write("/proc/stat", fmt::format("cpu  {} 0 0 5000 100 0 0 0 0 0\nctxt 1", busy_ticks));
  };
  const std::string count = "/sys/devices/system/cpu/cpu0/thermal_throttle/package_throttle_count";
  stat(1000);
  system_.write(count, "5");
  make();
  meters_->begin();
  clock_.advance(10);
  stat(1000 + 25 * static_cast<int>(::sysconf(_SC_CLK_TCK)));
  system_.write(count, "8");
  const Measurements m = meters_->end(1);
  EXPECT_NEAR(*m.conditions.others_load, 2.5, 0.1) << "but for this process's own time";
  EXPECT_EQ(m.conditions.throttled, 3);
  EXPECT_THAT(m.conditions.noise, ElementsAre(HasSubstr("other processes kept 2."),
                                              HasSubstr("heat slowed the processor 3 times")));
}

TEST_F(RunMetersTest, CountsThrottlingOfAPackageOnceForAllItsProcessors) {
  const auto throttled = [&](int count) {
    for (const int cpu : {0, 1, 2}) {
      system_.write(fmt::format("/sys/devices/system/cpu/cpu{}/thermal_throttle/"
                                "package_throttle_count",
                                cpu),
                    fmt::format("{}", count));
    }
  };
  throttled(5);
  make();
  meters_->begin();
  clock_.advance(1);
  throttled(7);
  EXPECT_EQ(meters_->end(1).conditions.throttled, 2);
}

TEST_F(RunMetersTest, ARateThatIsHardlyOneIsAnIntervalAllTheSame) {
  system_.odroid_old();
  parameters_.meter_rate = 1e-30;
  make();
  const Measurements m = run(1, 1);
  EXPECT_EQ(m.sampling->samples, 2);
  EXPECT_DOUBLE_EQ(m.sampling->interval_s, 1000);
}

TEST_F(RunMetersTest, MeasuresResidentMemoryFromTheBeginningOfTheRun) {
  constexpr std::size_t bytes = std::size_t{64} << 20;
  { const std::vector<char> before(2 * bytes, 1); }
  make();
  meters_->begin();
  { const std::vector<char> during(bytes, 1); }
  const Measurements m = meters_->end(1);
  if (!m.memory.peak_resident_bytes) GTEST_SKIP() << m.absent.at("memory.peak_resident_bytes");
  EXPECT_GE(*m.memory.peak_resident_bytes, *m.memory.resident_bytes);
  EXPECT_GE(*m.memory.peak_resident_bytes, bytes);
  // A sanitizer keeps what was freed.
  EXPECT_LT(*m.memory.peak_resident_bytes, *m.memory.resident_bytes + 2 * bytes);
}

TEST_F(RunMetersTest, OpensNoCounterUnlessAskedTo) {
  system_.odroid_old();
  make();
  run(1, 1);
  EXPECT_EQ(perf_.opened, 0);
}

TEST_F(RunMetersTest, CountersAreThereWhenAskedForAndPermitted) {
  parameters_.counters = true;
  perf_.refusal = "not permitted";
  make();
  EXPECT_EQ(meters_->stages(), nullptr);
  EXPECT_EQ(run(1, 1).absent.at("counters"), "not permitted");
  perf_.refusal.clear();
  perf_.values[{0, 0, -1}] = 5;
  make();
  ASSERT_NE(meters_->stages(), nullptr);
  meters_->stages()->stage_begin(Stage::track);
  perf_.values[{0, 0, -1}] = 9;
  meters_->stages()->stage_end(Stage::track);
  meters_->begin();
  EXPECT_EQ(meters_->end(1).counters->stages[static_cast<std::size_t>(Stage::track)].cycles, 0u)
      << "what was before the run is not of it";
}

TEST(StatusBytes, AreThoseOfTheLine) {
  const char* status = "Name:\tx\nVmHWM:\t    2048 kB\nVmRSS:\t  1 kB\n";
  EXPECT_EQ(status_bytes(status, "VmHWM"), 2048u * 1024);
  EXPECT_EQ(status_bytes(status, "VmRSS"), 1024u);
  for (const char* broken : {"", "VmRSS:\n", "VmRSS: many kB\n", "VmRSS: 12 MB\n", "VmRSS: 12"}) {
    EXPECT_THROW(status_bytes(broken, "VmRSS"), MeterError) << broken;
  }
}

TEST(BusySeconds, CountAllButIdleTimeAndGuestsOnce) {
  EXPECT_EQ(busy_seconds("cpu  100 200 300 4000 500 600 700 800 50 60\ncpu0 1", 100), 27);
  EXPECT_EQ(busy_seconds("cpu 1 2 3", 100), std::nullopt);
  EXPECT_EQ(busy_seconds("", 100), std::nullopt);
}

TEST(NoiseIn, AQuietMachineHasNone) {
  Conditions conditions;
  EXPECT_THAT(noise_in(conditions, {}), IsEmpty());
  conditions.others_load = 0.02;
  conditions.throttled = 0;
  conditions.governor = "performance";
  EXPECT_THAT(noise_in(conditions, {{0, 3e9}, {1, 3.1e9}, {2, 2.99e9}}), IsEmpty());
}

TEST(NoiseIn, AFrequencyThatFallsIsSaid) {
  EXPECT_THAT(noise_in({}, {{0, 3e9}, {1, 2.9e9}, {2, 2.5e9}}),
              ElementsAre(HasSubstr("fell from 3.00 to 2.50 GHz")));
}

TEST(NoiseOfRuns, IsSaidAboveThreePercent) {
  EXPECT_EQ(noise_of_runs(1, 0.029), "");
  EXPECT_THAT(noise_of_runs(1, 0.05), HasSubstr("differ by 5.0 %"));
  EXPECT_EQ(noise_of_runs(0, 0), "");
}

}  // namespace
}  // namespace slambench
