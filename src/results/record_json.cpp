// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "results/measurements_json.h"
#include "results/run_statistics.h"
#include "results/writers.h"

namespace slambench {
namespace {

using Json = nlohmann::ordered_json;
using Reasons = std::map<std::string, std::string>;

void put_text(Json* object, const char* key, const std::string& text) {
  if (!text.empty()) (*object)[key] = text;
}

/// Keeps a more exact reason that the run gave.
void explain(Reasons* absent, const std::string& place, const std::string& reason) {
  absent->try_emplace(place, reason);
}

Json json_of(const Statistics& s) {
  return {{"count", s.count}, {"mean", s.mean}, {"median", s.median},
          {"p95", s.p95},     {"p99", s.p99},   {"min", s.min},
          {"max", s.max},     {"std", s.std},   {"rmse", s.rmse}};
}

/// The root mean square of durations tells nobody anything.
Json json_of_times(const Statistics& s) {
  Json json = json_of(s);
  json.erase("rmse");
  return json;
}

Json json_of(Size size) { return {{"width", size.width}, {"height", size.height}}; }

Json json_of(const std::vector<int>& frames) {
  Json list = Json::array();
  for (const auto& [first, last] : ranges(frames)) list.push_back(Json::array({first, last}));
  return list;
}

Json provenance_json(const Provenance& p) {
  Json json = Json::object();
  put_text(&json, "version", p.version);
  put_text(&json, "commit", p.commit);
  put_text(&json, "compiler", p.compiler);
  put_text(&json, "flags", p.flags);
  put_text(&json, "build_type", p.build_type);
  put_text(&json, "cpu", p.cpu);
  if (p.cores > 0) json["cores"] = p.cores;
  if (p.threads > 0) json["threads"] = p.threads;
  put_text(&json, "instruction_set", p.instruction_set);
  if (p.load_average_start) json["load_average_start"] = *p.load_average_start;
  if (p.load_average_end) json["load_average_end"] = *p.load_average_end;
  put_text(&json, "os", p.os);
  if (p.host_memory_bytes > 0) json["host_memory_bytes"] = p.host_memory_bytes;
  put_text(&json, "backend", p.backend);
  put_text(&json, "device", p.device);
  put_text(&json, "driver", p.driver);
  put_text(&json, "command", p.command);
  put_text(&json, "started_at", p.started_at);
  return json;
}

Json sequence_json(const Record& r) {
  Json json = Json::object();
  put_text(&json, "name", r.sequence);
  put_text(&json, "layout", r.layout);
  put_text(&json, "path", r.path);
  put_text(&json, "ground_truth_file", r.ground_truth_file);
  put_text(&json, "axes", r.axes);
  Json rows = Json::array();
  for (int y = 0; y < 3; ++y) {
    const auto& M = r.own_from_camera;
    rows.push_back(Json::array({M(y, 0), M(y, 1), M(y, 2)}));
  }
  json["own_from_camera"] = rows;
  json["frames"] = r.sequence_frames;
  json["input_size"] = json_of(r.input_size);
  json["computation_size"] = json_of(r.computation_size);
  json["camera"] = {
      {"fx", r.camera.fx}, {"fy", r.camera.fy}, {"cx", r.camera.cx}, {"cy", r.camera.cy}};
  json["units_per_m"] = r.units_per_m;
  put_text(&json, "input_hash", r.input_hash);
  put_text(&json, "ground_truth_hash", r.ground_truth_hash);
  return json;
}

Json parameters_json(const std::vector<UsedParameter>& parameters) {
  Json json = Json::object();
  for (const UsedParameter& p : parameters) {
    json[p.group][p.name] = {{"value", p.value}, {"unit", p.unit}, {"set_by", p.set_by}};
  }
  return json;
}

Json frames_json(const Record& r) {
  const FrameCounts counts = frame_counts(r);
  return {{"processed", counts.processed},
          {"tracked", counts.tracked},
          {"integrated", counts.integrated},
          {"untracked", counts.untracked.size()},
          {"untracked_frames", json_of(counts.untracked)},
          {"lost", counts.lost.size()},
          {"lost_frames", json_of(counts.lost)},
          {"dropped", counts.dropped.size()},
          {"dropped_frames", json_of(counts.dropped)}};
}

/// What a stage or kernel took; statistics only where it ran at all.
Json json_of(const FrameSeconds& seconds) {
  Json json = {{"seconds_per_frame", seconds.per_frame}};
  if (seconds.when_it_ran.count > 0) json["seconds"] = json_of_times(seconds.when_it_ran);
  return json;
}

void put_share(Json* json, const std::optional<double>& share) {
  if (share) (*json)["share_of_computation"] = *share;
}

Json start_up_json(const FrameTimes& init) {
  Json kernels = Json::object();
  for (const KernelInfo& kernel : kernel_table()) {
    const auto i = static_cast<std::size_t>(kernel.kernel);
    if (init.kernel_calls[i] == 0) continue;
    kernels[std::string(kernel.name)] = {{"seconds", init.kernel_s[i]},
                                         {"calls", init.kernel_calls[i]}};
  }
  return {{"seconds", init.stage(Stage::init)}, {"kernels", kernels}};
}

Json transfers_json(const std::vector<TransferFigures>& transfers) {
  Json json = Json::object();
  for (const TransferFigures& transfer : transfers) {
    Json one = json_of(transfer.seconds);
    one["count_per_frame"] = transfer.count_per_frame;
    one["bytes_per_frame"] = transfer.bytes_per_frame;
    json[std::string(name(transfer.direction))] = one;
  }
  return json;
}

void put_measured(const TimeFigures& figures, Json* json, Reasons* absent) {
  (*json)["computation_s"] = json_of_times(figures.computation_s);
  (*json)["total_s"] = json_of_times(figures.total_s);
  (*json)["read_s"] = json_of_times(figures.read_s);
  Json stages = Json::object(), kernels = Json::object();
  for (const StageFigures& stage : figures.stages) {
    Json one = json_of(stage.seconds);
    put_share(&one, stage.share);
    if (!one.contains("seconds")) {
      explain(absent, fmt::format("time.stages.{}.seconds", name(stage.stage)),
              "it ran in no measured frame");
    }
    stages[std::string(name(stage.stage))] = one;
  }
  for (const KernelFigures& kernel : figures.kernels) {
    Json one = {{"stage", std::string(name(info(kernel.kernel).stage))}};
    one.update(json_of(kernel.seconds));
    put_share(&one, kernel.share);
    one["calls"] = kernel.calls;
    one["calls_per_frame"] = kernel.calls_per_frame;
    one["seconds_per_call"] = kernel.seconds_per_call;
    kernels[std::string(name(kernel.kernel))] = one;
  }
  (*json)["stages"] = stages;
  if (figures.between_stages) {
    (*json)["between_stages"] = json_of(*figures.between_stages);
  } else {
    explain(absent, "time.between_stages", "no frame was computed in one go: stages are all");
  }
  (*json)["kernels"] = kernels;
  if (!figures.transfers.empty()) {
    (*json)["transfers"] = transfers_json(figures.transfers);
  } else {
    explain(absent, "time.transfers", "none was measured: backends in host memory have none");
  }
}

Json time_json(const Record& r, Reasons* absent) {
  const TimeFigures figures = time_figures(r);
  Json json = {{"wall_s", r.wall_s},
               {"warmup_frames", json_of(figures.warmup)},
               {"measured_frames", figures.measured_frames}};
  if (figures.fps_computation) {
    json["fps_computation"] = *figures.fps_computation;
  } else {
    explain(absent, "time.fps_computation", "no computation was measured");
  }
  if (figures.fps_wall) {
    json["fps_wall"] = *figures.fps_wall;
  } else {
    explain(absent, "time.fps_wall", "the frame loop took no measurable time");
  }
  json["read_ahead"] = r.read_ahead;
  json["start_up"] = start_up_json(r.init);
  if (figures.measured_frames > 0) {
    put_measured(figures, &json, absent);
  } else {
    for (const char* key : {"computation_s", "total_s", "read_s", "stages", "between_stages",
                            "kernels", "transfers"}) {
      explain(absent, fmt::format("time.{}", key), "no frame was processed after the warm-up");
    }
  }
  return json;
}

Json trajectory_json(const TrajectoryFigures& figures, const std::string& place, Reasons* absent) {
  Json json = {{"association", figures.association},
               {"limit_s", figures.limit_s},
               {"estimate_poses", figures.estimate_poses},
               {"ground_truth_poses", figures.ground_truth_poses},
               {"matched", figures.matched}};
  const auto put = [&](Json* object, const std::string& key, const std::string& where,
                       const Statistics& statistics) {
    if (statistics.count > 0) {
      (*object)[key] = json_of(statistics);
    } else {
      explain(absent, fmt::format("{}.{}", where, key), "no pair of poses");
    }
  };
  Json ate = Json::object();
  for (const auto& [alignment, errors] : figures.ate_m) {
    put(&ate, alignment, place + ".ate_m", errors);
  }
  json["ate_m"] = ate;
  json["rpe_delta_s"] = figures.rpe_delta_s;
  put(&json, "rpe_translation_m", place, figures.rpe_translation_m);
  put(&json, "rpe_rotation_deg", place, figures.rpe_rotation_deg);
  return json;
}

Json accuracy_json(const Record& r, Reasons* absent) {
  Json json = Json::object();
  const auto put = [&](const char* key, const std::optional<TrajectoryFigures>& figures) {
    const std::string place = fmt::format("accuracy.{}", key);
    if (figures) {
      json[key] = trajectory_json(*figures, place, absent);
    } else {
      explain(absent, place, "not judged");
    }
  };
  put("over_processed", r.over_processed);
  put("over_all", r.over_all);
  if (r.slambench1_ate_m && r.slambench1_ate_m->count > 0) {
    json["slambench1_ate_m"] = json_of(*r.slambench1_ate_m);
  } else {
    explain(absent, "accuracy.slambench1_ate_m", "not judged");
  }
  return json;
}

bool finite(const Json& json) {
  if (json.is_number_float()) return std::isfinite(json.get<double>());
  if (!json.is_array()) return true;
  return std::all_of(json.begin(), json.end(), [](const Json& element) { return finite(element); });
}

/// JSON has no NaN and no infinity: takes members that are or hold one out, and says so.
void take_out_non_finite(Json* object, const std::string& place, Reasons* absent) {
  for (auto it = object->begin(); it != object->end();) {
    const std::string here = place.empty() ? it.key() : place + "." + it.key();
    if (it->is_object()) take_out_non_finite(&*it, here, absent);
    if (finite(*it)) {
      ++it;
      continue;
    }
    explain(absent, here, "not a finite number");
    it = object->erase(it);
  }
}

}  // namespace

std::string record_json(const Record& r) {
  Reasons absent = r.absent;
  const std::vector<std::string> invalid = reasons_invalid(r);
  Json json = {{"format", "slambench-record"},
               {"schema_version", Record::schema_version},
               {"valid", invalid.empty()},
               {"invalid_reasons", invalid},
               {"complete", r.complete}};
  put_text(&json, "incomplete_reason", r.incomplete_reason);
  json["provenance"] = provenance_json(r.provenance);
  json["sequence"] = sequence_json(r);
  json["parameters"] = parameters_json(r.parameters);
  json["frames"] = frames_json(r);
  json["time"] = time_json(r, &absent);
  json["memory"] = {{"map_bytes", r.map_bytes}};
  put_text(&json["memory"], "map", r.map);
  put_measurements(r, &json, &absent);
  json["accuracy"] = accuracy_json(r, &absent);
  take_out_non_finite(&json, "", &absent);
  json["absent"] = absent;
  // A path or command line may hold bytes that are not UTF-8, which JSON cannot.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace slambench
