// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/comparison.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "core/error.h"
#include "results/result_folder.h"
#include "results/sample_record.h"
#include "results/writers.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::message_of;
using ::testing::Not;

const ParameterRoles roles = {{"backend.threads", ParameterRole::implementation},
                              {"run.repeat", ParameterRole::bookkeeping},
                              {"run.warmup", ParameterRole::bookkeeping},
                              {"output.out", ParameterRole::bookkeeping}};

/// A machine on which runs of the same program differ.
class NoisyMachine {
 public:
  explicit NoisyMachine(std::uint64_t seed) : random_(seed) {}

  /// The whole machine becomes slower or faster for what follows.
  void drift() { speed_ *= std::exp(0.1 * normal_(random_)); }

  /// A run in which the raycast takes `raycast` times as long as it does; tracking scatters most.
  Record run(double raycast, int second = 0) {
    Record record = testing::sample_record();
    record.repetition = {};
    record.measurements = {};
    record.provenance.started_at =
        fmt::format("2015-05-26T09:{:02}:{:02}Z", second / 60, second % 60);
    record.frames.resize(1, record.frames.front());
    const double track_noise = noise(0.04), raycast_noise = noise(0.02);
    for (int i = 1; i < 40; ++i) {
      FrameRecord frame;
      frame.index = i;
      frame.tracked = true;
      testing::seconds(frame.times, Stage::track) = 2e-3 * track_noise * noise(0.1);
      testing::seconds(frame.times, Stage::raycast) = 5e-3 * raycast_noise * raycast * noise(0.1);
      for (double& s : frame.times.stage_s) s *= speed_;
      testing::called(frame.times, Kernel::align, frame.times.stage(Stage::track), 1);
      testing::called(frame.times, Kernel::raycast, frame.times.stage(Stage::raycast), 1);
      record.frames.push_back(frame);
    }
    return record;
  }

 private:
  double noise(double sigma) { return std::exp(sigma * normal_(random_)); }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  double speed_ = 1;
};

StoredRun stored(const Record& record) { return parse_stored_run(record_json(record), "r"); }

struct Two {
  RunGroup base, other;
};

/// `count` runs of each side that took turns.
Two interleaved(std::uint64_t seed, double raycast, int count) {
  NoisyMachine machine(seed);
  Two two{{"base", {}}, {"other", {}}};
  for (int i = 0; i < count; ++i) {
    machine.drift();
    two.base.runs.push_back(stored(machine.run(1, 10 * i)));
    two.other.runs.push_back(stored(machine.run(raycast, 10 * i + 5)));
  }
  return two;
}

std::set<std::string> shown(const Comparison& comparison) {
  std::set<std::string> names;
  for (const FigureComparison& f : comparison.figures) {
    if (f.verdict == Verdict::lower || f.verdict == Verdict::higher) names.insert(f.figure->name);
  }
  return names;
}

const FigureComparison& figure(const Comparison& comparison, std::string_view name) {
  for (const FigureComparison& f : comparison.figures) {
    if (f.figure->name == name) return f;
  }
  throw std::out_of_range(std::string(name));
}

TEST(Compare, ShowsNoDifferenceBetweenRunsOfTheSameBuild) {
  int none_shown = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Two two = interleaved(seed, 1, 8);
    none_shown += shown(compare(two.base, two.other, {})).empty() ? 1 : 0;
  }
  EXPECT_GE(none_shown, 93);
}

TEST(Compare, FindsTheKernelThatBecameSlower) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Two two = interleaved(seed, 1.1, 10);
    const Comparison comparison = compare(two.base, two.other, {});
    EXPECT_EQ(comparison.evidence, Evidence::pairs);
    const auto names = shown(comparison);
    found += names.count("kernel_raycast_s");
    EXPECT_EQ(names.count("kernel_align_s"), 0u);
    EXPECT_EQ(verdict_text(figure(comparison, "kernel_align_s")), "no difference shown");
  }
  EXPECT_GE(found, 19);
  const Two two = interleaved(3, 1.1, 10);
  const Comparison comparison = compare(two.base, two.other, {});
  const FigureComparison& raycast = figure(comparison, "kernel_raycast_s");
  EXPECT_EQ(verdict_text(raycast), "slower");
  EXPECT_GT(raycast.interval->low, 1.03);
  EXPECT_LT(raycast.interval->high, 1.17);
  EXPECT_NEAR(*raycast.ratio, raycast.interval->ratio, 1e-12);
}

