// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/result_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <set>

#include "core/error.h"
#include "io/files.h"
#include "io/png.h"
#include "io/trajectory_file.h"
#include "results/writers.h"
#include "sample_record.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::message_of;
using testing::sample_record;
using testing::TemporaryFolder;

std::set<std::string> names(const std::string& folder) {
  std::set<std::string> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    found.insert(entry.path().filename().string());
  }
  return found;
}

const std::set<std::string> result_files = {"README.txt",      "samples.csv", "frames.csv",
                                            "groundtruth.tum", "record.json", "slambench1.log",
                                            "trajectory.tum"};

Record record_of(const std::string& sequence) {
  Record record = sample_record();
  record.sequence = sequence;
  return record;
}

TEST(DefaultResultFolder, TellsTimeSequenceAndBackend) {
  const std::chrono::sys_seconds time(std::chrono::seconds(1432632600));
  EXPECT_EQ(default_result_folder(time, "living-room/2", "serial"),
            "results/20150526-093000-living-room-2-serial");
  EXPECT_EQ(default_result_folder(time, "../a b.raw", "x"), "results/20150526-093000-..-a-b.raw-x");
}

TEST(ResultFolder, HoldsAllFilesAndNothingElse) {
  const TemporaryFolder folder;
  write_results(folder.path("out"), false, sample_record());
  EXPECT_EQ(names(folder.path("out")), result_files);
  EXPECT_EQ(names(folder.path()), std::set<std::string>{"out"});
  const Record record = sample_record();
  EXPECT_EQ(read_file(folder.path("out/record.json")), record_json(record));
  EXPECT_EQ(read_file(folder.path("out/frames.csv")), frames_csv(record));
  EXPECT_EQ(read_file(folder.path("out/slambench1.log")), slambench1_log(record));
  EXPECT_EQ(read_file(folder.path("out/README.txt")), readme_text(record, false));
  EXPECT_EQ(read_file(folder.path("out/trajectory.tum")),
            trajectory_text(estimated_trajectory(record)));
  EXPECT_EQ(read_file(folder.path("out/groundtruth.tum")), trajectory_text(record.ground_truth));
}

TEST(ResultFolder, HasNoGroundTruthFileWhereThereIsNone) {
  const TemporaryFolder folder;
  Record record = sample_record();
  record.ground_truth.clear();
  write_results(folder.path("out"), false, record);
  EXPECT_FALSE(std::filesystem::exists(folder.path("out/groundtruth.tum")));
}

TEST(ResultFolder, MakesTheFoldersOnTheWay) {
  const TemporaryFolder folder;
  write_results(folder.path("a/b/out/"), false, sample_record());
  EXPECT_EQ(names(folder.path("a/b/out")), result_files);
}

TEST(ResultFolder, ShowsNothingBeforeItIsCommittedAndLeavesNoTraceWithout) {
  const TemporaryFolder folder;
  {
    ResultFolder results(folder.path("a/out"), false);
    results.write_image(3, "depth", Image<Rgba8>({2, 2}));
    EXPECT_FALSE(fs::exists(folder.path("a/out")));
    EXPECT_EQ(names(folder.path("a")), std::set<std::string>{".out.slambench-partial"});
  }
  EXPECT_THAT(names(folder.path()), IsEmpty());
}

TEST(ResultFolder, KeepsPicturesOfTheRun) {
  const TemporaryFolder folder;
  ResultFolder results(folder.path("out"), false);
  const Image<Rgba8> picture({2, 1}, Rgba8{1, 2, 3, 255});
  results.write_image(12, "depth", picture);
  results.write_image(12, "volume", Image<Rgba8>());
  results.commit(sample_record());
  EXPECT_EQ(names(folder.path("out/images")), std::set<std::string>{"frame_000012_depth.png"});
  EXPECT_EQ(read_file(folder.path("out/images/frame_000012_depth.png")), png_bytes(picture));
  EXPECT_EQ(read_file(folder.path("out/README.txt")), readme_text(sample_record(), true));
}

