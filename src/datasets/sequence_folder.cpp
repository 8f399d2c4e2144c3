// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/sequence_folder.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/error.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_write(const fs::path& path, const std::error_code& error) {
  throw Error(ExitStatus::failed,
              fmt::format("{}: cannot write: {}", path.string(), error.message()));
}

std::error_code system_error(int number) { return {number, std::generic_category()}; }

/// Without a slash at the end, so that it has a name and a parent; where a link leads.
fs::path place_of(const std::string& path) {
  if (path.empty()) throw UsageError("the folder to write to has no name");
  std::error_code error;
  fs::path place = fs::weakly_canonical(path, error);
  if (error) cannot_write(path, error);
  return place.has_filename() ? place : place.parent_path();
}

/// A new folder ".NAME.PROCESS-N.partial" beside the target.
fs::path make_beside(const fs::path& target) {
  for (int n = 0;; ++n) {
    fs::path folder = target.parent_path() /
                      fmt::format(".{}.{}-{}.partial", target.filename().string(), ::getpid(), n);
    if (::mkdir(folder.c_str(), 0777) == 0) return folder;
    if (errno != EEXIST) cannot_write(target, system_error(errno));
  }
}

}  // namespace

SequenceFolder::SequenceFolder(const std::string& path, bool force) : target_(place_of(path)) {
  std::error_code error;
  const fs::file_status status = fs::status(target_, error);
  if (fs::exists(status)) {
    if (!fs::is_directory(status)) throw UsageError(path + ": a file is there already");
    if (!fs::is_empty(target_, error)) {
      if (!force) throw UsageError(path + ": the folder exists; --force replaces it");
      if (!fs::exists(target_ / sequence_mark)) {
        throw UsageError(
            fmt::format("{}: the folder holds something else than a generated sequence (no {}) and "
                        "is not replaced",
                        path, sequence_mark));
      }
    }
    if (error) cannot_write(path, error);
    replaces_ = true;
  }
  partial_ = make_beside(target_);
}

SequenceFolder::~SequenceFolder() {
  std::error_code ignored;
  if (!partial_.empty()) fs::remove_all(partial_, ignored);
}

void SequenceFolder::make_folder(const std::string& name) const {
  std::error_code error;
  fs::create_directory(partial_ / name, error);
  if (error) cannot_write(target_ / name, error);
}

void SequenceFolder::commit() {
  std::error_code error;
  fs::path old;
  if (replaces_) {
    // Its place is taken by moves alone, so that there is always one whole folder.
    old = partial_.string() + "-old";
    fs::rename(target_, old, error);
    if (error) cannot_write(target_, error);
  }
  fs::rename(partial_, target_, error);
  if (error) {
    std::error_code ignored;
    if (replaces_) fs::rename(old, target_, ignored);
    cannot_write(target_, error);
  }
  partial_.clear();
  if (replaces_) fs::remove_all(old, error);
}

}  // namespace slambench
