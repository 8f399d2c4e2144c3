// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "all_parameters.h"
#include "analysis/result_folders.h"
#include "commands.h"
#include "exports/exports.h"
#include "io/files.h"
#include "terminal.h"

namespace slambench {
namespace {

constexpr const char* footer =
    "Examples:\n"
    "  slambench export results/* --format csv -o results.csv\n"
    "  slambench export results/mine --format trace -o trace.json\n"
    "  slambench export old-runs --format google-benchmark -o old.json\n"
    "  slambench export new-runs --format google-benchmark -o new.json\n"
    "  compare.py benchmarks old.json new.json\n";

struct ExportArguments {
  std::vector<std::string> runs;
  std::string format, out;
  bool force = false;
};

void require_place(const ExportArguments& arguments) {
  std::error_code error;
  const auto place = std::filesystem::status(arguments.out, error).type();
  if (place == std::filesystem::file_type::directory) {
    throw UsageError(fmt::format("--out {}: found a folder, expected a file", arguments.out));
  }
  // Nothing of a device or a pipe is lost.
  if (arguments.force || place != std::filesystem::file_type::regular) return;
  throw UsageError(fmt::format("--out {}: is there already; --force replaces it", arguments.out));
}

ExitStatus run(const ExportArguments& arguments) {
  require_place(arguments);
  const std::string text = find_export_format(arguments.format)
                               ->text(read_export_runs(find_result_folders(arguments.runs)),
                                      roles_of(AllParameters().lists()));
  if (arguments.out.empty()) {
    print(text);
  } else {
    write_file(arguments.out, text);
  }
  return ExitStatus::ok;
}

}  // namespace

Action add_export(CLI::App& command) {
  auto arguments = std::make_shared<ExportArguments>();
  command
      .add_option("RUN", arguments->runs,
                  "result folders of slambench run, or folders that hold some; one or more")
      ->required();
  std::vector<std::string> names;
  std::string sentences;
  for (const ExportFormat& format : export_table()) {
    names.emplace_back(format.name);
    sentences +=
        fmt::format("{}{}: {}", sentences.empty() ? "" : "; ", format.name, format.sentence);
  }
  command.add_option("--format", arguments->format, sentences)
      ->required()
      ->type_name("NAME")
      ->check(CLI::IsMember(names).description(""));
  command.add_option("-o,--out", arguments->out, "write to this file, not to the terminal")
      ->type_name("FILE");
  command.add_flag("--force", arguments->force, "replace the file when it is there");
  command.footer(footer);
  return [arguments] { return run(*arguments); };
}

}  // namespace slambench
