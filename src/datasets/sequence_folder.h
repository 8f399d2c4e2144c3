// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <filesystem>
#include <string>

namespace slambench {

/// The file that marks a folder as written by this program.
inline constexpr const char* sequence_mark = "slambench.toml";

/// A folder that appears whole or not at all: it is filled beside its place and moved there.
class SequenceFolder {
 public:
  /// Reserves the place. Throws UsageError when something is there already: an empty folder may be,
  /// and with `force` one that this program wrote; Error naming the folder and the system's reason
  /// when none can be made there.
  SequenceFolder(const std::string& path, bool force);
  /// Leaves no trace when commit() was not reached.
  ~SequenceFolder();
  SequenceFolder(const SequenceFolder&) = delete;
  SequenceFolder& operator=(const SequenceFolder&) = delete;

  /// Where a file of this name is to be written now.
  std::string file(const std::string& name) const { return partial_ / name; }
  /// Makes a folder inside. Throws Error.
  void make_folder(const std::string& name) const;
  /// Puts the folder in its place, instead of an earlier one. Throws Error.
  void commit();

 private:
  const std::filesystem::path target_;
  bool replaces_ = false;
  std::filesystem::path partial_;
};

}  // namespace slambench
