// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/fourier.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "core/simd.h"

namespace exemplar {
namespace {

constexpr std::size_t kLines = 32;  // transformed together, so that loops over them vectorize

/// One pass over `n` = r m rows of `width` numbers: y[r p + k] = w^(p k) sum over j of
/// x[p + m j] w_r^(j k).
struct Pass {
  std::size_t r, m, width;
  std::size_t turn;  ///< the whole length over n: w = root^turn
};

/// Powers of exp(-2 pi i / length).
struct Roots {
  std::vector<float> re, im;
};

EXEMPLAR_MULTIVERSION
void pass2(const Pass& g, const Roots& w, const float* xr, const float* xi, float* yr, float* yi) {
  for (std::size_t p = 0; p < g.m; ++p) {
    const float c = w.re[p * g.turn], s = w.im[p * g.turn];
    const float *ar = xr + p * g.width, *ai = xi + p * g.width;
    const float *br = ar + g.m * g.width, *bi = ai + g.m * g.width;
    float *er = yr + 2 * p * g.width, *ei = yi + 2 * p * g.width;
    float *fr = er + g.width, *fi = ei + g.width;
    for (std::size_t q = 0; q < g.width; ++q) {
      const float dr = ar[q] - br[q], di = ai[q] - bi[q];
      er[q] = ar[q] + br[q];
      ei[q] = ai[q] + bi[q];
      fr[q] = dr * c - di * s;
      fi[q] = dr * s + di * c;
    }
  }
}

EXEMPLAR_MULTIVERSION
void pass4(const Pass& g, const Roots& w, const float* xr, const float* xi, float* yr, float* yi) {
  const std::size_t step = g.m * g.width;
  for (std::size_t p = 0; p < g.m; ++p) {
    const std::size_t t = p * g.turn;
    const float c1 = w.re[t], s1 = w.im[t], c2 = w.re[2 * t], s2 = w.im[2 * t];
    const float c3 = w.re[3 * t], s3 = w.im[3 * t];
    const float *ar = xr + p * g.width, *ai = xi + p * g.width;
    float *zr = yr + 4 * p * g.width, *zi = yi + 4 * p * g.width;
    for (std::size_t q = 0; q < g.width; ++q) {
      const float r0 = ar[q] + ar[q + 2 * step], i0 = ai[q] + ai[q + 2 * step];
      const float r1 = ar[q] - ar[q + 2 * step], i1 = ai[q] - ai[q + 2 * step];
      const float r2 = ar[q + step] + ar[q + 3 * step], i2 = ai[q + step] + ai[q + 3 * step];
      const float r3 = ai[q + step] - ai[q + 3 * step], i3 = ar[q + 3 * step] - ar[q + step];
      zr[q] = r0 + r2;
      zi[q] = i0 + i2;
      zr[q + g.width] = (r1 + r3) * c1 - (i1 + i3) * s1;
      zi[q + g.width] = (r1 + r3) * s1 + (i1 + i3) * c1;
      zr[q + 2 * g.width] = (r0 - r2) * c2 - (i0 - i2) * s2;
      zi[q + 2 * g.width] = (r0 - r2) * s2 + (i0 - i2) * c2;
      zr[q + 3 * g.width] = (r1 - r3) * c3 - (i1 - i3) * s3;
      zi[q + 3 * g.width] = (r1 - r3) * s3 + (i1 - i3) * c3;
    }
  }
}

/// Any radix, by the definition.
EXEMPLAR_MULTIVERSION
void passAny(const Pass& g, const Roots& w, const float* xr, const float* xi, float* yr,
             float* yi) {
  const std::size_t length = w.re.size();
  for (std::size_t p = 0; p < g.m; ++p)
    for (std::size_t k = 0; k < g.r; ++k) {
      float *zr = yr + (g.r * p + k) * g.width, *zi = yi + (g.r * p + k) * g.width;
      std::fill(zr, zr + g.width, 0.0f);
      std::fill(zi, zi + g.width, 0.0f);
      for (std::size_t j = 0; j < g.r; ++j) {
        // w_r^(j k) w^(p k)
        const std::size_t t = (j * k * (length / g.r) + p * k * g.turn) % length;
        const float c = w.re[t], s = w.im[t];
        const float *ar = xr + (p + g.m * j) * g.width, *ai = xi + (p + g.m * j) * g.width;
        for (std::size_t q = 0; q < g.width; ++q) {
          zr[q] += ar[q] * c - ai[q] * s;
          zi[q] += ar[q] * s + ai[q] * c;
        }
      }
    }
}

/// Transforms of one length.
class Transform {
 public:
  explicit Transform(int length) : length_(static_cast<std::size_t>(length)) {
    std::size_t left = length_;
    while (left % 4 == 0) radices_.push_back(4), left /= 4;
    for (std::size_t r = 2; left > 1; ++r)
      for (; left % r == 0; left /= r) radices_.push_back(r);
    for (std::size_t t = 0; t < length_; ++t) {
      const double angle =
          -2 * std::numbers::pi * static_cast<double>(t) / static_cast<double>(length_);
      roots_.re.push_back(static_cast<float>(std::cos(angle)));
      roots_.im.push_back(static_cast<float>(std::sin(angle)));
    }
  }

