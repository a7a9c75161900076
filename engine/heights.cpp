// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/heights.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "maps/height_map_file.h"

namespace exemplar {
namespace {

/// Whether a file holds integers, and nothing says what they stand for.
bool needsScale(const Source& source) {
  if (!holdsIntegers(source.path())) return false;
  std::error_code error;
  return source.inMemory<std::string>() ||
         !std::filesystem::exists(heightSidecarPath(source.path()), error);
}

}  // namespace

std::vector<HeightMap> readHeightsAlike(std::span<const Source> sources, const ReadOptions& reading,
                                        Warnings& warnings, const Progress& progress) {
  std::vector<HeightMap> maps;
  const auto count = static_cast<double>(sources.size());
  for (const Source& source : sources) {
    HeightMapFileOptions file{reading.cellSize, reading.heightScale, &warnings};
    if (!maps.empty()) {
      file.cellSize.reset();
      if (!needsScale(source)) file.heightScale.reset();
    }
    const auto n = static_cast<double>(maps.size());
    maps.push_back(readHeights(source, file, progress.part(n / count, (n + 1) / count)));
  }
  const auto knows = std::ranges::find(maps, true, &HeightMap::cellSizeKnown);
  const HeightMap& model = knows != maps.end() ? *knows : maps.front();
  const double cell = model.cellSize;
  const bool known = model.cellSizeKnown;
  for (HeightMap& map : maps) {
    if (map.cellSizeKnown) continue;
    map.cellSize = cell;
    map.cellSizeKnown = known;
  }
  return maps;
}

}  // namespace exemplar
