// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "core/parameter.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <type_traits>

#include "core/error.h"
#include "core/trimmed.h"

namespace slambench {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = text.find(',', begin);
    parts.push_back(trimmed(text.substr(begin, comma - begin)));
    if (comma == std::string_view::npos) return parts;
    begin = comma + 1;
  }
}

[[noreturn]] void reject(const Parameter& parameter, std::string_view found) {
  throw UsageError(
      fmt::format("--{}: found '{}', expected {}", parameter.name, found, expectation(parameter)));
}

/// Locale-independent; the whole text must be the number.
template <class T>
T parse_number(const Parameter& parameter, std::string_view part, std::string_view whole) {
  if (!part.empty() && part.front() == '+') part.remove_prefix(1);
  T number{};
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
  if (part.empty() || error != std::errc{} || end != part.data() + part.size()) {
    reject(parameter, whole);
  }
  return number;
}

template <class T, std::size_t N>
std::array<T, N> parse_array(const Parameter& parameter, std::string_view text) {
  const auto parts = split(text);
  const bool repeat = N == 3 && parts.size() == 1 && parameter.parts.empty();
  if (parts.size() != N && !repeat) reject(parameter, text);
  std::array<T, N> values{};
  for (std::size_t i = 0; i < N; ++i) {
    values[i] = parse_number<T>(parameter, repeat ? parts[0] : parts[i], text);
  }
  return values;
}

template <class T>
std::string number_text(T value) {
  return fmt::format("{}", value);
}

template <class Range>
std::string list_text(const Range& values) {
  std::string text;
  for (const auto& value : values) {
    if (!text.empty()) text += ',';
    text += number_text(value);
  }
  return text;
}

std::string range_text(const Parameter& p) { return fmt::format("[{}, {}]", p.min, p.max); }

/// Of a triple of such numbers.
std::string triple_text(const Parameter& p, std::string_view numbers, const std::string& unit) {
  const std::string range = fmt::format("{} in {}{}", numbers, range_text(p), unit);
  return p.parts.empty() ? "one or three " + range : fmt::format("three {}: {}", range, p.parts);
}

/// Every number of the value, for the range check.
std::vector<double> numbers(const Parameter& parameter) {
  return std::visit(Overloaded{
                        [](bool*) { return std::vector<double>{}; },
                        [](std::string*) { return std::vector<double>{}; },
                        [](int* v) { return std::vector<double>{static_cast<double>(*v)}; },
                        [](double* v) { return std::vector<double>{*v}; },
                        [](std::optional<double>* v) {
                          return v->has_value() ? std::vector<double>{**v} : std::vector<double>{};
                        },
                        [](std::optional<std::array<double, 4>>* v) {
                          return v->has_value() ? std::vector<double>((*v)->begin(), (*v)->end())
                                                : std::vector<double>{};
                        },
                        [](auto* v) { return std::vector<double>(v->begin(), v->end()); },
                    },
                    parameter.value);
}

}  // namespace

ParameterList with_role(ParameterRole role, ParameterList list) {
  for (Parameter& parameter : list.parameters) parameter.role = role;
  return list;
}

std::string to_text(const Parameter& parameter) {
  return std::visit(
      Overloaded{
          [](bool* v) { return std::string(*v ? "true" : "false"); },
          [](int* v) { return number_text(*v); },
          [](double* v) { return number_text(*v); },
          [](std::string* v) { return *v; },
          [](std::optional<double>* v) { return v->has_value() ? number_text(**v) : ""; },
          [](std::optional<std::array<double, 4>>* v) {
            return v->has_value() ? list_text(**v) : "";
          },
          [](auto* v) { return list_text(*v); },
      },
      parameter.value);
}

void set_from_text(const Parameter& parameter, std::string_view text) {
  text = trimmed(text);
  std::visit(Overloaded{
                 [&](bool* v) {
                   if (text == "true" || text == "1") {
                     *v = true;
                   } else if (text == "false" || text == "0") {
                     *v = false;
                   } else {
                     reject(parameter, text);
                   }
                 },
                 [&](int* v) { *v = parse_number<int>(parameter, text, text); },
                 [&](double* v) { *v = parse_number<double>(parameter, text, text); },
                 [&](std::string* v) { *v = text; },
                 [&](std::vector<int>* v) {
                   std::vector<int> values;
                   for (const auto part : split(text)) {
                     values.push_back(parse_number<int>(parameter, part, text));
                   }
                   *v = values;
                 },
                 [&](std::optional<double>* v) {
                   if (text.empty()) {
                     v->reset();
                   } else {
                     *v = parse_number<double>(parameter, text, text);
                   }
                 },
                 [&](std::optional<std::array<double, 4>>* v) {
                   if (text.empty()) {
                     v->reset();
                   } else {
                     *v = parse_array<double, 4>(parameter, text);
                   }
                 },
                 [&](auto* v) {
                   using Array = std::remove_pointer_t<decltype(v)>;
                   *v = parse_array<typename Array::value_type, 3>(parameter, text);
                 },
             },
             parameter.value);
  check(parameter);
}

void check(const Parameter& parameter) {
  for (const double number : numbers(parameter)) {
    if (!std::isfinite(number) || number < parameter.min || number > parameter.max) {
      reject(parameter, to_text(parameter));
    }
  }
  if (const auto* const* list = std::get_if<std::vector<int>*>(&parameter.value)) {
    if ((*list)->empty()) reject(parameter, "nothing");
  }
  if (auto* const* word = std::get_if<std::string*>(&parameter.value);
      word != nullptr && !parameter.choices.empty()) {
    for (const auto choice : parameter.choices) {
      if (choice == **word) return;
    }
    reject(parameter, **word);
  }
}

std::string expectation(const Parameter& parameter) {
  const std::string unit = parameter.unit.empty() ? "" : fmt::format(" {}", parameter.unit);
  return std::visit(
      Overloaded{
          [](bool*) { return std::string("true or false"); },
          [&](int*) { return fmt::format("an integer in {}{}", range_text(parameter), unit); },
          [&](double*) { return fmt::format("a number in {}{}", range_text(parameter), unit); },
          [&](std::optional<double>*) {
            return fmt::format("a number in {}{}", range_text(parameter), unit);
          },
          [&](std::string*) {
            if (parameter.choices.empty()) return std::string("text");
            return fmt::format("one of {}", fmt::join(parameter.choices, ", "));
          },
          [&](std::array<int, 3>*) { return triple_text(parameter, "integers", unit); },
          [&](std::array<double, 3>*) { return triple_text(parameter, "numbers", unit); },
          [&](std::vector<int>*) {
            return fmt::format("integers in {}{}, separated by commas", range_text(parameter),
                               unit);
          },
          [&](std::optional<std::array<double, 4>>*) {
            return fmt::format("four numbers in {}{}", range_text(parameter), unit);
          },
      },
      parameter.value);
}

const Parameter* find(const std::vector<ParameterList>& lists, std::string_view name) {
  for (const auto& list : lists) {
    for (const auto& parameter : list.parameters) {
      if (parameter.name == name) return &parameter;
    }
  }
  return nullptr;
}

}  // namespace slambench
