// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/array3d.h"
#include "core/origin.h"
#include "core/progress.h"
#include "core/vec.h"
#include "preview/camera.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// A place of a result where it shows that it was put together.
struct Mark {
  enum class Kind {
    Seam,    ///< a seam that jumps much
    Repeat,  ///< a part of the example that occurs in the result more often than others
    Copy,    ///< a large part of the example taken over as it is
  };
  Kind kind = Kind::Seam;
  int group = 0;     ///< the same for all places of one repeated part; from 0
  Vec3d position{};  ///< on the surface, world units
  /// Seam: the largest jump, voxels. Repeat: how often the part occurs in the result, over how
  /// often the example's surface does on average. Copy: its surface over the example's.
  double value = 0;
  /// Where the picture shows it: 0..1 from the left and from the top; nothing where all of it is
  /// hidden.
  std::optional<std::array<double, 2>> at;
  std::vector<std::array<double, 2>> outline;  ///< around what is seen of it: convex, in order
};

struct MarkOptions {
  int seams = 6;            ///< the most marks of this kind
  int repeats = 2;          ///< the most repeated parts
  int places = 8;           ///< the most places of each of them
  int copies = 3;           ///< the most marks of this kind
  double leastJump = 1;     ///< voxels, from which a seam counts
  double leastRepeat = 2;   ///< times the average use, from which a part counts
  double leastCopy = 0.05;  ///< share of the example's surface, from which a copy counts
};

/// Finds what to look at in a result: by kind, the worst first; seams and places that the
/// camera sees before those that it does not. Only the surface counts: solid
/// samples with an empty one at a face.
///
/// Seams: the surface is cut into cells of 6 samples a side; the cells with most jump, none beside
/// another. Repeats: the example's surface in cells of 8 samples a side, and wherever a quarter of
/// such a cell or more occurs in the result by one motion. Copies: the connected regions of one
/// motion (`verbatimRun`) with most surface.
///
/// `jumps` is `seamJumps` of both. O(samples log samples), deterministic. Throws `InputError` for
/// origins or jumps that do not fit, and `Cancelled`. Origins in other examples than number
/// `exampleIndex` count for copies alone.
std::vector<Mark> findMarks(const DistanceField& example, const DistanceField& result,
                            const Origins& origins, const Array3D<float>& jumps,
                            const Camera& camera, const MarkOptions& options = {},
                            int exampleIndex = 0, const Progress& progress = {});

/// The smallest convex polygon around points, anticlockwise where y points up, from the lowest x;
/// of fewer than three corners where the points are in a line.
std::vector<std::array<double, 2>> convexHull(std::vector<std::array<double, 2>> points);

}  // namespace exemplar
