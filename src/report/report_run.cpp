// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "report/report_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "io/files.h"
#include "io/text.h"
#include "io/trajectory_file.h"
#include "results/record.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool is_result_folder(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / "record.json", ignored);
}

std::vector<std::string> folders_inside(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const bool hidden = entry.path().filename().string().starts_with(".");
    if (!hidden && is_result_folder(entry.path())) found.push_back(entry.path());
  }
  if (error) throw InputError(fmt::format("{}: {}", folder, error.message()));
  std::sort(found.begin(), found.end());
  return found;
}

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

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

FrameColumns read_frame_columns(const std::string& path) {
  const std::string text = read_file(path);
  FrameColumns columns;
  std::vector<std::string_view> names;
  int line_number = 0;
  for (std::string_view line : split(text, '\n')) {
    ++line_number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty()) continue;
    const auto fields = split(line, ',');
    if (names.empty()) {
      names = fields;
      continue;
    }
    const std::string place = fmt::format("line {}", line_number);
    if (fields.size() != names.size()) {
      throw InputError(path, place, fmt::format("{} fields", fields.size()),
                       fmt::format("{}", names.size()));
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto number = parse_finite(fields[i]);
      if (!number && !fields[i].empty()) {
        throw InputError(path, fmt::format("{}: {}", place, quote(names[i])), quote(fields[i]),
                         "a number or nothing");
      }
      columns[std::string(names[i])].push_back(
          number.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
  }
  return columns;
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
    const std::string name = entry.path().filename();
    const auto parts = split(name, '_');
    if (parts.size() != 3 || parts[0] != "frame" || !parts[2].ends_with(".png")) continue;
    const auto frame = parse_finite(parts[1]);
    if (!frame || *frame < 0 || *frame > std::numeric_limits<int>::max()) continue;
    const std::string_view kind = parts[2].substr(0, parts[2].size() - 4);
    pictures.push_back({static_cast<int>(*frame), std::string(kind), entry.path()});
  }
  std::sort(pictures.begin(), pictures.end(), [](const Picture& a, const Picture& b) {
    return std::pair(a.frame, a.kind) < std::pair(b.frame, b.kind);
  });
  return pictures;
}

/// The last `parts` names of the path: "suite/serial-0".
std::string path_end(const std::string& path, int parts) {
  fs::path rest = fs::absolute(path).lexically_normal();
  if (!rest.has_filename()) rest = rest.parent_path();
  fs::path end = rest.filename();
  for (int i = 1; i < parts && rest.parent_path() != rest; ++i) {
    rest = rest.parent_path();
    end = rest.filename() / end;
  }
  return end.string();
}

}  // namespace

std::vector<std::string> find_result_folders(const std::vector<std::string>& arguments) {
  std::vector<std::string> folders;
  std::set<fs::path> seen;
  const auto add = [&](const std::string& folder) {
    if (seen.insert(fs::canonical(folder)).second) folders.push_back(folder);
  };
  for (const std::string& argument : arguments) {
    std::error_code error;
    const fs::file_status status = fs::status(argument, error);
    if (!fs::exists(status)) throw InputError(fmt::format("{}: no such folder", argument));
    if (!fs::is_directory(status)) {
      throw InputError(fmt::format("{}: found a file, expected a result folder", argument));
    }
    if (is_result_folder(argument)) {
      add(argument);
      continue;
    }
    const auto inside = folders_inside(argument);
    if (inside.empty()) {
      throw InputError(fmt::format(
          "{}: found no record.json, expected a result folder or a folder of them", argument));
    }
    for (const std::string& folder : inside) add(folder);
  }
  return folders;
}

ReportRun read_report_run(const std::string& folder) {
  ReportRun run;
  const fs::path path(folder);
  run.folder = folder;
  run.name = path_end(folder, 1);
  run.record = read_record(path / "record.json");
  run.frames = read_frame_columns(path / "frames.csv");
  require_same_run(run, path / "frames.csv");
  if (run.record.at("frames").value("processed", Json()) != 0) {
    run.estimate = read_trajectory(path / "trajectory.tum");
  }
  if (fs::exists(path / "groundtruth.tum")) run.truth = read_trajectory(path / "groundtruth.tum");
  run.pictures = list_pictures(path / "images");
  return run;
}

void name_runs(std::vector<ReportRun>* runs) {
  constexpr int longest = 8;
  for (int parts = 1; parts <= longest; ++parts) {
    std::set<std::string> names;
    for (ReportRun& run : *runs) {
      run.name = path_end(run.folder, parts);
      names.insert(run.name);
    }
    if (names.size() == runs->size()) return;
  }
}

}  // namespace slambench
