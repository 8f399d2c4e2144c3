// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "backends/serial/serial_backend.h"
#include "cuda/host_launch.h"
#include "slam/kinect_fusion.h"
#include "support/advance.h"
#include "support/device_images.h"
#include "support/random_images.h"
#include "support/synthetic_scene.h"
#include "verify/recording.h"

/// What the agreement with the reference does not show. The kernels run on the host.
namespace slambench {
namespace {

using testing::AfterFrame;
using testing::downloaded;
using testing::expect_same;
using testing::HostCudaBackend;
using testing::HostLaunch;
using testing::Meeting;
using testing::Order;
using testing::step_by_step;
using testing::uploaded;
using testing::voxels_of;
using testing::corner::camera;
using testing::corner::fused;
using testing::corner::resolution;
using testing::corner::size;
using testing::corner::size_m;
using testing::corner::view_at;

struct CudaBackend : ::testing::Test {
  std::shared_ptr<HostLaunch> launch = std::make_shared<HostLaunch>(Order::forwards);
  HostCudaBackend backend{launch};
};

/// Counts what is measured of each kernel, and what is timed from outside.
struct Measured : Observer {
  void stage_begin(Stage) override {}
  void stage_end(Stage) override {}
  void in_one_go_begin() override {}
  void in_one_go_end() override {}
  void kernel_begin(Kernel kernel) override { ++from_outside[kernel]; }
  void kernel_end(Kernel) override {}
  void kernel_measured(Kernel kernel, double) override { ++by_itself[kernel]; }
  void transfer_measured(Transfer direction, std::size_t count, double) override {
    bytes[direction].push_back(count);
  }
  std::map<Kernel, int> by_itself, from_outside;
  std::map<Transfer, std::vector<std::size_t>> bytes;
};

KinectFusion system_for(Backend& backend, const Recording& recording, MapKind map, bool fused,
                        Observer* observer = nullptr) {
  KinectFusionParameters parameters = recording.parameters;
  parameters.map = name(map);
  parameters.fused = fused;
  return {backend,
          parameters,
          recording.frames[0].depth.size(),
          recording.camera,
          recording.units_per_m,
          observer};
}

TEST_F(CudaBackend, MeasuresEachKernelOnceAndTellsWhenItIsFinished) {
  Measured measured;
  backend.observe(&measured);
  const Recording recording = synthetic_recording({64, 48}, 1);
  auto depth = backend.make_image<float>({64, 48});
  backend.mm2meters(depth, uploaded(backend, recording.frames[0].depth), 1000);
  EXPECT_TRUE(measured.by_itself.empty());
  backend.finish();
  EXPECT_EQ(measured.by_itself, (std::map<Kernel, int>{{Kernel::mm2meters, 1}}));
  backend.finish();
  EXPECT_EQ(measured.by_itself, (std::map<Kernel, int>{{Kernel::mm2meters, 1}}));
  EXPECT_TRUE(measured.from_outside.empty());
}

TEST_F(CudaBackend, MeasuresEveryKernelOfThePipeline) {
  const Recording recording = synthetic_recording({80, 60}, 6);
  for (const bool fused : {false, true}) {
    Measured measured;
    backend.observe(&measured);
    KinectFusion system = system_for(backend, recording, MapKind::bricks, fused, &measured);
    for (const Frame& frame : recording.frames) {
      system.process(frame);
      system.render();
    }
    EXPECT_EQ(launch->open, 0);
    EXPECT_EQ(measured.by_itself[Kernel::mm2meters], 6);
    EXPECT_EQ(measured.by_itself[Kernel::bilateral_filter], 6);
    EXPECT_EQ(measured.by_itself[Kernel::render_depth], 6);
    EXPECT_EQ(measured.by_itself[Kernel::init_volume], 1);
    EXPECT_GT(measured.by_itself[Kernel::integrate], 0);
    EXPECT_GT(measured.by_itself[Kernel::raycast], 0);
    EXPECT_EQ(measured.by_itself[Kernel::align] > 0, fused);
    EXPECT_EQ(measured.by_itself[Kernel::track] > 0, !fused);
    EXPECT_EQ(measured.by_itself[Kernel::track], measured.by_itself[Kernel::reduce]);
    // solve is the host's.
    EXPECT_EQ(measured.from_outside[Kernel::solve] > 0, !fused);
    EXPECT_EQ(measured.from_outside.size(), 1u);
  }
}

TEST_F(CudaBackend, MeasuresEachTransferOnceAndTellsWhenItIsFinished) {
  Measured measured;
  const Image<float> image({64, 48}, 1.5f);
  auto unheard = uploaded(backend, image);
  backend.observe(&measured);
  auto depth = uploaded(backend, image);
  EXPECT_EQ(downloaded(backend, depth), image);
  EXPECT_TRUE(measured.bytes.empty());
  backend.finish();
  backend.finish();
  using Bytes = std::vector<std::size_t>;
  EXPECT_EQ(measured.bytes[Transfer::to_device], Bytes{image.bytes()});
  EXPECT_EQ(measured.bytes[Transfer::to_host], Bytes{image.bytes()});
  EXPECT_EQ(launch->open, 0);
}

TEST_F(CudaBackend, AllocatesNothingOnceItRuns) {
  const Recording recording = synthetic_recording({80, 60}, 9);
  for (const MapKind map : {MapKind::grid, MapKind::bricks}) {
    KinectFusion system = system_for(backend, recording, map, true);
    int before = 0;
    for (std::size_t i = 0; i < recording.frames.size(); ++i) {
      if (i == 5) before = launch->allocations;
      system.process(recording.frames[i]);
      system.render();
    }
    EXPECT_EQ(launch->allocations, before) << name(map);
  }
}

TEST(CudaBackendMemory, IsGivenBack) {
  const auto launch = std::make_shared<HostLaunch>(Order::forwards);
  {
    HostCudaBackend backend(launch);
    const Recording recording = synthetic_recording({40, 30}, 6);
    KinectFusion system = system_for(backend, recording, MapKind::bricks, true);
    for (const Frame& frame : recording.frames) system.process(frame);
    EXPECT_FALSE(launch->live.empty());
  }
  EXPECT_TRUE(launch->live.empty());
}

TEST_F(CudaBackend, TellsWhatMemoryItHolds) {
  const std::size_t before = backend.device_bytes().value();
  {
    const auto image = backend.make_image<float>({40, 30});
    EXPECT_EQ(backend.device_bytes(), before + 40 * 30 * sizeof(float));
    const Volume volume = backend.make_volume(MapKind::grid, {8, 8, 8}, {1, 1, 1});
    EXPECT_EQ(backend.device_bytes(), before + 40 * 30 * sizeof(float) + 8 * 8 * 8 * sizeof(Voxel));
  }
  EXPECT_EQ(backend.device_bytes(), before);
}

TEST_F(CudaBackend, SaysWhatDoesNotFit) {
  for (const MapKind map : {MapKind::grid, MapKind::bricks}) {
    EXPECT_THROW(backend.make_volume(map, {2048, 2048, 2048}, {1, 1, 1}), UnavailableError);
    EXPECT_THROW(backend.make_volume(map, {65536, 65536, 4096}, {1, 1, 1}), UnavailableError);
  }
  EXPECT_THROW(backend.make_image<float>({1 << 24, 1 << 24}), UnavailableError);
}

// ---------------------------------------------------------------- the alignment

struct Aligned {
  AlignResult result;
  bool blocks_agree = false;
};

/// Of frame 1 of a recording with the model of frame 0.
Aligned aligned(int processors, int pixels_wide) {
  const auto launch = std::make_shared<HostLaunch>(Order::forwards, processors);
  HostCudaBackend backend(launch);
  const Recording recording = synthetic_recording({pixels_wide, pixels_wide * 3 / 4}, 8);
  KinectFusion system = system_for(backend, recording, MapKind::bricks, true);
  Aligned last;
  FrameResult result;
  for (const Frame& frame : recording.frames) result = system.process(frame);
  last.result.T_volume_camera = result.T_start_camera;
  last.result.iterations = result.iterations;
  last.blocks_agree = launch->blocks_agree;
  EXPECT_TRUE(result.tracked);
  return last;
}

TEST(CudaAlign, IsTheSameInEveryBlockAndForAnyNumberOfThem) {
  const Aligned expected = aligned(1, 80);
  for (const int processors : {2, 7, 24}) {
    const Aligned found = aligned(processors, 80);
    EXPECT_TRUE(found.blocks_agree) << processors;
    EXPECT_EQ(found.result.iterations, expected.result.iterations);
    EXPECT_TRUE(found.result.T_volume_camera.isApprox(expected.result.T_volume_camera, 1e-6));
  }
}

// ---------------------------------------------------------------- a frame in one go

struct Advance : ::testing::TestWithParam<testing::MeetingCase> {};

TEST_P(Advance, DoesWhatTheSingleStepsDoWithOneWait) {
  const auto& [map, believed, due] = GetParam();
  HostCudaBackend one(std::make_shared<HostLaunch>(Order::forwards));
  Meeting single(one, map, believed, due);
  const AfterFrame expected = step_by_step(one, single);
  for (const Order order : {Order::forwards, Order::backwards}) {
    const auto launch = std::make_shared<HostLaunch>(order);
    HostCudaBackend two(launch);
    const Meeting meeting(two, map, believed, due);
    const int waits = launch->waits;
    const AdvanceResult advanced = two.advance(meeting.input);
    EXPECT_EQ(launch->waits, waits + 1);
    expect_same(meeting.now(two, advanced.aligned, advanced.tracked), expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Advance, testing::every_meeting(), testing::name_of_meeting);

TEST_F(CudaBackend, DoesNotBelieveAPoseThatIsNotFinite) {
  testing::expect_that_a_pose_is_finite(backend, MapKind::bricks);
}

TEST_F(CudaBackend, WaitsOnceForATrackedFrameAndOnceForItsPictures) {
  const Recording recording = synthetic_recording({80, 60}, 9);
  Measured measured;
  backend.observe(&measured);
  KinectFusion system = system_for(backend, recording, MapKind::bricks, true, &measured);
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    const int before = launch->waits;
    const bool tracked = system.process(recording.frames[i]).tracked;
    EXPECT_EQ(tracked, i >= 4);
    const int processed = launch->waits;
    system.render();
    if (!tracked) continue;
    EXPECT_EQ(processed, before + 1) << i;
    EXPECT_EQ(launch->waits, processed + 1) << i;
  }
  backend.observe(nullptr);
}

/// Where the last iterations were on a coarse level, its pixels are the whole.
TEST_F(CudaBackend, JudgesAnAlignmentByTheLevelThatItEndedOn) {
  Recording recording = synthetic_recording({80, 60}, 6);
  recording.parameters.pyramid_levels = {0, 8};
  recording.parameters.tracked_fraction = 0.5;
  KinectFusion system = system_for(backend, recording, MapKind::bricks, true);
  FrameResult last;
  for (const Frame& frame : recording.frames) last = system.process(frame);
  EXPECT_TRUE(last.tracked);
  EXPECT_GT(last.inlier_fraction, 0.5);
}

// ---------------------------------------------------------------- the bricks

/// Passing over free space loses nothing: on the host, where arithmetic is the reference's own,
/// not a bit.
TEST_F(CudaBackend, HasTheReferencesVoxelsAndSurfacesToTheBit) {
  SerialBackend serial;
  const Volume expected = fused(serial, MapKind::grid, 10);
  for (const MapKind map : {MapKind::grid, MapKind::bricks}) {
    const Volume found = fused(backend, map, 10);
    EXPECT_EQ(voxels_of(backend, found), voxels_of(serial, expected)) << name(map);
    for (int step = -2; step < 14; ++step) {
      const RaycastParameters view{to_rigid3f(view_at(step)),  camera, 0.2f, 4, 0.075f, 0.028f,
                                   step % 3 == 0 ? 1.0f : 0.8f};
      const auto seen = [&](Backend& b, const Volume& volume) {
        auto vertices = b.make_image<Float3>(size), normals = b.make_image<Float3>(size);
        b.raycast(vertices, normals, volume, view);
        return std::make_pair(downloaded(b, vertices), downloaded(b, normals));
      };
      EXPECT_EQ(seen(backend, found), seen(serial, expected)) << name(map) << " step " << step;
    }
  }
}

/// Bricks are worth having only when most of the work is not done.
TEST_F(CudaBackend, KeepsOnlyBricksWithASurface) {
  const Volume volume = fused(backend, MapKind::bricks, 4);
  const std::vector<Voxel> voxels = voxels_of(backend, volume);
  const Int3 bricks = cuda::bricks_along(resolution);
  std::vector<bool> has_surface(static_cast<std::size_t>(bricks.x * bricks.y * bricks.z));
  std::size_t i = 0;
  for (int z = 0; z < resolution.z; ++z) {
    for (int y = 0; y < resolution.y; ++y) {
      for (int x = 0; x < resolution.x; ++x) {
        const auto brick = static_cast<std::size_t>((z / 8 * bricks.y + y / 8) * bricks.x + x / 8);
        if (voxels[i++].tsdf != Voxel{}.tsdf) has_surface[brick] = true;
      }
    }
  }
  const auto& map = static_cast<const cuda::BrickStorage<HostLaunch>&>(*volume.storage).map();
  int kept = 0;
  for (std::size_t brick = 0; brick < has_surface.size(); ++brick) {
    const bool own = map.distance_planes[brick] != 0;
    kept += own ? 1 : 0;
    EXPECT_TRUE(own || !has_surface[brick]);
  }
  EXPECT_EQ(map.counters->distance_planes, kept + 1);
  EXPECT_LT(kept, static_cast<int>(has_surface.size()) / 2);
  EXPECT_LT(map.counters->varied, static_cast<int>(has_surface.size()) / 2);
}

// ---------------------------------------------------------------- the pyramid of depths

TEST(CudaDepthPyramid, BoundsEveryRectangle) {
  HostLaunch launch(Order::backwards);
  for (const Size image : {Size{1, 1}, Size{3, 70}, Size{64, 64}, Size{65, 63}, Size{200, 131}}) {
    Image<float> depth(image);
    std::uint32_t state = 1;
    for (float& value : depth) {
      state = state * 1664525u + 1013904223u;
      value = state >> 28 == 0 ? 0.0f : 0.5f + static_cast<float>(state >> 8) * 2e-7f;
    }
    cuda::BrickCounters counters{1, 2, 3};
    std::vector<cuda::DepthRange> tiles(
        static_cast<std::size_t>(cuda::DepthPyramid::first(image, cuda::DepthPyramid::levels)));
    const cuda::DepthPyramid pyramid{image, tiles.data()};
    const Size blocks = cuda::tiles_of(image, 64);
    launch.blocks(blocks.width * blocks.height,
                  cuda::BuildDepthPyramid{pyramid, depth.data(), &counters});
    EXPECT_EQ(counters.varied, 0);
    EXPECT_EQ(counters.distance_planes, 1);
    for (int i = 0; i < 300; ++i) {
      const auto next = [&](int count) {
        state = state * 1664525u + 1013904223u;
        return static_cast<int>(state >> 8) % count;
      };
      int x0 = next(image.width), x1 = next(image.width);
      int y0 = next(image.height), y1 = next(image.height);
      if (x0 > x1) std::swap(x0, x1);
      if (y0 > y1) std::swap(y0, y1);
      const cuda::DepthRange range = pyramid.range(x0, y0, x1, y1);
      float least = HUGE_VALF, greatest = 0;
      for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
          least = std::min(least, depth(x, y));
          greatest = std::max(greatest, depth(x, y));
        }
      }
      EXPECT_LE(range.least, least);
      EXPECT_GE(range.greatest, greatest);
    }
    const cuda::DepthRange all = pyramid.range(0, 0, image.width - 1, image.height - 1);
    EXPECT_EQ(all.greatest, *std::max_element(depth.begin(), depth.end()));
    EXPECT_EQ(all.least, *std::min_element(depth.begin(), depth.end()));
  }
}

}  // namespace
}  // namespace slambench
