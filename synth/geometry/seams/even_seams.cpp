// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/seams/even_seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/parallel.h"
#include "search/lattice_cut.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 4096;
/// Of the rounds in the gradient domain: near the best for regions of a dozen samples across.
constexpr float kOver = 1.7f;
/// Up to here, in voxels, distances are relaxed to slope 1: fully a voxel earlier.
constexpr float kRelaxed = 4;

/// The samples within `reach` steps of a seam, in the order of the grid.
std::vector<std::size_t> nearSeams(const Origins& origins, int reach) {
  if (reach == 0) return {};
  // Steps to the nearest sample beside a seam: along one axis after another, there and back.
  const Vec3i n = origins.size();
  constexpr int kFar = 254;
  Array3D<std::uint8_t> steps(n, kFar);
  parallelForEachCell(n, [&](const Vec3i& p) {
    const Vec3i offset = origins[p].cell() - p;
    for (const Vec3i& step : kFaceSteps) {
      const Vec3i q = p + step;
      if (origins.contains(q) && origins[q].cell() - q != offset) steps[p] = 0;
    }
  });
  const auto nearer = [](std::uint8_t& here, std::uint8_t there) {
    here = std::min<std::uint8_t>(here, std::min<std::uint8_t>(there, kFar) + 1);
  };
  const auto rows = [&](int count, const auto& body) {
    parallelFor(0, static_cast<std::size_t>(count), 1, [&](std::size_t from, std::size_t to) {
      for (std::size_t row = from; row < to; ++row) body(static_cast<int>(row));
    });
  };
  rows(n.z, [&](int k) {
    for (int j = 0; j < n.y; ++j) {
      for (int i = 1; i < n.x; ++i) nearer(steps(i, j, k), steps(i - 1, j, k));
      for (int i = n.x - 1; i-- > 0;) nearer(steps(i, j, k), steps(i + 1, j, k));
    }
    for (int j = 1; j < n.y; ++j) {
      for (int i = 0; i < n.x; ++i) nearer(steps(i, j, k), steps(i, j - 1, k));
    }
    for (int j = n.y - 1; j-- > 0;) {
      for (int i = 0; i < n.x; ++i) nearer(steps(i, j, k), steps(i, j + 1, k));
    }
  });
  rows(n.y, [&](int j) {
    for (int k = 1; k < n.z; ++k) {
      for (int i = 0; i < n.x; ++i) nearer(steps(i, j, k), steps(i, j, k - 1));
    }
    for (int k = n.z - 1; k-- > 0;) {
      for (int i = 0; i < n.x; ++i) nearer(steps(i, j, k), steps(i, j, k + 1));
    }
  });
  std::vector<std::size_t> samples;
  for (std::size_t s = 0; s < steps.count(); ++s) {
    if (steps.values()[s] < std::min(reach, kFar)) samples.push_back(s);
  }
  return samples;
}

/// A sample's six neighbors: the sample itself where there is none.
using Neighbors = std::array<std::uint32_t, 6>;

class Relaxation {
 public:
  /// `values` in voxels; those of `where` change.
  Relaxation(std::vector<float> values, const Array3D<Origin>& grid,
             const std::vector<std::size_t>& where)
      : values_(std::move(values)), where_(where), neighbors_(where.size()), next_(where.size()) {
    overSamples([&](std::size_t n, std::size_t s) {
      for (int d = 0; d < 6; ++d) {
        const Vec3i q = grid.ijk(s) + kLatticeSteps[d];
        neighbors_[n][d] = static_cast<std::uint32_t>(grid.contains(q) ? grid.index(q) : s);
      }
    });
  }

  /// Takes note of the sources' slopes, for `blend`.
  void noteSlopes(const DistanceField& example, const Origins& origins,
                  const Array3D<std::uint8_t>* usable) {
    rises_.resize(where_.size());
    overSamples([&](std::size_t n, std::size_t s) {
      for (int d = 0; d < 6; ++d) {
        const std::size_t t = neighbors_[n][d];
        rises_[n][d] = t == s ? 0 : rise(example, usable, origins, s, t, kLatticeSteps[d]);
      }
    });
    for (std::size_t n = 0; n < where_.size(); ++n) {
      const Vec3i p = origins.ijk(where_[n]);
      colors_[(p.x + p.y + p.z) % 2].push_back(static_cast<std::uint32_t>(n));
    }
  }

