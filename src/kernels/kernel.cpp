// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "kernels/kernel.h"

#include "kernels/types.h"

namespace slambench {
namespace {

double pixels(const ProblemSize& p) { return static_cast<double>(p.image.count()); }
double input_pixels(const ProblemSize& p) { return static_cast<double>(p.input.count()); }
double voxels(const ProblemSize& p) {
  return static_cast<double>(p.volume.x) * p.volume.y * p.volume.z;
}

constexpr double f32 = sizeof(float);
constexpr double vec = sizeof(Float3);
constexpr double voxel = sizeof(Voxel);
constexpr double track_row = sizeof(TrackData);
/// Trilinear samples of a ray through a room, counted on ICL-NUIM kt3 at 256^3 in 5 m.
constexpr double samples_per_ray = 36;
/// Eight voxels read, seven linear interpolations of three operations, six for the coordinates.
constexpr double sample_bytes = 8 * voxel, sample_flops = 27;
/// A gradient: 32 voxels, three trilinear interpolations of differences.
constexpr double gradient_flops = 3 * (8 + 21) + 12;

Cost acquire(const ProblemSize& p) { return {input_pixels(p) * 2, 0}; }
Cost mm2meters(const ProblemSize& p) { return {pixels(p) * (2 + f32), pixels(p)}; }
Cost bilateral_filter(const ProblemSize& p) {
  const double side = 2 * p.radius + 1;
  return {pixels(p) * 2 * f32, pixels(p) * (side * side * 9 + 1)};
}
/// `image` is the larger of the two.
Cost half_sample(const ProblemSize& p) { return {pixels(p) * f32 * 1.25, pixels(p) * 2.25}; }
Cost depth2vertex(const ProblemSize& p) { return {pixels(p) * (f32 + vec), pixels(p) * 6}; }
Cost vertex2normal(const ProblemSize& p) { return {pixels(p) * 2 * vec, pixels(p) * 25}; }
Cost track(const ProblemSize& p) { return {pixels(p) * (4 * vec + track_row), pixels(p) * 70}; }
Cost reduce(const ProblemSize& p) { return {pixels(p) * track_row, pixels(p) * 2 * 28}; }
Cost solve(const ProblemSize&) { return {28 * sizeof(double), 6 * 6 * 6 * 10}; }
/// One iteration, nothing stored.
Cost align(const ProblemSize& p) { return {pixels(p) * 4 * vec, pixels(p) * (70 + 2 * 28)}; }
/// Every voxel is visited and projected; about a tenth is changed.
Cost integrate(const ProblemSize& p) {
  return {voxels(p) * voxel * 1.1 + pixels(p) * f32, voxels(p) * 18};
}
Cost raycast(const ProblemSize& p) {
  return {pixels(p) * (2 * vec + sample_bytes),
          pixels(p) * (samples_per_ray * sample_flops + gradient_flops)};
}
Cost render_depth(const ProblemSize& p) { return {pixels(p) * (f32 + 4), pixels(p) * 10}; }
Cost render_track(const ProblemSize& p) { return {pixels(p) * (4 + 4), 0}; }
Cost render_volume(const ProblemSize& p) {
  return {pixels(p) * (4 + sample_bytes),
          pixels(p) * (samples_per_ray * sample_flops + gradient_flops + 20)};
}
Cost init_volume(const ProblemSize& p) { return {voxels(p) * voxel, 0}; }
Cost generate_gaussian(const ProblemSize& p) {
  return {(2.0 * p.radius + 1) * f32, (2.0 * p.radius + 1) * 4};
}

constexpr std::array<KernelInfo, kernel_count> table{{
    {Kernel::acquire, "acquire", "acquire", Stage::acquire, "n/a", "pointer", "2D", acquire,
     "reads the next RGB-D frame"},
    {Kernel::mm2meters, "mm2meters", "mm2meters", Stage::preprocess, "gather", "2D", "2D",
     mm2meters, "converts depth to metres and sub-samples it to the computation size"},
    {Kernel::bilateral_filter, "bilateral_filter", "bilateralFilter", Stage::preprocess, "stencil",
     "2D", "2D", bilateral_filter, "smooths the depth image and keeps its edges"},
    {Kernel::half_sample, "half_sample", "halfSample", Stage::track, "stencil", "2D", "2D",
     half_sample, "halves the depth image for the next level of the pyramid"},
    {Kernel::depth2vertex, "depth2vertex", "depth2vertex", Stage::track, "map", "2D", "2D",
     depth2vertex, "back-projects every pixel to a point"},
    {Kernel::vertex2normal, "vertex2normal", "vertex2normal", Stage::track, "stencil", "2D", "2D",
     vertex2normal, "takes normals from neighbouring points"},
    {Kernel::track, "track", "track", Stage::track, "map/gather", "2D", "2D", track,
     "associates live points with the model and writes each one's point-to-plane row"},
    {Kernel::reduce, "reduce", "reduce", Stage::track, "reduction", "2D", "6x6", reduce,
     "sums the rows into the normal equations"},
    {Kernel::solve, "solve", "solve", Stage::track, "sequential", "6x6", "6x1", solve,
     "solves the normal equations for the change of pose"},
    {Kernel::align, "align", "", Stage::track, "map/gather + reduction", "2D", "6x1", align,
     "track, reduce and solve fused, on backends that offer it"},
    {Kernel::integrate, "integrate", "integrate", Stage::integrate, "map/gather", "2D/3D", "3D",
     integrate, "averages the depth image into the volume"},
    {Kernel::raycast, "raycast", "raycast", Stage::raycast, "search/stencil", "2D/3D", "2D",
     raycast, "finds the surface along every pixel's ray: the model for tracking"},
    {Kernel::render_depth, "render_depth", "renderDepth", Stage::render, "map", "2D", "2D",
     render_depth, "colours the depth image"},
    {Kernel::render_track, "render_track", "renderTrack", Stage::render, "map", "2D", "2D",
     render_track, "colours the outcome of tracking"},
    {Kernel::render_volume, "render_volume", "renderVolume", Stage::render, "search/stencil", "3D",
     "2D", render_volume, "shades the reconstructed surface"},
    {Kernel::init_volume, "init_volume", "initVolume", Stage::init, "map", "3D", "3D", init_volume,
     "empties the volume, once at start"},
    {Kernel::generate_gaussian, "generate_gaussian", "generateGaussian", Stage::init, "map", "1D",
     "1D", generate_gaussian, "tabulates the bilateral filter's spatial weights, once at start"},
}};

constexpr bool rows_follow_the_enum() {
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (static_cast<std::size_t>(table[i].kernel) != i) return false;
  }
  return true;
}
static_assert(rows_follow_the_enum());

constexpr std::array<std::string_view, stage_count> stage_names = {
    "acquire", "preprocess", "track", "integrate", "raycast", "render", "init"};

}  // namespace

std::span<const KernelInfo, kernel_count> kernel_table() { return table; }
const KernelInfo& info(Kernel kernel) { return table[static_cast<std::size_t>(kernel)]; }
std::string_view name(Kernel kernel) { return info(kernel).name; }
std::string_view name(Stage stage) { return stage_names[static_cast<std::size_t>(stage)]; }

std::optional<Kernel> kernel_from_name(std::string_view name) {
  for (const auto& row : table) {
    if (row.name == name) return row.kernel;
  }
  return std::nullopt;
}

}  // namespace slambench
