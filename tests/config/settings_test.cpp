// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "config/settings.h"

#include <gmock/gmock.h>

#include <functional>

#include "backends/registry.h"
#include "config/nearest.h"
#include "core/error.h"
#include "datasets/source.h"
#include "runner/runner.h"
#include "slam/kinect_fusion.h"

namespace slambench {
namespace {

using testing::HasSubstr;

template <class E>
std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const E& error) {
    return error.what();
  }
  return "(nothing was thrown)";
}

class SettingsTest : public testing::Test {
 protected:
  KinectFusionParameters fusion_;
  BackendOptions backend_;
  Settings settings_{{fusion_.describe(), backend_.describe()}};

  ConfigFile parse(std::string_view text) {
    return parse_config(text, "a.toml", settings_.lists());
  }
  std::string input_error(std::string_view text) {
    return message_of<InputError>([&] { parse(text); });
  }
};

TEST_F(SettingsTest, TheStrongestOriginWinsInAnyOrder) {
  settings_.set("mu", "0.2", Origin::command_line, "command line");
  settings_.apply(parse("[kinectfusion]\nmu = 0.3\nnear = 0.5\n"));
  settings_.apply(Preset{"p", "", {{"mu", "0.4"}, {"near", "0.6"}, {"far", "5"}}});
  settings_.suggest({{"mu", "0.7"}, {"near", "0.8"}, {"far", "6"}, {"volume-size", "4.8"}});

  EXPECT_EQ(fusion_.mu_m, 0.2);
  EXPECT_EQ(fusion_.near_m, 0.5);
  EXPECT_EQ(fusion_.far_m, 5);
  EXPECT_EQ(fusion_.volume_size_m[2], 4.8);
  EXPECT_EQ(settings_.set_by("mu"), "command line");
  EXPECT_EQ(settings_.set_by("near"), "file a.toml");
  EXPECT_EQ(settings_.set_by("far"), "preset p");
  EXPECT_EQ(settings_.set_by("volume-size"), "sequence");
  EXPECT_EQ(settings_.set_by("ambient"), "default");
}

TEST_F(SettingsTest, EveryParameterIsRecorded) {
  settings_.set("compute-size-ratio", "2", Origin::command_line, "command line");
  const auto used = settings_.used();
  ASSERT_EQ(used.size(), settings_.lists()[0].parameters.size() + 3);
  EXPECT_EQ(used[1].group, "kinectfusion");
  EXPECT_EQ(used[1].name, "compute-size-ratio");
  EXPECT_EQ(used[1].value, "2");
  EXPECT_EQ(used[1].set_by, "command line");
  EXPECT_EQ(used[5].name, "mu");
  EXPECT_EQ(used[5].unit, "m");
  EXPECT_EQ(used.back().group, "backend");
  EXPECT_EQ(used.back().set_by, "default");
}

TEST_F(SettingsTest, AnUnknownNameIsAUsageError) {
  EXPECT_EQ(
      message_of<UsageError>([&] { settings_.set("volume-sise", "1", Origin::command_line, ""); }),
      "unknown parameter 'volume-sise'; did you mean 'volume-size'?");
}

TEST_F(SettingsTest, EveryTypeIsReadFromAFile) {
  const ConfigFile file = parse(R"(
sequence = "living-room/2"
preset = "slambench1"
[kinectfusion]
map = "grid"
compute-size-ratio = 4
mu = 1
volume-size = 4.8
volume-resolution = [64, 128, 256]
init-pose = [0.25, 0.5, 0]
pyramid-levels = [4, 3]
)");
  EXPECT_EQ(file.sequence, "living-room/2");
  EXPECT_EQ(file.preset, "slambench1");
  EXPECT_EQ(fusion_.compute_size_ratio, 1) << "reading must not set";
  settings_.apply(file);
  EXPECT_EQ(fusion_.compute_size_ratio, 4);
  EXPECT_EQ(fusion_.mu_m, 1);
  EXPECT_EQ(fusion_.volume_size_m, (std::array<double, 3>{4.8, 4.8, 4.8}));
  EXPECT_EQ(fusion_.volume_resolution, (std::array<int, 3>{64, 128, 256}));
  EXPECT_EQ(fusion_.init_pose, (std::array<double, 3>{0.25, 0.5, 0}));
  EXPECT_EQ(fusion_.pyramid_levels, (std::vector<int>{4, 3}));
}

