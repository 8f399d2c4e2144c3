// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "backends/backend.h"
#include "backends/cuda/align_kernel.h"
#include "backends/cuda/image_kernels.h"
#include "backends/cuda/integrate_kernels.h"
#include "backends/cuda/raycast_kernels.h"
#include "core/error.h"

/// The backend but for what only a device can do: memory, launches and clocks are a `Launch`'s.
/// There are two: one on CUDA, and one in the tests that runs the same kernels on the host.
///
/// A Launch works in order and has
///     std::string device() const, driver() const;
///     int processors() const;              // blocks of `grid`; a good number for `blocks`
///     void* allocate(std::size_t bytes);   // throws UnavailableError
///     void release(void*, std::size_t bytes) noexcept;
///     std::size_t allocated_bytes() const;
///     void upload(void* device, const void* host, std::size_t bytes);    // host is free again
///     void download(void* host, const void* device, std::size_t bytes);  // waits
///     void fetch(void* host, const void* device, std::size_t bytes);     // host has it only after
///     void finish();                                                     // this, which waits
///     void begin(Kernel), end(Kernel);     // around what counts as this kernel's time
///     void begin(Transfer, std::size_t bytes), end(Transfer);   // and as this transfer's
///     void report(Observer*);              // tells of each (null: nobody), once finished
///     void pixels(Size, f);                // f(x, y); neighbours along x, or, if F::square,
///                                          // along both axes run together
///     void elements(int count, f);         // f(i) for i < count at least
///     void voxels(Int3, f);                // f(x, y, z)
///     void blocks(int count, f);           // f(block, shared)
///     void grid(f);                        // f(grid), of processors() blocks at the same time
/// where `f` is a function object of kernels; blocks of F::threads threads share an F::Shared,
/// whose contents are unspecified at first. What kernels see of a block and of a grid:
///     int block.index() const, block.count() const;
///     void block.each(f);                  // f(thread), then all threads wait for all
///     bool block.any(f);                   // whether f(thread) is true of any; all wait for all
///     void block.append(int* counter, wanted, store);
///                                          // store(thread, place) where wanted(thread); places
///                                          // are counted on from *counter
///     int grid.count() const;
///     void grid.each_block(f);             // f(block, shared), shared lasting for the kernel
///     void grid.sync();                    // all blocks wait for all
///     F::Shared& grid.shared();            // of any block: only for what is the same in all
namespace slambench::cuda {

/// Memory on the device.
template <class Launch>
class Buffer {
 public:
  Buffer(std::shared_ptr<Launch> launch, std::size_t bytes)
      : launch_(std::move(launch)), data_(launch_->allocate(bytes)), bytes_(bytes) {}
  ~Buffer() { launch_->release(data_, bytes_); }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  template <class T = void>
  T* data() const {
    return static_cast<T*>(data_);
  }
  std::size_t bytes() const { return bytes_; }

 private:
  std::shared_ptr<Launch> launch_;
  void* data_;
  std::size_t bytes_;
};

template <class Launch>
struct ImageStorage final : Storage {
  ImageStorage(const std::shared_ptr<Launch>& launch, std::size_t bytes) : buffer(launch, bytes) {}
  Buffer<Launch> buffer;
};

inline Int3 bricks_along(Int3 resolution) {
  return {parts_of(resolution.x, brick_edge), parts_of(resolution.y, brick_edge),
          parts_of(resolution.z, brick_edge)};
}

/// All that bricks may ever need is allocated at once.
template <class Launch>
class BrickStorage final : public Storage {
 public:
  BrickStorage(const std::shared_ptr<Launch>& launch, Int3 resolution, Float3 size_m,
               std::size_t count)
      : distance_planes_(launch, count * sizeof(std::int32_t)),
        weight_planes_(launch, count * sizeof(std::int32_t)),
        distances_(launch, (count + 1) * brick_voxels * sizeof(std::int16_t)),
        weights_(launch, count * brick_voxels * sizeof(std::int16_t)),
        occupancy_(launch, count),
        varied_(launch, count * sizeof(std::int32_t)),
        counters_(launch, sizeof(BrickCounters)) {
    map_.resolution = resolution;
    map_.size_m = size_m;
    map_.bricks = bricks_along(resolution);
    map_.distance_planes = distance_planes_.template data<std::int32_t>();
    map_.weight_planes = weight_planes_.template data<std::int32_t>();
    map_.distances = distances_.template data<std::int16_t>();
    map_.weights = weights_.template data<std::int16_t>();
    map_.occupancy = occupancy_.template data<std::uint8_t>();
    map_.varied = varied_.template data<std::int32_t>();
    map_.counters = counters_.template data<BrickCounters>();
  }

