// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "io/whole_folder.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <set>

#include "core/error.h"
#include "io/files.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::message_of;
using testing::TemporaryFolder;

// The results of runs hold the rest of it (results/result_folder_test.cpp).

constexpr FolderKind kind = {"dish of this kitchen", "receipt.txt", [](const fs::path& folder) {
                               return fs::exists(folder / "receipt.txt");
                             }};

void cook(const std::string& path, bool force, const std::string& what) {
  WholeFolder folder(path, force, kind);
  folder.make_folder("side");
  write_file(folder.file("side/salad"), what);
  write_file(folder.file("receipt.txt"), what);
  folder.commit();
}

ino_t inode(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? status.st_ino : 0;
}

/// In another folder while this lives.
class Within {
 public:
  explicit Within(const std::string& folder) : before_(fs::current_path()) {
    fs::current_path(folder);
  }
  ~Within() { fs::current_path(before_); }
  Within(const Within&) = delete;
  Within& operator=(const Within&) = delete;

 private:
  const fs::path before_;
};

TEST(WholeFolder, NamesItsKindWhenItDoesNotReplace) {
  const TemporaryFolder folder;
  folder.write("out/thesis.tex", "years of work");
  const std::string out = folder.path("out");
  EXPECT_EQ(message_of<UsageError>([&] { cook(out, false, "soup"); }),
            out +
                ": holds files already; choose another folder, or say --force to replace the dish "
                "of this kitchen");
  EXPECT_EQ(message_of<UsageError>([&] { cook(out, true, "soup"); }),
            out +
                ": holds files but no dish of this kitchen (receipt.txt); --force does not replace "
                "it");
}

TEST(WholeFolder, IsNotExchangedUnderTheFeetOfTheUser) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path("here/below"));
  fs::remove(folder.path("here/below"));
  const Within within(folder.path("here"));
  const ino_t before = inode(folder.path("here"));
  cook(".", false, "soup");
  EXPECT_EQ(read_file("side/salad"), "soup");
  cook(".", true, "pie");
  EXPECT_EQ(read_file("side/salad"), "pie");
  cook("../here", true, "cake");
  EXPECT_EQ(read_file("side/salad"), "cake");
  EXPECT_EQ(inode(folder.path("here")), before);
  EXPECT_EQ(inode("."), before);
}

TEST(WholeFolder, IsFilledInPlaceWhereTheUserIsBelowIt) {
  const TemporaryFolder folder;
  cook(folder.path("out"), false, "soup");
  const ino_t before = inode(folder.path("out"));
  const Within within(folder.path("out/side"));
  cook("..", true, "pie");
  EXPECT_EQ(inode(folder.path("out")), before);
  EXPECT_EQ(read_file(folder.path("out/side/salad")), "pie");
}

TEST(WholeFolder, KnowsWhatWouldLieInIt) {
  const TemporaryFolder folder;
  const WholeFolder out(folder.path("out"), false, kind);
  EXPECT_TRUE(out.contains(folder.path("out/file")));
  EXPECT_TRUE(out.contains(folder.path("out/a/b")));
  EXPECT_TRUE(out.contains(folder.path("out")));
  EXPECT_TRUE(out.contains(folder.path("other/../out/file")));
  EXPECT_FALSE(out.contains(folder.path("outside")));
  EXPECT_FALSE(out.contains(folder.path("file")));
  const Within within(folder.path());
  EXPECT_TRUE(out.contains("out/file"));
  EXPECT_FALSE(out.contains("file"));
}

TEST(WholeFolder, LeavesNothingWithoutCommit) {
  const TemporaryFolder folder;
  {
    const WholeFolder out(folder.path("a/b/out"), false, kind);
    write_file(out.file("salad"), "half");
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace slambench
