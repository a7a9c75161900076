// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/cell_features.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "core/random.h"
#include "core/simd.h"

namespace exemplar {

namespace {

constexpr int kDegrees = 3;       // 0, 1, 2
constexpr double kHalf = 16384;   // the number of coefficient 0
constexpr double kReach = 16000;  // of the largest coefficient

// out[i] += weight * in[i]. Unfused, so that every machine gives the same.
EXEMPLAR_MULTIVERSION void addScaled(const float* in, float weight, float* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] += weight * in[i];
}

template <class Sample>
void centered(const Sample* in, float middle, float* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<float>(in[i]) - middle;
}

EXEMPLAR_MULTIVERSION void roundToNumbers(const float* in, float scale, std::int16_t* out,
                                          std::size_t count, std::size_t stride) {
  for (std::size_t i = 0; i < count; ++i) {
    float v = in[i] * scale + 16384.5f;
    v = v < 0 ? 0 : v > 32767 ? 32767 : v;
    out[i * stride] = static_cast<std::int16_t>(v);
  }
}

double innerProduct(const Array3D<double>& cell, const Vec3i& degrees,
                    const CellFeatures::Polynomials& polynomials) {
  double sum = 0;
  for (std::size_t s = 0; s < cell.count(); ++s) {
    const Vec3i p = cell.ijk(s);
    sum += cell.data()[s] * polynomials[0][degrees.x][p.x] * polynomials[1][degrees.y][p.y] *
           polynomials[2][degrees.z][p.z];
  }
  return sum;
}

// Rounding of three chains of products and sums, in numbers: each of `steps` operations is off by
// at most 2^-24 of a value that no coefficient exceeds.
double roundingError(const Vec3i& cell) {
  return (cell.x + cell.y + cell.z + 8) * 0x1p-23 * kReach;
}

}  // namespace

std::vector<std::vector<double>> orthonormalPolynomials(int length, int count) {
  std::vector<std::vector<double>> result;
  for (int degree = 0; degree < std::min(length, count); ++degree) {
    std::vector<double> p(static_cast<std::size_t>(length));
    for (int i = 0; i < length; ++i) p[i] = std::pow((2.0 * i + 1 - length) / length, degree);
    for (int pass = 0; pass < 2; ++pass)
      for (const auto& lower : result) {
        double product = 0;
        for (int i = 0; i < length; ++i) product += p[i] * lower[i];
        for (int i = 0; i < length; ++i) p[i] -= product * lower[i];
      }
    double norm = 0;
    for (double v : p) norm += v * v;
    for (double& v : p) v /= std::sqrt(norm);
    result.push_back(std::move(p));
  }
  return result;
}

CellLayout::CellLayout(const Vec3i& block, bool equal) {
  for (int cell = 0; cell < 8; ++cell) {
    Vec3i begin{}, length{};
    bool exists = true;
    for (int axis = 0; axis < 3; ++axis) {
      const bool second = (cell >> axis & 1) != 0;
      const int side = block[axis];
      const int lower = side == 1 ? 1 : equal ? side / 2 : (side + 1) / 2;
      const int upper = side / 2;
      if (second && side == 1) exists = false;
      begin[axis] = second ? side - upper : 0;
      length[axis] = second ? upper : lower;
    }
    if (!exists) continue;
    first[cell] = begin;
    size[cell] = length;
  }
}

