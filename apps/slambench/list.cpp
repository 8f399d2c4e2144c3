// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "all_parameters.h"
#include "commands.h"
#include "config/presets.h"
#include "help.h"
#include "kernels/kernel.h"
#include "meters/clock.h"
#include "meters/machine.h"
#include "meters/meter.h"
#include "parameter_options.h"
#include "terminal.h"

namespace slambench {
namespace {

using Json = nlohmann::ordered_json;
using Row = std::vector<std::string>;

constexpr std::size_t page_width = 80;

/// Columns as wide as their widest cell, two blanks apart; the last one is wrapped at the page.
std::string table(const std::string& title, const std::vector<Row>& rows) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text = title + "\n";
  for (const Row& row : rows) {
    std::string line = " ";
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      line += fmt::format(" {:{}} ", row[i], widths[i]);
    }
    const std::size_t indent = line.size() + 1;
    text += fmt::format("{} {}\n", line, wrapped(row.back(), page_width - indent, indent));
  }
  return text + "\n";
}

Json as_json(const Preset& preset) {
  Json assignments = Json::object();
  for (const auto& [name, value] : preset.assignments) assignments[name] = value;
  return {{"name", preset.name}, {"sentence", preset.sentence}, {"parameters", assignments}};
}

Json as_json(const BackendEntry& entry) {
  const Availability availability = entry.availability();
  Json json = {
      {"name", entry.name}, {"sentence", entry.sentence}, {"available", availability.available}};
  if (availability.available) {
    json["devices"] = entry.devices();
  } else {
    json["reason"] = availability.reason;
  }
  return json;
}

Json as_json(const MeterEntry& entry, const FoundMeters& found) {
  Json json = {
      {"name", entry.name}, {"sentence", entry.sentence}, {"available", found.unavailable.empty()}};
  if (!found.unavailable.empty()) json["reason"] = found.unavailable;
  for (const auto& meter : found.meters) {
    json["sensors"].push_back({{"name", meter->info().name}, {"sensor", meter->info().sensor}});
  }
  for (const auto& [info, reason] : found.refused) {
    json["refused"].push_back({{"name", info.name}, {"reason", reason}});
  }
  return json;
}

Json as_json(const KernelInfo& info) {
  return {{"name", info.name},
          {"paper_name", info.paper_name},
          {"stage", name(info.stage)},
          {"pattern", info.pattern},
          {"in", info.in},
          {"out", info.out},
          {"sentence", info.sentence}};
}

Json as_json(const Parameter& parameter) {
  Json json = {{"name", parameter.name}};
  if (parameter.flag != 0) json["letter"] = std::string(1, parameter.flag);
  json["unit"] = parameter.unit;
  json["default"] = to_text(parameter);
  if (const auto words = default_exception(parameter); !words.empty()) {
    json["default_exception"] = words;
  }
  json["expected"] = expectation(parameter);
  json["sentence"] = parameter.sentence;
  if (parameter.family != nullptr) json["family"] = parameter.family->name;
  return json;
}

/// Everything that the command tells, in one object; the tables are made of the same sources.
Json everything(const MeterContext& context) {
  Json json;
  for (const BackendEntry& entry : backend_table()) json["backends"].push_back(as_json(entry));
  for (const MeterEntry& entry : meter_table()) {
    json["meters"].push_back(as_json(entry, entry.find(context)));
  }
  for (const MapInfo& map : map_table()) {
    json["maps"].push_back({{"name", map.name}, {"sentence", map.sentence}});
  }
  for (const KernelInfo& info : kernel_table()) json["kernels"].push_back(as_json(info));
  for (const SourceEntry& entry : source_table()) {
    Json layout = {{"name", entry.layout},
                   {"sentence", entry.sentence},
                   {"available", entry.unavailable.empty()}};
    if (!entry.unavailable.empty()) layout["reason"] = entry.unavailable;
    json["layouts"].push_back(layout);
  }
  for (const Preset& preset : preset_table()) json["presets"].push_back(as_json(preset));
  AllParameters parameters;
  for (const ParameterList& list : parameters.lists()) {
    for (const Parameter& parameter : list.parameters) {
      json["parameters"][std::string(list.group)].push_back(as_json(parameter));
    }
  }
  return json;
}

