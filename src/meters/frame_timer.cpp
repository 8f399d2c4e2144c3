// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/frame_timer.h"

#include <algorithm>

namespace slambench {

double FrameTimes::computation_s() const {
  return stage(Stage::preprocess) + stage(Stage::track) + stage(Stage::integrate) +
         stage(Stage::raycast) + between_stages_s.value_or(0);
}

double FrameTimes::total_s() const {
  return stage(Stage::acquire) + computation_s() + stage(Stage::render);
}

void FrameTimer::stage_begin(Stage stage) {
  if (stages_ != nullptr) stages_->stage_begin(stage);
  in_stage_ = true;
  stage_begin_s_ = clock_.now_s();
}

void FrameTimer::stage_end(Stage stage) {
  const auto i = static_cast<std::size_t>(stage);
  times_.stage_s[i] += clock_.now_s() - stage_begin_s_;
  ++times_.stage_calls[i];
  in_stage_ = false;
  if (stages_ != nullptr) stages_->stage_end(stage);
}

void FrameTimer::in_one_go_begin() {
  if (stages_ != nullptr) stages_->in_one_go_begin();
  in_one_go_ = true;
  in_kernels_s_ = 0;
  in_one_go_begin_s_ = clock_.now_s();
}

void FrameTimer::in_one_go_end() {
  const double rest_s = clock_.now_s() - in_one_go_begin_s_ - in_kernels_s_;
  times_.between_stages_s = times_.between_stages_s.value_or(0) + std::max(rest_s, 0.0);
  in_one_go_ = false;
  if (stages_ != nullptr) stages_->in_one_go_end();
}

void FrameTimer::kernel_begin(Kernel) { kernel_begin_s_ = clock_.now_s(); }

void FrameTimer::kernel_end(Kernel kernel) {
  kernel_measured(kernel, clock_.now_s() - kernel_begin_s_);
}

void FrameTimer::kernel_measured(Kernel kernel, double seconds) {
  const auto i = static_cast<std::size_t>(kernel);
  times_.kernel_s[i] += seconds;
  ++times_.kernel_calls[i];
  if (!in_one_go_) return;
  const auto stage = static_cast<std::size_t>(info(kernel).stage);
  times_.stage_s[stage] += seconds;
  times_.stage_calls[stage] = 1;
  in_kernels_s_ += seconds;
}

void FrameTimer::transfer_measured(Transfer direction, std::size_t bytes, double seconds) {
  if (!in_stage_ && !in_one_go_) return;
  TransferTimes& times = times_.transfers[static_cast<std::size_t>(direction)];
  times.seconds += seconds;
  times.bytes += bytes;
  ++times.count;
}

FrameTimes FrameTimer::take() {
  const FrameTimes taken = times_;
  times_ = {};
  return taken;
}

}  // namespace slambench
