// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "metrics/trajectory_metrics.h"
#include "runner/runner.h"
#include "support/trajectories.h"

namespace slambench {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Key;
using testing::moved;
using ::testing::Not;
using testing::pose_at;
using testing::turned_by;
using testing::winding_path;

constexpr double stamp_0_s = 50;

/// A run of tracked frames with these poses, 30 a second.
Record record_of(const Trajectory& poses) {
  Record record;
  for (const auto& pose : poses) {
    FrameRecord frame;
    frame.index = static_cast<int>(record.frames.size());
    frame.time_s = stamp_0_s + pose.time_s;
    frame.tracked = true;
    frame.T_start_camera = poses.front().T_world_camera.inverse() * pose.T_world_camera;
    record.frames.push_back(frame);
  }
  return record;
}

/// The sequence whose ground truth is that path.
SequenceInfo sequence_of(Trajectory truth) {
  SequenceInfo info;
  info.fps = 30;
  for (auto& pose : truth) pose.time_s += stamp_0_s;
  info.ground_truth = std::move(truth);
  return info;
}

Pose nan_pose() { return pose_at(std::numeric_limits<double>::quiet_NaN(), 0, 0); }

void drop(FrameRecord& frame) {
  frame.dropped = true;
  frame.tracked = false;
  frame.T_start_camera = Pose::Identity();
}

TEST(Judge, APerfectRunHasNoError) {
  const auto truth = moved(winding_path(90), pose_at(1, 2, 3) * turned_by(50, {1, 1, 0}));
  Record record = record_of(truth);
  judge(sequence_of(truth), &record);
  ASSERT_TRUE(record.over_processed);
  const auto& figures = *record.over_processed;
  EXPECT_EQ(figures.association, "evo");
  EXPECT_EQ(figures.limit_s, 0.01);
  EXPECT_EQ(figures.estimate_poses, 90u);
  EXPECT_EQ(figures.ground_truth_poses, 90u);
  EXPECT_EQ(figures.matched, 90u);
  for (const char* alignment : {"first_pose", "se3", "sim3"}) {
    EXPECT_EQ(figures.ate_m.at(alignment).count, 90u);
    EXPECT_NEAR(figures.ate_m.at(alignment).max, 0, 1e-9) << alignment;
  }
  EXPECT_GT(figures.ate_m.at("none").mean, 1);
  EXPECT_NEAR(static_cast<double>(figures.rpe_translation_m.count), 62, 1)
      << "pairs of 0.9 s and more: 27 or 28 frames, by rounding";
  EXPECT_NEAR(figures.rpe_translation_m.max, 0, 1e-9);
  EXPECT_NEAR(figures.rpe_rotation_deg.max, 0, 1e-6);
  EXPECT_NEAR(record.frames[7].error_se3_m.value(), 0, 1e-9);
  EXPECT_NEAR(record.frames[7].error_first_pose_m.value(), 0, 1e-9);
  EXPECT_TRUE(record.valid);
  EXPECT_THAT(record.invalid_reasons, IsEmpty());
  EXPECT_EQ(record.over_all->ate_m.at("se3").count, 90u);
}

TEST(Judge, AKnownOffsetIsTheError) {
  const auto truth = winding_path(60);
  auto estimate = truth;
  for (std::size_t i = 1; i < estimate.size(); ++i) {
    estimate[i].T_world_camera = pose_at(0, 0, 0.5) * estimate[i].T_world_camera;
  }
  Record record = record_of(estimate);
  judge(sequence_of(truth), &record);
  EXPECT_NEAR(record.over_processed->ate_m.at("first_pose").max, 0.5, 1e-9);
  EXPECT_NEAR(record.over_processed->ate_m.at("first_pose").mean, 0.5 * 59 / 60, 1e-9);
  EXPECT_LT(record.over_processed->ate_m.at("se3").rmse, 0.1);
  EXPECT_NEAR(record.frames[0].error_first_pose_m.value(), 0, 1e-12);
  EXPECT_NEAR(record.frames[9].error_first_pose_m.value(), 0.5, 1e-9);
  EXPECT_GT(record.frames[0].error_se3_m.value(), 0.3);
}

TEST(Judge, AYUpGroundTruthIsJudgedInItsOwnAxes) {
  const auto camera = winding_path(60);
  const Eigen::Matrix3d y_up = Eigen::Vector3d(1, -1, 1).asDiagonal();
  Trajectory truth = camera;
  for (auto& pose : truth) {
    Pose own;
    own.linear() = y_up * pose.T_world_camera.linear() * y_up;
    own.translation() = y_up * pose.T_world_camera.translation();
    own.makeAffine();
    pose.T_world_camera = own;
  }
  SequenceInfo sequence = sequence_of(truth);
  Record wrong = record_of(camera);
  judge(sequence, &wrong);
  EXPECT_GT(wrong.over_processed->ate_m.at("first_pose").rmse, 0.1);
  EXPECT_GT(wrong.over_processed->ate_m.at("se3").rmse, 0.01);

  sequence.own_from_camera = y_up;
  Record right = record_of(camera);
  judge(sequence, &right);
  EXPECT_NEAR(right.over_processed->ate_m.at("first_pose").max, 0, 1e-9);
  EXPECT_NEAR(right.over_processed->rpe_rotation_deg.max, 0, 1e-6);
}

TEST(Judge, FramesWithoutARowHaveNoError) {
  auto truth = winding_path(60);
  Record record = record_of(truth);
  truth.erase(truth.begin());
  truth.resize(40);
  judge(sequence_of(truth), &record);
  EXPECT_EQ(record.over_processed->estimate_poses, 60u);
  EXPECT_EQ(record.over_processed->matched, 40u);
  EXPECT_NEAR(record.over_processed->ate_m.at("first_pose").max, 0, 1e-9);
  EXPECT_EQ(record.frames[0].error_se3_m, std::nullopt);
  EXPECT_EQ(record.frames[0].error_first_pose_m, std::nullopt);
  EXPECT_TRUE(record.frames[1].error_se3_m);
  EXPECT_TRUE(record.frames[40].error_se3_m);
  EXPECT_EQ(record.frames[41].error_se3_m, std::nullopt);
}

TEST(Judge, OfTwoRowsAtOneFrameTheFirstIsItsError) {
  const auto estimate = winding_path(10, 30);
  Record record = record_of(estimate);
  Trajectory truth = {estimate[0], estimate[5], estimate[5], estimate[9]};
  for (auto& pose : truth) {
    pose.T_world_camera = estimate[0].T_world_camera.inverse() * pose.T_world_camera;
  }
  truth[1].time_s -= 0.004;
  truth[2].time_s += 0.004;
  truth[2].T_world_camera = pose_at(0, 0, 3) * truth[2].T_world_camera;
  judge(sequence_of(truth), &record);
  EXPECT_EQ(record.over_processed->matched, 4u);
  EXPECT_NEAR(record.frames[5].error_first_pose_m.value(), 0, 1e-9);
}

TEST(Judge, DroppedFramesHoldTheLastPoseOverAll) {
  Trajectory truth;
  for (int i = 0; i < 6; ++i) truth.push_back({i / 30.0, pose_at(i, i * i, 0)});
  Record record = record_of(truth);
  drop(record.frames[3]);
  drop(record.frames[4]);
  judge(sequence_of(truth), &record);
  EXPECT_EQ(record.over_processed->estimate_poses, 4u);
  EXPECT_NEAR(record.over_processed->ate_m.at("none").max, 0, 1e-12);
  const Statistics& all = record.over_all->ate_m.at("none");
  EXPECT_EQ(all.count, 6u);
  EXPECT_NEAR(all.max, std::hypot(2, 12), 1e-12) << "frame 4 is where frame 2 was";
  EXPECT_NEAR(all.mean, (std::hypot(1, 5) + std::hypot(2, 12)) / 6, 1e-12);
  EXPECT_EQ(record.frames[3].error_se3_m, std::nullopt);
  EXPECT_TRUE(record.frames[5].error_se3_m);
}

TEST(Judge, FramesThatWereNotTrackedKeepTheirPose) {
  const auto truth = winding_path(30);
  Record record = record_of(truth);
  for (int i = 0; i < 4; ++i) record.frames[static_cast<std::size_t>(i)].tracked = false;
  judge(sequence_of(truth), &record);
  EXPECT_EQ(record.over_processed->estimate_poses, 30u);
  EXPECT_TRUE(record.valid);
}

TEST(Judge, WithoutGroundTruthSaysSo) {
  Record record = record_of(winding_path(30));
  judge(sequence_of({}), &record);
  EXPECT_FALSE(record.over_processed);
  EXPECT_FALSE(record.over_all);
  EXPECT_FALSE(record.slambench1_ate_m);
  EXPECT_EQ(record.absent.at("accuracy.over_processed"), "the sequence has no ground truth");
  EXPECT_EQ(record.absent.at("accuracy.over_all"), "the sequence has no ground truth");
  EXPECT_EQ(record.absent.at("accuracy.slambench1_ate_m"), "the sequence has no ground truth");
  EXPECT_TRUE(record.valid);
}

TEST(Judge, WithoutOverlapSaysSo) {
  auto truth = winding_path(30);
  Record record = record_of(truth);
  for (auto& pose : truth) pose.time_s += 1000;
  judge(sequence_of(truth), &record);
  EXPECT_FALSE(record.over_processed);
  EXPECT_THAT(record.absent.at("accuracy.over_processed"), ::testing::HasSubstr("time stamp"));
}

TEST(Judge, WhatTheMotionDoesNotDetermineIsAbsentWithAReason) {
  Trajectory truth;
  for (int i = 0; i < 90; ++i) truth.push_back({i / 30.0, pose_at(i * 0.01, 0, 0)});
  Record record = record_of(truth);
  judge(sequence_of(truth), &record);
  EXPECT_THAT(record.over_processed->ate_m, Contains(Key("first_pose")));
  EXPECT_THAT(record.over_processed->ate_m, Not(Contains(Key("se3"))));
  EXPECT_THAT(record.absent.at("accuracy.over_processed.ate_m.se3"),
              ::testing::HasSubstr("on one line"));
  EXPECT_THAT(record.absent, Contains(Key("accuracy.over_all.ate_m.sim3")));
  EXPECT_GT(record.over_processed->rpe_translation_m.count, 0u);
  EXPECT_EQ(record.frames[5].error_se3_m, std::nullopt);
  EXPECT_TRUE(record.valid);
}

TEST(Judge, ARunShorterThanASecondHasNoRelativeError) {
  const auto truth = winding_path(10);
  Record record = record_of(truth);
  judge(sequence_of(truth), &record);
  EXPECT_EQ(record.over_processed->rpe_translation_m.count, 0u);
  EXPECT_THAT(record.absent, Contains(Key("accuracy.over_processed.rpe_translation_m")));
  EXPECT_THAT(record.absent, Contains(Key("accuracy.over_processed.rpe_rotation_deg")));
}

TEST(Judge, StampsThatCountFramesStillGiveASecond) {
  auto truth = winding_path(90);
  for (std::size_t i = 0; i < truth.size(); ++i) truth[i].time_s = static_cast<double>(i);
  auto estimate = truth;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    estimate[i].T_world_camera = pose_at(0.001 * static_cast<double>(i), 0, 0) * Pose::Identity();
    truth[i].T_world_camera = Pose::Identity();
  }
  Record record = record_of(estimate);
  judge(sequence_of(truth), &record);
  const auto& rpe = record.over_processed->rpe_translation_m;
  EXPECT_NEAR(rpe.median, 0.030, 1e-9) << "30 frames at 1 mm each";
}