TEST(Compare, LooksMoreCloselyAtFewerFigures) {
  const Two two = interleaved(1, 1, 8);
  const auto width = [&](const std::vector<std::string>& figures) {
    const Comparison c = compare(two.base, two.other, {.confidence = 0.95, .figures = figures});
    return figure(c, "fps").interval->high - figure(c, "fps").interval->low;
  };
  EXPECT_LT(width({"fps"}), 0.7 * width({}));
  EXPECT_THAT(message_of<UsageError>([&] { width({"raycast"}); }),
              AllOf(HasSubstr("unknown figure 'raycast'"), HasSubstr("kernel_raycast_s")));
}

TEST(Compare, TakesPairsOnlyOfRunsThatTookTurns) {
  Two two = interleaved(1, 1, 8);
  for (StoredRun& run : two.other.runs) {
    run.texts["provenance.started_at"] = "2016-05-26T09:00:00Z";
  }
  EXPECT_EQ(compare(two.base, two.other, {}).evidence, Evidence::runs);
  const auto no_turns = ContainsRegex("did\\s+not\\s+take\\s+turns");
  EXPECT_THAT(comparison_text({compare(two.base, two.other, {})}), no_turns);
  two.other.runs.resize(2);
  EXPECT_EQ(compare(two.base, two.other, {}).evidence, Evidence::runs);
}

TEST(Compare, SaysWhenRunsThatTookTurnsAreTooFew) {
  const Two two = interleaved(1, 1, 3);
  const Comparison c = compare(two.base, two.other, {.figures = {"fps"}});
  EXPECT_EQ(c.evidence, Evidence::runs);
  EXPECT_THAT(comparison_text({c}),
              AllOf(ContainsRegex("too\\s+few\\s+to\\s+be\\s+taken\\s+in\\s+pairs"),
                    HasSubstr("The interval holds with 95 % confidence.")));
}

TEST(Compare, SaysWhenASideHasARunMore) {
  Two two = interleaved(1, 1, 8);
  two.other.runs.pop_back();
  const Comparison c = compare(two.base, two.other, {});
  EXPECT_EQ(c.evidence, Evidence::runs);
  EXPECT_THAT(comparison_text({c}),
              ContainsRegex("are\\s+not\\s+as\\s+many\\s+on\\s+each\\s+side"));
}

TEST(Compare, CallsNothingShownBySingleRuns) {
  const testing::TemporaryFolder folder;
  NoisyMachine machine(1);
  write_results(folder.path("a"), false, machine.run(1));
  write_results(folder.path("b"), false, machine.run(1.5));
  const RunGroup base = read_run_group(folder.path("a"), roles),
                 other = read_run_group(folder.path("b"), roles);
  const Comparison c = compare(base, other, {});
  EXPECT_EQ(c.evidence, Evidence::frames);
  EXPECT_EQ(c.frames, 39u);
  EXPECT_EQ(verdict_text(figure(c, "kernel_raycast_s")), "repeat to tell");
  EXPECT_NEAR(figure(c, "kernel_raycast_s").interval->ratio, 1.5, 0.2);
  EXPECT_LT(figure(c, "fps").interval->high, 1) << "the more time, the fewer frames a second";
  EXPECT_EQ(verdict_text(figure(c, "ate_rmse_m")), "the same");
  EXPECT_THAT(comparison_text({c}), HasSubstr("block bootstrap over the 39 measured frames"));
}

TEST(Compare, TakesAccuracyAndTheMapAsTheyAre) {
  Two two = interleaved(1, 1, 6);
  for (StoredRun& run : two.other.runs) {
    run.numbers["accuracy.over_processed.ate_m.se3.rmse"] = 0.0013;
    run.numbers["memory.map_bytes"] = 1 << 20;
  }
  Comparison c = compare(two.base, two.other, {});
  EXPECT_EQ(verdict_text(figure(c, "ate_rmse_m")), "worse");
  EXPECT_FALSE(figure(c, "ate_rmse_m").interval);
  EXPECT_EQ(verdict_text(figure(c, "map_bytes")), "less");
  EXPECT_EQ(verdict_text(figure(c, "tracked")), "the same");
  // In real time no two runs need be alike.
  for (RunGroup* group : {&two.base, &two.other}) {
    for (StoredRun& run : group->runs) run.texts["parameters.run.real-time.value"] = "true";
  }
  two.base.runs.resize(1);
  two.other.runs.resize(1);
  c = compare(two.base, two.other, {});
  EXPECT_EQ(verdict_text(figure(c, "ate_rmse_m")), "repeat to tell");
}

