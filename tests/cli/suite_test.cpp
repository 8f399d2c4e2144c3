// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// `slambench suite` as its user meets it, interrupted and killed too.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/file.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "cli/small_recording.h"
#include "scene/renderer.h"
#include "support/program.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using Arguments = std::vector<std::string>;
using Json = nlohmann::json;

constexpr const char* small_settings =
    "[source]\ncamera = [60, 60, 31.5, 23.5]\n"
    "[kinectfusion]\nvolume-resolution = 32\nvolume-size = 3\ninit-pose = [0.5, 0.5, 0.1]\n"
    "pyramid-levels = [4, 3]\ncompute-size-ratio = 1\n";

class SuiteTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write("small.raw", testing::small_raw(8));
    suite("sequence = 'small.raw'\n[matrix]\nbackend = ['serial', 'openmp']\n[run]\nrepeat = 2\n");
  }

  void write(const std::string& name, const std::string& contents) {
    program_.folder().write(name, contents);
  }
  void suite(const std::string& text) { write("a.toml", text + small_settings); }
  std::string path(const std::string& name) const { return program_.folder().path(name); }
  std::string file(const std::string& name) const { return testing::Program::contents(path(name)); }

  testing::Outcome run(const Arguments& more = {}) {
    Arguments arguments = {"suite", "a.toml", "--out", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return program_.run(arguments);
  }

  /// The records of all visible results, by the folder's place in `out`.
  std::map<std::string, std::string> records(const std::string& out = "out") const {
    std::map<std::string, std::string> found;
    if (!fs::exists(path(out))) return found;
    for (auto it = fs::recursive_directory_iterator(path(out)); it != fs::end(it); ++it) {
      if (it->path().filename().string().starts_with('.')) it.disable_recursion_pending();
      if (it->path().filename() != "record.json") continue;
      const fs::path folder = it->path().parent_path();
      found[folder.lexically_relative(path(out))] = testing::Program::contents(it->path());
    }
    return found;
  }
  std::vector<std::string> folders(const std::string& out = "out") const {
    std::vector<std::string> names;
    for (const auto& [name, record] : records(out)) names.push_back(name);
    return names;
  }
  /// Everything in `out` that starts with a dot.
  std::vector<std::string> hidden() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(path("out"))) {
      const std::string name = entry.path().filename();
      if (name.starts_with('.')) names.push_back(name);
    }
    return names;
  }

  testing::Program program_{SLAMBENCH_PROGRAM};
};

const std::vector<std::string> all_four = {"small.raw-openmp/1", "small.raw-openmp/2",
                                           "small.raw-serial/1", "small.raw-serial/2"};

TEST_F(SuiteTest, RunsTheMatrixInTurnsIntoFoldersThatOtherCommandsRead) {
  const testing::Outcome outcome = run();
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("[1/4] small.raw-serial/1"), HasSubstr("frames/s"),
                                 HasSubstr("[4/4] small.raw-openmp/2"), HasSubstr("left\n"),
                                 HasSubstr("slambench report out -o report.html")));
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  EXPECT_EQ(folders(), all_four);
  EXPECT_THAT(hidden(), IsEmpty());

  const Json record = Json::parse(file("out/small.raw-openmp/2/record.json"));
  EXPECT_THAT(record.at("provenance").at("command").get<std::string>(),
              HasSubstr("slambench run small.raw --camera=60,60,31.5,23.5 --backend=openmp"));
  EXPECT_EQ(record.at("parameters").at("backend").at("backend").at("set_by"), "command line");

  const auto compared = program_.run({"compare", "out/small.raw-serial", "out/small.raw-openmp"});
  EXPECT_EQ(compared.status, 0) << compared.err;
  EXPECT_EQ(program_.run({"report", "out", "-o", "r.html"}).status, 0);
}

TEST_F(SuiteTest, TheSameCommandGoesOnWhereItStopped) {
  ASSERT_EQ(run().status, 0);
  const auto first = records();
  fs::remove_all(path("out/small.raw-serial/2"));
  write("out/small.raw-serial/.2.slambench-partial/frames.csv", "half");
  write("out/small.raw-openmp/1/record.json",
        std::string(first.at("small.raw-openmp/1")).substr(0, 100));
  const testing::Outcome outcome = run();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("2 runs to do, 2 done before"));
  const auto second = records();
  EXPECT_EQ(folders(), all_four);
  EXPECT_EQ(second.at("small.raw-serial/1"), first.at("small.raw-serial/1"));
  EXPECT_EQ(second.at("small.raw-openmp/2"), first.at("small.raw-openmp/2"));
  EXPECT_THAT(hidden(), IsEmpty());
}