  const BrickMap& map() const { return map_; }
  std::size_t bytes() const {
    return distance_planes_.bytes() + weight_planes_.bytes() + distances_.bytes() +
           weights_.bytes() + occupancy_.bytes() + varied_.bytes() + counters_.bytes();
  }

 private:
  Buffer<Launch> distance_planes_, weight_planes_, distances_, weights_, occupancy_, varied_,
      counters_;
  BrickMap map_;
};

template <class Launch>
class DeviceBackend final : public Backend {
 public:
  explicit DeviceBackend(std::shared_ptr<Launch> launch)
      : launch_(std::move(launch)),
        block_sums_(launch_, std::size_t{2} * static_cast<std::size_t>(launch_->processors()) *
                                 sum_count * sizeof(double)),
        reduction_(launch_, sizeof(Reduction)),
        message_(launch_, sizeof(AlignMessage)) {}

  std::string_view name() const override { return "cuda"; }
  std::string device() const override { return launch_->device(); }
  std::string driver() const override { return launch_->driver(); }
  std::optional<std::size_t> device_bytes() const override { return launch_->allocated_bytes(); }
  bool supports(Kernel kernel, MapKind map) const override {
    return kernel != Kernel::acquire && (map == MapKind::grid || map == MapKind::bricks);
  }
  bool times_itself() const override { return true; }
  bool advances_in_one_go() const override { return true; }
  void finish() override {
    launch_->finish();
    launch_->report(observer());
  }

  void read_volume(std::vector<Voxel>& destination, const Volume& source) override {
    destination.resize(voxel_count(source.resolution));
    const std::size_t bytes = destination.size() * sizeof(Voxel);
    if (source.map == MapKind::grid) {
      return download(destination.data(), *source.storage, bytes);
    }
    const Buffer<Launch> flat(launch_, bytes);
    launch_->blocks(brick_blocks(source), ReadBricks{bricks(source), flat.template data<Voxel>()});
    to_host(destination.data(), flat.data(), bytes);
  }

  void write_volume(Volume& destination, const std::vector<Voxel>& source) override {
    check(source.size() == voxel_count(destination.resolution), "write_volume: sizes differ");
    const std::size_t bytes = source.size() * sizeof(Voxel);
    if (destination.map == MapKind::grid) {
      return upload(*destination.storage, source.data(), bytes);
    }
    const Buffer<Launch> flat(launch_, bytes);
    to_device(flat.data(), source.data(), bytes);
    clear(destination);
    launch_->blocks(brick_blocks(destination),
                    WriteBricks{bricks(destination), flat.template data<const Voxel>()});
    launch_->finish();  // before the flat one is released
  }

  /// All of it: what bricks do not use yet is theirs nevertheless.
  std::size_t volume_bytes(const Volume& volume) const override {
    return volume.map == MapKind::bricks
               ? static_cast<const BrickStorage<Launch>&>(*volume.storage).bytes()
               : static_cast<const ImageStorage<Launch>&>(*volume.storage).buffer.bytes();
  }

