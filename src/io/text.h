// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace slambench {

/// A line of a text file, cut at blanks and tabs.
struct TextLine {
  int number = 0;  ///< in the file, from 1
  std::vector<std::string_view> fields;
};

/// The lines that hold something, views into `text`: empty lines and those that begin with '#' are
/// left out; LF and CRLF end a line; a UTF-8 byte order mark at the start is skipped.
std::vector<TextLine> text_lines(std::string_view text);

/// The number that the whole of `text` is, whatever the locale; nothing for anything else,
/// infinities and NaN included.
std::optional<double> parse_finite(std::string_view text);

/// What a message shows of a piece of a file: at most 40 characters in quotes, control characters
/// and bytes that are not ASCII replaced by '?'.
std::string quote(std::string_view text);

/// A field of a CSV file (RFC 4180): in quotes where it needs them.
std::string csv_field(std::string_view text);

/// The fields of a line of a CSV file, without their quotes. A line end within quotes is not
/// understood: such a line has a field that nothing closes, and there are no fields then.
std::vector<std::string> csv_fields(std::string_view line);

/// Takes the next line, without its line end (LF or CR LF), off the front of the text.
std::string_view take_line(std::string_view* text);

}  // namespace slambench
