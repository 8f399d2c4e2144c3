// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// What the backend does besides computing: devices, times, the cache of programs, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "backends/opencl/opencl.h"
#include "backends/registry.h"
#include "core/error.h"
#include "io/files.h"
#include "meters/frame_timer.h"
#include "slam/kinect_fusion.h"
#include "support/device_images.h"
#include "support/environment.h"
#include "support/program.h"
#include "support/temporary_folder.h"
#include "verify/recording.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Opencl : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string reason = opencl_obstacle();
    if (!reason.empty()) GTEST_SKIP() << reason;
  }
};

/// PoCL 6.0 (Debian 13) says of every kernel that it needs none.
bool tells_local_memory() {
  const std::string device = opencl_devices()[0];
  return device.find("Portable Computing Language") == std::string::npos ||
         device.find("driver 3.") != std::string::npos;
}

/// Writes down what it is told.
class Journal final : public Observer {
 public:
  void stage_begin(Stage) override {}
  void stage_end(Stage) override {}
  void in_one_go_begin() override {}
  void in_one_go_end() override {}
  void kernel_begin(Kernel kernel) override { begun.push_back(kernel); }
  void kernel_end(Kernel) override {}
  void kernel_measured(Kernel kernel, double seconds) override {
    measured.push_back(kernel);
    least_s = std::min(least_s, seconds);
  }
  void transfer_measured(Transfer direction, std::size_t bytes, double seconds) override {
    transfers.emplace_back(direction, bytes);
    least_s = std::min(least_s, seconds);
  }
  std::vector<Kernel> begun, measured;
  std::vector<std::pair<Transfer, std::size_t>> transfers;
  double least_s = 1;
};

TEST_F(Opencl, ReportsEachCallOnceWhenItsTimeIsKnown) {
  const auto backend = make_opencl_backend(0, {});
  Journal journal;
  backend->observe(&journal);
  const Size size{33, 9};
  auto depth = testing::uploaded(*backend, Image<float>(size, 1.5f));
  auto vertices = backend->make_image<Float3>(size), normals = backend->make_image<Float3>(size);
  Volume volume = backend->make_volume(MapKind::bricks, {16, 16, 16}, {2, 2, 2});
  backend->depth2vertex(vertices, depth, {30, 30, 16, 4});
  backend->integrate(volume, depth, {{}, {30, 30, 16, 4}, 0.1f, 100, 0.0001f});
  backend->raycast(vertices, normals, volume, {{}, {30, 30, 16, 4}, 0.4f, 4, 0.1f, 0.05f, 0.8f});
  EXPECT_THAT(journal.measured, ::testing::IsEmpty());
  backend->finish();
  EXPECT_THAT(journal.begun, ::testing::IsEmpty());
  EXPECT_THAT(journal.measured, ::testing::ElementsAre(Kernel::init_volume, Kernel::depth2vertex,
                                                       Kernel::integrate, Kernel::raycast));
  EXPECT_GT(journal.least_s, 0);
}

TEST_F(Opencl, ReportsEachTransferOnceWhenItsTimeIsKnown) {
  const auto backend = make_opencl_backend(0, {});
  const Image<float> image({33, 9}, 1.5f);
  testing::uploaded(*backend, image);  // nobody listens
  Journal journal;
  backend->observe(&journal);
  auto depth = testing::uploaded(*backend, image);
  auto half = backend->make_image<float>({16, 4});
  backend->half_sample(half, depth, 0.1f);
  testing::downloaded(*backend, half);
  EXPECT_THAT(journal.transfers, ::testing::IsEmpty());
  backend->finish();
  backend->finish();
  EXPECT_THAT(journal.transfers,
              ::testing::ElementsAre(std::pair(Transfer::to_device, image.bytes()),
                                     std::pair(Transfer::to_host, 16 * 4 * sizeof(float))));
  EXPECT_GT(journal.least_s, 0);
}

