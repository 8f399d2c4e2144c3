// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/frame_cache.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

using Bytes = std::span<const std::byte>;

constexpr std::uint64_t magic = 0x3130'454d'4152'464cULL;  // "LFRAME01"

/// At the start of a file; then one Entry a frame, then the frames.
struct Header {
  std::uint64_t magic = 0;
  std::uint64_t key = 0;
  std::uint64_t frames = 0;
  std::uint64_t entries_hash = 0;
};

struct Entry {
  std::uint64_t size = 0;
  std::uint64_t hash = 0;
};

std::uint64_t hash_of(const void* data, std::size_t size) { return XXH3_64bits(data, size); }

std::string chunk_bytes(std::uint64_t key, const std::vector<std::string>& frames) {
  std::vector<Entry> entries;
  entries.reserve(frames.size());
  for (const std::string& frame : frames) {
    entries.push_back({frame.size(), hash_of(frame.data(), frame.size())});
  }
  const std::size_t table = entries.size() * sizeof(Entry);
  const Header header{magic, key, frames.size(), hash_of(entries.data(), table)};
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof header);
  bytes.append(reinterpret_cast<const char*>(entries.data()), table);
  for (const std::string& frame : frames) bytes += frame;
  return bytes;
}

/// The frames' places in a chunk; nothing when the table is damaged or of another key.
std::optional<std::vector<Entry>> entries_of(Bytes bytes, std::uint64_t key) {
  Header header;
  if (bytes.size() < sizeof header) return std::nullopt;
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.magic != magic || header.key != key || header.frames > FrameCache::chunk_frames) {
    return std::nullopt;
  }
  std::vector<Entry> entries(header.frames);
  const std::size_t table = entries.size() * sizeof(Entry);
  if (bytes.size() < sizeof header + table) return std::nullopt;
  std::memcpy(entries.data(), bytes.data() + sizeof header, table);
  if (hash_of(entries.data(), table) != header.entries_hash) return std::nullopt;
  return entries;
}

}  // namespace

/// The bytes of a chunk, of its file or held in memory.
struct FrameCache::Chunk {
  std::string file;
  Bytes bytes;
  std::vector<Entry> entries;

  /// Empty when the frame is not there or damaged.
  Bytes frame(std::size_t index) const {
    if (index >= entries.size()) return {};
    std::size_t begin = sizeof(Header) + entries.size() * sizeof(Entry);
    for (std::size_t i = 0; i < index; ++i) begin += entries[i].size;
    const Entry& entry = entries[index];
    if (begin > bytes.size() || entry.size > bytes.size() - begin) return {};
    const Bytes frame = bytes.subspan(begin, entry.size);
    return hash_of(frame.data(), frame.size()) == entry.hash ? frame : Bytes{};
  }
};

FrameCache::FrameCache(std::string folder, std::string name, const std::string& key)
    : folder_(std::move(folder)), name_(std::move(name)), key_(hash_of(key.data(), key.size())) {}

std::string FrameCache::path_of(int chunk) const {
  return fmt::format("{}/{}-{:016x}-{:03}.frames", folder_, name_, key_, chunk);
}

const FrameCache::Chunk* FrameCache::open(int chunk) {
  if (opened_ == chunk) return chunk_.get();
  auto opened = std::make_shared<Chunk>();
  if (const auto held = in_memory_.find(chunk); held != in_memory_.end()) {
    opened->bytes = std::as_bytes(std::span(held->second));
  } else {
    try {
      opened->file = read_file(path_of(chunk));
      opened->bytes = std::as_bytes(std::span(opened->file));
    } catch (const InputError&) {
      return nullptr;
    }
  }
  auto entries = entries_of(opened->bytes, key_);
  if (!entries) return nullptr;
  opened->entries = std::move(*entries);
  opened_ = chunk;
  chunk_ = std::move(opened);
  return chunk_.get();
}

bool FrameCache::has(int chunk, int frames) {
  const std::scoped_lock lock(mutex_);
  const Chunk* const opened = open(chunk);
  if (opened == nullptr || opened->entries.size() != static_cast<std::size_t>(frames)) return false;
  for (std::size_t i = 0; i < opened->entries.size(); ++i) {
    if (opened->frame(i).empty()) return false;
  }
  return true;
}

void FrameCache::write(int chunk, const std::string& bytes) {
  if (folder_.empty()) throw Error(ExitStatus::failed, "there is no folder to keep them in");
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw Error(ExitStatus::failed, fmt::format("{}: {}", folder_, error.message()));
  write_file(path_of(chunk), bytes);
}

void FrameCache::store(int chunk, const std::vector<std::string>& frames) {
  std::string bytes = chunk_bytes(key_, frames);
  std::string problem = this->problem();
  if (problem.empty()) {
    try {
      write(chunk, bytes);
    } catch (const Error& error) {
      problem = error.what();
    }
  }
  const std::scoped_lock lock(mutex_);
  if (opened_ == chunk) opened_ = -1;
  if (!std::exchange(tidied_, true)) remove_leftovers(folder_);
  if (problem.empty()) return;
  if (problem_.empty()) problem_ = problem;
  in_memory_[chunk] = std::move(bytes);
}

Bytes FrameCache::find(int frame) {
  const std::scoped_lock lock(mutex_);
  const Chunk* const chunk = open(frame / chunk_frames);
  return chunk == nullptr ? Bytes{} : chunk->frame(static_cast<std::size_t>(frame % chunk_frames));
}

std::string FrameCache::problem() {
  const std::scoped_lock lock(mutex_);
  return problem_;
}

}  // namespace slambench
