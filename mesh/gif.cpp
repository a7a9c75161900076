// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/gif.h"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>
#include <vector>

#include "core/error.h"
#include "core/file.h"

namespace exemplar {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

constexpr int kLevels[3] = {6, 7, 6};

/// The thresholds of ordered dithering (Bayer 1973), 0..15.
constexpr int kDither[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};

void appendShort(std::string& out, int value) {
  out += static_cast<char>(value & 255);
  out += static_cast<char>(value >> 8 & 255);
}

Rgb colorAt(const Image8& image, int x, int y) {
  const std::uint8_t* p = image.at(x, y);
  return image.channels < 3 ? Rgb{p[0], p[0], p[0]} : Rgb{p[0], p[1], p[2]};
}

/// The pictures as indices into one palette.
struct Indexed {
  std::vector<Rgb> palette;
  std::vector<std::vector<std::uint8_t>> pictures;
};

Indexed indexed(std::span<const Image8> pictures) {
  Indexed result;
  std::map<Rgb, std::uint8_t> known;
  bool exact = true;
  for (const Image8& image : pictures) {
    std::vector<std::uint8_t>& indices = result.pictures.emplace_back();
    for (int y = 0; y < image.height && exact; ++y) {
      for (int x = 0; x < image.width && exact; ++x) {
        const Rgb color = colorAt(image, x, y);
        const auto found = known.find(color);
        if (found != known.end()) {
          indices.push_back(found->second);
        } else if (known.size() < 256) {
          indices.push_back(static_cast<std::uint8_t>(known.size()));
          known.emplace(color, indices.back());
          result.palette.push_back(color);
        } else {
          exact = false;
        }
      }
    }
  }
  if (exact) return result;
  result = {};
  for (int n = 0; n < kLevels[0] * kLevels[1] * kLevels[2]; ++n) {
    const int level[3] = {n / (kLevels[1] * kLevels[2]), n / kLevels[2] % kLevels[1],
                          n % kLevels[2]};
    Rgb color;
    for (int c = 0; c < 3; ++c) {
      color[c] = static_cast<std::uint8_t>(255 * level[c] / (kLevels[c] - 1));
    }
    result.palette.push_back(color);
  }
  for (const Image8& image : pictures) {
    std::vector<std::uint8_t>& indices = result.pictures.emplace_back();
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const Rgb color = colorAt(image, x, y);
        int index = 0;
        for (int c = 0; c < 3; ++c) {
          // A whole level and sixteenths of one; the threshold decides about the next.
          const int sixteenths = color[c] * (kLevels[c] - 1) * 16 / 255;
          const int level = (sixteenths + kDither[y & 3][x & 3]) / 16;
          index = index * kLevels[c] + std::min(level, kLevels[c] - 1);
        }
        indices.push_back(static_cast<std::uint8_t>(index));
      }
    }
  }
  return result;
}

/// Variable-length-code LZW, as GIF has it: codes from the least significant bit on.
class Lzw {
 public:
  Lzw(std::string& out, int bits) : out_(out), bits_(bits) {
    out_ += static_cast<char>(bits_);
    reset();
  }

  void encode(const std::vector<std::uint8_t>& indices) {
    put(1 << bits_);
    std::uint32_t prefix = indices.front();
    for (std::size_t n = 1; n < indices.size(); ++n) {
      const std::uint32_t key = prefix << 8 | indices[n];
      const auto found = codes_.find(key);
      if (found != codes_.end()) {
        prefix = found->second;
        continue;
      }
      put(prefix);
      if (next_ < 4096) {
        codes_.emplace(key, next_);
        if (next_ == 1u << width_ && width_ < 12) ++width_;
        ++next_;
      } else {
        put(1 << bits_);
        reset();
      }
      prefix = indices[n];
    }
    put(prefix);
    put((1 << bits_) + 1);
    if (filled_ > 0) block_ += static_cast<char>(buffer_ & 255);
    flush();
    out_ += '\0';
  }

 private:
  void reset() {
    codes_.clear();
    next_ = (1u << bits_) + 2;
    width_ = bits_ + 1;
  }
  void put(std::uint32_t code) {
    buffer_ |= code << filled_;
    filled_ += width_;
    while (filled_ >= 8) {
      block_ += static_cast<char>(buffer_ & 255);
      buffer_ >>= 8;
      filled_ -= 8;
      if (block_.size() == 255) flush();
    }
  }
  void flush() {
    if (block_.empty()) return;
    out_ += static_cast<char>(block_.size());
    out_ += block_;
    block_.clear();
  }

  std::string& out_;
  std::string block_;
  int bits_, width_ = 0, filled_ = 0;
  std::uint32_t buffer_ = 0, next_ = 0;
  std::unordered_map<std::uint32_t, std::uint32_t> codes_;
};

}  // namespace

std::string formatGif(std::span<const Image8> pictures, int centiseconds) {
  if (pictures.empty()) throw InputError("an animation needs a picture");
  const int width = pictures[0].width, height = pictures[0].height;
  for (const Image8& image : pictures) {
    if (image.width != width || image.height != height) {
      throw InputError("the pictures of an animation should be of one size");
    }
  }
  if (width < 1 || height < 1 || width > 65535 || height > 65535) {
    throw InputError("the sides of a .gif should be 1 to 65535 pixels");
  }
  const Indexed image = indexed(pictures);
  int bits = 2;
  while (static_cast<std::size_t>(1) << bits < image.palette.size()) ++bits;
  std::string out = "GIF89a";
  appendShort(out, width);
  appendShort(out, height);
  out += static_cast<char>(0x80 | 7 << 4 | (bits - 1));
  out.append(2, '\0');
  for (std::size_t n = 0; n < std::size_t{1} << bits; ++n) {
    const Rgb color = n < image.palette.size() ? image.palette[n] : Rgb{};
    for (const std::uint8_t c : color) out += static_cast<char>(c);
  }
  out.append("\x21\xff\x0bNETSCAPE2.0\x03\x01\0\0\0", 19);
  for (const auto& indices : image.pictures) {
    out.append("\x21\xf9\x04\x04", 4);
    appendShort(out, std::clamp(centiseconds, 2, 65535));
    out.append(2, '\0');
    out += '\x2c';
    out.append(4, '\0');
    appendShort(out, width);
    appendShort(out, height);
    out += '\0';
    Lzw(out, bits).encode(indices);
  }
  return out + '\x3b';
}

void writeGif(const std::filesystem::path& path, std::span<const Image8> pictures,
              int centiseconds) {
  writeFile(path, formatGif(pictures, centiseconds));
}

}  // namespace exemplar
