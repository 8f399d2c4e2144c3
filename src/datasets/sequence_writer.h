// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "datasets/source.h"
#include "scene/rendered_sequence.h"

namespace slambench {

/// How a sequence is written.
enum class WrittenLayout {
  tum,  ///< TUM RGB-D: depth/ and rgb/, depth.txt, rgb.txt, groundtruth.txt, and camera.txt
  icl,  ///< ICL-NUIM's own: scene_00_NNNN.depth and .png, NAME.gt.freiburg in axes with y up
  raw,  ///< SLAMBench 1: sequence.raw, sequence.groundtruth.txt, sequence.camera.txt
};

struct WrittenSequence {
  WrittenLayout layout = WrittenLayout::tum;
  int frames = 0;          ///< at most as many as the trajectory has poses
  std::string trajectory;  ///< names ICL-NUIM's ground-truth file: "livingRoom2", "traj0"
  std::string sentence;    ///< what it shows, for people
  /// Settings that suit it (parameter name, value).
  std::vector<std::pair<std::string, std::string>> suggested;
};

/// Renders the sequence with all cores and writes it to the folder, with its ground truth, the
/// surface (surface.ply) in the world of the ground truth, and slambench.toml, a configuration for
/// running it. `progress` is told the frames done. Returns the indices of frames that see nothing
/// of the surface within the depth that the layout can hold. Throws as WholeFolder does;
/// UsageError for fewer frames than the layout needs; InputError when no frame sees anything; Error
/// when writing fails or `progress` ends it: nothing is left then.
std::vector<int> write_sequence(const RenderedSequence& sequence, const Mesh& surface,
                                const WrittenSequence& what, const std::string& folder, bool force,
                                const PrepareProgress& progress);

}  // namespace slambench
