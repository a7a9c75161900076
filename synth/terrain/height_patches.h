// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "maps/grid.h"
#include "synth/terrain/height_origin.h"

/// Patches of heights: which piece of an example has the shape that a piece of the result has,
/// wherever it lies in height (after Barnes, Shechtman, Finkelstein, Goldman: "PatchMatch",
/// SIGGRAPH 2009, doi:10.1145/1531326.1531330, and Kwatra, Essa, Bobick, Kwatra: "Texture
/// optimization for example-based synthesis", SIGGRAPH 2005, doi:10.1145/1073204.1073263).
namespace exemplar {

/// Side of a patch, samples.
inline constexpr int kHeightPatch = 8;

/// One resolution of an example. Samples without data are NaN.
struct HeightSource {
  Grid<float> heights;
  /// 1 where the patch whose first sample this is lies inside and has no holes.
  Grid<std::uint8_t> whole;
  /// What the costs of a patch are multiplied by: 1 / the root of its own variation. Sums of
  /// squares alone prefer patches that are gentler than what they stand for, and from resolution to
  /// resolution land would become flat.
  Grid<float> weights;
  /// The mean of the 4 x 4 samples of which this is the first (top left): a patch is four of them,
  /// and costs at least what these differ by.
  Grid<float> blocks;
  std::size_t places = 0;  ///< how many patches are whole
  /// Of a copy that was turned and bent: the example that it is of, and which sample of that, on
  /// this resolution, each sample comes from, if any. Without samples for an example itself.
  std::uint8_t copyOf = 0;
  Grid<Pixel> from;
};
/// A resolution, with all else found.
HeightSource heightSource(Grid<float> heights);

/// Where a patch of the result comes from: the first (top left) sample of the example's patch.
struct HeightMatch {
  std::int16_t x = 0, y = 0;
  std::uint8_t example = 0, turn = 0;
  float cost = 0;
  std::uint32_t piece = 0;  ///< of `HeightPieces`: the one whose place it began with
};
/// What the result's first (top left) sample of the patch comes from.
HeightOrigin originOfFirst(const HeightMatch& match);

/// A patch of the result, in the examples' orientations: what is compared with their patches.
class HeightQuery {
 public:
  /// Takes the patch whose first sample is `at`; past an end it goes on at the other.
  void take(const Grid<float>& heights, Pixel at);
  /// Turns it, so that several threads may compare it in these orientations.
  void turn(std::span<const int> turns);

  /// What it costs to take `match`: how little it has the query's shape. The sum of the squares of
  /// their differences without the mean difference, `level` times what that takes away, and
  /// `slopes` times the squares of the differences' steps; all times the match's weight. Where that
  /// is sure to exceed `most`, infinity.
  float cost(const HeightSource& source, const HeightMatch& match, float level, float slopes,
             float most);

 private:
  const float* turned(int turn);

  alignas(32) std::array<std::array<float, kHeightPatch * kHeightPatch>, 8> heights_;
  std::array<float, 4> blocks_;  // means, as `HeightSource::blocks`
  unsigned turned_ = 0;          // bit t: `heights_[t]` is there
};

struct HeightPieces;

struct HeightMatching {
  double slopes = 4;      ///< what differences of steps count beside those of heights; >= 0
  double level = 0.05;    ///< what the difference of mean heights counts; 0: nothing, 1: heights as
                          ///< they are
  double evenness = 0.5;  ///< what it costs to use a place more often than others; >= 0
  int stride = 2;         ///< samples from patch to patch, 1..kHeightPatch
  std::vector<int> turns{0};  ///< of `turnedStep`: the orientations in which patches are used
  bool wrapsX = false, wrapsY = false;
};

/// The patches of a result of some size, and where each comes from.
class HeightField {
 public:
  HeightField(int width, int height, const HeightMatching& matching);

  int columns() const { return static_cast<int>(xs_.size()); }
  int rows() const { return static_cast<int>(ys_.size()); }
  /// The first sample of a patch.
  Pixel place(int column, int row) const {
    return {xs_[static_cast<std::size_t>(column)], ys_[static_cast<std::size_t>(row)]};
  }
  Grid<HeightMatch>& matches() { return matches_; }
  const Grid<HeightMatch>& matches() const { return matches_; }

  /// Searches around what there is: each patch takes what its neighbors' places suggest and
  /// `tries` random places around its own where they are nearer; `round` numbers the draws.
  void search(std::span<const HeightSource> sources, const Grid<float>& heights, std::uint64_t seed,
              std::uint64_t round, int tries, const Progress& progress);
  /// Looks at every place of the examples in every orientation. O(patches x places): for small
  /// maps.
  void searchAll(std::span<const HeightSource> sources, const Grid<float>& heights,
                 const Progress& progress);

  /// The heights that the patches give, each at the height where it fits: their mean at each
  /// sample, of which a patch counts most at its middle. `heights` are what the patches were fitted
  /// to.
  Grid<float> vote(std::span<const HeightSource> sources, const Grid<float>& heights,
                   const Progress& progress) const;
  /// For each sample the origin on which most of the patches over it agree.
  Grid<HeightOrigin> origins(const Progress& progress) const;
  /// Moves what comes from places with holes to whole ones nearby.
  void leaveHoles(std::span<const HeightSource> sources);
  /// Begins with pieces, which must outlive the field: `search` spreads none of them beyond its
  /// reach.
  void begin(const HeightPieces& pieces, std::span<const HeightSource> sources);

 private:
  void countUses(std::span<const HeightSource> sources);
  void addUse(const HeightMatch& match, float by);
  bool consider(std::span<const HeightSource> sources, HeightQuery& query,
                const HeightMatch& candidate, HeightMatch& best) const;
  bool reaches(const HeightMatch& from, const HeightMatch& own, Pixel at) const;
  int width_, height_;
  HeightMatching matching_;
  std::vector<int> xs_, ys_;
  Grid<HeightMatch> matches_;
  const HeightPieces* pieces_ = nullptr;
  std::vector<Grid<float>> uses_;  // of blocks of the examples, 1 on average
  float usesEach_ = 1;             // how many patches that is
};

}  // namespace exemplar
