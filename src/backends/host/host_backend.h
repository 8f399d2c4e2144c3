// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstddef>

#include "backends/backend.h"
#include "backends/host/brick_volume.h"
#include "kernels/volume_maths.h"

namespace slambench {

/// Zeroed memory of the host, aligned for any SIMD type.
class HostStorage final : public Storage {
 public:
  /// Bytes behind the last one that may be read, by vectors that reach beyond an image.
  static constexpr std::size_t slack = 4;

  /// Throws UnavailableError when the machine has less than that available.
  explicit HostStorage(std::size_t bytes);
  ~HostStorage() override;
  HostStorage(const HostStorage&) = delete;
  HostStorage& operator=(const HostStorage&) = delete;

  void* data() const { return data_; }
  std::size_t bytes() const { return bytes_; }

 private:
  void* data_;
  std::size_t bytes_;
};

/// What backends that compute on the host share: memory for images, the flat grid and the bricks,
/// so that their kernels can stand in for each other.
class HostBackend : public Backend {
 public:
  std::string device() const override;
  int threads() const override { return 1; }
  void read_volume(std::vector<Voxel>& destination, const Volume& source) override;
  void write_volume(Volume& destination, const std::vector<Voxel>& source) override;
  std::size_t volume_bytes(const Volume& volume) const override;

 protected:
  std::unique_ptr<Storage> allocate(std::size_t bytes) override;
  void upload(Storage& destination, const void* source, std::size_t bytes) override;
  void download(void* destination, const Storage& source, std::size_t bytes) override;
  std::unique_ptr<Storage> allocate_volume(MapKind map, Int3 resolution, Float3 size_m) override;

  template <class T>
  static T* pixels(DeviceImage<T>& image) {
    return static_cast<T*>(static_cast<HostStorage&>(*image.storage).data());
  }
  template <class T>
  static const T* pixels(const DeviceImage<T>& image) {
    return static_cast<const T*>(static_cast<const HostStorage&>(*image.storage).data());
  }
  static Voxel* voxels(Volume& volume) {
    return static_cast<Voxel*>(static_cast<HostStorage&>(*volume.storage).data());
  }
  static BrickVolume& bricks(Volume& volume) { return static_cast<BrickVolume&>(*volume.storage); }
  static const BrickVolume& bricks(const Volume& volume) {
    return static_cast<const BrickVolume&>(*volume.storage);
  }
  static BrickView brick_view(const Volume& volume) {
    return {&bricks(volume), volume.resolution, volume.size_m};
  }
  static GridView grid(const Volume& volume) {
    return {static_cast<const Voxel*>(static_cast<const HostStorage&>(*volume.storage).data()),
            volume.resolution, volume.size_m};
  }
  /// Calls f with the volume as the per-voxel maths reads it: a GridView or a BrickView.
  template <class F>
  static void with_map(const Volume& volume, F f) {
    if (volume.map == MapKind::bricks) {
      f(brick_view(volume));
    } else {
      f(grid(volume));
    }
  }
};

}  // namespace slambench
