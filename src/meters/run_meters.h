// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/parameter.h"
#include "meters/conditions.h"
#include "meters/memory.h"
#include "meters/meter.h"
#include "meters/sampling_thread.h"
#include "meters/stage_counters.h"

namespace slambench {

/// What a user can say about meters.
struct MeterParameters {
  double meter_rate = 10;  ///< readings a second; 0: none
  double idle = 0;         ///< seconds of the baseline; 0: none
  bool counters = false;
  std::string sysfs_root;  ///< empty: of this machine
  std::string nvml_library = "libnvidia-ml.so.1";

  ParameterList describe();
  MeterContext context() const;
};

/// All meters around the runs of one command. Make it before the threads that it is to count.
class RunMeters {
 public:
  RunMeters(const MeterParameters& parameters, const MeterContext& context, const Clock& clock);

  /// Measures the idle machine for that long; `go_on` is asked now and then and can end it.
  void measure_idle(double seconds, const std::function<bool()>& go_on);

  /// Around the frames of a run, of which `frames` were processed.
  void begin();
  Measurements end(int frames);

  /// Who is to be told of stages (counters); null when nobody is.
  Observer* stages() { return counters_.get(); }

 private:
  void add_energy(const std::vector<Channel>& channels, int frames, Measurements* to) const;
  void add_conditions(std::vector<Channel> channels, Measurements* to) const;

  const Clock& clock_;
  std::unique_ptr<StageCounters> counters_;
  std::string no_counters_;
  std::vector<RefusedMeter> refused_;  ///< of energy
  std::string no_energy_;              ///< why there is no rail at all
  std::unique_ptr<Sampler> sampler_;   ///< null when there is nothing to sample
  std::optional<SamplingThread> thread_;
  double cpu_s_ = 0;
  std::map<std::string, double> idle_w_;
  std::optional<double> idle_seconds_;
  MemoryMeter memory_;
  ConditionsMeter conditions_;
};

}  // namespace slambench
