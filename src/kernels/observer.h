// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstddef>
#include <string_view>

#include "kernels/kernel.h"

namespace slambench {

/// Which way bytes go between the host and a device that does not compute in the host's memory.
enum class Transfer { to_device, to_host };
inline constexpr std::size_t transfer_count = 2;
constexpr std::string_view name(Transfer direction) {
  return direction == Transfer::to_device ? "to_device" : "to_host";
}

/// Is told what runs when. The pipeline and the backends have no clock of their own: whoever
/// measures implements this.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void stage_begin(Stage stage) = 0;
  virtual void stage_end(Stage stage) = 0;
  /// Around preprocess to raycast of a frame that a backend computes before anybody waits. None of
  /// these stages is told of: what is measured of its kernels is what there is of a stage's time.
  virtual void in_one_go_begin() = 0;
  virtual void in_one_go_end() = 0;
  /// Around each call of a kernel by a backend that computes before it returns.
  virtual void kernel_begin(Kernel kernel) = 0;
  virtual void kernel_end(Kernel kernel) = 0;
  /// From a backend with clocks on its device, once the time of an earlier call is known.
  virtual void kernel_measured(Kernel kernel, double seconds) = 0;
  /// The same of a transfer. Its time is part of the stage's, or in one go of what lies between
  /// stages, and of the kernel's that waits for it to go on: it is never to be added to any.
  virtual void transfer_measured(Transfer direction, std::size_t bytes, double seconds) = 0;
};

/// Reports a stage for as long as it lives. A null observer is told nothing.
class StageScope {
 public:
  StageScope(Observer* observer, Stage stage) : observer_(observer), stage_(stage) {
    if (observer_ != nullptr) observer_->stage_begin(stage_);
  }
  ~StageScope() {
    if (observer_ != nullptr) observer_->stage_end(stage_);
  }
  StageScope(const StageScope&) = delete;
  StageScope& operator=(const StageScope&) = delete;

 private:
  Observer* observer_;
  Stage stage_;
};

/// Reports a frame that is computed in one go for as long as it lives. A null observer is told
/// nothing.
class InOneGoScope {
 public:
  explicit InOneGoScope(Observer* observer) : observer_(observer) {
    if (observer_ != nullptr) observer_->in_one_go_begin();
  }
  ~InOneGoScope() {
    if (observer_ != nullptr) observer_->in_one_go_end();
  }
  InOneGoScope(const InOneGoScope&) = delete;
  InOneGoScope& operator=(const InOneGoScope&) = delete;

 private:
  Observer* observer_;
};

/// Reports a kernel for as long as it lives. A null observer is told nothing.
class KernelScope {
 public:
  KernelScope(Observer* observer, Kernel kernel) : observer_(observer), kernel_(kernel) {
    if (observer_ != nullptr) observer_->kernel_begin(kernel_);
  }
  ~KernelScope() {
    if (observer_ != nullptr) observer_->kernel_end(kernel_);
  }
  KernelScope(const KernelScope&) = delete;
  KernelScope& operator=(const KernelScope&) = delete;

 private:
  Observer* observer_;
  Kernel kernel_;
};

}  // namespace slambench
