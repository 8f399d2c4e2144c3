// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/icl_nuim.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <regex>

#include "core/error.h"
#include "datasets/sequence_info.h"
#include "io/files.h"
#include "io/png.h"
#include "io/text.h"

namespace slambench {
namespace {

constexpr float delivered_units_per_m = 5000;  // as in the same sequences' PNGs

/// One frame's files have this name and different extensions.
struct FrameFiles {
  int number = 0;
  std::string stem;
};

/// All frames of a folder in the order of their numbers.
std::vector<FrameFiles> frame_files(const std::string& folder) {
  static const std::regex name("(scene_([0-9]+)_([0-9]+))\\.depth");
  std::vector<FrameFiles> files;
  std::string scene;
  for (const std::string& entry : folder_entries(folder)) {
    std::smatch match;
    if (!std::regex_match(entry, match, name)) continue;
    if (!scene.empty() && match[2] != scene) {
      throw InputError(folder, "scenes", "scene_" + scene + " and scene_" + match[2].str(),
                       "one scene in a folder");
    }
    scene = match[2];
    int number = 0;
    const std::string digits = match[3];
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (result.ec != std::errc{}) {
      throw InputError(folder, "number of a frame", digits, "at most 2147483647");
    }
    files.push_back({number, folder + "/" + match[1].str()});
  }
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return a.number < b.number; });
  return files;
}

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

/// The distances in a .depth file.
std::vector<float> read_distances(const std::string& path) {
  const std::string text = read_file(path);
  std::vector<float> distances;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (;;) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return distances;
    float value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    const bool whole = next == end || is_blank(*next);
    if (error != std::errc{} || !whole || !std::isfinite(value) || value < 0) {
      throw InputError(path,
                       fmt::format("value {} (at byte {})", distances.size(), at - text.data()),
                       quote({at, std::find_if(at, end, is_blank)}), "a distance in metres");
    }
    distances.push_back(value);
    at = next;
  }
}

/// The size of an image with this many pixels and the proportions of 640x480.
std::optional<Size> size_of(std::size_t pixels) {
  const auto unit = static_cast<int>(std::lround(std::sqrt(static_cast<double>(pixels) / 12)));
  const Size size = {4 * unit, 3 * unit};
  return unit > 0 && size.count() == pixels ? std::optional(size) : std::nullopt;
}

/// The vector "NAME = [x, y, z]'" in POV-Ray's text.
Eigen::Vector3d povray_vector(const std::string& path, const std::string& text,
                              const std::string& name) {
  const auto fail = [&](std::string_view found) -> Eigen::Vector3d {
    throw InputError(path, name, found, name + " = [x, y, z]'");
  };
  std::size_t at = text.find(name);
  if (at == std::string::npos) return fail("nothing");
  const std::size_t line_end = std::min(text.find('\n', at), text.size());
  const std::string line = text.substr(at, line_end - at);
  const std::size_t begin = line.find('['), end = line.find(']');
  if (begin == std::string::npos || end == std::string::npos || end < begin) {
    return fail(quote(line));
  }
  std::string numbers = line.substr(begin + 1, end - begin - 1);
  std::replace(numbers.begin(), numbers.end(), ',', ' ');
  const auto lines = text_lines(numbers);
  if (lines.size() != 1 || lines[0].fields.size() != 3) return fail(quote(line));
  Eigen::Vector3d vector;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = parse_finite(lines[0].fields[i]);
    if (!number) return fail(quote(line));
    vector(static_cast<Eigen::Index>(i)) = *number;
  }
  return vector;
}

/// The pose in POV-Ray's camera text: x right, y up, z forward, as its cam_dir and cam_up say.
Pose read_povray_pose(const std::string& path, double units_per_m) {
  const std::string text = read_file(path);
  const Eigen::Vector3d z = povray_vector(path, text, "cam_dir").normalized();
  const Eigen::Vector3d x = povray_vector(path, text, "cam_up").cross(z).normalized();
  if (!(z.norm() > 0.5) || !(x.norm() > 0.5)) {
    throw InputError(path, "cam_dir, cam_up", "zero or parallel vectors", "a direction and an up");
  }
  Pose pose = Pose::Identity();
  pose.linear() << x, z.cross(x), z;
  pose.translation() = povray_vector(path, text, "cam_pos") / units_per_m;
  return pose;
}

class IclNuimSource final : public Source {
 public:
  IclNuimSource(const std::string& folder, const SourceParameters& parameters);
  const SequenceInfo& info() const override { return info_; }
  void read(int index, Frame& frame) override;
  double time_s(int index) override { return files_.at(static_cast<std::size_t>(index)).number; }

