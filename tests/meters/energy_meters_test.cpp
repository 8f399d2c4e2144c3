// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// The meters on trees of files as different machines have them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fakes.h"
#include "meters/meter.h"
#include "meters/sampler.h"
#include "support/fake_clock.h"
#include "support/fake_machine.h"

namespace slambench {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

constexpr const char* powercap = "/sys/class/powercap/";

class EnergyMeters : public ::testing::Test {
 protected:
  MeterContext context() const {
    return {SystemFiles(system_.root()), &perf_, "/nowhere/libnvidia-ml.so"};
  }

  static std::vector<std::string> names(const FoundMeters& found) {
    std::vector<std::string> all;
    for (const auto& meter : found.meters) all.push_back(meter->info().name);
    return all;
  }
  static std::vector<std::string> in_total(const FoundMeters& found) {
    std::vector<std::string> all;
    for (const auto& meter : found.meters) {
      if (meter->info().in_total) all.push_back(meter->info().name);
    }
    return all;
  }
  static const Meter& named(const FoundMeters& found, const std::string& name) {
    for (const auto& meter : found.meters) {
      if (meter->info().name == name) return *meter;
    }
    throw std::runtime_error("no meter " + name);
  }

  /// Begins to sample all meters; `at` then moves time and takes a reading.
  void begin() {
    sampler_ = std::make_unique<Sampler>(find_meters(context()).meters, clock_, 0.1);
    sampler_->begin();
  }
  void at(double time_s) {
    clock_.advance(time_s - elapsed_s_);
    elapsed_s_ = time_s;
    sampler_->sample();
  }
  Channel channel(const std::string& name) const {
    for (const Channel& channel : sampler_->channels()) {
      if (channel.info.name == name) return channel;
    }
    throw std::runtime_error("no channel " + name);
  }

