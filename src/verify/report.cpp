// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "verify/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace slambench {
namespace {

using Json = nlohmann::ordered_json;
/// A backend on a map.
using Column = std::pair<std::string, MapKind>;

std::vector<Column> columns_of(const AgreementReport& report) {
  std::vector<Column> columns;
  for (const Agreement& result : report.results) {
    const Column column{result.backend, result.map};
    if (std::find(columns.begin(), columns.end(), column) == columns.end()) {
      columns.push_back(column);
    }
  }
  return columns;
}

/// The checks that ran, in their order.
std::vector<const Check*> rows_of(const AgreementReport& report) {
  std::vector<const Check*> rows;
  for (const Check& check : check_table()) {
    if (std::any_of(report.results.begin(), report.results.end(),
                    [&](const Agreement& result) { return result.check == check.name; })) {
      rows.push_back(&check);
    }
  }
  return rows;
}

const Agreement* find(const AgreementReport& report, const Check& check, const Column& column) {
  for (const Agreement& result : report.results) {
    if (result.check == check.name && Column{result.backend, result.map} == column) return &result;
  }
  return nullptr;
}

/// Short enough for a terminal with many backends.
std::string_view word(const Agreement* result) {
  if (result == nullptr) return "";
  switch (result->verdict) {
    case Verdict::reference:
      return "ref";
    case Verdict::agrees:
      return "ok";
    case Verdict::disagrees:
      return "FAIL";
    case Verdict::unsupported:
      return "none";
  }
  return "";
}

std::string table(const AgreementReport& report, const std::vector<const Check*>& rows,
                  const std::vector<Column>& columns, std::size_t first_width) {
  const auto cell_width = [](const Column& column) {
    return std::max({column.first.size(), name(column.second).size(), std::size_t{4}}) + 2;
  };
  std::string text = fmt::format("{:{}}", "", first_width);
  for (const Column& column : columns) {
    text += fmt::format("{:>{}}", column.first, cell_width(column));
  }
  text += fmt::format("\n{:{}}", "kernel", first_width);
  for (const Column& column : columns) {
    text += fmt::format("{:>{}}", name(column.second), cell_width(column));
  }
  text += "\n";
  for (const Check* check : rows) {
    text += fmt::format("{:{}}", check->name, first_width);
    for (const Column& column : columns) {
      text += fmt::format("{:>{}}", word(find(report, *check, column)), cell_width(column));
    }
    text += "\n";
  }
  return text + "\n";
}

/// Several tables below each other when there are more backends than the page is wide.
std::string tables(const AgreementReport& report, std::size_t width) {
  const std::vector<const Check*> rows = rows_of(report);
  std::size_t first_width = 6;
  for (const Check* check : rows) first_width = std::max(first_width, check->name.size());
  std::string text;
  std::vector<Column> page;
  std::size_t used = first_width;
  for (const Column& column : columns_of(report)) {
    const std::size_t needed =
        std::max({column.first.size(), name(column.second).size(), std::size_t{4}}) + 2;
    if (!page.empty() && used + needed > width) {
      text += table(report, rows, page, first_width);
      page.clear();
      used = first_width;
    }
    page.push_back(column);
    used += needed;
  }
  if (!page.empty()) text += table(report, rows, page, first_width);
  return text;
}

std::string legend(const AgreementReport& report) {
  static constexpr std::pair<Verdict, std::string_view> words[] = {
      {Verdict::reference, "ref   the reference itself: compared with nothing"},
      {Verdict::agrees, "ok    within tolerance of the reference in every case"},
      {Verdict::disagrees, "FAIL  not within tolerance: see below"},
      {Verdict::unsupported, "none  unsupported: the backend does not have this kernel here"},
  };
  std::string text;
  for (const auto& [verdict, sentence] : words) {
    const auto has = [verdict = verdict](const Agreement& r) { return r.verdict == verdict; };
    if (std::any_of(report.results.begin(), report.results.end(), has)) {
      text += fmt::format("{}\n", sentence);
    }
  }
  for (const BackendState& backend : report.backends) {
    if (backend.availability.available) continue;
    text += fmt::format("{}: unavailable: {}\n", backend.name, backend.availability.reason);
  }
  return text;
}

std::string failures(const AgreementReport& report) {
  std::string text;
  for (const Agreement& result : report.results) {
    for (const Deviation& failure : result.failures) {
      text += fmt::format("\n{} on {}/{}: {}\n  {}: found {:.4g}, allowed {:.4g}\n", result.check,
                          result.backend, name(result.map), failure.input, failure.quantity,
                          failure.found, failure.allowed);
      if (!failure.where.empty()) text += fmt::format("  {}\n", failure.where);
    }
  }
  return text;
}

std::string conclusion(const AgreementReport& report) {
  int cases = 0, compared = 0, wrong = 0;
  for (const Agreement& result : report.results) {
    cases += result.cases;
    compared += result.verdict == Verdict::agrees || result.verdict == Verdict::disagrees ? 1 : 0;
    wrong += result.verdict == Verdict::disagrees ? 1 : 0;
  }
  if (compared == 0) return "nothing to compare with the reference\n";
  return fmt::format("{} of {} agree with {}/{} ({} cases, seed {})\n", compared - wrong, compared,
                     reference_backend, name(reference_map), cases, report.seed);
}

Json as_json(const Deviation& deviation) {
  // JSON has no infinity: what is not finite is absent.
  Json json = {{"input", deviation.input}, {"quantity", deviation.quantity}};
  if (std::isfinite(deviation.found)) json["found"] = deviation.found;
  json["allowed"] = deviation.allowed;
  if (!deviation.where.empty()) json["where"] = deviation.where;
  return json;
}

Json as_json(const Agreement& result) {
  Json json = {{"kernel", result.check},
               {"backend", result.backend},
               {"map", name(result.map)},
               {"verdict", name(result.verdict)},
               {"cases", result.cases}};
  if (result.closest) json["closest"] = as_json(*result.closest);
  json["failures"] = Json::array();
  for (const Deviation& failure : result.failures) json["failures"].push_back(as_json(failure));
  return json;
}

std::string matrix_markdown(const AgreementReport& report) {
  const std::vector<Column> columns = columns_of(report);
  std::string head = "| kernel |", rule = "|---|";
  for (const Column& column : columns) {
    head += fmt::format(" {}/{} |", column.first, name(column.second));
    rule += "---|";
  }
  std::string text = head + "\n" + rule + "\n";
  for (const Check* check : rows_of(report)) {
    text += fmt::format("| {} |", check->name);
    for (const Column& column : columns) {
      const Agreement* result = find(report, *check, column);
      text += fmt::format(" {} |", result == nullptr ? "" : name(result->verdict));
    }
    text += "\n";
  }
  for (const BackendState& backend : report.backends) {
    if (backend.availability.available) continue;
    text +=
        fmt::format("\n`{}` was not run, as it was not available where this table was made: {}\n",
                    backend.name, backend.availability.reason);
  }
  return text;
}

std::string limits_text(const Tolerance& tolerance) {
  std::string text;
  for (const Limit& limit : tolerance.limits) {
    if (!text.empty()) text += "<br>";
    text += limit.allowed == 0 ? fmt::format("{}: none", limit.quantity)
                               : fmt::format("{}: {}", limit.quantity, limit.allowed);
  }
  return text;
}

constexpr std::string_view introduction = R"(# Agreement of the backends

`slambench verify` runs every kernel of every backend on every map and holds the results against the
reference, the `serial` backend on the `grid` map. The same program runs as tests. This page is what
`slambench verify --markdown` prints.

## What is checked

- **Inputs**: from a seed (`--seed`) and from scenes with a closed form (a plane, a sphere, a room), in
  sizes that no work group divides, down to one pixel; images of zeros, single holes, patches without
  depth, values at the ends of the range, NaN and infinities; volumes that are neither cubes nor made of
  cubes nor a multiple of eight, fresh, random, written and integrated; real frames where a sequence is
  named (`--sequence`, `--frames`).
- **Results**: within the tolerance below wherever the reference's result is finite.
- **Outputs** are filled with a pattern before the kernel runs: every element must have been written.
- **Guard bands**: behind the last pixel of every image, inputs and outputs, lie canaries in the same
  allocation, also on devices whose memory nobody else sees. A write past the end changes them, a read
  past the end gets values that show. Not covered: writes before an image, and the inside of a volume's
  storage, which is the backend's own; for host backends AddressSanitizer covers both (preset `asan`).
- **Inputs** are read back after the kernel has run, volumes that are only looked at included, and must
  be what they were.
- **Repeatability**: a second instance of the backend, with another number of threads where it has
  threads, must give the same bits.
- **State**: volumes are changed between two looks from the same place: nothing may be remembered.
- **`pipeline`** runs KinectFusion over a dozen frames, pictures included, and compares the poses:
  once kernel by kernel, and once fused, where half of one frame is nearer than the map says.
  Tracking is lost there and found again, and were the lost frame integrated, the poses behind it
  would differ.
- **`memory`** writes images and volumes and reads them back.

The reference is compared with nothing; tests of its own hold it against closed-form answers.
)";

}  // namespace

