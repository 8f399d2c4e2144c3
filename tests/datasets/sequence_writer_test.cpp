// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/sequence_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "scene/shapes.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::message_of;
using testing::TemporaryFolder;

/// A ball in a box, seen by a camera that moves and turns a little.
class SequenceWriter : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!can_render()) GTEST_SKIP() << "built without Embree";
    surface_ = box({4, 3, 5}, {180, 160, 120});
    surface_.append(superellipsoid({0.5f, 0.5f, 0.5f}, 1, 1, {200, 60, 40}), placed(0, 1.5f, 1));
    for (int i = 0; i < frames; ++i) {
      Pose pose = Pose::Identity();
      pose.translation() << 0.1 * i, 1.5 + 0.02 * i, -1 + 0.03 * i;
      pose.rotate(Eigen::AngleAxisd(0.05 * i, Eigen::Vector3d(1, 2, 3).normalized()));
      trajectory_.push_back({10 + 0.1 * i, pose});
    }
  }

  RenderedSequence rendered() const { return {surface_, trajectory_, Shading::diffuse, {}, 1}; }

  std::vector<int> write(WrittenLayout layout, bool force = false,
                         const PrepareProgress& progress = {}) const {
    WrittenSequence what;
    what.layout = layout;
    what.frames = static_cast<int>(trajectory_.size());
    what.trajectory = "traj0";
    what.sentence = "A ball in a box";
    return write_sequence(rendered(), surface_, what, out_, force, progress);
  }

  /// What the reader finds is what was rendered, in depth to half a unit and in all colours.
  void expect_frames(Source& source, float tolerance_units) const {
    ASSERT_EQ(source.info().frame_count, frames);
    EXPECT_EQ(source.info().camera, rendered_camera);
    const RenderedSequence sequence = rendered();
    source.set_color(true);
    Rendering expected;
    Frame frame;
    for (int i = 0; i < frames; ++i) {
      sequence.render(i, expected);
      source.read(i, frame);
      ASSERT_EQ(frame.depth.size(), rendered_size);
      EXPECT_EQ(frame.color, expected.color);
      for (std::size_t k = 0; k < frame.depth.count(); ++k) {
        const float units = expected.depth_m.data()[k] * source.info().units_per_m;
        ASSERT_NEAR(frame.depth.data()[k], units, tolerance_units) << i << ' ' << k;
      }
    }
  }

  /// A pixel's measured point lies on the surface file, when moved by the ground truth: checked at
  /// the ball, whose centre is known through the mesh's last vertices.
  void expect_surface_fits(Source& source) const {
    const SequenceInfo& info = source.info();
    const Mesh surface = read_mesh(out_ + "/surface.ply");
    ASSERT_EQ(surface.vertices.size(), surface_.vertices.size());
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    const std::size_t ball = surface.vertices.size() - 25 * 13;
    Eigen::AlignedBox3d bounds;
    for (std::size_t i = ball; i < surface.vertices.size(); ++i) {
      bounds.extend(surface.vertices[i].cast<double>());
    }
    center = bounds.center();
    Frame frame;
    for (const StampedPose& truth : info.ground_truth) {
      int index = 0;
      while (std::abs(source.time_s(index) - truth.time_s) > 1e-3) ++index;
      source.read(index, frame);
      const Eigen::Vector3d in_camera =
          truth.T_world_camera.inverse() * center;  // in the sequence's own axes
      const Eigen::Vector3d down = info.own_from_camera.inverse() * in_camera;
      const int u =
          static_cast<int>(std::lround(info.camera.fx * down.x() / down.z() + info.camera.cx));
      const int v =
          static_cast<int>(std::lround(info.camera.fy * down.y() / down.z() + info.camera.cy));
      const double z = frame.depth(u, v) / static_cast<double>(info.units_per_m);
      const Eigen::Vector3d seen((u - info.camera.cx) / info.camera.fx * z,
                                 (v - info.camera.cy) / info.camera.fy * z, z);
      // Rough facets: 24 segments.
      EXPECT_NEAR((seen - down).norm(), 0.5, 0.02) << truth.time_s;
    }
  }

  static constexpr int frames = 3;
  const TemporaryFolder folder_;
  std::string out_ = folder_.path("out");
  Mesh surface_;
  Trajectory trajectory_;
};

TEST_F(SequenceWriter, TumReadsBack) {
  EXPECT_THAT(write(WrittenLayout::tum), IsEmpty());
  const auto source = open_source(out_, {});
  EXPECT_EQ(source->info().layout, "tum-rgbd");
  expect_frames(*source, 0.51f);
  expect_surface_fits(*source);
  ASSERT_EQ(source->info().ground_truth.size(), trajectory_.size());
  for (std::size_t i = 0; i < trajectory_.size(); ++i) {
    EXPECT_NEAR(source->time_s(static_cast<int>(i)), trajectory_[i].time_s, 1e-9);
    EXPECT_TRUE(source->info().ground_truth[i].T_world_camera.isApprox(
        trajectory_[i].T_world_camera, 1e-9));
  }
}

TEST_F(SequenceWriter, IclReadsBackWithYUpAndNoPoseOfTheFirstFrame) {
  EXPECT_THAT(write(WrittenLayout::icl), IsEmpty());
  const auto source = open_source(out_, {});
  const SequenceInfo& info = source->info();
  EXPECT_EQ(info.layout, "icl-nuim");
  expect_frames(*source, 0.6f);
  expect_surface_fits(*source);
  ASSERT_EQ(info.ground_truth.size(), 2u);
  EXPECT_EQ(info.ground_truth[0].time_s, 1);
  EXPECT_TRUE(info.ground_truth[0].T_world_camera.translation().isApprox(
      Eigen::Vector3d(0, 0, -2.25), 1e-12));
  EXPECT_TRUE(info.ground_truth[0].T_world_camera.linear().isIdentity(1e-12));
}

