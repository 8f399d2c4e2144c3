// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/intrinsics.h"
#include "datasets/source.h"

namespace slambench {

/// The camera of ICL-NUIM (Handa et al., ICRA 2014). It is published with fy = -480, because its y
/// axis points up; this is the same camera with y down.
inline constexpr Intrinsics icl_nuim_camera = {481.2F, 480, 319.5F, 239.5F};
/// The one that SLAMBench 1's published commands give for the same images, half a pixel off.
inline constexpr Intrinsics slambench1_icl_nuim_camera = {481.2F, 480, 320, 240};

/// The one of the two that the user means.
Intrinsics default_icl_nuim_camera(const SourceParameters& parameters);

/// The ground-truth file *.gt.freiburg in a folder of ICL-NUIM, "" for none; with several the first
/// by name, and a note.
std::string icl_nuim_ground_truth(const std::string& folder, std::vector<std::string>* notes);

/// The native layout of ICL-NUIM. Per frame F of scene S: scene_S_F.depth, distances from the
/// camera's centre in metres as text, row by row; scene_S_F.png, colour (optional); scene_S_F.txt,
/// POV-Ray's camera (optional); and *.gt.freiburg, all poses (optional, preferred). Time stamps are
/// the numbers F. Depth is delivered along the optical axis in 1/5000 m.
bool is_icl_nuim(const std::string& sequence);
std::unique_ptr<Source> open_icl_nuim(const std::string& sequence, const SourceParameters&);

/// The TUM-compatible layout of ICL-NUIM: depth/N.png of 5000 units per metre, rgb/N.png
/// (optional), depth.txt or associations.txt (optional), *.gt.freiburg (optional). Time stamps are
/// the numbers of frames: the pose with stamp N is that of image N, and image 0 has none.
bool is_icl_nuim_tum(const std::string& sequence);
std::unique_ptr<Source> open_icl_nuim_tum(const std::string& sequence, const SourceParameters&);

}  // namespace slambench
