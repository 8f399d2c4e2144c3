// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/opencl/brick_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "core/error.h"
#include "kernels/volume_maths.h"

namespace slambench {
namespace {

constexpr std::size_t plane_bytes = BrickMap::voxels * sizeof(std::int16_t);
constexpr std::size_t first_planes = 1024;
/// Bytes past the last plane that reading a pair at its last value touches.
constexpr std::size_t slack = 4;
/// Kernels address values by 32-bit indices.
constexpr std::size_t most_planes_addressed =
    static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) / BrickMap::voxels;

Int3 position_of(std::size_t brick, Int3 bricks) {
  const auto linear = static_cast<int>(brick);
  return {linear % bricks.x, linear / bricks.x % bricks.y, linear / bricks.x / bricks.y};
}

int bricks_along(int voxels) { return (voxels + BrickMap::edge - 1) / BrickMap::edge; }

/// Calls f(voxel of the brick, voxel of the flat volume, whether it is inside) for every voxel of a
/// brick; those beyond the resolution go with the last ones inside.
template <class F>
void for_each_voxel(std::size_t brick, Int3 bricks, Int3 n, const F& f) {
  constexpr int edge = BrickMap::edge;
  const Int3 at = position_of(brick, bricks);
  for (int i = 0; i < BrickMap::voxels; ++i) {
    const Int3 wanted{at.x * edge + i % edge, at.y * edge + i / edge % edge,
                      at.z * edge + i / edge / edge};
    const Int3 nearest{std::min(n.x - 1, wanted.x), std::min(n.y - 1, wanted.y),
                       std::min(n.z - 1, wanted.z)};
    const std::size_t row = static_cast<std::size_t>(nearest.z) * static_cast<std::size_t>(n.y) +
                            static_cast<std::size_t>(nearest.y);
    const bool inside = nearest.x == wanted.x && nearest.y == wanted.y && nearest.z == wanted.z;
    f(static_cast<std::size_t>(i),
      row * static_cast<std::size_t>(n.x) + static_cast<std::size_t>(nearest.x), inside);
  }
}

/// The bricks on the host.
struct HostBricks {
  std::vector<std::int32_t> distance_planes, weight_planes, owners;
  std::vector<std::int16_t> distances, weights;
  std::vector<std::uint8_t> occupied;
};

void mark_occupied(Int3 bricks, std::size_t brick, std::vector<std::uint8_t>* occupied) {
  const Int3 at = position_of(brick, bricks);
  for (int z = std::max(0, at.z - 1); z <= at.z; ++z) {
    for (int y = std::max(0, at.y - 1); y <= at.y; ++y) {
      for (int x = std::max(0, at.x - 1); x <= at.x; ++x) {
        (*occupied)[static_cast<std::size_t>(z * bricks.y + y) *
                        static_cast<std::size_t>(bricks.x) +
                    static_cast<std::size_t>(x)] = 1;
      }
    }
  }
}

bool all_equal(const std::array<std::int16_t, BrickMap::voxels>& values, std::int16_t value) {
  return std::all_of(values.begin(), values.end(), [&](std::int16_t v) { return v == value; });
}

HostBricks bricks_of(Int3 bricks, Int3 resolution, const Voxel* voxels) {
  const std::size_t count = voxel_count(bricks);
  std::array<std::int16_t, BrickMap::voxels> tsdf, weights;  // of one brick
  HostBricks host;
  host.distance_planes.resize(count);
  host.weight_planes.resize(count);
  host.occupied.resize(count);
  host.owners.resize(count + 1);
  host.distances.assign(BrickMap::voxels, Voxel{}.tsdf);
  for (std::size_t brick = 0; brick < count; ++brick) {
    for_each_voxel(brick, bricks, resolution, [&](std::size_t i, std::size_t flat, bool) {
      tsdf[i] = voxels[flat].tsdf;
      weights[i] = voxels[flat].weight;
    });
    if (!all_equal(tsdf, Voxel{}.tsdf)) {
      const std::size_t plane = host.distances.size() / BrickMap::voxels;
      host.distance_planes[brick] = static_cast<std::int32_t>(plane);
      host.owners[plane] = static_cast<std::int32_t>(brick);
      host.distances.insert(host.distances.end(), tsdf.begin(), tsdf.end());
      mark_occupied(bricks, brick, &host.occupied);
    }
    if (all_equal(weights, weights[0])) {
      host.weight_planes[brick] = -1 - weights[0];
    } else {
      host.weight_planes[brick] = static_cast<std::int32_t>(host.weights.size() / BrickMap::voxels);
      host.weights.insert(host.weights.end(), weights.begin(), weights.end());
    }
  }
  return host;
}

template <class T>
void upload(Queue& queue, const cl::Buffer& destination, const std::vector<T>& source) {
  queue.write(destination, source.data(), source.size() * sizeof(T));
}

template <class T>
std::vector<T> downloaded(Queue& queue, const cl::Buffer& source, std::size_t count) {
  std::vector<T> values(count);
  queue.read(values.data(), source, count * sizeof(T));
  return values;
}

}  // namespace

