// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "core/frame.h"
#include "datasets/source.h"
#include "meters/clock.h"

namespace slambench {

/// A frame, and how reading it went.
struct ReadFrame {
  Frame frame;
  double read_s = 0;         ///< what reading took
  std::exception_ptr error;  ///< why there is no frame
};

/// Reads frames of a source; ahead of time on a thread of its own, if asked to and the system
/// grants one. The source belongs to the reader for as long as that lives.
class FrameReader {
 public:
  FrameReader(Source& source, const Clock& clock, bool ahead);
  ~FrameReader();
  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;

  bool ahead() const { return thread_.joinable(); }
  /// Starts to read a frame and returns at once; nothing when frames are not read ahead.
  void begin(int index);
  /// Hands out frame `index`: waits for the one that was begun, or else reads it here. `frame`'s
  /// buffers are reused. What the source throws is kept in the result.
  void finish(int index, ReadFrame* frame);

 private:
  void run();
  void read(int index, ReadFrame* frame);

  Source& source_;
  const Clock& clock_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<int> wanted_;  ///< being read by the thread, into `next_`
  std::optional<int> done_;    ///< the frame that `next_` holds
  bool stop_ = false;
  ReadFrame next_;
  std::thread thread_;
};

}  // namespace slambench
