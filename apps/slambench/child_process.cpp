// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "core/error.h"

namespace slambench {
namespace {

constexpr int tick_ms = 100;

[[noreturn]] void fail(const char* what) {
  throw Error(ExitStatus::failed,
              fmt::format("cannot start a run: {}: {}", what, std::strerror(errno)));
}

/// What the child writes to one of its streams.
class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) fail("pipe");
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int writing_end() const { return ends_[1]; }
  int reading_end() const { return ends_[0]; }  ///< -1 after the end
  void close_writing_end() { close_end(1); }

  /// What is there now. Does not wait once poll() found something.
  void read_into(std::string* text) {
    std::array<char, 4096> bytes;
    const ssize_t count = ::read(ends_[0], bytes.data(), bytes.size());
    if (count > 0) text->append(bytes.data(), static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN)) close_end(0);
  }

 private:
  void close_end(std::size_t i) {
    if (ends_[i] >= 0) ::close(ends_[i]);
    ends_[i] = -1;
  }
  std::array<int, 2> ends_ = {-1, -1};
};

/// In the child, between fork and exec: only what may be called there.
[[noreturn]] void become(char* const* words, int out, int err, pid_t parent) {
  constexpr int not_started = 127;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(not_started);  // it is dead already
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  if (nothing > STDERR_FILENO) ::close(nothing);
  ::execv("/proc/self/exe", words);
  ::_exit(not_started);
}

/// Reads both streams until the child has ended. What its own children still hold open is not
/// waited for.
int wait_for(pid_t child, std::array<Pipe, 2>& pipes, const std::function<bool()>& tick,
             ChildOutcome* outcome) {
  int refused = 0;
  const auto read_what_is_there = [&](int wait_ms) {
    std::array<pollfd, 2> streams;
    for (std::size_t i = 0; i < 2; ++i) streams[i] = {pipes[i].reading_end(), POLLIN, 0};
    if (::poll(streams.data(), streams.size(), wait_ms) <= 0) return false;
    if (streams[0].revents != 0) pipes[0].read_into(&outcome->out);
    if (streams[1].revents != 0) pipes[1].read_into(&outcome->err);
    return true;
  };
  for (;;) {
    int ended = 0;
    const pid_t who = ::waitpid(child, &ended, WNOHANG);
    if (who == child) {
      while (read_what_is_there(0)) continue;
      return WIFEXITED(ended) ? WEXITSTATUS(ended) : 128 + WTERMSIG(ended);
    }
    if (who < 0 && errno != EINTR) fail("wait");
    constexpr int patience = 30;  // ticks until the child is asked again, which ends it at once
    if (!tick() && refused++ % patience == 0) ::kill(child, SIGTERM);
    const bool open = pipes[0].reading_end() >= 0 || pipes[1].reading_end() >= 0;
    constexpr int about_to_end_ms = 2;
    read_what_is_there(open ? tick_ms : about_to_end_ms);
  }
}

}  // namespace

ChildOutcome run_child(const std::string& name, const std::vector<std::string>& arguments,
                       const std::function<bool()>& tick) {
  std::array<Pipe, 2> pipes;
  std::vector<char*> words = {const_cast<char*>(name.c_str())};
  for (const std::string& argument : arguments) {
    words.push_back(const_cast<char*>(argument.c_str()));
  }
  words.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) fail("fork");
  if (child == 0) {
    become(words.data(), pipes[0].writing_end(), pipes[1].writing_end(), parent);
  }
  for (Pipe& pipe : pipes) pipe.close_writing_end();
  ChildOutcome outcome;
  outcome.status = wait_for(child, pipes, tick, &outcome);
  return outcome;
}

}  // namespace slambench