template <class Sample>
CellFeatures::CellFeatures(const CellLayout& layout,
                           std::span<const Array3D<Sample>* const> sources, double low, double high)
    : layout_(layout), middle_(static_cast<float>((low + high) / 2)) {
  double largest = 1;
  for (int c = 0; c < 8; ++c)
    if (layout.there(c)) {
      for (int axis = 0; axis < 3; ++axis) {
        polynomials_[c][axis] = orthonormalPolynomials(layout.size[c][axis], kDegrees);
        for (const std::vector<double>& p : polynomials_[c][axis])
          weights_[c][axis].emplace_back(p.begin(), p.end());
      }
      largest = std::max(largest, static_cast<double>(volume(layout.size[c])));
      margin_ = std::max(margin_, static_cast<int>(std::ceil(0.5 + roundingError(layout.size[c]))));
    }
  // No coefficient exceeds the length of its cell as a vector.
  const double reach = std::max((high - low) / 2 * std::sqrt(largest), 1e-30);
  scale_ = kReach / reach;

  // How much each polynomial's coefficient varies over a sample of the sources' cells.
  const Vec3i cell = layout.size[0];
  const Polynomials& polynomials = polynomials_[0];
  struct Choice {
    Vec3i degrees;
    double sum = 0, squares = 0, variance = 0;
  };
  std::vector<Choice> choices;
  for (int total = 0; total < kDegrees; ++total)
    for (int z = 0; z <= total; ++z)
      for (int y = 0; y + z <= total; ++y) {
        const Vec3i degrees{total - y - z, y, z};
        if (min(degrees, cell - Vec3i{1, 1, 1}) == degrees) choices.push_back({degrees});
      }
  const Random random(0, stream::kCellFeatures);
  const std::size_t draws =
      static_cast<std::size_t>(std::clamp(4e6 / static_cast<double>(volume(cell)), 64.0, 512.0));
  Array3D<double> samples(cell);
  for (std::size_t d = 0; d < draws; ++d) {
    const Array3D<Sample>& source = *sources[d % sources.size()];
    const Vec3i places = source.size() - cell + Vec3i{1, 1, 1};
    const Vec3i at{static_cast<int>(random.below(static_cast<std::uint32_t>(places.x), d, 0)),
                   static_cast<int>(random.below(static_cast<std::uint32_t>(places.y), d, 1)),
                   static_cast<int>(random.below(static_cast<std::uint32_t>(places.z), d, 2))};
    for (std::size_t s = 0; s < samples.count(); ++s)
      samples.data()[s] = static_cast<double>(source[at + samples.ijk(s)]) - middle_;
    for (Choice& choice : choices) {
      const double c = innerProduct(samples, choice.degrees, polynomials);
      choice.sum += c;
      choice.squares += c * c;
    }
  }
  for (Choice& choice : choices)
    choice.variance = choice.squares - choice.sum * choice.sum / static_cast<double>(draws);
  std::stable_sort(choices.begin() + 1, choices.end(),
                   [](const Choice& a, const Choice& b) { return a.variance > b.variance; });
  for (int f = 0; f < kCount; ++f)
    degrees_[f] = f < static_cast<int>(choices.size()) ? choices[f].degrees : Vec3i{-1, -1, -1};
}

bool CellFeatures::there(int cell, int f) const {
  const Vec3i last = layout_.size[cell] - Vec3i{1, 1, 1};
  return layout_.there(cell) && degrees_[f].x >= 0 && min(degrees_[f], last) == degrees_[f];
}

std::int16_t CellFeatures::number(double coefficient) const {
  return static_cast<std::int16_t>(std::clamp(coefficient, 0.0, 32767.0));
}

