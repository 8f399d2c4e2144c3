// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/image_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "core/error.h"
#include "datasets/sequence_info.h"
#include "io/files.h"
#include "io/text.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

double parse_stamp(const std::string& path, const TextLine& line, std::size_t field) {
  const auto stamp = parse_finite(line.fields[field]);
  if (!stamp) {
    throw InputError(fmt::format("{}:{}", path, line.number), "time stamp",
                     quote(line.fields[field]), "a finite number");
  }
  return *stamp;
}

void check_fields(const std::string& path, const TextLine& line, std::size_t count,
                  std::string_view expected) {
  if (line.fields.size() == count) return;
  throw InputError(fmt::format("{}:{}", path, line.number), "fields",
                   fmt::format("{}", line.fields.size()), fmt::format("{}: {}", count, expected));
}

void sort_by_stamp(const std::string& path, std::vector<ListedImage>* images,
                   std::vector<std::string>* notes) {
  const auto earlier = [](const auto& a, const auto& b) { return a.time_s < b.time_s; };
  if (images->empty()) throw InputError(path, "images", "none", "at least one");
  if (!std::is_sorted(images->begin(), images->end(), earlier)) {
    std::stable_sort(images->begin(), images->end(), earlier);
    notes->push_back(
        fmt::format("{} is not in the order of time: sorted", fs::path(path).filename().string()));
  }
  const auto twice =
      std::adjacent_find(images->begin(), images->end(),
                         [](const auto& a, const auto& b) { return a.time_s == b.time_s; });
  if (twice == images->end()) return;
  throw InputError(fmt::format("{}:{}", path, std::next(twice)->line), "time stamp",
                   fmt::format("{} again", twice->time_s),
                   fmt::format("each once (it is in line {})", twice->line));
}

bool names_depth(std::string_view file) { return file.find("depth") != std::string_view::npos; }

}  // namespace

std::vector<ListedImage> read_image_list(const std::string& path, std::vector<std::string>* notes) {
  const std::string text = read_file(path);
  std::vector<ListedImage> images;
  for (const TextLine& line : text_lines(text)) {
    check_fields(path, line, 2, "stamp file");
    images.push_back({parse_stamp(path, line, 0), std::string(line.fields[1]), "", line.number});
  }
  sort_by_stamp(path, &images, notes);
  return images;
}

std::vector<ListedImage> read_associations(const std::string& path,
                                           std::vector<std::string>* notes) {
  const std::string text = read_file(path);
  std::vector<ListedImage> images;
  for (const TextLine& line : text_lines(text)) {
    check_fields(path, line, 4, "stamp depth-file stamp colour-file");
    const bool swapped = !names_depth(line.fields[1]) && names_depth(line.fields[3]);
    const std::size_t depth = swapped ? 2 : 0;
    const std::size_t color = swapped ? 0 : 2;
    parse_stamp(path, line, color);
    images.push_back({parse_stamp(path, line, depth), std::string(line.fields[depth + 1]),
                      std::string(line.fields[color + 1]), line.number});
  }
  sort_by_stamp(path, &images, notes);
  return images;
}

std::vector<ListedImage> numbered_images(const std::string& folder) {
  std::vector<ListedImage> images;
  for (const std::string& name : folder_entries(folder + "/depth")) {
    if (fs::path(name).extension() != ".png" || file_number(name) < 0) continue;
    images.push_back(
        {static_cast<double>(file_number(name)), "depth/" + name, color_of(folder, name), 0});
  }
  std::sort(images.begin(), images.end(),
            [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  for (std::size_t i = 1; i < images.size(); ++i) {
    if (images[i - 1].time_s == images[i].time_s) {
      throw InputError(folder, "images of one number",
                       images[i - 1].file + " and " + images[i].file, "each number once");
    }
  }
  return images;
}

std::string color_of(const std::string& folder, const std::string& name) {
  std::string file = "rgb/" + name;
  return is_present(fmt::format("{}/{}", folder, file)) ? file : std::string();
}

int file_number(const std::string& file) {
  const std::string stem = fs::path(file).stem();
  int number = -1;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  const bool whole = error == std::errc{} && end == stem.data() + stem.size();
  return whole && number >= 0 ? number : -1;
}

}  // namespace slambench
