// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/random_streams.h"
#include "synth/layered/layers.h"

namespace exemplar {
namespace {

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kComponents = 24;
constexpr int kSample = 6000;      // neighborhoods that the components are taken from
constexpr int kClustered = 40000;  // pixels that clusters are found with, at most
constexpr int kRestarts = 5;
constexpr int kRounds = 40;
constexpr std::uint32_t kSpeck = 9;  // pixels; smaller components are no layers

/// The place of a pixel beyond the border, reflected at it.
int reflected(int x, int n) {
  if (n == 1) return 0;
  const int period = 2 * n - 2;
  x = std::abs(x) % period;
  return x < n ? x : period - x;
}

/// Neighborhoods of a texture as vectors.
class Neighborhoods {
 public:
  Neighborhoods(const MapLayer& texture, int side) : texture_(texture), side_(side) {}

  int dimensions() const { return side_ * side_ * static_cast<int>(texture_.planes.size()); }
  void write(std::size_t pixel, float* to) const {
    const Grid<float>& first = texture_.planes.front();
    const int x = static_cast<int>(pixel % static_cast<std::size_t>(first.width()));
    const int y = static_cast<int>(pixel / static_cast<std::size_t>(first.width()));
    const int half = side_ / 2;
    for (const Grid<float>& plane : texture_.planes) {
      for (int dy = -half; dy <= half; ++dy) {
        const int row = reflected(y + dy, plane.height());
        for (int dx = -half; dx <= half; ++dx) *to++ = plane(reflected(x + dx, plane.width()), row);
      }
    }
  }

 private:
  const MapLayer& texture_;
  int side_;
};

/// Every pixel's neighborhood by its first principal components.
Matrix features(const MapLayer& texture, int side, const Random& random, const Progress& progress) {
  const Neighborhoods neighborhoods(texture, side);
  const std::size_t pixels = texture.planes.front().count();
  const auto dimensions = static_cast<Eigen::Index>(neighborhoods.dimensions());
  const Eigen::Index samples = std::min<Eigen::Index>(kSample, static_cast<Eigen::Index>(pixels));
  Matrix sample(samples, dimensions);
  for (Eigen::Index n = 0; n < samples; ++n) {
    const auto draw = static_cast<std::uint64_t>(n);
    neighborhoods.write(random.bits(draw) % pixels, sample.row(n).data());
  }
  const Eigen::RowVectorXf mean = sample.colwise().mean();
  sample.rowwise() -= mean;
  progress.report("finding components", 0.1);
  const Eigen::MatrixXf covariance = sample.transpose() * sample / static_cast<float>(samples);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXf> solver(covariance);
  const Eigen::Index kept = std::min<Eigen::Index>(kComponents, dimensions);
  const Matrix axes = solver.eigenvectors().rightCols(kept);
  progress.report("finding components", 0.3);

  Matrix result(static_cast<Eigen::Index>(pixels), kept);
  parallelFor(0, pixels, 4096, [&](std::size_t first, std::size_t last) {
    progress.check();
    Matrix batch(static_cast<Eigen::Index>(last - first), dimensions);
    for (std::size_t p = first; p < last; ++p)
      neighborhoods.write(p, batch.row(static_cast<Eigen::Index>(p - first)).data());
    batch.rowwise() -= mean;
    result.middleRows(static_cast<Eigen::Index>(first), batch.rows()).noalias() = batch * axes;
  });
  return result;
}

int nearestCenter(const Matrix& centers, const float* point, float* distance) {
  int best = 0;
  float least = std::numeric_limits<float>::infinity();
  for (Eigen::Index k = 0; k < centers.rows(); ++k) {
    float sum = 0;
    for (Eigen::Index d = 0; d < centers.cols(); ++d) {
      const float step = centers(k, d) - point[d];
      sum += step * step;
    }
    if (sum < least) {
      least = sum;
      best = static_cast<int>(k);
    }
  }
  *distance = least;
  return best;
}

/// Lloyd's rounds from a k-means++ start; the sum of squared distances, and the centers.
double cluster(const Matrix& points, int count, const Random& random, Matrix& centers,
               const Progress& progress) {
  const Eigen::Index n = points.rows();
  centers.resize(count, points.cols());
  std::vector<double> nearest(static_cast<std::size_t>(n), std::numeric_limits<double>::max());
  Eigen::Index chosen = static_cast<Eigen::Index>(random.bits(0) % static_cast<std::uint64_t>(n));
  for (int k = 0; k < count; ++k) {
    centers.row(k) = points.row(chosen);
    double all = 0;
    for (Eigen::Index p = 0; p < n; ++p) {
      const double d = (points.row(p) - centers.row(k)).squaredNorm();
      double& least = nearest[static_cast<std::size_t>(p)];
      least = std::min(least, d);
      all += least;
    }
    double draw = random.uniform(1, static_cast<std::uint32_t>(k)) * all;
    for (chosen = 0; chosen + 1 < n; ++chosen) {
      draw -= nearest[static_cast<std::size_t>(chosen)];
      if (draw < 0) break;
    }
  }
  std::vector<int> owner(static_cast<std::size_t>(n), -1);
  double sum = 0;
  for (int round = 0; round < kRounds; ++round) {
    progress.check();
    bool changed = false;
    sum = 0;
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(count, points.cols());
    std::vector<double> members(static_cast<std::size_t>(count));
    for (Eigen::Index p = 0; p < n; ++p) {
      float distance = 0;
      const int k = nearestCenter(centers, points.row(p).data(), &distance);
      changed |= owner[static_cast<std::size_t>(p)] != k;
      owner[static_cast<std::size_t>(p)] = k;
      sum += distance;
      sums.row(k) += points.row(p).cast<double>();
      ++members[static_cast<std::size_t>(k)];
    }
    if (!changed) break;
    for (int k = 0; k < count; ++k) {
      const double size = members[static_cast<std::size_t>(k)];
      if (size > 0) centers.row(k) = (sums.row(k) / size).cast<float>();
    }
  }
  return sum;
}

/// The most frequent value of 3 x 3 pixels; the pixel's own among equals.
LayerMap majorityFiltered(const LayerMap& map) {
  LayerMap filtered = map;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      std::array<int, kMostLayers + 1> count{};
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          ++count[map(reflected(x + dx, map.width()), reflected(y + dy, map.height()))];
      std::uint8_t& own = filtered(x, y);
      for (std::uint8_t k = 0; k < count.size(); ++k)
        if (count[k] > count[own]) own = k;
    }
  }
  return filtered;
}

