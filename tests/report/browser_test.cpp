// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// Reports as a browser shows them.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string_view>

#include "io/files.h"
#include "report/sample_results.h"
#include "support/program.h"

namespace slambench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

class BrowserTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!can_draw_charts()) GTEST_SKIP() << "built without plotly.js";
    if (std::string(SLAMBENCH_CHROMIUM).empty()) GTEST_SKIP() << "there is no chromium here";
  }

  /// The page after its script ran, without the data that it was made from. Fails when the console
  /// says anything; what the page is forbidden to fetch is said there.
  std::string loaded(const std::vector<std::string>& folders) {
    return loaded(testing::read_runs(folders));
  }
  std::string loaded(const std::vector<ReportRun>& runs) {
    const std::string page = report_page(runs, {});
    const std::string file = folder_.write("report.html", page);
    testing::Program chromium(SLAMBENCH_CHROMIUM);
    chromium.set_environment("HOME", folder_.path());
    const auto outcome =
        chromium.run({"--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                      "--enable-unsafe-swiftshader", "--use-angle=swiftshader", "--no-first-run",
                      "--user-data-dir=" + folder_.path("profile"), "--virtual-time-budget=20000",
                      "--enable-logging=stderr", "--v=0", "--dump-dom", "file://" + file});
    EXPECT_EQ(outcome.status, 0);
    std::istringstream lines(outcome.err);
    for (std::string line; std::getline(lines, line);) {
      if (line.find("CONSOLE") == std::string::npos) continue;
      // How fast WebGL is without a GPU.
      if (line.find("GPU stall") != std::string::npos) continue;
      if (line.find("willReadFrequently") != std::string::npos) continue;
      ADD_FAILURE() << line;
    }
    return without_data(outcome.out);
  }

  /// By hand: std::regex takes a stack frame for every character that it repeats over.
  static std::string without_data(std::string dom) {
    static constexpr std::string_view end = "</script>";
    for (std::size_t at = 0;
         (at = dom.find("<script type=\"application/json\"", at)) != std::string::npos;) {
      const std::size_t behind = dom.find(end, at);
      if (behind == std::string::npos) {
        ADD_FAILURE() << "a script does not end";
        break;
      }
      dom.erase(at, behind + end.size() - at);
    }
    return dom;
  }

  /// Every figure that the page shows: its exact value, and its text.
  struct Shown {
    std::string place, value, text;
  };
  static std::vector<Shown> shown_figures(const std::string& dom) {
    const std::regex pattern("data-place=\"([^\"]+)\" data-value=\"([^\"]+)\">([^<]+)<");
    std::vector<Shown> list;
    for (std::sregex_iterator it(dom.begin(), dom.end(), pattern), end; it != end; ++it) {
      list.push_back({(*it)[1], (*it)[2], (*it)[3]});
    }
    return list;
  }

  static bool has_chart(const std::string& dom, const std::string& id) {
    const std::regex chart("<div class=\"[^\"]*js-plotly-plot[^\"]*\" id=\"" + id + "\"");
    const std::regex reversed("<div[^>]*id=\"" + id + "\"[^>]*js-plotly-plot");
    return std::regex_search(dom, chart) || std::regex_search(dom, reversed);
  }

  testing::TemporaryFolder folder_;
};

TEST_F(BrowserTest, ShowsTheFiguresOfTheRecord) {
  const std::string path = testing::write_run(folder_, "a", testing::full_record());
  const std::string dom = loaded({path});
  EXPECT_THAT(dom, HasSubstr("data-state=\"ready\""));
  for (const char* id : {"chart-stages", "chart-kernels", "chart-times", "chart-errors",
                         "chart-path", "chart-above", "chart-energy"}) {
    EXPECT_TRUE(has_chart(dom, id)) << id;
  }
  EXPECT_FALSE(has_chart(dom, "chart-trade-off"));
  EXPECT_THAT(dom, HasSubstr("A trade-off needs several runs"));

  const Json record = Json::parse(read_file(path + "/record.json"));
  const std::map<std::string, double> factors = {
      {"time.computation_s.mean", 1e3},
      {"accuracy.over_processed.ate_m.se3.rmse", 1e3},
      {"accuracy.over_processed.rpe_translation_m.rmse", 1e3},
      {"memory.peak_resident_bytes", 1.0 / (1 << 20)},
      {"memory.map_bytes", 1.0 / (1 << 20)}};
  const auto figures = shown_figures(dom);
  EXPECT_EQ(figures.size(), 8U);
  for (const Shown& figure : figures) {
    Json value = record;
    std::istringstream keys(figure.place);
    for (std::string key; std::getline(keys, key, '.');) value = value.at(key);
    const Json& medians = record.at("repetition").at("figures");
    if (medians.contains(figure.place)) value = medians.at(figure.place).at("median");
    EXPECT_EQ(std::stod(figure.value), value.get<double>()) << figure.place;
    const auto factor = factors.find(figure.place);
    const double expected = value.get<double>() * (factor == factors.end() ? 1 : factor->second);
    EXPECT_NEAR(std::stod(figure.text), expected, 1e-3 * std::abs(expected)) << figure.place;
  }
}

