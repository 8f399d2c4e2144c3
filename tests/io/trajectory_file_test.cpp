// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "io/trajectory_file.h"

#include <gmock/gmock.h>

#include <clocale>
#include <cstdlib>
#include <numbers>

#include "core/error.h"
#include "io/files.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::HasSubstr;
using testing::message_of;
using testing::TemporaryFolder;

Trajectory parse(std::string_view text) {
  const TemporaryFolder folder;
  return read_trajectory(folder.write("poses.txt", text));
}

/// The message for a file of this text, without the file's folder.
std::string error_of(std::string_view text) {
  const TemporaryFolder folder;
  const std::string file = folder.write("poses.txt", text);
  const std::string message = message_of<InputError>([&] { read_trajectory(file); });
  EXPECT_THAT(message, HasSubstr(file));
  return message.substr(message.find("poses.txt"));
}

TEST(TrajectoryFile, ReadsBlanksTabsCommentsAndCrlf) {
  const Trajectory poses = parse(
      "\xEF\xBB\xBF# a comment, with the numbers 1 2 3\r\n\r\n"
      "  1305031098.6659\t1 -2.5  +3e-1 0 0 0 1 \r\n"
      "# another\n \t \n"
      "7 0 0 0 1 0 0 0");
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].time_s, 1305031098.6659);
  EXPECT_EQ(poses[0].T_world_camera.translation(), Eigen::Vector3d(1, -2.5, 0.3));
  EXPECT_EQ(poses[0].T_world_camera.linear(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(poses[1].time_s, 7);
  EXPECT_EQ(poses[1].T_world_camera.linear(),
            Eigen::Vector3d(1, -1, -1).asDiagonal().toDenseMatrix());
}

TEST(TrajectoryFile, NormalisesQuaternionsOfAnyLength) {
  const Eigen::Matrix3d quarter_turn =
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (const char* line : {"0 1 2 3 0 0 0.7071 0.7071", "0 1 2 3 0 0 2 2", "0 1 2 3 0 0 1e-5 1e-5",
                           "0 1 2 3 0 0 1e200 1e200", "0 1 2 3 0 0 -1 -1"}) {
    const Pose pose = parse(line).at(0).T_world_camera;
    EXPECT_TRUE(pose.linear().isApprox(quarter_turn, 1e-15)) << line;
    EXPECT_TRUE((pose.linear() * pose.linear().transpose()).isIdentity(1e-15)) << line;
  }
}

TEST(TrajectoryFile, NamesTheFieldThatIsNotAFiniteNumber) {
  EXPECT_EQ(error_of("# c\n1 0 nan 0 0 0 0 1\n"),
            "poses.txt:2: ty: found 'nan', expected a finite number");
  EXPECT_EQ(error_of("inf 0 0 0 0 0 0 1"),
            "poses.txt:1: time: found 'inf', expected a finite number");
  EXPECT_EQ(error_of("1 0 0 0 0 0 0 1x"), "poses.txt:1: qw: found '1x', expected a finite number");
  EXPECT_EQ(error_of("1 0 0 0 0 1e999 0 1"),
            "poses.txt:1: qy: found '1e999', expected a finite number");
  EXPECT_EQ(error_of("1 0,5 0 0 0 0 0 1"),
            "poses.txt:1: tx: found '0,5', expected a finite number");
  EXPECT_EQ(error_of("1 0 0 + 0 0 0 1"), "poses.txt:1: tz: found '+', expected a finite number");
  EXPECT_EQ(error_of("1 0 0 0x10 0 0 0 1"),
            "poses.txt:1: tz: found '0x10', expected a finite number");
}

TEST(TrajectoryFile, CountsTheFields) {
  EXPECT_EQ(error_of("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 1\n"),
            "poses.txt:2: fields: found 7, expected 8: time tx ty tz qx qy qz qw");
  EXPECT_EQ(error_of("1 0 0 0 0 0 0 1 9"),
            "poses.txt:1: fields: found 9, expected 8: time tx ty tz qx qy qz qw");
}

TEST(TrajectoryFile, RejectsAZeroQuaternion) {
  EXPECT_EQ(error_of("1 0 0 0 0 0 0 0"),
            "poses.txt:1: quaternion qx qy qz qw: found norm 0, expected norm 1");
}

TEST(TrajectoryFile, RejectsAFileWithoutPoses) {
  const char* const message =
      "poses.txt: poses: found none, expected lines 'time tx ty tz qx qy qz qw'";
  EXPECT_EQ(error_of(""), message);
  EXPECT_EQ(error_of("# only\n\n# comments"), message);
}

TEST(TrajectoryFile, SurvivesBinaryGarbage) {
  EXPECT_EQ(error_of(std::string("\0\x01\xff\n", 4)),
            "poses.txt:1: fields: found 1, expected 8: time tx ty tz qx qy qz qw");
  EXPECT_EQ(error_of("1 0 0 0 0 0 0 \x1b[31m\xc3\xa4"),
            "poses.txt:1: qw: found '?[31m?"
            "?', expected a finite number");
  EXPECT_EQ(error_of("1 0 0 0 0 0 0 " + std::string(1000, 'x')),
            "poses.txt:1: qw: found '" + std::string(40, 'x') + "...', expected a finite number");
}

TEST(TrajectoryFile, NamesAMissingFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(message_of<InputError>([&] { read_trajectory(folder.path("none")); }),
            folder.path("none") + ": cannot read: No such file or directory");
  EXPECT_THAT(message_of<InputError>([&] { read_trajectory(folder.path()); }),
              HasSubstr("it is a folder"));
}

Trajectory sample() {
  Trajectory poses;
  for (int i = 0; i < 50; ++i) {
    StampedPose pose;
    pose.time_s = 1305031102.160407 + i / 30.0;
    pose.T_world_camera.translation() = Eigen::Vector3d(i / 3.0, -1e-7 * i, 1e6 / (i + 1));
    pose.T_world_camera.linear() =
        Eigen::AngleAxisd(0.13 * i, Eigen::Vector3d(1, i - 7, 2).normalized()).toRotationMatrix();
    poses.push_back(pose);
  }
  return poses;
}

void expect_round_trip() {
  const Trajectory poses = sample();
  const TemporaryFolder folder;
  const Trajectory read =
      read_trajectory(folder.write("trajectoire_é_軌跡.txt", trajectory_text(poses)));
  ASSERT_EQ(read.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(read[i].time_s, poses[i].time_s);
    EXPECT_EQ(read[i].T_world_camera.translation(), poses[i].T_world_camera.translation());
    EXPECT_TRUE(read[i].T_world_camera.linear().isApprox(poses[i].T_world_camera.linear(), 1e-15));
  }
}

TEST(TrajectoryFile, RoundTrips) { expect_round_trip(); }

TEST(TrajectoryFile, TextIsTheFormatOfTum) {
  StampedPose pose;
  pose.time_s = 0.5;
  pose.T_world_camera.translation() = Eigen::Vector3d(1, 0.25, -2);
  EXPECT_EQ(trajectory_text({pose}), "# time tx ty tz qx qy qz qw\n0.5 1 0.25 -2 0 0 0 1\n");
}

TEST(TrajectoryFile, DoesNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  const char* found = nullptr;
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "nl_NL.UTF-8"}) {
    if (found == nullptr) found = std::setlocale(LC_ALL, name);
  }
  if (found == nullptr) GTEST_SKIP() << "no locale with a decimal comma is installed";
  expect_round_trip();
  EXPECT_EQ(parse("0.5 0 0 0 0 0 0 1").at(0).time_s, 0.5);
  std::setlocale(LC_ALL, before.c_str());
}

TEST(TrajectoryFile, RefusesPositionsWithoutMeaning) {
  EXPECT_EQ(error_of("1 0 0 0 0 0 0 1\n2 0 -1e308 0 0 0 0 1"),
            "poses.txt:2: ty: found '-1e308', expected at most 1e6 m");
}

}  // namespace
}  // namespace slambench
