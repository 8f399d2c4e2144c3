// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/result_folder.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "io/files.h"
#include "io/png.h"
#include "io/trajectory_file.h"
#include "results/writers.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view partial_name = ".slambench-partial";
constexpr std::string_view record_name = "record.json";

[[noreturn]] void fail(const fs::path& path, const std::error_code& error) {
  throw Error(ExitStatus::failed,
              fmt::format("{}: cannot write: {}", path.string(), error.message()));
}
[[noreturn]] void fail(const fs::path& path) { fail(path, {errno, std::generic_category()}); }

/// Absolute, without a '/' at the end, links followed as far as the path exists.
fs::path resolved(const std::string& path) {
  if (path.empty()) throw UsageError("the results folder has an empty name");
  std::error_code error;
  fs::path absolute = fs::weakly_canonical(fs::absolute(path, error), error);
  if (error) fail(path, error);
  if (!absolute.has_filename()) absolute = absolute.parent_path();
  return absolute;
}

std::vector<fs::path> entries(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().filename() != partial_name) found.push_back(it->path());
  }
  if (error) fail(folder, error);
  return found;
}

/// Whether the folder has a record that this program wrote, of any version.
bool holds_results(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_regular_file(folder / record_name, error)) return false;
  const auto json = nlohmann::json::parse(read_file(folder / record_name), nullptr, false);
  const auto format = json.is_object() ? json.find("format") : json.end();
  return format != json.end() && *format == "slambench-record";
}

/// Whether a folder can be renamed: no mount point, and in a folder that can be written.
bool can_be_moved(const fs::path& folder) {
  struct stat own {};
  struct stat parent {};
  return ::stat(folder.c_str(), &own) == 0 && ::stat(folder.parent_path().c_str(), &parent) == 0 &&
         own.st_dev == parent.st_dev && ::access(folder.parent_path().c_str(), W_OK | X_OK) == 0;
}

