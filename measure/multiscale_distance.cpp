// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/multiscale_distance.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/axes.h"
#include "core/cells.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/simd.h"
#include "measure/example_nature.h"
#include "measure/same_voxels.h"

namespace exemplar {
namespace {

constexpr int kSide = 7, kReach = kSide / 2, kSamples = kSide * kSide * kSide;
constexpr float kTruncation = 3;  // voxels
constexpr int kScales = 4;
/// A scale counts where patches lie inside for this share of the surface.
constexpr double kEnough = 0.1;

/// Numbers that stand for patches: `projections` rows of one value a patch, ascending.
using Projected = std::vector<std::vector<float>>;

/// A field at one scale: at each cell the mean of the distances of the cells from there up to, and
/// not including, `scale` cells further along each axis.
class Scaled {
 public:
  explicit Scaled(const DistanceField& field) : values_(field.size()) {
    const auto voxel = static_cast<float>(field.voxelSize);
    parallelFor(0, values_.count(), 65536, [&](std::size_t first, std::size_t last) {
      for (std::size_t s = first; s < last; ++s)
        values_.data()[s] = std::clamp(field.values.data()[s] / voxel, -kTruncation, kTruncation);
    });
    for (int z = 0; z < field.size().z; ++z)
      forEachCell(CellBox{{0, 0, z}, {field.size().x, field.size().y, z + 1}}, [&](const Vec3i& p) {
        if (std::abs(values_[p]) <= 0.5f) surface_.push_back(p);
      });
  }

  int scale() const { return scale_; }
  const std::vector<Vec3i>& surface() const { return surface_; }
  Vec3i size() const { return values_.size(); }

  /// Doubles the scale: a mean of twice the length is that of two beside each other.
  void coarsen() {
    for (int axis = 0; axis < 3; ++axis) {
      Array3D<float> next(values_.size());
      parallelForEachCell(values_.size(), [&](const Vec3i& p) {
        Vec3i q = p;
        q[axis] = std::min(p[axis] + scale_, values_.size()[axis] - 1);
        next[p] = (values_[p] + values_[q]) / 2;
      });
      values_ = std::move(next);
    }
    scale_ *= 2;
  }

  /// The surface cells whose patches lie inside along `inside`.
  std::vector<Vec3i> centers(const Axes& inside) const {
    const int low = kReach * scale_ + scale_ / 2;
    const int high = kReach * scale_ + scale_ - scale_ / 2;
    std::vector<Vec3i> centers;
    for (const Vec3i& p : surface_) {
      bool fits = true;
      for (int axis = 0; axis < 3; ++axis)
        fits = fits && (!inside[axis] || (p[axis] >= low && p[axis] + high <= size()[axis]));
      if (fits) centers.push_back(p);
    }
    return centers;
  }

  void patch(const Vec3i& center, float* out) const {
    const Vec3i last = size() - Vec3i{1, 1, 1};
    for (int k = -kReach; k <= kReach; ++k)
      for (int j = -kReach; j <= kReach; ++j)
        for (int i = -kReach; i <= kReach; ++i) {
          const Vec3i half{scale_ / 2, scale_ / 2, scale_ / 2};
          const Vec3i at = center + Vec3i{i, j, k} * scale_ - half;
          *out++ = values_[max(Vec3i{0, 0, 0}, min(at, last))];
        }
  }

 private:
  Array3D<float> values_;
  std::vector<Vec3i> surface_;
  int scale_ = 1;
};

/// Directions of length 1 in the space of patches, one row each.
std::vector<float> directions(const MultiscaleOptions& options) {
  const Random random(options.seed, stream::kPatchDirections);
  std::vector<float> all(static_cast<std::size_t>(options.projections) * kSamples);
  for (std::size_t d = 0; d < static_cast<std::size_t>(options.projections); ++d) {
    std::array<double, kSamples> row;
    double square = 0;
    for (std::size_t s = 0; s < kSamples; ++s) {
      row[s] = random.normal(d, static_cast<std::uint32_t>(2 * s));
      square += row[s] * row[s];
    }
    for (std::size_t s = 0; s < kSamples; ++s)
      all[d * kSamples + s] = static_cast<float>(row[s] / std::sqrt(square));
  }
  return all;
}

/// Sums of products in eight lanes, which vectorize.
EXEMPLAR_MULTIVERSION
float dotProduct(const float* a, const float* b) {
  std::array<float, 8> lanes{};
  std::size_t s = 0;
  for (; s + 8 <= kSamples; s += 8)
    for (std::size_t l = 0; l < 8; ++l) lanes[l] += a[s + l] * b[s + l];
  float sum = 0;
  for (; s < kSamples; ++s) sum += a[s] * b[s];
  for (const float lane : lanes) sum += lane;
  return sum;
}

class Comparison {
 public:
  explicit Comparison(const MultiscaleOptions& options)
      : options_(options), directions_(directions(options)) {}

