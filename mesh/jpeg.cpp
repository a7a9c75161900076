// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/jpeg.h"

// jpeglib.h needs size_t and FILE declared before it.
#include <cstdio>
// clang-format off
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#include <csetjmp>
#include <cstdlib>
#include <new>

#include "core/error.h"
#include "core/memory.h"

namespace exemplar {
namespace {

/// A progressive file may hold any number of scans over the whole picture, each a few bytes long:
/// no real one has more than a dozen.
constexpr int kMostScans = 100;

/// One byte of a JPEG file decodes to fewer bytes than this: ten blocks of 64 samples, which may
/// cover 1,536 bytes of picture, take at least ten bits; the rest is room for arithmetic coding.
constexpr double kLargestRatio = 8192;

struct Decoder {
  jpeg_decompress_struct info{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr progress{};
  std::jmp_buf escape;
  char message[JMSG_LENGTH_MAX] = "";
};

[[noreturn]] void onError(j_common_ptr info) {
  Decoder* decoder = static_cast<Decoder*>(info->client_data);
  info->err->format_message(info, decoder->message);
  std::longjmp(decoder->escape, 1);
}

void onMessage(j_common_ptr info, int level) {
  // Warnings are survivable damage, and common; a missing end is not.
  const int code = info->err->msg_code;
  if (level < 0 && (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER)) onError(info);
}

void onProgress(j_common_ptr info) {
  Decoder* decoder = static_cast<Decoder*>(info->client_data);
  if (decoder->info.input_scan_number > kMostScans) {
    std::snprintf(decoder->message, sizeof decoder->message, "more than %d scans", kMostScans);
    std::longjmp(decoder->escape, 1);
  }
}

/// The three steps of reading each keep to plain data between `setjmp` and a possible `longjmp`.
bool start(Decoder& decoder, std::string_view bytes) {
  if (setjmp(decoder.escape) != 0) return false;
  jpeg_create_decompress(&decoder.info);
  decoder.info.client_data = &decoder;
  decoder.progress.progress_monitor = onProgress;
  decoder.info.progress = &decoder.progress;
  jpeg_mem_src(&decoder.info, reinterpret_cast<const unsigned char*>(bytes.data()),
               static_cast<unsigned long>(bytes.size()));
  jpeg_read_header(&decoder.info, TRUE);
  if (decoder.info.jpeg_color_space == JCS_GRAYSCALE) {
    decoder.info.out_color_space = JCS_GRAYSCALE;
  } else if (decoder.info.num_components == 3) {
    decoder.info.out_color_space = JCS_RGB;
  } else {
    std::snprintf(decoder.message, sizeof decoder.message,
                  "a JPEG with %d components; save it as RGB or gray", decoder.info.num_components);
    return false;
  }
  jpeg_calc_output_dimensions(&decoder.info);
  return true;
}

bool decode(Decoder& decoder, unsigned char* pixels, std::size_t rowBytes) {
  if (setjmp(decoder.escape) != 0) return false;
  jpeg_start_decompress(&decoder.info);
  while (decoder.info.output_scanline < decoder.info.output_height) {
    unsigned char* row = pixels + decoder.info.output_scanline * rowBytes;
    jpeg_read_scanlines(&decoder.info, &row, 1);
  }
  jpeg_finish_decompress(&decoder.info);
  return true;
}

}  // namespace

Image8 decodeJpeg(std::string_view bytes, const std::string& name) {
  struct Owner {
    Decoder decoder;
    ~Owner() { jpeg_destroy_decompress(&decoder.info); }
  } owner;
  Decoder& decoder = owner.decoder;
  decoder.info.err = jpeg_std_error(&decoder.errors);
  decoder.info.client_data = &decoder;
  decoder.errors.error_exit = onError;
  decoder.errors.emit_message = onMessage;
  const auto fail = [&] { throw InputError(name + ": not a whole JPEG: " + decoder.message); };
  if (!start(decoder, bytes)) fail();

  Image8 image;
  image.width = static_cast<int>(decoder.info.output_width);
  image.height = static_cast<int>(decoder.info.output_height);
  image.channels = decoder.info.out_color_space == JCS_GRAYSCALE ? 1 : 3;
  const double size = 1.0 * image.width * image.height * image.channels;
  if (size > kLargestRatio * static_cast<double>(bytes.size())) {
    throw InputError(name + ": not a whole JPEG: " + std::to_string(bytes.size()) +
                     " bytes cannot hold " + std::to_string(image.width) + " x " +
                     std::to_string(image.height) + " pixels");
  }
  // A progressive file keeps its coefficients beside the pixels, two bytes each.
  requireMemory(3 * size, name + ": decoding this picture", "use a smaller one");
  const std::size_t rowBytes = static_cast<std::size_t>(image.width) * image.channels;
  image.pixels.resize(rowBytes * image.height);
  if (!decode(decoder, image.pixels.data(), rowBytes)) fail();
  return image;
}

std::string encodeJpeg(const Image8& image, int quality) {
  const bool gray = image.channels == 1;
  if (image.width < 1 || image.height < 1 || image.width > JPEG_MAX_DIMENSION ||
      image.height > JPEG_MAX_DIMENSION || (!gray && image.channels != 3)) {
    throw InputError("a picture of " + std::to_string(image.width) + " x " +
                     std::to_string(image.height) + " pixels and " +
                     std::to_string(image.channels) + " channels cannot be a JPEG");
  }
  struct Encoder {
    jpeg_compress_struct info{};
    jpeg_error_mgr errors{};
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    ~Encoder() {
      jpeg_destroy_compress(&info);
      std::free(bytes);
    }
  } encoder;
  encoder.info.err = jpeg_std_error(&encoder.errors);
  // What could fail has been looked at above; what is left is a want of memory.
  encoder.errors.error_exit = [](j_common_ptr) { throw std::bad_alloc(); };
  jpeg_create_compress(&encoder.info);
  jpeg_mem_dest(&encoder.info, &encoder.bytes, &encoder.size);
  encoder.info.image_width = static_cast<JDIMENSION>(image.width);
  encoder.info.image_height = static_cast<JDIMENSION>(image.height);
  encoder.info.input_components = image.channels;
  encoder.info.in_color_space = gray ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&encoder.info);
  jpeg_set_quality(&encoder.info, quality, TRUE);
  encoder.info.comp_info[0].h_samp_factor = encoder.info.comp_info[0].v_samp_factor = 1;
  jpeg_start_compress(&encoder.info, TRUE);
  while (encoder.info.next_scanline < encoder.info.image_height) {
    // libjpeg only reads the row.
    auto* row =
        const_cast<unsigned char*>(image.at(0, static_cast<int>(encoder.info.next_scanline)));
    jpeg_write_scanlines(&encoder.info, &row, 1);
  }
  jpeg_finish_compress(&encoder.info);
  return {reinterpret_cast<const char*>(encoder.bytes), encoder.size};
}

}  // namespace exemplar
