// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// What a suite's file means: the runs, their order, and what is wrong with a file.
#include "suite/suite_plan.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <set>

#include "backends/registry.h"
#include "core/error.h"
#include "runner/runner.h"
#include "slam/kinect_fusion.h"
#include "suite/suite_summary.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Words = std::vector<std::string>;

class SuitePlanTest : public ::testing::Test {
 protected:
  SuiteFile parse(std::string_view text) { return parse_suite(text, "a.toml", lists_); }
  std::vector<Configuration> plan(std::string_view text, const SuiteSettings& overrides = {}) {
    return configurations(parse(text), overrides, lists_);
  }
  std::string error(std::string_view text) {
    return testing::message_of<InputError>([&] { plan(text); });
  }
  static Words folders(const std::vector<Configuration>& configurations) {
    Words names;
    for (const Configuration& c : configurations) names.push_back(c.folder);
    return names;
  }

  RunParameters run_;
  BackendOptions backend_;
  KinectFusionParameters fusion_;
  std::vector<ParameterList> lists_ = {run_.describe(), backend_.describe(), fusion_.describe(),
                                       backend_.opencl.describe()};
};

TEST_F(SuitePlanTest, EveryCombinationOfTheMatrixOnEverySequence) {
  const auto all = plan(
      "sequence = ['living-room/0', 'b']\npreset = 'slambench1'\n"
      "[matrix]\nvolume-resolution = [64, [64, 32, 16]]\nbackend = ['serial', 'openmp']\n"
      "fused = [true]\n[kinectfusion]\nmu = 0.2\n");
  EXPECT_THAT(
      folders(all),
      ElementsAre("living-room-0-volume-resolution-64-serial",
                  "living-room-0-volume-resolution-64-openmp",
                  "living-room-0-volume-resolution-64-32-16-serial",
                  "living-room-0-volume-resolution-64-32-16-openmp",
                  "b-volume-resolution-64-serial", "b-volume-resolution-64-openmp",
                  "b-volume-resolution-64-32-16-serial", "b-volume-resolution-64-32-16-openmp"));
  EXPECT_EQ(all[3].variant, "volume-resolution=64,32,16 openmp");
  EXPECT_EQ(all[3].sequence_name, "living-room/0");
  EXPECT_THAT(run_arguments(all[1]),
              ElementsAre("run", "living-room/0", "--preset=slambench1", "--backend=openmp",
                          "--volume-resolution=64,64,64", "--mu=0.2", "--fused=true"));
}

TEST_F(SuitePlanTest, AnEmptyValueIsAWordOfItsOwn) {
  const auto all = plan("sequence = 'a'\n[opencl]\nopencl-build-options = ''\n");
  EXPECT_THAT(run_arguments(all[0]), ElementsAre("run", "a", "--opencl-build-options", ""));
}

TEST_F(SuitePlanTest, ASuiteOfOneRunNeedsNoMatrix) {
  const auto all = plan("sequence = 'recordings/desk.raw'\n");
  EXPECT_THAT(folders(all), ElementsAre("recordings-desk.raw"));
  EXPECT_THAT(run_arguments(all[0]), ElementsAre("run", "recordings/desk.raw"));
  EXPECT_EQ(all[0].repeat, 1);
  EXPECT_EQ(all[0].warmup, 0);
}

TEST_F(SuitePlanTest, GroupsHaveSettingsAxesAndSequencesOfTheirOwn) {
  const auto all = plan(
      "[run]\nrepeat = 3\nwarmup = 1\n[matrix]\nbackend = ['serial', 'openmp']\n"
      "[[sequence]]\npath = '/data/x/'\nkinectfusion = {mu = 0.3, near = 0.5}\n"
      "[[sequence]]\npath = 'y'\nname = 'why'\n"
      "[[group]]\nname = 'plain'\npreset = 'slambench1'\nsequences = ['why']\n"
      "[[group]]\nname = 'coarse'\n[group.matrix]\nbackend = ['openmp']\nmu = [0.1, 0.2]\n"
      "[group.run]\nrepeat = 1\n[group.kinectfusion]\nnear = 0.6\n");
  EXPECT_THAT(folders(all),
              ElementsAre("x-coarse-mu-0.1", "x-coarse-mu-0.2", "why-plain-serial",
                          "why-plain-openmp", "why-coarse-mu-0.1", "why-coarse-mu-0.2"));
  EXPECT_EQ(all[0].repeat, 1);
  EXPECT_EQ(all[2].repeat, 3);
  EXPECT_EQ(all[0].warmup, 1);
  EXPECT_EQ(all[2].preset, "slambench1");
  EXPECT_EQ(all[0].preset, "");
  EXPECT_EQ(all[0].value("mu"), "0.1") << "the matrix beats the sequence";
  EXPECT_EQ(all[0].value("near"), "0.6") << "the group beats the sequence";
  EXPECT_EQ(all[2].value("near"), std::nullopt);
}

