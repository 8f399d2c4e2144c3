// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "results/output_parameters.h"
#include "results/run_statistics.h"
#include "sample_record.h"

namespace slambench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::sample_record;

TEST(SummaryText, IsTheLiteralTextOfASmallRecord) {
  EXPECT_EQ(summary_text(sample_record(), "results/x", false), R"(kt3: 5 frames on serial
device      A CPU, threads: 3, AVX2
sizes       input 640x480, computation 320x240, volume 256x256x256 in 5x5x5 m

run 2 of 3

kernel               ms a frame     share   calls/frame    ms a call
acquire                  41.667         -          1.00       41.667
mm2meters                83.333     6.7 %          1.00       83.333
track                   166.667    13.3 %          4.00       41.667
integrate               333.333    26.7 %          1.00      333.333

stage         ms a frame  frames    median       p95       p99       max   share
acquire           41.667       3    46.875    60.938    62.188    62.500       -
preprocess        83.333       3    93.750   121.875   124.375   125.000   6.7 %
track            166.667       3   187.500   243.750   248.750   250.000  13.3 %
integrate        333.333       3   375.000   487.500   497.500   500.000  26.7 %
raycast          666.667       3   750.000   975.000   995.000  1000.000  53.3 %
render          1333.333       3  1500.000  1950.000  1990.000  2000.000       -
computation     1250.000       3  1406.250  1828.125  1865.625  1875.000 100.0 %
total           2625.000       3  2953.125  3839.062  3917.812  3937.500       -

over 3 runs                 median         95 % interval  run to run   of frames
computation ms                1250       1000 -     2000      40.0 %      20.0 %

runs        3 measured after 1 not measured; the rest of this page is run 2, the
            median; spreads are standard deviations from run to run and from
            frame to frame
runs        another trajectory than run 1: 3

speed       0.80 frames/s of computation, 0.25 frames/s of all 16.0 s
measured    3 frames; left out as warm-up: 0
load        0.25 before the frames, 1.50 after; usable processors: 2
frames      2 tracked; 2 untracked (0, 3); 1 lost (3); 1 dropped (2)
accuracy    processed frames: 3 of 4 poses matched with 400 of ground truth
  ATE       first pose      mean     4.00  rmse     4.00  max     4.00 mm
  ATE       SE(3)           mean     1.00  rmse     1.00  max     1.00 mm
  RPE       over 1 s        mean    12.00  rmse    12.00  max    12.00 mm
                            mean    0.250  rmse    0.250  max    0.250 deg
  ATE       as SLAMBench 1  mean    20.70  rmse    20.70  max    20.70 mm
accuracy    all frames: 3 of 4 poses matched with 400 of ground truth
  ATE       first pose      mean     4.00  rmse     4.00  max     4.00 mm
  ATE       SE(3)           mean     1.00  rmse     1.00  max     1.00 mm
  RPE       over 1 s        mean    12.00  rmse    12.00  max    12.00 mm
                            mean    0.250  rmse    0.250  max    0.250 deg
memory      64.0 MiB of map, 512.0 MiB of process at most
energy      over 16.00 s and 4 frames; idle baseline of 8.0 s
  rail                      J    J/frame   mean W   peak W above idle  J s/frame
  package-0            64.000    16.0000    4.000    8.000     48.000   64.00000
  absent    energy.rails.dram: No such file or directory
noise       the governor is powersave
results     results/x
)");
}

TEST(SummaryText, TellsStagesThatDidNotRunInEveryFrame) {
  Record record = sample_record();
  for (const std::size_t frame : {1u, 3u}) {
    record.frames[frame].times.stage_s[static_cast<std::size_t>(Stage::integrate)] = 0;
    record.frames[frame].times.stage_calls[static_cast<std::size_t>(Stage::integrate)] = 0;
  }
  const std::string text = summary_text(record, "", false);
  EXPECT_THAT(text, HasSubstr("integrate        166.667       1   500.000   500.000"));
  EXPECT_THAT(text, HasSubstr("warm-up: 0; median to max are of the frames in\n"
                              "            which a stage ran\n"));
}