template <class Sample>
Array3D<CellFeatures::Numbers> CellFeatures::ofSource(const Array3D<Sample>& source,
                                                      const Vec3i& cell) const {
  const Vec3i size = source.size();
  const Vec3i places = size - cell + Vec3i{1, 1, 1};
  Array3D<Numbers> numbers(places, Numbers{});
  std::array<std::vector<std::vector<double>>, 3> polynomials;
  for (int axis = 0; axis < 3; ++axis)
    polynomials[axis] = orthonormalPolynomials(cell[axis], kDegrees);
  const auto exists = [&](int f) {
    return degrees_[f].x >= 0 && min(degrees_[f], cell - Vec3i{1, 1, 1}) == degrees_[f];
  };

  Array3D<float> slices({places.x, places.y, size.z});
  for (int f = 0; f < kCount; ++f) {
    if (!exists(f)) continue;
    // Features that agree along x and y share what is done there.
    const auto sameSlices = [&](int g) {
      return exists(g) && degrees_[g].x == degrees_[f].x && degrees_[g].y == degrees_[f].y;
    };
    bool done = false;
    for (int g = 0; g < f; ++g) done = done || sameSlices(g);
    if (done) continue;
    const std::vector<double>& px = polynomials[0][degrees_[f].x];
    const std::vector<double>& py = polynomials[1][degrees_[f].y];
    parallelFor(0, static_cast<std::size_t>(size.z), 1, [&](std::size_t begin, std::size_t end) {
      std::vector<float> row(static_cast<std::size_t>(size.x));
      Array3D<float> alongX({places.x, size.y, 1});
      for (int k = static_cast<int>(begin); k < static_cast<int>(end); ++k) {
        std::ranges::fill(alongX.values(), 0.0f);
        for (int j = 0; j < size.y; ++j) {
          centered(source.data() + source.index(0, j, k), static_cast<float>(middle_), row.data(),
                   row.size());
          for (int l = 0; l < cell.x; ++l)
            addScaled(row.data() + l, static_cast<float>(px[l]), &alongX(0, j, 0),
                      static_cast<std::size_t>(places.x));
        }
        float* out = slices.data() + slices.index(0, 0, k);
        std::fill_n(out, static_cast<std::size_t>(places.x) * places.y, 0.0f);
        for (int l = 0; l < cell.y; ++l)
          addScaled(&alongX(0, l, 0), static_cast<float>(py[l]), out,
                    static_cast<std::size_t>(places.x) * places.y);
      }
    });
    for (int g = f; g < kCount; ++g) {
      if (!sameSlices(g)) continue;
      const std::vector<double>& pz = polynomials[2][degrees_[g].z];
      parallelFor(
          0, static_cast<std::size_t>(places.z), 1, [&](std::size_t begin, std::size_t end) {
            const std::size_t count = static_cast<std::size_t>(places.x) * places.y;
            std::vector<float> sum(count);
            for (int k = static_cast<int>(begin); k < static_cast<int>(end); ++k) {
              std::ranges::fill(sum, 0.0f);
              for (int l = 0; l < cell.z; ++l)
                addScaled(slices.data() + slices.index(0, 0, k + l), static_cast<float>(pz[l]),
                          sum.data(), count);
              roundToNumbers(sum.data(), static_cast<float>(scale_),
                             numbers.data()[numbers.index(0, 0, k)].data() + g, count, kCount);
            }
          });
    }
  }
  return numbers;
}

namespace {

// Sums of whole rows, weighted along y and z, for the cells of one part of y and z: `sums[f]` is a
// row. For feature f the weights are `alongY[f][j] * alongZ[f][k]`; features that agree along y
// follow each other.
template <class Sample>
inline __attribute__((always_inline)) void sumRows(const Sample* samples, std::size_t strideY,
                                                   std::size_t strideZ, std::size_t length,
                                                   int rows, int slices, float middle,
                                                   const float* const* alongY,
                                                   const float* const* alongZ, int features,
                                                   float* row, float* plane, float* sums) {
  for (int k = 0; k < slices; ++k) {
    for (std::size_t i = 0; i < length * static_cast<std::size_t>(features); ++i) plane[i] = 0;
    for (int j = 0; j < rows; ++j) {
      const Sample* in =
          samples + static_cast<std::size_t>(k) * strideZ + static_cast<std::size_t>(j) * strideY;
      for (std::size_t i = 0; i < length; ++i) row[i] = static_cast<float>(in[i]) - middle;
      for (int f = 0; f < features; ++f) {
        if (f > 0 && alongY[f] == alongY[f - 1]) continue;
        const float w = alongY[f][j];
        float* out = plane + static_cast<std::size_t>(f) * length;
        for (std::size_t i = 0; i < length; ++i) out[i] += w * row[i];
      }
    }
    const float* in = plane;
    for (int f = 0; f < features; ++f) {
      if (f == 0 || alongY[f] != alongY[f - 1]) in = plane + static_cast<std::size_t>(f) * length;
      const float w = alongZ[f][k];
      float* out = sums + static_cast<std::size_t>(f) * length;
      for (std::size_t i = 0; i < length; ++i) out[i] += w * in[i];
    }
  }
}

EXEMPLAR_MULTIVERSION void sumRowsOf(const std::uint8_t* samples, std::size_t strideY,
                                     std::size_t strideZ, std::size_t length, int rows, int slices,
                                     float middle, const float* const* alongY,
                                     const float* const* alongZ, int features, float* row,
                                     float* plane, float* sums) {
  sumRows(samples, strideY, strideZ, length, rows, slices, middle, alongY, alongZ, features, row,
          plane, sums);
}

EXEMPLAR_MULTIVERSION void sumRowsOf(const float* samples, std::size_t strideY, std::size_t strideZ,
                                     std::size_t length, int rows, int slices, float middle,
                                     const float* const* alongY, const float* const* alongZ,
                                     int features, float* row, float* plane, float* sums) {
  sumRows(samples, strideY, strideZ, length, rows, slices, middle, alongY, alongZ, features, row,
          plane, sums);
}

std::int64_t knownIn(const Array3D<std::uint8_t>& known, const Vec3i& first, const Vec3i& size) {
  std::int64_t count = 0;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j) {
      const std::uint8_t* at = known.data() + known.index(first.x, first.y + j, first.z + k);
      int inRow = 0;
      for (int i = 0; i < size.x; ++i) inRow += at[i] != 0;
      count += inRow;
    }
  return count;
}

}  // namespace