TEST_F(SuitePlanTest, TheCommandLineBeatsAllAndSelectsFromTheMatrix) {
  const auto all = plan(
      "sequence = 'a'\n[matrix]\nbackend = ['serial', 'openmp']\npreset = ['fast', 'slambench1']\n"
      "[run]\nframes = 9\nrepeat = 2\n",
      {"slambench1", {{"backend", "serial"}, {"frames", "5"}, {"repeat", "4"}}});
  ASSERT_THAT(folders(all), ElementsAre("a-serial-fast", "a-serial-slambench1", "a-openmp-fast",
                                        "a-openmp-slambench1"));
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].runs_today(), i == 1) << i;
  EXPECT_EQ(all[1].value("backend"), "serial");
  EXPECT_EQ(all[1].preset, "slambench1");
  for (const Configuration& each : all) {
    EXPECT_EQ(each.value("frames"), "5");
    EXPECT_EQ(each.repeat, 4);
  }
  EXPECT_THAT(runs_in_turns(all, [](const PlannedRun& run) { return run.repetition > 1; }),
              ElementsAre(PlannedRun{1, 1}));
}

TEST_F(SuitePlanTest, AGroupWhoseListLacksWhatIsSelectedIsLeftOut) {
  const char* text =
      "sequence = 'a'\n[[group]]\nname = 'published'\n"
      "matrix = {backend = ['serial', 'openmp'], volume-resolution = [64, 128]}\n"
      "[[group]]\nname = 'fast'\npreset = 'fast'\nmatrix.backend = ['openmp']\n";
  const SuiteSettings serial = {"", {{"backend", "serial"}, {"volume-resolution", "64"}}};
  std::vector<std::string> running;
  for (const Configuration& each : plan(text, serial)) {
    if (each.runs_today()) running.push_back(each.folder);
  }
  EXPECT_THAT(running, ElementsAre("a-published-serial-volume-resolution-64"));
  EXPECT_THAT(lists_without_selection(parse(text), serial, lists_),
              ElementsAre("group fast: backend: found serial, expected one of openmp"));
  EXPECT_THAT(lists_without_selection(parse(text), {"", {{"mu", "0.2"}}}, lists_), IsEmpty());
}

TEST_F(SuitePlanTest, WithoutGroupAndMatrixAVariantHasAName) {
  EXPECT_EQ(plan("sequence = 'a'\n")[0].variant, "all settings");
}

TEST_F(SuitePlanTest, FoldersDifferEvenWhereNamesDoNotAndAreNeverHidden) {
  EXPECT_THAT(folders(plan("sequence = ['a/b', 'a-b', './.c']\n")),
              ElementsAre("a-b", "a-b-2", "-c"));
}

TEST_F(SuitePlanTest, FoldersAreNoFilesOfTheSuiteAndNotTooLong) {
  const auto all = plan(fmt::format("sequence = ['suite.json', '{}', '{}']\n",
                                    std::string(300, 'a'), std::string(299, 'a')));
  for (const std::string& folder : folders(all)) EXPECT_TRUE(is_folder_name(folder)) << folder;
  EXPECT_EQ(all[0].folder, "suite.json-2");
  EXPECT_EQ(all[2].folder, all[1].folder + "-2");
  for (const char* name : {"", ".", "..", ".a", "../a", "a/b", "suite.json"}) {
    EXPECT_FALSE(is_folder_name(name)) << name;
  }
}

TEST_F(SuitePlanTest, APairToCompareComputesTheSame) {
  const auto pair = [&](std::string_view text) {
    const auto found = comparable_pair(plan(text), lists_);
    return found ? Words{found->first.folder, found->second.folder} : Words{};
  };
  EXPECT_THAT(pair("sequence = ['a', 'b']\n[matrix]\nbackend = ['serial', 'openmp']\n"
                   "volume-resolution = [64, 32]\n"),
              ElementsAre("a-serial-volume-resolution-64", "a-openmp-volume-resolution-64"));
  EXPECT_THAT(pair("sequence = ['a', 'b']\n[matrix]\nmu = [0.1, 0.2]\n"), IsEmpty());
  EXPECT_THAT(pair("sequence = 'a'\n"), IsEmpty());
  EXPECT_THAT(pair("sequence = 'a'\n[[group]]\nname = 'one'\npreset = 'fast'\n"
                   "[[group]]\nname = 'two'\npreset = 'slambench1'\n"
                   "[[group]]\nname = 'three'\npreset = 'slambench1'\nbackend = {threads = 1}\n"),
              ElementsAre("a-two", "a-three"))
      << "not always the first";
}

