// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <string_view>

#include "meters/clock.h"

namespace slambench {

/// A line that is redrawn at standard error while something goes on, and removed at its end. Draws
/// nothing unless standard error is a terminal and the user wants to see it.
class ProgressBar {
 public:
  /// `what` goes on, in `unit`s ("frames").
  ProgressBar(std::string what, std::string unit, const Clock& clock, bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `remark` stands at the end of the line. Redraws at most ten times a second.
  void show(int done, int total, std::string_view remark = "");

 private:
  const std::string what_, unit_;
  const Clock& clock_;
  const bool visible_;
  const double begin_s_;
  double drawn_s_;
};

/// The line itself, `width` columns at most: "what [#####.....] 120/400 frames, 35.1/s, remark".
std::string progress_line(std::string_view what, std::string_view unit, int done, int total,
                          double elapsed_s, std::string_view remark, int width);

}  // namespace slambench
