// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "core/image.h"
#include "io/whole_folder.h"
#include "results/record.h"

namespace slambench {

/// "results/20150526-093000-living-room-2-serial": a folder name for a run started then (UTC).
std::string default_result_folder(std::chrono::sys_seconds started_at, std::string_view sequence,
                                  std::string_view backend);

/// The folder of one run's results, whole or not there (io/whole_folder.h).
class ResultFolder {
 public:
  /// Checks and reserves the place, before the run. Throws as WholeFolder does.
  ResultFolder(const std::string& path, bool force);

  /// Where the results will be, as the user named it.
  const std::string& path() const { return folder_.path(); }
  /// Whether that file would lie among the results.
  bool contains(const std::string& file) const { return folder_.contains(file); }

  /// Saves images/frame_000120_PICTURE.png, to come with the other results; nothing for an empty
  /// image. Throws Error when it cannot be written.
  void write_image(int frame, std::string_view picture, const Image<Rgba8>& image);

  /// Writes all files and puts them in place, record.json last. Throws Error naming what failed; an
  /// earlier run's results are still there then.
  void commit(const Record& record);

 private:
  WholeFolder folder_;
  bool has_images_ = false;
};

/// All of a run's results at once, when nothing was to be saved during the run.
void write_results(const std::string& path, bool force, const Record& record);

}  // namespace slambench
