// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/file.h"
#include "core/memory.h"
#include "core/text.h"
#include "core/text_scanner.h"
#include "mesh/image.h"
#include "sdf/height_map.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

// A map without a cell size of its own is this many reliefs wide.
constexpr double kSidePerRelief = 5;
// Heights are stored as float, and squares of them must not overflow.
constexpr double kLargestHeight = 1e15;

[[noreturn]] void fail(const std::string& name, const std::string& what) {
  throw InputError(name + ": " + what);
}

template <class Number>
std::string text(Number value) {
  char buffer[64];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}
/// For messages: four digits are enough.
std::string rounded(double value) {
  char buffer[64];
  return {buffer,
          std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 4).ptr};
}

void checkOptions(const HeightMapFileOptions& options) {
  const auto check = [](const std::optional<double>& value, const char* name) {
    if (value && !(*value > 0 && *value < std::numeric_limits<double>::infinity()))
      throw InputError(std::string("`") + name + "` is " + text(*value) + "; it must be > 0");
  };
  check(options.cellSize, "cell-size");
  check(options.heightScale, "height-scale");
}

/// What is read: a file's bytes, and what is to be done with them.
struct Source {
  std::string_view bytes;
  const std::string& name;
  const HeightMapFileOptions& options;
  const Progress& progress;

  void warn(const std::string& what) const { exemplar::warn(options.warnings, name + ": " + what); }
};

/// Words of a text, wherever its lines end.
class Words {
 public:
  /// With `gluedComments`, a comment may follow a word without a blank ("500#wide").
  Words(const Source& source, bool gluedComments)
      : in_(source.bytes, source.name, {.comments = true}),
        progress_(source.progress),
        gluedComments_(gluedComments) {
    in_.nextLine();
  }

  /// The next word; empty at the end.
  std::string_view next() {
    if (count_++ % 65536 == 0) progress_.report("reading", in_.fraction());
    const std::string_view word = in_.wordAhead();
    const std::size_t comment = word.find('#');
    if (!gluedComments_ || comment == std::string_view::npos) return word;
    in_.rest();
    return word.substr(0, comment);
  }
  /// The next word as a number from `low` to `high`; `what` is what errors call it.
  template <class Number>
  Number number(const std::string& what, Number low, Number high) {
    const std::string_view word = next();
    if (word.empty()) fail("the file ends before " + what);
    return parse<Number>(word, what, low, high);
  }
  template <class Number>
  Number parse(std::string_view word, const std::string& what, Number low, Number high) {
    const std::optional<double> value = parseNumber(word);
    if (!value || !(*value >= low && *value <= high) ||
        *value != static_cast<double>(static_cast<Number>(*value))) {
      fail(what + " is \"" + TextScanner::shown(word) + "\"; it must be a number from " +
           text(low) + " to " + text(high));
    }
    return static_cast<Number>(*value);
  }
  [[noreturn]] void fail(const std::string& what) const { in_.fail(what); }
  std::size_t bytesLeft() const { return in_.bytesLeft(); }

 private:
  TextScanner in_;
  const Progress& progress_;
  bool gluedComments_;
  std::uint64_t count_ = 0;
};

void allocate(HeightMap& map, int width, int height, const std::string& name) {
  if (width < 2 || height < 2)
    fail(name, "is " + std::to_string(width) + " x " + std::to_string(height) +
                   " points; a height map needs at least 2 x 2");
  requireMemory(8.0 * width * height, name + ": its heights", "use a smaller height map");
  map.width = width;
  map.height = height;
  map.heights.resize(static_cast<std::size_t>(width) * height);
}

double reliefOf(const HeightMap& map) {
  const auto [low, high] = std::minmax_element(map.heights.begin(), map.heights.end());
  return double{*high} - *low;
}
double longerSide(const HeightMap& map) { return std::max(map.width, map.height) - 1; }

