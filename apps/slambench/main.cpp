// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <map>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "commands.h"
#include "config/nearest.h"
#include "core/logged_error.h"
#include "core/shell_text.h"
#include "help.h"
#include "results/provenance.h"
#include "terminal.h"
#include "wait_policy.h"

namespace slambench {
namespace {

struct Command {
  const char* name;
  const char* sentence;
  std::function<Action(CLI::App&)> add;
};

std::vector<Command> command_table(const std::vector<std::string>& words) {
  return {
      {"run", "run KinectFusion over a sequence: times, accuracy, a record",
       [words](CLI::App& app) { return add_run(app, shell_text(words)); }},
      {"compare", "what differs between runs: ratios of all figures with intervals", add_compare},
      {"evaluate", "compare two trajectories: absolute trajectory and relative pose error",
       add_evaluate},
      {"export", "hand runs to other programs: CSV, Google Benchmark, traces for Perfetto",
       add_export},
      {"generate", "render a sequence, of the living room or an own mesh, to disk", add_generate},
      {"info", "what a sequence has: frames, camera, axes, ground truth, suggestions", add_info},
      {"list", "what there is: backends, maps, kernels, layouts, presets, parameters", add_list},
      {"report", "make one HTML file of runs: charts, paths, pictures, parameters", add_report},
      {"suite", "run a matrix of sequences, backends and parameters, in turns",
       [words](CLI::App& app) { return add_suite(app, words.front()); }},
      {"verify", "whether the backends compute what the reference computes", add_verify},
  };
}

constexpr const char* footer =
    "'slambench COMMAND --help' says more about each.\n"
    "Exit status: 0 ok, 1 failed or interrupted, 2 usage, 3 bad input,\n"
    "4 unavailable here, 5 a threshold was violated.";

/// The long options of the command, with their dashes.
std::vector<std::string> option_words(const CLI::App& command) {
  std::vector<std::string> words;
  for (const CLI::Option* option : command.get_options()) {
    for (const auto& word : option->get_lnames()) words.push_back("--" + word);
  }
  return words;
}

/// The first argument that nobody wanted is the user's mistake.
void reject_extras(const CLI::App& command) {
  const std::vector<std::string> extras = command.remaining();
  if (extras.empty()) return;
  std::string word = extras.front();
  for (const auto& extra : extras) {
    if (extra.starts_with("-")) {
      word = extra.substr(0, extra.find('='));
      break;
    }
  }
  const bool is_option = word.starts_with("-");
  const auto known = option_words(command);
  throw UsageError(fmt::format(
      "{} '{}'{}", is_option ? "unknown option" : "unexpected argument", word,
      is_option ? suggestion(word, std::vector<std::string_view>(known.begin(), known.end()))
                : ""));
}

void require_command(const CLI::App& app, const std::vector<Command>& commands) {
  if (!app.get_subcommands().empty()) return;
  const auto extras = app.remaining();
  if (extras.empty()) throw UsageError("no command; 'slambench --help' lists them");
  if (extras.front().starts_with("-")) reject_extras(app);
  std::vector<std::string_view> known;
  known.reserve(commands.size());
  for (const Command& command : commands) known.emplace_back(command.name);
  throw UsageError(
      fmt::format("unknown command '{}'{}", extras.front(), suggestion(extras.front(), known)));
}

ExitStatus run(int argc, char** argv) {
  CLI::App app{"A benchmark of dense visual SLAM: how fast and how accurate it is", "slambench"};
  app.formatter_fn([](const CLI::App* command, const std::string&, CLI::AppFormatMode) {
    return help_text(*command);
  });
  app.set_help_flag("-h,--help", "print this and end");
  app.footer(footer);
  app.allow_extras();
  app.set_version_flag("--version", version_text(), "print version and commit and end");
  const std::vector<Command> commands = command_table(std::vector<std::string>(argv, argv + argc));
  std::map<const CLI::App*, Action> actions;
  for (const Command& command : commands) {
    CLI::App* sub = app.add_subcommand(command.name, command.sentence);
    sub->allow_extras();
    sub->footer("");
    actions[sub] = command.add(*sub);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    print(app.help());
    return ExitStatus::ok;
  } catch (const CLI::CallForVersion&) {
    print(version_text() + "\n");
    return ExitStatus::ok;
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  require_command(app, commands);
  const CLI::App* chosen = app.get_subcommands().front();
  reject_extras(*chosen);
  return actions.at(chosen)();
}

/// Names from files and arguments may hold line ends and escapes: a message stays one line.
std::string one_line(std::string text) {
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = '?';
  }
  return text;
}

int report(ExitStatus status, const std::string& message) {
  print_error(fmt::format("slambench: {}\n", one_line(message)));
  return static_cast<int>(status);
}

/// The log comes below the message, indented.
int report(const LoggedError& error) {
  report(error.status(), error.message() + ":");
  std::istringstream log(error.log());
  for (std::string line; std::getline(log, line);) {
    std::replace(line.begin(), line.end(), '\t', ' ');
    print_error(fmt::format("  {}\n", one_line(line)));
  }
  return static_cast<int>(error.status());
}

}  // namespace
}  // namespace slambench

int main(int argc, char** argv) {
  using slambench::ExitStatus;
  slambench::let_threads_sleep(argv);
  try {
    slambench::prepare_standard_streams();
    return static_cast<int>(slambench::run(argc, argv));
  } catch (const slambench::LoggedError& error) {
    return slambench::report(error);
  } catch (const slambench::Error& error) {
    return slambench::report(error.status(), error.what());
  } catch (const std::bad_alloc&) {
    return slambench::report(ExitStatus::unavailable, "not enough memory");
  } catch (const std::exception& error) {
    return slambench::report(ExitStatus::failed, fmt::format("internal error: {}", error.what()));
  }
}
