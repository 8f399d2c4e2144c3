// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "backends/backend.h"

namespace slambench {

/// What a kernel did to memory that it had no business with; `quantity` is one of the common
/// limits.
struct Violation {
  std::string_view quantity;
  std::size_t count = 0;
};

/// Bytes that no kernel has a reason to write: as a float 3.4e38, as an outcome none, as a colour
/// one that is not opaque.
inline constexpr unsigned char canary_byte = 0x7f;

template <class T>
T canary() {
  T value;
  std::memset(static_cast<void*>(&value), canary_byte, sizeof value);
  return value;
}

/// An image in a backend's memory with canaries behind its last pixel. It works for memory that
/// only the backend can see: the storage is larger than the image says, so that a kernel that
/// writes past the end changes a canary, and one that reads past the end gets
/// values that show.
template <class T>
class GuardedImage {
 public:
  GuardedImage(Backend& backend, const Image<T>& content)
      : backend_(backend), content_(with_guard(content)), size_(content.size()) {
    image_ = backend.make_image<T>(content_.size());
    backend.write(image_, content_);
    image_.size = size_;
  }

  DeviceImage<T>& image() { return image_; }
  const DeviceImage<T>& image() const { return image_; }

  /// The whole storage: the image, then the guard.
  Image<T> read_all() {
    Image<T> all;
    image_.size = content_.size();
    backend_.read(all, image_);
    image_.size = size_;
    return all;
  }
  /// As it was before any kernel ran.
  const Image<T>& before() const { return content_; }

 private:
  /// As many rows more as a work group could be high, and pixels as it could have threads.
  static Image<T> with_guard(const Image<T>& content) {
    constexpr int least_rows = 16, least_pixels = 1024;
    const int width = content.width();
    const int rows = std::max(least_rows, (least_pixels + width - 1) / width);
    Image<T> all({width, content.height() + rows}, canary<T>());
    std::copy(content.begin(), content.end(), all.begin());
    return all;
  }

  Backend& backend_;
  Image<T> content_;
  Size size_;
  DeviceImage<T> image_;
};

/// The memory of one run of one kernel: inputs that must stay as they are, outputs that must be
/// written to the last pixel, and canaries behind both.
class Workbench {
 public:
  Workbench(Backend& backend, MapKind map) : backend_(backend), map_(map) {}

  Backend& backend() { return backend_; }
  MapKind map() const { return map_; }

  template <class T>
  const DeviceImage<T>& input(const Image<T>& content) {
    return keep(std::make_unique<Item<T>>(backend_, content, true));
  }
  template <class T>
  DeviceImage<T>& output(Size size) {
    return keep(std::make_unique<Item<T>>(backend_, Image<T>(size, canary<T>()), false));
  }
  /// What the kernel wrote.
  template <class T>
  Image<T> result(const DeviceImage<T>& output) {
    Image<T> image;
    backend_.read(image, output);
    return image;
  }
  Volume volume(Int3 resolution, Float3 size_m) {
    return backend_.make_volume(map_, resolution, size_m);
  }
  void note(std::string_view quantity, std::size_t count) { notes_.push_back({quantity, count}); }

  /// Looks at everything on the bench.
  std::vector<Violation> violations();

 private:
  struct AnyItem {
    virtual ~AnyItem() = default;
    virtual void audit(std::vector<Violation>* violations) = 0;
  };
  template <class T>
  struct Item final : AnyItem {
    Item(Backend& backend, const Image<T>& content, bool is_input_)
        : guarded(backend, content), is_input(is_input_) {}
    void audit(std::vector<Violation>* violations) override;

    GuardedImage<T> guarded;
    bool is_input;
  };
  template <class T>
  DeviceImage<T>& keep(std::unique_ptr<Item<T>> item) {
    DeviceImage<T>& image = item->guarded.image();
    items_.push_back(std::move(item));
    return image;
  }

  Backend& backend_;
  const MapKind map_;
  std::vector<std::unique_ptr<AnyItem>> items_;
  std::vector<Violation> notes_;
};

template <class T>
void Workbench::Item<T>::audit(std::vector<Violation>* violations) {
  const Image<T> after = guarded.read_all();
  const Image<T>& before = guarded.before();
  const std::size_t pixels = guarded.image().size.count();
  std::size_t modified = 0, unwritten = 0, overrun = 0;
  for (std::size_t i = 0; i < after.count(); ++i) {
    const T &was = before.data()[i], &is = after.data()[i];
    using Bytes = std::array<unsigned char, sizeof(T)>;
    const bool changed = std::bit_cast<Bytes>(was) != std::bit_cast<Bytes>(is);
    if (i >= pixels) {
      overrun += changed ? 1 : 0;
    } else if (is_input) {
      modified += changed ? 1 : 0;
    } else {
      unwritten += changed ? 0 : 1;
    }
  }
  violations->push_back({"input pixels modified", modified});
  violations->push_back({"output pixels not written", unwritten});
  violations->push_back({"pixels written past the end", overrun});
}

inline std::vector<Violation> Workbench::violations() {
  backend_.finish();
  std::vector<Violation> all = notes_;
  for (const auto& item : items_) item->audit(&all);
  return all;
}

}  // namespace slambench