 protected:
  std::unique_ptr<Storage> allocate(std::size_t bytes) override {
    return std::make_unique<ImageStorage<Launch>>(launch_, bytes);
  }
  void upload(Storage& destination, const void* source, std::size_t bytes) override {
    to_device(static_cast<ImageStorage<Launch>&>(destination).buffer.data(), source, bytes);
  }
  void download(void* destination, const Storage& source, std::size_t bytes) override {
    to_host(destination, static_cast<const ImageStorage<Launch>&>(source).buffer.data(), bytes);
  }
  std::unique_ptr<Storage> allocate_volume(MapKind map, Int3 resolution, Float3 size_m) override {
    if (map == MapKind::grid) return allocate(voxel_count(resolution) * sizeof(Voxel));
    const std::size_t count = voxel_count(bricks_along(resolution));
    if (count > most_bricks) {
      throw UnavailableError("bricks: found " + std::to_string(count) +
                             " needed, expected at most " + std::to_string(most_bricks));
    }
    return std::make_unique<BrickStorage<Launch>>(launch_, resolution, size_m, count);
  }

  void do_generate_gaussian(DeviceImage<float>& weights, float sigma_px) override {
    timed(Kernel::generate_gaussian, [&] {
      launch_->pixels(weights.size,
                      GenerateGaussian{pixels(weights), weights.size.width / 2, sigma_px});
    });
  }
  void do_init_volume(Volume& volume) override {
    timed(Kernel::init_volume, [&] { clear(volume); });
  }
  void do_mm2meters(DeviceImage<float>& depth_m, const DeviceImage<std::uint16_t>& depth,
                    float units_per_m) override {
    const int ratio = depth.size.width / depth_m.size.width;
    timed(Kernel::mm2meters, [&] {
      launch_->pixels(depth_m.size, MetersFromUnits{pixels(depth_m), depth_m.size, pixels(depth),
                                                    ratio, units_per_m});
    });
  }
  void do_bilateral_filter(DeviceImage<float>& filtered_m, const DeviceImage<float>& depth_m,
                           const DeviceImage<float>& gaussian, float range_sigma_m) override {
    const float inverse_two_sigma2 = 1.0f / (2.0f * range_sigma_m * range_sigma_m);
    timed(Kernel::bilateral_filter, [&] {
      launch_->pixels(depth_m.size, BilateralFilter{pixels(filtered_m), pixels(depth_m),
                                                    depth_m.size, pixels(gaussian),
                                                    gaussian.size.width / 2, inverse_two_sigma2});
    });
  }
  void do_half_sample(DeviceImage<float>& half_m, const DeviceImage<float>& depth_m,
                      float range_m) override {
    timed(Kernel::half_sample, [&] {
      launch_->pixels(half_m.size, HalfSample{pixels(half_m), half_m.size, pixels(depth_m),
                                              depth_m.size, range_m});
    });
  }
  void do_depth2vertex(DeviceImage<Float3>& vertices, const DeviceImage<float>& depth_m,
                       Intrinsics camera) override {
    timed(Kernel::depth2vertex, [&] {
      launch_->pixels(vertices.size,
                      VertexFromDepth{pixels(vertices), pixels(depth_m), vertices.size, camera});
    });
  }
  void do_vertex2normal(DeviceImage<Float3>& normals,
                        const DeviceImage<Float3>& vertices) override {
    timed(Kernel::vertex2normal, [&] {
      launch_->pixels(normals.size,
                      NormalFromVertices{pixels(normals), pixels(vertices), normals.size});
    });
  }
  void do_track(DeviceImage<TrackData>& rows, const DeviceImage<Float3>& vertices,
                const DeviceImage<Float3>& normals, const DeviceImage<Float3>& model_vertices,
                const DeviceImage<Float3>& model_normals,
                const TrackParameters& parameters) override {
    timed(Kernel::track, [&] {
      launch_->pixels(rows.size, Track{pixels(rows), pixels(vertices), pixels(normals), rows.size,
                                       pixels(model_vertices), pixels(model_normals),
                                       model_vertices.size, parameters});
    });
  }
  Reduction do_reduce(const DeviceImage<TrackData>& rows) override {
    const int blocks = launch_->processors();
    auto* of_blocks = block_sums_.template data<double>();
    auto* result = reduction_.template data<Reduction>();
    timed(Kernel::reduce, [&] {
      launch_->blocks(blocks, ReduceRows{pixels(rows), count(rows.size), of_blocks});
      launch_->blocks(1, ReduceBlocks{of_blocks, blocks, result});
    });
    Reduction sum;
    to_host(&sum, result, sizeof sum);
    return sum;
  }
  bool fuses_align() const override { return true; }
  AlignResult do_align(const AlignInput& input, double condition) override {
    launch_align(input, condition, {});
    AlignMessage message;
    to_host(&message, message_.data(), sizeof message);
    return align_result(message.outcome, input.iterations.size());
  }
  AdvanceResult do_advance(const AdvanceInput& input) override {
    launch_align(input.align, input.condition, input.limits);
    const FoundPose* found = &message_.template data<AlignMessage>()->found;
    if (input.integrate) integrate_at(found, *input.volume, *input.depth_m, *input.integrate);
    raycast_at(found, *input.model_vertices, *input.model_normals, *input.volume, input.raycast);
    transfer(Transfer::to_host, sizeof received_,
             [&] { launch_->fetch(&received_, message_.data(), sizeof received_); });
    finish();
    return {align_result(received_.outcome, input.align.iterations.size()),
            received_.found.tracked != 0};
  }

