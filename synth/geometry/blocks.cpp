// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/blocks.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "core/random.h"
#include "sdf/resample.h"
#include "search/block_index.h"
#include "search/linear_scan.h"
#include "search/search_tree.h"
#include "synth/geometry/pyramid/pyramid.h"
#include "synth/geometry/stationary.h"

namespace exemplar {
namespace {

/// Whether blocks keep their height: where the example is not stationary along z (ground below, air
/// above) and the result is as high as it.
bool keepsHeight(const DistanceField& example, const BlocksOptions& options) {
  return options.size.z == example.size().z && !findStationaryAxes(example).z;
}

/// What step `n` of `count` equal ones reports to.
Progress shareOf(const Progress& progress, int n, int count) {
  return progress.part(static_cast<double>(n) / count, static_cast<double>(n + 1) / count);
}

/// The example as iterations with blocks of one size search it: quantized, at least a block thick
/// along each axis, and, where blocks keep their height, cut into overlapping slabs of a block's
/// height.
struct BlockSource {
  int side = 0;        ///< of blocks, in finest samples
  bool slabs = false;  ///< slab n begins at height n * side / 2; else there is one, the whole
  std::optional<SlidingPyramid> pyramid;  ///< of the whole
  std::vector<SlidingPyramid> pyramids;   ///< of the slabs
  std::vector<SearchTree> trees;          ///< of the slabs, where they are what is searched

  BlockSource(const DistanceField& example, int blockSide, const BlocksOptions& options,
              const Progress& progress)
      : side(blockSide), slabs(keepsHeight(example, options)) {
    const auto levels =
        quantize(example, static_cast<float>(options.truncation * example.voxelSize)).levels;
    Vec3i size = max(levels.size(), Vec3i{side, side, side});
    const int halves = std::max(2, (options.size.z + side / 2 - 1) / (side / 2));
    if (slabs) size.z = halves * (side / 2);
    const auto cut = [&](int from, int height) {
      Array3D<std::uint8_t> source({size.x, size.y, height});
      parallelForEachCell(source.size(), [&](const Vec3i& p) {
        source[p] = levels[levels.clamped(p + Vec3i{0, 0, from})];
      });
      return source;
    };
    const int count = slabs ? halves - 1 : 1;
    for (int slab = 0; slab < count; ++slab) {
      progress.check();
      auto levelsOfSlab = slabs ? cut(slab * (side / 2), side) : cut(0, size.z);
      if (options.search == BlockSearch::Tree)
        trees.emplace_back(levelsOfSlab, side, shareOf(progress, slab, count));
      pyramids.emplace_back(std::move(levelsOfSlab), side);
    }
    pyramid.emplace(cut(0, size.z), side);
  }
};

/// One iteration of section 5.1 at one level of resolution.
///
/// The target is cut into cells half a block wide. A block covers two cells a side, and is where
/// its last cell is made; cells with an index 0 are made by the first blocks.
class Pass {
 public:
  /// `size` of the target at `level`, whose cells are 2^level finest samples.
  Pass(const BlockSource& source, int level, const Vec3i& size, const BlocksOptions& options,
       const Progress& progress)
      : source_(source.pyramid->averages(level)),
        step_(1 << level),
        half_(source.side / step_ / 2),
        height_(source.slabs ? source.side / 2 : 0),
        options_(options) {
    for (int axis = 0; axis < 3; ++axis) {
      cells_[axis] = std::max(2, (size[axis] + half_ - 1) / half_);
    }
    origins_ = Array3D<Vec3i>(cells_ * half_);
    target_ = Array3D<std::uint8_t>(origins_.size());
    made_ = Array3D<std::uint8_t>(origins_.size());
    for (const SearchTree& tree : source.trees) trees_.push_back(tree.dropLeaves(level));
    for (const SlidingPyramid& pyramid : source.pyramids) {
      if (options.search == BlockSearch::Tree) break;
      const Array3D<std::uint8_t>& averages = pyramid.averages(level);
      Array3D<std::uint8_t> lattice((averages.size() - Vec3i{1, 1, 1}) / step_ + Vec3i{1, 1, 1});
      parallelForEachCell(lattice.size(),
                          [&](const Vec3i& p) { lattice[p] = averages[p * step_]; });
      if (options.search == BlockSearch::Index) {
        const int slab = static_cast<int>(indices_.size());
        const int count = static_cast<int>(source.pyramids.size());
        indices_.emplace_back(std::move(lattice), Vec3i{1, 1, 1} * (2 * half_), BlockIndexOptions{},
                              shareOf(progress, slab, count));
      } else {
        lattices_.push_back(std::move(lattice));
      }
    }
  }

