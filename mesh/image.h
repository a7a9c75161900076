// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace exemplar {

/// Pixels in rows from the top, channels interleaved: `(y * width + x) * channels + c`.
/// `Sample` is `std::uint8_t` (sRGB where it is color) or `std::uint16_t` (linear, as heights).
template <class Sample>
struct Image {
  int width = 0, height = 0;
  int channels = 0;  ///< 1 gray, 2 gray and alpha, 3 RGB, 4 RGBA
  std::vector<Sample> pixels;

  const Sample* at(int x, int y) const {
    return &pixels[(static_cast<std::size_t>(y) * width + x) * channels];
  }
  Sample* at(int x, int y) { return &pixels[(static_cast<std::size_t>(y) * width + x) * channels]; }
};

using Image8 = Image<std::uint8_t>;
using Image16 = Image<std::uint16_t>;

/// A `.png` of any depth, as 16 bits: 8-bit samples are spread over the whole range (x 257).
/// Throws `InputError` for anything that is not a whole PNG file or would not fit in memory.
Image16 readPng16(const std::filesystem::path& path);

/// The same from the bytes of a `.png`; `name` is what errors call it.
Image16 decodePng16(std::string_view bytes, const std::string& name);

/// A PNG or JPEG in memory (a texture), as 8 bits. `name` is what errors call it.
Image8 decodeImage(std::string_view bytes, const std::string& name);

/// Writes a `.png`, whole or not at all (`OutputFile`). The same pixels give the same bytes.
void writePng(const std::filesystem::path& path, const Image8& image);
void writePng(const std::filesystem::path& path, const Image16& image);

}  // namespace exemplar
