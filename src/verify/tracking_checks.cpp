// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/se3.h"
#include "kernels/pixel.h"
#include "verify/checks.h"
#include "verify/compare.h"
#include "verify/inputs.h"
#include "verify/scenes.h"
#include "verify/trial.h"

namespace slambench {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// A live frame to be held against a model.
struct TrackInput {
  std::string name;
  Maps live, model;
  TrackParameters parameters;
  bool finite = true;
};

Pose small_motion(double scale) {
  Vector6 xi;
  xi << 0.011, -0.007, 0.009, 0.004, -0.006, 0.005;
  return se3_exp(xi * scale);
}

/// Model of one view and live frame of the same or a coarser size, from the poses of a recording.
TrackInput from_recording(const Recording& recording, std::size_t frame, bool coarse) {
  const View model = view(recording, frame - 1), live = view(recording, frame);
  const Image<float> depth = coarse ? halved(live.depth_m) : live.depth_m;
  TrackInput input;
  input.name = fmt::format("{} frame {}{}", recording.name, recording.frames[frame].index,
                           coarse ? " halved" : "");
  input.live = maps_of(depth, live.camera.divided_by(coarse ? 2.0f : 1.0f));
  input.model = moved(maps_of(model.depth_m, model.camera), model.T_volume_camera);
  input.parameters = {to_rigid3f(model.T_volume_camera),
                      to_rigid3f(model.T_volume_camera.inverse()), model.camera, 0.1f, 0.8f};
  return input;
}

/// Points and normals near the model's, so that every outcome occurs.
TrackInput perturbed(Size size, Random* random) {
  Pose pose = Pose::Identity();
  pose.translation() << 1.9, 2.1, 0.9;
  const Maps seen =
      maps_of(depth_of(room_scene(4.0), pose, camera_for(size), size), camera_for(size));
  TrackInput input{"perturbed " + text(size), seen, moved(seen, pose), {}};
  input.parameters = {to_rigid3f(pose * small_motion(1)), to_rigid3f(pose.inverse()),
                      camera_for(size), 0.1f, 0.8f};
  for (std::size_t i = 0; i < seen.vertices.count(); ++i) {
    Float3 &vertex = input.live.vertices.data()[i], &normal = input.live.normals.data()[i];
    vertex = vertex + random_unit_vector(random) * random->uniform_f(0, 0.12);
    if (normal.x != invalid_normal) {
      normal = normalized(normal + random_unit_vector(random) * random->uniform_f(0, 0.9));
    }
    if (random->chance(0.1)) normal = {invalid_normal, 0, 0};
    if (random->chance(0.1)) input.model.normals.data()[i] = {invalid_normal, 0, 0};
  }
  return input;
}

TrackInput spoiled(Size size, Random* random) {
  TrackInput input = perturbed(size, random);
  input.name = "not finite " + text(size);
  input.finite = false;
  for (Maps* maps : {&input.live, &input.model}) {
    spoil(&maps->vertices, random);
    spoil(&maps->normals, random);
  }
  return input;
}

TrackInput without_model(Size size, Random* random) {
  TrackInput input = perturbed(size, random);
  input.name = "no model " + text(size);
  input.model = {Image<Float3>({24, 17}), Image<Float3>({24, 17}, {invalid_normal, 0, 0})};
  return input;
}

std::vector<TrackInput> track_inputs(Trial& trial) {
  Random random = trial.random();
  std::vector<TrackInput> inputs;
  for (const Size size : image_sizes) inputs.push_back(perturbed(size, &random));
  inputs.push_back(spoiled({37, 23}, &random));
  inputs.push_back(spoiled({127, 65}, &random));
  inputs.push_back(without_model({37, 23}, &random));
  for (const Recording& recording : trial.recordings()) {
    if (recording.frames.size() < 2) continue;
    inputs.push_back(from_recording(recording, recording.frames.size() - 1, false));
    inputs.push_back(from_recording(recording, recording.frames.size() - 1, true));
  }
  return inputs;
}

double outcome_distance(const TrackData& expected, const TrackData& found) {
  return expected.outcome == found.outcome ? 0 : 1;
}

bool both_ok(const TrackData& a, const TrackData& b) {
  return a.outcome == TrackOutcome::ok && b.outcome == TrackOutcome::ok;
}

bool is_finite(const TrackData& row) {
  return std::isfinite(row.error) && std::all_of(std::begin(row.jacobian), std::end(row.jacobian),
                                                 [](float j) { return std::isfinite(j); });
}

/// What is not finite must not count; under which name is not told by the contract.
double counting_distance(const TrackData& expected, const TrackData& found) {
  return (expected.outcome == TrackOutcome::ok) == (found.outcome == TrackOutcome::ok) ? 0 : 1;
}

void compare_rows(Trial& trial, bool finite, const Image<TrackData>& expected,
                  const Image<TrackData>& found) {
  const Spread outcomes = spread(expected, found, 0, finite ? outcome_distance : counting_distance);
  trial.at_most("outcomes that differ, of pixels", outcomes.share_beyond(), outcomes.where);
  const double error_limit = trial.tolerance().allowed("error difference, m");
  const double jacobian_limit = trial.tolerance().allowed("jacobian difference");
  // In units of the limits.
  const Spread rows = spread(expected, found, 1, [&](const TrackData& e, const TrackData& f) {
    if (!both_ok(e, f) || !is_finite(e)) return 0.0;
    double distance = std::abs(static_cast<double>(e.error) - f.error) / error_limit;
    for (int i = 0; i < 6; ++i) {
      const double d = std::abs(static_cast<double>(e.jacobian[i]) - f.jacobian[i]);
      if (!(d / jacobian_limit <= distance)) distance = d / jacobian_limit;
    }
    return distance;
  });
  trial.at_most("rows apart by more, of pixels", rows.share_beyond(), rows.where);
}

/// Rows of which none, some or all count; those that do not hold no numbers.
Image<TrackData> random_rows(Size size, double ok, Random* random) {
  constexpr std::array others = {TrackOutcome::invalid_input, TrackOutcome::outside_model,
                                 TrackOutcome::invalid_model, TrackOutcome::too_far,
                                 TrackOutcome::wrong_normal};
  Image<TrackData> rows(size);
  for (TrackData& row : rows) {
    if (random->chance(ok)) {
      row.outcome = TrackOutcome::ok;
      row.error = random->uniform_f(-0.1, 0.1);
      const Float3 normal = random_unit_vector(random);
      const Float3 point{random->uniform_f(0, 5), random->uniform_f(0, 5), random->uniform_f(0, 5)};
      const Float3 moment = cross(point, normal);
      const float jacobian[] = {normal.x, normal.y, normal.z, moment.x, moment.y, moment.z};
      std::copy(std::begin(jacobian), std::end(jacobian), row.jacobian);
    } else {
      row.outcome = others[static_cast<std::size_t>(random->index(5))];
      row.error = std::numeric_limits<float>::quiet_NaN();
      std::fill(std::begin(row.jacobian), std::end(row.jacobian),
                std::numeric_limits<float>::infinity());
    }
  }
  return rows;
}

/// What the entries of a reduction are sums of, in absolute values.
Reduction absolute_sums(const Image<TrackData>& rows) {
  Reduction sum;
  for (TrackData row : rows) {
    row.error = std::abs(row.error);
    for (float& j : row.jacobian) j = std::abs(j);
    accumulate(row, &sum);
  }
  return sum;
}

void compare_reductions(Trial& trial, const Reduction& scale, const Reduction& expected,
                        const Reduction& found) {
  const bool equal = expected.inliers == found.inliers && expected.too_far == found.too_far &&
                     expected.wrong_normal == found.wrong_normal && expected.others == found.others;
  trial.at_most("counts that differ", equal ? 0 : 1,
                fmt::format("found {}, {}, {}, {}, expected {}, {}, {}, {}", found.inliers,
                            found.too_far, found.wrong_normal, found.others, expected.inliers,
                            expected.too_far, expected.wrong_normal, expected.others));
  double worst = 0;
  std::string where;
  const auto entry = [&](const std::string& name, double sum, double e, double f) {
    const double d = e == f ? 0 : std::abs(f - e) / sum;
    if (d <= worst) return;
    worst = d;
    where = fmt::format("{}: found {}, expected {}", name, f, e);
  };
  entry("squared_error", scale.squared_error, expected.squared_error, found.squared_error);
  for (int i = 0; i < 6; ++i) {
    entry(fmt::format("jt_error[{}]", i), scale.jt_error[i], expected.jt_error[i],
          found.jt_error[i]);
  }
  for (int i = 0; i < 21; ++i) {
    entry(fmt::format("jt_j[{}]", i), scale.jt_j[i], expected.jt_j[i], found.jt_j[i]);
  }
  trial.at_most("difference, of the sum of absolute values", worst, where);
}

/// Normal equations of random rows whose solution is known.
struct Equations {
  std::string name;
  Reduction reduction;
  bool well_conditioned = true;
};

/// `free` components of the motion leave no trace in the rows.
Equations random_equations(int free, double scale, Random* random) {
  Equations system{fmt::format("{} free components, scale {}", free, scale), {}, free == 0};
  Vector6 truth;
  for (double& component : truth) component = random->uniform(-0.01, 0.01);
  for (int i = 0; i < 200; ++i) {
    Vector6 row = Vector6::Zero();
    for (int k = 0; k < 6 - free; ++k) row[k] = scale * random->uniform(-1, 1);
    const double error = row.dot(truth) + scale * random->uniform(-1e-3, 1e-3);
    double* entry = system.reduction.jt_j;
    for (int k = 0; k < 6; ++k) {
      system.reduction.jt_error[k] += error * row[k];
      for (int l = k; l < 6; ++l) *entry++ += row[k] * row[l];
    }
    system.reduction.squared_error += error * error;
    ++system.reduction.inliers;
  }
  return system;
}

Vector6 direct_solution(const Reduction& reduction) {
  Matrix6 m;
  const double* entry = reduction.jt_j;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) m(row, column) = m(column, row) = *entry++;
  }
  return m.ldlt().solve(Vector6(Eigen::Map<const Vector6>(reduction.jt_error)));
}

