// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/frame.h"
#include "core/intrinsics.h"
#include "core/parameter.h"
#include "core/trajectory.h"

namespace slambench {

/// What a user can say about any source.
struct SourceParameters {
  std::optional<std::array<double, 4>> camera;  ///< overrides the source's fx,fy,cx,cy
  std::string icl_nuim_camera = "dataset";      ///< or "slambench1"
  std::optional<double> depth_scale;            ///< overrides the file's depth units per metre
  std::string ground_truth;                     ///< file that overrides the source's own
  bool noise = false;                           ///< living-room only
  int noise_seed = 0;

  ParameterList describe();
};

/// What is known of a sequence before a frame is read.
struct SequenceInfo {
  std::string name;    ///< short, for people and folder names: "living-room/2", "kt3_400"
  std::string layout;  ///< "icl-nuim", "icl-nuim-tum", "tum-rgbd", "slambench-raw", "living-room"
  std::string path;    ///< as opened; empty for built-in sequences
  int frame_count = 0;
  Size depth_size;
  Intrinsics camera;  ///< y-down, at depth_size; after overrides
  float units_per_m = 1000;
  bool has_color = false;
  double fps = 30;  ///< nominal rate, from the time stamps where they are times
  double first_time_s = 0, last_time_s = 0;  ///< own time stamps of the first and last frame

  /// The sequence's own axes: `own_from_camera` maps the y-down camera axes used here to those of
  /// its ground truth (diag(1,-1,1) for ICL-NUIM, identity else). A pose T here is
  /// own_from_camera * T * own_from_camera^-1 there.
  Eigen::Matrix3d own_from_camera = Eigen::Matrix3d::Identity();
  std::string axes;         ///< in words, for people
  Trajectory ground_truth;  ///< in the sequence's own axes and time stamps; may be empty
  std::string ground_truth_file;
  int frames_with_ground_truth = 0;  ///< frames that have a pose closer than 0.02 s

  /// Settings that suit this sequence (parameter name, value), weaker than any the user makes.
  std::vector<std::pair<std::string, std::string>> suggested;
  std::vector<std::string> notes;  ///< what the reader had to assume or skip, for people
};

/// Is told while frames are made ready; returns false to end that early.
using PrepareProgress = std::function<bool(int done, int total)>;

/// A recorded or rendered RGB-D sequence with random access.
class Source {
 public:
  virtual ~Source() = default;
  virtual const SequenceInfo& info() const = 0;
  /// Makes the first `frames` frames ready to be read without delay: a sequence that is rendered is
  /// rendered here, a recording has nothing to do. Throws Error(failed) when `progress` ends it
  /// early; what is ready by then stays so.
  virtual void prepare(int /*frames*/, const PrepareProgress& /*progress*/) {}
  /// Reads frame `index`; the frame's buffers are reused. Throws InputError naming the file.
  virtual void read(int index, Frame& frame) = 0;
  /// The time stamp that `read` gives frame `index`. Reads the frame unless a source knows better.
  virtual double time_s(int index) {
    Frame frame;
    read(index, frame);
    return frame.time_s;
  }

  /// Whether `read` fills in the colour image too. Only pictures need it, and decoding it takes as
  /// long as the depth does: off unless asked for, and `Frame::color` is empty then.
  void set_color(bool wanted) { wants_color_ = wanted; }

 protected:
  bool wants_color() const { return wants_color_; }

 private:
  bool wants_color_ = false;
};

/// A layout that can be read, for detection and listing.
struct SourceEntry {
  std::string_view layout;
  std::string_view sentence;
  /// Whether `sequence` (a path, or a built-in name) looks like this layout.
  bool (*matches)(const std::string& sequence);
  std::unique_ptr<Source> (*open)(const std::string& sequence, const SourceParameters&);
  /// Why it cannot be opened in this build, and what would help; empty when it can.
  std::string_view unavailable = {};
};

/// In the order of detection.
const std::vector<SourceEntry>& source_table();

/// The parameters that readers suggest values for (SequenceInfo::suggested).
inline constexpr std::string_view suggested_parameters[] = {"compute-size-ratio", "volume-size",
                                                            "init-pose"};

/// What a sequence's own settings are called: a configuration file as --config takes it.
inline constexpr std::string_view sequence_settings = "slambench.toml";

/// Where they are: in the sequence's folder, or beside its file. "" when there are none.
std::string sequence_settings_file(const std::string& sequence);

/// Opens a sequence, whatever its layout. Throws InputError that says what was looked for when
/// nothing matches, UnavailableError for a layout that was not built in.
std::unique_ptr<Source> open_source(const std::string& sequence, const SourceParameters&);

}  // namespace slambench