  /// Seeds the target with random samples of the example (of the same height, where that is kept),
  /// or with nothing.
  void seedRandomly() {
    const Random random(options_.seed, stream::kBlockSeeding);
    parallelFor(0, target_.count(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) {
        Vec3i from;
        for (int axis = 0; axis < 3; ++axis) {
          from[axis] = static_cast<int>(random.below(source_.size()[axis], s, axis));
        }
        if (height_ > 0) from.z = std::min(target_.ijk(s).z * step_, source_.size().z - 1);
        target_.values()[s] = source_[from];
      }
    });
    masked_ = options_.seeding == BlockSeeding::Masked;
  }

  /// Seeds the target with the result of the iteration before, of half the resolution.
  void seedWith(const Array3D<Vec3i>& coarser) {
    parallelForEachCell(target_.size(), [&](const Vec3i& x) {
      const Vec3i parent = coarser.clamped({x.x / 2, x.y / 2, x.z / 2});
      const Vec3i within = min(max(x - parent * 2, Vec3i{0, 0, 0}), Vec3i{1, 1, 1});
      origins_[x] = source_.clamped(coarser[parent] + within * step_);
      target_[x] = source_[origins_[x]];
    });
  }

  /// Makes every block, in waves of blocks that do not depend on each other: a block reads only
  /// what blocks made whose indices add up to less.
  void run(const std::string& stage, const Progress& progress) {
    const Vec3i blocks = cells_ - Vec3i{1, 1, 1};
    const int waves = blocks.x + blocks.y + blocks.z - 2;
    const double all = static_cast<double>(volume(blocks));
    std::vector<Vec3i> wave;
    for (int w = 0; w < waves; ++w) {
      wave.clear();
      for (int k = 0; k < blocks.z; ++k) {
        for (int j = 0; j < blocks.y; ++j) {
          const int i = w - j - k;
          if (i >= 0 && i < blocks.x) wave.push_back({i, j, k});
        }
      }
      parallelFor(0, wave.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
          progress.check();
          make(wave[n]);
        }
      });
      matches_ += static_cast<std::int64_t>(wave.size());
      progress.report(stage, static_cast<double>(matches_) / all);
    }
  }

  const Array3D<Vec3i>& origins() const { return origins_; }
  std::int64_t matches() const { return matches_; }

 private:
  /// Matches the block at `block` (in cells), and copies what was not synthesized.
  void make(const Vec3i& block) {
    const Vec3i first = block * half_;
    const int side = 2 * half_;
    BlockQuery<std::uint8_t> query{Array3D<std::uint8_t>({side, side, side}), {}};
    if (masked_) query.known = Array3D<std::uint8_t>(query.samples.size());
    bool anyKnown = !masked_;
    for (std::size_t s = 0; s < query.samples.count(); ++s) {
      const Vec3i x = first + query.samples.ijk(s);
      query.samples.values()[s] = target_[x];
      if (masked_) {
        query.known.values()[s] = made_[x];
        anyKnown = anyKnown || made_[x];
      }
    }
    const Vec3i match =
        Vec3i{0, 0, block.z * height_} + (anyKnown ? bestMatch(query, block) : randomMatch(block));
    for (std::size_t s = 0; s < query.samples.count(); ++s) {
      const Vec3i within = query.samples.ijk(s);
      const Vec3i x = first + within;
      if (made_[x]) continue;
      made_[x] = 1;
      origins_[x] = match + within * step_;
      target_[x] = source_[origins_[x]];
    }
  }

  /// The best place in the slab that the block may come from, in finest samples.
  Vec3i bestMatch(const BlockQuery<std::uint8_t>& query, const Vec3i& block) const {
    const std::size_t slab = height_ > 0 ? block.z : 0;
    switch (options_.search) {
      case BlockSearch::Index:
        return indices_[slab].findBest(query, hints(block)).position * step_;
      case BlockSearch::Scan:
        return linearScan(lattices_[slab], query).position * step_;
      case BlockSearch::Tree:
        break;
    }
    return trees_[slab].findBest(query, {.positionStride = step_}).position;
  }

  /// Where the block would continue what its corner and its neighbors hold: likely to be near.
  std::vector<BlockMatch> hints(const Vec3i& block) const {
    std::vector<BlockMatch> likely;
    const Vec3i first = block * half_;
    for (const Vec3i& within : {Vec3i{0, 0, 0}, Vec3i{half_, 0, 0}, Vec3i{0, half_, 0},
                                Vec3i{0, 0, half_}, Vec3i{half_, half_, half_}}) {
      const Vec3i from = origins_[first + within] - Vec3i{0, 0, block.z * height_};
      likely.push_back(
          {.position = Vec3i{from.x / step_, from.y / step_, from.z / step_} - within});
    }
    return likely;
  }

  /// Any place in the slab.
  Vec3i randomMatch(const Vec3i& block) const {
    const Random random(options_.seed, stream::kBlockStart);
    const Vec3i last = source_.size() - Vec3i{1, 1, 1} * ((2 * half_ - 1) * step_ + 1);
    const std::size_t key = origins_.index(block * half_);
    Vec3i position;
    for (int axis = 0; axis < (height_ > 0 ? 2 : 3); ++axis) {
      position[axis] = static_cast<int>(random.below(last[axis] / step_ + 1, key, axis)) * step_;
    }
    return position;
  }

  const Array3D<std::uint8_t>& source_;  ///< averages of the level's cells, at every fine shift
  std::vector<SearchTree> trees_;        ///< of the slabs, less their leaves
  std::vector<Array3D<std::uint8_t>> lattices_;    ///< the subsampled slabs, for scanning
  std::vector<BlockIndex<std::uint8_t>> indices_;  ///< of the subsampled slabs
  int step_, half_,
      height_;  ///< finest samples a cell, samples half a block, between slabs (0: one slab)
  const BlocksOptions& options_;
  bool masked_ = false;
  Vec3i cells_;
  Array3D<Vec3i> origins_;  ///< first fine sample of the cell that was copied
  Array3D<std::uint8_t> target_;
  Array3D<std::uint8_t> made_;
  std::int64_t matches_ = 0;
};

