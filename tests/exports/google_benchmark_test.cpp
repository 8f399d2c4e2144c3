// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "exports/exported.h"
#include "support/program.h"

namespace slambench {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;
using testing::exported;
using testing::message_of;
using testing::single_record;

class GoogleBenchmarkTest : public ::testing::Test {
 protected:
  Json document(const std::vector<Record>& records) {
    return Json::parse(google_benchmark_json(exported(folder_, records), {}));
  }
  std::string refusal(const std::vector<Record>& records) {
    return message_of<InputError>([&] { document(records); });
  }
  /// The entries of that name, in order.
  static std::vector<Json> entries(const Json& document, const std::string& name) {
    std::vector<Json> found;
    for (const Json& entry : document.at("benchmarks")) {
      if (entry.at("name") == name) found.push_back(entry);
    }
    return found;
  }

  testing::TemporaryFolder folder_;
};

TEST_F(GoogleBenchmarkTest, HasTheTimesOfARun) {
  const Json json = document({single_record()});
  EXPECT_EQ(json.at("context").at("num_cpus"), 2);
  EXPECT_EQ(json.at("context").at("mhz_per_cpu"), 2000);
  EXPECT_EQ(json.at("context").at("cpu_scaling_enabled"), true);
  EXPECT_THAT(json.at("context").at("cpu_time"), HasSubstr("not measured"));
  const auto track = entries(json, "kt3/kernel/track");
  ASSERT_EQ(track.size(), 1U);
  // Frames 1, 3 and 4 are measured: 8/3 of 1/16 s on average.
  EXPECT_DOUBLE_EQ(track[0].at("real_time").get<double>(), 8 / 3.0 / 16 * 1e3);
  EXPECT_EQ(track[0].at("cpu_time"), track[0].at("real_time"));
  EXPECT_EQ(track[0].at("time_unit"), "ms");
  EXPECT_EQ(track[0].at("run_type"), "iteration");
  EXPECT_EQ(track[0].at("iterations"), 3);
  EXPECT_EQ(track[0].at("threads"), 3);
  EXPECT_EQ(entries(json, "kt3/stage/render").size(), 1U);
  EXPECT_TRUE(entries(json, "kt3/kernel/raycast").empty()) << "was not called";
  const auto computation = entries(json, "kt3/computation");
  ASSERT_EQ(computation.size(), 1U);
  EXPECT_DOUBLE_EQ(computation[0].at("items_per_second").get<double>(), 1 / (8 / 3.0 * 15 / 32));
  EXPECT_EQ(computation[0].at("frame_energy_j"), 16);
  EXPECT_EQ(computation[0].at("ate_rmse_m"), 0.001);
  EXPECT_FALSE(computation[0].contains("device_bytes")) << "was not measured";
}

TEST_F(GoogleBenchmarkTest, RepeatedRunsAreRepetitions) {
  const Json json = document({testing::sample_record(), single_record()});
  const auto computation = entries(json, "kt3/computation");
  ASSERT_EQ(computation.size(), 4U) << "three in one record, and another run";
  EXPECT_EQ(computation[1].at("real_time"), 1250);
  EXPECT_FALSE(computation[0].contains("frame_energy_j")) << "known of one repeat of three";
  EXPECT_TRUE(computation[3].contains("frame_energy_j"));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(computation[i].at("repetitions"), 4);
    EXPECT_EQ(computation[i].at("repetition_index"), i);
  }
}

TEST_F(GoogleBenchmarkTest, HasNoThreadsWhereTheRecordHasNone) {
  Record record = single_record();
  record.provenance.threads = 0;
  EXPECT_FALSE(entries(document({record}), "kt3/computation").at(0).contains("threads"));
}

TEST_F(GoogleBenchmarkTest, BackendsAreNamedWhereThereAreSeveral) {
  Record other = single_record();
  other.provenance.backend = "openmp";
  const Json json = document({single_record(), other});
  EXPECT_EQ(entries(json, "kt3/serial/total").size(), 1U);
  EXPECT_EQ(entries(json, "kt3/openmp/total").size(), 1U);
  EXPECT_TRUE(entries(json, "kt3/total").empty());
}

