// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <span>
#include <string>
#include <vector>

#include "datasets/source.h"

namespace slambench {

/// The short name of a sequence in this folder or file: its last part, without an extension ".raw"
/// and without TUM's prefix "rgbd_dataset_".
std::string sequence_name(const std::string& path);

/// What is at a path, links followed; false for what cannot be looked at.
bool is_present(const std::string& path);
bool is_file(const std::string& path);
bool is_folder(const std::string& path);

/// The names of what lies in a folder, sorted. Throws InputError naming the folder.
std::vector<std::string> folder_entries(const std::string& folder);

/// Axes of the ICL-NUIM cameras and poses: y points up.
void set_axes_y_up(SequenceInfo* info);

/// The parameters, with the camera that the text file ("fx fy cx cy", '#' begins a comment) gives
/// unless the user gave one or there is no such file. Throws InputError naming file and line.
SourceParameters with_camera_file(SourceParameters parameters, const std::string& file);

/// What every layout does alike, once its reader has filled in the rest: `info->camera` comes as
/// that of a 640x480 image and is scaled to `depth_size`; the user's camera, depth scale and ground
/// truth override the sequence's own; the ground truth is read and compared with the frames' time
/// stamps (sorted); one named as ICL-NUIM's has its axes; settings that suit the sequence are
/// suggested unless the reader has.
/// `ground_truth_file` is the sequence's own, "" for none; poses that a reader has put into
/// `info->ground_truth` itself are weaker than both files.
/// Throws InputError for a bad ground truth or one that belongs to none of the frames, UsageError
/// for a camera without focal length.
void complete_info(const SourceParameters& parameters, const std::string& ground_truth_file,
                   std::span<const double> stamps_s, SequenceInfo* info);

}  // namespace slambench
