// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "scene/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "core/error.h"
#include "io/text.h"

namespace slambench {
namespace {

enum class Format { ascii, little_endian, big_endian };
enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };

std::optional<Type> type_of(std::string_view word) {
  constexpr std::pair<std::string_view, Type> names[] = {
      {"char", Type::i8},   {"int8", Type::i8},     {"uchar", Type::u8},   {"uint8", Type::u8},
      {"short", Type::i16}, {"int16", Type::i16},   {"ushort", Type::u16}, {"uint16", Type::u16},
      {"int", Type::i32},   {"int32", Type::i32},   {"uint", Type::u32},   {"uint32", Type::u32},
      {"float", Type::f32}, {"float32", Type::f32}, {"double", Type::f64}, {"float64", Type::f64}};
  for (const auto& [name, type] : names) {
    if (name == word) return type;
  }
  return std::nullopt;
}

struct Property {
  std::string name;
  Type type = Type::f32;
  std::optional<Type> count_type;  ///< of a list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

/// Takes a PLY file apart from its beginning to its end.
class Reader {
 public:
  Reader(const std::string& path, std::string_view contents) : path_(path), rest_(contents) {}

  Mesh read() {
    read_header();
    for (const Element& element : elements_) {
      for (std::size_t i = 0; i < element.count; ++i) {
        where_ = fmt::format("{} {}", element.name, i);
        read_row(element);
        if (element.name == "vertex") add_vertex(element);
        if (element.name == "face") add_face();
      }
    }
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(std::string_view found, std::string_view expected) const {
    throw InputError(path_, where_, found, expected);
  }

  std::string_view take_line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) fail("the end of the file", "a line (it is truncated)");
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  void read_header() {
    where_ = "line 1";
    if (!rest_.starts_with("ply")) fail(quote(rest_.substr(0, 12)), "ply");
    take_line();
    bool has_format = false;
    for (int number = 2;; ++number) {
      where_ = fmt::format("line {}", number);
      const std::string_view line = take_line();
      const auto parsed = text_lines(line);
      if (parsed.empty()) continue;
      const auto& words = parsed[0].fields;
      if (words[0] == "end_header") break;
      if (words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "format" && words.size() == 3) {
        has_format = set_format(words[1]);
      } else if (words[0] == "element" && words.size() == 3) {
        add_element(words[1], words[2]);
      } else if (words[0] == "property" && !elements_.empty()) {
        add_property(words);
      } else {
        fail(quote(line), "a line of a PLY header");
      }
    }
    where_ = "header";
    if (!has_format) fail("no format", "one");
    check_vertex_properties();
  }

  bool set_format(std::string_view word) {
    if (word == "ascii") {
      format_ = Format::ascii;
    } else if (word == "binary_little_endian") {
      format_ = Format::little_endian;
    } else if (word == "binary_big_endian") {
      format_ = Format::big_endian;
    } else {
      fail(quote(word), "ascii, binary_little_endian or binary_big_endian");
    }
    return true;
  }

  void add_element(std::string_view name, std::string_view count_word) {
    std::size_t count = 0;
    const auto [end, error] =
        std::from_chars(count_word.data(), count_word.data() + count_word.size(), count);
    if (error != std::errc{} || end != count_word.data() + count_word.size()) {
      fail(quote(count_word), "a number of elements");
    }
    elements_.push_back({std::string(name), count, {}});
  }

  void add_property(const std::vector<std::string_view>& words) {
    Property property;
    const bool list = words.size() == 5 && words[1] == "list";
    if (!list && words.size() != 3) fail(quote(words[0]), "property TYPE NAME");
    const auto type = type_of(words[list ? 3 : 1]);
    if (list) property.count_type = type_of(words[2]);
    if (!type || (list && !property.count_type)) fail(quote(words[1]), "a type of PLY");
    property.type = *type;
    property.name = words.back();
    elements_.back().properties.push_back(property);
  }

  void check_vertex_properties() const {
    for (const Element& element : elements_) {
      // Else a count from a damaged header would be worked through without any bytes.
      if (element.count > 0 && element.properties.empty()) fail("no property", "one an element");
      if (element.name != "vertex") continue;
      for (const std::string_view name : {"x", "y", "z"}) {
        const bool found =
            std::any_of(element.properties.begin(), element.properties.end(),
                        [&](const Property& p) { return p.name == name && !p.count_type; });
        if (!found) fail(fmt::format("no property {}", name), "x, y and z of a vertex");
      }
      return;
    }
    fail("no element vertex", "one");
  }

