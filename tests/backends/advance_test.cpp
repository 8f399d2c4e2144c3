// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "backends/registry.h"
#include "slam/recording_backend.h"
#include "support/advance.h"

/// A frame from its alignment to the next model, on every backend that is available.
namespace slambench {
namespace {

using testing::AfterFrame;
using testing::expect_same;
using testing::Meeting;
using testing::step_by_step;
using testing::voxels_of;

void on_every_backend(MapKind map, const std::function<void(Backend&)>& test) {
  for (const BackendEntry& entry : backend_table()) {
    if (!entry.availability().available) continue;
    const std::unique_ptr<Backend> backend = create_backend(entry.name, {});
    SCOPED_TRACE(entry.name);
    if (!backend->missing_kernel(map)) test(*backend);
  }
}

struct Advance : ::testing::TestWithParam<testing::MeetingCase> {};

TEST_P(Advance, DoesWhatTheSingleStepsDo) {
  const auto& [map, believed, due] = GetParam();
  on_every_backend(map, [&, map = map, believed = believed, due = due](Backend& backend) {
    Meeting single(backend, map, believed, due);
    const std::vector<Voxel> before = voxels_of(backend, single.volume);
    const AfterFrame expected = step_by_step(backend, single);
    EXPECT_EQ(expected.tracked, believed);
    EXPECT_EQ(expected.voxels != before, believed && due);
    const Meeting meeting(backend, map, believed, due);
    const AdvanceResult advanced = backend.advance(meeting.input);
    expect_same(meeting.now(backend, advanced.aligned, advanced.tracked), expected);
  });
}

INSTANTIATE_TEST_SUITE_P(Every, Advance, testing::every_meeting(), testing::name_of_meeting);

TEST(AdvanceJudges, NoPoseThatIsNotFiniteToBeBelieved) {
  on_every_backend(MapKind::grid, [](Backend& backend) {
    testing::expect_that_a_pose_is_finite(backend, MapKind::grid);
  });
}

/// Counts what is told of each kernel.
struct Told : Observer {
  void stage_begin(Stage) override {}
  void stage_end(Stage) override {}
  void in_one_go_begin() override {}
  void in_one_go_end() override {}
  void kernel_begin(Kernel) override {}
  void kernel_end(Kernel kernel) override { ++kernels[kernel]; }
  void kernel_measured(Kernel kernel, double) override { ++kernels[kernel]; }
  void transfer_measured(Transfer, std::size_t, double) override {}
  std::map<Kernel, int> kernels;
};

TEST(AdvanceTells, OfEveryKernelByItsEnd) {
  on_every_backend(MapKind::grid, [](Backend& backend) {
    Meeting meeting(backend, MapKind::grid, true, true);
    backend.finish();
    Told told;
    backend.observe(&told);
    const AlignResult aligned = backend.advance(meeting.input).aligned;
    backend.observe(nullptr);
    EXPECT_EQ(told.kernels[Kernel::integrate], 1);
    EXPECT_EQ(told.kernels[Kernel::raycast], 1);
    EXPECT_EQ(told.kernels[Kernel::align] + told.kernels[Kernel::solve],
              told.kernels[Kernel::align] > 0 ? 1 : aligned.iterations[0]);
  });
}

/// Before a backend is asked for it: one with steps of its own need not look.
TEST(AdvanceRefuses, WhatDoesNotFit) {
  testing::RecordingBackend backend;
  const Meeting meeting(backend, MapKind::grid, true, true);
  const auto refuses = [&](const std::function<void(AdvanceInput*)>& spoil) {
    AdvanceInput input = meeting.input;
    spoil(&input);
    EXPECT_THROW(backend.advance(input), std::invalid_argument);
    EXPECT_FALSE(backend.advance_input.has_value());
  };
  DeviceImage<Float3> other = backend.make_image<Float3>({3, 3});
  refuses([](AdvanceInput* input) { *input = {}; });
  refuses([](AdvanceInput* input) { input->align.rows.clear(); });
  refuses([](AdvanceInput* input) { input->volume = nullptr; });
  refuses([](AdvanceInput* input) { input->depth_m = nullptr; });
  refuses([](AdvanceInput* input) { input->model_vertices = nullptr; });
  refuses([](AdvanceInput* input) { input->model_normals = nullptr; });
  refuses([&](AdvanceInput* input) { input->model_normals = &other; });
}

}  // namespace
}  // namespace slambench
