// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace slambench {

/// What the process reports to its caller; fixed, so that scripts can rely on it.
enum class ExitStatus {
  ok = 0,
  failed = 1,
  usage = 2,        ///< the command line or a parameter is wrong
  bad_input = 3,    ///< a file or folder the user named is wrong
  unavailable = 4,  ///< asked for something this machine or build does not offer
  threshold = 5,    ///< everything ran, and a limit the user set was violated
};

/// The base of every error that is meant to be read by a user: one line, and a status.
class Error : public std::runtime_error {
 public:
  Error(ExitStatus status, const std::string& message)
      : std::runtime_error(message), status_(status) {}
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

/// A wrong option, parameter or combination of them.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error(ExitStatus::usage, message) {}
};

/// A wrong file: says which, where in it, what was found and what was expected.
class InputError : public Error {
 public:
  explicit InputError(const std::string& message) : Error(ExitStatus::bad_input, message) {}
  /// "FILE: FIELD: found FOUND, expected EXPECTED"
  InputError(std::string_view file, std::string_view field, std::string_view found,
             std::string_view expected)
      : InputError(std::string(file) + ": " + std::string(field) + ": found " + std::string(found) +
                   ", expected " + std::string(expected)) {}
};

/// Something this machine or this build cannot do: says why, and how to get it.
class UnavailableError : public Error {
 public:
  explicit UnavailableError(const std::string& message) : Error(ExitStatus::unavailable, message) {}
};

}  // namespace slambench
