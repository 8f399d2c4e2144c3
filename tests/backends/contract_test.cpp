// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "backends/registry.h"
#include "backends/serial/serial_backend.h"
#include "core/error.h"
#include "support/device_images.h"
#include "support/random_images.h"

namespace slambench {
namespace {

class Contract : public ::testing::Test {
 protected:
  SerialBackend backend_;
};

TEST_F(Contract, SerialOffersEveryKernelButTheFusedOne) {
  for (const KernelInfo& row : kernel_table()) {
    const bool expected = row.kernel != Kernel::acquire && row.kernel != Kernel::align;
    EXPECT_EQ(backend_.supports(row.kernel, MapKind::grid), expected) << row.name;
  }
  EXPECT_EQ(backend_.name(), "serial");
  EXPECT_FALSE(backend_.times_itself());
  EXPECT_EQ(name(MapKind::grid), "grid");
}

TEST_F(Contract, SerialDoesNotAdvanceAFrameInOneGo) {
  EXPECT_FALSE(backend_.advances_in_one_go());
  EXPECT_THROW(backend_.advance({}), std::invalid_argument);
}

TEST_F(Contract, SerialChoosesNoInstructionSetAndLacksNothing) {
  EXPECT_EQ(backend_.instruction_set(), "");
  EXPECT_EQ(backend_.missing_kernel(MapKind::grid), std::nullopt);
  EXPECT_EQ(backend_.missing_kernel(MapKind::bricks), std::nullopt);
}

TEST_F(Contract, ImagesComeBackAsWritten) {
  const Image<float> image = testing::random_depth_m({7, 3}, 1);
  EXPECT_EQ(testing::downloaded(backend_, testing::uploaded(backend_, image)), image);
}

TEST_F(Contract, WritingNeedsTheImagesSize) {
  auto image = backend_.make_image<float>({7, 3});
  EXPECT_THROW(backend_.write(image, Image<float>({3, 7})), std::invalid_argument);
}

TEST_F(Contract, AVolumeIsMadeEmpty) {
  Volume volume = backend_.make_volume(MapKind::grid, {3, 4, 5}, {1, 2, 3});
  EXPECT_EQ(volume.resolution, (Int3{3, 4, 5}));
  EXPECT_EQ(volume.size_m, (Float3{1, 2, 3}));
  EXPECT_EQ(backend_.volume_bytes(volume), 3u * 4 * 5 * 4);
  std::vector<Voxel> voxels;
  backend_.read_volume(voxels, volume);
  EXPECT_EQ(voxels, std::vector<Voxel>(3 * 4 * 5));
}

TEST_F(Contract, InitVolumeForgetsEverything) {
  Volume volume = backend_.make_volume(MapKind::grid, {3, 4, 5}, {1, 2, 3});
  std::vector<Voxel> voxels(3 * 4 * 5, Voxel{-5, 7});
  backend_.write_volume(volume, voxels);
  std::vector<Voxel> read;
  backend_.read_volume(read, volume);
  EXPECT_EQ(read, voxels);
  backend_.init_volume(volume);
  backend_.read_volume(read, volume);
  EXPECT_EQ(read, std::vector<Voxel>(3 * 4 * 5));
}

TEST_F(Contract, WritingAVolumeNeedsEveryVoxel) {
  Volume volume = backend_.make_volume(MapKind::grid, {3, 4, 5}, {1, 2, 3});
  EXPECT_THROW(backend_.write_volume(volume, std::vector<Voxel>(59)), std::invalid_argument);
}

TEST_F(Contract, AVolumeHasVoxelsAndExtent) {
  for (const Int3 resolution : {Int3{0, 4, 4}, Int3{4, 0, 4}, Int3{4, 4, 0}, Int3{-4, 4, 4}}) {
    EXPECT_THROW(backend_.make_volume(MapKind::grid, resolution, {1, 1, 1}), std::invalid_argument);
  }
  for (const Float3 size_m :
       {Float3{0, 1, 1}, Float3{1, 0, 1}, Float3{1, 1, 0}, Float3{1, -1, 1}}) {
    EXPECT_THROW(backend_.make_volume(MapKind::grid, {4, 4, 4}, size_m), std::invalid_argument);
  }
}

TEST_F(Contract, WhatDoesNotFitIsUnavailable) {
  EXPECT_THROW(backend_.make_volume(MapKind::grid, {65536, 65536, 4096}, {1, 1, 1}),
               UnavailableError);
  EXPECT_THROW(backend_.make_image<float>({1 << 24, 1 << 24}), UnavailableError);
}

TEST_F(Contract, TheGaussianIsOneRowOfOddLength) {
  for (const Size size : {Size{4, 1}, Size{5, 2}, Size{0, 1}}) {
    auto weights = backend_.make_image<float>(size);
    EXPECT_THROW(backend_.generate_gaussian(weights, 4), std::invalid_argument);
  }
}

/// Names of what began and ended, in order.
class Journal : public Observer {
 public:
  void stage_begin(Stage stage) override { add("+", name(stage)); }
  void stage_end(Stage stage) override { add("-", name(stage)); }
  void in_one_go_begin() override { add("+", "in one go"); }
  void in_one_go_end() override { add("-", "in one go"); }
  void kernel_begin(Kernel kernel) override { add("+", name(kernel)); }
  void kernel_end(Kernel kernel) override { add("-", name(kernel)); }
  void kernel_measured(Kernel kernel, double) override { add("=", name(kernel)); }
  void transfer_measured(Transfer direction, std::size_t, double) override {
    add("=", name(direction));
  }
  std::vector<std::string> entries;

