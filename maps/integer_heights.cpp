// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Heights as integers: .pgm, .png, .r16, .raw.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "maps/height_formats.h"
#include "maps/height_words.h"
#include "mesh/image.h"

namespace exemplar {
namespace {

constexpr int kLargest = 65535;

/// Integer heights to world units, by what the user or the file beside it says.
void finish(HeightMap& map, const HeightFile& file, int largest) {
  HeightSteps steps{file.options.heightScale.value_or(1), largest};
  const std::optional<HeightSidecar>& sidecar = file.sidecar;
  const bool fits = sidecar && sidecar->width == map.width() && sidecar->height == map.height();
  if (sidecar && !fits) {
    file.warn("the .json beside it is for " + std::to_string(sidecar->width) + " x " +
              std::to_string(sidecar->height) + " points and is not used");
  }
  if (fits) {
    if (sidecar->noData) {
      for (float& h : map.heights.values())
        if (h == static_cast<float>(*sidecar->noData)) h = std::numeric_limits<float>::quiet_NaN();
    }
    if (!file.options.heightScale) {
      steps.size = sidecar->step;
      steps.offset = sidecar->offset;
    }
    map.corner = sidecar->corner;
    map.cellSizeKnown = sidecar->cellSize.has_value();
    if (map.cellSizeKnown) map.cellSize = *sidecar->cellSize;
  }
  for (float& h : map.heights.values())
    h = static_cast<float>(steps.offset + double{h} * steps.size);
  map.steps = steps;
}

/// The bits of a sample in a PNG whose header has been found sound. The depth of a palette's
/// indices says nothing about its colors, which have 8.
int pngDepth(std::string_view bytes) {
  constexpr std::size_t kDepth = 24, kColorType = 25;
  constexpr char kPalette = 3;
  return bytes[kColorType] == kPalette ? 8 : bytes[kDepth];
}

/// The integer that a height is nearest to.
double stepsOf(double height, const HeightSteps& steps) {
  return std::round((height - steps.offset) / steps.size);
}

bool holds(const HeightSteps& steps, const HeightRange& range, int most) {
  return stepsOf(range.low, steps) >= 0 && stepsOf(range.high, steps) <= most;
}

/// Steps that hold the heights: whole numbers as they are, or of a power of two, so that what they
/// stand for has few digits and is the same after any number of times.
HeightSteps chosenSteps(const HeightMap& map, const HeightRange& range, int most) {
  HeightSteps steps;
  const auto isWhole = [](float h) { return std::isnan(h) || h == std::floor(h); };
  if (range.relief() == 0) {
    if (!(isWhole(range.low) && holds(steps, range, most))) steps.offset = range.low;
    return steps;
  }
  if (range.relief() <= most && std::ranges::all_of(map.heights.values(), isWhole)) {
    if (!holds(steps, range, most)) steps.offset = range.low;
    return steps;
  }
  steps.size = std::exp2(std::ceil(std::log2(range.relief() / (most - 1))));
  steps.offset = std::floor(range.low / steps.size) * steps.size;
  return steps;
}

/// What the integers of a file stand for, and warnings about what they lose.
HeightSteps stepsFor(const std::string& name, const HeightMap& map, const HeightRange& range,
                     int most, const HeightMapFileOptions& options) {
  const HeightSteps own = map.steps.value_or(HeightSteps{});
  // Finer where they came from a file of fewer bits.
  HeightSteps steps{options.heightScale.value_or(own.size) * own.largest / kLargest, kLargest,
                    own.offset};
  if (!options.heightScale && !map.steps) return chosenSteps(map, range, most);
  if (!holds(steps, range, most)) {
    // The same steps from another height, which the lowest one has room above.
    HeightSteps moved = steps;
    moved.offset += std::floor((range.low - steps.offset) / steps.size) * steps.size;
    if (options.heightScale) {
      if (range.low < steps.offset || holds(moved, range, most)) steps = moved;
    } else if (holds(moved, range, most)) {
      return moved;
    } else {
      warn(options.warnings, name + ": steps of " + roundedNumber(steps.size) +
                                 ", the example's, do not reach from its lowest to its highest "
                                 "height; larger ones are used");
      return chosenSteps(map, range, most);
    }
  }
  if (options.heightScale && !map.steps && range.relief() > 0 &&
      range.relief() < 255 * steps.size) {
    warn(options.warnings, name + ": its heights span only " +
                               roundedNumber(range.relief() / steps.size) + " steps of " +
                               roundedNumber(steps.size) +
                               "; set a smaller `height-scale` or write .asc, .tif or .exr");
  }
  return steps;
}

std::string lowByteFirst(const std::vector<std::uint16_t>& integers) {
  std::string out;
  out.reserve(2 * integers.size());
  for (const std::uint16_t h : integers) {
    out += static_cast<char>(h & 0xff);
    out += static_cast<char>(h >> 8);
  }
  return out;
}

}  // namespace

HeightMap readPgm(const HeightFile& source) {
  Words words(source, true);
  const std::string_view magic = words.next();
  if (magic != "P2" && magic != "P5") words.fail("is no .pgm file: it must begin with P2 or P5");
  // Binary samples follow the header's bytes as they are, whatever a text would be decoded to.
  if (magic == "P5" && source.bytes.find("P5") == std::string_view::npos)
    words.fail("is no .pgm file: a binary one is not text in UTF-16");
  constexpr int kLongest = 1 << 24;
  const int width = words.number("the width", 1, kLongest);
  const int height = words.number("the height", 1, kLongest);
  const int largest = words.number("the largest value", 1, 65535);
  // Each point takes a byte at least: a header that claims more than the file holds is refused
  // before any memory is taken for it.
  const std::size_t left = words.bytesLeft();
  const std::size_t count = static_cast<std::size_t>(width) * height;
  const std::size_t size = magic == "P5" && largest > 255 ? 2 : 1;
  if (left < count * size || (magic == "P5" && left < count * size + 1))
    source.fail("the file ends early: " + std::to_string(width) + " x " + std::to_string(height) +
                " points need " + std::to_string(count * size) + " bytes and " +
                std::to_string(left ? left - 1 : 0) + " are there");
  HeightMap map = source.allocate(width, height);
  if (magic == "P2") {
    for (float& h : map.heights.values())
      h = static_cast<float>(words.number("a height", 0, largest));
  } else {
    const std::string_view tail = source.bytes.substr(source.bytes.size() - left + 1);
    const auto* data = reinterpret_cast<const unsigned char*>(tail.data());
    for (std::size_t p = 0; p < count; ++p) {
      const int h = size == 2 ? data[2 * p] << 8 | data[2 * p + 1] : data[p];
      if (h > largest)
        source.fail("a height is " + std::to_string(h) + ", above the file's largest value " +
                    std::to_string(largest));
      map.heights[p] = static_cast<float>(h);
    }
  }
  finish(map, source, largest);
  return map;
}

HeightMap readPngHeights(const HeightFile& file) {
  const Image16 image = decodePng16(file.bytes, file.name);
  // Samples of fewer bits come spread over 16; their own steps are what the file counts in.
  int largest = (1 << pngDepth(file.bytes)) - 1;
  HeightMap map = file.allocate(image.width, image.height);
  const int alpha = image.channels % 2 == 0 ? image.channels - 1 : -1;
  bool spread = largest == kLargest;  // 8 bits in a file of 16
  std::uint16_t highest = 0;
  for (int row = 0; row < map.height(); ++row) {
    file.progress.check();
    for (int column = 0; column < map.width(); ++column) {
      const std::uint16_t* p = image.at(column, row);
      if (alpha >= 0 && p[alpha] == 0) continue;
      if (image.channels >= 3 && (p[0] != p[1] || p[0] != p[2]))
        file.fail("is a color picture; a height map must be gray");
      map.heights(column, row) = static_cast<float>(std::lround(p[0] * (largest / 65535.0)));
      spread = spread && p[0] % 257 == 0;
      highest = std::max(highest, p[0]);
    }
  }
  if (spread && highest > 257) {
    file.warn(
        "its 16 bits hold 8-bit heights, at most 256 different ones, which makes terraces on "
        "slopes; save it from where it was made");
  }
  finish(map, file, largest);
  return map;
}

HeightMap readRaw(const HeightFile& file) {
  const bool floats = file.sidecar && file.sidecar->floats && lowerExtension(file.name) == ".raw";
  const std::size_t bytes = floats ? 4 : 2, count = file.bytes.size() / bytes;
  double width = std::floor(std::sqrt(static_cast<double>(count))), height = width;
  const bool said = file.sidecar && file.sidecar->width > 0;
  if (said) {
    width = file.sidecar->width;
    height = file.sidecar->height;
  }
  if (file.bytes.size() % bytes != 0 || width * height != static_cast<double>(count)) {
    file.fail(std::to_string(file.bytes.size()) + " bytes are no " +
              (said ? exactNumber(width) + " x " + exactNumber(height) +
                          (floats ? " floats" : " integers") + ", as the .json beside it says"
                    : "square of 16-bit integers, and no .json beside it says its size: write one "
                      "with \"kind\": \"exemplar height map\", \"width\" and \"height\""));
  }
  HeightMap map = file.allocate(width, height);
  const auto* data = reinterpret_cast<const unsigned char*>(file.bytes.data());
  for (std::size_t p = 0; p < count; ++p) {
    std::uint32_t bits = 0;
    for (std::size_t b = 0; b < bytes; ++b) bits |= std::uint32_t{data[bytes * p + b]} << (8 * b);
    map.heights[p] = floats ? std::bit_cast<float>(bits) : static_cast<float>(bits);
    if (floats && std::isinf(map.heights[p])) file.fail("holds an infinite height");
  }
  finish(map, file, kLargest);
  if (floats) map.steps.reset();
  return map;
}

void writeIntegers(const std::filesystem::path& path, const HeightMap& map,
                   const HeightMapFileOptions& options, const Progress& progress) {
  const std::string name = path.string(), ending = lowerExtension(path);
  requireSidecarPlace(path);
  const HeightRange range = rangeOf(map.heights).value_or(HeightRange{0, 0, map.heights.count()});
  // A picture's holes are transparent; elsewhere an integer stands for them.
  const bool marks = range.holes > 0 && ending != ".png";
  const int most = marks ? kLargest - 1 : kLargest;
  const HeightSteps steps = stepsFor(name, map, range, most, options);
  const int channels = range.holes > 0 && !marks ? 2 : 1;
  std::vector<std::uint16_t> integers;
  integers.reserve(map.heights.count() * static_cast<std::size_t>(channels));
  std::size_t clamped = 0;
  for (const float h : map.heights.values()) {
    const bool hole = std::isnan(h);
    const double value = hole ? (marks ? kLargest : 0) : stepsOf(h, steps);
    if (!hole) clamped += value < 0 || value > most;
    integers.push_back(
        static_cast<std::uint16_t>(hole ? value : std::clamp(value, 0.0, 1.0 * most)));
    if (channels == 2) integers.push_back(hole ? 0 : 65535);
  }
  if (clamped > 0) {
    warn(options.warnings,
         name + ": " + std::to_string(clamped) + " of " + std::to_string(map.heights.count()) +
             " heights are outside of " + roundedNumber(steps.offset) + " to " +
             roundedNumber(steps.offset + most * steps.size) + ", what 16-bit steps of " +
             roundedNumber(steps.size) +
             " hold, and are clamped; set a larger `height-scale` or write .asc, .tif or .exr");
  }
  if (ending == ".png") {
    writePng(path, Image16{map.width(), map.height(), channels, std::move(integers)});
  } else if (ending == ".r16" || ending == ".raw") {
    writeFile(path, lowByteFirst(integers), progress.part(0.5, 1));
  } else {
    std::string out =
        "P5\n" + std::to_string(map.width()) + " " + std::to_string(map.height()) + "\n65535\n";
    for (const std::uint16_t h : integers) {
      out += static_cast<char>(h >> 8);
      out += static_cast<char>(h & 0xff);
    }
    writeFile(path, out, progress.part(0.5, 1));
  }
  HeightSidecar sidecar{map.width(), map.height(), {}, map.corner, steps.size, steps.offset, {}};
  if (map.cellSizeKnown) sidecar.cellSize = map.cellSize;
  if (marks) sidecar.noData = kLargest;
  writeSidecar(path, sidecar, options.warnings);
}

}  // namespace exemplar
