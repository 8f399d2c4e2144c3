// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "runner/frame_reader.h"

#include <system_error>
#include <utility>

#include "core/quiet_thread.h"

namespace slambench {

FrameReader::FrameReader(Source& source, const Clock& clock, bool ahead)
    : source_(source), clock_(clock) {
  if (!ahead) return;
  try {
    thread_ = quiet_thread([this] { run(); });
  } catch (const std::system_error&) {  // no thread is to be had: frames are read when asked for
  }
}

FrameReader::~FrameReader() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void FrameReader::begin(int index) {
  if (!ahead()) return;
  {
    const std::lock_guard lock(mutex_);
    done_.reset();
    wanted_ = index;
  }
  changed_.notify_all();
}

void FrameReader::finish(int index, ReadFrame* frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !wanted_; });
  if (done_ == index) {
    std::swap(*frame, next_);
  } else {
    read(index, frame);
  }
  done_.reset();
}

void FrameReader::read(int index, ReadFrame* frame) {
  frame->error = nullptr;
  const double begin_s = clock_.now_s();
  try {
    source_.read(index, frame->frame);
  } catch (...) {
    frame->error = std::current_exception();
  }
  frame->read_s = clock_.now_s() - begin_s;
}

void FrameReader::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return stop_ || wanted_; });
    if (stop_) return;
    const int index = *wanted_;
    lock.unlock();
    read(index, &next_);
    lock.lock();
    done_ = index;
    wanted_.reset();
    changed_.notify_all();
  }
}

}  // namespace slambench
