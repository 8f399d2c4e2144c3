// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"
#include "results/record.h"

namespace slambench {

/// "results/20150526-093000-living-room-2-serial": a folder name for a run started then (UTC).
std::string default_result_folder(std::chrono::sys_seconds started_at, std::string_view sequence,
                                  std::string_view backend);

/// The folder of one run's results. Until commit() everything lies in a folder of its own, named
/// ".NAME.slambench-partial" beside the result folder, or ".slambench-partial" inside one that
/// exists and cannot be exchanged as a whole. Only a killed process leaves it behind, and the next
/// run into the same folder removes it.
class ResultFolder {
 public:
  /// Checks and reserves the place, before the run. Throws UsageError when `path` is a file, when
  /// it holds anything and `force` is not set, when it holds anything but the results of an earlier
  /// run and `force` is set, and when another run is writing to it; Error naming the folder and the
  /// system's reason when nothing can be written there.
  ResultFolder(const std::string& path, bool force);
  /// Leaves no trace when commit() was not reached.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  /// Where the results will be, as the user named it.
  const std::string& path() const { return path_; }

  /// Saves images/frame_000120_PICTURE.png, to come with the other results; nothing for an empty
  /// image. Throws Error when it cannot be written.
  void write_image(int frame, std::string_view picture, const Image<Rgba8>& image);

  /// Writes all files and puts them in place, record.json last. Throws Error naming what failed; an
  /// earlier run's results are still there then.
  void commit(const Record& record);

 private:
  void inspect(bool force);
  void create_parents(const std::filesystem::path& folder);
  void reserve();
  void remove_traces() noexcept;
  void move_folder();
  void move_files();

  const std::string path_;
  const std::filesystem::path target_;  ///< absolute, links followed
  bool inside_ = false;                 ///< the partial folder lies in the target, which stays
  bool replaces_ = false;               ///< an earlier run's results
  std::filesystem::path partial_;
  std::vector<std::filesystem::path> created_;  ///< parents made for this run, outermost first
  int lock_ = -1;                               ///< held on the partial folder while this lives
  bool has_images_ = false, moving_ = false, committed_ = false;
};

/// All of a run's results at once, when nothing was to be saved during the run.
void write_results(const std::string& path, bool force, const Record& record);

}  // namespace slambench
