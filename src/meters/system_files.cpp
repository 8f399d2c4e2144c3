// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/system_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "core/trimmed.h"
#include "io/text.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = std::size_t{64} << 10;

/// Digits compare as numbers.
bool natural_less(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      std::uint64_t x = 0, y = 0;
      i = static_cast<std::size_t>(std::from_chars(&a[i], a.data() + a.size(), x).ptr - a.data());
      j = static_cast<std::size_t>(std::from_chars(&b[j], b.data() + b.size(), y).ptr - b.data());
      if (x != y) return x < y;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i, ++j;
    }
  }
  return a.size() - i < b.size() - j;
}

template <class T>
T parsed(const std::string& text, const std::string& path, const char* expected) {
  T value{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size()) {
    throw MeterError(fmt::format("{}: found {}, expected {}", path, quote(text), expected));
  }
  return value;
}

}  // namespace

bool SystemFiles::exists(std::string_view file) const {
  std::error_code ignored;
  return fs::exists(path(file), ignored);
}

std::vector<std::string> SystemFiles::names(std::string_view folder) const {
  std::vector<std::string> found;
  std::error_code error;
  for (fs::directory_iterator it(path(folder), error), end; !error && it != end;
       it.increment(error)) {
    found.push_back(it->path().filename().string());
  }
  std::sort(found.begin(), found.end(), natural_less);
  return found;
}

std::string SystemFiles::link_target_name(std::string_view file) const {
  std::error_code error;
  const fs::path target = fs::read_symlink(path(file), error);
  return error ? "" : target.filename().string();
}

std::string SystemFiles::text(std::string_view file) const {
  const std::string name = path(file);
  const auto fail = [&] { throw MeterError(fmt::format("{}: {}", name, std::strerror(errno))); };
  const int descriptor = ::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) fail();
  std::string contents;
  std::array<char, 4096> buffer;
  ssize_t count = 0;
  do {
    count = ::read(descriptor, buffer.data(), buffer.size());
    if (count > 0) contents.append(buffer.data(), static_cast<std::size_t>(count));
  } while ((count > 0 && contents.size() < most_bytes) || (count < 0 && errno == EINTR));
  const int error = errno;
  ::close(descriptor);
  errno = error;
  if (count < 0) fail();
  return std::string(trimmed(contents, std::string_view(" \t\r\n\0", 5)));
}

std::string SystemFiles::text_or_empty(std::string_view file) const {
  try {
    return text(file);
  } catch (const MeterError&) {
    return {};
  }
}

std::uint64_t SystemFiles::count(std::string_view file) const {
  return parsed<std::uint64_t>(text(file), path(file), "a whole number");
}

double SystemFiles::number(std::string_view file) const {
  const std::string found = text(file);
  const auto value = parsed<double>(found, path(file), "a number");
  if (!std::isfinite(value)) {
    throw MeterError(fmt::format("{}: found {}, expected a number", path(file), quote(found)));
  }
  return value;
}

std::vector<std::string> processor_folders(const SystemFiles& files) {
  std::vector<std::string> folders;
  for (const std::string& name : files.names(processors_folder)) {
    const bool is_processor = name.starts_with("cpu") && name.size() > 3 &&
                              name.find_first_not_of("0123456789", 3) == std::string::npos;
    if (is_processor) folders.push_back(fmt::format("{}/{}", processors_folder, name));
  }
  return folders;
}

}  // namespace slambench
