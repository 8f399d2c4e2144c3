// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/living_room.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <mutex>
#include <optional>

#include "core/error.h"
#include "core/processors.h"
#include "datasets/frame_cache.h"
#include "datasets/sequence_info.h"
#include "io/text.h"
#include "scene/camera_path.h"
#include "scene/frame_codec.h"
#include "scene/living_room.h"
#include "scene/parallel.h"
#include "scene/rendered_sequence.h"

namespace slambench {
namespace {

constexpr std::string_view built_in_name = "living-room";
constexpr int default_path = 2;
constexpr double volume_m = 4.8;

int path_number(const std::string& sequence) {
  if (sequence == built_in_name) return default_path;
  const std::string number = sequence.substr(built_in_name.size() + 1);
  const bool is_path =
      number.size() == 1 && number[0] >= '0' && number[0] < '0' + living_room_path_count;
  if (!is_path) {
    throw InputError(sequence, "path", quote(number),
                     fmt::format("0 to {}", living_room_path_count - 1));
  }
  return number[0] - '0';
}

template <class T>
std::uint64_t hash_of(const std::vector<T>& values) {
  return XXH3_64bits(values.data(), values.size() * sizeof(T));
}

std::uint64_t hash_of(const Trajectory& trajectory) {
  std::vector<double> numbers;
  for (const StampedPose& stamped : trajectory) {
    const auto& m = stamped.T_world_camera.matrix();
    numbers.insert(numbers.end(), m.data(), m.data() + m.size());
  }
  return hash_of(numbers);
}

/// What the frames depend on. The number is that of everything which is not data here: how light,
/// noise and the codec work.
std::string key_of(const Mesh& mesh, const Trajectory& trajectory, std::string_view what) {
  constexpr int version = 1;
  return fmt::format("{} {} {:x} {:x} {:x} {:x} {}x{} {},{},{},{} {}", version, what,
                     hash_of(mesh.vertices), hash_of(mesh.triangles), hash_of(mesh.colors),
                     hash_of(trajectory), rendered_size.width, rendered_size.height,
                     rendered_camera.fx, rendered_camera.fy, rendered_camera.cx, rendered_camera.cy,
                     rendered_units_per_m);
}

/// Where rendered frames are kept; "" when the user has no such place.
std::string frames_folder() {
  try {
    return cache_folder() + "/living-room";
  } catch (const UnavailableError&) {
    return "";
  }
}

class LivingRoomSource final : public Source {
 public:
  LivingRoomSource(int path, const SourceParameters& parameters);
  const SequenceInfo& info() const override { return info_; }
  void prepare(int frames, const PrepareProgress& progress) override;
  void read(int index, Frame& frame) override;
  double time_s(int index) override { return index / living_room_fps; }

 private:
  const RenderedSequence& scene();
  int frames_in(int chunk) const;
  bool has(int chunk);
  void render_chunk(const RenderedSequence& scene, int chunk,
                    const std::function<void()>& rendered);
  bool decode(int index, Frame& frame);
  void note_problems();

