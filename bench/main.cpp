// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// Times of every kernel on every backend and map, in the paper's sizes, on the state that a run of
// KinectFusion leaves behind. See docs/benchmarks.md.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "config/settings.h"
#include "core/error.h"
#include "datasets/source.h"
#include "kernel_bench.h"
#include "meters/clock.h"
#include "results/provenance.h"

namespace slambench {
namespace {

struct Options {
  std::string sequence;  ///< empty: the made-up room
  int frames = 20;
  int threads = 0;
};

constexpr std::string_view usage = R"(slambench_bench [options] [Google Benchmark's options]
  --sequence=PATH  frames of this sequence instead of a made-up room
  --frames=N       fused before the kernels are timed (default 20)
  --threads=N      of host backends (default: one per core)
)";

int number(std::string_view text, std::string_view option, int least) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < least) {
    throw UsageError(
        fmt::format("{}: found '{}', expected an integer of at least {}", option, text, least));
  }
  return value;
}

/// Takes the program's own options out of the arguments.
Options parse(int* argc, char** argv) {
  Options options;
  const auto take = [&](std::string_view argument) {
    const std::size_t equals = argument.find('=');
    const std::string_view name = argument.substr(0, equals);
    const std::string_view value =
        equals == std::string_view::npos ? "" : argument.substr(equals + 1);
    if (name == "--sequence") {
      options.sequence = value;
    } else if (name == "--frames") {
      options.frames = number(value, name, 2);
    } else if (name == "--threads") {
      options.threads = number(value, name, 0);
    } else {
      return false;
    }
    return true;
  };
  char** const end =
      std::remove_if(argv + 1, argv + *argc, [&](const char* text) { return take(text); });
  *argc = static_cast<int>(end - argv);
  return options;
}

/// The paper's configuration: 640x480 in, 320x240 computed, 256^3 voxels.
Recording made_up_recording(int frames) {
  Recording recording = synthetic_recording({640, 480}, frames);
  recording.name = "room";
  recording.parameters.compute_size_ratio = 2;
  recording.parameters.volume_resolution = {256, 256, 256};
  recording.parameters.mu_m = 0.1;
  return recording;
}

Recording read_recording(const Options& options) {
  if (options.sequence.empty()) return made_up_recording(options.frames);
  const auto source = open_source(options.sequence, {});
  const SequenceInfo& info = source->info();
  KinectFusionParameters parameters;
  Settings settings({parameters.describe()});
  settings.suggest(info.suggested);
  std::vector<Frame> frames;
  for (int i = 0; i < std::min(options.frames, info.frame_count); ++i) {
    frames.emplace_back();
    source->read(i, frames.back());
  }
  if (frames.size() < 2) {
    throw InputError(options.sequence, "frames", std::to_string(frames.size()), "at least 2");
  }
  return tracked_recording(info.name, std::move(frames), info.camera, info.units_per_m, parameters);
}

/// One backend on one map at a time, made when its first kernel is timed.
class CurrentBench {
 public:
  CurrentBench(const Recording& recording, int threads)
      : recording_(recording), threads_(threads) {}

  KernelBench& of(std::string_view backend, MapKind map) {
    const std::pair<std::string, MapKind> wanted(backend, map);
    if (!bench_ || wanted != current_) {
      bench_.reset();
      BackendOptions options;
      options.threads = threads_;
      bench_ = std::make_unique<KernelBench>(create_backend(backend, options), map, recording_);
      current_ = wanted;
    }
    return *bench_;
  }

 private:
  const Recording& recording_;
  const int threads_;
  std::unique_ptr<KernelBench> bench_;
  std::pair<std::string, MapKind> current_;
};

/// The least time that the machine allows for this cost.
double floor_s(const Cost& cost, const MachineCeiling& ceiling) {
  return std::max(cost.bytes / ceiling.copy_bytes_per_s, cost.flops / ceiling.fma_flops_per_s);
}

void run(benchmark::State& state, KernelBench& bench, Kernel kernel,
         const MachineCeiling& ceiling) {
  bench.prepare(kernel);
  const double begin_s = steady_clock().now_s();
  for ([[maybe_unused]] const auto iteration : state) bench.run(kernel);
  const double call_s =
      (steady_clock().now_s() - begin_s) / static_cast<double>(state.iterations());
  using benchmark::Counter;
  const Cost cost = bench.cost(kernel);
  state.counters["bytes/s"] = Counter(cost.bytes / call_s);
  if (cost.flops > 0) state.counters["FLOP/s"] = Counter(cost.flops / call_s);
  if (bench.on_host()) state.counters["of_ceiling"] = Counter(floor_s(cost, ceiling) / call_s);
}

void register_all(CurrentBench* stage, const MachineCeiling& ceiling, int threads) {
  for (const BackendEntry& entry : backend_table()) {
    const Availability availability = entry.availability();
    if (!availability.available) {
      fmt::print(stderr, "{}: unavailable: {}\n", entry.name, availability.reason);
      continue;
    }
    BackendOptions options;
    options.threads = threads;
    const auto backend = create_backend(entry.name, options);
    for (const MapInfo& map : map_table()) {
      for (const KernelInfo& row : kernel_table()) {
        if (!backend->supports(row.kernel, map.map)) continue;
        const auto body = [=, name = std::string(entry.name), kind = map.map,
                           kernel = row.kernel](benchmark::State& state) {
          run(state, stage->of(name, kind), kernel, ceiling);
        };
        const std::string name = fmt::format("{}/{}/{}", row.name, entry.name, map.name);
        benchmark::RegisterBenchmark(name.c_str(), body)
            ->Unit(benchmark::kMicrosecond)
            ->UseRealTime();
      }
    }
  }
}

void add_context(const Recording& recording, const MachineCeiling& ceiling) {
  const Provenance provenance =
      build_and_machine(std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()));
  benchmark::AddCustomContext("version", version_text());
  benchmark::AddCustomContext("cpu", provenance.cpu);
  benchmark::AddCustomContext("compiler", provenance.compiler);
  benchmark::AddCustomContext(
      "sequence", fmt::format("{}, {} frames", recording.name, recording.frames.size()));
  benchmark::AddCustomContext(
      "ceiling", fmt::format("{} threads: copy {:.1f} GB/s, {} {:.0f} GFLOP/s", ceiling.threads,
                             ceiling.copy_bytes_per_s * 1e-9, ceiling.instruction_set,
                             ceiling.fma_flops_per_s * 1e-9));
}

int run_benchmarks(int argc, char** argv) {
  const Options options = parse(&argc, argv);
  benchmark::Initialize(&argc, argv, [] {
    fmt::print("{}", usage);
    benchmark::PrintDefaultHelp();
  });
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return static_cast<int>(ExitStatus::usage);
  }
  const Recording recording = read_recording(options);
  const MachineCeiling ceiling = measure_machine(steady_clock(), options.threads);
  add_context(recording, ceiling);
  CurrentBench stage(recording, options.threads);
  register_all(&stage, ceiling, options.threads);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace
}  // namespace slambench

int main(int argc, char** argv) {
  try {
    return slambench::run_benchmarks(argc, argv);
  } catch (const slambench::Error& error) {
    fmt::print(stderr, "slambench_bench: {}\n", error.what());
    return static_cast<int>(error.status());
  } catch (const std::exception& error) {
    fmt::print(stderr, "slambench_bench: {}\n", error.what());
    return static_cast<int>(slambench::ExitStatus::failed);
  }
}
