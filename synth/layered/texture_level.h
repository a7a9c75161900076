// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "core/progress.h"
#include "core/random.h"
#include "synth/layered/texture_by_numbers.h"

namespace exemplar {

/// Cells with several values each, those of a cell together: what patches compare. The guide's
/// values come first.
struct TextureFeatures {
  Vec3i size{};
  int values = 0, guides = 0;
  std::vector<float> data;

  const float* at(const Vec3i& p) const { return &data[index(p)]; }
  float* at(const Vec3i& p) { return &data[index(p)]; }

 private:
  std::size_t index(const Vec3i& p) const {
    return ((static_cast<std::size_t>(p.z) * size.y + p.y) * size.x + p.x) *
           static_cast<std::size_t>(values);
  }
};

/// One resolution of patch optimization: a nearest-neighbor field from the result's patches to the
/// example's, and the result that they vote for.
class TextureLevel {
 public:
  /// `hole`: as in `TextureTask`, at this resolution; may be null. Throws `InputError` where it
  /// leaves no patch of the example.
  TextureLevel(const TextureFeatures& example, TextureFeatures result, const Shape* hole,
               const TextureOptions& options, const Random& random);

  /// Begins with places whose guide is like the cell's: the best of a few drawn.
  void startAtRandom();
  /// Begins with the places of the coarser level.
  void startFrom(const TextureOrigins& coarser);
  void run(int rounds, const Progress& progress);

  const TextureOrigins& origins() const { return origins_; }
  const Array3D<float>& costs() const { return costs_; }

 private:
  Vec3i inside(const Vec3i& place) const;
  bool isInside(const Vec3i& place) const;
  bool isFree(std::size_t p) const { return free_.empty() || free_.data()[p]; }
  Vec3i anyPlace(std::uint64_t bits) const;
  float cost(const Vec3i& at, const Vec3i& place, float limit) const;
  float overuse(const Vec3i& place) const;
  void countUses();
  void search(int sweep, int reach);
  void vote(bool weighs);

  const TextureFeatures& example_;
  TextureFeatures result_;
  const Shape* hole_;
  const TextureOptions& options_;
  Random random_;
  Vec3i reach_;  // of a patch, from its middle
  int patchCells_;
  TextureOrigins origins_;
  Array3D<float> costs_;
  Array3D<float> uses_;
  // With a hole: cells whose patches touch it and are searched; the example's places that can
  // serve, as a list and for each place.
  Shape free_, serves_;
  std::vector<Vec3i> serving_;
};

}  // namespace exemplar