TEST(Judge, APoseThatIsNotANumberMakesTheRecordInvalid) {
  const auto truth = winding_path(60);
  Record record = record_of(truth);
  record.frames[20].T_start_camera = nan_pose();
  record.frames[21].T_start_camera = nan_pose();
  judge(sequence_of(truth), &record);
  EXPECT_FALSE(record.valid);
  EXPECT_THAT(record.invalid_reasons,
              ::testing::ElementsAre("the pose of frame 20 is not finite (2 such frames)"));
  EXPECT_EQ(record.over_processed->estimate_poses, 58u);
  EXPECT_EQ(record.over_all->estimate_poses, 60u) << "they hold the last pose";
  EXPECT_TRUE(std::isfinite(record.over_all->ate_m.at("se3").max));
  EXPECT_EQ(record.frames[20].error_se3_m, std::nullopt);
  EXPECT_NEAR(record.frames[22].error_se3_m.value(), 0, 1e-9);
  EXPECT_EQ(record.absent.at("accuracy.slambench1_ate_m"), "a pose is not finite");
}

TEST(Judge, NothingTrackedOrProcessedIsInvalid) {
  const auto truth = winding_path(10);
  Record record = record_of(truth);
  for (auto& frame : record.frames) frame.tracked = false;
  judge(sequence_of(truth), &record);
  EXPECT_FALSE(record.valid);
  EXPECT_THAT(record.invalid_reasons, ::testing::ElementsAre("no frame was tracked"));

  for (const char* first : {"9", "10"}) {
    Record few = record;
    few.invalid_reasons.clear();
    few.parameters = {{"kinectfusion", "bootstrap-frames", "frames", first, "default"}};
    judge(sequence_of(truth), &few);
    EXPECT_THAT(few.invalid_reasons,
                ::testing::ElementsAre(first == std::string("9")
                                           ? "no frame was tracked"
                                           : "no frame was tracked: 10 were processed, and the "
                                             "first 10 (--bootstrap-frames) never are"));
  }

  Record none;
  none.complete = false;
  judge(sequence_of(truth), &none);
  EXPECT_FALSE(none.valid);
  EXPECT_THAT(none.invalid_reasons, ::testing::ElementsAre("no frame was processed"));
  EXPECT_EQ(none.absent.at("accuracy.over_processed"), "no frame has a pose");
}

