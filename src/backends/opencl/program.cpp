// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/opencl/program.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "backends/opencl/kernels/kernel_texts.h"
#include "backends/opencl/queue.h"
#include "core/logged_error.h"
#include "io/files.h"

namespace slambench {
namespace {

namespace fs = std::filesystem;

/// What every kernel builds on, in this order; `NAME.cl` follows.
constexpr std::string_view shared[] = {"types",  "lanes", "float3_lanes", "maths",
                                       "volume", "sums",  "track_point",  "integrate_voxels"};

std::string source_of(const std::string& name) {
  std::string text;
  for (const std::string_view part : shared) text += kernel_texts::find(part);
  return text.append(kernel_texts::find(name));
}

/// Of two that contradict each other compilers take the later: the user's options come after those
/// that may be changed and before the macros, which the launches rely on.
std::string options_of(const OpenclDevice& device, const KernelLayout& layout,
                       const std::string& macros, const std::string& build_options) {
  std::string options = "-cl-std=CL1.2";
  if (device.divides_exactly) options += " -cl-fp32-correctly-rounded-divide-sqrt";
  if (!build_options.empty()) options += " " + build_options;
  options += fmt::format(" -DGROUP={} -DLANES={} -DPACKETS={}", layout.group, layout.lanes,
                         layout.packets);
  if (!macros.empty()) options += " " + macros;
  return options;
}

/// Where the device's program is kept; "" when the user has no such place.
std::string cache_file(const OpenclDevice& device, const std::string& options,
                       const std::string& source) {
  const std::string key = fmt::format("{}\n{}\n{}\n{}\n{}", device.platform, device.name,
                                      device.driver, options, source);
  try {
    return fmt::format("{}/opencl/{:016x}.bin", cache_folder(),
                       XXH3_64bits(key.data(), key.size()));
  } catch (const UnavailableError&) {
    return "";
  }
}

/// Before a program in its file: drivers may crash on a damaged one.
struct Header {
  std::uint64_t magic = 0;
  std::uint64_t size = 0;
  std::uint64_t hash = 0;  ///< of what follows
};

Header header_of(std::string_view program) {
  constexpr std::uint64_t magic = 0x31304c434f424c53;  // "SLBOCL01" as bytes
  return {magic, program.size(), XXH3_64bits(program.data(), program.size())};
}

/// The program in the bytes of a file; empty when they are not what was written.
std::string_view program_in(std::string_view bytes) {
  if (bytes.size() < sizeof(Header)) return {};
  const std::string_view program = bytes.substr(sizeof(Header));
  const Header expected = header_of(program);
  return std::memcmp(bytes.data(), &expected, sizeof expected) == 0 ? program : std::string_view();
}

/// The program from the cache; a null one when it is not there, damaged or does not fit any more.
cl::Program cached(const cl::Context& context, const cl::Device& device, const std::string& file,
                   const std::string& options) {
  try {
    if (!fs::is_regular_file(file)) return {};
    const std::string bytes = read_file(file);
    const std::string_view binary = program_in(bytes);
    if (binary.empty()) return {};
    cl::Program program(context, {device}, {{binary.begin(), binary.end()}});
    program.build({device}, options.c_str());
    return program;
  } catch (const std::exception&) {
    return {};
  }
}

/// A cache that cannot be written costs time, nothing else.
void keep(const cl::Program& program, const std::string& file) {
  if (file.empty()) return;
  try {
    const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
    if (binaries.size() != 1 || binaries[0].empty()) return;
    const std::string folder = fs::path(file).parent_path();
    fs::create_directories(folder);
    remove_leftovers(folder);
    const std::string binary(binaries[0].begin(), binaries[0].end());
    const Header header = header_of(binary);
    write_file(file, std::string(reinterpret_cast<const char*>(&header), sizeof header) + binary);
  } catch (const std::exception&) {
  }
}

cl::Program compiled(const cl::Context& context, const OpenclDevice& device,
                     const std::string& name, const std::string& source,
                     const std::string& options) {
  cl::Program program(context, source);
  try {
    program.build({device.device}, options.c_str());
  } catch (const cl::BuildError& error) {
    std::string log;
    for (const auto& [of, text] : error.getBuildLog()) log += text;
    throw LoggedError(
        error.err() == CL_INVALID_BUILD_OPTIONS ? ExitStatus::usage : ExitStatus::failed,
        fmt::format("opencl: {}.cl does not build on {} with '{}'; the compiler says", name,
                    device.name, options),
        log);
  }
  return program;
}

}  // namespace

Programs::Programs(cl::Context context, OpenclDevice device, OpenclParameters parameters)
    : context_(std::move(context)),
      device_(std::move(device)),
      parameters_(std::move(parameters)) {}

DeviceKernel& Programs::get(const std::string& name, const std::string& macros) {
  const std::string key = name + " " + macros;
  const auto it = kernels_.find(key);
  if (it != kernels_.end()) return it->second;
  return kernels_.emplace(key, build(name, macros)).first->second;
}

DeviceKernel Programs::build(const std::string& name, const std::string& macros) const {
  DeviceKernel result;
  result.layout = parameters_.layout(name, device_.is_processor);
  const std::string options =
      options_of(device_, result.layout, macros, parameters_.build_options_of(name));
  const std::string source = source_of(name);
  const std::string file = cache_file(device_, options, source);
  with_opencl_errors(device_.name, [&] {
    cl::Program program = cached(context_, device_.device, file, options);
    if (program() == nullptr) {
      program = compiled(context_, device_, name, source, options);
      keep(program, file);
    }
    result.kernel = cl::Kernel(program, name.c_str());
    require_fits(name, result);
  });
  return result;
}

void Programs::require_fits(const std::string& name, const DeviceKernel& kernel) const {
  const std::size_t local =
      kernel.kernel.getWorkGroupInfo<CL_KERNEL_LOCAL_MEM_SIZE>(device_.device);
  if (local > device_.local_bytes) {
    throw UnavailableError(
        fmt::format("opencl: kernel {}: found {} bytes of local memory needed, expected at most {} "
                    "on {}; a smaller group needs less",
                    name, local, device_.local_bytes, device_.name));
  }
  const std::size_t most =
      kernel.kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(device_.device);
  if (static_cast<std::size_t>(kernel.layout.group) > most) {
    throw UnavailableError(
        fmt::format("opencl: kernel {}: found a group of {} work-items, expected at most {} on {}",
                    name, kernel.layout.group, most, device_.name));
  }
}

}  // namespace slambench