BrickMap::BrickMap(Queue& queue, Int3 resolution)
    : resolution_(resolution),
      bricks_{bricks_along(resolution.x), bricks_along(resolution.y), bricks_along(resolution.z)} {
  distance_planes = queue.allocate(count() * sizeof(std::int32_t));
  weight_planes = queue.allocate(count() * sizeof(std::int32_t));
  owners = queue.allocate((count() + 1) * sizeof(std::int32_t));
  varied = queue.allocate(count() * sizeof(std::int32_t));
  occupied = queue.allocate(count());
  counters = queue.allocate(3 * sizeof(std::int32_t));
  reserve(queue, 1, 0, &distances, &distance_capacity_);
  reserve(queue, 1, 0, &weights, &weight_capacity_);
}

std::size_t BrickMap::count() const { return voxel_count(bricks_); }

void BrickMap::reserve(Queue& queue, std::size_t planes, std::size_t used, DeviceMemory* buffer,
                       std::size_t* capacity) const {
  if (planes <= *capacity) return;
  if (planes > most_planes_addressed) {
    throw UnavailableError(fmt::format("bricks: found {} planes needed, expected at most {}",
                                       planes, most_planes_addressed));
  }
  const std::size_t wanted = std::max({planes, *capacity + *capacity / 2, first_planes});
  const std::size_t fit = (queue.device().largest_buffer_bytes - slack) / plane_bytes;
  const std::size_t grown = std::max(planes, std::min({wanted, count() + 1, fit}));
  const DeviceMemory larger = queue.allocate(grown * plane_bytes + slack);
  if (used > 0) queue.copy(larger, *buffer, used * plane_bytes);
  *buffer = larger;
  *capacity = grown;
}

void BrickMap::clear(Queue& queue) {
  queue.fill(distance_planes, std::int32_t{0}, 0, count() * sizeof(std::int32_t));
  queue.fill(weight_planes, std::int32_t{-1 - Voxel{}.weight}, 0, count() * sizeof(std::int32_t));
  queue.fill(occupied, std::uint8_t{0}, 0, count());
  queue.fill(distances, Voxel{}.tsdf, 0, plane_bytes);
  queue.fill(counters, std::int32_t{1}, 0, sizeof(std::int32_t));
  queue.fill(counters, std::int32_t{0}, sizeof(std::int32_t), 2 * sizeof(std::int32_t));
  most_planes_ = 1;
}

void BrickMap::begin_classification(Queue& queue) {
  queue.fill(counters, std::int32_t{0}, 2 * sizeof(std::int32_t), sizeof(std::int32_t));
}

std::size_t BrickMap::reserve_for_varied(Queue& queue) {
  std::int32_t found[3];
  queue.read(found, counters, sizeof(found));
  const auto distance_planes_used = static_cast<std::size_t>(found[0]);
  const auto weight_planes_used = static_cast<std::size_t>(found[1]);
  const auto listed = static_cast<std::size_t>(found[2]);
  most_planes_ = std::min(count() + 1, distance_planes_used + listed);
  reserve(queue, most_planes_, distance_planes_used, &distances, &distance_capacity_);
  reserve(queue, std::min(count(), weight_planes_used + listed), weight_planes_used, &weights,
          &weight_capacity_);
  return listed;
}

std::size_t BrickMap::bytes(Queue& queue) const {
  std::int32_t used[2];
  queue.read(used, counters, sizeof(used));
  return static_cast<std::size_t>(used[0] + used[1]) * plane_bytes +
         count() * (4 * sizeof(std::int32_t) + 1);
}

void BrickMap::read(Queue& queue, Voxel* destination) const {
  const auto used = downloaded<std::int32_t>(queue, counters, 2);
  const auto plane = downloaded<std::int32_t>(queue, distance_planes, count());
  const auto weight_plane = downloaded<std::int32_t>(queue, weight_planes, count());
  const auto tsdf =
      downloaded<std::int16_t>(queue, distances, static_cast<std::size_t>(used[0]) * voxels);
  const auto weight =
      downloaded<std::int16_t>(queue, weights, static_cast<std::size_t>(used[1]) * voxels);
  for (std::size_t brick = 0; brick < count(); ++brick) {
    const std::int16_t* t = tsdf.data() + static_cast<std::size_t>(plane[brick]) * voxels;
    const bool one_weight = weight_plane[brick] < 0;
    const auto shared = static_cast<std::int16_t>(-1 - weight_plane[brick]);
    const std::int16_t* w =
        one_weight ? nullptr
                   : weight.data() + static_cast<std::size_t>(weight_plane[brick]) * voxels;
    for_each_voxel(brick, bricks_, resolution_, [&](std::size_t i, std::size_t flat, bool inside) {
      if (inside) destination[flat] = {t[i], one_weight ? shared : w[i]};
    });
  }
}

void BrickMap::write(Queue& queue, const Voxel* source) {
  const HostBricks host = bricks_of(bricks_, resolution_, source);
  const std::size_t planes = host.distances.size() / voxels;
  const std::size_t weight_plane_count = host.weights.size() / voxels;
  reserve(queue, planes, 0, &distances, &distance_capacity_);
  reserve(queue, weight_plane_count, 0, &weights, &weight_capacity_);
  upload(queue, distance_planes, host.distance_planes);
  upload(queue, weight_planes, host.weight_planes);
  upload(queue, owners, host.owners);
  upload(queue, occupied, host.occupied);
  upload(queue, distances, host.distances);
  upload(queue, weights, host.weights);
  upload(queue, counters,
         std::vector<std::int32_t>{static_cast<std::int32_t>(planes),
                                   static_cast<std::int32_t>(weight_plane_count), 0});
  most_planes_ = planes;
}

}  // namespace slambench
