// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <optional>
#include <string>

#include "engine/comparison.h"
#include "engine/source.h"
#include "measure/terrain.h"

/// Engines compared on a height map: by heights, with the ruler of terrain.
namespace exemplar {

/// One run, for people.
struct ComparedTerrain {
  std::string engine;
  std::uint64_t seed = 0;
  std::string status, why;  ///< as in `ComparedRun`
  double seconds = 0;
  TerrainLikeness likeness;  ///< where it is complete
};

/// Runs every engine with every seed; measures, draws and writes each result into the folder:
/// heights as .tif and relief beside the example's as .png; the first three seeds of each engine as
/// ENGINE-seeds.png, and all first seeds together, at one scale, as compare.png; the whole, with
/// how far seeds are apart (`distanceBetween`), as compare.json and report.html. Nothing is taken
/// from what the folder holds. `terrain` works on the heights, `layered` on a picture of them from
/// the lowest to the highest; engines on distances on a volume of the example, as `reading` samples
/// it, and are measured at its resolution, against the example at that resolution. Others refuse
/// it. `picture` says how large pictures are, and gets the warnings of what was read. Throws
/// `InputError` and `Cancelled`.
void compareTerrain(const Source& source, const ReadOptions& reading,
                    const ComparisonOptions& options,
                    const std::function<void(const ComparedTerrain&)>& finished = {},
                    const Progress& progress = {});

}  // namespace exemplar
