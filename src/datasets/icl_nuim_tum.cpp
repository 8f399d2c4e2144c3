// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/icl_nuim.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "datasets/png_source.h"
#include "datasets/sequence_info.h"
#include "io/files.h"
#include "io/text.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

/// The file that lists the images, "" for none.
std::string list_of(const std::string& folder) {
  for (const char* name : {"/depth.txt", "/associations.txt"}) {
    if (is_file(folder + name)) return folder + name;
  }
  return {};
}

bool lists_associations(const std::string& list) { return list.ends_with("associations.txt"); }

/// Whether the first line of a list has an image whose name is its time stamp and a whole number.
bool lists_numbers(const std::string& list) {
  const std::string text = read_file(list);
  const auto lines = text_lines(text);
  if (lines.empty()) return false;
  const auto& fields = lines.front().fields;
  if (fields.size() < 2) return false;
  const auto stamp = parse_finite(fields[0]);
  return stamp && *stamp >= 0 && *stamp == file_number(std::string(fields[1]));
}

bool ends_as_ground_truth(const std::string& name) { return name.ends_with(".gt.freiburg"); }

std::vector<ListedImage> images_of(const std::string& folder, const std::string& list,
                                   std::vector<std::string>* notes) {
  if (list.empty()) return numbered_images(folder);
  if (lists_associations(list)) return read_associations(list, notes);
  auto images = read_image_list(list, notes);
  for (ListedImage& image : images) {  // the list names no colour images: their names tell
    image.color_file = color_of(folder, fs::path(image.file).filename());
  }
  return images;
}

}  // namespace

Intrinsics default_icl_nuim_camera(const SourceParameters& parameters) {
  return parameters.icl_nuim_camera == "slambench1" ? slambench1_icl_nuim_camera : icl_nuim_camera;
}

std::string icl_nuim_ground_truth(const std::string& folder, std::vector<std::string>* notes) {
  auto names = folder_entries(folder);
  std::erase_if(names, [](const std::string& name) { return !ends_as_ground_truth(name); });
  if (names.empty()) return {};
  if (names.size() > 1) {
    notes->push_back(fmt::format("of {} files *.gt.freiburg the first, {}, is used", names.size(),
                                 names.front()));
  }
  return folder + "/" + names.front();
}

bool is_icl_nuim_tum(const std::string& sequence) {
  if (!is_folder(sequence + "/depth")) return false;
  const auto names = folder_entries(sequence);
  if (std::any_of(names.begin(), names.end(), ends_as_ground_truth)) return true;
  if (is_present(sequence + "/groundtruth.txt")) return false;
  const std::string list = list_of(sequence);
  return list.empty() ? !numbered_images(sequence).empty() : lists_numbers(list);
}

std::unique_ptr<Source> open_icl_nuim_tum(const std::string& sequence,
                                          const SourceParameters& parameters) {
  SequenceInfo info;
  info.name = sequence_name(sequence);
  info.layout = "icl-nuim-tum";
  info.path = sequence;
  info.units_per_m = 5000;
  info.camera = default_icl_nuim_camera(parameters);
  set_axes_y_up(&info);
  const std::string list = list_of(sequence);
  if (list.empty()) {
    info.notes.push_back("no depth.txt and no associations.txt: the images are read by number");
  }
  auto images = images_of(sequence, list, &info.notes);
  if (images.empty()) throw InputError(sequence + "/depth", "images N.png", "none", "at least one");
  const std::string ground_truth = icl_nuim_ground_truth(sequence, &info.notes);
  return std::make_unique<PngSource>(std::move(info), std::move(images), list, ground_truth,
                                     parameters);
}

}  // namespace slambench
