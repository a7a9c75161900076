// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/resample.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/parallel.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 1 << 14;

}  // namespace

DistanceField blockAverage(const DistanceField& field, int factor) {
  if (factor < 1)
    throw InputError("the averaging factor is " + std::to_string(factor) + "; it must be >= 1");
  const Vec3i fine = field.size();
  // Not (n + factor - 1) / factor, which would wrap for factors near the largest integer.
  const auto cells = [&](int n) { return n / factor + (n % factor != 0); };
  DistanceField result;
  result.values = Array3D<float>({cells(fine.x), cells(fine.y), cells(fine.z)});
  result.voxelSize = field.voxelSize * factor;
  result.truncation = field.truncation;
  const double shift = (factor - 1.0) / 2 * field.voxelSize;
  result.origin = field.origin + Vec3d{shift, shift, shift};
  const Vec3i coarse = result.size();
  parallelFor(
      0, static_cast<std::size_t>(coarse.z) * coarse.y, 4, [&](std::size_t b, std::size_t e) {
        for (std::size_t row = b; row < e; ++row) {
          const int cj = static_cast<int>(row % coarse.y), ck = static_cast<int>(row / coarse.y);
          for (int ci = 0; ci < coarse.x; ++ci) {
            const Vec3i low = Vec3i{ci, cj, ck} * factor;
            const auto end = [&](int start, int n) {
              return n - start > factor ? start + factor : n;
            };
            const Vec3i high{end(low.x, fine.x), end(low.y, fine.y), end(low.z, fine.z)};
            double sum = 0;
            for (int k = low.z; k < high.z; ++k)
              for (int j = low.y; j < high.y; ++j) {
                const float* samples = field.values.data() + field.values.index(low.x, j, k);
                for (int i = 0; i < high.x - low.x; ++i) sum += samples[i];
              }
            result.values(ci, cj, ck) =
                static_cast<float>(sum / static_cast<double>(volume(high - low)));
          }
        }
      });
  return result;
}

double cubicAt(const Array3D<float>& values, const Vec3d& at) {
  const Vec3i& n = values.size();
  std::array<std::array<int, 4>, 3> index;
  std::array<std::array<double, 4>, 3> weight;
  for (int axis = 0; axis < 3; ++axis) {
    const double x = std::clamp(at[axis], 0.0, n[axis] - 1.0);
    const int below = std::min(static_cast<int>(x), std::max(n[axis] - 2, 0));
    const double f = x - below;
    for (int k = 0; k < 4; ++k) index[axis][k] = std::clamp(below + k - 1, 0, n[axis] - 1);
    weight[axis] = {0.5 * f * (f * (2 - f) - 1), 0.5 * (f * f * (3 * f - 5) + 2),
                    0.5 * f * (f * (4 - 3 * f) + 1), 0.5 * f * f * (f - 1)};
  }
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    double layer = 0;
    for (int j = 0; j < 4; ++j) {
      double row = 0;
      for (int i = 0; i < 4; ++i)
        row += weight[0][i] * values(index[0][i], index[1][j], index[2][k]);
      layer += weight[1][j] * row;
    }
    sum += weight[2][k] * layer;
  }
  return sum;
}

float sampleCubic(const DistanceField& field, const Vec3d& xyz) {
  return static_cast<float>(cubicAt(field.values, (xyz - field.origin) / field.voxelSize));
}

float sampleTrilinear(const DistanceField& field, const Vec3d& xyz) {
  const Vec3d last = cast<double>(field.size() - Vec3i{1, 1, 1});
  const Vec3d ijk = min(max(field.index(xyz), Vec3d{}), last);
  const Vec3i a = cast<int>(ijk);  // rounds down: no component is negative
  const Vec3i b = field.values.clamped(a + Vec3i{1, 1, 1});
  const Vec3d t = ijk - cast<double>(a);
  const auto& v = field.values;
  const auto mix = [](double p, double q, double s) { return p + (q - p) * s; };
  const auto alongX = [&](int j, int k) { return mix(v(a.x, j, k), v(b.x, j, k), t.x); };
  const double below = mix(alongX(a.y, a.z), alongX(b.y, a.z), t.y);
  const double above = mix(alongX(a.y, b.z), alongX(b.y, b.z), t.y);
  return static_cast<float>(mix(below, above, t.z));
}

QuantizedField quantize(const DistanceField& field, float range) {
  if (!(range > 0 && range < std::numeric_limits<float>::infinity()))
    throw InputError("the range to quantize is " + std::to_string(range) +
                     "; it must be > 0 and finite");
  QuantizedField result{Array3D<std::uint8_t>(field.size()), -range, range};
  const auto values = field.values.values();
  const auto levels = result.levels.values();
  parallelFor(0, values.size(), kGrain, [&](std::size_t b, std::size_t e) {
    for (std::size_t s = b; s < e; ++s) {
      const double share = std::clamp((double{values[s]} + range) / (2.0 * range), 0.0, 1.0);
      levels[s] = static_cast<std::uint8_t>(share * 255 + 0.5);
    }
  });
  return result;
}

}  // namespace exemplar
