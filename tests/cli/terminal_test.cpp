// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>

#include "cli/small_recording.h"
#include "slambench/help.h"
#include "slambench/progress.h"
#include "support/program.h"

namespace slambench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(ProgressLine, FitsTheTerminal) {
  EXPECT_EQ(progress_line("room", "frames", 5, 10, 2, "error 3.1 mm", 200),
            "room [###############...............] 5/10 frames, 2.5/s, error 3.1 mm");
  EXPECT_EQ(progress_line("room", "frames", 5, 10, 0, "", 40),
            "room [##########..........] 5/10 frames");
  EXPECT_EQ(progress_line("room", "frames", 10, 10, 1, "", 200),
            "room [##############################] 10/10 frames, 10.0/s");
  EXPECT_EQ(progress_line("room", "frames", 5, 10, 2, "", 20), "room 5/10 frames, 2");
  EXPECT_EQ(progress_line("room", "frames", 0, 0, 1, "", 200),
            "room [..............................] 0/0 frames, 0.0/s");
  for (int width = 0; width < 100; ++width) {
    EXPECT_LE(progress_line("a", "b", 1, 3, 1, "c", width).size(), std::max(width - 1, 0));
  }
}

TEST(Wrapped, BreaksBetweenWords) {
  EXPECT_EQ(wrapped("one two three", 7, 2), "one two\n  three");
  EXPECT_EQ(wrapped("one  two", 3, 1), "one\n two");
  EXPECT_EQ(wrapped("unbreakable a", 4, 0), "unbreakable\na");
  EXPECT_EQ(wrapped("", 4, 0), "");
}

/// A pseudo-terminal, seen from the side of who looks at it.
class Terminal {
 public:
  Terminal() : side_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK)) {
    is_there_ = side_ >= 0 && ::grantpt(side_) == 0 && ::unlockpt(side_) == 0;
  }
  ~Terminal() { ::close(side_); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  bool is_there() const { return is_there_; }
  std::string name() const { return ::ptsname(side_); }

  /// What appears until `enough` of it or until whoever wrote has closed the terminal; a minute at
  /// most. One read returns 4095 bytes, or fewer while more is on its way.
  template <class Enough>
  std::string shown(const Enough& enough) {
    std::string text;
    for (int waits = 0; waits < 6000 && !enough(text);) {
      char part[4096];
      const ssize_t count = ::read(side_, part, sizeof part);
      if (count > 0) {
        text.append(part, static_cast<std::size_t>(count));
      } else if (count == 0 || errno != EAGAIN) {
        break;
      } else {
        ++waits;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    }
    return text;
  }
  std::string all_shown() {
    return shown([](const std::string&) { return false; });
  }

 private:
  int side_;
  bool is_there_ = false;
};

/// Runs the program with standard error at a terminal of its own; returns what appears there.
class TerminalTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!terminal_.is_there()) GTEST_SKIP() << "no pseudo-terminal here";
    program_.folder().write("small.raw", testing::small_raw(8));
    program_.set_error(terminal_.name());
  }

  void run(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = testing::small_run();
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(program_.run(arguments).status, 0);
  }
  std::string shown(const std::vector<std::string>& more) {
    run(more);
    return terminal_.all_shown();
  }

  testing::Program program_{SLAMBENCH_PROGRAM};
  Terminal terminal_;
};

TEST_F(TerminalTest, ShowsProgressAndRemovesIt) {
  const std::string text = shown({});
  EXPECT_THAT(text, AllOf(HasSubstr("small ["), HasSubstr("8/8 frames")));
  EXPECT_TRUE(text.ends_with("\r\033[K")) << "the line is cleared at the end";
}

TEST_F(TerminalTest, TheSecondInterruptEndsAtOnceAndTheFirstSaysSo) {
  std::vector<std::string> arguments = testing::small_run();
  // Seconds a frame, so that the second interrupt meets it on a busy machine too.
  for (const char* more : {"--backend", "serial", "--map", "grid", "-v", "512"}) {
    arguments.emplace_back(more);
  }
  const pid_t child = program_.start(arguments);
  const auto wait_for = [&](const std::string& words) {
    return terminal_.shown(
        [&](const std::string& text) { return text.find(words) != std::string::npos; });
  };
  wait_for("/8 frames");
  ASSERT_EQ(::kill(child, SIGINT), 0);
  EXPECT_THAT(wait_for("without results\r\n"), HasSubstr("interrupt again to end at once"));
  ASSERT_EQ(::kill(child, SIGINT), 0);
  EXPECT_EQ(program_.wait(child).status, 128 + SIGINT);
  EXPECT_FALSE(std::filesystem::exists(program_.folder().path("out")));
}

TEST_F(TerminalTest, ShowsNothingWhenNotWanted) {
  EXPECT_THAT(shown({"--quiet"}), IsEmpty());
  EXPECT_THAT(shown({"--json", "--force"}), IsEmpty());
  program_.set_environment("TERM", "dumb");
  EXPECT_THAT(shown({"--force"}), IsEmpty());
}

TEST_F(TerminalTest, ColoursOnlyWhereTheyAreTaken) {
  Terminal output;
  ASSERT_TRUE(output.is_there());
  program_.set_output(output.name());
  const auto summary = [&] {
    run({"--force"});
    return output.all_shown();
  };
  EXPECT_THAT(summary(), HasSubstr("\033["));
  program_.set_environment("NO_COLOR", "1");
  EXPECT_THAT(summary(), AllOf(HasSubstr("raycast"), Not(HasSubstr("\033["))));
}

}  // namespace
}  // namespace slambench
