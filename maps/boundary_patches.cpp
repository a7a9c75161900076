// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/boundary_patches.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "core/parallel.h"
#include "core/simd.h"

namespace exemplar {
namespace {

std::vector<int> symmetriesOf(int turns) {
  if (turns == 2) return {0, 2};
  std::vector<int> all;
  for (int t = 0; t < turns; ++t) all.push_back(t);
  return all;
}

/// Cells that differ in the words that count whole, and half of those in the others.
EXEMPLAR_MULTIVERSION
int differing(const std::uint64_t* a, const std::uint64_t* b, int whole, int words) {
  int sum = 0, halves = 0;
  for (int w = 0; w < whole; ++w) sum += std::popcount(a[w] ^ b[w]);
  for (int w = whole; w < words; ++w) halves += std::popcount(a[w] ^ b[w]);
  return sum + halves / 2;
}

EXEMPLAR_MULTIVERSION
void differingAndKnown(const std::uint64_t* a, const std::uint64_t* b, const std::uint64_t* known,
                       int whole, int words, int& sum, int& count) {
  int halves = 0;
  sum = count = 0;
  for (int w = 0; w < whole; ++w) {
    sum += std::popcount((a[w] ^ b[w]) & known[w]);
    count += std::popcount(known[w]);
  }
  for (int w = whole; w < words; ++w) {
    halves += std::popcount((a[w] ^ b[w]) & known[w]);
    if (whole == 0) count += std::popcount(known[w]);
  }
  sum += halves / 2;
}

/// For each of consecutive oriented patches, how much its blocks differ from a patch's.
EXEMPLAR_MULTIVERSION
void blocksDiffering(const std::uint8_t* blocks, const std::uint8_t* turned, int turns,
                     int* differences) {
  for (int t = 0; t < turns; ++t, turned += BoundaryPatches::kBlocks) {
    int sum = 0;
    for (int b = 0; b < BoundaryPatches::kBlocks; ++b) sum += std::abs(blocks[b] - turned[b]);
    differences[t] = sum;
  }
}

/// The indices of the cells of one row of a patch, from `begin` on; -1 beyond a shape that does not
/// wrap.
void cellsOfRow(const Shape& shape, const Vec3i& begin, const Vec3i& along, bool wraps,
                std::span<std::int64_t> row) {
  const Vec3i& size = shape.size();
  if (shape.contains(begin) && shape.contains(begin + along * (static_cast<int>(row.size()) - 1))) {
    const std::int64_t step = along.x + std::int64_t{along.y} * size.x;
    auto at = static_cast<std::int64_t>(shape.index(begin));
    for (std::int64_t& cell : row) {
      cell = at;
      at += step;
    }
    return;
  }
  Vec3i place = begin;
  for (std::int64_t& cell : row) {
    const Vec3i there = wraps ? wrappedPlace(place, size) : place;
    cell = shape.contains(there) ? static_cast<std::int64_t>(shape.index(there)) : -1;
    place += along;
  }
}

/// The block in which each cell of a patch lies: 5 x 5 of them, in space 3 x 3 x 3. Empty where
/// their cells would not count in a byte.
std::vector<std::uint8_t> blocksOfCells(int side, int depth) {
  const int parts = depth == 1 ? 5 : 3;
  const int most = (side + parts - 1) / parts;
  if (most * most * (depth == 1 ? 1 : most) > 255) return {};
  std::vector<std::uint8_t> blocks;
  for (int z = 0; z < depth; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        blocks.push_back(static_cast<std::uint8_t>(
            ((depth == 1 ? 0 : z * parts / depth) * parts + y * parts / side) * parts +
            x * parts / side));
  return blocks;
}

}  // namespace

Vec3i turnedAboutZ(Vec3i step, int turn) {
  if (turn >= 4) step.x = -step.x;
  for (int t = 0; t < turn % 4; ++t) step = {-step.y, step.x, step.z};
  return step;
}

BoundaryPatches::BoundaryPatches(const ShapePlanes& planes, std::span<const Vec3i> centers,
                                 int side, int turns, bool wraps)
    : side_(side),
      cells_(patchCells(planes.size(), side)),
      symmetries_(symmetriesOf(turns)),
      centers_(centers.begin(), centers.end()),
      whole_(centers.size(), 1),
      inside_(centers.size()) {
  const Shape& shape = *planes.shapes.front();
  const Vec3i& size = planes.size();
  const int planeWords = (cells_ + 63) / 64;
  words_ = planeWords * static_cast<int>(planes.shapes.size());
  wholeWords_ = planeWords * static_cast<int>(planes.whole);
  const std::size_t each = symmetries_.size() * static_cast<std::size_t>(words_);
  bits_.resize(centers_.size() * each);
  blocks_.resize(centers_.size() * symmetries_.size() * kBlocks);
  const std::vector<std::uint8_t> blockOf = blocksOfCells(side, patchDepth(size, side));
  const int half = side / 2, halfDepth = patchDepth(size, side) / 2;
  if (!wraps) {
    const Vec3i reach{half, half, halfDepth};
    for (std::size_t p = 0; p < centers_.size(); ++p) {
      const Vec3i low = centers_[p] - reach, high = centers_[p] + reach;
      whole_[p] = shape.contains(low) && shape.contains(high);
    }
    if (std::ranges::find(whole_, 0) != whole_.end()) known_.resize(bits_.size());
  }
  // Where a row of a patch goes on along x, for each orientation.
  std::vector<Vec3i> alongX;
  for (const int symmetry : symmetries_) alongX.push_back(turnedAboutZ({1, 0, 0}, symmetry));
  parallelFor(0, centers_.size(), 256, [&](std::size_t first, std::size_t last) {
    std::vector<std::int64_t> row(static_cast<std::size_t>(side));
    for (std::size_t p = first; p < last; ++p) {
      for (std::size_t t = 0; t < symmetries_.size(); ++t) {
        std::size_t bit = 0;
        for (int dz = -halfDepth; dz <= halfDepth; ++dz) {
          for (int dy = -half; dy <= half; ++dy) {
            const Vec3i begin = centers_[p] + turnedAboutZ({-half, dy, dz}, symmetries_[t]);
            cellsOfRow(shape, begin, alongX[t], wraps, row);
            packRow(planes, row, p, t, bit, blockOf);
            bit += row.size();
          }
        }
      }
      for (int w = 0; w < planeWords; ++w) inside_[p] += std::popcount(bits(p, 0)[w]);
    }
  });
}

void BoundaryPatches::packRow(const ShapePlanes& planes, std::span<const std::int64_t> row,
                              std::size_t patch, std::size_t turn, std::size_t bit,
                              std::span<const std::uint8_t> blockOf) {
  const std::size_t oriented = patch * symmetries_.size() + turn;
  const auto planeWords = static_cast<std::size_t>((cells_ + 63) / 64);
  std::uint64_t* words = &bits_[oriented * static_cast<std::size_t>(words_)];
  std::uint64_t* known =
      whole_[patch] ? nullptr : &known_[oriented * static_cast<std::size_t>(words_)];
  std::uint8_t* blocks = &blocks_[oriented * kBlocks];
  const auto put = [&](std::uint64_t rowBits, std::uint64_t* to) {
    to[bit / 64] |= rowBits << bit % 64;
    if (bit % 64 + row.size() > 64) to[bit / 64 + 1] |= rowBits >> (64 - bit % 64);
  };
  for (const Shape* shape : planes.shapes) {
    const std::uint8_t* values = shape->data();
    const bool counts = shape == planes.shapes.front() && !blockOf.empty();
    std::uint64_t insideBits = 0, knownBits = 0;
    for (std::size_t x = 0; x < row.size(); ++x) {
      if (row[x] < 0) continue;
      const std::uint8_t inside = values[row[x]] != 0;
      insideBits |= std::uint64_t{inside} << x;
      knownBits |= std::uint64_t{1} << x;
      if (counts) blocks[blockOf[bit + x]] += inside;
    }
    put(insideBits, words);
    words += planeWords;
    if (!known) continue;
    put(knownBits, known);
    known += planeWords;
  }
}

int patchDistance(const BoundaryPatches& set, std::size_t a, const BoundaryPatches& examples,
                  std::size_t b, int turn) {
  const std::uint64_t* known = examples.known(b, turn);
  const int whole = set.wholeWords(), words = set.words();
  if (!known) return differing(set.bits(a, 0), examples.bits(b, turn), whole, words);
  int sum = 0, count = 0;
  differingAndKnown(set.bits(a, 0), examples.bits(b, turn), known, whole, words, sum, count);
  // Each plane knows the same cells.
  const int planes = (whole > 0 ? whole : words) / ((set.cells() + 63) / 64);
  return static_cast<int>(std::lround(static_cast<double>(sum) * set.cells() * planes / count));
}

NearestPatches::NearestPatches(const BoundaryPatches& examples) : examples_(&examples) {
  for (std::uint32_t p = 0; p < examples.count(); ++p)
    (examples.whole(p) ? byInside_ : partial_).push_back(p);
  std::ranges::stable_sort(byInside_, {}, [&](std::uint32_t p) { return examples.inside(p); });
  for (const std::uint32_t p : byInside_) {
    const std::uint8_t* blocks = examples.insideOfBlocks(p, 0);
    blocks_.insert(blocks_.end(), blocks, blocks + examples.turns() * BoundaryPatches::kBlocks);
  }
}

bool NearestPatches::compare(const BoundaryPatches& set, std::size_t patch, std::size_t rank,
                             int limit, BoundaryMatch& match) const {
  const BoundaryPatches& examples = *examples_;
  const int turns = examples.turns();
  int atLeast[8];
  blocksDiffering(set.insideOfBlocks(patch, 0),
                  &blocks_[rank * static_cast<std::size_t>(turns) * BoundaryPatches::kBlocks],
                  turns, atLeast);
  int least = 1 << 30, best = 0;
  for (int t = 0; t < turns; ++t) {
    if (atLeast[t] > limit) continue;
    const int distance = differing(set.bits(patch, 0), examples.bits(byInside_[rank], t),
                                   examples.wholeWords(), examples.words());
    if (distance >= least) continue;
    least = distance;
    best = t;
  }
  match = {byInside_[rank], static_cast<std::uint16_t>(best), static_cast<std::uint16_t>(least)};
  return least < 1 << 30;
}

void NearestPatches::find(const BoundaryPatches& set, std::size_t patch, std::size_t wanted,
                          std::span<const std::uint32_t> left,
                          std::vector<BoundaryMatch>& found) const {
  const BoundaryPatches& examples = *examples_;
  found.clear();
  const auto nearer = [](const BoundaryMatch& a, const BoundaryMatch& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.patch < b.patch;
  };
  const auto offer = [&](const BoundaryMatch& match) {
    if (found.size() == wanted && !nearer(match, found.back())) return;
    if (found.size() == wanted) found.pop_back();
    found.insert(std::ranges::upper_bound(found, match, nearer), match);
  };
  const int inside = set.inside(patch);
  const auto limit = [&] { return found.size() < wanted ? 1 << 30 : int{found.back().distance}; };
  const auto visit = [&](std::size_t rank) {
    if (!left.empty() && left[byInside_[rank]] == 0) return;
    BoundaryMatch match;
    if (compare(set, patch, rank, limit(), match)) offer(match);
  };
  // Outward from the patches with as many inside cells.
  auto up = static_cast<std::size_t>(
      std::ranges::lower_bound(byInside_, inside, {},
                               [&](std::uint32_t p) { return examples.inside(p); }) -
      byInside_.begin());
  std::size_t down = up;
  for (bool goesUp = up<byInside_.size(), goesDown = down> 0; goesUp || goesDown;) {
    if (goesUp) {
      if (examples.inside(byInside_[up]) - inside > limit()) {
        goesUp = false;
      } else {
        visit(up);
        goesUp = ++up < byInside_.size();
      }
    }
    if (goesDown) {
      if (inside - examples.inside(byInside_[down - 1]) > limit()) {
        goesDown = false;
      } else {
        visit(--down);
        goesDown = down > 0;
      }
    }
  }
  for (const std::uint32_t p : partial_) {
    if (!left.empty() && left[p] == 0) continue;
    int least = 1 << 30, turn = 0;
    for (int t = 0; t < examples.turns(); ++t) {
      const int distance = patchDistance(set, patch, examples, p, t);
      if (distance < least) {
        least = distance;
        turn = t;
      }
    }
    offer({p, static_cast<std::uint16_t>(turn), static_cast<std::uint16_t>(least)});
  }
}

}  // namespace exemplar
