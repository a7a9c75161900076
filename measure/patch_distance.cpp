// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/patch_distance.h"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"
#include "measure/same_voxels.h"

namespace exemplar {
namespace {

constexpr int kSide = 7;
constexpr int kReach = kSide / 2;
constexpr int kSamples = kSide * kSide * kSide;
constexpr double kTruncation = 3;  // voxels

/// One row a patch.
using Patches = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Where the patches of a field are centered, in the order of the samples.
std::vector<Vec3i> centers(const DistanceField& field) {
  const Vec3i n = field.size();
  const auto half = static_cast<float>(field.voxelSize / 2);
  std::vector<std::vector<Vec3i>> layers(std::max(0, n.z - 2 * kReach));
  parallelFor(0, layers.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t layer = begin; layer < end; ++layer) {
      const int k = static_cast<int>(layer) + kReach;
      for (int j = kReach; j < n.y - kReach; ++j)
        for (int i = kReach; i < n.x - kReach; ++i)
          if (std::abs(field.values(i, j, k)) <= half) layers[layer].push_back({i, j, k});
    }
  });
  std::vector<Vec3i> all;
  for (const auto& layer : layers) all.insert(all.end(), layer.begin(), layer.end());
  return all;
}

/// `count` patches drawn with repetition: `count` x 343 samples in voxels.
Patches draw(const DistanceField& field, const std::vector<Vec3i>& centers, double truncation,
             int count, std::uint64_t seed, std::uint32_t randomStream, int round) {
  const Random random(seed, randomStream);
  Patches patches(count, kSamples);
  parallelFor(0, count, 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const Vec3i c = centers[random.below(static_cast<std::uint32_t>(centers.size()), p, round)];
      double* out = patches.row(static_cast<Eigen::Index>(p)).data();
      for (int k = -kReach; k <= kReach; ++k)
        for (int j = -kReach; j <= kReach; ++j) {
          const float* in = &field.values(c.x - kReach, c.y + j, c.z + k);
          for (int i = 0; i < kSide; ++i)
            *out++ = std::clamp(in[i] / field.voxelSize, -truncation, truncation);
        }
    }
  });
  return patches;
}

struct Gaussian {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

Gaussian fit(const Patches& points) {
  Gaussian g;
  g.mean = points.colwise().mean();
  const Eigen::MatrixXd centered = points.rowwise() - g.mean.transpose();
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(points.cols(), points.cols());
  lower.selfadjointView<Eigen::Lower>().rankUpdate(centered.transpose(),
                                                   1.0 / static_cast<double>(points.rows() - 1));
  g.covariance = lower.selfadjointView<Eigen::Lower>();
  return g;
}

/// The square root of a symmetric matrix; eigenvalues below zero are rounding and count as zero.
Eigen::MatrixXd squareRoot(const Eigen::MatrixXd& m) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(m);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() *
         solver.eigenvectors().transpose();
}

double frechet(const Gaussian& a, const Gaussian& b) {
  // trace (S1 S2)^(1/2) = trace (S1^(1/2) S2 S1^(1/2))^(1/2), whose argument is symmetric.
  const Eigen::MatrixXd root = squareRoot(a.covariance);
  Eigen::MatrixXd product = root * b.covariance * root;
  product = (0.5 * (product + product.transpose())).eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(product, Eigen::EigenvaluesOnly);
  const double distance = (a.mean - b.mean).squaredNorm() + a.covariance.trace() +
                          b.covariance.trace() -
                          2 * solver.eigenvalues().cwiseMax(0).cwiseSqrt().sum();
  return std::max(0.0, distance);
}

/// The truncation of a field in voxels; a field that names none has none.
double truncationVoxels(const DistanceField& field) {
  return field.truncation > 0 ? field.truncation / field.voxelSize : kTruncation;
}

}  // namespace

std::optional<PatchDistance> patchDistance(const DistanceField& example,
                                           const DistanceField& result,
                                           const PatchDistanceOptions& options,
                                           const Progress& progress) {
  assert(options.patches >= 64 && options.rounds >= 1);
  assert(options.components >= 1 && options.components <= kSamples);
  requireSameVoxels(example, result);
  const std::vector<Vec3i> exampleCenters = centers(example), resultCenters = centers(result);
  if (exampleCenters.empty() || resultCenters.empty()) return std::nullopt;
  const double truncation =
      std::min({kTruncation, truncationVoxels(example), truncationVoxels(result)});

  PatchDistance sum;
  Eigen::MatrixXd basis;  // 343 x components
  for (int round = 0; round < options.rounds; ++round) {
    progress.report("comparing patches", static_cast<double>(round) / options.rounds);
    const Patches patches = draw(example, exampleCenters, truncation, options.patches, options.seed,
                                 stream::kExampleWindows, round);
    if (round == 0) {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(fit(patches).covariance);
      basis = solver.eigenvectors().rightCols(options.components);  // ascending eigenvalues
    }
    // The same stream for both: the example against itself scores its floor, to the bit.
    const Gaussian reference = fit(patches * basis);
    const auto against = [&](const DistanceField& field, const std::vector<Vec3i>& from) {
      return frechet(reference, fit(draw(field, from, truncation, options.patches, options.seed,
                                         stream::kResultWindows, round) *
                                    basis));
    };
    sum.distance += against(result, resultCenters);
    sum.floor += against(example, exampleCenters);
  }
  return PatchDistance{sum.distance / options.rounds, sum.floor / options.rounds,
                       static_cast<std::int64_t>(exampleCenters.size()),
                       static_cast<std::int64_t>(resultCenters.size())};
}

}  // namespace exemplar
