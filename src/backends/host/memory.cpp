// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/host/memory.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

/// The number in a file that holds one; nothing for "max" or no such file.
std::optional<std::size_t> number_in(const fs::path& file) {
  std::ifstream stream(file);
  std::size_t number = 0;
  if (stream >> number) return number;
  return std::nullopt;
}

/// The number after a word at the start of a line of a file.
std::optional<std::size_t> number_after(const fs::path& file, std::string_view word) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(word)) continue;
    return std::strtoull(line.c_str() + word.size(), nullptr, 10);
  }
  return std::nullopt;
}

/// What the files of a hierarchy of control groups are called.
struct GroupFiles {
  const char *folder, *limit, *usage, *reclaimable;
};
constexpr GroupFiles version_1 = {"sys/fs/cgroup/memory", "memory.limit_in_bytes",
                                  "memory.usage_in_bytes", "total_inactive_file "};
constexpr GroupFiles version_2 = {"sys/fs/cgroup", "memory.max", "memory.current",
                                  "inactive_file "};

/// What one group may still take; files that nobody uses are given back when memory is short.
std::optional<std::size_t> left_in(const fs::path& group, const GroupFiles& files) {
  const auto limit = number_in(group / files.limit), usage = number_in(group / files.usage);
  if (!limit || !usage) return std::nullopt;
  const std::size_t reclaimable =
      number_after(group / "memory.stat", files.reclaimable).value_or(0);
  const std::size_t used = *usage - std::min(reclaimable, *usage);
  return *limit - std::min(used, *limit);
}

/// The least of what the group and those above it may take. Within a container the path is often
/// that on the host and does not exist here: then the topmost one here is the container's.
std::size_t left_in_groups(const fs::path& root, std::string path, const GroupFiles& files) {
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (;; path.erase(path.find_last_of('/'))) {
    const auto left = left_in(root / files.folder / path.substr(path.empty() ? 0 : 1), files);
    least = std::min(least, left.value_or(least));
    if (path.find('/') == std::string::npos) return least;
  }
}

/// The lines of /proc/self/cgroup are "number:controllers:path"; version 2 has no controllers.
std::size_t left_in_control_groups(const fs::path& root) {
  std::size_t least = std::numeric_limits<std::size_t>::max();
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const auto first = line.find(':');
    const auto second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers =
        fmt::format(",{},", std::string_view(line).substr(first + 1, second - first - 1));
    std::string path = line.substr(second + 1);
    if (path == "/") path.clear();
    if (controllers == ",,") {
      least = std::min(least, left_in_groups(root, path, version_2));
    } else if (controllers.find(",memory,") != std::string::npos) {
      least = std::min(least, left_in_groups(root, path, version_1));
    }
  }
  return least;
}

}  // namespace

std::size_t available_memory_bytes(const fs::path& root) {
  const std::size_t in_groups = left_in_control_groups(root);
  if (const auto kib = number_after(root / "proc/meminfo", "MemAvailable:")) {
    return std::min(in_groups, *kib * 1024);
  }
  return std::min(in_groups, static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
                                 static_cast<std::size_t>(sysconf(_SC_PAGE_SIZE)));
}

void require_memory(std::size_t bytes) {
  const std::size_t available = available_memory_bytes();
  if (bytes > available) {
    throw UnavailableError(fmt::format("memory: found {} MiB available, expected {} MiB",
                                       available >> 20, bytes >> 20));
  }
}

void ask_for_huge_pages([[maybe_unused]] void* data, [[maybe_unused]] std::size_t bytes) {
#if defined(MADV_HUGEPAGE)
  madvise(data, bytes, MADV_HUGEPAGE);
#endif
}

}  // namespace slambench
