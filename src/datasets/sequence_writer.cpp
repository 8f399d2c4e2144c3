// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/sequence_writer.h"

#include <fcntl.h>
#include <fmt/compile.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
#include <system_error>

#include "core/error.h"
#include "core/processors.h"
#include "datasets/sequence_info.h"
#include "io/files.h"
#include "io/png.h"
#include "io/trajectory_file.h"
#include "io/whole_folder.h"
#include "scene/parallel.h"

namespace slambench {
namespace {

constexpr FolderKind generated_sequence = {
    "generated sequence", sequence_settings,
    [](const std::filesystem::path& folder) { return is_file(folder / sequence_settings); }};

/// One way of writing frames. `write` is called for several frames at once.
class FrameWriter {
 public:
  virtual ~FrameWriter() = default;
  /// False when the frame holds no depth at all.
  virtual bool write(int index, const Rendering& frame) = 0;
  /// Writes the lists, the ground truth and the surface.
  virtual void finish(const Trajectory& trajectory, const Mesh& surface) = 0;
};

bool sees_something(const Image<std::uint16_t>& depth) {
  return std::any_of(depth.begin(), depth.end(), [](std::uint16_t value) { return value > 0; });
}

std::string camera_text() {
  const Intrinsics& k = rendered_camera;
  return fmt::format("# fx fy cx cy of the images, pixels, y down\n{} {} {} {}\n", k.fx, k.fy, k.cx,
                     k.cy);
}

class TumWriter final : public FrameWriter {
 public:
  TumWriter(const WholeFolder& folder, const Trajectory& trajectory)
      : folder_(folder), trajectory_(trajectory) {
    folder.make_folder("depth");
    folder.make_folder("rgb");
  }

  bool write(int index, const Rendering& frame) override {
    Image<std::uint16_t> depth;
    quantize_depth(frame.depth_m, rendered_units_per_m, depth);
    write_file(folder_.file("depth/" + name(index)), png_bytes(depth));
    write_file(folder_.file("rgb/" + name(index)), png_bytes(frame.color));
    return sees_something(depth);
  }

  void finish(const Trajectory& trajectory, const Mesh& surface) override {
    for (const std::string kind : {"depth", "rgb"}) {
      std::string list = "# timestamp filename\n";
      for (std::size_t i = 0; i < trajectory.size(); ++i) {
        list += fmt::format("{} {}/{}\n", trajectory[i].time_s, kind, name(static_cast<int>(i)));
      }
      write_file(folder_.file(kind + ".txt"), list);
    }
    write_file(folder_.file("camera.txt"), camera_text());
    write_file(folder_.file("groundtruth.txt"),
               "# timestamp tx ty tz qx qy qz qw\n" + trajectory_text(trajectory));
    write_file(folder_.file("surface.ply"), ply_bytes(surface));
  }

 private:
  std::string name(int index) const {
    return fmt::format("{:.6f}.png", trajectory_[static_cast<std::size_t>(index)].time_s);
  }

  const WholeFolder& folder_;
  const Trajectory& trajectory_;
};

/// ICL-NUIM's world has y up and the second frame at (0, 0, -2.25), looking along z.
class IclWriter final : public FrameWriter {
 public:
  IclWriter(const WholeFolder& folder, std::string trajectory)
      : folder_(folder), trajectory_(std::move(trajectory)) {
    for (int v = 0; v < rendered_size.height; ++v) {
      for (int u = 0; u < rendered_size.width; ++u) {
        const float x = (float(u) - rendered_camera.cx) / rendered_camera.fx;
        const float y = (float(v) - rendered_camera.cy) / rendered_camera.fy;
        distance_per_depth_.push_back(std::sqrt(x * x + y * y + 1));
      }
    }
  }

  bool write(int index, const Rendering& frame) override {
    fmt::memory_buffer text;
    bool something = false;
    for (std::size_t i = 0; i < frame.depth_m.count(); ++i) {
      const float distance_m = frame.depth_m.data()[i] * distance_per_depth_[i];
      something = something || distance_m > 0;
      fmt::format_to(std::back_inserter(text), FMT_COMPILE("{:.6g} "), distance_m);
    }
    const std::string stem = folder_.file(fmt::format("scene_00_{:04}", index));
    write_file(stem + ".depth", {text.data(), text.size()});
    write_file(stem + ".png", png_bytes(frame.color));
    return something;
  }

  void finish(const Trajectory& trajectory, const Mesh& surface) override {
    const Eigen::DiagonalMatrix<double, 3> flip(1, -1, 1);
    const Eigen::Vector3d start(0, 0, -2.25);
    const Pose T_first_world = trajectory.at(1).T_world_camera.inverse();
    Trajectory published;
    for (std::size_t i = 1; i < trajectory.size(); ++i) {
      const Pose moved = T_first_world * trajectory[i].T_world_camera;
      Pose pose = Pose::Identity();
      pose.linear() = flip * moved.linear() * flip;
      pose.translation() = flip * moved.translation() + start;
      published.push_back({static_cast<double>(i), pose});
    }
    write_file(folder_.file(trajectory_ + ".gt.freiburg"), trajectory_text(published));

    Mesh mirrored = surface;
    for (auto& vertex : mirrored.vertices) {
      vertex = (flip * (T_first_world * vertex.cast<double>()) + start).cast<float>();
    }
    for (auto& triangle : mirrored.triangles) std::swap(triangle[1], triangle[2]);
    write_file(folder_.file("surface.ply"), ply_bytes(mirrored));
  }

