// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/perf_events.h"

#include <fmt/format.h>
#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>

namespace slambench {
namespace {

class SystemCount final : public PerfCount {
 public:
  explicit SystemCount(int descriptor) : descriptor_(descriptor) {}
  ~SystemCount() override { ::close(descriptor_); }

  std::uint64_t read() override {
    struct {
      std::uint64_t value, enabled_ns, running_ns;
    } counted{};
    if (::read(descriptor_, &counted, sizeof counted) != sizeof counted) {
      throw MeterError(fmt::format("performance counter: {}", std::strerror(errno)));
    }
    if (counted.running_ns == 0 || counted.running_ns == counted.enabled_ns) return counted.value;
    return static_cast<std::uint64_t>(
        std::llround(static_cast<double>(counted.value) * static_cast<double>(counted.enabled_ns) /
                     static_cast<double>(counted.running_ns)));
  }

 private:
  const int descriptor_;
};

std::string reason(int error) {
  if (error == ENOENT || error == ENODEV || error == EOPNOTSUPP) {
    return "this processor or virtual machine has no such counter";
  }
  if (error == EACCES || error == EPERM) {
    return fmt::format("{}; /proc/sys/kernel/perf_event_paranoid is {}", std::strerror(error),
                       SystemFiles().text_or_empty("/proc/sys/kernel/perf_event_paranoid"));
  }
  return std::strerror(error);
}

class SystemPerfEvents final : public PerfEvents {
 public:
  std::unique_ptr<PerfCount> open(const PerfEvent& event) const override {
    perf_event_attr attributes{};
    attributes.size = sizeof attributes;
    attributes.type = event.type;
    attributes.config = event.config;
    attributes.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
    if (event.cpu < 0) {
      attributes.inherit = 1;
      attributes.exclude_kernel = 1;
      attributes.exclude_hv = 1;
    }
    const int process = event.cpu < 0 ? 0 : -1;
    const auto descriptor = static_cast<int>(
        ::syscall(SYS_perf_event_open, &attributes, process, event.cpu, -1, PERF_FLAG_FD_CLOEXEC));
    if (descriptor < 0) throw MeterError(fmt::format("performance counter: {}", reason(errno)));
    return std::make_unique<SystemCount>(descriptor);
  }
};

}  // namespace

const PerfEvents& system_perf_events() {
  static const SystemPerfEvents events;
  return events;
}

}  // namespace slambench
