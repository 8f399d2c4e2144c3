// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meters/meter.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class NvmlTest : public ::testing::Test {
 protected:
  NvmlTest() : library_(::dlopen(SLAMBENCH_FAKE_NVML, RTLD_NOW)) {
    if (library_ == nullptr) throw std::runtime_error(::dlerror());
    set_ = reinterpret_cast<void (*)(unsigned long long, unsigned long long, int)>(
        ::dlsym(library_, "fake_nvml_set"));
    users_ = reinterpret_cast<int (*)()>(::dlsym(library_, "fake_nvml_users"));
    set_(1000, 0, 0);
  }
  ~NvmlTest() override { ::dlclose(library_); }

  static FoundMeters find(const std::string& library = SLAMBENCH_FAKE_NVML) {
    return find_nvml({SystemFiles("/nowhere"), nullptr, library});
  }

  void* const library_;
  void (*set_)(unsigned long long mj, unsigned long long mj_a_reading, int status);
  int (*users_)();
};

TEST_F(NvmlTest, ReadsEnergyWhereTheDeviceCountsItAndElsePower) {
  FoundMeters found = find();
  ASSERT_EQ(found.meters.size(), 2u);
  EXPECT_EQ(found.meters[0]->info().name, "gpu0");
  EXPECT_EQ(found.meters[0]->info().sensor, "NVML Fake V100");
  EXPECT_EQ(found.meters[0]->info().quantity, Quantity::energy_j);
  EXPECT_EQ(found.meters[0]->info().resolution, 1e-3);
  EXPECT_TRUE(found.meters[0]->info().in_total);
  EXPECT_DOUBLE_EQ(found.meters[0]->read(), 1);
  set_(3500, 0, 0);
  EXPECT_DOUBLE_EQ(found.meters[0]->read(), 3.5);
  EXPECT_EQ(found.meters[1]->info().quantity, Quantity::power_w);
  EXPECT_DOUBLE_EQ(found.meters[1]->read(), 75);
}

TEST_F(NvmlTest, ADeviceThatIsLostSaysSo) {
  FoundMeters found = find();
  set_(1000, 0, 15);
  EXPECT_EQ(testing::message_of<MeterError>([&] { found.meters[0]->read(); }),
            "nvmlDeviceGetTotalEnergyConsumption: GPU is lost");
  EXPECT_EQ(testing::message_of<MeterError>([&] { found.meters[1]->read(); }),
            "nvmlDeviceGetPowerUsage: GPU is lost");
}

TEST_F(NvmlTest, EnergyThatFallsIsNoReading) {
  FoundMeters found = find();
  set_(900, 0, 0);
  EXPECT_THAT(testing::message_of<MeterError>([&] { found.meters[0]->read(); }),
              HasSubstr("the driver was loaded again"));
}

TEST_F(NvmlTest, ShutsDownWithItsLastMeter) {
  {
    FoundMeters found = find();
    EXPECT_EQ(users_(), 1);
    found.meters.pop_back();
    EXPECT_EQ(users_(), 1);
  }
  EXPECT_EQ(users_(), 0);
}

TEST_F(NvmlTest, IsUnavailableWithoutTheLibraryOrWithAnother) {
  const FoundMeters none = find("/nowhere/libnvidia-ml.so.1");
  EXPECT_THAT(none.meters, IsEmpty());
  EXPECT_THAT(none.unavailable, HasSubstr("/nowhere/libnvidia-ml.so.1"));
  EXPECT_THAT(find("libc.so.6").unavailable, HasSubstr("NVML has no nvmlInit_v2"));
}

}  // namespace
}  // namespace slambench
