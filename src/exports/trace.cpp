// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The Trace Event Format, which Perfetto and Chrome read: complete events ("X") on threads, where
// one that lies within another is drawn below it, instants ("i"), counters ("C") and names ("M");
// times in microseconds.
// https://docs.google.com/document/d/1CvAClvFfyA5R-PhYUmn5OOQtYMH4h6I0nSsKchNAySU
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "analysis/frame_columns.h"
#include "analysis/samples.h"
#include "core/error.h"
#include "exports/exports.h"
#include "kernels/kernel.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Nanoseconds = std::int64_t;

constexpr const char* laid_out =
    "Acquiring a frame and processing it begin when they were measured to begin. In processing, "
    "stages follow one another in the order of the pipeline, without the moments between them, and "
    "within a stage its kernels, each once with the time of all its calls: lengths are measured, "
    "these places are not.";
constexpr const char* in_one_go =
    "Frames were computed in one go: there a stage is as long as its kernels, by the device's "
    "clock, and the rest of the computation's wall time is the gap before drawing.";
constexpr const char* no_starts =
    "This result folder does not have the times at which frames began: they are laid end to end.";
constexpr const char* own_track =
    "The kernels took longer than their stages, as a device's own clock told: they have a track of "
    "their own, none before its stage began.";

/// Threads of a run's process.
constexpr int pipeline_thread = 1, kernel_thread = 2;

Nanoseconds nanoseconds(double seconds) { return std::llround(seconds * 1e9); }
double microseconds(Nanoseconds time) { return static_cast<double>(time) / 1e3; }

/// The frames of a run as columns of numbers, NaN where there is none.
class Frames {
 public:
  Frames(FrameColumns columns, const std::string& path) : columns_(std::move(columns)) {
    for (const char* name : {"index", "dropped"}) {
      if (!columns_.contains(name))
        throw InputError(path, "columns", "no " + std::string(name), "it");
    }
  }

  std::size_t count() const { return columns_.at("index").size(); }
  bool have_starts() const {
    return columns_.contains("start_s") && columns_.contains("process_start_s");
  }
  double value(std::string_view column, std::size_t row) const {
    const auto it = columns_.find(column);
    return it == columns_.end() ? std::nan("") : it->second[row];
  }
  /// Whether any was computed in one go: its stages are not the whole computation.
  bool in_one_go() const {
    for (std::size_t row = 0; row < count(); ++row) {
      if (!std::isnan(value("between_stages_s", row))) return true;
    }
    return false;
  }
  bool dropped(std::size_t row) const { return value("dropped", row) == 1; }
  int index(std::size_t row) const { return static_cast<int>(value("index", row)); }

  /// Nothing where the stage did not run or the kernel was not called.
  std::optional<Nanoseconds> stage(Stage stage, std::size_t row) const {
    return length(fmt::format("stage_{}_s", name(stage)), row);
  }
  /// Of the computation, in no stage.
  Nanoseconds between_stages(std::size_t row) const {
    return length("between_stages_s", row).value_or(0);
  }
  std::optional<Nanoseconds> kernel(Kernel kernel, std::size_t row) const {
    return length(fmt::format("kernel_{}_s", name(kernel)), row);
  }
  int calls(Kernel kernel, std::size_t row) const {
    const double count = value(fmt::format("kernel_{}_calls", name(kernel)), row);
    return std::isnan(count) ? 0 : static_cast<int>(count);
  }

 private:
  std::optional<Nanoseconds> length(const std::string& column, std::size_t row) const {
    const double seconds = value(column, row);
    return std::isnan(seconds) ? std::nullopt : std::optional(nanoseconds(seconds));
  }

  FrameColumns columns_;
};

/// In the order of the pipeline; start-up is before the frames.
constexpr Stage stages[] = {Stage::acquire,   Stage::preprocess, Stage::track,
                            Stage::integrate, Stage::raycast,    Stage::render};

