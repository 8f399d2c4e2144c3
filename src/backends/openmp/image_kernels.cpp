// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "backends/openmp/image_kernels.h"

#include <algorithm>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "backends/openmp/image_kernels.cpp"
#include "hwy/foreach_target.h"
// Included once per target.
#include "backends/openmp/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace slambench {
namespace HWY_NAMESPACE {
namespace {

constexpr int lanes() { return static_cast<int>(hn::MaxLanes(f32)); }

std::size_t index(Size size, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
         static_cast<std::size_t>(x);
}

void mm2meters(float* depth_m, Size size, const std::uint16_t* depth, int ratio, float units_per_m,
               Rows rows) {
  for (int y = rows.begin; y < rows.end; ++y) {
    const std::uint16_t* in = depth + index({size.width * ratio, 0}, 0, y * ratio);
    float* out = depth_m + index(size, 0, y);
    for (int x = 0; x < size.width; ++x) out[x] = meters_from_units(in[x * ratio], units_per_m);
  }
}

/// Rows [begin - radius, end + radius) of the image, clamped at the border, each with `radius`
/// pixels more on the left and enough on the right for whole vectors.
struct Padded {
  Padded(const float* image, Size size, int radius, Rows rows)
      : stride(size.width + 2 * radius + lanes()),
        pixels(static_cast<std::size_t>(stride) *
               static_cast<std::size_t>(rows.end - rows.begin + 2 * radius)) {
    float* out = pixels.data();
    for (int y = rows.begin - radius; y < rows.end + radius; ++y, out += stride) {
      const float* in = image + index(size, 0, clamp_index(y, size.height));
      std::fill_n(out, radius, in[0]);
      std::copy_n(in, size.width, out + radius);
      std::fill_n(out + radius + size.width, radius + lanes(), in[size.width - 1]);
    }
  }
  int stride;
  std::vector<float> pixels;
};

/// The filter of one vector of pixels; `corner` is the top left of the first one's window.
HWY_INLINE Floats bilateral_lanes(const float* corner, int stride, const float* gaussian,
                                  int radius, float inverse_two_sigma2) {
  const int side = 2 * radius + 1;
  const Floats center = hn::LoadU(f32, corner + radius * stride + radius);
  const Floats zero = hn::Zero(f32);
  Floats sum = zero, weights = zero;
  for (int dy = 0; dy < side; ++dy) {
    for (int dx = 0; dx < side; ++dx) {
      const Floats neighbour = hn::LoadU(f32, corner + dy * stride + dx);
      const Floats difference = hn::Sub(neighbour, center);
      const Floats exponent =
          hn::Mul(hn::Mul(hn::Neg(difference), difference), set(inverse_two_sigma2));
      const Floats weight =
          hn::IfThenElseZero(hn::Gt(neighbour, zero),
                             hn::Mul(set(gaussian[dx] * gaussian[dy]), exp_nonpositive(exponent)));
      sum = hn::IfThenElse(hn::Gt(neighbour, zero), hn::MulAdd(weight, neighbour, sum), sum);
      weights = hn::Add(weights, weight);
    }
  }
  return hn::IfThenElseZero(hn::Gt(center, zero), hn::Div(sum, weights));
}

void bilateral_filter(float* filtered_m, const float* depth_m, Size size, const float* gaussian,
                      int radius, float inverse_two_sigma2, Rows rows) {
  const Padded padded(depth_m, size, radius, rows);
  for (int y = rows.begin; y < rows.end; ++y) {
    const float* corner =
        padded.pixels.data() + static_cast<std::ptrdiff_t>(y - rows.begin) * padded.stride;
    float* out = filtered_m + index(size, 0, y);
    for (int x = 0; x < size.width; x += lanes()) {
      const Floats filtered =
          bilateral_lanes(corner + x, padded.stride, gaussian, radius, inverse_two_sigma2);
      const int left = size.width - x;
      if (left >= lanes()) {
        hn::StoreU(filtered, f32, out + x);
      } else {
        hn::BlendedStore(filtered, hn::FirstN(f32, static_cast<std::size_t>(left)), f32, out + x);
      }
    }
  }
}

void half_sample(float* half_m, Size half, const float* depth_m, Size size, float range_m,
                 Rows rows) {
  for (int y = rows.begin; y < rows.end; ++y) {
    float* out = half_m + index(half, 0, y);
    int x = 0;
    for (; x + lanes() <= half.width; x += lanes()) {
      const float* block = depth_m + index(size, 2 * x, 2 * y);
      Floats values[4];
      hn::LoadInterleaved2(f32, block, values[0], values[1]);
      hn::LoadInterleaved2(f32, block + size.width, values[2], values[3]);
      Floats sum = hn::Zero(f32), count = hn::Zero(f32);
      for (const Floats& value : values) {
        const FloatMask near = hn::Le(hn::Abs(hn::Sub(value, values[0])), set(range_m));
        sum = hn::IfThenElse(near, hn::Add(sum, value), sum);
        count = hn::IfThenElse(near, hn::Add(count, set(1.0f)), count);
      }
      hn::StoreU(hn::IfThenElseZero(hn::Gt(count, hn::Zero(f32)), hn::Div(sum, count)), f32,
                 out + x);
    }
    for (; x < half.width; ++x) out[x] = half_sampled(depth_m, size, x, y, range_m);
  }
}

void depth2vertex(Float3* vertices, const float* depth_m, Size size, Intrinsics camera, Rows rows) {
  for (int y = rows.begin; y < rows.end; ++y) {
    const float* in = depth_m + index(size, 0, y);
    Float3* out = vertices + index(size, 0, y);
    const float ray_y = pixel_ray(camera, 0, y).y;
    int x = 0;
    for (; x + lanes() <= size.width; x += lanes()) {
      const Floats depth = hn::LoadU(f32, in + x);
      const Floats ray_x = hn::Div(hn::Sub(iota(x), set(camera.cx)), set(camera.fx));
      const FloatMask valid = hn::Gt(depth, hn::Zero(f32));
      store(
          {hn::IfThenElseZero(valid, hn::Mul(ray_x, depth)),
           hn::IfThenElseZero(valid, hn::Mul(set(ray_y), depth)), hn::IfThenElseZero(valid, depth)},
          out + x);
    }
    for (; x < size.width; ++x) out[x] = vertex_from_depth(in[x], camera, x, y);
  }
}

void vertex2normal(Float3* normals, const Float3* vertices, Size size, Rows rows) {
  const Floats zero = hn::Zero(f32);
  const Vec3 invalid = set(Float3{invalid_normal, 0.0f, 0.0f});
  for (int y = rows.begin; y < rows.end; ++y) {
    const Float3* row = vertices + index(size, 0, y);
    const Float3* above = vertices + index(size, 0, clamp_index(y - 1, size.height));
    const Float3* below = vertices + index(size, 0, clamp_index(y + 1, size.height));
    Float3* out = normals + index(size, 0, y);
    out[0] = normal_from_vertices(vertices, size, 0, y);
    int x = 1;
    for (; x + lanes() < size.width; x += lanes()) {
      const Vec3 left = load(row + x - 1), right = load(row + x + 1);
      const Vec3 up = load(above + x), down = load(below + x);
      const FloatMask hole = hn::Or(hn::Or(hn::Eq(left.z, zero), hn::Eq(right.z, zero)),
                                    hn::Or(hn::Eq(up.z, zero), hn::Eq(down.z, zero)));
      const Vec3 normal = cross(sub(down, up), sub(right, left));
      const Floats norm = length(normal);
      const FloatMask valid = hn::AndNot(hole, hn::Gt(norm, zero));
      store(select(valid, mul(normal, hn::Div(set(1.0f), norm)), invalid), out + x);
    }
    for (; x < size.width; ++x) out[x] = normal_from_vertices(vertices, size, x, y);
  }
}

const char* instruction_set() { return hwy::TargetName(HWY_TARGET); }

void render_depth(Rgba8* image, const float* depth_m, Size size, float near_m, float far_m,
                  Rows rows) {
  for (std::size_t i = index(size, 0, rows.begin); i < index(size, 0, rows.end); ++i) {
    image[i] = depth_color(depth_m[i], near_m, far_m);
  }
}

void render_track(Rgba8* image, const TrackData* track, Size size, Rows rows) {
  for (std::size_t i = index(size, 0, rows.begin); i < index(size, 0, rows.end); ++i) {
    image[i] = track_color(track[i].outcome);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace slambench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace slambench {

HWY_EXPORT(instruction_set);
HWY_EXPORT(mm2meters);
HWY_EXPORT(bilateral_filter);
HWY_EXPORT(half_sample);
HWY_EXPORT(depth2vertex);
HWY_EXPORT(vertex2normal);
HWY_EXPORT(render_depth);
HWY_EXPORT(render_track);

std::string kernels_instruction_set() { return HWY_DYNAMIC_DISPATCH(instruction_set)(); }

void mm2meters_rows(float* depth_m, Size size, const std::uint16_t* depth, int ratio,
                    float units_per_m, Rows rows) {
  HWY_DYNAMIC_DISPATCH(mm2meters)(depth_m, size, depth, ratio, units_per_m, rows);
}
void bilateral_rows(float* filtered_m, const float* depth_m, Size size, const float* gaussian,
                    int radius, float inverse_two_sigma2, Rows rows) {
  HWY_DYNAMIC_DISPATCH(bilateral_filter)
  (filtered_m, depth_m, size, gaussian, radius, inverse_two_sigma2, rows);
}
void half_sample_rows(float* half_m, Size half, const float* depth_m, Size size, float range_m,
                      Rows rows) {
  HWY_DYNAMIC_DISPATCH(half_sample)(half_m, half, depth_m, size, range_m, rows);
}
void depth2vertex_rows(Float3* vertices, const float* depth_m, Size size, Intrinsics camera,
                       Rows rows) {
  HWY_DYNAMIC_DISPATCH(depth2vertex)(vertices, depth_m, size, camera, rows);
}
void vertex2normal_rows(Float3* normals, const Float3* vertices, Size size, Rows rows) {
  HWY_DYNAMIC_DISPATCH(vertex2normal)(normals, vertices, size, rows);
}
void render_depth_rows(Rgba8* image, const float* depth_m, Size size, float near_m, float far_m,
                       Rows rows) {
  HWY_DYNAMIC_DISPATCH(render_depth)(image, depth_m, size, near_m, far_m, rows);
}
void render_track_rows(Rgba8* image, const TrackData* track, Size size, Rows rows) {
  HWY_DYNAMIC_DISPATCH(render_track)(image, track, size, rows);
}

}  // namespace slambench
#endif
