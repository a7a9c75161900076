// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/boundary_patches.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "core/disjoint_sets.h"
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

EXEMPLAR_MULTIVERSION
int differing(const std::uint64_t* a, const std::uint64_t* b, int words) {
  int sum = 0;
  for (int w = 0; w < words; ++w) sum += std::popcount(a[w] ^ b[w]);
  return sum;
}

EXEMPLAR_MULTIVERSION
void differingAndKnown(const std::uint64_t* a, const std::uint64_t* b, const std::uint64_t* known,
                       int words, int& sum, int& count) {
  sum = count = 0;
  for (int w = 0; w < words; ++w) {
    sum += std::popcount((a[w] ^ b[w]) & known[w]);
    count += std::popcount(known[w]);
  }
}

/// The nearest of consecutive orientations of one patch that are wholly known.
EXEMPLAR_MULTIVERSION
int nearestTurn(const std::uint64_t* a, const std::uint64_t* turned, int words, int turns,
                int* turn) {
  int least = 1 << 30;
  for (int t = 0; t < turns; ++t) {
    int sum = 0;
    for (int w = 0; w < words; ++w) sum += std::popcount(a[w] ^ turned[t * words + w]);
    if (sum < least) {
      least = sum;
      *turn = t;
    }
  }
  return least;
}

/// The component of each pixel: the index of its first pixel.
DisjointSets componentsOf(const Shape& shape, bool wraps) {
  DisjointSets sets(shape.count());
  for (int y = 0; y < shape.height(); ++y) {
    for (int x = 0; x < shape.width(); ++x) {
      const std::size_t p = shape.index(x, y);
      for (const Pixel& step : {Pixel{1, 0}, Pixel{0, 1}}) {
        if (!wraps && !shape.contains(x + step.x, y + step.y)) continue;
        const std::size_t q = shape.wrapped(x + step.x, y + step.y);
        if (shape[p] == shape[q])
          sets.join(static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(q));
      }
    }
  }
  return sets;
}

std::vector<std::uint32_t> pixelsOfSets(DisjointSets& sets) {
  std::vector<std::uint32_t> pixels(sets.count());
  for (std::uint32_t p = 0; p < pixels.size(); ++p) ++pixels[sets.find(p)];
  return pixels;
}

}  // namespace

std::vector<std::uint32_t> componentSizes(const Shape& shape, bool inside, bool wraps) {
  DisjointSets sets = componentsOf(shape, wraps);
  std::vector<std::uint32_t> sizes;
  const std::vector<std::uint32_t> pixels = pixelsOfSets(sets);
  for (std::uint32_t p = 0; p < pixels.size(); ++p)
    if (pixels[p] > 0 && (shape[p] != 0) == inside) sizes.push_back(pixels[p]);
  return sizes;
}

void removeSmall(Shape& shape, std::uint32_t inside, std::uint32_t outside, bool wraps) {
  DisjointSets sets = componentsOf(shape, wraps);
  const std::vector<std::uint32_t> pixels = pixelsOfSets(sets);
  for (std::uint32_t p = 0; p < pixels.size(); ++p)
    if (pixels[sets.find(p)] < (shape[p] ? inside : outside)) shape[p] = !shape[p];
}