/// Cells without data get the mean of their neighbors that have it, ring by ring from the border.
/// Returns how many there were.
std::size_t fillHoles(HeightMap& map, std::vector<char>& known) {
  const auto forNeighbors = [&](std::size_t p, const auto& body) {
    const int column = static_cast<int>(p % map.width), row = static_cast<int>(p / map.width);
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, map.height - 1); ++r)
      for (int c = std::max(column - 1, 0); c <= std::min(column + 1, map.width - 1); ++c)
        body(static_cast<std::size_t>(r) * map.width + c);
  };
  std::vector<std::size_t> ring;  // the cells without data next to ones with
  std::size_t holes = 0;
  for (std::size_t p = 0; p < known.size(); ++p) {
    if (known[p]) continue;
    ++holes;
    bool borders = false;
    forNeighbors(p, [&](std::size_t q) { borders = borders || known[q]; });
    if (borders) ring.push_back(p);
  }
  while (!ring.empty()) {
    std::vector<float> filled;
    for (const std::size_t p : ring) {
      double sum = 0;
      int count = 0;
      forNeighbors(p, [&](std::size_t q) {
        if (!known[q]) return;
        sum += map.heights[q];
        ++count;
      });
      filled.push_back(static_cast<float>(sum / count));
    }
    for (std::size_t i = 0; i < ring.size(); ++i) {
      map.heights[ring[i]] = filled[i];
      known[ring[i]] = 1;
    }
    std::vector<std::size_t> next;
    for (const std::size_t p : ring) {
      forNeighbors(p, [&](std::size_t q) {
        if (!known[q]) next.push_back(q);
      });
    }
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    ring = std::move(next);
  }
  return holes;
}

/// Integer heights to world units.
void finish(HeightMap& map, const HeightMapFileOptions& options, int largest) {
  map.steps = HeightSteps{options.heightScale.value_or(1), largest};
  for (float& h : map.heights) h = static_cast<float>(h * map.steps->size);
  const double relief = reliefOf(map);
  map.cellSize = options.cellSize ? *options.cellSize
                 : relief > 0     ? kSidePerRelief * relief / longerSide(map)
                                  : 1;
}

HeightMap readPgm(const Source& source) {
  const std::string& name = source.name;
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
    fail(name, "the file ends early: " + std::to_string(width) + " x " + std::to_string(height) +
                   " points need " + std::to_string(count * size) + " bytes and " +
                   std::to_string(left ? left - 1 : 0) + " are there");
  HeightMap map;
  allocate(map, width, height, name);
  if (magic == "P2") {
    for (float& h : map.heights) h = static_cast<float>(words.number("a height", 0, largest));
  } else {
    const std::string_view tail = source.bytes.substr(source.bytes.size() - left + 1);
    const auto* data = reinterpret_cast<const unsigned char*>(tail.data());
    for (std::size_t p = 0; p < count; ++p) {
      const int h = size == 2 ? data[2 * p] << 8 | data[2 * p + 1] : data[p];
      if (h > largest)
        fail(name, "a height is " + std::to_string(h) + ", above the file's largest value " +
                       std::to_string(largest));
      map.heights[p] = static_cast<float>(h);
    }
  }
  finish(map, source.options, largest);
  return map;
}

/// The bits of a sample in a PNG whose header has been found sound. The depth of a palette's
/// indices says nothing about its colors, which have 8.
int pngDepth(std::string_view bytes) {
  constexpr std::size_t kDepth = 24, kColorType = 25;
  constexpr char kPalette = 3;
  return bytes[kColorType] == kPalette ? 8 : bytes[kDepth];
}

HeightMap readPng(const Source& source) {
  const Image16 image = decodePng16(source.bytes, source.name);
  // Samples of fewer bits come spread over 16; their own steps are what the file counts in.
  const int largest = (1 << pngDepth(source.bytes)) - 1;
  HeightMap map;
  allocate(map, image.width, image.height, source.name);
  std::vector<char> known(map.heights.size(), 1);
  const int alpha = image.channels % 2 == 0 ? image.channels - 1 : -1;
  for (int row = 0; row < map.height; ++row) {
    source.progress.check();
    for (int column = 0; column < map.width; ++column) {
      const std::uint16_t* p = image.at(column, row);
      const std::size_t at = static_cast<std::size_t>(row) * map.width + column;
      if (alpha >= 0 && p[alpha] == 0) {
        known[at] = 0;
        continue;
      }
      if (image.channels >= 3 && (p[0] != p[1] || p[0] != p[2]))
        fail(source.name, "is a color picture; a height map must be gray");
      map.heights[at] = static_cast<float>(std::lround(p[0] * (largest / 65535.0)));
    }
  }
  const auto holes = static_cast<std::size_t>(std::count(known.begin(), known.end(), 0));
  if (holes == known.size()) fail(source.name, "holds no heights: every pixel is transparent");
  if (holes > 0) {
    source.warn("filling " + counted(holes, "transparent pixel") + " from their neighbors");
    fillHoles(map, known);
  }
  finish(map, source.options, largest);
  return map;
}

