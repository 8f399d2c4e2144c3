// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <iterator>

#include "results/writers.h"

namespace slambench {

std::string slambench1_log(const Record& record) {
  std::string text =
      "frame\tacquisition\tpreprocessing\ttracking\tintegration\traycasting\trendering\t"
      "computation\ttotal\tX\tY\tZ\ttracked\tintegrated\n";
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (const FrameRecord& frame : record.frames) {
    if (frame.dropped) continue;
    const FrameTimes& t = frame.times;
    fmt::format_to(std::back_inserter(text),
                   "{}\t{:.6f}\t{:.6f}\t{:.6f}\t{:.6f}\t{:.6f}\t{:.6f}\t{:.6f}\t{:.6f}\t"
                   "{:.6f}\t{:.6f}\t{:.6f}\t{}\t{}\n",
                   frame.index, t.stage(Stage::acquire), t.stage(Stage::preprocess),
                   t.stage(Stage::track), t.stage(Stage::integrate), t.stage(Stage::raycast),
                   t.stage(Stage::render), t.computation_s(), t.total_s(), before.x(), before.y(),
                   before.z(), frame.tracked ? 1 : 0, frame.integrated ? 1 : 0);
    before = frame.T_start_camera.translation();
  }
  return text;
}

}  // namespace slambench