TEST_F(SequenceWriter, RawReadsBack) {
  EXPECT_THAT(write(WrittenLayout::raw), IsEmpty());
  const auto source = open_source(out_ + "/sequence.raw", {});
  EXPECT_EQ(source->info().layout, "slambench-raw");
  expect_frames(*source, 0.51f);
  expect_surface_fits(*source);
  EXPECT_EQ(source->info().frames_with_ground_truth, frames);
}

TEST_F(SequenceWriter, DoesNotReplaceWhatItDidNotWrite) {
  folder_.write("out/thesis.tex", "years of work");
  EXPECT_THAT(message_of<UsageError>([&] { write(WrittenLayout::raw); }), HasSubstr("--force"));
  EXPECT_THAT(message_of<UsageError>([&] { write(WrittenLayout::raw, true); }),
              HasSubstr("holds files but no generated sequence (slambench.toml)"));
  EXPECT_TRUE(fs::exists(out_ + "/thesis.tex"));
  EXPECT_EQ(folder_.file_count(), 1u);
}

TEST_F(SequenceWriter, ReplacesItsOwnFolderWithForceOnly) {
  write(WrittenLayout::raw);
  EXPECT_THAT(message_of<UsageError>([&] { write(WrittenLayout::icl); }), HasSubstr("--force"));
  write(WrittenLayout::icl, true);
  EXPECT_FALSE(fs::exists(out_ + "/sequence.raw"));
  EXPECT_TRUE(fs::exists(out_ + "/traj0.gt.freiburg"));
  EXPECT_EQ(folder_.file_count(), 1u);
}

TEST_F(SequenceWriter, FillsAnEmptyFolder) {
  fs::create_directory(out_);
  struct stat before {};
  struct stat after {};
  ASSERT_EQ(::stat(out_.c_str(), &before), 0);
  write(WrittenLayout::raw);
  EXPECT_TRUE(fs::exists(out_ + "/sequence.raw"));
  ASSERT_EQ(::stat(out_.c_str(), &after), 0);
  EXPECT_EQ(after.st_ino, before.st_ino) << "it may be the one that somebody is in";
}

TEST_F(SequenceWriter, LeavesNothingWhenItIsEndedEarly) {
  const auto end = [&] { write(WrittenLayout::tum, false, [](int, int) { return false; }); };
  EXPECT_THAT(message_of<Error>(end), HasSubstr("interrupted"));
  EXPECT_EQ(folder_.file_count(), 0u);
}

TEST_F(SequenceWriter, NamesFramesThatSeeNothing) {
  Mesh ball = superellipsoid({0.5f, 0.5f, 0.5f}, 1, 1, {200, 60, 40});
  ball.transform(placed(0, 1.5f, 1));
  surface_ = ball;
  trajectory_[1].T_world_camera.rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY()));
  EXPECT_THAT(write(WrittenLayout::tum), ElementsAre(1));
}

TEST_F(SequenceWriter, RejectsATrajectoryThatSeesNothingAtAll) {
  for (StampedPose& stamped : trajectory_) stamped.T_world_camera.translation().x() += 1000;
  for (const auto layout : {WrittenLayout::tum, WrittenLayout::raw}) {
    EXPECT_THAT(message_of<InputError>([&] { write(layout); }), HasSubstr("sees anything"));
    EXPECT_EQ(folder_.file_count(), 0u);
  }
}

TEST_F(SequenceWriter, SaysWhereItCannotWrite) {
  folder_.write("file", "no folder");
  out_ = folder_.path("file");
  EXPECT_THAT(message_of<UsageError>([&] { write(WrittenLayout::raw); }), HasSubstr("is a file"));
  out_ = folder_.path("file/out");
  EXPECT_THAT(message_of<Error>([&] { write(WrittenLayout::raw); }), HasSubstr("Not a directory"));
}

TEST_F(SequenceWriter, IclNeedsTwoFrames) {
  trajectory_.resize(1);
  EXPECT_THAT(message_of<UsageError>([&] { write(WrittenLayout::icl); }), HasSubstr("at least 2"));
}

TEST(CameraFile, OverridesTheLayoutsCameraButNotTheUsers) {
  const TemporaryFolder folder;
  folder.write("a/depth.txt", "1 depth/1.png\n");
  folder.write("a/camera.txt", "# fx fy cx cy\n100 101 50 51\n");
  const SourceParameters none;
  EXPECT_THAT(message_of<InputError>([&] { open_source(folder.path("a"), none); }),
              HasSubstr("1.png"));
  folder.write("a/camera.txt", "100 101 50\n");
  EXPECT_THAT(message_of<InputError>([&] { open_source(folder.path("a"), none); }),
              HasSubstr("camera.txt: contents: found"));
  folder.write("a/camera.txt", "100 -101 50 60\n");
  EXPECT_THAT(message_of<InputError>([&] { open_source(folder.path("a"), none); }),
              HasSubstr("camera.txt: line 1: found '-101'"));
  SourceParameters users;
  users.camera = std::array<double, 4>{1, 2, 3, 4};
  EXPECT_THAT(message_of<InputError>([&] { open_source(folder.path("a"), users); }),
              HasSubstr("1.png"));
}

}  // namespace
}  // namespace slambench