/// The depth image goes up; sums of each iteration and the count of bricks come back; pictures that
/// somebody looks at between two frames are no frame's.
TEST_F(Opencl, TransfersOfAFrameAreItsOwn) {
  const auto backend = make_opencl_backend(0, {});
  FrameTimer timer(steady_clock());
  backend->observe(&timer);
  const Recording recording = synthetic_recording({80, 60}, 6);
  KinectFusionParameters parameters = recording.parameters;
  parameters.map = "bricks";
  KinectFusion system(*backend, parameters, {80, 60}, recording.camera, recording.units_per_m,
                      &timer);
  timer.take();
  int aligned = 0;
  for (const Frame& frame : recording.frames) {
    const FrameResult result = system.process(frame);
    system.render();
    const auto [to_device, to_host] = timer.take().transfers;
    const int iterations = std::accumulate(result.iterations.begin(), result.iterations.end(), 0);
    aligned += iterations > 0 ? 1 : 0;
    EXPECT_EQ(to_device.bytes, frame.depth.bytes());
    EXPECT_EQ(to_device.count, 1);
    EXPECT_EQ(to_host.count, iterations + (result.integrated ? 1 : 0));
    EXPECT_EQ(to_host.bytes,
              128u * static_cast<unsigned>(iterations) + (result.integrated ? 12u : 0u));
    EXPECT_GT(to_device.seconds, 0);
    system.pictures();
    EXPECT_EQ(timer.take().transfers[1].count, 0);
  }
  EXPECT_GT(aligned, 0);
}

TEST_F(Opencl, BricksGrowWithWhatIsSeen) {
  const auto backend = make_opencl_backend(0, {});
  Volume volume = backend->make_volume(MapKind::bricks, {128, 128, 128}, {4, 4, 4});
  const std::size_t empty = backend->volume_bytes(volume);
  const Size size{64, 48};
  auto depth = testing::uploaded(*backend, Image<float>(size, 2.0f));
  backend->integrate(volume, depth, {{}, {60, 60, 32, 24}, 0.1f, 100, 0.0001f});
  EXPECT_GT(backend->volume_bytes(volume), empty);
  EXPECT_LT(backend->volume_bytes(volume), std::size_t{128 * 128 * 128 * 4});
}

/// What was seen is drawn as it is, and only what was not is looked for.
TEST_F(Opencl, DrawsWhatWasSeen) {
  const auto backend = make_opencl_backend(0, {});
  const Size size{21, 9};
  const Intrinsics camera{20, 20, 10, 4};
  Volume volume = backend->make_volume(MapKind::bricks, {64, 64, 64}, {2, 2, 2});
  const Rigid3f from_before{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
  const Rigid3f to_camera{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, 0}};
  auto wall = testing::uploaded(*backend, Image<float>(size, 1.2f));
  backend->integrate(volume, wall, {to_camera, camera, 0.1f, 100, 0.0001f});
  const RaycastParameters view{from_before, camera, 0.4f, 1.1f, 0.075f, 0.03f, 0.8f};
  RaycastParameters farther = view;
  farther.far_m = 1.9f;
  Image<Float3> points(size, {1, 1, 1}), towards_light(size, {0, 0, -1});
  points(14, 6) = {};
  towards_light(14, 6) = {-2, 0, 0};
  const auto vertices = testing::uploaded(*backend, points);
  const auto normals = testing::uploaded(*backend, towards_light);
  const SeenSurface seen{&vertices, &normals, view};
  auto picture = backend->make_image<Rgba8>(size);
  const auto drawn = [&](const RaycastParameters& as, const SeenSurface* from) {
    backend->render_volume(picture, volume, as, {{1, 1, 0}, 0}, from);
    return testing::downloaded(*backend, picture);
  };
  Image<Rgba8> expected(size, {255, 255, 255, 255});
  expected(14, 6) = {0, 0, 0, 255};
  EXPECT_EQ(drawn(view, &seen), expected);
  expected(14, 6) = drawn(farther, nullptr)(14, 6);
  EXPECT_GT(expected(14, 6).r, 0);
  EXPECT_EQ(drawn(farther, &seen), expected);
}

