// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "runner/input_hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <bit>
#include <cstdint>
#include <new>

namespace slambench {

static_assert(std::endian::native == std::endian::little, "the hash is over memory as it lies");

namespace {

std::string text_of(XXH128_hash_t hash) {
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace

struct InputHash::State {
  State() : xxh(XXH3_createState()) {
    if (xxh == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(xxh);
  }
  ~State() { XXH3_freeState(xxh); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  XXH3_state_t* xxh;
};

InputHash::InputHash() : state_(std::make_unique<State>()) {}
InputHash::~InputHash() = default;

void InputHash::add(const Frame& frame) {
  const auto index = static_cast<std::uint32_t>(frame.index);
  XXH3_128bits_update(state_->xxh, &index, sizeof index);
  XXH3_128bits_update(state_->xxh, frame.depth.data(), frame.depth.bytes());
}

std::string InputHash::text() const { return text_of(XXH3_128bits_digest(state_->xxh)); }

std::string hash_text(std::string_view bytes) {
  return text_of(XXH3_128bits(bytes.data(), bytes.size()));
}

}  // namespace slambench
