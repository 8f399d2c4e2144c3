// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "progress.h"

#include <fmt/format.h>

#include <algorithm>

#include "terminal.h"

namespace slambench {
namespace {

constexpr double redraw_interval_s = 0.1;
constexpr const char* clear_line = "\r\033[K";

}  // namespace

std::string progress_line(std::string_view what, std::string_view unit, int done, int total,
                          double elapsed_s, std::string_view remark, int width) {
  std::string figures = fmt::format(" {}/{} {}", done, total, unit);
  if (elapsed_s > 0) figures += fmt::format(", {:.1f}/s", done / elapsed_s);
  if (!remark.empty()) figures += fmt::format(", {}", remark);

  // The bar takes what is left of the line, within reason, and goes when that is too little.
  const int left = width - static_cast<int>(what.size() + figures.size()) - 4;
  const int bar = std::min(left, 30);
  std::string line(what);
  if (bar >= 5) {
    const int filled = total > 0 ? static_cast<int>(std::int64_t{bar} * done / total) : 0;
    line += fmt::format(" [{:#<{}}{:.<{}}]", "", filled, "", bar - filled);
  }
  line += figures;
  return line.substr(0, static_cast<std::size_t>(std::max(width - 1, 0)));
}

ProgressBar::ProgressBar(std::string what, std::string unit, const Clock& clock, bool wanted)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      clock_(clock),
      visible_(wanted && error_is_terminal()),
      begin_s_(clock.now_s()),
      drawn_s_(begin_s_ - redraw_interval_s) {}

ProgressBar::~ProgressBar() {
  if (visible_) print_error(clear_line);
}

void ProgressBar::show(int done, int total, std::string_view remark) {
  if (!visible_) return;
  const double now_s = clock_.now_s();
  if (now_s - drawn_s_ < redraw_interval_s && done < total) return;
  drawn_s_ = now_s;
  print_error(clear_line +
              progress_line(what_, unit_, done, total, now_s - begin_s_, remark, terminal_width()));
}

}  // namespace slambench
