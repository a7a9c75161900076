// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/layered/texture_level.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/cells.h"
#include "core/error.h"
#include "core/simd.h"

namespace exemplar {
namespace {

constexpr int kSweeps = 4;  // of PatchMatch in a round
constexpr float kFar = std::numeric_limits<float>::infinity();

/// The sum of squared differences of `rows` rows of `count` values, in four lanes.
EXEMPLAR_MULTIVERSION
float rowsDistance(const float* a, std::size_t strideA, const float* b, std::size_t strideB,
                   int rows, int count) {
  float lanes[4] = {}, rest = 0;
  for (int row = 0; row < rows; ++row, a += strideA, b += strideB) {
    int v = 0;
    for (; v + 4 <= count; v += 4)
      for (int lane = 0; lane < 4; ++lane) {
        const float d = a[v + lane] - b[v + lane];
        lanes[lane] += d * d;
      }
    for (; v < count; ++v) rest += (a[v] - b[v]) * (a[v] - b[v]);
  }
  return lanes[0] + lanes[1] + lanes[2] + lanes[3] + rest;
}

/// The median of the costs of the cells that are searched.
float median(const Array3D<float>& costs, const Shape& among) {
  std::vector<float> sorted;
  for (std::size_t p = 0; p < costs.count(); ++p)
    if (among.empty() || among.data()[p]) sorted.push_back(costs.data()[p]);
  if (sorted.empty()) return 1;
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, at);
  return std::max(*at, 1e-6f);
}

/// Whether any cell of the box that lies on the grid is in the shape.
bool touchesBox(const Shape& shape, const CellBox& box) {
  bool touches = false;
  forEachCell(box & CellBox::of(shape.size()), [&](const Vec3i& p) { touches |= shape[p] != 0; });
  return touches;
}

/// Means of the values over a patch, on the torus.
Array3D<float> meansOver(Array3D<float> values, const Vec3i& reach) {
  const Vec3i& size = values.size();
  for (int axis = 0; axis < 3; ++axis) {
    if (reach[axis] == 0) continue;
    Array3D<float> sums(size);
    Vec3i step{};
    step[axis] = 1;
    parallelForEachCell(size, [&](const Vec3i& p) {
      float sum = 0;
      for (int d = -reach[axis]; d <= reach[axis]; ++d)
        sum += values[wrappedPlace(p + step * d, size)];
      sums[p] = sum / static_cast<float>(2 * reach[axis] + 1);
    });
    values = std::move(sums);
  }
  return values;
}

}  // namespace

TextureLevel::TextureLevel(const TextureFeatures& example, TextureFeatures result,
                           const Shape* hole, const TextureOptions& options, const Random& random)
    : example_(example),
      result_(std::move(result)),
      hole_(hole),
      options_(options),
      random_(random),
      reach_{options.patch / 2, options.patch / 2, patchDepth(example.size, options.patch) / 2},
      patchCells_(patchCells(example.size, options.patch)),
      origins_(result_.size),
      costs_(result_.size, kFar) {
  if (!hole) return;
  free_ = serves_ = Shape(result_.size);
  const Vec3i one{1, 1, 1};
  parallelForEachCell(result_.size, [&](const Vec3i& p) {
    free_[p] = touchesBox(*hole, {p - reach_, p + reach_ + one});
    serves_[p] = !free_[p] && p == inside(p);
  });
  forEachCell(result_.size, [&](const Vec3i& p) {
    if (serves_[p]) serving_.push_back(p);
    origins_[p] = p;
    if (!free_[p]) costs_[p] = 0;
  });
  if (serving_.empty())
    throw InputError("the hole leaves no whole patch of the example; make it smaller");
}

Vec3i TextureLevel::inside(const Vec3i& place) const {
  if (options_.exampleWraps) return wrappedPlace(place, example_.size);
  return max(reach_, min(place, example_.size - reach_ - Vec3i{1, 1, 1}));
}

bool TextureLevel::isInside(const Vec3i& place) const {
  if (options_.exampleWraps) return true;
  for (int axis = 0; axis < 3; ++axis)
    if (place[axis] < reach_[axis] || place[axis] >= example_.size[axis] - reach_[axis])
      return false;
  return serves_.empty() || serves_[place];
}

