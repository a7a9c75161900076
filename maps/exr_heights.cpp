// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Heights in .exr files (OpenEXR): one channel of half or whole floats.

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/error.h"
#include "maps/height_formats.h"

namespace exemplar {
namespace {

constexpr double kLargestHeight = 1e15;
/// Zip makes no more than so many bytes of one; so do the others.
constexpr double kLargestRatio = 1500;
constexpr const char* kCellSize = "cellSize";
constexpr const char* kWest = "west";
constexpr const char* kSouth = "south";

class MemoryIn final : public Imf::IStream {
 public:
  MemoryIn(std::string_view bytes, const std::string& name)
      : IStream(name.c_str()), bytes_(bytes) {}

  bool read(char to[], int count) override {
    if (count < 0 || static_cast<std::uint64_t>(count) > bytes_.size() - position_)
      throw std::runtime_error("the file ends early");
    std::memcpy(to, bytes_.data() + position_, static_cast<std::size_t>(count));
    position_ += static_cast<std::uint64_t>(count);
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override {
    if (position > bytes_.size()) throw std::runtime_error("the file ends early");
    position_ = position;
  }
  void clear() override {}

 private:
  std::string_view bytes_;
  std::uint64_t position_ = 0;
};

class MemoryOut final : public Imf::OStream {
 public:
  explicit MemoryOut(const std::string& name) : OStream(name.c_str()) {}

  void write(const char from[], int count) override {
    const auto n = static_cast<std::size_t>(count);
    if (bytes.size() < position_ + n) bytes.resize(position_ + n);
    std::memcpy(bytes.data() + position_, from, n);
    position_ += n;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::string bytes;

 private:
  std::uint64_t position_ = 0;
};

/// The message of an error in one line.
std::string line(const std::exception& error) {
  std::string text = error.what();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::optional<double> numberOf(const Imf::Header& header, const char* name) {
  const auto* attribute = header.findTypedAttribute<Imf::DoubleAttribute>(name);
  if (!attribute || !std::isfinite(attribute->value())) return std::nullopt;
  return attribute->value();
}

/// The channel that holds heights.
std::string heightChannel(const HeightFile& file, const Imf::ChannelList& channels) {
  std::vector<std::string> names;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel)
    names.emplace_back(channel.name());
  for (const char* usual : {"height", "Y", "Z"})
    if (std::ranges::find(names, usual) != names.end()) return usual;
  if (names.size() == 1) return names.front();
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  file.fail("has the channels " + list +
            "; a height map has one, or one of the name height, Y or Z");
}

HeightMap read(const HeightFile& file) {
  MemoryIn in(file.bytes, file.name);
  Imf::InputFile exr(in, 0);
  const Imf::Header& header = exr.header();
  const Imath::Box2i box = header.dataWindow();
  const double width = 1.0 + box.max.x - box.min.x, height = 1.0 + box.max.y - box.min.y;
  const std::string name = heightChannel(file, header.channels());
  const Imf::Channel& channel = header.channels()[name.c_str()];
  if (channel.xSampling != 1 || channel.ySampling != 1)
    file.fail("has a channel " + name + " of fewer points than pixels");
  if (2 * width * height > kLargestRatio * static_cast<double>(file.bytes.size())) {
    file.fail("the file ends early: " + exactNumber(width) + " x " + exactNumber(height) +
              " points cannot be in " + std::to_string(file.bytes.size()) + " bytes");
  }
  HeightMap map = file.allocate(width, height);
  const auto row = static_cast<std::ptrdiff_t>(width) * static_cast<std::ptrdiff_t>(sizeof(float));
  // OpenEXR counts from the pixel (0, 0), wherever the window begins.
  char* origin = reinterpret_cast<char*>(map.heights.values().data()) - box.min.y * row -
                 box.min.x * static_cast<std::ptrdiff_t>(sizeof(float));
  Imf::FrameBuffer frame;
  frame.insert(name, Imf::Slice(Imf::FLOAT, origin, sizeof(float), static_cast<std::size_t>(row)));
  exr.setFrameBuffer(frame);
  constexpr int kRows = 256;
  for (int y = box.min.y; y <= box.max.y; y += kRows) {
    file.progress.report("reading", (y - box.min.y) / height);
    exr.readPixels(y, std::min(y + kRows - 1, box.max.y));
  }
  const double scale = file.options.heightScale.value_or(1);
  for (float& h : map.heights.values()) {
    if (std::isinf(h)) h = std::numeric_limits<float>::quiet_NaN();
    if (std::abs(h) > kLargestHeight)
      file.fail("a height is " + roundedNumber(h) + "; it must be below 1e15 in size");
    if (scale != 1) h = static_cast<float>(h * scale);
  }
  if (const std::optional<double> cell = numberOf(header, kCellSize);
      cell && *cell > 0 && *cell < kLargestHeight) {
    map.cellSize = *cell;
    map.cellSizeKnown = true;
  }
  const std::optional<double> west = numberOf(header, kWest), south = numberOf(header, kSouth);
  if (west && south) map.corner = {*west, *south};
  if (std::abs(header.pixelAspectRatio() - 1) > 1e-6f)
    file.warn("its pixels are not square, and are taken for square");
  return map;
}

}  // namespace

HeightMap readExr(const HeightFile& file) {
  try {
    return read(file);
  } catch (const InputError&) {
    throw;
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& error) {
    file.fail("is no whole .exr file (" + line(error) + ")");
  }
}

std::string exrBytes(const HeightMap& map, const std::string& name) {
  try {
    Imf::Header header(map.width(), map.height());
    header.compression() = Imf::ZIP_COMPRESSION;
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    if (map.cellSizeKnown) header.insert(kCellSize, Imf::DoubleAttribute(map.cellSize));
    if (map.corner) {
      header.insert(kWest, Imf::DoubleAttribute(map.corner->west));
      header.insert(kSouth, Imf::DoubleAttribute(map.corner->south));
    }
    MemoryOut out(name);
    {
      Imf::OutputFile exr(out, header, 0);
      Imf::FrameBuffer frame;
      // It is read only.
      char* values = reinterpret_cast<char*>(const_cast<float*>(map.heights.values().data()));
      frame.insert("Y", Imf::Slice(Imf::FLOAT, values, sizeof(float),
                                   sizeof(float) * static_cast<std::size_t>(map.width())));
      exr.setFrameBuffer(frame);
      exr.writePixels(map.height());
    }
    return std::move(out.bytes);
  } catch (const std::exception& error) {
    throw InputError(name + ": cannot be written (" + line(error) + ")");
  }
}

}  // namespace exemplar
