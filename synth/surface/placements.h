// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "synth/surface/local_map.h"
#include "synth/surface/slab.h"

namespace exemplar::surface {

/// A disc of the surface and the part of the example that lies on it.
struct Placement {
  LocalMap map;
  int turn = 0;               ///< of the example against the map, in turns of the symmetry
  std::vector<Vec2d> source;  ///< of each of the map's nodes: its place in the example, samples
  double disagreement = 0;    ///< with what was there before, mean, in samples, 0..4
  bool met = false;           ///< whether anything was there before
};

/// Placements that cover a sheet, and which of them each node shows.
struct Placements {
  static constexpr std::uint32_t kNone = 0xffffffff;

  /// That a node is in a placement's map, and where.
  struct Membership {
    std::uint32_t placement = 0, number = 0;  ///< in `Placement::map.nodes`
    bool possible = false;                    ///< the node can show it
  };
  std::vector<Placement> all;
  std::vector<std::uint32_t> owner;  ///< n: what each node shows

  std::span<const Membership> at(std::uint32_t node) const {
    return {members_.data() + begin_[node], begin_[node + 1] - begin_[node]};
  }
  /// The membership of a node in a placement, or null.
  const Membership* find(std::uint32_t node, std::uint32_t placement) const;
  /// Its number among all, from 0.
  std::size_t numberOf(const Membership& m) const {
    return static_cast<std::size_t>(&m - members_.data());
  }
  std::size_t memberships() const { return members_.size(); }

  /// Finds who is where; whenever maps or sources have changed.
  void index(std::size_t nodes, const Slab& slab);

 private:
  std::vector<Membership> members_;  // by node, then placement
  std::vector<std::uint32_t> begin_;
};

struct PlacementOptions {
  std::uint64_t seed = 0;
  double spacing = 0.75;  ///< of the maps' middles, in radii: 0.3..1
  double use = 0.15;      ///< price of a part of the example used twice its share, samples; >= 0
  SlabSymmetry symmetry;
};

/// Covers a sheet with maps about Poisson discs apart and lays the example on them one after
/// another, outward from the first: each from where it agrees best with what nodes show already
/// (Praun, Finkelstein, Hoppe: "Lapped textures", SIGGRAPH 2000, for the covering; Efros and
/// Freeman 2001 for the choice). Along periods of the example only whole periods are tried, so that
/// all placements stay in step; elsewhere every sample, and halves of one at the end.
///
/// Costs placements x places x 400 columns. The same bytes at any number of threads. Throws
/// `Cancelled`.
Placements place(const LocalMapper& mapper, const Slab& slab, const PlacementOptions& options,
                 std::vector<StretchShare>* stretch = nullptr, const Progress& progress = {});

}  // namespace exemplar::surface
