// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "meters/system_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fakes.h"
#include "support/fake_machine.h"

namespace slambench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;

class SystemFilesTest : public ::testing::Test {
 protected:
  testing::FakeMachine system_;
  SystemFiles files_{system_.root()};
};

TEST_F(SystemFilesTest, ReadsNumbersWithBlanksAround) {
  system_.write("/sys/a", " 18446744073709551615 ");
  system_.write("/sys/b", "-0.25");
  EXPECT_EQ(files_.count("/sys/a"), 18446744073709551615U);
  EXPECT_EQ(files_.number("/sys/b"), -0.25);
}

TEST_F(SystemFilesTest, RefusesWhatIsNotANumberAsAWhole) {
  for (const char* text : {"12abc", "", "0x10", "1 2", "nan", "inf", "99999999999999999999999"}) {
    system_.write("/sys/a", text);
    const std::string message = message_of<MeterError>([&] { files_.count("/sys/a"); });
    EXPECT_THAT(message,
                HasSubstr(system_.path("/sys/a: found '" + std::string(text).substr(0, 40) +
                                       "', expected a whole number")));
  }
  system_.write("/sys/a", "12.5W");
  EXPECT_THAT(message_of<MeterError>([&] { files_.number("/sys/a"); }),
              HasSubstr("found '12.5W', expected a number"));
}

TEST_F(SystemFilesTest, NamesFileAndReason) {
  EXPECT_EQ(message_of<MeterError>([&] { files_.text("/sys/none"); }),
            system_.path("/sys/none: No such file or directory"));
  system_.write("/sys/secret", "1");
  ::chmod(system_.path("/sys/secret").c_str(), 0);
  const testing::WithoutRootsPowers user;
  EXPECT_EQ(message_of<MeterError>([&] { files_.text("/sys/secret"); }),
            system_.path("/sys/secret: Permission denied"));
}

TEST_F(SystemFilesTest, ListsInNaturalOrder) {
  for (const char* name : {"hwmon10", "hwmon2", "hwmon1", "other"}) {
    system_.write(std::string("/sys/class/hwmon/") + name, "");
  }
  EXPECT_THAT(files_.names("/sys/class/hwmon"),
              ElementsAre("hwmon1", "hwmon2", "hwmon10", "other"));
  EXPECT_THAT(files_.names("/sys/none"), ElementsAre());
}

}  // namespace
}  // namespace slambench
