// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/core.h>

#include <cstdio>
#include <exception>
#include <map>

#include "commands.h"

namespace slambench {
namespace {

struct Command {
  const char* name;
  const char* sentence;
  Action (*add)(CLI::App&);
};

constexpr Command commands[] = {
    {"evaluate", "compare two trajectories: absolute trajectory and relative pose error",
     add_evaluate},
};

ExitStatus run(int argc, char** argv) {
  CLI::App app{"SLAMBench: a benchmark of dense visual SLAM", "slambench"};
  app.require_subcommand(1);
  std::map<const CLI::App*, Action> actions;
  for (const Command& command : commands) {
    CLI::App* sub = app.add_subcommand(command.name, command.sentence);
    actions[sub] = command.add(*sub);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? ExitStatus::ok : ExitStatus::usage;
  }
  return actions.at(app.get_subcommands().front())();
}

}  // namespace
}  // namespace slambench

int main(int argc, char** argv) {
  using slambench::ExitStatus;
  try {
    return static_cast<int>(slambench::run(argc, argv));
  } catch (const slambench::Error& error) {
    fmt::print(stderr, "slambench: {}\n", error.what());
    return static_cast<int>(error.status());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "slambench: not enough memory\n");
    return static_cast<int>(ExitStatus::unavailable);
  } catch (const std::exception& error) {
    fmt::print(stderr, "slambench: internal error: {}\n", error.what());
    return static_cast<int>(ExitStatus::failed);
  }
}