  /// Transforms `kLines` lines at once, of which sample i is at i * kLines, with room for as many
  /// in `yr` and `yi`.
  void operator()(float* xr, float* xi, float* yr, float* yi) const {
    float* const intoR = xr;
    float* const intoI = xi;
    std::size_t n = length_, lines = kLines;
    for (const std::size_t r : radices_) {
      const Pass pass{r, n / r, lines, length_ / n};
      (r == 4 ? pass4 : r == 2 ? pass2 : passAny)(pass, roots_, xr, xi, yr, yi);
      std::swap(xr, yr);
      std::swap(xi, yi);
      n /= r;
      lines *= r;
    }
    if (xr == intoR) return;
    std::copy(xr, xr + length_ * kLines, intoR);
    std::copy(xi, xi + length_ * kLines, intoI);
  }

 private:
  std::size_t length_;
  std::vector<std::size_t> radices_;
  Roots roots_;
};

/// Transforms `re` + i `im` along one axis, in place.
void transformAxis(Array3D<float>& re, Array3D<float>& im, int axis, const Progress& progress) {
  const Vec3i size = re.size();
  const auto length = static_cast<std::size_t>(size[axis]);
  if (length == 1) return;
  const Transform transform(size[axis]);
  // Samples of a line are `inner` apart; lines that begin beside each other are taken together.
  std::size_t inner = 1;
  for (int a = 0; a < axis; ++a) inner *= static_cast<std::size_t>(size[a]);
  const std::size_t lines = re.count() / length;
  const auto begin = [&](std::size_t line) { return line / inner * inner * length + line % inner; };
  parallelFor(0, (lines + kLines - 1) / kLines, 4, [&](std::size_t first, std::size_t last) {
    std::vector<float> room(4 * length * kLines);
    float *xr = room.data(), *xi = xr + length * kLines;
    float *yr = xi + length * kLines, *yi = yr + length * kLines;
    for (std::size_t group = first; group < last; ++group) {
      progress.check();
      const std::size_t from = group * kLines, count = std::min(kLines, lines - from);
      std::size_t at[kLines];
      for (std::size_t l = 0; l < count; ++l) at[l] = begin(from + l);
      for (std::size_t t = 0; t < length; ++t)
        for (std::size_t l = 0; l < count; ++l) {
          xr[t * kLines + l] = re.data()[at[l] + t * inner];
          xi[t * kLines + l] = im.data()[at[l] + t * inner];
        }
      transform(xr, xi, yr, yi);
      for (std::size_t t = 0; t < length; ++t)
        for (std::size_t l = 0; l < count; ++l) {
          re.data()[at[l] + t * inner] = xr[t * kLines + l];
          im.data()[at[l] + t * inner] = xi[t * kLines + l];
        }
    }
  });
}

}  // namespace

Array3D<float> circularCorrelation(const Array3D<float>& a, const Array3D<float>& b,
                                   const Progress& progress) {
  assert(a.size() == b.size());
  // Both are real, so one transform of a + i b has both spectra in it.
  Array3D<float> re = a, im = b;
  for (int axis = 0; axis < 3; ++axis) transformAxis(re, im, axis, progress);
  // C(k) = A(k) conj(B(k)), and C(-k) = conj(C(k)), scaled for the way back.
  const Vec3i n = a.size();
  const auto scale = static_cast<float>(1.0 / static_cast<double>(a.count()));
  parallelFor(0, static_cast<std::size_t>(n.z), 4, [&](std::size_t z0, std::size_t z1) {
    for (int z = static_cast<int>(z0); z < static_cast<int>(z1); ++z)
      for (int y = 0; y < n.y; ++y)
        for (int x = 0; x < n.x; ++x) {
          const std::size_t k = re.index(x, y, z);
          const std::size_t l = re.index((n.x - x) % n.x, (n.y - y) % n.y, (n.z - z) % n.z);
          if (l < k) continue;  // done with its opposite, by whoever has that
          const float zr = re.data()[k], zi = im.data()[k];
          const float or_ = re.data()[l], oi = im.data()[l];
          // A = (Z(k) + conj(Z(-k))) / 2, B = (Z(k) - conj(Z(-k))) / 2i.
          const float ar = (zr + or_) / 2, ai = (zi - oi) / 2;
          const float br = (zi + oi) / 2, bi = (or_ - zr) / 2;
          const float cr = (ar * br + ai * bi) * scale, ci = (ai * br - ar * bi) * scale;
          re.data()[k] = cr;
          im.data()[k] = ci;
          re.data()[l] = cr;
          im.data()[l] = l == k ? ci : -ci;
        }
  });
  // The way back is the way there with the parts exchanged.
  for (int axis = 0; axis < 3; ++axis) transformAxis(im, re, axis, progress);
  return re;
}

int quickLength(int n) {
  for (;; ++n) {
    int left = n;
    for (const int prime : {2, 3, 5})
      while (left % prime == 0) left /= prime;
    if (left == 1) return n;
  }
}

}  // namespace exemplar
