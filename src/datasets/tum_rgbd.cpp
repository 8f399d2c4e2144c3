// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/tum_rgbd.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <tuple>

#include "datasets/png_source.h"
#include "datasets/sequence_info.h"

namespace slambench {
namespace {

/// The published calibrations of the depth cameras of the three series; for others the nominal
/// calibration of the Kinect.
void set_camera(SequenceInfo* info) {
  static constexpr Intrinsics cameras[] = {{517.3F, 516.5F, 318.6F, 255.3F},
                                           {520.9F, 521.0F, 325.1F, 249.7F},
                                           {535.4F, 539.2F, 320.1F, 247.6F}};
  static const std::regex series("(^|[^a-z0-9])(freiburg|fr)([123])([^0-9]|$)", std::regex::icase);
  std::smatch match;
  if (std::regex_search(info->name, match, series)) {
    info->camera = cameras[match[3].str()[0] - '1'];
    return;
  }
  info->camera = {525, 525, 319.5F, 239.5F};
  info->notes.push_back(
      "the folder's name tells no series (freiburg1, 2, 3): the camera is the nominal one, "
      "525,525,319.5,239.5");
}

/// Gives every depth image the colour image nearest in time: one to one, the smallest difference
/// first, strictly below 0.02 s, as the benchmark's own tool pairs them. Both are sorted.
void associate_color(const std::vector<ListedImage>& color, std::vector<ListedImage>* depth) {
  constexpr double limit_s = 0.02;
  std::vector<std::tuple<double, std::size_t, std::size_t>> candidates;  // difference, depth, color
  std::size_t first = 0;
  for (std::size_t d = 0; d < depth->size(); ++d) {
    const double t = (*depth)[d].time_s;
    while (first < color.size() && color[first].time_s <= t - limit_s) ++first;
    for (std::size_t c = first; c < color.size() && color[c].time_s < t + limit_s; ++c) {
      candidates.emplace_back(std::abs(color[c].time_s - t), d, c);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<bool> used(color.size(), false);
  for (const auto& [difference, d, c] : candidates) {
    if (used[c] || !(*depth)[d].color_file.empty()) continue;
    used[c] = true;
    (*depth)[d].color_file = color[c].file;
  }
}

/// The rate that the median difference of time stamps means.
double rate_of(const std::vector<ListedImage>& images, double otherwise) {
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < images.size(); ++i) {
    steps_s.push_back(images[i].time_s - images[i - 1].time_s);
  }
  if (steps_s.empty()) return otherwise;
  const auto middle = steps_s.begin() + static_cast<std::ptrdiff_t>(steps_s.size() / 2);
  std::nth_element(steps_s.begin(), middle, steps_s.end());
  return 1 / *middle;
}

}  // namespace

bool is_tum_rgbd(const std::string& sequence) { return is_file(sequence + "/depth.txt"); }

std::unique_ptr<Source> open_tum_rgbd(const std::string& sequence, const SourceParameters& users) {
  const SourceParameters parameters = with_camera_file(users, sequence + "/camera.txt");
  SequenceInfo info;
  info.name = sequence_name(sequence);
  info.layout = "tum-rgbd";
  info.path = sequence;
  info.units_per_m = 5000;
  if (!parameters.camera) set_camera(&info);
  const std::string list = sequence + "/depth.txt";
  std::vector<ListedImage> images = read_image_list(list, &info.notes);
  info.fps = rate_of(images, info.fps);
  if (const std::string color = sequence + "/rgb.txt"; is_present(color)) {
    associate_color(read_image_list(color, &info.notes), &images);
  }
  std::string ground_truth = sequence + "/groundtruth.txt";
  if (!is_present(ground_truth)) ground_truth.clear();
  return std::make_unique<PngSource>(std::move(info), std::move(images), list, ground_truth,
                                     parameters);
}

}  // namespace slambench