/// Makes a rename in this folder last through a loss of power. What refuses that cannot be helped.
void flush_folder(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

/// Whether the lock, on the folder that `file` is open on, could be had. File systems that lock no
/// folders grant it.
bool lock(int file) {
  while (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    return errno != EWOULDBLOCK;
  }
  return true;
}

bool same_folder(int file, const fs::path& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

void rename_or_fail(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) fail(to);
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
    : path_(path), target_(resolved(path)) {
  inspect(force);
  const bool was_inside = inside_;
  partial_ = inside_ ? target_ / partial_name
                     : target_.parent_path() /
                           fmt::format(".{}{}", target_.filename().string(), partial_name);
  try {
    create_parents(target_.parent_path());
    reserve();
    inspect(force);  // again, now that nobody else can write to it
    if (inside_ != was_inside) throw UsageError(path_ + ": another run is writing to this folder");
  } catch (...) {
    remove_traces();
    throw;
  }
}

ResultFolder::~ResultFolder() { remove_traces(); }

void ResultFolder::create_parents(const fs::path& folder) {
  std::error_code error;
  if (folder.empty() || fs::is_directory(folder, error)) return;
  create_parents(folder.parent_path());
  if (::mkdir(folder.c_str(), 0777) == 0) {
    created_.push_back(folder);
  } else if (errno != EEXIST) {
    fail(folder);
  } else if (!fs::is_directory(folder, error)) {
    fail(folder, std::make_error_code(std::errc::not_a_directory));
  }
}

/// Refuses what must not be written to; else decides how the results come into place.
void ResultFolder::inspect(bool force) {
  std::error_code error;
  const fs::file_status status = fs::status(target_, error);
  if (error && status.type() != fs::file_type::not_found) fail(path_, error);
  if (fs::exists(status)) {
    if (!fs::is_directory(status)) throw UsageError(path_ + ": is a file, expected a folder");
    replaces_ = !entries(target_).empty();
    if (replaces_ && !force) {
      throw UsageError(path_ +
                       ": holds files already; choose another folder, or say --force to "
                       "replace the results of an earlier run");
    }
    if (replaces_ && !holds_results(target_)) {
      throw UsageError(path_ +
                       ": holds files but no results of an earlier run (record.json); "
                       "--force does not replace it");
    }
    inside_ = !replaces_ || !can_be_moved(target_);
  }
}

/// Takes the partial folder: a new one, or that of a run that was killed, whose lock is free.
void ResultFolder::reserve() {
  for (;;) {
    if (::mkdir(partial_.c_str(), 0777) != 0 && errno != EEXIST) fail(partial_);
    const int file = ::open(partial_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (file < 0 && errno == ENOENT) continue;  // its owner has just finished
    if (file < 0) fail(partial_);
    if (!lock(file)) {
      ::close(file);
      throw UsageError(path_ + ": another run is writing to this folder");
    }
    if (same_folder(file, partial_)) {
      lock_ = file;
      break;
    }
    ::close(file);
  }
  std::error_code error;
  for (const fs::path& left_over : entries(partial_)) {
    fs::remove_all(left_over, error);
    if (error) fail(left_over, error);
  }
  if (::access(partial_.c_str(), W_OK | X_OK) != 0) fail(partial_);
}

/// What this run made and did not hand over. The lock goes last, so that no other run meets
/// a folder on its way out.
void ResultFolder::remove_traces() noexcept {
  std::error_code ignored;
  if (lock_ >= 0) {
    if (!committed_) fs::remove_all(partial_, ignored);
    ::close(std::exchange(lock_, -1));
  }
  if (committed_) return;
  if (moving_) {
    for (fs::directory_iterator it(target_, ignored), end; !ignored && it != end;
         it.increment(ignored)) {
      fs::remove_all(it->path(), ignored);
    }
  }
  std::for_each(created_.rbegin(), created_.rend(),
                [](const fs::path& folder) { ::rmdir(folder.c_str()); });
}

void ResultFolder::write_image(int frame, std::string_view picture, const Image<Rgba8>& image) {
  if (image.empty()) return;
  const fs::path images = partial_ / "images";
  if (!has_images_ && ::mkdir(images.c_str(), 0777) != 0) fail(images);
  has_images_ = true;
  write_file(images / fmt::format("frame_{:06}_{}.png", frame, picture), png_bytes(image));
}

void ResultFolder::commit(const Record& record) {
  write_file(partial_ / "README.txt", readme_text(record, has_images_));
  write_file(partial_ / "frames.csv", frames_csv(record));
  write_file(partial_ / "trajectory.tum", trajectory_text(estimated_trajectory(record)));
  write_file(partial_ / "slambench1.log", slambench1_log(record));
  write_file(partial_ / record_name, record_json(record));
  flush_folder(partial_);
  inside_ ? move_files() : move_folder();
}

/// In one step, so that at any time the old or the new results are there, whole.
void ResultFolder::move_folder() {
  if (replaces_) {
    if (::renameat2(AT_FDCWD, partial_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) != 0) {
      // A file system that cannot exchange: two steps, with the old results aside in between.
      const fs::path aside = partial_.string() + "-replaced";
      rename_or_fail(target_, aside);
      if (::rename(partial_.c_str(), target_.c_str()) != 0) {
        const std::error_code error(errno, std::generic_category());
        rename_or_fail(aside, target_);
        fail(target_, error);
      }
      rename_or_fail(aside, partial_);
    }
  } else {
    rename_or_fail(partial_, target_);
  }
  committed_ = true;
  flush_folder(target_.parent_path());
  std::error_code ignored;
  if (replaces_) fs::remove_all(partial_, ignored);
}

/// File by file. The record marks complete results: the old one goes first, the new comes last.
void ResultFolder::move_files() {
  std::error_code error;
  if (replaces_) {
    fs::remove(target_ / record_name, error);
    for (const fs::path& old : entries(target_)) {
      fs::remove_all(old, error);
      if (error) fail(old, error);
    }
  }
  moving_ = true;
  for (const fs::path& file : entries(partial_)) {
    if (file.filename() != record_name) rename_or_fail(file, target_ / file.filename());
  }
  rename_or_fail(partial_ / record_name, target_ / record_name);
  committed_ = true;
  flush_folder(target_);
  fs::remove(partial_, error);
}

void write_results(const std::string& path, bool force, const Record& record) {
  ResultFolder(path, force).commit(record);
}

}  // namespace slambench
