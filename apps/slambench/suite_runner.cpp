// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "suite_runner.h"

#include <fmt/format.h>

#include <utility>

#include "analysis/figure.h"
#include "analysis/stored_run.h"
#include "child_process.h"

namespace slambench {
namespace {

/// The last thing it said, or how it ended. Its results were at `path` and are now at `kept`,
/// unless that is "".
std::string failure_text(const ChildOutcome& outcome, const std::string& path,
                         const std::string& kept) {
  constexpr int signals = 128;
  if (outcome.status > signals) return fmt::format("ended by signal {}", outcome.status - signals);
  std::string text = outcome.err;
  while (text.ends_with('\n')) text.pop_back();
  text = text.substr(text.rfind('\n') + 1);
  constexpr std::string_view prefix = "slambench: ";
  if (text.starts_with(prefix)) text = text.substr(prefix.size());
  const std::size_t named = kept.empty() ? std::string::npos : text.rfind(path);
  if (named != std::string::npos) text.replace(named, path.size(), kept);
  return fmt::format("status {}{}{}", outcome.status, text.empty() ? "" : ": ", text);
}

std::string run_name(const Configuration& configuration, const PlannedRun& run) {
  return run.repetition == 0 ? configuration.folder + ", warming up"
                             : fmt::format("{}/{}", configuration.folder, run.repetition);
}

}  // namespace

SuiteRunner::SuiteRunner(const std::string& program, std::string folder,
                         const std::vector<Configuration>& configurations,
                         std::vector<PlannedRun> runs, std::vector<int> frames,
                         SuiteResults results)
    : program_(program),
      folder_(std::move(folder)),
      configurations_(configurations),
      runs_(std::move(runs)),
      frames_(std::move(frames)),
      results_(std::move(results)) {
  for (const auto& [run, cost] : results_.done) times_.add(of(run), cost);
}

std::vector<std::string> SuiteRunner::arguments_of(const PlannedRun& run) const {
  auto words = run_arguments(of(run));
  words.push_back("--out=" + folder_of(run));
  return words;
}

void SuiteRunner::run_all(const InterruptFlag& interrupt, SuiteProgress* progress) {
  for (std::size_t i = 0; i < runs_.size() && !interrupt.raised().load(); ++i) {
    run_one(i, interrupt, progress);
  }
}

const Configuration& SuiteRunner::of(const PlannedRun& run) const {
  return configurations_[run.configuration];
}

/// Nothing when it is not known of one of them.
std::optional<double> SuiteRunner::expected_s(std::size_t from) const {
  double sum = 0;
  for (std::size_t i = from; i < runs_.size(); ++i) {
    const auto one = times_.expected_s(of(runs_[i]), frames_[runs_[i].configuration]);
    if (!one) return std::nullopt;
    sum += *one;
  }
  return sum;
}

void SuiteRunner::run_one(std::size_t i, const InterruptFlag& interrupt, SuiteProgress* progress) {
  const PlannedRun& run = runs_[i];
  const std::string path = folder_of(run);
  auto words = arguments_of(run);
  words.push_back("--quiet");
  progress->begin(i, run_name(of(run), run), expected_s(i));
  const ChildOutcome outcome = run_child(program_, words, [&] {
    progress->show();
    return !interrupt.raised().load();
  });
  if (outcome.status == 0) {
    const StoredRun stored = read_stored_run(path);
    const RunCost cost = cost_of(stored);
    times_.add(of(run), cost);
    progress->end(value_of("time.fps_computation", stored), expected_s(i + 1));
    if (run.repetition > 0) results_.done[run] = cost;
  } else {
    const std::string kept = discard_results(folder_, path);
    if (interrupt.raised().load()) return;
    const std::string reason = failure_text(outcome, path, kept);
    failures_.push_back(fmt::format("{} ({})", run_name(of(run), run), reason));
    progress->fail(reason);
  }
  if (outcome.status != 0 || run.repetition == 0) remove_suite_leftovers(folder_);
}

}  // namespace slambench
