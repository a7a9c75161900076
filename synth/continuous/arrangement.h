// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "synth/continuous/central.h"
#include "synth/continuous/planes.h"

/// The vertices at which planes meet, and how lines join them.
namespace exemplar::continuous {

/// The other end of an edge of the arrangement.
struct EdgeEnd {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::uint32_t vertex = kNone;
  std::uint32_t ray = 0;  ///< of that vertex, back along the edge
};

/// All vertices of planes in a box, with its sides. Vertices are in lexicographic order of
/// position, rays in the order of `Central::rays`. Every line through a vertex goes on to another
/// one, except out of the box.
class Arrangement {
 public:
  /// Throws `InputError` where there would be more than `mostVertices`, and `Cancelled`. Time is
  /// about that of one exact intersection for every triple of planes that meet in the box.
  Arrangement(const PlaneSets& planes, const Centrals& centrals, std::size_t mostVertices,
              const Progress& progress = {});

  const PlaneSets& planes() const { return planes_; }
  const Centrals& centrals() const { return *centrals_; }
  std::size_t vertices() const { return points_.size(); }
  const ExactPoint& point(std::uint32_t v) const { return points_[v]; }
  /// The families with a plane through a vertex, and what they cut its surroundings into.
  Families on(std::uint32_t v) const { return kinds_[kind_[v]]->families; }
  const Central& central(std::uint32_t v) const { return *kinds_[kind_[v]]; }
  /// Vertices through which the same families go have the same kind.
  std::uint32_t kind(std::uint32_t v) const { return kind_[v]; }
  const std::vector<const Central*>& kinds() const { return kinds_; }
  /// The other ends of the edges along each ray.
  std::span<const EdgeEnd> ends(std::uint32_t v) const {
    return {ends_.data() + first_[v], first_[v + 1] - first_[v]};
  }
  /// Whether a vertex is strictly inside the box.
  bool inside(std::uint32_t v) const { return inside_[v] != 0; }
  /// Which plane of a family is the last one not above a vertex, and whether the vertex is on it.
  struct Level {
    int plane = -1;
    bool on = false;
    bool operator==(const Level&) const = default;
  };
  Level level(const ExactPoint& p, std::size_t family) const;

 private:
  void findPoints(std::size_t mostVertices, const Progress& progress);
  void joinLines(const Progress& progress);

  PlaneSets planes_;
  const Centrals* centrals_;
  std::vector<ExactPoint> points_;
  std::vector<std::uint32_t> kind_;
  std::vector<const Central*> kinds_;
  std::vector<std::uint8_t> inside_;
  std::vector<std::size_t> first_;
  std::vector<EdgeEnd> ends_;
};

}  // namespace exemplar::continuous
