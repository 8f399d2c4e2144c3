// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "suite_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "suite/suite_summary.h"
#include "terminal.h"

namespace slambench {
namespace {

constexpr const char* clear_line = "\r\033[K";
constexpr double redraw_interval_s = 0.5;

std::string left_text(const std::optional<double>& left_s) {
  return left_s ? fmt::format("{} left", duration_text(std::max(*left_s, 0.0))) : "";
}

}  // namespace

SuiteProgress::SuiteProgress(std::size_t runs, const Clock& clock, bool wanted)
    : runs_(runs), clock_(clock), wanted_(wanted), on_terminal_(wanted && error_is_terminal()) {}

void SuiteProgress::begin(std::size_t index, std::string name, std::optional<double> left_s) {
  index_ = index;
  name_ = std::move(name);
  left_s_ = left_s;
  begin_s_ = clock_.now_s();
  shown_s_ = begin_s_ - redraw_interval_s;
  show();
}

double SuiteProgress::elapsed_s() const { return clock_.now_s() - begin_s_; }

void SuiteProgress::show() {
  const double now_s = clock_.now_s();
  if (!on_terminal_ || now_s - shown_s_ < redraw_interval_s) return;
  shown_s_ = now_s;
  std::string line = fmt::format("{} {:>22.0f} s", head(), elapsed_s());
  if (left_s_) line += fmt::format("  {}", left_text(*left_s_ - elapsed_s()));
  print_error(clear_line + line.substr(0, static_cast<std::size_t>(terminal_width() - 1)));
}

void SuiteProgress::end(std::optional<double> fps, std::optional<double> left_s) {
  if (on_terminal_) print_error(clear_line);
  if (!wanted_) return;
  std::string line =
      fmt::format("{} {:>13} {:>8}", head(), fps ? fmt::format("{:.2f} fps", *fps) : "-",
                  fmt::format("{:.1f} s", elapsed_s()));
  if (index_ + 1 < runs_) line += fmt::format("  {}", left_text(left_s));
  print(line + "\n");
}

void SuiteProgress::fail(const std::string& reason) {
  if (on_terminal_) print_error(clear_line);
  if (wanted_) print(fmt::format("{} failed: {}\n", head(), reason));
}

/// "[ 3/60] living-room-2-published-serial/1       ", on a terminal with no longer name than fits.
std::string SuiteProgress::head() const {
  constexpr std::size_t most = 38;
  const std::string total = std::to_string(runs_);
  const bool whole = name_.size() <= most || !output_is_terminal();
  const std::string name = whole ? name_ : "..." + name_.substr(name_.size() - most + 3);
  return fmt::format("[{:>{}}/{}] {:<{}}", index_ + 1, total.size(), total, name, most);
}

}  // namespace slambench
