// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/repetition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "core/statistics.h"
#include "results/run_statistics.h"

namespace slambench {
namespace {

using Figures = std::map<std::string, Figure>;

/// Collects figures that are there and finite.
class Collector {
 public:
  void add(const std::string& place, const char* unit, std::optional<double> value,
           std::optional<double> frame_spread = std::nullopt) {
    if (value && std::isfinite(*value)) figures_[place] = {unit, *value, frame_spread};
  }
  Figures take() && { return std::move(figures_); }

 private:
  Figures figures_;
};

void add_times(const Record& record, Collector* to) {
  const TimeFigures times = time_figures(record);
  to->add("time.fps_computation", "frames/s", times.fps_computation);
  to->add("time.fps_wall", "frames/s", times.fps_wall);
  if (times.measured_frames == 0) return;
  to->add("time.computation_s.mean", "s", times.computation_s.mean, times.computation_s.std);
  to->add("time.computation_s.p95", "s", times.computation_s.p95);
  to->add("time.computation_s.p99", "s", times.computation_s.p99);
  to->add("time.total_s.mean", "s", times.total_s.mean, times.total_s.std);
  to->add("time.read_s.mean", "s", times.read_s.mean, times.read_s.std);
  for (const StageFigures& stage : times.stages) {
    to->add(fmt::format("time.stages.{}.seconds_per_frame", name(stage.stage)), "s",
            stage.seconds.per_frame, stage.seconds.when_it_ran.std);
  }
  if (times.between_stages) {
    to->add("time.between_stages.seconds_per_frame", "s", times.between_stages->per_frame,
            times.between_stages->when_it_ran.std);
  }
  for (const KernelFigures& kernel : times.kernels) {
    to->add(fmt::format("time.kernels.{}.seconds_per_frame", name(kernel.kernel)), "s",
            kernel.seconds.per_frame, kernel.seconds.when_it_ran.std);
  }
  for (const TransferFigures& transfer : times.transfers) {
    to->add(fmt::format("time.transfers.{}.seconds_per_frame", name(transfer.direction)), "s",
            transfer.seconds.per_frame, transfer.seconds.when_it_ran.std);
  }
}

void add_energy(const std::string& place, const EnergyFigures& energy, Collector* to) {
  to->add(place + ".joules", "J", energy.joules);
  to->add(place + ".joules_per_frame", "J/frame", energy.joules_per_frame);
  to->add(place + ".mean_w", "W", energy.mean_w);
  to->add(place + ".peak_w", "W", energy.peak_w);
  to->add(place + ".idle_w", "W", energy.idle_w);
  to->add(place + ".energy_delay_js", "J s", energy.energy_delay_js);
  to->add(place + ".joules_above_idle", "J", energy.joules_above_idle);
}

void add_memory(const Record& record, Collector* to) {
  const auto add = [&](const char* place, std::optional<std::size_t> bytes) {
    if (bytes) to->add(place, "bytes", static_cast<double>(*bytes));
  };
  const MemoryMeasurement& memory = record.measurements.memory;
  add("memory.map_bytes", record.map_bytes);
  add("memory.peak_resident_bytes", memory.peak_resident_bytes);
  add("memory.resident_bytes", memory.resident_bytes);
  add("memory.device_bytes", memory.device_bytes);
}

void add_counters(const CounterMeasurement& counters, Collector* to) {
  for (std::size_t i = 0; i < stage_count; ++i) {
    const CounterValues& values = counters.stages[i];
    const auto add = [&](const char* what, std::optional<std::uint64_t> count) {
      if (!count) return;
      to->add(fmt::format("counters.stages.{}.{}", name(static_cast<Stage>(i)), what), "",
              static_cast<double>(*count));
    };
    add("cycles", values.cycles);
    add("instructions", values.instructions);
    add("cache_misses", values.cache_misses);
    add("branch_misses", values.branch_misses);
  }
}

void add_errors(const std::string& place, const char* unit, const Statistics& errors,
                Collector* to) {
  if (errors.count == 0) return;
  to->add(place + ".rmse", unit, errors.rmse);
  to->add(place + ".mean", unit, errors.mean);
  to->add(place + ".max", unit, errors.max);
}

void add_accuracy(const Record& record, Collector* to) {
  if (record.slambench1_ate_m) {
    add_errors("accuracy.slambench1_ate_m", "m", *record.slambench1_ate_m, to);
  }
  if (!record.over_processed) return;
  const TrajectoryFigures& figures = *record.over_processed;
  const std::string place = "accuracy.over_processed";
  for (const auto& [alignment, errors] : figures.ate_m) {
    add_errors(fmt::format("{}.ate_m.{}", place, alignment), "m", errors, to);
  }
  add_errors(place + ".rpe_translation_m", "m", figures.rpe_translation_m, to);
  add_errors(place + ".rpe_rotation_deg", "deg", figures.rpe_rotation_deg, to);
}

void add_frames(const Record& record, Collector* to) {
  const FrameCounts counts = frame_counts(record);
  const auto add = [&](const char* place, std::size_t count) {
    to->add(place, "", static_cast<double>(count));
  };
  add("frames.processed", counts.processed);
  add("frames.tracked", counts.tracked);
  add("frames.lost", counts.lost.size());
  add("frames.dropped", counts.dropped.size());
}

RepeatedFigure repeated(const std::vector<Figures>& runs, const std::string& place) {
  RepeatedFigure figure;
  std::vector<double> frame_spreads;
  for (const Figures& run : runs) {
    const Figure& one = run.at(place);
    figure.unit = one.unit;
    figure.values.push_back(one.value);
    if (one.frame_spread) frame_spreads.push_back(*one.frame_spread);
  }
  const Statistics statistics = summarize(figure.values);
  figure.median = statistics.median;
  if (!frame_spreads.empty()) figure.frame_spread = summarize(frame_spreads).median;
  if (runs.size() < 2) return figure;
  const auto n = static_cast<double>(runs.size());
  figure.run_spread = statistics.std * std::sqrt(n / (n - 1));
  const Interval interval = bootstrap_median(figure.values);
  figure.low = interval.low;
  figure.high = interval.high;
  return figure;
}

/// The median; reorders the values.
double median_of(std::vector<double>* values) {
  const auto middle = values->begin() + static_cast<std::ptrdiff_t>(values->size() / 2);
  std::nth_element(values->begin(), middle, values->end());
  if (values->size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values->begin(), middle)) / 2;
}

}  // namespace

