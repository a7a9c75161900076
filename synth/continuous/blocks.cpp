// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/blocks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/array3d.h"
#include "core/cells.h"
#include "core/loop_progress.h"
#include "core/parallel.h"

namespace exemplar::continuous {
namespace {

/// Every this many blocks along each axis run at once: between them is half a block.
constexpr int kColors = 3;

/// The longest edges between inner vertices, along each axis, units.
Vec3d longestEdges(const Puzzle& puzzle) {
  const Arrangement& a = puzzle.arrangement;
  Vec3d longest;
  for (std::uint32_t v = 0; v < a.vertices(); ++v) {
    if (!a.inside(v)) continue;
    const Vec3d p = a.point(v).approximately();
    for (const EdgeEnd& end : a.ends(v)) {
      if (end.vertex == EdgeEnd::kNone || end.vertex < v || !a.inside(end.vertex)) continue;
      const Vec3d d = a.point(end.vertex).approximately() - p;
      longest = max(longest, Vec3d{std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    }
  }
  return longest;
}

/// Inner vertices by half-blocks, and along which axes a vertex is on its half-block's low side.
class HalfBlocks {
 public:
  HalfBlocks(const Arrangement& arrangement, const Vec3l& low, const Vec3l& half) {
    const Vec3l high = arrangement.planes().window.high;
    for (int axis = 0; axis < 3; ++axis)
      size_[axis] = static_cast<int>(floorDivide(high[axis] - low[axis], half[axis])) + 1;
    members_ = Array3D<std::vector<Member>>(size_);
    for (std::uint32_t v = 0; v < arrangement.vertices(); ++v) {
      if (!arrangement.inside(v)) continue;
      const ExactPoint& p = arrangement.point(v);
      Vec3i cell;
      std::uint8_t onLow = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t at = p.n[axis] - low[axis] * p.d, side = half[axis] * p.d;
        cell[axis] = static_cast<int>(floorDivide(at, side));
        if (cell[axis] * side == at) onLow |= static_cast<std::uint8_t>(1 << axis);
      }
      members_[cell].push_back({v, onLow});
    }
  }

  Vec3i size() const { return size_; }
  /// The vertices strictly within the block of half-blocks from `first` to `first` + 1, ascending.
  std::vector<std::uint32_t> within(const Vec3i& first) const {
    std::vector<std::uint32_t> found;
    const CellBox all = CellBox::of(size_) & CellBox{first, first + Vec3i{2, 2, 2}};
    forEachCell(all, [&](const Vec3i& cell) {
      for (const Member& member : members_[cell]) {
        bool inner = true;
        for (int axis = 0; axis < 3; ++axis)
          inner = inner && !(cell[axis] == first[axis] && (member.onLow >> axis & 1));
        if (inner) found.push_back(member.vertex);
      }
    });
    std::ranges::sort(found);
    return found;
  }

 private:
  struct Member {
    std::uint32_t vertex;
    std::uint8_t onLow;
  };
  Vec3i size_;
  Array3D<std::vector<Member>> members_;
};

}  // namespace

BlockCounts modifyInBlocks(const Puzzle& puzzle, std::span<const double> weights, Domains& labels,
                           const Random& random, const BlockOptions& options,
                           const Progress& progress) {
  const Arrangement& a = puzzle.arrangement;
  const Vec3d longest = longestEdges(puzzle);
  Vec3l half;
  for (int axis = 0; axis < 3; ++axis) {
    const auto least = static_cast<std::int64_t>(std::ceil(longest[axis]));
    half[axis] =
        std::max<std::int64_t>(options.spacing[axis] * ((options.side + 1) / 2), least + 1);
  }
  BlockCounts counts;
  Search::Marks marks(puzzle);
  std::uint32_t region = 0;
  for (int round = 0; round < options.rounds; ++round) {
    // Each round's blocks begin elsewhere.
    Vec3l low = a.planes().window.low;
    for (int axis = 0; axis < 3; ++axis) {
      const auto shifts = static_cast<std::uint32_t>(half[axis] / options.spacing[axis]);
      const std::uint32_t by =
          random.below(std::max(1u, shifts), static_cast<std::uint64_t>(round), 900u + axis);
      low[axis] -= options.spacing[axis] * by;
    }
    const HalfBlocks halves(a, low, half);
    const Vec3i blocks = halves.size();  // the first begins a half before the box
    LoopProgress loop(progress.part(static_cast<double>(round) / options.rounds,
                                    static_cast<double>(round + 1) / options.rounds),
                      "modifying blocks", static_cast<std::size_t>(volume(blocks)) + 1);
    for (int color = 0; color < kColors * kColors * kColors; ++color) {
      const Vec3i from{color % kColors, color / kColors % kColors, color / kColors / kColors};
      std::vector<Vec3i> firsts;
      for (int z = from.z; z <= blocks.z; z += kColors)
        for (int y = from.y; y <= blocks.y; y += kColors)
          for (int x = from.x; x <= blocks.x; x += kColors)
            firsts.push_back(Vec3i{x, y, z} - Vec3i{1, 1, 1});
      std::vector<BlockCounts> made(firsts.size());
      parallelFor(0, firsts.size(), 1, [&](std::size_t b0, std::size_t b1) {
        for (std::size_t b = b0; b < b1; ++b) {
          loop.advance();
          const std::vector<std::uint32_t> vertices = halves.within(firsts[b]);
          if (vertices.empty()) continue;
          std::vector<Word> before;
          for (const std::uint32_t v : vertices) {
            before.insert(before.end(), labels[v].begin(), labels[v].end());
            std::ranges::copy(puzzle.domains[v], labels[v].begin());
          }
          Search search(puzzle, weights, labels, marks);
          search.setBacktracking(options.backtracking);
          search.setGuide(options.guide);
          const std::uint64_t number = static_cast<std::uint64_t>(region) + b;
          const bool done = search.begin(vertices, region + 1 + static_cast<std::uint32_t>(b)) &&
                            search.run(random.fork(1000 + number), options.budget) == Found::All;
          made[b] = {1, done, search.counts().choices, search.counts().failures};
          if (done) continue;
          for (std::size_t n = 0; n < vertices.size(); ++n) {
            std::copy_n(before.begin() + static_cast<std::ptrdiff_t>(n * labels.words()),
                        labels.words(), labels[vertices[n]].begin());
          }
        }
      });
      region += static_cast<std::uint32_t>(firsts.size());
      for (const BlockCounts& m : made) {
        counts.blocks += m.blocks;
        counts.kept += m.kept;
        counts.choices += m.choices;
        counts.failures += m.failures;
      }
    }
  }
  return counts;
}

}  // namespace exemplar::continuous