std::string to_text(const AgreementReport& report, std::size_t width) {
  return tables(report, width) + legend(report) + failures(report) + "\n" + conclusion(report);
}

std::string to_json(const AgreementReport& report) {
  Json json = {{"reference", fmt::format("{}/{}", reference_backend, name(reference_map))},
               {"seed", report.seed},
               {"agrees", report.agrees()},
               {"recordings", report.recordings}};
  json["backends"] = Json::array();
  for (const BackendState& backend : report.backends) {
    Json entry = {{"name", backend.name}, {"available", backend.availability.available}};
    if (backend.availability.available) {
      entry["device"] = backend.device;
    } else {
      entry["reason"] = backend.availability.reason;
    }
    json["backends"].push_back(entry);
  }
  json["results"] = Json::array();
  for (const Agreement& result : report.results) json["results"].push_back(as_json(result));
  return json.dump(2) + "\n";
}

std::string tolerances_markdown() {
  std::string text =
      "## Tolerances\n\n| kernel | may differ by at most | because |\n|---|---|---|\n";
  for (const Tolerance& tolerance : tolerance_table()) {
    text += fmt::format("| {} | {} | {} |\n", tolerance.check, limits_text(tolerance),
                        tolerance.reason);
  }
  return text;
}

std::string to_markdown(const AgreementReport& report) {
  std::string text = fmt::format("{}\n{}\n## Kernels, backends and maps\n\n{}", introduction,
                                 tolerances_markdown(), matrix_markdown(report));
  const std::string wrong = failures(report);
  if (!wrong.empty()) text += fmt::format("\n```\n{}```\n", wrong.substr(1));
  return text;
}

}  // namespace slambench
