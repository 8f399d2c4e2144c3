// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/opencl/opencl_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "core/error.h"

namespace slambench {
namespace {

/// A kernel, the parameters of its layout and of its build options, and the layouts that suit a
/// processor and a GPU. A processor has few cores: groups of one work-item, long runs and wide
/// vectors; a GPU makes vectors of work-items.
struct Row {
  std::string_view kernel, layout, build_options;
  KernelLayout processor, gpu;
};

/// The two parameters of a kernel, whose name is written with hyphens there.
#define PARAMETERS(name) "opencl-" name, "opencl-" name "-options"

constexpr Row rows[] = {
    {"generate_gaussian", PARAMETERS("generate-gaussian"), {64, 1, 1}, {64, 1, 1}},
    {"mm2meters", PARAMETERS("mm2meters"), {1, 16, 128}, {128, 1, 1}},
    {"bilateral_filter", PARAMETERS("bilateral-filter"), {1, 16, 64}, {128, 1, 1}},
    {"half_sample", PARAMETERS("half-sample"), {1, 16, 64}, {128, 1, 1}},
    {"depth2vertex", PARAMETERS("depth2vertex"), {1, 16, 128}, {128, 1, 1}},
    {"vertex2normal", PARAMETERS("vertex2normal"), {1, 16, 64}, {128, 1, 1}},
    {"track", PARAMETERS("track"), {1, 16, 64}, {128, 1, 1}},
    {"reduce", PARAMETERS("reduce"), {1, 16, 64}, {128, 1, 8}},
    {"align", PARAMETERS("align"), {1, 16, 64}, {128, 1, 8}},
    {"sum_groups", PARAMETERS("sum-groups"), {1, 1, 1}, {32, 1, 1}},
    {"integrate", PARAMETERS("integrate"), {1, 16, 256}, {128, 1, 1}},
    {"depth_tiles", PARAMETERS("depth-tiles"), {64, 1, 1}, {64, 1, 1}},
    {"classify_bricks", PARAMETERS("classify-bricks"), {256, 1, 1}, {128, 1, 1}},
    {"integrate_bricks", PARAMETERS("integrate-bricks"), {1, 16, 1}, {64, 1, 1}},
    {"start_depths", PARAMETERS("start-depths"), {1, 1, 1024}, {128, 1, 8}},
    {"raycast", PARAMETERS("raycast"), {1, 16, 32}, {64, 1, 1}},
    {"render_depth", PARAMETERS("render-depth"), {1, 16, 64}, {128, 1, 1}},
    {"render_track", PARAMETERS("render-track"), {1, 16, 64}, {128, 1, 1}},
    {"render_volume", PARAMETERS("render-volume"), {1, 16, 64}, {128, 1, 1}},
};
#undef PARAMETERS
static_assert(std::size(rows) == OpenclParameters::kernels);

/// Macros of the kernels that say how, and for what, they are launched.
constexpr std::string_view own_macros[] = {"GROUP", "LANES",       "PACKETS", "BRICKS",
                                           "WIDE",  "ONLY_MISSES", "TILE",    "MOST_TILES"};

constexpr int most_work_items = 1024;

bool is_power_of_two(int n) { return n > 0 && (n & (n - 1)) == 0; }

std::size_t row_of(std::string_view kernel) {
  for (std::size_t i = 0; i < std::size(rows); ++i) {
    if (rows[i].kernel == kernel) return i;
  }
  throw std::invalid_argument("opencl: no such kernel");
}

/// `name` is that of the macro or folder, which may be a word of its own.
void check_option(std::string_view parameter, std::string_view option, std::string_view name) {
  if (name.empty() || name[0] == '-') {
    throw UsageError(
        fmt::format("--{}: found {} alone, expected a name after it", parameter, option));
  }
  const std::string_view macro = name.substr(0, name.find_first_of("=("));
  if (option == "-I" || std::ranges::find(own_macros, macro) == std::end(own_macros)) return;
  throw UsageError(
      fmt::format("--{}: found {}{}, expected none of the macros that the program "
                  "defines itself: {}",
                  parameter, option, name, fmt::join(own_macros, ", ")));
}

void check_build_options(std::string_view parameter, const std::string& options) {
  std::istringstream words(options);
  for (std::string word, next; words >> word;) {
    const std::string option = word.substr(0, 2);
    if (option != "-D" && option != "-U" && option != "-I") continue;
    if (word == option) word += words >> next ? next : "";
    check_option(parameter, option, std::string_view(word).substr(2));
  }
}

}  // namespace

ParameterList OpenclParameters::describe() {
  ParameterList list{"opencl", {}};
  for (std::size_t i = 0; i < kernels; ++i) {
    list.parameters.push_back({rows[i].layout, 0, "", &layouts[i], 0, most_work_items,
                               "group, lanes (1, 8 or 16) and packets per work-item; 0: what suits "
                               "the device"});
    list.parameters.push_back({rows[i].build_options, 0, "", &kernel_build_options[i], 0, 0,
                               "further options of OpenCL's compiler, for this kernel"});
  }
  list.parameters.push_back({"opencl-build-options", 0, "", &build_options, 0, 0,
                             "further options of OpenCL's compiler, for every kernel, before the "
                             "kernel's own"});
  return with_role(ParameterRole::implementation, std::move(list));
}

KernelLayout OpenclParameters::layout(std::string_view name, bool on_processor) const {
  const std::size_t i = row_of(name);
  KernelLayout layout = on_processor ? rows[i].processor : rows[i].gpu;
  const auto& [group, lanes, packets] = layouts[i];
  if (group != 0) layout.group = group;
  if (lanes != 0) layout.lanes = lanes;
  if (packets != 0) layout.packets = packets;
  if (!is_power_of_two(layout.group) ||
      (layout.lanes != 1 && layout.lanes != 8 && layout.lanes != 16)) {
    throw UsageError(
        fmt::format("--{}: found {},{},{}, expected a group of a power of two, lanes of 1, 8 or 16",
                    rows[i].layout, group, lanes, packets));
  }
  return layout;
}

std::string OpenclParameters::build_options_of(std::string_view name) const {
  const std::string& own = kernel_build_options[row_of(name)];
  return build_options.empty() || own.empty() ? build_options + own : build_options + " " + own;
}

void OpenclParameters::check(bool on_processor) const {
  check_build_options("opencl-build-options", build_options);
  for (std::size_t i = 0; i < kernels; ++i) {
    layout(rows[i].kernel, on_processor);
    check_build_options(rows[i].build_options, kernel_build_options[i]);
  }
}

}  // namespace slambench
