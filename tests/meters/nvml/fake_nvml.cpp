// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// What the meters use of NVIDIA's management library, for two devices: the first counts energy, the
// second tells its power only.
#include <cstdint>
#include <cstring>

namespace {

unsigned long long energy_mj = 1000;
unsigned long long step_mj = 0;
int status = 0;
int users = 0;

int index_of(void* device) { return static_cast<int>(reinterpret_cast<std::intptr_t>(device)); }

}  // namespace

extern "C" {

// For tests.
void fake_nvml_set(unsigned long long mj, unsigned long long mj_a_reading, int answer) {
  energy_mj = mj;
  step_mj = mj_a_reading;
  status = answer;
}
int fake_nvml_users() { return users; }

int nvmlInit_v2() { return ++users, 0; }
int nvmlShutdown() { return --users, 0; }
const char* nvmlErrorString(int error) {
  return error == 3 ? "Not Supported" : error == 15 ? "GPU is lost" : "Unknown Error";
}
int nvmlDeviceGetCount_v2(unsigned* count) { return *count = 2, 0; }
int nvmlDeviceGetHandleByIndex_v2(unsigned index, void** device) {
  *device = reinterpret_cast<void*>(static_cast<std::intptr_t>(index + 1));
  return 0;
}
int nvmlDeviceGetName(void* device, char* name, unsigned length) {
  std::strncpy(name, index_of(device) == 1 ? "Fake V100" : "Fake K80", length);
  return 0;
}
int nvmlDeviceGetTotalEnergyConsumption(void* device, unsigned long long* mj) {
  if (index_of(device) != 1) return 3;
  *mj = energy_mj;
  energy_mj += step_mj;
  return status;
}
int nvmlDeviceGetPowerUsage(void*, unsigned* mw) { return *mw = 75000, status; }

}  // extern "C"
