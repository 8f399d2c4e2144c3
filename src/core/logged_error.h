// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <utility>

#include "core/error.h"

namespace slambench {

/// An error whose reason is a text of several lines that another program wrote: a compiler's log.
class LoggedError : public Error {
 public:
  LoggedError(ExitStatus status, std::string message, std::string log)
      : Error(status, message + ":\n" + log), message_(std::move(message)), log_(std::move(log)) {}

  /// Without the log.
  const std::string& message() const { return message_; }
  const std::string& log() const { return log_; }

 private:
  std::string message_, log_;
};

}  // namespace slambench
