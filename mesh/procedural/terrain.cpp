// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "core/random.h"
#include "mesh/primitives.h"
#include "mesh/procedural/noise.h"
#include "mesh/procedural/processes.h"

namespace exemplar {
namespace {

constexpr int kNeighbors[8][2] = {{1, 0}, {-1, 0}, {0, 1},  {0, -1},
                                  {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};

/// Land that rises and is carved by the water that runs over it. Lengths in cells.
class Landscape {
 public:
  Landscape(int columns, int rows, double valley, const Random& random)
      : columns_(columns), rows_(rows) {
    const std::size_t n = static_cast<std::size_t>(columns) * rows;
    height_.resize(n);
    floor_.resize(n);
    receiver_.resize(n);
    area_.resize(n);
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {
        const std::size_t cell = index(c, r);
        // Valley floors wind along the zero lines of a smooth noise: base levels that never rise.
        const double bend = fractalNoise(random, c / (1.25 * valley), r / (1.25 * valley), 3, 0.35);
        floor_[cell] = std::abs(bend) < 0.05;
        height_[cell] =
            floor_[cell] ? 0 : 0.5 + 0.5 * fractalNoise(random, 31 + c / 9.0, 47 + r / 9.0, 4);
      }
    }
  }

  /// One step of uplift and erosion, implicit in time: heights can only become smoother.
  void erode(double uplift, double erodibility) {
    route();
    std::fill(area_.begin(), area_.end(), 1.0);
    for (auto it = order_.rbegin(); it != order_.rend(); ++it) {
      if (receiver_[*it] != *it) area_[receiver_[*it]] += area_[*it];
    }
    for (const std::size_t cell : order_) {
      if (receiver_[cell] == cell) continue;
      const double run = distance(cell, receiver_[cell]);
      const double power = erodibility * std::sqrt(area_[cell]) / run;
      height_[cell] = (height_[cell] + uplift + power * height_[receiver_[cell]]) / (1 + power);
    }
  }

  /// Lets slopes above `limit` slide, and smooths a little.
  void slide(double limit, int rounds) {
    std::vector<double> next(height_.size());
    for (int round = 0; round < rounds; ++round) {
      next = height_;
      for (int r = 0; r < rows_; ++r) {
        for (int c = 0; c < columns_; ++c) {
          const std::size_t cell = index(c, r);
          if (floor_[cell]) continue;
          for (const auto& d : kNeighbors) {
            if (!inside(c + d[0], r + d[1])) continue;
            const std::size_t other = index(c + d[0], r + d[1]);
            const double run = d[0] && d[1] ? std::sqrt(2.0) : 1.0;
            const double drop = height_[cell] - height_[other];
            if (drop > limit * run) next[cell] -= 0.12 * (drop - limit * run);
            if (-drop > limit * run) next[cell] += 0.12 * (-drop - limit * run);
          }
        }
      }
      height_.swap(next);
    }
  }

  /// Averages each cell with its neighbors: soil creeps.
  void smooth(int rounds) {
    std::vector<double> next(height_.size());
    for (int round = 0; round < rounds; ++round) {
      for (int r = 0; r < rows_; ++r) {
        for (int c = 0; c < columns_; ++c) {
          double sum = 2 * height_[index(c, r)], weight = 2;
          for (const auto& d : kNeighbors) {
            if (!inside(c + d[0], r + d[1])) continue;
            const double w = d[0] && d[1] ? 0.5 : 1.0;
            sum += w * height_[index(c + d[0], r + d[1])];
            weight += w;
          }
          next[index(c, r)] = sum / weight;
        }
      }
      height_.swap(next);
    }
  }

  const std::vector<double>& heights() const { return height_; }
  std::vector<double>& heights() { return height_; }

 private:
  std::size_t index(int c, int r) const { return static_cast<std::size_t>(r) * columns_ + c; }
  bool inside(int c, int r) const { return c >= 0 && r >= 0 && c < columns_ && r < rows_; }
  double distance(std::size_t a, std::size_t b) const {
    const int n = columns_;
    const bool straight = a % n == b % n || a / n == b / n;
    return straight ? 1.0 : std::sqrt(2.0);
  }

  /// Where each cell's water goes: flooded from the valley floors upwards, so that every pit has a
  /// way out; then to the steepest of the neighbors flooded earlier.
  void route() {
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::vector<std::uint8_t> reached(height_.size());
    order_.clear();
    for (std::size_t cell = 0; cell < height_.size(); ++cell) {
      if (!floor_[cell]) continue;
      receiver_[cell] = cell;
      reached[cell] = 1;
      queue.push({height_[cell], cell});
    }
    if (queue.empty()) {
      receiver_[0] = 0;
      reached[0] = 1;
      queue.push({height_[0], 0});
    }
    while (!queue.empty()) {
      const auto [level, cell] = queue.top();
      queue.pop();
      order_.push_back(cell);
      const int c = static_cast<int>(cell % columns_), r = static_cast<int>(cell / columns_);
      for (const auto& d : kNeighbors) {
        if (!inside(c + d[0], r + d[1])) continue;
        const std::size_t other = index(c + d[0], r + d[1]);
        if (reached[other]) continue;
        reached[other] = 1;
        receiver_[other] = cell;
        queue.push({std::max(height_[other], level), other});
      }
    }
  }

  int columns_, rows_;
  std::vector<double> height_;
  std::vector<std::uint8_t> floor_;
  std::vector<std::size_t> receiver_, order_;
  std::vector<double> area_;
};

std::array<float, 4> mix(const std::array<float, 4>& a, const std::array<float, 4>& b, double t) {
  const float s = static_cast<float>(std::clamp(t, 0.0, 1.0));
  return {a[0] + (b[0] - a[0]) * s, a[1] + (b[1] - a[1]) * s, a[2] + (b[2] - a[2]) * s, 1};
}

/// By height and slope: meadow on the valley floors, scree, rock on slopes, snow on the ridges.
void paint(TriangleMesh& mesh, double relief) {
  const std::array<float, 4> meadow{0.16f, 0.24f, 0.07f, 1}, earth{0.34f, 0.24f, 0.14f, 1},
      rock{0.30f, 0.27f, 0.25f, 1}, snow{0.86f, 0.88f, 0.92f, 1};
  std::vector<Vec3d> normals(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) normals[v] += areaNormal(mesh, t);
  }
  mesh.colors.resize(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const double height = mesh.positions[v].z / relief;
    const double flat = normalized(normals[v]).z;
    auto color = mix(meadow, earth, (height - 0.15) / 0.3);
    color = mix(color, rock, (0.86 - flat) / 0.15);
    mesh.colors[v] = mix(color, snow, (height - 0.8) / 0.1 * (flat - 0.45));
  }
}

}  // namespace

