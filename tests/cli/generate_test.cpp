// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// `slambench generate` as its user meets it.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "scene/obj.h"
#include "scene/renderer.h"
#include "support/program.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* wall = "v -9 -9 2\nv 9 -9 2\nv 9 9 2\nv -9 9 2\nf 1 2 3 4\n";
constexpr const char* way = "0 0 0 0 0 0 0 1\n0.1 0 0 0.1 0 0 0 1\n0.2 0 0 0.2 0 0 0 1\n";

class GenerateTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!can_render()) GTEST_SKIP() << "built without Embree";
    if (!can_read_obj()) GTEST_SKIP() << "built without Assimp";
    program_.folder().write("wall.obj", wall);
    program_.folder().write("way.txt", way);
  }
  testing::Outcome run(const std::vector<std::string>& arguments) const {
    return program_.run(arguments);
  }
  void expect_error(const std::vector<std::string>& arguments, int status,
                    const std::string& message) const {
    const testing::Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_FALSE(fs::exists(program_.folder().path("out")));
  }

  bool has_partial_folder() const {
    const fs::directory_iterator entries(program_.folder().path());
    return std::any_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
      return entry.path().filename().string().ends_with(".slambench-partial");
    });
  }

  const testing::Program program_{SLAMBENCH_PROGRAM};
};

TEST_F(GenerateTest, WritesAnOwnSceneThatCanBeRead) {
  const auto outcome = run({"generate", "out", "--scene", "wall.obj", "--trajectory", "way.txt"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "3 frames in out\n");
  EXPECT_THAT(outcome.err, IsEmpty());
  const auto info = run({"info", "out"});
  EXPECT_THAT(info.out, HasSubstr("fx 481.2"));
  EXPECT_THAT(info.out, HasSubstr("3 of 3 frames have a pose"));
}

TEST_F(GenerateTest, WritesTheLivingRoomWithItsSettings) {
  ASSERT_EQ(run({"generate", "out", "--frames=6", "--layout=raw", "--quiet"}).status, 0);
  const auto outcome = run({"run", "out/sequence.raw", "--volume-resolution=64", "--out=results"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("out/slambench.toml sets compute-size-ratio, volume-size, "));
  EXPECT_THAT(outcome.out, HasSubstr("in 4.8x4.8x4.8 m"));
  EXPECT_EQ(run({"run", "out/sequence.raw", "--config", "out/slambench.toml",
                 "--volume-resolution=64", "--quiet", "--out=again"})
                .status,
            0);
}

TEST_F(GenerateTest, RejectsWhatDoesNotFitTogether) {
  expect_error({"generate"}, 2, "OUT");
  expect_error({"generate", "out", "--layout", "kitti"}, 2, "expected tum, icl or raw");
  expect_error({"generate", "out", "--path", "4"}, 2, "--path");
  expect_error({"generate", "out", "--frames", "0"}, 2, "--frames");
  expect_error({"generate", "out", "--scene", "wall.obj"}, 2, "needs --trajectory");
  expect_error({"generate", "out", "--trajectory", "way.txt", "--path", "1"}, 2, "--path");
  expect_error({"generate", "out", "--scene", "none.ply", "--trajectory", "way.txt"}, 3,
               "none.ply: cannot read");
  expect_error({"generate", "out", "--trajectory", "wall.obj"}, 3, "wall.obj");
  program_.folder().write("back.txt", "1 0 0 0 0 0 0 1\n0.5 0 0 0 0 0 0 1\n");
  expect_error({"generate", "out", "--trajectory", "back.txt"}, 3, "back.txt: time of pose 2");
  program_.folder().write("away.txt", "0 0 0 90 0 0 0 1\n");
  expect_error({"generate", "out", "--scene", "wall.obj", "--trajectory", "away.txt"}, 3,
               "none of the frames");
}

TEST_F(GenerateTest, FillsAFolderThatIsThere) {
  fs::create_directory(program_.folder().path("out"));
  const std::vector<std::string> arguments = {"generate", "out",          "--scene",
                                              "wall.obj", "--trajectory", "way.txt"};
  const auto outcome = run(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(program_.folder().path("out/slambench.toml")));
  const auto again = run(arguments);
  EXPECT_EQ(again.status, 2);
  EXPECT_THAT(again.err, HasSubstr("say --force to replace the generated sequence"));
}

TEST_F(GenerateTest, WarnsOfAFrameThatSeesNothing) {
  program_.folder().write("partly.txt", "0 0 0 0 0 0 0 1\n1 0 0 0 0 1 0 0\n");
  const auto outcome =
      run({"generate", "out", "--scene", "wall.obj", "--trajectory", "partly.txt"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err,
              HasSubstr("1 of 2 frames see nothing of the scene, the first is frame 1"));
}

TEST_F(GenerateTest, AnInterruptLeavesNothing) {
  const pid_t child = program_.start({"generate", "out", "--path=3"});
  // Once its folder is there, it listens.
  for (int i = 0; i < 3000 && !has_partial_folder(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_TRUE(has_partial_folder());
  ASSERT_EQ(::kill(child, SIGINT), 0);
  const auto outcome = program_.wait(child);
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
  EXPECT_FALSE(has_partial_folder());
  EXPECT_FALSE(fs::exists(program_.folder().path("out")));
}

}  // namespace
}  // namespace slambench
