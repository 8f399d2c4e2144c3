// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/measurements_json.h"

#include <fmt/format.h>

#include "results/run_statistics.h"

namespace slambench {
namespace {

using Json = nlohmann::ordered_json;
using Reasons = std::map<std::string, std::string>;

template <class T>
void put(Json* object, const char* key, const std::optional<T>& value) {
  if (value) (*object)[key] = *value;
}

void put_text(Json* object, const char* key, const std::string& text) {
  if (!text.empty()) (*object)[key] = text;
}

Json json_of(const Statistics& s) {
  return {{"count", s.count}, {"mean", s.mean}, {"median", s.median},
          {"min", s.min},     {"max", s.max},   {"std", s.std}};
}

void put_figures(const EnergyFigures& f, Json* json) {
  (*json)["joules"] = f.joules;
  (*json)["joules_per_frame"] = f.joules_per_frame;
  (*json)["mean_w"] = f.mean_w;
  put(json, "peak_w", f.peak_w);
  put(json, "idle_w", f.idle_w);
  put(json, "joules_above_idle", f.joules_above_idle);
  (*json)["energy_delay_js"] = f.energy_delay_js;
  put(json, "frames_per_joule", f.frames_per_joule);
}

Json rail_json(const RailEnergy& rail) {
  Json json = {{"sensor", rail.sensor}, {"reads", rail.reads}};
  put_text(&json, "within", rail.within);
  json["in_total"] = rail.in_total;
  json[rail.reads == "power" ? "resolution_w" : "resolution_j"] = rail.resolution;
  json["updates"] = rail.updates;
  put_figures(rail.figures, &json);
  return json;
}

Json energy_json(const EnergyMeasurement& energy) {
  Json json = {{"seconds", energy.seconds}, {"frames", energy.frames}};
  put(&json, "idle_seconds", energy.idle_seconds);
  Json rails = Json::object();
  for (const RailEnergy& rail : energy.rails) rails[rail.name] = rail_json(rail);
  json["rails"] = rails;
  if (energy.total) {
    json["total"] = Json::object();
    put_figures(*energy.total, &json["total"]);
  }
  return json;
}

Json counters_json(const CounterMeasurement& counters) {
  Json stages = Json::object();
  for (std::size_t i = 0; i < stage_count; ++i) {
    const auto stage = static_cast<Stage>(i);
    if (stage == Stage::init) continue;
    const CounterValues& values = counters.stages[i];
    Json json = Json::object();
    put(&json, "cycles", values.cycles);
    put(&json, "instructions", values.instructions);
    put(&json, "cache_misses", values.cache_misses);
    put(&json, "branch_misses", values.branch_misses);
    stages[std::string(name(stage))] = json;
  }
  return {{"frames", counters.frames}, {"stages", stages}};
}

Json conditions_json(const Conditions& conditions) {
  Json json = Json::object();
  put(&json, "others_load", conditions.others_load);
  put_text(&json, "governor", conditions.governor);
  if (conditions.cpu_frequency_hz) json["cpu_frequency_hz"] = json_of(*conditions.cpu_frequency_hz);
  if (!conditions.temperature_c.empty()) {
    Json sensors = Json::object();
    for (const auto& [sensor, celsius] : conditions.temperature_c) {
      sensors[sensor] = json_of(celsius);
    }
    json["temperature_c"] = sensors;
  }
  put(&json, "throttled", conditions.throttled);
  json["noise"] = conditions.noise;
  return json;
}

Json sampling_json(const Sampling& sampling) {
  return {{"interval_s", sampling.interval_s},
          {"samples", sampling.samples},
          {"cpu_s", sampling.cpu_s},
          {"share_of_run", sampling.share_of_run}};
}

Json repetition_json(const Repetition& repetition) {
  Json figures = Json::object();
  for (const auto& [place, figure] : repetition.figures) {
    Json json = {{"unit", figure.unit}, {"values", figure.values}, {"median", figure.median}};
    put(&json, "low", figure.low);
    put(&json, "high", figure.high);
    put(&json, "run_spread", figure.run_spread);
    put(&json, "frame_spread", figure.frame_spread);
    figures[place] = json;
  }
  return {{"runs", repetition.runs},
          {"warmup_runs", repetition.warmup_runs},
          {"shown_run", repetition.shown_run},
          {"same_trajectory", repetition.other_trajectory.empty()},
          {"other_trajectory", repetition.other_trajectory},
          {"figures", figures}};
}

}  // namespace

void put_measurements(const Record& record, Json* document, Reasons* absent) {
  const Measurements& m = record.measurements;
  absent->insert(m.absent.begin(), m.absent.end());
  if (m.energy) {
    (*document)["energy"] = energy_json(*m.energy);
  } else {
    absent->try_emplace("energy", not_metered);
  }
  if (m.counters) {
    (*document)["counters"] = counters_json(*m.counters);
  } else {
    absent->try_emplace("counters", not_metered);
  }
  Json& memory = (*document)["memory"];
  const auto put_bytes = [&](const char* key, const std::optional<std::size_t>& bytes) {
    put(&memory, key, bytes);
    if (!bytes) absent->try_emplace(fmt::format("memory.{}", key), not_metered);
  };
  put_bytes("peak_resident_bytes", m.memory.peak_resident_bytes);
  put_bytes("resident_bytes", m.memory.resident_bytes);
  put_bytes("device_bytes", m.memory.device_bytes);
  (*document)["conditions"] = conditions_json(m.conditions);
  if (m.sampling) (*document)["sampling"] = sampling_json(*m.sampling);
  (*document)["repetition"] = repetition_json(record.repetition);
  for (const std::string& place : record.repetition.lacking) {
    absent->try_emplace(fmt::format("repetition.figures.{}", place), "not measured in every run");
  }
}

}  // namespace slambench
