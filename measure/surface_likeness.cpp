// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/surface_likeness.h"

#include <vector>

#include "core/cells.h"
#include "core/error.h"
#include "core/origin.h"
#include "measure/occupancy.h"
#include "measure/patch_likeness.h"

namespace exemplar {
namespace {

/// Solid cells of several grids side by side along x. Windows across their joints are like nothing,
/// so they may be references, but must not be asked for.
Occupancy sideBySide(std::span<const Array3D<float>> grids) {
  Vec3i size{0, 0, 0};
  for (const Array3D<float>& grid : grids)
    size = {size.x + grid.size().x, std::max(size.y, grid.size().y),
            std::max(size.z, grid.size().z)};
  Array3D<std::uint8_t> cells(size);
  int at = 0;
  for (const Array3D<float>& grid : grids) {
    forEachCell(grid.size(), [&](const Vec3i& p) { cells[p + Vec3i{at, 0, 0}] = grid[p] < 0; });
    at += grid.size().x;
  }
  return Occupancy(cells);
}

/// Every nth place along x and y of a patch, from one on.
Array3D<float> gridOf(const Array3D<float>& patch, int perSample, int x, int y) {
  const Vec3i& size = patch.size();
  Array3D<float> grid(
      {(size.x - x + perSample - 1) / perSample, (size.y - y + perSample - 1) / perSample, size.z});
  forEachCell(grid.size(), [&](const Vec3i& p) {
    grid[p] = patch[{x + perSample * p.x, y + perSample * p.y, p.z}];
  });
  return grid;
}

/// The grid of a patch that is most like the example, by a few windows.
Array3D<float> alignedGrid(const Array3D<float>& patch, int perSample, const Occupancy& examples,
                           const Progress& progress) {
  PatchLikenessOptions options;
  options.border = WindowBorder::Interior;
  options.windows = options.averaged = 8;
  Array3D<float> best;
  double highest = -1;
  for (int y = 0; y < perSample; ++y) {
    for (int x = 0; x < perSample; ++x) {
      Array3D<float> grid = gridOf(patch, perSample, x, y);
      const double iou =
          perSample == 1
              ? 1
              : patchLikeness(sideBySide({&grid, 1}), examples, options, progress).meanIou;
      if (iou <= highest) continue;
      highest = iou;
      best = std::move(grid);
    }
  }
  return best;
}

}  // namespace

SurfaceLikeness surfaceLikeness(std::span<const Array3D<float>> patches, int perSample,
                                const Array3D<float>& example, int turns,
                                const Progress& progress) {
  if (patches.empty()) throw InputError("there are no patches to compare with the example");
  if (turns != 1 && turns != 2 && turns != 4)
    throw InputError("an example is turned 1, 2 or 4 times in once around");
  if (perSample < 1) throw InputError("patches have one place to a sample, or more");
  for (const Array3D<float>& patch : patches)
    if (!hasInteriorWindows(
            {(patch.size().x - 1) / perSample, (patch.size().y - 1) / perSample, patch.size().z}))
      throw InputError("the patches have no room for a window of 11 samples");
  std::vector<Array3D<float>> turned;
  for (int k = 0; k < 4; k += 4 / turns) turned.push_back(turnedGrid(example, k));
  const Occupancy examples = sideBySide(turned);
  std::vector<Array3D<float>> grids;
  for (const Array3D<float>& patch : patches)
    grids.push_back(alignedGrid(
        patch, perSample, examples,
        progress.part(
            0.5 * static_cast<double>(grids.size()) / static_cast<double>(patches.size()),
            0.5 * static_cast<double>(grids.size() + 1) / static_cast<double>(patches.size()))));
  const Occupancy all = sideBySide(grids);

  PatchLikenessOptions options;
  options.border = WindowBorder::Interior;
  SurfaceLikeness result;
  double alike = 0, iou = 0;
  for (const Array3D<float>& grid : grids) {
    const PatchLikeness one =
        patchLikeness(sideBySide({&grid, 1}), examples, options, progress.part(0.5, 0.8));
    result.windows += one.windows;
    alike += one.share * static_cast<double>(one.windows);
    iou += one.meanIou * static_cast<double>(one.windows);
  }
  if (result.windows > 0) {
    result.likeness = alike / static_cast<double>(result.windows);
    result.meanIou = iou / static_cast<double>(result.windows);
  }
  result.coverage =
      patchLikeness(sideBySide(std::span(turned).first(1)), all, options, progress.part(0.8, 1))
          .share;
  return result;
}

}  // namespace exemplar
