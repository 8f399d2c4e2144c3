// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include "results/run_statistics.h"
#include "results/writers.h"

namespace slambench {
namespace {

constexpr std::string_view files = R"(
Files
  record.json     the run in figures: where it was made and from what, every
                  parameter, times per stage and kernel, accuracy, validity.
                  A figure that is missing has its reason under "absent".
  frames.csv      a row a frame: pose, errors against ground truth, tracking, when
                  it began, seconds and calls of every stage and kernel. Comma separated
                  (RFC 4180); a field is empty where there is no value.
  trajectory.tum  the estimated camera: "time tx ty tz qx qy qz qw" (metres, unit
                  quaternion), camera to world, in the sequence's own axes and
                  time stamps; the world is the first camera.
  slambench1.log  the log of SLAMBench 1: 14 columns, tab separated, seconds and
                  metres. As published, X Y Z of a row is the position BEFORE its
                  frame was tracked, in the start camera's axes (y down).
)";

constexpr std::string_view ground_truth =
    R"(  groundtruth.tum the true camera in the same format, axes and stamps.
)";

constexpr std::string_view samples =
    R"(  samples.csv     what sensors said over time: meter, unit, seconds since the first
                  frame, value.
)";

constexpr std::string_view images =
    R"(  images/         pictures of some frames, named by frame: the colour image, where
                  the sequence has one, the depth image, what became of each
                  pixel in tracking (grey used, black no measurement, red outside
                  the view, green no surface there, blue too far, yellow wrong
                  direction) and the reconstruction.
)";

constexpr std::string_view evaluation = R"(
To judge the trajectory again, by this program or by evo:
  slambench evaluate trajectory.tum groundtruth.tum
  evo_ape tum groundtruth.tum trajectory.tum --align
)";

}  // namespace

std::string readme_text(const Record& record, bool with_images) {
  const Provenance& p = record.provenance;
  std::string text = fmt::format(
      "Results of one run of SLAMBench {} (commit {})\n\n"
      "Sequence  {}, {} of {} frames processed\n"
      "Backend   {} on {}\n"
      "Started   {}\n"
      "Command   {}\n",
      p.version, p.commit, record.sequence, frame_counts(record).processed, record.sequence_frames,
      p.backend, p.device, p.started_at, p.command);
  if (!record.complete) {
    text += fmt::format("\nINCOMPLETE: {}\n", record.incomplete_reason.empty()
                                                  ? "the run was interrupted"
                                                  : record.incomplete_reason);
  }
  const auto reasons = reasons_invalid(record);
  for (const std::string& reason : reasons) text += fmt::format("\nINVALID: {}\n", reason);
  text += files;
  const bool judged = !record.ground_truth.empty();
  if (judged) text += ground_truth;
  if (record.measurements.sampling) text += samples;
  if (with_images) text += images;
  if (!record.ground_truth_file.empty()) {
    text += fmt::format("\nGround truth: {}\n", record.ground_truth_file);
  }
  if (judged) text += evaluation;
  return text;
}

}  // namespace slambench
