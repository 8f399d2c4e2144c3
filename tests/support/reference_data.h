// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

/// Skips the test unless SLAMBENCH_DATA names the folder with the public sequences.
#define SLAMBENCH_REQUIRE_DATA()                                                       \
  if (std::getenv("SLAMBENCH_DATA") == nullptr) {                                      \
    GTEST_SKIP() << "SLAMBENCH_DATA does not name the folder of the public sequences"; \
  }                                                                                    \
  static_assert(true)

namespace slambench::testing {

/// A path below the folder that SLAMBENCH_DATA names.
inline std::string reference_data(const std::string& name) {
  return std::string(std::getenv("SLAMBENCH_DATA")) + "/" + name;
}

}  // namespace slambench::testing
