// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "results/provenance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slambench {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

TEST(CpuModel, OfX86IsTheModelName) {
  EXPECT_EQ(cpu_model("processor\t: 0\nmodel\t\t: 97\nmodel name\t: AMD Ryzen 9 7950X \n\n"
                      "processor\t: 1\nmodel name\t: another\n"),
            "AMD Ryzen 9 7950X");
}

TEST(CpuModel, OfArmCountsKindsOfCores) {
  constexpr std::string_view xu3 =
      "processor\t: 0\nmodel name\t: ARMv7 Processor rev 3 (v7l)\n"
      "CPU implementer\t: 0x41\nCPU part\t: 0xc07\n\n"
      "processor\t: 1\nCPU implementer\t: 0x41\nCPU part\t: 0xc07\n\n"
      "processor\t: 2\nCPU implementer\t: 0x41\nCPU part\t: 0xc0f\n\n"
      "Hardware\t: ODROID-XU3\n";
  EXPECT_EQ(cpu_model(xu3), "2x ARM Cortex-A7, 1x ARM Cortex-A15");
}

TEST(CpuModel, OfAnUnknownArmCoreGivesItsNumbers) {
  EXPECT_EQ(cpu_model("CPU implementer\t: 0x61\nCPU part\t: 0xd08\n"),
            "1x ARM implementer 0x61 part 0xd08");
  EXPECT_EQ(cpu_model("CPU implementer\t: 0x41\nCPU part\t: what\n"),
            "1x ARM implementer 0x41 part what");
}

TEST(CpuModel, OfNothingIsUnknown) {
  EXPECT_EQ(cpu_model(""), "unknown");
  EXPECT_EQ(cpu_model("no colon\n:\n"), "unknown");
}

TEST(UtcText, IsIso8601) {
  EXPECT_EQ(utc_text(std::chrono::sys_seconds(std::chrono::seconds(1432632600))),
            "2015-05-26T09:30:00Z");
}

TEST(BuildAndMachine, AreTold) {
  const Provenance p =
      build_and_machine(std::chrono::sys_seconds(std::chrono::seconds(1432632600)));
  EXPECT_THAT(p.version, MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_THAT(p.commit, MatchesRegex("unknown|[0-9a-f]{40,64}(-dirty)?"));
  EXPECT_THAT(p.compiler, MatchesRegex("[A-Za-z]+ [0-9.]+"));
  EXPECT_THAT(p.flags, HasSubstr("-ffp-contract=off"));
  EXPECT_FALSE(p.build_type.empty());
  EXPECT_FALSE(p.cpu.empty());
  EXPECT_THAT(p.os, HasSubstr("Linux"));
  EXPECT_GE(p.cores, 1);
  EXPECT_GT(p.host_memory_bytes, std::size_t{1} << 20);
  ASSERT_TRUE(p.load_average_start);
  EXPECT_GE(*p.load_average_start, 0);
  EXPECT_EQ(p.load_average_end, std::nullopt) << "nothing has run yet";
  EXPECT_EQ(p.started_at, "2015-05-26T09:30:00Z");
}

TEST(VersionText, ShortensTheCommit) {
  EXPECT_THAT(version_text(), MatchesRegex("[0-9.]+ \\((unknown|[0-9a-f]{12}(-dirty)?)\\)"));
}

}  // namespace
}  // namespace slambench
