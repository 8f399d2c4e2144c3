// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/stored_run.h"
#include "core/parameter.h"

namespace slambench {

/// What each parameter decides, by group and name ("kinectfusion.mu"). One that is not there is of
/// the task: a record may come from another version of this program.
using ParameterRoles = std::map<std::string, ParameterRole, std::less<>>;
ParameterRoles roles_of(const std::vector<ParameterList>& lists);

/// Repeated runs of one configuration, in the order in which they ran.
struct RunGroup {
  std::string name;  ///< as the user wrote it
  std::vector<StoredRun> runs;
};

/// From an argument: a result folder, a record.json, a folder that holds result folders, or
/// several of these joined by commas. Throws InputError for what cannot be read, for a run that
/// is incomplete or not valid, and for runs that are not repeats of each other.
RunGroup read_run_group(const std::string& argument, const ParameterRoles& roles);

/// Something in which two runs differ.
struct RunDifference {
  enum class Kind {
    task,            ///< what was computed: such runs are compared only when the user says so
    implementation,  ///< how it was computed and measured
    build,           ///< which program on which machine
  };
  Kind kind = Kind::task;
  std::string key, base, other;  ///< "volume-size", "5,5,5", "4.8,4.8,4.8"
};

/// In the order: task, implementation, build.
std::vector<RunDifference> differences(const StoredRun& base, const StoredRun& other,
                                       const ParameterRoles& roles);

/// "mu (0.1 against 0.2), far (4 against 5)".
std::string list_text(const std::vector<RunDifference>& list);

/// Throws InputError that names each difference of the task whose key is not in `allowed`.
void require_same_task(const RunGroup& base, const RunGroup& other,
                       const std::vector<std::string>& allowed, const ParameterRoles& roles);

/// Whether the run dropped frames that came too late, so that no two runs need be alike.
bool in_real_time(const StoredRun& run);

}  // namespace slambench
