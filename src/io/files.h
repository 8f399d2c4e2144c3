// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace slambench {

/// Writes a file whole or not at all: to a temporary name beside it, flushed, then renamed.
/// Throws Error(failed) naming the file and the system's reason; nothing is left behind then.
void write_file(const std::string& path, std::string_view contents);

/// The whole file. Throws InputError naming the file and the system's reason; a folder is not one.
std::string read_file(const std::string& path);

/// A file mapped for reading, of any size.
class MappedFile {
 public:
  /// Throws InputError naming the file and the system's reason.
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

/// The user's cache folder for this program: $XDG_CACHE_HOME/slambench, else ~/.cache/slambench.
std::string cache_folder();

}  // namespace slambench
