// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/statistics.h"
#include "kernels/kernel.h"

namespace slambench {

// What the meters found out about one run: plain data. A figure without a value was not measured.

/// Energy over the frames of a run, of one rail or of several together.
struct EnergyFigures {
  double joules = 0;
  double joules_per_frame = 0;
  double mean_w = 0;
  std::optional<double> peak_w;             ///< highest mean between two updates of the sensor
  std::optional<double> idle_w;             ///< mean of the idle baseline
  std::optional<double> joules_above_idle;  ///< joules - idle_w x seconds
  double energy_delay_js = 0;               ///< joules a frame x seconds a frame
  std::optional<double> frames_per_joule;
};

/// One rail: a supply line, or a domain of a processor, that a sensor measures.
struct RailEnergy {
  std::string name;       ///< "package-0", "A15", "VDD_IN"
  std::string sensor;     ///< "powercap intel-rapl:0"
  std::string reads;      ///< "energy" (a counter, differenced) or "power" (integrated over time)
  std::string within;     ///< the rail whose energy holds this one's; empty: none is known
  bool in_total = false;  ///< added up in the total
  double resolution = 0;  ///< smallest step of the reading, J or W as `reads` says
  int updates = 0;        ///< readings that differed from the one before
  EnergyFigures figures;
};

struct EnergyMeasurement {
  double seconds = 0;                  ///< from just before the first frame to just after the last
  int frames = 0;                      ///< processed in that time
  std::optional<double> idle_seconds;  ///< duration of the idle baseline
  std::vector<RailEnergy> rails;
  std::optional<EnergyFigures> total;  ///< of the rails that are `in_total`
};

struct MemoryMeasurement {
  std::optional<std::size_t> peak_resident_bytes;  ///< largest resident set during the frames
  std::optional<std::size_t> resident_bytes;       ///< resident set after the last frame
  std::optional<std::size_t> device_bytes;         ///< memory of a device of its own
};

/// Events that the processor counted in user space, of all threads.
struct CounterValues {
  std::optional<std::uint64_t> cycles, instructions, cache_misses, branch_misses;
};

/// By stage, over all processed frames.
struct CounterMeasurement {
  int frames = 0;
  std::array<CounterValues, stage_count> stages{};
};

/// The state of the machine while the frames ran.
struct Conditions {
  std::optional<double> others_load;  ///< processors that anything but this process kept busy
  std::string governor;               ///< of the processor's frequency; "a, b" when they differ
  std::optional<Statistics> cpu_frequency_hz;       ///< mean of all processors, over the samples
  std::map<std::string, Statistics> temperature_c;  ///< by sensor, over the samples
  std::optional<int> throttled;                     ///< times that heat slowed the processor
  std::vector<std::string> noise;  ///< what may have disturbed the times, and what to do about it
};

/// One reading of one sensor.
struct MeterSample {
  double time_s = 0;  ///< since the first frame began
  double value = 0;
};
struct SampleSeries {
  std::string name, unit;
  std::vector<MeterSample> samples;
};

/// How the sensors were read.
struct Sampling {
  double interval_s = 0;
  int samples = 0;          ///< times that the sensors were read
  double cpu_s = 0;         ///< processor time that reading them took
  double share_of_run = 0;  ///< cpu_s / the duration
  std::vector<SampleSeries> series;
};

/// Everything that the meters know of one run.
struct Measurements {
  std::optional<Sampling> sampling;
  std::optional<EnergyMeasurement> energy;
  MemoryMeasurement memory;
  std::optional<CounterMeasurement> counters;
  Conditions conditions;
  /// Why a figure could not be measured, by its place in record.json ("energy.rails.A15").
  std::map<std::string, std::string> absent;
};

}  // namespace slambench
