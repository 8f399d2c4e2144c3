// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace slambench {

/// Width and height in pixels.
struct Size {
  int width = 0;
  int height = 0;

  std::size_t count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  bool empty() const { return width <= 0 || height <= 0; }
  friend bool operator==(const Size&, const Size&) = default;
};

struct Rgb8 {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb8&, const Rgb8&) = default;
};

struct Rgba8 {
  std::uint8_t r = 0, g = 0, b = 0, a = 0;
  friend bool operator==(const Rgba8&, const Rgba8&) = default;
};

/// An image in host memory: row-major, rows contiguous, (0,0) at the top left.
template <class T>
class Image {
 public:
  using value_type = T;

  Image() = default;
  explicit Image(Size size, T value = T{}) : size_(size), pixels_(size.count(), value) {}

  Size size() const { return size_; }
  int width() const { return size_.width; }
  int height() const { return size_.height; }
  bool empty() const { return pixels_.empty(); }

  T& operator()(int x, int y) { return pixels_[index(x, y)]; }
  const T& operator()(int x, int y) const { return pixels_[index(x, y)]; }

  T* data() { return pixels_.data(); }
  const T* data() const { return pixels_.data(); }
  std::size_t count() const { return pixels_.size(); }
  std::size_t bytes() const { return pixels_.size() * sizeof(T); }
  auto begin() { return pixels_.begin(); }
  auto end() { return pixels_.end(); }
  auto begin() const { return pixels_.begin(); }
  auto end() const { return pixels_.end(); }

  /// Gives the image this size; the contents are unspecified afterwards. Memory is reused.
  void resize(Size size) {
    size_ = size;
    pixels_.resize(size.count());
  }

  friend bool operator==(const Image&, const Image&) = default;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) +
           static_cast<std::size_t>(x);
  }

  Size size_;
  std::vector<T> pixels_;
};

}  // namespace slambench
