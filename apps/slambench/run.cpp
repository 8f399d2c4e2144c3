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
#include <vector>

#include "all_parameters.h"
#include "commands.h"
#include "config/config_file.h"
#include "config/presets.h"
#include "config/settings.h"
#include "help.h"
#include "interrupt.h"
#include "io/files.h"
#include "limit_options.h"
#include "meters/clock.h"
#include "meters/run_meters.h"
#include "open_sequence.h"
#include "parameter_options.h"
#include "progress.h"
#include "results/color_picture.h"
#include "results/provenance.h"
#include "results/result_folder.h"
#include "results/run_statistics.h"
#include "results/summary.h"
#include "results/writers.h"
#include "runner/repeat.h"
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
    "  slambench run --fail-if 'ate_rmse_m>0.05' --fail-if 'fps<30'\n"
    "\n"
    "The command line is stronger than the configuration file, the file than the\n"
    "preset, the preset than what suits the sequence (its own slambench.toml, else\n"
    "what 'slambench info' shows), that than the default.\n"
    "An interrupted run (Ctrl-C) ends after the frame in progress and keeps the\n"
    "results so far, marked incomplete; interrupted again, it ends at once.";

/// What was said on the command line.
struct RunArguments {
  std::string command_line;
  CLI::Option* sequence_option = nullptr;
  std::string sequence, input_file, preset, config;
  std::vector<std::string> limits;
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

/// Whether a file can be written beside the results; fails now rather than after the run.
void require_writable(const std::string& option, const std::string& file,
                      const ResultFolder& results) {
  if (file.empty()) return;
  if (results.contains(file)) {
    throw UsageError(fmt::format(
        "--{}: {} lies in the results folder {}, which is written as a whole; choose another place",
        option, file, results.path()));
  }
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

void require_writable(const OutputParameters& output, const ResultFolder& results) {
  require_writable("log-file", output.log_file, results);
  require_writable("dump-volume", output.dump_volume, results);
  if (!output.log_file.empty() && output.log_file == output.dump_volume) {
    throw UsageError(fmt::format("--log-file and --dump-volume: both are {}", output.log_file));
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

/// Colour is not read with the frames that are processed: nothing of the system needs it.
Image<Rgb8> read_color(int index, Source& source) {
  if (!source.info().has_color) return {};
  Frame frame;
  source.set_color(true);
  source.read(index, frame);
  source.set_color(false);
  return std::move(frame.color);
}

void save_images(const FrameRecord& frame, Source& source, System& system, int every,
                 ResultFolder& folder) {
  if (every == 0 || frame.index % every != 0) return;
  const Pictures pictures = system.pictures();
  const auto write = [&](std::string_view name, const Image<Rgba8>& picture) {
    if (!picture.empty()) folder.write_image(frame.index, name, picture);
  };
  write("color", color_picture(read_color(frame.index, source), pictures.depth.size()));
  write("depth", pictures.depth);
  write("track", pictures.track);
  // Drawn at the rendering rate only: an older one does not belong to this frame.
  if (frame.times.kernel_calls[static_cast<std::size_t>(Kernel::render_volume)] > 0) {
    write("volume", pictures.volume);
  }
}

Provenance provenance(const RunArguments& arguments, const Backend& backend,
                      std::chrono::sys_seconds started_at) {
  Provenance provenance = build_and_machine(started_at);
  provenance.backend = backend.name();
  provenance.device = backend.device();
  provenance.driver = backend.driver();
  provenance.threads = backend.threads();
  provenance.instruction_set = backend.instruction_set();
  provenance.command = arguments.command_line;
  return provenance;
}

void write_outputs(const Record& record, System& system, const OutputParameters& output,
                   ResultFolder& folder) {
  folder.commit(record);
  if (!output.log_file.empty()) write_file(output.log_file, slambench1_log(record));
  if (!output.dump_volume.empty()) system.dump_volume(output.dump_volume);
}

/// "out/slambench.toml sets volume-size, init-pose"; empty when no file of the sequence's does.
std::string own_settings(const Record& record) {
  constexpr std::string_view own_file = "sequence file ";
  std::string text;
  for (const UsedParameter& parameter : record.parameters) {
    if (!parameter.set_by.starts_with(own_file)) continue;
    text += text.empty() ? parameter.set_by.substr(own_file.size()) + " sets " : ", ";
    text += parameter.name;
  }
  return text;
}

/// What the reader of the sequence had to assume, in the columns of the summary.
std::string notes_text(const Record& record, const SequenceInfo& info) {
  constexpr std::size_t label_width = 12, page_width = 80;
  std::string text;
  std::vector<std::string> notes = info.notes;
  if (auto own = own_settings(record); !own.empty()) notes.insert(notes.begin(), std::move(own));
  for (const std::string& note : notes) {
    text += fmt::format("{:{}}{}\n", "note", label_width,
                        wrapped(note, page_width - label_width, label_width));
  }
  return text;
}

/// Throws when the run does not count.
void report(const Record& record, const SequenceInfo& info, const std::string& folder,
            const OutputParameters& output) {
  if (output.json) {
    print(record_json(record));
  } else if (!output.quiet) {
    print(summary_text(record, folder, output_takes_colors()) + notes_text(record, info));
  }
  if (!record.complete) {
    throw Error(ExitStatus::failed,
                fmt::format("{}; the results so far are in {}", record.incomplete_reason, folder));
  }
  if (!record.valid) {
    throw Error(ExitStatus::failed, fmt::format("the result is not valid: {}; see {}",
                                                fmt::join(record.invalid_reasons, "; "), folder));
  }
}

/// The power of the machine at rest.
void measure_idle(double seconds, RunMeters& meters, bool show, const InterruptFlag& interrupt) {
  if (!(seconds > 0)) return;
  ProgressBar bar("idle baseline", "s", steady_clock(), show);
  const double begin_s = steady_clock().now_s();
  meters.measure_idle(seconds, [&] {
    bar.show(static_cast<int>(steady_clock().now_s() - begin_s), static_cast<int>(seconds));
    return !interrupt.raised().load();
  });
}

void add_device_memory(const Backend& backend, Measurements* measurements) {
  measurements->memory.device_bytes = backend.device_bytes();
  if (measurements->memory.device_bytes) return;
  measurements->absent["memory.device_bytes"] = "computes in host memory";
}

std::string progress_title(const std::string& sequence, const RunNumber& run) {
  return run.of == 1 && !run.warmup ? sequence : fmt::format("{}, {}", sequence, to_text(run));
}

ExitStatus run(RunArguments& arguments) {
  const auto started_at =
      std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  const std::vector<Limit> limits = parse_limits(arguments.limits, false);
  RunPlan plan = make_plan(arguments);
  AllParameters& p = arguments.parameters;
  const InterruptFlag interrupt;
  const auto source = open_sequence(plan.sequence, p.source, &plan.settings);
  const SequenceInfo& info = source->info();
  RunMeters meters(p.meters, p.meters.context(), steady_clock());  // before the backend's threads
  const auto backend = create_backend(p.backend.backend, p.backend);
  const auto folder =
      open_results(p.output, default_result_folder(started_at, info.name, backend->name()));
  require_writable(p.output, *folder);
  const bool show = !p.output.quiet && !p.output.json;
  prepare_sequence(*source, frames_to_run(info, p.run), show, interrupt);
  if (!p.source.ground_truth.empty()) check_ground_truth(*source, p.run);
  measure_idle(p.meters.idle, meters, show, interrupt);

  std::unique_ptr<System> system;  // of the last run
  const auto one_run = [&](const RunNumber& number) {
    system.reset();  // its memory is the next one's
    FrameTimer timer(steady_clock(), meters.stages());
    backend->observe(&timer);
    system = std::make_unique<KinectFusion>(*backend, p.kinectfusion, info.depth_size, info.camera,
                                            info.units_per_m, &timer);
    Record record;
    record.provenance = provenance(arguments, *backend, started_at);
    record.parameters = plan.settings.used();
    record.parameters.insert(record.parameters.begin(), plan.preset);
    record.computation_size = {info.depth_size.width / p.kinectfusion.compute_size_ratio,
                               info.depth_size.height / p.kinectfusion.compute_size_ratio};
    ProgressBar bar(progress_title(info.name, number), "frames", steady_clock(), show);
    RunHooks hooks;
    hooks.progress = [&](const Progress& at) { bar.show(at.done, at.total, remark(at)); };
    hooks.begin = [&] { meters.begin(); };
    hooks.images = [&](const FrameRecord& frame, System& s) {
      if (number.last) save_images(frame, *source, s, p.output.images, *folder);
    };
    hooks.stop = &interrupt.raised();
    run_frames(*source, *system, timer, steady_clock(), p.run, hooks, &record);
    record.measurements = meters.end(static_cast<int>(frame_counts(record).processed));
    add_device_memory(*backend, &record.measurements);
    record.provenance.load_average_end = load_average();
    judge(info, &record);
    backend->observe(nullptr);
    return record;
  };
  const Record record = repeat_runs(p.run, one_run);
  write_outputs(record, *system, p.output, *folder);
  report(record, info, folder->path(), p.output);
  if (!limits.empty()) {
    const StoredRun stored = parse_stored_run(record_json(record), folder->path());
    throw_if_violated(violations(limits, stored));
  }
  return ExitStatus::ok;
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
  add_limit_option(command, &arguments->limits, false);
  arguments->options.add(command, arguments->parameters.lists());
  command.footer(footer);
  return [arguments] { return run(*arguments); };
}

}  // namespace slambench
