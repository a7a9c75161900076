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

/// The nearest of consecutive orientations of one patch that are wholly known.
EXEMPLAR_MULTIVERSION
int nearestTurn(const std::uint64_t* a, const std::uint64_t* turned, int whole, int words,
                int turns, int* turn) {
  int least = 1 << 30;
  for (int t = 0; t < turns; ++t, turned += words) {
    int sum = 0, halves = 0;
    for (int w = 0; w < whole; ++w) sum += std::popcount(a[w] ^ turned[w]);
    for (int w = whole; w < words; ++w) halves += std::popcount(a[w] ^ turned[w]);
    sum += halves / 2;
    if (sum < least) {
      least = sum;
      *turn = t;
    }
  }
  return least;
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
  const Vec3i& size = planes.size();
  const int planeWords = (cells_ + 63) / 64;
  words_ = planeWords * static_cast<int>(planes.shapes.size());
  wholeWords_ = planeWords * static_cast<int>(planes.whole);
  const std::size_t each = symmetries_.size() * static_cast<std::size_t>(words_);
  bits_.resize(centers_.size() * each);
  const int half = side / 2, halfDepth = patchDepth(size, side) / 2;
  if (!wraps) {
    const Vec3i reach{half, half, halfDepth};
    for (std::size_t p = 0; p < centers_.size(); ++p) {
      const Vec3i low = centers_[p] - reach, high = centers_[p] + reach;
      const Shape& shape = *planes.shapes.front();
      whole_[p] = shape.contains(low) && shape.contains(high);
    }
    if (std::ranges::find(whole_, 0) != whole_.end()) known_.resize(bits_.size());
  }
  // Where a row of a patch goes on along x, for each orientation.
  std::vector<Vec3i> alongX;
  for (const int symmetry : symmetries_) alongX.push_back(turnedAboutZ({1, 0, 0}, symmetry));
  parallelFor(0, centers_.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
      for (std::size_t t = 0; t < symmetries_.size(); ++t) {
        const std::size_t at = p * each + t * static_cast<std::size_t>(words_);
        std::size_t bit = 0;
        for (int dz = -halfDepth; dz <= halfDepth; ++dz) {
          for (int dy = -half; dy <= half; ++dy) {
            Vec3i place = centers_[p] + turnedAboutZ({-half, dy, dz}, symmetries_[t]);
            for (int dx = -half; dx <= half; ++dx, ++bit, place += alongX[t]) {
              const bool known = whole_[p] || planes.shapes.front()->contains(place);
              if (!known) continue;
              const std::size_t from =
                  planes.shapes.front()->index(wraps ? wrappedPlace(place, size) : place);
              std::size_t word = at + bit / 64;
              for (const Shape* shape : planes.shapes) {
                bits_[word] |= std::uint64_t{shape->data()[from] != 0} << bit % 64;
                if (!whole_[p]) known_[word] |= std::uint64_t{1} << bit % 64;
                word += static_cast<std::size_t>(planeWords);
              }
              if (t == 0) inside_[p] += planes.shapes.front()->data()[from] != 0;
            }
          }
        }
      }
    }
  });
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
}

void NearestPatches::find(const BoundaryPatches& set, std::size_t patch, std::size_t wanted,
                          std::span<const std::uint32_t> left,
                          std::vector<BoundaryMatch>& found) const {
  const BoundaryPatches& examples = *examples_;
  found.clear();
  const auto nearer = [](const BoundaryMatch& a, const BoundaryMatch& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.patch < b.patch;
  };
  const auto offer = [&](std::uint32_t p, int distance, int turn) {
    const BoundaryMatch match{p, static_cast<std::uint16_t>(turn),
                              static_cast<std::uint16_t>(distance)};
    if (found.size() == wanted && !nearer(match, found.back())) return;
    if (found.size() == wanted) found.pop_back();
    found.insert(std::ranges::upper_bound(found, match, nearer), match);
  };
  const std::uint64_t* bits = set.bits(patch, 0);
  const auto visit = [&](std::uint32_t p) {
    if (!left.empty() && left[p] == 0) return;
    int turn = 0;
    const int distance = nearestTurn(bits, examples.bits(p, 0), examples.wholeWords(),
                                     examples.words(), examples.turns(), &turn);
    offer(p, distance, turn);
  };
  const int inside = set.inside(patch);
  const auto limit = [&] { return found.size() < wanted ? 1 << 30 : int{found.back().distance}; };
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
        visit(byInside_[up]);
        goesUp = ++up < byInside_.size();
      }
    }
    if (goesDown) {
      if (inside - examples.inside(byInside_[down - 1]) > limit()) {
        goesDown = false;
      } else {
        visit(byInside_[--down]);
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
    offer(p, least, turn);
  }
}

}  // namespace exemplar
