// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// `slambench info` as its user meets it: arguments in, text and status out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "io/png.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Outcome {
  int status = -1;
  std::string output;  ///< standard output and error together
};

class InfoTest : public ::testing::Test {
 protected:
  InfoTest() {
    for (const std::string i : {"0", "1", "2"}) {
      folder_.write("kt1/depth/" + i + ".png", png_bytes(Image<std::uint16_t>(Size{8, 6}, 5000)));
    }
    folder_.write("kt1/livingRoom1.gt.freiburg", "1 0 0 -2.25 0 0 0 1\n2 3 4 -2.25 0 0 0 1\n");
  }

  Outcome info(const std::string& arguments) const {
    const std::string command = std::string("cd '") + folder_.path() + "' && '" +
                                SLAMBENCH_PROGRAM + "' info " + arguments + " 2>&1";
    Outcome outcome;
    FILE* pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr) return outcome;
    std::array<char, 4096> buffer;
    while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
      outcome.output.append(buffer.data(), n);
    }
    const int ended = ::pclose(pipe);
    outcome.status = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
    return outcome;
  }

  testing::TemporaryFolder folder_;
};

TEST_F(InfoTest, PrintsAPageOf80Columns) {
  const Outcome outcome = info("kt1/");
  EXPECT_EQ(outcome.status, 0);
  for (const char* line : {
           "sequence      kt1\n",
           "layout        icl-nuim-tum\n",
           "path          kt1\n",
           "frames        3, stamps 0 to 2, 30 frames a second\n",
           "depth         8x6, 5000 units per metre\n",
           "colour        none\n",
           "camera        fx 6.015, fy 6, cx 3.99375, cy 2.99375 px (y down)\n",
           "axes          x right, y up, z forward\n",
           "ground truth  kt1/livingRoom1.gt.freiburg\n",
           "              2 poses, stamps 1 to 2, path of 5.000 m\n",
           "              2 of 3 frames have a pose\n",
           "suggested     --compute-size-ratio=2 --volume-size=5,5,5\n",
           "              --init-pose=0.485,0.5,0.55\n",
           "notes         no depth.txt and no associations.txt: the images are read by\n",
       }) {
    EXPECT_THAT(outcome.output, HasSubstr(line));
  }
  std::istringstream lines(outcome.output);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

TEST_F(InfoTest, TakesWhatTheUserSaysOfTheSource) {
  folder_.write("poses.txt", "0 0 0 0 0 0 0 1\n");
  const Outcome outcome =
      info("kt1 -k 5,-6,4,3 --depth-scale 1000 --ground-truth poses.txt --json");
  EXPECT_EQ(outcome.status, 0);
  const auto json = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(json.at("layout"), "icl-nuim-tum");
  EXPECT_EQ(json.at("frames"), 3);
  EXPECT_EQ(json.at("width"), 8);
  EXPECT_EQ(json.at("height"), 6);
  EXPECT_EQ(json.at("camera").at("fy"), 6);
  EXPECT_EQ(json.at("depth_units_per_m"), 1000);
  EXPECT_EQ(json.at("ground_truth").at("file"), "poses.txt");
  EXPECT_EQ(json.at("ground_truth").at("frames_with_pose"), 1);
  EXPECT_EQ(json.at("suggested").at("volume-size"), "6,6,6");
  EXPECT_TRUE(json.at("settings_file").is_null());
}

TEST_F(InfoTest, TakesTheSettingsThatTheSequenceBrings) {
  folder_.write("kt1/slambench.toml",
                "[source]\ndepth-scale = 1000\n[kinectfusion]\nvolume-size = 4\nmu = 0.2\n"
                "[output]\nimages = 3\n");
  const std::string page = info("kt1").output;
  EXPECT_THAT(page, HasSubstr("8x6, 1000 units per metre\n"));
  EXPECT_THAT(page, HasSubstr("--volume-size=4,4,4"));
  EXPECT_THAT(page, HasSubstr("--init-pose=0.485,0.5,0.55"));
  EXPECT_THAT(page, HasSubstr("settings      kt1/slambench.toml\n"));
  const auto json = nlohmann::json::parse(info("kt1/ --depth-scale 2000 --json").output);
  EXPECT_EQ(json.at("depth_units_per_m"), 2000);
  EXPECT_EQ(json.at("suggested").at("mu"), "0.2");
  EXPECT_FALSE(json.at("suggested").contains("images"));
  EXPECT_EQ(json.at("settings_file"), "kt1/slambench.toml");
}

TEST_F(InfoTest, SaysWithoutGroundTruthThatThereIsNone) {
  std::filesystem::remove(folder_.path("kt1/livingRoom1.gt.freiburg"));
  EXPECT_THAT(info("kt1").output, HasSubstr("ground truth  none\n"));
  EXPECT_TRUE(nlohmann::json::parse(info("kt1 --json").output).at("ground_truth").is_null());
}

TEST_F(InfoTest, EndsWithOneLineAndAStatusOnBadInput) {
  const auto expect = [&](const std::string& arguments, int status, const std::string& message) {
    const Outcome outcome = info(arguments);
    EXPECT_EQ(outcome.status, status) << arguments;
    EXPECT_THAT(outcome.output, StartsWith("slambench: " + message));
    EXPECT_EQ(outcome.output.find('\n'), outcome.output.size() - 1) << outcome.output;
  };
  expect("none", 3, "none: No such file or directory, and no built-in sequence has this name\n");
  expect(".", 3, ".: layout: found a folder with 'kt1', expected one of: ");
  expect("kt1 --ground-truth none", 3, "none: cannot read: No such file or directory\n");
  expect("kt1 -k 1,2,3", 2, "--camera: found '1,2,3', expected ");
  expect("kt1 -k 0,2,3,4", 2, "--camera: found '0,2,3,4', expected ");
  expect("", 2, "");
  folder_.write("kt1/depth/0.png", png_bytes(Image<Rgb8>(Size{8, 6})));
  expect("kt1", 3, "kt1/depth/0.png: PNG: found 8 bits RGB, expected 16 bits greyscale\n");
}

}  // namespace
}  // namespace slambench
