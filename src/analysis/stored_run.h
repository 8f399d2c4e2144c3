// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace slambench {

/// A run as its record.json tells it, whatever version of this program wrote it. A place is where
/// a value stands in that file: "time.fps_computation".
struct StoredRun {
  std::string path;                           ///< of the record.json, for messages
  std::map<std::string, double> numbers;      ///< by place
  std::map<std::string, std::string> texts;   ///< by place; booleans are "true" and "false"
  std::map<std::string, std::string> absent;  ///< by place: why it was not measured

  /// By place: the value of each measured repeat of the run (--repeat), where there are several.
  std::map<std::string, std::vector<double>> repeats;

  /// "" when there is none.
  std::string text(const std::string& place) const;
  /// A text, or a number as text; nothing when there is neither.
  std::optional<std::string> value_text(const std::string& place) const;
  /// "kinectfusion.mu": of every parameter.
  std::set<std::string> parameters() const;
  /// Its value by that name; nothing when the run has no such parameter.
  std::optional<std::string> parameter(const std::string& group_and_name) const;
  /// Measured repeats.
  std::size_t run_count() const { return repeats.empty() ? 1 : repeats.begin()->second.size(); }
  bool complete() const { return text("complete") == "true"; }
  bool valid() const { return text("valid") == "true"; }
};

/// Throws InputError for a run that was interrupted or is not valid.
void require_counts(const StoredRun& run);

/// From a result folder or a record.json. Throws InputError naming the file for what cannot be read
/// or is not the record of a run.
StoredRun read_stored_run(const std::string& path);

/// The same for a text that is already in memory; `path` is for messages.
StoredRun parse_stored_run(std::string_view json, const std::string& path);

}  // namespace slambench
