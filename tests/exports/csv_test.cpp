// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gmock/gmock.h>

#include <map>

#include "analysis/figure.h"
#include "exports/exported.h"
#include "io/text.h"
#include "results/repetition.h"

namespace slambench {
namespace {

using testing::exported;
using testing::single_record;
using Row = std::map<std::string, std::string>;

/// The rows of a CSV text by the names of its columns.
std::vector<Row> rows_of(const std::string& csv) {
  std::string_view text = csv;
  const std::vector<std::string> columns = csv_fields(take_line(&text));
  std::vector<Row> rows;
  while (!text.empty()) {
    const std::vector<std::string> fields = csv_fields(take_line(&text));
    EXPECT_EQ(fields.size(), columns.size());
    Row row;
    for (std::size_t i = 0; i < fields.size(); ++i) row[columns[i]] = fields[i];
    rows.push_back(row);
  }
  return rows;
}

TEST(WideCsv, HasARowARunAndAColumnAFigureAndParameter) {
  const testing::TemporaryFolder folder;
  Record other = single_record();
  other.provenance.backend = "openmp";
  other.parameters.push_back({"backend", "device", "", "a \"fast\" one, or not", "command line"});
  const auto rows = rows_of(wide_csv(exported(folder, {testing::sample_record(), other}), {}));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].at("run"), "r0");
  EXPECT_EQ(rows[0].at("repeats"), "3");
  EXPECT_EQ(rows[0].at("computation_s"), "1.25") << "the median";
  EXPECT_EQ(rows[1].at("repeats"), "1");
  EXPECT_EQ(rows[1].at("computation_s"), "1.25");
  EXPECT_EQ(rows[1].at("backend"), "openmp");
  EXPECT_EQ(rows[1].at("sequence"), "kt3");
  EXPECT_EQ(rows[1].at("threads"), "3");
  EXPECT_EQ(rows[1].at("ate_rmse_m"), "0.001");
  EXPECT_EQ(rows[1].at("device_bytes"), "") << "was not measured";
  EXPECT_EQ(rows[1].at("kinectfusion.volume-size"), "5,5,5");
  EXPECT_EQ(rows[1].at("backend.device"), "a \"fast\" one, or not");
  EXPECT_EQ(rows[0].at("backend.device"), "") << "the run has no such parameter";
  for (const NamedFigure& figure : figure_table()) EXPECT_TRUE(rows[0].contains(figure.name));
}

TEST(Figures, OfARunAreKnownOfEveryRepeat) {
  const testing::TemporaryFolder folder;
  Record record = testing::sample_record();
  record.measurements.memory.device_bytes = 1 << 20;
  record.repetition = repetition_of({run_figures(record), run_figures(record)});
  const StoredRun run = exported(folder, {record}).front().run;
  for (const NamedFigure& figure : figure_table()) {
    EXPECT_NE(values_of(figure.place, run).size(), 1U) << figure.name;
  }
}

TEST(LongCsv, HasARowAValueAndTheReasonOfWhatIsNotThere) {
  const testing::TemporaryFolder folder;
  const auto rows = rows_of(long_csv(exported(folder, {testing::sample_record()}), {}));
  std::vector<std::string> repeats;
  for (const Row& row : rows) {
    if (row.at("figure") == "computation_s")
      repeats.push_back(row.at("repeat") + " " + row.at("value"));
    if (row.at("figure") != "device_bytes") continue;
    EXPECT_EQ(row.at("value"), "");
    EXPECT_EQ(row.at("unit"), "B");
    EXPECT_EQ(row.at("absent"), "computes in host memory");
  }
  EXPECT_THAT(repeats, ::testing::ElementsAre("1 1", "2 1.25", "3 2"));
}

}  // namespace
}  // namespace slambench
