// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "all_parameters.h"
#include "commands.h"
#include "config/config_file.h"
#include "config/presets.h"
#include "config/settings.h"
#include "help.h"
#include "interrupt.h"
#include "io/files.h"
#include "meters/clock.h"
#include "parameter_options.h"
#include "progress.h"
#include "results/provenance.h"
#include "results/repetition.h"
#include "results/result_folder.h"
#include "results/summary.h"
#include "results/writers.h"
#include "runner/runner.h"
#include "terminal.h"

namespace slambench {
namespace {

constexpr const char* default_sequence = "living-room/2";

constexpr const char* footer =
    "Examples:\n"
    "  slambench run\n"
    "  slambench run rgbd_dataset_freiburg1_xyz -c 2 -s 6 -p 0.5,0.5,0.35\n"
    "  slambench run recording.raw --preset slambench1 --out results/mine\n"
    "\n"
    "The command line is stronger than the configuration file, the file than the\n"
    "preset, the preset than what suits the sequence, that than the default.\n"
    "An interrupted run (Ctrl-C) keeps the results so far, marked incomplete.";

/// What was said on the command line.
struct RunArguments {
  std::string command_line;
  CLI::Option* sequence_option = nullptr;
  std::string sequence, input_file, preset, config;
  AllParameters parameters;
  ParameterOptions options;
};

/// What was decided from it.
struct RunPlan {
  std::string sequence;
  UsedParameter preset;
  Settings settings;
};

RunPlan make_plan(RunArguments& arguments) {
  if (!arguments.sequence.empty() && !arguments.input_file.empty()) {
    throw UsageError("--input-file: the sequence is already given as SEQUENCE");
  }
  if (arguments.sequence_option->count() > 0 && arguments.sequence.empty()) {
    throw UsageError("SEQUENCE: found '', expected a folder, a file or a built-in sequence");
  }
  RunPlan plan{arguments.sequence + arguments.input_file,
               {"run", "preset", "", arguments.preset, "command line"},
               Settings(arguments.parameters.lists())};
  std::optional<ConfigFile> file;
  if (!arguments.config.empty()) file = read_config_file(arguments.config, plan.settings.lists());
  if (plan.preset.value.empty()) {
    plan.preset.set_by = file && file->preset ? fmt::format("file {}", file->path) : "default";
    plan.preset.value = file && file->preset ? *file->preset : std::string(default_preset);
  }
  plan.settings.apply(find_preset(plan.preset.value));
  if (file) plan.settings.apply(*file);
  arguments.options.apply(plan.settings);

  if (plan.sequence.empty() && file && file->sequence) plan.sequence = *file->sequence;
  if (plan.sequence.empty()) plan.sequence = default_sequence;
  return plan;
}

/// Fails now rather than after the run.
void require_writable(const std::string& option, const std::string& file) {
  if (file.empty()) return;
  const std::filesystem::path path(file);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw UsageError(fmt::format("--{}: {} is a folder, expected a file", option, file));
  }
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  if (::access((folder / "").c_str(), W_OK) != 0) {
    throw Error(ExitStatus::failed,
                fmt::format("--{}: {}: cannot write: {}", option, file, std::strerror(errno)));
  }
}

/// The folder that was asked for, or a new one: another run of the same second has another name.
std::unique_ptr<ResultFolder> open_results(const OutputParameters& output,
                                           const std::string& fresh_name) {
  if (!output.out.empty()) return std::make_unique<ResultFolder>(output.out, output.force);
  constexpr int most = 100;
  for (int i = 1; i < most; ++i) {
    const std::string name = i == 1 ? fresh_name : fmt::format("{}-{}", fresh_name, i);
    try {
      return std::make_unique<ResultFolder>(name, false);
    } catch (const UsageError&) {
      continue;  // taken
    }
  }
  return std::make_unique<ResultFolder>(fresh_name, false);
}

std::string remark(const Progress& progress) {
  if (progress.frame == nullptr || !progress.frame->error_first_pose_m) return "";
  return fmt::format("error {:.1f} mm", *progress.frame->error_first_pose_m * 1e3);
}

void save_images(const FrameRecord& frame, System& system, int every, ResultFolder& folder) {
  if (every == 0 || frame.index % every != 0) return;
  const Pictures pictures = system.pictures();
  const auto write = [&](std::string_view name, const Image<Rgba8>& picture) {
    if (!picture.empty()) folder.write_image(frame.index, name, picture);
  };
  write("depth", pictures.depth);
  write("track", pictures.track);
  // Drawn at the rendering rate only: an older one does not belong to this frame.
  if (frame.times.kernel_calls[static_cast<std::size_t>(Kernel::render_volume)] > 0) {
    write("volume", pictures.volume);
  }
}

/// Renders what is to be rendered.
void prepare(Source& source, int frames, bool show, const InterruptFlag& interrupt) {
  ProgressBar bar("rendering", "frames", steady_clock(), show);
  source.prepare(frames, [&](int done, int total) {
    bar.show(done, total);
    return !interrupt.raised().load();
  });
}

Provenance provenance(const RunArguments& arguments, const Backend& backend,
                      std::chrono::sys_seconds started_at) {
  Provenance provenance = build_and_machine(started_at);
  provenance.backend = backend.name();
  provenance.device = backend.device();
  provenance.driver = backend.driver();
  provenance.threads = backend.threads();
  provenance.command = arguments.command_line;
  return provenance;
}

void write_outputs(const Record& record, System& system, const OutputParameters& output,
                   ResultFolder& folder) {
  folder.commit(record);
  if (!output.log_file.empty()) write_file(output.log_file, slambench1_log(record));
  if (!output.dump_volume.empty()) system.dump_volume(output.dump_volume);
}

/// What the reader of the sequence had to assume, in the columns of the summary.
std::string notes_text(const SequenceInfo& info) {
  constexpr std::size_t label_width = 12, page_width = 80;
  std::string text;
  for (const std::string& note : info.notes) {
    text += fmt::format("{:{}}{}\n", "note", label_width,
                        wrapped(note, page_width - label_width, label_width));
  }
  return text;
}

ExitStatus report(const Record& record, const SequenceInfo& info, const std::string& folder,
                  const OutputParameters& output) {
  if (output.json) {
    print(record_json(record));
  } else if (!output.quiet) {
    print(summary_text(record, folder, output_takes_colors()) + notes_text(info));
  }
  if (!record.complete) {
    throw Error(ExitStatus::failed,
                fmt::format("{}; the results so far are in {}", record.incomplete_reason, folder));
  }
  if (!record.valid) {
    throw Error(ExitStatus::failed, fmt::format("the result is not valid: {}; see {}",
                                                fmt::join(record.invalid_reasons, "; "), folder));
  }
  return ExitStatus::ok;
}

ExitStatus run(RunArguments& arguments) {
  const auto started_at =
      std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  RunPlan plan = make_plan(arguments);
  AllParameters& p = arguments.parameters;
  require_writable("log-file", p.output.log_file);
  require_writable("dump-volume", p.output.dump_volume);

  const InterruptFlag interrupt;
  const auto source = open_source(plan.sequence, p.source);
  const SequenceInfo& info = source->info();
  plan.settings.suggest(info.suggested);
  const auto backend = create_backend(p.backend.backend, p.backend);
  const auto folder =
      open_results(p.output, default_result_folder(started_at, info.name, backend->name()));
  const bool show = !p.output.quiet && !p.output.json;
  prepare(*source, frames_to_run(info, p.run), show, interrupt);
  if (!p.source.ground_truth.empty()) check_ground_truth(*source, p.run);

  FrameTimer timer(steady_clock());
  backend->observe(&timer);
  KinectFusion system(*backend, p.kinectfusion, info.depth_size, info.camera, info.units_per_m,
                      &timer);
  Record record;
  record.provenance = provenance(arguments, *backend, started_at);
  record.parameters = plan.settings.used();
  record.parameters.insert(record.parameters.begin(), plan.preset);
  record.computation_size = {info.depth_size.width / p.kinectfusion.compute_size_ratio,
                             info.depth_size.height / p.kinectfusion.compute_size_ratio};
  {
    ProgressBar bar(info.name, "frames", steady_clock(), show);
    RunHooks hooks;
    hooks.progress = [&](const Progress& at) { bar.show(at.done, at.total, remark(at)); };
    hooks.images = [&](const FrameRecord& frame, System& s) {
      save_images(frame, s, p.output.images, *folder);
    };
    hooks.stop = &interrupt.raised();
    run_frames(*source, system, timer, steady_clock(), p.run, hooks, &record);
  }
  judge(info, &record);
  record.repetition = repetition_of({run_figures(record)});
  write_outputs(record, system, p.output, *folder);
  return report(record, info, folder->path(), p.output);
}

}  // namespace

Action add_run(CLI::App& command, const std::string& command_line) {
  auto arguments = std::make_shared<RunArguments>();
  arguments->command_line = command_line;
  arguments->sequence_option = command.add_option(
      "SEQUENCE", arguments->sequence,
      fmt::format("folder or file of a recording, or a built-in sequence; layouts "
                  "and names: slambench list (default {}: under a minute on two "
                  "cores)",
                  default_sequence));
  command.add_option("-i,--input-file", arguments->input_file, "the sequence, as SEQUENCE")
      ->type_name("PATH");
  std::string presets;
  for (const Preset& preset : preset_table()) {
    presets += fmt::format("{}{}: {}", presets.empty() ? "" : "; ", preset.name, preset.sentence);
  }
  command
      .add_option("--preset", arguments->preset,
                  fmt::format("{} (default {})", presets, default_preset))
      ->type_name("NAME");
  command.add_option("--config", arguments->config, "parameters from a TOML file")
      ->type_name("FILE");
  arguments->options.add(command, arguments->parameters.lists());
  command.footer(footer);
  return [arguments] { return run(*arguments); };
}

}  // namespace slambench
