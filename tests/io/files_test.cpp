// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "io/files.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <thread>
#include <utility>

#include "core/error.h"
#include "support/environment.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

TEST(Files, WritesAndReadsBack) {
  const TemporaryFolder folder;
  const std::string file = folder.path("läuft 測.bin");
  const std::string contents("a\0b\r\n\xff", 6);
  write_file(file, contents);
  EXPECT_EQ(read_file(file), contents);
  write_file(file, "");
  EXPECT_EQ(read_file(file), "");
  const std::string large(300'001, 'x');
  write_file(file, large);
  EXPECT_EQ(read_file(file), large);
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(Files, WritesInTheCurrentFolder) {
  const TemporaryFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  EXPECT_NO_THROW(write_file("plain", "x"));
  std::filesystem::current_path(before);
  EXPECT_EQ(read_file(folder.path("plain")), "x");
}

TEST(Files, WritingKeepsALinkAndTheFilesMode) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "old");
  std::filesystem::permissions(file, std::filesystem::perms(0640));
  std::filesystem::create_symlink("file", folder.path("link"));
  write_file(folder.path("link"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("link")));
  EXPECT_EQ(read_file(file), "new");
  EXPECT_EQ(std::filesystem::status(file).permissions(), std::filesystem::perms(0640));
}

TEST(Files, WritingToADeviceLeavesItADevice) {
  write_file("/dev/null", "x");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(Files, WritingSaysWhyItFails) {
  const TemporaryFolder folder;
  EXPECT_EQ(message_of<Error>([&] { write_file(folder.path("no/file"), "x"); }),
            folder.path("no/file") + ": cannot write: No such file or directory");
  EXPECT_EQ(message_of<Error>([&] { write_file(folder.path(), "x"); }),
            folder.path() + ": cannot write: it is a folder, not a file");
  const std::string file = folder.write("file", "old");
  EXPECT_EQ(message_of<Error>([&] { write_file(file + "/below", "x"); }),
            file + "/below: cannot write: Not a directory");
  try {
    write_file(folder.path("no/file"), "x");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::failed);
  }
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(Files, AFullDiskLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "old");
  rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {1000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = message_of<Error>([&] { write_file(file, std::string(5000, 'x')); });
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(message, file + ": cannot write: File too large");
  EXPECT_EQ(read_file(file), "old");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(Files, ReadingSaysWhyItFails) {
  const TemporaryFolder folder;
  EXPECT_EQ(message_of<InputError>([&] { read_file(folder.path("none")); }),
            folder.path("none") + ": cannot read: No such file or directory");
  EXPECT_EQ(message_of<InputError>([&] { read_file(folder.path()); }),
            folder.path() + ": cannot read: it is a folder, not a file");
  EXPECT_EQ(message_of<InputError>([&] { read_file("/dev/zero"); }),
            "/dev/zero: cannot read: it is not a file");
}

/// A pipe with a name, and both of its ends, so that either may be opened.
struct Pipe {
  Pipe() {
    EXPECT_EQ(mkfifo(path.c_str(), 0600), 0);
    ends = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  }
  ~Pipe() { close_ends(); }
  void close_ends() {
    if (ends >= 0) ::close(std::exchange(ends, -1));
  }

  TemporaryFolder folder;
  std::string path = folder.path("pipe");
  int ends = -1;
};

TEST(Files, ReadsAPipeToItsEnd) {
  Pipe pipe;
  const std::string contents(200'000, 'x');  // more than it holds at once
  std::thread writer([&] {
    write_file(pipe.path, contents);
    pipe.close_ends();
  });
  EXPECT_EQ(read_file(pipe.path), contents);
  writer.join();
}

TEST(Files, APipeWithoutAnotherEndIsAnErrorAtOnce) {
  Pipe pipe;
  pipe.close_ends();
  EXPECT_EQ(message_of<InputError>([&] { read_file(pipe.path); }),
            pipe.path + ": cannot read: it is a pipe that nobody writes to");
  EXPECT_EQ(message_of<Error>([&] { write_file(pipe.path, "text"); }),
            pipe.path + ": cannot write: nobody reads from this pipe");
}

std::string piece_of(const PiecewiseFile& file, std::size_t offset, std::size_t count) {
  std::string text(count, '\0');
  file.read(offset, std::as_writable_bytes(std::span(text)));
  return text;
}

TEST(PiecewiseFile, IsReadFromAnyPlace) {
  const TemporaryFolder folder;
  const PiecewiseFile file(folder.write("file", "abcdef"));
  EXPECT_EQ(file.size(), 6u);
  EXPECT_EQ(piece_of(file, 0, 6), "abcdef");
  EXPECT_EQ(piece_of(file, 4, 2), "ef");
  EXPECT_EQ(piece_of(file, 2, 1), "c");
  EXPECT_EQ(piece_of(file, 6, 0), "");
  EXPECT_EQ(PiecewiseFile(folder.write("empty", "")).size(), 0u);
}

TEST(PiecewiseFile, ThatIsShortenedMeanwhileIsAnError) {
  const TemporaryFolder folder;
  const std::string path = folder.write("file", std::string(100'000, 'x'));
  const PiecewiseFile file(path);
  std::filesystem::resize_file(path, 10);
  EXPECT_EQ(piece_of(file, 0, 10), "xxxxxxxxxx");
  EXPECT_EQ(message_of<InputError>([&] { piece_of(file, 5, 50'000); }),
            path + ": cannot read: it has 10 bytes, and had 100000 when it was opened");
}

TEST(PiecewiseFile, SaysWhyItCannotBeOpened) {
  const TemporaryFolder folder;
  EXPECT_EQ(message_of<InputError>([&] { const PiecewiseFile file(folder.path("none")); }),
            folder.path("none") + ": cannot read: No such file or directory");
  EXPECT_EQ(message_of<InputError>([&] { const PiecewiseFile file(folder.path()); }),
            folder.path() + ": cannot read: it is a folder, not a file");
  EXPECT_EQ(message_of<InputError>([&] { const PiecewiseFile file("/dev/null"); }),
            "/dev/null: cannot read: it is not a file");
  const Pipe pipe;
  EXPECT_EQ(message_of<InputError>([&] { const PiecewiseFile file(pipe.path); }),
            pipe.path + ": cannot read: it is not a file");
}

TEST(CacheFolder, FollowsTheXdgSpecification) {
  const testing::Environment home("HOME", "/home/someone");
  {
    const testing::Environment xdg("XDG_CACHE_HOME", "/cache");
    EXPECT_EQ(cache_folder(), "/cache/slambench");
  }
  {
    const testing::Environment xdg("XDG_CACHE_HOME", "relative");
    EXPECT_EQ(cache_folder(), "/home/someone/.cache/slambench");
  }
  const testing::Environment xdg("XDG_CACHE_HOME", nullptr);
  EXPECT_EQ(cache_folder(), "/home/someone/.cache/slambench");
  const testing::Environment no_home("HOME", nullptr);
  EXPECT_THAT(message_of<UnavailableError>([] { cache_folder(); }), HasSubstr("HOME"));
}

}  // namespace
}  // namespace slambench
