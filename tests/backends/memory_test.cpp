// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/host/memory.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using testing::message_of;
using testing::TemporaryFolder;

constexpr std::size_t mib = std::size_t{1} << 20;

/// A machine with 1000 MiB available, as its files tell.
class AvailableMemory : public ::testing::Test {
 protected:
  void SetUp() override {
    root_.write("proc/meminfo", "MemTotal: 4096000 kB\nMemFree: 1 kB\nMemAvailable: 1024000 kB\n");
  }
  void group(const std::string& folder, const std::string& limit, std::size_t used_mib,
             const std::string& statistics = "") {
    root_.write("sys/fs/cgroup/" + folder + "/memory.max", limit + "\n");
    root_.write("sys/fs/cgroup/" + folder + "/memory.current",
                std::to_string(used_mib * mib) + "\n");
    root_.write("sys/fs/cgroup/" + folder + "/memory.stat", statistics);
  }
  std::size_t available_mib() const { return available_memory_bytes(root_.path()) / mib; }

  TemporaryFolder root_;
};

TEST_F(AvailableMemory, IsTheMachinesWithoutControlGroups) {
  EXPECT_EQ(available_mib(), 1000u);
  root_.write("proc/self/cgroup", "0::/\n");
  EXPECT_EQ(available_mib(), 1000u);
}

TEST_F(AvailableMemory, IsWhatTheGroupsLimitLeaves) {
  root_.write("proc/self/cgroup", "0::/a/b\n");
  group("a/b", std::to_string(300 * mib), 120);
  EXPECT_EQ(available_mib(), 180u);
  group("a/b", std::to_string(300 * mib), 120, "anon 5\ninactive_file 20971520\nslab 1\n");
  EXPECT_EQ(available_mib(), 200u) << "cached files are given back";
  group("a/b", std::to_string(100 * mib), 120);
  EXPECT_EQ(available_mib(), 0u);
  group("a/b", "max", 120);
  EXPECT_EQ(available_mib(), 1000u);
  group("a/b", std::to_string(9000 * mib), 120);
  EXPECT_EQ(available_mib(), 1000u) << "the machine has less than the limit";
}

TEST_F(AvailableMemory, IsTheLeastOfAllGroupsAbove) {
  root_.write("proc/self/cgroup", "0::/a/b\n");
  group("a/b", std::to_string(300 * mib), 120);
  group("a", std::to_string(200 * mib), 150);
  EXPECT_EQ(available_mib(), 50u);
}

TEST_F(AvailableMemory, OfAContainerIsThatOfItsTopmostGroup) {
  root_.write("proc/self/cgroup", "0::/docker/4711\n");  // as the host calls it
  group("", std::to_string(256 * mib), 56);
  EXPECT_EQ(available_mib(), 200u);
}

TEST_F(AvailableMemory, OfVersionOneIsWhatItsLimitLeaves) {
  root_.write("proc/self/cgroup", "9:name=systemd:/x\n4:cpu,memory:/c/d\n3:memoryless:/e\n");
  const std::string folder = "sys/fs/cgroup/memory/c/d/";
  root_.write(folder + "memory.limit_in_bytes", std::to_string(400 * mib));
  root_.write(folder + "memory.usage_in_bytes", std::to_string(100 * mib));
  root_.write(folder + "memory.stat", "inactive_file 1\ntotal_inactive_file 10485760\n");
  EXPECT_EQ(available_mib(), 310u);
  root_.write(folder + "memory.limit_in_bytes", "9223372036854771712");  // none
  EXPECT_EQ(available_mib(), 1000u);
}

TEST_F(AvailableMemory, StandsFilesThatSayNothing) {
  root_.write("proc/self/cgroup", "\n:\nx:y\n0::\n0::relative\n");
  group("a", "garbage", 1);
  EXPECT_EQ(available_mib(), 1000u);
  root_.write("proc/meminfo", "");
  EXPECT_GT(available_mib(), 0u) << "of the machine that this runs on";
}

TEST(RequireMemory, SaysWhatThereIsAndWhatIsNeeded) {
  EXPECT_NO_THROW(require_memory(1));
  const std::string message =
      message_of<UnavailableError>([] { require_memory(std::size_t{1} << 60); });
  EXPECT_NE(message.find("MiB available, expected 1099511627776 MiB"), std::string::npos)
      << message;
}

}  // namespace
}  // namespace slambench
