// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "cli/small_recording.h"
#include "support/program.h"

namespace slambench::testing {

/// The program in a folder with the results of a small run, `out`.
class SmallResultTest : public ::testing::Test {
 protected:
  void SetUp() override {
    program_.folder().write("small.raw", small_raw(8));
    ASSERT_EQ(program_.run(small_run()).status, 0);
  }
  std::string file(const std::string& name) const {
    return Program::contents(program_.folder().path(name));
  }

  Program program_{SLAMBENCH_PROGRAM};
};

}  // namespace slambench::testing
