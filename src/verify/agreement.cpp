// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "verify/agreement.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "core/error.h"
#include "verify/checks.h"
#include "verify/trial.h"

namespace slambench {
namespace {

/// Instances of a host backend differ in these, and no result may.
constexpr int first_threads = 0, second_threads = 3;

const std::array<Check, 18>& table() {
  const auto kernel = [](Kernel k, void (*run)(Trial&)) {
    return Check{slambench::name(k), k, info(k).sentence, run};
  };
  static const std::array<Check, 18> checks = {{
      kernel(Kernel::mm2meters, check_mm2meters),
      kernel(Kernel::bilateral_filter, check_bilateral_filter),
      kernel(Kernel::half_sample, check_half_sample),
      kernel(Kernel::depth2vertex, check_depth2vertex),
      kernel(Kernel::vertex2normal, check_vertex2normal),
      kernel(Kernel::track, check_track),
      kernel(Kernel::reduce, check_reduce),
      kernel(Kernel::solve, check_solve),
      kernel(Kernel::align, check_align),
      kernel(Kernel::integrate, check_integrate),
      kernel(Kernel::raycast, check_raycast),
      kernel(Kernel::render_depth, check_render_depth),
      kernel(Kernel::render_track, check_render_track),
      kernel(Kernel::render_volume, check_render_volume),
      kernel(Kernel::init_volume, check_init_volume),
      kernel(Kernel::generate_gaussian, check_generate_gaussian),
      {"memory", std::nullopt, "writes images and volumes to the backend and reads them back",
       check_memory},
      {"pipeline", std::nullopt, "runs KinectFusion over a dozen frames", check_pipeline},
  }};
  return checks;
}

/// The made-up sequence that the kernels' checks take frames from besides the user's.
AgreementOptions with_synthetic(const AgreementOptions& options) {
  AgreementOptions all = options;
  all.recordings.insert(all.recordings.begin(), synthetic_recording({127, 65}, 6));
  return all;
}

bool is_reference(const Backend& backend, MapKind map) {
  return backend.name() == reference_backend && map == reference_map;
}

std::vector<const Check*> selected_checks(const std::optional<std::string>& name) {
  std::vector<const Check*> checks;
  std::string known;
  for (const Check& check : check_table()) {
    if (!name || *name == check.name) checks.push_back(&check);
    known += known.empty() ? "" : ", ";
    known += check.name;
  }
  if (checks.empty()) {
    throw UsageError("--kernel: found '" + *name + "', expected one of " + known);
  }
  return checks;
}

}  // namespace

std::span<const Check> check_table() { return table(); }

const Check* find_check(std::string_view name) {
  const auto it = std::find_if(table().begin(), table().end(),
                               [&](const Check& check) { return check.name == name; });
  return it == table().end() ? nullptr : &*it;
}

const Tolerance& tolerance_of(const Check& check) {
  const auto all = tolerance_table();
  return *std::find_if(all.begin(), all.end(),
                       [&](const Tolerance& t) { return t.check == check.name; });
}

bool supports(const Backend& backend, const Check& check, MapKind map) {
  if (check.kernel) return backend.supports(*check.kernel, map);
  if (check.name == "memory") return backend.supports(Kernel::init_volume, map);
  return !backend.missing_kernel(map);  // the pipeline
}

Candidate make_candidate(std::string_view backend, const BackendOptions& options) {
  BackendOptions first = options, second = options;
  if (first.threads == 0) first.threads = first_threads;
  second.threads = second_threads;
  return {create_backend(backend, first), create_backend(backend, second)};
}

std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::reference:
      return "reference";
    case Verdict::agrees:
      return "agrees";
    case Verdict::disagrees:
      return "disagrees";
    case Verdict::unsupported:
      return "unsupported";
  }
  throw std::invalid_argument("name: no such verdict");
}

Agreement agreement(const Check& check, Candidate& candidate, MapKind map,
                    const AgreementOptions& options) {
  Agreement result;
  result.check = check.name;
  result.backend = candidate.first->name();
  result.map = map;
  if (!supports(*candidate.first, check, map)) return result;
  if (is_reference(*candidate.first, map)) {
    result.verdict = Verdict::reference;
    return result;
  }
  const AgreementOptions all = with_synthetic(options);
  Trial trial(tolerance_of(check), candidate, map, all);
  check.run(trial);
  return trial.take();
}

bool AgreementReport::agrees() const {
  return std::none_of(results.begin(), results.end(),
                      [](const Agreement& result) { return result.verdict == Verdict::disagrees; });
}

AgreementReport verify(const AgreementSelection& selection, const AgreementOptions& options,
                       const std::function<void(const Agreement&)>& progress) {
  const std::vector<const Check*> checks = selected_checks(selection.check);
  AgreementReport report;
  report.seed = options.seed;
  for (const Recording& recording : options.recordings) report.recordings.push_back(recording.name);
  // An unknown or unavailable backend that was asked for is an error before anything runs.
  if (selection.backend) create_backend(*selection.backend, selection.options);
  for (const BackendEntry& entry : backend_table()) {
    if (selection.backend && *selection.backend != entry.name) continue;
    BackendState state{std::string(entry.name), "", entry.availability()};
    if (!state.availability.available) {
      report.backends.push_back(state);
      continue;
    }
    Candidate candidate = make_candidate(entry.name, selection.options);
    state.device = candidate.first->device();
    report.backends.push_back(state);
    for (const MapInfo& map : map_table()) {
      if (selection.map && *selection.map != map.map) continue;
      for (const Check* check : checks) {
        report.results.push_back(agreement(*check, candidate, map.map, options));
        if (progress) progress(report.results.back());
      }
    }
  }
  return report;
}

}  // namespace slambench
