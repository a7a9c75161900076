// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/gif.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"

namespace exemplar {
namespace {

/// What a decoder that knows the standard alone makes of an animation.
struct Decoded {
  int width = 0, height = 0;
  std::vector<std::vector<std::array<std::uint8_t, 3>>> frames;
};

std::vector<int> unpacked(const std::string& blocks, int bits, std::size_t pixels) {
  std::vector<int> out;
  std::vector<std::vector<int>> table;
  const int clear = 1 << bits, end = clear + 1;
  int width = bits + 1, previous = -1;
  std::size_t bit = 0;
  const auto reset = [&] {
    table.assign(static_cast<std::size_t>(end) + 1, {});
    for (int n = 0; n < clear; ++n) table[n] = {n};
    width = bits + 1;
    previous = -1;
  };
  reset();
  while (bit + width <= blocks.size() * 8) {
    int code = 0;
    for (int n = 0; n < width; ++n, ++bit) {
      code |= (static_cast<unsigned char>(blocks[bit / 8]) >> (bit % 8) & 1) << n;
    }
    if (code == end) break;
    if (code == clear) {
      reset();
      continue;
    }
    EXPECT_LE(code, static_cast<int>(table.size()));
    std::vector<int> entry;
    if (code < static_cast<int>(table.size())) {
      entry = table[code];
    } else {
      entry = table[previous];
      entry.push_back(entry.front());
    }
    out.insert(out.end(), entry.begin(), entry.end());
    if (previous >= 0 && table.size() < 4096) {
      std::vector<int> added = table[previous];
      added.push_back(entry.front());
      table.push_back(added);
      if (table.size() == std::size_t{1} << width && width < 12) ++width;
    }
    previous = code;
  }
  EXPECT_EQ(out.size(), pixels);
  return out;
}

Decoded decode(const std::string& gif) {
  std::size_t at = 0;
  const auto byte = [&] { return static_cast<int>(static_cast<unsigned char>(gif.at(at++))); };
  const auto number = [&] {
    const int low = byte();
    return low | byte() << 8;
  };
  EXPECT_EQ(gif.substr(0, 6), "GIF89a");
  at = 6;
  Decoded result;
  result.width = number();
  result.height = number();
  const int flags = byte();
  at += 2;
  std::vector<std::array<std::uint8_t, 3>> palette(std::size_t{2} << (flags & 7));
  for (auto& color : palette) {
    for (auto& c : color) c = static_cast<std::uint8_t>(byte());
  }
  for (int kind = byte(); kind != 0x3b; kind = byte()) {
    if (kind == 0x21) {
      byte();
      for (int size = byte(); size != 0; size = byte()) at += size;
      continue;
    }
    EXPECT_EQ(kind, 0x2c);
    at += 9;
    const int bits = byte();
    std::string blocks;
    for (int size = byte(); size != 0; size = byte()) {
      blocks += gif.substr(at, size);
      at += size;
    }
    auto& frame = result.frames.emplace_back();
    for (const int index :
         unpacked(blocks, bits, static_cast<std::size_t>(result.width) * result.height)) {
      frame.push_back(palette.at(index));
    }
  }
  EXPECT_EQ(at, gif.size());
  return result;
}

Image8 randomImage(int width, int height, int colors, std::uint64_t seed) {
  const Random random(seed, 0x61f);
  Image8 image{width, height, 3, {}};
  for (int n = 0; n < width * height; ++n) {
    // Runs of one color, as pictures have them.
    const std::uint32_t color = random.below(colors, n / (1 + random.below(4, n, 1)));
    for (int c = 0; c < 3; ++c) {
      image.pixels.push_back(static_cast<std::uint8_t>(color * (53 + 31 * c)));
    }
  }
  return image;
}

TEST(Gif, FewColorsComeBackExactly) {
  for (const int colors : {1, 2, 3, 5, 17, 250}) {
    const std::vector<Image8> images{randomImage(61, 47, colors, 1),
                                     randomImage(61, 47, colors, 2)};
    const Decoded decoded = decode(formatGif(images));
    ASSERT_EQ(decoded.frames.size(), 2u);
    EXPECT_EQ(decoded.width, 61);
    for (std::size_t n = 0; n < 2; ++n) {
      for (std::size_t p = 0; p < decoded.frames[n].size(); ++p) {
        for (int c = 0; c < 3; ++c) {
          ASSERT_EQ(decoded.frames[n][p][c], images[n].pixels[3 * p + c]) << colors << " at " << p;
        }
      }
    }
  }
}

TEST(Gif, LargePicturesFillTheTableOfCodes) {
  // More than 4096 codes: the table is reset several times.
  const std::vector<Image8> images{randomImage(400, 300, 200, 3)};
  const Decoded decoded = decode(formatGif(images));
  for (std::size_t p = 0; p < decoded.frames[0].size(); ++p) {
    for (int c = 0; c < 3; ++c) ASSERT_EQ(decoded.frames[0][p][c], images[0].pixels[3 * p + c]);
  }
}

TEST(Gif, ManyColorsComeBackNearly) {
  Image8 ramp{64, 64, 3, {}};
  for (int n = 0; n < 64 * 64; ++n) {
    for (const int c : {4 * (n % 64), 4 * (n / 64), 128}) {
      ramp.pixels.push_back(static_cast<std::uint8_t>(c));
    }
  }
  const Decoded decoded = decode(formatGif({&ramp, 1}));
  double sum[3] = {}, expected[3] = {};
  for (std::size_t p = 0; p < decoded.frames[0].size(); ++p) {
    for (int c = 0; c < 3; ++c) {
      // A level is 51 wide.
      EXPECT_LE(std::abs(decoded.frames[0][p][c] - ramp.pixels[3 * p + c]), 51);
      sum[c] += decoded.frames[0][p][c];
      expected[c] += ramp.pixels[3 * p + c];
    }
  }
  // Dithering keeps the mean, within a sixteenth of a level or so.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / 4096, expected[c] / 4096, 5);
}

TEST(Gif, BadInputIsRefused) {
  EXPECT_THROW(formatGif({}), InputError);
  const std::vector<Image8> images{randomImage(4, 4, 2, 1), randomImage(4, 5, 2, 1)};
  EXPECT_THROW(formatGif(images), InputError);
}

}  // namespace
}  // namespace exemplar
