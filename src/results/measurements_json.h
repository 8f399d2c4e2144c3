// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "results/record.h"

namespace slambench {

/// Adds what the meters read and how figures varied over repeated runs to the document, and the
/// reasons for what is missing.
void put_measurements(const Record& record, nlohmann::ordered_json* document,
                      std::map<std::string, std::string>* absent);

}  // namespace slambench
