// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "results/record.h"

namespace slambench {

/// The version and commit of this build: "0.1.0 (1a2b3c4d5e6f-dirty)".
std::string version_text();

/// What build and machine say of themselves; backend, device, driver and command are left to the
/// caller. Neither the user's nor the machine's name is in it.
Provenance build_and_machine(std::chrono::sys_seconds started_at);

/// How many processes wanted a processor of this machine in the last minute, on average; none where
/// the system does not tell.
std::optional<double> load_average();

/// The processor model in the text of Linux's /proc/cpuinfo: the model name, or the kinds of ARM
/// cores ("4x ARM Cortex-A7, 4x ARM Cortex-A15"); "unknown" when it tells neither.
std::string cpu_model(std::string_view cpuinfo);

/// ISO 8601: "2015-05-26T09:30:00Z".
std::string utc_text(std::chrono::sys_seconds time);

}  // namespace slambench
