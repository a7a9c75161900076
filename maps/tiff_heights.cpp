// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Heights in .tif files: libtiff, and of GeoTIFF (OGC 19-008r4) the tags that say how large cells
// are, where they lie, and in which unit.

#include <tiffio.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/memory.h"
#include "core/text.h"
#include "maps/height_formats.h"

namespace exemplar {
namespace {

// GeoTIFF's tags, and GDAL's.
constexpr ttag_t kPixelScale = 33550, kTiepoints = 33922, kTransformation = 34264, kGeoKeys = 34735,
                 kNoDataTag = 42113;
// GeoTIFF's keys.
constexpr std::uint16_t kModelType = 1024, kRasterType = 1025, kLinearUnits = 3076;
constexpr std::uint16_t kGeographic = 2, kPointRaster = 2, kMeter = 9001;
constexpr double kLargestHeight = 1e15;
/// Deflate, LZW and PackBits make no more than so many bytes of one.
constexpr double kLargestRatio = 1500;
/// Other compressions, and files that leave blocks out, are believed this much; a small file is
/// believed so many bytes.
constexpr double kBelievedRatio = 50'000, kBelievedBytes = 64e6;

/// A file in memory, as libtiff reads and writes it.
struct Memory {
  std::string_view in;
  std::string out;
  bool writes = false;
  std::uint64_t position = 0;
  std::string message, warning;  ///< libtiff's first

  std::uint64_t size() const { return writes ? out.size() : in.size(); }
};

tmsize_t readBytes(thandle_t handle, void* to, tmsize_t count) {
  auto& memory = *static_cast<Memory*>(handle);
  const std::uint64_t there = memory.size() > memory.position ? memory.size() - memory.position : 0;
  const auto n = std::min(static_cast<std::uint64_t>(std::max<tmsize_t>(count, 0)), there);
  std::memcpy(to, (memory.writes ? memory.out.data() : memory.in.data()) + memory.position, n);
  memory.position += n;
  return static_cast<tmsize_t>(n);
}

tmsize_t writeBytes(thandle_t handle, void* from, tmsize_t count) {
  auto& memory = *static_cast<Memory*>(handle);
  if (!memory.writes || count < 0) return 0;
  const std::uint64_t end = memory.position + static_cast<std::uint64_t>(count);
  if (memory.out.size() < end) memory.out.resize(end);
  std::memcpy(memory.out.data() + memory.position, from, static_cast<std::size_t>(count));
  memory.position = end;
  return count;
}

toff_t seek(thandle_t handle, toff_t offset, int whence) {
  auto& memory = *static_cast<Memory*>(handle);
  const std::uint64_t base = whence == SEEK_CUR   ? memory.position
                             : whence == SEEK_END ? memory.size()
                                                  : 0;
  memory.position = base + offset;
  return memory.position;
}

int closeNothing(thandle_t) { return 0; }
toff_t sizeOf(thandle_t handle) { return static_cast<Memory*>(handle)->size(); }

std::string line(const char* format, std::va_list values) {
  char text[256];
  std::vsnprintf(text, sizeof text, format, values);
  return oneLine(text);
}

int takeError(TIFF*, void* user, const char*, const char* format, std::va_list values) {
  auto& memory = *static_cast<Memory*>(user);
  if (memory.message.empty()) memory.message = line(format, values);
  return 1;
}
int takeWarning(TIFF*, void* user, const char*, const char* format, std::va_list values) {
  auto& memory = *static_cast<Memory*>(user);
  // GeoTIFF's own tags are among those that libtiff does not know.
  const std::string text = line(format, values);
  if (memory.warning.empty() && text.find("Unknown field") == std::string::npos)
    memory.warning = text;
  return 1;
}

using File = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

File open(Memory& memory, const std::string& name, const char* mode) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(
      TIFFOpenOptionsAlloc(), &TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), takeError, &memory);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), takeWarning, &memory);
  const double most = std::min(static_cast<double>(availableMemoryBytes()) / 2, 4e18);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(most));
  return {TIFFClientOpenExt(name.c_str(), mode, &memory, readBytes, writeBytes, seek, closeNothing,
                            sizeOf, nullptr, nullptr, options.get()),
          &TIFFClose};
}

