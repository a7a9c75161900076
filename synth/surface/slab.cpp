// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/slab.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "sdf/resample.h"

namespace exemplar::surface {
namespace {

/// The share of the lowest layer that is solid where it is ground, and of the highest that may be.
constexpr double kGround = 0.9, kCutTop = 0.02;
/// At most so many heights of a column are compared.
constexpr int kHeights = 24;
/// A turned example repeats itself if it is less unlike than this, of the median of all steps.
constexpr double kTurnRepeats = 0.5;
/// Windows of a turned example may be so much more unlike their best match than its own are.
constexpr double kTurnAlike = 1.12;
constexpr int kWindow = 12, kWindows = 100;
/// Basis vectors are as long and across each other within this share.
constexpr double kSquare = 0.03;

double solidShare(const Array3D<float>& values, int k) {
  std::size_t solid = 0;
  const Vec3i n = values.size();
  for (int j = 0; j < n.y; ++j)
    for (int i = 0; i < n.x; ++i) solid += values(i, j, k) < 0;
  return static_cast<double>(solid) / (static_cast<double>(n.x) * n.y);
}

/// Where each column first leaves the ground, from below.
std::vector<double> groundHeights(const Array3D<float>& values) {
  std::vector<double> heights;
  const Vec3i n = values.size();
  for (int j = 0; j < n.y; ++j) {
    for (int i = 0; i < n.x; ++i) {
      int k = 0;
      while (k < n.z && values(i, j, k) < 0) ++k;
      if (k == 0 || k == n.z) continue;
      const double below = values(i, j, k - 1), above = values(i, j, k);
      heights.push_back(k - 1 + below / (below - above));
    }
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

double quantile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

int differenceOf(std::span<const std::int8_t> a, std::span<const std::int8_t> b) {
  int sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += std::abs(a[k] - b[k]);
  return sum;
}

/// How unlike the slab is to itself turned and then moved by `step`, near its surface.
class TurnedUnlikeness {
 public:
  TurnedUnlikeness(const Slab& slab, int turns, int symmetry)
      : slab_(slab), turn_(rotation(turns, symmetry)) {}

  double at(const Vec2d& step) const {
    double sum = 0;
    std::size_t count = 0;
    for (int j = 0; j < slab_.size().y; j += 2) {
      for (int i = 0; i < slab_.size().x; i += 2) {
        const Vec2d here{static_cast<double>(i), static_cast<double>(j)};
        const Vec2d there = turn_ * here + step;
        if (!slab_.has(there)) continue;
        sum += differenceOf(slab_.column(here), slab_.column(there));
        ++count;
      }
    }
    const double columns = static_cast<double>(slab_.size().x) * slab_.size().y / 4;
    return static_cast<double>(count) < columns / 5 ? std::numeric_limits<double>::max()
                                                    : sum / static_cast<double>(count);
  }

 private:
  const Slab& slab_;
  Mat2d turn_;
};

/// The step after which the turned slab is itself again, if there is one.
std::optional<Vec2d> turnedStep(const Slab& slab, const Lattice& lattice, int turns, int symmetry) {
  const TurnedUnlikeness unlikeness(slab, turns, symmetry);
  const Vec2d middle{(slab.size().x - 1) / 2.0, (slab.size().y - 1) / 2.0};
  const Vec2d center = middle - rotation(turns, symmetry) * middle;
  const double reach = std::max(length(lattice.first), length(lattice.second)) / 2 + 1;
  const int steps = static_cast<int>(std::ceil(reach));
  std::vector<double> all;
  double least = std::numeric_limits<double>::max();
  Vec2d best{};
  for (int j = -steps; j <= steps; ++j) {
    for (int i = -steps; i <= steps; ++i) {
      const Vec2d step = center + Vec2d{static_cast<double>(i), static_cast<double>(j)};
      const double value = unlikeness.at(step);
      if (value == std::numeric_limits<double>::max()) continue;
      all.push_back(value);
      if (value < least) {
        least = value;
        best = step;
      }
    }
  }
  if (all.empty()) return std::nullopt;
  std::sort(all.begin(), all.end());
  if (least > kTurnRepeats * quantile(all, 0.5)) return std::nullopt;
  // Between samples: where lines of equal slope through the neighbors meet.
  const auto between = [&](const Vec2d& one) {
    const double before = unlikeness.at(best - one), after = unlikeness.at(best + one);
    const double rise = std::max(before, after) - least;
    if (!(rise > 0) || rise > 1e9) return 0.0;
    return std::clamp((before - after) / (2 * rise), -0.5, 0.5);
  };
  return best + Vec2d{between({1, 0}), between({0, 1})};
}

bool isSquare(const Lattice& lattice) {
  const double a = length(lattice.first), b = length(lattice.second);
  return lattice.periods == 2 && std::abs(a - b) < kSquare * a &&
         std::abs(dot(lattice.first, lattice.second)) < kSquare * a * b;
}

void makeSquare(Lattice& lattice) {
  const Mat2d quarter = rotation(1, 4);
  const Vec2d back = rotation(3, 4) * lattice.second;
  if (dot(back, lattice.first) < 0) lattice.second = -lattice.second;
  const Vec2d turned = rotation(3, 4) * lattice.second;
  lattice.first = (lattice.first + turned) * 0.5;
  lattice.second = quarter * lattice.first;
}

SlabSymmetry repeatingSymmetry(const Slab& slab, Lattice& lattice, std::optional<int> wanted) {
  const int most = wanted.value_or(4);
  if (most >= 4 && most != 6 && isSquare(lattice)) {
    if (const auto step = turnedStep(slab, lattice, 1, 4)) {
      makeSquare(lattice);
      // middle = turn * middle + step
      const Mat2d quarter = rotation(1, 4);
      const Mat2d less{1 - quarter.xx, -quarter.xy, -quarter.yx, 1 - quarter.yy};
      return {4, less.inverse() * *step};
    }
  }
  if (most >= 2) {
    if (const auto step = turnedStep(slab, lattice, 1, 2)) return {2, *step * 0.5};
  }
  return {1, {(slab.size().x - 1) / 2.0, (slab.size().y - 1) / 2.0}};
}

/// The median difference of windows of a slab, turned, to their best matches in it; windows that
/// overlap with themselves do not count.
double windowUnlikeness(const Slab& slab, int turns, int symmetry) {
  const Vec3i n = slab.size();
  const int spanX = n.x - kWindow, spanY = n.y - kWindow;
  const Mat2d turn = rotation(turns, symmetry);
  const int side = static_cast<int>(std::sqrt(static_cast<double>(kWindows)));
  std::vector<double> best(static_cast<std::size_t>(side) * side);
  parallelFor(0, best.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t w = begin; w < end; ++w) {
      const int x0 = static_cast<int>(w % side) * spanX / (side - 1);
      const int y0 = static_cast<int>(w / side) * spanY / (side - 1);
      int least = std::numeric_limits<int>::max();
      for (int y = 0; y <= spanY; y += 1) {
        for (int x = 0; x <= spanX; x += 1) {
          if (turns == 0 && std::abs(x - x0) < kWindow / 2 && std::abs(y - y0) < kWindow / 2)
            continue;
          int sum = 0;
          for (int j = 0; j < kWindow && sum < least; j += 2) {
            for (int i = 0; i < kWindow; i += 2) {
              const double half = (kWindow - 2) / 2.0;
              const Vec2d local = turn * Vec2d{i - half, j - half};
              const Vec2d there{x + half + local.x, y + half + local.y};
              sum += differenceOf(
                  slab.column(Vec2d{static_cast<double>(x0 + i), static_cast<double>(y0 + j)}),
                  slab.column(there));
            }
          }
          least = std::min(least, sum);
        }
      }
      best[w] = least;
    }
  });
  std::sort(best.begin(), best.end());
  return quantile(best, 0.5);
}

SlabSymmetry stationarySymmetry(const Slab& slab, std::optional<int> wanted) {
  const Vec2d middle{(slab.size().x - 1) / 2.0, (slab.size().y - 1) / 2.0};
  if (wanted) return {*wanted, middle};
  if (std::min(slab.size().x, slab.size().y) < 2 * kWindow) return {1, middle};
  const double own = windowUnlikeness(slab, 0, 4);
  if (windowUnlikeness(slab, 1, 4) <= kTurnAlike * own) return {4, middle};
  if (windowUnlikeness(slab, 1, 2) <= kTurnAlike * own) return {2, middle};
  return {1, middle};
}

}  // namespace

Slab::Slab(const DistanceField& example) : values_(example.size()) {
  const Vec3i n = values_.size();
  const auto voxel = static_cast<float>(example.voxelSize);
  for (std::size_t s = 0; s < values_.count(); ++s)
    values_.values()[s] = example.values.values()[s] / voxel;
  if (n.x < 8 || n.y < 8 || n.z < 2)
    throw InputError("`on`: the example has " + std::to_string(n.x) + " x " + std::to_string(n.y) +
                     " x " + std::to_string(n.z) +
                     " samples, too few to be laid on a surface; use a higher `resolution`");
  if (solidShare(values_, n.z - 1) > kCutTop)
    throw InputError(
        "`on` needs an example that lies flat, with air above it and x and y along it: solid is "
        "cut at the top of its box");
  grounded_ = solidShare(values_, 0) > kGround;
  for (int k = 0; k < n.z; ++k)
    if (solidShare(values_, k) > 0) top_ = k + 0.5;
  if (grounded_) {
    const std::vector<double> heights = groundHeights(values_);
    if (heights.empty()) throw InputError("`on`: the example has no surface");
    low_ = quantile(heights, 0.05);
    high_ = quantile(heights, 0.95);
  } else {
    low_ = n.z;
    high_ = -1;
    for (int k = 0; k < n.z; ++k) {
      if (solidShare(values_, k) == 0) continue;
      low_ = std::min(low_, k - 0.5);
      high_ = std::max(high_, k + 0.5);
    }
    if (high_ < 0) throw InputError("`on`: the example has no surface");
  }
  const int stride = (n.z + kHeights - 1) / kHeights;
  heights_ = (n.z + stride - 1) / stride;
  columns_.reserve(static_cast<std::size_t>(n.x) * n.y * heights_);
  for (int j = 0; j < n.y; ++j) {
    for (int i = 0; i < n.x; ++i) {
      for (int k = stride / 2; k < n.z + stride / 2; k += stride) {
        const double v = values_(i, j, std::min(k, n.z - 1));
        columns_.push_back(
            static_cast<std::int8_t>(std::lround(std::clamp(v, -kLimit, kLimit) * kSteps)));
      }
    }
  }
  columns_.resize(static_cast<std::size_t>(n.x) * n.y * heights_);
}

double Slab::value(const Vec2d& at, double z) const {
  const Vec3i n = size();
  double value = cubicAt(values_, {at.x, at.y, z});
  // Beyond the top it is air, below the bottom of a grounded one solid: farther by the way there.
  if (z > n.z - 1) value += z - (n.z - 1);
  if (z < 0) value += grounded_ ? z : -z;
  return value;
}

std::span<const std::int8_t> Slab::column(const Vec2d& at) const {
  const int i = std::clamp(static_cast<int>(std::lround(at.x)), 0, size().x - 1);
  const int j = std::clamp(static_cast<int>(std::lround(at.y)), 0, size().y - 1);
  return {columns_.data() + (static_cast<std::size_t>(j) * size().x + i) * heights_,
          static_cast<std::size_t>(heights_)};
}

void Slab::column(const Vec2d& at, std::int8_t* out) const {
  const double x = std::clamp(at.x, 0.0, size().x - 1.0), y = std::clamp(at.y, 0.0, size().y - 1.0);
  const int i = std::min(static_cast<int>(x), size().x - 2);
  const int j = std::min(static_cast<int>(y), size().y - 2);
  const auto fx = static_cast<float>(x - i), fy = static_cast<float>(y - j);
  const std::int8_t* a = columns_.data() + (static_cast<std::size_t>(j) * size().x + i) * heights_;
  const std::int8_t* b = a + heights_;
  const std::int8_t* c = a + static_cast<std::size_t>(size().x) * heights_;
  const std::int8_t* d = c + heights_;
  for (int k = 0; k < heights_; ++k) {
    const float lower = a[k] + fx * (b[k] - a[k]), upper = c[k] + fx * (d[k] - c[k]);
    out[k] = static_cast<std::int8_t>(std::lround(lower + fy * (upper - lower)));
  }
}

SlabSymmetry findSymmetry(const Slab& slab, Lattice& lattice, std::optional<int> wanted) {
  return lattice.periods > 0 ? repeatingSymmetry(slab, lattice, wanted)
                             : stationarySymmetry(slab, wanted);
}

Lattice latticeOf(std::span<const Vec3d> basis) {
  constexpr double kFlat = 0.1;
  std::vector<Vec2d> flat;
  for (const Vec3d& v : basis) {
    if (std::abs(v.z) > kFlat * exemplar::length(v)) continue;
    flat.push_back({v.x, v.y});
  }
  Lattice lattice;
  if (flat.empty()) return lattice;
  lattice.first = flat[0];
  lattice.second = rotation(1, 4) * (lattice.first * (1 / length(lattice.first)));
  lattice.periods = 1;
  if (flat.size() > 1) {
    lattice.second = flat[1];
    if (lattice.basis().determinant() < 0) lattice.second = -lattice.second;
    lattice.periods = 2;
  }
  return lattice;
}

}  // namespace exemplar::surface
