// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "config/presets.h"

#include <fmt/format.h>

#include <algorithm>

#include "backends/registry.h"
#include "config/nearest.h"
#include "core/error.h"

namespace slambench {
namespace {

/// The table of backends runs from slow to fast; those that are slower are not asked.
std::string quickest_backend() {
  const auto backends = backend_table();
  const auto quickest = std::find_if(backends.rbegin(), backends.rend(), [](const auto& entry) {
    return entry.availability().available;
  });
  return std::string(quickest->name);
}

}  // namespace

std::vector<Preset> preset_table() {
  return {
      {"fast",
       "the quickest combination available here that agrees with the reference",
       {{"backend", quickest_backend()}, {"map", "auto"}, {"fused", "true"}}},
      {"slambench1",
       "the published behaviour: flat volume, the paper's kernels one by one",
       {{"map", "grid"},
        {"fused", "false"},
        {"icl-nuim-camera", "slambench1"},
        {"light", "1,1,-1"},
        {"light-frame", "volume"},
        {"prefetch", "off"}}},
  };
}

Preset find_preset(std::string_view name) {
  std::vector<std::string_view> known;
  for (Preset& preset : preset_table()) {
    if (preset.name == name) return std::move(preset);
    known.push_back(preset.name);
  }
  throw UsageError(fmt::format("--preset: found '{}', expected one of {}{}", name,
                               fmt::join(known, ", "), suggestion(name, known)));
}

}  // namespace slambench