  void do_integrate(Volume& volume, const DeviceImage<float>& depth_m,
                    const IntegrateParameters& parameters) override {
    integrate_at(nullptr, volume, depth_m, parameters);
  }
  void do_raycast(DeviceImage<Float3>& vertices, DeviceImage<Float3>& normals, const Volume& volume,
                  const RaycastParameters& parameters) override {
    raycast_at(nullptr, vertices, normals, volume, parameters);
  }
  void do_render_depth(DeviceImage<Rgba8>& image, const DeviceImage<float>& depth_m, float near_m,
                       float far_m) override {
    timed(Kernel::render_depth, [&] {
      launch_->pixels(image.size,
                      RenderDepth{pixels(image), pixels(depth_m), image.size, near_m, far_m});
    });
  }
  void do_render_track(DeviceImage<Rgba8>& image, const DeviceImage<TrackData>& rows) override {
    timed(Kernel::render_track, [&] {
      launch_->pixels(image.size, RenderTrack{pixels(image), pixels(rows), image.size});
    });
  }
  void do_render_volume(DeviceImage<Rgba8>& image, const Volume& volume,
                        const RaycastParameters& view, const ShadeParameters& shading) override {
    timed(Kernel::render_volume, [&] {
      with_rays(nullptr, volume, view, image.size, [&](const auto& rays) {
        launch_->pixels(image.size, RenderVolume<std::decay_t<decltype(rays)>>{
                                        rays, view, shading, pixels(image), image.size});
      });
    });
  }

 private:
  static constexpr std::size_t most_bricks = std::numeric_limits<std::int32_t>::max() / 2;

  /// Reports what f launches as this kernel's time, unless nobody listens.
  template <class F>
  void timed(Kernel kernel, const F& f) {
    const bool heard = observer() != nullptr;
    if (heard) launch_->begin(kernel);
    f();
    if (heard) launch_->end(kernel);
  }
  /// The same of a transfer, through pinned memory or not: the way there is part of it.
  template <class F>
  void transfer(Transfer direction, std::size_t bytes, const F& f) {
    const bool heard = observer() != nullptr;
    if (heard) launch_->begin(direction, bytes);
    f();
    if (heard) launch_->end(direction);
  }
  void to_device(void* device, const void* host, std::size_t bytes) {
    transfer(Transfer::to_device, bytes, [&] { launch_->upload(device, host, bytes); });
  }
  void to_host(void* host, const void* device, std::size_t bytes) {
    transfer(Transfer::to_host, bytes, [&] { launch_->download(host, device, bytes); });
  }

