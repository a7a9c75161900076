// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "fft_correlation.h"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "search/block_sum.h"

namespace exemplar {

namespace {

// Centerd values are small, and so are the errors.
constexpr float kCenter = 127.5f;

struct Free {
  void operator()(void* p) const { fftwf_free(p); }
};
template <class T>
using Buffer = std::unique_ptr<T[], Free>;

template <class T>
Buffer<T> buffer(std::size_t count) {
  return Buffer<T>(static_cast<T*>(fftwf_malloc(count * sizeof(T))));
}

}  // namespace

struct FftCorrelation::Impl {
  Array3D<std::uint8_t> source;
  std::size_t spectrum;
  Buffer<float> real, image;
  Buffer<fftwf_complex> values, squares, a, b;
  fftwf_plan forward, backward;
  double valueNorm = 0, squareNorm = 0;
  double squareMean = 0;
  std::int64_t verified = 0;

  explicit Impl(Array3D<std::uint8_t> s) : source(std::move(s)) {
    const Vec3i n = source.size();
    spectrum = static_cast<std::size_t>(n.z) * n.y * (n.x / 2 + 1);
    real = buffer<float>(source.count());
    image = buffer<float>(source.count());
    values = buffer<fftwf_complex>(spectrum);
    squares = buffer<fftwf_complex>(spectrum);
    a = buffer<fftwf_complex>(spectrum);
    b = buffer<fftwf_complex>(spectrum);
    forward = fftwf_plan_dft_r2c_3d(n.z, n.y, n.x, real.get(), a.get(), FFTW_MEASURE);
    backward = fftwf_plan_dft_c2r_3d(n.z, n.y, n.x, a.get(), image.get(), FFTW_MEASURE);
    for (std::size_t i = 0; i < source.count(); ++i) {
      const double v = source.data()[i] - kCenter;
      squareMean += v * v / static_cast<double>(source.count());
    }
    for (std::size_t i = 0; i < source.count(); ++i) {
      real[i] = source.data()[i] - kCenter;
      valueNorm += double{real[i]} * real[i];
    }
    fftwf_execute_dft_r2c(forward, real.get(), values.get());
    for (std::size_t i = 0; i < source.count(); ++i) {
      const float v = source.data()[i] - kCenter;
      real[i] = static_cast<float>(double{v} * v - squareMean);
      squareNorm += double{real[i]} * real[i];
    }
    fftwf_execute_dft_r2c(forward, real.get(), squares.get());
  }
  ~Impl() {
    fftwf_destroy_plan(forward);
    fftwf_destroy_plan(backward);
  }
};

FftCorrelation::FftCorrelation(Array3D<std::uint8_t> source)
    : impl_(std::make_unique<Impl>(std::move(source))) {}
FftCorrelation::~FftCorrelation() = default;
std::int64_t FftCorrelation::verified() const { return impl_->verified; }

BlockMatch FftCorrelation::findBest(const BlockQuery<std::uint8_t>& query) {
  Impl& m = *impl_;
  const Vec3i n = m.source.size(), size = query.samples.size();
  const Vec3i positions = blockPositions(n, size);
  const BlockSum<std::uint8_t> rows(query, n);
  const float scale = 1.0f / static_cast<float>(m.source.count());

  double queryNorm = 0, constant = 0;
  const auto load = [&](bool mask) {
    std::memset(m.real.get(), 0, m.source.count() * sizeof(float));
    for (std::size_t i = 0; i < query.samples.count(); ++i) {
      if (!query.known.empty() && query.known.data()[i] == 0) continue;
      const float q = query.samples.data()[i] - kCenter;
      m.real[m.source.index(query.samples.ijk(i))] = mask ? scale : -2 * q * scale;
      if (mask) continue;
      queryNorm += double{q} * q;
      constant += double{q} * q + m.squareMean;
    }
  };
  load(false);
  fftwf_execute_dft_r2c(m.forward, m.real.get(), m.a.get());
  load(true);
  fftwf_execute_dft_r2c(m.forward, m.real.get(), m.b.get());
  for (std::size_t f = 0; f < m.spectrum; ++f) {
    // Correlation: the query's transform conjugated.
    const float ar = m.a[f][0], ai = -m.a[f][1], br = m.b[f][0], bi = -m.b[f][1];
    const float vr = m.values[f][0], vi = m.values[f][1];
    const float sr = m.squares[f][0], si = m.squares[f][1];
    m.a[f][0] = vr * ar - vi * ai + sr * br - si * bi;
    m.a[f][1] = vr * ai + vi * ar + sr * bi + si * br;
  }
  fftwf_execute_dft_c2r(m.backward, m.a.get(), m.image.get());

  float smallest = std::numeric_limits<float>::max();
  for (int k = 0; k < positions.z; ++k)
    for (int j = 0; j < positions.y; ++j) {
      const float* row = m.image.get() + m.source.index(0, j, k);
      float lanes[16];
      std::fill(lanes, lanes + 16, smallest);
      int i = 0;
      for (; i + 16 <= positions.x; i += 16)
        for (int l = 0; l < 16; ++l) lanes[l] = std::min(lanes[l], row[i + l]);
      for (; i < positions.x; ++i) lanes[0] = std::min(lanes[0], row[i]);
      smallest = *std::min_element(lanes, lanes + 16);
    }
  // A transform's relative error in the 2-norm is about 2^-24 log2(n) at most (the mean is far
  // smaller); three transforms and a product of two follow each other, and no sample's error
  // exceeds the 2-norm.
  const double ulps = 4 * 0x1p-24 * std::log2(static_cast<double>(m.source.count()));
  const double error = ulps * (2 * std::sqrt(m.valueNorm * queryNorm) +
                               std::sqrt(m.squareNorm * static_cast<double>(rows.known())));
  const float within = static_cast<float>(smallest + 2 * error);
  (void)constant;

  BlockMatch best;
  std::int64_t limit = std::numeric_limits<std::int64_t>::max();
  m.verified = 0;
  for (int k = 0; k < positions.z; ++k)
    for (int j = 0; j < positions.y; ++j) {
      const std::size_t row = m.source.index(0, j, k);
      for (int i = 0; i < positions.x; ++i) {
        if (m.image[row + i] > within) continue;
        ++m.verified;
        const std::int64_t sum = rows.sum(m.source.data() + row + i, limit);
        if (sum > limit) continue;
        best = {{i, j, k}, rows.distance(sum), 0};
        limit = sum - 1;
        if (limit < 0) return best;
      }
    }
  return best;
}

}  // namespace exemplar
