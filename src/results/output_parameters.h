// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>

#include "core/parameter.h"

namespace slambench {

/// What a user can say about the results of a run.
struct OutputParameters {
  std::string out;  ///< empty: a fresh folder, see default_result_folder
  bool force = false;
  int images = 0;           ///< pictures of every so many frames; 0: none
  std::string log_file;     ///< empty: only in the results folder
  std::string dump_volume;  ///< empty: none
  bool quiet = false;
  bool json = false;
  bool no_gui = false;  ///< nothing opens a window; accepted because scripts say it

  ParameterList describe();
};

}  // namespace slambench