TEST_F(Opencl, FindsDevicesByIndexAndByAPartOfTheirText) {
  const std::vector<std::string> devices = opencl_devices();
  ASSERT_FALSE(devices.empty());
  const std::string name = make_opencl_backend(0, {})->device();
  EXPECT_THAT(devices[0], ::testing::StartsWith(name));
  BackendOptions options;
  for (const std::string& wanted : {std::string("0"), name.substr(2, 6)}) {
    options.device = wanted;
    EXPECT_EQ(create_backend("opencl", options)->device(), name);
  }
  for (const std::string& wanted : {std::to_string(devices.size()), std::string("abacus")}) {
    options.device = wanted;
    EXPECT_THAT(testing::message_of<UsageError>([&] { create_backend("opencl", options); }),
                AllOf(HasSubstr("--device: found '" + wanted + "'"), HasSubstr(name)));
  }
  EXPECT_THROW(make_opencl_backend(static_cast<int>(devices.size()), {}), UnavailableError);
}

TEST_F(Opencl, ABuildThatFailsShowsTheLog) {
  OpenclParameters parameters;
  parameters.build_options = "-Dhalf_sample=5";
  const auto backend = make_opencl_backend(0, parameters);
  auto depth = backend->make_image<float>({8, 8}), half = backend->make_image<float>({4, 4});
  EXPECT_THAT(testing::message_of<Error>([&] { backend->half_sample(half, depth, 0.1f); }),
              AllOf(HasSubstr("half_sample.cl does not build"), HasSubstr("-Dhalf_sample=5"),
                    HasSubstr("error:")));
}

/// Sets a parameter as a user does.
void set(OpenclParameters* parameters, const char* name, const char* text) {
  const std::vector<ParameterList> lists = {parameters->describe()};
  set_from_text(*find(lists, name), text);
}

TEST_F(Opencl, BuildOptionsOfAKernelAreItsAlone) {
  OpenclParameters parameters;
  set(&parameters, "opencl-half-sample-options", "-DRowPacket=5");
  const auto backend = make_opencl_backend(0, parameters);
  auto depth = backend->make_image<float>({8, 8}), half = backend->make_image<float>({4, 4});
  auto vertices = backend->make_image<Float3>({8, 8});
  EXPECT_NO_THROW(backend->depth2vertex(vertices, depth, {8, 8, 4, 4}));
  EXPECT_THAT(testing::message_of<Error>([&] { backend->half_sample(half, depth, 0.1f); }),
              AllOf(HasSubstr("half_sample.cl does not build"), HasSubstr("-DRowPacket=5")));
}

/// Makes an array of arrays of the local memory of start_depths.
constexpr char too_much_local_memory[] = "-Down_tiles=own_tiles[25000]";

TEST_F(Opencl, AKernelOverTheLocalMemoryIsUnavailable) {
  if (!tells_local_memory()) GTEST_SKIP() << "PoCL does not tell what a kernel needs";
  OpenclParameters parameters;
  parameters.build_options = too_much_local_memory;
  const auto backend = make_opencl_backend(0, parameters);
  auto vertices = backend->make_image<Float3>({8, 8}),
       normals = backend->make_image<Float3>({8, 8});
  const Volume volume = backend->make_volume(MapKind::bricks, {8, 8, 8}, {1, 1, 1});
  EXPECT_THAT(
      testing::message_of<UnavailableError>([&] {
        backend->raycast(vertices, normals, volume, {{}, {8, 8, 4, 4}, 0.4f, 4, 0.1f, 0.05f, 0.8f});
      }),
      AllOf(HasSubstr("start_depths"), HasSubstr("bytes of local memory")));
}

TEST_F(Opencl, MemoryThatTheDeviceDoesNotHaveIsUnavailable) {
  const auto backend = make_opencl_backend(0, {});
  EXPECT_THAT(testing::message_of<UnavailableError>([&] {
                backend->make_image<Float3>({1 << 20, 1 << 20});
              }),
              HasSubstr("MiB, expected at most"));
  EXPECT_THROW(backend->make_volume(MapKind::grid, {4096, 4096, 4096}, {1, 1, 1}),
               UnavailableError);
}

/// What half_sample makes of 2.5 everywhere, with the programs kept in a folder of the test's own.
/// Set when the driver has been asked for devices: PoCL then has its own cache where it was, not in
/// the folder of the first test that runs.
class OpenclCache : public Opencl {
 protected:
  void SetUp() override {
    Opencl::SetUp();
    cache_.emplace("XDG_CACHE_HOME", folder_.path().c_str());
  }
  static void expect_right(const OpenclParameters& parameters) {
    const auto backend = make_opencl_backend(0, parameters);
    auto half = backend->make_image<float>({4, 4});
    backend->half_sample(half, testing::uploaded(*backend, Image<float>({8, 8}, 2.5f)), 0.1f);
    EXPECT_EQ(testing::downloaded(*backend, half), Image<float>({4, 4}, 2.5f));
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_.path("slambench/opencl"))) {
      files.push_back(entry.path());
    }
    return files;
  }

  testing::TemporaryFolder folder_;
  std::optional<testing::Environment> cache_;
};

