// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors

// What a user is told of a driver's errors, and the account of a device's memory.
#include "backends/opencl/queue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

template <class E>
std::string thrown_for(cl_int code) {
  return testing::message_of<E>([&] { throw_opencl_error("a GPU", cl::Error(code, "clThis")); });
}

TEST(OpenclErrors, OfABusyDeviceAreUnavailable) {
  EXPECT_THAT(thrown_for<UnavailableError>(CL_DEVICE_NOT_AVAILABLE),
              AllOf(HasSubstr("a GPU is not available, another program may hold it"),
                    HasSubstr("clThis (error -2)")));
}

TEST(OpenclErrors, OfMemoryAreUnavailable) {
  for (const cl_int code : {CL_MEM_OBJECT_ALLOCATION_FAILURE, CL_OUT_OF_RESOURCES,
                            CL_OUT_OF_HOST_MEMORY, CL_INVALID_BUFFER_SIZE}) {
    EXPECT_THAT(thrown_for<UnavailableError>(code),
                HasSubstr("a GPU has no memory or resources left: clThis"));
  }
}

TEST(OpenclErrors, OfAnyOtherKindAreFailures) {
  EXPECT_THAT(thrown_for<Error>(CL_INVALID_KERNEL_ARGS), HasSubstr("a GPU failed: clThis"));
  try {
    throw_opencl_error("a GPU", cl::Error(CL_INVALID_VALUE, "clThis"));
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::failed);
  }
}

TEST(OpenclQueue, CountsItsMemoryAndRefusesMoreThanThereIs) {
  const std::vector<OpenclDevice> devices = find_opencl_devices();
  if (devices.empty()) GTEST_SKIP() << "no device";
  constexpr std::size_t mib = std::size_t{1} << 20;
  OpenclDevice small = devices.front();
  small.memory_bytes = 4 * mib;
  small.largest_buffer_bytes = 3 * mib;
  Queue queue(small);
  EXPECT_THAT(testing::message_of<UnavailableError>([&] { queue.allocate(4 * mib); }),
              HasSubstr("found a buffer of 4 MiB, expected at most 3 on"));
  {
    const DeviceMemory held = queue.allocate(3 * mib);
    EXPECT_EQ(queue.allocated_bytes(), 3 * mib);
    EXPECT_THAT(testing::message_of<UnavailableError>([&] { queue.allocate(2 * mib); }),
                HasSubstr("found a buffer of 2 MiB, expected at most the 1 left of 4 on"));
    const DeviceMemory rest = queue.allocate(mib);
  }
  EXPECT_EQ(queue.allocated_bytes(), 0u);
  EXPECT_NO_THROW(queue.allocate(2 * mib));
}

}  // namespace
}  // namespace slambench
