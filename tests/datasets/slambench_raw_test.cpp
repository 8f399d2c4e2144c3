// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "datasets/slambench_raw.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>

#include "core/error.h"
#include "datasets/sample_images.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::HasSubstr;
using testing::message_of;
using testing::raw_frame;
using testing::sample_color;
using testing::sample_depth;
using testing::TemporaryFolder;

constexpr Size size = {4, 3};
constexpr std::size_t light_bytes = 8 + 2 * 12;
constexpr std::size_t full_bytes = light_bytes + 8 + 3 * 12;

std::string raw_file(int frames, bool with_color) {
  std::string bytes;
  for (int i = 0; i < frames; ++i) bytes += raw_frame(size, i, with_color);
  return bytes;
}

/// The message for a file of these bytes, without the file's folder.
std::string error_of(const std::string& bytes) {
  const TemporaryFolder folder;
  const std::string file = folder.write("s.raw", bytes);
  const std::string message = message_of<InputError>([&] { open_source(file, {}); });
  EXPECT_THAT(message, HasSubstr(file));
  return message.substr(message.find("s.raw"));
}

TEST(SlambenchRaw, ReadsDepthAndColor) {
  const TemporaryFolder folder;
  const auto source = open_source(folder.write("kt2.raw", raw_file(3, true)), {});
  const SequenceInfo& info = source->info();
  EXPECT_EQ(info.layout, "slambench-raw");
  EXPECT_EQ(info.name, "kt2");
  EXPECT_EQ(info.path, folder.path("kt2.raw"));
  EXPECT_EQ(info.frame_count, 3);
  EXPECT_EQ(info.depth_size, size);
  EXPECT_EQ(info.units_per_m, 1000);
  EXPECT_TRUE(info.has_color);
  EXPECT_TRUE(info.ground_truth.empty());
  EXPECT_TRUE(info.own_from_camera.isIdentity());
  Frame frame;
  for (const int i : {2, 0, 1}) {
    source->read(i, frame);
    EXPECT_EQ(frame.index, i);
    EXPECT_EQ(source->time_s(i), frame.time_s);
    EXPECT_EQ(frame.time_s, i);
    EXPECT_EQ(frame.depth, sample_depth(size, i));
    EXPECT_TRUE(frame.color.empty());
  }
  source->set_color(true);
  source->read(1, frame);
  EXPECT_EQ(frame.color, sample_color(size, 1));
  source->set_color(false);
  source->read(1, frame);
  EXPECT_TRUE(frame.color.empty());
  EXPECT_THROW(source->read(3, frame), std::out_of_range);
  EXPECT_THROW(source->read(-1, frame), std::out_of_range);
}

TEST(SlambenchRaw, ReadsTheLightVariantOfAnyLength) {
  const TemporaryFolder folder;
  for (int frames = 1; frames <= 20; ++frames) {
    const auto source = open_source(folder.write("s.raw", raw_file(frames, false)), {});
    EXPECT_EQ(source->info().frame_count, frames);
    EXPECT_FALSE(source->info().has_color);
    source->set_color(true);
    Frame frame;
    source->read(frames - 1, frame);
    EXPECT_EQ(frame.depth, sample_depth(size, frames - 1));
    EXPECT_TRUE(frame.color.empty());
  }
}

TEST(SlambenchRaw, TellsFullFromLightAtEveryLength) {
  const TemporaryFolder folder;
  for (int frames = 1; frames <= 20; ++frames) {  // 8 full frames are as long as 19 light ones
    const auto source = open_source(folder.write("s.raw", raw_file(frames, true)), {});
    EXPECT_EQ(source->info().frame_count, frames);
    EXPECT_TRUE(source->info().has_color);
  }
}

TEST(SlambenchRaw, EveryTruncationIsNoticed) {
  const TemporaryFolder folder;
  for (const bool with_color : {true, false}) {
    const std::string bytes = raw_file(3, with_color);
    const std::size_t frame_bytes = with_color ? full_bytes : light_bytes;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      const std::string file = folder.write("s.raw", std::string_view(bytes).substr(0, length));
      // What is left of these lengths is whole in the other variant: nothing can tell.
      const bool other =
          with_color ? length == light_bytes || length == 2 * light_bytes : length == full_bytes;
      if (length > 0 && (length % frame_bytes == 0 || other)) {
        const std::size_t whole = with_color == other ? light_bytes : full_bytes;
        EXPECT_EQ(open_source(file, {})->info().frame_count, static_cast<int>(length / whole))
            << length;
      } else {
        EXPECT_THROW(open_source(file, {}), InputError) << with_color << " " << length;
      }
    }
  }
}

TEST(SlambenchRaw, SaysWhereItIsTruncated) {
  EXPECT_EQ(error_of(""), "s.raw: the file is empty, expected frames");
  EXPECT_EQ(error_of("1234567"),
            "s.raw: frame 0 at byte 0: found 7 bytes to the end, expected a header of 8 bytes (the "
            "file is truncated)");
  EXPECT_EQ(error_of(raw_file(3, true).substr(0, 3 * full_bytes - 1)),
            "s.raw: frame 2 at byte 152: found 75 bytes to the end, expected 76 bytes (the file is "
            "truncated)");
  EXPECT_EQ(error_of(raw_file(3, false).substr(0, 2 * light_bytes + 5)),
            "s.raw: frame 2 at byte 64: found 5 bytes to the end, expected 32 bytes (the file is "
            "truncated)");
}

