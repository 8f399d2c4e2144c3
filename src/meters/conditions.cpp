// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/conditions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

namespace slambench {
namespace {

// Above these a run counts as disturbed.
constexpr double most_others_load = 0.1;  ///< processors
constexpr double most_frequency_drop = 0.05;
constexpr double most_run_spread = 0.03;

double own_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Of each processor's counts, by file. An event of a package stands in those of all its
/// processors.
std::map<std::string, std::uint64_t> throttle_counts(const SystemFiles& files) {
  std::map<std::string, std::uint64_t> counts;
  for (const std::string& cpu : processor_folders(files)) {
    for (const char* what : {"core", "package"}) {
      const std::string file = fmt::format("{}/thermal_throttle/{}_throttle_count", cpu, what);
      try {
        counts[file] = files.count(file);
      } catch (const MeterError&) {
        // Not every processor tells.
        counts.erase(file);
      }
    }
  }
  return counts;
}

/// The most that one count rose; none when no count was there both times.
std::optional<int> throttled_between(const std::map<std::string, std::uint64_t>& begin,
                                     const std::map<std::string, std::uint64_t>& end) {
  std::optional<std::uint64_t> most;
  for (const auto& [file, count] : end) {
    const auto before = begin.find(file);
    if (before == begin.end()) continue;
    most = std::max(most.value_or(0), count > before->second ? count - before->second : 0);
  }
  if (!most) return std::nullopt;
  return static_cast<int>(std::min<std::uint64_t>(*most, std::numeric_limits<int>::max()));
}

std::string governors(const SystemFiles& files) {
  std::set<std::string> names;
  for (const std::string& cpu : processor_folders(files)) {
    const std::string name = files.text_or_empty(cpu + "/cpufreq/scaling_governor");
    if (!name.empty()) names.insert(name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

double mean(const std::vector<MeterSample>& samples, std::size_t begin, std::size_t end) {
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) sum += samples[i].value;
  return sum / static_cast<double>(end - begin);
}

/// Of the frequency in the last third to the first.
std::optional<std::string> frequency_drop(const std::vector<MeterSample>& samples) {
  constexpr std::size_t parts = 3;
  const std::size_t third = samples.size() / parts;
  if (third == 0) return std::nullopt;
  const double first = mean(samples, 0, third);
  const double last = mean(samples, samples.size() - third, samples.size());
  if (last >= first * (1 - most_frequency_drop)) return std::nullopt;
  return fmt::format(
      "the processor's frequency fell from {:.2f} to {:.2f} GHz: cool it better, or fix a "
      "frequency that it can hold",
      first * 1e-9, last * 1e-9);
}

}  // namespace

std::optional<double> busy_seconds(const std::string& stat, double ticks_per_s) {
  // cpu user nice system idle iowait irq softirq steal ...; guests are in user and nice.
  std::istringstream line(stat.substr(0, stat.find('\n')));
  std::string head;
  double user = 0, nice = 0, system = 0, idle = 0, iowait = 0, irq = 0, softirq = 0, steal = 0;
  line >> head >> user >> nice >> system >> idle >> iowait >> irq >> softirq >> steal;
  if (!line || head != "cpu") return std::nullopt;
  return (user + nice + system + irq + softirq + steal) / ticks_per_s;
}

ConditionsMeter::Accounts ConditionsMeter::now() const {
  return {
      clock_.now_s(),
      busy_seconds(files_.text_or_empty("/proc/stat"), static_cast<double>(::sysconf(_SC_CLK_TCK))),
      own_seconds(), throttle_counts(files_)};
}

void ConditionsMeter::end(Conditions* conditions) const {
  const Accounts end = now();
  const double seconds = end.time_s - begin_.time_s;
  if (end.busy_s && begin_.busy_s && seconds > 0) {
    const double others_s = *end.busy_s - *begin_.busy_s - (end.own_s - begin_.own_s);
    conditions->others_load = std::max(0.0, others_s / seconds);
  }
  conditions->governor = governors(files_);
  conditions->throttled = throttled_between(begin_.throttled, end.throttled);
}

std::vector<std::string> noise_in(const Conditions& conditions,
                                  const std::vector<MeterSample>& frequency_hz) {
  std::vector<std::string> noise;
  if (conditions.others_load.value_or(0) > most_others_load) {
    noise.push_back(
        fmt::format("other processes kept {:.2f} processors busy during the run: stop them, or "
                    "run when the machine is idle",
                    *conditions.others_load));
  }
  if (conditions.throttled.value_or(0) > 0) {
    noise.push_back(
        fmt::format("heat slowed the processor {} times: cool it better, or let it rest between "
                    "runs",
                    *conditions.throttled));
  }
  if (const auto drop = frequency_drop(frequency_hz)) noise.push_back(*drop);
  if (!conditions.governor.empty() && conditions.governor != "performance") {
    noise.push_back(
        fmt::format("the frequency governor is {}: sudo cpupower frequency-set -g performance",
                    conditions.governor));
  }
  return noise;
}

std::string noise_of_runs(double median, double run_spread) {
  if (!(median > 0) || run_spread <= most_run_spread * median) return {};
  return fmt::format(
      "the runs' computation times differ by {:.1f} % (standard deviation): quieten the machine, "
      "or raise --repeat",
      100 * run_spread / median);
}

}  // namespace slambench