std::vector<Pixel> boundaryOf(const Shape& shape, bool wraps) {
  constexpr Pixel kSteps[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  std::vector<Pixel> boundary;
  for (int y = 0; y < shape.height(); ++y) {
    for (int x = 0; x < shape.width(); ++x) {
      if (!shape(x, y)) continue;
      for (const Pixel& step : kSteps) {
        const int nx = x + step.x, ny = y + step.y;
        if (!wraps && !shape.contains(nx, ny)) continue;
        if (shape[shape.wrapped(nx, ny)]) continue;
        boundary.push_back({x, y});
        break;
      }
    }
  }
  return boundary;
}

double areaOf(const Shape& shape) {
  std::int64_t inside = 0;
  for (const std::uint8_t v : shape.values()) inside += v;
  return static_cast<double>(inside) / static_cast<double>(shape.count());
}

Pixel turnedStep(Pixel step, int turn) {
  if (turn >= 4) step.x = -step.x;
  for (int t = 0; t < turn % 4; ++t) step = {-step.y, step.x};
  return step;
}

BoundaryPatches::BoundaryPatches(const Shape& shape, std::span<const Pixel> centers, int side,
                                 int turns, bool wraps)
    : side_(side),
      words_((side * side + 63) / 64),
      symmetries_(symmetriesOf(turns)),
      centers_(centers.begin(), centers.end()),
      whole_(centers.size(), 1),
      inside_(centers.size()) {
  const std::size_t each = symmetries_.size() * static_cast<std::size_t>(words_);
  bits_.resize(centers_.size() * each);
  const int half = side / 2;
  if (!wraps) {
    for (std::size_t p = 0; p < centers_.size(); ++p) {
      const Pixel& c = centers_[p];
      whole_[p] = shape.contains(c.x - half, c.y - half) && shape.contains(c.x + half, c.y + half);
    }
    if (std::ranges::find(whole_, 0) != whole_.end()) known_.resize(bits_.size());
  }
  parallelFor(0, centers_.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
      const Pixel& c = centers_[p];
      for (std::size_t t = 0; t < symmetries_.size(); ++t) {
        const std::size_t at = p * each + t * static_cast<std::size_t>(words_);
        std::size_t bit = 0;
        for (int dy = -half; dy <= half; ++dy) {
          for (int dx = -half; dx <= half; ++dx, ++bit) {
            const Pixel step = turnedStep({dx, dy}, symmetries_[t]);
            const int x = c.x + step.x, y = c.y + step.y;
            const bool known = wraps || shape.contains(x, y);
            const bool inside = known && shape[shape.wrapped(x, y)];
            bits_[at + bit / 64] |= std::uint64_t{inside} << bit % 64;
            if (!whole_[p]) known_[at + bit / 64] |= std::uint64_t{known} << bit % 64;
            if (t == 0) inside_[p] += inside;
          }
        }
      }
    }
  });
}

int patchDistance(const BoundaryPatches& set, std::size_t a, const BoundaryPatches& examples,
                  std::size_t b, int turn) {
  const std::uint64_t* known = examples.known(b, turn);
  if (!known) return differing(set.bits(a, 0), examples.bits(b, turn), set.words());
  int sum = 0, count = 0;
  differingAndKnown(set.bits(a, 0), examples.bits(b, turn), known, set.words(), sum, count);
  return static_cast<int>(std::lround(static_cast<double>(sum) * set.side() * set.side() / count));
}

NearestPatches::NearestPatches(const BoundaryPatches& examples) : examples_(&examples) {
  for (std::uint32_t p = 0; p < examples.count(); ++p)
    (examples.whole(p) ? byInside_ : partial_).push_back(p);
  std::ranges::stable_sort(byInside_, {}, [&](std::uint32_t p) { return examples.inside(p); });
}

void NearestPatches::find(const BoundaryPatches& set, std::size_t patch, std::size_t wanted,
                          std::span<const std::uint32_t> left,
                          std::vector<PatchMatch2D>& found) const {
  const BoundaryPatches& examples = *examples_;
  found.clear();
  const auto nearer = [](const PatchMatch2D& a, const PatchMatch2D& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.patch < b.patch;
  };
  const auto offer = [&](std::uint32_t p, int distance, int turn) {
    const PatchMatch2D match{p, static_cast<std::uint16_t>(turn),
                             static_cast<std::uint16_t>(distance)};
    if (found.size() == wanted && !nearer(match, found.back())) return;
    if (found.size() == wanted) found.pop_back();
    found.insert(std::ranges::upper_bound(found, match, nearer), match);
  };
  const std::uint64_t* bits = set.bits(patch, 0);
  const auto visit = [&](std::uint32_t p) {
    if (!left.empty() && left[p] == 0) return;
    int turn = 0;
    const int distance =
        nearestTurn(bits, examples.bits(p, 0), examples.words(), examples.turns(), &turn);
    offer(p, distance, turn);
  };
  const int inside = set.inside(patch);
  const auto limit = [&] { return found.size() < wanted ? 1 << 30 : int{found.back().distance}; };
  // Outward from the patches with as many inside pixels.
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
