// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <vector>

#include "core/progress.h"
#include "maps/grid.h"

/// What of a map of heights is a copy. Both look at the second difference (the Laplacian) of
/// heights, which stays the same when a piece is raised, tilted, or bent smoothly to meet its
/// neighbors, and both look for copies in all eight orientations of the grid.
namespace exemplar {

/// h(east) + h(west) + h(north) + h(south) - 4 h; NaN at the border and where one of them is.
Grid<float> laplacian(const Grid<float>& heights);
/// Means over 3 x 3 cells; NaN at the border and where one of them is.
Grid<float> smoothed3x3(const Grid<float>& values);

/// Of windows of 24 x 24 cells of the result, up to 150 on an even lattice, the share that occurs
/// in the example: somewhere in it, in one of eight orientations, a window of the same size has a
/// Laplacian that differs by less than a third of its own, root mean square (at most a sixth of the
/// squares in its 16 strongest cells). Flat windows, and ones
/// with holes, are passed over. Nothing where no window is left or a map is smaller than one. The
/// number of windows is lowered, to 24 at least, where the example is large. Not seen: copies that
/// are turned by other angles, or scaled. Throws `Cancelled`.
std::optional<double> verbatimShare(const Grid<float>& example, const Grid<float>& result,
                                    const Progress& progress = {});

/// Peaks: the cells that are highest within 8 cells (the first of equal ones), not within 13 cells
/// of the border or of a hole.
struct Peak {
  Pixel at;
  float prominence = 0;  ///< above the mean at a distance of 8 cells
};
/// The `most` most prominent, in that order.
std::vector<Peak> prominentPeaks(const Grid<float>& heights, std::size_t most);

/// Of up to 400 most prominent peaks, the share whose surroundings occur at another one of them:
/// the Laplacians within 9 cells, smoothed over 3 x 3, correlate at 0.75 or more in one of eight
/// orientations, when moved by up to 2 cells. Nothing for fewer than two peaks. Throws `Cancelled`.
std::optional<double> repeatedPeaks(const Grid<float>& heights, const Progress& progress = {});

}  // namespace exemplar
