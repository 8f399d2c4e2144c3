// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <vector>

#include "backends/registry.h"
#include "core/parameter.h"
#include "datasets/source.h"
#include "meters/run_meters.h"
#include "results/output_parameters.h"
#include "runner/runner.h"
#include "slam/kinect_fusion.h"

namespace slambench {

/// Everything a user can turn in a run. The lists point into the object, which stays in its place.
struct AllParameters {
  RunParameters run;
  SourceParameters source;
  BackendOptions backend;
  MeterParameters meters;
  OutputParameters output;
  KinectFusionParameters kinectfusion;

  AllParameters() = default;
  AllParameters(const AllParameters&) = delete;
  AllParameters& operator=(const AllParameters&) = delete;

  std::vector<ParameterList> lists() {
    return {run.describe(),    source.describe(),       backend.describe(),       meters.describe(),
            output.describe(), kinectfusion.describe(), backend.opencl.describe()};
  }
};

}  // namespace slambench