TEST(Compare, UsesTheRepeatsOfARecord) {
  Two two = interleaved(1, 1, 1);
  two.base.runs[0].repeats["time.fps_computation"] = {100, 101, 99, 100};
  two.other.runs[0].repeats["time.fps_computation"] = {80, 81, 79, 80};
  const Comparison c = compare(two.base, two.other, {.confidence = 0.95, .figures = {"fps"}});
  EXPECT_EQ(c.evidence, Evidence::runs);
  EXPECT_EQ(c.base.runs, 4u);
  EXPECT_EQ(verdict_text(figure(c, "fps")), "slower");
  EXPECT_NEAR(*figure(c, "fps").ratio, 0.8, 1e-3);
}

TEST(Compare, ShowsNothingOfFiguresThatARecordDoesNotRepeat) {
  Two two = interleaved(1, 1, 1);
  two.base.runs[0].repeats["time.fps_computation"] = {100, 101, 99, 100};
  two.other.runs[0].repeats["time.fps_computation"] = {80, 81, 79, 80};
  const Comparison c = compare(two.base, two.other, {});
  EXPECT_FALSE(figure(c, "computation_p99_s").interval);
  EXPECT_EQ(verdict_text(figure(c, "computation_p99_s")), "repeat to tell");
}

/// A run whose trajectory error is this, and the number of tracked frames that.
StoredRun with_error(double ate_rmse_m, int tracked = 100) {
  StoredRun run = stored(testing::sample_record());
  run.repeats.clear();
  run.numbers["accuracy.over_processed.ate_m.se3.rmse"] = ate_rmse_m;
  run.numbers["frames.tracked"] = tracked;
  return run;
}

TEST(Compare, TakesErrorsThatRoundingMovesForTheSame) {
  const auto verdict = [](double base, double other, std::optional<double> tolerance = {}) {
    const Comparison c = compare({"base", {with_error(base)}}, {"other", {with_error(other)}},
                                 {.tolerance = tolerance});
    return verdict_text(figure(c, "ate_rmse_m"));
  };
  EXPECT_EQ(verdict(0.020, 0.020), "the same");
  EXPECT_EQ(verdict(0.020, 0.0203), "within tolerance");
  EXPECT_EQ(verdict(0.020, 0.0197), "within tolerance");
  EXPECT_EQ(verdict(0.020, 0.0207), "worse");
  EXPECT_EQ(verdict(0.020, 0.0193), "better");
  EXPECT_EQ(verdict(0.001, 0.00118), "within tolerance") << "0.18 mm";
  EXPECT_EQ(verdict(0.001, 0.00122), "worse");
  EXPECT_EQ(verdict(0.020, 0.0203, 0), "worse") << "only equal is the same";
  EXPECT_EQ(verdict(0.001, 0.00118, 0), "worse");
  EXPECT_EQ(verdict(0.020, 0.0203, 0.01), "worse");
  EXPECT_EQ(verdict(0.020, 0.0219, 0.1), "within tolerance");
}

TEST(Compare, CountsHaveNoTolerance) {
  const Comparison c = compare({"base", {with_error(0.02, 1000)}},
                               {"other", {with_error(0.02, 999)}}, {.tolerance = 0.5});
  EXPECT_EQ(verdict_text(figure(c, "tracked")), "fewer");
}

TEST(CompareDocuments, ShowTheDigitsInWhichErrorsDiffer) {
  const Comparison c =
      compare({"base", {with_error(0.0021504)}}, {"other", {with_error(0.00215043)}}, {});
  EXPECT_THAT(comparison_text({c}), AllOf(HasSubstr("2.15040"), HasSubstr("2.15043"),
                                          HasSubstr("within tolerance"), HasSubstr("--tolerance")));
  EXPECT_THAT(comparison_markdown({c}), AllOf(HasSubstr("2.15040"), HasSubstr("2.15043")));
}

