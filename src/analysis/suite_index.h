// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace slambench {

/// The file in a suite's folder that says what lies in its other folders (docs/suite.md).
inline constexpr const char* suite_index_name = "suite.json";

struct SuiteIndex {
  struct Configuration {
    std::string folder;             ///< of its runs, beside the file
    std::string sequence, variant;  ///< what tables call the row and the column
    std::string path, preset;       ///< what is run; "" where that is not known or not set
    std::vector<std::pair<std::string, std::string>> parameters;
  };
  std::string title;
  std::string executable;  ///< hash of the program that made the results
  std::vector<Configuration> configurations;
};

/// Throws InputError naming the file for what cannot be read or is not what suite_index_json()
/// gives.
SuiteIndex read_suite_index(const std::string& file);

std::string suite_index_json(const SuiteIndex& index);

}  // namespace slambench
