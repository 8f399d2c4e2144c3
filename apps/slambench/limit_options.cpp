// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "limit_options.h"

#include <fmt/format.h>

#include "core/error.h"

namespace slambench {

void add_limit_option(CLI::App& command, std::vector<std::string>* limits, bool ratios) {
  command
      .add_option(
          "--fail-if", *limits,
          fmt::format("end with status 5 when this holds: a figure, one of < <= > >= == !=, and a "
                      "number, as in 'ate_rmse_m>0.05' or 'fps<30'{}; may be given several times. "
                      "Figures: {}; or any number by its place in record.json",
                      ratios ? ", or 'ratio(fps)<0.9' for other / base, which counts once the "
                               "whole interval is beyond the number"
                             : "",
                      known_figures()))
      ->type_name("LIMIT")
      ->allow_extra_args(false);
}

std::vector<Limit> parse_limits(const std::vector<std::string>& texts, bool ratios) {
  std::vector<Limit> limits;
  limits.reserve(texts.size());
  for (const std::string& text : texts) limits.push_back(parse_limit(text, ratios));
  return limits;
}

void throw_if_violated(const std::vector<std::string>& lines) {
  if (!lines.empty()) {
    throw Error(ExitStatus::threshold, fmt::format("{}", fmt::join(lines, "; ")));
  }
}

}  // namespace slambench
