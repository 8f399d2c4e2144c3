// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "kernels/types.h"
#include "verify/random.h"
#include "verify/recording.h"

/// The inputs that the checks share: made up from a seed or from scenes with a closed form, in
/// sizes that no work group divides.
namespace slambench {

inline constexpr Size image_sizes[] = {{1, 1}, {3, 5}, {37, 23}, {64, 48}, {127, 65}, {320, 240}};

template <class T>
struct Named {
  std::string name;
  T value;
};

std::string text(Size size);
std::string text(Int3 resolution);

/// Metric depth: noise with holes in every size, scenes, an image of zeros, one lonely hole, one
/// lonely value, values at the ends of the range, and (but not first) what is no number.
std::vector<Named<Image<float>>> depth_images(Random random,
                                              const std::vector<Recording>& recordings);

/// The same as points of the camera, and points at random, some not finite.
std::vector<Named<Image<Float3>>> vertex_maps(Random random,
                                              const std::vector<Recording>& recordings);

/// Points and normals, by the reference's maths.
struct Maps {
  Image<Float3> vertices, normals;
};
Maps maps_of(const Image<float>& depth_m, Intrinsics camera);
/// Moved from the camera's frame; invalid points and normals stay as they are.
Maps moved(const Maps& maps, const Pose& T_volume_camera);

Image<Float3> vertices_of(const Image<float>& depth_m, Intrinsics camera);
Image<float> halved(const Image<float>& depth_m);

/// Puts NaN and infinities of both signs into some of the values.
void spoil(Image<float>* image, Random* random);
void spoil(Image<Float3>* image, Random* random);

Float3 random_unit_vector(Random* random);

}  // namespace slambench
