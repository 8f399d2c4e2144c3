// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "report/report_page.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "all_parameters.h"
#include "analysis/result_folders.h"
#include "commands.h"
#include "io/files.h"
#include "report/report_entries.h"
#include "terminal.h"

namespace slambench {
namespace {

struct Arguments {
  std::vector<std::string> runs;
  std::string out = "report.html";
  std::string title;  ///< empty: not said
  bool force = false, each = false;
  ReportOptions options;
};

/// An earlier report is replaced, anything else only when the user says so.
void require_place(const Arguments& arguments) {
  if (!std::filesystem::exists(arguments.out)) return;
  if (std::filesystem::is_directory(arguments.out)) {
    throw UsageError(fmt::format("--out {}: found a folder, expected a file", arguments.out));
  }
  if (arguments.force || is_report_page(read_file(arguments.out))) return;
  throw UsageError(fmt::format("--out {}: found a file that is not a report; --force replaces it",
                               arguments.out));
}

void require_pictures(const Arguments& arguments, const std::vector<ReportRun>& runs) {
  for (const int frame : arguments.options.picture_frames) {
    bool there = false;
    for (const ReportRun& run : runs) {
      for (const Picture& picture : run.pictures) there = there || picture.frame == frame;
    }
    if (there) continue;
    throw UsageError(fmt::format(
        "--pictures {}: no run has pictures of that frame; slambench run --images N saves them",
        frame));
  }
}

ExitStatus make_report(const Arguments& arguments) {
  require_place(arguments);
  std::vector<ReportRun> runs;
  for (const std::string& folder : find_result_folders(arguments.runs)) {
    runs.push_back(read_report_run(folder));
  }
  const std::size_t count = runs.size();
  const ReportEntries entries =
      report_entries(std::move(runs), roles_of(AllParameters().lists()), !arguments.each);
  require_pictures(arguments, entries.runs);
  ReportOptions options = arguments.options;
  if (!entries.title.empty()) options.title = entries.title;
  if (!arguments.title.empty()) options.title = arguments.title;
  const std::string page = report_page(entries.runs, options);
  write_file(arguments.out, page);
  print(fmt::format("{}: {} run{}, {:.1f} MB\n", arguments.out, count, count == 1 ? "" : "s",
                    static_cast<double>(page.size()) / 1e6));
  return ExitStatus::ok;
}

}  // namespace

Action add_report(CLI::App& command) {
  auto arguments = std::make_shared<Arguments>();
  constexpr int most_runs = 100;
  command
      .add_option("RUN", arguments->runs,
                  "result folders of slambench run, or folders that hold some; one or more")
      ->required();
  command.add_option("-o,--out", arguments->out, "the HTML file (default report.html)")
      ->type_name("FILE");
  command.add_option("--title", arguments->title,
                     "what stands on top (default: that of the suite, else 'SLAMBench report')");
  command.add_flag("--each", arguments->each,
                   "show every run by itself, also those that only repeat others");
  command
      .add_option("--detail", arguments->options.detailed_runs,
                  "show so many runs frame by frame (default 8), of several sequences those of one")
      ->check(CLI::Range(0, most_runs))
      ->type_name("N");
  command
      .add_option("--pictures", arguments->options.picture_frames,
                  "frames whose pictures are shown, as 60,120 (default: up to 4 of each run)")
      ->delimiter(',')
      ->type_name("FRAMES");
  command.add_flag("--force", arguments->force,
                   "replace a file that is not a report of this program");
  return [arguments] { return make_report(*arguments); };
}

}  // namespace slambench