  /// Gives the values the slopes of their sources: samples whose coordinates' sum is even, then the
  /// others, for no two of one kind are neighbors.
  void blend(int rounds, const Progress& progress) {
    for (int half = 0; half < 2 * rounds; ++half) {
      progress.report("evening seams", half / (2.0 * rounds));
      const std::vector<std::uint32_t>& color = colors_[half % 2];
      parallelFor(0, color.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m) {
          const std::size_t n = color[m], s = where_[n];
          float sum = 0;
          int count = 0;
          for (int d = 0; d < 6; ++d) {
            const std::size_t t = neighbors_[n][d];
            if (t == s) continue;
            sum += values_[t] - rises_[n][d];
            ++count;
          }
          if (count == 0) continue;
          float& v = values_[s];
          const float moved = v + kOver * (sum / static_cast<float>(count) - v);
          v = v < 0 ? std::min(moved, -kLeast) : std::max(moved, kLeast);
        }
      });
    }
  }

  /// Relaxes the values to slope 1, in Jacobi's rounds.
  void relax(int rounds, const Progress& progress) {
    std::vector<float> held(where_.size());
    overSamples([&](std::size_t n, std::size_t s) { held[n] = distanceToZero(n, s); });
    // Without a surface near seams there is nothing to be a distance to.
    if (std::all_of(held.begin(), held.end(), [](float h) { return h == 0; })) return;
    for (int round = 0; round < rounds; ++round) {
      progress.report("evening seams", static_cast<double>(round) / rounds);
      overSamples([&](std::size_t n, std::size_t s) {
        const float v = values_[s];
        if (held[n] != 0) {
          next_[n] = v + 0.5f * (held[n] - v);
          return;
        }
        const float weight = std::clamp(kRelaxed - std::abs(v), 0.0f, 1.0f);
        const float step = weight == 0 ? 0 : 0.5f * weight * (upwindSlope(n, s) - 1);
        const float moved = v - std::copysign(1.0f, v) * step;
        next_[n] = (moved < 0) == (v < 0) ? moved : v;
      });
      overSamples([&](std::size_t n, std::size_t s) { values_[s] = next_[n]; });
    }
  }

  const std::vector<float>& values() const { return values_; }

 private:
  /// How near to the surface a sample that would cross it stays, in voxels.
  static constexpr float kLeast = 0.05f;

  /// By how much the field rises from s to t, one step on, according to the sources of both, in
  /// voxels.
  static float rise(const DistanceField& example, const Array3D<std::uint8_t>* usable,
                    const Origins& origins, std::size_t s, std::size_t t, const Vec3i& step) {
    const Vec3i from = origins.values()[s].cell(), to = origins.values()[t].cell();
    const float voxel = static_cast<float>(example.voxelSize);
    if (to - from == step) return (example.values[to] - example.values[from]) / voxel;
    const auto known = [&](const Vec3i& cell) {
      return example.values.contains(cell) && (!usable || (*usable)[cell]);
    };
    float sum = 0;
    int count = 0;
    if (const Vec3i on = from + step; known(on)) {
      sum += example.values[on] - example.values[from];
      ++count;
    }
    if (const Vec3i back = to - step; known(back)) {
      sum += example.values[to] - example.values[back];
      ++count;
    }
    return count == 0 ? 0 : sum / (static_cast<float>(count) * voxel);
  }

  template <class Body>
  void overSamples(const Body& body) const {
    parallelFor(0, where_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) body(n, where_[n]);
    });
  }

  /// The signed distance to the zero set, by the slope across it, where it passes between a sample
  /// and a neighbor; 0 elsewhere.
  float distanceToZero(std::size_t n, std::size_t s) const {
    const float v = values_[s];
    bool beside = false;
    float square = 0, steepest = 1e-3f;
    for (int d = 0; d < 6; d += 2) {
      const float a = values_[neighbors_[n][d]], b = values_[neighbors_[n][d + 1]];
      beside = beside || (a < 0) != (v < 0) || (b < 0) != (v < 0);
      square += (a - b) * (a - b) / 4;
      steepest = std::max({steepest, std::abs(a - v), std::abs(v - b)});
    }
    return beside ? v / std::max(std::sqrt(square), steepest) : 0;
  }

  /// Godunov's slope, seen from the zero set.
  float upwindSlope(std::size_t n, std::size_t s) const {
    const float v = values_[s], sign = std::copysign(1.0f, v);
    float square = 0;
    for (int d = 0; d < 6; d += 2) {
      const float up = sign * (v - values_[neighbors_[n][d]]);
      const float down = sign * (v - values_[neighbors_[n][d + 1]]);
      const float rise = std::max({up, down, 0.0f});
      square += rise * rise;
    }
    return std::sqrt(square);
  }

  std::vector<float> values_;
  const std::vector<std::size_t>& where_;
  std::vector<Neighbors> neighbors_;
  std::vector<float> next_;
  std::vector<std::array<float, 6>> rises_;  ///< from each sample to its neighbors, in voxels
  std::array<std::vector<std::uint32_t>, 2> colors_;
};

}  // namespace

DistanceField evenSeams(const DistanceField& example, const Origins& origins,
                        const EvenSeamsOptions& options, const Progress& progress) {
  progress.report("evening seams", 0);
  DistanceField field;
  field.voxelSize = example.voxelSize;
  field.origin = example.origin;
  field.truncation = example.truncation;
  field.values = Array3D<float>(origins.size());
  std::vector<float> voxels(origins.count());
  const float voxel = static_cast<float>(example.voxelSize);
  parallelFor(0, origins.count(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      const float v = example.values[origins.values()[s].cell()];
      field.values.values()[s] = v;
      voxels[s] = v / voxel;
    }
  });
  std::vector<std::size_t> where = nearSeams(origins, options.reach);
  if (options.fixed) {
    std::erase_if(where, [&](std::size_t s) { return options.fixed->values()[s] != 0; });
  }
  progress.report("evening seams", 0.2);
  Relaxation relaxation(std::move(voxels), origins, where);
  relaxation.noteSlopes(example, origins, options.usable);
  relaxation.blend(options.blends, progress.part(0.3, 0.8));
  relaxation.relax(options.rounds, progress.part(0.8, 1));
  for (const std::size_t s : where) {
    float v = relaxation.values()[s] * voxel;
    if (example.truncation > 0) v = std::clamp(v, -example.truncation, example.truncation);
    field.values.values()[s] = v;
  }
  return field;
}

}  // namespace exemplar
