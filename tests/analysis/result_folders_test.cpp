// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/result_folders.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(FindResultFolders, TakesRunsAndFoldersOfThem) {
  const testing::TemporaryFolder folder;
  const std::string a = folder.path("suite/a"), b = folder.path("suite/b");
  for (const char* run : {"suite/b", "suite/a"})
    folder.write(std::string(run) + "/record.json", "");
  folder.write("suite/notes.txt", "not a run");
  EXPECT_THAT(find_result_folders({folder.path("suite")}), ElementsAre(a, b));
  EXPECT_THAT(find_result_folders({b, folder.path("suite")}), ElementsAre(b, a));
}

TEST(FindResultFolders, RefusesWhatIsNone) {
  const testing::TemporaryFolder folder;
  const auto error = [](const std::string& path) {
    return testing::message_of<InputError>([&] { find_result_folders({path}); });
  };
  EXPECT_THAT(error(folder.path("none")), HasSubstr("none: no such folder"));
  EXPECT_THAT(error(folder.write("file", "")), HasSubstr("expected a result folder"));
  std::filesystem::create_directory(folder.path("empty"));
  EXPECT_THAT(error(folder.path("empty")), HasSubstr("found no record.json"));
}

TEST(ShortNames, AreAsLongAsItTakes) {
  EXPECT_THAT(short_names({"/r/a", "/r/b/"}), ElementsAre("a", "b"));
  EXPECT_THAT(short_names({"/r/x/run", "/r/y/run"}), ElementsAre("x/run", "y/run"));
  EXPECT_THAT(short_names({"/r/a", "/r/b/1"}), ElementsAre("a", "b/1"));
}

}  // namespace
}  // namespace slambench
