// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/source.h"

#include <fmt/format.h>

#include <filesystem>
#include <limits>

#include "core/error.h"
#include "datasets/icl_nuim.h"
#include "datasets/living_room.h"
#include "datasets/sequence_info.h"
#include "datasets/slambench_raw.h"
#include "datasets/tum_rgbd.h"
#include "io/text.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

/// What a folder holds, in a few words.
std::string contents_of(const std::string& folder) {
  constexpr std::size_t shown = 4;
  const auto names = folder_entries(folder);
  if (names.empty()) return "an empty folder";
  std::string text = "a folder with ";
  for (std::size_t i = 0; i < std::min(shown, names.size()); ++i) {
    text += (i > 0 ? ", " : "") + quote(names[i]);
  }
  if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

[[noreturn]] void reject(const std::string& sequence) {
  std::error_code error;
  const fs::file_status status = fs::status(sequence, error);
  if (!fs::exists(status)) {
    const std::string why = error ? error.message() : "No such file or directory";
    throw InputError(fmt::format("{}: {}, and no built-in sequence has this name",
                                 sequence.empty() ? "''" : sequence, why));
  }
  std::string layouts;
  for (const SourceEntry& entry : source_table()) {
    layouts += fmt::format("{}{} ({})", layouts.empty() ? "" : ", ", entry.layout, entry.sentence);
  }
  throw InputError(
      sequence, "layout",
      fs::is_directory(status) ? contents_of(sequence) : "a file that is no sequence of frames",
      "one of: " + layouts);
}

}  // namespace

ParameterList SourceParameters::describe() {
  constexpr double huge = 1e6;
  return {"source",
          {
              {"camera", 'k', "px", &camera, -huge, huge,
               "intrinsics fx,fy,cx,cy at full input resolution instead of the sequence's own; a "
               "negative fy says that the camera's y axis points up"},
              {"icl-nuim-camera",
               0,
               "",
               &icl_nuim_camera,
               0,
               0,
               "camera of ICL-NUIM's images: the dataset's own, or the one of SLAMBench 1's "
               "published commands, half a pixel off",
               {"dataset", "slambench1"}},
              {"depth-scale", 0, "1/m", &depth_scale, 1e-3, huge,
               "units per metre of the depth in the files, instead of the layout's own"},
              {"ground-truth", 0, "", &ground_truth, 0, 0,
               "ground truth to judge by, a file in TUM format, instead of the sequence's own"},
              {"noise", 0, "", &noise, 0, 1,
               "add the noise of a Kinect to the depth of a rendered sequence"},
              {"noise-seed", 0, "", &noise_seed, 0, std::numeric_limits<int>::max(),
               "seed of the noise: the same seed gives the same images"},
          }};
}

const std::vector<SourceEntry>& source_table() {
  static const std::vector<SourceEntry> table = {
      {"living-room", "built in, rendered: living-room/0 to living-room/3", is_living_room,
       open_living_room, living_room_unavailable()},
      {"icl-nuim", "ICL-NUIM as published: a folder of scene_NN_NNNN.depth, .png, .txt",
       is_icl_nuim, open_icl_nuim},
      {"icl-nuim-tum", "ICL-NUIM for TUM tools: a folder with depth/N.png and *.gt.freiburg",
       is_icl_nuim_tum, open_icl_nuim_tum},
      {"tum-rgbd", "TUM RGB-D: a folder with depth.txt, rgb.txt, groundtruth.txt", is_tum_rgbd,
       open_tum_rgbd},
      {"slambench-raw", "SLAMBench 1: a .raw file, with or without colour", is_slambench_raw,
       open_slambench_raw},
  };
  return table;
}

std::string sequence_settings_file(const std::string& sequence) {
  if (sequence.empty() || is_living_room(sequence)) return "";
  const fs::path place(sequence);
  const fs::path file = (is_folder(sequence) ? place : place.parent_path()) / sequence_settings;
  return is_file(file) ? file.string() : "";
}

std::unique_ptr<Source> open_source(const std::string& name, const SourceParameters& parameters) {
  std::string sequence = name;
  while (sequence.size() > 1 && sequence.ends_with('/')) sequence.pop_back();
  for (const SourceEntry& entry : source_table()) {
    if (!sequence.empty() && entry.matches(sequence)) return entry.open(sequence, parameters);
  }
  reject(sequence);
}

}  // namespace slambench
