// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <CL/opencl.hpp>
#include <cstddef>

#include "backends/backend.h"
#include "backends/opencl/queue.h"

namespace slambench {

/// A volume in bricks of 8^3 voxels on the device (kernels/volume.cl and integrate_bricks.cl say
/// what the buffers hold): planes of distances and of weights grow as bricks need them.
class BrickMap final : public Storage {
 public:
  static constexpr int edge = 8;
  static constexpr int voxels = edge * edge * edge;

  BrickMap(Queue& queue, Int3 resolution);

  void clear(Queue& queue);
  void read(Queue& queue, Voxel* destination) const;
  void write(Queue& queue, const Voxel* source);
  /// Memory in use.
  std::size_t bytes(Queue& queue) const;

  Int3 bricks() const { return bricks_; }
  std::size_t count() const;
  /// How many bricks the last classification listed; makes sure that each of them finds planes.
  /// Waits.
  std::size_t reserve_for_varied(Queue& queue);
  void begin_classification(Queue& queue);

  // On the device.
  DeviceMemory distance_planes, weight_planes;  ///< per brick
  DeviceMemory distances, weights;              ///< the planes
  DeviceMemory occupied, owners, varied;
  DeviceMemory counters;  ///< planes of distances in use, of weights, bricks in the list
  /// At least the planes of distances in use.
  std::size_t most_planes() const { return most_planes_; }

 private:
  void reserve(Queue& queue, std::size_t planes, std::size_t used, DeviceMemory* buffer,
               std::size_t* capacity) const;

  Int3 resolution_, bricks_;
  std::size_t distance_capacity_ = 0, weight_capacity_ = 0;
  std::size_t most_planes_ = 1;
};

}  // namespace slambench
