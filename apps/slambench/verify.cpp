// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "config/settings.h"
#include "datasets/source.h"
#include "meters/clock.h"
#include "open_sequence.h"
#include "parameter_options.h"
#include "progress.h"
#include "terminal.h"
#include "verify/agreement.h"
#include "verify/report.h"

namespace slambench {
namespace {

constexpr std::size_t page_width = 80;

struct VerifyArguments {
  std::optional<std::string> backend, map, kernel, device, sequence;
  int threads = 0, frames = 12;
  std::uint64_t seed = 1;
  bool fail_fast = false, json = false, markdown = false;
};

/// The first frames of a sequence, with the settings that suit it.
Recording read_recording(const std::string& sequence, int frames) {
  SourceParameters of_source;
  KinectFusionParameters parameters;
  Settings settings({of_source.describe(), parameters.describe()});
  const auto source = open_sequence(sequence, of_source, &settings);
  const SequenceInfo& info = source->info();
  std::vector<Frame> read;
  for (int i = 0; i < std::min(frames, info.frame_count); ++i) {
    read.emplace_back();
    source->read(i, read.back());
  }
  return tracked_recording(info.name, std::move(read), info.camera, info.units_per_m, parameters);
}

AgreementSelection selection(const VerifyArguments& arguments) {
  AgreementSelection selection;
  selection.backend = arguments.backend;
  selection.check = arguments.kernel;
  if (arguments.map) selection.map = map_from_name(*arguments.map);
  selection.options.threads = arguments.threads;
  if (arguments.device) selection.options.device = *arguments.device;
  return selection;
}

/// How many lines of the report there will be, for the progress bar.
int expected_results(const AgreementSelection& selection) {
  std::size_t backends = 0;
  for (const BackendEntry& entry : backend_table()) {
    const bool wanted = !selection.backend || *selection.backend == entry.name;
    if (wanted && entry.availability().available) ++backends;
  }
  return static_cast<int>(backends * (selection.map ? 1 : map_table().size()) *
                          (selection.check ? 1 : check_table().size()));
}

ExitStatus run(const VerifyArguments& arguments) {
  if (arguments.json && arguments.markdown) {
    throw UsageError("--json and --markdown: choose one");
  }
  AgreementOptions options;
  options.seed = arguments.seed;
  options.fail_fast = arguments.fail_fast;
  if (arguments.sequence) {
    options.recordings.push_back(read_recording(*arguments.sequence, arguments.frames));
  }
  const AgreementSelection selected = selection(arguments);
  AgreementReport report;
  {
    ProgressBar bar("verifying", "checks", steady_clock(), true);
    int done = 0;
    const int total = expected_results(selected);
    report = verify(selected, options,
                    [&](const Agreement& result) { bar.show(++done, total, result.check); });
  }
  if (arguments.json) {
    print(to_json(report));
  } else {
    print(arguments.markdown ? to_markdown(report) : to_text(report, page_width));
  }
  return report.agrees() ? ExitStatus::ok : ExitStatus::threshold;
}

}  // namespace

Action add_verify(CLI::App& command) {
  auto arguments = std::make_shared<VerifyArguments>();
  command.add_option("--backend", arguments->backend, "this one instead of all");
  command.add_option("--map", arguments->map, "this one instead of all");
  command.add_option("--kernel", arguments->kernel,
                     "this one instead of all; also 'memory' and 'pipeline'");
  command.add_option("--device", arguments->device,
                     "index or part of the name of the device it runs on");
  command
      .add_option("--threads", arguments->threads,
                  "threads of a host backend; 0: one per core; held against runs with 3")
      ->check(CLI::Range(0, 4096));
  command.add_option("--seed", arguments->seed, "of the made-up inputs (default 1)")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--sequence", arguments->sequence,
                     "real frames in addition: a path or a built-in name");
  command.add_option("--frames", arguments->frames, "how many of them (default 12)")
      ->check(CLI::Range(1, 100000))
      ->needs("--sequence");
  command.add_flag("--fail-fast", arguments->fail_fast, "end each check with its first failure");
  command.add_flag("--json", arguments->json, "as one JSON object, with numbers");
  command.add_flag("--markdown", arguments->markdown, "as docs/agreement.md");
  return [arguments] { return run(*arguments); };
}

}  // namespace slambench
