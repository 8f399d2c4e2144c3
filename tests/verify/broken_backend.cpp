// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "verify/broken_backend.h"

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace slambench {
namespace {

void disturb(float* value) { *value += 0.01f; }
void disturb(Float3* value) { value->y += 0.1f; }
void disturb(Rgba8* value) { value->g = static_cast<std::uint8_t>(value->g ^ 0x40u); }
void disturb(TrackData* value) {
  value->outcome = value->outcome == TrackOutcome::ok ? TrackOutcome::too_far : TrackOutcome::ok;
}
void disturb(Voxel* value) { value->tsdf = static_cast<std::int16_t>(value->tsdf - 100); }

/// The least that can be told apart.
void stir(float* value) { *value = std::nextafter(*value, 100.0f); }
void stir(Float3* value) { stir(&value->z); }
void stir(Rgba8*) {}
void stir(TrackData* value) { stir(&value->error); }

/// Differs from call to call, and from instance to instance.
bool another_time() {
  static bool odd = false;
  odd = !odd;
  return odd;
}

}  // namespace

void BrokenBackend::throw_if(Kernel kernel) const {
  if (is(kernel, Defect::throws)) throw std::runtime_error("the device is lost");
}

template <class T>
void BrokenBackend::spoil(Kernel kernel, DeviceImage<T>& output) {
  throw_if(kernel);
  if (broken_ != kernel) return;
  T* const out = pixels(output);
  const std::size_t count = output.size.count();
  // More pixels than a tolerance lets pass.
  const std::size_t some = count / 100 + 1;
  for (std::size_t i = 0; i < some; ++i) {
    if (defect_ == Defect::value) disturb(&out[count - 1 - i]);
  }
  if (defect_ == Defect::unwritten)
    std::memset(static_cast<void*>(&out[count - 1]), 0x7f, sizeof(T));
  if (defect_ == Defect::overrun) out[count] = out[count - 1];
  if (defect_ == Defect::unsteady && another_time()) {
    for (std::size_t i = 0; i < count; ++i) stir(&out[i]);
  }
}

template <class T, class In>
void BrokenBackend::spoil(Kernel kernel, DeviceImage<T>& output, const DeviceImage<In>& input) {
  spoil(kernel, output);
  if (is(kernel, Defect::input)) {
    auto* bytes = reinterpret_cast<unsigned char*>(const_cast<In*>(pixels(input)));
    bytes[input.size.count() * sizeof(In) - 1] ^= 1u;
  }
}

void BrokenBackend::do_generate_gaussian(DeviceImage<float>& weights, float sigma_px) {
  serial_.generate_gaussian(weights, sigma_px);
  spoil(Kernel::generate_gaussian, weights);
}

void BrokenBackend::do_init_volume(Volume& volume) {
  throw_if(Kernel::init_volume);
  serial_.init_volume(volume);
  if (is(Kernel::init_volume, Defect::value)) disturb(&voxels(volume)[0]);
}

void BrokenBackend::do_mm2meters(DeviceImage<float>& depth_m,
                                 const DeviceImage<std::uint16_t>& depth, float units_per_m) {
  serial_.mm2meters(depth_m, depth, units_per_m);
  spoil(Kernel::mm2meters, depth_m, depth);
}

void BrokenBackend::do_bilateral_filter(DeviceImage<float>& filtered_m,
                                        const DeviceImage<float>& depth_m,
                                        const DeviceImage<float>& gaussian, float range_sigma_m) {
  serial_.bilateral_filter(filtered_m, depth_m, gaussian, range_sigma_m);
  spoil(Kernel::bilateral_filter, filtered_m, depth_m);
}

void BrokenBackend::do_half_sample(DeviceImage<float>& half_m, const DeviceImage<float>& depth_m,
                                   float range_m) {
  serial_.half_sample(half_m, depth_m, range_m);
  spoil(Kernel::half_sample, half_m, depth_m);
}

void BrokenBackend::do_depth2vertex(DeviceImage<Float3>& vertices,
                                    const DeviceImage<float>& depth_m, Intrinsics camera) {
  serial_.depth2vertex(vertices, depth_m, camera);
  spoil(Kernel::depth2vertex, vertices, depth_m);
}

void BrokenBackend::do_vertex2normal(DeviceImage<Float3>& normals,
                                     const DeviceImage<Float3>& vertices) {
  serial_.vertex2normal(normals, vertices);
  spoil(Kernel::vertex2normal, normals, vertices);
}

void BrokenBackend::do_track(DeviceImage<TrackData>& rows, const DeviceImage<Float3>& vertices,
                             const DeviceImage<Float3>& normals,
                             const DeviceImage<Float3>& model_vertices,
                             const DeviceImage<Float3>& model_normals,
                             const TrackParameters& parameters) {
  serial_.track(rows, vertices, normals, model_vertices, model_normals, parameters);
  spoil(Kernel::track, rows, model_vertices);
}

Reduction BrokenBackend::do_reduce(const DeviceImage<TrackData>& rows) {
  throw_if(Kernel::reduce);
  Reduction sum = serial_.reduce(rows);
  if (is(Kernel::reduce, Defect::value)) sum.jt_j[20] *= 1.0001;
  if (is(Kernel::reduce, Defect::unwritten)) sum.others -= 1;
  if (is(Kernel::reduce, Defect::unsteady) && another_time()) sum.jt_j[3] *= 1 + 1e-14;
  if (is(Kernel::reduce, Defect::input)) {
    const_cast<TrackData*>(pixels(rows))->outcome = TrackOutcome::too_far;
  }
  return sum;
}

Twist BrokenBackend::do_solve(const Reduction& reduction, double condition) {
  throw_if(Kernel::solve);
  Twist twist = serial_.solve(reduction, condition);
  if (is(Kernel::solve, Defect::value)) twist.v[5] *= 1.001;
  if (is(Kernel::solve, Defect::unsteady) && another_time()) twist.v[0] *= 1 + 1e-14;
  return twist;
}

AlignResult BrokenBackend::do_align(const AlignInput& input, double condition) {
  throw_if(Kernel::align);
  AlignResult result = serial_.align(input, condition);
  if (is(Kernel::align, Defect::value)) result.T_volume_camera.translation().x() += 1e-4;
  if (is(Kernel::align, Defect::unwritten)) {
    for (DeviceImage<TrackData>* rows : input.rows) write(*rows, Image<TrackData>(rows->size));
  }
  if (is(Kernel::align, Defect::unsteady) && another_time()) {
    result.T_volume_camera.translation().x() += 1e-12;
  }
  if (is(Kernel::align, Defect::input)) {
    const_cast<Float3*>(pixels(*input.model_vertices))->x += 1.0f;
  }
  return result;
}

void BrokenBackend::do_integrate(Volume& volume, const DeviceImage<float>& depth_m,
                                 const IntegrateParameters& parameters) {
  throw_if(Kernel::integrate);
  serial_.integrate(volume, depth_m, parameters);
  if (broken_ != Kernel::integrate) return;
  const Int3 n = volume.resolution;
  const int count = n.x * n.y * n.z;
  if (defect_ == Defect::value) {
    for (int i = 0; i < count; i += 500) disturb(&voxels(volume)[i]);
  }
  if (defect_ == Defect::unwritten) {
    for (int i = 0; i < count; i += 500) voxels(volume)[i].weight = 0;
  }
  if (defect_ == Defect::unsteady && another_time()) voxels(volume)[count / 2].tsdf ^= 1;
  if (defect_ == Defect::input) const_cast<float*>(pixels(depth_m))[0] += 1.0f;
}

void BrokenBackend::do_raycast(DeviceImage<Float3>& vertices, DeviceImage<Float3>& normals,
                               const Volume& volume, const RaycastParameters& parameters) {
  serial_.raycast(vertices, normals, volume, parameters);
  spoil(Kernel::raycast, vertices);
  if (is(Kernel::raycast, Defect::input)) {
    voxels(const_cast<Volume&>(volume))[0].weight = 77;
  }
}

void BrokenBackend::do_render_depth(DeviceImage<Rgba8>& image, const DeviceImage<float>& depth_m,
                                    float near_m, float far_m) {
  serial_.render_depth(image, depth_m, near_m, far_m);
  spoil(Kernel::render_depth, image, depth_m);
}

void BrokenBackend::do_render_track(DeviceImage<Rgba8>& image, const DeviceImage<TrackData>& rows) {
  serial_.render_track(image, rows);
  spoil(Kernel::render_track, image, rows);
}

void BrokenBackend::do_render_volume(DeviceImage<Rgba8>& image, const Volume& volume,
                                     const RaycastParameters& view,
                                     const ShadeParameters& shading) {
  serial_.render_volume(image, volume, view, shading);
  spoil(Kernel::render_volume, image);
  if (is(Kernel::render_volume, Defect::input)) {
    voxels(const_cast<Volume&>(volume))[0].weight = 77;
  }
}

void BrokenBackend::do_render_seen(DeviceImage<Rgba8>& image, const Volume& volume,
                                   const RaycastParameters& view, const ShadeParameters& shading,
                                   const SeenSurface& seen) {
  do_render_volume(image, volume, is(Kernel::render_volume, Defect::seen) ? seen.view : view,
                   shading);
}

}  // namespace slambench
