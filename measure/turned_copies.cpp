// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/turned_copies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/parallel.h"
#include "maps/halved.h"
#include "measure/repeated_share.h"
#include "measure/terrain_copies.h"

namespace exemplar {
namespace {

constexpr std::size_t kRings = 9, kAngles = 48, kHarmonics = 17;
constexpr int kMargin = 13;   ///< of the map: the largest ring, a step and what smoothing reads
constexpr int kApart = 3;     ///< shapes are the extrema within so many cells
constexpr int kSmoothed = 2;  ///< times by means of 3 x 3
/// Shapes whose surroundings correlate so much are the same one.
constexpr float kSame = 0.85f;
/// The least side of a map on the resolution of its layout.
constexpr int kLayoutSide = 40;

struct Place {
  double x, y;
};

struct Candidate {
  Pixel at;
  float strength;
};

/// The strongest extrema, the strongest first.
std::vector<Candidate> extrema(const Grid<float>& detail, std::size_t most) {
  std::vector<Candidate> found;
  const auto isExtreme = [&](int x, int y) {
    const float v = detail(x, y), sign = v < 0 ? -1.0f : 1.0f;
    for (int dy = -kApart; dy <= kApart; ++dy) {
      for (int dx = -kApart; dx <= kApart; ++dx) {
        const bool before = dy < 0 || (dy == 0 && dx < 0);
        const float other = sign * detail(x + dx, y + dy);
        if (before ? !(other < sign * v) : !(other <= sign * v)) return false;
      }
    }
    return true;
  };
  for (int y = kMargin; y < detail.height() - kMargin; ++y) {
    for (int x = kMargin; x < detail.width() - kMargin; ++x)
      if (isExtreme(x, y)) found.push_back({{x, y}, std::abs(detail(x, y))});
  }
  std::ranges::stable_sort(
      found, [](const Candidate& a, const Candidate& b) { return a.strength > b.strength; });
  if (found.size() > most) found.resize(most);
  return found;
}

/// Between cells: where parabolas through the neighbors have their extrema.
Place refined(const Grid<float>& detail, Pixel at) {
  const auto along = [](float before, float here, float after) {
    const double bend = double{before} - 2.0 * here + after;
    return bend == 0 ? 0.0 : std::clamp((double{before} - after) / (2 * bend), -0.5, 0.5);
  };
  const float here = detail(at.x, at.y);
  return {at.x + along(detail(at.x - 1, at.y), here, detail(at.x + 1, at.y)),
          at.y + along(detail(at.x, at.y - 1), here, detail(at.x, at.y + 1))};
}

float between(const Grid<float>& values, double x, double y) {
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const auto fx = static_cast<float>(x - x0), fy = static_cast<float>(y - y0);
  return (1 - fy) * ((1 - fx) * values(x0, y0) + fx * values(x0 + 1, y0)) +
         fy * ((1 - fx) * values(x0, y0 + 1) + fx * values(x0 + 1, y0 + 1));
}

struct Waves {
  std::array<std::complex<float>, kAngles> roots;
  Waves() {
    for (std::size_t n = 0; n < kAngles; ++n) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(n) / kAngles;
      roots[n] = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
    }
  }
};
const Waves kWaves;

}  // namespace

class TerrainShapes::Surroundings {
 public:
  Surroundings(const Grid<float>& detail, Place at) {
    std::array<std::array<float, kAngles>, kRings> rings;
    double sum = 0, weights = 0;
    for (std::size_t r = 0; r < kRings; ++r) {
      for (std::size_t n = 0; n < kAngles; ++n) {
        const auto radius = static_cast<float>(r + 1);
        rings[r][n] = between(detail, at.x + radius * kWaves.roots[n].real(),
                              at.y + radius * kWaves.roots[n].imag());
        sum += radius * rings[r][n];
        weights += radius;
      }
    }
    const auto mean = static_cast<float>(sum / weights);
    double power = 0;
    for (std::size_t r = 0; r < kRings; ++r) {
      // A ring counts as its cells.
      const float weight = std::sqrt(static_cast<float>(r + 1));
      for (std::size_t k = 0; k < kHarmonics; ++k) {
        std::complex<float> c = 0;
        for (std::size_t n = 0; n < kAngles; ++n)
          c += (rings[r][n] - mean) * std::conj(kWaves.roots[n * k % kAngles]);
        c *= weight;
        coefficients_[k][r] = c;
        power += timesOf(k) * std::norm(c);
      }
    }
    whole_ = std::isfinite(power) && power > 0;
    const auto scale = static_cast<float>(1 / std::sqrt(power));
    for (std::size_t k = 0; k < kHarmonics; ++k) {
      float norm = 0;
      for (std::complex<float>& c : coefficients_[k]) norm += std::norm(c *= scale);
      norms_[k] = std::sqrt(timesOf(k) * norm);
    }
  }