/// A walk along x that rests in frames 0 and 1, and its ground truth without a row for frame 0.
struct Walk {
  Record record;
  SequenceInfo sequence;
};
Walk walk(int frames) {
  Trajectory poses;
  for (int i = 0; i < frames; ++i) {
    poses.push_back({i / 30.0, pose_at(0.01 * std::max(0, i - 1), 0, 0)});
  }
  Walk walk{record_of(poses), {}};
  Trajectory truth = moved(poses, pose_at(0, 0, -2.25));
  truth.erase(truth.begin());
  walk.sequence = sequence_of(truth);
  return walk;
}

TEST(Judge, ThePublishedConventionIsTwoFramesLateWithoutARowOfFrame0) {
  Walk w = walk(20);
  judge(w.sequence, &w.record);
  EXPECT_NEAR(w.record.over_processed->ate_m.at("first_pose").max, 0, 1e-12);
  ASSERT_TRUE(w.record.slambench1_ate_m);
  EXPECT_EQ(w.record.slambench1_ate_m->count, 19u);
  EXPECT_NEAR(w.record.slambench1_ate_m->median, 0.02, 1e-12);
  EXPECT_NEAR(w.record.slambench1_ate_m->max, 0.02, 1e-12);
  EXPECT_THAT(w.record.absent, Not(Contains(Key("accuracy.slambench1_ate_m"))));
}

