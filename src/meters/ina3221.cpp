// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The INA3221 of NVIDIA's Jetson boards: voltage and current of three supply lines a chip.
#include <fmt/format.h>

#include <algorithm>

#include "meters/file_meter.h"
#include "meters/hwmon.h"

namespace slambench {
namespace {

constexpr const char* driver_folder = "/sys/bus/i2c/drivers/ina3221x";
constexpr int channels = 3;

/// Volts times amperes, read one after the other.
class VoltsTimesAmperes final : public Meter {
 public:
  VoltsTimesAmperes(MeterInfo info, SystemFiles files, std::string mv, std::string ma)
      : Meter(std::move(info)),
        files_(std::move(files)),
        mv_file_(std::move(mv)),
        ma_file_(std::move(ma)) {}
  double read() override { return files_.number(mv_file_) * files_.number(ma_file_) * 1e-6; }

 private:
  const SystemFiles files_;
  const std::string mv_file_, ma_file_;
};

/// Not connected.
bool is_connected(const std::string& label) { return label != "NC"; }
/// The line that supplies the whole board.
bool is_input(const std::string& label) { return label == "VDD_IN" || label == "POM_5V_IN"; }

MeterInfo info_of(std::string name, std::string sensor, double resolution_w) {
  return {.name = std::move(name),
          .sensor = std::move(sensor),
          .quantity = Quantity::power_w,
          .resolution = resolution_w,
          .within = "",
          .in_total = true};
}

/// A line and how it is read, before it is known which of them supplies the others.
struct Line {
  MeterInfo info;
  std::string mv, ma;  ///< files of voltage and current, or else
  std::string mw;      ///< of power
};

/// Kernels before 5: an IIO device a chip, which multiplies itself.
void find_old(const SystemFiles& files, std::vector<Line>* lines) {
  for (const std::string& device : files.names(driver_folder)) {
    const std::string chip = fmt::format("{}/{}", driver_folder, device);
    for (const std::string& entry : files.names(chip)) {
      if (!entry.starts_with("iio:device")) continue;
      for (int i = 0; i < channels; ++i) {
        const std::string folder = fmt::format("{}/{}", chip, entry);
        const std::string mw = fmt::format("{}/in_power{}_input", folder, i);
        if (!files.exists(mw)) continue;
        std::string label = files.text_or_empty(fmt::format("{}/rail_name_{}", folder, i));
        if (!is_connected(label)) continue;
        if (label.empty()) label = fmt::format("{} channel {}", device, i);
        lines->push_back(
            {info_of(label, fmt::format("INA3221 {} channel {}", device, i), 1e-3), "", "", mw});
      }
    }
  }
}

void find_new(const SystemFiles& files, std::vector<Line>* lines) {
  for (const HwmonChip& chip : hwmon_chips(files)) {
    if (chip.name != "ina3221") continue;
    for (int i = 1; i <= channels; ++i) {
      const auto file = [&](const char* format) {
        return chip.folder + "/" + fmt::format(fmt::runtime(format), i);
      };
      const std::string mv = file("in{}_input"), ma = file("curr{}_input");
      if (!files.exists(mv) || !files.exists(ma)) continue;
      if (files.text_or_empty(file("in{}_enable")) == "0") continue;
      std::string label = files.text_or_empty(file("in{}_label"));
      if (!is_connected(label)) continue;
      if (label.empty()) label = fmt::format("{} channel {}", chip.device, i);
      double volts = 0;
      try {
        volts = files.number(mv) * 1e-3;
      } catch (const MeterError&) {
        // Told when the meter is tried.
      }
      lines->push_back({info_of(label, fmt::format("INA3221 {} channel {}", chip.device, i),
                                volts * 1e-3),  // a milliampere at this voltage
                        mv, ma, ""});
    }
  }
}

}  // namespace

FoundMeters find_ina3221(const MeterContext& context) {
  std::vector<Line> lines;
  find_old(context.files, &lines);
  if (lines.empty()) find_new(context.files, &lines);
  const auto input = std::find_if(lines.begin(), lines.end(),
                                  [](const Line& line) { return is_input(line.info.name); });
  const std::string whole = input == lines.end() ? "" : input->info.name;
  FoundMeters found;
  for (Line& line : lines) {
    if (!whole.empty() && line.info.name != whole) {
      line.info.within = whole;
      line.info.in_total = false;
    }
    if (!line.mw.empty()) {
      add_readable(std::make_unique<FileMeter>(line.info, context.files, line.mw, 1e-3), &found);
    } else {
      add_readable(std::make_unique<VoltsTimesAmperes>(line.info, context.files, line.mv, line.ma),
                   &found);
    }
  }
  explain_nothing(&found, "no INA3221 as of a Jetson board");
  return found;
}

}  // namespace slambench
