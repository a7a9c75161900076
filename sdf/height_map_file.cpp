// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/file.h"
#include "core/memory.h"
#include "mesh/image.h"
#include "sdf/height_map.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

// A map without a cell size of its own is this many reliefs wide.
constexpr double kSidePerRelief = 5;
// Heights are stored as float, and squares of them must not overflow.
constexpr double kLargestHeight = 1e15;

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what);
}
[[noreturn]] void fail(const fs::path& path, int line, const std::string& what) {
  throw InputError(path.string() + ":" + std::to_string(line) + ": " + what);
}

void checkOptions(const HeightMapFileOptions& options) {
  const auto check = [](double value, const char* name) {
    if (!(value > 0 && value < std::numeric_limits<double>::infinity()))
      throw InputError(std::string(name) + " is " + std::to_string(value) + "; it must be > 0");
  };
  if (options.cellSize) check(*options.cellSize, "cellSize");
  check(options.heightScale, "heightScale");
}

// Words of a text, with the line that they stand on; with comments from '#' to the line's end.
class Words {
 public:
  Words(std::string_view text, const fs::path& path) : text_(text), path_(path) {}

  /// The next word; empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && (blank(text_[at_]) || text_[at_] == '#')) {
      if (text_[at_] == '#') {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      } else {
        line_ += text_[at_++] == '\n';
      }
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && !blank(text_[at_]) && text_[at_] != '#') ++at_;
    return text_.substr(begin, at_ - begin);
  }
  /// The next word as a number from `low` to `high`; `what` is what errors call it.
  template <class Number>
  Number number(const std::string& what, Number low, Number high) {
    const std::string_view word = next();
    if (word.empty()) fail(path_, line_, "the file ends before " + what);
    return parse<Number>(word, what, low, high);
  }
  template <class Number>
  Number parse(std::string_view word, const std::string& what, Number low, Number high) {
    Number value{};
    const char* begin = word.data() + (word.size() > 1 && word[0] == '+' ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() ||
        !(value >= low && value <= high))
      fail(path_, line_,
           what + " is \"" + std::string(word.substr(0, 40)) + "\"; it must be a number from " +
               text(low) + " to " + text(high));
    return value;
  }
  std::size_t offset() const { return at_; }
  int line() const { return line_; }

 private:
  static bool blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  template <class Number>
  static std::string text(Number value) {
    char buffer[64];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
  }

  std::string_view text_;
  const fs::path& path_;
  std::size_t at_ = 0;
  int line_ = 1;
};

void allocate(HeightMap& map, int width, int height, const fs::path& path) {
  if (width < 2 || height < 2)
    fail(path, "is " + std::to_string(width) + " x " + std::to_string(height) +
                   " points; a height map needs at least 2 x 2");
  requireMemory(8.0 * width * height, path.string() + ": its heights", "use a smaller height map");
  map.width = width;
  map.height = height;
  map.heights.resize(static_cast<std::size_t>(width) * height);
}

// Integer heights to world units.
void finish(HeightMap& map, const HeightMapFileOptions& options) {
  for (float& h : map.heights) h = static_cast<float>(h * options.heightScale);
  const auto [low, high] = std::minmax_element(map.heights.begin(), map.heights.end());
  const double relief = double{*high} - *low;
  const double side = std::max(map.width, map.height) - 1;
  map.cellSize = options.cellSize ? *options.cellSize
                 : relief > 0     ? kSidePerRelief * relief / side
                                  : 1;
}

HeightMap readPgm(const fs::path& path, const HeightMapFileOptions& options) {
  const std::string bytes = readFile(path);
  Words words(bytes, path);
  const std::string_view magic = words.next();
  if (magic != "P2" && magic != "P5") fail(path, 1, "is no .pgm file: it must begin with P2 or P5");
  constexpr int kLongest = 1 << 24;
  const int width = words.number("the width", 1, kLongest);
  const int height = words.number("the height", 1, kLongest);
  const int largest = words.number("the largest value", 1, 65535);
  // Each point takes a byte at least: a header that claims more than the file holds is refused
  // before any memory is taken for it.
  const std::size_t left = bytes.size() - words.offset();
  const std::size_t count = static_cast<std::size_t>(width) * height;
  const std::size_t size = magic == "P5" && largest > 255 ? 2 : 1;
  if (left < count * size || (magic == "P5" && left < count * size + 1))
    fail(path, "the file ends early: " + std::to_string(width) + " x " + std::to_string(height) +
                   " points need " + std::to_string(count * size) + " bytes and " +
                   std::to_string(left ? left - 1 : 0) + " are there");
  HeightMap map;
  allocate(map, width, height, path);
  if (magic == "P2") {
    for (float& h : map.heights) h = static_cast<float>(words.number("a height", 0, largest));
  } else {
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data()) + words.offset() + 1;
    for (std::size_t p = 0; p < count; ++p) {
      const int h = size == 2 ? data[2 * p] << 8 | data[2 * p + 1] : data[p];
      if (h > largest)
        fail(path, "a height is " + std::to_string(h) + ", above the file's largest value " +
                       std::to_string(largest));
      map.heights[p] = static_cast<float>(h);
    }
  }
  finish(map, options);
  return map;
}

