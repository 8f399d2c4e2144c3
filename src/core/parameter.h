// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace slambench {

/// Where a parameter's value lives and what type it has.
using ParameterPointer =
    std::variant<bool*, int*, double*, std::string*, std::array<int, 3>*, std::array<double, 3>*,
                 std::vector<int>*, std::optional<double>*, std::optional<std::array<double, 4>>*>;

/// What of a run a parameter decides.
enum class ParameterRole {
  task,            ///< what is computed
  implementation,  ///< how it is computed and measured: of equal use to the task
  bookkeeping,     ///< where results go and how often the run is repeated
};

/// Parameters of the same kind, so many that the help tells of all in one entry.
struct ParameterFamily {
  std::string_view name;      ///< with a word in capitals where theirs differ: "opencl-KERNEL"
  std::string_view sentence;  ///< what they do, for people
};

/// A described, live parameter. Structs of parameters describe themselves as a ParameterList;
/// the command line, the configuration file, the help text, the record and a search space are all
/// derived from that list, so a parameter is declared in one place.
struct Parameter {
  std::string_view name;  ///< kebab-case: the long option and the key in a TOML file
  char flag = 0;          ///< the short option, 0 for none
  std::string_view unit;  ///< "m", "px", "s", "" for a pure number
  ParameterPointer value;
  double min = 0;  ///< inclusive; holds for every component; ignored for bool and string
  double max = 0;
  std::string_view sentence;  ///< what it does, for people
  /// Allowed words of a string parameter; empty: any.
  std::vector<std::string_view> choices = {};
  /// Comparisons refuse runs that differ in a parameter of the task.
  ParameterRole role = ParameterRole::task;
  /// What the numbers of a triple are where each is something else ("GROUP,LANES,PACKETS"): all
  /// three have to be given. Empty: one number stands for three equal ones.
  std::string_view parts = {};
  const ParameterFamily* family = nullptr;  ///< null for most: of no family
};

/// The parameters of one struct, under the name of their TOML table.
struct ParameterList {
  std::string_view group;
  std::vector<Parameter> parameters;
};

/// The list with this role for all of its parameters.
ParameterList with_role(ParameterRole role, ParameterList list);

/// The value as it would be written on the command line ("256,256,256", "0.1", "true"); an unset
/// optional is "". Numbers round-trip.
std::string to_text(const Parameter& parameter);

/// Sets the value from command-line text. One number is enough for a triple without
/// parts: it is repeated. Throws UsageError naming parameter, text, and what was expected (type,
/// range, words).
void set_from_text(const Parameter& parameter, std::string_view text);

/// Throws UsageError when the value lies outside its range or words, or is not finite.
void check(const Parameter& parameter);

/// "integer in [1, 8]", "3 numbers in [0, 1]", "one of grid, bricks": for help and errors.
std::string expectation(const Parameter& parameter);

/// The parameter of that name in any of the lists; nullptr when there is none.
const Parameter* find(const std::vector<ParameterList>& lists, std::string_view name);

}  // namespace slambench