std::map<std::string, Figure> run_figures(const Record& record) {
  Collector figures;
  add_times(record, &figures);
  if (const auto& energy = record.measurements.energy) {
    for (const RailEnergy& rail : energy->rails) {
      add_energy(fmt::format("energy.rails.{}", rail.name), rail.figures, &figures);
    }
    if (energy->total) add_energy("energy.total", *energy->total, &figures);
  }
  add_memory(record, &figures);
  if (record.measurements.counters) add_counters(*record.measurements.counters, &figures);
  add_accuracy(record, &figures);
  add_frames(record, &figures);
  return std::move(figures).take();
}

Repetition repetition_of(const std::vector<std::map<std::string, Figure>>& runs) {
  Repetition repetition;
  repetition.runs = static_cast<int>(runs.size());
  std::map<std::string, std::size_t> found;
  for (const Figures& run : runs) {
    for (const auto& [place, figure] : run) ++found[place];
  }
  for (const auto& [place, count] : found) {
    if (count == runs.size()) {
      repetition.figures[place] = repeated(runs, place);
    } else {
      repetition.lacking.push_back(place);
    }
  }
  return repetition;
}

std::size_t median_run(const std::vector<std::map<std::string, Figure>>& runs,
                       const std::string& place) {
  std::vector<std::pair<double, std::size_t>> values;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (const auto found = runs[i].find(place); found != runs[i].end()) {
      values.emplace_back(found->second.value, i);
    }
  }
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[(values.size() - 1) / 2].second;
}

Interval bootstrap_median(std::span<const double> values, double confidence, int resamples,
                          std::uint64_t seed) {
  if (values.empty()) return {};
  std::mt19937_64 random(seed);
  std::vector<double> medians, sample(values.size());
  medians.reserve(static_cast<std::size_t>(resamples));
  for (int i = 0; i < resamples; ++i) {
    // The standard's distributions differ between libraries; this bias is below 2^-32.
    for (double& value : sample) value = values[random() % values.size()];
    medians.push_back(median_of(&sample));
  }
  std::sort(medians.begin(), medians.end());
  const double tail = (1 - confidence) / 2;
  const auto last = static_cast<double>(medians.size() - 1);
  return {medians[static_cast<std::size_t>(std::floor(tail * last))],
          medians[static_cast<std::size_t>(std::ceil((1 - tail) * last))]};
}

}  // namespace slambench