/// Reads an ESRI grid: keys and numbers, then the heights.
class AscReader {
 public:
  explicit AscReader(const Source& source) : source_(source), words_(source, false) {}

  HeightMap read() {
    std::string_view word = readKeys();
    if (!columns_ || !rows_ || !cellSize_)
      words_.fail(std::string("is no ESRI grid: ") +
                  (!columns_ ? "ncols"
                   : !rows_  ? "nrows"
                             : "cellsize") +
                  " is missing");
    const std::size_t count = static_cast<std::size_t>(*columns_) * *rows_;
    if (source_.bytes.size() / 2 + 1 < count)  // a digit and a blank each
      fail(source_.name, "the file ends early: it is too short for " + std::to_string(*columns_) +
                             " x " + std::to_string(*rows_) + " heights");
    allocate(map_, *columns_, *rows_, source_.name);
    known_.assign(count, 1);
    for (std::size_t p = 0; p < count; ++p, word = words_.next()) {
      if (word.empty())
        words_.fail("the file ends after " + std::to_string(p) + " of " + std::to_string(count) +
                    " heights");
      readHeight(p, word);
    }
    if (!word.empty())
      words_.fail("has more than " + std::to_string(*columns_) + " x " + std::to_string(*rows_) +
                  " heights");
    fillCellsWithoutData();
    const double scale = source_.options.heightScale.value_or(1);
    for (float& h : map_.heights) h = static_cast<float>(h * scale);
    setCellSize();
    return std::move(map_);
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  static bool isNan(const std::string& word) {
    // As C, Python, and Microsoft's and Intel's libraries write it.
    return word.find("nan") != std::string::npos || word.find("#ind") != std::string::npos;
  }

  /// Reads the keys; returns the first word after them.
  std::string_view readKeys() {
    std::string_view word = words_.next();
    for (; !word.empty() && std::isalpha(static_cast<unsigned char>(word[0]));
         word = words_.next()) {
      const std::string key = lowerCase(word);
      if (key == "nan" || key == "inf" || key == "infinity") break;  // a value
      if (key == "ncols") {
        columns_ = words_.number("ncols", 1, 1 << 24);
      } else if (key == "nrows") {
        rows_ = words_.number("nrows", 1, 1 << 24);
      } else if (key == "cellsize" || key == "dx" || key == "dy") {
        const double size = words_.number(key, std::numeric_limits<double>::min(), kLargestHeight);
        if (cellSize_ && std::abs(size - *cellSize_) > 1e-6 * size)
          words_.fail("dx and dy differ; the cells must be square");
        cellSize_ = size;
      } else if (key == "xllcorner" || key == "xllcenter") {
        west_ = words_.number(key, -kInfinity, kInfinity);
      } else if (key == "yllcorner" || key == "yllcenter") {
        south_ = words_.number(key, -kInfinity, kInfinity);
      } else if (key == "nodata_value" || key == "nodata") {
        const std::string_view value = words_.next();
        hasNoData_ = true;
        noData_ = isNan(lowerCase(value)) ? std::numeric_limits<double>::quiet_NaN()
                                          : words_.parse(value, key, -kInfinity, kInfinity);
      } else {
        words_.fail("\"" + TextScanner::shown(word) +
                    "\" is no key of an ESRI grid: ncols, nrows, xllcorner, yllcorner, cellsize, "
                    "nodata_value");
      }
    }
    return word;
  }

  /// Whether a number means that there is no data. Programs round the value on its way through
  /// floats and few digits.
  bool isNoData(double h) const {
    if (hasNoData_) {
      const double rounding = (std::abs(noData_) < 1e30 ? 1e-6 : 1e-5) * std::abs(noData_);
      return std::abs(h - noData_) <= rounding;
    }
    // Esri's own default, and what others use; a float's largest number.
    for (const double usual : {-9999.0, -99999.0, -32768.0, -32767.0}) {
      if (h == usual) return true;
    }
    return std::abs(h) >= 3.4e38 && std::abs(h) < 3.41e38;
  }

  void readHeight(std::size_t p, std::string_view word) {
    if (word.find_first_of("nN#") != std::string_view::npos && isNan(lowerCase(word))) {
      known_[p] = 0;
      assumed_ = assumed_ || !(hasNoData_ && std::isnan(noData_));
      return;
    }
    const double h = words_.parse(word, "a height", -kInfinity, kInfinity);
    if (isNoData(h)) {
      known_[p] = 0;
      assumed_ = assumed_ || !hasNoData_;
      return;
    }
    if (!(std::abs(h) <= kLargestHeight))
      words_.fail("a height is \"" + TextScanner::shown(word) +
                  "\"; it must be below 1e15 in size");
    map_.heights[p] = static_cast<float>(h);
  }

  void fillCellsWithoutData() {
    const auto holes = static_cast<std::size_t>(std::count(known_.begin(), known_.end(), 0));
    if (holes == known_.size()) fail(source_.name, "holds no heights: every cell is NODATA");
    if (holes == 0) return;
    if (assumed_)
      source_.warn("filling " + counted(holes, "cell") +
                   " without data, which no NODATA_value announces, from their neighbors");
    fillHoles(map_, known_);
  }

  void setCellSize() {
    map_.cellSize = source_.options.cellSize.value_or(*cellSize_);
    if (source_.options.cellSize) return;
    // No ground is ten times as high as it is wide: the heights are in another unit.
    const double side = longerSide(map_) * *cellSize_;
    if (!(reliefOf(map_) > 10 * side)) return;
    const double north = south_ + *cellSize_ * *rows_;
    const bool degrees = *cellSize_ <= 1 && std::abs(west_) <= 360 &&
                         std::abs(west_ + *cellSize_ * *columns_) <= 360 &&
                         std::abs(south_) <= 90 && north <= 90.5;
    if (!degrees) {
      source_.warn("its heights span " + rounded(reliefOf(map_)) + " and its side is " +
                   rounded(side) + ": set `cell-size` where cells have another unit than heights");
      return;
    }
    // One length for both directions, that the cells' area is right.
    constexpr double kMetersPerDegree = 111'195;  // on a sphere of 6371 km
    const double latitude = (south_ + north) / 2 * (std::numbers::pi / 180);
    map_.cellSize = kMetersPerDegree * *cellSize_ * std::sqrt(std::max(0.01, std::cos(latitude)));
    source_.warn("its cells of " + rounded(*cellSize_) +
                 " degrees under heights in meters are taken as " + rounded(map_.cellSize) +
                 " m long; set `cell-size` for another length");
  }

  const Source& source_;
  Words words_;
  HeightMap map_;
  std::vector<char> known_;
  std::optional<int> columns_, rows_;
  std::optional<double> cellSize_;
  double west_ = 0, south_ = 0, noData_ = 0;
  bool hasNoData_ = false;
  bool assumed_ = false;  // cells without data that the file does not announce
};

/// The heights as 16-bit integers, and warnings about what they lose.
std::vector<std::uint16_t> steps(const std::string& name, const HeightMap& map,
                                 const HeightMapFileOptions& options) {
  const auto [lowest, highest] = std::minmax_element(map.heights.begin(), map.heights.end());
  const double low = *lowest, high = *highest;
  double step = 1, offset = 0;
  if (options.heightScale || map.steps) {
    const HeightSteps steps = map.steps.value_or(HeightSteps{});
    step = options.heightScale.value_or(steps.size) * steps.largest / 65535;
  } else {
    offset = low;
    if (high > low) step = (high - low) / 65535;
    warn(options.warnings, name + ": the integers 0 to 65535 are heights from " + text(*lowest) +
                               " to " + text(*highest) + ", in steps of " + rounded(step));
  }
  std::vector<std::uint16_t> result(map.heights.size());
  std::size_t clamped = 0;
  for (std::size_t p = 0; p < result.size(); ++p) {
    const double value = (map.heights[p] - offset) / step;
    clamped += value < -0.5 || value > 65535.5;
    result[p] = static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 65535.0)));
  }
  if (clamped > 0) {
    warn(options.warnings, name + ": " + std::to_string(clamped) + " of " +
                               std::to_string(result.size()) + " heights are outside of 0 to " +
                               rounded(65535 * step) + ", what 16-bit steps of " + rounded(step) +
                               " hold, and are clamped; set a larger `height-scale` or write .asc");
  } else if (!map.steps && high > low && high - low < 255 * step) {
    warn(options.warnings, name + ": its heights span only " + rounded((high - low) / step) +
                               " steps of " + rounded(step) +
                               "; set a smaller `height-scale` or write .asc");
  }
  return result;
}

