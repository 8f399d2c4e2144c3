// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "io/files.h"

namespace slambench {

/// Encoded frames that are kept in a folder, in files of `chunk_frames` consecutive frames each.
/// A file appears whole or not at all, each frame in it has a checksum, and every process that
/// writes one writes the same: so processes may be killed and several may run at once. Where
/// nothing can be written, chunks are held in memory. Threads may call any member at once.
class FrameCache {
 public:
  static constexpr int chunk_frames = 16;

  /// `key` says everything that the frames depend on; files of another key are not read. The folder
  /// is made when the first chunk is stored; without one ("") all is held in memory.
  FrameCache(std::string folder, std::string name, const std::string& key);

  /// Whether the chunk is there, whole, of `frames` frames, every checksum right. Reads all of it,
  /// so that what follows finds it in memory.
  bool has(int chunk, int frames);

  /// Keeps the chunk, made of these encoded frames.
  void store(int chunk, const std::vector<std::string>& frames);

  /// The bytes of a frame, valid until the next call from any thread; empty when it is not there or
  /// damaged.
  std::span<const std::byte> find(int frame);

  /// Why chunks are held in memory; empty when they are not.
  std::string problem();

 private:
  struct Chunk;
  std::string path_of(int chunk) const;
  void write(int chunk, const std::string& bytes);
  const Chunk* open(int chunk);

  const std::string folder_, name_;
  const std::uint64_t key_;
  std::mutex mutex_;
  std::string problem_;
  bool tidied_ = false;
  std::map<int, std::string> in_memory_;
  int opened_ = -1;
  std::shared_ptr<const Chunk> chunk_;
};

}  // namespace slambench
