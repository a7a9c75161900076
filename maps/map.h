// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/warnings.h"
#include "maps/grid.h"

/// Maps: rectangles of several channels, seen from above. A texture, a height map, a scanned
/// material's set of pictures. Never voxels.
namespace exemplar {

/// One picture of a map: planes of the same size.
struct MapLayer {
  std::string name;  ///< "color", "normal", "height", "metallic"; what files are named by
  /// 1 (gray) or 3 (red, green, blue) planes of values 0..1, as the file holds them: sRGB where it
  /// is color.
  std::vector<Grid<float>> planes;
  int bits = 8;  ///< of a sample in the file, 8 or 16: what it is written with
};

/// Aligned pictures of one surface; the first is the one that is looked at.
struct Map {
  std::vector<MapLayer> layers;

  int width() const { return layers.front().planes.front().width(); }
  int height() const { return layers.front().planes.front().height(); }
  /// All planes of all pictures, in their order.
  std::vector<const Grid<float>*> planes() const;
};

/// A picture (the bytes of a `.png` of any depth, or of a `.jpg`) as one layer of a map. `file` is
/// what errors call it. Opacity is dropped with a warning unless it is 1 everywhere. Throws
/// `InputError`.
MapLayer decodeMapLayer(std::string_view bytes, const std::string& file, const std::string& name,
                        Warnings* warnings = nullptr);
/// The same from a file.
MapLayer readMapLayer(const std::filesystem::path& path, const std::string& name,
                      Warnings* warnings = nullptr);

/// The same of a picture that says where something is, a mask or a layer map: one that is not
/// opaque everywhere is refused, because it does not say what lies under what is clear.
MapLayer readOpaqueMapLayer(const std::filesystem::path& path, const std::string& name);

/// Writes a layer as a `.png` of its own depth, whole or not at all. Throws `InputError`.
void writeMapLayer(const std::filesystem::path& path, const MapLayer& layer);

}  // namespace exemplar
