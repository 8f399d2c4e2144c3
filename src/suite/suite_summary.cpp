// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "suite/suite_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "analysis/figure.h"
#include "analysis/run_group.h"
#include "core/error.h"
#include "core/statistics.h"
#include "results/page.h"

namespace slambench {
namespace {

std::optional<double> median(std::string_view figure, const std::vector<StoredRun>& runs) {
  std::vector<double> values;
  for (const StoredRun& run : runs) {
    for (const double value : values_of(find_figure(figure)->place, run)) values.push_back(value);
  }
  return values.empty() ? std::nullopt : std::optional(summarize(values).median);
}

std::string cell(const std::optional<double>& value, double factor, int decimals) {
  return value ? fmt::format("{:.{}f}", *value * factor, decimals) : "-";
}

}  // namespace

void RunTimes::add(const Configuration& configuration, const RunCost& cost) {
  if (cost.frames < 1) return;
  for (Sum* sum : {&by_folder_[configuration.folder], &by_variant_[configuration.variant], &all_}) {
    sum->seconds += cost.seconds;
    sum->frames += cost.frames;
  }
}

std::optional<double> RunTimes::expected_s(const Configuration& configuration, int frames) const {
  const auto of = [&](const Sum& sum) { return sum.seconds / static_cast<double>(sum.frames); };
  if (const auto it = by_folder_.find(configuration.folder); it != by_folder_.end()) {
    return of(it->second) * frames;
  }
  if (const auto it = by_variant_.find(configuration.variant); it != by_variant_.end()) {
    return of(it->second) * frames;
  }
  return all_.frames > 0 ? std::optional(of(all_) * frames) : std::nullopt;
}

std::string duration_text(double seconds) {
  constexpr double minute_s = 60, rounded_from_s = 100;
  if (seconds < rounded_from_s) return fmt::format("{:.0f} s", std::ceil(seconds));
  const int minutes = static_cast<int>(std::ceil(seconds / minute_s));
  constexpr int hour = 60, long_run = 100;
  return minutes < long_run ? fmt::format("{} min", minutes)
                            : fmt::format("{} h {} min", minutes / hour, minutes % hour);
}

ConfigurationResult result_of(const std::string& folder, const Configuration& configuration,
                              std::size_t runs, const std::vector<ParameterList>& lists) {
  ConfigurationResult result{
      configuration.sequence_name, configuration.variant, runs, {}, {}, {}, {}, ""};
  if (runs == 0) return result;
  try {
    const auto group =
        read_run_group(std::filesystem::path(folder) / configuration.folder, roles_of(lists));
    result.fps = median("fps", group.runs);
    result.computation_s = median("computation_s", group.runs);
    result.ate_rmse_m = median("ate_rmse_m", group.runs);
    result.frame_energy_j = median("frame_energy_j", group.runs);
  } catch (const InputError& error) {
    result.problem = error.what();
  }
  return result;
}

std::string suite_table(const std::vector<ConfigurationResult>& results, bool colors) {
  constexpr int left = 33;
  constexpr std::size_t most = left - 2;
  Page page(colors);
  std::string sequence;
  for (const ConfigurationResult& result : results) {
    if (result.sequence_name != sequence || &result == &results.front()) {
      if (&result != &results.front()) page.gap();
      sequence = result.sequence_name;
      const std::string name =
          sequence.size() <= most ? sequence : "..." + sequence.substr(sequence.size() - most + 3);
      page.line(fmt::format("{:<{}}{:>5}{:>11}{:>12}{:>9}{:>10}", name, left, "runs", "frames/s",
                            "ms a frame", "ATE mm", "J/frame"),
                Look::heading);
    }
    std::string variant = result.variant;
    const std::string figures =
        fmt::format("{:>5}{:>11}{:>12}{:>9}{:>10}", result.runs, cell(result.fps, 1, 2),
                    cell(result.computation_s, 1e3, 3), cell(result.ate_rmse_m, 1e3, 2),
                    cell(result.frame_energy_j, 1, 3));
    if (variant.size() > most) {  // a line of its own
      page.line("  " + variant);
      variant.clear();
    }
    page.line(fmt::format("  {:<{}}{}", variant, most, figures));
  }
  return std::move(page).text();
}

}  // namespace slambench