TEST_F(SettingsTest, WhatAFileGetsWrongIsNamedWithItsLine) {
  EXPECT_EQ(input_error("[kinectfusion]\nmu-m = 0.1\n"),
            "a.toml:2: unknown key 'mu-m' in [kinectfusion]; did you mean 'mu'?");
  EXPECT_EQ(input_error("\n[kinectfussion]\n"),
            "a.toml:2: unknown table 'kinectfussion'; did you mean 'kinectfusion'?");
  EXPECT_EQ(input_error("prset = \"fast\"\n"),
            "a.toml:1: unknown key 'prset'; did you mean 'preset'?");
  EXPECT_EQ(input_error("preset = 1\n"), "a.toml:1: preset: found 1, expected text");
  EXPECT_EQ(input_error("kinectfusion = 1\n"), "a.toml:1: kinectfusion: found 1, expected a table");
  EXPECT_EQ(input_error("[kinectfusion]\n\nmu = \"0.1\"\n"),
            "a.toml:3: mu: found '0.1', expected a number in [0.0001, 10] m");
  EXPECT_EQ(input_error("[kinectfusion]\nmu = nan\n"),
            "a.toml:2: mu: found nan, expected a number in [0.0001, 10] m");
  EXPECT_EQ(input_error("[kinectfusion]\nmu = [0.1]\n"),
            "a.toml:2: mu: found [0.1], expected a number in [0.0001, 10] m");
  EXPECT_EQ(input_error("[kinectfusion]\ncompute-size-ratio = 2.5\n"),
            "a.toml:2: compute-size-ratio: found 2.5, expected an integer in [1, 8]");
  EXPECT_EQ(input_error("[kinectfusion]\ncompute-size-ratio = 99999999999999\n"),
            "a.toml:2: compute-size-ratio: found 99999999999999, expected an integer in [1, 8]");
  EXPECT_EQ(input_error("[kinectfusion]\nvolume-size = [1, 2]\n"),
            "a.toml:2: volume-size: found [1,2], expected one or three numbers in [0.01, 1000] m");
  EXPECT_EQ(
      input_error("[kinectfusion]\npyramid-levels = []\n"),
      "a.toml:2: pyramid-levels: found [], expected integers in [0, 1000], separated by commas");
  EXPECT_EQ(input_error("[kinectfusion]\nmap = \"octree\"\n"),
            "a.toml:2: map: found 'octree', expected one of auto, grid, bricks");
  EXPECT_EQ(input_error("[kinectfusion]\nmu = 1979-05-27\n"),
            "a.toml:2: mu: found a date or time, expected a number in [0.0001, 10] m");
  EXPECT_THAT(input_error("[kinectfusion]\nmu = 0.1\nmu = 0.2\n"), HasSubstr("a.toml:3: not TOML"));
  EXPECT_THAT(input_error("[kinectfusion\n"), HasSubstr("a.toml:1: not TOML"));
  EXPECT_THAT(input_error(std::string_view("\0\xff", 2)), HasSubstr("a.toml:1: not TOML"));
  const std::string nul = "found text with a NUL character, expected text without";
  EXPECT_EQ(input_error("\nsequence = \"a\\u0000b\"\n"), "a.toml:2: " + nul);
  EXPECT_EQ(input_error("[kinectfusion]\nmap = \"grid\\u0000\"\n"), "a.toml:2: " + nul);
  EXPECT_EQ(input_error("[kinectfusion]\nvolume-size = [\"\\u0000\"]\n"), "a.toml:2: " + nul);
}

TEST_F(SettingsTest, AMissingFileIsNamed) {
  EXPECT_THAT(
      message_of<InputError>([&] { read_config_file("/nowhere/a.toml", settings_.lists()); }),
      HasSubstr("/nowhere/a.toml"));
}

TEST_F(SettingsTest, EveryPresetFitsTheParameters) {
  SourceParameters source;
  RunParameters run;
  Settings settings({fusion_.describe(), backend_.describe(), source.describe(), run.describe()});
  for (const Preset& preset : preset_table()) {
    EXPECT_NO_THROW(settings.apply(preset)) << preset.name;
    EXPECT_FALSE(preset.sentence.empty());
    EXPECT_EQ(find_preset(preset.name).name, preset.name);
  }
  EXPECT_NO_THROW(find_preset(default_preset));
  EXPECT_EQ(message_of<UsageError>([] { find_preset("slambench"); }),
            "--preset: found 'slambench', expected one of fast, slambench1; "
            "did you mean 'slambench1'?");
}

/// The published values where the defaults differ from them (SLAMBench 1: the light is at
/// (1, 1, -1) of the volume, the map is flat, every kernel runs on its own).
TEST_F(SettingsTest, Slambench1IsAsPublished) {
  SourceParameters source;
  RunParameters run;
  Settings settings({fusion_.describe(), backend_.describe(), source.describe(), run.describe()});
  settings.apply(find_preset("slambench1"));
  EXPECT_EQ(fusion_.light_m, (std::array<double, 3>{1, 1, -1}));
  EXPECT_EQ(fusion_.light_frame, "volume");
  EXPECT_EQ(fusion_.map, "grid");
  EXPECT_FALSE(fusion_.fused);
  EXPECT_EQ(source.icl_nuim_camera, "slambench1");
  EXPECT_EQ(run.prefetch, "off") << "reading counts as acquiring on every machine";
}

TEST(Nearest, FindsWhatWasMeant) {
  const std::vector<std::string_view> known = {"frames", "far", "near", "volume-size"};
  EXPECT_EQ(nearest("frame", known), "frames");
  EXPECT_EQ(nearest("volumesize", known), "volume-size");
  EXPECT_EQ(nearest("neer", known), "near");
  EXPECT_EQ(nearest("something-else", known), "");
  EXPECT_EQ(nearest("", known), "");
  EXPECT_EQ(nearest(std::string(1000000, 'x'), known), "");
  EXPECT_EQ(suggestion("frame", known, "--"), "; did you mean '--frames'?");
  EXPECT_EQ(suggestion("zzz", known), "");
}

}  // namespace
}  // namespace slambench
