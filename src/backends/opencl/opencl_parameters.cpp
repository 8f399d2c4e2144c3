// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/opencl/opencl_parameters.h"

#include <fmt/format.h>

#include <stdexcept>

#include "core/error.h"

namespace slambench {
namespace {

/// A kernel, its option, and the layouts that suit a processor and a GPU. A processor has few
/// cores: groups of one work-item, long runs and wide vectors; a GPU makes vectors of work-items.
struct Row {
  std::string_view kernel, option;
  KernelLayout processor, gpu;
};

constexpr Row rows[] = {
    {"generate_gaussian", "opencl-generate-gaussian", {64, 1, 1}, {64, 1, 1}},
    {"mm2meters", "opencl-mm2meters", {1, 16, 128}, {128, 1, 1}},
    {"bilateral_filter", "opencl-bilateral-filter", {1, 16, 64}, {128, 1, 1}},
    {"half_sample", "opencl-half-sample", {1, 16, 64}, {128, 1, 1}},
    {"depth2vertex", "opencl-depth2vertex", {1, 16, 128}, {128, 1, 1}},
    {"vertex2normal", "opencl-vertex2normal", {1, 16, 64}, {128, 1, 1}},
    {"track", "opencl-track", {1, 16, 64}, {128, 1, 1}},
    {"reduce", "opencl-reduce", {1, 16, 64}, {128, 1, 8}},
    {"align", "opencl-align", {1, 16, 64}, {128, 1, 8}},
    {"sum_groups", "opencl-sum-groups", {1, 1, 1}, {32, 1, 1}},
    {"integrate", "opencl-integrate", {1, 16, 256}, {128, 1, 1}},
    {"depth_tiles", "opencl-depth-tiles", {64, 1, 1}, {64, 1, 1}},
    {"classify_bricks", "opencl-classify-bricks", {256, 1, 1}, {128, 1, 1}},
    {"integrate_bricks", "opencl-integrate-bricks", {1, 16, 1}, {64, 1, 1}},
    {"start_depths", "opencl-start-depths", {1, 1, 1024}, {128, 1, 8}},
    {"raycast", "opencl-raycast", {1, 16, 32}, {64, 1, 1}},
    {"render_depth", "opencl-render-depth", {1, 16, 64}, {128, 1, 1}},
    {"render_track", "opencl-render-track", {1, 16, 64}, {128, 1, 1}},
    {"render_volume", "opencl-render-volume", {1, 16, 64}, {128, 1, 1}},
};
static_assert(std::size(rows) == OpenclParameters::kernels);

constexpr int most_work_items = 1024;

bool is_power_of_two(int n) { return n > 0 && (n & (n - 1)) == 0; }

}  // namespace

ParameterList OpenclParameters::describe() {
  ParameterList list{"opencl", {}};
  for (std::size_t i = 0; i < kernels; ++i) {
    list.parameters.push_back({rows[i].option, 0, "", &layouts[i], 0, most_work_items,
                               "group, lanes (1, 8 or 16) and packets per work-item; 0: what suits "
                               "the device"});
  }
  list.parameters.push_back({"opencl-build-options", 0, "", &build_options, 0, 0,
                             "further options of OpenCL's compiler, for every kernel"});
  return with_role(ParameterRole::implementation, std::move(list));
}

KernelLayout OpenclParameters::layout(std::string_view name, bool on_processor) const {
  for (std::size_t i = 0; i < kernels; ++i) {
    if (rows[i].kernel != name) continue;
    KernelLayout layout = on_processor ? rows[i].processor : rows[i].gpu;
    const auto& [group, lanes, per_item] = layouts[i];
    if (group != 0) layout.group = group;
    if (lanes != 0) layout.lanes = lanes;
    if (per_item != 0) layout.per_item = per_item;
    if (!is_power_of_two(layout.group) ||
        (layout.lanes != 1 && layout.lanes != 8 && layout.lanes != 16)) {
      throw UsageError(fmt::format(
          "--{}: found {},{},{}, expected a group of a power of two, lanes of 1, 8 or 16",
          rows[i].option, group, lanes, per_item));
    }
    return layout;
  }
  throw std::invalid_argument("layout: no such kernel");
}

void OpenclParameters::check_layouts(bool on_processor) const {
  for (const Row& row : rows) layout(row.kernel, on_processor);
}

}  // namespace slambench