TEST_F(SuiteTest, NewCombinationsAreAddedAndOldOnesNeverMixedIn) {
  ASSERT_EQ(run().status, 0);
  const auto first = records();
  suite("sequence = 'small.raw'\n[matrix]\nbackend = ['serial', 'openmp']\nmu = [0.1, 0.2]\n");
  const testing::Outcome refused = run();
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("out/small.raw-openmp/1 is of other settings: mu not "
                                           "set, expected 0.1"),
                                 HasSubstr("--set-aside")));
  EXPECT_EQ(records(), first);

  suite(
      "sequence = 'small.raw'\n[[group]]\nname = 'a'\nmatrix = {backend = ['serial', 'openmp']}\n"
      "[[group]]\nname = 'b'\nbackend = {backend = 'openmp'}\nkinectfusion = {mu = 0.2}\n");
  const testing::Outcome added = run();
  EXPECT_EQ(added.status, 0) << added.err;
  EXPECT_THAT(added.out, HasSubstr("1 runs to do, 4 done before"));
  EXPECT_THAT(folders(), AllOf(SizeIs(5), Contains("small.raw-b/1"))) << "old folders keep names";

  suite("sequence = 'small.raw'\n[matrix]\nbackend = ['serial']\n");
  EXPECT_EQ(run().status, 2);
  EXPECT_EQ(run({"--set-aside"}).status, 0);
  EXPECT_THAT(folders(), ElementsAre("small.raw-serial/1", "small.raw-serial/2"));
  EXPECT_EQ(file("out/.set-aside/small.raw-b-1/record.json").empty(), false);
}

TEST_F(SuiteTest, ResultsOfAnotherBuildOrOfOtherSettingsAreRefused) {
  ASSERT_EQ(run().status, 0);
  Json record = Json::parse(file("out/small.raw-serial/1/record.json"));
  record["provenance"]["commit"] = "0123456789ab";
  write("out/small.raw-serial/1/record.json", record.dump());
  EXPECT_THAT(run().err, HasSubstr("commit is '0123456789ab', here '"));
  fs::remove_all(path("out/small.raw-serial/1"));
  fs::rename(path("out/small.raw-openmp/2"), path("out/small.raw-serial/1"));
  const testing::Outcome mixed = run();
  EXPECT_EQ(mixed.status, 2);
  EXPECT_THAT(mixed.err, HasSubstr("of other settings: backend openmp, expected serial"));
}

TEST_F(SuiteTest, ResultsOfWhatIsLeftOutTodayStayTheSuites) {
  write("there.raw", testing::small_raw(8));
  suite(
      "[[sequence]]\npath = 'small.raw'\n[[sequence]]\npath = 'there.raw'\noptional = true\n"
      "[matrix]\nbackend = ['serial', 'openmp']\n");
  ASSERT_EQ(run().status, 0);
  const auto first = records();
  ASSERT_EQ(first.size(), 4U);
  fs::rename(path("there.raw"), path("away.raw"));
  fs::remove_all(path("out/small.raw-serial"));
  const testing::Outcome outcome = run({"--backend", "serial"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("1 configurations, 1 runs to do, 3 done before"),
                                 HasSubstr("sequence there.raw: there.raw is not there")));
  EXPECT_EQ(records().size(), 4U);
  fs::rename(path("away.raw"), path("there.raw"));
  EXPECT_THAT(run().out, HasSubstr("4 configurations, 0 runs to do, 4 done before"));
  EXPECT_EQ(records().at("there.raw-openmp/1"), first.at("there.raw-openmp/1"));
}

TEST_F(SuiteTest, ResultsOfOtherParametersOnTheCommandLineNameThem) {
  ASSERT_EQ(run({"--frames", "7", "--repeat", "1"}).status, 0);
  EXPECT_THAT(run({"--frames", "6"}).err,
              HasSubstr("out/small.raw-openmp/1 is of other settings: frames 7, expected 6"));
}

