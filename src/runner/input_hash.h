// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/frame.h"

namespace slambench {

/// XXH3-128 over what a system was given: of each frame its index as 32 bits, then its depth
/// pixels, all little-endian. Equal hashes mean equal inputs, wherever they were read from.
class InputHash {
 public:
  InputHash();
  ~InputHash();
  void add(const Frame& frame);
  /// 32 hexadecimal digits, the most significant first, as xxh128sum prints them.
  std::string text() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The same hash over bytes.
std::string hash_text(std::string_view bytes);

}  // namespace slambench
