// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "commands.h"
#include "config/settings.h"
#include "io/trajectory_file.h"
#include "metrics/trajectory_metrics.h"
#include "parameter_options.h"
#include "terminal.h"

namespace slambench {
namespace {

using Json = nlohmann::ordered_json;

/// How two trajectories are compared.
struct EvaluateParameters {
  std::string association = "evo";
  std::optional<double> max_difference_s;
  std::string alignment = "se3";
  double rpe_delta = 1;
  std::string rpe_unit = "seconds";

  ParameterList describe() {
    return {"evaluate",
            {{"association",
              0,
              "",
              &association,
              0,
              0,
              "how poses are paired by time: tum, one-to-one with the smallest difference first, "
              "and the relative error by that benchmark's rules; evo, the nearest pose each",
              {"tum", "evo"}},
             {"max-difference", 0, "s", &max_difference_s, 0, 1e9,
              "largest time difference of a pair; unless given 0.02 for tum, 0.01 for evo"},
             {"alignment",
              0,
              "",
              &alignment,
              0,
              0,
              "what is fitted before the absolute error is taken",
              {"none", "first-pose", "se3", "sim3", "all"}},
             {"rpe-delta", 0, "", &rpe_delta, 1e-9, 1e9,
              "how far apart the poses are that the relative error compares"},
             {"rpe-unit",
              0,
              "",
              &rpe_unit,
              0,
              0,
              "what that distance is counted in",
              {"seconds", "frames", "meters"}}}};
  }
};

struct Arguments {
  std::string estimate_file, truth_file;
  bool json = false;
  EvaluateParameters parameters;
  ParameterOptions options;
};

/// The word of the command line for each; table and JSON use the same.
const std::vector<std::pair<std::string, Alignment>>& alignment_words() {
  static const std::vector<std::pair<std::string, Alignment>> words = {
      {"none", Alignment::none},
      {"first-pose", Alignment::first_pose},
      {"se3", Alignment::se3},
      {"sim3", Alignment::sim3}};
  return words;
}

DeltaUnit delta_unit(const std::string& word) {
  if (word == "frames") return DeltaUnit::frames;
  return word == "meters" ? DeltaUnit::meters : DeltaUnit::seconds;
}

/// "1 s", "5 frames", "0.5 m".
std::string distance_text(const EvaluateParameters& p) {
  const char* unit = p.rpe_unit == "seconds" ? "s" : (p.rpe_unit == "meters" ? "m" : "frames");
  return fmt::format("{} {}", p.rpe_delta, unit);
}

/// All that is said about two trajectories.
struct Evaluation {
  Association rule = Association::evo;
  double max_difference_s = 0;
  std::size_t estimate_poses = 0, truth_poses = 0, matched = 0, lost = 0;
  std::map<std::string, AteResult> ate;
  RpeResult rpe;
  std::map<std::string, std::string> absent;  ///< figure -> why
};

void evaluate_ate(const PairedTrajectories& paired, const std::string& wanted, Evaluation* result) {
  for (const auto& [word, alignment] : alignment_words()) {
    if (wanted != "all" && wanted != word) continue;
    try {
      result->ate[word] =
          absolute_trajectory_error(paired.estimate, paired.ground_truth, alignment);
    } catch (const InputError& error) {
      if (wanted != "all") throw;
      result->absent["ate_m." + word] = error.what();
    }
  }
}

Evaluation evaluate(const Arguments& arguments) {
  const EvaluateParameters& p = arguments.parameters;
  const Trajectory estimate = read_trajectory(arguments.estimate_file);
  const Trajectory truth = read_trajectory(arguments.truth_file);

  Evaluation result;
  result.rule = p.association == "tum" ? Association::tum : Association::evo;
  result.max_difference_s = p.max_difference_s.value_or(default_limit_s(result.rule));
  const PosePairs pairs = associate(estimate, truth, result.rule, result.max_difference_s);
  std::set<std::size_t> matched;
  for (const auto& pair : pairs) matched.insert(pair.first);
  result.estimate_poses = estimate.size();
  result.truth_poses = truth.size();
  result.matched = pairs.size();
  result.lost = estimate.size() - matched.size();
  if (pairs.empty()) {
    throw InputError(
        arguments.estimate_file, "time stamps",
        fmt::format("none within {} s of one in {}", result.max_difference_s, arguments.truth_file),
        "two trajectories of the same time");
  }
  const PairedTrajectories paired = select(estimate, truth, pairs);
  evaluate_ate(paired, p.alignment, &result);
  const DeltaUnit unit = delta_unit(p.rpe_unit);
  result.rpe = result.rule == Association::tum
                   ? tum_relative_pose_error(estimate, truth, p.rpe_delta, unit)
                   : relative_pose_error(paired.estimate, paired.ground_truth, p.rpe_delta, unit);
  if (result.rpe.translation_m.count == 0) {
    result.absent["rpe"] = fmt::format("no two matched poses are {} apart", distance_text(p));
  }
  return result;
}

Json as_json(const Statistics& s) {
  return {{"count", s.count},   {"rmse", s.rmse}, {"mean", s.mean},
          {"median", s.median}, {"std", s.std},   {"min", s.min},
          {"max", s.max},       {"p95", s.p95},   {"p99", s.p99}};
}

Json as_json(const Similarity& s) {
  const Eigen::Quaterniond q(s.rigid.linear());
  const Eigen::Vector3d t = s.rigid.translation();
  return {{"scale", s.scale},
          {"translation_m", {t.x(), t.y(), t.z()}},
          {"rotation_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
}

std::string json_text(const Arguments& arguments, const Evaluation& e) {
  const EvaluateParameters& p = arguments.parameters;
  Json json = {{"estimate", {{"file", arguments.estimate_file}, {"poses", e.estimate_poses}}},
               {"ground_truth", {{"file", arguments.truth_file}, {"poses", e.truth_poses}}},
               {"association", {{"rule", name(e.rule)}, {"max_difference_s", e.max_difference_s}}},
               {"matched", e.matched},
               {"total", e.estimate_poses},
               {"lost", e.lost}};
  json["ate_m"] = Json::object();
  for (const auto& [word, ate] : e.ate) {
    json["ate_m"][word] = as_json(ate.statistics);
    json["ate_m"][word]["alignment"] = as_json(ate.alignment);
  }
  if (e.rpe.translation_m.count > 0) {
    json["rpe"] = {{"delta", p.rpe_delta},
                   {"unit", p.rpe_unit},
                   {"translation_m", as_json(e.rpe.translation_m)},
                   {"rotation_deg", as_json(e.rpe.rotation_deg)}};
  }
  json["absent"] = e.absent;
  // A file name may hold bytes that are not UTF-8, which JSON cannot.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string heading(const char* first) {
  return fmt::format("{:<14}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}\n", first, "rmse", "mean",
                     "median", "std", "min", "max");
}

std::string row(const std::string& first, const Statistics& s) {
  return fmt::format("{:<14}{:>11.6f}{:>11.6f}{:>11.6f}{:>11.6f}{:>11.6f}{:>11.6f}\n", first,
                     s.rmse, s.mean, s.median, s.std, s.min, s.max);
}

std::string table_text(const Arguments& arguments, const Evaluation& e) {
  const EvaluateParameters& p = arguments.parameters;
  std::string text;
  text += fmt::format("estimate      {} ({} poses)\n", arguments.estimate_file, e.estimate_poses);
  text += fmt::format("ground truth  {} ({} poses)\n", arguments.truth_file, e.truth_poses);
  text += fmt::format("matched       {} pairs by the rule of {}, within {} s\n", e.matched,
                      name(e.rule), e.max_difference_s);
  text += fmt::format("lost          {} of {} poses of the estimate\n", e.lost, e.estimate_poses);

  text += "\nAbsolute trajectory error, m\n" + heading("alignment");
  for (const auto& [word, alignment] : alignment_words()) {
    const auto ate = e.ate.find(word);
    if (ate != e.ate.end()) text += row(word, ate->second.statistics);
  }
  const auto sim3 = e.ate.find("sim3");
  if (sim3 != e.ate.end()) {
    text += fmt::format("scale of sim3 {:>11.6f}\n", sim3->second.alignment.scale);
  }
  if (e.rpe.translation_m.count > 0) {
    text += fmt::format("\nRelative pose error over {}, {} pairs\n", distance_text(p),
                        e.rpe.translation_m.count);
    text += heading("") + row("translation m", e.rpe.translation_m) +
            row("rotation deg", e.rpe.rotation_deg);
  }
  if (!e.absent.empty()) text += "\nNot measured\n";
  for (const auto& [figure, reason] : e.absent) text += fmt::format("{}: {}\n", figure, reason);
  return text;
}

}  // namespace

Action add_evaluate(CLI::App& command) {
  auto arguments = std::make_shared<Arguments>();
  command.add_option("ESTIMATE", arguments->estimate_file, "trajectory to be judged, TUM format")
      ->required();
  command.add_option("GROUND_TRUTH", arguments->truth_file, "trajectory to judge it by")
      ->required();
  arguments->options.add(command, {arguments->parameters.describe()});
  for (CLI::Option* option : command.get_options({})) {
    if (!option->get_positional()) option->group("Options");
  }
  command.add_flag("--json", arguments->json, "the result as one JSON object");
  return [arguments] {
    Settings settings({arguments->parameters.describe()});
    arguments->options.apply(settings);
    const Evaluation result = evaluate(*arguments);
    print(arguments->json ? json_text(*arguments, result) : table_text(*arguments, result));
    return ExitStatus::ok;
  };
}

}  // namespace slambench