TEST_F(SuiteTest, AFailedRunIsToldAndTriedAgainAndTheOthersGoOn) {
  write("broken.raw", testing::small_raw(2).substr(0, 7000));
  suite("sequence = ['broken.raw', 'small.raw']\n[backend]\nbackend = 'serial'\n");
  EXPECT_EQ(run().status, 3) << "an unreadable sequence is told before anything runs";
  suite(
      "sequence = ['small.raw']\n[backend]\nbackend = 'serial'\n"
      "[[group]]\nname = 'bad'\nbackend = {device = 'none'}\n[[group]]\nname = 'good'\n");
  for (int attempt = 0; attempt < 2; ++attempt) {
    const testing::Outcome outcome = run();
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.out, HasSubstr("small.raw-bad/1                        failed: status 2: "
                                       "--device: found 'none'"));
    EXPECT_THAT(
        outcome.err,
        HasSubstr(attempt == 0 ? "1 of 2 runs failed: small.raw-bad/1 (status 2: --device"
                               : "1 of 1 runs failed: small.raw-bad/1 (status 2: --device"));
    EXPECT_THAT(folders(), ElementsAre("small.raw-good/1"));
    EXPECT_THAT(hidden(), IsEmpty());
  }
}

TEST_F(SuiteTest, ARunThatDoesNotCountSaysWhereItIs) {
  suite("sequence = 'small.raw'\n[backend]\nbackend = 'serial'\n");
  const testing::Outcome outcome = run({"--frames", "3"});
  EXPECT_EQ(outcome.status, 1);
  const std::string place = "see out/.failed/small.raw-1";
  EXPECT_THAT(outcome.err, HasSubstr(place));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr(place), Not(HasSubstr("report "))))
      << "there are no results to make one of";
  EXPECT_TRUE(fs::exists(path("out/.failed/small.raw-1/record.json")));
}

TEST_F(SuiteTest, TheComparisonThatIsSuggestedIsNotRefused) {
  suite(
      "sequence = 'small.raw'\n[matrix]\nbackend = ['serial', 'openmp']\n"
      "max-weight = [100, 50]\n");
  const testing::Outcome outcome = run();
  EXPECT_THAT(outcome.out, HasSubstr("slambench compare out/small.raw-serial-max-weight-100\n"
                                     "            out/small.raw-openmp-max-weight-100\n"));
  EXPECT_EQ(program_
                .run({"compare", "out/small.raw-serial-max-weight-100",
                      "out/small.raw-openmp-max-weight-100"})
                .status,
            0);
}

TEST_F(SuiteTest, QuietSaysWhyRunsFail) {
  suite("sequence = 'small.raw'\n[matrix]\nbackend = ['serial']\nmap = ['grid']\n");
  fs::create_directories(path("out"));
  write("out/suite.json", R"({"format": "slambench-suite", "version": 1, "title": "",
                             "configurations": []})");
  write("out/small.raw", "a file of the user's");
  const testing::Outcome outcome = run({"--quiet"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("1 of 1 runs failed: small.raw/1 (status 1: "),
                                 HasSubstr("small.raw")));
  EXPECT_EQ(file("out/small.raw"), "a file of the user's");
}

TEST_F(SuiteTest, ASequenceMayHaveTheNameOfALeftover) {
  suite("[[sequence]]\npath = 'small.raw'\nname = 'a.slambench-partial'\n");
  ASSERT_EQ(run().status, 0);
  EXPECT_EQ(run().status, 0);
  EXPECT_EQ(folders(), Arguments{"a.slambench-partial/1"});
}

TEST_F(SuiteTest, FoldersOfSuiteJsonDoNotLeadElsewhere) {
  ASSERT_EQ(run().status, 0);
  const std::string written = file("out/suite.json");
  for (const char* folder : {"../escaped", "small.raw-openmp"}) {
    std::string text = written;
    const std::string from = "\"folder\": \"small.raw-serial\"";
    text.replace(text.find(from), from.size(), fmt::format("\"folder\": \"{}\"", folder));
    write("out/suite.json", text);
    const testing::Outcome outcome = run();
    EXPECT_EQ(outcome.status, 3) << folder;
    EXPECT_THAT(outcome.err, HasSubstr(fmt::format("suite.json: folder: found '{}'", folder)));
  }
  EXPECT_EQ(folders(), all_four);
}

