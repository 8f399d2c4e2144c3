// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "exports/exported.h"
#include "io/files.h"

namespace slambench {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;
using testing::exported;
using testing::single_record;

class TraceTest : public ::testing::Test {
 protected:
  Json trace(const std::vector<Record>& records) {
    const auto runs = exported(folder_, records);
    return Json::parse(trace_json(runs, {}));
  }
  static std::vector<Json> slices(const Json& trace, const std::string& kind) {
    std::vector<Json> found;
    for (const Json& event : trace.at("traceEvents")) {
      if (event.at("ph") == "X" && event.at("cat") == kind) found.push_back(event);
    }
    return found;
  }
  static double begin(const Json& event) { return event.at("ts").get<double>(); }
  static double end(const Json& event) { return begin(event) + event.at("dur").get<double>(); }

  testing::TemporaryFolder folder_;
};

TEST_F(TraceTest, FramesBeginWhenTheyDidAndTakeWhatTheyTook) {
  const auto frames = slices(trace({single_record()}), "frame");
  ASSERT_EQ(frames.size(), 4U) << "the dropped one has none";
  EXPECT_EQ(frames[0].at("name"), "frame 0");
  EXPECT_EQ(begin(frames[0]), 0);
  EXPECT_EQ(frames[0].at("dur"), 984.375e6);
  EXPECT_EQ(frames[1].at("ts"), 1004e6);
  EXPECT_EQ(frames[1].at("dur"), 0.984375e6);
  EXPECT_EQ(frames[1].at("args").at("tracked"), 1);
  EXPECT_EQ(frames[3].at("name"), "frame 4");
  EXPECT_EQ(frames[3].at("ts"), 1016e6);
}

/// As when frames are read ahead: pictures were saved between acquiring this one and its turn.
TEST_F(TraceTest, ProcessingBeginsWhenItDid) {
  Record record = single_record();
  record.frames[1].process_start_s = 1005;
  const Json all = trace({record});
  const auto frames = slices(all, "frame"), stages = slices(all, "stage");
  const Json acquire = stages[6], preprocess = stages[7], render = stages[11];
  EXPECT_EQ(acquire.at("ts"), 1004e6);
  EXPECT_EQ(preprocess.at("ts"), 1005e6);
  EXPECT_EQ(begin(frames[1]), 1004e6);
  EXPECT_EQ(end(frames[1]), end(render));
  EXPECT_EQ(end(frames[1]), 1005e6 + 0.984375e6 - acquire.at("dur").get<double>());
}

TEST_F(TraceTest, FramesInOneGoTakeTheirWholeComputation) {
  Record record = single_record();
  record.frames[1].times.between_stages_s = 0.25;
  const Json all = trace({record});
  const auto frames = slices(all, "frame"), stages = slices(all, "stage");
  EXPECT_EQ(frames[1].at("dur"), (0.984375 + 0.25) * 1e6);
  EXPECT_EQ(frames[1].at("args").at("between_stages_s"), 0.25);
  const Json raycast = stages[10], render = stages[11];
  EXPECT_EQ(begin(render), end(raycast) + 0.25e6);
  EXPECT_EQ(end(render), end(frames[1]));
  EXPECT_EQ(frames[2].at("dur"), 3 * 0.984375e6) << "has nothing between";
  EXPECT_FALSE(frames[2].at("args").contains("between_stages_s"));
  EXPECT_THAT(all.at("otherData").at("r0"), HasSubstr("the gap before drawing"));
}

TEST_F(TraceTest, StagesLieInFramesAndKernelsInStages) {
  const Json all = trace({single_record()});
  const auto frames = slices(all, "frame"), stages = slices(all, "stage"),
             kernels = slices(all, "kernel");
  ASSERT_EQ(stages.size(), 4U * 6);
  ASSERT_EQ(kernels.size(), 4U * 4);
  const auto within = [](const Json& inner, const std::vector<Json>& outer) {
    return std::any_of(outer.begin(), outer.end(), [&](const Json& o) {
      return begin(o) <= begin(inner) && end(inner) <= end(o) && o.at("tid") == inner.at("tid");
    });
  };
  double before = 0;
  for (const Json& stage : stages) {
    EXPECT_TRUE(within(stage, frames)) << stage;
    EXPECT_GE(begin(stage), before) << "one after another";
    before = end(stage);
  }
  for (const Json& kernel : kernels) EXPECT_TRUE(within(kernel, stages)) << kernel;
  std::vector<std::string> names;
  for (std::size_t i = 6; i < 12; ++i) names.push_back(stages[i].at("name"));
  EXPECT_THAT(names,
              ElementsAre("acquire", "preprocess", "track", "integrate", "raycast", "render"));
  EXPECT_EQ(kernels[6].at("name"), "track");
  EXPECT_EQ(kernels[6].at("ts"), stages[8].at("ts"));
  EXPECT_EQ(kernels[6].at("dur"), 0.0625e6);
  EXPECT_EQ(kernels[6].at("args").at("calls"), 4);
  EXPECT_THAT(all.at("otherData").at("r0"),
              AllOf(HasSubstr("these places are not"), Not(HasSubstr("end to end")),
                    Not(HasSubstr("in one go"))));
}

TEST_F(TraceTest, DroppedFramesAreMarkedWhereTheyWereFoundTooLate) {
  const Json all = trace({single_record()});
  for (const Json& event : all.at("traceEvents")) {
    if (event.at("ph") != "i") continue;
    EXPECT_EQ(event.at("name"), "dropped frame 2");
    EXPECT_EQ(event.at("ts"), (1004 + 0.984375) * 1e6) << "the end of frame 1";
    return;
  }
  ADD_FAILURE() << "none";
}

TEST_F(TraceTest, KernelsThatOutlastTheirStageHaveATrackOfTheirOwn) {
  Record record = single_record();
  for (const int i : {1, 3}) {
    testing::called(record.frames[static_cast<std::size_t>(i)].times, Kernel::raycast, 3, 1);
    testing::called(record.frames[static_cast<std::size_t>(i)].times, Kernel::render_depth, 1, 1);
  }
  const Json all = trace({record});
  double before = 0;
  for (const Json& kernel : slices(all, "kernel")) {
    EXPECT_EQ(kernel.at("tid"), 2);
    EXPECT_GE(begin(kernel), before) << "none at once";
    before = end(kernel);
    if (kernel.at("name") != "raycast") continue;
    EXPECT_EQ(kernel.at("dur"), 3e6) << "as measured";
  }
  EXPECT_THAT(all.at("otherData").at("r0"), HasSubstr("a device's own clock"));
}

TEST_F(TraceTest, FoldersWithoutStartsAreLaidEndToEndAndSaySo) {
  const auto runs = exported(folder_, {single_record()});
  const std::string file = folder_.path("r0/frames.csv");
  std::string text = read_file(file);
  text.replace(text.find(",start_s,"), 9, ",started,");
  write_file(file, text);
  const Json all = Json::parse(trace_json(runs, {}));
  const auto frames = slices(all, "frame");
  EXPECT_EQ(begin(frames[1]), end(frames[0]));
  EXPECT_EQ(begin(frames[2]), end(frames[1]));
  EXPECT_THAT(all.at("otherData").at("r0"), HasSubstr("laid end to end"));
}

TEST_F(TraceTest, SensorsAreCounters) {
  Record record = single_record();
  record.measurements.sampling->series.push_back({"Tctl", "degree C", {{0.25, 60}, {1.25, 61}}});
  std::map<std::string, std::vector<std::pair<double, double>>> counters;
  const Json all = trace({record});
  for (const Json& event : all.at("traceEvents")) {
    if (event.at("ph") != "C") continue;
    counters[event.at("name")].emplace_back(begin(event), event.at("args").at("value"));
  }
  using Points = std::vector<std::pair<double, double>>;
  EXPECT_EQ(counters.at("package-0 (W)"), (Points{{0, 2}, {62500, 8}, {125000, 8}}))
      << "means that end at the reading";
  EXPECT_EQ(counters.at("Tctl (degree C)"), (Points{{250000, 60}, {1250000, 61}}));
}

TEST_F(TraceTest, EachRunIsAProcess) {
  const Json all = trace({single_record(), single_record()});
  std::map<int, std::string> names;
  for (const Json& event : all.at("traceEvents")) {
    if (event.at("name") == "process_name") names[event.at("pid")] = event.at("args").at("name");
  }
  EXPECT_EQ(names,
            (std::map<int, std::string>{{1, "r0: kt3 on serial"}, {2, "r1: kt3 on serial"}}));
  EXPECT_EQ(slices(all, "frame").size(), 8U);
}

TEST_F(TraceTest, RefusesAFolderWithoutFrames) {
  const auto runs = exported(folder_, {single_record()});
  std::filesystem::remove(folder_.path("r0/frames.csv"));
  EXPECT_THAT(testing::message_of<InputError>([&] { trace_json(runs, {}); }),
              HasSubstr("frames.csv"));
}

}  // namespace
}  // namespace slambench