  /// Draws patches, with repetition, and projects them.
  Projected draw(const Scaled& field, std::span<const Vec3i> centers, std::uint32_t stream) const {
    const auto count = static_cast<std::size_t>(options_.patches);
    const auto rows = static_cast<std::size_t>(options_.projections);
    const Random random(options_.seed, stream);
    Projected projected(rows, std::vector<float>(count));
    parallelFor(0, count, 64, [&](std::size_t first, std::size_t last) {
      std::array<float, kSamples> patch;
      for (std::size_t p = first; p < last; ++p) {
        const Vec3i center = centers[random.below(static_cast<std::uint32_t>(centers.size()), p,
                                                  static_cast<std::uint32_t>(field.scale()))];
        field.patch(center, patch.data());
        for (std::size_t d = 0; d < rows; ++d)
          projected[d][p] = dotProduct(&directions_[d * kSamples], patch.data());
      }
    });
    parallelFor(0, rows, 4, [&](std::size_t first, std::size_t last) {
      for (std::size_t d = first; d < last; ++d) std::ranges::sort(projected[d]);
    });
    return projected;
  }

  static double distance(const Projected& a, const Projected& b) {
    double sum = 0;
    for (std::size_t d = 0; d < a.size(); ++d)
      for (std::size_t p = 0; p < a[d].size(); ++p) sum += std::abs(a[d][p] - b[d][p]);
    return sum / static_cast<double>(a.size() * a.front().size());
  }

 private:
  MultiscaleOptions options_;
  std::vector<float> directions_;
};

/// What two halves of an example are apart. Where the box cuts it, they lie on both sides of its
/// middle, along each level axis that it is cut along, and the figure is the mean: halves hold half
/// as much as wholes do, so they are sqrt(2) times as far apart, which is taken out. An object has
/// another side on the other side; so its halves are the black and the white cells of a
/// checkerboard of a quarter of its length. docs/measures.md compares both with fresh samples.
double halvesDistance(const Scaled& example, std::span<const Vec3i> centers,
                      const ExampleNature& nature, const Axes& cut, const Comparison& compare) {
  const auto halves = [&](const auto& isFirst) {
    std::vector<Vec3i> parts[2];
    for (const Vec3i& p : centers) parts[isFirst(p) ? 0 : 1].push_back(p);
    if (parts[0].empty() || parts[1].empty()) return 0.0;
    return Comparison::distance(compare.draw(example, parts[0], stream::kExampleWindows),
                                compare.draw(example, parts[1], stream::kResultWindows));
  };
  const Vec3i size = nature.solid.size();
  if (!cut.x && !cut.y) {
    const int cell = std::max(4, std::max({size.x, size.y, size.z}) / 4);
    return halves([&](const Vec3i& p) {
      const Vec3i q = p - nature.solid.begin;
      return ((q.x / cell + q.y / cell + q.z / cell) & 1) == 0;
    });
  }
  double sum = 0;
  int axes = 0;
  for (int axis = 0; axis < 2; ++axis) {
    if (!cut[axis]) continue;
    const int middle = nature.size[axis] / 2;
    sum += halves([&](const Vec3i& p) { return p[axis] < middle; }) / std::sqrt(2.0);
    ++axes;
  }
  return sum / axes;
}

}  // namespace

std::optional<MultiscaleDistance> multiscaleDistance(const DistanceField& example,
                                                     const DistanceField& result,
                                                     const MultiscaleOptions& options,
                                                     const Progress& progress) {
  assert(options.patches >= 64 && options.projections >= 1);
  requireSameVoxels(example, result);
  progress.report("comparing shapes at several scales", 0);
  Scaled ofExample(example), ofResult(result);
  if (ofExample.surface().empty() || ofResult.surface().empty()) return std::nullopt;
  const ExampleNature nature = natureOf(Occupancy(example));
  Axes cut;
  for (std::size_t axis = 0; axis < 3; ++axis)
    cut[static_cast<int>(axis)] =
        nature.sides[2 * axis] == BoxSide::Cut || nature.sides[2 * axis + 1] == BoxSide::Cut;
  const Comparison compare(options);
  MultiscaleDistance found;
  for (int level = 0; level < kScales; ++level) {
    progress.report("comparing shapes at several scales", static_cast<double>(level) / kScales);
    if (level > 0) {
      ofExample.coarsen();
      ofResult.coarsen();
    }
    const std::vector<Vec3i> mine = ofExample.centers(cut), its = ofResult.centers(cut);
    const auto enough = [](const std::vector<Vec3i>& centers, const Scaled& field) {
      return !centers.empty() && static_cast<double>(centers.size()) >=
                                     kEnough * static_cast<double>(field.surface().size());
    };
    if (!enough(mine, ofExample) || !enough(its, ofResult)) continue;
    ScaleDistance at;
    at.scale = ofExample.scale();
    const Projected reference = compare.draw(ofExample, mine, stream::kExampleWindows);
    at.distance =
        Comparison::distance(reference, compare.draw(ofResult, its, stream::kResultWindows));
    // Two drawings of the same patches are this far apart, at least: halves may be the same.
    const double drawn =
        Comparison::distance(reference, compare.draw(ofExample, mine, stream::kResultWindows));
    at.floor = std::max({1e-6, drawn, halvesDistance(ofExample, mine, nature, cut, compare)});
    found.ratio += at.ratio();
    found.scales.push_back(at);
  }
  if (found.scales.empty()) return std::nullopt;
  found.ratio /= static_cast<double>(found.scales.size());
  return found;
}

}  // namespace exemplar
