// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/winding_lanes.h"

#include <cmath>
#include <numbers>

#include "core/simd.h"

namespace exemplar {
namespace {

// The moments times the derivatives of d / |d|^3, the field of a single area vector; each term is
// symmetric in its indices.
EXEMPLAR_MULTIVERSION void addCluster(const ClusterMoments& cluster, int n,
                                      const double* __restrict px, const double* __restrict py,
                                      const double* __restrict pz, double* __restrict sum) {
  const ClusterMoments m = cluster;  // a copy, which no write through a pointer can reach
  const auto& f = m.first;
  const auto& s = m.second;
  const double trace = f[0] + f[1] + f[2];
  const double tx = s[0] + s[5] + s[7], ty = s[1] + s[3] + s[8], tz = s[2] + s[4] + s[6];
  for (int l = 0; l < n; ++l) {
    const double x = m.center.x - px[l], y = m.center.y - py[l], z = m.center.z - pz[l];
    const double xx = x * x, yy = y * y, zz = z * z;
    const double r2 = xx + yy + zz;
    const double inverse2 = 1 / r2, inverse3 = inverse2 / std::sqrt(r2);
    const double linear = m.area.x * x + m.area.y * y + m.area.z * z;
    const double quadratic =
        f[0] * xx + f[1] * yy + f[2] * zz + 2 * (f[3] * x * y + f[4] * x * z + f[5] * y * z);
    const double traces = tx * x + ty * y + tz * z;
    const double cubic =
        s[0] * xx * x + s[1] * yy * y + s[2] * zz * z +
        3 * (xx * (s[3] * y + s[4] * z) + yy * (s[5] * x + s[6] * z) + zz * (s[7] * x + s[8] * y)) +
        6 * s[9] * x * y * z;
    sum[l] += (linear + trace - (3 * quadratic + 4.5 * traces) * inverse2 +
               7.5 * cubic * inverse2 * inverse2) *
              inverse3;
  }
}

EXEMPLAR_MULTIVERSION void addTriangle(const Corners& triangle, int n, const double* __restrict px,
                                       const double* __restrict py, const double* __restrict pz,
                                       double* __restrict real, double* __restrict imaginary,
                                       double* __restrict turns) {
  const Corners t = triangle;
  for (int l = 0; l < n; ++l) {
    const double ax = t[0].x - px[l], ay = t[0].y - py[l], az = t[0].z - pz[l];
    const double bx = t[1].x - px[l], by = t[1].y - py[l], bz = t[1].z - pz[l];
    const double cx = t[2].x - px[l], cy = t[2].y - py[l], cz = t[2].z - pz[l];
    const double la = std::sqrt(ax * ax + ay * ay + az * az);
    const double lb = std::sqrt(bx * bx + by * by + bz * bz);
    const double lc = std::sqrt(cx * cx + cy * cy + cz * cz);
    const double im =
        ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
    // In the triangle's plane the angle counts as 0, also within the triangle.
    const double re = im == 0 ? 1
                              : la * lb * lc + (ax * bx + ay * by + az * bz) * lc +
                                    (bx * cx + by * cy + bz * cz) * la +
                                    (cx * ax + cy * ay + cz * az) * lb;
    // The product of two numbers of size 1 or less, kept from shrinking to 0.
    const double scale = 1 / (std::abs(re) + std::abs(im));
    const double fr = re * scale, fi = im * scale;
    const double r = real[l] * fr - imaginary[l] * fi;
    const double i = real[l] * fi + imaginary[l] * fr;
    // Both angles on one side of 0 and the product on the other: the sum went past half a turn.
    const double up = ((imaginary[l] >= 0) & (fi > 0) & (i < 0)) ? 1.0 : 0.0;
    const double down = ((imaginary[l] < 0) & (fi < 0) & (i >= 0)) ? 1.0 : 0.0;
    turns[l] += up - down;
    const double size = 1 / (std::abs(r) + std::abs(i));
    real[l] = r * size;
    imaginary[l] = i * size;
  }
}

}  // namespace

WindingLanes::WindingLanes(const Vec3d* points, int count) : count_(count) {
  for (int l = 0; l < count; ++l) {
    x_[l] = points[l].x;
    y_[l] = points[l].y;
    z_[l] = points[l].z;
    far_[l] = imaginary_[l] = turns_[l] = 0;
    real_[l] = 1;
  }
}

void WindingLanes::add(const ClusterMoments& cluster) {
  addCluster(cluster, count_, x_.data(), y_.data(), z_.data(), far_.data());
}

void WindingLanes::add(const Corners& triangle) {
  addTriangle(triangle, count_, x_.data(), y_.data(), z_.data(), real_.data(), imaginary_.data(),
              turns_.data());
}

void WindingLanes::finish(double* result) const {
  constexpr double kPerRadian = 0.5 * std::numbers::inv_pi;
  for (int l = 0; l < count_; ++l) {
    result[l] = std::atan2(imaginary_[l], real_[l]) * kPerRadian + turns_[l] +
                far_[l] * (0.25 * std::numbers::inv_pi);
  }
}

}  // namespace exemplar