TEST(CompareDocuments, SayWhereStagesOfOneSideAreTheDevicesTimes) {
  NoisyMachine machine(14);
  Record in_one_go = machine.run(1);
  for (FrameRecord& frame : in_one_go.frames) frame.times.between_stages_s = 1e-3;
  const RunGroup a{"a", {stored(machine.run(1))}}, b{"b", {stored(in_one_go)}};
  EXPECT_TRUE(value_of(find_figure("between_stages_s")->place, b.runs.front()));
  const auto remark = ContainsRegex("Stages of b are .* those of a\\s+wall");
  EXPECT_THAT(comparison_text({compare(a, b, {})}), remark);
  EXPECT_THAT(comparison_markdown({compare(b, a, {})}), remark);
  const auto none = Not(HasSubstr("Stages of"));
  EXPECT_THAT(comparison_text({compare(a, a, {})}), none);
  EXPECT_THAT(comparison_text({compare(b, b, {})}), AllOf(none, HasSubstr("between_stages")));
  EXPECT_THAT(comparison_text({compare(a, b, {.figures = {"computation_s"}})}), none);
}

TEST(CompareViolations, CountRatiosOnlyBeyondTheirInterval) {
  const Two two = interleaved(3, 1.1, 10);
  const Comparison c = compare(two.base, two.other, {});
  const auto lines = [&](const char* text) {
    return violations({parse_limit(text, true)}, two.other, c);
  };
  EXPECT_THAT(lines("ratio(kernel_raycast_s)>1.02"), ::testing::SizeIs(1));
  EXPECT_THAT(lines("ratio(kernel_raycast_s)>1.09"), IsEmpty());
  EXPECT_THAT(lines("kernel_raycast_s>0.004"),
              ElementsAre(HasSubstr("other: kernel_raycast_s is")));
  EXPECT_THAT(lines("lost>0"), IsEmpty());
  EXPECT_THAT(message_of<UnavailableError>([&] { lines("ratio(energy_j)>1"); }),
              HasSubstr("energy_j was not measured: "));
}

TEST(CompareDocuments, AreOf80ColumnsAndEqualInAllFormats) {
  const Two two = interleaved(3, 1.1, 10);
  const Comparison c = compare(two.base, two.other, {});
  const std::string text = comparison_text({c, c});
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    EXPECT_LE(end - begin, 80u) << text.substr(begin, end - begin);
    begin = end + 1;
  }
  EXPECT_THAT(text, AllOf(HasSubstr("base (10 runs): kt3 on serial, commit 0123456789ab"),
                          HasSubstr("kernels, ms a frame"), HasSubstr("slower"),
                          HasSubstr("10 pairs of runs that")));
  EXPECT_THAT(comparison_markdown({c}), HasSubstr("| `kernel_raycast_s`, ms |"));
  const auto json = nlohmann::json::parse(comparison_json({c}));
  const auto& first = json.at("comparisons").at(0);
  EXPECT_EQ(first.at("intervals_from"), "pairs");
  EXPECT_EQ(first.at("figures").size(), c.figures.size());
  const std::string csv = comparison_csv({c});
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
            1 + c.figures.size());
  EXPECT_THAT(csv, HasSubstr("base,other,10,10,kernel_raycast_s,s,"));
  EXPECT_THAT(csv, HasSubstr(",pairs,slower\r\n"));
}

TEST(CompareText, KeepsColumnsApartHoweverLargeARatioIs) {
  NoisyMachine machine(1);
  const auto group = [&](double first, double second) {
    return RunGroup{"g", {stored(machine.run(first)), stored(machine.run(second))}};
  };
  const ComparisonOptions one{.figures = {"kernel_raycast_s"}};
  const Comparison large = compare(group(1, 1), group(1e6, 1e6), one);
  EXPECT_THAT(comparison_text({large}),
              ContainsRegex(" raycast +[0-9.e+]+ +[0-9.e+]+ [0-9.]+e\\+0[56] "
                            "[0-9.]+e\\+0[0-9] to [0-9.]+e\\+0[0-9] slower\n"));
  const Comparison wide = compare(group(1, 1), group(1, 1e6), one);
  EXPECT_THAT(comparison_text({wide}), ContainsRegex(" raycast .* too few runs to tell\n"));
  EXPECT_GT(figure(wide, "kernel_raycast_s").interval->high, 1e6) << "the documents have it";
}

TEST(RunGroupTest, ReadsFoldersFilesAndLists) {
  const testing::TemporaryFolder folder;
  NoisyMachine machine(1);
  for (const char* name : {"all/2", "all/1", "one"}) {
    write_results(folder.path(name), false, machine.run(1));
  }
  folder.write("all/notes.txt", "");
  folder.write(".hidden/record.json", "");
  EXPECT_EQ(read_run_group(folder.path("all"), roles).runs.size(), 2u);
  EXPECT_EQ(read_run_group(folder.path("one"), roles).runs.size(), 1u);
  EXPECT_EQ(read_run_group(folder.path("one/record.json"), roles).runs.size(), 1u);
  EXPECT_EQ(read_run_group(folder.path("one") + "," + folder.path("all"), roles).runs.size(), 3u);
  folder.write("none/x", "");
  EXPECT_THAT(message_of<InputError>([&] { read_run_group(folder.path("none"), roles); }),
              HasSubstr("expected a result folder or a folder of result folders"));
}

