// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <vector>

#include "backends/host/host_backend.h"
#include "backends/openmp/image_kernels.h"
#include "backends/openmp/integrate_kernels.h"
#include "backends/openmp/parallel.h"
#include "backends/openmp/raycast_kernels.h"
#include "backends/openmp/track_kernels.h"

namespace slambench {

/// The host at its limit: threads over rows and bricks, SIMD inside. Every kernel rounds as the
/// reference does, except for the exponential of the bilateral filter, the order of sums in the
/// reduction and the factors of the solve, all the same on any number of threads.
class OpenmpBackend final : public HostBackend {
 public:
  /// 0 threads: one per core that this process may use.
  explicit OpenmpBackend(int threads) : parallel_(threads) {}

  int threads() const override { return parallel_.threads(); }
  std::string instruction_set() const override { return kernels_instruction_set(); }

  std::string_view name() const override { return "openmp"; }
  bool supports(Kernel kernel, MapKind map) const override;

 protected:
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
  Twist do_solve(const Reduction& reduction, double condition) override;
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
  /// f(rows) over all rows of an image in parallel.
  template <class F>
  void for_rows(int height, const F& f) const;
  /// The sums of f(band) over the bands of an image, in their order.
  template <class F>
  Reduction sum_bands(Size size, const F& f);
  void integrate_bricks(BrickVolume& volume, const IntegrateInput& input);
  /// raycast in parallel.
  void march(RaycastOutput output, const Volume& volume, const RaycastParameters& parameters);
  /// Images of its own for march().
  RaycastOutput scratch_surface(Size size);
  void shade(DeviceImage<Rgba8>& image, const ShadeParameters& shading, const Float3* vertices,
             const Float3* normals) const;

  Parallel parallel_;
  std::vector<Reduction> bands_;                ///< of the reduction in progress
  DepthPyramid depth_;                          ///< of the integration in progress
  std::vector<std::vector<BrickWork>> slices_;  ///< what it has to do, per slice of bricks
  std::vector<BrickWork> work_;
  StartDepths start_;                                 ///< of the raycast in progress
  std::vector<Float3> seen_vertices_, seen_normals_;  ///< of the render_volume in progress
};

}  // namespace slambench
