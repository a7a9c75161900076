// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "core/random.h"
#include "maps/boundary_patches.h"
#include "synth/layered/assignment.h"

/// One shape made like another, flat or in space (Rosenberger, Cohen-Or, Lischinski 2009,
/// section 3.2).
namespace exemplar {

/// What the threshold of certainty, below which a cell stays as it is, is chosen by.
enum class CertaintyKind {
  Boundary,  ///< the length of the boundary; the area is set afterward, exactly
  Area,      ///< the area, as in the paper
};

struct ShapeOptions {
  int patch = 15;       ///< cells a side of a boundary patch, odd, 5..31; on every level
  int levels = 5;       ///< resolutions, each half the one before, 1..7
  int iterations = 10;  ///< on each level, at most, 1..50
  /// A level ends where fewer cells change than this share of those on the boundary.
  double settled = 0.01;
  int turns = 4;  ///< orientations of patches: 1, 2 (0 and 180 degrees), 4, or 8 (mirrored)
  AssignmentKind assignment = AssignmentKind::Greedy;
  CertaintyKind certainty = CertaintyKind::Boundary;
  /// Patches are compared by the layer below, too, at half weight, so that layers go together in
  /// every iteration and not at the start alone.
  bool joint = false;
  bool exampleWraps = false;  ///< the example tiles
};

/// A layer of the example at one resolution, and what a shape like it must have.
struct ShapeExample {
  Shape shape;
  BoundaryPatches patches;  ///< around its boundary
  double area = 0;          ///< share of cells inside
  double boundary = 0;      ///< share of cells on the boundary
  /// Components of what is inside, and of what is not: cells of the smallest, how many there are
  /// for each cell of the example, and how far, in cells, one of their cells lies at most from what
  /// is not of them (infinite where there is nothing else).
  struct Components {
    std::uint32_t smallest = 0;
    double perCell = 0;
    float deepest = 0;

    /// How many a shape of so many cells may have.
    std::size_t mostIn(std::size_t cells) const;
  } inside, outside;
};
/// At most so many boundary patches of an example are used, drawn at random from all.
inline constexpr std::size_t kMostExamplePatches = 6000;
/// Patches that lean over the example's border are left out while a quarter remains without them.
/// `below`: the layer that is compared, too; may be null. `unknown`: where the example is not
/// known; patches that touch it are left out, and neither area nor boundary counts it; may be null.
ShapeExample shapeExample(const Shape& shape, const Shape* below, const Shape* unknown,
                          const ShapeOptions& options, const Random& random);
/// Boundary cells of an example whose patches serve: as `shapeExample` says.
std::vector<Vec3i> servingCenters(std::vector<Vec3i> all, const Vec3i& size, const Shape* unknown,
                                  const ShapeOptions& options, const Random& random);

/// Where boundary patches lie in a result, and which patches of the example they were given.
struct PlacedPatches {
  std::vector<Vec3i> boundary;
  std::vector<BoundaryMatch> matches;  ///< one for each
};
/// Of a large boundary in space the patches of every fourth cell are matched; they cover it many
/// times over.
std::vector<Vec3i> matchedCenters(std::vector<Vec3i> boundary, const Vec3i& size);

/// What pasted patches say of each cell: the weights that say inside and outside.
struct PatchVotes {
  Array3D<float> inside, outside;

