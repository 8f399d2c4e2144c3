// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/memory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

#include "meters/meter.h"

namespace slambench {
namespace {

constexpr const char* reset_file = "/proc/self/clear_refs";

}  // namespace

std::size_t status_bytes(std::string_view status, std::string_view key) {
  const std::string head = fmt::format("{}:", key);
  while (!status.empty()) {
    std::string_view line = status.substr(0, status.find('\n'));
    status.remove_prefix(std::min(status.size(), line.size() + 1));
    if (!line.starts_with(head)) continue;
    line.remove_prefix(std::min(line.find_first_of("0123456789"), line.size()));
    std::size_t kib = 0;
    const char* end = line.data() + line.size();
    const auto result = std::from_chars(line.data(), end, kib);
    const std::string_view unit(result.ptr, static_cast<std::size_t>(end - result.ptr));
    if (result.ec == std::errc{} && unit == " kB") return kib * 1024;
    break;
  }
  throw MeterError(fmt::format("/proc/self/status: no line '{} N kB'", head));
}

void MemoryMeter::begin() {
  no_peak_.clear();
  // proc(5): 5 sets the largest resident set to the present one.
  const int descriptor = ::open(reset_file, O_WRONLY | O_CLOEXEC);
  if (descriptor < 0 || ::write(descriptor, "5", 1) != 1) {
    no_peak_ = fmt::format("{}: {}", reset_file, std::strerror(errno));
  }
  if (descriptor >= 0) ::close(descriptor);
}

void MemoryMeter::end(MemoryMeasurement* memory, std::map<std::string, std::string>* absent) {
  const std::string status = SystemFiles().text_or_empty("/proc/self/status");
  const auto read = [&](const char* key, const char* place, std::optional<std::size_t>* bytes) {
    try {
      *bytes = status_bytes(status, key);
    } catch (const MeterError& error) {
      (*absent)[place] = error.what();
    }
  };
  read("VmRSS", "memory.resident_bytes", &memory->resident_bytes);
  if (no_peak_.empty()) {
    read("VmHWM", "memory.peak_resident_bytes", &memory->peak_resident_bytes);
  } else {
    (*absent)["memory.peak_resident_bytes"] = no_peak_;
  }
}

FoundMeters find_memory(const MeterContext&) {
  FoundMeters found;
  try {
    status_bytes(SystemFiles().text("/proc/self/status"), "VmRSS");
  } catch (const MeterError& error) {
    found.unavailable = error.what();
  }
  return found;
}

}  // namespace slambench
