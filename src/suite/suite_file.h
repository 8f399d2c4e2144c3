// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/config_file.h"
#include "core/parameter.h"

namespace slambench {

/// What is set of a part of a suite: `preset` is empty when it says none.
struct SuiteSettings {
  std::string preset;
  std::vector<ConfigAssignment> assignments;
};

/// A parameter, or "preset", and the values that the runs go through.
struct SuiteAxis {
  std::string name;
  std::vector<std::string> values;  ///< as on the command line
};

struct SuiteSequence {
  /// As slambench run takes it; ${NAME} stands for the environment's NAME. Empty: not known here.
  std::string path;
  std::string name;       ///< what tables call it
  bool optional = false;  ///< left out where it is not there
  bool available = true;
  int line = 0;  ///< of the file, for messages
  SuiteSettings settings;
};

struct SuiteGroup {
  std::string name;                    ///< empty for the one group of a suite that names none
  std::vector<std::string> sequences;  ///< names; empty: all
  SuiteSettings settings;
  std::vector<SuiteAxis> axes;  ///< in the order of the file; hides the suite's of the same name
};

/// A suite as its file says it (docs/suite.md).
struct SuiteFile {
  std::string path, title;
  SuiteSettings settings;
  std::vector<SuiteAxis> axes;
  std::vector<SuiteSequence> sequences;  ///< one at least
  std::vector<SuiteGroup> groups;        ///< one at least
};

/// Reads and checks a file against the lists of parameters, whose values stay as they are. Throws
/// InputError naming file, line and key: what is not TOML, an unknown key (and the nearest known
/// one), a value of the wrong type or outside its range, an unknown preset or sequence, two of one
/// name, a suite without a sequence.
SuiteFile read_suite_file(const std::string& path, const std::vector<ParameterList>& lists);

/// The same for text that is already in memory; `path` is for messages.
SuiteFile parse_suite(std::string_view text, const std::string& path,
                      const std::vector<ParameterList>& lists);

}  // namespace slambench
