// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "commands.h"
#include "config/settings.h"
#include "datasets/source.h"
#include "help.h"
#include "open_sequence.h"
#include "parameter_options.h"
#include "slam/kinect_fusion.h"
#include "terminal.h"

namespace slambench {
namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::string sequence;
  bool json = false;
  SourceParameters parameters;
  ParameterOptions options;
};

/// What a run would take from the sequence: parameter, value.
std::vector<std::pair<std::string, std::string>> suggested(const Settings& settings) {
  std::vector<std::pair<std::string, std::string>> taken;
  for (const UsedParameter& parameter : settings.used()) {
    if (parameter.set_by.starts_with("sequence"))
      taken.emplace_back(parameter.name, parameter.value);
  }
  return taken;
}

double path_length_m(const Trajectory& trajectory) {
  double length_m = 0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    length_m += (trajectory[i].T_world_camera.translation() -
                 trajectory[i - 1].T_world_camera.translation())
                    .norm();
  }
  return length_m;
}

Json ground_truth_json(const SequenceInfo& info) {
  if (info.ground_truth.empty()) return nullptr;
  return {{"file", info.ground_truth_file},
          {"poses", info.ground_truth.size()},
          {"first_time_s", info.ground_truth.front().time_s},
          {"last_time_s", info.ground_truth.back().time_s},
          {"path_length_m", path_length_m(info.ground_truth)},
          {"frames_with_pose", info.frames_with_ground_truth}};
}

std::string json_text(const SequenceInfo& info, const Settings& settings) {
  const Intrinsics& k = info.camera;
  Json taken = Json::object();
  for (const auto& [name, value] : suggested(settings)) taken[name] = value;
  const std::string file = sequence_settings_file(info.path);
  const Json json = {
      {"name", info.name},
      {"layout", info.layout},
      {"path", info.path},
      {"frames", info.frame_count},
      {"first_time_s", info.first_time_s},
      {"last_time_s", info.last_time_s},
      {"fps", info.fps},
      {"width", info.depth_size.width},
      {"height", info.depth_size.height},
      {"depth_units_per_m", info.units_per_m},
      {"color", info.has_color},
      {"camera", {{"fx", k.fx}, {"fy", k.fy}, {"cx", k.cx}, {"cy", k.cy}}},
      {"axes", info.axes},
      {"ground_truth", ground_truth_json(info)},
      {"suggested", taken},
      {"settings_file", file.empty() ? Json(nullptr) : Json(file)},
      {"notes", info.notes},
  };
  // A file name may hold bytes that are not UTF-8, which JSON cannot.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Rows of a name and a text at 80 columns.
class Page {
 public:
  /// A text that may be wrapped between words.
  void row(std::string_view name, const std::string& text) {
    line(name, wrapped(text, width - indent, indent));
  }
  /// A text that stays as it is, such as the name of a file.
  void line(std::string_view name, std::string_view text) {
    text_ += fmt::format("{:{}}{}\n", name, indent, text);
  }
  const std::string& text() const { return text_; }

 private:
  static constexpr std::size_t width = 80, indent = 14;
  std::string text_;
};

void add_ground_truth(const SequenceInfo& info, Page* page) {
  if (info.ground_truth.empty()) {
    page->row("ground truth", "none");
    return;
  }
  page->line("ground truth", info.ground_truth_file);
  page->row("", fmt::format("{} poses, stamps {} to {}, path of {:.3f} m", info.ground_truth.size(),
                            info.ground_truth.front().time_s, info.ground_truth.back().time_s,
                            path_length_m(info.ground_truth)));
  page->row("", fmt::format("{} of {} frames have a pose", info.frames_with_ground_truth,
                            info.frame_count));
}

std::string page_text(const SequenceInfo& info, const Settings& settings) {
  const Intrinsics& k = info.camera;
  Page page;
  page.line("sequence", info.name);
  page.line("layout", info.layout);
  if (!info.path.empty()) page.line("path", info.path);
  page.row("frames", fmt::format("{}, stamps {} to {}, {:.4g} frames a second", info.frame_count,
                                 info.first_time_s, info.last_time_s, info.fps));
  page.row("depth", fmt::format("{}x{}, {} units per metre", info.depth_size.width,
                                info.depth_size.height, info.units_per_m));
  page.row("colour", info.has_color ? "yes" : "none");
  page.row("camera", fmt::format("fx {:.6g}, fy {:.6g}, cx {:.6g}, cy {:.6g} px (y down)", k.fx,
                                 k.fy, k.cx, k.cy));
  page.row("axes", info.axes);
  add_ground_truth(info, &page);
  std::string options;
  for (const auto& [name, value] : suggested(settings)) {
    options += fmt::format("--{}={} ", name, value);
  }
  page.row("suggested", options.empty() ? "the defaults" : options);
  if (const auto file = sequence_settings_file(info.path); !file.empty()) {
    page.line("settings", file);
  }
  std::string_view name = "notes";
  for (const std::string& note : info.notes) {
    page.row(name, note);
    name = "";
  }
  return page.text();
}

}  // namespace

Action add_info(CLI::App& command) {
  auto arguments = std::make_shared<Arguments>();
  command
      .add_option("SEQUENCE", arguments->sequence, "folder, file or name of a built-in sequence")
      ->required();
  arguments->options.add(command, {arguments->parameters.describe()});
  for (CLI::Option* option : command.get_options({})) {
    if (!option->get_positional()) option->group("Options");
  }
  command.add_flag("--json", arguments->json, "the same as one JSON object");
  return [arguments] {
    KinectFusionParameters of_runs;
    Settings settings({arguments->parameters.describe(), of_runs.describe()});
    arguments->options.apply(settings);
    const auto source = open_sequence(arguments->sequence, arguments->parameters, &settings);
    const SequenceInfo& info = source->info();
    print(arguments->json ? json_text(info, settings) : page_text(info, settings));
    return ExitStatus::ok;
  };
}

}  // namespace slambench
