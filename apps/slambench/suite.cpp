// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "all_parameters.h"
#include "child_process.h"
#include "commands.h"
#include "config/presets.h"
#include "core/shell_text.h"
#include "interrupt.h"
#include "io/files.h"
#include "meters/clock.h"
#include "open_sequence.h"
#include "parameter_options.h"
#include "results/page.h"
#include "results/provenance.h"
#include "runner/input_hash.h"
#include "suite/suite_folder.h"
#include "suite/suite_plan.h"
#include "suite/suite_summary.h"
#include "suite_progress.h"
#include "suite_runner.h"
#include "terminal.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

constexpr const char* footer =
    "FILE is TOML; docs/suite.md describes it:\n"
    "\n"
    "  sequence = [\"living-room/0\", \"living-room/2\"]\n"
    "  [matrix]                          # every combination of\n"
    "  backend = [\"serial\", \"openmp\"]\n"
    "  volume-resolution = [128, 256]\n"
    "  [run]                             # in all runs\n"
    "  repeat = 3\n"
    "\n"
    "Runs take turns, each in a process of its own. The same command goes on where an\n"
    "earlier one was stopped or killed: finished runs stay, failed ones are tried\n"
    "again. Parameters on the command line are stronger than the file; of the lists\n"
    "of a matrix they select: --backend serial leaves one backend of many.\n"
    "\n"
    "Examples:\n"
    "  slambench suite configs/paper.toml --dry-run\n"
    "  slambench suite configs/paper.toml --frames 50 --repeat 1 --out results/try\n"
    "  slambench report results/paper -o report.html\n"
    "\n"
    "Exit status: 1 when a run failed or the suite was interrupted, 4 when nothing\n"
    "can run here or, with --require-all, something cannot.";

struct SuiteArguments {
  std::string program, file, out, preset;
  bool dry_run = false, require_all = false, set_aside = false, quiet = false;
  AllParameters parameters;
  ParameterOptions options;
};

/// What the file asks for, and what of it is left out today.
struct SuitePlan {
  std::string title;
  std::vector<Configuration> configurations;
  std::vector<std::string> not_selected;  ///< by the command line
  std::vector<std::string> unavailable;   ///< here

  std::vector<std::string> left_out() const {
    std::vector<std::string> sentences = not_selected;
    sentences.insert(sentences.end(), unavailable.begin(), unavailable.end());
    return sentences;
  }
  long running() const { return std::ranges::count_if(configurations, &Configuration::runs_today); }
};

