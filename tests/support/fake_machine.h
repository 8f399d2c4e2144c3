// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "support/temporary_folder.h"

namespace slambench::testing {

/// A root with the files of /sys and /proc that meters look for; tests write them, change them and
/// take them away.
class FakeMachine {
 public:
  const std::string& root() const { return folder_.path(); }
  std::string path(const std::string& file) const { return folder_.path() + file; }

  void write(const std::string& file, const std::string& text) const {
    folder_.write(file.substr(1), text + "\n");
  }
  template <class Number>
  void set(const std::string& file, Number value) const {
    write(file, fmt::format("{}", value));
  }
  void remove(const std::string& file) const { std::filesystem::remove_all(path(file)); }
  void link(const std::string& file, const std::string& target) const {
    std::filesystem::create_directories(std::filesystem::path(path(file)).parent_path());
    std::filesystem::create_symlink(target, path(file));
  }

  /// A zone of /sys/class/powercap.
  void zone(const std::string& zone, const std::string& name, std::uint64_t energy_uj,
            std::uint64_t range_uj) const {
    const std::string folder = "/sys/class/powercap/" + zone;
    write(folder + "/name", name);
    set(folder + "/energy_uj", energy_uj);
    set(folder + "/max_energy_range_uj", range_uj);
  }

  /// Two packages with cores and memory each, the first once more by way of memory-mapped
  /// registers.
  void intel_server() const {
    constexpr std::uint64_t range_uj = 262143328850;
    write("/sys/class/powercap/intel-rapl/enabled", "1");
    for (const int package : {0, 1}) {
      const std::string zone_name = fmt::format("intel-rapl:{}", package);
      zone(zone_name, fmt::format("package-{}", package), 1000000, range_uj);
      zone(zone_name + ":0", "core", 2000000, range_uj);
      zone(zone_name + ":1", "dram", 3000000, range_uj);
    }
    write("/sys/class/powercap/intel-rapl-mmio/enabled", "1");
    zone("intel-rapl-mmio:0", "package-0", 1000000, range_uj);
  }

  /// One package with cores; the graphics card and the processor's temperature by hwmon; a
  /// governor.
  void amd_desktop() const {
    zone("intel-rapl:0", "package-0", 5000000, 65532610987);
    zone("intel-rapl:0:0", "core", 1000000, 65532610987);
    write("/sys/class/hwmon/hwmon0/name", "k10temp");
    write("/sys/class/hwmon/hwmon0/temp1_label", "Tctl");
    write("/sys/class/hwmon/hwmon0/temp1_input", "60500");
    write("/sys/class/hwmon/hwmon1/name", "amdgpu");
    write("/sys/class/hwmon/hwmon1/power1_label", "PPT");
    write("/sys/class/hwmon/hwmon1/power1_average", "25000000");
    for (const int cpu : {0, 1}) {
      const std::string folder = fmt::format("/sys/devices/system/cpu/cpu{}/cpufreq", cpu);
      write(folder + "/scaling_cur_freq", cpu == 0 ? "4000000" : "3000000");
      write(folder + "/scaling_governor", "powersave");
    }
  }

  static constexpr const char* odroid_addresses[] = {"4-0040", "4-0041", "4-0044", "4-0045"};

  /// The vendor's kernel: a folder a chip below the driver.
  void odroid_old() const {
    write("/sys/bus/i2c/drivers/INA231/module/version", "1");
    for (const std::string address : odroid_addresses) {
      write(fmt::format("/sys/bus/i2c/drivers/INA231/{}/enable", address), "1");
      odroid_old_power(address, "0.500000");
    }
  }
  void odroid_old_power(const std::string& address, const std::string& watts) const {
    write(fmt::format("/sys/bus/i2c/drivers/INA231/{}/sensor_W", address), watts);
  }

  /// A mainline kernel: hwmon0 to hwmon3 in the order of the addresses.
  void odroid_mainline() const {
    for (int i = 0; i < 4; ++i) {
      const std::string chip = fmt::format("/sys/class/hwmon/hwmon{}", i);
      write(chip + "/name", "ina231");
      write(chip + "/power1_input", "500000");
      link(chip + "/device", fmt::format("../../../{}", odroid_addresses[i]));
    }
  }

  /// A Jetson Orin: hwmon, the first line supplies the board, one channel is not connected.
  void jetson_new() const {
    const std::string chip = "/sys/class/hwmon/hwmon1";
    write(chip + "/name", "ina3221");
    link(chip + "/device", "../../../1-0040");
    const char* labels[] = {"VDD_IN", "VDD_CPU_GPU_CV", "NC"};
    for (int i = 1; i <= 3; ++i) {
      write(fmt::format("{}/in{}_label", chip, i), labels[i - 1]);
      write(fmt::format("{}/in{}_input", chip, i), "5000");
      write(fmt::format("{}/curr{}_input", chip, i), "1000");
    }
    write(chip + "/in7_label", "sum of shunt voltages");
  }

  /// A Jetson TX2 or Nano with NVIDIA's older kernel.
  void jetson_old() const {
    const std::string chip = "/sys/bus/i2c/drivers/ina3221x/6-0040/iio:device0";
    const char* labels[] = {"POM_5V_IN", "POM_5V_GPU", "POM_5V_CPU"};
    for (int i = 0; i < 3; ++i) {
      write(fmt::format("{}/rail_name_{}", chip, i), labels[i]);
      write(fmt::format("{}/in_power{}_input", chip, i), "2000");
    }
  }

  /// power/energy-*/ on two sockets, whose counters live on processors 0 and 18.
  void perf_power() const {
    const std::string folder = "/sys/bus/event_source/devices/power";
    write(folder + "/type", "9");
    write(folder + "/cpumask", "0,18");
    for (const std::string event : {"energy-pkg", "energy-ram"}) {
      write(folder + "/events/" + event, event == "energy-pkg" ? "event=0x02" : "event=0x03");
      write(folder + "/events/" + event + ".scale", "2.3283064365386962890625e-10");
      write(folder + "/events/" + event + ".unit", "Joules");
    }
    write("/sys/devices/system/cpu/cpu0/topology/physical_package_id", "0");
    write("/sys/devices/system/cpu/cpu18/topology/physical_package_id", "1");
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace slambench::testing