std::vector<Row> meter_rows(const MeterContext& context) {
  std::vector<Row> rows;
  for (const MeterEntry& entry : meter_table()) {
    const FoundMeters found = entry.find(context);
    rows.push_back({std::string(entry.name),
                    found.unavailable.empty() ? "available" : "unavailable",
                    std::string(entry.sentence)});
    if (!found.unavailable.empty()) {
      rows.push_back({"", "", found.unavailable});
      continue;
    }
    for (const auto& meter : found.meters) {
      rows.push_back({"", "", fmt::format("{}: {}", meter->info().name, meter->info().sensor)});
    }
    for (const auto& [info, reason] : found.refused) {
      rows.push_back({"", "", fmt::format("not {}: {}", info.name, reason)});
    }
  }
  return rows;
}

std::string tables(const MeterContext& context) {
  std::vector<Row> backends, maps, kernels, layouts, presets;
  for (const BackendEntry& entry : backend_table()) {
    const Availability availability = entry.availability();
    backends.push_back({std::string(entry.name),
                        availability.available ? "available" : "unavailable",
                        std::string(entry.sentence)});
    if (!availability.available) {
      backends.push_back({"", "", availability.reason});
      continue;
    }
    int index = 0;
    for (const std::string& device : entry.devices()) {
      backends.push_back({"", "", fmt::format("device {}: {}", index++, device)});
    }
  }
  for (const MapInfo& map : map_table()) {
    maps.push_back({std::string(map.name), std::string(map.sentence)});
  }
  kernels.push_back({"name", "in the paper", "stage", "in", "out", "pattern"});
  for (const KernelInfo& info : kernel_table()) {
    kernels.push_back({std::string(info.name), std::string(info.paper_name),
                       std::string(name(info.stage)), std::string(info.in), std::string(info.out),
                       std::string(info.pattern)});
  }
  for (const SourceEntry& entry : source_table()) {
    const bool available = entry.unavailable.empty();
    layouts.push_back({std::string(entry.layout), available ? "available" : "unavailable",
                       std::string(entry.sentence)});
    if (!available) layouts.push_back({"", "", std::string(entry.unavailable)});
  }
  for (const Preset& preset : preset_table()) {
    presets.push_back({std::string(preset.name), std::string(preset.sentence)});
  }
  return table("Backends (--backend)", backends) + table("Maps (--map)", maps) +
         table("Presets (--preset)", presets) +
         table("Layouts of sequences, recognised by themselves", layouts) +
         table("Meters", meter_rows(context)) + table("Kernels", kernels) +
         "Parameters: slambench list --parameters\n";
}

std::string option_text(const Parameter& parameter) {
  return parameter.flag == 0 ? fmt::format("--{}", parameter.name)
                             : fmt::format("-{}, --{}", parameter.flag, parameter.name);
}

std::string parameter_tables() {
  AllParameters parameters;
  std::string text;
  for (const ParameterList& list : parameters.lists()) {
    std::vector<Row> rows = {{"option", "default", "unit", "range and meaning"}};
    for (const Parameter& parameter : list.parameters) {
      const std::string range = range_words(parameter);
      const std::string exception = default_exception(parameter);
      rows.push_back({option_text(parameter), to_text(parameter), std::string(parameter.unit),
                      fmt::format("{}{}{}{}", range, range.empty() ? "" : ": ", parameter.sentence,
                                  exception.empty() ? "" : "; the default holds " + exception)});
    }
    text += table(fmt::format("[{}]", list.group), rows);
  }
  text.pop_back();
  return text;
}

constexpr const char* markdown_head = R"(# Parameters

Everything that can be set in a run. On the command line a parameter is the option of its name; in a
configuration file (`--config FILE`, TOML) it is the key of its name in the table of its group:

```toml
sequence = "living-room/2"   # optional: what to run
preset = "fast"              # optional

[kinectfusion]
volume-size = 4.8            # one number stands for three equal ones
pyramid-levels = [10, 5, 4]
```

The command line is stronger than the file, the file than the preset, the preset than what suits the
sequence, that than the default. The record says of each value who set it.

