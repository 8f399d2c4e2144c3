// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/png_source.h"

#include <fmt/format.h>

#include "core/error.h"
#include "datasets/sequence_info.h"
#include "io/png.h"

namespace slambench {

PngSource::PngSource(SequenceInfo info, std::vector<ListedImage> images, const std::string& list,
                     const std::string& ground_truth_file, const SourceParameters& parameters)
    : info_(std::move(info)), images_(std::move(images)) {
  const ListedImage& first = images_.at(0);
  if (first.line > 0 && !is_present(path_of(first.file))) {
    throw InputError(fmt::format("{}:{}", list, first.line), "image",
                     fmt::format("no file {}", path_of(first.file)), "a 16-bit PNG");
  }
  Image<std::uint16_t> depth;
  read_png(path_of(first.file), depth);
  info_.depth_size = depth.size();
  leave_out_missing_color();
  std::vector<double> stamps_s;
  for (const ListedImage& image : images_) stamps_s.push_back(image.time_s);
  complete_info(parameters, ground_truth_file, stamps_s, &info_);
}

void PngSource::leave_out_missing_color() {
  int missing = 0, present = 0;
  for (ListedImage& image : images_) {
    if (image.color_file.empty()) continue;
    if (is_present(path_of(image.color_file))) {
      ++present;
    } else {
      image.color_file.clear();
      ++missing;
    }
  }
  info_.has_color = present > 0;
  if (missing > 0) {
    info_.notes.push_back(fmt::format("{} colour images are named but do not exist", missing));
  }
}

void PngSource::read(int index, Frame& frame) {
  const ListedImage& image = images_.at(static_cast<std::size_t>(index));
  frame.index = index;
  frame.time_s = image.time_s;
  read_png(path_of(image.file), frame.depth);
  if (frame.depth.size() != info_.depth_size) {
    throw InputError(path_of(image.file), "size",
                     fmt::format("{}x{}", frame.depth.width(), frame.depth.height()),
                     fmt::format("{}x{} as in the first frame", info_.depth_size.width,
                                 info_.depth_size.height));
  }
  if (wants_color() && !image.color_file.empty()) {
    read_png(path_of(image.color_file), frame.color);
  } else {
    frame.color.resize({});
  }
}

}  // namespace slambench