template <class Number>
void appendNumber(std::string& out, Number value) {
  char buffer[64];
  out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

std::string ascText(const HeightMap& map, const Progress& progress) {
  std::string out = "ncols " + std::to_string(map.width) + "\nnrows " + std::to_string(map.height) +
                    "\nxllcorner 0\nyllcorner 0\ncellsize ";
  appendNumber(out, map.cellSize);
  out += '\n';
  for (int row = 0; row < map.height; ++row) {
    progress.report("writing", static_cast<double>(row) / map.height);
    for (int column = 0; column < map.width; ++column) {
      appendNumber(out, map.at(column, row));
      out += column + 1 < map.width ? ' ' : '\n';
    }
  }
  return out;
}

}  // namespace

bool isHeightMapFile(const fs::path& path) {
  const std::string ending = lowerExtension(path);
  return ending == ".png" || ending == ".pgm" || ending == ".asc";
}

HeightMap readHeightMap(const fs::path& path, const HeightMapFileOptions& options,
                        const Progress& progress) {
  checkOptions(options);
  if (!isHeightMapFile(path))
    fail(path.string(), "is no height map; its ending must be .png, .pgm or .asc");
  return readHeightMap(readFile(path, progress.part(0, 0.1)), path.string(), options,
                       progress.part(0.1, 1));
}

