// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "report/report_entries.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "analysis/suite_index.h"
#include "report/report_data.h"
#include "report/sample_results.h"

namespace slambench {
namespace {

using ::testing::ElementsAre;

class ReportEntriesTest : public ::testing::Test {
 protected:
  /// A run of those times of a frame.
  static Record run(double scale, const std::string& backend = "serial") {
    Record record = testing::single_run();
    record.provenance.backend = backend;
    for (FrameRecord& frame : record.frames) {
      if (!frame.dropped) frame.times = testing::sample_times(scale);
    }
    return record;
  }
  void add(const std::string& name, const Record& record) {
    runs_.push_back(read_report_run(testing::write_run(folder_, name, record)));
  }
  ReportEntries entries(bool repeats_together = true) {
    return report_entries(runs_, roles_, repeats_together);
  }
  static std::vector<std::string> names(const ReportEntries& entries) {
    std::vector<std::string> list;
    for (const ReportRun& run : entries.runs) list.push_back(run.name);
    return list;
  }

  testing::TemporaryFolder folder_;
  std::vector<ReportRun> runs_;
  const ParameterRoles roles_ = {{"output.out", ParameterRole::bookkeeping}};
};

TEST_F(ReportEntriesTest, RepeatsAreOneEntryWithTheMiddleRun) {
  add("s/1", run(4));
  add("s/2", run(1));
  add("s/3", run(2));
  add("o/1", run(1, "openmp"));
  const ReportEntries found = entries();
  EXPECT_THAT(names(found), ElementsAre("s", "o/1"));
  EXPECT_EQ(found.runs[0].folder, folder_.path("s/3"));
  const auto& repetition = found.runs[0].record.at("repetition");
  EXPECT_EQ(repetition.at("runs"), 3);
  const auto& time = repetition.at("figures").at("time.computation_s.mean");
  EXPECT_EQ(time.at("values"), (std::vector<double>{4 * 15 / 32.0, 15 / 32.0, 2 * 15 / 32.0}));
  EXPECT_EQ(time.at("median"), 2 * 15 / 32.0);
  EXPECT_EQ(time.at("low"), 15 / 32.0);
  EXPECT_EQ(time.at("high"), 4 * 15 / 32.0);
  EXPECT_TRUE(repetition.at("figures").contains("energy.rails.package-0.joules_per_frame"));
  EXPECT_EQ(found.runs[1].record, runs_[3].record) << "a single run is as it was";
}

TEST_F(ReportEntriesTest, FiguresOfRepeatsAreMedians) {
  for (const double scale : {4, 1, 2, 3}) add(fmt::format("s/{}", scale), run(scale));
  const ReportRun entry = entries().runs.at(0);
  EXPECT_EQ(entry.folder, folder_.path("s/2")) << "of two in the middle the faster";
  const auto& time = entry.record.at("time");
  EXPECT_EQ(time.at("computation_s").at("mean"), 2.5 * 15 / 32);
  EXPECT_EQ(time.at("stages").at("track").at("seconds_per_frame"), 2.5 / 16);
  EXPECT_EQ(time.at("kernels").at("track").at("seconds_per_frame"), 2.5 / 16);
}

TEST_F(ReportEntriesTest, FiguresOfRepeatsWithinARecordAreMedians) {
  Record record = run(2);
  record.repetition = testing::sample_repetition();
  record.measurements.energy->rails[0].name = "cpu.big";
  RepeatedFigure& joules = record.repetition.figures["energy.rails.cpu.big.joules"];
  joules.values = {1, 2, 9};
  joules.median = 2;
  add("s", record);
  for (const bool together : {true, false}) {
    const auto shown = entries(together).runs.at(0).record;
    EXPECT_EQ(shown.at("time").at("computation_s").at("mean"), 1.25);
    EXPECT_EQ(shown.at("energy").at("rails").at("cpu.big").at("joules"), 2);
  }
}

TEST_F(ReportEntriesTest, EachRunStandsAloneWhenAskedFor) {
  add("s/1", run(4));
  add("s/2", run(1));
  const ReportEntries found = entries(false);
  EXPECT_THAT(names(found), ElementsAre("s/1", "s/2"));
  EXPECT_EQ(found.runs[0].variant, "serial (s/1)");
  EXPECT_EQ(found.runs[1].variant, "serial (s/2)");
}

TEST_F(ReportEntriesTest, WhatIsNotValidOrWholeIsNoRepeat) {
  add("s/1", run(4));
  Record record = run(1);
  record.valid = false;
  add("s/2", record);
  record = run(1);
  record.complete = false;
  add("s/3", record);
  EXPECT_EQ(entries().runs.size(), 3U);
}

TEST_F(ReportEntriesTest, RepeatsWithinARecordCountAsRuns) {
  Record three = run(2);
  three.repetition = testing::sample_repetition();
  add("s/1", three);
  add("s/2", run(1));
  const auto entry = entries().runs.at(0);
  EXPECT_EQ(entry.record.at("repetition").at("runs"), 4);
}

TEST_F(ReportEntriesTest, VariantsSayInWhatRunsOfASequenceDiffer) {
  add("a", run(1));
  add("b", run(1, "openmp"));
  Record other = run(1);
  other.parameters[0].value = "128,128,128";
  add("c", other);
  other.sequence = "kt0";
  other.input_hash = "00";
  add("d", other);
  std::vector<std::string> variants, sequences;
  for (const ReportRun& run : entries().runs) {
    variants.push_back(run.variant);
    sequences.push_back(run.sequence);
  }
  EXPECT_THAT(variants, ElementsAre("serial, volume-resolution 256,256,256",
                                    "openmp, volume-resolution 256,256,256",
                                    "serial, volume-resolution 128,128,128",
                                    "serial, volume-resolution 128,128,128"));
  EXPECT_THAT(sequences, ElementsAre("kt3", "kt3", "kt3", "kt0"));
}

TEST_F(ReportEntriesTest, FollowTheSuiteThatMadeThem) {
  add("out/kt3-b/1", run(1, "openmp"));
  add("out/kt3-b/2", run(2, "openmp"));
  add("out/kt3-a/1", run(4));
  folder_.write("out/suite.json",
                suite_index_json({"Paper",
                                  "",
                                  {{"kt3-a", "living room 3", "C++", "", "", {}},
                                   {"kt3-b", "living room 3", "OpenMP", "", "", {}}}}));
  const ReportEntries found = entries();
  EXPECT_EQ(found.title, "Paper");
  EXPECT_THAT(names(found), ElementsAre("living room 3, C++", "living room 3, OpenMP"));
  EXPECT_EQ(found.runs[1].variant, "OpenMP");
  add("elsewhere/1", run(1));
  EXPECT_EQ(entries().title, "") << "not all are of the suite";
}

TEST_F(ReportEntriesTest, TheSequenceOfMostRunsIsShownInDetail) {
  for (const char* name : {"a", "b", "c"}) {
    Record record = run(1, name);
    record.sequence = name[0] == 'a' ? "kt0" : "kt3";
    add(name, record);
  }
  EXPECT_THAT(detailed_runs(runs_, {}), ElementsAre(1, 2));
  EXPECT_THAT(detailed_runs(runs_, {.detailed_runs = 1}), ElementsAre(1));
  EXPECT_THAT(detailed_runs(runs_, {.detailed_runs = 0}), ElementsAre());
  runs_.pop_back();
  EXPECT_THAT(detailed_runs(runs_, {}), ElementsAre(0)) << "the first of as many";
}

}  // namespace
}  // namespace slambench
