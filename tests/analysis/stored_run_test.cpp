// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/stored_run.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "analysis/figure.h"
#include "analysis/frame_columns.h"
#include "core/error.h"
#include "results/result_folder.h"
#include "results/sample_record.h"
#include "results/writers.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;

double value(const char* figure, const StoredRun& run) {
  return value_of(find_figure(figure)->place, run).value_or(-1);
}

TEST(StoredRun, ReadsWhatAResultFolderHolds) {
  const testing::TemporaryFolder folder;
  const Record record = testing::sample_record();
  write_results(folder.path("run"), false, record);
  for (const char* path : {"run", "run/record.json"}) {
    const StoredRun run = read_stored_run(folder.path(path));
    EXPECT_THAT(run.path, HasSubstr("run/record.json"));
    EXPECT_TRUE(run.complete());
    EXPECT_TRUE(run.valid());
    EXPECT_EQ(run.run_count(), 3u);
    EXPECT_THAT(run.repeats.at("time.computation_s.mean"), ElementsAre(1, 1.25, 2));
    EXPECT_EQ(run.text("sequence.name"), "kt3");
    EXPECT_EQ(run.text("parameters.kinectfusion.volume-size.value"), "5,5,5");
    EXPECT_EQ(value("ate_rmse_m", run), 0.001);
    EXPECT_EQ(value("ate_first_pose_m", run), 0.004);
    EXPECT_EQ(value("ate_slambench1_m", run), 0.0207);
    EXPECT_EQ(value("rpe_rmse_deg", run), 0.25);
    EXPECT_EQ(value("map_bytes", run), 64 << 20);
    EXPECT_EQ(value("dropped", run), 1);
    EXPECT_EQ(value("lost", run), 1);
    // Frames 1, 3 and 4 are measured, a second of which has the stages' fractions.
    EXPECT_DOUBLE_EQ(value("stage_raycast_s", run), 8.0 / 3 / 4);
    EXPECT_DOUBLE_EQ(value("kernel_track_s", run), 8.0 / 3 / 16);
    EXPECT_DOUBLE_EQ(value("fps", run), 1 / value("computation_s", run));
  }
}

TEST(StoredRun, ReadsTheFramesByColumn) {
  const testing::TemporaryFolder folder;
  write_results(folder.path("run"), false, testing::sample_record());
  const FrameColumns frames = read_frame_columns(folder.path("run/frames.csv"));
  EXPECT_THAT(frames.at("index"), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(frames.at("dropped"), ElementsAre(0, 0, 1, 0, 0));
  EXPECT_EQ(frames.at("stage_raycast_s")[3], 0.75);
  EXPECT_TRUE(std::isnan(frames.at("stage_raycast_s")[2]));
  EXPECT_EQ(frames.count("kernel_integrate_calls"), 1u);
}

TEST(StoredRun, SaysWhatItCannotRead) {
  const testing::TemporaryFolder folder;
  folder.write("empty/x", "");
  const auto message = [&](const std::string& path) {
    return message_of<InputError>([&] { read_stored_run(path); });
  };
  EXPECT_THAT(message(folder.path("nowhere")), HasSubstr("nowhere"));
  EXPECT_THAT(message(folder.path("empty")), HasSubstr("empty/record.json"));
  for (const char* text : {"", "{", "[]", "3", "{}", R"({"format": "other"})", "\xff"}) {
    EXPECT_THAT(message(folder.write("bad.json", text)), HasSubstr("is not the record of a run"));
  }
  EXPECT_THAT(message_of<InputError>([] { parse_frame_columns("a,b\r\n1\r\n", "f.csv"); }),
              HasSubstr("f.csv: line 2: found 1 fields, expected 2"));
  EXPECT_THAT(message_of<InputError>([] { parse_frame_columns("a,b\r\n1,x\r\n", "f.csv"); }),
              HasSubstr("f.csv: line 2: found 'x', expected a number"));
}

TEST(StoredRun, ReadsRepeats) {
  const StoredRun run = parse_stored_run(
      R"({"format": "slambench-record", "repetition": {"runs": 3, "figures": {
          "time.fps_computation": {"values": [1, 5, 2]},
          "time.stages.track.seconds_per_frame": {"values": [4, 2]}}}})",
      "r");
  EXPECT_EQ(run.run_count(), 3u);
  EXPECT_THAT(values_of("time.fps_computation", run), ElementsAre(1, 5, 2));
  EXPECT_EQ(value("fps", run), 2);
  EXPECT_EQ(value("stage_track_s", run), 3);
}

TEST(FigureTable, HasUniqueNamesAndUnits) {
  std::set<std::string> names, places;
  for (const NamedFigure& figure : figure_table()) {
    EXPECT_TRUE(names.insert(figure.name).second) << figure.name;
    EXPECT_TRUE(places.insert(figure.place).second) << figure.place;
    EXPECT_EQ(figure.name.ends_with("_s"), figure.unit == "s") << figure.name;
    EXPECT_EQ(figure.name.ends_with("_m"), figure.unit == "m") << figure.name;
    EXPECT_EQ(figure.name.ends_with("_j"), figure.unit == "J") << figure.name;
    EXPECT_EQ(figure.name.ends_with("_bytes"), figure.unit == "B") << figure.name;
    EXPECT_FALSE(figure.sentence.empty());
  }
  EXPECT_EQ(find_figure("no_figure"), nullptr);
}

TEST(ReasonAbsent, IsThatOfTheNearestPlace) {
  StoredRun run;
  run.absent = {{"energy", "no sensor"}, {"energy.rails.A15", "permission denied"}};
  EXPECT_EQ(reason_absent("energy.total.joules", run), "no sensor");
  EXPECT_EQ(reason_absent("energy.rails.A15.joules", run), "permission denied");
  EXPECT_EQ(reason_absent("time.wall_s", run), "the record does not hold it");
}

}  // namespace
}  // namespace slambench
