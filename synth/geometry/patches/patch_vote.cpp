// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/patches/patch_vote.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/parallel.h"

namespace exemplar {
namespace {

std::vector<float> gaussian(int patch) {
  std::vector<float> weights(patch);
  const double sigma = patch / 3.0;
  for (int n = 0; n < patch; ++n) {
    const double d = n - (patch - 1) / 2.0;
    weights[n] = static_cast<float>(std::exp(-d * d / (2 * sigma * sigma)));
  }
  return weights;
}

/// The weight of a patch's vote (recipe of Kwatra 2005, section 3.2, softened near zero).
float confidence(float distance) { return 1.0f / (0.05f + distance); }

/// The patches whose samples cover one coordinate: first and one past the last index along an axis.
struct Covering {
  int begin, end;
};
Covering covering(int p, int patch, int stride, int patches) {
  const int first = p - patch + 1;
  return {first <= 0 ? 0 : (first + stride - 1) / stride, std::min(p / stride + 1, patches)};
}

}  // namespace

NearestNeighborField fieldOf(const PyramidLevel& level, const PyramidSources& sources,
                             const Vec3i& stride) {
  NearestNeighborField field;
  const Vec3i last = sources.size() - level.patch;
  const Vec3i lastMatch = level.source.values.size() - level.patch;
  const Vec3i half{level.patch.x / 2, level.patch.y / 2, level.patch.z / 2};
  field.stride = stride;
  field.position =
      Array3D<Vec3i>({last.x / stride.x + 1, last.y / stride.y + 1, last.z / stride.z + 1});
  parallelForEachCell(field.position.size(), [&](const Vec3i& p) {
    const Vec3i middle = scaled(p, stride) + half;
    field.position[p] = max(Vec3i{0, 0, 0}, min(sources[middle] - half, lastMatch));
  });
  return field;
}

Array3D<float> vote(const PyramidLevel& level, const NearestNeighborField& field, const Vec3i& size,
                    const Progress& progress) {
  Array3D<float> target(size);
  const auto gx = gaussian(level.patch.x), gy = gaussian(level.patch.y),
             gz = gaussian(level.patch.z);
  const Vec3i n = field.position.size();
  const std::size_t rows = static_cast<std::size_t>(size.y) * size.z;
  parallelFor(0, rows, 16, [&](std::size_t begin, std::size_t end) {
    std::vector<float> sum(size.x), weight(size.x);
    for (std::size_t row = begin; row < end; ++row) {
      progress.check();
      const int j = static_cast<int>(row % size.y), k = static_cast<int>(row / size.y);
      std::fill(sum.begin(), sum.end(), 0.0f);
      std::fill(weight.begin(), weight.end(), 0.0f);
      const Covering cy = covering(j, level.patch.y, field.stride.y, n.y);
      const Covering cz = covering(k, level.patch.z, field.stride.z, n.z);
      for (int c = cz.begin; c < cz.end; ++c) {
        const int dz = k - c * field.stride.z;
        for (int b = cy.begin; b < cy.end; ++b) {
          const int dy = j - b * field.stride.y;
          for (int a = 0; a < n.x; ++a) {
            const Vec3i from = field.position(a, b, c);
            const float w = confidence(field.distance(a, b, c)) * gy[dy] * gz[dz];
            const float* values = &level.source.values(from.x, from.y + dy, from.z + dz);
            float* s = &sum[static_cast<std::size_t>(a) * field.stride.x];
            float* t = &weight[static_cast<std::size_t>(a) * field.stride.x];
            for (int i = 0; i < level.patch.x; ++i) {
              s[i] += w * gx[i] * values[i];
              t[i] += w * gx[i];
            }
          }
        }
      }
      for (int i = 0; i < size.x; ++i) target(i, j, k) = sum[i] / weight[i];
    }
  });
  return target;
}

PyramidSources plurality(const PyramidLevel& level, const NearestNeighborField& field,
                         const Vec3i& size, const Array3D<std::uint8_t>* where,
                         const Progress& progress) {
  PyramidSources sources(size);
  const auto gx = gaussian(level.patch.x), gy = gaussian(level.patch.y),
             gz = gaussian(level.patch.z);
  const Vec3i n = field.position.size();
  const std::size_t rows = static_cast<std::size_t>(size.y) * size.z;
  parallelFor(0, rows, 16, [&](std::size_t begin, std::size_t end) {
    std::vector<std::pair<Vec3i, float>> votes;
    for (std::size_t row = begin; row < end; ++row) {
      progress.check();
      const int j = static_cast<int>(row % size.y), k = static_cast<int>(row / size.y);
      const Covering cy = covering(j, level.patch.y, field.stride.y, n.y);
      const Covering cz = covering(k, level.patch.z, field.stride.z, n.z);
      for (int i = 0; i < size.x; ++i) {
        if (where && !(*where)(i, j, k)) continue;
        const Covering cx = covering(i, level.patch.x, field.stride.x, n.x);
        votes.clear();
        for (int c = cz.begin; c < cz.end; ++c) {
          for (int b = cy.begin; b < cy.end; ++b) {
            for (int a = cx.begin; a < cx.end; ++a) {
              const Vec3i d = Vec3i{i, j, k} - scaled(Vec3i{a, b, c}, field.stride);
              const Vec3i cell = field.position(a, b, c) + d;
              const float w = confidence(field.distance(a, b, c)) * gx[d.x] * gy[d.y] * gz[d.z];
              const auto known = std::find_if(votes.begin(), votes.end(),
                                              [&](const auto& v) { return v.first == cell; });
              if (known == votes.end()) {
                votes.emplace_back(cell, w);
              } else {
                known->second += w;
              }
            }
          }
        }
        std::size_t best = 0;
        for (std::size_t v = 1; v < votes.size(); ++v) {
          if (votes[v].second > votes[best].second) best = v;
        }
        sources(i, j, k) = votes[best].first;
      }
    }
  });
  return sources;
}

}  // namespace exemplar
