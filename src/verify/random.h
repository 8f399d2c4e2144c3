// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace slambench {

/// Random numbers that are the same on every platform: the standard fixes the engine, not the
/// distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// A stream of its own for each name, whatever else draws from the same seed.
  Random(std::uint64_t seed, std::string_view name);

  /// In [0, 1), with 24 random bits: exact in single precision.
  double uniform();
  double uniform(double low, double high);
  float uniform_f(double low, double high) { return static_cast<float>(uniform(low, high)); }
  /// In [0, count).
  int index(int count);
  bool chance(double probability) { return uniform() < probability; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace slambench