TEST(SlambenchRaw, RejectsAFrameOfAnotherSize) {
  std::string bytes = raw_file(4, true);
  bytes[2 * full_bytes] = 5;
  EXPECT_EQ(error_of(bytes),
            "s.raw: frame 2 at byte 152: found size 5x3, expected 4x3 as in the first frame");
  bytes = raw_file(4, true);
  bytes[2 * full_bytes + light_bytes + 4] = 9;
  EXPECT_EQ(error_of(bytes),
            "s.raw: frame 2 at byte 184: found size 4x9, expected 4x3 as in the first frame");
}

TEST(SlambenchRaw, RejectsAFrameOfAnotherSizeFarFromBothEndsWhenItIsRead) {
  std::string bytes = raw_file(100, true);
  bytes[50 * full_bytes] = 5;
  const TemporaryFolder folder;
  const auto source = open_source(folder.write("s.raw", bytes), {});
  ASSERT_EQ(source->info().frame_count, 100);
  Frame frame;
  EXPECT_NO_THROW(source->read(49, frame));
  EXPECT_EQ(message_of<InputError>([&] { source->read(50, frame); }),
            folder.path("s.raw") +
                ": frame 50 at byte 3800: found size 5x3, expected 4x3 as in the first frame");
}

TEST(SlambenchRaw, ThatIsShortenedWhileItIsReadIsBadInput) {
  const TemporaryFolder folder;
  const std::string path = folder.write("s.raw", raw_file(100, true));
  const auto source = open_source(path, {});
  Frame frame;
  source->read(99, frame);
  std::filesystem::resize_file(path, 50 * full_bytes + 20);
  EXPECT_NO_THROW(source->read(49, frame));
  for (const int i : {50, 51, 99}) {
    EXPECT_EQ(message_of<InputError>([&] { source->read(i, frame); }),
              path + ": cannot read: it has 3820 bytes, and had 7600 when it was opened");
  }
}

TEST(SlambenchRaw, RejectsGarbage) {
  EXPECT_EQ(error_of("# this is a text file, not a sequence of frames"),
            "s.raw: frame 0 at byte 0: found no width and height from 1 to 16384, expected a frame "
            "of SLAMBench 1 (u32 width, u32 height, depth)");
  EXPECT_THAT(error_of(std::string(100, '\0')), HasSubstr("frame 0 at byte 0"));
}

TEST(SlambenchRaw, IsKnownByItsHeaderWhateverItsName) {
  const TemporaryFolder folder;
  EXPECT_TRUE(is_slambench_raw(folder.write("frames.bin", raw_file(1, true))));
  EXPECT_FALSE(is_slambench_raw(folder.write("text", "# stamp file")));
  EXPECT_FALSE(is_slambench_raw(folder.write("short", "1234")));
  EXPECT_FALSE(is_slambench_raw(folder.path()));
}

TEST(SlambenchRaw, ReadsBeyondFourGibibytes) {
  constexpr Size kinect = {640, 480};
  constexpr std::int64_t bytes = 8 + 2 * 307200 + 8 + 3 * 307200;
  constexpr int frames = 2900;
  static_assert(bytes * (frames - 50) > std::int64_t{1} << 32);
  const TemporaryFolder folder;
  const std::string path = folder.path("large.raw");
  {  // a file with holes: only what is read takes space
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT, 0600);
    ASSERT_GE(file, 0);
    const std::uint32_t header[] = {640, 480};
    for (int i = 0; i < frames; ++i) {
      if (i >= 32 && i < frames - 60) continue;
      const std::int64_t at = i * bytes;
      ASSERT_EQ(::pwrite(file, header, 8, at), 8);
      ASSERT_EQ(::pwrite(file, header, 8, at + 8 + 2 * 307200), 8);
    }
    const std::uint16_t pixel = 4242;
    ASSERT_EQ(::pwrite(file, &pixel, 2, (frames - 50) * bytes + 8 + 2 * 5), 2);
    ASSERT_EQ(::ftruncate(file, frames * bytes), 0);
    ::close(file);
  }
  const auto source = open_source(path, {});
  EXPECT_EQ(source->info().frame_count, frames);
  EXPECT_EQ(source->info().camera, (Intrinsics{531.15F, 531.15F, 320, 240}));
  Frame frame;
  source->read(frames - 50, frame);
  EXPECT_EQ(frame.depth.size(), kinect);
  EXPECT_EQ(frame.depth(5, 0), 4242);
  EXPECT_EQ(frame.depth(4, 0), 0);
}

TEST(SlambenchRaw, JudgedByIclNuimGroundTruthItHasItsAxes) {
  const TemporaryFolder folder;
  const std::string file = folder.write("s.raw", raw_file(3, false));
  SourceParameters parameters;
  parameters.ground_truth =
      folder.write("livingRoom2.gt.freiburg", "1 0 0 -2.25 0 0 0 1\n2 0 0 -2.2 0 0 0 1\n");
  const auto source = open_source(file, parameters);
  const SequenceInfo& info = source->info();
  EXPECT_EQ(info.ground_truth.size(), 2u);
  EXPECT_EQ(info.frames_with_ground_truth, 2);
  EXPECT_EQ(info.own_from_camera, Eigen::Vector3d(1, -1, 1).asDiagonal().toDenseMatrix());
  EXPECT_THAT(info.suggested,
              ::testing::Contains(std::pair<std::string, std::string>("volume-size", "4.8")));
}

}  // namespace
}  // namespace slambench
