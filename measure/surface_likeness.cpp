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

}  // namespace

SurfaceLikeness surfaceLikeness(std::span<const Array3D<float>> patches,
                                const Array3D<float>& example, int turns,
                                const Progress& progress) {
  if (patches.empty()) throw InputError("there are no patches to compare with the example");
  if (turns != 1 && turns != 2 && turns != 4)
    throw InputError("an example is turned 1, 2 or 4 times in once around");
  for (const Array3D<float>& patch : patches)
    if (!hasInteriorWindows(patch.size()))
      throw InputError("the patches have no room for a window of 11 samples");
  std::vector<Array3D<float>> turned;
  for (int k = 0; k < 4; k += 4 / turns) turned.push_back(turnedGrid(example, k));
  const Occupancy examples = sideBySide(turned), all = sideBySide(patches);

  PatchLikenessOptions options;
  options.border = WindowBorder::Interior;
  SurfaceLikeness result;
  double alike = 0, iou = 0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const PatchLikeness one = patchLikeness(
        sideBySide(patches.subspan(p, 1)), examples, options,
        progress.part(0.7 * static_cast<double>(p) / static_cast<double>(patches.size()),
                      0.7 * static_cast<double>(p + 1) / static_cast<double>(patches.size())));
    result.windows += one.windows;
    alike += one.share * static_cast<double>(one.windows);
    iou += one.meanIou * static_cast<double>(one.windows);
  }
  if (result.windows > 0) {
    result.likeness = alike / static_cast<double>(result.windows);
    result.meanIou = iou / static_cast<double>(result.windows);
  }
  result.coverage =
      patchLikeness(sideBySide(std::span(turned).first(1)), all, options, progress.part(0.7, 1))
          .share;
  return result;
}

}  // namespace exemplar
