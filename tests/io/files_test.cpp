// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "io/files.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <thread>

#include "core/error.h"
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

TEST(Files, ReadsAPipe) {
  const TemporaryFolder folder;
  const std::string pipe = folder.path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string contents(20'000, 'x');
  std::thread writer([&] { write_file(pipe, contents); });
  EXPECT_EQ(read_file(pipe), contents);
  writer.join();
}

TEST(Files, MapsAFile) {
  const TemporaryFolder folder;
  const MappedFile file(folder.write("file", "abc"));
  ASSERT_EQ(file.bytes().size(), 3u);
  EXPECT_EQ(file.bytes()[2], std::byte{'c'});
  EXPECT_TRUE(MappedFile(folder.write("empty", "")).bytes().empty());
}

TEST(Files, MappingSaysWhyItFails) {
  const TemporaryFolder folder;
  EXPECT_EQ(message_of<InputError>([&] { const MappedFile file(folder.path("none")); }),
            folder.path("none") + ": cannot read: No such file or directory");
  EXPECT_EQ(message_of<InputError>([&] { const MappedFile file(folder.path()); }),
            folder.path() + ": cannot read: it is a folder, not a file");
  EXPECT_EQ(message_of<InputError>([&] { const MappedFile file("/dev/null"); }),
            "/dev/null: cannot read: it is not a file");
}

/// Sets an environment variable, or unsets it, for the time it lives.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* const before = std::getenv(name)) before_ = before;
    set(value);
  }
  ~Environment() { set(before_ ? before_->c_str() : nullptr); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  void set(const char* value) { value != nullptr ? ::setenv(name_, value, 1) : ::unsetenv(name_); }
  const char* name_;
  std::optional<std::string> before_;
};

TEST(CacheFolder, FollowsTheXdgSpecification) {
  const Environment home("HOME", "/home/someone");
  {
    const Environment xdg("XDG_CACHE_HOME", "/cache");
    EXPECT_EQ(cache_folder(), "/cache/slambench");
  }
  {
    const Environment xdg("XDG_CACHE_HOME", "relative");
    EXPECT_EQ(cache_folder(), "/home/someone/.cache/slambench");
  }
  const Environment xdg("XDG_CACHE_HOME", nullptr);
  EXPECT_EQ(cache_folder(), "/home/someone/.cache/slambench");
  const Environment no_home("HOME", nullptr);
  EXPECT_THAT(message_of<UnavailableError>([] { cache_folder(); }), HasSubstr("HOME"));
}

}  // namespace
}  // namespace slambench
