// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

#include "results/writers.h"

namespace slambench {
namespace {

constexpr std::string_view line_end = "\r\n";  // RFC 4180

/// Appends the fields of one row after another.
class Rows {
 public:
  void add(std::string_view field) {
    if (!first_) text_ += ',';
    text_ += field;
    first_ = false;
  }
  void add(double number) { add(std::isfinite(number) ? fmt::format("{}", number) : ""); }
  void add(std::size_t number) { add(fmt::format("{}", number)); }
  void add(int number) { add(fmt::format("{}", number)); }
  void add(const std::optional<double>& number) { number ? add(*number) : add(std::string_view{}); }
  void add_empty(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) add(std::string_view{});
  }
  void end() {
    text_ += line_end;
    first_ = true;
  }
  std::string text() && { return std::move(text_); }

 private:
  std::string text_;
  bool first_ = true;
};

/// Start-up comes once, before the frames.
bool within_frames(Stage stage) { return stage != Stage::init; }

std::size_t level_count(const Record& record) {
  std::size_t levels = 0;
  for (const FrameRecord& frame : record.frames) {
    levels = std::max(levels, frame.iterations.size());
  }
  return levels;
}

constexpr std::array<std::string_view, 18> leading_columns = {"index",
                                                              "time_s",
                                                              "dropped",
                                                              "warmup",
                                                              "tracked",
                                                              "integrated",
                                                              "x_m",
                                                              "y_m",
                                                              "z_m",
                                                              "qx",
                                                              "qy",
                                                              "qz",
                                                              "qw",
                                                              "error_first_pose_m",
                                                              "error_se3_m",
                                                              "inliers",
                                                              "inlier_fraction",
                                                              "residual_m"};

void add_header(std::size_t levels, Rows* rows) {
  for (const std::string_view column : leading_columns) rows->add(column);
  for (std::size_t level = 0; level < levels; ++level) {
    rows->add(fmt::format("iterations_level{}", level));
  }
  rows->add("start_s");
  rows->add("process_start_s");
  rows->add("computation_s");
  rows->add("total_s");
  rows->add("read_s");
  rows->add("between_stages_s");
  for (std::size_t i = 0; i < stage_count; ++i) {
    const auto stage = static_cast<Stage>(i);
    if (within_frames(stage)) rows->add(fmt::format("stage_{}_s", name(stage)));
  }
  for (const KernelInfo& kernel : kernel_table()) {
    if (!within_frames(kernel.stage)) continue;
    rows->add(fmt::format("kernel_{}_s", kernel.name));
    rows->add(fmt::format("kernel_{}_calls", kernel.name));
  }
  for (const Transfer direction : {Transfer::to_device, Transfer::to_host}) {
    for (const char* what : {"s", "bytes", "count"}) {
      rows->add(fmt::format("transfer_{}_{}", name(direction), what));
    }
  }
  rows->end();
}

void add_pose(const Record& record, const FrameRecord& frame, Rows* rows) {
  constexpr std::size_t columns = 7;
  if (!frame.T_start_camera.matrix().allFinite()) return rows->add_empty(columns);
  const Pose own = in_own_axes(record, frame.T_start_camera);
  const Eigen::Quaterniond q(own.linear());
  for (const double v : {own.translation().x(), own.translation().y(), own.translation().z()}) {
    rows->add(v);
  }
  for (const double v : {q.x(), q.y(), q.z(), q.w()}) rows->add(v);
}

/// Empty where no alignment was tried.
void add_alignment(const FrameRecord& frame, std::size_t levels, Rows* rows) {
  const auto& iterations = frame.iterations;
  if (std::accumulate(iterations.begin(), iterations.end(), 0) == 0) {
    return rows->add_empty(3 + levels);
  }
  rows->add(frame.inliers);
  rows->add(frame.inlier_fraction);
  if (frame.inliers > 0) {
    rows->add(frame.residual_m);
  } else {
    rows->add_empty(1);
  }
  for (const int count : iterations) rows->add(count);
  rows->add_empty(levels - iterations.size());
}

void add_times(const FrameRecord& frame, Rows* rows) {
  const FrameTimes& times = frame.times;
  rows->add(frame.start_s);
  rows->add(frame.process_start_s);
  rows->add(times.computation_s());
  rows->add(times.total_s());
  rows->add(times.read_s);
  rows->add(times.between_stages_s);
  for (std::size_t i = 0; i < stage_count; ++i) {
    if (!within_frames(static_cast<Stage>(i))) continue;
    times.stage_calls[i] > 0 ? rows->add(times.stage_s[i]) : rows->add_empty(1);
  }
  for (const KernelInfo& kernel : kernel_table()) {
    if (!within_frames(kernel.stage)) continue;
    const auto i = static_cast<std::size_t>(kernel.kernel);
    times.kernel_calls[i] > 0 ? rows->add(times.kernel_s[i]) : rows->add_empty(1);
    rows->add(times.kernel_calls[i]);
  }
  for (const TransferTimes& transfer : times.transfers) {
    if (transfer.count == 0) {
      rows->add_empty(2);
    } else {
      rows->add(transfer.seconds);
      rows->add(transfer.bytes);
    }
    rows->add(transfer.count);
  }
}

std::size_t time_column_count() {
  std::size_t kernels = 0;
  for (const KernelInfo& kernel : kernel_table()) kernels += within_frames(kernel.stage) ? 1 : 0;
  return 6 + (stage_count - 1) + 2 * kernels + 3 * transfer_count;
}

}  // namespace

std::string frames_csv(const Record& record) {
  const std::size_t levels = level_count(record);
  Rows rows;
  add_header(levels, &rows);
  int processed = 0;
  for (const FrameRecord& frame : record.frames) {
    rows.add(frame.index);
    rows.add(frame.time_s);
    rows.add(frame.dropped ? 1 : 0);
    if (frame.dropped) {
      rows.add_empty(leading_columns.size() - 3 + levels + time_column_count());
    } else {
      rows.add(processed++ < record.warmup_frames ? 1 : 0);
      rows.add(frame.tracked ? 1 : 0);
      rows.add(frame.integrated ? 1 : 0);
      add_pose(record, frame, &rows);
      rows.add(frame.error_first_pose_m);
      rows.add(frame.error_se3_m);
      add_alignment(frame, levels, &rows);
      add_times(frame, &rows);
    }
    rows.end();
  }
  return std::move(rows).text();
}

}  // namespace slambench
