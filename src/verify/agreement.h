// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backends/backend.h"
#include "backends/registry.h"
#include "verify/recording.h"
#include "verify/tolerances.h"

/// The agreement program: every kernel of every backend on every map, held against the reference.
namespace slambench {

/// The backend and map that define what is correct.
inline constexpr std::string_view reference_backend = "serial";
inline constexpr MapKind reference_map = MapKind::grid;

class Trial;

/// One line of the table of checks: a kernel, or what only several kernels together show.
struct Check {
  std::string_view name;
  std::optional<Kernel> kernel;
  std::string_view sentence;
  void (*run)(Trial& trial);
};

/// A check for every kernel that a backend computes (all but `acquire`), then `memory` and
/// `pipeline`.
std::span<const Check> check_table();
const Check* find_check(std::string_view name);
const Tolerance& tolerance_of(const Check& check);

/// Whether the backend has all that the check needs.
bool supports(const Backend& backend, const Check& check, MapKind map);

/// Two instances of the backend under test that must give the same bits; host backends get
/// different numbers of threads.
struct Candidate {
  std::unique_ptr<Backend> first, second;
};
/// Throws as create_backend does.
Candidate make_candidate(std::string_view backend, const BackendOptions& options);

struct AgreementOptions {
  std::uint64_t seed = 1;
  /// In addition to the made-up inputs, which are always used.
  std::vector<Recording> recordings;
  /// Each check ends with its first case that fails.
  bool fail_fast = false;
};

enum class Verdict {
  reference,    ///< nothing to compare with
  agrees,       ///< within tolerance in every case
  disagrees,    ///< not within tolerance, or wrong in a way that has none
  unsupported,  ///< the backend says that it does not have it
};
std::string_view name(Verdict verdict);

/// A measured quantity of one case.
struct Deviation {
  std::string input;
  std::string_view quantity;
  double found = 0, allowed = 0;
  std::string where;  ///< the place and the values there; may be empty
};

/// The outcome of one check of one backend on one map.
struct Agreement {
  std::string_view check;
  std::string backend;
  MapKind map = MapKind::grid;
  Verdict verdict = Verdict::unsupported;
  int cases = 0;
  std::optional<Deviation> closest;  ///< what used most of its tolerance; none: no difference
  std::vector<Deviation> failures;   ///< the first few cases of each quantity
};

Agreement agreement(const Check& check, Candidate& candidate, MapKind map,
                    const AgreementOptions& options);

/// A backend of the table, and why it was not checked if it was not.
struct BackendState {
  std::string name, device;
  Availability availability;
};

struct AgreementReport {
  std::uint64_t seed = 0;
  std::vector<std::string> recordings;
  std::vector<BackendState> backends;
  std::vector<Agreement> results;

  bool agrees() const;
};

/// What to check; everything there is unless named.
struct AgreementSelection {
  std::optional<std::string> backend, check;
  std::optional<MapKind> map;
  BackendOptions options;
};

/// Runs the checks. Throws UsageError for an unknown name, UnavailableError when the backend that
/// was named cannot be used here; one that was not named is reported as unavailable.
AgreementReport verify(const AgreementSelection& selection, const AgreementOptions& options,
                       const std::function<void(const Agreement&)>& progress);

}  // namespace slambench
