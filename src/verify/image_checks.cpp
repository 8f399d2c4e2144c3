// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "kernels/pixel.h"
#include "verify/checks.h"
#include "verify/compare.h"
#include "verify/inputs.h"
#include "verify/scenes.h"
#include "verify/trial.h"

namespace slambench {
namespace {

/// For images of floats that have one limit, of their relative difference.
struct CompareRelative {
  Trial& trial;

  void operator()(const Image<float>& expected, const Image<float>& found) const {
    const Spread s = spread(expected, found, 0, relative_distance);
    trial.at_most("relative difference", s.worst, s.where);
  }
};

struct CompareLevels {
  Trial& trial;

  void operator()(const Image<Rgba8>& expected, const Image<Rgba8>& found) const {
    const Spread s = spread(expected, found, 0, level_distance);
    trial.at_most("level difference", s.worst, s.where);
  }
};

Image<float> gaussian(int radius, float sigma_px) {
  Image<float> weights({2 * radius + 1, 1});
  for (int i = -radius; i <= radius; ++i) weights(i + radius, 0) = gaussian_weight(i, sigma_px);
  return weights;
}

/// Of the raw depth of a sensor; the largest values and zero are among them.
Image<std::uint16_t> raw_noise(Size size, Random* random) {
  Image<std::uint16_t> raw(size);
  for (std::uint16_t& value : raw) {
    value = random->chance(0.1)   ? std::uint16_t{0}
            : random->chance(0.1) ? std::uint16_t{65535}
                                  : static_cast<std::uint16_t>(random->index(65536));
  }
  return raw;
}

}  // namespace

void check_generate_gaussian(Trial& trial) {
  for (const int radius : {0, 1, 2, 3, 8, 40}) {
    for (const float sigma_px : {0.5f, 4.0f, 13.7f}) {
      trial.add(
          fmt::format("radius {} sigma {}", radius, sigma_px),
          [&](Workbench& bench) {
            auto& weights = bench.output<float>({2 * radius + 1, 1});
            bench.backend().generate_gaussian(weights, sigma_px);
            return bench.result(weights);
          },
          [&](const Image<float>& expected, const Image<float>& found) {
            // Weights of no consequence may be flushed to zero.
            const Spread s = spread(expected, found, 0, [](float e, float f) {
              return e < 1e-30f && f >= 0.0f && f < 1e-30f ? 0 : relative_distance(e, f);
            });
            trial.at_most("relative difference", s.worst, s.where);
          });
    }
  }
}

void check_mm2meters(Trial& trial) {
  Random random = trial.random();
  const auto add = [&](const std::string& input, const Image<std::uint16_t>& raw, int ratio,
                       float units_per_m) {
    trial.add(
        fmt::format("{} ratio {} units {}", input, ratio, units_per_m),
        [&](Workbench& bench) {
          auto& depth_m = bench.output<float>({raw.width() / ratio, raw.height() / ratio});
          bench.backend().mm2meters(depth_m, bench.input(raw), units_per_m);
          return bench.result(depth_m);
        },
        CompareRelative{trial});
  };
  for (const Size size : image_sizes) {
    for (const int ratio : {1, 2, 4, 8}) {
      if (ratio > 2 && size.width > 127) continue;  // larger than any sensor
      const Size input{size.width * ratio, size.height * ratio};
      add("noise " + text(input), raw_noise(input, &random), ratio, ratio == 4 ? 5000.0f : 1000.0f);
    }
  }
  add("zeros 37x23", Image<std::uint16_t>({37, 23}), 1, 1000);
  for (const Recording& recording : trial.recordings()) {
    add(recording.name + " frame 0", recording.frames[0].depth,
        recording.parameters.compute_size_ratio, recording.units_per_m);
  }
}

void check_bilateral_filter(Trial& trial) {
  const auto add = [&](const std::string& input, const Image<float>& depth_m, int radius,
                       float range_sigma_m) {
    trial.add(
        fmt::format("{} radius {} sigma {} m", input, radius, range_sigma_m),
        [&](Workbench& bench) {
          auto& filtered_m = bench.output<float>(depth_m.size());
          bench.backend().bilateral_filter(filtered_m, bench.input(depth_m),
                                           bench.input(gaussian(radius, 4.0f)), range_sigma_m);
          return bench.result(filtered_m);
        },
        CompareRelative{trial});
  };
  for (const auto& [name, depth_m] : depth_images(trial.random(), trial.recordings())) {
    add(name, depth_m, 2, 0.1f);
    if (depth_m.width() > 127) continue;
    add(name, depth_m, 0, 0.1f);
    add(name, depth_m, 1, 0.02f);
    add(name, depth_m, 4, 0.5f);
  }
}

void check_half_sample(Trial& trial) {
  for (const auto& [name, depth_m] : depth_images(trial.random(), trial.recordings())) {
    const Size half{depth_m.width() / 2, depth_m.height() / 2};
    if (half.empty()) continue;  // no system makes a level without pixels
    for (const float range_m : {0.0f, 0.3f, 5.0f}) {
      trial.add(
          fmt::format("{} range {} m", name, range_m),
          [&, &image = depth_m](Workbench& bench) {
            auto& half_m = bench.output<float>(half);
            bench.backend().half_sample(half_m, bench.input(image), range_m);
            return bench.result(half_m);
          },
          CompareRelative{trial});
    }
  }
}

void check_depth2vertex(Trial& trial) {
  for (const auto& [name, depth_m] : depth_images(trial.random(), trial.recordings())) {
    trial.add(
        name,
        [&image = depth_m](Workbench& bench) {
          auto& vertices = bench.output<Float3>(image.size());
          bench.backend().depth2vertex(vertices, bench.input(image), camera_for(image.size()));
          return bench.result(vertices);
        },
        [&](const Image<Float3>& expected, const Image<Float3>& found) {
          const Spread s = spread(expected, found, 0, [](const Float3& e, const Float3& f) {
            return e == f ? 0 : vector_distance(e, f) / static_cast<double>(length(e));
          });
          trial.at_most("relative difference", s.worst, s.where);
        });
  }
}

void check_vertex2normal(Trial& trial) {
  for (const auto& [name, vertices] : vertex_maps(trial.random(), trial.recordings())) {
    trial.add(
        name,
        [&image = vertices](Workbench& bench) {
          auto& normals = bench.output<Float3>(image.size());
          bench.backend().vertex2normal(normals, bench.input(image));
          return bench.result(normals);
        },
        [&](const Image<Float3>& expected, const Image<Float3>& found) {
          const Spread validity = spread(expected, found, 0, [](const Float3& e, const Float3& f) {
            const bool differs = (e.x == invalid_normal) != (f.x == invalid_normal);
            return is_finite(e) && differs ? 1 : 0;
          });
          trial.at_most("validity that differs, of pixels", validity.share_beyond(),
                        validity.where);
          const double limit = trial.tolerance().allowed("difference");
          const Spread s = spread(expected, found, limit, vector_distance);
          trial.at_most("normals apart by more, of pixels", s.share_beyond(), s.where);
        });
  }
}

void check_render_depth(Trial& trial) {
  for (const auto& [name, depth_m] : depth_images(trial.random(), trial.recordings())) {
    trial.add(
        name,
        [&image = depth_m](Workbench& bench) {
          auto& picture = bench.output<Rgba8>(image.size());
          bench.backend().render_depth(picture, bench.input(image), 0.4f, 4.0f);
          return bench.result(picture);
        },
        CompareLevels{trial});
  }
}

void check_render_track(Trial& trial) {
  Random random = trial.random();
  for (const Size size : image_sizes) {
    Image<TrackData> rows(size);
    for (TrackData& row : rows) {
      constexpr std::array outcomes = {TrackOutcome::ok,
                                       TrackOutcome::invalid_input,
                                       TrackOutcome::outside_model,
                                       TrackOutcome::invalid_model,
                                       TrackOutcome::too_far,
                                       TrackOutcome::wrong_normal};
      row.outcome = outcomes[static_cast<std::size_t>(random.index(6))];
    }
    trial.add(
        "outcomes " + text(size),
        [&](Workbench& bench) {
          auto& picture = bench.output<Rgba8>(size);
          bench.backend().render_track(picture, bench.input(rows));
          return bench.result(picture);
        },
        CompareLevels{trial});
  }
}

}  // namespace slambench