double relative_distance(const Vector6& expected, const Vector6& found) {
  const double distance = (expected - found).norm();
  return distance == 0 ? 0 : distance / expected.norm();
}

std::string vector_text(const Twist& twist) {
  return fmt::format("({:.6g})", fmt::join(twist.v, ", "));
}

/// The pyramid of a live frame and the model, for the whole loop.
struct AlignCase {
  std::string name;
  std::vector<Maps> live;
  Maps model;
  TrackParameters parameters;
  Pose start = Pose::Identity();
  std::vector<int> iterations;
  double convergence = 1e-5;
  bool keep_rows = true;
};

AlignCase align_case(const Recording& recording, std::size_t frame, double offset,
                     std::vector<int> iterations) {
  const View model = view(recording, frame - 1), live = view(recording, frame);
  AlignCase c;
  c.name = fmt::format("{} frame {} offset {} iterations {}", recording.name,
                       recording.frames[frame].index, offset, fmt::join(iterations, ","));
  Image<float> depth = live.depth_m;
  for (std::size_t level = 0; level < iterations.size(); ++level) {
    c.live.push_back(maps_of(depth, live.camera.divided_by(static_cast<float>(1 << level))));
    depth = halved(depth);
  }
  c.model = moved(maps_of(model.depth_m, model.camera), model.T_volume_camera);
  c.start = model.T_volume_camera * small_motion(offset);
  c.parameters = {to_rigid3f(c.start), to_rigid3f(model.T_volume_camera.inverse()), model.camera,
                  0.1f, 0.8f};
  c.iterations = std::move(iterations);
  return c;
}

