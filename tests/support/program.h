// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace slambench::testing {

/// How a program ended; 128 + the signal's number when one ended it.
struct Outcome {
  int status = -1;
  std::string out, err;
};

/// The program under test, run in a folder of its own, which is its cache and holds its results.
class Program {
 public:
  explicit Program(std::string path) : path_(std::move(path)) {
    environment_["XDG_CACHE_HOME"] = folder_.path("cache");
    environment_["TERM"] = "xterm";
    environment_["NO_COLOR"] = "";  // as if it were not set
  }

  const TemporaryFolder& folder() const { return folder_; }
  void set_environment(const std::string& name, const std::string& value) {
    environment_[name] = value;
  }
  /// Standard output goes to this file from now on; "" closes it.
  void set_output(const std::string& file) { output_ = file; }

  /// Standard error goes to this file from now on, and is not in Outcome::err.
  void set_error(const std::string& file) { error_ = file; }

  /// A limit of the process from now on, below the hard one (sys/resource.h).
  void set_limit(decltype(RLIMIT_STACK) resource, rlim_t value) { limits_[resource] = value; }

  pid_t start(const std::vector<std::string>& arguments) const {
    const pid_t child = ::fork();
    if (child == 0) execute(arguments);
    return child;
  }

  Outcome wait(pid_t child) const {
    int ended = 0;
    if (::waitpid(child, &ended, 0) != child) return {};
    const int status = WIFEXITED(ended) ? WEXITSTATUS(ended) : 128 + WTERMSIG(ended);
    return {status, contents(folder_.path("stdout")), contents(folder_.path("stderr"))};
  }

  Outcome run(const std::vector<std::string>& arguments) const { return wait(start(arguments)); }

  static std::string contents(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  [[noreturn]] void execute(const std::vector<std::string>& arguments) const {
    constexpr int mode = 0600;
    constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOCTTY;
    const std::string out = output_ == "-" ? folder_.path("stdout") : output_;
    if (out.empty()) {
      ::close(STDOUT_FILENO);
    } else {
      ::dup2(::open(out.c_str(), flags, mode), STDOUT_FILENO);
    }
    ::dup2(::open(error_.empty() ? folder_.path("stderr").c_str() : error_.c_str(), flags, mode),
           STDERR_FILENO);
    for (const auto& [name, value] : environment_) ::setenv(name.c_str(), value.c_str(), 1);
    for (const auto& [resource, value] : limits_) {
      rlimit limit{};
      ::getrlimit(resource, &limit);
      limit.rlim_cur = value;
      if (::setrlimit(resource, &limit) != 0) ::_exit(125);
    }
    if (::chdir(folder_.path().c_str()) != 0) ::_exit(126);
    std::vector<char*> words = {const_cast<char*>(path_.c_str())};
    for (const auto& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    ::execv(path_.c_str(), words.data());
    ::_exit(127);
  }

  std::string path_;
  TemporaryFolder folder_;
  std::map<std::string, std::string> environment_;
  std::map<decltype(RLIMIT_STACK), rlim_t> limits_;
  std::string output_ = "-";  ///< "-": kept for Outcome::out
  std::string error_;         ///< empty: kept for Outcome::err
};

}  // namespace slambench::testing
