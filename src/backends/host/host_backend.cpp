// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/host/host_backend.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "core/error.h"

namespace slambench {
namespace {

/// What Linux can hand out without swapping; elsewhere the whole memory. An allocation beyond it
/// would succeed and the process be killed later.
std::size_t available_memory_bytes() {
  std::ifstream meminfo("/proc/meminfo");
  for (std::string line; std::getline(meminfo, line);) {
    if (line.starts_with("MemAvailable:")) {
      return std::strtoull(line.c_str() + std::strlen("MemAvailable:"), nullptr, 10) * 1024;
    }
  }
  return static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::size_t>(sysconf(_SC_PAGE_SIZE));
}

constexpr std::size_t alignment = 64;

std::string processor_name() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "processor";
}

std::size_t voxel_count(Int3 resolution) {
  return static_cast<std::size_t>(resolution.x) * static_cast<std::size_t>(resolution.y) *
         static_cast<std::size_t>(resolution.z);
}

}  // namespace

HostStorage::HostStorage(std::size_t bytes) : data_(nullptr), bytes_(bytes) {
  const std::size_t rounded =
      (std::max<std::size_t>(bytes, 1) + alignment - 1) / alignment * alignment;
  const std::size_t available = available_memory_bytes();
  if (rounded <= available) data_ = std::aligned_alloc(alignment, rounded);
  if (data_ == nullptr) {
    throw UnavailableError(fmt::format("memory: found {} MiB available, expected {} MiB",
                                       available >> 20, rounded >> 20));
  }
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

std::unique_ptr<Storage> HostBackend::allocate_volume(MapKind, Int3 resolution, Float3) {
  return allocate(voxel_count(resolution) * sizeof(Voxel));
}

void HostBackend::read_volume(std::vector<Voxel>& destination, const Volume& source) {
  destination.resize(voxel_count(source.resolution));
  download(destination.data(), *source.storage, destination.size() * sizeof(Voxel));
}

void HostBackend::write_volume(Volume& destination, const std::vector<Voxel>& source) {
  check(source.size() == voxel_count(destination.resolution), "write_volume: sizes differ");
  upload(*destination.storage, source.data(), source.size() * sizeof(Voxel));
}

std::size_t HostBackend::volume_bytes(const Volume& volume) const {
  return static_cast<const HostStorage&>(*volume.storage).bytes();
}

}  // namespace slambench