TEST_F(OpenclCache, KeepsAProgram) {
  expect_right({});
  ASSERT_EQ(files().size(), 1U);
  const fs::file_time_type written = fs::last_write_time(files()[0]);
  expect_right({});
  ASSERT_EQ(files().size(), 1U);
  EXPECT_EQ(fs::last_write_time(files()[0]), written);
}

TEST_F(OpenclCache, BuildsADamagedProgramAnew) {
  expect_right({});
  ASSERT_EQ(files().size(), 1U);
  const std::string file = "slambench/opencl/" + files()[0].filename().string();
  const std::string whole = read_file(folder_.path(file));
  std::string flipped = whole;
  flipped[whole.size() / 2] ^= 1;
  constexpr std::size_t header_bytes = 24;
  for (const std::string& damaged :
       {std::string(), std::string("no program"), whole.substr(0, header_bytes),
        whole.substr(0, whole.size() / 2), whole.substr(0, whole.size() - 1),
        whole.substr(header_bytes), flipped, whole + "more"}) {
    folder_.write(file, damaged);
    expect_right({});
    EXPECT_NE(read_file(folder_.path(file)), damaged);
  }
}

TEST_F(OpenclCache, TellsProgramsOfOtherBuildOptionsApart) {
  expect_right({});
  OpenclParameters parameters;
  set(&parameters, "opencl-half-sample-options", "-DA=1");
  expect_right(parameters);
  EXPECT_EQ(files().size(), 2U);
  set(&parameters, "opencl-half-sample-options", "");
  set(&parameters, "opencl-depth2vertex-options", "-DA=1");
  expect_right(parameters);
  EXPECT_EQ(files().size(), 2U);
}

TEST_F(Opencl, NeedsNoHome) {
  const testing::Environment no_cache("XDG_CACHE_HOME", nullptr), no_home("HOME", nullptr);
  const auto backend = make_opencl_backend(0, {});
  auto half = backend->make_image<float>({4, 4});
  backend->half_sample(half, testing::uploaded(*backend, Image<float>({8, 8}, 2.5f)), 0.1f);
  EXPECT_EQ(testing::downloaded(*backend, half), Image<float>({4, 4}, 2.5f));
}

TEST_F(Opencl, RefusesALayoutBeforeAnyKernelIsAskedFor) {
  BackendOptions options;
  options.opencl.layouts.back() = {3, 1, 1};
  EXPECT_THAT(testing::message_of<UsageError>([&] { create_backend("opencl", options); }),
              HasSubstr("expected a group of a power of two"));
}

/// The program where the loader finds no platform.
TEST(OpenclWithoutPlatform, IsUnavailableAndSaysWhatWouldHelp) {
  testing::Program program(SLAMBENCH_PROGRAM);
  program.set_environment("OCL_ICD_VENDORS", program.folder().path("none"));
  program.set_environment("OCL_ICD_FILENAMES", "");
  const testing::Outcome run = program.run({"run", "living-room/2", "--backend", "opencl"});
  EXPECT_EQ(run.status, 4) << run.err;
  EXPECT_THAT(run.err, AllOf(HasSubstr("backend opencl: unavailable"), HasSubstr("install")));
  const testing::Outcome list = program.run({"list"});
  EXPECT_EQ(list.status, 0);
  EXPECT_THAT(list.out, HasSubstr("unavailable"));
}

struct ErrorCase {
  const char* name;
  std::vector<std::string> arguments;
  int status;
  std::vector<const char*> words;
};

void PrintTo(const ErrorCase& error, std::ostream* os) { *os << error.name; }

class OpenclError : public ::testing::TestWithParam<ErrorCase> {};

