// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/slambench_raw.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <numeric>
#include <optional>
#include <span>

#include "core/error.h"
#include "datasets/sequence_info.h"
#include "io/files.h"

namespace slambench {
namespace {

static_assert(std::endian::native == std::endian::little, "pixels are copied as they are");

namespace fs = std::filesystem;

constexpr std::size_t header_bytes = 8;

using Sides = std::array<std::uint32_t, 2>;

/// The size that a frame's header tells, or nothing when it is none of an image.
std::optional<Size> size_of(const Sides& sides) {
  constexpr std::uint32_t largest_side = 16384;
  for (const std::uint32_t side : sides) {
    if (side == 0 || side > largest_side) return std::nullopt;
  }
  return Size{static_cast<int>(sides[0]), static_cast<int>(sides[1])};
}

Sides read_header(const PiecewiseFile& file, std::size_t offset) {
  Sides sides{};
  file.read(offset, std::as_writable_bytes(std::span(sides)));
  return sides;
}

/// Where things lie in a file of frames of one size.
struct Layout {
  Size size;
  bool has_color = false;

  std::size_t depth_bytes() const { return header_bytes + 2 * size.count(); }
  std::size_t frame_bytes() const {
    return depth_bytes() + (has_color ? header_bytes + 3 * size.count() : 0);
  }
};

/// The first thing that is wrong with a file as frames of one layout.
struct Defect {
  std::size_t frame = 0;
  std::size_t offset = 0;
  std::string found, expected;
};

/// What is wrong with the header at this place, if anything.
std::optional<Defect> header_defect(const PiecewiseFile& file, const Layout& layout,
                                    std::size_t frame, std::size_t offset) {
  const Sides sides = read_header(file, offset);
  if (size_of(sides) == layout.size) return std::nullopt;
  return Defect{frame, offset, fmt::format("size {}x{}", sides[0], sides[1]),
                fmt::format("{}x{} as in the first frame", layout.size.width, layout.size.height)};
}

std::optional<Defect> frame_defect(const PiecewiseFile& file, const Layout& layout,
                                   std::size_t frame) {
  const std::size_t offset = frame * layout.frame_bytes();
  const auto check = [&](std::size_t at) -> std::optional<Defect> {
    if (at + header_bytes > file.size()) return std::nullopt;  // truncated: reported as that
    return header_defect(file, layout, frame, at);
  };
  if (auto defect = check(offset)) return defect;
  if (layout.has_color) {
    if (auto defect = check(offset + layout.depth_bytes())) return defect;
  }
  if (offset + layout.frame_bytes() <= file.size()) return std::nullopt;
  return Defect{frame, offset, fmt::format("{} bytes to the end", file.size() - offset),
                fmt::format("{} bytes (the file is truncated)", layout.frame_bytes())};
}

/// Checks the first and last frames; `read` checks the others when they are needed, since touching
/// every header of a file larger than the memory takes long.
std::optional<Defect> find_defect(const PiecewiseFile& file, const Layout& layout) {
  constexpr std::size_t checked = 32;
  const std::size_t frames = (file.size() + layout.frame_bytes() - 1) / layout.frame_bytes();
  for (std::size_t frame = 0; frame < frames; ++frame) {
    if (frame == checked && frames > 2 * checked) frame = frames - checked;
    if (auto defect = frame_defect(file, layout, frame)) return defect;
  }
  return std::nullopt;
}

[[noreturn]] void reject(const std::string& path, const Defect& defect) {
  throw InputError(path, fmt::format("frame {} at byte {}", defect.frame, defect.offset),
                   defect.found, defect.expected);
}

/// With colour or without, whichever has no defect; else whichever goes well for longer.
Layout detect_layout(const std::string& path, const PiecewiseFile& file) {
  if (file.size() == 0) throw InputError(path + ": the file is empty, expected frames");
  if (file.size() < header_bytes) {
    reject(path, {0, 0, fmt::format("{} bytes to the end", file.size()),
                  "a header of 8 bytes (the file is truncated)"});
  }
  const auto size = size_of(read_header(file, 0));
  if (!size) {
    throw InputError(path, "frame 0 at byte 0", "no width and height from 1 to 16384",
                     "a frame of SLAMBench 1 (u32 width, u32 height, depth)");
  }
  const Layout full = {*size, true}, light = {*size, false};
  const auto full_defect = find_defect(file, full);
  if (!full_defect) return full;
  const auto light_defect = find_defect(file, light);
  if (!light_defect) return light;
  reject(path, full_defect->offset >= light_defect->offset ? *full_defect : *light_defect);
}

class RawSource final : public Source {
 public:
  RawSource(const std::string& path, const SourceParameters& parameters);
  const SequenceInfo& info() const override { return info_; }
  void read(int index, Frame& frame) override;
  double time_s(int index) override { return index; }

 private:
  template <class T>
  void read_pixels(std::size_t offset, Image<T>& image) const {
    file_.read(offset, std::as_writable_bytes(std::span(image.data(), image.count())));
  }

  PiecewiseFile file_;
  Layout layout_;
  SequenceInfo info_;
};

RawSource::RawSource(const std::string& path, const SourceParameters& parameters)
    : file_(path), layout_(detect_layout(path, file_)) {
  info_.name = sequence_name(path);
  info_.layout = "slambench-raw";
  info_.path = path;
  info_.depth_size = layout_.size;
  info_.camera = {531.15F, 531.15F, 320, 240};
  info_.units_per_m = 1000;
  info_.has_color = layout_.has_color;
  std::vector<double> stamps_s(file_.size() / layout_.frame_bytes());
  std::iota(stamps_s.begin(), stamps_s.end(), 0);
  std::string ground_truth = fs::path(path).replace_extension(".groundtruth.txt");
  if (!is_present(ground_truth)) ground_truth.clear();
  const std::string camera = fs::path(path).replace_extension(".camera.txt");
  complete_info(with_camera_file(parameters, camera), ground_truth, stamps_s, &info_);
}

void RawSource::read(int index, Frame& frame) {
  if (index < 0 || index >= info_.frame_count) {
    throw std::out_of_range(fmt::format("frame {} of {}", index, info_.frame_count));
  }
  const auto number = static_cast<std::size_t>(index);
  if (const auto defect = frame_defect(file_, layout_, number)) reject(info_.path, *defect);
  const std::size_t depth = number * layout_.frame_bytes() + header_bytes;
  frame.index = index;
  frame.time_s = index;
  frame.depth.resize(layout_.size);
  read_pixels(depth, frame.depth);
  frame.color.resize(wants_color() && layout_.has_color ? layout_.size : Size{});
  static_assert(sizeof(Rgb8) == 3);
  if (!frame.color.empty()) read_pixels(depth + frame.depth.bytes() + header_bytes, frame.color);
}

}  // namespace

bool is_slambench_raw(const std::string& sequence) {
  if (!is_file(sequence)) return false;
  if (fs::path(sequence).extension() == ".raw") return true;
  try {
    const PiecewiseFile file(sequence);
    return file.size() >= header_bytes && size_of(read_header(file, 0)).has_value();
  } catch (const InputError&) {
    return false;
  }
}

std::unique_ptr<Source> open_slambench_raw(const std::string& sequence,
                                           const SourceParameters& parameters) {
  return std::make_unique<RawSource>(sequence, parameters);
}

}  // namespace slambench
