// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <vector>

#include "core/progress.h"
#include "core/random.h"
#include "maps/boundary_patches.h"
#include "synth/layered/assignment.h"

/// One shape made like another (Rosenberger, Cohen-Or, Lischinski 2009, section 3.2).
namespace exemplar {

struct ShapeOptions {
  int patch = 15;          ///< pixels a side of a boundary patch, odd, 9..31; on every level
  int levels = 5;          ///< resolutions, each half the one before, 1..7
  int iterations = 10;     ///< on each level, at most, 1..50
  double settled = 0.002;  ///< a level ends where less than this share of the pixels changes
  int turns = 4;  ///< orientations of patches: 1, 2 (0 and 180 degrees), 4, or 8 (mirrored)
  AssignmentKind assignment = AssignmentKind::Greedy;
  bool exampleWraps = false;  ///< the example tiles
};

/// A layer of the example at one resolution, and what a shape like it must have.
struct ShapeExample {
  Shape shape;
  BoundaryPatches patches;  ///< around its boundary
  double area = 0;          ///< share of pixels inside
  double boundary = 0;      ///< share of pixels on the boundary
  /// Pixels of the smallest component inside, and outside.
  std::uint32_t smallestInside = 0, smallestOutside = 0;
};
/// At most so many boundary patches of an example are used, drawn at random from all.
inline constexpr std::size_t kMostExamplePatches = 6000;
/// Patches that lean over the example's border are left out while a quarter remains without them.
ShapeExample shapeExample(const Shape& shape, const ShapeOptions& options, const Random& random);

/// Where boundary patches lie in a result, and which patches of the example they were given.
struct PlacedPatches {
  std::vector<Pixel> boundary;
  std::vector<PatchMatch2D> matches;  ///< one for each
};

/// What pasted patches say of each pixel: the weights that say inside and outside.
struct PatchVotes {
  Grid<float> inside, outside;

  float weight(std::size_t p) const { return inside[p] + outside[p]; }
  /// The share that says inside; 1/2 where nothing says anything.
  float share(std::size_t p) const { return weight(p) > 0 ? inside[p] / weight(p) : 0.5f; }
  /// The median of the weights of some pixels.
  float medianWeight(std::span<const Pixel> pixels) const;
};
/// Pastes for each match the patch of `shape` (the example's layer, or the one above it) where it
/// was placed on a torus of this size, weighted by 1 / (1 + distance) and a Gaussian of half a
/// patch (equation 4).
PatchVotes votesOf(const Shape& shape, const BoundaryPatches& patches, const PlacedPatches& placed,
                   int width, int height, bool exampleWraps);

/// Adds pixels along the contour (those that votes want most first), or takes them away, until
/// exactly `target` are inside; outside `mask`, where there is one, nothing is added. Returns
/// whether that could be.
bool setArea(Shape& shape, std::int64_t target, const PatchVotes& votes, const Shape* mask,
             const Random& random);

/// A shape on a torus, with what it was made by last.
struct OptimizedShape {
  Shape shape;
  PlacedPatches placed;
  int iterations = 0;
};
/// Changes `start` until its boundary looks like the example's at this resolution: matching and
/// voting in turns. Its area becomes the example's share; of several thresholds of certainty below
/// which a pixel stays as it is, that is taken which gives the example's share of boundary.
///
/// The paper chooses that threshold by area alone. Area does not pin it down, so holes multiply or
/// nothing changes; here the threshold serves the boundary's length and area is kept apart.
/// O(boundary x example's boundary) for each iteration. The same at any number of threads. Throws
/// `Cancelled`.
OptimizedShape optimizeShape(Shape start, const ShapeExample& example, const Shape* mask,
                             const ShapeOptions& options, const Random& random,
                             const Progress& progress = {});

}  // namespace exemplar
