// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "commands.h"
#include "core/processors.h"
#include "datasets/living_room.h"
#include "datasets/sequence_writer.h"
#include "interrupt.h"
#include "io/text.h"
#include "io/trajectory_file.h"
#include "meters/clock.h"
#include "progress.h"
#include "scene/camera_path.h"
#include "scene/living_room.h"
#include "scene/parallel.h"
#include "terminal.h"

namespace slambench {
namespace {

struct Arguments {
  std::string folder, layout = "tum", scene, trajectory;
  int frames = 0, path = 2, noise_seed = 0;
  bool noise = false, force = false, quiet = false;
};

WrittenLayout layout_of(const std::string& word) {
  static const std::map<std::string, WrittenLayout> layouts = {
      {"tum", WrittenLayout::tum}, {"icl", WrittenLayout::icl}, {"raw", WrittenLayout::raw}};
  const auto found = layouts.find(word);
  if (found == layouts.end()) {
    throw UsageError(fmt::format("--layout: found {}, expected tum, icl or raw", quote(word)));
  }
  return found->second;
}

/// A user's poses are those of frames in a row, so their times must rise.
Trajectory read_camera_path(const std::string& path) {
  Trajectory trajectory = read_trajectory(path);
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    // Frames are named by their times in microseconds.
    if (trajectory[i].time_s - trajectory[i - 1].time_s < 1e-6) {
      throw InputError(path, fmt::format("time of pose {}", i + 1),
                       fmt::format("{}", trajectory[i].time_s),
                       fmt::format("more than the {} before", trajectory[i - 1].time_s));
    }
  }
  return trajectory;
}

/// The surface, the way through it, and what is to be said about them.
struct Plan {
  Mesh surface;
  Trajectory trajectory;
  WrittenSequence written;
};

Plan plan_of(const Arguments& arguments) {
  if (!arguments.scene.empty() && arguments.trajectory.empty()) {
    throw UsageError("--scene: needs --trajectory, the way of the camera through it");
  }
  Plan plan;
  const bool own_scene = !arguments.scene.empty(), own_way = !arguments.trajectory.empty();
  plan.trajectory =
      own_way ? read_camera_path(arguments.trajectory) : living_room_path(arguments.path);
  plan.surface = own_scene ? read_mesh(arguments.scene) : living_room();
  const auto poses = static_cast<int>(plan.trajectory.size());
  WrittenSequence& written = plan.written;
  written.layout = layout_of(arguments.layout);
  written.frames = arguments.frames > 0 ? std::min(arguments.frames, poses) : poses;
  written.trajectory = own_way ? "traj0" : fmt::format("livingRoom{}", arguments.path);
  const auto file_name = [](const std::string& path) {
    return std::filesystem::path(path).filename().string();
  };
  written.sentence = fmt::format(
      "{}, {}, {} frames, {}",
      own_scene ? "Scene " + quote(file_name(arguments.scene)) : std::string("The living room"),
      own_way ? "trajectory " + quote(file_name(arguments.trajectory))
              : fmt::format("path {}", arguments.path),
      written.frames,
      arguments.noise ? fmt::format("noise of a Kinect with seed {}", arguments.noise_seed)
                      : std::string("without noise"));
  if (!own_way) written.suggested = living_room_settings(plan.trajectory.front().T_world_camera);
  return plan;
}

void warn_of_blind_frames(const std::vector<int>& blind, int frames) {
  if (blind.empty()) return;
  print_error(
      fmt::format("slambench: warning: {} of {} frames see nothing of the scene, the first "
                  "is frame {}\n",
                  blind.size(), frames, blind.front()));
}

ExitStatus generate(const Arguments& arguments) {
  const Plan plan = plan_of(arguments);
  const InterruptFlag interrupt;
  std::vector<int> blind;
  {
    std::optional<std::uint64_t> seed;
    if (arguments.noise) seed = static_cast<std::uint64_t>(arguments.noise_seed);
    const RenderedSequence sequence(plan.surface, plan.trajectory, Shading::diffuse, seed,
                                    usable_processors());
    ProgressBar bar("generating", "frames", steady_clock(), !arguments.quiet);
    blind = write_sequence(sequence, plan.surface, plan.written, arguments.folder, arguments.force,
                           [&](int done, int total) {
                             bar.show(done, total);
                             return !interrupt.raised();
                           });
  }
  warn_of_blind_frames(blind, plan.written.frames);
  if (!arguments.quiet) {
    print(fmt::format("{} frames in {}\n", plan.written.frames, arguments.folder));
  }
  return ExitStatus::ok;
}

}  // namespace

Action add_generate(CLI::App& command) {
  auto a = std::make_shared<Arguments>();
  command.add_option("OUT", a->folder, "folder to write to; it must not exist")->required();
  command.add_option("--layout", a->layout, "tum (default), icl or raw");
  CLI::Option* path =
      command
          .add_option("--path", a->path, "camera path through the living room: 0 to 3 (default 2)")
          ->check(CLI::Range(0, living_room_path_count - 1));
  command.add_option("--scene", a->scene,
                     "own mesh instead of the living room: OBJ or PLY, metres");
  command
      .add_option("--trajectory", a->trajectory,
                  "own camera path in TUM format; the camera looks along z, y points down")
      ->excludes(path);
  command.add_option("--frames", a->frames, "at most so many first frames")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  command.add_flag("--noise", a->noise, "add the noise of a Kinect to the depth");
  command.add_option("--noise-seed", a->noise_seed, "seed of that noise (default 0)")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  command.add_flag("--force", a->force, "replace a folder that was written by this command");
  command.add_flag("--quiet", a->quiet, "say nothing unless something is wrong");
  return [a] { return generate(*a); };
}

}  // namespace slambench