void check(const DistanceField& example, const BlocksOptions& options) {
  const auto fail = [](const std::string& what) { throw InputError(what); };
  const Vec3i n = example.size();
  const int longest = std::max({n.x, n.y, n.z});
  if (volume(n) == 0) fail("the example has no samples");
  if (longest > 32767) fail("the example is longer than 32,767 samples");
  for (int axis = 0; axis < 3; ++axis) {
    if (options.size[axis] < 1) fail("`size` must be at least 1 sample along each axis");
  }
  if (options.block < 2 || options.block > 256 || (options.block & (options.block - 1))) {
    fail("`block` " + std::to_string(options.block) + ": expected a power of two, 2 to 256");
  }
  if (options.block > longest) {
    fail("`block` " + std::to_string(options.block) + ": the example is only " +
         std::to_string(longest) + " samples long; use a smaller `block` or a higher `resolution`");
  }
  if (options.iterations < 1 || options.iterations > 8) {
    fail("`iterations` " + std::to_string(options.iterations) + ": expected 1 to 8");
  }
  if (!(options.truncation > 0)) fail("`truncation` must be above 0");
  // The tree, and for each sample of the result its value, its origins and the field.
  requireMemory(60.0 * static_cast<double>(volume(max(n, Vec3i{1, 1, 1} * (2 * options.block)))) +
                    40.0 * static_cast<double>(volume(options.size)),
                "synthesis at this size", "use a lower `resolution` or a smaller `scale`");
}

/// The block's side in the iteration that works on cells of 2^level samples, in finest samples: as
/// in the last one, and twice that in the first (coarsest), unless that would be more than half of
/// the example.
int blockSide(const DistanceField& example, const BlocksOptions& options, int level) {
  const Vec3i n = example.size();
  const int longest = std::max({n.x, n.y, n.z});
  const bool first = level == options.iterations - 1 && options.iterations > 1;
  return first && 4 * options.block <= longest ? 2 * options.block : options.block;
}

/// The number of iterations that the block's size permits: each needs blocks of two samples a side.
int usableIterations(const BlocksOptions& options) {
  int iterations = options.iterations;
  while (iterations > 1 && options.block >> (iterations - 1) < 2) --iterations;
  return iterations;
}

}  // namespace

SynthesisResult synthesizeBlocks(const DistanceField& example, const BlocksOptions& given,
                                 const Progress& progress) {
  check(example, given);
  BlocksOptions options = given;
  options.iterations = usableIterations(options);

  SynthesisResult result;
  Array3D<Vec3i> origins;
  std::optional<BlockSource> source;
  for (int level = options.iterations - 1; level >= 0; --level) {
    const std::string stage = "matching blocks, level " +
                              std::to_string(options.iterations - level) + " of " +
                              std::to_string(options.iterations);
    const Progress iteration = levelProgress(progress, level, options.iterations);
    iteration.report(stage, 0);
    const int side = blockSide(example, options, level);
    if (!source || source->side != side)
      source.emplace(example, side, options, iteration.part(0, 0.05));
    const int cell = 1 << level;
    Pass pass(*source, level,
              {(options.size.x + cell - 1) / cell, (options.size.y + cell - 1) / cell,
               (options.size.z + cell - 1) / cell},
              options, iteration.part(0.05, 0.15));
    if (origins.empty()) {
      pass.seedRandomly();
    } else {
      pass.seedWith(origins);
    }
    pass.run(stage, iteration.part(0.15, 1));
    result.matches += pass.matches();
    origins = pass.origins();
  }

  result.field = example;
  result.field.values = Array3D<float>(options.size);
  result.origins = Origins(options.size);
  parallelForEachCell(options.size, [&](const Vec3i& p) {
    const Vec3i origin = example.values.clamped(origins[p]);
    result.origins[p] = Origin(origin);
    result.field.values[p] = example.values[origin];
  });
  return result;
}

}  // namespace exemplar
