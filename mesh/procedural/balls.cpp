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

/// Balls of radius 1 in a bin that wraps around in x and y and has a floor at z = 0.
class Heap {
 public:
  Heap(double width, double depth, int count, const Random& random) : width_(width), depth_(depth) {
    // Dropped from a loose cloud: a third of the density of the heap.
    const double height = count * 4.19 / 0.2 / (width * depth);
    for (int n = 0; n < count; ++n) {
      centers_.push_back({random.uniform(0, width, n, 0), random.uniform(0, depth, n, 1),
                          1 + random.uniform(0, height, n, 2)});
    }
  }

  /// Lets everything fall by `fall`, then pushes overlapping balls apart `rounds` times.
  void settle(double fall, int rounds) {
    for (Vec3d& c : centers_) c.z -= fall;
    for (int round = 0; round < rounds; ++round) pushApart();
  }

  /// The deepest overlap of two balls, or of one with the floor.
  double deepest() {
    sort();
    double depth = 0;
    forNeighbors([&](std::size_t a, std::size_t b) {
      depth = std::max(depth, 2 - length(difference(a, b)));
    });
    return depth;
  }

  const std::vector<Vec3d>& centers() const { return centers_; }

 private:
  Vec3d difference(std::size_t a, std::size_t b) const {
    Vec3d d = centers_[b] - centers_[a];
    d.x -= width_ * std::round(d.x / width_);
    d.y -= depth_ * std::round(d.y / depth_);
    return d;
  }

  void pushApart() {
    sort();
    for (Vec3d& c : centers_) c.z = std::max(c.z, 1.0);
    forNeighbors([&](std::size_t a, std::size_t b) {
      const Vec3d d = difference(a, b);
      const double distance = length(d);
      if (distance >= 2 || distance == 0) return;
      const Vec3d push = d * (0.5 * (2 - distance) / distance);
      centers_[a] -= push;
      centers_[b] += push;
      centers_[a].z = std::max(centers_[a].z, 1.0);
      centers_[b].z = std::max(centers_[b].z, 1.0);
    });
  }

  /// Puts the balls into cells of at least two radii; cells wrap around in x and y.
  void sort() {
    nx_ = std::max(1, static_cast<int>(width_ / 2.2));
    ny_ = std::max(1, static_cast<int>(depth_ / 2.2));
    double top = 0;
    for (Vec3d& c : centers_) {
      c.x -= width_ * std::floor(c.x / width_);
      c.y -= depth_ * std::floor(c.y / depth_);
      top = std::max(top, c.z);
    }
    nz_ = static_cast<int>(top / 2.2) + 1;
    cells_.assign(static_cast<std::size_t>(nx_) * ny_ * nz_, {});
    for (std::size_t n = 0; n < centers_.size(); ++n) cells_[cellOf(centers_[n])].push_back(n);
  }

  std::size_t cellOf(const Vec3d& c) const {
    const int i = std::min(nx_ - 1, static_cast<int>(c.x / width_ * nx_));
    const int j = std::min(ny_ - 1, static_cast<int>(c.y / depth_ * ny_));
    const int k = std::clamp(static_cast<int>(c.z / 2.2), 0, nz_ - 1);
    return (static_cast<std::size_t>(k) * ny_ + j) * nx_ + i;
  }

  /// Each pair of balls in the same or in neighbouring cells, once, lowest cell first.
  template <class Body>
  void forNeighbors(const Body& body) {
    for (int k = 0; k < nz_; ++k) {
      for (int j = 0; j < ny_; ++j) {
        for (int i = 0; i < nx_; ++i) {
          const auto& own = cells_[(static_cast<std::size_t>(k) * ny_ + j) * nx_ + i];
          for (int step = 0; step < 27; ++step) {
            const int dk = step / 9 - 1, dj = step / 3 % 3 - 1, di = step % 3 - 1;
            if (k + dk < 0 || k + dk >= nz_) continue;
            const std::size_t other =
                (static_cast<std::size_t>(k + dk) * ny_ + (j + dj + ny_) % ny_) * nx_ +
                (i + di + nx_) % nx_;
            for (const std::size_t a : own) {
              for (const std::size_t b : cells_[other]) {
                if (a < b) body(a, b);
              }
            }
          }
        }
      }
    }
  }

  double width_, depth_;
  std::vector<Vec3d> centers_;
  int nx_ = 1, ny_ = 1, nz_ = 1;
  std::vector<std::vector<std::size_t>> cells_;
};

constexpr std::array<std::array<float, 4>, 5> kColors{{{0.64f, 0.10f, 0.07f, 1},
                                                       {0.85f, 0.52f, 0.09f, 1},
                                                       {0.08f, 0.29f, 0.46f, 1},
                                                       {0.71f, 0.68f, 0.60f, 1},
                                                       {0.13f, 0.37f, 0.18f, 1}}};

}  // namespace

ProcessSample makeBalls(const BallsProcess& process, const Vec3d& extent, std::uint64_t seed) {
  const Random random(seed, 0xba11);
  const double r = process.radius;
  const Vec3d window = extent * process.side;
  // In ball radii: a bin wider than the window, whose lowest layers and loose top stay outside.
  const double margin = 4, below = 6, above = 6;
  const Vec3d bin = window / r + Vec3d{2 * margin, 2 * margin, below + above};
  const int count = static_cast<int>(bin.x * bin.y * bin.z * 0.58 / 4.18879);
  Heap heap(bin.x, bin.y, count, random);
  for (int step = 0; step < 400; ++step) heap.settle(0.2, 2);
  for (int step = 0; step < 100; ++step) heap.settle(0.02, 3);
  heap.settle(0, 200);
  const double radius = r * (1 - 0.5 * std::max(0.0, heap.deepest()) - 1e-4);

  ProcessSample sample;
  sample.box = {{0, 0, 0}, window};
  std::vector<TriangleMesh> byColor(process.colors);
  const std::vector<Vec3d>& centers = heap.centers();
  for (std::size_t n = 0; n < centers.size(); ++n) {
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
