// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "verify/random.h"

namespace slambench {
namespace {

/// FNV-1a.
std::uint64_t hash(std::string_view text) {
  std::uint64_t value = 14695981039346656037u;
  for (const char c : text) value = (value ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return value;
}

}  // namespace

Random::Random(std::uint64_t seed, std::string_view name) : engine_(seed ^ hash(name)) {}

double Random::uniform() { return static_cast<double>(engine_() >> 40) * 0x1p-24; }
double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }
int Random::index(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }

}  // namespace slambench