TEST(SummaryText, ListsTransfersOfABackendThatHasAny) {
  Record record = sample_record();
  testing::add_sample_transfers(record);
  EXPECT_THAT(summary_text(record, "", false), HasSubstr(R"(
total           2625.000       3  2953.125  3839.062  3917.812  3937.500       -

transfers            ms a frame    median       a frame  KiB a frame       GiB/s
to the device            41.667    46.875          1.00        1.000        0.00
to the host              41.667    62.500          2.00        0.250        0.00
(part of the times above, and never added to them)

over 3 runs)"));
}

TEST(SummaryText, TellsWhatLiesBetweenStagesOfFramesInOneGo) {
  Record record = sample_record();
  for (FrameRecord& frame : record.frames) {
    if (!frame.dropped) frame.times.between_stages_s = 0.5;
  }
  const std::string text = summary_text(record, "", false);
  EXPECT_THAT(text, HasSubstr("between_stages   500.000       3   500.000   500.000   500.000   "
                              "500.000  28.6 %\ncomputation "));
  EXPECT_THAT(text, HasSubstr("timed their kernels; between_stages: launching, waiting)\n"));
}

TEST(SummaryText, FitsEightyColumnsWithLongNamesAndTimes) {
  Record record = sample_record();
  testing::add_sample_transfers(record);
  record.provenance.device =
      "A processor with a very long name, of many words, at 2.40 GHz, and "
      "a second one beside it";
  record.invalid_reasons = {
      "a long reason that explains in many words what went wrong and how one "
      "would have to run it again"};
  for (int i = 100; i < 200; i += 2) {
    record.frames.push_back(record.frames[3]);
    record.frames.back().index = i;
  }
  for (auto& frame : record.frames) {
    for (double& s : frame.times.stage_s) s *= 1000;
  }
  std::istringstream lines(summary_text(record, "results/x", false));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

TEST(SummaryText, SaysWhyNoEnergyWasMeasured) {
  Record record = sample_record();
  record.measurements.energy.reset();
  EXPECT_THAT(summary_text(record, "", false),
              HasSubstr("energy      not measured: not metered\n"));
  record.measurements.absent["energy"] = "no sensor";
  EXPECT_THAT(summary_text(record, "", false), HasSubstr("energy      not measured: no sensor\n"));
}

TEST(SummaryText, AddsRailsUpAndMarksThoseWithinAnother) {
  Record record = sample_record();
  auto& rails = record.measurements.energy->rails;
  rails.push_back(rails[0]);
  rails[1].name = "package-0/core";
  rails[1].within = "package-0";
  rails[1].figures.peak_w.reset();
  const std::string text = summary_text(record, "", false);
  EXPECT_THAT(text, HasSubstr("  - package-0/core     64.000    16.0000    4.000        -"));
  EXPECT_THAT(text, HasSubstr("\n  total                64.000"));
}

TEST(SummaryText, ShowsCountersInMillionsAFrame) {
  Record record = sample_record();
  CounterMeasurement counters;
  counters.frames = 4;
  counters.stages[static_cast<std::size_t>(Stage::track)] = {8'000'000, 20'000'000, {}, 4'000};
  record.measurements.counters = counters;
  EXPECT_THAT(summary_text(record, "", false),
              HasSubstr("\n  track                     2.000          5.000               -"
                        "           0.001\n"));
}

TEST(SummaryText, OfASingleRunHasNoIntervals) {
  Record record = sample_record();
  record.repetition.runs = 1;
  EXPECT_THAT(summary_text(record, "", false), Not(HasSubstr("interval")));
}

TEST(SummaryText, ColorsOnlyWhenWanted) {
  EXPECT_THAT(summary_text(sample_record(), "", true), HasSubstr("\x1b["));
  EXPECT_THAT(summary_text(sample_record(), "", false), Not(HasSubstr("\x1b")));
}

TEST(SummaryText, SaysWhyNothingWasJudged) {
  Record record = sample_record();
  record.over_processed.reset();
  record.absent["accuracy.over_processed"] = "the sequence has no ground truth";
  EXPECT_THAT(summary_text(record, "", false),
              HasSubstr("accuracy    not judged: the sequence has no ground truth\n"));
}

TEST(SummaryText, SaysThatARunIsIncompleteOrInvalid) {
  Record record = sample_record();
  record.complete = false;
  record.invalid_reasons = {"why"};
  const std::string text = summary_text(record, "", false);
  EXPECT_THAT(text, HasSubstr("INCOMPLETE  the run was interrupted\n"));
  EXPECT_THAT(text, HasSubstr("INVALID     why\n"));
}

TEST(SummaryText, NamesTheStartWhenOnlyItWasUntracked) {
  Record record = sample_record();
  record.frames.resize(2);
  EXPECT_THAT(summary_text(record, "", false),
              HasSubstr("frames      1 tracked; 1 untracked (0, the start); 0 lost; 0 dropped\n"));
}

TEST(SummaryText, OfARunWithoutFramesHasNoTables) {
  const std::string text = summary_text(Record{}, "", false);
  EXPECT_THAT(text, HasSubstr("measured    0 frames\n"));
  EXPECT_THAT(text, Not(HasSubstr("ms a frame")));
}

TEST(FrameListText, JoinsRunsAndCountsTheRest) {
  EXPECT_EQ(frame_list_text({0, 1, 2, 3, 17}), "0-3, 17");
  EXPECT_EQ(frame_list_text({0, 2, 4, 6, 8, 10, 12, 14}), "0, 2, 4, 6, 8, 10, 12, 14");
  EXPECT_EQ(frame_list_text({0, 2, 4, 6, 8, 10, 12, 14, 15, 17, 18}),
            "0, 2, 4, 6, 8, 10, 12, 14-15 and 2 more");
  EXPECT_EQ(frame_list_text({}), "");
}

TEST(OutputParameters, AreSetFromText) {
  OutputParameters p;
  const std::vector<ParameterList> lists = {p.describe()};
  EXPECT_EQ(lists[0].group, "output");
  set_from_text(*find(lists, "out"), "folder");
  set_from_text(*find(lists, "force"), "true");
  set_from_text(*find(lists, "images"), "10");
  set_from_text(*find(lists, "log-file"), "log");
  set_from_text(*find(lists, "dump-volume"), "volume");
  set_from_text(*find(lists, "quiet"), "true");
  set_from_text(*find(lists, "json"), "true");
  set_from_text(*find(lists, "no-gui"), "true");
  EXPECT_EQ(p.out, "folder");
  EXPECT_EQ(p.log_file, "log");
  EXPECT_EQ(p.dump_volume, "volume");
  EXPECT_EQ(p.images, 10);
  EXPECT_TRUE(p.force && p.quiet && p.json && p.no_gui);
}

TEST(OutputParameters, HaveTheShortNamesOfSlambench1) {
  OutputParameters p;
  const std::vector<ParameterList> lists = {p.describe()};
  EXPECT_EQ(find(lists, "log-file")->flag, 'o');
  EXPECT_EQ(find(lists, "dump-volume")->flag, 'd');
  EXPECT_EQ(find(lists, "no-gui")->flag, 'q');
}

}  // namespace
}  // namespace slambench
