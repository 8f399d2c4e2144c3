// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/figure.h"

#include <fmt/format.h>

#include <algorithm>

#include "kernels/kernel.h"

namespace slambench {
namespace {

void add_times(std::vector<NamedFigure>* table) {
  const auto add = [&](std::string name, FigureGroup group, std::string place, std::string words) {
    table->push_back({std::move(name), "s", group, std::move(place), false, std::move(words)});
  };
  add("computation_s", FigureGroup::speed, "time.computation_s.mean",
      "mean time a frame of preprocess, track, integrate and raycast");
  add("total_s", FigureGroup::speed, "time.total_s.mean",
      "mean time a frame, acquiring and drawing included");
  add("computation_p99_s", FigureGroup::speed, "time.computation_s.p99",
      "what 99 of 100 frames need at most");
  add("read_s", FigureGroup::speed, "time.read_s.mean",
      "mean time of reading a frame, on whichever thread");
  for (std::size_t i = 0; i < stage_count; ++i) {
    const auto stage = static_cast<Stage>(i);
    if (stage == Stage::init) continue;
    add(fmt::format("stage_{}_s", name(stage)), FigureGroup::stages,
        fmt::format("time.stages.{}.seconds_per_frame", name(stage)),
        "mean time a frame in the stage");
  }
  add("between_stages_s", FigureGroup::stages, "time.between_stages.seconds_per_frame",
      "mean time a frame of the computation in no stage, where frames are computed in one go");
  for (const KernelInfo& kernel : kernel_table()) {
    if (kernel.stage == Stage::init) continue;
    add(fmt::format("kernel_{}_s", kernel.name), FigureGroup::kernels,
        fmt::format("time.kernels.{}.seconds_per_frame", kernel.name),
        "mean time a frame in all calls of the kernel");
  }
}

// docs/compare.md tells what these come from.
constexpr Tolerance distance{.relative = 0.03, .absolute = 2e-4};
constexpr Tolerance angle{.relative = 0.03, .absolute = 3e-3};

std::vector<NamedFigure> make_table() {
  using enum FigureGroup;
  std::vector<NamedFigure> table = {
      {"fps", "frames/s", speed, "time.fps_computation", true, "frames a second of computation"},
      {"fps_wall", "frames/s", speed, "time.fps_wall", true,
       "frames a second of all, reading and drawing included"},
  };
  add_times(&table);
  table.insert(
      table.end(),
      {
          {"energy_j", "J", energy, "energy.total.joules", false, "energy of all frames"},
          {"frame_energy_j", "J", energy, "energy.total.joules_per_frame", false,
           "energy of a frame"},
          {"power_w", "W", energy, "energy.total.mean_w", false, "mean power"},
          {"peak_resident_bytes", "B", memory, "memory.peak_resident_bytes", false,
           "largest resident set during the frames"},
          {"device_bytes", "B", memory, "memory.device_bytes", false,
           "memory of a device of its own"},
          {"map_bytes", "B", memory, "memory.map_bytes", false, "of the map after the last frame"},
          {"ate_rmse_m", "m", accuracy, "accuracy.over_processed.ate_m.se3.rmse", false,
           "absolute trajectory error after alignment by SE(3), root mean square", distance},
          {"ate_mean_m", "m", accuracy, "accuracy.over_processed.ate_m.se3.mean", false,
           "the same, mean", distance},
          {"ate_max_m", "m", accuracy, "accuracy.over_processed.ate_m.se3.max", false,
           "the same, largest", distance},
          {"ate_first_pose_m", "m", accuracy, "accuracy.over_processed.ate_m.first_pose.rmse",
           false, "the same with the first poses laid on each other, root mean square", distance},
          {"ate_slambench1_m", "m", accuracy, "accuracy.slambench1_ate_m.mean", false,
           "absolute trajectory error as SLAMBench 1 published it, mean", distance},
          {"rpe_rmse_m", "m", accuracy, "accuracy.over_processed.rpe_translation_m.rmse", false,
           "relative pose error over a second, root mean square", distance},
          {"rpe_rmse_deg", "deg", accuracy, "accuracy.over_processed.rpe_rotation_deg.rmse", false,
           "the same of the rotation", angle},
          {"processed", "", frames, "frames.processed", true, "frames given to the system"},
          {"tracked", "", frames, "frames.tracked", true, "frames whose pose was updated"},
          {"lost", "", frames, "frames.lost", false, "frames in which tracking failed"},
          {"dropped", "", frames, "frames.dropped", false,
           "frames that came too late in real time"},
      });
  return table;
}

}  // namespace

const std::vector<NamedFigure>& figure_table() {
  static const std::vector<NamedFigure> table = make_table();
  return table;
}

const NamedFigure* find_figure(std::string_view name) {
  const auto& table = figure_table();
  const auto it = std::find_if(table.begin(), table.end(),
                               [&](const NamedFigure& figure) { return figure.name == name; });
  return it == table.end() ? nullptr : &*it;
}

std::string_view name(FigureGroup group) {
  switch (group) {
    case FigureGroup::speed:
      return "speed";
    case FigureGroup::stages:
      return "stages";
    case FigureGroup::kernels:
      return "kernels";
    case FigureGroup::energy:
      return "energy";
    case FigureGroup::memory:
      return "memory";
    case FigureGroup::accuracy:
      return "accuracy";
    case FigureGroup::frames:
      return "frames";
  }
  return "";
}

std::vector<double> values_of(const std::string& place, const StoredRun& run) {
  if (const auto it = run.repeats.find(place); it != run.repeats.end()) return it->second;
  const auto it = run.numbers.find(place);
  return it == run.numbers.end() ? std::vector<double>() : std::vector<double>{it->second};
}

std::optional<double> value_of(const std::string& place, const StoredRun& run) {
  std::vector<double> values = values_of(place, run);
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

std::string reason_absent(const std::string& place, const StoredRun& run) {
  for (std::string part = place; !part.empty();) {
    if (const auto it = run.absent.find(part); it != run.absent.end()) return it->second;
    const std::size_t dot = part.rfind('.');
    part = dot == std::string::npos ? "" : part.substr(0, dot);
  }
  return "the record does not hold it";
}

}  // namespace slambench
