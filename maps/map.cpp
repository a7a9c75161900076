// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/map.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/file.h"
#include "mesh/image.h"

namespace exemplar {
namespace {

/// The planes of a picture; what it says beside gray or color is opacity.
template <class Sample>
MapLayer layerOf(const Image<Sample>& image, const std::string& name, bool& transparent) {
  constexpr double kMost = sizeof(Sample) == 1 ? 255 : 65535;
  MapLayer layer;
  layer.name = name;
  layer.bits = 8 * static_cast<int>(sizeof(Sample));
  const int colors = image.channels >= 3 ? 3 : 1;
  layer.planes.assign(static_cast<std::size_t>(colors), Grid<float>(image.width, image.height));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Sample* pixel = image.at(x, y);
      for (int c = 0; c < colors; ++c)
        layer.planes[static_cast<std::size_t>(c)](x, y) = static_cast<float>(pixel[c] / kMost);
      if (image.channels > colors) transparent |= pixel[colors] < kMost;
    }
  }
  return layer;
}

template <class Sample>
Image<Sample> imageOf(const MapLayer& layer) {
  constexpr float kMost = sizeof(Sample) == 1 ? 255 : 65535;
  const auto channels = static_cast<int>(layer.planes.size());
  const int width = layer.planes.front().width(), height = layer.planes.front().height();
  Image<Sample> image{width, height, channels, {}};
  image.pixels.resize(static_cast<std::size_t>(width) * height * channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) {
        const float value = std::clamp(layer.planes[static_cast<std::size_t>(c)](x, y), 0.0f, 1.0f);
        image.at(x, y)[c] = static_cast<Sample>(std::lround(value * kMost));
      }
    }
  }
  return image;
}

/// Whether a PNG has 16 bits a sample (its header's ninth byte of data).
bool isDeep(std::string_view bytes) {
  return bytes.size() > 24 && bytes.starts_with("\x89PNG") && bytes[24] == 16;
}

}  // namespace

std::vector<const Grid<float>*> Map::planes() const {
  std::vector<const Grid<float>*> all;
  for (const MapLayer& layer : layers)
    for (const Grid<float>& plane : layer.planes) all.push_back(&plane);
  return all;
}

MapLayer decodeMapLayer(std::string_view bytes, const std::string& file, const std::string& name,
                        Warnings* warnings) {
  bool transparent = false;
  MapLayer layer = isDeep(bytes) ? layerOf(decodePng16(bytes, file), name, transparent)
                                 : layerOf(decodeImage(bytes, file), name, transparent);
  if (transparent && warnings)
    warnings->push_back(file + ": opacity is not synthesized and was dropped");
  return layer;
}

MapLayer readMapLayer(const std::filesystem::path& path, const std::string& name,
                      Warnings* warnings) {
  return decodeMapLayer(readFile(path), path.string(), name, warnings);
}

MapLayer readOpaqueMapLayer(const std::filesystem::path& path, const std::string& name) {
  Warnings dropped;
  MapLayer layer = readMapLayer(path, name, &dropped);
  if (!dropped.empty()) {
    throw InputError(path.string() +
                     ": is clear in places, which says nothing there; save it without opacity");
  }
  return layer;
}

void writeMapLayer(const std::filesystem::path& path, const MapLayer& layer) {
  if (layer.bits == 16) {
    writePng(path, imageOf<std::uint16_t>(layer));
  } else {
    writePng(path, imageOf<std::uint8_t>(layer));
  }
}

}  // namespace exemplar
