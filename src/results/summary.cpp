// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/page.h"
#include "results/run_statistics.h"
#include "results/summary_measurements.h"

namespace slambench {
namespace {

constexpr double ms_per_s = 1e3;
constexpr double mm_per_m = 1e3;
constexpr double bytes_per_kib = 1 << 10, bytes_per_gib = 1 << 30;

std::string size_text(Size size) { return fmt::format("{}x{}", size.width, size.height); }

std::string parameter(const Record& record, std::string_view name) {
  const auto found = std::find_if(record.parameters.begin(), record.parameters.end(),
                                  [&](const UsedParameter& p) { return p.name == name; });
  return found == record.parameters.end() ? "" : found->value;
}

std::string share_text(const std::optional<double>& share) {
  return share ? fmt::format("{:.1f} %", 100 * *share) : "-";
}

void identify(const Record& r, const FrameCounts& counts, Page* page) {
  page->line(fmt::format("{}: {} frames on {}", r.sequence,
                         counts.processed + counts.dropped.size(), r.provenance.backend),
             Look::heading);
  std::string device = r.provenance.device;
  if (r.provenance.threads > 0) device += fmt::format(", threads: {}", r.provenance.threads);
  if (!r.provenance.instruction_set.empty()) device += ", " + r.provenance.instruction_set;
  page->wrapped("device", device);
  const std::string preset = parameter(r, "preset");
  if (!preset.empty() && !r.map.empty()) {
    page->wrapped("settings", fmt::format("preset {}, map {}", preset, r.map));
  }
  std::string sizes = fmt::format("input {}, computation {}", size_text(r.input_size),
                                  size_text(r.computation_size));
  if (auto voxels = parameter(r, "volume-resolution"); !voxels.empty()) {
    std::replace(voxels.begin(), voxels.end(), ',', 'x');
    sizes += fmt::format(", volume {}", voxels);
  }
  if (auto size = parameter(r, "volume-size"); !size.empty()) {
    std::replace(size.begin(), size.end(), ',', 'x');
    sizes += fmt::format(" in {} m", size);
  }
  page->wrapped("sizes", sizes);
}

/// Of repeated runs: which one the tables below show.
void tell_shown_run(const Repetition& repetition, Page* page) {
  if (repetition.runs < 2) return;
  page->gap();
  page->line(fmt::format("run {} of {}", repetition.shown_run, repetition.runs), Look::heading);
}

void list_kernels(const TimeFigures& figures, Page* page) {
  page->gap();
  page->line(fmt::format("{:<18}{:>13}{:>10}{:>14}{:>13}", "kernel", "ms a frame", "share",
                         "calls/frame", "ms a call"),
             Look::heading);
  for (const KernelFigures& k : figures.kernels) {
    page->line(fmt::format("{:<18}{:>13.3f}{:>10}{:>14.2f}{:>13.3f}", name(k.kernel),
                           k.seconds.per_frame * ms_per_s, share_text(k.share), k.calls_per_frame,
                           k.seconds_per_call * ms_per_s));
  }
}

/// Three decimals as long as they fit.
std::string ms_text(double seconds) {
  const double ms = seconds * ms_per_s;
  return ms < 1e4 ? fmt::format("{:.3f}", ms) : fmt::format("{:.1f}", ms);
}

std::string stage_row(std::string_view what, const FrameSeconds& seconds,
                      const std::string& share) {
  const Statistics& s = seconds.when_it_ran;
  std::string row = fmt::format("{:<14}{:>10}{:>8}", what, ms_text(seconds.per_frame), s.count);
  for (const double figure : {s.median, s.p95, s.p99, s.max}) {
    row += fmt::format("{:>10}", s.count > 0 ? ms_text(figure) : "-");
  }
  return row + fmt::format("{:>8}", share);
}

/// What every measured frame has.
FrameSeconds in_every_frame(const Statistics& seconds) { return {seconds.mean, seconds}; }

void list_stages(const TimeFigures& figures, Page* page) {
  page->gap();
  page->line(fmt::format("{:<14}{:>10}{:>8}{:>10}{:>10}{:>10}{:>10}{:>8}", "stage", "ms a frame",
                         "frames", "median", "p95", "p99", "max", "share"),
             Look::heading);
  for (const StageFigures& stage : figures.stages) {
    page->line(stage_row(name(stage.stage), stage.seconds, share_text(stage.share)));
  }
  const double computation_s = figures.computation_s.mean;
  const auto share = [&](double seconds) {
    return share_text(computation_s > 0 ? std::optional(seconds / computation_s) : std::nullopt);
  };
  if (figures.between_stages) {
    page->line(stage_row("between_stages", *figures.between_stages,
                         share(figures.between_stages->per_frame)));
  }
  page->line(stage_row("computation", in_every_frame(figures.computation_s), share(computation_s)));
  page->line(stage_row("total", in_every_frame(figures.total_s), "-"));
  if (figures.between_stages) {
    page->line("(stages as the device timed their kernels; between_stages: launching, waiting)");
  }
}

/// Only of a backend that has any.
void list_transfers(const TimeFigures& figures, Page* page) {
  if (figures.transfers.empty()) return;
  page->gap();
  page->line(fmt::format("{:<18}{:>13}{:>10}{:>14}{:>13}{:>12}", "transfers", "ms a frame",
                         "median", "a frame", "KiB a frame", "GiB/s"),
             Look::heading);
  for (const TransferFigures& t : figures.transfers) {
    const double rate = t.bytes_per_frame / t.seconds.per_frame / bytes_per_gib;
    page->line(fmt::format("{:<18}{:>13.3f}{:>10.3f}{:>14.2f}{:>13.3f}{:>12}",
                           t.direction == Transfer::to_device ? "to the device" : "to the host",
                           t.seconds.per_frame * ms_per_s, t.seconds.when_it_ran.median * ms_per_s,
                           t.count_per_frame, t.bytes_per_frame / bytes_per_kib,
                           std::isfinite(rate) ? fmt::format("{:.2f}", rate) : "-"));
  }
  page->line("(part of the times above, and never added to them)");
}

void tell_speed(const Record& r, const TimeFigures& figures, Page* page) {
  page->gap();
  std::vector<std::string> rates;
  if (figures.fps_computation) {
    rates.push_back(fmt::format("{:.2f} frames/s of computation", *figures.fps_computation));
  }
  if (figures.fps_wall) {
    rates.push_back(fmt::format("{:.2f} frames/s of all {:.1f} s", *figures.fps_wall, r.wall_s));
  }
  if (!rates.empty()) page->wrapped("speed", fmt::format("{}", fmt::join(rates, ", ")), Look::good);
  if (r.read_ahead && figures.measured_frames > 0) {
    page->wrapped("reading", fmt::format("{:.3f} ms a frame, ahead of time on a thread of its own: "
                                         "acquire is what the run waited for it",
                                         figures.read_s.mean * ms_per_s));
  }
  std::string measured = fmt::format("{} frames", figures.measured_frames);
  if (!figures.warmup.empty()) {
    measured += fmt::format("; left out as warm-up: {}", frame_list_text(figures.warmup));
  }
  const bool partly =
      std::any_of(figures.stages.begin(), figures.stages.end(), [&](const StageFigures& stage) {
        return stage.seconds.when_it_ran.count < figures.measured_frames;
      });
  if (partly) measured += "; median to max are of the frames in which a stage ran";
  page->wrapped("measured", measured);
  const Provenance& p = r.provenance;
  if (p.load_average_start && p.load_average_end) {
    page->wrapped("load",
                  fmt::format("{:.2f} before the frames, {:.2f} after; usable processors: {}",
                              *p.load_average_start, *p.load_average_end, p.cores));
  }
}

/// "4 lost (0-3, the start)"
std::string counted(const std::vector<int>& frames, std::string_view what, int first_processed) {
  if (frames.empty()) return fmt::format("0 {}", what);
  const auto runs = ranges(frames);
  const bool only_start = runs.size() == 1 && runs.front().first == first_processed;
  return fmt::format("{} {} ({}{})", frames.size(), what, frame_list_text(frames),
                     only_start ? ", the start" : "");
}

void tell_frames(const Record& r, const FrameCounts& counts, Page* page) {
  const auto first = std::find_if(r.frames.begin(), r.frames.end(),
                                  [](const FrameRecord& frame) { return !frame.dropped; });
  const int start = first == r.frames.end() ? -1 : first->index;
  page->wrapped(
      "frames",
      fmt::format("{} tracked; {}; {}; {}", counts.tracked,
                  counted(counts.untracked, "untracked", start),
                  counted(counts.lost, "lost", start), counted(counts.dropped, "dropped", -1)),
      counts.lost.empty() ? Look::plain : Look::bad);
}

void tell_errors(std::string_view label, std::string_view what, const Statistics& s, Page* page) {
  page->line(fmt::format("{:<12}{:<16}mean {:>8.2f}  rmse {:>8.2f}  max {:>8.2f} mm", label, what,
                         s.mean * mm_per_m, s.rmse * mm_per_m, s.max * mm_per_m));
}

std::string_view spelled(std::string_view alignment) {
  if (alignment == "first_pose") return "first pose";
  if (alignment == "se3") return "SE(3)";
  if (alignment == "sim3") return "Sim(3)";
  return alignment == "none" ? "not aligned" : alignment;
}

void tell_trajectory(std::string_view of, const TrajectoryFigures& figures, Page* page) {
  page->wrapped("accuracy",
                fmt::format("{}: {} of {} poses matched with {} of ground truth", of,
                            figures.matched, figures.estimate_poses, figures.ground_truth_poses));
  for (const auto& [alignment, errors] : figures.ate_m) {
    if (errors.count > 0) tell_errors("  ATE", spelled(alignment), errors, page);
  }
  if (figures.rpe_translation_m.count > 0) {
    const std::string over = fmt::format("over {} s", figures.rpe_delta_s);
    tell_errors("  RPE", over, figures.rpe_translation_m, page);
    const Statistics& turn = figures.rpe_rotation_deg;
    page->line(fmt::format("{:<12}{:<16}mean {:>8.3f}  rmse {:>8.3f}  max {:>8.3f} deg", "", "",
                           turn.mean, turn.rmse, turn.max));
  }
}

void tell_accuracy(const Record& r, const FrameCounts& counts, Page* page) {
  if (r.over_processed) {
    tell_trajectory("processed frames", *r.over_processed, page);
  } else {
    const auto reason = r.absent.find("accuracy.over_processed");
    page->wrapped("accuracy",
                  reason == r.absent.end() ? "not judged" : "not judged: " + reason->second);
  }
  if (r.slambench1_ate_m && r.slambench1_ate_m->count > 0) {
    tell_errors("  ATE", "as SLAMBench 1", *r.slambench1_ate_m, page);
  }
  // Without a dropped frame both are the same.
  if (r.over_all && !counts.dropped.empty()) tell_trajectory("all frames", *r.over_all, page);
}

/// What was to be judged and could not be; a missing ground truth was said above.
void tell_not_measured(const Record& r, Page* page) {
  if (!r.over_processed) return;
  for (const auto& [figure, reason] : r.absent) {
    if (figure.starts_with("accuracy.over_all")) continue;
    page->wrapped("absent", fmt::format("{}: {}", figure, reason));
  }
}

void tell_validity(const Record& r, Page* page) {
  if (!r.complete) {
    page->wrapped("INCOMPLETE",
                  r.incomplete_reason.empty() ? "the run was interrupted" : r.incomplete_reason,
                  Look::bad);
  }
  for (const std::string& reason : reasons_invalid(r)) page->wrapped("INVALID", reason, Look::bad);
}

}  // namespace

std::string summary_text(const Record& record, std::string_view folder, bool colors) {
  Page page(colors);
  const FrameCounts counts = frame_counts(record);
  const TimeFigures figures = time_figures(record);
  identify(record, counts, &page);
  if (figures.measured_frames > 0) {
    tell_shown_run(record.repetition, &page);
    list_kernels(figures, &page);
    list_stages(figures, &page);
    list_transfers(figures, &page);
    list_repetition(record.repetition, &page);
  }
  tell_speed(record, figures, &page);
  tell_frames(record, counts, &page);
  tell_accuracy(record, counts, &page);
  tell_measurements(record, &page);
  tell_not_measured(record, &page);
  tell_validity(record, &page);
  if (!folder.empty()) page.line(fmt::format("{:<12}{}", "results", folder));
  return std::move(page).text();
}

}  // namespace slambench
