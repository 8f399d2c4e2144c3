// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace slambench {

/// What lies in a folder that this program writes.
struct FolderKind {
  std::string_view contents;  ///< "results of an earlier run"
  std::string_view mark;      ///< the file that a whole one has, and that comes into place last
  bool (*is_one)(const std::filesystem::path& folder);  ///< only such a one is ever replaced
};

/// A folder that appears whole or not at all. Until commit() everything lies in a folder of its
/// own, named ".NAME.slambench-partial" beside the place, or ".slambench-partial" inside a folder
/// that exists and is to stay: an empty one, a mount point, or one that this process works in. Only
/// a killed process leaves it behind, and the next one that writes to the same place removes it.
class WholeFolder {
 public:
  /// Checks and reserves the place. Throws UsageError when `path` is a file, when it holds anything
  /// and `force` is not set, when it holds anything but a whole folder of the kind and `force` is
  /// set, and when somebody else is writing to it; Error naming the folder and the system's reason
  /// when nothing can be written there.
  WholeFolder(const std::string& path, bool force, const FolderKind& kind);
  /// Leaves no trace when commit() was not reached.
  ~WholeFolder();
  WholeFolder(const WholeFolder&) = delete;
  WholeFolder& operator=(const WholeFolder&) = delete;

  /// Where it will be, as the user named it.
  const std::string& path() const { return path_; }
  /// Whether that file would lie in the place.
  bool contains(const std::string& file) const;
  /// Where a file of this name is to be written until commit().
  std::string file(const std::string& name) const { return partial_ / name; }
  /// Makes a folder inside. Throws Error.
  void make_folder(const std::string& name) const;
  /// Puts it in its place. Throws Error naming what failed; an earlier one is still there then.
  void commit();

 private:
  void inspect(bool force);
  void create_parents(const std::filesystem::path& folder);
  void reserve();
  void remove_traces() noexcept;
  void move_folder();
  void move_files();

  const std::string path_;
  const FolderKind kind_;
  const std::filesystem::path target_;  ///< absolute, links followed
  bool inside_ = false;                 ///< the partial folder lies in the target, which stays
  bool replaces_ = false;               ///< an earlier one
  std::filesystem::path partial_;
  std::vector<std::filesystem::path> created_;  ///< parents made for this, outermost first
  int lock_ = -1;                               ///< held on the partial folder while this lives
  bool moving_ = false, committed_ = false;
};

}  // namespace slambench
