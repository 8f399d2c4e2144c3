// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>

#include "backends/backend.h"

namespace slambench {

/// Host memory that counts how often it has been handed out for writing: who remembers something
/// about its contents can tell whether that still holds.
class VersionedStorage : public Storage {
 public:
  std::uint64_t version() const { return version_; }
  void changed() { ++version_; }

 private:
  std::uint64_t version_ = 0;
};

}  // namespace slambench