/// On the command line.
TEST_P(OpenclError, HasItsStatusAndSaysWhy) {
  if (const std::string reason = opencl_obstacle(); !reason.empty()) GTEST_SKIP() << reason;
  testing::Program program(SLAMBENCH_PROGRAM);
  program.set_environment("POCL_MEMORY_LIMIT", "1");  // GiB; a buffer may have a quarter of it
  // LeakSanitizer itself can crash on PoCL's threads when a run ends like this.
  program.set_environment("ASAN_OPTIONS", "detect_leaks=0");
  std::vector<std::string> arguments = {
      "run", "living-room/2", "--backend", "opencl", "--frames", "6", "-c", "8", "-v", "32", "-q"};
  const ErrorCase& error = GetParam();
  if (error.name == std::string("LocalMemory") && !tells_local_memory()) GTEST_SKIP();
  arguments.insert(arguments.end(), error.arguments.begin(), error.arguments.end());
  const testing::Outcome outcome = program.run(arguments);
  EXPECT_EQ(outcome.status, error.status) << outcome.err;
  for (const char* word : error.words) EXPECT_THAT(outcome.err, HasSubstr(word));
}

INSTANTIATE_TEST_SUITE_P(
    All, OpenclError,
    ::testing::Values(
        ErrorCase{"NoSuchIndex", {"--device", "99"}, 2, {"--device: found '99'", "(0: "}},
        ErrorCase{"NoSuchName", {"--device", "abacus"}, 2, {"--device: found 'abacus'", "(0: "}},
        ErrorCase{"NoSuchLayout",
                  {"--opencl-raycast", "3,1,1"},
                  2,
                  {"--opencl-raycast: found 3,1,1", "a power of two"}},
        ErrorCase{"LayoutOfOneNumber",
                  {"--opencl-raycast", "64"},
                  2,
                  {"--opencl-raycast: found '64', expected three integers"}},
        ErrorCase{"NoLayout",
                  {"--opencl-raycast"},
                  2,
                  {"--opencl-raycast: 1 required GROUP,LANES,PACKETS missing"}},
        ErrorCase{"LayoutWithoutEffect",
                  {"--opencl-start-depths", "64,8,1"},
                  2,
                  {"--opencl-start-depths: found 64,8,1, expected a group", "lanes of 1\n"}},
        ErrorCase{"BuildFailure",
                  {"--opencl-build-options=-Dhalf_sample=5"},
                  1,
                  {"half_sample.cl does not build on", "the compiler says:\n  ", "error: "}},
        ErrorCase{
            "BuildFailureOfOneKernel",
            {"--opencl-track-options=-DRowPacket=5", "--opencl-align-options=-DRowPacket=5"},
            1,
            {"align.cl does not build on", "-DRowPacket=5 -DGROUP=", "; the compiler says:\n  "}},
        ErrorCase{
            "NoSuchBuildOption",
            {"--opencl-build-options=-no-such-option"},
            2,
            {".cl does not build on", "-no-such-option -DGROUP=", "; the compiler says:\n  "}},
        ErrorCase{"OwnMacro",
                  {"--opencl-mm2meters-options=-DLANES=8"},
                  2,
                  {"--opencl-mm2meters-options: found -DLANES=8, expected none of"}},
        ErrorCase{"NoMacro",
                  {"--opencl-build-options=-D"},
                  2,
                  {"--opencl-build-options: found -D alone, expected a name after it"}},
        ErrorCase{"LocalMemory",
                  {std::string("--opencl-start-depths-options=") + too_much_local_memory},
                  4,
                  {"kernel start_depths: found 409600000 bytes of local memory needed"}},
        ErrorCase{"Memory",
                  {"-v", "1024", "--map", "grid"},
                  4,
                  {"volume of 1024x1024x1024 voxels", "found a buffer of 4096 MiB"}}),
    [](const auto& test) { return std::string(test.param.name); });

/// Looking for the quickest backend must not load drivers, which start threads.
TEST(OpenclPreset, FastDoesNotTakeIt) {
  const auto is_named = [](std::string_view name) {
    return [name](const BackendEntry& entry) { return entry.name == name; };
  };
  const auto table = backend_table();
  EXPECT_LT(std::find_if(table.begin(), table.end(), is_named("opencl")),
            std::find_if(table.begin(), table.end(), is_named("openmp")));
}

}  // namespace
}  // namespace slambench