std::vector<AlignCase> align_cases(Trial& trial) {
  std::vector<AlignCase> cases;
  for (const Recording& recording : trial.recordings()) {
    if (recording.frames.size() < 2) continue;
    const std::size_t last = recording.frames.size() - 1;
    cases.push_back(align_case(recording, last, 0, {10, 5, 4}));
    cases.push_back(align_case(recording, last, 2, {10, 5, 4}));
    cases.push_back(align_case(recording, last, 1, {0, 3, 2}));
    cases.push_back(align_case(recording, last, 1, {6}));
    cases.push_back(cases.front());
    cases.back().keep_rows = false;
    cases.back().name += " without rows";
    cases.push_back(cases.front());
    const Size size = cases.back().model.normals.size();
    cases.back().model.normals = Image<Float3>(size, {invalid_normal, 0, 0});
    cases.back().name += " without model";
  }
  return cases;
}

using AlignOutput = std::tuple<AlignResult, Image<TrackData>>;

AlignOutput run_align(Workbench& bench, const AlignCase& c) {
  AlignInput input;
  std::vector<DeviceImage<TrackData>> rows;
  for (const Maps& maps : c.live) {
    input.vertices.push_back(&bench.input(maps.vertices));
    input.normals.push_back(&bench.input(maps.normals));
    rows.push_back(bench.backend().make_image<TrackData>(maps.vertices.size()));
    bench.backend().write(rows.back(), Image<TrackData>(maps.vertices.size()));
  }
  for (auto& image : rows) input.rows.push_back(&image);
  input.model_vertices = &bench.input(c.model.vertices);
  input.model_normals = &bench.input(c.model.normals);
  input.iterations = c.iterations;
  input.parameters = c.parameters;
  input.T_volume_camera = c.start;
  input.convergence = c.convergence;
  input.keep_rows = c.keep_rows;
  AlignResult result = bench.backend().align(input, 1e6);
  Image<TrackData> last;
  if (c.keep_rows) {
    last = bench.result(rows[static_cast<std::size_t>(result.last_level)]);
  }
  return {result, last};
}

