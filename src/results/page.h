// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace slambench {

enum class Look { plain, heading, good, bad };

/// Lines of text, coloured when that is wanted.
class Page {
 public:
  static constexpr std::size_t width = 80;

  explicit Page(bool colors) : colors_(colors) {}

  void line(std::string_view text, Look look = Look::plain) {
    static constexpr std::string_view codes[] = {"", "\x1b[1m", "\x1b[32m", "\x1b[1;31m"};
    const bool colored = colors_ && look != Look::plain;
    if (colored) text_ += codes[static_cast<std::size_t>(look)];
    text_ += text;
    if (colored) text_ += "\x1b[0m";
    text_ += '\n';
  }
  /// Under a label, broken between words so that it fits the terminal.
  void wrapped(std::string_view label, std::string_view text, Look look = Look::plain) {
    constexpr std::size_t indent = 12;
    std::string row = fmt::format("{:<{}}", label, indent);
    std::size_t used = 0;
    while (!text.empty()) {
      const std::string_view word = text.substr(0, text.find(' '));
      text.remove_prefix(std::min(text.size(), word.size() + 1));
      if (used > 0 && row.size() + 1 + word.size() > width) {
        line(row, look);
        row.assign(indent, ' ');
        used = 0;
      }
      if (used++ > 0) row += ' ';
      row += word;
    }
    line(row, look);
  }
  void gap() { text_ += '\n'; }
  std::string text() && { return std::move(text_); }

 private:
  const bool colors_;
  std::string text_;
};

}  // namespace slambench