HeightMap readPng(const fs::path& path, const HeightMapFileOptions& options) {
  const Image16 image = readPng16(path);
  // Samples of fewer bits come spread over 16; their own steps are what the file counts in. The
  // depth stands in the header, which has been found sound.
  const std::string bytes = readFile(path);
  const int depth = bytes.size() > 24 ? bytes[24] : 16;
  const int steps = depth >= 1 && depth < 16 ? (1 << depth) - 1 : 65535;
  HeightMap map;
  allocate(map, image.width, image.height, path);
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column) {
      const std::uint16_t* p = image.at(column, row);
      if (image.channels >= 3 && (p[0] != p[1] || p[0] != p[2]))
        fail(path, "is a colour picture; a height map must be grey");
      map.heights[static_cast<std::size_t>(row) * map.width + column] =
          static_cast<float>(std::lround(p[0] * (steps / 65535.0)));
    }
  finish(map, options);
  return map;
}

// Cells without data get the mean of their neighbours that have it, ring by ring from the border.
void fillHoles(HeightMap& map, std::vector<char>& known) {
  std::vector<int> open;
  for (int p = 0; p < static_cast<int>(known.size()); ++p)
    if (!known[p]) open.push_back(p);
  while (!open.empty()) {
    std::vector<std::pair<int, float>> filled;
    std::vector<int> left;
    for (const int p : open) {
      const int column = p % map.width, row = p / map.width;
      double sum = 0;
      int count = 0;
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, map.height - 1); ++r)
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, map.width - 1); ++c)
          if (known[static_cast<std::size_t>(r) * map.width + c]) {
            sum += map.at(c, r);
            ++count;
          }
      if (count > 0) {
        filled.emplace_back(p, static_cast<float>(sum / count));
      } else {
        left.push_back(p);
      }
    }
    for (const auto& [p, h] : filled) {
      map.heights[p] = h;
      known[p] = 1;
    }
    open = std::move(left);
  }
}