TEST_F(SuitePlanTest, AMatrixIsOfAReasonableSize) {
  std::string values = "1";
  for (int i = 2; i <= 101; ++i) values += fmt::format(", {}", i);
  EXPECT_THAT(
      error(fmt::format("sequence = 'a'\n[matrix]\ntracking-rate = [{0}]\n"
                        "integration-rate = [{0}]\n",
                        values)),
      HasSubstr("a.toml: matrix: found 10201 combinations or more, expected at most 10000"));
}

TEST_F(SuitePlanTest, RunsTakeTurns) {
  const auto all = plan(
      "sequence = 's'\n"
      "[[group]]\nname = 'a'\nrun = {repeat = 3, warmup = 1}\nkinectfusion = {mu = 0.1}\n"
      "[[group]]\nname = 'b'\nrun = {repeat = 1}\n"
      "[[group]]\nname = 'c'\nrun = {repeat = 2, warmup = 2}\nkinectfusion = {mu = 0.2}\n");
  const auto words = [&](const std::set<PlannedRun>& done) {
    std::string text;
    for (const PlannedRun& run :
         runs_in_turns(all, [&](const PlannedRun& r) { return done.contains(r); })) {
      text += fmt::format("{}{} ", all[run.configuration].folder.back(), run.repetition);
    }
    return text;
  };
  EXPECT_EQ(words({}), "a0 c0 c0 a1 b1 c1 a2 c2 a3 ");
  EXPECT_EQ(words({{0, 1}, {1, 1}, {2, 1}, {2, 2}, {0, 3}}), "a0 a2 ")
      << "what is done is not warmed up for";
  EXPECT_EQ(words({{0, 1}, {0, 2}, {0, 3}, {1, 1}, {2, 1}, {2, 2}}), "");
}

TEST_F(SuitePlanTest, ErrorsNameFileLineAndWhatWasExpected) {
  EXPECT_THAT(error("sequence = 'a'\n[matrix]\nbackend = ['serial', 'openmpi']\n"),
              ::testing::AllOf(HasSubstr("a.toml:3: backend: found 'openmpi', expected one of "),
                               HasSubstr("openmp")));
  EXPECT_EQ(error("sequence = 'a'\n[matrix]\nbackends = ['serial']\n"),
            "a.toml:3: unknown parameter 'backends' in [matrix]; did you mean 'backend'?");
  EXPECT_EQ(error("sequence = 'a'\n[matrix]\nmu = 0.1\n"),
            "a.toml:3: mu: found 0.1, expected a list with one value at least");
  EXPECT_EQ(error("sequence = 'a'\n[matrix]\nmu = []\n"),
            "a.toml:3: mu: found an empty one, expected a list with one value at least");
  EXPECT_EQ(error("sequence = 'a'\n[matrix]\nmu = [0.1,\n0.1]\n"),
            "a.toml:4: mu: 0.1 is there twice");
  EXPECT_EQ(error("sequence = 'a'\n[matrix]\nrepeat = [1, 2]\n"),
            "a.toml:3: repeat: cannot be varied; set it under [run]");
  EXPECT_THAT(error("sequence = 'a'\npreset = 'quick'\n"),
              HasSubstr("a.toml:2: preset: found 'quick', expected one of fast, slambench1"));
  EXPECT_THAT(error("sequence = 'a'\n[kinectfusion]\nmu = 'x'\n"),
              HasSubstr("a.toml:3: mu: found 'x', expected a number in"));
  EXPECT_EQ(error("sequence = 'a'\n[martix]\n"),
            "a.toml:2: unknown table 'martix'; did you mean 'matrix'?");
  EXPECT_EQ(error("sequence = 'a'\nrepeats = 2\n"), "a.toml:2: unknown key 'repeats'");
  EXPECT_THAT(error("sequence = [\n"), HasSubstr("not TOML"));
  EXPECT_EQ(
      error("title = 'x'\n"),
      "a.toml: sequence: found none, expected one at least: [[sequence]] with path = \"...\"");
  EXPECT_EQ(error("[[sequence]]\nname = 'a'\n"),
            "a.toml:1: sequence: found no path, expected path = \"...\"");
  EXPECT_EQ(error("sequence = [\n'a',\n'a']\n"),
            "a.toml:3: sequence: two are called 'a'; give one another name = \"...\"");
  EXPECT_EQ(error("sequence = 'a'\n[[group]]\n"),
            "a.toml:2: group: found no name, expected name = \"...\"");
  EXPECT_THAT(error("sequence = 'a'\n[[group]]\nname = 'g'\nsequences = ['aa']\n"),
              HasSubstr("group 'g': sequences: found 'aa', expected some of a"));
  EXPECT_THAT(error("sequence = 'a'\n[[group]]\nname = 'g'\n[[group]]\nname = 'h'\n"),
              HasSubstr("a-g and a-h are the same runs"));
}