TEST(ResultFolder, FillsAnEmptyFolderInPlace) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path("out"));
  const auto permissions = fs::perms::owner_all;
  fs::permissions(folder.path("out"), permissions);
  write_results(folder.path("out"), false, sample_record());
  EXPECT_EQ(names(folder.path("out")), result_files);
  EXPECT_EQ(fs::status(folder.path("out")).permissions(), permissions) << "the same folder";
}

TEST(ResultFolder, LeavesAnEmptyFolderEmptyWhenNothingWasCommitted) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path("out"));
  { const ResultFolder results(folder.path("out"), false); }
  EXPECT_THAT(names(folder.path("out")), IsEmpty());
}

TEST(ResultFolder, DoesNotTouchEarlierResultsWithoutForce) {
  const TemporaryFolder folder;
  write_results(folder.path("out"), false, record_of("old"));
  const std::string out = folder.path("out");
  EXPECT_EQ(message_of<UsageError>([&] { const ResultFolder results(out, false); }),
            out +
                ": holds files already; choose another folder, or say --force to replace the "
                "results of an earlier run");
  EXPECT_EQ(read_file(folder.path("out/record.json")), record_json(record_of("old")));
  EXPECT_EQ(names(folder.path()), std::set<std::string>{"out"});
}

TEST(ResultFolder, ReplacesEarlierResultsAsAWholeWithForce) {
  const TemporaryFolder folder;
  {
    ResultFolder old(folder.path("out"), false);
    old.write_image(1, "depth", Image<Rgba8>({1, 1}));
    old.commit(record_of("old"));
  }
  ResultFolder results(folder.path("out"), true);
  EXPECT_EQ(read_file(folder.path("out/record.json")), record_json(record_of("old")))
      << "until the new ones are there";
  results.commit(record_of("new"));
  EXPECT_EQ(read_file(folder.path("out/record.json")), record_json(record_of("new")));
  EXPECT_EQ(names(folder.path("out")), result_files) << "no picture of the old run";
  EXPECT_EQ(names(folder.path()), std::set<std::string>{"out"});
}

TEST(ResultFolder, KeepsEarlierResultsWhenTheNewRunFails) {
  const TemporaryFolder folder;
  write_results(folder.path("out"), false, record_of("old"));
  { const ResultFolder results(folder.path("out"), true); }
  EXPECT_EQ(read_file(folder.path("out/record.json")), record_json(record_of("old")));
  EXPECT_EQ(names(folder.path()), std::set<std::string>{"out"});
}

TEST(ResultFolder, ForceDoesNotReplaceOtherFolders) {
  const TemporaryFolder folder;
  for (const char* contents : {"", "{}", "[]", "{\"format\": \"something else\"}", "{\"form"}) {
    folder.write("thesis/record.json", contents);
    EXPECT_THAT(message_of<UsageError>([&] { const ResultFolder r(folder.path("thesis"), true); }),
                HasSubstr("holds files but no results of an earlier run"));
  }
  fs::rename(folder.path("thesis/record.json"), folder.path("thesis/thesis.tex"));
  EXPECT_THAT(message_of<UsageError>([&] { const ResultFolder r(folder.path("thesis"), true); }),
              HasSubstr("holds files but no results of an earlier run"));
  EXPECT_EQ(names(folder.path("thesis")), std::set<std::string>{"thesis.tex"});
}

TEST(ResultFolder, RefusesAFileAndAnEmptyName) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "text");
  EXPECT_EQ(message_of<UsageError>([&] { const ResultFolder results(file, true); }),
            file + ": is a file, expected a folder");
  EXPECT_THROW(ResultFolder("", false), UsageError);
  EXPECT_EQ(read_file(file), "text");
}

TEST(ResultFolder, SaysEarlyThatNothingCanBeWrittenBelowAFile) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "text");
  EXPECT_EQ(message_of<Error>([&] { const ResultFolder results(file + "/a/out", false); }),
            file + ": cannot write: Not a directory");
  EXPECT_EQ(names(folder.path()), std::set<std::string>{"file"});
}

