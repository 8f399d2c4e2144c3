// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "io/whole_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view partial_name = ".slambench-partial";

[[noreturn]] void fail(const fs::path& path, const std::error_code& error) {
  throw Error(ExitStatus::failed,
              fmt::format("{}: cannot write: {}", path.string(), error.message()));
}
[[noreturn]] void fail(const fs::path& path) { fail(path, {errno, std::generic_category()}); }

/// Absolute, without a '/' at the end, links followed as far as the path exists.
fs::path resolved(const std::string& path) {
  if (path.empty()) throw UsageError("the folder to write to has an empty name");
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

/// Whether a path lies in a folder or is that. Both are absolute, links followed.
bool lies_in(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

/// Whether a folder can be renamed: no mount point, in a folder that can be written, and not the
/// one that the user's shell is in, which would be left in a removed one.
bool can_be_moved(const fs::path& folder) {
  std::error_code error;
  const fs::path working = fs::current_path(error);
  if (error || lies_in(working, folder)) return false;
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

}  // namespace

WholeFolder::WholeFolder(const std::string& path, bool force, const FolderKind& kind)
    : path_(path), kind_(kind), target_(resolved(path)) {
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

WholeFolder::~WholeFolder() { remove_traces(); }

void WholeFolder::create_parents(const fs::path& folder) {
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

/// Refuses what must not be written to; else decides how the files come into place.
void WholeFolder::inspect(bool force) {
  std::error_code error;
  const fs::file_status status = fs::status(target_, error);
  if (error && status.type() != fs::file_type::not_found) fail(path_, error);
  if (fs::exists(status)) {
    if (!fs::is_directory(status)) throw UsageError(path_ + ": is a file, expected a folder");
    replaces_ = !entries(target_).empty();
    if (replaces_ && !force) {
      throw UsageError(
          fmt::format("{}: holds files already; choose another folder, or say --force to replace "
                      "the {}",
                      path_, kind_.contents));
    }
    if (replaces_ && !kind_.is_one(target_)) {
      throw UsageError(fmt::format("{}: holds files but no {} ({}); --force does not replace it",
                                   path_, kind_.contents, kind_.mark));
    }
    inside_ = !replaces_ || !can_be_moved(target_);
  }
}

/// Takes the partial folder: a new one, or that of a process that was killed, whose lock is free.
void WholeFolder::reserve() {
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

/// What this made and did not hand over. The lock goes last, so that nobody else meets a folder on
/// its way out.
void WholeFolder::remove_traces() noexcept {
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

bool WholeFolder::contains(const std::string& file) const {
  std::error_code error;
  const fs::path place = fs::weakly_canonical(fs::absolute(file, error), error);
  return !error && lies_in(place, target_);
}

void WholeFolder::make_folder(const std::string& name) const {
  if (::mkdir(file(name).c_str(), 0777) != 0) fail(target_ / name);
}

void WholeFolder::commit() {
  flush_folder(partial_);
  inside_ ? move_files() : move_folder();
}

/// In one step, so that at any time the old or the new folder is there, whole.
void WholeFolder::move_folder() {
  if (replaces_) {
    if (::renameat2(AT_FDCWD, partial_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) != 0) {
      // A file system that cannot exchange: two steps, with the old folder aside in between.
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

/// File by file. The mark says that it is whole: the old one goes first, the new one comes last.
void WholeFolder::move_files() {
  std::error_code error;
  if (replaces_) {
    fs::remove(target_ / kind_.mark, error);
    for (const fs::path& old : entries(target_)) {
      fs::remove_all(old, error);
      if (error) fail(old, error);
    }
  }
  moving_ = true;
  for (const fs::path& file : entries(partial_)) {
    if (file.filename() != kind_.mark) rename_or_fail(file, target_ / file.filename());
  }
  rename_or_fail(partial_ / kind_.mark, target_ / kind_.mark);
  committed_ = true;
  flush_folder(target_);
  fs::remove(partial_, error);
}

}  // namespace slambench
