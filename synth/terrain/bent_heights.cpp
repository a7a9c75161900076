// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/bent_heights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/parallel.h"
#include "core/random.h"
#include "maps/halved.h"
#include "synth/terrain/gradient_direction.h"
#include "synth/terrain/standing_water.h"

namespace exemplar {
namespace {

/// Copies of each example.
constexpr int kCopies = 3;
/// How many of the coarsest resolutions have them, beside the finest one.
constexpr std::size_t kResolutions = 3;
/// How much they are bent.
constexpr double kStrain = 0.35;
/// Lengths of the waves that bend, of the map's smaller side.
constexpr double kShortest = 0.5, kLongest = 1.2;
constexpr std::size_t kWaves = 4;
/// Sources are numbered by bytes.
constexpr std::size_t kMostSources = 255;

struct Place {
  double x, y;
};

/// Where samples of a turned and bent map come from. Each wave moves along its crests, by what
/// depends on the place across them: a shear, which keeps areas.
class Bending {
 public:
  Bending(int width, int height, const Bend& bend)
      : cosine_(std::cos(bend.angle)),
        sine_(std::sin(bend.angle)),
        from_{width / 2.0, height / 2.0} {
    const double c = std::abs(cosine_), s = std::abs(sine_);
    size_ = {std::max(1, static_cast<int>(std::ceil(width * c + height * s))),
             std::max(1, static_cast<int>(std::ceil(width * s + height * c)))};
    const Random random(bend.seed, stream::kTerrainStart);
    const double side = std::min(width, height);
    for (std::size_t n = 0; n < kWaves; ++n) {
      const double length = side * random.uniform(kShortest, kLongest, n, 0);
      const double direction = std::numbers::pi * random.uniform(n, 1);
      const double number = 2 * std::numbers::pi / length;
      waves_[n] = {
          number * std::cos(direction), number * std::sin(direction),
          2 * std::numbers::pi * random.uniform(n, 2),
          // Waves that do not know of one another add up like their squares.
          bend.strain * std::numbers::sqrt2 / std::sqrt(static_cast<double>(kWaves)) / number,
          -std::sin(direction), std::cos(direction)};
    }
  }

  Pixel size() const { return size_; }
  /// The place in the map, in samples from its corner, of one in the result.
  Place from(double x, double y) const {
    x -= size_.x / 2.0;
    y -= size_.y / 2.0;
    double dx = 0, dy = 0;
    for (const Wave& wave : waves_) {
      const double by = wave.amplitude * std::sin(wave.kx * x + wave.ky * y + wave.phase);
      dx += by * wave.alongX;
      dy += by * wave.alongY;
    }
    x += dx;
    y += dy;
    return {from_.x + cosine_ * x + sine_ * y, from_.y - sine_ * x + cosine_ * y};
  }

 private:
  struct Wave {
    double kx, ky, phase, amplitude, alongX, alongY;
  };
  double cosine_, sine_;
  Place from_;
  Pixel size_;
  std::array<Wave, kWaves> waves_;
};

/// Linearly between the middles of samples; NaN beside the map.
double heightAt(const Grid<float>& heights, Place at) {
  const double x = at.x - 0.5, y = at.y - 0.5;
  if (!(x >= 0 && y >= 0 && x <= heights.width() - 1 && y <= heights.height() - 1))
    return std::numeric_limits<double>::quiet_NaN();
  const int x0 = std::min(static_cast<int>(x), std::max(0, heights.width() - 2));
  const int y0 = std::min(static_cast<int>(y), std::max(0, heights.height() - 2));
  const int x1 = std::min(x0 + 1, heights.width() - 1), y1 = std::min(y0 + 1, heights.height() - 1);
  const double fx = x - x0, fy = y - y0;
  return (1 - fy) * ((1 - fx) * heights(x0, y0) + fx * heights(x1, y0)) +
         fy * ((1 - fx) * heights(x0, y1) + fx * heights(x1, y1));
}

/// The same on half the resolution: the place of the first of 2 x 2 samples, halved.
Grid<Pixel> halvedPlaces(const Grid<Pixel>& from) {
  Grid<Pixel> half(from.width() / 2, from.height() / 2);
  for (int y = 0; y < half.height(); ++y) {
    for (int x = 0; x < half.width(); ++x) {
      const Pixel place = from(2 * x, 2 * y);
      half(x, y) = {place.x >> 1, place.y >> 1};  // down, also beside the map
    }
  }
  return half;
}

}  // namespace

Grid<float> bentHalf(const Grid<float>& heights, const Bend& bend) {
  const Bending bending(std::max(1, heights.width() / 2), std::max(1, heights.height() / 2), bend);
  Grid<float> half(bending.size().x, bending.size().y);
  parallelFor(0, static_cast<std::size_t>(half.height()), 16, [&](std::size_t y0, std::size_t y1) {
    for (std::size_t r = y0; r < y1; ++r) {
      const int y = static_cast<int>(r);
      for (int x = 0; x < half.width(); ++x) {
        double sum = 0;
        for (const double dy : {0.25, 0.75}) {
          for (const double dx : {0.25, 0.75}) {
            const Place at = bending.from(x + dx, y + dy);
            sum += heightAt(heights, {2 * at.x, 2 * at.y});
          }
        }
        half(x, y) = static_cast<float>(sum / 4);
      }
    }
  });
  return half;
}

Grid<Pixel> bentPlaces(Pixel size, const Bend& bend) {
  const Bending bending(size.x, size.y, bend);
  Grid<Pixel> from(bending.size().x, bending.size().y);
  for (int y = 0; y < from.height(); ++y) {
    for (int x = 0; x < from.width(); ++x) {
      const Place at = bending.from(x + 0.5, y + 0.5);
      from(x, y) = {static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y))};
    }
  }
  return from;
}

