// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "search/feature_tree.h"
#include "search/kernels.h"
#include "search/nearest_neighbor_field.h"

namespace exemplar {

/// All patches of several channels, for summing squared differences fast. Values must be finite.
class PatchSet {
 public:
  PatchSet(const Channels& channels, const Vec3i& patch);

  const Vec3i& size() const { return size_; }    ///< of the grid, samples
  const Vec3i& patch() const { return patch_; }  ///< samples
  Vec3i positions() const { return size_ - patch_ + Vec3i{1, 1, 1}; }
  /// The index of a patch is that of its first sample.
  std::uint32_t index(const Vec3i& p) const {
    return static_cast<std::uint32_t>((static_cast<std::size_t>(p.z) * size_.y + p.y) * size_.x +
                                      p.x);
  }
  Vec3i position(std::uint32_t index) const;
  /// Terms of a sum: samples times channels.
  int terms() const { return patch_.x * static_cast<int>(rows_.size()); }
  /// The length of a gathered patch: rows padded with zeros to multiples of eight.
  std::size_t gatheredLength() const { return rows_.size() * width_; }
  void gather(std::uint32_t index, float* patch) const;

  /// The sum of squared differences between a gathered patch (of any set with the same patch and
  /// channels) and one of this set, in float, over eight lanes; or, once it exceeds `limit`, a part
  /// that does.
  float sum(const float* gathered, std::uint32_t index, float limit) const;
  /// Inner products of the patch, less `center`, with sixteen others at once: `basis[t * 16 + b]`
  /// is term t of the b-th. Rows are summed before they are added up.
  void project(const float* basis, float center, std::uint32_t index, float* products) const;
  /// The mean of all samples, and a bound on the length of any patch as a vector, `center` taken
  /// off.
  float center() const;
  float largestNorm(float center) const;
  /// Whether two patches of this set are the same, bit for bit.
  bool same(std::uint32_t a, std::uint32_t b) const;
  /// Equal patches have equal ones.
  std::vector<std::uint64_t> hashes() const;

 private:
  Vec3i size_, patch_;
  std::size_t width_ = 0;
  std::vector<float> values_;         // channel after channel, and a margin to read over
  std::vector<std::uint32_t> rows_;   // from a patch's first sample to each of its rows
  std::vector<std::uint32_t> order_;  // the rows as `sum` visits them, spread over the patch
  std::vector<float> inside_;         // 1 for samples of a row, 0 for padding
};

/// Which source patches a search may choose, and at what price.
struct PatchChoice {
  const Array3D<std::uint8_t>* allowed = nullptr;
  const Array3D<float>* weight = nullptr;
  /// Searches will be limited to windows, so equal patches in different places differ.
  bool windowed = false;
};

/// An exact nearest-neighbor index of a set's patches.
///
/// Patches are projected on 32 orthonormal directions, the leading principal components of the set.
/// By Bessel's inequality projected distances never exceed the patches' own, as equation 2 of Lagae
/// 2004 says of averages. A `FeatureTree` over the projections, as whole numbers, yields the
/// candidates; each is then summed in full. The bounds are kept below the sums by more than the
/// rounding of both.
class PatchTree {
 public:
  static constexpr int kDirections = FeatureTree::kFeatures;

  /// Keeps a reference to `set`. Deterministic; parallel. About 55 bytes a patch.
  PatchTree(const PatchSet& set, const PatchChoice& choice);

  struct Candidate {
    float cost;           ///< weighted sum of squared differences
    std::uint32_t index;  ///< in the set
    float sum;            ///< the same without weight
    bool before(const Candidate& b) const {
      return cost < b.cost || (cost == b.cost && index < b.index);
    }
  };
  /// The window of positions to choose from, both ends included.
  struct Window {
    Vec3i first, last;
  };

  /// The cheapest patch, ties by lowest index, or `start` if nothing comes before it. `features`
  /// are those of the gathered patch.
  Candidate nearest(const float* gathered, const kernels::QueryFeatures& features,
                    const Candidate& start, const Window* window) const;
  /// What a patch of any set says about its projections; `norm` is that set's
  /// `largestNorm(center())`.
  kernels::QueryFeatures features(const PatchSet& from, std::uint32_t index, float norm) const;
  float center() const { return center_; }

 private:
  struct Search;
  struct Child {
    float weight;       // the smallest below
    Vec3i first, last;  // positions below
  };
  void findDirections(std::span<const std::uint32_t> points);
  /// How far rounding may carry a projection from the true one, in numbers.
  double roundingError(double norm) const;

  const PatchSet& set_;
  const Array3D<float>* weight_;
  bool windowed_;
  std::vector<std::uint32_t> points_;  // by entry of the tree, rising
  FeatureTree tree_;
  std::vector<std::vector<Child>> below_;  // of each leaf; of each node of level 0, 1, ...
  std::vector<float> basis_;               // terms x kDirections
  double scale_ = 1;                       // numbers a unit of a projection
  float center_ = 0, norm_ = 0;            // of the set
};

}  // namespace exemplar