 private:
  const WholeFolder& folder_;
  const std::string trajectory_;
  std::vector<float> distance_per_depth_;
};

/// Frames of one size, each at its place in the file.
class RawWriter final : public FrameWriter {
 public:
  explicit RawWriter(const WholeFolder& folder)
      : folder_(folder),
        file_(::open(folder.file("sequence.raw").c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC,
                     0666)) {
    if (file_ < 0) fail();
  }
  ~RawWriter() override {
    if (file_ >= 0) ::close(file_);
  }
  RawWriter(const RawWriter&) = delete;
  RawWriter& operator=(const RawWriter&) = delete;

  bool write(int index, const Rendering& frame) override {
    constexpr float millimetres = 1000;
    static_assert(std::endian::native == std::endian::little && sizeof(Rgb8) == 3);
    Image<std::uint16_t> depth;
    quantize_depth(frame.depth_m, millimetres, depth);
    std::string bytes;
    const auto append = [&](const void* data, std::size_t size) {
      bytes.append(static_cast<const char*>(data), size);
    };
    const std::uint32_t sides[2] = {static_cast<std::uint32_t>(depth.width()),
                                    static_cast<std::uint32_t>(depth.height())};
    append(sides, sizeof sides);
    append(depth.data(), depth.bytes());
    append(sides, sizeof sides);
    append(frame.color.data(), frame.color.bytes());
    write_at(static_cast<off_t>(bytes.size()) * index, bytes);
    return sees_something(depth);
  }

  void finish(const Trajectory& trajectory, const Mesh& surface) override {
    const int file = std::exchange(file_, -1);
    const bool flushed = ::fsync(file) == 0;
    if (::close(file) != 0 || !flushed) fail();
    write_file(folder_.file("sequence.camera.txt"), camera_text());
    Trajectory numbered = trajectory;  // the file has no time stamps: frames are counted
    for (std::size_t i = 0; i < numbered.size(); ++i) numbered[i].time_s = static_cast<double>(i);
    write_file(folder_.file("sequence.groundtruth.txt"), trajectory_text(numbered));
    write_file(folder_.file("surface.ply"), ply_bytes(surface));
  }

 private:
  [[noreturn]] static void fail() {
    throw Error(ExitStatus::failed, fmt::format("sequence.raw: cannot write: {}",
                                                std::generic_category().message(errno)));
  }

  void write_at(off_t offset, std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::pwrite(file_, bytes.data(), bytes.size(), offset);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail();
      bytes.remove_prefix(static_cast<std::size_t>(written));
      offset += written;
    }
  }

  const WholeFolder& folder_;
  int file_;
};

std::unique_ptr<FrameWriter> make_writer(const WrittenSequence& what, const WholeFolder& folder,
                                         const Trajectory& trajectory) {
  switch (what.layout) {
    case WrittenLayout::tum:
      return std::make_unique<TumWriter>(folder, trajectory);
    case WrittenLayout::icl:
      return std::make_unique<IclWriter>(folder, what.trajectory);
    case WrittenLayout::raw:
      break;
  }
  return std::make_unique<RawWriter>(folder);
}

/// A configuration file with which the sequence can be run.
std::string configuration(const WrittenSequence& what) {
  std::string text = fmt::format(
      "# {}\n# Written by slambench generate. A run of this sequence takes its settings from "
      "here.\n",
      what.sentence);
  if (!what.suggested.empty()) text += "\n[kinectfusion]\n";
  for (const auto& [name, value] : what.suggested) {
    const bool list = value.find(',') != std::string::npos;
    text += fmt::format("{} = {}{}{}\n", name, list ? "[" : "", value, list ? "]" : "");
  }
  return text;
}

}  // namespace

std::vector<int> write_sequence(const RenderedSequence& sequence, const Mesh& surface,
                                const WrittenSequence& what, const std::string& folder_path,
                                bool force, const PrepareProgress& progress) {
  const auto& all = sequence.trajectory();
  const Trajectory trajectory(all.begin(), all.begin() + what.frames);
  if (what.layout == WrittenLayout::icl && what.frames < 2) {
    throw UsageError(
        "--frames: found 1, expected at least 2: ICL-NUIM's ground truth has no pose "
        "of the first frame");
  }
  WholeFolder folder(folder_path, force, generated_sequence);
  const auto writer = make_writer(what, folder, trajectory);
  std::mutex reporting;
  int done = 0;
  std::vector<int> blind;
  parallel_for(what.frames, usable_processors(), [&](int i) {
    thread_local Rendering frame;
    sequence.render(i, frame);
    const bool something = writer->write(i, frame);
    const std::scoped_lock lock(reporting);
    if (!something) blind.push_back(i);
    if (progress && !progress(++done, what.frames)) {
      throw Error(ExitStatus::failed, folder_path + ": interrupted, nothing was written");
    }
  });
  std::sort(blind.begin(), blind.end());
  if (static_cast<int>(blind.size()) == what.frames) {
    throw InputError(
        "none of the frames sees anything of the scene: does the trajectory belong to "
        "it, with x right, y down, z forward and in metres?");
  }
  writer->finish(trajectory, surface);
  write_file(folder.file(std::string(sequence_settings)), configuration(what));
  folder.commit();
  return blind;
}

}  // namespace slambench
