// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/file.h"
#include "maps/height_map_file.h"
#include "tests/temporary_files.h"

/// Height maps and their files, made for tests.
namespace exemplar::test {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

inline HeightMap makeMap(int width, int height, double cellSize,
                         const std::function<double(double, double)>& f) {
  HeightMap map{Grid<float>(width, height), cellSize};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      map.heights(column, row) =
          static_cast<float>(f(column * cellSize, (height - 1 - row) * cellSize));
  return map;
}

inline double hills(double x, double y) {
  return 3 + 0.6 * std::sin(1.1 * x) + 0.5 * std::cos(0.9 * y + 0.4 * x);
}

/// A grid of 5 x 4 heights 1, 2, ..., with `hole` in place of number 7 (counted from 0).
inline std::string ascGrid(const std::string& keys, const std::string& hole) {
  std::string text = "ncols 5\nnrows 4\ncellsize 10\n" + keys;
  for (int p = 0; p < 20; ++p)
    text += (p == 7 ? hole : std::to_string(p + 1)) + (p % 5 == 4 ? "\n" : " ");
  return text;
}

/// A height map, and what was warned of.
struct Read {
  HeightMap map;
  Warnings warnings;
};
inline Read readWarned(const std::string& name, const std::string& bytes,
                       HeightMapFileOptions options = {}) {
  Read read;
  options.warnings = &read.warnings;
  read.map = readHeightMap(bytes, name, options);
  return read;
}

/// What a .tif says about itself; without a value, nothing.
struct TiffTags {
  std::uint32_t width = 2, height = 2;
  std::uint16_t bits = 16, format = 1, photometric = 1, samples = 1;
  std::string noData;
  std::vector<double> scale, tie;
  std::vector<std::uint16_t> keys, colors;
};

/// An uncompressed .tif in one strip.
inline std::string tiff(const TiffTags& tags, const std::string& data) {
  std::string out = "II*\0", more, entries;
  out.resize(4);
  out[2] = 42;
  int count = 0;
  const auto append = [](std::string& to, auto value) {
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const std::uint32_t dataAt = 8;
  const auto moreAt = static_cast<std::uint32_t>(dataAt + data.size() + data.size() % 2);
  const auto entry = [&](std::uint16_t tag, std::uint16_t type, std::uint32_t n,
                         const std::string& value) {
    append(entries, tag);
    append(entries, type);
    append(entries, n);
    if (value.size() <= 4) {
      entries += value + std::string(4 - value.size(), '\0');
    } else {
      append(entries, static_cast<std::uint32_t>(moreAt + more.size()));
      more += value + std::string(value.size() % 2, '\0');
    }
    ++count;
  };
  const auto number = [&](std::uint16_t tag, std::uint32_t value) {
    std::string bytes;
    append(bytes, value);
    entry(tag, 4, 1, bytes);
  };
  const auto small = [&](std::uint16_t tag, std::uint16_t value) {
    std::string bytes;
    append(bytes, value);
    entry(tag, 3, 1, bytes);
  };
  const auto list = [&](std::uint16_t tag, std::uint16_t type, const auto& values) {
    if (values.empty()) return;
    std::string bytes;
    for (const auto v : values) append(bytes, v);
    entry(tag, type, static_cast<std::uint32_t>(values.size()), bytes);
  };
  number(256, tags.width);
  number(257, tags.height);
  small(258, tags.bits);
  small(259, 1);
  small(262, tags.photometric);
  number(273, dataAt);
  small(277, tags.samples);
  number(278, tags.height);
  number(279, static_cast<std::uint32_t>(data.size()));
  list(320, 3, tags.colors);
  small(339, tags.format);
  list(33550, 12, tags.scale);
  list(33922, 12, tags.tie);
  list(34735, 3, tags.keys);
  if (!tags.noData.empty())
    entry(42113, 2, static_cast<std::uint32_t>(tags.noData.size() + 1), tags.noData + '\0');
  append(out, static_cast<std::uint32_t>(moreAt + more.size()));
  out += data + std::string(data.size() % 2, '\0') + more;
  append(out, static_cast<std::uint16_t>(count));
  return out + entries + std::string(4, '\0');
}

inline std::string wholePgm(int width, int height, bool wide) {
  std::string bytes = "P5\n# a comment\n" + std::to_string(width) + " " + std::to_string(height) +
                      "\n" + (wide ? "65535\n" : "255\n");
  for (int p = 0; p < width * height; ++p) {
    if (wide) bytes += static_cast<char>(p >> 8);
    bytes += static_cast<char>(p & 0xff);
  }
  return bytes;
}

// Reads a file with this content.
inline HeightMap readBytes(const std::string& name, const std::string& bytes,
                           const HeightMapFileOptions& options = {}) {
  static const TemporaryFolder folder;
  writeBytes(folder / name, bytes);
  return readHeightMap(folder / name, options);
}

/// A map with negative heights, fractions, a corner and, with `holes`, cells without data.
inline HeightMap sampleMap(int width, int height, bool whole, bool holes) {
  HeightMap map = makeMap(width, height, 30, [&](double x, double y) {
    const double h = 200 * hills(x / 30, y / 30) - 600;
    return whole ? std::round(h) : h;
  });
  map.cellSizeKnown = true;
  map.corner = MapCorner{500'000.5, -20'000};
  if (holes) map.heights(3, 2) = map.heights(0, 0) = map.heights(width - 1, 4) = kNan;
  return map;
}

inline std::string written(const std::string& name, int width, int height) {
  const TemporaryFolder folder;
  writeHeightMap(folder / name, sampleMap(width, height, false, true));
  return readFile(folder / name);
}

}  // namespace exemplar::test
