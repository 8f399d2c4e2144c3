// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/frame_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "io/files.h"
#include "io/text.h"

namespace slambench {
namespace {

/// The next field of a row, which is shortened by it. No field of a frames.csv is quoted.
std::string_view take_field(std::string_view* row) {
  const std::size_t end = row->find(',');
  const std::string_view field = row->substr(0, end);
  *row = end == std::string_view::npos ? std::string_view() : row->substr(end + 1);
  return field;
}

std::size_t field_count(std::string_view row) {
  return 1 + static_cast<std::size_t>(std::count(row.begin(), row.end(), ','));
}

}  // namespace

FrameColumns parse_frame_columns(std::string_view csv, const std::string& path) {
  std::string_view header = take_line(&csv);
  const std::size_t width = field_count(header);
  std::vector<FrameColumns::value_type*> order;
  FrameColumns columns;
  for (std::size_t i = 0; i < width; ++i) {
    order.push_back(&*columns.try_emplace(std::string(take_field(&header))).first);
  }
  for (int number = 2; !csv.empty(); ++number) {
    std::string_view row = take_line(&csv);
    const std::string place = fmt::format("line {}", number);
    if (field_count(row) != width) {
      throw InputError(path, place, fmt::format("{} fields", field_count(row)),
                       fmt::format("{}", width));
    }
    for (auto* column : order) {
      const std::string_view field = take_field(&row);
      const auto value = field.empty() ? std::optional<double>(std::nan("")) : parse_finite(field);
      if (!value) {
        throw InputError(path, place, quote(field),
                         fmt::format("a number or nothing as {}", quote(column->first)));
      }
      column->second.push_back(*value);
    }
  }
  return columns;
}

FrameColumns read_frame_columns(const std::string& path) {
  return parse_frame_columns(read_file(path), path);
}

}  // namespace slambench