/// Gives components of fewer than `kSpeck` pixels to the layer around them.
void removeSpecks(LayerMap& map) {
  DisjointSets sets(map.count());
  const auto id = [&](int x, int y) { return static_cast<std::uint32_t>(map.index(x, y)); };
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (x > 0 && map(x, y) == map(x - 1, y)) sets.join(id(x, y), id(x - 1, y));
      if (y > 0 && map(x, y) == map(x, y - 1)) sets.join(id(x, y), id(x, y - 1));
    }
  }
  std::vector<std::uint32_t> size(map.count());
  for (std::uint32_t p = 0; p < map.count(); ++p) ++size[sets.find(p)];
  // What a speck has around it, row by row.
  std::vector<std::uint8_t> around(map.count());
  const auto look = [&](int x, int y, int nx, int ny) {
    if (!map.contains(nx, ny) || map(nx, ny) == map(x, y)) return;
    std::uint8_t& found = around[sets.find(id(x, y))];
    if (size[sets.find(id(nx, ny))] >= kSpeck && found == 0) found = map(nx, ny);
  };
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (size[sets.find(id(x, y))] >= kSpeck) continue;
      look(x, y, x - 1, y);
      look(x, y, x + 1, y);
      look(x, y, x, y - 1);
      look(x, y, x, y + 1);
    }
  }
  for (std::uint32_t p = 0; p < map.count(); ++p) {
    const std::uint32_t set = sets.find(p);
    if (size[set] < kSpeck && around[set] != 0) map[p] = around[set];
  }
}

/// Numbers clusters by their size, the largest first.
void numberBySize(LayerVolume& map, int layers) {
  const std::vector<double> shares = layerShares(map, layers);
  std::vector<int> order(static_cast<std::size_t>(layers));
  std::iota(order.begin(), order.end(), 1);
  std::ranges::stable_sort(order, std::greater{},
                           [&](int k) { return shares[static_cast<std::size_t>(k - 1)]; });
  renumber(map, order);
}