/// A tag that libtiff does not know itself: a list of values.
template <class Value>
std::vector<Value> listOf(TIFF* tiff, ttag_t tag, TIFFDataType type) {
  const TIFFField* field = TIFFFindField(tiff, tag, TIFF_ANY);
  if (!field || TIFFFieldDataType(field) != type || !TIFFFieldPassCount(field) ||
      TIFFFieldReadCount(field) != TIFF_VARIABLE2)
    return {};
  std::uint32_t count = 0;
  const Value* values = nullptr;
  if (!TIFFGetField(tiff, tag, &count, &values) || !values) return {};
  return {values, values + count};
}

/// The value of a GeoTIFF key that is a number; 0 where it is not there.
std::uint16_t geoKey(const std::vector<std::uint16_t>& keys, std::uint16_t id) {
  for (std::size_t at = 4; at + 3 < keys.size(); at += 4)
    if (keys[at] == id && keys[at + 1] == 0) return keys[at + 3];
  return 0;
}

/// How samples are stored.
struct Layout {
  std::uint32_t width = 0, height = 0;
  std::uint16_t bits = 1, samples = 1, format = SAMPLEFORMAT_UINT;
  bool planar = false;  ///< each sample in a plane of its own
  bool alpha = false;
};

class TiffReader {
 public:
  TiffReader(const HeightFile& file) : file_(file) { memory_.in = file.bytes; }

