// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "meters/clock.h"
#include "meters/measurements.h"
#include "meters/meter.h"

namespace slambench {

/// What one meter told between begin() and end().
struct Channel {
  MeterInfo info;
  std::string failure;  ///< why it is not valid; empty: it is
  int readings = 0;
  int updates = 0;    ///< readings that differed from the one before
  double joules = 0;  ///< of energy the difference, of power the integral over time (trapezoids)
  std::optional<double> peak_w;
  std::vector<MeterSample> samples;  ///< W, Hz or degrees; of energy the mean since the last update
};

/// Reads meters, adds up what they say. Not to be used by two threads at once.
class Sampler {
 public:
  /// Readings are meant to follow each other by about that time.
  Sampler(std::vector<std::unique_ptr<Meter>> meters, const Clock& clock, double interval_s);
  ~Sampler();

  /// Begins anew: the first reading.
  void begin();
  /// Readings between. Frequencies and temperatures are read once a second only.
  void sample();
  /// The last reading.
  void end();

  /// Of the measurement that ended: its duration, and the channels in the order of the meters.
  double seconds() const { return last_s_ - begin_s_; }
  int samples() const { return samples_; }
  std::vector<Channel> channels() const;
  double interval_s() const { return interval_s_; }

 private:
  class Reader;
  void read(double now_s, bool all);

  const Clock& clock_;
  const double interval_s_;
  std::vector<std::unique_ptr<Reader>> readers_;
  double begin_s_ = 0, last_s_ = 0, slow_s_ = 0;
  int samples_ = 0;
};

}  // namespace slambench
