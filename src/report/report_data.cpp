// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "report/report_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "io/files.h"
#include "report/base64.h"
#include "report/paths.h"
#include "results/provenance.h"

namespace slambench {
namespace {

using Json = nlohmann::ordered_json;

// What keeps a report below 10 MB: a frame takes some 150 bytes, a run's record some 10 KB.
constexpr std::size_t most_frames = 12'000;            // of all runs together
constexpr std::size_t most_picture_bytes = 3'200'000;  // likewise, as files
constexpr std::size_t most_samples = 500;              // of a sensor
constexpr std::size_t usual_pictures = 4;              // frames a run

/// The figure at a place of the record ("time.computation_s.mean"), if it has it.
std::optional<double> figure(const Json& record, std::string_view place) {
  std::string path(1, '/');
  path += place;
  std::replace(path.begin(), path.end(), '.', '/');
  const Json::json_pointer pointer(path);
  if (!record.contains(pointer) || !record.at(pointer).is_number()) return {};
  return record.at(pointer).get<double>();
}

/// The rows of every `step`-th frame, times `factor`, rounded to `decimals`; null where empty.
Json column(const std::vector<double>& values, std::size_t step, double factor, int decimals) {
  const double scale = std::pow(10.0, decimals);
  Json list = Json::array();
  for (std::size_t i = 0; i < values.size(); i += step) {
    const double value = values[i] * factor;
    list.push_back(std::isfinite(value) ? Json(std::round(value * scale) / scale) : Json());
  }
  return list;
}

Json frames_json(const FrameColumns& frames, std::size_t step) {
  Json json = Json::object();
  const auto put = [&](const char* key, const std::string& name, double factor, int decimals) {
    const auto found = frames.find(name);
    if (found != frames.end()) json[key] = column(found->second, step, factor, decimals);
  };
  put("index", "index", 1, 0);
  put("computation_ms", "computation_s", 1e3, 3);
  put("total_ms", "total_s", 1e3, 3);
  put("error_se3_mm", "error_se3_m", 1e3, 3);
  put("error_first_pose_mm", "error_first_pose_m", 1e3, 3);
  Json stages = Json::object();
  for (const auto& [name, values] : frames) {
    if (!name.starts_with("stage_") || !name.ends_with("_s")) continue;
    stages[name.substr(6, name.size() - 8)] = column(values, step, 1e3, 3);
  }
  json["stages_ms"] = stages;
  return json;
}

Json path_json(const std::vector<Eigen::Vector3d>& points, std::size_t step) {
  const std::array<const char*, 3> axes = {"right", "forward", "up"};
  Json json = Json::object();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    values.reserve(points.size());
    for (const auto& point : points) values.push_back(point[axis]);
    json[axes[static_cast<std::size_t>(axis)]] = column(values, step, 1, 4);
  }
  return json;
}

Json paths_json(const ReportRun& run, std::size_t step) {
  const ReportPaths paths = report_paths(run);
  Json json = {{"estimate", path_json(paths.estimate, step)}};
  if (!paths.truth.empty()) {
    // The truth may have another rate than the estimate.
    const std::size_t ratio = paths.truth.size() / std::max<std::size_t>(paths.estimate.size(), 1);
    json["truth"] = path_json(paths.truth, step * std::max<std::size_t>(ratio, 1));
  }
  if (!paths.truth_note.empty()) json["truth_note"] = paths.truth_note;
  return json;
}

/// Frames with pictures that are shown: the chosen ones, or some evenly spread over the run.
std::vector<int> shown_frames(const ReportRun& run, const ReportOptions& options,
                              std::size_t count) {
  std::vector<int> all;
  for (const Picture& picture : run.pictures) {
    if (all.empty() || all.back() != picture.frame) all.push_back(picture.frame);
  }
  std::vector<int> shown;
  if (!options.picture_frames.empty()) {
    for (const int frame : options.picture_frames) {
      if (std::binary_search(all.begin(), all.end(), frame)) shown.push_back(frame);
    }
    return shown;
  }
  if (all.size() <= count) return all;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t last = all.size() - 1;
    shown.push_back(all[count == 1 ? last : i * last / (count - 1)]);
  }
  return shown;
}

/// Empty when they are more than `budget` bytes together.
std::optional<std::vector<Json>> pictures_json(const std::vector<const ReportRun*>& runs,
                                               const ReportOptions& options, std::size_t count,
                                               std::size_t budget) {
  std::vector<Json> lists;
  std::size_t used = 0;
  for (const ReportRun* run : runs) {
    Json list = Json::array();
    const auto frames = shown_frames(*run, options, count);
    for (const Picture& picture : run->pictures) {
      if (std::find(frames.begin(), frames.end(), picture.frame) == frames.end()) continue;
      const std::string bytes = read_file(picture.path);
      used += bytes.size();
      if (used > budget) return {};
      list.push_back({{"frame", picture.frame}, {"kind", picture.kind}, {"png", base64(bytes)}});
    }
    lists.push_back(list);
  }
  return lists;
}