TEST_F(SuitePlanTest, WhereResultsGoIsNotTheFilesToSay) {
  lists_.push_back({"output", {{"out", 0, "", &backend_.device, 0, 0, ""}}});
  EXPECT_EQ(error("sequence = 'a'\n[output]\nout = 'x'\n"),
            "a.toml:3: out: cannot be set in a suite, which decides it for each run");
  EXPECT_THAT(error("sequence = 'a'\n[matrix]\nout = ['x']\n"), HasSubstr("a.toml:3: out: cannot"));
}

TEST_F(SuitePlanTest, OptionalSequencesAreLeftOutWithAWord) {
  SuiteFile file = parse(
      "[[sequence]]\npath = '${DATA}/x'\noptional = true\n"
      "[[sequence]]\npath = '${NOTHING}/y'\noptional = true\n"
      "[[sequence]]\npath = '${NOTHING}/u'\noptional = true\n"
      "[[sequence]]\npath = '${DATA}/z'\noptional = true\n[[sequence]]\npath = 'w'\n");
  const auto environment = [](const std::string& name) {
    return name == "DATA" ? std::optional<std::string>("/data") : std::nullopt;
  };
  const auto is_there = [](const std::string& path) { return path == "/data/x"; };
  EXPECT_THAT(resolve_sequences(&file, environment, is_there),
              ElementsAre("sequence y: NOTHING is not set", "sequence u: NOTHING is not set",
                          "sequence z: /data/z is not there"));
  EXPECT_EQ(file.sequences[0].path, "/data/x");
  std::string available;
  for (const Configuration& each : configurations(file, {}, lists_)) {
    available += each.folder + (each.runs_today() ? " " : " not ");
  }
  EXPECT_EQ(available, "x y not u not z not w ");

  SuiteFile needed = parse("[[sequence]]\npath = '${NOTHING}/y'\n");
  EXPECT_EQ(
      testing::message_of<InputError>([&] { resolve_sequences(&needed, environment, is_there); }),
      "a.toml:1: path: found '${NOTHING}/y', expected the environment to have NOTHING");
}

TEST(RunTimesTest, ExpectsWhatTheNearestRunsTook) {
  Configuration a, b, c;
  a.folder = "1-slow", a.variant = "slow";
  b.folder = "2-slow", b.variant = "slow";
  c.folder = "2-fast", c.variant = "fast";
  RunTimes times;
  EXPECT_EQ(times.expected_s(a, 100), std::nullopt);
  times.add(a, {50, 100});
  EXPECT_EQ(times.expected_s(a, 200), 100);
  EXPECT_EQ(times.expected_s(b, 300), 150);
  EXPECT_EQ(times.expected_s(c, 10), 5);
  times.add(c, {1, 100});
  EXPECT_EQ(times.expected_s(c, 100), 1);
  EXPECT_EQ(times.expected_s(b, 100), 50);
  EXPECT_EQ(duration_text(12.2), "13 s");
  EXPECT_EQ(duration_text(100), "2 min");
  EXPECT_EQ(duration_text(3600 * 2.5), "2 h 30 min");
}

TEST(SuiteTableTest, HasARowAConfigurationIn80Columns) {
  std::vector<ConfigurationResult> results = {
      {"living-room/2", "serial", 3, 13.9, 0.0719, 0.00215, {}, ""},
      {"living-room/2",
       "a variant of very many words=1 and values=2",
       1,
       1234.5,
       0.0001,
       {},
       1.5,
       ""},
      {"x", "all settings", 0, {}, {}, {}, {}, ""}};
  const std::string table = suite_table(results, false);
  EXPECT_THAT(table, HasSubstr("  serial                             3      13.90      71.900     "
                               "2.15         -\n"));
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
}

}  // namespace
}  // namespace slambench
