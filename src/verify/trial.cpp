// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "verify/trial.h"

#include <algorithm>

namespace slambench {
namespace {

/// Of each quantity, so that a broken kernel does not fill pages.
constexpr std::ptrdiff_t reported_failures = 3;

/// How much of its tolerance a quantity used; what has none uses it up at once.
double used(const Deviation& deviation) {
  if (deviation.allowed > 0) return deviation.found / deviation.allowed;
  return deviation.found > 0 ? HUGE_VAL : 0;
}

}  // namespace

Trial::Trial(const Tolerance& tolerance, Candidate& candidate, MapKind map,
             const AgreementOptions& options)
    : tolerance_(tolerance),
      candidate_(candidate),
      map_(map),
      options_(options),
      reference_(create_backend(reference_backend, {})) {
  result_.check = tolerance.check;
  result_.backend = candidate.first->name();
  result_.map = map;
  result_.verdict = Verdict::agrees;
}

void Trial::at_most(std::string_view quantity, double found, const std::string& where) {
  Deviation deviation{input_, quantity, found, tolerance_.allowed(quantity), where};
  const double closest = result_.closest ? used(*result_.closest) : 0;
  if (used(deviation) > closest) result_.closest = deviation;
  if (found <= deviation.allowed) return;  // a NaN is not within any limit
  result_.verdict = Verdict::disagrees;
  const auto known =
      std::count_if(result_.failures.begin(), result_.failures.end(),
                    [&](const Deviation& failure) { return failure.quantity == quantity; });
  if (known < reported_failures) result_.failures.push_back(std::move(deviation));
}

void Trial::report(const std::vector<Violation>& violations) {
  for (const Violation& violation : violations) {
    at_most(violation.quantity, static_cast<double>(violation.count));
  }
}

Agreement Trial::take() { return std::move(result_); }

}  // namespace slambench