template <class Sample>
kernels::QueryFeatures CellFeatures::ofQuery(const BlockQuery<Sample>& query,
                                             const Vec3d& slopes) const {
  kernels::QueryFeatures features;
  std::ranges::fill(features.meanLow, std::int16_t{0});
  std::ranges::fill(features.meanHigh, std::int16_t{32767});
  std::ranges::fill(features.meanWeight, std::uint16_t{65535});
  std::ranges::fill(features.detailLow, std::int16_t{0});
  std::ranges::fill(features.detailHigh, std::int16_t{32767});
  features.weighted = false;
  features.detailPairs = 0;

  const Vec3i block = query.samples.size();
  std::int64_t known[8] = {};
  for (int c = 0; c < 8; ++c) {
    if (!layout_.there(c)) continue;
    const Vec3i first = layout_.first[c], size = layout_.size[c];
    const std::int64_t samples = volume(size);
    known[c] = query.known.empty() ? samples : knownIn(query.known, first, size);
    if (known[c] == 0 || known[c] == samples) continue;
    // Only the mean, and as far as the known samples say something about it.
    double sum = 0;
    for (int k = 0; k < size.z; ++k)
      for (int j = 0; j < size.y; ++j) {
        const std::size_t at = query.known.index(first.x, first.y + j, first.z + k);
        for (int i = 0; i < size.x; ++i)
          if (query.known.data()[at + i]) sum += static_cast<double>(query.samples.data()[at + i]);
      }
    const double mean = sum / static_cast<double>(known[c]) - middle_;
    const double shift = meanShift(query.known, first, size, slopes);
    const double unit = std::sqrt(static_cast<double>(samples)) * scale_;
    features.meanLow[c] = number(std::floor((mean - shift) * unit - 0.01) + kHalf);
    features.meanHigh[c] = number(std::ceil((mean + shift) * unit + 0.01) + kHalf);
    features.meanWeight[c] = static_cast<std::uint16_t>(std::floor(
        65535 * std::sqrt(static_cast<double>(known[c]) / static_cast<double>(samples))));
    features.weighted = true;
  }

  // Cells known in full, two at a time: those that differ in x alone have their rows in common.
  const std::size_t length = static_cast<std::size_t>(block.x);
  std::vector<float> buffer(length * (2 * kCount + 1));
  float* const row = buffer.data();
  float* const plane = row + length;
  float* const sums = plane + length * kCount;
  for (int c = 0; c < 8; c += 2) {
    const auto full = [&](int cell) {
      return layout_.there(cell) && known[cell] == volume(layout_.size[cell]);
    };
    if (!full(c) && !full(c + 1)) continue;
    const Vec3i first = layout_.first[c], size = layout_.size[c];
    const float* alongY[kCount];
    const float* alongZ[kCount];
    int which[kCount], count = 0;
    for (int y = 0; y < kDegrees; ++y)
      for (int f = 0; f < kCount; ++f) {
        const Vec3i d = degrees_[f];
        if (d.x < 0 || d.y != y || d.y >= size.y || d.z >= size.z) continue;
        which[count] = f;
        alongY[count] = weights_[c][1][d.y].data();
        alongZ[count++] = weights_[c][2][d.z].data();
      }
    std::fill_n(sums, length * static_cast<std::size_t>(count), 0.0f);
    sumRowsOf(query.samples.data() + query.samples.index(0, first.y, first.z), length,
              length * static_cast<std::size_t>(block.y), length, size.y, size.z,
              static_cast<float>(middle_), alongY, alongZ, count, row, plane, sums);
    for (int cell = c; cell < c + 2; ++cell) {
      if (!full(cell)) continue;
      const double error = roundingError(layout_.size[cell]);
      for (int n = 0; n < count; ++n) {
        const int f = which[n];
        if (!there(cell, f)) continue;
        const std::vector<double>& alongX = polynomials_[cell][0][degrees_[f].x];
        const float* in = sums + static_cast<std::size_t>(n) * length + layout_.first[cell].x;
        double coefficient = 0;
        for (std::size_t i = 0; i < alongX.size(); ++i) coefficient += in[i] * alongX[i];
        coefficient *= scale_;
        const std::int16_t low = number(std::floor(coefficient - error) + kHalf);
        const std::int16_t high = number(std::ceil(coefficient + error) + kHalf);
        (f == 0 ? features.meanLow[cell] : features.detailLow[kernels::detail(cell, f - 1)]) = low;
        (f == 0 ? features.meanHigh[cell] : features.detailHigh[kernels::detail(cell, f - 1)]) =
            high;
      }
    }
  }
  for (int p = 0; p < kernels::kDetails / 2; ++p) {
    const auto says = [&](int d) {
      return features.detailLow[d] > 0 || features.detailHigh[d] < 32767;
    };
    if (says(2 * p) || says(2 * p + 1))
      features.detailPair[features.detailPairs++] = static_cast<std::uint8_t>(p);
  }
  return features;
}

