// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "architecture/source_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

namespace slambench {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) all.push_back(line);
  return all;
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

bool is_source(const fs::path& path) {
  static const std::set<std::string> extensions = {".h", ".cpp", ".cu", ".cuh", ".cl"};
  return extensions.contains(path.extension().string());
}

/// Paths below root/folder, relative to root, with '/', in a fixed order.
std::vector<std::string> files(const fs::path& root, const std::string& folder,
                               const std::function<bool(const fs::path&)>& wanted) {
  std::vector<std::string> found;
  if (!fs::is_directory(root / folder)) return found;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    if (entry.is_regular_file() && wanted(entry.path())) {
      found.push_back(entry.path().lexically_relative(root).generic_string());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string folder_of(const std::string& path) { return fs::path(path).parent_path().string(); }
std::string without_extension(const std::string& path) {
  return fs::path(path).replace_extension().string();
}

/// What the CMake files say about targets.
struct Targets {
  std::map<std::string, std::string> by_folder;          ///< all files of a folder
  std::map<std::string, std::string> by_stem;            ///< listed files and their headers
  std::map<std::string, std::set<std::string>> links;    ///< all
  std::map<std::string, std::set<std::string>> exports;  ///< those that users of the target see

  std::optional<std::string> owner(const std::string& file) const {
    if (const auto it = by_stem.find(without_extension(file)); it != by_stem.end()) {
      return it->second;
    }
    if (const auto it = by_folder.find(folder_of(file)); it != by_folder.end()) return it->second;
    return std::nullopt;
  }

  std::set<std::string> reach(const std::string& target) const {
    std::set<std::string> reached = {target};
    const std::function<void(const std::string&)> follow = [&](const std::string& next) {
      if (!reached.insert(next).second || !exports.contains(next)) return;
      for (const auto& further : exports.at(next)) follow(further);
    };
    if (links.contains(target)) {
      for (const auto& next : links.at(target)) follow(next);
    }
    return reached;
  }
};

std::string target_name(std::string name) {
  std::replace(name.begin(), name.end(), '/', '_');
  return "slambench_" + name;
}

void read_command(const std::string& command, const std::vector<std::string>& arguments,
                  const std::string& folder, Targets* targets) {
  if (arguments.empty()) return;
  if (command == "slambench_library") {
    const std::string target = target_name(arguments[0]);
    targets->by_folder[folder] = target;
    for (std::size_t i = 1; i < arguments.size(); ++i) {
      targets->links[target].insert(target_name(arguments[i]));
      targets->exports[target].insert(target_name(arguments[i]));
    }
  } else if (command == "add_library" || command == "add_executable") {
    for (const auto& argument : arguments) {
      if (argument == "${sources}") targets->by_folder[folder] = arguments[0];
      if (is_source(argument)) {
        targets->by_stem[without_extension(folder + "/" + argument)] = arguments[0];
      }
    }
  } else if (command == "target_link_libraries") {
    bool exported = true;
    for (std::size_t i = 1; i < arguments.size(); ++i) {
      if (arguments[i] == "PRIVATE") exported = false;
      if (arguments[i] == "PUBLIC" || arguments[i] == "INTERFACE") exported = true;
      targets->links[arguments[0]].insert(arguments[i]);
      if (exported) targets->exports[arguments[0]].insert(arguments[i]);
    }
  }
}

Targets read_targets(const fs::path& root) {
  static const std::regex comment("#[^\n]*");
  static const std::regex call(R"((\w+)\s*\(([^()]*)\))");
  const auto is_list = [](const fs::path& path) { return path.filename() == "CMakeLists.txt"; };
  Targets targets;
  for (const char* folder : {"src", "apps"}) {
    for (const auto& list : files(root, folder, is_list)) {
      const std::string text = std::regex_replace(read(root / list), comment, "");
      for (std::sregex_iterator it(text.begin(), text.end(), call), end; it != end; ++it) {
        read_command((*it)[1], words((*it)[2]), folder_of(list), &targets);
      }
    }
  }
  return targets;
}

/// The file under root that `#include "path"` in `file` means; empty for a library's header.
std::string resolve(const fs::path& root, const std::string& file, const std::string& path) {
  const std::string beside = (fs::path(file).parent_path() / path).lexically_normal().string();
  for (const std::string& candidate : {"src/" + path, beside}) {
    if (fs::is_regular_file(root / candidate)) return candidate;
  }
  return {};
}

/// What src/ does not do, and the files (by prefix) whose job it is nevertheless.
struct SideEffect {
  const char* pattern;
  const char* sentence;
  std::vector<std::string> allowed = {};
};

const std::vector<SideEffect>& side_effects() {
  static const std::vector<SideEffect> all = {
      {R"(\bstd::(cout|cerr|clog)\b|\b(printf|puts|putchar|fmt::print)\s*\()"
       R"(|\bstd::print(ln)?\s*\(|\bfprintf\s*\(|\b(stdout|stderr)\b)",
       "prints"},
      {R"(\b(std::)?(exit|_exit|_Exit|quick_exit|abort|terminate)\s*\()", "ends the process"},
      {R"(\b(secure_)?getenv\s*\(|\benviron\b)", "reads the environment", {"src/io/"}},
      {R"(\b(steady|system|high_resolution)_clock::|\b(clock_gettime|gettimeofday)\s*\()"
       R"(|\bstd::time\s*\(|\bthis_thread::sleep_\w+\s*\()",
       "looks at a clock",
       {"src/meters/"}},
  };
  return all;
}

}  // namespace

std::vector<std::string> include_violations(const fs::path& root) {
  static const std::regex include(R"re(^\s*#\s*include\s*"([^"]+)")re");
  const Targets targets = read_targets(root);
  std::vector<std::string> violations;
  for (const char* folder : {"src", "apps"}) {
    for (const auto& file : files(root, folder, is_source)) {
      const auto owner = targets.owner(file);
      if (!owner) {
        violations.push_back(fmt::format("{}:1: belongs to no CMake target", file));
        continue;
      }
      const auto reached = targets.reach(*owner);
      int number = 0;
      for (const auto& line : lines(read(root / file))) {
        ++number;
        std::smatch match;
        if (!std::regex_search(line, match, include)) continue;
        const std::string included = resolve(root, file, match[1]);
        if (included.empty()) continue;
        const auto target = targets.owner(included);
        if (!target || !reached.contains(*target)) {
          violations.push_back(fmt::format("{}:{}: includes {} of {}, which {} does not link", file,
                                           number, included, target.value_or("no target"), *owner));
        }
      }
    }
  }
  return violations;
}

std::vector<std::string> side_effect_violations(const fs::path& root) {
  static const std::regex comment("//.*$");
  static const std::regex string(R"re("(\\.|[^"\\])*")re");
  std::vector<std::string> violations;
  for (const auto& effect : side_effects()) {
    const std::regex pattern(effect.pattern);
    for (const auto& file : files(root, "src", is_source)) {
      const bool allowed =
          std::any_of(effect.allowed.begin(), effect.allowed.end(),
                      [&](const std::string& prefix) { return file.starts_with(prefix); });
      if (allowed) continue;
      int number = 0;
      for (const auto& line : lines(read(root / file))) {
        ++number;
        const std::string code =
            std::regex_replace(std::regex_replace(line, string, "\"\""), comment, "");
        if (std::regex_search(code, pattern)) {
          violations.push_back(fmt::format("{}:{}: {}", file, number, effect.sentence));
        }
      }
    }
  }
  return violations;
}

std::vector<std::string> header_violations(const fs::path& root) {
  const std::string expected =
      "// SPDX-License-Identifier: MIT\n// SPDX-FileCopyrightText: The SLAMBench authors\n";
  std::vector<std::string> violations;
  for (const char* folder : {"src", "apps", "tests", "bench", "examples"}) {
    for (const auto& file : files(root, folder, is_source)) {
      if (!read(root / file).starts_with(expected)) {
        violations.push_back(fmt::format("{}:1: does not start with the SPDX header", file));
      }
    }
  }
  return violations;
}

}  // namespace slambench