  template <class T>
  double binary_number() {
    std::array<char, sizeof(T)> raw;
    if (rest_.size() < raw.size()) fail("the end of the file", "a value (it is truncated)");
    std::copy_n(rest_.data(), raw.size(), raw.begin());
    rest_.remove_prefix(raw.size());
    const bool native =
        (std::endian::native == std::endian::little) == (format_ == Format::little_endian);
    if (!native) std::reverse(raw.begin(), raw.end());
    return static_cast<double>(std::bit_cast<T>(raw));
  }

  double ascii_number() {
    const std::size_t begin = rest_.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) {
      fail("the end of the file", "a value (it is truncated)");
    }
    const std::size_t end = std::min(rest_.find_first_of(" \t\r\n", begin), rest_.size());
    const std::string_view word = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    const auto number = parse_finite(word);
    if (!number) fail(quote(word), "a number");
    return *number;
  }

  double number(Type type) {
    if (format_ == Format::ascii) return ascii_number();
    switch (type) {
      case Type::i8:
        return binary_number<std::int8_t>();
      case Type::u8:
        return binary_number<std::uint8_t>();
      case Type::i16:
        return binary_number<std::int16_t>();
      case Type::u16:
        return binary_number<std::uint16_t>();
      case Type::i32:
        return binary_number<std::int32_t>();
      case Type::u32:
        return binary_number<std::uint32_t>();
      case Type::f32:
        return binary_number<float>();
      case Type::f64:
        break;
    }
    return binary_number<double>();
  }

  /// Fills in `row_` (the scalars, in order) and `list_` (the vertex indices).
  void read_row(const Element& element) {
    row_.clear();
    list_.clear();
    for (const Property& property : element.properties) {
      if (!property.count_type) {
        row_.push_back(number(property.type));
        continue;
      }
      row_.push_back(0);
      const double count = number(*property.count_type);
      if (!(count >= 0)) fail(fmt::format("a list of {}", count), "a number of values");
      const bool wanted = property.name == "vertex_indices" || property.name == "vertex_index";
      for (double i = 0; i < count; ++i) {
        const double value = number(property.type);
        if (wanted) list_.push_back(value);
      }
    }
  }

  void add_vertex(const Element& element) {
    Eigen::Vector3f point;
    Rgb8 color{178, 178, 178};
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Property& property = element.properties[i];
      const bool is_byte = property.type == Type::u8;
      const auto channel = [&] {
        return static_cast<std::uint8_t>(std::clamp(is_byte ? row_[i] : row_[i] * 255, 0.0, 255.0));
      };
      const auto value = static_cast<float>(row_[i]);
      if (property.name == "x") point.x() = value;
      if (property.name == "y") point.y() = value;
      if (property.name == "z") point.z() = value;
      if (property.name == "red") color.r = channel();
      if (property.name == "green") color.g = channel();
      if (property.name == "blue") color.b = channel();
    }
    if (!point.allFinite()) fail("a coordinate that is not finite", "numbers");
    mesh_.vertices.push_back(point);
    mesh_.colors.push_back(color);
  }

  void add_face() {
    for (std::size_t i = 2; i < list_.size(); ++i) {
      mesh_.triangles.push_back({index(list_[0]), index(list_[i - 1]), index(list_[i])});
    }
  }

  std::uint32_t index(double value) const {
    if (!(value >= 0) || value >= static_cast<double>(mesh_.vertices.size())) {
      fail(fmt::format("vertex {}", value),
           fmt::format("one of the {} before it", mesh_.vertices.size()));
    }
    return static_cast<std::uint32_t>(value);
  }

  const std::string& path_;
  std::string_view rest_;
  std::string where_;
  Format format_ = Format::ascii;
  std::vector<Element> elements_;
  std::vector<double> row_, list_;
  Mesh mesh_;
};

}  // namespace

Mesh parse_ply(const std::string& path, std::string_view contents) {
  return Reader(path, contents).read();
}

}  // namespace slambench