  static int count(Size size) { return size.width * size.height; }
  static std::size_t voxel_count(Int3 n) {
    return static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) *
           static_cast<std::size_t>(n.z);
  }
  template <class T>
  static T* pixels(DeviceImage<T>& image) {
    return static_cast<ImageStorage<Launch>&>(*image.storage).buffer.template data<T>();
  }
  template <class T>
  static const T* pixels(const DeviceImage<T>& image) {
    return static_cast<const ImageStorage<Launch>&>(*image.storage).buffer.template data<T>();
  }
  static Voxel* voxels(const Volume& volume) {
    return static_cast<const ImageStorage<Launch>&>(*volume.storage).buffer.template data<Voxel>();
  }
  static const BrickMap& bricks(const Volume& volume) {
    return static_cast<const BrickStorage<Launch>&>(*volume.storage).map();
  }
  /// Blocks for kernels that take one brick after the other.
  int brick_blocks(const Volume& volume) const {
    constexpr int a_processor = 4;  // blocks of brick_voxels threads
    return std::min(bricks(volume).count(), a_processor * launch_->processors());
  }

  void clear(const Volume& volume) {
    if (volume.map == MapKind::bricks) {
      const BrickMap& map = bricks(volume);
      launch_->elements(std::max(map.count(), brick_voxels), ClearBricks{map});
    } else {
      launch_->voxels(volume.resolution, ClearGrid{voxels(volume), volume.resolution});
    }
  }

  /// Memory of at least that size for the call in progress; what was in it is lost.
  void* scratch(std::unique_ptr<Buffer<Launch>>* buffer, std::size_t bytes) {
    if (*buffer == nullptr || (*buffer)->bytes() < bytes) {
      launch_->finish();  // somebody may still be using the old one
      buffer->reset();
      *buffer = std::make_unique<Buffer<Launch>>(launch_, bytes);
    }
    return (*buffer)->data();
  }

  void launch_align(const AlignInput& input, double condition, const TrackingLimits& limits);
  static AlignResult align_result(const AlignOutcome& outcome, std::size_t levels);

  /// Launches a kernel at the pose found on the device, or without one where its parameters say.
  template <class F, class Go>
  static void at(const FoundPose* found, const F& kernel, const Go& go) {
    if (found != nullptr) return go(AtFoundPose<F>{kernel, found});
    go(kernel);
  }

  void integrate_at(const FoundPose* found, Volume& volume, const DeviceImage<float>& depth_m,
                    const IntegrateParameters& parameters) {
    const Float3 voxel_m = voxel_size(volume.resolution, volume.size_m);
    timed(Kernel::integrate, [&] {
      if (volume.map == MapKind::bricks) {
        return integrate_bricks(found, volume, depth_m, voxel_m, parameters);
      }
      at(found,
         IntegrateGrid{voxels(volume), volume.resolution, voxel_m, pixels(depth_m), depth_m.size,
                       parameters},
         [&](const auto& kernel) { launch_->voxels(volume.resolution, kernel); });
    });
  }

  void integrate_bricks(const FoundPose* found, Volume& volume, const DeviceImage<float>& depth_m,
                        Float3 voxel_m, const IntegrateParameters& parameters) {
    const BrickMap& map = bricks(volume);
    const Size size = depth_m.size,
               s = tiles_of(size, DepthPyramid::edge(DepthPyramid::levels - 1));
    const auto tiles = static_cast<std::size_t>(DepthPyramid::first(size, DepthPyramid::levels));
    const DepthPyramid pyramid{
        size, static_cast<DepthRange*>(scratch(&pyramid_, tiles * sizeof(DepthRange)))};
    const Float3 size_m = volume.size_m;
    const BrickMeasurement measurement{
        map,  voxel_m,    pixels(depth_m),
        size, parameters, 1e-5f * std::max({size_m.x, size_m.y, size_m.z})};
    launch_->blocks(s.width * s.height, BuildDepthPyramid{pyramid, pixels(depth_m), map.counters});
    at(found, ClassifyBricks{measurement, pyramid}, [&](const auto& kernel) {
      launch_->blocks(parts_of(map.count(), ClassifyBricks::threads), kernel);
    });
    at(found, IntegrateBricks{measurement},
       [&](const auto& kernel) { launch_->blocks(brick_blocks(volume), kernel); });
  }

