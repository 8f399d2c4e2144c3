// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "backends/opencl/brick_map.h"
#include "backends/opencl/program.h"
#include "backends/opencl/queue.h"

namespace slambench {

/// Any device of OpenCL 1.2. Kernels round as the reference does where the device divides exactly,
/// except for the exponential of the bilateral filter and the order of sums in the reduction.
class OpenclBackend final : public Backend {
 public:
  OpenclBackend(const OpenclDevice& device, const OpenclParameters& parameters);

  std::string_view name() const override { return "opencl"; }
  std::string device() const override { return queue_.device().name; }
  std::string driver() const override {
    return queue_.device().platform + " " + queue_.device().driver;
  }
  std::optional<std::size_t> device_bytes() const override;
  int busy_processors() const override {
    const OpenclDevice& device = queue_.device();
    return device.is_processor
               ? static_cast<int>(device.device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>())
               : 1;
  }
  bool supports(Kernel kernel, MapKind map) const override;
  bool times_itself() const override { return true; }
  void finish() override { queue_.finish(observer()); }
  void read_volume(std::vector<Voxel>& destination, const Volume& source) override;
  void write_volume(Volume& destination, const std::vector<Voxel>& source) override;
  std::size_t volume_bytes(const Volume& volume) const override;

 protected:
  std::unique_ptr<Storage> allocate(std::size_t bytes) override;
  void upload(Storage& destination, const void* source, std::size_t bytes) override;
  void download(void* destination, const Storage& source, std::size_t bytes) override;
  std::unique_ptr<Storage> allocate_volume(MapKind map, Int3 resolution, Float3 size_m) override;

  void do_generate_gaussian(DeviceImage<float>& weights, float sigma_px) override;
  void do_init_volume(Volume& volume) override;
  void do_mm2meters(DeviceImage<float>& depth_m, const DeviceImage<std::uint16_t>& depth,
                    float units_per_m) override;
  void do_bilateral_filter(DeviceImage<float>& filtered_m, const DeviceImage<float>& depth_m,
                           const DeviceImage<float>& gaussian, float range_sigma_m) override;
  void do_half_sample(DeviceImage<float>& half_m, const DeviceImage<float>& depth_m,
                      float range_m) override;
  void do_depth2vertex(DeviceImage<Float3>& vertices, const DeviceImage<float>& depth_m,
                       Intrinsics camera) override;
  void do_vertex2normal(DeviceImage<Float3>& normals, const DeviceImage<Float3>& vertices) override;
  void do_track(DeviceImage<TrackData>& rows, const DeviceImage<Float3>& vertices,
                const DeviceImage<Float3>& normals, const DeviceImage<Float3>& model_vertices,
                const DeviceImage<Float3>& model_normals,
                const TrackParameters& parameters) override;
  Reduction do_reduce(const DeviceImage<TrackData>& rows) override;
  AlignResult do_align(const AlignInput& input, double condition) override;
  bool fuses_align() const override { return true; }
  void do_integrate(Volume& volume, const DeviceImage<float>& depth_m,
                    const IntegrateParameters& parameters) override;
  void do_raycast(DeviceImage<Float3>& vertices, DeviceImage<Float3>& normals, const Volume& volume,
                  const RaycastParameters& parameters) override;
  void do_render_depth(DeviceImage<Rgba8>& image, const DeviceImage<float>& depth_m, float near_m,
                       float far_m) override;
  void do_render_track(DeviceImage<Rgba8>& image, const DeviceImage<TrackData>& rows) override;
  void do_render_volume(DeviceImage<Rgba8>& image, const Volume& volume,
                        const RaycastParameters& view, const ShadeParameters& shading) override;
  void do_render_seen(DeviceImage<Rgba8>& image, const Volume& volume,
                      const RaycastParameters& view, const ShadeParameters& shading,
                      const SeenSurface& seen) override;

 private:
  /// The queue, which measures transfers from now on if anybody wants to know.
  Queue& queue();
  void begin(Kernel kernel) { queue().begin(kernel); }
  void integrate_bricks(BrickMap& map, const Volume& volume, const DeviceImage<float>& depth_m,
                        const IntegrateParameters& parameters);
  /// Launches raycast into two buffers of three floats a pixel, for all or where there is no
  /// surface in them yet.
  void march(const cl::Buffer& vertices, const cl::Buffer& normals, Size size, const Volume& volume,
             const RaycastParameters& parameters, bool only_misses = false);
  /// Launches render_volume on such buffers.
  void launch_shading(DeviceImage<Rgba8>& image, const cl::Buffer& vertices,
                      const cl::Buffer& normals, const ShadeParameters& shading);
  /// Launches start_depths; the edge of the tiles.
  int find_start_depths(const BrickMap& map, const Volume& volume, Size size,
                        const RaycastParameters& view);
  /// Launches track as its own or within `align`.
  void launch_track(DeviceImage<TrackData>& rows, const DeviceImage<Float3>& vertices,
                    const DeviceImage<Float3>& normals, const DeviceImage<Float3>& model_vertices,
                    const DeviceImage<Float3>& model_normals, const TrackParameters& parameters);
  /// Room for the sums of so many groups.
  const cl::Buffer& partial_sums(std::size_t groups);
  /// Adds up the groups' sums and waits for them.
  Reduction total_of(std::size_t groups);
  /// A buffer that is kept and grows when needed.
  const cl::Buffer& scratch(DeviceMemory& buffer, std::size_t bytes);

  mutable Queue queue_;
  Programs programs_;
  DeviceMemory partial_, total_;       ///< sums of groups, and of all
  DeviceMemory tiles_, start_depths_;  ///< of the integration and of the raycast in progress
  DeviceMemory seen_vertices_, seen_normals_;  ///< of render_volume
};

}  // namespace slambench