  SequenceInfo info_;
  Trajectory trajectory_;
  std::optional<std::uint64_t> noise_seed_;
  std::unique_ptr<FrameCache> depth_, color_;
  std::unique_ptr<RenderedSequence> scene_;
  bool scene_has_color_ = false;
};

LivingRoomSource::LivingRoomSource(int path, const SourceParameters& parameters)
    : trajectory_(living_room_path(path)) {
  if (parameters.noise) noise_seed_ = static_cast<std::uint64_t>(parameters.noise_seed);
  info_.name = fmt::format("{}/{}", built_in_name, path);
  info_.layout = built_in_name;
  info_.depth_size = rendered_size;
  info_.camera = rendered_camera;
  info_.units_per_m = rendered_units_per_m;
  info_.has_color = true;
  info_.fps = living_room_fps;
  info_.ground_truth = trajectory_;
  info_.ground_truth_file = "built in, exact";
  info_.suggested = living_room_settings(trajectory_.front().T_world_camera);
  std::vector<double> stamps_s;
  for (const StampedPose& stamped : trajectory_) stamps_s.push_back(stamped.time_s);
  complete_info(parameters, "", stamps_s, &info_);

  const Mesh mesh = living_room();
  const std::string folder = frames_folder();
  const std::string depth =
      noise_seed_ ? fmt::format("{}-noise-{}", path, *noise_seed_) : fmt::format("{}-exact", path);
  const std::string color = fmt::format("{}-color", path);
  depth_ = std::make_unique<FrameCache>(folder, depth, key_of(mesh, trajectory_, depth));
  color_ = std::make_unique<FrameCache>(folder, color, key_of(mesh, trajectory_, color));
}

const RenderedSequence& LivingRoomSource::scene() {
  if (scene_ == nullptr || (wants_color() && !scene_has_color_)) {
    scene_ = std::make_unique<RenderedSequence>(living_room(), trajectory_,
                                                wants_color() ? Shading::diffuse : Shading::none,
                                                noise_seed_, usable_processors());
    scene_has_color_ = wants_color();
  }
  return *scene_;
}

int LivingRoomSource::frames_in(int chunk) const {
  return std::min(FrameCache::chunk_frames, info_.frame_count - chunk * FrameCache::chunk_frames);
}

bool LivingRoomSource::has(int chunk) {
  return depth_->has(chunk, frames_in(chunk)) &&
         (!wants_color() || color_->has(chunk, frames_in(chunk)));
}

void LivingRoomSource::render_chunk(const RenderedSequence& scene, int chunk,
                                    const std::function<void()>& rendered) {
  std::vector<std::string> depths, colors;
  Rendering rendering;
  Image<std::uint16_t> depth;
  for (int i = 0; i < frames_in(chunk); ++i) {
    scene.render(chunk * FrameCache::chunk_frames + i, rendering);
    quantize_depth(rendering.depth_m, rendered_units_per_m, depth);
    depths.push_back(encode_image(depth));
    if (wants_color()) colors.push_back(encode_image(rendering.color));
    rendered();
  }
  depth_->store(chunk, depths);
  if (wants_color()) color_->store(chunk, colors);
}

void LivingRoomSource::prepare(int frames, const PrepareProgress& progress) {
  frames = std::clamp(frames, 0, info_.frame_count);
  std::vector<int> missing;
  int total = 0;
  for (int chunk = 0; chunk * FrameCache::chunk_frames < frames; ++chunk) {
    if (has(chunk)) continue;
    missing.push_back(chunk);
    total += frames_in(chunk);
  }
  if (missing.empty()) return;

  std::mutex reporting;
  int done = 0;
  const auto rendered = [&](int count) {
    const std::scoped_lock lock(reporting);
    done += count;
    if (progress && !progress(done, total)) {
      throw Error(ExitStatus::failed, info_.name + ": interrupted while rendering");
    }
  };
  const RenderedSequence& shared = scene();
  parallel_for(static_cast<int>(missing.size()), usable_processors(), [&](int i) {
    const int chunk = missing[static_cast<std::size_t>(i)];
    if (has(chunk)) {  // by now, from another process
      rendered(frames_in(chunk));
    } else {
      render_chunk(shared, chunk, [&] { rendered(1); });
    }
  });
  note_problems();
}

bool LivingRoomSource::decode(int index, Frame& frame) {
  if (!decode_image(depth_->find(index), info_.depth_size, frame.depth)) return false;
  if (wants_color()) return decode_image(color_->find(index), info_.depth_size, frame.color);
  frame.color.resize({});
  return true;
}

void LivingRoomSource::read(int index, Frame& frame) {
  frame.index = index;
  frame.time_s = trajectory_.at(static_cast<std::size_t>(index)).time_s;
  if (decode(index, frame)) return;
  render_chunk(scene(), index / FrameCache::chunk_frames, [] {});
  note_problems();
  if (decode(index, frame)) return;
  // The disk does not give back what was written.
  Rendering rendering;
  scene().render(index, rendering);
  quantize_depth(rendering.depth_m, rendered_units_per_m, frame.depth);
  frame.color = std::move(rendering.color);
}

void LivingRoomSource::note_problems() {
  for (FrameCache* cache : {depth_.get(), color_.get()}) {
    if (cache->problem().empty()) continue;
    const std::string note = "rendered frames are held in memory and not kept: " + cache->problem();
    if (std::find(info_.notes.begin(), info_.notes.end(), note) == info_.notes.end()) {
      info_.notes.push_back(note);
    }
  }
}

}  // namespace

bool is_living_room(const std::string& sequence) {
  return sequence == built_in_name || sequence.starts_with(std::string(built_in_name) + "/");
}

std::unique_ptr<Source> open_living_room(const std::string& sequence,
                                         const SourceParameters& parameters) {
  const int path = path_number(sequence);
  if (!can_render())
    throw UnavailableError(sequence + ": " + std::string(living_room_unavailable()));
  return std::make_unique<LivingRoomSource>(path, parameters);
}

std::string_view living_room_unavailable() {
  return can_render() ? "" : "this build has no Embree; install libembree-dev and configure again";
}

std::vector<std::pair<std::string, std::string>> living_room_settings(const Pose& T_world_start) {
  const Eigen::Vector3d middle(0, -living_room_height_m / 2, 0);
  const Eigen::Vector3d from_middle =
      T_world_start.linear().transpose() * (T_world_start.translation() - middle);
  const Eigen::Vector3d factors = Eigen::Vector3d::Constant(0.5) + from_middle / volume_m;
  return {
      {"compute-size-ratio", "2"},
      {"volume-size", fmt::format("{}", volume_m)},
      {"init-pose", fmt::format("{:.6g},{:.6g},{:.6g}", factors.x(), factors.y(), factors.z())}};
}

}  // namespace slambench