  HeightMap read() {
    tiff_ = open(memory_, file_.name, "rm").release();
    const File closes(tiff_, &TIFFClose);
    if (!tiff_) fail("is no .tif file");
    readLayout();
    HeightMap map = file_.allocate(layout_.width, layout_.height);
    noData_ = noDataOf();
    if (TIFFIsTiled(tiff_)) {
      readTiles(map);
    } else {
      readStrips(map);
    }
    warnOfAssumedHoles(file_, assumed_);
    place(map);
    if (layout_.format != SAMPLEFORMAT_IEEEFP && layout_.bits <= 16) {
      map.steps = HeightSteps{file_.options.heightScale.value_or(1), (1 << layout_.bits) - 1};
    }
    for (const std::string& said : {memory_.message, memory_.warning})
      if (!said.empty()) file_.warn("is read, but is not sound (" + said + ")");
    if (TIFFReadDirectory(tiff_)) {
      std::uint32_t kind = 0;
      TIFFGetFieldDefaulted(tiff_, TIFFTAG_SUBFILETYPE, &kind);
      if (!(kind & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)))
        file_.warn("only the first of its pictures is read");
    }
    return map;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    file_.fail(memory_.message.empty() ? what : what + " (" + memory_.message + ")");
  }

  void readLayout() {
    std::uint16_t photometric = PHOTOMETRIC_MINISBLACK, planar = PLANARCONFIG_CONTIG;
    if (!TIFFGetField(tiff_, TIFFTAG_IMAGEWIDTH, &layout_.width) ||
        !TIFFGetField(tiff_, TIFFTAG_IMAGELENGTH, &layout_.height))
      fail("says no size");
    TIFFGetFieldDefaulted(tiff_, TIFFTAG_BITSPERSAMPLE, &layout_.bits);
    TIFFGetFieldDefaulted(tiff_, TIFFTAG_SAMPLESPERPIXEL, &layout_.samples);
    TIFFGetFieldDefaulted(tiff_, TIFFTAG_SAMPLEFORMAT, &layout_.format);
    TIFFGetFieldDefaulted(tiff_, TIFFTAG_PLANARCONFIG, &planar);
    TIFFGetField(tiff_, TIFFTAG_PHOTOMETRIC, &photometric);
    std::uint16_t extraCount = 0;
    const std::uint16_t* extra = nullptr;
    TIFFGetFieldDefaulted(tiff_, TIFFTAG_EXTRASAMPLES, &extraCount, &extra);
    layout_.planar = planar == PLANARCONFIG_SEPARATE;
    layout_.alpha = layout_.samples == 2 && extraCount == 1 && extra &&
                    (extra[0] == EXTRASAMPLE_UNASSALPHA || extra[0] == EXTRASAMPLE_ASSOCALPHA);
    if (photometric == PHOTOMETRIC_PALETTE)
      fail("is a picture with a palette; save the heights themselves, as gray");
    if (photometric != PHOTOMETRIC_MINISBLACK && photometric != PHOTOMETRIC_MINISWHITE)
      fail("is a color picture; a height map must be gray");
    if (layout_.samples != 1 && !layout_.alpha)
      fail("has " + std::to_string(layout_.samples) + " bands; a height map has one");
    if (photometric == PHOTOMETRIC_MINISWHITE)
      fail("counts from white; save it counted from black");
    const bool real = layout_.format == SAMPLEFORMAT_IEEEFP;
    const bool whole = layout_.format == SAMPLEFORMAT_UINT || layout_.format == SAMPLEFORMAT_INT ||
                       layout_.format == SAMPLEFORMAT_VOID;
    const bool known = (whole && (layout_.bits == 8 || layout_.bits == 16 || layout_.bits == 32)) ||
                       (real && (layout_.bits == 32 || layout_.bits == 64));
    if (!known) {
      fail("has samples of " + std::to_string(layout_.bits) +
           " bits of a kind that is not read; save it as 16-bit integers or 32-bit floats");
    }
    const double bytes =
        1.0 * layout_.width * layout_.height * layout_.samples * (layout_.bits / 8);
    std::uint16_t compression = COMPRESSION_NONE;
    TIFFGetFieldDefaulted(tiff_, TIFFTAG_COMPRESSION, &compression);
    const bool bounded = compression == COMPRESSION_NONE || compression == COMPRESSION_LZW ||
                         compression == COMPRESSION_ADOBE_DEFLATE ||
                         compression == COMPRESSION_DEFLATE || compression == COMPRESSION_PACKBITS;
    const bool sparse = TIFFGetStrileByteCount(tiff_, 0) == 0;
    const auto size = static_cast<double>(file_.bytes.size());
    if (bytes >
        (bounded && !sparse ? kLargestRatio * size : kBelievedRatio * size + kBelievedBytes)) {
      fail("the file ends early: " + std::to_string(layout_.width) + " x " +
           std::to_string(layout_.height) + " points cannot be in " +
           std::to_string(file_.bytes.size()) + " bytes");
    }
  }

  /// What the file says that holes hold.
  std::optional<double> noDataOf() const {
    std::string text;
    const TIFFField* field = TIFFFindField(tiff_, kNoDataTag, TIFF_ANY);
    if (field && TIFFFieldDataType(field) == TIFF_ASCII && TIFFFieldPassCount(field)) {
      for (const char c : listOf<char>(tiff_, kNoDataTag, TIFF_ASCII)) {
        if (c == '\0') break;
        if (c != ' ') text += c;
      }
    }
    if (text.empty()) return std::nullopt;
    if (text == "nan" || text == "NaN" || text == "-nan")
      return std::numeric_limits<double>::quiet_NaN();
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
      file_.warn("its NODATA value is no number and is not used");
      return std::nullopt;
    }
    return value;
  }

  template <class Sample>
  static double sampleAt(const unsigned char* bytes, std::size_t index) {
    Sample value;
    std::memcpy(&value, bytes + index * sizeof value, sizeof value);
    return static_cast<double>(value);
  }
  double sample(const std::vector<unsigned char>& block, std::size_t index) const {
    const unsigned char* bytes = block.data();
    if (layout_.format == SAMPLEFORMAT_IEEEFP)
      return layout_.bits == 32 ? sampleAt<float>(bytes, index) : sampleAt<double>(bytes, index);
    const bool isSigned = layout_.format == SAMPLEFORMAT_INT;
    switch (layout_.bits) {
      case 8:
        return isSigned ? sampleAt<std::int8_t>(bytes, index) : bytes[index];
      case 16:
        return isSigned ? sampleAt<std::int16_t>(bytes, index)
                        : sampleAt<std::uint16_t>(bytes, index);
      default:
        return isSigned ? sampleAt<std::int32_t>(bytes, index)
                        : sampleAt<std::uint32_t>(bytes, index);
    }
  }

  /// A float's value for NODATA may have been rounded on its way through text.
  bool isNoData(double h) {
    if (!noData_) {
      const bool usual = isUsualNoData(h);
      assumed_ += usual;
      return usual;
    }
    if (layout_.format != SAMPLEFORMAT_IEEEFP) return h == *noData_;
    return std::abs(h - *noData_) <= 1e-6 * std::abs(*noData_);
  }

  /// Takes the samples of a block whose first is at (x0, y0) and whose rows are `rowLength` long.
  void take(HeightMap& map, const std::vector<unsigned char>& block, std::uint32_t x0,
            std::uint32_t y0, std::uint32_t rowLength, std::uint32_t rows, bool isAlpha) {
    const std::uint32_t step = layout_.planar ? 1u : layout_.samples;
    const double scale = file_.options.heightScale.value_or(1);
    for (std::uint32_t y = 0; y < rows && y0 + y < layout_.height; ++y) {
      for (std::uint32_t x = 0; x < rowLength && x0 + x < layout_.width; ++x) {
        const std::size_t at = (static_cast<std::size_t>(y) * rowLength + x) * step;
        float& to = map.heights(static_cast<int>(x0 + x), static_cast<int>(y0 + y));
        if (isAlpha) {
          if (sample(block, at) == 0) to = std::numeric_limits<float>::quiet_NaN();
          continue;
        }
        if (layout_.alpha && !layout_.planar && sample(block, at + 1) == 0) continue;
        const double h = sample(block, at);
        if (std::isnan(h) || isNoData(h)) continue;
        if (!(std::abs(h) <= kLargestHeight)) {
          // Infinite, or a float's largest number beside another value that is announced.
          if (std::abs(h) >= 3.4e38) continue;
          fail("a height is " + roundedNumber(h) + "; it must be below 1e15 in size");
        }
        to = static_cast<float>(scale == 1 ? h : h * scale);
      }
    }
  }

  /// Whether a block is not in the file, as GDAL writes ones without data: it stays a hole.
  bool isLeftOut(std::uint32_t block) {
    if (TIFFGetStrileByteCount(tiff_, block) != 0 || TIFFGetStrileOffset(tiff_, block) != 0)
      return false;
    file_.warn("blocks that are not in the file are read as cells without data");
    return true;
  }

  std::vector<unsigned char> blockOf(std::uint64_t bytes) const {
    requireMemory(static_cast<double>(bytes), file_.name + ": one of its blocks",
                  "save it in strips or tiles");
    return std::vector<unsigned char>(bytes);
  }

  void readStrips(HeightMap& map) {
    std::uint32_t rows = 0;
    TIFFGetFieldDefaulted(tiff_, TIFFTAG_ROWSPERSTRIP, &rows);
    rows = std::min(rows, layout_.height);
    const std::uint64_t row = TIFFScanlineSize64(tiff_);
    if (rows == 0 || row < std::uint64_t{layout_.width} * (layout_.bits / 8))
      fail("says how its rows lie in a way that cannot be");
    std::vector<unsigned char> block = blockOf(row * rows);
    const std::uint32_t planes = layout_.planar ? layout_.samples : 1u;
    for (std::uint32_t plane = 0; plane < planes; ++plane) {
      for (std::uint32_t y = 0; y < layout_.height; y += rows) {
        file_.progress.report("reading", static_cast<double>(y) / layout_.height / planes);
        const std::uint32_t here = std::min(rows, layout_.height - y);
        const auto strip = TIFFComputeStrip(tiff_, y, static_cast<std::uint16_t>(plane));
        const auto wanted = static_cast<tmsize_t>(row * here);
        if (isLeftOut(strip)) continue;
        if (TIFFReadEncodedStrip(tiff_, strip, block.data(), wanted) != wanted)
          fail("cannot be read whole");
        take(map, block, 0, y, layout_.width, here, plane == 1);
      }
    }
  }

  void readTiles(HeightMap& map) {
    std::uint32_t width = 0, height = 0;
    TIFFGetField(tiff_, TIFFTAG_TILEWIDTH, &width);
    TIFFGetField(tiff_, TIFFTAG_TILELENGTH, &height);
    const std::uint64_t bytes = TIFFTileSize64(tiff_);
    const std::uint64_t samples = layout_.planar ? 1u : layout_.samples;
    if (width == 0 || height == 0 ||
        1.0 * width * height * static_cast<double>(samples) * (layout_.bits / 8) >
            static_cast<double>(bytes))
      fail("says how its tiles lie in a way that cannot be");
    // A tile may be larger than the map, but not by much.
    if (1.0 * width * height > 4.0 * layout_.width * layout_.height + 1e6)
      fail("has tiles that are far larger than itself");
    std::vector<unsigned char> block = blockOf(bytes);
    const std::uint32_t planes = layout_.planar ? layout_.samples : 1u;
    for (std::uint32_t plane = 0; plane < planes; ++plane) {
      for (std::uint64_t y = 0; y < layout_.height; y += height) {
        file_.progress.report("reading", static_cast<double>(y) / layout_.height / planes);
        for (std::uint64_t x = 0; x < layout_.width; x += width) {
          const auto tile =
              TIFFComputeTile(tiff_, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                              0, static_cast<std::uint16_t>(plane));
          if (isLeftOut(tile)) continue;
          if (TIFFReadEncodedTile(tiff_, tile, block.data(), static_cast<tmsize_t>(bytes)) !=
              static_cast<tmsize_t>(bytes))
            fail("cannot be read whole");
          take(map, block, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), width,
               height, plane == 1);
        }
      }
    }
  }

  /// What GeoTIFF's tags say about cells.
  void place(HeightMap& map) const {
    const auto keys = listOf<std::uint16_t>(tiff_, kGeoKeys, TIFF_SHORT);
    const auto scale = listOf<double>(tiff_, kPixelScale, TIFF_DOUBLE);
    const auto ties = listOf<double>(tiff_, kTiepoints, TIFF_DOUBLE);
    const auto matrix = listOf<double>(tiff_, kTransformation, TIFF_DOUBLE);
    double x = 0, y = 0;  // sides of a cell
    if (scale.size() >= 2) {
      x = scale[0];
      y = scale[1];
    } else if (matrix.size() >= 16) {
      x = std::hypot(matrix[0], matrix[4]);
      y = std::hypot(matrix[1], matrix[5]);
    } else {
      return;
    }
    if (!(x > 0 && y > 0 && x < kLargestHeight && y < kLargestHeight)) {
      file_.warn("says how large its cells are in a way that cannot be, and is not heard");
      return;
    }
    if (file_.options.cellSize) return;
    if (std::abs(x - y) > 1e-6 * std::max(x, y)) {
      fail("has cells of " + roundedNumber(x) + " x " + roundedNumber(y) +
           "; they must be square: resample it, or set `cell-size` to take them for square");
    }
    map.cellSize = x;
    map.cellSizeKnown = true;
    if (scale.size() >= 2 && ties.size() >= 6) {
      const double shift = geoKey(keys, kRasterType) == kPointRaster ? 0.5 : 0;
      const MapCorner corner{ties[3] - (ties[0] + shift) * x,
                             ties[4] + (ties[1] + shift) * y - map.height() * y};
      if (std::isfinite(corner.west) && std::isfinite(corner.south)) map.corner = corner;
    }
    if (geoKey(keys, kModelType) == kGeographic) {
      const double south = map.corner ? map.corner->south : 0;
      map.cellSize = metersOfDegrees(x, south, south + y * map.height());
      map.corner.reset();
      file_.warn("its cells of " + roundedNumber(x) + " degrees are taken as " +
                 roundedNumber(map.cellSize) + " m long; set `cell-size` for another length");
    } else if (const std::uint16_t unit = geoKey(keys, kLinearUnits);
               unit > kMeter && unit < 9100) {
      file_.warn("its cells are not in meters but in the unit " + std::to_string(unit) +
                 " of EPSG; its heights are taken to be in the same one: set `cell-size` where "
                 "they are not");
    } else {
      checkCellUnit(map, file_);
    }
  }

  const HeightFile& file_;
  Memory memory_;
  TIFF* tiff_ = nullptr;
  Layout layout_;
  std::optional<double> noData_;
  std::size_t assumed_ = 0;  ///< cells without data that the file does not announce
};

