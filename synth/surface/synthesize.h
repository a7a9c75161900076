// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/origin.h"
#include "core/origin_map.h"
#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"
#include "synth/surface/band.h"
#include "synth/surface/coordinates.h"
#include "synth/surface/placements.h"
#include "synth/surface/sheet.h"
#include "synth/surface/slab.h"
#include "synth/surface/unrolled.h"

namespace exemplar::surface {

struct SurfaceOptions {
  /// Length of the example's longest side on the surface, world units, > 0; a quarter of the
  /// diagonal of the surface's box.
  std::optional<double> span;
  std::uint64_t seed = 0;
  /// What is below the example: where its ground is solid and the surface closed, the inside;
  /// else nothing.
  std::optional<Base> base;
  /// The closed surface that an open one is a part of, for its inside as `base`: all of it is in
  /// the result then, as it is where the example is not.
  std::optional<TriangleMesh> body;
  double height = 1;            ///< of the example, of its own, 0.05..20
  std::optional<int> symmetry;  ///< turns that the example allows, 1, 2, 4 or 6; found
  /// A direction in space that the example's y follows; where it has no turns, z; where it has half
  /// turns and does not repeat, `leastCurvature`.
  std::optional<Vec3d> along;
  bool leastCurvature = false;  ///< follow the way in which the surface bends least instead
  bool smoothest = false;       ///< no direction is followed, even where the example has no turns
  /// Lines that the example's y follows, in the surface's coordinates.
  std::vector<std::vector<Vec3d>> strokes;
  /// The example's size at each of the surface's vertices, of its own, > 0; empty: 1 everywhere.
  /// Made smaller where it changes too fast for the example to follow.
  std::vector<double> sizes;
  double stretch = 1.15;  ///< of nearly all of a placement, at most; 1.02..2
  /// How many pieces of the result are laid flat again, to be compared with the example; >= 0.
  int patches = 0;
  /// Steps after which the example repeats, samples; see `findRepetition`.
  std::vector<Vec3d> repetition;
};

/// What a run was like.
struct SurfaceFigures {
  std::int64_t nodes = 0, singularities = 0, dislocations = 0, placements = 0, bandSamples = 0;
  int symmetry = 1, periods = 0;
  double stretch05 = 1, stretch95 = 1;  ///< 5 % of the area is stretched less, 5 % more
  double disagreement = 0;              ///< of a placement with what was there, median, samples
  double seamShare = 0;                 ///< of the edges between nodes
  double seamCost = 1;                  ///< after cuts, of before
  /// The share of the area where the example's height times the curvature is above 0.8: in folds it
  /// is cut there, on ridges drawn apart.
  double steepShare = 0;
  bool closed = true;  ///< the surface
  Base base = Base::None;
  std::vector<Vec3d> singularPlaces;
  std::vector<std::pair<std::string, double>> seconds;  ///< by stage
};

struct SurfaceResult {
  DistanceField field;
  Origins origins;  ///< the nearest sample of the example, for each in the band
  std::shared_ptr<const OriginMap> originMap;
  SurfaceFigures figures;
  Unrolled unrolled;  ///< where patches were asked for
};

/// Lays an example on a surface: "geometry synthesis over arbitrary topology surfaces" (Lagae,
/// Dumont, Dutré 2004, section 7).
///
/// The surface is cut finely (`Sheet`), gets a field of directions (`smoothestField`) and, along
/// what repeats, phases (`integrate`). Discs of it are laid out flat (`LocalMapper`), the example
/// is placed on them one by one (`place`), seams are cut where both sides agree best (`cutSeams`),
/// and space around the surface asks its nearest point what the example has there (`fillBand`).
///
/// `example` lies flat: z is the height over a surface, air is above, x and y go on. `on` is a
/// manifold, oriented mesh; open only with a `body` or without a `base`. Throws `InputError` for
/// what cannot be, and `Cancelled`. The same bytes at any number of threads.
SurfaceResult synthesizeOnSurface(const DistanceField& example, const TriangleMesh& on,
                                  const SurfaceOptions& options = {},
                                  const Progress& progress = {});

}  // namespace exemplar::surface
