// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace slambench {

/// Why a sensor cannot be read: a sentence that names it.
class MeterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The small files by which Linux tells of the machine: /sys and /proc, or a copy of them below
/// another root. Files are opened at every reading, so that one that vanished is noticed.
class SystemFiles {
 public:
  explicit SystemFiles(std::string root = "") : root_(std::move(root)) {}

  /// The path in the real file system.
  std::string path(std::string_view file) const { return root_ + std::string(file); }

  bool exists(std::string_view file) const;
  /// Names in a folder, in natural order ("hwmon2" before "hwmon10"); none when there is no folder.
  std::vector<std::string> names(std::string_view folder) const;
  /// The last part of what a symbolic link points to; empty when it is none.
  std::string link_target_name(std::string_view file) const;

  /// Without blanks at both ends. Throws MeterError with the system's reason.
  std::string text(std::string_view file) const;
  /// Empty when it cannot be read.
  std::string text_or_empty(std::string_view file) const;
  /// Throws MeterError also when the text is not a number as a whole.
  std::uint64_t count(std::string_view file) const;
  double number(std::string_view file) const;

 private:
  std::string root_;
};

/// Where Linux tells of processors.
constexpr const char* processors_folder = "/sys/devices/system/cpu";

/// The folder of each processor in it.
std::vector<std::string> processor_folders(const SystemFiles& files);

}  // namespace slambench