constexpr TIFFFieldInfo kFields[] = {
    {kPixelScale, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("ModelPixelScale")},
    {kTiepoints, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("ModelTiepoint")},
    {kGeoKeys, -1, -1, TIFF_SHORT, FIELD_CUSTOM, 1, 1, const_cast<char*>("GeoKeyDirectory")},
    {kNoDataTag, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("GDALNoData")}};

}  // namespace

HeightMap readTiff(const HeightFile& file) { return TiffReader(file).read(); }

std::string tiffBytes(const HeightMap& map, const std::string& name, const Progress& progress) {
  Memory memory;
  memory.writes = true;
  const auto width = static_cast<std::uint32_t>(map.width());
  const auto height = static_cast<std::uint32_t>(map.height());
  // BigTIFF where offsets of 32 bits might not do.
  File tiff = open(memory, name, 4.5 * width * height > 4e9 ? "w8m" : "wm");
  const auto fail = [&] {
    throw InputError(name + ": cannot be written (" + memory.message + ")");
  };
  if (!tiff) fail();
  TIFFMergeFieldInfo(tiff.get(), kFields, std::size(kFields));
  TIFFSetField(tiff.get(), TIFFTAG_IMAGEWIDTH, width);
  TIFFSetField(tiff.get(), TIFFTAG_IMAGELENGTH, height);
  TIFFSetField(tiff.get(), TIFFTAG_BITSPERSAMPLE, 32);
  TIFFSetField(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(tiff.get(), TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
  TIFFSetField(tiff.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  TIFFSetField(tiff.get(), TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff.get(), TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  TIFFSetField(tiff.get(), TIFFTAG_PREDICTOR, PREDICTOR_FLOATINGPOINT);
  const std::uint32_t rows = std::clamp((1u << 18) / (4 * width), 1u, height);
  TIFFSetField(tiff.get(), TIFFTAG_ROWSPERSTRIP, rows);
  if (map.cellSizeKnown) {
    const MapCorner corner = map.corner.value_or(MapCorner{});
    const double scale[3] = {map.cellSize, map.cellSize, 0};
    const double tie[6] = {0, 0, 0, corner.west, corner.south + map.cellSize * map.height(), 0};
    // A user-defined model (32767) whose cells are areas (1).
    const std::uint16_t keys[] = {1, 1, 0, 2, kModelType, 0, 1, 32767, kRasterType, 0, 1, 1};
    TIFFSetField(tiff.get(), kPixelScale, 3, scale);
    TIFFSetField(tiff.get(), kTiepoints, 6, tie);
    TIFFSetField(tiff.get(), kGeoKeys, static_cast<int>(std::size(keys)), keys);
  }
  const std::optional<HeightRange> range = rangeOf(map.heights);
  // Heights that others take for holes are none where the file says what a hole is.
  const bool saysHoles = !range || range->holes > 0 || range->low <= -9999;
  if (saysHoles) TIFFSetField(tiff.get(), kNoDataTag, "nan");
  std::vector<float> block(static_cast<std::size_t>(rows) * width);
  for (std::uint32_t y = 0, strip = 0; y < height; y += rows, ++strip) {
    progress.report("writing", static_cast<double>(y) / height);
    const std::uint32_t here = std::min(rows, height - y);
    const std::size_t count = static_cast<std::size_t>(here) * width;
    // libtiff works on the block itself.
    std::copy_n(&map.heights.values()[static_cast<std::size_t>(y) * width], count, block.begin());
    const auto bytes = static_cast<tmsize_t>(count * sizeof(float));
    if (TIFFWriteEncodedStrip(tiff.get(), strip, block.data(), bytes) != bytes) fail();
  }
  if (!TIFFWriteDirectory(tiff.get())) fail();
  tiff.reset();
  return std::move(memory.out);
}

}  // namespace exemplar