TEST_F(SuiteTest, RunsOfAnOlderInputAreRefusedAndCanBePutAside) {
  ASSERT_EQ(run().status, 0);
  std::string other = testing::small_raw(8);
  other.back() ^= 1;  // a pixel of the last frame
  write("small.raw", other);
  fs::remove_all(path("out/small.raw-serial/2"));
  EXPECT_EQ(run().status, 1) << "its runs are no repeats now";
  const testing::Outcome again = run();
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, AllOf(HasSubstr("out/small.raw-serial/1 has another input than "
                                         "out/small.raw-serial/2"),
                               HasSubstr("out/small.raw-openmp/1 has another input"),
                               HasSubstr("--set-aside")));
  EXPECT_EQ(run({"--set-aside"}).status, 0);
  EXPECT_EQ(folders(), all_four);
}

TEST_F(SuiteTest, AFinishedSuiteNeedsItsSequencesNoMore) {
  ASSERT_EQ(run().status, 0);
  fs::rename(path("small.raw"), path("elsewhere.raw"));
  const testing::Outcome outcome = run();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("0 runs to do, 4 done"));
}

TEST_F(SuiteTest, DryRunPrintsCommandsAndChangesNothing) {
  const testing::Outcome listed = run({"--dry-run", "--repeat", "1"});
  EXPECT_EQ(listed.status, 0) << listed.err;
  EXPECT_FALSE(fs::exists(path("out")));
  EXPECT_THAT(listed.out, AllOf(HasSubstr("run small.raw --camera=60,60,31.5,23.5"),
                                HasSubstr(" --out=out/small.raw-openmp/1\n")));
  EXPECT_EQ(std::count(listed.out.begin(), listed.out.end(), '\n'), 3) << listed.out;
  ASSERT_EQ(run({"--repeat", "1", "--quiet"}).status, 0);
  EXPECT_THAT(run({"--dry-run"}).out, AllOf(HasSubstr("2 runs to do, 2 done"),
                                            Not(HasSubstr("serial/1")), HasSubstr("serial/2")));
}

TEST_F(SuiteTest, WhatIsNotHereIsLeftOutUnlessAllIsRequired) {
  suite(
      "[[sequence]]\npath = 'small.raw'\n[[sequence]]\npath = '${SLAMBENCH_NOT_SET}/x'\n"
      "optional = true\n[backend]\nbackend = 'serial'\n[run]\nwarmup = 1\n");
  const testing::Outcome outcome = run();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("left out    sequence x: SLAMBENCH_NOT_SET is not set"),
                                 HasSubstr("[1/2] small.raw, warming up")));
  EXPECT_THAT(folders(), ElementsAre("small.raw/1"));
  EXPECT_THAT(hidden(), IsEmpty());
  const testing::Outcome insisted = run({"--require-all"});
  EXPECT_EQ(insisted.status, 4);
  EXPECT_THAT(insisted.err, HasSubstr("SLAMBENCH_NOT_SET is not set"));
}

TEST_F(SuiteTest, WrongArgumentsHaveTheirStatus) {
  EXPECT_EQ(program_.run({"suite"}).status, 2);
  EXPECT_EQ(program_.run({"suite", "nowhere.toml"}).status, 3);
  EXPECT_EQ(run({"--mu", "x"}).status, 2);
  EXPECT_EQ(run({"--preset", "x"}).status, 2);
  EXPECT_THAT(run({"--backend", "cuda"}).err,
              HasSubstr("leaves nothing to run: matrix: backend: found cuda, expected one of "
                        "serial, openmp"));
  suite("sequence = 'nowhere'\n");
  EXPECT_EQ(run().status, 3);
  suite("sequence = 'small.raw'\n[matrix]\nbackend = ['serail']\n");
  EXPECT_EQ(run().status, 3);
  write("taken/notes.txt", "mine");
  suite("sequence = 'small.raw'\n");
  const testing::Outcome taken = program_.run({"suite", "a.toml", "--out", "taken"});
  EXPECT_EQ(taken.status, 2);
  EXPECT_THAT(taken.err, HasSubstr("taken: holds files but no suite"));
}

