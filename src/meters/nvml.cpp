// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// NVIDIA's management library, which comes with the driver and is loaded when it is there.
// https://docs.nvidia.com/deploy/nvml-api/
#include <dlfcn.h>
#include <fmt/format.h>

#include <array>

#include "meters/file_meter.h"
#include "meters/meter.h"

namespace slambench {
namespace {

using Status = int;    // nvmlReturn_t: 0 is success
using Device = void*;  // nvmlDevice_t

/// The functions that are used of it. Shut down when the last meter goes.
class Nvml {
 public:
  explicit Nvml(const std::string& library) : handle_(::dlopen(library.c_str(), RTLD_NOW)) {
    if (handle_ == nullptr) throw MeterError(::dlerror());
    try {
      load("nvmlInit_v2", &init_);
      load("nvmlShutdown", &shutdown_);
      load("nvmlErrorString", &error_string_);
      load("nvmlDeviceGetCount_v2", &count_);
      load("nvmlDeviceGetHandleByIndex_v2", &device_);
      load("nvmlDeviceGetName", &name_);
      load("nvmlDeviceGetTotalEnergyConsumption", &energy_mj_);
      load("nvmlDeviceGetPowerUsage", &power_mw_);
      check(init_(), "nvmlInit");
    } catch (const MeterError&) {
      ::dlclose(handle_);
      throw;
    }
  }
  ~Nvml() {
    shutdown_();
    ::dlclose(handle_);
  }
  Nvml(const Nvml&) = delete;
  Nvml& operator=(const Nvml&) = delete;

  unsigned device_count() const {
    unsigned count = 0;
    check(count_(&count), "nvmlDeviceGetCount");
    return count;
  }
  Device device(unsigned index) const {
    Device device = nullptr;
    check(device_(index, &device), "nvmlDeviceGetHandleByIndex");
    return device;
  }
  std::string name(Device device) const {
    std::array<char, 96> text{};  // NVML_DEVICE_NAME_V2_BUFFER_SIZE
    check(name_(device, text.data(), text.size()), "nvmlDeviceGetName");
    return text.data();
  }
  /// Since the driver was loaded.
  double energy_j(Device device) const {
    unsigned long long mj = 0;
    check(energy_mj_(device, &mj), "nvmlDeviceGetTotalEnergyConsumption");
    return static_cast<double>(mj) * 1e-3;
  }
  double power_w(Device device) const {
    unsigned mw = 0;
    check(power_mw_(device, &mw), "nvmlDeviceGetPowerUsage");
    return mw * 1e-3;
  }

 private:
  template <class Function>
  void load(const char* symbol, Function* function) const {
    *function = reinterpret_cast<Function>(::dlsym(handle_, symbol));
    if (*function == nullptr) throw MeterError(fmt::format("NVML has no {}", symbol));
  }
  void check(Status status, const char* function) const {
    if (status != 0) throw MeterError(fmt::format("{}: {}", function, error_string_(status)));
  }

  void* const handle_;
  Status (*init_)() = nullptr;
  Status (*shutdown_)() = nullptr;
  const char* (*error_string_)(Status) = nullptr;
  Status (*count_)(unsigned*) = nullptr;
  Status (*device_)(unsigned, Device*) = nullptr;
  Status (*name_)(Device, char*, unsigned) = nullptr;
  Status (*energy_mj_)(Device, unsigned long long*) = nullptr;
  Status (*power_mw_)(Device, unsigned*) = nullptr;
};

class NvmlMeter final : public Meter {
 public:
  NvmlMeter(MeterInfo info, std::shared_ptr<const Nvml> nvml, Device device)
      : Meter(std::move(info)), nvml_(std::move(nvml)), device_(device) {}

  double read() override {
    if (info().quantity == Quantity::power_w) return nvml_->power_w(device_);
    const double now_j = nvml_->energy_j(device_);
    if (now_j < last_j_) {
      throw MeterError("NVML's energy fell: the driver was loaded again");
    }
    return last_j_ = now_j;
  }
  void restart() override { last_j_ = 0; }

 private:
  const std::shared_ptr<const Nvml> nvml_;
  const Device device_;
  double last_j_ = 0;
};

MeterInfo info_of(unsigned index) {
  return {.name = fmt::format("gpu{}", index),
          .sensor = "NVML",
          .quantity = Quantity::energy_j,
          .resolution = 1e-3,
          .within = "",
          .in_total = true};
}

/// The counter of energy where the device has one (Volta and later), else its power.
std::unique_ptr<Meter> meter_of(const std::shared_ptr<const Nvml>& nvml, unsigned index) {
  const Device device = nvml->device(index);
  MeterInfo info = info_of(index);
  info.sensor = fmt::format("NVML {}", nvml->name(device));
  try {
    nvml->energy_j(device);
  } catch (const MeterError&) {
    info.quantity = Quantity::power_w;
  }
  return std::make_unique<NvmlMeter>(std::move(info), nvml, device);
}

}  // namespace

FoundMeters find_nvml(const MeterContext& context) {
  FoundMeters found;
  try {
    const auto nvml = std::make_shared<const Nvml>(context.nvml_library);
    const unsigned count = nvml->device_count();
    for (unsigned i = 0; i < count; ++i) {
      add_readable(
          info_of(i), [&] { return meter_of(nvml, i); }, &found);
    }
    explain_nothing(&found, "NVML knows of no device");
  } catch (const MeterError& error) {
    found.unavailable = error.what();
  }
  return found;
}

}  // namespace slambench