TEST_F(GoogleBenchmarkTest, RefusesWhatWouldBeMixedUpOrDoesNotCount) {
  Record other = single_record();
  other.parameters[1].value = "4,4,4";
  EXPECT_THAT(
      refusal({single_record(), other}),
      AllOf(HasSubstr("r0"), HasSubstr("r1"), HasSubstr("volume-size (5,5,5 against 4,4,4)"),
            HasSubstr("files of their own: slambench export " + folder_.path("r0") +
                      " --format google-benchmark -o r0.json && slambench export " +
                      folder_.path("r1") + " --format google-benchmark -o r1.json")));
  other = single_record();
  other.complete = false;
  EXPECT_THAT(refusal({other}), HasSubstr("was interrupted"));
  other = single_record();
  other.valid = false;
  EXPECT_THAT(refusal({other}), HasSubstr("is not valid"));
  other = single_record();
  other.frames.resize(1);
  EXPECT_THAT(refusal({other}), HasSubstr("has no times: "));
}

TEST_F(GoogleBenchmarkTest, ARefusalKeepsRepeatsTogether) {
  Record other = single_record();
  other.parameters[1].value = "4,4,4";
  std::vector<std::string> paths;
  for (const char* place : {"coarse/1", "coarse/2", "fine's/1", "fine's/2"}) {
    paths.push_back(folder_.path(place));
    std::filesystem::create_directories(std::filesystem::path(paths.back()).parent_path());
    write_results(paths.back(), true, place[0] == 'c' ? single_record() : other);
  }
  const std::string refused =
      message_of<InputError>([&] { google_benchmark_json(read_export_runs(paths), roles_of({})); });
  const std::string fine = "'" + folder_.path("fine'\\''s");
  EXPECT_THAT(
      refused,
      HasSubstr("slambench export " + folder_.path("coarse/1") + " " + folder_.path("coarse/2") +
                " --format google-benchmark -o coarse-1.json && slambench export " + fine + "/1' " +
                fine + "/2' --format google-benchmark -o 'fine'\\''s-1.json'"));
}

/// The script needs scipy, which evo needs too: SLAMBENCH_EVO_PYTHON, else python3.
TEST_F(GoogleBenchmarkTest, TheScriptOfGoogleBenchmarkComparesTwo) {
  if (std::string(SLAMBENCH_COMPARE_PY).empty()) GTEST_SKIP() << "libbenchmark-tools is missing";
  const char* chosen = std::getenv("SLAMBENCH_EVO_PYTHON");
  const testing::Program python(chosen == nullptr ? "/usr/bin/python3" : chosen);
  if (python.run({"-c", "import scipy"}).status != 0) GTEST_SKIP() << "python has no scipy";
  Record slower = testing::sample_record();
  for (double& value : slower.repetition.figures.at("time.computation_s.mean").values) value *= 1.5;
  const auto write = [&](const char* name, const Record& record) {
    return python.folder().write(name, google_benchmark_json(exported(folder_, {record}), {}));
  };
  const std::string base = write("base.json", testing::sample_record());
  const std::string other = write("other.json", slower);
  const auto outcome = python.run({SLAMBENCH_COMPARE_PY, "--no-color", "benchmarks", base, other});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  // Three repetitions of 1, 1.25 and 2 s against half as much again.
  EXPECT_THAT(outcome.out, ::testing::ContainsRegex("kt3/computation +\\+0\\.5000"));
  EXPECT_THAT(outcome.out, HasSubstr("kt3/computation_pvalue"));
  EXPECT_THAT(outcome.out, HasSubstr("U Test, Repetitions: 3 vs 3"));
  EXPECT_THAT(outcome.out, ::testing::ContainsRegex("kt3/kernel/track +\\+0\\.0000"));
}

}  // namespace
}  // namespace slambench
