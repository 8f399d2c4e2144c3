// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "backends/host/host_backend.h"

namespace slambench::testing {

/// A backend that computes nothing: it keeps what the pipeline asked for, and answers `align` as
/// the test says.
class RecordingBackend final : public HostBackend {
 public:
  std::string_view name() const override { return "recording"; }
  bool supports(Kernel kernel, MapKind map) const override {
    return missing.count(kernel) == 0 && maps.count(map) > 0;
  }
  void finish() override { ++finished; }
  bool advances_in_one_go() const override { return in_one_go; }

  std::set<Kernel> missing;
  std::set<MapKind> maps = {MapKind::grid, MapKind::bricks};
  AlignResult answer;      ///< of the next align or advance
  bool in_one_go = false;  ///< offers advance as what to use
  bool believed = true;    ///< what advance says of the alignment

  int finished = 0;
  Size gaussian_size;
  float gaussian_sigma_px = 0, units_per_m = 0, range_sigma_m = 0;
  std::vector<float> half_ranges_m;
  std::vector<Size> half_sizes;
  std::vector<Intrinsics> level_cameras;
  std::optional<AlignInput> align_input;  ///< its pointers are the pipeline's
  std::optional<AdvanceInput> advance_input;
  double condition = 0;
  /// What mm2meters wrote and what integrate read.
  const DeviceImage<float>*metric_depth = nullptr, *integrated_depth = nullptr;
  Volume made;  ///< resolution and size only
  std::optional<IntegrateParameters> integrated;
  std::optional<RaycastParameters> raycasted, rendered;
  std::vector<SeenSurface> seen;  ///< what volumes were drawn from
  ShadeParameters shading;
  float render_near_m = 0, render_far_m = 0;
  int raycasts = 0, integrations = 0, volume_pictures = 0;

 protected:
  std::unique_ptr<Storage> allocate_volume(MapKind map, Int3 resolution, Float3 size_m) override {
    made.map = map;
    made.resolution = resolution;
    made.size_m = size_m;
    return HostBackend::allocate_volume(map, resolution, size_m);
  }
  void do_generate_gaussian(DeviceImage<float>& weights, float sigma_px) override {
    gaussian_size = weights.size;
    gaussian_sigma_px = sigma_px;
  }
  void do_init_volume(Volume&) override {}
  void do_mm2meters(DeviceImage<float>& depth_m, const DeviceImage<std::uint16_t>&,
                    float units) override {
    metric_depth = &depth_m;
    units_per_m = units;
  }
  void do_bilateral_filter(DeviceImage<float>&, const DeviceImage<float>&,
                           const DeviceImage<float>&, float sigma_m) override {
    range_sigma_m = sigma_m;
  }
  void do_half_sample(DeviceImage<float>& half_m, const DeviceImage<float>&,
                      float range_m) override {
    half_ranges_m.push_back(range_m);
    half_sizes.push_back(half_m.size);
  }
  void do_depth2vertex(DeviceImage<Float3>&, const DeviceImage<float>&,
                       Intrinsics camera) override {
    level_cameras.push_back(camera);
  }
  void do_vertex2normal(DeviceImage<Float3>&, const DeviceImage<Float3>&) override {}
  void do_track(DeviceImage<TrackData>&, const DeviceImage<Float3>&, const DeviceImage<Float3>&,
                const DeviceImage<Float3>&, const DeviceImage<Float3>&,
                const TrackParameters&) override {}
  Reduction do_reduce(const DeviceImage<TrackData>&) override { return {}; }
  void do_integrate(Volume&, const DeviceImage<float>& depth_m,
                    const IntegrateParameters& parameters) override {
    integrated_depth = &depth_m;
    ++integrations;
    integrated = parameters;
  }
  void do_raycast(DeviceImage<Float3>&, DeviceImage<Float3>&, const Volume&,
                  const RaycastParameters& parameters) override {
    ++raycasts;
    raycasted = parameters;
  }
  void do_render_depth(DeviceImage<Rgba8>&, const DeviceImage<float>&, float near_m,
                       float far_m) override {
    render_near_m = near_m;
    render_far_m = far_m;
  }
  void do_render_track(DeviceImage<Rgba8>&, const DeviceImage<TrackData>&) override {}
  void do_render_volume(DeviceImage<Rgba8>&, const Volume&, const RaycastParameters& view,
                        const ShadeParameters& shade_parameters) override {
    ++volume_pictures;
    rendered = view;
    shading = shade_parameters;
  }
  void do_render_seen(DeviceImage<Rgba8>& image, const Volume& volume,
                      const RaycastParameters& view, const ShadeParameters& shade_parameters,
                      const SeenSurface& surface) override {
    seen.push_back(surface);
    do_render_volume(image, volume, view, shade_parameters);
  }
  AlignResult do_align(const AlignInput& input, double solve_condition) override {
    align_input = input;
    condition = solve_condition;
    return answer;
  }
  AdvanceResult do_advance(const AdvanceInput& input) override {
    advance_input = input;
    return {answer, believed};
  }
};

}  // namespace slambench::testing
