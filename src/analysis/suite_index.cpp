// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/suite_index.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/files.h"

namespace slambench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* suite_format = "slambench-suite";
constexpr int suite_version = 1;

Json as_json(const SuiteIndex::Configuration& configuration) {
  Json parameters = Json::object();
  for (const auto& [name, value] : configuration.parameters) parameters[name] = value;
  return {{"folder", configuration.folder},   {"sequence", configuration.sequence},
          {"variant", configuration.variant}, {"path", configuration.path},
          {"preset", configuration.preset},   {"parameters", parameters}};
}

SuiteIndex::Configuration configuration_of(const Json& json) {
  SuiteIndex::Configuration configuration;
  json.at("folder").get_to(configuration.folder);
  json.at("sequence").get_to(configuration.sequence);
  json.at("variant").get_to(configuration.variant);
  json.at("path").get_to(configuration.path);
  json.at("preset").get_to(configuration.preset);
  for (const auto& [name, value] : json.at("parameters").items()) {
    configuration.parameters.emplace_back(name, value.get<std::string>());
  }
  return configuration;
}

}  // namespace

SuiteIndex read_suite_index(const std::string& file) {
  const Json json = Json::parse(read_file(file), nullptr, false);
  if (!json.is_object() || json.value("format", Json()) != suite_format ||
      json.value("version", Json()) != suite_version) {
    throw InputError(fmt::format("{}: is not what this version of slambench suite writes", file));
  }
  SuiteIndex index;
  try {
    index.title = json.value("title", "");
    index.executable = json.value("executable", "");
    for (const Json& each : json.at("configurations")) {
      index.configurations.push_back(configuration_of(each));
    }
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: {}", file, error.what()));
  }
  return index;
}

std::string suite_index_json(const SuiteIndex& index) {
  Json json = {{"format", suite_format},
               {"version", suite_version},
               {"title", index.title},
               {"executable", index.executable}};
  json["configurations"] = Json::array();
  for (const SuiteIndex::Configuration& c : index.configurations) {
    json["configurations"].push_back(as_json(c));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace slambench