TEST(RunGroupTest, RefusesWhatDoesNotCountOrIsNoRepeat) {
  const testing::TemporaryFolder folder;
  Record record = testing::sample_record();
  record.complete = false;
  write_results(folder.path("stopped"), false, record);
  EXPECT_THAT(message_of<InputError>([&] { read_run_group(folder.path("stopped"), roles); }),
              HasSubstr("the run was interrupted"));
  record = testing::sample_record();
  record.valid = false;
  write_results(folder.path("bad"), false, record);
  EXPECT_THAT(message_of<InputError>([&] { read_run_group(folder.path("bad"), roles); }),
              HasSubstr("the run is not valid"));
  write_results(folder.path("both/1"), false, testing::sample_record());
  record = testing::sample_record();
  record.provenance.backend = "openmp";
  record.parameters[1].value = "4,4,4";
  record.parameters.push_back({"output", "out", "", "elsewhere", "command line"});
  write_results(folder.path("both/2"), false, record);
  EXPECT_THAT(message_of<InputError>([&] { read_run_group(folder.path("both"), roles); }),
              AllOf(HasSubstr("not repeats of one another"),
                    HasSubstr("volume-size (5,5,5 against 4,4,4)"), Not(HasSubstr("elsewhere"))));
}

TEST(RequireSameTask, NamesWhatDiffers) {
  Record record = testing::sample_record();
  const RunGroup base{"base", {stored(record)}};
  record.parameters[1].value = "4,4,4";
  record.parameters.push_back({"run", "frames", "", "5", "command line"});
  record.parameters.push_back({"backend", "threads", "", "1", "command line"});
  record.input_hash = "ff";
  record.provenance.cpu = "another CPU";
  const RunGroup other{"other", {stored(record)}};
  EXPECT_THAT(
      message_of<InputError>([&] { require_same_task(base, other, {}, roles); }),
      AllOf(HasSubstr("base and other did not compute the same"),
            HasSubstr("sequence.input_hash (00112233445566778899aabbccddeeff against ff)"),
            HasSubstr("volume-size (5,5,5 against 4,4,4)"), HasSubstr("frames (nothing against 5)"),
            Not(HasSubstr("CPU")), Not(HasSubstr("threads"))));
  EXPECT_THAT(message_of<InputError>([&] {
                require_same_task(base, other, {"volume-size", "frames"}, roles);
              }),
              AllOf(HasSubstr("sequence.input_hash"), Not(HasSubstr("volume-size"))));
  EXPECT_NO_THROW(
      require_same_task(base, other, {"volume-size", "frames", "sequence.input_hash"}, roles));
  const Comparison c = compare(base, other, {.confidence = 0.95, .figures = {}, .roles = roles});
  EXPECT_THAT(
      comparison_text({c}),
      AllOf(HasSubstr("in task: "), HasSubstr("in implementation: threads nothing against 1"),
            HasSubstr("in build and machine: cpu A CPU against another CPU")));
}

TEST(RequireSameTask, HowOftenARunIsRepeatedIsNoDifference) {
  Record record = testing::sample_record();
  const RunGroup base{"base", {stored(record)}};
  record.parameters.push_back({"run", "repeat", "runs", "3", "command line"});
  record.parameters.push_back({"run", "warmup", "runs", "1", "command line"});
  EXPECT_NO_THROW(require_same_task(base, {"other", {stored(record)}}, {}, roles));
  record.parameters.push_back({"run", "warmup-frames", "", "9", "command line"});
  EXPECT_THAT(message_of<InputError>([&] {
                require_same_task(base, {"other", {stored(record)}}, {}, roles);
              }),
              HasSubstr("warmup-frames (nothing against 9)"));
}

TEST(RequireSameTask, TakesEqualInputForEqualSequences) {
  Record record = testing::sample_record();
  const RunGroup base{"base", {stored(record)}};
  record.sequence = "another name";
  record.path = "/elsewhere";
  EXPECT_NO_THROW(require_same_task(base, {"other", {stored(record)}}, {}, roles));
}

}  // namespace
}  // namespace slambench
