// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/redistance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "sdf/sample_distances.h"

namespace exemplar {
namespace {

// The corners of a cell, x fastest, and the six tetrahedra along its diagonal from corner 0 to 7
// (Kuhn's subdivision): neighbouring cells cut their common face along the same diagonal. Each is
// listed so that its corners are positively oriented.
constexpr std::array<std::array<int, 4>, 6> kTetrahedra{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

struct Sample {
  Vec3d position;
  double value;
};

// Where the line between samples of different sign is zero. The samples come in the same order from
// every tetrahedron that has the edge, so that the corner is the same to the last bit.
Vec3d crossing(const Sample& a, const Sample& b) {
  const Sample& inside = a.value < 0 ? a : b;
  const Sample& outside = a.value < 0 ? b : a;
  const double t = inside.value / (inside.value - outside.value);
  return inside.position + (outside.position - inside.position) * t;
}

void cutTetrahedron(const std::array<Sample, 4>& s, std::vector<Corners>& out) {
  std::array<int, 4> in{}, ex{};
  int inCount = 0, exCount = 0;
  for (int c = 0; c < 4; ++c) {
    if (s[c].value < 0) {
      in[inCount++] = c;
    } else {
      ex[exCount++] = c;
    }
  }
  if (inCount == 0 || exCount == 0) return;
  // The triangle's front faces the outside samples: fixed up by the sign of a determinant, which is
  // simpler than a table of cases.
  const auto emit = [&](const Vec3d& p, const Vec3d& q, const Vec3d& r) {
    const Vec3d normal = cross(q - p, r - p);
    Vec3d toOutside{};
    for (int e = 0; e < exCount; ++e) toOutside += s[ex[e]].position / double(exCount);
    for (int i = 0; i < inCount; ++i) toOutside -= s[in[i]].position / double(inCount);
    if (dot(normal, toOutside) >= 0) {
      out.push_back({p, q, r});
    } else {
      out.push_back({p, r, q});
    }
  };
  if (inCount == 2) {
    const Vec3d p = crossing(s[in[0]], s[ex[0]]), q = crossing(s[in[0]], s[ex[1]]);
    const Vec3d r = crossing(s[in[1]], s[ex[1]]), t = crossing(s[in[1]], s[ex[0]]);
    emit(p, q, r);
    emit(p, r, t);
  } else {
    const auto& apex = inCount == 1 ? s[in[0]] : s[ex[0]];
    const auto& base = inCount == 1 ? ex : in;
    emit(crossing(apex, s[base[0]]), crossing(apex, s[base[1]]), crossing(apex, s[base[2]]));
  }
}

}  // namespace

std::vector<Corners> zeroSet(const Array3D<float>& values, const Array3D<std::uint8_t>* where) {
  const Vec3i size = values.size();
  if (size.x < 2 || size.y < 2 || size.z < 2) return {};
  // One list a layer of cells, joined in order: the same triangles at any number of threads.
  std::vector<std::vector<Corners>> layers(static_cast<std::size_t>(size.z) - 1);
  parallelFor(0, layers.size(), 1, [&](std::size_t k0, std::size_t k1) {
    for (std::size_t layer = k0; layer < k1; ++layer) {
      const int k = static_cast<int>(layer);
      for (int j = 0; j + 1 < size.y; ++j)
        for (int i = 0; i + 1 < size.x; ++i) {
          // Most cells have nothing: cheap looks first.
          int inside = 0, wanted = where ? 0 : 1;
          for (int c = 0; c < 8; ++c) {
            const Vec3i ijk{i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)};
            inside += values[ijk] < 0;
            if (where) wanted |= (*where)[ijk];
          }
          if (inside == 0 || inside == 8 || wanted == 0) continue;
          std::array<Sample, 8> cell;
          for (int c = 0; c < 8; ++c) {
            const Vec3i ijk{i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)};
            cell[c] = {cast<double>(ijk), values[ijk]};
          }
          for (const auto& t : kTetrahedra) {
            cutTetrahedron({cell[t[0]], cell[t[1]], cell[t[2]], cell[t[3]]}, layers[layer]);
          }
        }
    }
  });
  std::size_t count = 0;
  for (const auto& layer : layers) count += layer.size();
  std::vector<Corners> triangles;
  triangles.reserve(count);
  for (auto& layer : layers) {
    triangles.insert(triangles.end(), layer.begin(), layer.end());
    layer = {};
  }
  return triangles;
}

DistanceField redistance(const DistanceField& field, const RedistanceOptions& options,
                         const Progress& progress) {
  if (!(options.halfWidth > 0))
    throw InputError("halfWidth is " + std::to_string(options.halfWidth) +
                     "; it must be > 0 voxels");
  requireMemory(static_cast<double>(field.values.count()) * 8, "redistancing a field",
                "use a lower resolution");
  DistanceField result;
  result.values = Array3D<float>(field.size());
  result.voxelSize = field.voxelSize;
  result.origin = field.origin;
  result.truncation = static_cast<float>(options.halfWidth * field.voxelSize);
  progress.report("redistancing", 0);
  const TriangleTree surface(zeroSet(field.values));
  const double diagonal = length(cast<double>(field.size()));
  const double limit =
      surface.count() == 0 ? std::min(options.halfWidth, diagonal) : options.halfWidth;
  progress.report("redistancing", 0.3);
  sampleDistances(surface, limit, {}, result.values);
  const auto before = field.values.values();
  const auto values = result.values.values();
  parallelFor(0, values.size(), 1 << 14, [&](std::size_t b, std::size_t e) {
    for (std::size_t s = b; s < e; ++s) {
      const auto d = static_cast<float>(values[s] * field.voxelSize);
      values[s] = before[s] < 0 ? -std::max(d, std::numeric_limits<float>::min()) : d;
    }
  });
  progress.report("redistancing", 1);
  return result;
}

}  // namespace exemplar
