// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/sequence_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>

#include "core/error.h"
#include "io/files.h"
#include "io/text.h"
#include "io/trajectory_file.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

constexpr Size nominal_size = {640, 480};
constexpr std::string_view icl_nuim_suffix = ".gt.freiburg";

void scale_camera(SequenceInfo* info) {
  if (info->depth_size == nominal_size) return;
  const float x = static_cast<float>(info->depth_size.width) / nominal_size.width;
  const float y = static_cast<float>(info->depth_size.height) / nominal_size.height;
  Intrinsics& k = info->camera;
  k = {k.fx * x, k.fy * y, k.cx * x, k.cy * y};
  info->notes.push_back("the camera is the default one for 640x480, scaled to the depth image");
}

void override_camera(const std::array<double, 4>& camera, SequenceInfo* info) {
  const auto [fx, fy, cx, cy] = camera;
  if (!(fx > 0) || fy == 0) {
    throw UsageError(
        fmt::format("--camera: found '{},{},{},{}', expected fx,fy,cx,cy with fx > 0 "
                    "and fy not 0",
                    fx, fy, cx, cy));
  }
  info->camera = {static_cast<float>(fx), static_cast<float>(std::abs(fy)), static_cast<float>(cx),
                  static_cast<float>(cy)};
  if (fy < 0) {
    set_axes_y_up(info);
    info->notes.push_back("the camera's negative fy is taken as: its y axis points up");
  }
}

/// Frames that have a pose closer in time than the limit; both are sorted.
int count_with_pose(std::span<const double> stamps_s, const std::vector<double>& pose_stamps_s) {
  constexpr double limit_s = 0.02;  // of the TUM benchmark's association
  return static_cast<int>(std::count_if(stamps_s.begin(), stamps_s.end(), [&](double t) {
    const auto after = std::lower_bound(pose_stamps_s.begin(), pose_stamps_s.end(), t);
    return (after != pose_stamps_s.end() && *after - t < limit_s) ||
           (after != pose_stamps_s.begin() && t - *std::prev(after) < limit_s);
  }));
}

void check_overlap(std::span<const double> stamps_s, SequenceInfo* info) {
  std::vector<double> poses_s;
  for (const StampedPose& pose : info->ground_truth) poses_s.push_back(pose.time_s);
  std::sort(poses_s.begin(), poses_s.end());
  info->frames_with_ground_truth = count_with_pose(stamps_s, poses_s);
  if (info->frames_with_ground_truth == 0) {
    throw InputError(
        info->ground_truth_file, "time stamps",
        fmt::format("{} to {}", poses_s.front(), poses_s.back()),
        fmt::format("those of the frames, {} to {}", stamps_s.front(), stamps_s.back()));
  }
}

/// The number K of ICL-NUIM's living-room trajectory whose ground truth this is; -1 for others.
/// "trajK" is also how the office's are called.
int living_room_trajectory(const SequenceInfo& info) {
  static const std::regex name("(livingroom|traj)([0-3])\\.gt\\.freiburg", std::regex::icase);
  static const std::regex office("office", std::regex::icase);
  const std::string file = fs::path(info.ground_truth_file).filename();
  std::smatch match;
  if (!std::regex_match(file, match, name)) return -1;
  if (std::regex_search(info.path, office)) return -1;
  return match[2].str()[0] - '0';
}

/// The settings SLAMBench 1 was run with on these sequences.
void suggest_settings(SequenceInfo* info) {
  struct Settings {
    const char *volume_size, *init_pose;
  };
  static constexpr Settings living_room[] = {{"5", "0.34,0.5,0.24"},
                                             {"5", "0.485,0.5,0.55"},
                                             {"4.8", "0.34,0.5,0.24"},
                                             {"5", "0.2685,0.5,0.4"}};
  static constexpr Settings hand_held = {"6", "0.5,0.5,0.35"};
  const int trajectory = living_room_trajectory(*info);
  const Settings settings = trajectory < 0 ? hand_held : living_room[trajectory];
  info->suggested = {{"volume-size", settings.volume_size}, {"init-pose", settings.init_pose}};
  if (info->depth_size.width % 2 == 0 && info->depth_size.height % 2 == 0) {
    info->suggested.insert(info->suggested.begin(), {"compute-size-ratio", "2"});
  }
  info->notes.push_back(
      trajectory < 0
          ? "the suggested volume suits a room around a hand-held camera"
          : fmt::format("the suggested settings are the published ones of ICL-NUIM's living room, "
                        "trajectory {}",
                        trajectory));
}

}  // namespace

std::string sequence_name(const std::string& path) {
  std::error_code error;
  fs::path whole = fs::canonical(path, error);  // "." has a name too
  if (error) whole = fs::path(path).lexically_normal();
  std::string name = whole.extension() == ".raw" ? whole.stem() : whole.filename();
  constexpr std::string_view prefix = "rgbd_dataset_";
  if (name.size() > prefix.size() && name.starts_with(prefix)) name.erase(0, prefix.size());
  return name;
}

bool is_present(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool is_file(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

std::vector<std::string> folder_entries(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    names.push_back(it->path().filename());
  }
  if (error) {
    throw InputError(fmt::format("{}: cannot list the folder: {}", folder, error.message()));
  }
  std::sort(names.begin(), names.end());
  return names;
}

void set_axes_y_up(SequenceInfo* info) {
  info->own_from_camera = Eigen::Vector3d(1, -1, 1).asDiagonal();
  info->axes = "x right, y up, z forward";
}

SourceParameters with_camera_file(SourceParameters parameters, const std::string& file) {
  if (parameters.camera || !is_present(file)) return parameters;
  const std::string text = read_file(file);
  const auto lines = text_lines(text);
  if (lines.size() != 1 || lines[0].fields.size() != 4) {
    throw InputError(file, "contents", quote(text), "one line: fx fy cx cy");
  }
  parameters.camera.emplace();
  for (std::size_t i = 0; i < 4; ++i) {
    const auto number = parse_finite(lines[0].fields[i]);
    if (!number || (i < 2 && !(*number > 0))) {
      throw InputError(file, fmt::format("line {}", lines[0].number), quote(lines[0].fields[i]),
                       i < 2 ? "a focal length in pixels" : "a position in pixels");
    }
    (*parameters.camera)[i] = *number;
  }
  return parameters;
}

void complete_info(const SourceParameters& parameters, const std::string& ground_truth_file,
                   std::span<const double> stamps_s, SequenceInfo* info) {
  info->frame_count = static_cast<int>(stamps_s.size());
  info->first_time_s = stamps_s.front();
  info->last_time_s = stamps_s.back();
  if (info->axes.empty()) info->axes = "x right, y down, z forward";
  if (parameters.camera) {
    override_camera(*parameters.camera, info);
  } else {
    scale_camera(info);
  }
  if (parameters.depth_scale) info->units_per_m = static_cast<float>(*parameters.depth_scale);

  const std::string& file =
      parameters.ground_truth.empty() ? ground_truth_file : parameters.ground_truth;
  if (!file.empty()) {
    info->ground_truth = read_trajectory(file);
    info->ground_truth_file = file;
    if (file.ends_with(icl_nuim_suffix) && info->own_from_camera.isIdentity()) {
      set_axes_y_up(info);
      info->notes.push_back("the ground truth is one of ICL-NUIM: its y axis points up");
    }
  }
  if (info->ground_truth.empty()) {
    info->notes.push_back("no ground truth was found: accuracy cannot be judged");
  } else {
    check_overlap(stamps_s, info);
  }
  if (info->suggested.empty()) suggest_settings(info);
}

}  // namespace slambench
