// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "core/parameter.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace slambench {
namespace {

Parameter with_parts(Parameter parameter) {
  parameter.parts = "GROUP,LANES,PACKETS";
  return parameter;
}

/// One parameter of every type.
struct Everything {
  bool flag = false;
  int count = 3;
  double length = 0.1;
  std::string word = "grid", text = "any";
  std::array<int, 3> voxels = {1, 2, 3};
  std::array<double, 3> size = {0.5, 1, 2};
  std::array<int, 3> layout = {1, 8, 2};
  std::vector<int> levels = {10, 5, 4};
  std::optional<double> scale;
  std::optional<std::array<double, 4>> camera;

  ParameterList describe() {
    return {"everything",
            {{"flag", 'f', "", &flag, 0, 0, "a flag"},
             {"count", 'c', "frames", &count, 1, 8, "a count"},
             {"length", 0, "m", &length, 0, 10, "a length"},
             {"word", 0, "", &word, 0, 0, "a word", {"grid", "bricks"}},
             {"text", 0, "", &text, 0, 0, "a text"},
             {"voxels", 0, "", &voxels, 1, 512, "voxels"},
             {"size", 0, "m", &size, 0, 100, "a size"},
             with_parts({"layout", 0, "", &layout, 0, 100, "a layout"}),
             {"levels", 0, "", &levels, 0, 100, "levels"},
             {"scale", 0, "", &scale, 1, 5000, "a scale"},
             {"camera", 0, "px", &camera, 0, 10000, "a camera"}}};
  }
};

class Parameters : public ::testing::Test {
 protected:
  const Parameter& at(std::string_view name) { return *find(lists_, name); }
  void set(std::string_view name, std::string_view text) { set_from_text(at(name), text); }
  std::string refusal(std::string_view name, std::string_view text) {
    return testing::message_of<UsageError>([&] { set(name, text); });
  }