/// Whether the kernels of every stage fit into it. Those of the processor do; where a device
/// measured them by its own clock, they need not.
bool kernels_fit(const Frames& frames) {
  constexpr Nanoseconds rounding = 100;
  for (std::size_t row = 0; row < frames.count(); ++row) {
    for (const Stage stage : stages) {
      Nanoseconds sum = 0;
      for (const KernelInfo& info : kernel_table()) {
        if (info.stage == stage) sum += frames.kernel(info.kernel, row).value_or(0);
      }
      if (sum > frames.stage(stage, row).value_or(0) + rounding) return false;
    }
  }
  return true;
}

/// The events of one run.
class RunTrace {
 public:
  RunTrace(int process, std::vector<Json>* events) : process_(process), events_(*events) {}

  void add_name(const char* kind, int thread, const std::string& name) {
    events_.push_back({{"name", kind},
                       {"ph", "M"},
                       {"pid", process_},
                       {"tid", thread},
                       {"args", {{"name", name}}}});
  }

  void add_frames(const Frames& frames, bool nested) {
    nested_ = nested;
    Nanoseconds end = 0;
    for (std::size_t row = 0; row < frames.count(); ++row) {
      if (frames.dropped(row)) {
        add_dropped(frames.index(row), end);
        continue;
      }
      end = add_frame(frames, row, end);
    }
  }

  /// A reading of power holds until the next; what a counter of energy says is the mean since its
  /// last update, and holds from there.
  void add_series(const StoredSeries& series, bool mean_before) {
    const std::string name = fmt::format("{} ({})", series.meter, series.unit);
    double before_s = 0;
    for (std::size_t i = 0; i < series.values.size(); ++i) {
      add_counter(name, mean_before ? before_s : series.times_s[i], series.values[i]);
      before_s = series.times_s[i];
    }
    if (mean_before && !series.values.empty()) add_counter(name, before_s, series.values.back());
  }

 private:
  void add_slice(const char* kind, std::string name, int thread, Nanoseconds begin,
                 Nanoseconds length, Json more) {
    Json event = {{"name", std::move(name)},
                  {"cat", kind},
                  {"ph", "X"},
                  {"ts", microseconds(begin)},
                  {"dur", microseconds(length)},
                  {"pid", process_},
                  {"tid", thread}};
    if (!more.empty()) event["args"] = std::move(more);
    events_.push_back(std::move(event));
  }

  void add_dropped(int index, Nanoseconds time) {
    events_.push_back({{"name", fmt::format("dropped frame {}", index)},
                       {"cat", "frame"},
                       {"ph", "i"},
                       {"s", "t"},
                       {"ts", microseconds(time)},
                       {"pid", process_},
                       {"tid", pipeline_thread}});
  }

  void add_counter(const std::string& name, double time_s, double value) {
    events_.push_back({{"name", name},
                       {"ph", "C"},
                       {"ts", microseconds(nanoseconds(time_s))},
                       {"pid", process_},
                       {"args", {{"value", value}}}});
  }

  /// Returns its end. `before` is that of the frame before.
  Nanoseconds add_frame(const Frames& frames, std::size_t row, Nanoseconds before) {
    const auto [begin, processed] = starts(frames, row, before);
    const Nanoseconds between_stages = frames.between_stages(row);
    Nanoseconds end = processed + between_stages;
    for (const Stage stage : stages) {
      if (stage != Stage::acquire) end += frames.stage(stage, row).value_or(0);
    }
    Json facts = Json::object();
    for (const char* name : {"tracked", "integrated", "warmup", "time_s", "error_se3_m",
                             "between_stages_s", "transfer_to_device_s", "transfer_to_host_s"}) {
      const double value = frames.value(name, row);
      if (!std::isnan(value)) facts[name] = value;
    }
    add_slice("frame", fmt::format("frame {}", frames.index(row)), pipeline_thread, begin,
              end - begin, std::move(facts));
    Nanoseconds at = begin;
    for (const Stage stage : stages) {
      if (stage == Stage::preprocess) at = processed;
      if (stage == Stage::render) at += between_stages;
      const auto taken = frames.stage(stage, row);
      if (taken) add_slice("stage", std::string(name(stage)), pipeline_thread, at, *taken, {});
      add_kernels(frames, row, stage, at, at + taken.value_or(0));
      at += taken.value_or(0);
    }
    return at;
  }

