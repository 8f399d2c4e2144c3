// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "open_sequence.h"

#include <fmt/format.h>

#include "all_parameters.h"
#include "config/config_file.h"
#include "meters/clock.h"
#include "progress.h"

namespace slambench {

std::unique_ptr<Source> open_sequence(const std::string& sequence,
                                      const SourceParameters& parameters, Settings* settings) {
  if (const std::string path = sequence_settings_file(sequence); !path.empty()) {
    AllParameters all;  // to check the whole file against
    const ConfigFile file = read_config_file(path, all.lists());
    const std::vector<ParameterList> of_sequences = {all.source.describe(),
                                                     all.kinectfusion.describe()};
    for (const ConfigAssignment& assignment : file.assignments) {
      if (find(of_sequences, assignment.name) == nullptr) continue;
      settings->set(assignment.name, assignment.value, Origin::sequence,
                    fmt::format("sequence file {}", path));
    }
  }
  auto source = open_source(sequence, parameters);
  settings->suggest(source->info().suggested);
  return source;
}

void prepare_sequence(Source& source, int frames, bool show, const InterruptFlag& interrupt) {
  ProgressBar bar("rendering", "frames", steady_clock(), show);
  source.prepare(frames, [&](int done, int total) {
    bar.show(done, total);
    return !interrupt.raised().load();
  });
}

}  // namespace slambench
