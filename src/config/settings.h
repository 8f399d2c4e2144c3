// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/config_file.h"
#include "config/presets.h"
#include "core/parameter.h"
#include "results/record.h"

namespace slambench {

/// The text that the record would show of this value; the parameter stays as it is. Throws
/// UsageError as set_from_text() does.
std::string canonical_text(const Parameter& parameter, std::string_view text);

/// Who sets a value, from weak to strong: a sequence's reader suggests, a sequence's own file
/// knows.
enum class Origin { defaults, reader, sequence, preset, file, command_line };

/// The parameters of one run and who set each. Whatever the order of the calls, the strongest
/// origin wins; of one origin, the last call.
class Settings {
 public:
  /// The values that the lists point to must outlive this object and hold their defaults.
  explicit Settings(std::vector<ParameterList> lists);

  const std::vector<ParameterList>& lists() const { return lists_; }

  /// Throws UsageError for an unknown name or a value that does not fit.
  void set(std::string_view name, std::string_view text, Origin origin, std::string set_by);

  void apply(const Preset& preset);
  void apply(const ConfigFile& file);
  /// What the sequence's reader suggests.
  void suggest(const std::vector<std::pair<std::string, std::string>>& assignments);

  /// "default", "sequence", "sequence file PATH", "preset NAME", "file PATH", "command line".
  const std::string& set_by(std::string_view name) const;

  std::vector<UsedParameter> used() const;

 private:
  struct Setter {
    Origin origin = Origin::defaults;
    std::string name = "default";
  };
  /// Of the parameter in the same place in the lists; throws UsageError.
  std::pair<const Parameter*, std::size_t> locate(std::string_view name) const;

  std::vector<ParameterList> lists_;
  std::vector<Setter> setters_;  ///< one per parameter, in the order of the lists
};

}  // namespace slambench
