// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/voting/example_regions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "core/cells.h"
#include "core/error.h"
#include "core/random.h"

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// The waves' length, of the examples' longest side, and at most of the result's.
constexpr double kWavelength = 1.5, kLongestWave = 1.0;
constexpr std::uint32_t kWaves = 16;
/// The field's quantiles are taken from at most so many samples along each axis.
constexpr int kQuantiles = 32;
/// By how much the borders follow what was made at most, once.
constexpr double kFollow = 2;
/// Shares may differ from a sum of 1 by rounding.
constexpr double kRounding = 0.01;

/// Faces between solid and air, of all samples.
double surfaceOf(const DistanceField& example) {
  const Vec3i n = example.size();
  std::int64_t faces = 0;
  forEachCell(n, [&](const Vec3i& p) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i q = p;
      if (++q[axis] < n[axis]) faces += (example.values[p] < 0) != (example.values[q] < 0);
    }
  });
  return static_cast<double>(std::max<std::int64_t>(1, faces)) / static_cast<double>(volume(n));
}

}  // namespace

ExampleRegions::ExampleRegions(std::span<const DistanceField* const> examples,
                               const MixOptions& mix, const Vec3i& size, const Axes& along,
                               const Axes& periodic, std::uint64_t seed)
    : mix_(mix), size_(size) {
  const std::size_t count = examples.size();
  if (mix_.shares.empty()) mix_.shares.assign(count, 1.0 / static_cast<double>(count));
  if (mix_.shares.size() != count)
    throw InputError("`mix`: " + std::to_string(mix_.shares.size()) + " shares for " +
                     std::to_string(count) + " examples");
  double sum = 0;
  for (const double share : mix_.shares) {
    if (!(share >= 0 && share <= 1)) throw InputError("`mix`: shares are 0 to 1");
    sum += share;
  }
  if (std::abs(sum - 1) > kRounding) throw InputError("`mix`: shares must add up to 1");
  if (mix_.map && mix_.map->size() != size)
    throw InputError("`mix-map`: it is given for a result of another size");

  double longest = 0, longestMade = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const DistanceField* example : examples)
      longest = std::max<double>(longest, example->size()[axis]);
    if (along[axis]) longestMade = std::max<double>(longestMade, size[axis]);
  }
  const double wavelength =
      std::min(kWavelength * longest, kLongestWave * std::max(1.0, longestMade));
  const Random random(seed, stream::kExampleRegions);
  for (std::uint32_t w = 0; w < kWaves; ++w) {
    Wave wave{{0, 0, 0}, random.uniform(0, 2 * std::numbers::pi, w, 6)};
    double norm = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (along[axis])
        wave.frequency[axis] = random.normal(w, static_cast<std::uint32_t>(2 * axis));
      norm += wave.frequency[axis] * wave.frequency[axis];
    }
    for (int axis = 0; axis < 3; ++axis) {
      double& f = wave.frequency[axis];
      if (norm > 0) f /= std::sqrt(norm) * wavelength;
      if (periodic[axis]) f = std::round(f * size[axis]) / size[axis];
    }
    waves_.push_back(wave);
  }
  const Vec3i coarse = min(size, Vec3i{kQuantiles, kQuantiles, kQuantiles});
  forEachCell(coarse, [&](const Vec3i& p) {
    Vec3d place;
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = (p[axis] + 0.5) * size[axis] / coarse[axis] - 0.5;
    sorted_.push_back(field(place));
  });
  std::sort(sorted_.begin(), sorted_.end());
  for (const DistanceField* example : examples) density_.push_back(surfaceOf(*example));
  findTails();
}

double ExampleRegions::field(const Vec3d& place) const {
  double sum = 0;
  for (const Wave& wave : waves_) {
    sum += std::cos(
        2 * std::numbers::pi *
            (wave.frequency.x * place.x + wave.frequency.y * place.y + wave.frequency.z * place.z) +
        wave.phase);
  }
  return sum;
}

void ExampleRegions::findTails() {
  std::vector<double> volumes;
  for (std::size_t e = 0; e < density_.size(); ++e) volumes.push_back(mix_.shares[e] / density_[e]);
  const double all = std::accumulate(volumes.begin(), volumes.end(), 0.0);
  tails_.assign(volumes.size() - 1, 0);
  double tail = 0;
  for (std::size_t e = volumes.size() - 1; e > 0; --e) {
    tail += volumes[e] / all;
    tails_[e - 1] = tail;
  }
}

int ExampleRegions::at(const Vec3d& place) const {
  const auto rank = std::lower_bound(sorted_.begin(), sorted_.end(), field(place));
  const double u = (static_cast<double>(rank - sorted_.begin()) + 0.5) /
                   (static_cast<double>(sorted_.size()) + 1);
  double painted = 0;
  if (mix_.map) {
    const Vec3i cell{static_cast<int>(std::lround(place.x)), static_cast<int>(std::lround(place.y)),
                     static_cast<int>(std::lround(place.z))};
    painted = (*mix_.map)[mix_.map->clamped(cell)] * static_cast<double>(tails_.size());
  }
  int example = 0;
  for (std::size_t e = 0; e < tails_.size(); ++e) {
    const double tail =
        mix_.map ? std::clamp(painted - static_cast<double>(e), 0.0, 1.0) : tails_[e];
    example += u < tail;
  }
  return example;
}

double ExampleRegions::correct(std::span<const double> made) {
  if (mix_.map) return 0;
  double off = 0;
  for (std::size_t e = 0; e < density_.size(); ++e) {
    off = std::max(off, std::abs(made[e] - mix_.shares[e]));
    if (mix_.shares[e] > 0)
      density_[e] *= std::clamp(made[e] / mix_.shares[e], 1 / kFollow, kFollow);
  }
  findTails();
  return off;
}

}  // namespace exemplar