TEST_F(SuiteTest, ThePapersExperimentIsOne) {
  if (!can_render()) GTEST_SKIP() << "this build cannot render the living room";
  const testing::Outcome outcome =
      program_.run({"suite", SLAMBENCH_SOURCE_DIR "/configs/paper.toml", "--dry-run"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("living-room-0-published-serial/1"),
                                 HasSubstr("living-room-2-fast-openmp/5"),
                                 Not(HasSubstr("living-room-3-published-serial/2"))));
}

TEST_F(SuiteTest, TwoInOneFolderAreRefused) {
  fs::create_directory(path("out"));
  const int folder = ::open(path("out").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(::flock(folder, LOCK_EX), 0);
  const testing::Outcome outcome = run();
  ::close(folder);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("out: another suite is working in this folder"));
}

/// Waits for a file of a run in progress, so that a signal meets one.
bool wait_for_a_run(const std::string& folder) {
  for (int i = 0; i < 1000; ++i) {
    std::error_code error;
    for (auto it = fs::recursive_directory_iterator(folder, error); !error && it != fs::end(it);
         it.increment(error)) {
      if (it->path().filename().string().ends_with(".slambench-partial")) return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

TEST_F(SuiteTest, AnInterruptedSuiteEndsCleanlyAndGoesOn) {
  write("long.raw", testing::small_raw(400));
  suite("sequence = ['small.raw', 'long.raw']\n[matrix]\nbackend = ['serial']\n");
  const pid_t child = program_.start({"suite", "a.toml", "--out", "out"});
  ASSERT_TRUE(wait_for_a_run(path("out/long.raw")));
  ::kill(child, SIGINT);
  const testing::Outcome outcome = program_.wait(child);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("interrupted; 1 runs are done; the same command goes on"));
  EXPECT_THAT(folders(), ElementsAre("small.raw/1"));
  EXPECT_THAT(hidden(), IsEmpty());
  EXPECT_EQ(run().status, 0);
  EXPECT_THAT(folders(), ElementsAre("long.raw/1", "small.raw/1"));
}

TEST_F(SuiteTest, KilledAtAnyMomentItLosesRepeatsAndHalvesNothing) {
  constexpr int kills = 20;
  suite(
      "sequence = 'small.raw'\n[matrix]\nbackend = ['serial', 'openmp']\nmu = [0.1, 0.2]\n"
      "[run]\nrepeat = 3\n");
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(program_.run({"suite", "a.toml", "--out", "whole"}).status, 0);
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin;
  const auto expected = folders("whole");
  ASSERT_EQ(expected.size(), 12U);

  const auto seed = std::random_device()();
  SCOPED_TRACE(fmt::format("seed {}", seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> moment_s(0, 0.6 * whole.count());
  std::map<std::string, std::string> finished;
  int killed = 0, completed = 0;
  while (killed < kills) {
    const pid_t child = program_.start({"suite", "a.toml", "--out", "out", "--quiet"});
    std::this_thread::sleep_for(std::chrono::duration<double>(moment_s(random)));
    ::kill(child, SIGKILL);
    const int status = program_.wait(child).status;
    EXPECT_THAT(status, ::testing::AnyOf(0, 128 + SIGKILL)) << file("stderr");
    const auto now = records();
    for (const auto& [name, record] : now) {
      const Json json = Json::parse(record, nullptr, false);
      ASSERT_TRUE(json.is_object()) << name << " is half";
      EXPECT_TRUE(json.at("complete").get<bool>() && json.at("valid").get<bool>()) << name;
    }
    for (const auto& [name, record] : finished) {
      ASSERT_TRUE(now.contains(name)) << name << " was lost";
      EXPECT_EQ(now.at(name), record) << name << " was repeated";
    }
    finished = now;
    if (status != 0) {
      ++killed;
      continue;
    }
    EXPECT_EQ(folders(), expected);
    fs::remove_all(path("out"));
    finished.clear();
    ASSERT_LT(++completed, 10 * kills);
  }
  std::cout << fmt::format("seed {}: {} kills, completed {} times\n", seed, killed, completed);
  const testing::Outcome last = run();
  EXPECT_EQ(last.status, 0) << last.err;
  EXPECT_EQ(folders(), expected);
  EXPECT_THAT(hidden(), IsEmpty());
  const auto now = records();
  for (const auto& [name, record] : finished) EXPECT_EQ(now.at(name), record) << name;
}

}  // namespace
}  // namespace slambench