  void raycast_at(const FoundPose* found, DeviceImage<Float3>& vertices,
                  DeviceImage<Float3>& normals, const Volume& volume,
                  const RaycastParameters& parameters) {
    timed(Kernel::raycast, [&] {
      with_rays(found, volume, parameters, vertices.size, [&](const auto& rays) {
        at(found,
           Raycast<std::decay_t<decltype(rays)>>{rays, parameters, pixels(vertices),
                                                 pixels(normals), vertices.size},
           [&](const auto& kernel) { launch_->pixels(vertices.size, kernel); });
      });
    });
  }

  /// Calls f with what casts rays through the volume.
  template <class F>
  void with_rays(const FoundPose* found, const Volume& volume, const RaycastParameters& view,
                 Size size, const F& f) {
    if (volume.map == MapKind::grid) {
      return f(GridRays{{voxels(volume), volume.resolution, volume.size_m}});
    }
    const BrickMap& map = bricks(volume);
    StartDepths start{size, nullptr};
    const int tiles = start.everywhere() + 1;
    start.depths = static_cast<float*>(
        scratch(&start_depths_, static_cast<std::size_t>(tiles) * sizeof(float)));
    launch_->elements(tiles, ClearStartDepths{start});
    at(found, MarkStartDepths{map, view, start},
       [&](const auto& kernel) { launch_->elements(map.count(), kernel); });
    f(BrickRays{map, start});
  }

  std::shared_ptr<Launch> launch_;
  Buffer<Launch> block_sums_, reduction_, message_;
  AlignMessage received_;  ///< of the last frame's
  std::unique_ptr<Buffer<Launch>> pyramid_, start_depths_;
};

inline PoseD to_pose_d(const Pose& pose) {
  PoseD d;
  for (int i = 0; i < 3; ++i) {
    d.translation[i] = pose.translation()[i];
    for (int j = 0; j < 3; ++j) d.rotation[3 * i + j] = pose.linear()(i, j);
  }
  return d;
}

inline Pose to_pose(const PoseD& d) {
  Pose pose = Pose::Identity();
  for (int i = 0; i < 3; ++i) {
    pose.translation()[i] = d.translation[i];
    for (int j = 0; j < 3; ++j) pose.linear()(i, j) = d.rotation[3 * i + j];
  }
  return pose;
}

template <class Launch>
void DeviceBackend<Launch>::launch_align(const AlignInput& input, double condition,
                                         const TrackingLimits& limits) {
  const std::size_t levels = input.iterations.size();
  check(levels <= most_levels, "align: more levels than the device's kernel takes");
  Align align{};
  for (std::size_t i = 0; i < levels; ++i) {
    align.levels[i] = {pixels(*input.vertices[i]), pixels(*input.normals[i]),
                       pixels(*input.rows[i]), count(input.vertices[i]->size), input.iterations[i]};
  }
  align.level_count = static_cast<int>(levels);
  align.model_vertices = pixels(*input.model_vertices);
  align.model_normals = pixels(*input.model_normals);
  align.model_size = input.model_vertices->size;
  align.parameters = input.parameters;
  align.start = to_pose_d(input.T_volume_camera);
  align.convergence = input.convergence;
  align.condition = condition;
  align.limits = limits;
  align.keep_rows = input.keep_rows;
  align.of_blocks = block_sums_.template data<double>();
  align.message = message_.template data<AlignMessage>();
  timed(Kernel::align, [&] { launch_->grid(align); });
}

template <class Launch>
AlignResult DeviceBackend<Launch>::align_result(const AlignOutcome& outcome, std::size_t levels) {
  AlignResult result;
  result.T_volume_camera = to_pose(outcome.pose);
  result.last = outcome.last;
  result.last_level = outcome.last_level;
  result.iterations.assign(outcome.iterations, outcome.iterations + levels);
  return result;
}

}  // namespace slambench::cuda
