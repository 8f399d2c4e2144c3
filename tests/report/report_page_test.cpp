// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "report/report_page.h"

#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>

#include "io/files.h"
#include "report/base64.h"
#include "report/paths.h"
#include "report/sample_results.h"

namespace slambench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

class ReportPageTest : public ::testing::Test {
 protected:
  std::string run(const std::string& name, const Record& record) {
    return testing::write_run(folder_, name, record);
  }
  testing::TemporaryFolder folder_;
};

TEST(Base64, IsThatOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(ParetoFront, HasWhatNoOtherBeatsInBoth) {
  EXPECT_THAT(pareto_front({{0, 3, 1}, {1, 1, 3}, {2, 2, 2}, {3, 3, 3}, {4, 2, 2.5}}),
              ElementsAre(1, 2, 0));
  EXPECT_THAT(pareto_front({{0, 1, 1}, {1, 1, 1}}), ElementsAre(0, 1));
  EXPECT_THAT(pareto_front({{0, 1, 2}, {1, 1, 1}}), ElementsAre(1));
  EXPECT_THAT(pareto_front({}), ElementsAre());
}

TEST_F(ReportPageTest, DataHoldsTheRecordAsItIs) {
  const auto runs = testing::read_runs({run("a", testing::full_record())});
  const Json data = report_data(runs, {});
  EXPECT_EQ(data.at("runs").at(0).at("record"),
            Json::parse(read_file(folder_.path("a/record.json"))));
  const Json& frames = data.at("runs").at(0).at("frames");
  EXPECT_EQ(frames.at("index"), Json({0, 1, 2, 3, 4}));
  EXPECT_EQ(frames.at("computation_ms").at(2), Json()) << "dropped";
  EXPECT_EQ(data.at("runs").at(0).at("pictures").size(), 2U);
}

TEST_F(ReportPageTest, ShowsOnlySoManyRunsFrameByFrame) {
  ReportOptions options;
  options.detailed_runs = 1;
  options.picture_frames = {4};
  const auto runs =
      testing::read_runs({run("a", testing::full_record()), run("b", testing::full_record())});
  const Json data = report_data(runs, options);
  EXPECT_EQ(data.at("runs").at(0).at("pictures").size(), 1U);
  EXPECT_FALSE(data.at("runs").at(1).contains("frames"));
  EXPECT_EQ(data.at("limits").at("detailed_runs"), 1);
}

TEST_F(ReportPageTest, FrontsAreOfOneInputEach) {
  Record other = testing::full_record(), shorter = other, noisy = other;
  other.sequence = "another";
  shorter.frames.pop_back();
  noisy.parameters.push_back({"source", "noise", "", "true", "command line"});
  const auto runs =
      testing::read_runs({run("a", testing::full_record()), run("b", other), run("c", shorter),
                          run("d", noisy), run("e", testing::full_record())});
  const Json data = report_data(runs, {});
  std::map<std::string, Json> members;
  for (const Json& front : data.at("fronts")) {
    members[front.at("input")] = front.at("runs");
  }
  const std::map<std::string, Json> expected = {{"kt3, 5 frames", {0, 4}},
                                                {"another, 5 frames", Json::array({1})},
                                                {"kt3, 4 frames", Json::array({2})},
                                                {"kt3, 5 frames, noise true", Json::array({3})}};
  EXPECT_EQ(members, expected);
}

// The sample's axes have y up: right is x, up is y, forward is z.
TEST_F(ReportPageTest, PathsAreRightForwardUp) {
  Record record = testing::full_record();
  // The same path, seen from elsewhere.
  record.ground_truth = estimated_trajectory(record);
  const Pose elsewhere =
      Eigen::Translation3d(3, 2, 1) * Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized());
  for (StampedPose& pose : record.ground_truth)
    pose.T_world_camera = elsewhere * pose.T_world_camera;
  const ReportPaths paths = report_paths(testing::read_runs({run("a", record)}).front());
  ASSERT_EQ(paths.estimate.size(), 4U);
  EXPECT_TRUE(paths.estimate[1].isApprox(Eigen::Vector3d(1, 0.5, -0.25), 1e-9));
  EXPECT_THAT(paths.truth_note, HasSubstr("first pose")) << "all on one line";
  ASSERT_EQ(paths.truth.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(paths.truth[i].isApprox(paths.estimate[i], 1e-9));
  record.ground_truth.clear();
  const ReportPaths alone = report_paths(testing::read_runs({run("b", record)}).front());
  EXPECT_TRUE(alone.truth.empty());
  EXPECT_THAT(alone.truth_note, HasSubstr("no ground truth"));
}

TEST_F(ReportPageTest, LongSequencesAreThinned) {
  Record record = testing::full_record();
  const FrameRecord last = record.frames.back();
  while (record.frames.size() < 30'000) {
    record.frames.push_back(last);
    record.frames.back().index = static_cast<int>(record.frames.size()) - 1;
    record.frames.back().time_s = 0.5 * static_cast<double>(record.frames.size());
  }
  record.ground_truth.clear();
  const Json data = report_data(testing::read_runs({run("a", record)}), {});
  EXPECT_EQ(data.at("limits").at("frame_step"), 3);
  EXPECT_EQ(data.at("runs").at(0).at("frames").at("index").size(), 10'000U);
}

TEST_F(ReportPageTest, PowerIsThatOfTheSamples) {
  Record record = testing::full_record();
  SampleSeries many{"A15", "W", {}};
  for (int i = 0; i < 1200; ++i) many.samples.push_back({0.5 * (i + 1), i % 3 == 0 ? 3.0 : 0.0});
  record.measurements.sampling->series.push_back(many);
  record.measurements.sampling->series.push_back({"Tctl", "degree C", {{1, 60}}});
  const Json data = report_data(testing::read_runs({run("a", record)}), {});
  const Json& power = data.at("runs").at(0).at("power");
  ASSERT_EQ(power.size(), 2U) << "temperatures are no power";
  EXPECT_EQ(power[0].at("rail"), "package-0");
  EXPECT_EQ(power[0].at("mean"), true) << "of a counter of energy";
  EXPECT_EQ(power[0].at("time_s"), (Json{0.0625, 0.125}));
  EXPECT_EQ(power[0].at("power_w"), (Json{2, 8}));
  ASSERT_EQ(power[1].at("time_s").size(), 400U) << "means of three";
  EXPECT_EQ(power[1].at("mean"), false);
  EXPECT_EQ(power[1].at("time_s").at(1), 3);
  for (const Json& watts : power[1].at("power_w")) EXPECT_EQ(watts, 1);
}

TEST_F(ReportPageTest, PageIsCompleteSmallAndTakesNothingForMarkup) {
  if (!can_draw_charts()) GTEST_SKIP() << "built without plotly.js";
  Record record = testing::full_record();
  record.sequence = record.provenance.command = testing::hostile;
  record.parameters[0].value = testing::hostile;
  ReportOptions options;
  options.title = testing::hostile;
  const std::string page = report_page(testing::read_runs({run("a", record)}), options);
  EXPECT_TRUE(is_report_page(page));
  EXPECT_FALSE(is_report_page("<!DOCTYPE html>"));
  EXPECT_LT(page.size(), 10'000'000U);
  EXPECT_THAT(page, Not(HasSubstr(testing::hostile)));
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  for (const char* request : {"src=\"http", "href=\"http", "url(http", "@import"}) {
    EXPECT_THAT(page, Not(HasSubstr(request)));
  }
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
}

}  // namespace
}  // namespace slambench