  bool whole() const { return whole_; }

  /// Whether the two correlate, turned by any angle, mirrored or not.
  bool same(const Surroundings& other) const {
    for (const bool mirrored : {false, true}) {
      std::array<std::complex<float>, kHarmonics> products;
      // No turn correlates more than the sum of the products' sizes, and these are no larger than
      // those of the norms.
      float most = 0;
      for (std::size_t k = 0; k < kHarmonics; ++k) most += norms_[k] * other.norms_[k];
      std::size_t k = 0;
      for (; k < kHarmonics && most >= kSame; ++k) {
        std::complex<float> product = 0;
        for (std::size_t r = 0; r < kRings; ++r) {
          const std::complex<float> a = coefficients_[k][r], b = other.coefficients_[k][r];
          // a b*, without the library's care for infinities.
          const float im = mirrored ? -b.imag() : b.imag();
          product += std::complex<float>{a.real() * b.real() + a.imag() * im,
                                         a.imag() * b.real() - a.real() * im};
        }
        products[k] = product;
        most += timesOf(k) * std::abs(product) - norms_[k] * other.norms_[k];
      }
      if (most < kSame) continue;
      for (std::size_t n = 0; n < kAngles; ++n) {
        float sum = products[0].real();
        for (std::size_t h = 1; h < kHarmonics; ++h) {
          const std::complex<float> root = kWaves.roots[n * h % kAngles];
          sum += 2 * (products[h].real() * root.real() - products[h].imag() * root.imag());
        }
        if (sum >= kSame) return true;
      }
    }
    return false;
  }

 private:
  /// Coefficients other than the first stand for those of the opposite frequency, too.
  static float timesOf(std::size_t k) { return k == 0 ? 1 : 2; }

  std::array<std::array<std::complex<float>, kRings>, kHarmonics> coefficients_;
  std::array<float, kHarmonics> norms_{};  // over the rings, so that their squares sum to 1
  bool whole_ = false;
};

TerrainShapes::TerrainShapes(const Grid<float>& heights, std::size_t most) {
  Grid<float> smooth = heights;
  for (int n = 0; n < kSmoothed; ++n) smooth = smoothed3x3(smooth);
  const Grid<float> detail = laplacian(smooth);
  for (const Candidate& candidate : extrema(detail, most)) {
    const Surroundings shape(detail, refined(detail, candidate.at));
    if (shape.whole()) shapes_.push_back(shape);
  }
}
TerrainShapes::~TerrainShapes() = default;
TerrainShapes::TerrainShapes(TerrainShapes&&) noexcept = default;

std::size_t TerrainShapes::count() const { return shapes_.size(); }

std::optional<double> TerrainShapes::repeated(const Progress& progress) const {
  return repeatedShare<Surroundings>(shapes_, progress);
}

std::optional<double> TerrainShapes::foundIn(const TerrainShapes& others,
                                             const Progress& progress) const {
  if (shapes_.empty() || others.shapes_.empty()) return std::nullopt;
  std::vector<std::uint8_t> found(shapes_.size());
  parallelFor(0, shapes_.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t a = first; a < last; ++a) {
      progress.check();
      found[a] = std::ranges::any_of(
          others.shapes_, [&](const Surroundings& other) { return shapes_[a].same(other); });
    }
  });
  return static_cast<double>(std::ranges::count(found, 1)) / static_cast<double>(found.size());
}

int layoutHalvings(const Grid<float>& heights) {
  int side = std::min(heights.width(), heights.height()), halvings = 0;
  for (; side / 2 >= kLayoutSide; side /= 2) ++halvings;
  return halvings;
}

Grid<float> layoutOf(const Grid<float>& heights, int halvings) {
  Grid<float> coarse = heights;
  for (int n = 0; n < halvings; ++n) coarse = halved(coarse, false);
  return coarse;
}

}  // namespace exemplar