What suits a sequence is what its own settings say, and else what its reader thinks (`slambench info
SEQUENCE` shows both). Its own settings are a configuration file named `slambench.toml` in its folder,
or beside its `.raw` file; only the tables `[source]` and `[kinectfusion]` of it count. `slambench
generate` writes one.

This file is generated: `slambench list --parameters --markdown > docs/parameters.md`.
)";

/// In a cell of a table, a bar must not end the cell.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string parameter_markdown() {
  AllParameters parameters;
  std::string text = markdown_head;
  for (const ParameterList& list : parameters.lists()) {
    text += fmt::format(
        "\n## `[{}]`\n\n| option | default | unit | range | meaning |\n"
        "|---|---|---|---|---|\n",
        list.group);
    for (const Parameter& parameter : list.parameters) {
      const std::string value = to_text(parameter), exception = default_exception(parameter);
      text += fmt::format("| `{}` | {}{}{} | {} | {} | {} |\n", option_text(parameter),
                          value.empty() ? "" : fmt::format("`{}`", value),
                          exception.empty() ? "" : " ", exception, parameter.unit,
                          cell(range_words(parameter)), cell(parameter.sentence));
    }
  }
  return text;
}

Json as_json(const MachineCeiling& ceiling) {
  return {{"threads", ceiling.threads},
          {"copy_bytes_per_s", ceiling.copy_bytes_per_s},
          {"fma_flops_per_s", ceiling.fma_flops_per_s},
          {"instruction_set", ceiling.instruction_set}};
}

std::string ceiling_text(const MachineCeiling& ceiling) {
  return table(fmt::format("What {} threads reach here", ceiling.threads),
               {{"copy bandwidth", fmt::format("{:.1f} GB/s", ceiling.copy_bytes_per_s * 1e-9),
                 "bytes read and written, of arrays larger than the caches"},
                {"multiply-add rate", fmt::format("{:.0f} GFLOP/s", ceiling.fma_flops_per_s * 1e-9),
                 fmt::format("single precision from registers, {}", ceiling.instruction_set)}});
}

struct ListOptions {
  bool json = false, parameters = false, markdown = false, machine = false;
  int threads = 0;
  MeterParameters meters;
};

ExitStatus list_machine(const ListOptions& options) {
  const MachineCeiling ceiling = measure_machine(steady_clock(), options.threads);
  print(options.json ? as_json(ceiling).dump(2) + "\n" : ceiling_text(ceiling));
  return ExitStatus::ok;
}

}  // namespace

Action add_list(CLI::App& command) {
  auto options = std::make_shared<ListOptions>();
  command.add_flag("--parameters", options->parameters, "all parameters of a run as a table");
  command.add_flag("--markdown", options->markdown, "with --parameters: as docs/parameters.md");
  command.add_flag("--machine", options->machine,
                   "measure what the cores reach: copy bandwidth and multiply-add rate");
  command.add_option("--threads", options->threads, "with --machine; 0: one per core (default)")
      ->check(CLI::Range(0, 4096));
  // Where meters look, as a run may be told.
  const std::vector<ParameterList> lists = {options->meters.describe()};
  for (const char* name : {"sysfs-root", "nvml-library"}) {
    const Parameter& parameter = *find(lists, name);
    command
        .add_option(fmt::format("--{}", name), *std::get<std::string*>(parameter.value),
                    help_sentence(parameter))
        ->type_name("TEXT");
  }
  command.add_flag("--json", options->json, "everything, or the machine, as one JSON object");
  return [options] {
    if (options->markdown && !options->parameters) {
      throw UsageError("--markdown: needs --parameters");
    }
    if (options->machine && options->parameters) {
      throw UsageError("--machine and --parameters: choose one");
    }
    if (options->threads > 0 && !options->machine) throw UsageError("--threads: needs --machine");
    if (options->machine) return list_machine(*options);
    if (options->json) {
      // What sensors are called is up to the machine.
      const Json all = everything(options->meters.context());
      print(all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    } else if (options->markdown) {
      print(parameter_markdown());
    } else {
      print(options->parameters ? parameter_tables() : tables(options->meters.context()));
    }
    return ExitStatus::ok;
  };
}

}  // namespace slambench