/// What a run's sensors of power said over time, in at most `most_samples` means each; `mean` where
/// a reading is the mean since the one before.
Json power_json(const ReportRun& run) {
  Json list = Json::array();
  for (const StoredSeries& series : run.samples) {
    if (series.unit != "W" || series.values.empty()) continue;
    const std::size_t step = (series.values.size() + most_samples - 1) / most_samples;
    std::vector<double> times_s, values;
    for (std::size_t i = 0; i < series.values.size(); i += step) {
      const std::size_t end = std::min(i + step, series.values.size());
      double sum = 0;
      for (std::size_t k = i; k < end; ++k) sum += series.values[k];
      times_s.push_back(series.times_s[end - 1]);
      values.push_back(sum / static_cast<double>(end - i));
    }
    const std::string reads = run.stored.text("energy.rails." + series.meter + ".reads");
    list.push_back({{"rail", series.meter},
                    {"mean", reads == "energy"},
                    {"time_s", column(times_s, 1, 1, 4)},
                    {"power_w", column(values, 1, 1, 4)}});
  }
  return list;
}

/// What a run was given: "living-room/2, 300 frames, noise true". Runs on different inputs are no
/// alternatives to each other.
std::string input_text(const Json& record) {
  const auto text = [](const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
  };
  const Json& frames = record.at("frames");
  const auto given =
      figure(frames, "processed").value_or(0) + figure(frames, "dropped").value_or(0);
  std::string input = text(record.at("sequence").value("name", Json("unnamed"))) + ", " +
                      std::to_string(static_cast<long>(given)) + " frames";
  const Json source = record.at("parameters").value("source", Json::object());
  for (const auto& [name, parameter] : source.items()) {
    if (!parameter.is_object()) continue;
    const std::string set_by = text(parameter.value("set_by", Json("default")));
    if (set_by == "default" || set_by == "sequence") continue;
    input += ", " + name + " " + text(parameter.value("value", Json()));
  }
  return input;
}

/// Fronts of time against error, one an input.
Json fronts_json(const std::vector<ReportRun>& runs) {
  std::map<std::string, std::vector<TradeOff>> points;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Json& record = runs[i].record;
    const auto time = figure(record, "time.computation_s.mean");
    const auto error = figure(record, "accuracy.over_processed.ate_m.se3.rmse");
    if (time && error) points[input_text(record)].push_back({i, *time, *error});
  }
  Json fronts = Json::array();
  for (const auto& [input, of_input] : points) {
    Json members = Json::array();
    for (const TradeOff& point : of_input) members.push_back(point.index);
    fronts.push_back({{"input", input}, {"runs", members}, {"front", pareto_front(of_input)}});
  }
  return fronts;
}

}  // namespace

std::vector<std::size_t> pareto_front(std::vector<TradeOff> points) {
  std::sort(points.begin(), points.end(), [](const TradeOff& a, const TradeOff& b) {
    return std::tie(a.x, a.y, a.index) < std::tie(b.x, b.y, b.index);
  });
  std::vector<std::size_t> front;
  double best = std::numeric_limits<double>::infinity(), best_x = best;
  for (const TradeOff& point : points) {
    const bool twin = point.x == best_x && point.y == best;
    if (point.y >= best && !twin) continue;
    best = point.y;
    best_x = point.x;
    front.push_back(point.index);
  }
  return front;
}

std::vector<std::size_t> detailed_runs(const std::vector<ReportRun>& runs,
                                       const ReportOptions& options) {
  std::map<std::string, std::size_t> counts;
  for (const ReportRun& run : runs) ++counts[run.sequence];
  std::string chosen;  // of equals the first in the order of the runs
  for (const ReportRun& run : runs) {
    if (chosen.empty() || counts[run.sequence] > counts[chosen]) chosen = run.sequence;
  }
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto most = static_cast<std::size_t>(std::max(options.detailed_runs, 0));
    if (runs[i].sequence == chosen && indices.size() < most) indices.push_back(i);
  }
  return indices;
}

Json report_data(const std::vector<ReportRun>& runs, const ReportOptions& options) {
  const std::vector<std::size_t> detailed = detailed_runs(runs, options);
  std::vector<const ReportRun*> shown;
  std::size_t frames = 0;
  for (const std::size_t i : detailed) {
    shown.push_back(&runs[i]);
    frames += runs[i].frames.at("index").size();
  }
  const std::size_t step = std::max<std::size_t>(1, (frames + most_frames - 1) / most_frames);

  // As many pictures as fit.
  std::optional<std::vector<Json>> pictures;
  std::size_t count = usual_pictures;
  while (!(pictures = pictures_json(shown, options, count, most_picture_bytes))) {
    if (count == 0 || !options.picture_frames.empty()) break;
    --count;
  }

  Json data = {{"title", options.title},
               {"program", "slambench " + version_text()},
               {"limits",
                {{"detailed_runs", detailed.size()},
                 {"frame_step", step},
                 {"pictures_left_out", !pictures.has_value()}}},
               {"fronts", fronts_json(runs)},
               {"runs", Json::array()}};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Json run = {{"name", runs[i].name},
                {"folder", runs[i].folder},
                {"sequence", runs[i].sequence},
                {"variant", runs[i].variant},
                {"record", runs[i].record}};
    const auto at = std::find(detailed.begin(), detailed.end(), i);
    if (at != detailed.end()) {
      const auto nth = static_cast<std::size_t>(at - detailed.begin());
      run["frames"] = frames_json(runs[i].frames, step);
      run["paths"] = paths_json(runs[i], step);
      run["power"] = power_json(runs[i]);
      run["pictures"] = pictures ? (*pictures)[nth] : Json::array();
    }
    data["runs"].push_back(run);
  }
  return data;
}

}  // namespace slambench