double meanShift(const Array3D<std::uint8_t>& known, const Vec3i& first, const Vec3i& size,
                 const Vec3d& slopes) {
  Array3D<double> mass(size);
  double total = 0;
  for (std::size_t s = 0; s < mass.count(); ++s)
    total += mass.data()[s] = known[first + mass.ijk(s)] != 0 ? 1 : 0;
  if (total == 0) return std::numeric_limits<double>::infinity();

  // The cost of turning even masses into these, along one line: what has to pass between
  // neighbors.
  const auto alongLine = [](const std::vector<double>& masses) {
    double sum = 0, cost = 0, passed = 0;
    for (double m : masses) sum += m;
    if (sum == 0) return 0.0;
    for (double m : masses) {
      passed += m - sum / static_cast<double>(masses.size());
      cost += std::abs(passed);
    }
    return cost;
  };
  double best = std::numeric_limits<double>::infinity();
  for (int start = 0; start < 3; ++start) {
    const int a = start, b = (start + 1) % 3, c = (start + 2) % 3;
    Array3D<double> plane({size[a], size[b], 1});
    std::vector<double> line(static_cast<std::size_t>(size[a]), 0.0);
    double cost = 0;
    std::vector<double> masses;
    for (int i = 0; i < size[a]; ++i)
      for (int j = 0; j < size[b]; ++j) {
        masses.assign(static_cast<std::size_t>(size[c]), 0.0);
        for (int k = 0; k < size[c]; ++k) {
          Vec3i p;
          p[a] = i;
          p[b] = j;
          p[c] = k;
          masses[k] = mass[p];
          plane(i, j, 0) += masses[k];
        }
        cost += slopes[c] * alongLine(masses);
        line[i] += plane(i, j, 0);
      }
    for (int i = 0; i < size[a]; ++i) {
      masses.assign(static_cast<std::size_t>(size[b]), 0.0);
      for (int j = 0; j < size[b]; ++j) masses[j] = plane(i, j, 0);
      cost += slopes[b] * alongLine(masses);
    }
    cost += slopes[a] * alongLine(line);
    best = std::min(best, cost / total);
  }
  return best;
}

template CellFeatures::CellFeatures(const CellLayout&,
                                    std::span<const Array3D<std::uint8_t>* const>, double, double);
template CellFeatures::CellFeatures(const CellLayout&, std::span<const Array3D<float>* const>,
                                    double, double);
template Array3D<CellFeatures::Numbers> CellFeatures::ofSource(const Array3D<std::uint8_t>&,
                                                               const Vec3i&) const;
template Array3D<CellFeatures::Numbers> CellFeatures::ofSource(const Array3D<float>&,
                                                               const Vec3i&) const;
template kernels::QueryFeatures CellFeatures::ofQuery(const BlockQuery<std::uint8_t>&,
                                                      const Vec3d&) const;
template kernels::QueryFeatures CellFeatures::ofQuery(const BlockQuery<float>&, const Vec3d&) const;

}  // namespace exemplar