TEST_F(BrowserTest, ComparesRuns) {
  Record slow = testing::full_record();
  for (FrameRecord& frame : slow.frames) {
    if (!frame.dropped) frame.times = testing::sample_times(2);
  }
  const std::string dom = loaded({testing::write_run(folder_, "fast", testing::full_record()),
                                  testing::write_run(folder_, "slow", slow)});
  EXPECT_THAT(dom, HasSubstr("data-state=\"ready\""));
  EXPECT_TRUE(has_chart(dom, "chart-trade-off"));
  EXPECT_THAT(dom, HasSubstr("Pareto front"));
  // Eight figures of each, and their errors in the table of them.
  EXPECT_EQ(shown_figures(dom).size(), 18U);
  EXPECT_TRUE(has_chart(dom, "chart-stages"));
  EXPECT_TRUE(has_chart(dom, "chart-power"));
}

/// Two sequences, three backends, two repeats of each: what the paper's experiment looks like.
TEST_F(BrowserTest, ShowsSequencesByVariants) {
  std::vector<ReportRun> runs;
  for (const char* sequence : {"kt0", "kt2"}) {
    for (const char* backend : {"serial", "openmp", "opencl"}) {
      for (const int repeat : {1, 2}) {
        Record record = testing::single_run();
        record.sequence = record.input_hash = sequence;
        record.provenance.backend = backend;
        for (FrameRecord& frame : record.frames) {
          if (!frame.dropped) frame.times = testing::sample_times(repeat);
        }
        runs.push_back(read_report_run(testing::write_run(
            folder_, fmt::format("{}-{}/{}", sequence, backend, repeat), record)));
      }
    }
  }
  const std::string dom = loaded(report_entries(std::move(runs), {}, true).runs);
  EXPECT_THAT(dom, HasSubstr("data-state=\"ready\""));
  EXPECT_THAT(dom, HasSubstr("12 runs of 6 configurations"));
  for (const char* id : {"chart-stages-1", "chart-stages-2", "chart-kernels-1", "chart-kernels-2",
                         "chart-energy-1", "chart-energy-2", "chart-power", "chart-times"}) {
    EXPECT_TRUE(has_chart(dom, id)) << id;
  }
  EXPECT_FALSE(has_chart(dom, "chart-stages"));
  EXPECT_THAT(dom, HasSubstr("Shown are 3 of 6 runs, those on kt0."));
  int errors = 0;  // in the table of all runs, and in that by sequence and variant
  for (const Shown& figure : shown_figures(dom)) {
    if (figure.place == "accuracy.over_processed.ate_m.se3.rmse") ++errors;
  }
  EXPECT_EQ(errors, 2 * 6);
  EXPECT_THAT(dom, HasSubstr("20.70, max 20.70")) << "as SLAMBench 1 published it";
}

TEST_F(BrowserTest, SaysWhyThereIsNothing) {
  Record record = testing::full_record();
  record.ground_truth.clear();
  record.over_processed.reset();
  record.over_all.reset();
  record.slambench1_ate_m.reset();
  for (FrameRecord& frame : record.frames) frame.error_first_pose_m = frame.error_se3_m = {};
  record.absent["accuracy.over_processed"] = "the sequence has no ground truth";
  record.measurements = {};
  record.measurements.absent["energy"] = "no sensor can be read here";
  const std::string path = testing::write_run(folder_, "a", record);
  std::filesystem::remove_all(path + "/images");
  const std::string dom = loaded({path});
  EXPECT_THAT(dom, HasSubstr("data-state=\"ready\""));
  EXPECT_FALSE(has_chart(dom, "chart-errors"));
  EXPECT_FALSE(has_chart(dom, "chart-energy"));
  EXPECT_TRUE(has_chart(dom, "chart-path"));
  EXPECT_THAT(dom, HasSubstr("Not judged: the sequence has no ground truth."));
  EXPECT_THAT(dom, HasSubstr("Energy was not measured: no sensor can be read here."));
  EXPECT_THAT(dom, HasSubstr("No run saved pictures"));
}

TEST_F(BrowserTest, TakesNoNameForMarkup) {
  Record record = testing::full_record();
  record.sequence = record.provenance.command = record.provenance.device = testing::hostile;
  record.parameters[0].value = record.parameters[1].name = testing::hostile;
  record.measurements.energy->rails[0].name = testing::hostile;
  record.measurements.conditions.noise = {testing::hostile};
  const std::string other = testing::write_run(folder_, "other", testing::full_record());
  const std::string dom =
      loaded({testing::write_run(folder_, "<img src=x onerror=\"alert(1)\">", record), other});
  EXPECT_THAT(dom, HasSubstr("data-state=\"ready\""));
  EXPECT_THAT(dom, HasSubstr("<title>SLAMBench report</title>"));
  EXPECT_THAT(dom, Not(HasSubstr("<img src=\"x\"")));
}

}  // namespace
}  // namespace slambench
