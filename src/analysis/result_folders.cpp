// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/result_folders.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "core/error.h"

namespace slambench {

namespace fs = std::filesystem;

bool is_result_folder(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / "record.json", error);
}

std::vector<std::string> result_folders_in(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const bool hidden = it->path().filename().string().starts_with('.');
    if (!hidden && is_result_folder(it->path())) found.push_back(it->path());
  }
  if (error) throw InputError(fmt::format("{}: {}", folder, error.message()));
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace slambench