Vec3i TextureLevel::anyPlace(std::uint64_t bits) const {
  if (!serving_.empty())
    return serving_[static_cast<std::size_t>(((bits >> 32) * serving_.size()) >> 32)];
  const Vec3i margin = options_.exampleWraps ? Vec3i{} : reach_;
  Vec3i place = margin;
  // Twenty-one bits for each axis.
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::uint64_t>(example_.size[axis] - 2 * margin[axis]);
    place[axis] += static_cast<int>((((bits >> (21 * axis)) & 0x1fffff) * n) >> 21);
  }
  return place;
}

void TextureLevel::startAtRandom() {
  constexpr std::uint32_t kDrawn = 24;
  parallelForEachCell(result_.size, [&](const Vec3i& at) {
    const std::size_t p = origins_.index(at);
    if (!isFree(p)) return;
    float least = kFar;
    for (std::uint32_t d = 0; d < kDrawn; ++d) {
      const Vec3i place = anyPlace(random_.bits(p, d));
      const float* a = example_.at(place);
      const float* b = result_.at(at);
      float distance = 0;
      for (int g = 0; g < example_.guides; ++g) distance += (a[g] - b[g]) * (a[g] - b[g]);
      if (distance >= least) continue;
      least = distance;
      origins_.data()[p] = place;
    }
  });
  vote(false);
}

void TextureLevel::startFrom(const TextureOrigins& coarser) {
  const bool flat = result_.size.z == 1;
  parallelForEachCell(result_.size, [&](const Vec3i& at) {
    const std::size_t p = origins_.index(at);
    if (!isFree(p)) return;
    const Vec3i half{at.x / 2, at.y / 2, flat ? 0 : at.z / 2};
    const Vec3i odd{at.x % 2, at.y % 2, flat ? 0 : at.z % 2};
    const Vec3i& place = coarser[coarser.clamped(half)];
    const Vec3i twice{2 * place.x, 2 * place.y, flat ? 0 : 2 * place.z};
    const Vec3i there = inside(twice + odd);
    origins_.data()[p] = isInside(there) ? there : anyPlace(random_.bits(p, 999));
  });
  vote(false);
}

void TextureLevel::run(int rounds, const Progress& progress) {
  for (int round = 0; round < rounds; ++round) {
    progress.report("following the layers", static_cast<double>(round) / rounds);
    countUses();
    parallelForEachCell(result_.size, [&](const Vec3i& at) {
      if (isFree(costs_.index(at))) costs_[at] = cost(at, origins_[at], kFar);
    });
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      progress.check();
      search(round * kSweeps + sweep, kSweeps - 1 - sweep);
    }
    vote(true);
  }
}

/// The squared difference of the patches, and what the place's overuse costs; at least `limit`
/// where it is not below.
float TextureLevel::cost(const Vec3i& at, const Vec3i& place, float limit) const {
  float sum = overuse(place);
  const int n = example_.values;
  const auto within = [&](const Vec3i& p, const Vec3i& size) {
    return p.x >= reach_.x && p.y >= reach_.y && p.z >= reach_.z && p.x < size.x - reach_.x &&
           p.y < size.y - reach_.y && p.z < size.z - reach_.z;
  };
  if (within(at, result_.size) && within(place, example_.size)) {
    const auto strideA = static_cast<std::size_t>(result_.size.x * n);
    const auto strideB = static_cast<std::size_t>(example_.size.x * n);
    for (int dz = -reach_.z; dz <= reach_.z && sum < limit; ++dz) {
      const Vec3i corner{-reach_.x, -reach_.y, dz};
      sum += rowsDistance(result_.at(at + corner), strideA, example_.at(place + corner), strideB,
                          2 * reach_.y + 1, n * (2 * reach_.x + 1));
    }
    return sum;
  }
  for (int dz = -reach_.z; dz <= reach_.z; ++dz) {
    for (int dy = -reach_.y; dy <= reach_.y; ++dy) {
      for (int dx = -reach_.x; dx <= reach_.x; ++dx) {
        const Vec3i step{dx, dy, dz};
        Vec3i p = at + step;
        if (options_.wraps) {
          p = wrappedPlace(p, result_.size);
        } else {
          p = max(Vec3i{}, min(p, result_.size - Vec3i{1, 1, 1}));
        }
        const float* a = result_.at(p);
        const float* b = example_.at(wrappedPlace(place + step, example_.size));
        for (int v = 0; v < n; ++v) sum += (a[v] - b[v]) * (a[v] - b[v]);
      }
    }
    if (sum >= limit) return sum;
  }
  return sum;
}