std::string lower(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

HeightMap readAsc(const fs::path& path) {
  const std::string bytes = readFile(path);
  Words words(bytes, path);
  std::optional<int> columns, rows;
  std::optional<double> cellSize, noData;
  std::string_view word = words.next();
  const double infinity = std::numeric_limits<double>::infinity();
  for (; !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])); word = words.next()) {
    const std::string key = lower(word);
    if (key == "nan" || key == "inf" || key == "infinity") break;  // a value, found wanting below
    if (key == "ncols") {
      columns = words.number("ncols", 1, 1 << 24);
    } else if (key == "nrows") {
      rows = words.number("nrows", 1, 1 << 24);
    } else if (key == "cellsize" || key == "dx" || key == "dy") {
      const double size = words.number(key, std::numeric_limits<double>::min(), kLargestHeight);
      if (cellSize && std::abs(size - *cellSize) > 1e-6 * size)
        fail(path, words.line(), "dx and dy differ; the cells must be square");
      cellSize = size;
    } else if (key == "xllcorner" || key == "yllcorner" || key == "xllcenter" ||
               key == "yllcenter") {
      words.number(key, -infinity, infinity);
    } else if (key == "nodata_value") {
      const std::string value = lower(words.next());
      noData = value == "nan" || value == "-nan" ? std::numeric_limits<double>::quiet_NaN()
                                                 : words.parse(value, key, -infinity, infinity);
    } else {
      fail(path, words.line(),
           "\"" + std::string(word.substr(0, 40)) +
               "\" is no key of an ESRI grid: ncols, nrows, "
               "xllcorner, yllcorner, cellsize, nodata_value");
    }
  }
  if (!columns || !rows || !cellSize)
    fail(path, words.line(),
         std::string("is no ESRI grid: ") +
             (!columns ? "ncols"
              : !rows  ? "nrows"
                       : "cellsize") +
             " is missing");
  const std::size_t count = static_cast<std::size_t>(*columns) * *rows;
  if (bytes.size() / 2 + 1 < count)  // a digit and a blank each
    fail(path, "the file ends early: it is too short for " + std::to_string(*columns) + " x " +
                   std::to_string(*rows) + " heights");
  HeightMap map;
  allocate(map, *columns, *rows, path);
  map.cellSize = *cellSize;
  std::vector<char> known(count, 1);
  bool any = false;
  for (std::size_t p = 0; p < count; ++p, word = words.next()) {
    if (word.empty())
      fail(
          path, words.line(),
          "the file ends after " + std::to_string(p) + " of " + std::to_string(count) + " heights");
    const bool nan = lower(word) == "nan" || lower(word) == "-nan";
    if (nan && noData && std::isnan(*noData)) {
      known[p] = 0;
      continue;
    }
    const double h = words.parse(word, "a height", -infinity, infinity);
    if (noData && h == *noData) {
      known[p] = 0;
      continue;
    }
    if (!(std::abs(h) <= kLargestHeight))
      fail(
          path, words.line(),
          "a height is \"" + std::string(word.substr(0, 40)) + "\"; it must be below 1e15 in size");
    map.heights[p] = static_cast<float>(h);
    any = true;
  }
  if (!word.empty())
    fail(path, words.line(),
         "has more than " + std::to_string(*columns) + " x " + std::to_string(*rows) + " heights");
  if (!any) fail(path, "holds no heights: every cell is NODATA");
  fillHoles(map, known);
  return map;
}

std::vector<std::uint16_t> steps(const HeightMap& map, double heightScale) {
  std::vector<std::uint16_t> result(map.heights.size());
  for (std::size_t p = 0; p < result.size(); ++p) {
    result[p] = static_cast<std::uint16_t>(
        std::lround(std::clamp(map.heights[p] / heightScale, 0.0, 65535.0)));
  }
  return result;
}

template <class Number>
void appendNumber(std::string& out, Number value) {
  char buffer[64];
  out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

std::string ascText(const HeightMap& map) {
  std::string out = "ncols " + std::to_string(map.width) + "\nnrows " + std::to_string(map.height) +
                    "\nxllcorner 0\nyllcorner 0\ncellsize ";
  appendNumber(out, map.cellSize);
  out += '\n';
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column) {
      appendNumber(out, map.at(column, row));
      out += column + 1 < map.width ? ' ' : '\n';
    }
  return out;
}

}  // namespace

bool isHeightMapFile(const fs::path& path) {
  const std::string ending = lowerExtension(path);
  return ending == ".png" || ending == ".pgm" || ending == ".asc";
}

HeightMap readHeightMap(const fs::path& path, const HeightMapFileOptions& options) {
  checkOptions(options);
  const std::string ending = lowerExtension(path);
  if (ending == ".asc") return readAsc(path);
  if (ending == ".pgm") return readPgm(path, options);
  if (ending == ".png") return readPng(path, options);
  fail(path, "is no height map; its ending must be .png, .pgm or .asc");
}

void writeHeightMap(const fs::path& path, const HeightMap& map,
                    const HeightMapFileOptions& options) {
  checkOptions(options);
  if (map.width < 1 || map.height < 1) fail(path, "cannot be written: the height map is empty");
  const std::string ending = lowerExtension(path);
  if (ending == ".asc") {
    writeFile(path, ascText(map));
  } else if (ending == ".png") {
    writePng(path, Image16{map.width, map.height, 1, steps(map, options.heightScale)});
  } else if (ending == ".pgm") {
    std::string out =
        "P5\n" + std::to_string(map.width) + " " + std::to_string(map.height) + "\n65535\n";
    for (const std::uint16_t h : steps(map, options.heightScale)) {
      out += static_cast<char>(h >> 8);
      out += static_cast<char>(h & 0xff);
    }
    writeFile(path, out);
  } else {
    fail(path, "cannot be written as a height map; its ending must be .png, .pgm or .asc");
  }
}

}  // namespace exemplar