  /// When acquiring and when processing a frame began; where nobody wrote that down, right after
  /// the frame before.
  static std::pair<Nanoseconds, Nanoseconds> starts(const Frames& frames, std::size_t row,
                                                    Nanoseconds before) {
    const Nanoseconds acquired = frames.stage(Stage::acquire, row).value_or(0);
    if (!frames.have_starts()) return {before, before + acquired};
    const Nanoseconds begin = nanoseconds(frames.value("start_s", row));
    const Nanoseconds processed = nanoseconds(frames.value("process_start_s", row));
    return {begin, std::max(begin + acquired, processed)};
  }

  void add_kernels(const Frames& frames, std::size_t row, Stage stage, Nanoseconds begin,
                   Nanoseconds end) {
    Nanoseconds at = nested_ ? begin : std::max(begin, kernels_end_);
    for (const KernelInfo& info : kernel_table()) {
      if (info.stage != stage) continue;
      const auto taken = frames.kernel(info.kernel, row);
      if (!taken) continue;
      const Nanoseconds length = nested_ ? std::min(*taken, end - at) : *taken;
      add_slice("kernel", std::string(info.name), nested_ ? pipeline_thread : kernel_thread, at,
                length, {{"calls", frames.calls(info.kernel, row)}});
      at += length;
    }
    kernels_end_ = std::max(kernels_end_, at);
  }

  const int process_;
  std::vector<Json>& events_;
  bool nested_ = true;
  Nanoseconds kernels_end_ = 0;
};

/// What there is to know about how the events of the run were placed.
std::string add_run(const ExportRun& each, int process, std::vector<Json>* events) {
  const fs::path folder = fs::path(each.run.path).parent_path();
  const std::string frames_file = folder / "frames.csv";
  const Frames frames(read_frame_columns(frames_file), frames_file);
  const bool nested = kernels_fit(frames);
  RunTrace trace(process, events);
  trace.add_name("process_name", 0,
                 fmt::format("{}: {} on {}", each.name, each.run.text("sequence.name"),
                             each.run.text("provenance.backend")));
  trace.add_name("thread_name", pipeline_thread,
                 nested ? "frames, stages, kernels" : "frames, stages");
  if (!nested) trace.add_name("thread_name", kernel_thread, "kernels, by the device's clock");
  trace.add_frames(frames, nested);
  std::error_code error;
  if (const fs::path file = folder / "samples.csv"; fs::exists(file, error)) {
    for (const StoredSeries& series : read_samples(file)) {
      const std::string reads = each.run.text(fmt::format("energy.rails.{}.reads", series.meter));
      trace.add_series(series, reads == "energy");
    }
  }
  std::string words = laid_out;
  if (frames.in_one_go()) words += fmt::format(" {}", in_one_go);
  if (!frames.have_starts()) words += fmt::format(" {}", no_starts);
  if (!nested) words += fmt::format(" {}", own_track);
  return words;
}

}  // namespace

std::string trace_json(const std::vector<ExportRun>& runs, const ParameterRoles&) {
  std::vector<Json> events;
  Json about = {{"made_by", "slambench export"}};
  int process = 1;
  for (const ExportRun& each : runs) about[each.name] = add_run(each, process++, &events);
  const auto dump = [](const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  std::string text = fmt::format(
      "{{\"displayTimeUnit\":\"ms\",\n\"otherData\":{},\n\"traceEvents\":[", dump(about));
  for (std::size_t i = 0; i < events.size(); ++i) {
    text += i == 0 ? "\n" : ",\n";
    text += dump(events[i]);
  }
  return text + "\n]}\n";
}

}  // namespace slambench
