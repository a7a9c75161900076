// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "synth/surface/coordinates.h"
#include "synth/surface/plane.h"
#include "synth/surface/sheet.h"

namespace exemplar::surface {

/// A geodesic disc of a sheet, laid out flat in the example's plane: where a placement of the
/// example can be.
struct LocalMap {
  static constexpr std::uint32_t kNowhere = 0xffffffff;

  std::uint32_t seed = 0;
  std::vector<std::uint32_t> nodes;  ///< ascending
  std::vector<Vec2d> at;             ///< their places, samples of the example; the seed's is near 0
  std::vector<std::uint8_t> turns;   ///< of the direction named there against the map's
  /// Whether all triangles around a node are in the map, none of them singular or turned over: only
  /// such nodes can show it.
  std::vector<std::uint8_t> inner;
  double radius = 0;  ///< samples

  /// The number of a node in the map, or `kNowhere`.
  std::uint32_t find(std::uint32_t node) const;
};

struct LocalMapOptions {
  double sample = 1;        ///< length of one on the surface where its size is 1, > 0
  double radius = 12;       ///< samples, > 0; no map is larger
  double leastRadius = 12;  ///< samples, > 0; nor smaller for the sake of `stretch`
  /// Nearly all of a map (95 %, either way) is stretched by no more than this, and by no less than
  /// `shrink`.
  double stretch = 1.15, shrink = 0.87;
};

/// What of a map is stretched by how much: singular values of its Jacobian, with areas.
struct StretchShare {
  double least = 1, most = 1, area = 0;
};

/// Makes maps of one sheet, any number of them at once; each is a function of its seed alone.
///
/// A disc is what Dijkstra's algorithm reaches; directions are combed along its tree, and an edge
/// across which they, or the phases, do not meet is cut, which happens behind a singularity or a
/// dislocation as seen from the seed. Periodic coordinates are added up along the tree, and do not
/// depend on the way; of others the map is the least-squares one with the field's gradients.
class LocalMapper {
 public:
  LocalMapper(const Sheet& sheet, const Coordinates& coordinates, const LocalMapOptions& options)
      : sheet_(sheet), coordinates_(coordinates), options_(options) {}

  LocalMap map(std::uint32_t seed, std::vector<StretchShare>* stretch = nullptr) const;

  /// The nodes within `distance` along edges, with their distances, nearest first: in world units
  /// where the example's size is 1, elsewhere in its size.
  std::vector<std::pair<std::uint32_t, double>> near(std::uint32_t seed, double distance) const;

  /// Whether what two nodes of a map, joined by an edge, have there is what the edge adds: else
  /// there is a cut between them.
  bool joined(const LocalMap& map, std::uint32_t a, std::uint32_t b, const Sheet::Link& link) const;

  const Sheet& sheet() const { return sheet_; }
  const Coordinates& coordinates() const { return coordinates_; }
  const LocalMapOptions& options() const { return options_; }

 private:
  const Sheet& sheet_;
  const Coordinates& coordinates_;
  LocalMapOptions options_;
};

}  // namespace exemplar::surface
