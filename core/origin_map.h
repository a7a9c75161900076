// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/vec.h"

namespace exemplar {

/// Where points of a result came from, where its parts were bent: not by one shift and turn for
/// each sample (`OriginMotion`), but by one map for each part. Immutable; any number of threads may
/// ask.
class OriginMap {
 public:
  /// A part of the result that may have a point, and how much of it, 0..1.
  struct Candidate {
    std::uint32_t part = 0;
    double weight = 0;
  };
  /// A place in the example, and what directions there are.
  struct Place {
    Vec3d index;                  ///< of the example's samples, fractional
    std::array<Vec3d, 3> rows{};  ///< a direction d of the result is (rows[0] · d, ...) there

    Vec3d direction(const Vec3d& d) const {
      return {dot(rows[0], d), dot(rows[1], d), dot(rows[2], d)};
    }
  };

  virtual ~OriginMap() = default;
  /// The parts at a point (world) of the result, heaviest first.
  virtual void candidates(const Vec3d& position, std::vector<Candidate>& out) const = 0;
  /// Where a part has a point; nothing where it is not there.
  virtual std::optional<Place> place(std::uint32_t part, const Vec3d& position) const = 0;
};

}  // namespace exemplar