std::optional<std::string> environment(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

bool can_be_opened(const std::string& sequence) {
  return std::ranges::any_of(source_table(), [&](const SourceEntry& entry) {
    return entry.unavailable.empty() && entry.matches(sequence);
  });
}

SuiteSettings overrides(const SuiteArguments& arguments, const std::vector<ParameterList>& lists) {
  SuiteSettings settings{arguments.preset, arguments.options.given()};
  if (!settings.preset.empty()) find_preset(settings.preset);  // throws when there is none
  for (const auto& [name, value] : settings.assignments) canonical_text(*find(lists, name), value);
  return settings;
}

/// Backends that cannot be used here and why. Asked of a process of its own, as drivers stay
/// loaded once they were.
std::map<std::string, std::string> unavailable_backends(const std::string& program) {
  const ChildOutcome list = run_child(program, {"list", "--json"}, [] { return true; });
  const auto json = nlohmann::json::parse(list.out, nullptr, false);
  if (list.status != 0 || !json.is_object()) {
    throw Error(ExitStatus::failed, "slambench list --json failed: " + list.err);
  }
  std::map<std::string, std::string> unavailable;
  for (const auto& backend : json.at("backends")) {
    if (!backend.at("available").get<bool>()) {
      unavailable[backend.at("name")] = backend.at("reason");
    }
  }
  return unavailable;
}

void leave_out_backends(const std::string& program, SuitePlan* plan) {
  const bool asks = std::ranges::any_of(plan->configurations, [](const Configuration& c) {
    return c.runs_today() && c.value("backend").has_value();
  });
  if (!asks) return;
  std::vector<std::string> found;
  const auto unavailable = unavailable_backends(program);
  for (Configuration& configuration : plan->configurations) {
    const auto it = unavailable.find(configuration.value("backend").value_or(""));
    if (it == unavailable.end() || !configuration.runs_today()) continue;
    configuration.available = false;
    const std::string sentence = fmt::format("backend {}: {}", it->first, it->second);
    if (std::ranges::find(found, sentence) == found.end()) found.push_back(sentence);
  }
  plan->unavailable.insert(plan->unavailable.end(), found.begin(), found.end());
}

SuitePlan make_plan(const SuiteArguments& arguments, const std::vector<ParameterList>& lists) {
  SuiteFile file = read_suite_file(arguments.file, lists);
  const SuiteSettings over = overrides(arguments, lists);
  SuitePlan plan;
  plan.title = file.title.empty() ? fs::path(file.path).stem().string() : file.title;
  plan.unavailable = resolve_sequences(&file, environment, can_be_opened);
  plan.configurations = configurations(file, over, lists);
  plan.not_selected = lists_without_selection(file, over, lists);
  if (std::ranges::none_of(plan.configurations, &Configuration::selected)) {
    throw UsageError(fmt::format("{}: the command line leaves nothing to run: {}", arguments.file,
                                 fmt::join(plan.not_selected, "; ")));
  }
  leave_out_backends(arguments.program, &plan);
  if (plan.running() == 0 || (arguments.require_all && !plan.unavailable.empty())) {
    throw UnavailableError(
        fmt::format("{}: cannot run here: {}", arguments.file, fmt::join(plan.unavailable, "; ")));
  }
  return plan;
}

/// Opens the sequence of every run, so that what is wrong with one is told now, and has it rendered
/// unless it is to be looked at only. Returns the frames that each configuration runs over, 0 where
/// it has no run.
std::vector<int> prepare_sequences(const std::vector<Configuration>& configurations,
                                   const std::vector<PlannedRun>& runs, bool render, bool show,
                                   const InterruptFlag& interrupt) {
  std::set<std::size_t> used;
  for (const PlannedRun& run : runs) used.insert(run.configuration);
  std::map<std::vector<std::string>, int> known;
  std::vector<int> frames(configurations.size(), 0);
  for (const std::size_t i : used) {
    const Configuration& configuration = configurations[i];
    AllParameters p;
    const auto lists = p.lists();
    const std::vector<std::string> input = input_of(configuration, lists);
    auto it = known.find(input);
    if (it == known.end()) {
      Settings settings(lists);
      if (!configuration.preset.empty()) settings.apply(find_preset(configuration.preset));
      for (const auto& [name, value] : configuration.assignments) {
        settings.set(name, value, Origin::command_line, "command line");
      }
      const auto source = open_sequence(configuration.sequence, p.source, &settings);
      const int count = frames_to_run(source->info(), p.run);
      if (render) prepare_sequence(*source, count, show, interrupt);
      it = known.emplace(input, count).first;
    }
    frames[i] = it->second;
  }
  return frames;
}

/// A suite that was killed leaves a run behind that ends a moment later.
void take_lock(const std::string& folder, SuiteLock* lock) {
  constexpr int tries = 100, wait_ms = 20;
  for (int i = 0; i < tries; ++i) {
    if (lock->take(folder)) return;
    ::poll(nullptr, 0, wait_ms);
  }
  throw UsageError(folder + ": another suite is working in this folder");
}

std::string first_few(const std::vector<std::string>& texts) {
  constexpr std::size_t most = 3;
  const auto end = texts.begin() + static_cast<std::ptrdiff_t>(std::min(most, texts.size()));
  const std::string text = fmt::format("{}", fmt::join(texts.begin(), end, "; "));
  return texts.size() <= most ? text : fmt::format("{}; and {} more", text, texts.size() - most);
}

std::string misfits_text(const std::vector<Misfit>& misfits) {
  std::vector<std::string> texts;
  texts.reserve(misfits.size());
  for (const Misfit& misfit : misfits) {
    texts.push_back(fmt::format("{} {}", misfit.path, misfit.reason));
  }
  return first_few(texts);
}

/// Throws when there are results that another suite, build or machine made.
void require_own(const std::string& folder, const std::vector<Misfit>& foreign) {
  if (foreign.empty()) return;
  throw UsageError(fmt::format(
      "{}: holds results that do not belong to the suite: {}; choose another --out, or say "
      "--set-aside to move them to {}/.set-aside",
      folder, misfits_text(foreign), folder));
}

/// Leaves nothing in the folder but what counts.
void take_over(const std::string& folder, const SuitePlan& plan, const SuiteBuild& build,
               const SuiteResults& results) {
  for (const Misfit& misfit : results.foreign) put_away(folder, "set-aside", misfit.path);
  for (const Misfit& misfit : results.half) discard_results(folder, misfit.path);
  remove_suite_leftovers(folder);
  write_suite(folder, plan.title, plan.configurations, build);
}

/// What to do next with the results of configurations that have some.
void suggest(const std::vector<Configuration>& configurations, const std::string& folder,
             const std::vector<ParameterList>& lists, Page* page) {
  if (configurations.empty()) return;
  if (const auto pair = comparable_pair(configurations, lists)) {
    page->wrapped("compare",
                  shell_text({"slambench", "compare", fs::path(folder) / pair->first.folder,
                              fs::path(folder) / pair->second.folder}));
  }
  page->wrapped("report", shell_text({"slambench", "report", folder, "-o", "report.html"}));
}

/// Throws when something is wrong with the results.
void report(const SuitePlan& plan, const SuiteRunner& runner, const std::string& folder,
            const std::vector<ParameterList>& lists, bool quiet) {
  std::vector<Configuration> with_results;  // what is left out too
  std::vector<ConfigurationResult> results;
  std::vector<std::string> problems;
  for (std::size_t i = 0; i < plan.configurations.size(); ++i) {
    const auto count = std::ranges::count_if(
        runner.done(), [&](const auto& done) { return done.first.configuration == i; });
    if (count == 0 && !plan.configurations[i].runs_today()) continue;
    if (count > 0) with_results.push_back(plan.configurations[i]);
    results.push_back(
        result_of(folder, plan.configurations[i], static_cast<std::size_t>(count), lists));
    if (!results.back().problem.empty()) problems.push_back(results.back().problem);
  }
  if (!quiet) {
    Page page(output_takes_colors());
    page.gap();
    for (const std::string& sentence : plan.left_out()) page.wrapped("left out", sentence);
    page.wrapped("results", folder);
    suggest(with_results, folder, lists, &page);
    print("\n" + suite_table(results, output_takes_colors()) + std::move(page).text());
  }
  if (!problems.empty()) {
    throw Error(ExitStatus::failed, fmt::format("{}", fmt::join(problems, "; ")));
  }
  if (!runner.failures().empty()) {
    throw Error(
        ExitStatus::failed,
        fmt::format("{} of {} runs failed: {}; the same command tries them again",
                    runner.failures().size(), runner.runs().size(), first_few(runner.failures())));
  }
}

/// A shell script: what is done or cannot be done is a comment.
std::string listing(const SuitePlan& plan, const SuiteRunner& runner, const std::string& program) {
  std::string text = fmt::format("# {}: {} configurations, {} runs to do, {} done\n", plan.title,
                                 plan.running(), runner.runs().size(), runner.done().size());
  for (const std::string& sentence : plan.left_out()) {
    text += fmt::format("# left out: {}\n", sentence);
  }
  for (const PlannedRun& run : runner.runs()) {
    auto words = runner.arguments_of(run);
    words.insert(words.begin(), program);
    text += shell_text(words) + "\n";
    if (run.repetition == 0) text += shell_text({"rm", "-r", runner.folder_of(run)}) + "\n";
  }
  return text;
}

std::string folder_of(const SuiteArguments& arguments) {
  fs::path folder = arguments.out.empty() ? fs::path("results") / fs::path(arguments.file).stem()
                                          : fs::path(arguments.out).lexically_normal();
  return (folder.has_filename() ? folder : folder.parent_path()).string();
}

ExitStatus run(SuiteArguments& arguments) {
  const std::vector<ParameterList> lists = arguments.parameters.lists();
  SuitePlan plan = make_plan(arguments, lists);
  const std::string folder = folder_of(arguments);
  const SuiteBuild build{
      build_and_machine(std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now())),
      hash_text(read_file("/proc/self/exe"))};
  keep_folders(folder, &plan.configurations);
  SuiteLock lock;
  if (!arguments.dry_run) {
    take_lock(folder, &lock);
    keep_folders(folder, &plan.configurations);  // now that nobody else changes it
  }
  SuiteResults results = find_results(folder, plan.configurations, build, lists);
  if (!arguments.set_aside) require_own(folder, results.foreign);
  const InterruptFlag interrupt;
  auto runs = runs_in_turns(plan.configurations,
                            [&](const PlannedRun& r) { return results.done.contains(r); });
  auto frames =
      prepare_sequences(plan.configurations, runs, !arguments.dry_run, !arguments.quiet, interrupt);
  if (!arguments.dry_run) take_over(folder, plan, build, results);
  SuiteRunner runner(arguments.program, folder, plan.configurations, std::move(runs),
                     std::move(frames), std::move(results));
  if (arguments.dry_run) {
    print(listing(plan, runner, arguments.program));
    return ExitStatus::ok;
  }
  const std::size_t before = runner.done().size();
  if (!arguments.quiet) {
    print(fmt::format("{}: {} configurations, {} runs to do, {} done before\n", plan.title,
                      plan.running(), runner.runs().size(), before));
  }
  SuiteProgress progress(runner.runs().size(), steady_clock(), !arguments.quiet);
  runner.run_all(interrupt, &progress);
  if (interrupt.raised().load()) {
    throw Error(ExitStatus::failed,
                fmt::format("interrupted; {} runs are done; the same command goes on from there",
                            runner.done().size()));
  }
  report(plan, runner, folder, lists, arguments.quiet);
  return ExitStatus::ok;
}

}  // namespace