HeightMap readHeightMap(std::string_view bytes, const std::string& name,
                        const HeightMapFileOptions& options, const Progress& progress) {
  checkOptions(options);
  const Source source{bytes, name, options, progress};
  const std::string ending = lowerExtension(name);
  if (ending == ".asc") return AscReader(source).read();
  if (ending == ".pgm") return readPgm(source);
  if (ending == ".png") return readPng(source);
  fail(name, "is no height map; its ending must be .png, .pgm or .asc");
}

void writeHeightMap(const fs::path& path, const HeightMap& map, const HeightMapFileOptions& options,
                    const Progress& progress) {
  checkOptions(options);
  const std::string name = path.string();
  if (map.width < 1 || map.height < 1) fail(name, "cannot be written: the height map is empty");
  progress.report("writing", 0);
  const std::string ending = lowerExtension(path);
  if (ending == ".asc") {
    writeFile(path, ascText(map, progress.part(0, 0.9)), progress.part(0.9, 1));
  } else if (ending == ".png") {
    writePng(path, Image16{map.width, map.height, 1, steps(name, map, options)});
  } else if (ending == ".pgm") {
    std::string out =
        "P5\n" + std::to_string(map.width) + " " + std::to_string(map.height) + "\n65535\n";
    for (const std::uint16_t h : steps(name, map, options)) {
      out += static_cast<char>(h >> 8);
      out += static_cast<char>(h & 0xff);
    }
    writeFile(path, out, progress.part(0.5, 1));
  } else {
    fail(name, "cannot be written as a height map; its ending must be .png, .pgm or .asc");
  }
}

}  // namespace exemplar
