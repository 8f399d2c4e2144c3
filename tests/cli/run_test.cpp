// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// `slambench run` as its user meets it: arguments in, files, text and status out.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/small_recording.h"
#include "io/png.h"
#include "support/program.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;
using Arguments = std::vector<std::string>;
using Json = nlohmann::json;

Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

class RunTest : public ::testing::Test {
 protected:
  void SetUp() override { write("small.raw", testing::small_raw(8)); }

  std::string write(const std::string& name, const std::string& contents) {
    return program_.folder().write(name, contents);
  }
  std::string path(const std::string& name) const { return program_.folder().path(name); }
  std::string file(const std::string& name) const { return testing::Program::contents(path(name)); }
  Json record(const std::string& folder) const {
    return Json::parse(file(folder + "/record.json"));
  }
  static Json parameter(const Json& record, const std::string& name) {
    for (const auto& group : record.at("parameters")) {
      if (group.contains(name)) return group.at(name);
    }
    ADD_FAILURE() << name << " is not in the record";
    return {};
  }

  static Arguments small(const Arguments& more = {}) { return testing::small_run() + more; }

  testing::Outcome run(const Arguments& arguments) { return program_.run(arguments); }

  /// One line that says it, the status, and no trace of a result.
  void expect_error(const Arguments& arguments, int status,
                    const ::testing::Matcher<std::string>& message) {
    const testing::Outcome outcome = run(arguments);
    SCOPED_TRACE(fmt::format("{}", fmt::join(arguments, " ")));
    EXPECT_EQ(outcome.status, status);
    EXPECT_THAT(outcome.err, AllOf(StartsWith("slambench: "), message));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_FALSE(fs::exists(path("out")));
    for (const auto& entry : fs::directory_iterator(program_.folder().path())) {
      EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr("partial")));
    }
  }

  testing::Program program_{SLAMBENCH_PROGRAM};
};

TEST_F(RunTest, WritesResultsAndASummaryOf80Columns) {
  const testing::Outcome outcome = run(small());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty()) << "no progress bar where no terminal is";
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("raycast"), HasSubstr("frames/s"), HasSubstr("out"),
                                 HasSubstr("note        no ground truth was found")));
  EXPECT_THAT(outcome.out, Not(HasSubstr("\033"))) << "no colours where no terminal is";
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  for (const char* name : {"record.json", "frames.csv", "trajectory.tum", "slambench1.log"}) {
    EXPECT_FALSE(file(std::string("out/") + name).empty()) << name;
  }
  EXPECT_GT(record("out").at("time").at("kernels").size(), 10U) << "each kernel is timed";
}

TEST_F(RunTest, TheSameCommandGivesTheSameTrajectory) {
  ASSERT_EQ(run(small()).status, 0);
  const std::string first = file("out/trajectory.tum");
  ASSERT_EQ(run(small({"--force"})).status, 0);
  EXPECT_EQ(file("out/trajectory.tum"), first);
}

TEST_F(RunTest, QuietPrintsNothingAndJsonTheRecordOnly) {
  const testing::Outcome quiet = run(small({"--quiet"}));
  EXPECT_EQ(quiet.status, 0);
  EXPECT_THAT(quiet.out + quiet.err, IsEmpty());

  const testing::Outcome json = run(small({"--json", "--force"}));
  EXPECT_EQ(json.status, 0);
  EXPECT_THAT(json.err, IsEmpty());
  EXPECT_EQ(Json::parse(json.out), record("out"));
}

