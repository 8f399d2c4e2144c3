// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/opencl/opencl_backend.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "backends/align.h"
#include "backends/opencl/opencl.h"
#include "core/error.h"
#include "kernels/volume_maths.h"

namespace slambench {
namespace {

constexpr int sum_columns = 32, count_columns = 28;  // of kernels/sums.cl
constexpr int depth_tile = 8;                        // pixels along a tile of depth_tiles
constexpr int start_tile = 8;                        // and of start_depths, at least
constexpr int most_start_tiles = 4096;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Device memory of an image or of the flat volume.
class DeviceBuffer final : public Storage {
 public:
  explicit DeviceBuffer(DeviceMemory memory) : buffer(std::move(memory)) {}
  DeviceMemory buffer;
};

const cl::Buffer& memory(const Storage& storage) {
  return static_cast<const DeviceBuffer&>(storage).buffer;
}
template <class T>
const cl::Buffer& memory(const DeviceImage<T>& image) {
  return memory(*image.storage);
}

BrickMap& brick_map(const Volume& volume) { return static_cast<BrickMap&>(*volume.storage); }

int pixel_count(Size size) { return static_cast<int>(size.count()); }

/// Packets of an image whose packets do not reach over the end of a row.
std::size_t row_packets(const DeviceKernel& kernel, Size size) {
  return kernel.packets(size.width) * static_cast<std::size_t>(size.height);
}

Size tiles_of(Size size, int tile) {
  return {(size.width + tile - 1) / tile, (size.height + tile - 1) / tile};
}

/// Bricks are never addressed beyond 32 bits (brick_map.cpp).
std::string raycast_macros(const Volume& volume, bool only_misses) {
  const bool bricks = volume.map == MapKind::bricks;
  const bool wide =
      !bricks && voxel_count(volume.resolution) > std::numeric_limits<std::int32_t>::max();
  return fmt::format("-DBRICKS={:d} -DWIDE={:d} -DONLY_MISSES={:d}", bricks, wide, only_misses);
}

Reduction reduction_of(const float (&total)[sum_columns]) {
  Reduction sum;
  sum.squared_error = static_cast<double>(total[0]);
  for (int i = 0; i < 6; ++i) sum.jt_error[i] = static_cast<double>(total[1 + i]);
  for (int i = 0; i < 21; ++i) sum.jt_j[i] = static_cast<double>(total[7 + i]);
  sum.inliers = std::bit_cast<std::int32_t>(total[count_columns]);
  sum.too_far = std::bit_cast<std::int32_t>(total[count_columns + 1]);
  sum.wrong_normal = std::bit_cast<std::int32_t>(total[count_columns + 2]);
  sum.others = std::bit_cast<std::int32_t>(total[count_columns + 3]);
  return sum;
}

}  // namespace

OpenclBackend::OpenclBackend(const OpenclDevice& device, const OpenclParameters& parameters)
    : queue_(device), programs_(queue_.context(), device, parameters) {
  total_ = queue_.allocate(sum_columns * sizeof(float));
}

std::optional<std::size_t> OpenclBackend::device_bytes() const {
  if (queue_.device().is_processor) return std::nullopt;  // it is the host's memory
  return queue_.allocated_bytes();
}

bool OpenclBackend::supports(Kernel kernel, MapKind map) const {
  return kernel != Kernel::acquire && (map == MapKind::grid || map == MapKind::bricks);
}

// ---------------------------------------------------------------- memory

Queue& OpenclBackend::queue() {
  queue_.measure(observer() != nullptr);
  return queue_;
}

std::unique_ptr<Storage> OpenclBackend::allocate(std::size_t bytes) {
  // gather3 (kernels/float3_lanes.cl) reads past the last pixel
  constexpr std::size_t slack = sizeof(float);
  return std::make_unique<DeviceBuffer>(queue_.allocate(bytes + slack));
}

void OpenclBackend::upload(Storage& destination, const void* source, std::size_t bytes) {
  queue().write(memory(destination), source, bytes);
}

void OpenclBackend::download(void* destination, const Storage& source, std::size_t bytes) {
  queue().read(destination, memory(source), bytes);
}

std::unique_ptr<Storage> OpenclBackend::allocate_volume(MapKind map, Int3 resolution, Float3) {
  if (map == MapKind::bricks) return std::make_unique<BrickMap>(queue_, resolution);
  return std::make_unique<DeviceBuffer>(queue_.allocate(voxel_count(resolution) * sizeof(Voxel)));
}

void OpenclBackend::read_volume(std::vector<Voxel>& destination, const Volume& source) {
  destination.resize(voxel_count(source.resolution));
  if (source.map == MapKind::bricks) return brick_map(source).read(queue(), destination.data());
  download(destination.data(), *source.storage, destination.size() * sizeof(Voxel));
}

void OpenclBackend::write_volume(Volume& destination, const std::vector<Voxel>& source) {
  check(source.size() == voxel_count(destination.resolution), "write_volume: sizes differ");
  if (destination.map == MapKind::bricks) {
    return brick_map(destination).write(queue(), source.data());
  }
  upload(*destination.storage, source.data(), source.size() * sizeof(Voxel));
}

std::size_t OpenclBackend::volume_bytes(const Volume& volume) const {
  if (volume.map == MapKind::bricks) return brick_map(volume).bytes(queue_);
  return voxel_count(volume.resolution) * sizeof(Voxel);
}

const cl::Buffer& OpenclBackend::scratch(DeviceMemory& buffer, std::size_t bytes) {
  if (buffer() == nullptr || buffer.getInfo<CL_MEM_SIZE>() < bytes) buffer = queue_.allocate(bytes);
  return buffer;
}

void OpenclBackend::do_init_volume(Volume& volume) {
  begin(Kernel::init_volume);
  if (volume.map == MapKind::bricks) return brick_map(volume).clear(queue_);
  queue_.fill(memory(*volume.storage), std::bit_cast<std::int32_t>(Voxel{}), 0,
              voxel_count(volume.resolution) * sizeof(Voxel));
}

// ---------------------------------------------------------------- images

void OpenclBackend::do_generate_gaussian(DeviceImage<float>& weights, float sigma_px) {
  begin(Kernel::generate_gaussian);
  queue_.launch(programs_.get("generate_gaussian"), weights.size.count(), memory(weights),
                weights.size.width / 2, sigma_px);
}

void OpenclBackend::do_mm2meters(DeviceImage<float>& depth_m,
                                 const DeviceImage<std::uint16_t>& depth, float units_per_m) {
  begin(Kernel::mm2meters);
  DeviceKernel& kernel = programs_.get("mm2meters");
  queue_.launch(kernel, row_packets(kernel, depth_m.size), memory(depth_m), depth_m.size,
                memory(depth), depth.size.width / depth_m.size.width, units_per_m);
}

void OpenclBackend::do_bilateral_filter(DeviceImage<float>& filtered_m,
                                        const DeviceImage<float>& depth_m,
                                        const DeviceImage<float>& gaussian, float range_sigma_m) {
  begin(Kernel::bilateral_filter);
  DeviceKernel& kernel = programs_.get("bilateral_filter");
  const float inverse_two_sigma2 = 1.0f / (2.0f * range_sigma_m * range_sigma_m);
  queue_.launch(kernel, row_packets(kernel, depth_m.size), memory(filtered_m), memory(depth_m),
                depth_m.size, memory(gaussian), gaussian.size.width / 2, inverse_two_sigma2);
}

void OpenclBackend::do_half_sample(DeviceImage<float>& half_m, const DeviceImage<float>& depth_m,
                                   float range_m) {
  begin(Kernel::half_sample);
  DeviceKernel& kernel = programs_.get("half_sample");
  queue_.launch(kernel, row_packets(kernel, half_m.size), memory(half_m), half_m.size,
                memory(depth_m), depth_m.size, range_m);
}

void OpenclBackend::do_depth2vertex(DeviceImage<Float3>& vertices,
                                    const DeviceImage<float>& depth_m, Intrinsics camera) {
  begin(Kernel::depth2vertex);
  DeviceKernel& kernel = programs_.get("depth2vertex");
  queue_.launch(kernel, row_packets(kernel, depth_m.size), memory(vertices), memory(depth_m),
                depth_m.size, camera);
}

void OpenclBackend::do_vertex2normal(DeviceImage<Float3>& normals,
                                     const DeviceImage<Float3>& vertices) {
  begin(Kernel::vertex2normal);
  DeviceKernel& kernel = programs_.get("vertex2normal");
  queue_.launch(kernel, row_packets(kernel, vertices.size), memory(normals), memory(vertices),
                vertices.size);
}

void OpenclBackend::do_render_depth(DeviceImage<Rgba8>& image, const DeviceImage<float>& depth_m,
                                    float near_m, float far_m) {
  begin(Kernel::render_depth);
  DeviceKernel& kernel = programs_.get("render_depth");
  const int count = pixel_count(image.size);
  queue_.launch(kernel, kernel.packets(count), memory(image), memory(depth_m), count, near_m,
                far_m);
}

void OpenclBackend::do_render_track(DeviceImage<Rgba8>& image, const DeviceImage<TrackData>& rows) {
  begin(Kernel::render_track);
  DeviceKernel& kernel = programs_.get("render_track");
  const int count = pixel_count(image.size);
  queue_.launch(kernel, kernel.packets(count), memory(image), memory(rows), count);
}

// ---------------------------------------------------------------- alignment

void OpenclBackend::launch_track(DeviceImage<TrackData>& rows, const DeviceImage<Float3>& vertices,
                                 const DeviceImage<Float3>& normals,
                                 const DeviceImage<Float3>& model_vertices,
                                 const DeviceImage<Float3>& model_normals,
                                 const TrackParameters& parameters) {
  DeviceKernel& kernel = programs_.get("track");
  const int count = pixel_count(vertices.size);
  queue_.launch(kernel, kernel.packets(count), memory(rows), memory(vertices), memory(normals),
                count, memory(model_vertices), memory(model_normals), model_vertices.size,
                parameters);
}

void OpenclBackend::do_track(DeviceImage<TrackData>& rows, const DeviceImage<Float3>& vertices,
                             const DeviceImage<Float3>& normals,
                             const DeviceImage<Float3>& model_vertices,
                             const DeviceImage<Float3>& model_normals,
                             const TrackParameters& parameters) {
  begin(Kernel::track);
  launch_track(rows, vertices, normals, model_vertices, model_normals, parameters);
}

const cl::Buffer& OpenclBackend::partial_sums(std::size_t groups) {
  return scratch(partial_, groups * sum_columns * sizeof(float));
}

Reduction OpenclBackend::total_of(std::size_t groups) {
  queue_.launch_groups(programs_.get("sum_groups"), 1, total_, partial_, static_cast<int>(groups));
  float total[sum_columns];
  queue_.read(total, total_, sizeof(total));
  return reduction_of(total);
}

Reduction OpenclBackend::do_reduce(const DeviceImage<TrackData>& rows) {
  begin(Kernel::reduce);
  DeviceKernel& kernel = programs_.get("reduce");
  const int count = pixel_count(rows.size);
  const std::size_t groups = kernel.groups(kernel.packets(count));
  queue_.launch_groups(kernel, groups, partial_sums(groups), memory(rows), count);
  return total_of(groups);
}

AlignResult OpenclBackend::do_align(const AlignInput& input, double condition) {
  begin(Kernel::align);
  DeviceKernel& kernel = programs_.get("align");
  TrackParameters parameters;
  const auto match = [&](std::size_t level, const TrackParameters& at) {
    parameters = at;
    const int count = pixel_count(input.vertices[level]->size);
    const std::size_t groups = kernel.groups(kernel.packets(count));
    queue_.launch_groups(kernel, groups, partial_sums(groups), memory(*input.vertices[level]),
                         memory(*input.normals[level]), count, memory(*input.model_vertices),
                         memory(*input.model_normals), input.model_vertices->size, at);
    return total_of(groups);
  };
  AlignResult result =
      iterate_align(input, match, [&](const Reduction& sums) { return do_solve(sums, condition); });
  const auto last = static_cast<std::size_t>(result.last_level);
  if (input.keep_rows && result.iterations[last] > 0) {
    launch_track(*input.rows[last], *input.vertices[last], *input.normals[last],
                 *input.model_vertices, *input.model_normals, parameters);
  }
  return result;
}

// ---------------------------------------------------------------- the volume

void OpenclBackend::do_integrate(Volume& volume, const DeviceImage<float>& depth_m,
                                 const IntegrateParameters& parameters) {
  begin(Kernel::integrate);
  if (volume.map == MapKind::bricks) {
    return integrate_bricks(brick_map(volume), volume, depth_m, parameters);
  }
  DeviceKernel& kernel = programs_.get("integrate");
  const Int3 n = volume.resolution;
  const std::size_t groups = kernel.groups(kernel.packets(n.x) * static_cast<std::size_t>(n.y));
  queue_.launch_layers(kernel, groups, static_cast<std::size_t>(n.z), memory(*volume.storage), n,
                       voxel_size(n, volume.size_m), memory(depth_m), depth_m.size, parameters);
}

void OpenclBackend::integrate_bricks(BrickMap& map, const Volume& volume,
                                     const DeviceImage<float>& depth_m,
                                     const IntegrateParameters& parameters) {
  static const std::string tile = fmt::format("-DTILE={}", depth_tile);
  const Float3 voxel_m = voxel_size(volume.resolution, volume.size_m);
  const Float3 size_m = volume.size_m;
  const float tolerance_m = 1e-5f * std::max({size_m.x, size_m.y, size_m.z});
  const Size tiles = tiles_of(depth_m.size, depth_tile);
  scratch(tiles_, tiles.count() * 2 * sizeof(float));
  queue_.launch(programs_.get("depth_tiles", tile), tiles.count(), tiles_, tiles, memory(depth_m),
                depth_m.size);
  map.begin_classification(queue_);
  queue_.launch(programs_.get("classify_bricks", tile), map.count(), map.varied, map.counters,
                map.distance_planes, map.weight_planes, map.bricks(), voxel_m, tiles_, tiles,
                depth_m.size, parameters, tolerance_m);
  const std::size_t varied = map.reserve_for_varied(queue_);
  queue_.launch_groups(programs_.get("integrate_bricks"), varied, map.varied, map.counters,
                       map.distance_planes, map.weight_planes, map.distances, map.weights,
                       map.owners, map.occupied, map.bricks(), voxel_m, memory(depth_m),
                       depth_m.size, parameters);
}

int OpenclBackend::find_start_depths(const BrickMap& map, const Volume& volume, Size size,
                                     const RaycastParameters& view) {
  static const std::string macro = fmt::format("-DMOST_TILES={}", most_start_tiles);
  int tile = start_tile;
  while (tiles_of(size, tile).count() > most_start_tiles) tile *= 2;
  const Size tiles = tiles_of(size, tile);
  scratch(start_depths_, tiles.count() * sizeof(float));
  queue_.fill(start_depths_, infinity, 0, tiles.count() * sizeof(float));
  queue_.launch(programs_.get("start_depths", macro), map.most_planes(), start_depths_, tiles, tile,
                map.owners, map.counters, volume.resolution, map.bricks(),
                voxel_size(volume.resolution, volume.size_m), size, view);
  return tile;
}

void OpenclBackend::march(const cl::Buffer& vertices, const cl::Buffer& normals, Size size,
                          const Volume& volume, const RaycastParameters& parameters,
                          bool only_misses) {
  DeviceKernel& kernel = programs_.get("raycast", raycast_macros(volume, only_misses));
  const int packet_width = kernel.layout.lanes == 1 ? 1 : 4;
  const int packet_height = kernel.layout.lanes / packet_width;
  const auto packets = static_cast<std::size_t>((size.width + packet_width - 1) / packet_width) *
                       static_cast<std::size_t>((size.height + packet_height - 1) / packet_height);
  if (volume.map == MapKind::bricks) {
    const BrickMap& map = brick_map(volume);
    const int tile = find_start_depths(map, volume, size, parameters);
    queue_.launch(kernel, packets, vertices, normals, size, parameters, volume.resolution,
                  volume.size_m, map.distances, map.distance_planes, map.bricks(), map.occupied,
                  start_depths_, tile);
  } else {
    const cl::Buffer& voxels = memory(*volume.storage);
    queue_.launch(kernel, packets, vertices, normals, size, parameters, volume.resolution,
                  volume.size_m, voxels, voxels, Int3{}, voxels, voxels, 1);
  }
}

void OpenclBackend::do_raycast(DeviceImage<Float3>& vertices, DeviceImage<Float3>& normals,
                               const Volume& volume, const RaycastParameters& parameters) {
  begin(Kernel::raycast);
  march(memory(vertices), memory(normals), vertices.size, volume, parameters);
}

void OpenclBackend::do_render_volume(DeviceImage<Rgba8>& image, const Volume& volume,
                                     const RaycastParameters& view,
                                     const ShadeParameters& shading) {
  begin(Kernel::render_volume);
  const std::size_t bytes = image.size.count() * sizeof(Float3);
  march(scratch(seen_vertices_, bytes), scratch(seen_normals_, bytes), image.size, volume, view);
  launch_shading(image, seen_vertices_, seen_normals_, shading);
}

void OpenclBackend::do_render_seen(DeviceImage<Rgba8>& image, const Volume& volume,
                                   const RaycastParameters& view, const ShadeParameters& shading,
                                   const SeenSurface& seen) {
  begin(Kernel::render_volume);
  const cl::Buffer& vertices = memory(*seen.vertices);
  const cl::Buffer& normals = memory(*seen.normals);
  if (seen.view.far_m == view.far_m) return launch_shading(image, vertices, normals, shading);
  // A ray that met a surface meets the same one when it may go farther.
  const std::size_t bytes = image.size.count() * sizeof(Float3);
  queue_.copy(scratch(seen_vertices_, bytes), vertices, bytes);
  queue_.copy(scratch(seen_normals_, bytes), normals, bytes);
  march(seen_vertices_, seen_normals_, image.size, volume, view, /*only_misses=*/true);
  launch_shading(image, seen_vertices_, seen_normals_, shading);
}

void OpenclBackend::launch_shading(DeviceImage<Rgba8>& image, const cl::Buffer& vertices,
                                   const cl::Buffer& normals, const ShadeParameters& shading) {
  DeviceKernel& kernel = programs_.get("render_volume");
  const int count = pixel_count(image.size);
  queue_.launch(kernel, kernel.packets(count), memory(image), vertices, normals, count, shading);
}

std::unique_ptr<Backend> make_opencl_backend(int device, const OpenclParameters& parameters) {
  const std::vector<OpenclDevice> devices = find_opencl_devices();
  const auto index = static_cast<std::size_t>(device);
  if (index >= devices.size()) {
    throw UnavailableError(
        fmt::format("opencl: found device {}, expected an index below {}", device, devices.size()));
  }
  return std::make_unique<OpenclBackend>(devices[index], parameters);
}

}  // namespace slambench
