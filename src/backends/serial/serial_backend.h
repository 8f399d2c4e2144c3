// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "backends/host/host_backend.h"

namespace slambench {

/// The reference: one thread, one loop a kernel over the shared per-element functions. It defines
/// what "correct" means and stays obvious on purpose.
class SerialBackend final : public HostBackend {
 public:
  std::string_view name() const override { return "serial"; }
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
  void do_integrate(Volume& volume, const DeviceImage<float>& depth_m,
                    const IntegrateParameters& parameters) override;
  void do_raycast(DeviceImage<Float3>& vertices, DeviceImage<Float3>& normals, const Volume& volume,
                  const RaycastParameters& parameters) override;
  void do_render_depth(DeviceImage<Rgba8>& image, const DeviceImage<float>& depth_m, float near_m,
                       float far_m) override;
  void do_render_track(DeviceImage<Rgba8>& image, const DeviceImage<TrackData>& rows) override;
  void do_render_volume(DeviceImage<Rgba8>& image, const Volume& volume,
                        const RaycastParameters& view, const ShadeParameters& shading) override;
};

}  // namespace slambench
