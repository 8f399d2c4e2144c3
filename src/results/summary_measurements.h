// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "results/page.h"
#include "results/record.h"

namespace slambench {

/// Memory, energy and conditions of a run.
void tell_measurements(const Record& record, Page* page);

/// The figures of repeated runs with their intervals; nothing for a single run.
void list_repetition(const Repetition& repetition, Page* page);

}  // namespace slambench
