// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/result_folder.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <nlohmann/json.hpp>
#include <system_error>

#include "io/files.h"
#include "io/png.h"
#include "io/trajectory_file.h"
#include "results/writers.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view record_name = "record.json";

/// Whether the folder has a record that this program wrote, of any version.
bool holds_results(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_regular_file(folder / record_name, error)) return false;
  const auto json = nlohmann::json::parse(read_file(folder / record_name), nullptr, false);
  const auto format = json.is_object() ? json.find("format") : json.end();
  return format != json.end() && *format == "slambench-record";
}

std::string in_a_name(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '_' || c == '-' || c == '.';
    name += plain ? c : '-';
  }
  return name;
}

}  // namespace

std::string default_result_folder(std::chrono::sys_seconds started_at, std::string_view sequence,
                                  std::string_view backend) {
  const auto time = static_cast<std::time_t>(started_at.time_since_epoch().count());
  return fmt::format("results/{:%Y%m%d-%H%M%S}-{}-{}", fmt::gmtime(time), in_a_name(sequence),
                     in_a_name(backend));
}

ResultFolder::ResultFolder(const std::string& path, bool force)
    : folder_(path, force, {"results of an earlier run", record_name, holds_results}) {}

void ResultFolder::write_image(int frame, std::string_view picture, const Image<Rgba8>& image) {
  if (image.empty()) return;
  if (!has_images_) folder_.make_folder("images");
  has_images_ = true;
  write_file(folder_.file(fmt::format("images/frame_{:06}_{}.png", frame, picture)),
             png_bytes(image));
}

void ResultFolder::commit(const Record& record) {
  write_file(folder_.file("README.txt"), readme_text(record, has_images_));
  write_file(folder_.file("frames.csv"), frames_csv(record));
  write_file(folder_.file("trajectory.tum"), trajectory_text(estimated_trajectory(record)));
  if (!record.ground_truth.empty()) {
    write_file(folder_.file("groundtruth.tum"), trajectory_text(record.ground_truth));
  }
  if (record.measurements.sampling) {
    write_file(folder_.file("samples.csv"), samples_csv(record));
  }
  write_file(folder_.file("slambench1.log"), slambench1_log(record));
  write_file(folder_.file(std::string(record_name)), record_json(record));
  folder_.commit();
}

void write_results(const std::string& path, bool force, const Record& record) {
  ResultFolder(path, force).commit(record);
}

}  // namespace slambench