void compare_poses(Trial& trial, const AlignResult& expected, const AlignResult& found) {
  const Pose difference = expected.T_volume_camera.inverse() * found.T_volume_camera;
  trial.at_most("translation, m", difference.translation().norm());
  trial.at_most("rotation, rad", Eigen::AngleAxisd(difference.linear()).angle());
}

void compare_alignments(Trial& trial, const AlignCase& c, const AlignOutput& expected,
                        const AlignOutput& found) {
  const AlignResult &e = std::get<0>(expected), &f = std::get<0>(found);
  compare_poses(trial, e, f);
  double apart =
      e.iterations.size() == f.iterations.size() && e.last_level == f.last_level ? 0 : HUGE_VAL;
  for (std::size_t i = 0; i < std::min(e.iterations.size(), f.iterations.size()); ++i) {
    apart = std::max(apart, std::abs(static_cast<double>(e.iterations[i] - f.iterations[i])));
  }
  trial.at_most("iterations", apart,
                fmt::format("found {}, expected {}", fmt::join(f.iterations, ","),
                            fmt::join(e.iterations, ",")));
  const Size size = c.live[static_cast<std::size_t>(e.last_level)].vertices.size();
  trial.at_most("inliers that differ, of pixels",
                std::abs(static_cast<double>(e.last.inliers - f.last.inliers)) /
                    static_cast<double>(size.count()),
                fmt::format("found {}, expected {}", f.last.inliers, e.last.inliers));
  const double error = std::abs(e.last.squared_error - f.last.squared_error);
  trial.at_most("mean squared error, relative", error == 0 ? 0 : error / e.last.squared_error);
  if (!c.keep_rows || apart == HUGE_VAL) return;
  const Spread outcomes = spread(std::get<1>(expected), std::get<1>(found), 0, outcome_distance);
  trial.at_most("outcomes that differ, of pixels", outcomes.share_beyond(), outcomes.where);
}

}  // namespace

void check_track(Trial& trial) {
  for (const TrackInput& input : track_inputs(trial)) {
    trial.add(
        input.name,
        [&](Workbench& bench) {
          auto& rows = bench.output<TrackData>(input.live.vertices.size());
          bench.backend().track(rows, bench.input(input.live.vertices),
                                bench.input(input.live.normals), bench.input(input.model.vertices),
                                bench.input(input.model.normals), input.parameters);
          return bench.result(rows);
        },
        [&](const Image<TrackData>& expected, const Image<TrackData>& found) {
          compare_rows(trial, input.finite, expected, found);
        });
  }
}

void check_reduce(Trial& trial) {
  Random random = trial.random();
  for (const Size size : image_sizes) {
    for (const double ok : {0.0, 0.1, 0.7, 1.0}) {
      const Image<TrackData> rows = random_rows(size, ok, &random);
      trial.add(
          fmt::format("{} % ok {}", ok * 100, text(size)),
          [&](Workbench& bench) { return bench.backend().reduce(bench.input(rows)); },
          [&](const Reduction& expected, const Reduction& found) {
            compare_reductions(trial, absolute_sums(rows), expected, found);
          });
    }
  }
}

void check_solve(Trial& trial) {
  Random random = trial.random();
  std::vector<Equations> systems;
  for (int free = 0; free <= 6; ++free) systems.push_back(random_equations(free, 1, &random));
  for (const double scale : {1e-3, 1e3}) systems.push_back(random_equations(0, scale, &random));
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    systems.push_back(random_equations(0, 1, &random));
    systems.back().name = fmt::format("an entry {}", value);
    systems.back().well_conditioned = false;
    systems.back().reduction.jt_j[7] = value;
  }
  for (const Equations& system : systems) {
    trial.add(
        system.name, [&](Workbench& bench) { return bench.backend().solve(system.reduction, 1e6); },
        [&](const Twist& expected, const Twist& found) {
          const Vector6 motion = Eigen::Map<const Vector6>(found.v);
          const Vector6 wanted = Eigen::Map<const Vector6>(expected.v);
          const std::string where =
              fmt::format("found {}, expected {}", vector_text(found), vector_text(expected));
          trial.at_most("difference, of the motion", relative_distance(wanted, motion), where);
          if (!system.well_conditioned) return;
          const Vector6 truth = direct_solution(system.reduction);
          trial.at_most("difference from the truth, of the motion",
                        relative_distance(truth, motion), where);
        });
  }
}

void check_align(Trial& trial) {
  for (const AlignCase& c : align_cases(trial)) {
    trial.add(
        c.name, [&](Workbench& bench) { return run_align(bench, c); },
        [&](const AlignOutput& expected, const AlignOutput& found) {
          compare_alignments(trial, c, expected, found);
        });
  }
}

}  // namespace slambench
