// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/host/host_backend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "backends/host/memory.h"
#include "core/error.h"

namespace slambench {
namespace {

constexpr std::size_t alignment = 64;
constexpr std::size_t huge_page = std::size_t{2} << 20;

constexpr std::size_t rounded_up(std::size_t bytes, std::size_t unit) {
  return (bytes + unit - 1) / unit * unit;
}

std::string processor_name() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "processor";
}

/// Calls f(brick, voxel of the brick, voxel of the flat volume) for every voxel of a volume.
template <class F>
void for_each_voxel(const BrickVolume& volume, Int3 n, F f) {
  constexpr int edge = BrickVolume::edge;
  std::size_t flat = 0;
  for (int z = 0; z < n.z; ++z) {
    for (int y = 0; y < n.y; ++y) {
      for (int x = 0; x < n.x; ++x) {
        f(volume.index(x / edge, y / edge, z / edge),
          (z % edge * edge + y % edge) * edge + x % edge, flat++);
      }
    }
  }
}

void read_bricks(Voxel* destination, const BrickVolume& source, Int3 resolution) {
  for_each_voxel(source, resolution, [&](std::size_t brick, int i, std::size_t flat) {
    const std::int16_t* weights = source.own_weights(brick);
    destination[flat] = {source.tsdf(brick, i),
                         weights == nullptr ? source.uniform_weight(brick) : weights[i]};
  });
}

void write_bricks(BrickVolume& destination, const Voxel* source, Int3 n) {
  destination.clear();
  std::int16_t tsdf[BrickVolume::voxels], weights[BrickVolume::voxels];
  for (std::size_t brick = 0; brick < destination.count(); ++brick) {
    for (int i = 0; i < BrickVolume::voxels; ++i) {
      const Int3 at = destination.voxel_at(brick, i);
      const Voxel& voxel = source[voxel_index(n, clamp_index(at.x, n.x), clamp_index(at.y, n.y),
                                              clamp_index(at.z, n.z))];
      tsdf[i] = voxel.tsdf;
      weights[i] = voxel.weight;
    }
    destination.reserve(1);
    destination.store(brick, tsdf, weights);
  }
  destination.refresh();
}

}  // namespace

HostStorage::HostStorage(std::size_t bytes) : data_(nullptr), bytes_(bytes) {
  const bool huge = bytes >= 2 * huge_page;
  const std::size_t unit = huge ? huge_page : alignment;
  const std::size_t rounded = rounded_up(bytes + slack, alignment);
  require_memory(rounded);
  if (posix_memalign(&data_, unit, rounded) != 0) {
    throw UnavailableError(fmt::format("memory: the system refuses {} MiB", rounded >> 20));
  }
  if (huge) ask_for_huge_pages(data_, rounded);
  std::memset(data_, 0, rounded);
}

HostStorage::~HostStorage() { std::free(data_); }

std::string HostBackend::device() const { return processor_name(); }

std::unique_ptr<Storage> HostBackend::allocate(std::size_t bytes) {
  return std::make_unique<HostStorage>(bytes);
}

void HostBackend::upload(Storage& destination, const void* source, std::size_t bytes) {
  std::memcpy(static_cast<HostStorage&>(destination).data(), source, bytes);
}

void HostBackend::download(void* destination, const Storage& source, std::size_t bytes) {
  std::memcpy(destination, static_cast<const HostStorage&>(source).data(), bytes);
}

std::unique_ptr<Storage> HostBackend::allocate_volume(MapKind map, Int3 resolution, Float3) {
  if (map == MapKind::bricks) return std::make_unique<BrickVolume>(resolution);
  return allocate(voxel_count(resolution) * sizeof(Voxel));
}

void HostBackend::read_volume(std::vector<Voxel>& destination, const Volume& source) {
  destination.resize(voxel_count(source.resolution));
  if (source.map == MapKind::bricks) {
    read_bricks(destination.data(), bricks(source), source.resolution);
  } else {
    download(destination.data(), *source.storage, destination.size() * sizeof(Voxel));
  }
}

void HostBackend::write_volume(Volume& destination, const std::vector<Voxel>& source) {
  check(source.size() == voxel_count(destination.resolution), "write_volume: sizes differ");
  if (destination.map == MapKind::bricks) {
    write_bricks(bricks(destination), source.data(), destination.resolution);
  } else {
    std::copy(source.begin(), source.end(), voxels(destination));
  }
}

std::size_t HostBackend::volume_bytes(const Volume& volume) const {
  if (volume.map == MapKind::bricks) return bricks(volume).bytes();
  return static_cast<const HostStorage&>(*volume.storage).bytes();
}

}  // namespace slambench
