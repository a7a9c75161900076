// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/origin.h"
#include "core/progress.h"
#include "sdf/distance_field.h"
#include "synth/surface/foot.h"
#include "synth/surface/placements.h"
#include "synth/surface/sheet.h"
#include "synth/surface/slab.h"

namespace exemplar::surface {

/// What is below the example.
enum class Base {
  None,   ///< nothing: it is a sheet of its own, of its own thickness
  Under,  ///< the inside of the surface, on which it stands
  Carve,  ///< the inside of the surface, out of which its air is cut
};

/// What placements show on each triangle, mixed within a few samples of a seam.
class SheetContent {
 public:
  struct Part {
    std::uint32_t placement = 0;
    std::array<Vec2d, 3> source;  ///< of the triangle's corners
    std::array<float, 3> weight{};
  };

  /// `mapper` is that of the placements' maps.
  SheetContent(const LocalMapper& mapper, const Placements& placements);

  std::span<const Part> at(std::uint32_t triangle) const {
    return {parts_.data() + begin_[triangle], begin_[triangle + 1] - begin_[triangle]};
  }

 private:
  std::vector<Part> parts_;
  std::vector<std::uint32_t> begin_;
};

/// A closed surface that a sheet is a part of.
struct Body {
  const Sheet& sheet;
  const FootFinder& feet;
};

struct BandOptions {
  double sample = 1;  ///< length of one on the surface where the example's size is 1; > 0
  double voxel = 1;   ///< side of the result's, world units, > 0
  Base base = Base::None;
  double height = 1;  ///< of the example, of its own, > 0
  /// What a base is the inside of where the sheet is open, else null: all of it is in the result,
  /// as it is where the sheet is not.
  const Body* body = nullptr;
};

struct Band {
  DistanceField field;
  Origins origins;
  double zero = 0, limit = 0;  ///< where the sheet is along z, samples; reach, world units
  std::int64_t samples = 0;    ///< those near enough to the surface to be asked
};

/// The example's distances around the sheet, as a field: right in sign, and nearly a distance
/// within each placement; beyond a few voxels of the example's heights only right in sign. Closed
/// in every case, for it is a function of space.
///
/// About two microseconds a sample in the band, 12 bytes a sample of its box. The same bytes at any
/// number of threads. Throws `InputError` where the box would not fit in memory, and `Cancelled`.
Band fillBand(const Sheet& sheet, const FootFinder& feet, const SheetContent& content,
              const Placements& placements, const Slab& slab, int symmetry,
              const BandOptions& options, const Progress& progress = {});

}  // namespace exemplar::surface