 private:
  void add(const char* sign, std::string_view word) { entries.push_back(sign + std::string(word)); }
};

TEST_F(Contract, EveryKernelIsReportedAroundItsCall) {
  Journal journal;
  backend_.observe(&journal);
  const Size size{4, 4};
  auto gaussian = backend_.make_image<float>({3, 1});
  auto raw = backend_.make_image<std::uint16_t>(size);
  auto depth = backend_.make_image<float>(size), filtered = backend_.make_image<float>(size);
  auto half = backend_.make_image<float>({2, 2});
  auto vertices = backend_.make_image<Float3>(size), normals = backend_.make_image<Float3>(size);
  auto rows = backend_.make_image<TrackData>(size);
  auto picture = backend_.make_image<Rgba8>(size);
  const Intrinsics camera{4, 4, 2, 2};
  const RaycastParameters view{{}, camera, 0.4f, 4, 0.1f, 0.05f, 0.8f};

  Volume volume = backend_.make_volume(MapKind::grid, {4, 4, 4}, {1, 1, 1});
  backend_.generate_gaussian(gaussian, 4);
  backend_.mm2meters(depth, raw, 1000);
  backend_.bilateral_filter(filtered, depth, gaussian, 0.1f);
  backend_.half_sample(half, depth, 0.3f);
  backend_.depth2vertex(vertices, depth, camera);
  backend_.vertex2normal(normals, vertices);
  backend_.track(rows, vertices, normals, vertices, normals, {{}, {}, camera, 0.1f, 0.8f});
  const Reduction sum = backend_.reduce(rows);
  backend_.solve(sum, 1e6);
  backend_.integrate(volume, depth, {{}, camera, 0.1f, 100, 0.0001f});
  backend_.raycast(vertices, normals, volume, view);
  backend_.render_depth(picture, depth, 0.4f, 4);
  backend_.render_track(picture, rows);
  backend_.render_volume(picture, volume, view, {});
  backend_.finish();
  backend_.observe(nullptr);
  backend_.reduce(rows);

  std::vector<std::string> expected;
  for (const std::string word :
       {"init_volume", "generate_gaussian", "mm2meters", "bilateral_filter", "half_sample",
        "depth2vertex", "vertex2normal", "track", "reduce", "solve", "integrate", "raycast",
        "render_depth", "render_track", "render_volume"}) {
    expected.push_back("+" + word);
    expected.push_back("-" + word);
  }
  EXPECT_EQ(journal.entries, expected);
}

// --- the registry --------------------------------------------------------------------------------

TEST(Registry, CreatesBackendsByTheirNames) {
  for (const BackendEntry& entry : backend_table()) {
    EXPECT_FALSE(entry.sentence.empty());
    if (!entry.availability().available) {
      EXPECT_FALSE(entry.availability().reason.empty()) << entry.name;
      EXPECT_THROW(create_backend(entry.name, {}), UnavailableError) << entry.name;
      continue;
    }
    EXPECT_FALSE(entry.devices().empty()) << entry.name;
    EXPECT_EQ(create_backend(entry.name, {})->name(), entry.name);
  }
}

TEST(Registry, NamesTheKnownOnesForAnUnknown) {
  try {
    create_backend("abacus", {});
    FAIL() << "nothing was thrown";
  } catch (const UsageError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("'abacus'"), std::string::npos) << message;
    EXPECT_NE(message.find("serial"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace slambench