TEST(ResultFolder, SaysEarlyThatNothingCanBeMadeThere) {
  EXPECT_THAT(message_of<Error>([] { const ResultFolder results("/proc/slambench", false); }),
              HasSubstr("/proc/.slambench.slambench-partial: cannot write: "));
}

TEST(ResultFolder, SaysEarlyThatAFolderIsReadOnly) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write to read-only folders";
  const TemporaryFolder folder;
  fs::create_directory(folder.path("closed"));
  fs::permissions(folder.path("closed"), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THAT(message_of<Error>([&] { const ResultFolder r(folder.path("closed/out"), false); }),
              HasSubstr("cannot write: Permission denied"));
}

TEST(ResultFolder, RefusesASecondRunAtTheSameTime) {
  const TemporaryFolder folder;
  const std::string out = folder.path("out");
  ResultFolder first(out, false);
  EXPECT_EQ(message_of<UsageError>([&] { const ResultFolder second(out, true); }),
            out + ": another run is writing to this folder");
  first.commit(record_of("first"));
  EXPECT_EQ(read_file(out + "/record.json"), record_json(record_of("first")));

  fs::create_directory(folder.path("empty"));
  const ResultFolder third(folder.path("empty"), false);
  EXPECT_THROW(ResultFolder(folder.path("empty"), false), UsageError);
}

TEST(ResultFolder, TakesOverWhatAKilledRunLeft) {
  const TemporaryFolder folder;
  folder.write(".out.slambench-partial/images/frame_000000_depth.png", "half a picture");
  write_results(folder.path("out"), false, sample_record());
  EXPECT_EQ(names(folder.path("out")), result_files);
  EXPECT_EQ(names(folder.path()), std::set<std::string>{"out"});

  folder.write("empty/.slambench-partial/record.json", "half a record");
  write_results(folder.path("empty"), false, sample_record());
  EXPECT_EQ(names(folder.path("empty")), result_files);
}

TEST(ResultFolder, DoesNotOverwriteWhatCameMeanwhile) {
  const TemporaryFolder folder;
  {
    ResultFolder results(folder.path("out"), false);
    folder.write("out/notes.txt", "mine");
    EXPECT_THAT(message_of<Error>([&] { results.commit(sample_record()); }),
                HasSubstr(folder.path("out") + ": cannot write: "));
  }
  EXPECT_EQ(names(folder.path("out")), std::set<std::string>{"notes.txt"});
  EXPECT_EQ(names(folder.path()), std::set<std::string>{"out"});
}

/// Files can grow to so many bytes while this lives: what a full disk does, for one process.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit = {bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST(ResultFolder, LeavesNothingHalfWrittenOnAFullDisk) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path("empty"));
  write_results(folder.path("old"), false, record_of("old"));
  const std::string longest = record_json(sample_record());
  for (const char* out : {"new", "empty", "old"}) {
    ResultFolder results(folder.path(out), true);
    const FileSizeLimit limit(longest.size() - 1);  // only the last file does not fit
    EXPECT_THAT(message_of<Error>([&] { results.commit(sample_record()); }),
                HasSubstr("record.json: cannot write: "));
  }
  EXPECT_EQ(names(folder.path()), (std::set<std::string>{"empty", "old"}));
  EXPECT_THAT(names(folder.path("empty")), IsEmpty());
  EXPECT_EQ(read_file(folder.path("old/record.json")), record_json(record_of("old")));
}

TEST(ResultFolder, WritesThroughALinkToAFolder) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path("place"));
  fs::create_directory_symlink(folder.path("place"), folder.path("link"));
  write_results(folder.path("link"), false, record_of("old"));
  write_results(folder.path("link"), true, record_of("new"));
  EXPECT_TRUE(fs::is_symlink(folder.path("link")));
  EXPECT_EQ(read_file(folder.path("place/record.json")), record_json(record_of("new")));
}

}  // namespace
}  // namespace slambench
