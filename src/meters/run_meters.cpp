// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/run_meters.h"

#include <fmt/format.h>

#include <algorithm>

namespace slambench {
namespace {

/// How often a baseline asks whether it is to go on.
constexpr double ask_interval_s = 0.05;
/// Between readings: a thread cannot wait for ever.
constexpr double longest_interval_s = 1000;

bool is_energy(Quantity quantity) {
  return quantity == Quantity::energy_j || quantity == Quantity::power_w;
}

const char* unit_of(Quantity quantity) {
  if (is_energy(quantity)) return "W";
  return quantity == Quantity::frequency_hz ? "Hz" : "degree C";
}

Statistics statistics_of(const std::vector<MeterSample>& samples) {
  std::vector<double> values;
  values.reserve(samples.size());
  for (const MeterSample& sample : samples) values.push_back(sample.value);
  return summarize(values);
}

EnergyFigures figures_of(double joules, double seconds, int frames, std::optional<double> peak_w,
                         std::optional<double> idle_w) {
  EnergyFigures figures;
  figures.joules = joules;
  figures.mean_w = joules / seconds;
  figures.joules_per_frame = joules / frames;
  figures.energy_delay_js = figures.joules_per_frame * seconds / frames;
  figures.peak_w = peak_w;
  figures.idle_w = idle_w;
  if (idle_w) figures.joules_above_idle = joules - *idle_w * seconds;
  if (joules > 0) figures.frames_per_joule = frames / joules;
  return figures;
}

/// Peaks of rails need not fall together: the total has none.
EnergyFigures total_of(const std::vector<RailEnergy>& rails, double seconds, int frames) {
  double joules = 0;
  std::optional<double> idle_w = 0;
  for (const RailEnergy& rail : rails) {
    if (!rail.in_total) continue;
    joules += rail.figures.joules;
    if (rail.figures.idle_w && idle_w) {
      *idle_w += *rail.figures.idle_w;
    } else {
      idle_w.reset();
    }
  }
  return figures_of(joules, seconds, frames, std::nullopt, idle_w);
}

}  // namespace

ParameterList MeterParameters::describe() {
  return with_role(ParameterRole::implementation,
                   {"meters",
                    {{"meter-rate", 0, "Hz", &meter_rate, 0, 1000,
                      "how often sensors of energy, frequency and temperature are read; 0: never"},
                     {"idle", 0, "s", &idle, 0, 3600,
                      "measure the idle machine's power for so long before the run; 0: not"},
                     {"counters", 0, "", &counters, 0, 0,
                      "count cycles, instructions, cache and branch misses of each stage"},
                     {"sysfs-root", 0, "", &sysfs_root, 0, 0,
                      "folder in which /sys and /proc are looked for, instead of /"},
                     {"nvml-library", 0, "", &nvml_library, 0, 0,
                      "NVIDIA's management library, a name that the loader finds or a path"}}});
}

MeterContext MeterParameters::context() const {
  return {SystemFiles(sysfs_root), &system_perf_events(), nvml_library};
}

RunMeters::RunMeters(const MeterParameters& parameters, const MeterContext& context,
                     const Clock& clock)
    : clock_(clock), conditions_(context.files, clock) {
  no_counters_ = "not asked for: --counters";
  if (parameters.counters) {
    try {
      counters_ = std::make_unique<StageCounters>(*context.perf);
    } catch (const MeterError& error) {
      no_counters_ = error.what();
    }
  }
  if (!(parameters.meter_rate > 0)) {
    no_energy_ = "sensors are not read: --meter-rate 0";
    return;
  }
  FoundMeters found = find_meters(context);
  refused_ = std::move(found.refused);
  no_energy_ = found.unavailable;
  if (found.meters.empty()) return;
  sampler_ = std::make_unique<Sampler>(std::move(found.meters), clock,
                                       std::min(longest_interval_s, 1 / parameters.meter_rate));
}

void RunMeters::measure_idle(double seconds, const std::function<bool()>& go_on) {
  if (!sampler_ || seconds <= 0) return;
  sampler_->begin();
  {
    SamplingThread thread(*sampler_);
    const double end_s = clock_.now_s() + seconds;
    while (go_on() && clock_.now_s() < end_s) {
      clock_.sleep_until(std::min(end_s, clock_.now_s() + ask_interval_s));
    }
  }
  sampler_->end();
  if (!(sampler_->seconds() > 0)) return;
  idle_seconds_ = sampler_->seconds();
  for (const Channel& channel : sampler_->channels()) {
    if (!is_energy(channel.info.quantity) || !channel.failure.empty()) continue;
    idle_w_[channel.info.name] = channel.joules / *idle_seconds_;
  }
}

void RunMeters::begin() {
  if (counters_) {
    std::map<std::string, std::string> ignored;
    counters_->take(0, &ignored);
  }
  memory_.begin();
  conditions_.begin();
  if (!sampler_) return;
  const double before_s = thread_cpu_s();
  sampler_->begin();
  cpu_s_ = thread_cpu_s() - before_s;
  thread_.emplace(*sampler_);
}

Measurements RunMeters::end(int frames) {
  Measurements m;
  if (sampler_) {
    cpu_s_ += thread_->stop();
    thread_.reset();
    const double before_s = thread_cpu_s();
    sampler_->end();
    cpu_s_ += thread_cpu_s() - before_s;
  }
  conditions_.end(&m.conditions);
  memory_.end(&m.memory, &m.absent);
  if (counters_) {
    m.counters = counters_->take(frames, &m.absent);
  } else {
    m.absent["counters"] = no_counters_;
  }
  std::vector<Channel> channels;
  if (sampler_) channels = sampler_->channels();
  add_energy(channels, frames, &m);
  add_conditions(std::move(channels), &m);
  return m;
}

void RunMeters::add_energy(const std::vector<Channel>& channels, int frames,
                           Measurements* to) const {
  std::string lacking;  // of the total
  for (const auto& [info, reason] : refused_) {
    to->absent[fmt::format("energy.rails.{}", info.name)] = reason;
    if (info.in_total) lacking = info.name;
  }
  EnergyMeasurement energy;
  energy.frames = frames;
  energy.idle_seconds = idle_seconds_;
  bool any_in_total = false;
  if (sampler_) energy.seconds = sampler_->seconds();
  std::string failure = no_energy_;
  for (const Channel& channel : channels) {
    const MeterInfo& info = channel.info;
    if (!is_energy(info.quantity)) continue;
    any_in_total |= info.in_total;
    std::string reason = channel.failure;
    if (reason.empty() && (frames == 0 || !(energy.seconds > 0))) reason = "no frame was processed";
    if (!reason.empty()) {
      to->absent[fmt::format("energy.rails.{}", info.name)] = reason;
      failure = reason;
      if (info.in_total) lacking = info.name;
      continue;
    }
    const auto idle = idle_w_.find(info.name);
    energy.rails.push_back(
        {.name = info.name,
         .sensor = info.sensor,
         .reads = info.quantity == Quantity::energy_j ? "energy" : "power",
         .within = info.within,
         .in_total = info.in_total,
         .resolution = info.resolution,
         .updates = channel.updates,
         .figures =
             figures_of(channel.joules, energy.seconds, frames, channel.peak_w,
                        idle == idle_w_.end() ? std::nullopt : std::optional(idle->second))});
  }
  if (energy.rails.empty()) {
    to->absent["energy"] = failure;
    return;
  }
  if (!lacking.empty()) {
    to->absent["energy.total"] = fmt::format("{} was not measured", lacking);
  } else if (any_in_total) {
    energy.total = total_of(energy.rails, energy.seconds, frames);
  } else {
    to->absent["energy.total"] = "what these rails supply is not known";
  }
  to->energy = std::move(energy);
}

void RunMeters::add_conditions(std::vector<Channel> channels, Measurements* to) const {
  std::vector<MeterSample> frequency_hz;
  if (sampler_) {
    Sampling sampling;
    sampling.interval_s = sampler_->interval_s();
    sampling.samples = sampler_->samples();
    sampling.cpu_s = cpu_s_;
    sampling.share_of_run = sampler_->seconds() > 0 ? cpu_s_ / sampler_->seconds() : 0;
    for (Channel& channel : channels) {
      if (!channel.failure.empty() || channel.samples.empty()) continue;
      const MeterInfo& info = channel.info;
      if (info.quantity == Quantity::frequency_hz) {
        frequency_hz = channel.samples;
        to->conditions.cpu_frequency_hz = statistics_of(channel.samples);
      }
      if (info.quantity == Quantity::temperature_c) {
        to->conditions.temperature_c[info.name] = statistics_of(channel.samples);
      }
      sampling.series.push_back({info.name, unit_of(info.quantity), std::move(channel.samples)});
    }
    to->sampling = std::move(sampling);
  }
  to->conditions.noise = noise_in(to->conditions, frequency_hz);
}

}  // namespace slambench
