// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/image.h"

#include <png.h>

#include <bit>
#include <cassert>
#include <csetjmp>
#include <cstdio>
#include <cstring>

#include "core/error.h"
#include "core/file.h"
#include "core/memory.h"
#include "mesh/jpeg.h"

namespace exemplar {
namespace {

constexpr std::string_view kPngSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::string_view kJpegSignature("\xff\xd8\xff", 3);

/// Deflate turns one byte into at most 1,032.
constexpr double kLargestRatio = 1032;

/// libpng's state for one picture, with what its callbacks read and write. libpng reports errors by
/// `longjmp`; each function that calls `setjmp` keeps to plain data between it and a possible jump.
struct Png {
  png_structp png = nullptr;
  png_infop info = nullptr;
  bool writes = false;
  std::string_view in;
  std::size_t position = 0;
  std::string out;
  bool outOfMemory = false;
  char message[128] = "";

  ~Png() {
    if (writes) {
      png_destroy_write_struct(&png, &info);
    } else {
      png_destroy_read_struct(&png, &info, nullptr);
    }
  }
};

[[noreturn]] void onError(png_structp png, png_const_charp message) {
  Png* state = static_cast<Png*>(png_get_error_ptr(png));
  std::snprintf(state->message, sizeof state->message, "%s", message);
  png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

void onRead(png_structp png, png_bytep to, std::size_t count) {
  Png* state = static_cast<Png*>(png_get_io_ptr(png));
  if (count > state->in.size() - state->position) png_error(png, "the file ends too early");
  std::memcpy(to, state->in.data() + state->position, count);
  state->position += count;
}

void onWrite(png_structp png, png_bytep from, std::size_t count) {
  Png* state = static_cast<Png*>(png_get_io_ptr(png));
  try {
    state->out.append(reinterpret_cast<const char*>(from), count);
  } catch (const std::bad_alloc&) {
    state->outOfMemory = true;
  }
  if (state->outOfMemory) png_error(png, "out of memory");
}

void onFlush(png_structp) {}

bool readHeader(Png& state, int bits) {
  state.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state, onError, onWarning);
  if (!state.png) return false;
  if (setjmp(png_jmpbuf(state.png)) != 0) return false;
  state.info = png_create_info_struct(state.png);
  if (!state.info) return false;
  png_set_read_fn(state.png, &state, onRead);
  // Chunks that a height map or texture has no use for are skipped: less to unpack.
  png_set_keep_unknown_chunks(state.png, PNG_HANDLE_CHUNK_NEVER, nullptr, 0);
  png_set_chunk_malloc_max(state.png, 8'000'000);
  png_read_info(state.png, state.info);
  png_set_expand(state.png);
  if (bits == 8) {
    png_set_scale_16(state.png);
  } else {
    png_set_expand_16(state.png);
    if (std::endian::native == std::endian::little) png_set_swap(state.png);
  }
  png_set_interlace_handling(state.png);
  png_read_update_info(state.png, state.info);
  return true;
}

bool readPixels(Png& state, png_bytepp rows) {
  if (setjmp(png_jmpbuf(state.png)) != 0) return false;
  png_read_image(state.png, rows);
  png_read_end(state.png, nullptr);
  return true;
}

template <class Sample>
Image<Sample> decodePng(std::string_view bytes, const std::string& name) {
  Png state;
  state.in = bytes;
  const auto fail = [&] { throw InputError(name + ": not a whole PNG: " + state.message); };
  if (!readHeader(state, 8 * sizeof(Sample))) fail();

  Image<Sample> image;
  image.width = static_cast<int>(png_get_image_width(state.png, state.info));
  image.height = static_cast<int>(png_get_image_height(state.png, state.info));
  image.channels = png_get_channels(state.png, state.info);
  const std::size_t rowBytes = png_get_rowbytes(state.png, state.info);
  assert(rowBytes == static_cast<std::size_t>(image.width) * image.channels * sizeof(Sample));
  // A sample may have been a single bit in the file: 16 times fewer bytes, with palettes 64.
  const double size = 1.0 * image.height * static_cast<double>(rowBytes);
  if (size > 64 * kLargestRatio * static_cast<double>(bytes.size())) {
    throw InputError(name + ": not a whole PNG: " + std::to_string(bytes.size()) +
                     " bytes cannot hold " + std::to_string(image.width) + " x " +
                     std::to_string(image.height) + " pixels");
  }
  requireMemory(size, name + ": decoding this picture", "use a smaller one");
  image.pixels.resize(static_cast<std::size_t>(image.width) * image.height * image.channels);
  std::vector<png_bytep> rows(image.height);
  for (int y = 0; y < image.height; ++y) {
    rows[y] = reinterpret_cast<png_bytep>(image.pixels.data()) + y * rowBytes;
  }
  if (!readPixels(state, rows.data())) fail();
  return image;
}

bool encode(Png& state, int width, int height, int channels, int bits, png_bytepp rows) {
  state.writes = true;
  state.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &state, onError, onWarning);
  if (!state.png) return false;
  if (setjmp(png_jmpbuf(state.png)) != 0) return false;
  state.info = png_create_info_struct(state.png);
  if (!state.info) return false;
  constexpr int kColorTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                 PNG_COLOR_TYPE_RGB_ALPHA};
  png_set_write_fn(state.png, &state, onWrite, onFlush);
  png_set_compression_level(state.png, 6);
  png_set_IHDR(state.png, state.info, width, height, bits, kColorTypes[channels - 1],
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(state.png, state.info);
  if (bits == 16 && std::endian::native == std::endian::little) png_set_swap(state.png);
  png_write_image(state.png, rows);
  png_write_end(state.png, nullptr);
  return true;
}

template <class Sample>
void writePngOf(const std::filesystem::path& path, const Image<Sample>& image) {
  assert(image.channels >= 1 && image.channels <= 4);
  assert(image.pixels.size() ==
         static_cast<std::size_t>(image.width) * image.height * image.channels);
  OutputFile file(path);
  std::vector<png_bytep> rows(image.height);
  for (int y = 0; y < image.height; ++y) {
    // libpng takes rows without const and does not write to them.
    rows[y] = reinterpret_cast<png_bytep>(const_cast<Sample*>(image.at(0, y)));
  }
  Png state;
  if (!encode(state, image.width, image.height, image.channels, 8 * sizeof(Sample), rows.data())) {
    throw InputError(path.string() + ": cannot be written as PNG: " + state.message);
  }
  file.write(state.out);
  file.commit();
}

}  // namespace

Image16 readPng16(const std::filesystem::path& path) {
  return decodePng16(readFile(path), path.string());
}

Image16 decodePng16(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with(kPngSignature)) throw InputError(name + ": not a PNG file");
  return decodePng<std::uint16_t>(bytes, name);
}

Image8 decodeImage(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with(kPngSignature)) return decodePng<std::uint8_t>(bytes, name);
  if (bytes.starts_with(kJpegSignature)) return decodeJpeg(bytes, name);
  throw InputError(name + ": neither a PNG nor a JPEG picture");
}

void writePng(const std::filesystem::path& path, const Image8& image) { writePngOf(path, image); }
void writePng(const std::filesystem::path& path, const Image16& image) { writePngOf(path, image); }

}  // namespace exemplar
