// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <vector>

#include "datasets/image_list.h"
#include "datasets/source.h"

namespace slambench {

/// A sequence of 16-bit depth PNGs, with 8-bit colour PNGs where there are any.
class PngSource final : public Source {
 public:
  /// `info` as complete_info (sequence_info.h) takes it; the images are those of `info.path`.
  /// `list` is the file that names them, for messages. Colour images that do not exist are left out
  /// with a note. Throws InputError when the first depth image is missing or bad.
  PngSource(SequenceInfo info, std::vector<ListedImage> images, const std::string& list,
            const std::string& ground_truth_file, const SourceParameters& parameters);

  const SequenceInfo& info() const override { return info_; }
  void read(int index, Frame& frame) override;
  double time_s(int index) override { return images_.at(static_cast<std::size_t>(index)).time_s; }

 private:
  std::string path_of(const std::string& file) const { return info_.path + "/" + file; }
  void leave_out_missing_color();

  SequenceInfo info_;
  std::vector<ListedImage> images_;
};

}  // namespace slambench
