// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/result_folders.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>

#include "analysis/suite_index.h"
#include "core/error.h"

namespace slambench {

namespace fs = std::filesystem;

namespace {

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

bool is_number(const std::string& text) {
  return text.find_first_not_of("0123456789") == std::string::npos;
}

/// In order of their names.
std::vector<fs::path> visible_folders_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    const bool hidden = it->path().filename().string().starts_with('.');
    if (!hidden && it->is_directory(ignored)) found.push_back(it->path());
  }
  if (error) throw InputError(fmt::format("{}: {}", folder.string(), error.message()));
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

bool is_result_folder(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / "record.json", error);
}

std::vector<std::string> result_folders_in(const std::string& folder) {
  std::vector<std::string> found;
  for (const fs::path& inside : visible_folders_in(folder)) {
    if (is_result_folder(inside)) {
      found.push_back(inside);
      continue;
    }
    std::error_code error;
    if (!fs::exists(fs::path(folder) / suite_index_name, error)) continue;
    for (const fs::path& deeper : visible_folders_in(inside)) {
      if (is_result_folder(deeper)) found.push_back(deeper);
    }
  }
  return found;
}

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
    const auto inside = result_folders_in(argument);
    if (inside.empty()) {
      throw InputError(fmt::format(
          "{}: found no record.json, expected a result folder or a folder of them", argument));
    }
    for (const std::string& folder : inside) add(folder);
  }
  return folders;
}

std::vector<std::string> short_names(const std::vector<std::string>& folders) {
  constexpr int longest = 8;
  std::vector<std::string> names;
  for (int parts = 1; parts <= longest; ++parts) {
    names.clear();
    for (const std::string& folder : folders) {
      names.push_back(path_end(folder, parts));
      if (is_number(names.back())) names.back() = path_end(folder, parts + 1);
    }
    if (std::set<std::string>(names.begin(), names.end()).size() == names.size()) break;
  }
  return names;
}

}  // namespace slambench
