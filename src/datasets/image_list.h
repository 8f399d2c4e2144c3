// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <vector>

namespace slambench {

/// A depth image, or an image of any kind, as a list file names it.
struct ListedImage {
  double time_s = 0;
  std::string file;        ///< as in the list: relative to the list's folder
  std::string color_file;  ///< of the same moment; empty for none
  int line = 0;            ///< where the list names it, from 1; 0 without a list
};

/// Reads a file of lines "stamp file".
/// Both functions sort by stamp (and note it when there was something to sort) and throw InputError
/// naming the line for a wrong number of fields, a bad stamp, or a stamp that comes twice.
std::vector<ListedImage> read_image_list(const std::string& path, std::vector<std::string>* notes);

/// Reads a file of lines "stamp depth-file stamp colour-file", in this order or, where the names
/// tell, the other. The stamp is that of the depth image.
std::vector<ListedImage> read_associations(const std::string& path,
                                           std::vector<std::string>* notes);

/// The images depth/N.png of a folder in the order of N, which is also their stamp, with the colour
/// image rgb/N.png where there is one.
std::vector<ListedImage> numbered_images(const std::string& folder);

/// "rgb/NAME" when there is such a colour image in the folder, else "".
std::string color_of(const std::string& folder, const std::string& name);

/// The number that the name of a file is up to its extension ("depth/12.png": 12), else -1.
int file_number(const std::string& file);

}  // namespace slambench
