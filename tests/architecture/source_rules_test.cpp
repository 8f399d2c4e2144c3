// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "architecture/source_rules.h"

#include <gmock/gmock.h>

#include <fstream>
#include <map>

namespace slambench {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

const fs::path project = SLAMBENCH_SOURCE_DIR;

TEST(Project, IncludesOnlyWhatItLinks) { EXPECT_THAT(include_violations(project), IsEmpty()); }
TEST(Project, HasNoHiddenSideEffects) { EXPECT_THAT(side_effect_violations(project), IsEmpty()); }
TEST(Project, CarriesItsLicence) { EXPECT_THAT(header_violations(project), IsEmpty()); }

/// A small source tree that lives as long as the test.
class SourceRules : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) /
            (std::string("source_rules_") +
             testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(root_);
    add("src/core/CMakeLists.txt", "slambench_library(core)\n");
    add("src/core/image.h", "#include <vector>\n");
    add("src/kernels/CMakeLists.txt", "slambench_library(kernels core) # not io\n");
    add("src/kernels/kernel.h", "#include \"core/image.h\"\n");
    add("src/slam/CMakeLists.txt", "slambench_library(slam kernels)\n");
    add("src/slam/slam.h", "#include \"core/image.h\"\n#include \"kernels/kernel.h\"\n");
  }
  void TearDown() override { fs::remove_all(root_); }

  void add(const std::string& path, const std::string& text) {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }

  fs::path root_;
};

TEST_F(SourceRules, DirectAndIndirectLinksMayBeIncluded) {
  EXPECT_THAT(include_violations(root_), IsEmpty());
}

TEST_F(SourceRules, AnArrowThatRunsTheWrongWayIsFound) {
  add("src/core/wrong.cpp", "\n#include \"kernels/kernel.h\"\n");
  EXPECT_THAT(include_violations(root_),
              ElementsAre("src/core/wrong.cpp:2: includes src/kernels/kernel.h of "
                          "slambench_kernels, which slambench_core does not link"));
}

TEST_F(SourceRules, SiblingsMayNotKnowEachOther) {
  add("src/backends/a/CMakeLists.txt", "slambench_library(backends/a kernels)\n");
  add("src/backends/a/a.h", "#include \"kernels/kernel.h\"\n");
  add("src/backends/b/CMakeLists.txt", "slambench_library(backends/b kernels)\n");
  add("src/backends/b/b.cpp", "#include \"../a/a.h\"\n");
  EXPECT_THAT(include_violations(root_),
              ElementsAre("src/backends/b/b.cpp:1: includes src/backends/a/a.h of "
                          "slambench_backends_a, which slambench_backends_b does not link"));
}

TEST_F(SourceRules, APrivateLinkIsNotPassedOn) {
  add("src/backends/CMakeLists.txt",
      "add_library(slambench_backends STATIC registry.cpp)\n"
      "target_link_libraries(slambench_backends PUBLIC slambench_core\n"
      "                                         PRIVATE slambench_backends_a)\n");
  add("src/backends/registry.h", "");
  add("src/backends/registry.cpp", "#include \"backends/a/a.h\"\n");
  add("src/backends/a/CMakeLists.txt", "slambench_library(backends/a core)\n");
  add("src/backends/a/a.h", "");
  add("src/slam/CMakeLists.txt", "slambench_library(slam backends kernels)\n");
  EXPECT_THAT(include_violations(root_), IsEmpty());

  add("src/slam/wrong.cpp", "#include \"backends/a/a.h\"\n");
  EXPECT_THAT(include_violations(root_),
              ElementsAre("src/slam/wrong.cpp:1: includes src/backends/a/a.h of "
                          "slambench_backends_a, which slambench_slam does not link"));
}

TEST_F(SourceRules, AFileOfNoTargetIsFound) {
  add("src/stray/stray.h", "");
  EXPECT_THAT(include_violations(root_),
              ElementsAre("src/stray/stray.h:1: belongs to no CMake target"));
}

TEST_F(SourceRules, EachSideEffectIsFound) {
  const std::map<std::string, std::string> lines = {
      {"std::cout << 1;", "prints"},
      {"  printf(\"x\");", "prints"},
      {"fmt::print(\"x\");", "prints"},
      {"std::fputs(text, stderr);", "prints"},
      {"std::exit(1);", "ends the process"},
      {"abort();", "ends the process"},
      {"std::getenv(\"HOME\");", "reads the environment"},
      {"auto t = std::chrono::steady_clock::now();", "looks at a clock"},
      {"clock_gettime(CLOCK_MONOTONIC, &t);", "looks at a clock"},
      {"std::this_thread::sleep_for(1s);", "looks at a clock"},
  };
  for (const auto& [line, sentence] : lines) {
    add("src/core/effect.cpp", line + "\n");
    EXPECT_THAT(side_effect_violations(root_), ElementsAre("src/core/effect.cpp:1: " + sentence))
        << line;
  }
}

TEST_F(SourceRules, WordsInCommentsAndTextAreNoSideEffects) {
  add("src/core/effect.cpp",
      "clock.sleep_until(1); // std::exit(1)\nauto text = \"getenv(\\\"x\\\")\"; // stderr\n");
  EXPECT_THAT(side_effect_violations(root_), IsEmpty());
}

TEST_F(SourceRules, AMissingHeaderIsFound) {
  fs::remove_all(root_ / "src");
  add("src/core/a.h",
      "// SPDX-License-Identifier: MIT\n// SPDX-FileCopyrightText: The SLAMBench authors\n");
  add("apps/b.cpp", "int main() {}\n");
  EXPECT_THAT(header_violations(root_),
              ElementsAre("apps/b.cpp:1: does not start with the SPDX header"));
}

}  // namespace
}  // namespace slambench
