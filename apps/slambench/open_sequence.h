// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <memory>
#include <string>

#include "config/settings.h"
#include "datasets/source.h"
#include "interrupt.h"

namespace slambench {

/// Opens a sequence and lets it suggest settings: first those of its own file (slambench.toml, of
/// which the tables [source] and [kinectfusion] count), then what its reader thinks suits it.
/// `parameters` are among those that `settings` sets. Throws as read_config_file() and
/// open_source() do.
std::unique_ptr<Source> open_sequence(const std::string& sequence,
                                      const SourceParameters& parameters, Settings* settings);

/// Renders what is to be rendered, with a bar when `show`.
void prepare_sequence(Source& source, int frames, bool show, const InterruptFlag& interrupt);

}  // namespace slambench