TEST(Judge, ThePublishedConventionIsOneFrameLateWithARowOfFrame0) {
  Walk w = walk(20);
  w.sequence.ground_truth.insert(w.sequence.ground_truth.begin(),
                                 {stamp_0_s, pose_at(0, 0, -2.25)});
  judge(w.sequence, &w.record);
  ASSERT_TRUE(w.record.slambench1_ate_m);
  EXPECT_EQ(w.record.slambench1_ate_m->count, 20u);
  EXPECT_NEAR(w.record.slambench1_ate_m->median, 0.01, 1e-12);
  EXPECT_NEAR(w.record.slambench1_ate_m->max, 0.01, 1e-12);
}

TEST(Judge, ThePublishedConventionMovesRowsUpOverHoles) {
  Walk w = walk(20);
  w.sequence.ground_truth.erase(w.sequence.ground_truth.begin() + 9);  // frame 10's
  judge(w.sequence, &w.record);
  ASSERT_TRUE(w.record.slambench1_ate_m);
  EXPECT_EQ(w.record.slambench1_ate_m->count, 18u);
  EXPECT_NEAR(w.record.slambench1_ate_m->max, 0.03, 1e-12) << "three late after the hole";
  EXPECT_NEAR(w.record.slambench1_ate_m->min, 0, 1e-12);
  EXPECT_NEAR(w.record.slambench1_ate_m->mean, (0.01 + 7 * 0.02 + 9 * 0.03) / 18, 1e-12);
}