/// How often places were used, in fair shares, when the round began: the mean over a patch, for a
/// patch covers all its cells.
void TextureLevel::countUses() {
  Array3D<float> counts(example_.size);
  for (const Vec3i& place : origins_.values()) ++counts[place];
  const float fair = static_cast<float>(origins_.count()) / static_cast<float>(counts.count());
  uses_ = meansOver(std::move(counts), reach_);
  for (float& uses : uses_.values()) uses /= fair;
}

float TextureLevel::overuse(const Vec3i& place) const {
  const float excess = uses_[place] - 1;
  return excess > 0 ? static_cast<float>(options_.evenness) * 0.02f * excess *
                          static_cast<float>(patchCells_)
                    : 0;
}

/// One sweep: neighbors' places, moved along, and a few drawn around the own one. Cells read the
/// places that the sweep began with, so that their order does not matter.
void TextureLevel::search(int sweep, int reach) {
  const TextureOrigins before = origins_;
  const int step = 1 << reach;
  const Vec3i& size = result_.size;
  parallelForEachCell(size, [&](const Vec3i& at) {
    const std::size_t p = origins_.index(at);
    if (!isFree(p)) return;
    Vec3i best = before.data()[p];
    float least = costs_.data()[p];
    const auto offer = [&](const Vec3i& place) {
      if (place == best || !isInside(place)) return;
      const Vec3i there = options_.exampleWraps ? inside(place) : place;
      const float found = cost(at, there, least);
      if (found >= least) return;
      least = found;
      best = there;
    };
    for (int axis = 0; axis < 3; ++axis) {
      if (size[axis] == 1) continue;
      for (const int sign : {-1, 1}) {
        Vec3i s{};
        s[axis] = sign * step;
        Vec3i neighbor = at + s;
        if (options_.wraps) {
          neighbor = wrappedPlace(neighbor, size);
        } else if (!origins_.contains(neighbor)) {
          continue;
        }
        offer(before[neighbor] - s);
      }
    }
    int radius = std::max({example_.size.x, example_.size.y, example_.size.z});
    for (std::uint32_t draw = 0; radius >= 1; radius /= 4, ++draw) {
      const std::uint64_t bits =
          random_.bits(p, 1000 + static_cast<std::uint32_t>(sweep) * 16 + draw);
      const auto span = static_cast<std::uint64_t>(2 * radius + 1);
      Vec3i place = best;
      for (int axis = 0; axis < 3; ++axis) {
        if (size[axis] == 1) continue;
        place[axis] += static_cast<int>((((bits >> (21 * axis)) & 0x1fffff) * span) >> 21) - radius;
      }
      offer(inside(place));
    }
    origins_.data()[p] = best;
    costs_.data()[p] = least;
  });
}

/// Sets each cell's texture to the mean of what the patches over it say; those that fit well count
/// more where it weighs. The guide stays, and so does what lies outside a hole.
void TextureLevel::vote(bool weighs) {
  Array3D<float> weights(result_.size, 1.0f);
  if (weighs) {
    const float spread = median(costs_, free_);
    for (std::size_t p = 0; p < weights.count(); ++p)
      weights.data()[p] = std::exp(-std::min(costs_.data()[p] / spread, 40.0f)) + 1e-6f;
  }
  const int n = example_.values, first = example_.guides;
  TextureFeatures voted = result_;
  parallelForEachCell(result_.size, [&](const Vec3i& at) {
    if (hole_ && !(*hole_)[at]) return;
    float sums[64] = {}, all = 0;
    for (int dz = -reach_.z; dz <= reach_.z; ++dz) {
      for (int dy = -reach_.y; dy <= reach_.y; ++dy) {
        for (int dx = -reach_.x; dx <= reach_.x; ++dx) {
          const Vec3i step{dx, dy, dz};
          Vec3i p = at + step;
          if (options_.wraps) {
            p = wrappedPlace(p, result_.size);
          } else if (!origins_.contains(p)) {
            continue;
          }
          const float* from = example_.at(wrappedPlace(origins_[p] - step, example_.size));
          const float weight = weights[p];
          for (int v = first; v < n; ++v) sums[v] += weight * from[v];
          all += weight;
        }
      }
    }
    float* to = voted.at(at);
    for (int v = first; v < n; ++v) to[v] = sums[v] / all;
  });
  result_ = std::move(voted);
}

}  // namespace exemplar