ProcessSample makeTerrain(const TerrainProcess& process, const Vec3d& extent, std::uint64_t seed,
                          const Progress& progress) {
  const Random random(seed, stream::kTerrain);
  const double cell = 0.5, margin = 20;
  const Vec3d window = extent * process.side;
  const int columns = static_cast<int>((window.x + 2 * margin) / cell) + 1;
  const int rows = static_cast<int>((window.y + 2 * margin) / cell) + 1;
  Landscape land(columns, rows, process.valley / cell, random);
  for (int step = 0; step < process.steps; ++step) {
    progress.report("eroding", 0.9 * step / process.steps);
    land.erode(0.5, 0.17);
    land.slide(0.9, 1);
  }
  land.smooth(1);
  land.slide(0.85, 4);
  // The process has no scale of height of its own: its 99.5th percentile becomes the relief.
  std::vector<double> sorted = land.heights();
  const auto high = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 995 / 1000);
  std::nth_element(sorted.begin(), high, sorted.end());
  for (double& h : land.heights()) h *= process.relief / std::max(1e-9, *high);

  ProcessSample sample;
  const double air = 2;
  sample.box = {{0, 0, -process.depth}, {window.x, window.y, 1.1 * process.relief + air}};
  sample.mesh = makeHeightFieldSolid({-margin, -margin, 0}, cell, columns, rows, land.heights(),
                                     -3 * process.depth);
  progress.report("painting", 0.9);
  paint(sample.mesh, process.relief);
  setMaterial(sample.mesh, {.name = "terrain", .baseColor = {1, 1, 1, 1}, .roughness = 0.9f});
  return sample;
}

}  // namespace exemplar
