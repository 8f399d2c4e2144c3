// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "io/text.h"

#include <gmock/gmock.h>

namespace slambench {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(CsvFields, AreWhatCsvFieldWrote) {
  const std::string hard = "a \"b\", c";
  EXPECT_THAT(csv_fields("1," + csv_field(hard) + ",,x"), ElementsAre("1", hard, "", "x"));
  EXPECT_THAT(csv_fields(""), ElementsAre(""));
  EXPECT_THAT(csv_fields("a,\"b"), IsEmpty()) << "nothing closes the quotes";
}

TEST(TakeLine, EndsLinesAtLfAndCrLf) {
  std::string_view text = "a\r\nb\n\nc";
  EXPECT_EQ(take_line(&text), "a");
  EXPECT_EQ(take_line(&text), "b");
  EXPECT_EQ(take_line(&text), "");
  EXPECT_EQ(take_line(&text), "c");
  EXPECT_EQ(text, "");
}

}  // namespace
}  // namespace slambench
