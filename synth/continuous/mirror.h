// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "synth/continuous/search.h"

/// Results that are their own mirror image.
namespace exemplar::continuous {

/// Half of a puzzle's vertices stand for all: what one has, its image has mirrored. Since edges
/// between the halves that do not end in the middle plane join a vertex and its image, what they
/// demand is a demand on the vertex alone, and on a vertex in the plane that it is its own image.
class Mirror {
 public:
  /// Mirrors along an axis about the middle of the arrangement's box. Throws `InputError` where
  /// the planes are not their own images.
  Mirror(const Puzzle& puzzle, int axis);

  /// The inner vertices on one side of the plane and in it, of `vertices`, ascending.
  std::vector<std::uint32_t> half(std::span<const std::uint32_t> vertices) const;
  /// Leaves each vertex of the half the labels whose images the figures have, and that agree with
  /// their images.
  void restrict(std::span<const std::uint32_t> half, Domains& domains) const;
  /// Gives the images of the half's vertices the images of their labels.
  void complete(std::span<const std::uint32_t> half, Domains& domains) const;

 private:
  std::vector<int> imagesOf(std::uint32_t kind, std::uint32_t imageKind) const;

  const Puzzle& puzzle_;
  int axis_;
  std::int64_t twiceMiddle_ = 0;
  std::vector<std::uint32_t> image_;      // of each vertex
  std::vector<std::vector<int>> labels_;  // of each kind: the images of its labels, or -1
};

}  // namespace exemplar::continuous
