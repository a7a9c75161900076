// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/array3d.h"
#include "core/progress.h"
#include "core/vec.h"
#include "sdf/triangle_soup.h"

namespace exemplar {

/// What is inside a soup of triangles, by its generalized winding number (`TriangleTree`).
///
/// A point is inside where the winding number of all closed components together is more than 1/2 in
/// size: overlapping solids are one solid, solids that are turned inside out are solids, and a
/// hollow whose walls face it is outside. It is inside, too, where the winding number of an open
/// component is more than 1/2: the surface on which it is 1/2 closes the opening. Open components
/// count one by one, because each winds around points outside it, too, down to -1/2 and up to 1/2
/// before its opening: in the sum of all, a stone without a bottom would dig a ditch into the floor
/// it rests on, and bulge out below. Those that are turned inside out are turned back first. Flat
/// ones, which enclose nothing alone, count together.
class SolidTest {
 public:
  /// `tree` holds the soup's triangles in their order; that of a closed soup needs no winding
  /// numbers, for closed components are asked by their rows (`sdf/row_crossing.h`). Throws
  /// `Cancelled`.
  SolidTest(const TriangleSoup& soup, std::shared_ptr<const TriangleTree> tree,
            const Progress& progress = {});
  ~SolidTest();

  /// Whether each point is inside; fastest for points that are close together. Any number of
  /// threads may ask.
  void inside(std::span<const Vec3d> points, std::span<std::uint8_t> result) const;
  /// Whether the points low + ijk are, much faster for closed components. Throws
  /// `Cancelled`.
  void mark(const Vec3i& low, Array3D<std::uint8_t>& inside, const Progress& progress = {}) const;

 private:
  static constexpr std::size_t kTogether = 64;
  // Sets those of at most `kTogether` points that are inside open components.
  void askOpen(std::span<const Vec3d> points, std::uint8_t* in) const;

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace exemplar