  float weight(std::size_t p) const { return inside.data()[p] + outside.data()[p]; }
  /// The share that says inside; 1/2 where nothing says anything.
  float share(std::size_t p) const { return weight(p) > 0 ? inside.data()[p] / weight(p) : 0.5f; }
  /// The median of the weights of some cells.
  float medianWeight(std::span<const Vec3i> cells) const;
};
/// Pastes for each match the patch of `shape` (the example's layer, or the one above it) where it
/// was placed on a torus of this size, weighted by 1 / (1 + distance) and a Gaussian of half a
/// patch (equation 4).
PatchVotes votesOf(const Shape& shape, const BoundaryPatches& patches, const PlacedPatches& placed,
                   const Vec3i& size, bool exampleWraps);
/// Calls `say(cell, from, weight)` for each cell of each pasted patch: the indices of the result's
/// cell and of the example's, and the weight of equation 4.
template <class Say>
void forEachPasted(const BoundaryPatches& patches, const PlacedPatches& placed, const Vec3i& size,
                   const Vec3i& exampleSize, bool exampleWraps, Say&& say);

/// What a shape must respect, beside its likeness; null where it need not.
struct ShapeLimits {
  const Shape* mask = nullptr;   ///< the shape stays inside: the layer below, less what it says
  const Shape* open = nullptr;   ///< only these cells change
  const Shape* below = nullptr;  ///< the result's layer below, to compare jointly
  std::optional<std::int64_t> target;  ///< cells inside, in place of the example's share
  std::optional<double> boundary;      ///< cells on the boundary, in place of the example's share
};

/// Adds cells along the contour (those that votes want most first), or takes them away, until
/// exactly `target` are inside; where there is no contour, from the cell that they want most.
/// Outside the mask nothing is added. Returns whether that could be.
bool setArea(Shape& shape, std::int64_t target, const PatchVotes& votes, const ShapeLimits& limits,
             const Random& random);

/// A shape on a torus, with what it was made by last.
struct OptimizedShape {
  Shape shape;
  PlacedPatches placed;
  int iterations = 0;
  bool dealtExactly = true;  ///< in all of them
};
/// Changes `start` until its boundary looks like the example's at this resolution: matching and
/// voting in turns. Its area becomes the example's share; of several thresholds of certainty below
/// which a cell stays as it is, that is taken which gives the example's share of boundary.
///
/// The paper chooses that threshold by area alone (`CertaintyKind::Area`). Area does not pin it
/// down, so holes multiply or nothing changes; here the threshold serves the boundary's length and
/// area is kept apart. O(boundary x example's boundary) for each iteration. The same at any number
/// of threads. Throws `Cancelled`.
OptimizedShape optimizeShape(Shape start, const ShapeExample& example, const ShapeLimits& limits,
                             const ShapeOptions& options, const Random& random,
                             const Progress& progress = {});

/// The share of a shape's cells that it should have inside: `target`, or the example's share of the
/// cells that may change and the others as they are.
std::int64_t wantedCells(const Shape& shape, double share, const ShapeLimits& limits);

template <class Say>
void forEachPasted(const BoundaryPatches& patches, const PlacedPatches& placed, const Vec3i& size,
                   const Vec3i& exampleSize, bool exampleWraps, Say&& say) {
  const int side = patches.side(), half = side / 2, halfDepth = patchDepth(size, side) / 2;
  std::vector<float> falloff;
  const double sigma = side / 2.0;
  for (int dz = -halfDepth; dz <= halfDepth; ++dz)
    for (int dy = -half; dy <= half; ++dy)
      for (int dx = -half; dx <= half; ++dx)
        falloff.push_back(
            static_cast<float>(std::exp(-(dx * dx + dy * dy + dz * dz) / (2 * sigma * sigma))));
  const auto box = [](const Vec3i& s) {
    return [s](const Vec3i& p) {
      return (static_cast<std::size_t>(p.z) * s.y + p.y) * s.x + static_cast<std::size_t>(p.x);
    };
  };
  const auto at = box(size), from = box(exampleSize);
  for (std::size_t s = 0; s < placed.boundary.size(); ++s) {
    const BoundaryMatch& match = placed.matches[s];
    const float certainty = 1.0f / (1.0f + static_cast<float>(match.distance));
    const int symmetry = patches.symmetry(match.turn);
    const Vec3i along = turnedAboutZ({1, 0, 0}, symmetry);
    std::size_t n = 0;
    for (int dz = -halfDepth; dz <= halfDepth; ++dz) {
      for (int dy = -half; dy <= half; ++dy) {
        Vec3i source = patches.center(match.patch) + turnedAboutZ({-half, dy, dz}, symmetry);
        Vec3i to = wrappedPlace(placed.boundary[s] + Vec3i{-half, dy, dz}, size);
        for (int dx = -half; dx <= half; ++dx, ++n, source += along) {
          Vec3i known = source;
          if (exampleWraps) known = wrappedPlace(source, exampleSize);
          const bool inside = known.x >= 0 && known.y >= 0 && known.z >= 0 &&
                              known.x < exampleSize.x && known.y < exampleSize.y &&
                              known.z < exampleSize.z;
          if (inside) say(at(to), from(known), certainty * falloff[n]);
          if (++to.x == size.x) to.x = 0;
        }
      }
    }
  }
}

}  // namespace exemplar