  Everything values_;
  std::vector<ParameterList> lists_{values_.describe()};
};

TEST_F(Parameters, AreFoundByName) {
  EXPECT_EQ(at("count").flag, 'c');
  EXPECT_EQ(find(lists_, "counts"), nullptr);
  EXPECT_EQ(find({}, "count"), nullptr);
}

TEST_F(Parameters, AreWrittenAsOnTheCommandLine) {
  EXPECT_EQ(to_text(at("flag")), "false");
  EXPECT_EQ(to_text(at("count")), "3");
  EXPECT_EQ(to_text(at("length")), "0.1");
  EXPECT_EQ(to_text(at("word")), "grid");
  EXPECT_EQ(to_text(at("voxels")), "1,2,3");
  EXPECT_EQ(to_text(at("size")), "0.5,1,2");
  EXPECT_EQ(to_text(at("levels")), "10,5,4");
  EXPECT_EQ(to_text(at("scale")), "");
  EXPECT_EQ(to_text(at("camera")), "");
}

TEST_F(Parameters, TakeTextOfTheirType) {
  set("flag", "true");
  EXPECT_TRUE(values_.flag);
  set("flag", "0");
  EXPECT_FALSE(values_.flag);
  set("flag", "1");
  EXPECT_TRUE(values_.flag);
  set("flag", "false");
  EXPECT_FALSE(values_.flag);
  set("count", " +5 ");
  EXPECT_EQ(values_.count, 5);
  set("length", "2.5e-1");
  EXPECT_EQ(values_.length, 0.25);
  set("word", "bricks");
  EXPECT_EQ(values_.word, "bricks");
  set("text", "what you like");
  EXPECT_EQ(values_.text, "what you like");
  set("voxels", "4, 5,6");
  EXPECT_EQ(values_.voxels, (std::array<int, 3>{4, 5, 6}));
  set("voxels", "7");
  EXPECT_EQ(values_.voxels, (std::array<int, 3>{7, 7, 7}));
  set("size", "4.8");
  EXPECT_EQ(values_.size, (std::array<double, 3>{4.8, 4.8, 4.8}));
  set("levels", "3");
  EXPECT_EQ(values_.levels, (std::vector<int>{3}));
  set("scale", "5000");
  EXPECT_EQ(values_.scale, 5000);
  set("scale", "");
  EXPECT_EQ(values_.scale, std::nullopt);
  set("camera", "1,2,3,4.5");
  EXPECT_EQ(values_.camera, (std::array<double, 4>{1, 2, 3, 4.5}));
  set("camera", "");
  EXPECT_EQ(values_.camera, std::nullopt);
}

TEST_F(Parameters, NeedAllPartsWhereEachIsSomethingElse) {
  set("layout", "4,5,6");
  EXPECT_EQ(values_.layout, (std::array<int, 3>{4, 5, 6}));
  EXPECT_EQ(refusal("layout", "7"),
            "--layout: found '7', expected three integers in [0, 100]: GROUP,LANES,PACKETS");
  EXPECT_EQ(values_.layout, (std::array<int, 3>{4, 5, 6}));
}

TEST_F(Parameters, ComeBackFromTheirText) {
  values_.length = 0.1 + 0.2;
  const std::string text = to_text(at("length"));
  values_.length = 0;
  set("length", text);
  EXPECT_EQ(values_.length, 0.1 + 0.2);
}

TEST_F(Parameters, IncludeTheEndsOfTheirRange) {
  for (const char* text : {"1", "8"}) EXPECT_NO_THROW(set("count", text)) << text;
  for (const char* text : {"0", "10", "-0.0"}) EXPECT_NO_THROW(set("length", text)) << text;
  for (const char* text : {"0", "9", "-1", "99999999999"}) {
    EXPECT_THROW(set("count", text), UsageError) << text;
  }
  for (const char* text : {"-0.001", "10.001", "nan", "inf", "-inf", "1e999"}) {
    EXPECT_THROW(set("length", text), UsageError) << text;
  }
  EXPECT_THROW(set("voxels", "1,513,1"), UsageError);
  EXPECT_THROW(set("size", "1,1,-1"), UsageError);
  EXPECT_THROW(set("levels", "5,101"), UsageError);
  EXPECT_THROW(set("scale", "0.5"), UsageError);
  EXPECT_THROW(set("camera", "1,2,3,10001"), UsageError);
}

TEST_F(Parameters, RefuseWhatIsNotOfTheirType) {
  for (const char* text : {"", "x", "1x", "1.5", "1,2", "++1", "0x3", " "}) {
    EXPECT_THROW(set("count", text), UsageError) << text;
  }
  for (const char* text : {"", "x", "1 2", "1,5", "1.2.3"}) {
    EXPECT_THROW(set("length", text), UsageError) << text;
  }
  for (const char* text : {"", "yes", "TRUE", "2"}) {
    EXPECT_THROW(set("flag", text), UsageError) << text;
  }
  for (const char* text : {"", "1,2", "1,2,3,4", "1,,3", "1,2,", "1,2,x", "1.5"}) {
    EXPECT_THROW(set("voxels", text), UsageError) << text;
  }
  for (const char* text : {"", ",", "5,", "5,x"}) {
    EXPECT_THROW(set("levels", text), UsageError) << text;
  }
  for (const char* text : {"1", "1,2,3", "1,2,3,4,5"}) {
    EXPECT_THROW(set("camera", text), UsageError) << text;
  }
  EXPECT_THROW(set("word", "octree"), UsageError);
  EXPECT_THROW(set("word", ""), UsageError);
}

TEST_F(Parameters, SayWhatTheyExpected) {
  EXPECT_EQ(refusal("count", "9"), "--count: found '9', expected an integer in [1, 8] frames");
  EXPECT_EQ(refusal("length", "far"), "--length: found 'far', expected a number in [0, 10] m");
  EXPECT_EQ(refusal("flag", "yes"), "--flag: found 'yes', expected true or false");
  EXPECT_EQ(refusal("word", "octree"), "--word: found 'octree', expected one of grid, bricks");
  EXPECT_EQ(refusal("voxels", "1,2"),
            "--voxels: found '1,2', expected one or three integers in [1, 512]");
  EXPECT_EQ(refusal("size", "a"), "--size: found 'a', expected one or three numbers in [0, 100] m");
  EXPECT_EQ(refusal("levels", "x"),
            "--levels: found 'x', expected integers in [0, 100], separated by commas");
  EXPECT_EQ(refusal("scale", "0"), "--scale: found '0', expected a number in [1, 5000]");
  EXPECT_EQ(refusal("camera", "1"), "--camera: found '1', expected four numbers in [0, 10000] px");
  EXPECT_EQ(expectation(at("text")), "text");
}

TEST_F(Parameters, AreCheckedHoweverTheyWereSet) {
  for (const ParameterList& list : lists_) {
    for (const Parameter& parameter : list.parameters) EXPECT_NO_THROW(check(parameter));
  }
  values_.count = 9;
  EXPECT_THROW(check(at("count")), UsageError);
  values_.length = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(check(at("length")), UsageError);
  values_.levels.clear();
  EXPECT_THROW(check(at("levels")), UsageError);
  values_.camera = {1, 2, 3, -4};
  EXPECT_THROW(check(at("camera")), UsageError);
}

}  // namespace
}  // namespace slambench
