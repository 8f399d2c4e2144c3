// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>

#include "verify/agreement.h"

namespace slambench {

/// The table of checks by backend and map, at most `width` columns wide, what it does not say
/// (unavailable backends, failing cases with numbers), and a last line with the verdict.
std::string to_text(const AgreementReport& report, std::size_t width);

std::string to_json(const AgreementReport& report);

/// The page docs/agreement.md: how it is measured, the tolerances, and this report's table.
std::string to_markdown(const AgreementReport& report);

/// The part of that page that does not depend on where it was made.
std::string tolerances_markdown();

}  // namespace slambench
