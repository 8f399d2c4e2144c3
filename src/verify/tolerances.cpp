// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "verify/tolerances.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace slambench {
namespace {

const std::array<Tolerance, 18>& table() {
  static const std::array<Tolerance, 18> tolerances = {{
      {"mm2meters",
       {{"relative difference", 0}},
       "One division, correctly rounded; what comes later compares with zero and with thresholds."},
      {"bilateral_filter",
       {{"relative difference", 1e-5}},
       "25 weights, each with an exponential of its own making and rounding; the mean cancels most "
       "of it. Where there is no depth there is none in the result."},
      {"half_sample",
       {{"relative difference", 1e-6}},
       "A sum of at most four values in any order and a division; which values count is decided "
       "by a subtraction that rounds alike everywhere."},
      {"depth2vertex",
       {{"relative difference", 1e-6}},
       "Dividing by the focal length or multiplying by its inverse differs by two roundings; "
       "relative to the point's distance."},
      {"vertex2normal",
       {{"validity that differs, of pixels", 0},
        {"difference", 1e-4},
        {"normals apart by more, of pixels", 1e-3}},
       "The cross product cancels where a surface is seen edge-on: rounding grows by one over the "
       "sine between the two tangents there."},
      {"track",
       {{"outcomes that differ, of pixels", 1e-3},
        {"error difference, m", 1e-5},
        {"jacobian difference", 1e-5},
        {"rows apart by more, of pixels", 1e-3}},
       "A point that falls on the border of two model pixels, or on a threshold, may go either "
       "way by one rounding, and then meets another model point; other rows differ by the "
       "rounding of coordinates of a few metres."},
      {"reduce",
       {{"counts that differ", 0}, {"difference, of the sum of absolute values", 1e-5}},
       "Any order of summation, partial sums in single precision included; rows that are not ok "
       "must not count, whatever they hold."},
      {"solve",
       {{"difference, of the motion", 1e-6}, {"difference from the truth, of the motion", 1e-6}},
       "Double precision and a condition of up to a thousand leave ten digits; systems that do "
       "not determine the motion give the shortest one, systems that are not finite none."},
      {"align",
       {{"translation, m", 2e-5},
        {"rotation, rad", 1e-4},
        {"iterations", 1},
        {"inliers that differ, of pixels", 1e-3},
        {"mean squared error, relative", 1e-3},
        {"outcomes that differ, of pixels", 2e-3}},
       "The loop ends when a step is below 1e-5, so that one iteration more or less moves the "
       "pose by up to that; outcomes flip at thresholds as in track, from poses that differ."},
      {"integrate",
       {{"distances apart by more than 2 units, of voxels", 1e-3},
        {"weights that differ, of voxels", 5e-4}},
       "A voxel that projects onto the border of two pixels may take either one's depth. Counted "
       "of the voxels that changed, not of all."},
      {"raycast",
       {{"hits that differ, of pixels", 1e-3},
        {"vertex difference, m", 1e-4},
        {"normal difference", 1e-2},
        {"vertices or normals apart by more, of pixels", 2e-3}},
       "A ray that grazes a silhouette may hit or miss by one rounding, and a sample at a "
       "threshold changes where the next ones lie; elsewhere the crossing is interpolated between "
       "the same voxels."},
      {"render_depth",
       {{"level difference", 1}},
       "The ramp is rounded to 256 levels; which side of near and far a pixel lies on is exact."},
      {"render_track", {{"level difference", 0}}, "A colour per outcome."},
      {"render_volume",
       {{"level difference", 2}, {"pixels apart by more, of pixels", 2e-3}},
       "Shading is smooth in the normal, which may differ as in raycast; so may silhouettes."},
      {"init_volume", {{"voxels that differ", 0}}, "A constant."},
      {"generate_gaussian",
       {{"relative difference", 1e-5}},
       "An exponential to within a few units in the last place, and the rounding of its argument."},
      {"memory",
       {{"values that differ", 0}},
       "What is written to a backend's memory is what is read from it, in every shape."},
      {"pipeline",
       {{"tracked frames that differ", 0},
        {"lost frames that are not", 0},
        {"translation, m", 1e-4},
        {"rotation, rad", 1e-4}},
       "Differences of single kernels within their tolerances, carried from frame to frame by map "
       "and pose."},
  }};
  return tolerances;
}

}  // namespace

double Tolerance::allowed(std::string_view quantity) const {
  for (const auto& some : {std::span<const Limit>(limits), common_limits()}) {
    for (const Limit& limit : some) {
      if (limit.quantity == quantity) return limit.allowed;
    }
  }
  throw std::invalid_argument("tolerance of " + std::string(check) + ": no limit for " +
                              std::string(quantity));
}

std::span<const Tolerance> tolerance_table() { return table(); }

std::span<const Limit> common_limits() {
  static constexpr Limit limits[] = {
      {"exception", 0},
      {"differs when repeated", 0},
      {"input pixels modified", 0},
      {"input voxels modified", 0},
      {"output pixels not written", 0},
      {"pixels written past the end", 0},
  };
  return limits;
}

}  // namespace slambench
