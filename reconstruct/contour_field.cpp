// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/contour_field.h"

#include <array>
#include <cmath>
#include <cstdint>

#include "core/cells.h"
#include "core/parallel.h"

namespace exemplar {
namespace {

/// Samples are kept this far from zero, as a share of a typical difference of neighbors: a
/// crossing never falls on a sample, so the corners of a quad lie inside four different cells.
constexpr float kAwayFromZero = 0.005f;

/// How much neighboring samples differ where the sign changes between them, on average: one
/// voxel's length or less for a distance, anything for other scalars. 0 where there is no surface.
double typicalDifference(const DistanceField& field, const Progress& progress) {
  struct Sum {
    double total = 0;
    std::int64_t count = 0;
    Sum& operator+=(const Sum& other) {
      total += other.total;
      count += other.count;
      return *this;
    }
  };
  const Vec3i n = field.size();
  const auto& values = field.values;
  const Sum sum = parallelSum<Sum>(0, n.z, 1, [&](std::size_t k0, std::size_t k1) {
    Sum part;
    const auto visit = [&](float a, float b) {
      if ((a < 0) == (b < 0)) return;
      part.total += std::abs(double{a} - b);
      ++part.count;
    };
    progress.check();
    const CellBox layer{{0, 0, static_cast<int>(k0)}, {n.x, n.y, static_cast<int>(k1)}};
    forEachCell(layer, [&](const Vec3i& p) {
      const float a = values[p];
      if (p.x + 1 < n.x) visit(a, values(p.x + 1, p.y, p.z));
      if (p.y + 1 < n.y) visit(a, values(p.x, p.y + 1, p.z));
      if (p.z + 1 < n.z) visit(a, values(p.x, p.y, p.z + 1));
    });
    return part;
  });
  return sum.count == 0 ? 0 : sum.total / static_cast<double>(sum.count);
}

/// The weights of four samples for a place `t` (0..1) between the middle two, and their
/// derivatives: Catmull and Rom's cubic, which unlike a linear blend follows the curvature of a
/// distance.
void cubicWeights(double t, std::array<double, 4>& weight, std::array<double, 4>& slope) {
  const double t2 = t * t, t3 = t2 * t;
  weight = {(-t3 + 2 * t2 - t) / 2, (3 * t3 - 5 * t2 + 2) / 2, (-3 * t3 + 4 * t2 + t) / 2,
            (t3 - t2) / 2};
  slope = {(-3 * t2 + 4 * t - 1) / 2, (9 * t2 - 10 * t) / 2, (-9 * t2 + 8 * t + 1) / 2,
           (3 * t2 - 2 * t) / 2};
}

}  // namespace

ContourField::ContourField(const DistanceField& field, bool close, const Axes& wraps,
                           const Progress& progress)
    : size_(field.size()), close_(close), wraps_(wraps), padded_(field.size() + Vec3i{2, 2, 2}) {
  const double difference = typicalDifference(field, progress);
  const auto scale =
      static_cast<float>(1 / (difference > 0 ? std::min(difference, field.voxelSize) : 1.0));
  const auto tamed = [&](float v) {
    const float s = std::clamp(v * scale, -kSaturation, kSaturation);
    return v < 0 ? std::min(s, -kAwayFromZero) : std::max(s, kAwayFromZero);
  };
  parallelForEachCell(padded_.size(), [&](const Vec3i& p) {
    if (p.x == 0) progress.check();
    Vec3i at = p - Vec3i{1, 1, 1};
    for (int a = 0; a < 3; ++a) {
      if (wraps_[a]) at[a] = (at[a] + size_[a]) % size_[a];
    }
    const Vec3i inside = field.values.clamped(at);
    const float v = tamed(field.values[inside]);
    padded_[p] = inside != at && close_ ? std::abs(v) : v;
  });
}

double ContourField::smoothValue(const Vec3d& p, Vec3d* gradient) const {
  std::array<std::array<int, 4>, 3> at;
  std::array<std::array<double, 4>, 3> weight, slope;
  for (int a = 0; a < 3; ++a) {
    const int n = size_[a];
    const double x = wraps_[a] ? p[a] : std::clamp(p[a], 0.0, n - 1.0);
    const int base = wraps_[a] ? static_cast<int>(std::floor(x))
                               : std::clamp(static_cast<int>(x), 0, std::max(0, n - 2));
    for (int m = 0; m < 4; ++m) {
      const int i = base - 1 + m;
      at[a][m] = (wraps_[a] ? ((i % n) + n) % n : std::clamp(i, 0, n - 1)) + 1;
    }
    cubicWeights(x - base, weight[a], slope[a]);
  }
  double sum = 0;
  Vec3d slopes{};
  for (int k = 0; k < 4; ++k) {
    double plane = 0, planeX = 0, planeY = 0;
    for (int j = 0; j < 4; ++j) {
      double row = 0, rowX = 0;
      for (int i = 0; i < 4; ++i) {
        const double v = padded_(at[0][i], at[1][j], at[2][k]);
        row += weight[0][i] * v;
        rowX += slope[0][i] * v;
      }
      plane += weight[1][j] * row;
      planeX += weight[1][j] * rowX;
      planeY += slope[1][j] * row;
    }
    sum += weight[2][k] * plane;
    slopes.x += weight[2][k] * planeX;
    slopes.y += weight[2][k] * planeY;
    slopes.z += slope[2][k] * plane;
  }
  if (gradient) *gradient = slopes;
  return sum;
}

double ContourField::value(const Vec3d& p) const {
  double v = smoothValue(p, nullptr);
  if (close_) {
    for (int a = 0; a < 3; ++a) {
      if (!wraps_[a]) v = std::max({v, -0.5 - p[a], p[a] - (size_[a] - 0.5)});
    }
  }
  return v;
}

}  // namespace exemplar
