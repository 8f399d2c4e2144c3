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

/// Removes what killed processes left behind in the folder while they wrote: write_file()'s
/// temporary files that are older than a day, as younger ones may belong to a process that runs.
void remove_leftovers(const std::string& folder);

/// The whole file, or what comes through a pipe that somebody writes to. Throws InputError naming
/// the file and the system's reason; a folder or a device is no file.
std::string read_file(const std::string& path);

/// A file of any size that is read in pieces. It may be changed or shortened meanwhile: unlike of a
/// mapped one, what is missing then is an error and not the end of the process.
class PiecewiseFile {
 public:
  /// Throws InputError naming the file and the system's reason.
  explicit PiecewiseFile(std::string path);
  ~PiecewiseFile();
  PiecewiseFile(const PiecewiseFile&) = delete;
  PiecewiseFile& operator=(const PiecewiseFile&) = delete;

  /// Bytes when it was opened.
  std::size_t size() const { return size_; }
  /// Fills all of `destination` from this place on. Throws InputError when the file ends before.
  void read(std::size_t offset, std::span<std::byte> destination) const;

 private:
  const std::string path_;
  int file_ = -1;
  std::size_t size_ = 0;
};

/// The user's cache folder for this program: $XDG_CACHE_HOME/slambench, else ~/.cache/slambench.
std::string cache_folder();

}  // namespace slambench
