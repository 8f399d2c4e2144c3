// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "config/config_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/nearest.h"
#include "config/toml_reading.h"
#include "io/files.h"

namespace slambench {
namespace {

void read_top(const toml::table& top, const std::vector<ParameterList>& lists, ConfigFile* file) {
  std::vector<std::string_view> known = {"sequence", "preset"};
  for (const ParameterList& list : lists) known.push_back(list.group);
  for (const auto& [key, node] : top) {
    const std::string_view name(key);
    const TomlPlace place{file->path, node};
    const auto list = std::find_if(lists.begin(), lists.end(),
                                   [&](const ParameterList& l) { return l.group == name; });
    if (name == "sequence") {
      file->sequence = read_word(name, place);
    } else if (name == "preset") {
      file->preset = read_word(name, place);
    } else if (list == lists.end()) {
      const char* kind = node.is_table() ? "table" : "key";
      place.reject(fmt::format("unknown {} '{}'{}", kind, name, suggestion(name, known)));
    } else if (!node.is_table()) {
      place.reject(fmt::format("{}: found {}, expected a table", name, written(node)));
    } else {
      read_group(*node.as_table(), *list, file->path, &file->assignments);
    }
  }
}

}  // namespace

ConfigFile parse_config(std::string_view text, const std::string& path,
                        const std::vector<ParameterList>& lists) {
  ConfigFile file;
  file.path = path;
  read_top(parse_toml(text, path), lists, &file);
  return file;
}

ConfigFile read_config_file(const std::string& path, const std::vector<ParameterList>& lists) {
  return parse_config(read_file(path), path, lists);
}

}  // namespace slambench
