// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace slambench {

/// Whether `slambench run` left its results there: whether the folder has a record.json.
bool is_result_folder(const std::filesystem::path& folder);

/// The result folders in a folder, hidden ones left out, in order of their names; in that of a
/// suite (suite.json) also those one level deeper. Throws InputError naming a folder that cannot be
/// read, with the system's reason.
std::vector<std::string> result_folders_in(const std::string& folder);

/// The result folders that the arguments name: each is one, or holds some, which come in order of
/// their names; none comes twice. Throws InputError for what is neither.
std::vector<std::string> find_result_folders(const std::vector<std::string>& arguments);

/// For each folder the shortest end of its path that tells it from the others: "openmp", or
/// "monday/openmp" beside "tuesday/openmp". A number alone says nothing: "openmp/1".
std::vector<std::string> short_names(const std::vector<std::string>& folders);

}  // namespace slambench