Action add_suite(CLI::App& command, const std::string& program) {
  auto arguments = std::make_shared<SuiteArguments>();
  arguments->program = program;
  command.add_option("FILE", arguments->file, "what is to be run: a TOML file, see below")
      ->required();
  command
      .add_option("--out", arguments->out,
                  "folder of the results, also of earlier ones (default results/NAME for "
                  "NAME.toml)")
      ->type_name("DIR");
  command.add_flag("--dry-run", arguments->dry_run,
                   "print the runs that are to be done, as commands, and end");
  command.add_flag("--require-all", arguments->require_all,
                   "end with status 4 when a backend or an optional sequence is not there; "
                   "otherwise it is left out with a word");
  command.add_flag("--set-aside", arguments->set_aside,
                   "move results in DIR that the suite no longer has, or that another build or "
                   "machine made, to DIR/.set-aside; otherwise they are refused");
  command.add_flag("--quiet", arguments->quiet, "print errors only");
  command.add_option("--preset", arguments->preset, "in all runs, instead of those of the file")
      ->type_name("NAME");
  auto lists = arguments->parameters.lists();
  std::erase_if(lists, [](const ParameterList& list) { return list.group == "output"; });
  arguments->options.add(command, lists);
  command.footer(footer);
  return [arguments] { return run(*arguments); };
}

}  // namespace slambench
