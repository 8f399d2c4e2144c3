// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: The SLAMBench authors
#include "io/png.h"

#include <fmt/format.h>
#include <spng.h>

#include <memory>

#include "core/error.h"
#include "io/files.h"

namespace slambench {
namespace {

/// Larger images are taken for corrupt headers.
constexpr std::uint32_t largest_side = 16384;

struct Free {
  void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using Context = std::unique_ptr<spng_ctx, Free>;

Context make_context(int flags) {
  Context context(spng_ctx_new(flags));
  if (!context) throw std::bad_alloc();
  return context;
}

std::string_view color_name(const spng_ihdr& header) {
  switch (header.color_type) {
    case SPNG_COLOR_TYPE_GRAYSCALE:
      return "greyscale";
    case SPNG_COLOR_TYPE_TRUECOLOR:
      return "RGB";
    case SPNG_COLOR_TYPE_INDEXED:
      return "palette";
    case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
      return "greyscale with alpha";
    default:
      return "RGB with alpha";
  }
}

/// A PNG file being decoded; errors name it.
class Decoder {
 public:
  explicit Decoder(const std::string& path)
      : path_(path), bytes_(read_file(path)), context_(make_context(0)) {
    if (bytes_.empty()) throw InputError(path_ + ": the file is empty, expected a PNG");
    check(spng_set_image_limits(context_.get(), largest_side, largest_side));
    check(spng_set_png_buffer(context_.get(), bytes_.data(), bytes_.size()));
    check(spng_get_ihdr(context_.get(), &header_));
    check_complete();
  }

  const spng_ihdr& header() const { return header_; }
  Size size() const { return {static_cast<int>(header_.width), static_cast<int>(header_.height)}; }
  std::string kind() const {
    return fmt::format("{} bits {}", header_.bit_depth, color_name(header_));
  }

  /// Decodes into exactly `bytes` bytes.
  void decode(void* pixels, std::size_t bytes, spng_format format) {
    check(spng_decode_image(context_.get(), pixels, bytes, format, 0));
    check(spng_decode_chunks(context_.get()));
  }

  [[noreturn]] void reject_kind(std::string_view expected) const {
    throw InputError(path_, "PNG", kind(), expected);
  }

 private:
  /// Follows the chunks (length, type, data, checksum) to the end mark: the decoder itself is
  /// content with a file that ends after the last pixel.
  void check_complete() const {
    constexpr std::size_t signature = 8, chunk_frame = 12;
    for (std::size_t at = signature; at + chunk_frame <= bytes_.size();) {
      std::size_t length = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        length = length << 8 | static_cast<std::uint8_t>(bytes_[at + i]);
      }
      const bool last = bytes_.compare(at + 4, 4, "IEND") == 0;
      at += chunk_frame + length;
      if (last && at <= bytes_.size()) return;
    }
    reject_truncated();
  }

  [[noreturn]] void reject_truncated() const {
    throw InputError(
        fmt::format("{}: truncated PNG: no end mark within its {} bytes", path_, bytes_.size()));
  }

  void check(int error) const {
    if (error == SPNG_OK) return;
    if (error == SPNG_EMEM) throw std::bad_alloc();
    if (error == SPNG_ESIGNATURE) throw InputError(path_ + ": not a PNG");
    if (error == SPNG_IO_EOF || error == SPNG_EOF || error == SPNG_EIDAT_TOO_SHORT) {
      reject_truncated();
    }
    throw InputError(fmt::format("{}: corrupt PNG: {}", path_, spng_strerror(error)));
  }

  const std::string& path_;
  const std::string bytes_;
  const Context context_;
  spng_ihdr header_ = {};
};

template <class T>
std::string encode(const Image<T>& image, std::uint8_t color_type, std::uint8_t bit_depth) {
  const auto check = [](int error) {
    if (error != SPNG_OK) {
      throw Error(ExitStatus::failed, fmt::format("cannot encode PNG: {}", spng_strerror(error)));
    }
  };
  const Context context = make_context(SPNG_CTX_ENCODER);
  spng_ihdr header = {};
  header.width = static_cast<std::uint32_t>(image.width());
  header.height = static_cast<std::uint32_t>(image.height());
  header.color_type = color_type;
  header.bit_depth = bit_depth;
  check(spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1));
  check(spng_set_ihdr(context.get(), &header));
  check(spng_encode_image(context.get(), image.data(), image.bytes(), SPNG_FMT_PNG,
                          SPNG_ENCODE_FINALIZE));
  std::size_t size = 0;
  int error = 0;
  const std::unique_ptr<void, void (*)(void*)> bytes(
      spng_get_png_buffer(context.get(), &size, &error), std::free);
  check(error);
  return {static_cast<const char*>(bytes.get()), size};
}

}  // namespace

void read_png(const std::string& path, Image<std::uint16_t>& image) {
  Decoder decoder(path);
  if (decoder.header().color_type != SPNG_COLOR_TYPE_GRAYSCALE ||
      decoder.header().bit_depth != 16) {
    decoder.reject_kind("16 bits greyscale");
  }
  image.resize(decoder.size());
  decoder.decode(image.data(), image.bytes(), SPNG_FMT_PNG);
}

void read_png(const std::string& path, Image<Rgb8>& image) {
  static_assert(sizeof(Rgb8) == 3);
  Decoder decoder(path);
  if (decoder.header().bit_depth > 8) decoder.reject_kind("8 bits colour or greyscale");
  image.resize(decoder.size());
  decoder.decode(image.data(), image.bytes(), SPNG_FMT_RGB8);
}

std::string png_bytes(const Image<std::uint16_t>& image) {
  return encode(image, SPNG_COLOR_TYPE_GRAYSCALE, 16);
}

std::string png_bytes(const Image<Rgb8>& image) {
  return encode(image, SPNG_COLOR_TYPE_TRUECOLOR, 8);
}

std::string png_bytes(const Image<Rgba8>& image) {
  return encode(image, SPNG_COLOR_TYPE_TRUECOLOR_ALPHA, 8);
}

}  // namespace slambench
