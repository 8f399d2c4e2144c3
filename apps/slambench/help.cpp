// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "help.h"

#include <fmt/format.h>

#include <sstream>
#include <vector>

namespace slambench {
namespace {

constexpr std::size_t page_width = 80;
constexpr std::size_t right_column = 30;

/// "-c, --compute-size-ratio N"; options without a letter leave its place empty. A text that the
/// option has of its own stands for it.
std::string left_text(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name(true);
  if (!option.get_option_text().empty()) return "    " + option.get_option_text();
  std::string text;
  for (const auto& letter : option.get_snames()) text += fmt::format("-{}, ", letter);
  if (text.empty()) text.assign(4, ' ');
  for (const auto& word : option.get_lnames()) text += fmt::format("--{}, ", word);
  text.resize(text.size() - 2);
  const std::string value = option.get_type_name();
  return option.get_expected_max() > 0 && !value.empty() ? text + " " + value : text;
}

std::string row(const std::string& left, const std::string& sentence) {
  const std::string text = wrapped(sentence, page_width - right_column, right_column);
  if (left.size() + 4 > right_column) {
    return fmt::format("  {}\n{:{}}{}\n", left, "", right_column, text);
  }
  return fmt::format("  {:{}}{}\n", left, right_column - 2, text);
}

std::string usage(const CLI::App& command) {
  std::string text = command.get_name();
  for (const auto* parent = command.get_parent(); parent != nullptr;
       parent = parent->get_parent()) {
    text = fmt::format("{} {}", parent->get_name(), text);
  }
  if (!command.get_subcommands([](const CLI::App*) { return true; }).empty()) text += " COMMAND";
  for (const auto* option : command.get_options()) {
    if (!option->get_positional()) continue;
    const std::string name = option->get_name(true);
    text += option->get_required() ? " " + name : fmt::format(" [{}]", name);
  }
  return fmt::format("Usage: {} [OPTIONS]\n", text);
}

std::string as_sentence(std::string text) {
  if (text.empty()) return text;
  if (text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  if (!text.ends_with('.')) text += '.';
  return text;
}

std::string rows(const CLI::App& command, const std::string& title,
                 const std::function<bool(const CLI::Option*)>& wanted) {
  std::string text;
  for (const auto* option : command.get_options(wanted)) {
    if (option->get_description().empty()) continue;  // another's row tells of it
    text += row(left_text(*option), option->get_description());
  }
  return text.empty() ? "" : fmt::format("\n{}:\n{}", title, text);
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::istringstream words{std::string(text)};
  std::string result, word;
  std::size_t column = 0;
  while (words >> word) {
    if (column > 0 && column + 1 + word.size() > width) {
      result += fmt::format("\n{:{}}", "", indent);
      column = 0;
    }
    if (column > 0) {
      result += ' ';
      ++column;
    }
    result += word;
    column += word.size();
  }
  return result;
}

std::string help_text(const CLI::App& command) {
  std::string text = usage(command);
  text += fmt::format("\n{}\n", wrapped(as_sentence(command.get_description()), page_width, 0));

  text += rows(command, "Arguments", [](const CLI::Option* o) { return o->get_positional(); });
  const auto subcommands = command.get_subcommands([](const CLI::App*) { return true; });
  if (!subcommands.empty()) text += "\nCommands:\n";
  for (const auto* sub : subcommands) text += row(sub->get_name(), sub->get_description());
  for (const auto& group : command.get_groups()) {
    if (group.empty()) continue;  // hidden
    text += rows(command, group, [&](const CLI::Option* o) {
      return !o->get_positional() && o->get_group() == group;
    });
  }
  const std::string footer = command.get_footer();
  if (!footer.empty()) text += fmt::format("\n{}\n", footer);
  return text;
}

}  // namespace slambench