Grid<std::uint8_t> bentKinds(const Grid<std::uint8_t>& kinds, const Grid<Pixel>& from) {
  Grid<std::uint8_t> bent(from.width(), from.height());
  for (std::size_t s = 0; s < bent.count(); ++s)
    if (kinds.contains(from[s].x, from[s].y)) bent[s] = kinds(from[s].x, from[s].y);
  return bent;
}

std::vector<Bend> bendsOf(std::span<const Grid<float>> examples, std::span<const int> turns,
                          bool asTheyAre, std::uint64_t seed) {
  const bool quarters = std::ranges::find(turns, 1) != turns.end();
  const double most = asTheyAre ? 0 : greatestTurn(examples);
  const Random random = Random(seed, stream::kTerrainStart).fork(0);
  std::vector<Bend> bends;
  for (int n = 0; n < kCopies; ++n) {
    const auto key = static_cast<std::uint64_t>(n);
    Bend bend;
    // Spread evenly over a quarter, or over what there is.
    const double share = (n + random.uniform(0.25, 0.75, key, 0) + 0.5) / (kCopies + 1);
    bend.angle = quarters ? share * std::numbers::pi / 2 : most * (2 * share - 1);
    bend.strain = quarters ? kStrain : std::min(kStrain, std::max(most, 0.1));
    bend.seed = random.bits(key, 1);
    bends.push_back(bend);
  }
  return bends;
}

void addBentCopies(std::vector<HeightLevel>& pyramid, std::size_t examples,
                   std::span<const Bend> bends) {
  if (pyramid.size() < 2) return;
  const std::size_t begin = pyramid.size() - std::min(kResolutions, pyramid.size() - 1);
  for (std::size_t e = 0; e < examples; ++e) {
    for (const Bend& bend : bends) {
      if (pyramid.back().sources.size() >= kMostSources) return;
      Grid<float> heights = bentHalf(pyramid[begin - 1].sources[e].heights, bend);
      const Grid<float>& of = pyramid[begin].sources[e].heights;
      Grid<Pixel> from = bentPlaces({of.width(), of.height()}, bend);
      Grid<std::uint8_t> water;
      if (!pyramid.front().water.empty()) water = bentKinds(pyramid[begin].water[e], from);
      if (heightSource(heights).places == 0) continue;
      for (std::size_t l = begin; l < pyramid.size(); ++l) {
        HeightLevel& level = pyramid[l];
        Grid<float> half;
        if (l + 1 < pyramid.size()) {
          half = halved(heights, false);
          level.details.push_back(detailOf(heights, half));
        }
        Grid<Pixel> halfFrom = halvedPlaces(from);
        level.sources.push_back(heightSource(std::move(heights)));
        level.sources.back().copyOf = static_cast<std::uint8_t>(e);
        level.sources.back().from = std::move(from);
        heights = std::move(half);
        from = std::move(halfFrom);
        if (water.empty()) continue;
        Grid<std::uint8_t> halfWater = halvedWater(water);
        level.water.push_back(std::move(water));
        water = std::move(halfWater);
      }
    }
  }
}

}  // namespace exemplar