  testing::FakeMachine system_;
  testing::FakePerfEvents perf_;
  testing::FakeClock clock_;
  double elapsed_s_ = 0;
  std::unique_ptr<Sampler> sampler_;
};

TEST_F(EnergyMeters, AMachineWithoutSensorsHasNoFigure) {
  const FoundMeters found = find_meters(context());
  EXPECT_THAT(found.meters, IsEmpty());
  EXPECT_THAT(found.unavailable, HasSubstr("no sensor"));
  for (const MeterEntry& entry : meter_table()) {
    const FoundMeters one = entry.find(context());
    EXPECT_THAT(one.meters, IsEmpty()) << entry.name;
    EXPECT_EQ(one.unavailable.empty(), entry.name == "memory") << entry.name;
  }
}

// --- an Intel server ---

TEST_F(EnergyMeters, IntelServerCountsEachPackageOnce) {
  system_.intel_server();
  const FoundMeters found = find_powercap(context());
  EXPECT_THAT(names(found), ElementsAre("package-0", "package-0/core", "package-0/dram",
                                        "package-1", "package-1/core", "package-1/dram"));
  EXPECT_THAT(in_total(found), ElementsAre("package-0", "package-1"))
      << "a part is not added to the whole";
  EXPECT_EQ(named(found, "package-1/dram").info().within, "package-1");
  EXPECT_EQ(named(found, "package-0").info().sensor, "powercap intel-rapl:0");
  EXPECT_EQ(named(found, "package-0").info().resolution, 1e-6);
}

TEST_F(EnergyMeters, MemoryMappedZonesCountWhereThereAreNoOthers) {
  system_.zone("intel-rapl-mmio:0", "package-0", 1, 1000);
  EXPECT_THAT(names(find_powercap(context())), ElementsAre("package-0"));
}

TEST_F(EnergyMeters, ThePlatformIsShownButNotAdded) {
  system_.zone("intel-rapl:0", "package-0", 1, 1000);
  system_.zone("intel-rapl:1", "psys", 1, 1000);
  const FoundMeters found = find_powercap(context());
  EXPECT_THAT(names(found), ElementsAre("package-0", "psys"));
  EXPECT_THAT(in_total(found), ElementsAre("package-0"));
}

TEST_F(EnergyMeters, CountersAreDifferenced) {
  system_.intel_server();
  begin();
  for (int i = 1; i <= 20; ++i) {
    system_.set(std::string(powercap) + "intel-rapl:0/energy_uj", 1000000 + i * 1500000);
    system_.set(std::string(powercap) + "intel-rapl:1/energy_uj", 1000000 + i * 250000);
    at(i * 0.125);
  }
  EXPECT_DOUBLE_EQ(channel("package-0").joules, 30);
  EXPECT_DOUBLE_EQ(channel("package-1").joules, 5);
  EXPECT_DOUBLE_EQ(*channel("package-0").peak_w, 12);
  EXPECT_EQ(channel("package-0").updates, 20);
  EXPECT_EQ(channel("package-0/dram").updates, 0);
}

TEST_F(EnergyMeters, ACounterThatWrapsAroundCountsOn) {
  system_.zone("intel-rapl:0", "package-0", 900, 1000);
  begin();
  std::uint64_t total_uj = 900;
  for (int i = 1; i <= 50; ++i) {
    total_uj += 370;  // wraps 18 times
    system_.set(std::string(powercap) + "intel-rapl:0/energy_uj", total_uj % 1000);
    at(i);
  }
  EXPECT_EQ(channel("package-0").failure, "");
  EXPECT_DOUBLE_EQ(channel("package-0").joules, 50 * 370e-6);
}

TEST_F(EnergyMeters, EveryZoneWrapsAtItsOwnRange) {
  system_.zone("intel-rapl:0", "package-0", 9000, 10000);
  system_.zone("intel-rapl:1", "package-1", 9000, 20000);
  begin();
  for (const char* zone : {"intel-rapl:0", "intel-rapl:1"}) {
    system_.set(fmt::format("{}{}/energy_uj", powercap, zone), 2000);
  }
  at(1);
  EXPECT_DOUBLE_EQ(channel("package-0").joules, 3000e-6);
  EXPECT_THAT(channel("package-1").failure, HasSubstr("moved by 13000 of 20000 uJ"))
      << "more than half a range between two readings may be any number of wraps";
}

TEST_F(EnergyMeters, BetweenTwoMeasurementsACounterMayWrapAsItLikes) {
  system_.zone("intel-rapl:0", "package-0", 900, 1000);
  begin();
  at(1);
  system_.set(std::string(powercap) + "intel-rapl:0/energy_uj", 800);
  sampler_->begin();
  system_.set(std::string(powercap) + "intel-rapl:0/energy_uj", 850);
  at(2);
  EXPECT_EQ(channel("package-0").failure, "");
  EXPECT_DOUBLE_EQ(channel("package-0").joules, 50e-6);
}

TEST_F(EnergyMeters, RootsCountersAreRefusedWithTheReason) {
  system_.intel_server();
  for (const auto& zone : SystemFiles(system_.root()).names(powercap)) {
    ::chmod(system_.path(powercap + zone + "/energy_uj").c_str(), 0);
  }
  const testing::WithoutRootsPowers user;
  const FoundMeters found = find_meters(context());
  EXPECT_THAT(found.meters, IsEmpty());
  EXPECT_EQ(found.refused.size(), 6u);
  EXPECT_THAT(found.unavailable,
              HasSubstr("/sys/class/powercap/intel-rapl:0/energy_uj: Permission denied"));
  EXPECT_EQ(find_powercap(context()).unavailable, found.unavailable);
}

TEST_F(EnergyMeters, OneUnreadableZoneLeavesTheOthers) {
  system_.intel_server();
  ::chmod(system_.path(std::string(powercap) + "intel-rapl:0:1/energy_uj").c_str(), 0);
  const testing::WithoutRootsPowers user;
  const FoundMeters found = find_meters(context());
  EXPECT_EQ(found.meters.size(), 5u);
  EXPECT_THAT(found.refused, ElementsAre(Pair(Field(&MeterInfo::name, "package-0/dram"),
                                              HasSubstr("Permission denied"))));
}

TEST_F(EnergyMeters, GarbageIsNoReading) {
  system_.zone("intel-rapl:0", "package-0", 100, 1000);
  system_.write(std::string(powercap) + "intel-rapl:0/energy_uj", "100 uJ");
  const FoundMeters found = find_powercap(context());
  EXPECT_THAT(found.meters, IsEmpty());
  EXPECT_THAT(found.unavailable, HasSubstr("energy_uj: found '100 uJ', expected a whole number"));
  system_.write(std::string(powercap) + "intel-rapl:0/energy_uj", "1001");
  EXPECT_THAT(find_powercap(context()).unavailable,
              HasSubstr("found 1001, expected at most max_energy_range_uj = 1000"));
  system_.remove(std::string(powercap) + "intel-rapl:0/max_energy_range_uj");
  EXPECT_THAT(find_powercap(context()).unavailable, HasSubstr("max_energy_range_uj: No such file"));
}

TEST_F(EnergyMeters, ASensorThatVanishesMakesItsRailInvalidOnly) {
  system_.intel_server();
  begin();
  system_.set(std::string(powercap) + "intel-rapl:0/energy_uj", 2000000);
  system_.set(std::string(powercap) + "intel-rapl:1/energy_uj", 2000000);
  at(1);
  system_.remove(std::string(powercap) + "intel-rapl:1");
  at(2);
  system_.zone("intel-rapl:1", "package-1", 3000000, 262143328850);
  at(3);
  sampler_->end();
  EXPECT_EQ(channel("package-0").failure, "");
  EXPECT_DOUBLE_EQ(channel("package-0").joules, 1);
  EXPECT_THAT(channel("package-1").failure,
              HasSubstr("intel-rapl:1/energy_uj: No such file or directory"))
      << "and coming back does not make up for what is missing";
}

TEST_F(EnergyMeters, GarbageDuringTheRunMakesTheRailInvalid) {
  system_.odroid_old();
  begin();
  system_.odroid_old_power("4-0040", "0.5 W");
  at(1);
  EXPECT_THAT(channel("A15").failure, HasSubstr("4-0040/sensor_W: found '0.5 W'"));
  EXPECT_EQ(channel("A7").failure, "");
}

// --- performance events ---

TEST_F(EnergyMeters, PerfEventsHaveTheirScaleAndAreReadOnEverySocket) {
  system_.perf_power();
  for (const int cpu : {0, 18}) {
    perf_.values[{9, 2, cpu}] = std::uint64_t{1} << 40;
    perf_.values[{9, 3, cpu}] = std::uint64_t{1} << 40;
  }
  const FoundMeters found = find_perf_power(context());
  EXPECT_THAT(names(found),
              ElementsAre("package-0", "package-0/dram", "package-1", "package-1/dram"));
  EXPECT_THAT(in_total(found), ElementsAre("package-0", "package-1"));
  begin();
  perf_.values[{9, 2, 18}] += std::uint64_t{3} << 32;  // one step is 2^-32 J
  at(1);
  EXPECT_DOUBLE_EQ(channel("package-1").joules, 3);
  EXPECT_DOUBLE_EQ(channel("package-0").joules, 0);
}

TEST_F(EnergyMeters, PerfEventsAreNotReadBesidesPowercap) {
  system_.perf_power();
  for (const int cpu : {0, 18}) perf_.values[{9, 2, cpu}] = perf_.values[{9, 3, cpu}] = 1;
  system_.intel_server();
  const FoundMeters found = find_meters(context());
  EXPECT_EQ(found.meters.size(), 6u);
  EXPECT_EQ(named(found, "package-0").info().sensor, "powercap intel-rapl:0");
}

TEST_F(EnergyMeters, PerfEventsStandInForPowercapThatMayNotBeRead) {
  system_.perf_power();
  for (const int cpu : {0, 18}) perf_.values[{9, 2, cpu}] = perf_.values[{9, 3, cpu}] = 1;
  system_.zone("intel-rapl:0", "package-0", 1, 1000);
  ::chmod(system_.path(std::string(powercap) + "intel-rapl:0/energy_uj").c_str(), 0);
  const testing::WithoutRootsPowers user;
  const FoundMeters found = find_meters(context());
  EXPECT_EQ(found.meters.size(), 4u);
  EXPECT_THAT(found.refused, IsEmpty()) << "package-0 is measured in another way";
}

TEST_F(EnergyMeters, PerfEventsThatMayNotBeOpenedSayWhy) {
  system_.perf_power();
  perf_.refusal = "not permitted";
  EXPECT_EQ(find_perf_power(context()).unavailable, "not permitted");
  perf_.refusal.clear();
  system_.write("/sys/bus/event_source/devices/power/cpumask", "0-");
  EXPECT_THAT(find_perf_power(context()).unavailable,
              HasSubstr("cpumask: found '0-', expected a list of processors"));
  system_.write("/sys/bus/event_source/devices/power/cpumask", "0");
  system_.write("/sys/bus/event_source/devices/power/events/energy-pkg", "config=2");
  system_.remove("/sys/bus/event_source/devices/power/events/energy-ram");
  EXPECT_THAT(find_perf_power(context()).unavailable,
              HasSubstr("energy-pkg: found 'config=2', expected event=0x..."));
  system_.write("/sys/bus/event_source/devices/power/events/energy-pkg.unit", "Watts");
  EXPECT_THAT(find_perf_power(context()).unavailable, HasSubstr("found 'Watts', expected Joules"));
}

// --- an AMD desktop ---

TEST_F(EnergyMeters, AmdDesktopAddsThePackageOnly) {
  system_.amd_desktop();
  const FoundMeters found = find_meters(context());
  EXPECT_THAT(names(found),
              ElementsAre("package-0", "package-0/core", "amdgpu PPT", "cpu frequency", "Tctl"));
  EXPECT_THAT(in_total(found), ElementsAre("package-0"))
      << "what hwmon's other chips supply is not known";
  begin();
  at(1);
  system_.set("/sys/class/hwmon/hwmon1/power1_average", 75000000);
  at(2);
  EXPECT_DOUBLE_EQ(channel("amdgpu PPT").joules, 25 + 50) << "trapezoids";
  EXPECT_DOUBLE_EQ(channel("cpu frequency").samples.at(0).value, 3.5e9);
  EXPECT_DOUBLE_EQ(channel("Tctl").samples.at(0).value, 60.5);
}

TEST_F(EnergyMeters, HwmonPrefersTheReadingToTheAverageAndNumbersCards) {
  for (const char* chip : {"hwmon1", "hwmon2"}) {
    const std::string folder = std::string("/sys/class/hwmon/") + chip;
    system_.write(folder + "/name", "amdgpu");
    system_.write(folder + "/power1_average", "1");
    system_.write(folder + "/power1_input", "2000000");
    system_.write(folder + "/power1_cap", "3");
    system_.write(folder + "/energy1_input", "4000000");
  }
  FoundMeters found = find_meters(context());
  EXPECT_THAT(names(found), ElementsAre("amdgpu", "amdgpu 2", "amdgpu 3", "amdgpu 4"));
  EXPECT_DOUBLE_EQ(found.meters[0]->read(), 2);
  EXPECT_EQ(found.meters[1]->info().quantity, Quantity::energy_j);
  EXPECT_DOUBLE_EQ(found.meters[1]->read(), 4);
}

// --- an ODROID-XU3 ---

TEST_F(EnergyMeters, OdroidHasFourRailsThatAddUp) {
  system_.odroid_old();
  const FoundMeters found = find_meters(context());
  EXPECT_THAT(names(found), ElementsAre("A15", "DRAM", "GPU", "A7"));
  EXPECT_EQ(in_total(found).size(), 4u);
  EXPECT_EQ(named(found, "GPU").info().sensor, "INA231 4-0044 (vendor's driver)");
}

TEST_F(EnergyMeters, OdroidWithAMainlineKernelHasTheSame) {
  system_.odroid_mainline();
  FoundMeters found = find_meters(context());
  EXPECT_THAT(names(found), ElementsAre("A15", "DRAM", "GPU", "A7"));
  EXPECT_EQ(in_total(found).size(), 4u);
  EXPECT_DOUBLE_EQ(found.meters[2]->read(), 0.5);
}

TEST_F(EnergyMeters, AnotherBoardsIna2xxIsNoOdroid) {
  system_.write("/sys/class/hwmon/hwmon0/name", "ina226");
  system_.write("/sys/class/hwmon/hwmon0/power1_input", "1000000");
  system_.link("/sys/class/hwmon/hwmon0/device", "../../../1-0040");
  const FoundMeters found = find_meters(context());
  EXPECT_THAT(names(found), ElementsAre("ina226 1-0040"));
  EXPECT_THAT(in_total(found), IsEmpty());
}

TEST_F(EnergyMeters, ASwitchedOffSensorSaysHowToSwitchItOn) {
  system_.odroid_old();
  system_.write("/sys/bus/i2c/drivers/INA231/4-0045/enable", "0");
  const FoundMeters found = find_meters(context());
  EXPECT_EQ(found.meters.size(), 3u);
  EXPECT_THAT(found.refused,
              ElementsAre(Pair(Field(&MeterInfo::name, "A7"),
                               AllOf(HasSubstr("echo 1"), HasSubstr("4-0045/enable")))));
}

/// A triangle: power rises from 1 to 3 W and falls again, in 2 s: 4 J; read at 16 Hz.
TEST_F(EnergyMeters, PowerIsIntegratedOverTime) {
  system_.odroid_old();
  const auto watts = [](double time_s) { return 1 + 2 * (1 - std::abs(time_s - 1)); };
  system_.odroid_old_power("4-0040", fmt::format("{:.6f}", watts(0)));
  begin();
  for (int i = 1; i <= 32; ++i) {
    system_.odroid_old_power("4-0040", fmt::format("{:.6f}", watts(i / 16.)));
    at(i / 16.);
  }
  EXPECT_NEAR(channel("A15").joules, 4, 1e-12);
  EXPECT_DOUBLE_EQ(*channel("A15").peak_w, 3);
  EXPECT_EQ(channel("A15").updates, 32);
}

TEST_F(EnergyMeters, UnevenReadingsWeighByTheirTime) {
  system_.odroid_old();
  system_.odroid_old_power("4-0040", "1");
  begin();
  at(3);
  system_.odroid_old_power("4-0040", "5");
  at(3.5);
  at(4.5);
  EXPECT_DOUBLE_EQ(channel("A15").joules, 3 * 1 + 0.5 * 3 + 1 * 5);
}

// --- a Jetson ---

TEST_F(EnergyMeters, JetsonsInputSuppliesTheOtherLines) {
  system_.jetson_new();
  FoundMeters found = find_meters(context());
  EXPECT_THAT(names(found), ElementsAre("VDD_IN", "VDD_CPU_GPU_CV")) << "NC is not connected";
  EXPECT_THAT(in_total(found), ElementsAre("VDD_IN"));
  EXPECT_EQ(named(found, "VDD_CPU_GPU_CV").info().within, "VDD_IN");
  EXPECT_DOUBLE_EQ(found.meters[0]->read(), 5) << "5000 mV x 1000 mA";
  EXPECT_DOUBLE_EQ(found.meters[0]->info().resolution, 0.005);
}

TEST_F(EnergyMeters, JetsonWithoutAnInputLineAddsItsLines) {
  system_.jetson_new();
  system_.write("/sys/class/hwmon/hwmon1/in1_label", "GPU");
  system_.write("/sys/class/hwmon/hwmon1/in2_label", "CPU");
  EXPECT_THAT(in_total(find_meters(context())), UnorderedElementsAre("GPU", "CPU"));
}

TEST_F(EnergyMeters, OlderJetsonsMultiplyThemselves) {
  system_.jetson_old();
  FoundMeters found = find_meters(context());
  EXPECT_THAT(names(found), ElementsAre("POM_5V_IN", "POM_5V_GPU", "POM_5V_CPU"));
  EXPECT_THAT(in_total(found), ElementsAre("POM_5V_IN"));
  EXPECT_DOUBLE_EQ(found.meters[0]->read(), 2);
}

TEST_F(EnergyMeters, ASwitchedOffChannelOfAJetsonIsNone) {
  system_.jetson_new();
  system_.write("/sys/class/hwmon/hwmon1/in2_enable", "0");
  EXPECT_THAT(names(find_meters(context())), ElementsAre("VDD_IN"));
}

// --- temperature and frequency ---

TEST_F(EnergyMeters, ThermalZonesAreReadByType) {
  system_.write("/sys/class/thermal/thermal_zone0/type", "cpu0-thermal");
  system_.write("/sys/class/thermal/thermal_zone0/temp", "45000");
  system_.write("/sys/class/thermal/thermal_zone1/type", "broken");
  system_.write("/sys/class/thermal/thermal_zone1/temp", "");
  system_.write("/sys/class/thermal/cooling_device0/type", "Fan");
  FoundMeters found = find_temperature(context());
  EXPECT_THAT(names(found), ElementsAre("cpu0-thermal"));
  EXPECT_DOUBLE_EQ(found.meters[0]->read(), 45);
}

TEST_F(EnergyMeters, OfManyProcessorsSomeAreAskedForTheirFrequency) {
  for (int cpu = 0; cpu < 64; ++cpu) {
    system_.write(fmt::format("/sys/devices/system/cpu/cpu{}/cpufreq/scaling_cur_freq", cpu),
                  "2000000");
  }
  FoundMeters found = find_frequency(context());
  ASSERT_EQ(found.meters.size(), 1u);
  EXPECT_EQ(found.meters[0]->info().sensor, "cpufreq of 16 processors");
  EXPECT_DOUBLE_EQ(found.meters[0]->read(), 2e9);
}

}  // namespace
}  // namespace slambench