TEST_F(RunTest, TheCommandLineBeatsTheFileAndTheFileThePreset) {
  write("a.toml",
        "sequence = \"small.raw\"\npreset = \"slambench1\"\n"
        "[run]\nframes = 5\n[kinectfusion]\nmu = 0.2\nambient = 0.3\nvolume-resolution = 16\n"
        "[source]\ncamera = [60, 60, 31.5, 23.5]\n");
  const testing::Outcome outcome =
      run({"run", "--config", "a.toml", "-m", "0.25", "-v", "32", "--out", "out"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json made = record("out");
  const auto expect = [&](const char* name, const char* value, const char* set_by) {
    EXPECT_EQ(parameter(made, name).at("set_by"), set_by) << name;
    EXPECT_EQ(parameter(made, name).at("value"), value) << name;
  };
  expect("preset", "slambench1", "file a.toml");
  expect("frames", "5", "file a.toml");
  expect("mu", "0.25", "command line");
  expect("ambient", "0.3", "file a.toml");
  expect("volume-resolution", "32,32,32", "command line");
  expect("map", "grid", "preset slambench1");
  expect("near", "0.4", "default");
}

TEST_F(RunTest, TakesTheSettingsThatASequenceBrings) {
  const auto run_here = [&](const Arguments& more) {
    return run(Arguments{"run", "own/small.raw", "-v", "32", "--out", "out", "--force"} + more);
  };
  const auto expect = [&](const char* name, const char* value, const char* set_by) {
    const Json made = record("out");
    EXPECT_EQ(parameter(made, name).at("set_by"), set_by) << name;
    EXPECT_EQ(parameter(made, name).at("value"), value) << name;
  };
  write("own/small.raw", testing::small_raw(8));
  write("own/slambench.toml",
        "preset = \"slambench1\"\n[source]\ncamera = [60, 60, 31.5, 23.5]\n"
        "[kinectfusion]\nvolume-size = 3\ninit-pose = [0.5, 0.5, 0.1]\nmap = \"grid\"\n"
        "[output]\nquiet = true\n[run]\nframes = 1\n");
  const testing::Outcome outcome = run_here({"-c", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("note        own/slambench.toml sets camera, volume-size"));
  expect("volume-size", "3,3,3", "sequence file own/slambench.toml");
  expect("camera", "60,60,31.5,23.5", "sequence file own/slambench.toml");
  expect("compute-size-ratio", "1", "command line");
  expect("preset", "fast", "default");
  expect("map", "auto", "preset fast");
  expect("frames", "0", "default");
  EXPECT_EQ(record("out").at("sequence").at("camera").at("fx"), 60);

  write("a.toml", "[kinectfusion]\nvolume-size = 3.5\n");
  ASSERT_EQ(run_here({"--config", "a.toml", "-p", "0.5,0.5,0.2"}).status, 0);
  expect("volume-size", "3.5,3.5,3.5", "file a.toml");
  expect("init-pose", "0.5,0.5,0.2", "command line");
  expect("compute-size-ratio", "2", "sequence");

  const testing::Outcome info = run({"info", "own/small.raw"});
  EXPECT_THAT(info.out, AllOf(HasSubstr("--volume-size=3,3,3"), HasSubstr("fx 60,"),
                              HasSubstr("settings      own/slambench.toml")));
  write("own/slambench.toml", "[kinectfusion]\nvolume-sise = 3\n");
  fs::remove_all(path("out"));
  expect_error({"run", "own/small.raw", "--out", "out"}, 3,
               HasSubstr("own/slambench.toml:2: unknown key 'volume-sise'"));
}

TEST_F(RunTest, HelpTellsTheDefaultsThatHold) {
  const std::string help = run({"run", "--help"}).out;
  std::string joined;  // without line breaks and indents
  std::istringstream words(help);
  for (std::string word; words >> word;) joined += word + " ";
  EXPECT_THAT(joined, HasSubstr("default 2,2,2 unless the sequence has its own"));
  EXPECT_THAT(joined, HasSubstr("default auto, by preset fast"));
  EXPECT_THAT(joined, HasSubstr("default true, by preset fast"));
  EXPECT_THAT(joined, HasSubstr("default 0.1)"));
  EXPECT_THAT(joined, Not(HasSubstr("default serial")));
  ASSERT_EQ(run(small()).status, 0);
  const Json made = record("out");
  EXPECT_THAT(joined,
              HasSubstr("default " + parameter(made, "backend").at("value").get<std::string>() +
                        ", by preset fast"));
}

TEST_F(RunTest, ThePublishedOptionsKeepTheirLetters) {
  const testing::Outcome outcome = run({"run",
                                        "-i",
                                        "small.raw",
                                        "-c",
                                        "2",
                                        "-d",
                                        "volume",
                                        "-f",
                                        "0",
                                        "-k",
                                        "60,60,31.5,23.5",
                                        "-l",
                                        "1e-4",
                                        "-m",
                                        "0.2",
                                        "-o",
                                        "log.txt",
                                        "-p",
                                        "0.5,0.5,0.1",
                                        "-q",
                                        "-r",
                                        "1",
                                        "-s",
                                        "3",
                                        "-t",
                                        "2",
                                        "-v",
                                        "32",
                                        "-y",
                                        "4,3",
                                        "-z",
                                        "2",
                                        "--out",
                                        "out"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(file("volume").size(), 32U * 32 * 32 * 2);
  EXPECT_EQ(file("log.txt"), file("out/slambench1.log"));
  const Json made = record("out");
  EXPECT_EQ(parameter(made, "compute-size-ratio").at("value"), "2");
  EXPECT_EQ(parameter(made, "pyramid-levels").at("value"), "4,3");
  EXPECT_EQ(parameter(made, "tracking-rate").at("value"), "2");
  EXPECT_EQ(parameter(made, "icp-threshold").at("value"), "0.0001");
}

TEST_F(RunTest, TheLastOfARepeatedOptionCounts) {
  ASSERT_EQ(run(small({"-m", "0.2", "--mu", "0.3", "--force", "--force=false"})).status, 0);
  EXPECT_EQ(parameter(record("out"), "mu").at("value"), "0.3");
  EXPECT_EQ(parameter(record("out"), "force").at("value"), "false");
}

TEST_F(RunTest, SavesPictures) {
  ASSERT_EQ(run(small({"--images", "4"})).status, 0);
  Image<Rgb8> picture;
  for (const char* name : {"depth", "track", "volume"}) {
    read_png(path(fmt::format("out/images/frame_000004_{}.png", name)), picture);
    EXPECT_EQ(picture.size(), testing::small_size) << name;
  }
  EXPECT_FALSE(fs::exists(path("out/images/frame_000005_depth.png")));
}

TEST_F(RunTest, SavesTheColourOfASequenceThatHasIt) {
  ASSERT_EQ(run({"run", "living-room/0", "--frames", "8", "--images", "4", "-c", "8", "-v", "32",
                 "--quiet", "--out", "colour"})
                .status,
            0);
  Image<Rgb8> picture;
  read_png(path("colour/images/frame_000004_color.png"), picture);
  EXPECT_EQ(picture.size(), (Size{80, 60}));
  EXPECT_FALSE(picture == Image<Rgb8>(Size{80, 60}, picture(0, 0))) << "of one colour";
  ASSERT_EQ(run(small({"--images", "4"})).status, 0);
  EXPECT_FALSE(fs::exists(path("out/images/frame_000004_color.png"))) << "has none";
}

TEST_F(RunTest, MakesANewFolderUnderResults) {
  Arguments arguments = small();
  arguments.resize(arguments.size() - 2);
  ASSERT_EQ(run(arguments).status, 0);
  ASSERT_EQ(run(arguments).status, 0) << "a second run finds another name";
  const fs::directory_iterator folders(path("results"));
  EXPECT_EQ(std::distance(fs::begin(folders), fs::end(folders)), 2);
}

TEST_F(RunTest, AnInterruptKeepsTheResultsSoFar) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const pid_t child = program_.start(small({"--real-time", "-f", "1"}));
    // The partial folder is there once signals are caught.
    while (!fs::exists(path(".out.slambench-partial")) && ::kill(child, 0) == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    ::kill(child, signal);
    const testing::Outcome outcome = program_.wait(child);
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("the results so far are in out"));
    const Json made = record("out");
    EXPECT_EQ(made.at("complete"), false);
    fs::remove_all(path("out"));
  }
}

TEST_F(RunTest, AnIgnoredSignalStaysIgnored) {
  const auto before = std::signal(SIGHUP, SIG_IGN);  // as nohup leaves it
  const pid_t child = program_.start(small({"--real-time", "-f", "8"}));
  std::signal(SIGHUP, before);
  while (!fs::exists(path(".out.slambench-partial")) && ::kill(child, 0) == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  ::kill(child, SIGHUP);
  const testing::Outcome outcome = program_.wait(child);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(record("out").at("complete"), true);
}

TEST_F(RunTest, RefusedThreadsAreUnavailable) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer needs the address space that this test takes away";
#endif
  // Of stacks this large an address space holds two.
  program_.set_limit(RLIMIT_STACK, rlim_t{50} << 40);
  expect_error(
      small({"--backend", "openmp", "--threads", "8"}), 4,
      AllOf(HasSubstr("threads: the system grants "), HasSubstr(" of 8"), HasSubstr("--threads")));
  expect_error(small({"--backend", "openmp", "--threads", "1", "--prefetch", "on"}), 4,
               HasSubstr("--prefetch on: the system grants no thread"));
  EXPECT_EQ(run(small({"--backend", "openmp", "--threads", "1"})).status, 0);
}

TEST_F(RunTest, FilesAmongTheResultsAreRefused) {
  expect_error(small({"-d", "out/volume"}), 2,
               HasSubstr("--dump-volume: out/volume lies in the results folder out"));
  expect_error(small({"-o", "out/record.json"}), 2,
               HasSubstr("--log-file: out/record.json lies in the results folder out"));
  expect_error(small({"-o", path("out/../out/log")}), 2, HasSubstr("lies in the results folder"));
  expect_error(small({"-o", "same", "-d", "same"}), 2, HasSubstr("both are same"));
  ASSERT_EQ(run(small({"-o", "outside"})).status, 0);
  EXPECT_EQ(run(small({"--force", "-o", "out/log"})).status, 2);
  EXPECT_FALSE(fs::exists(path("out/log")));
}

TEST_F(RunTest, APipeThatNobodyWritesToIsBadInput) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  for (const char* option : {"--config", "--ground-truth"}) {
    expect_error(small({option, "pipe"}), 3, HasSubstr("pipe: cannot read: it is a pipe"));
  }
  write("tum/depth.txt", "0.0 depth/0.png\n");
  fs::create_directory(path("tum/depth"));
  ASSERT_EQ(::mkfifo(path("tum/depth/0.png").c_str(), 0600), 0);
  expect_error({"run", "tum", "--out", "out"}, 3, HasSubstr("0.png: cannot read: it is a pipe"));
}

TEST_F(RunTest, LeavesTheGroundTruthThatItWasJudgedBy) {
  const std::string truth = "# time tx ty tz qx qy qz qw\n1 0.5 0 0 0 0 0 1\n2 0.5 0 0 0 0 0 1\n";
  write("truth.txt", truth);
  ASSERT_EQ(run(small({"--ground-truth", "truth.txt"})).status, 0);
  EXPECT_EQ(file("out/groundtruth.tum"), truth);
  EXPECT_EQ(record("out").at("sequence").at("ground_truth_hash").get<std::string>().size(), 32U);
  ASSERT_EQ(run(small({"--force"})).status, 0);
  EXPECT_FALSE(fs::exists(path("out/groundtruth.tum")));
}

TEST_F(RunTest, SaysWhatTheMachineWasLike) {
  ASSERT_EQ(run(small({"--backend", "openmp"})).status, 0);
  const Json provenance = record("out").at("provenance");
  EXPECT_GE(provenance.at("load_average_start").get<double>(), 0);
  EXPECT_GE(provenance.at("load_average_end").get<double>(), 0);
  EXPECT_FALSE(provenance.at("instruction_set").get<std::string>().empty());
}

TEST_F(RunTest, WrongWordsAreUsageErrors) {
  expect_error(small({"--bakend", "serial"}), 2,
               HasSubstr("unknown option '--bakend'; did you mean '--backend'?"));
  expect_error(small({"--backend", "sirial"}), 2,
               HasSubstr("--backend: found 'sirial', expected one of "));
  expect_error(small({"--backend", "serial", "--device", "7"}), 2,
               HasSubstr("--device: found '7', expected one of backend serial's devices (0: "));
  expect_error(small({"--preset", "slambench2"}), 2,
               HasSubstr("expected one of fast, slambench1; did you mean 'slambench1'?"));
  expect_error(small({"--map", "octree"}), 2, HasSubstr("--map: found 'octree'"));
  expect_error(small({"-m", "0"}), 2, HasSubstr("--mu: found '0', expected a number in ["));
  expect_error(small({"-m", "nan"}), 2, HasSubstr("--mu: found 'nan', expected a number in ["));
  expect_error(small({"-m", "0,1"}), 2, HasSubstr("--mu: found '0,1', expected a number in ["));
  expect_error(small({"-v", "1e2"}), 2, HasSubstr("--volume-resolution: found '1e2', expected"));
  expect_error(small({"-c", "3"}), 2, HasSubstr("--compute-size-ratio: found 3"));
  expect_error(small({"-m"}), 2, HasSubstr("mu"));
  expect_error(small({"other.raw"}), 2, HasSubstr("unexpected argument 'other.raw'"));
  expect_error(small({"-i", "small.raw"}), 2, HasSubstr("already given"));
  expect_error({"rnu"}, 2, HasSubstr("unknown command 'rnu'; did you mean 'run'?"));
  expect_error({}, 2, HasSubstr("no command"));
}

TEST_F(RunTest, WrongConfigurationFilesAreBadInput) {
  expect_error(small({"--config", "none.toml"}), 3, HasSubstr("none.toml"));
  write("key.toml", "[kinectfusion]\nvolume-sise = 2\n");
  expect_error(small({"--config", "key.toml"}), 3,
               HasSubstr("key.toml:2: unknown key 'volume-sise' in [kinectfusion]; did you mean "
                         "'volume-size'?"));
  write("garbage.toml", std::string("\x00\x7f\xff[", 4));
  expect_error(small({"--config", "garbage.toml"}), 3, HasSubstr("garbage.toml:1: not TOML"));
}

TEST_F(RunTest, WrongSequencesAreBadInput) {
  const auto with = [](const std::string& sequence, const Arguments& more = {}) {
    return Arguments{"run", sequence, "--out", "out", "-v", "32"} + more;
  };
  expect_error(with("nowhere"), 3, HasSubstr("nowhere: No such file or directory"));
  fs::create_directory(path("empty"));
  expect_error(with("empty"), 3, HasSubstr("an empty folder"));
  write("other/notes.txt", "nothing to see");
  expect_error(with("other"), 3, AllOf(HasSubstr("other: layout: found"), HasSubstr("tum-rgbd")));

  const std::string raw = testing::small_raw(2);
  write("cut.raw", raw.substr(0, raw.size() - 1));
  expect_error(with("cut.raw"), 3, HasSubstr("cut.raw"));
  write("empty.raw", "");
  expect_error(with("empty.raw"), 3, HasSubstr("empty.raw"));

  const auto tum = [&](const std::string& name, const std::string& second_image) {
    write(name + "/depth.txt", "0.0 depth/0.png\n0.1 depth/1.png\n");
    write(name + "/groundtruth.txt", "0.0 0 0 0 0 0 0 1\n0.1 0 0 0 0 0 0 1\n");
    write(name + "/depth/0.png", png_bytes(testing::small_depth()));
    write(name + "/depth/1.png", second_image);
  };
  tum("eight_bits", png_bytes(Image<Rgb8>(testing::small_size)));
  expect_error(with("eight_bits"), 3, HasSubstr("eight_bits/depth/1.png"));
  tum("other_size", png_bytes(Image<std::uint16_t>({32, 24})));
  expect_error(with("other_size"), 3,
               AllOf(HasSubstr("other_size/depth/1.png"), HasSubstr("32x24"), HasSubstr("64x48")));
  tum("truncated", png_bytes(testing::small_depth()).substr(0, 60));
  expect_error(with("truncated"), 3, HasSubstr("truncated/depth/1.png"));
}

TEST_F(RunTest, WrongGroundTruthIsBadInput) {
  expect_error(small({"--ground-truth", "none.txt"}), 3, HasSubstr("none.txt"));
  write("nan.txt", "0 0 0 0 0 0 0 1\n1 nan 0 0 0 0 0 1\n");
  expect_error(small({"--ground-truth", "nan.txt"}), 3, HasSubstr("nan.txt:2"));
  write("garbage.txt", "0 0 0 zero 0 0 0 1\n");
  expect_error(small({"--ground-truth", "garbage.txt"}), 3, HasSubstr("garbage.txt:1"));
  write("later.txt", "1000 0 0 0 0 0 0 1\n1001 0 0 0 0 0 0 1\n");
  expect_error(small({"--ground-truth", "later.txt"}), 3, HasSubstr("later.txt"));
}

/// Also where there is a device, but none that this process may see.
TEST_F(RunTest, NamesWhatIsMissingForCuda) {
  program_.set_environment("CUDA_VISIBLE_DEVICES", "");
  expect_error(small({"--backend", "cuda"}), 4, HasSubstr("backend cuda: unavailable: "));
}

TEST_F(RunTest, TooBigAVolumeIsUnavailable) {
  expect_error(small({"-v", "4096", "--map", "grid"}), 4,
               HasSubstr("volume of 4096x4096x4096 voxels: "));
}

TEST_F(RunTest, UnwritableOutputIsAnError) {
  Arguments arguments = small();
  arguments.back() = "small.raw/out";
  expect_error(arguments, 1, HasSubstr("small.raw: cannot write: Not a directory"));
  arguments.back() = "small.raw";
  expect_error(arguments, 2, HasSubstr("small.raw"));
  expect_error(small({"-o", "nowhere/log"}), 1, HasSubstr("--log-file: nowhere/log"));
  expect_error(small({"-d", "small.raw/volume"}), 1, HasSubstr("--dump-volume: small.raw/volume"));
}

TEST_F(RunTest, AnUnwritableCacheIsSaidAndDoesNotStopARun) {
  program_.set_environment("XDG_CACHE_HOME", "/dev/null");
  const testing::Outcome outcome =
      run({"run", "living-room/0", "--frames", "8", "-c", "4", "-v", "64", "--out", "out"});
  if (outcome.status == 4) GTEST_SKIP() << outcome.err;
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("/dev/null/slambench/living-room: Not a directory"));
}

TEST_F(RunTest, TheRenderedRoomTracksTheSameFromTheCache) {
  const Arguments arguments = {"run", "living-room/0", "--frames", "8",       "-c",     "4", "-v",
                               "64",  "--out",         "out",      "--force", "--quiet"};
  const testing::Outcome outcome = run(arguments);
  if (outcome.status == 4) GTEST_SKIP() << outcome.err;
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string rendered = file("out/trajectory.tum");
  ASSERT_TRUE(fs::exists(path("cache/slambench/living-room")));
  ASSERT_EQ(run(arguments).status, 0);
  EXPECT_EQ(file("out/trajectory.tum"), rendered);
}

TEST_F(RunTest, ResultsAreNotReplacedUnlessForced) {
  ASSERT_EQ(run(small()).status, 0);
  const std::string before = file("out/record.json");
  const testing::Outcome again = run(small());
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, AllOf(HasSubstr("out"), HasSubstr("--force")));
  EXPECT_EQ(file("out/record.json"), before);
  EXPECT_EQ(run(small({"--force"})).status, 0);
  EXPECT_NE(file("out/record.json"), before);
}

TEST_F(RunTest, AnOutputThatTakesNothingIsAnError) {
  for (const char* output : {"/dev/full", ""}) {
    program_.set_output(output);
    const testing::Outcome outcome = program_.run(small({"--force"}));
    EXPECT_EQ(outcome.status, 1) << output;
    EXPECT_THAT(outcome.err, StartsWith("slambench: standard output: "));
    EXPECT_THAT(file("out/record.json"), StartsWith("{")) << "the results are there all the same";
  }
}

}  // namespace
}  // namespace slambench