TEST(Judge, ThePublishedConventionUsesTheRowAfterTheLastFrame) {
  Walk w = walk(20);
  w.record.frames.resize(10);
  judge(w.sequence, &w.record);
  EXPECT_EQ(w.record.slambench1_ate_m->count, 10u);
}

TEST(Judge, ThePublishedConventionRepeatsTheRowBeforeADroppedFrame) {
  Walk w = walk(6);
  drop(w.record.frames[4]);
  judge(w.sequence, &w.record);
  // Row 4 repeats row 3, which is frame 2's pose, and is compared with frame 5's: three late.
  EXPECT_NEAR(w.record.slambench1_ate_m->max, 0.03, 1e-12);
}

TEST(Judge, ThePublishedConventionMeansNothingWhereRowsBelongToNoFrame) {
  Walk w = walk(20);
  Trajectory dense;  // two rows a frame
  for (int i = 0; i < 40; ++i) dense.push_back({stamp_0_s + i / 60.0, pose_at(0, 0, -2.25)});
  w.sequence.ground_truth = dense;
  judge(w.sequence, &w.record);
  EXPECT_FALSE(w.record.slambench1_ate_m);
  EXPECT_THAT(w.record.absent.at("accuracy.slambench1_ate_m"),
              ::testing::HasSubstr("pairs by row"));
}

TEST(Judge, OfASinglePairNothingIsWithoutErrorByDefinition) {
  Walk w = walk(20);
  w.sequence.ground_truth.resize(1);
  judge(w.sequence, &w.record);
  ASSERT_TRUE(w.record.over_processed);
  EXPECT_EQ(w.record.over_processed->matched, 1u);
  EXPECT_THAT(w.record.over_processed->ate_m, Not(Contains(Key("first_pose"))));
  EXPECT_EQ(w.record.absent.at("accuracy.over_processed.ate_m.first_pose"),
            "alignment: found 1 pairs of poses, expected 2 at least");
  EXPECT_FALSE(w.record.frames[1].error_first_pose_m);
  EXPECT_FALSE(w.record.slambench1_ate_m);
  EXPECT_THAT(w.record.absent, Contains(Key("accuracy.slambench1_ate_m")));
}

TEST(Judge, ThePublishedConventionNeedsTheCamerasOwnAxes) {
  Walk w = walk(20);
  w.sequence.ground_truth = moved(w.sequence.ground_truth, turned_by(10, {0, 0, 1}));
  judge(w.sequence, &w.record);
  EXPECT_FALSE(w.record.slambench1_ate_m);
  EXPECT_THAT(w.record.absent.at("accuracy.slambench1_ate_m"), ::testing::HasSubstr("only shifts"));
}

}  // namespace
}  // namespace slambench