 private:
  void read_poses(double units_per_m);
  /// Multiplied with a distance, this is the depth in delivered units (per pixel).
  void set_factors(double units_per_m);

  SequenceInfo info_;
  std::vector<FrameFiles> files_;
  std::vector<bool> has_color_;
  std::vector<float> factors_;
};

IclNuimSource::IclNuimSource(const std::string& folder, const SourceParameters& parameters)
    : files_(frame_files(folder)) {
  info_.name = sequence_name(folder);
  info_.layout = "icl-nuim";
  info_.path = folder;
  info_.camera = default_icl_nuim_camera(parameters);
  info_.units_per_m = 1;  // of the text
  set_axes_y_up(&info_);
  const std::string first = files_.at(0).stem + ".depth";
  const std::size_t values = read_distances(first).size();
  const auto size = size_of(values);
  if (!size) {
    throw InputError(first, "values", fmt::format("{}", values),
                     "307200 for 640x480, or another image of these proportions");
  }
  info_.depth_size = *size;
  std::vector<double> stamps_s;
  for (const FrameFiles& files : files_) {
    stamps_s.push_back(files.number);
    has_color_.push_back(is_present(files.stem + ".png"));
  }
  info_.has_color = std::find(has_color_.begin(), has_color_.end(), true) != has_color_.end();
  const std::string ground_truth = icl_nuim_ground_truth(folder, &info_.notes);
  const double text_units_per_m = parameters.depth_scale.value_or(1);
  if (ground_truth.empty() && parameters.ground_truth.empty()) read_poses(text_units_per_m);
  complete_info(parameters, ground_truth, stamps_s, &info_);
  set_factors(info_.units_per_m);
  info_.units_per_m = delivered_units_per_m;
  info_.notes.push_back(
      "distances from the camera's centre are converted to depth in steps of 1/5000 m; what is "
      "farther than 13.1 m counts as not measured");
}

void IclNuimSource::read_poses(double units_per_m) {
  for (const FrameFiles& files : files_) {
    const std::string path = files.stem + ".txt";
    if (!is_present(path)) continue;
    info_.ground_truth.push_back(
        {static_cast<double>(files.number), read_povray_pose(path, units_per_m)});
  }
  if (info_.ground_truth.empty()) return;
  info_.ground_truth_file = info_.path + "/scene_*.txt";
}

void IclNuimSource::set_factors(double units_per_m) {
  const Intrinsics& k = info_.camera;
  for (int v = 0; v < info_.depth_size.height; ++v) {
    for (int u = 0; u < info_.depth_size.width; ++u) {
      const double x = (u - k.cx) / k.fx;
      const double y = (v - k.cy) / k.fy;
      factors_.push_back(
          static_cast<float>(delivered_units_per_m / units_per_m / std::sqrt(x * x + y * y + 1)));
    }
  }
}

void IclNuimSource::read(int index, Frame& frame) {
  const auto i = static_cast<std::size_t>(index);
  const std::string path = files_.at(i).stem + ".depth";
  const std::vector<float> distances = read_distances(path);
  if (distances.size() != factors_.size()) {
    throw InputError(path, "values", fmt::format("{}", distances.size()),
                     fmt::format("{} for {}x{} as in the first frame", factors_.size(),
                                 info_.depth_size.width, info_.depth_size.height));
  }
  frame.index = index;
  frame.time_s = files_[i].number;
  frame.depth.resize(info_.depth_size);
  std::transform(distances.begin(), distances.end(), factors_.begin(), frame.depth.begin(),
                 [](float distance, float factor) {
                   constexpr float largest = std::numeric_limits<std::uint16_t>::max();
                   const float depth = std::round(distance * factor);
                   return static_cast<std::uint16_t>(depth <= largest ? depth : 0);
                 });
  if (wants_color() && has_color_[i]) {
    read_png(files_[i].stem + ".png", frame.color);
  } else {
    frame.color.resize({});
  }
}

}  // namespace

bool is_icl_nuim(const std::string& sequence) {
  if (!is_folder(sequence)) return false;
  static const std::regex name("scene_[0-9]+_[0-9]+\\.depth");
  const auto names = folder_entries(sequence);
  return std::any_of(names.begin(), names.end(),
                     [](const std::string& entry) { return std::regex_match(entry, name); });
}

std::unique_ptr<Source> open_icl_nuim(const std::string& sequence,
                                      const SourceParameters& parameters) {
  return std::make_unique<IclNuimSource>(sequence, parameters);
}

}  // namespace slambench
