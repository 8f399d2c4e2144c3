// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "analysis/samples.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::message_of;

TEST(Samples, AreSeriesByMeter) {
  const auto all = parse_samples(
      "meter,unit,time_s,value\r\npackage-0,W,0.5,4\r\npackage-0,W,1,8\r\n"
      "\"a \"\"b\"\", c\",degree C,1,60\r\n",
      "s");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].meter, "package-0");
  EXPECT_EQ(all[0].unit, "W");
  EXPECT_THAT(all[0].times_s, ElementsAre(0.5, 1));
  EXPECT_THAT(all[0].values, ElementsAre(4, 8));
  EXPECT_EQ(all[1].meter, "a \"b\", c");
  EXPECT_TRUE(parse_samples("meter,unit,time_s,value\r\n", "s").empty());
}

TEST(Samples, RefuseWhatTheyAreNot) {
  const auto error = [](const char* text) {
    return message_of<InputError>([&] { parse_samples(text, "s.csv"); });
  };
  EXPECT_THAT(error("index,time_s\n"), AllOf(HasSubstr("s.csv: line 1"), HasSubstr("meter,unit")));
  EXPECT_THAT(error("meter,unit,time_s,value\na,W,0,x\n"), HasSubstr("line 2"));
  EXPECT_THAT(error("meter,unit,time_s,value\na,W,0\n"), HasSubstr("line 2"));
  EXPECT_THAT(error("meter,unit,time_s,value\n\"a,W,0,1\n"), HasSubstr("two numbers"));
}

}  // namespace
}  // namespace slambench
