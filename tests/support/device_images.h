// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include "backends/backend.h"

namespace slambench::testing {

template <class T>
DeviceImage<T> uploaded(Backend& backend, const Image<T>& image) {
  DeviceImage<T> on_device = backend.make_image<T>(image.size());
  backend.write(on_device, image);
  return on_device;
}

template <class T>
Image<T> downloaded(Backend& backend, const DeviceImage<T>& on_device) {
  Image<T> image;
  backend.read(image, on_device);
  return image;
}

}  // namespace slambench::testing