/// A Gaussian of one pixel.
Grid<float> smoothed(const Grid<float>& values) {
  constexpr std::array<float, 7> kWeights{0.00443f, 0.05401f, 0.24204f, 0.39904f,
                                          0.24204f, 0.05401f, 0.00443f};
  Grid<float> rows(values.width(), values.height()), both = rows;
  for (int y = 0; y < values.height(); ++y)
    for (int x = 0; x < values.width(); ++x)
      for (int d = -3; d <= 3; ++d)
        rows(x, y) +=
            kWeights[static_cast<std::size_t>(d + 3)] * values(reflected(x + d, values.width()), y);
  for (int y = 0; y < values.height(); ++y)
    for (int x = 0; x < values.width(); ++x)
      for (int d = -3; d <= 3; ++d)
        both(x, y) +=
            kWeights[static_cast<std::size_t>(d + 3)] * rows(x, reflected(y + d, values.height()));
  return both;
}

/// How many different colors a texture has, counted up to `most`.
std::size_t colorsOf(const MapLayer& texture, std::size_t most) {
  std::set<std::vector<float>> colors;
  for (std::size_t p = 0; p < texture.planes.front().count() && colors.size() < most; ++p) {
    std::vector<float> color;
    for (const Grid<float>& plane : texture.planes) color.push_back(plane[p]);
    colors.insert(std::move(color));
  }
  return colors.size();
}

Decomposition finished(LayerVolume map, int layers) {
  Decomposition result;
  result.shares = layerShares(map, layers);
  result.skipping = skippingShare(map);
  result.map = std::move(map);
  for (const double share : result.shares) {
    if (!(share > 0))
      throw InputError("`layers`: the example has fewer than " + std::to_string(layers) +
                       " different regions; ask for fewer layers");
  }
  return result;
}

}  // namespace

Decomposition decomposeTexture(const MapLayer& texture, const DecompositionOptions& options,
                               std::uint64_t seed, const Progress& progress) {
  const Random random(seed, stream::kLayerClusters);
  const Grid<float>& first = texture.planes.front();
  const std::size_t colors = colorsOf(texture, static_cast<std::size_t>(options.layers));
  if (colors < 2) throw InputError("the example has one color, and so no layers");
  if (colors < static_cast<std::size_t>(options.layers))
    throw InputError("`layers` " + std::to_string(options.layers) + ": the example has " +
                     std::to_string(colors) + " colors, and at most as many layers");
  const Matrix points =
      features(texture, options.neighborhood, random.fork(1), progress.part(0, 0.6));
  const Eigen::Index step = std::max<Eigen::Index>(1, points.rows() / kClustered);
  Matrix sample((points.rows() + step - 1) / step, points.cols());
  for (Eigen::Index n = 0; n < sample.rows(); ++n) sample.row(n) = points.row(n * step);
  std::vector<Matrix> centers(kRestarts);
  std::vector<double> sums(kRestarts);
  parallelFor(0, kRestarts, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r)
      sums[r] = cluster(sample, options.layers, random.fork(2 + r), centers[r], progress);
  });
  progress.report("finding layers", 0.9);
  const Matrix& best =
      centers[static_cast<std::size_t>(std::ranges::min_element(sums) - sums.begin())];
  LayerMap map(first.width(), first.height());
  parallelFor(0, map.count(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      float distance = 0;
      map[p] = static_cast<std::uint8_t>(
          1 + nearestCenter(best, points.row(static_cast<Eigen::Index>(p)).data(), &distance));
    }
  });
  map = majorityFiltered(map);
  removeSpecks(map);
  LayerVolume layers = boxOf(map);
  numberBySize(layers, options.layers);
  renumber(layers, options.order.empty() ? orderOfLayers(layers, options.layers) : options.order);
  progress.report("finding layers", 1);
  return finished(std::move(layers), options.layers);
}

Decomposition decomposeHeights(const Grid<float>& heights, const DecompositionOptions& options,
                               const Progress& progress) {
  progress.report("finding layers", 0);
  if (std::ranges::count(heights.values(), heights[0]) == std::ssize(heights.values()))
    throw InputError("the example has one height, and so no layers");
  const Grid<float> smooth = smoothed(heights);
  std::vector<float> sorted(smooth.values().begin(), smooth.values().end());
  std::ranges::sort(sorted);
  LayerMap map(heights.width(), heights.height(), 1);
  for (int i = 1; i < options.layers; ++i) {
    const std::size_t at =
        sorted.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(options.layers);
    for (std::size_t p = 0; p < map.count(); ++p)
      if (smooth[p] >= sorted[at] && sorted[at] > sorted.front())
        map[p] = static_cast<std::uint8_t>(i + 1);
  }
  return finished(boxOf(map), options.layers);
}

}  // namespace exemplar
