// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/array3d.h"
#include "core/origin.h"
#include "core/origin_map.h"
#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "reconstruct/transfer.h"
#include "sdf/distance_field.h"
#include "sdf/example_surface.h"

namespace exemplar {

/// A place of an example that a point of the result may have come from.
struct Match {
  OriginMotion motion;  ///< of an `OriginMap`'s part: (its number, 0, 0) as the shift
  SurfacePoint point;   ///< the nearest on the example's surface
  double cost = 0;      ///< its distance and how much it faces away, in voxels of the example
  double weight = 0;    ///< 0..1; all matches of a point together have 1
};

/// The matches of one point, heaviest first; few, so they live on the stack.
struct Matches {
  static constexpr int kMost = 12;
  std::array<Match, kMost> match;
  int count = 0;

  const Match* begin() const { return match.data(); }
  const Match* end() const { return match.data() + count; }
};

/// Throws `InputError` unless there is an origin for each sample of the field, all of them naming
/// examples that are there.
void checkOrigins(const DistanceField& field, const Origins& origins,
                  std::span<const ExampleView> examples);

/// Pulls points of a result back to the examples through its origins. Immutable; borrows its
/// arguments.
class OriginPullView {
 public:
  static constexpr double kAnywhere = std::numeric_limits<double>::infinity();

  /// `blend`: within how many voxels samples count. `map`, where there is one, says where points
  /// came from in place of the origins. Throws `InputError`, and `Cancelled`.
  OriginPullView(const DistanceField& field, const Origins& origins,
                 std::span<const ExampleView> examples, double blend,
                 const OriginMap* map = nullptr, const Progress& progress = {});

  /// Where `position` (world) of the result, with unit normal `normal` or zero, may have come from;
  /// places farther than `radius` voxels from the example's surface do not count.
  void match(const Vec3d& position, const Vec3d& normal, Matches& out,
             double radius = kAnywhere) const;

  /// The nearest point of an example's surface under a given motion, with its cost in voxels;
  /// `groups` as in `ClosestOptions`. Nothing where the group has no triangle within `radius`
  /// voxels.
  std::optional<Match> matchUnder(const OriginMotion& motion, const Vec3d& position,
                                  const Vec3d& normal, std::span<const std::uint32_t> groups = {},
                                  std::uint32_t group = 0, double radius = kAnywhere) const;

 private:
  /// Weights by how near the places are, and the heaviest first.
  static void weigh(Matches& matches, double best);
  void matchMapped(const Vec3d& position, const Vec3d& normal, Matches& out, double radius) const;
  std::optional<Match> nearest(const OriginMotion& motion, const Vec3d& index, const Vec3d& normal,
                               double radius, std::span<const std::uint32_t> groups,
                               std::uint32_t group) const;

  const DistanceField& field_;
  const Origins& origins_;
  std::span<const ExampleView> examples_;
  const OriginMap* map_;
  double reach_;
  std::vector<ExampleSurface> surfaces_;
  Array3D<std::uint8_t> mixed_;  ///< where several motions may be within reach
};

}  // namespace exemplar
