// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "io/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace slambench {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void cannot_read(const std::string& path, const std::string& why) {
  throw InputError(fmt::format("{}: cannot read: {}", path, why));
}

[[noreturn]] void cannot_write(const std::string& path, const std::string& why) {
  throw Error(ExitStatus::failed, fmt::format("{}: cannot write: {}", path, why));
}

class FileDescriptor {
 public:
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor() { close(); }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  int number() const { return number_; }
  int release() { return std::exchange(number_, -1); }
  /// False, with errno set, when the system reports a delayed error.
  bool close() {
    const int number = std::exchange(number_, -1);
    return number < 0 || ::close(number) == 0;
  }

 private:
  int number_;
};

/// What the opened file is; throws InputError when it did not open or is a folder.
struct stat status_of(const std::string& path, const FileDescriptor& file) {
  struct stat status = {};
  if (file.number() < 0 || fstat(file.number(), &status) != 0) cannot_read(path, reason(errno));
  if (S_ISDIR(status.st_mode)) cannot_read(path, "it is a folder, not a file");
  return status;
}

/// Opening does not wait for whoever is at the other end of a pipe or device.
constexpr int open_at_once = O_CLOEXEC | O_NONBLOCK | O_NOCTTY;

int open_to_read(const std::string& path) { return ::open(path.c_str(), O_RDONLY | open_at_once); }

/// From now on reading or writing waits for the other end.
void wait_for_the_other_end(int file) {
  ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK);
}

void write_all(const std::string& path, int file, std::string_view contents) {
  while (!contents.empty()) {
    const ssize_t written = ::write(file, contents.data(), contents.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) cannot_write(path, reason(errno));
    contents.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// A file of a new name in a folder, removed again unless it was moved to its place.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& target, const std::filesystem::path& folder)
      : file_(create(target, folder)) {}
  ~TemporaryFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int number() const { return file_.number(); }
  void move_to(const std::string& target, const std::string& place) {
    if (!file_.close() || ::rename(path_.c_str(), place.c_str()) != 0) {
      cannot_write(target, reason(errno));
    }
    path_.clear();
  }

 private:
  int create(const std::string& target, const std::filesystem::path& folder) {
    for (int n = 0;; ++n) {
      path_ = folder / fmt::format(".slambench-{}-{}.tmp", ::getpid(), n);
      const int file = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (file >= 0) return file;
      const int error = errno;
      if (error == EEXIST) continue;
      path_.clear();
      cannot_write(target, reason(error));
    }
  }

  std::string path_;
  FileDescriptor file_;
};

/// What is at `path` now, links followed; nothing when there is nothing.
std::optional<struct stat> present_status(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) == 0) return status;
  if (errno != ENOENT) cannot_write(path, reason(errno));
  return std::nullopt;
}

}  // namespace

void write_file(const std::string& path, std::string_view contents) {
  const auto present = present_status(path);
  if (present && S_ISDIR(present->st_mode)) cannot_write(path, "it is a folder, not a file");
  if (present && ::access(path.c_str(), W_OK) != 0) cannot_write(path, reason(errno));
  if (present && !S_ISREG(present->st_mode)) {  // a pipe or device: it must stay what it is
    FileDescriptor device(::open(path.c_str(), O_WRONLY | open_at_once));
    if (device.number() < 0 && errno == ENXIO) cannot_write(path, "nobody reads from this pipe");
    if (device.number() < 0) cannot_write(path, reason(errno));
    wait_for_the_other_end(device.number());
    write_all(path, device.number(), contents);
    return;
  }
  // Where a link leads, so that the link stays a link.
  std::error_code error;
  const std::filesystem::path place =
      present ? std::filesystem::canonical(path, error) : std::filesystem::path(path);
  if (error) cannot_write(path, error.message());
  TemporaryFile file(path, place.has_parent_path() ? place.parent_path() : ".");
  write_all(path, file.number(), contents);
  if (present && ::fchmod(file.number(), present->st_mode & 07777) != 0) {
    cannot_write(path, reason(errno));
  }
  if (::fsync(file.number()) != 0) cannot_write(path, reason(errno));
  file.move_to(path, place);
}

void remove_leftovers(const std::string& folder) {
  constexpr auto old = std::chrono::hours(24);
  std::error_code error;
  const auto now = std::filesystem::file_time_type::clock::now();
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    std::error_code ignored;
    if (it->path().extension() == ".tmp" && now - it->last_write_time(ignored) > old) {
      std::filesystem::remove(it->path(), ignored);
    }
  }
}

std::string read_file(const std::string& path) {
  const FileDescriptor file(open_to_read(path));
  const struct stat status = status_of(path, file);
  const bool pipe = S_ISFIFO(status.st_mode);
  if (!S_ISREG(status.st_mode) && !pipe) cannot_read(path, "it is not a file");
  // One byte more than the size, so that the end is seen without growing; a pipe has size 0.
  std::string contents(static_cast<std::size_t>(status.st_size) + 1, '\0');
  for (std::size_t used = 0;;) {
    if (used == contents.size()) contents.resize(std::max<std::size_t>(used * 2, 4096));
    const ssize_t count = ::read(file.number(), contents.data() + used, contents.size() - used);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) {  // a writer is there and will write
      wait_for_the_other_end(file.number());
      continue;
    }
    if (count < 0) cannot_read(path, reason(errno));
    used += static_cast<std::size_t>(count);
    if (count == 0) {
      if (pipe && used == 0) cannot_read(path, "it is a pipe that nobody writes to");
      contents.resize(used);
      return contents;
    }
  }
}

PiecewiseFile::PiecewiseFile(std::string path) : path_(std::move(path)) {
  FileDescriptor file(open_to_read(path_));
  const struct stat status = status_of(path_, file);
  if (!S_ISREG(status.st_mode)) cannot_read(path_, "it is not a file");
  size_ = static_cast<std::size_t>(status.st_size);
  ::posix_fadvise(file.number(), 0, 0, POSIX_FADV_SEQUENTIAL);  // a hint: failing is harmless
  file_ = file.release();
}

PiecewiseFile::~PiecewiseFile() { ::close(file_); }

void PiecewiseFile::read(std::size_t offset, std::span<std::byte> destination) const {
  while (!destination.empty()) {
    const ssize_t count =
        ::pread(file_, destination.data(), destination.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) cannot_read(path_, reason(errno));
    if (count == 0) {
      struct stat now {};
      ::fstat(file_, &now);
      cannot_read(
          path_, fmt::format("it has {} bytes, and had {} when it was opened", now.st_size, size_));
    }
    offset += static_cast<std::size_t>(count);
    destination = destination.subspan(static_cast<std::size_t>(count));
  }
}

std::string cache_folder() {
  // The XDG base directory specification tells to ignore relative paths.
  const char* const xdg = std::getenv("XDG_CACHE_HOME");
  if (xdg != nullptr && xdg[0] == '/') return std::string(xdg) + "/slambench";
  const char* const home = std::getenv("HOME");
  if (home != nullptr && home[0] != '\0') return std::string(home) + "/.cache/slambench";
  throw UnavailableError(
      "no folder to keep rendered sequences in: neither HOME nor XDG_CACHE_HOME is set");
}

}  // namespace slambench
