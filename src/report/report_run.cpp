// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "report/report_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string_view>
#include <system_error>

#include "analysis/result_folders.h"
#include "core/error.h"
#include "io/files.h"
#include "io/text.h"
#include "io/trajectory_file.h"
#include "results/record.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json read_record(const std::string& path) {
  Json record = Json::parse(read_file(path), nullptr, false);
  if (!record.is_object() || record.value("format", Json()) != "slambench-record") {
    throw InputError(path, "format", record.is_object() ? "another" : "no JSON object",
                     "slambench-record");
  }
  const Json version = record.value("schema_version", Json());
  if (version != Record::schema_version) {
    throw InputError(path, "schema_version", version.dump(),
                     fmt::format("{}, as this program writes", Record::schema_version));
  }
  for (const char* part :
       {"provenance", "sequence", "parameters", "frames", "time", "memory", "accuracy", "absent"}) {
    if (record.value(part, Json()).is_object()) continue;
    throw InputError(path, part, record.contains(part) ? "something else" : "nothing", "an object");
  }
  return record;
}

/// Whether frames.csv is of the same run as the record.
void require_same_run(const ReportRun& run, const std::string& path) {
  for (const char* column : {"index", "time_s", "dropped", "computation_s"}) {
    if (!run.frames.contains(column))
      throw InputError(path, "columns", "no " + std::string(column), "it");
  }
  const Json& frames = run.record.at("frames");
  const auto count = [&](const char* key) {
    const Json number = frames.value(key, Json());
    return number.is_number_integer() ? number.get<long>() : -1;
  };
  const auto rows = static_cast<long>(run.frames.at("index").size());
  const long expected = count("processed") + count("dropped");
  if (rows != expected) {
    throw InputError(path, "rows", std::to_string(rows),
                     fmt::format("{}, as record.json has processed and dropped frames", expected));
  }
}

std::vector<Picture> list_pictures(const fs::path& folder) {
  std::vector<Picture> pictures;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing)) {
    if (entry.path().extension() != ".png") continue;
    const std::string stem = entry.path().stem();
    constexpr std::string_view head = "frame_";
    const std::size_t end = stem.find('_', head.size());
    if (!stem.starts_with(head) || end == std::string::npos) continue;
    const auto frame = parse_finite(std::string_view(stem).substr(head.size(), end - head.size()));
    if (!frame || *frame < 0 || *frame > std::numeric_limits<int>::max()) continue;
    pictures.push_back({static_cast<int>(*frame), stem.substr(end + 1), entry.path()});
  }
  std::sort(pictures.begin(), pictures.end(), [](const Picture& a, const Picture& b) {
    return std::pair(a.frame, a.kind) < std::pair(b.frame, b.kind);
  });
  return pictures;
}

}  // namespace

ReportRun read_report_run(const std::string& folder) {
  ReportRun run;
  const fs::path path(folder);
  run.folder = folder;
  run.name = short_names({folder}).front();
  run.record = read_record(path / "record.json");
  run.stored = read_stored_run(folder);
  run.sequence = run.stored.text("sequence.name");
  run.variant = run.stored.text("provenance.backend");
  run.frames = read_frame_columns(path / "frames.csv");
  require_same_run(run, path / "frames.csv");
  if (run.record.at("frames").value("processed", Json()) != 0) {
    run.estimate = read_trajectory(path / "trajectory.tum");
  }
  if (fs::exists(path / "groundtruth.tum")) run.truth = read_trajectory(path / "groundtruth.tum");
  if (fs::exists(path / "samples.csv")) run.samples = read_samples(path / "samples.csv");
  run.pictures = list_pictures(path / "images");
  return run;
}

}  // namespace slambench
