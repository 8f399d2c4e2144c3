// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/provenance.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "core/processors.h"
#include "core/trimmed.h"
#include "results/commit.h"

namespace slambench {
namespace {

/// Arm's own cores by the part number in their main ID register (the values of Linux's
/// arch/arm64/include/asm/cputype.h and of Arm's reference manuals).
struct ArmPart {
  unsigned number;
  std::string_view name;
};
constexpr ArmPart arm_parts[] = {
    {0xc05, "Cortex-A5"},    {0xc07, "Cortex-A7"},   {0xc08, "Cortex-A8"},   {0xc09, "Cortex-A9"},
    {0xc0d, "Cortex-A12"},   {0xc0e, "Cortex-A17"},  {0xc0f, "Cortex-A15"},  {0xd01, "Cortex-A32"},
    {0xd03, "Cortex-A53"},   {0xd04, "Cortex-A35"},  {0xd05, "Cortex-A55"},  {0xd07, "Cortex-A57"},
    {0xd08, "Cortex-A72"},   {0xd09, "Cortex-A73"},  {0xd0a, "Cortex-A75"},  {0xd0b, "Cortex-A76"},
    {0xd0c, "Neoverse-N1"},  {0xd0d, "Cortex-A77"},  {0xd40, "Neoverse-V1"}, {0xd41, "Cortex-A78"},
    {0xd42, "Cortex-A78AE"}, {0xd44, "Cortex-X1"},   {0xd46, "Cortex-A510"}, {0xd47, "Cortex-A710"},
    {0xd48, "Cortex-X2"},    {0xd49, "Neoverse-N2"}, {0xd4d, "Cortex-A715"}, {0xd4e, "Cortex-X3"},
    {0xd4f, "Neoverse-V2"},  {0xd80, "Cortex-A520"}, {0xd81, "Cortex-A720"},
};
constexpr unsigned implementer_arm = 0x41;

/// What stands around values and words of text files.
constexpr std::string_view around = " \t\r\n\"";

/// "key SEPARATOR value" lines, in order; other lines are passed over.
std::vector<std::pair<std::string_view, std::string_view>> key_values(std::string_view text,
                                                                      char separator) {
  std::vector<std::pair<std::string_view, std::string_view>> pairs;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const auto middle = line.find(separator);
    if (middle == std::string_view::npos) continue;
    pairs.emplace_back(trimmed(line.substr(0, middle), around),
                       trimmed(line.substr(middle + 1), around));
  }
  return pairs;
}

std::optional<unsigned> hexadecimal(std::string_view text) {
  if (!text.starts_with("0x")) return std::nullopt;
  unsigned number = 0;
  const auto result = std::from_chars(text.data() + 2, text.data() + text.size(), number, 16);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string arm_core(std::string_view implementer, std::string_view part) {
  if (hexadecimal(implementer) == implementer_arm) {
    const auto number = hexadecimal(part);
    for (const ArmPart& known : arm_parts) {
      if (number == known.number) return fmt::format("ARM {}", known.name);
    }
  }
  return fmt::format("ARM implementer {} part {}", implementer, part);
}

/// The text of a small system file; empty when it cannot be read.
std::string system_file(const char* path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string operating_system() {
  std::string text;
  const std::string release = system_file("/etc/os-release");
  for (const auto& [key, value] : key_values(release, '=')) {
    if (key == "PRETTY_NAME") text = fmt::format("{}, ", value);
  }
  utsname system{};
  if (uname(&system) != 0) return text + "unknown";
  return text + fmt::format("{} {} {}", system.sysname, system.release, system.machine);
}

std::size_t memory_bytes() {
  return static_cast<std::size_t>(std::max(0L, sysconf(_SC_PHYS_PAGES))) *
         static_cast<std::size_t>(std::max(0L, sysconf(_SC_PAGE_SIZE)));
}

}  // namespace

std::string version_text() {
  constexpr std::string_view commit = SLAMBENCH_COMMIT;
  constexpr std::size_t digits = 12;
  const auto dash = commit.find('-');
  const std::string_view dirty = dash == std::string_view::npos ? "" : commit.substr(dash);
  return fmt::format("{} ({}{})", SLAMBENCH_VERSION, commit.substr(0, std::min(dash, digits)),
                     dirty);
}

std::optional<double> load_average() {
  double last_minute = 0;
  if (::getloadavg(&last_minute, 1) != 1) return std::nullopt;
  return last_minute;
}

std::string cpu_model(std::string_view cpuinfo) {
  std::vector<std::pair<std::string, int>> cores;  // kinds in order of appearance, and how many
  std::string_view implementer, model;
  for (const auto& [key, value] : key_values(cpuinfo, ':')) {
    if (key == "model name" && model.empty()) model = value;
    if (key == "CPU implementer") implementer = value;
    if (key != "CPU part") continue;
    const std::string core = arm_core(implementer, value);
    const auto known = std::find_if(cores.begin(), cores.end(),
                                    [&](const auto& kind) { return kind.first == core; });
    if (known == cores.end()) {
      cores.emplace_back(core, 1);
    } else {
      ++known->second;
    }
  }
  std::string text;
  for (const auto& [core, count] : cores) {
    text += fmt::format("{}{}x {}", text.empty() ? "" : ", ", count, core);
  }
  if (!text.empty()) return text;
  return model.empty() ? "unknown" : std::string(model);
}

std::string utc_text(std::chrono::sys_seconds time) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                     fmt::gmtime(static_cast<std::time_t>(time.time_since_epoch().count())));
}

Provenance build_and_machine(std::chrono::sys_seconds started_at) {
  Provenance p;
  p.version = SLAMBENCH_VERSION;
  p.commit = SLAMBENCH_COMMIT;
  p.compiler = SLAMBENCH_COMPILER;
  p.flags = trimmed(SLAMBENCH_FLAGS, around);
  p.build_type = SLAMBENCH_BUILD_TYPE;
  p.cpu = cpu_model(system_file("/proc/cpuinfo"));
  p.cores = usable_processors();
  p.load_average_start = load_average();
  p.os = operating_system();
  p.host_memory_bytes = memory_bytes();
  p.started_at = utc_text(started_at);
  return p;
}

}  // namespace slambench
