// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "mesh/primitives.h"
#include "mesh/procedural/processes.h"

namespace exemplar {
namespace {

/// Balls of radius 1 in a bin that wraps around in x and y and has a floor at z = 0. They are
/// dropped one after the other, and each rolls down over those before it until it rests (the
/// sequential deposition of Visscher, Bolsterli: "Random packing of equal and unequal spheres in
/// two and three dimensions", Nature 239, 1972, doi:10.1038/239504a0, in small steps): about 0.56
/// of the bin is solid.
class Heap {
 public:
  Heap(double width, double depth)
      : width_(width),
        depth_(depth),
        nx_(std::max(3, static_cast<int>(width / 2))),
        ny_(std::max(3, static_cast<int>(depth / 2))) {}

  /// Drops one more ball at (x, y).
  void drop(double x, double y) {
    Vec3d c{x, y, top_ + 2};
    double step = 0.25;
    while (step > 0.01) {
      Vec3d next = c;
      next.z -= step;
      if (!pushOut(next) || next.z > c.z - 0.005 * step) {
        step *= 0.5;
      } else {
        c = next;
      }
    }
    c.x -= width_ * std::floor(c.x / width_);
    c.y -= depth_ * std::floor(c.y / depth_);
    top_ = std::max(top_, c.z);
    const std::size_t layers = static_cast<std::size_t>(top_ / kCell) + 1;
    cells_.resize(std::max(cells_.size(), layers * nx_ * ny_));
    cells_[cellOf(column(c), static_cast<int>(c.z / kCell))].push_back(centers_.size());
    centers_.push_back(c);
  }

  /// The deepest overlap of two balls.
  double deepest() const {
    double depth = 0;
    for (std::size_t n = 0; n < centers_.size(); ++n) {
      forNear(centers_[n], [&](std::size_t m, const Vec3d& toward) {
        if (m != n) depth = std::max(depth, 2 - length(toward));
      });
    }
    return depth;
  }

  const std::vector<Vec3d>& centers() const { return centers_; }

 private:
  static constexpr double kCell = 2;  ///< height of a cell; its sides are at least as long

  struct Column {
    int i, j;
  };
  Column column(const Vec3d& c) const {
    const int i = static_cast<int>(std::floor(c.x / width_ * nx_));
    const int j = static_cast<int>(std::floor(c.y / depth_ * ny_));
    return {((i % nx_) + nx_) % nx_, ((j % ny_) + ny_) % ny_};
  }
  std::size_t cellOf(const Column& column, int layer) const {
    return (static_cast<std::size_t>(layer) * ny_ + column.j) * nx_ + column.i;
  }

  /// Calls body(ball, vector to it) for every ball that could touch one at `c`.
  template <class Body>
  void forNear(const Vec3d& c, const Body& body) const {
    const Column middle = column(c);
    const int layer = static_cast<int>(c.z / kCell);
    for (int k = std::max(0, layer - 1); k <= layer + 1; ++k) {
      for (int step = 0; step < 9; ++step) {
        const Column at{(middle.i + step % 3 - 1 + nx_) % nx_,
                        (middle.j + step / 3 - 1 + ny_) % ny_};
        const std::size_t cell = cellOf(at, k);
        if (cell >= cells_.size()) continue;
        for (const std::size_t m : cells_[cell]) {
          Vec3d d = centers_[m] - c;
          d.x -= width_ * std::round(d.x / width_);
          d.y -= depth_ * std::round(d.y / depth_);
          body(m, d);
        }
      }
    }
  }

  /// Moves a ball out of the others and above the floor, out of the deepest overlap first. False
  /// where there is no room.
  bool pushOut(Vec3d& c) const {
    for (int round = 0; round < 60; ++round) {
      c.z = std::max(c.z, 1.0);
      double depth = 1e-3;
      Vec3d push{};
      forNear(c, [&](std::size_t, const Vec3d& toward) {
        const double distance = length(toward);
        if (2 - distance <= depth || distance == 0) return;
        depth = 2 - distance;
        push = toward * (-depth / distance);
      });
      if (push == Vec3d{}) return true;
      c += push;
    }
    return false;
  }

  double width_, depth_;
  int nx_, ny_;
  double top_ = 0;
  std::vector<Vec3d> centers_;
  std::vector<std::vector<std::size_t>> cells_;
};

constexpr std::array<std::array<float, 4>, 5> kColors{{{0.64f, 0.10f, 0.07f, 1},
                                                       {0.85f, 0.52f, 0.09f, 1},
                                                       {0.08f, 0.29f, 0.46f, 1},
                                                       {0.71f, 0.68f, 0.60f, 1},
                                                       {0.13f, 0.37f, 0.18f, 1}}};

}  // namespace

ProcessSample makeBalls(const BallsProcess& process, const Vec3d& extent, std::uint64_t seed,
                        const Progress& progress) {
  const Random random(seed, stream::kBalls);
  const double r = process.radius;
  const Vec3d window = extent * process.side;
  // In ball radii: a bin wider than the window, whose lowest layers and loose top stay outside.
  const double margin = 4, below = 6, above = 6;
  const Vec3d bin = window / r + Vec3d{2 * margin, 2 * margin, below + above};
  const int count = static_cast<int>(bin.x * bin.y * bin.z * 0.56 / 4.18879);
  Heap heap(bin.x, bin.y);
  for (int n = 0; n < count; ++n) {
    progress.report("dropping balls", 0.6 * n / count);
    heap.drop(random.uniform(0, bin.x, n, 0), random.uniform(0, bin.y, n, 1));
  }
  // What overlap the small steps left is taken off all radii.
  const double radius = r * (1 - 0.5 * std::max(0.0, heap.deepest()) - 1e-4);

  ProcessSample sample;
  sample.box = {{0, 0, 0}, window};
  std::vector<TriangleMesh> byColor(process.colors);
  const std::vector<Vec3d>& centers = heap.centers();
  for (std::size_t n = 0; n < centers.size(); ++n) {
    progress.report("making balls", 0.6 + 0.4 * static_cast<double>(n) / count);
    // The bin wraps: every copy that reaches into the window counts.
    for (int wrap = 0; wrap < 9; ++wrap) {
      const Vec3d c = (centers[n] - Vec3d{margin, margin, below} +
                       Vec3d{bin.x * (wrap % 3 - 1), bin.y * (wrap / 3 - 1), 0}) *
                      r;
      const Vec3d nearest = max(sample.box.min, min(c, sample.box.max));
      if (length(nearest - c) > 2 * r) continue;
      append(byColor[random.below(process.colors, n, 7)], makeSphere(c, radius, 6));
    }
  }
  for (int color = 0; color < process.colors; ++color) {
    if (byColor[color].triangles.empty()) continue;
    setMaterial(byColor[color], {.name = "ball " + std::to_string(color + 1),
                                 .baseColor = kColors[color % kColors.size()],
                                 .roughness = 0.45f});
    append(sample.mesh, byColor[color]);
  }
  return sample;
}

}  // namespace exemplar
