// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "all_parameters.h"
#include "analysis/comparison.h"
#include "commands.h"
#include "io/files.h"
#include "io/text.h"
#include "limit_options.h"
#include "terminal.h"

namespace slambench {
namespace {

constexpr const char* footer =
    "Each of BASE and OTHER is a result folder, a record.json, a folder of result\n"
    "folders, or several of these joined by commas: all its runs are repeats of one\n"
    "configuration. Repeats show how much runs differ by themselves; a single run\n"
    "cannot. They tell most when the runs of both took turns, six or more of each:\n"
    "\n"
    "  for i in $(seq 10); do\n"
    "    old/slambench run -c 4 -v 128 --out old-runs/$i\n"
    "    new/slambench run -c 4 -v 128 --out new-runs/$i\n"
    "  done\n"
    "  slambench compare old-runs new-runs\n"
    "\n"
    "More examples:\n"
    "  slambench compare results/serial results/openmp results/opencl\n"
    "  slambench compare old-runs new-runs --figure kernel_raycast_s\n"
    "  slambench compare old-runs new-runs --fail-if 'ratio(computation_s)>1.05'\n"
    "  slambench compare coarse fine --allow volume-resolution --format markdown\n"
    "\n"
    "Exit status: 3 when the runs did not compute the same, 5 when a --fail-if holds.";

/// A number between these; CLI11's own check takes NaN for one.
CLI::Validator in_range(double least, double most) {
  return {[=](const std::string& text) {
            const auto value = parse_finite(text);
            if (value && *value >= least && *value <= most) return std::string();
            return fmt::format("found '{}', expected a number from {} to {}", text, least, most);
          },
          ""};
}

struct CompareArguments {
  std::string base, format = "text", output;
  std::vector<std::string> others, allowed;
  bool allow_different = false;
  ComparisonOptions options;
  std::vector<std::string> limits;
};

std::string document(const std::vector<Comparison>& comparisons, const std::string& format) {
  if (format == "markdown") return comparison_markdown(comparisons);
  if (format == "csv") return comparison_csv(comparisons);
  if (format == "json") return comparison_json(comparisons);
  return comparison_text(comparisons);
}

ExitStatus run(const CompareArguments& arguments) {
  const std::vector<Limit> limits = parse_limits(arguments.limits, true);
  const ParameterRoles& roles = arguments.options.roles;
  const RunGroup base = read_run_group(arguments.base, roles);
  std::vector<RunGroup> others;
  others.reserve(arguments.others.size());
  for (const std::string& other : arguments.others) {
    others.push_back(read_run_group(other, roles));
    if (!arguments.allow_different)
      require_same_task(base, others.back(), arguments.allowed, roles);
  }
  std::vector<Comparison> comparisons;
  for (const RunGroup& other : others) {
    comparisons.push_back(compare(base, other, arguments.options));
  }
  const std::string text = document(comparisons, arguments.format);
  if (arguments.output.empty()) {
    print(text);
  } else {
    write_file(arguments.output, text);
  }
  std::vector<std::string> violated;
  for (std::size_t i = 0; i < others.size(); ++i) {
    const auto lines = violations(limits, others[i], comparisons[i]);
    violated.insert(violated.end(), lines.begin(), lines.end());
  }
  throw_if_violated(violated);
  return ExitStatus::ok;
}

}  // namespace

Action add_compare(CLI::App& command) {
  auto arguments = std::make_shared<CompareArguments>();
  arguments->options.roles = roles_of(AllParameters().lists());
  command.add_option("BASE", arguments->base, "what the others are compared with")->required();
  command.add_option("OTHER", arguments->others, "what is compared")->required();
  command
      .add_option("--figure", arguments->options.figures,
                  "compare only this one; may be given several times. The fewer, the narrower "
                  "the intervals")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command
      .add_option("--confidence", arguments->options.confidence,
                  "with which all intervals together hold (default 0.95)")
      ->type_name("X")
      ->check(in_range(0.5, 0.9999));
  command
      .add_option("--tolerance", arguments->options.tolerance,
                  "accuracy that differs by no more than this part is the same, instead of 0.03 "
                  "or what docs/compare.md says of small ones; 0: only equal is the same")
      ->type_name("X")
      ->check(in_range(0, 1));
  command
      .add_option("--allow", arguments->allowed,
                  "compare although this differs: a parameter's name, or a place in record.json "
                  "such as sequence.input_hash; may be given several times")
      ->type_name("KEY")
      ->allow_extra_args(false);
  command.add_flag("--allow-different", arguments->allow_different,
                   "compare whatever sequences and parameters differ");
  command.add_option("--format", arguments->format, "text, markdown, csv or json (default text)")
      ->type_name("NAME")
      ->check(CLI::IsMember({"text", "markdown", "csv", "json"}).description(""));
  command.add_option("-o,--output", arguments->output, "write to this file, not to the terminal")
      ->type_name("FILE");
  add_limit_option(command, &arguments->limits, true);
  command.footer(footer);
  return [arguments] { return run(*arguments); };
}

}  // namespace slambench
