// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/summary_measurements.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "results/run_statistics.h"

namespace slambench {
namespace {

constexpr double ms_per_s = 1e3;
constexpr double bytes_per_mib = 1024.0 * 1024.0;

void tell_memory(const Record& r, Page* page) {
  std::string text =
      fmt::format("{:.1f} MiB of map", static_cast<double>(r.map_bytes) / bytes_per_mib);
  const auto add = [&](const std::optional<std::size_t>& bytes, std::string_view what) {
    if (!bytes) return;
    text += fmt::format(", {:.1f} MiB {}", static_cast<double>(*bytes) / bytes_per_mib, what);
  };
  const MemoryMeasurement& memory = r.measurements.memory;
  add(memory.device_bytes, "on the device");
  add(memory.peak_resident_bytes, "of process at most");
  page->wrapped("memory", text);
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.3f}", *value) : "-";
}

void list_energy(std::string_view name, const EnergyFigures& f, Page* page) {
  page->line(fmt::format("{:<18}{:>11.3f}{:>11.4f}{:>9.3f}{:>9}{:>11}{:>11.5f}", name, f.joules,
                         f.joules_per_frame, f.mean_w, number(f.peak_w),
                         number(f.joules_above_idle), f.energy_delay_js));
}

void tell_energy(const Measurements& m, Page* page) {
  if (!m.energy) {
    const auto reason = m.absent.find("energy");
    page->wrapped("energy", fmt::format("not measured: {}", reason == m.absent.end()
                                                                ? std::string(not_metered)
                                                                : reason->second));
    return;
  }
  std::string window =
      fmt::format("over {:.2f} s and {} frames", m.energy->seconds, m.energy->frames);
  if (m.energy->idle_seconds) {
    window += fmt::format("; idle baseline of {:.1f} s", *m.energy->idle_seconds);
  }
  page->wrapped("energy", window);
  page->line(fmt::format("{:<18}{:>11}{:>11}{:>9}{:>9}{:>11}{:>11}", "  rail", "J", "J/frame",
                         "mean W", "peak W", "above idle", "J s/frame"),
             Look::heading);
  for (const RailEnergy& rail : m.energy->rails) {
    list_energy(fmt::format("  {}{}", rail.within.empty() ? "" : "- ", rail.name), rail.figures,
                page);
  }
  if (m.energy->total && m.energy->rails.size() > 1) list_energy("  total", *m.energy->total, page);
  for (const auto& [place, reason] : m.absent) {
    if (place.starts_with("energy."))
      page->wrapped("  absent", fmt::format("{}: {}", place, reason));
  }
}

void tell_counters(const CounterMeasurement& counters, Page* page) {
  page->line(fmt::format("{:<18}{:>15}{:>15}{:>16}{:>16}", "counted, M/frame", "cycles",
                         "instructions", "cache misses", "branch misses"),
             Look::heading);
  for (std::size_t i = 0; i < stage_count; ++i) {
    const auto stage = static_cast<Stage>(i);
    if (stage == Stage::init) continue;
    const auto millions = [&](const std::optional<std::uint64_t>& count) {
      if (!count || counters.frames == 0) return std::string("-");
      return fmt::format("{:.3f}", static_cast<double>(*count) * 1e-6 / counters.frames);
    };
    const CounterValues& values = counters.stages[i];
    page->line(fmt::format("{:<18}{:>15}{:>15}{:>16}{:>16}", fmt::format("  {}", name(stage)),
                           millions(values.cycles), millions(values.instructions),
                           millions(values.cache_misses), millions(values.branch_misses)));
  }
}

std::string percent(const std::optional<double>& part, double whole) {
  return part && whole != 0 ? fmt::format("{:.1f} %", 100 * *part / whole) : "-";
}

/// One figure over the runs; nothing when it was not measured.
void list_figure(const Repetition& repetition, const std::string& label, const std::string& place,
                 double scale, Page* page) {
  const auto found = repetition.figures.find(place);
  if (found == repetition.figures.end()) return;
  const RepeatedFigure& figure = found->second;
  if (!figure.low || !figure.high) return;
  page->line(fmt::format("{:<23}{:>11.4g}{:>11.4g} -{:>9.4g}{:>12}{:>12}", label,
                         figure.median * scale, *figure.low * scale, *figure.high * scale,
                         percent(figure.run_spread, figure.median),
                         percent(figure.frame_spread, figure.median)));
}

}  // namespace

void list_repetition(const Repetition& r, Page* page) {
  if (r.runs < 2) return;
  page->gap();
  page->line(fmt::format("{:<23}{:>11}{:>22}{:>12}{:>12}", fmt::format("over {} runs", r.runs),
                         "median", "95 % interval", "run to run", "of frames"),
             Look::heading);
  for (const KernelInfo& kernel : kernel_table()) {
    list_figure(r, fmt::format("{} ms", kernel.name),
                fmt::format("time.kernels.{}.seconds_per_frame", kernel.name), ms_per_s, page);
  }
  for (std::size_t i = 0; i < stage_count; ++i) {
    const std::string_view stage = name(static_cast<Stage>(i));
    list_figure(r, fmt::format("stage {} ms", stage),
                fmt::format("time.stages.{}.seconds_per_frame", stage), ms_per_s, page);
  }
  list_figure(r, "computation ms", "time.computation_s.mean", ms_per_s, page);
  list_figure(r, "total ms", "time.total_s.mean", ms_per_s, page);
  list_figure(r, "frames/s of computation", "time.fps_computation", 1, page);
  list_figure(r, "frames/s of all", "time.fps_wall", 1, page);
  list_figure(r, "energy J/frame", "energy.total.joules_per_frame", 1, page);
  list_figure(r, "memory at most MiB", "memory.peak_resident_bytes", 1 / bytes_per_mib, page);
  page->gap();
  page->wrapped("runs", fmt::format("{} measured after {} not measured; the rest of this page is "
                                    "run {}, the median; spreads are standard deviations from run "
                                    "to run and from frame to frame",
                                    r.runs, r.warmup_runs, r.shown_run));
  if (!r.other_trajectory.empty()) {
    page->wrapped(
        "runs",
        fmt::format("another trajectory than run 1: {}", fmt::join(r.other_trajectory, ", ")),
        Look::bad);
  }
}

void tell_measurements(const Record& record, Page* page) {
  const Measurements& m = record.measurements;
  tell_memory(record, page);
  tell_energy(m, page);
  if (m.counters) tell_counters(*m.counters, page);
  for (const std::string& noise : m.conditions.noise) page->wrapped("noise", noise, Look::bad);
}

}  // namespace slambench
