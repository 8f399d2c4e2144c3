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

/// Which numbers of a layout a kernel makes use of besides the group; the others are 1.
struct Uses {
  bool lanes, packets;
  std::string_view sentence;
};
constexpr Uses all = {true, true,
                      "group, lanes (1, 8 or 16) and packets per work-item; 0: what suits the "
                      "device"};
constexpr Uses no_lanes = {false, true,
                           "group, lanes (1 alone, without vectors) and packets per work-item; 0: "
                           "what suits the device"};
constexpr Uses no_packets = {true, false,
                             "group, lanes (1, 8 or 16) and packets per work-item (1 alone, a "
                             "group takes a brick); 0: what suits the device"};
constexpr Uses group_alone = {false, false,
                              "group, lanes and packets per work-item (both 1 alone, there is one "
                              "group); 0: what suits the device"};

/// A kernel, and the layouts that suit a processor and a GPU. A processor has few cores: groups of
/// one work-item, long runs and wide vectors; a GPU makes vectors of work-items.
struct Row {
  std::string_view kernel;
  KernelLayout processor, gpu;
  Uses uses = all;
};

constexpr Row rows[] = {
    {"generate_gaussian", {64, 1, 1}, {64, 1, 1}, no_lanes},
    {"mm2meters", {1, 16, 128}, {128, 1, 1}},
    {"bilateral_filter", {1, 16, 64}, {128, 1, 1}},
    {"half_sample", {1, 16, 64}, {128, 1, 1}},
    {"depth2vertex", {1, 16, 128}, {128, 1, 1}},
    {"vertex2normal", {1, 16, 64}, {128, 1, 1}},
    {"track", {1, 16, 64}, {128, 1, 1}},
    {"reduce", {1, 16, 64}, {128, 1, 8}},
    {"align", {1, 16, 64}, {128, 1, 8}},
    {"sum_groups", {1, 1, 1}, {32, 1, 1}, group_alone},
    {"integrate", {1, 16, 256}, {128, 1, 1}},
    {"depth_tiles", {64, 1, 1}, {64, 1, 1}, no_lanes},
    {"classify_bricks", {256, 1, 1}, {128, 1, 1}, no_lanes},
    {"integrate_bricks", {1, 16, 1}, {64, 1, 1}, no_packets},
    {"start_depths", {1, 1, 1024}, {128, 1, 8}, no_lanes},
    {"raycast", {1, 16, 32}, {64, 1, 1}},
    {"render_depth", {1, 16, 64}, {128, 1, 1}},
    {"render_track", {1, 16, 64}, {128, 1, 1}},
    {"render_volume", {1, 16, 64}, {128, 1, 1}},
};

/// The names of a kernel's parameters, its own name in them with hyphens.
struct Names {
  explicit Names(std::string kernel) {
    std::ranges::replace(kernel, '_', '-');
    layout = "opencl-" + kernel;
    build_options = layout + "-options";
  }
  std::string layout, build_options;
};

const Names& names_of(std::size_t row) {
  static const std::vector<Names> names = [] {
    std::vector<Names> made;
    for (const Row& each : rows) made.emplace_back(std::string(each.kernel));
    return made;
  }();
  return names[row];
}

constexpr ParameterFamily layout_family = {
    "opencl-KERNEL",
    "a kernel's group, lanes (1, 8 or 16) and packets per work-item; 0: what suits the device. "
    "Which kernels have 1 lane or 1 packet alone: slambench list --parameters"};
constexpr ParameterFamily build_options_family = {
    "opencl-KERNEL-options", "further options of OpenCL's compiler, for one kernel"};

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

bool is_possible(const KernelLayout& layout, const Uses& uses) {
  const auto& [group, lanes, packets] = layout;
  const bool vectors = uses.lanes && (lanes == 8 || lanes == 16);
  return (group == 0 || is_power_of_two(group)) && (lanes == 0 || lanes == 1 || vectors) &&
         (packets == 0 || packets == 1 || uses.packets);
}

}  // namespace

OpenclParameters::OpenclParameters()
    : layouts(std::size(rows)), kernel_build_options(std::size(rows)) {}

ParameterList OpenclParameters::describe() {
  ParameterList list{"opencl", {}};
  for (std::size_t i = 0; i < std::size(rows); ++i) {
    Parameter layout = {names_of(i).layout,   0, "", &layouts[i], 0, most_work_items,
                        rows[i].uses.sentence};
    layout.parts = "GROUP,LANES,PACKETS";
    layout.family = &layout_family;
    Parameter own_options = {names_of(i).build_options,
                             0,
                             "",
                             &kernel_build_options[i],
                             0,
                             0,
                             "further options of OpenCL's compiler, for this kernel"};
    own_options.family = &build_options_family;
    list.parameters.push_back(layout);
    list.parameters.push_back(own_options);
  }
  list.parameters.push_back({"opencl-build-options", 0, "", &build_options, 0, 0,
                             "further options of OpenCL's compiler, for every kernel, before the "
                             "kernel's own"});
  return with_role(ParameterRole::implementation, std::move(list));
}

KernelLayout OpenclParameters::layout(std::string_view name, bool on_processor) const {
  const std::size_t i = row_of(name);
  check_layout(i);
  KernelLayout layout = on_processor ? rows[i].processor : rows[i].gpu;
  const auto& [group, lanes, packets] = layouts[i];
  if (group != 0) layout.group = group;
  if (lanes != 0) layout.lanes = lanes;
  if (packets != 0) layout.packets = packets;
  return layout;
}

void OpenclParameters::check_layout(std::size_t row) const {
  const auto& [group, lanes, packets] = layouts[row];
  const Uses& uses = rows[row].uses;
  if (is_possible({group, lanes, packets}, uses)) return;
  throw UsageError(
      fmt::format("--{}: found {},{},{}, expected a group of a power of two, lanes of {}{}",
                  names_of(row).layout, group, lanes, packets, uses.lanes ? "1, 8 or 16" : "1",
                  uses.packets ? "" : ", packets of 1"));
}

std::string OpenclParameters::build_options_of(std::string_view name) const {
  const std::string& own = kernel_build_options[row_of(name)];
  return build_options.empty() || own.empty() ? build_options + own : build_options + " " + own;
}

void OpenclParameters::check() const {
  check_build_options("opencl-build-options", build_options);
  for (std::size_t i = 0; i < std::size(rows); ++i) {
    check_layout(i);
    check_build_options(names_of(i).build_options, kernel_build_options[i]);
  }
}

}  // namespace slambench
