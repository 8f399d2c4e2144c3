// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "backends/host/host_backend.h"
#include "backends/serial/serial_backend.h"

namespace slambench {

/// What is wrong with a kernel; the check of that kernel has to find it.
enum class Defect {
  none,
  value,      ///< a single result is off
  unwritten,  ///< the last result is not computed
  overrun,    ///< one more is
  input,      ///< an input is changed
  seen,       ///< of render_volume: rays that met nothing in what was seen go no farther
  unsteady,   ///< another result every time, within tolerance
  throws,
};

/// The serial backend under another name, of which one kernel has a defect.
class BrokenBackend final : public HostBackend {
 public:
  BrokenBackend(std::optional<Kernel> broken, Defect defect)
      : broken_(broken), defect_(broken ? defect : Defect::none) {}

  std::string_view name() const override { return "broken"; }
  bool supports(Kernel kernel, MapKind map) const override {
    return kernel == Kernel::align ? map == MapKind::grid : serial_.supports(kernel, map);
  }

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
  bool is(Kernel kernel, Defect defect) const { return broken_ == kernel && defect_ == defect; }
  void throw_if(Kernel kernel) const;
  /// After the kernel has computed correctly.
  template <class T, class In>
  void spoil(Kernel kernel, DeviceImage<T>& output, const DeviceImage<In>& input);
  template <class T>
  void spoil(Kernel kernel, DeviceImage<T>& output);

  const std::optional<Kernel> broken_;
  const Defect defect_;
  SerialBackend serial_;
};

}  // namespace slambench
