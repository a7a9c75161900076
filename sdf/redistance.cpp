// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/redistance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/cells.h"
#include "core/error.h"
#include "core/loop_progress.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "sdf/dilate.h"
#include "sdf/example_surface.h"
#include "sdf/sample_distances.h"

namespace exemplar {
namespace {

// The corners of a cell, x fastest, and the six tetrahedra along its diagonal from corner 0 to 7
// (Kuhn's subdivision): neighboring cells cut their common face along the same diagonal. Each is
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

std::vector<Corners> zeroSet(const Array3D<float>& values, const Array3D<std::uint8_t>* where,
                             const Progress& progress) {
  const Vec3i size = values.size();
  if (size.x < 2 || size.y < 2 || size.z < 2) return {};
  // One list a layer of cells, joined in order: the same triangles at any number of threads.
  std::vector<std::vector<Corners>> layers(static_cast<std::size_t>(size.z) - 1);
  parallelFor(0, layers.size(), 1, [&](std::size_t k0, std::size_t k1) {
    for (std::size_t layer = k0; layer < k1; ++layer) {
      progress.check();
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

namespace {

// A distance with the sign of `value`: -0 would count as outside.
float signedAs(float value, double distance) {
  const auto d = static_cast<float>(distance);
  return value < 0 ? -std::max(d, std::numeric_limits<float>::min()) : d;
}

}  // namespace

DistanceField redistance(const DistanceField& field, const RedistanceOptions& options,
                         const Progress& progress) {
  if (!(options.halfWidth > 0))
    throw InputError("`halfWidth` is " + std::to_string(options.halfWidth) +
                     "; it must be > 0 voxels");
  requireMemory(static_cast<double>(field.values.count()) * 8, "redistancing a field",
                "use a lower resolution");
  DistanceField result;
  result.values = Array3D<float>(field.size());
  result.voxelSize = field.voxelSize;
  result.origin = field.origin;
  result.truncation = static_cast<float>(options.halfWidth * field.voxelSize);
  progress.report("redistancing", 0);
  const TriangleTree surface(zeroSet(field.values, nullptr, progress), progress);
  const double diagonal = length(cast<double>(field.size()));
  const double limit =
      surface.count() == 0 ? std::min(options.halfWidth, diagonal) : options.halfWidth;
  sampleDistances(surface, limit, {}, result.values, progress.part(0.3, 1));
  const auto before = field.values.values();
  const auto values = result.values.values();
  parallelFor(0, values.size(), 1 << 14, [&](std::size_t b, std::size_t e) {
    for (std::size_t s = b; s < e; ++s)
      values[s] = signedAs(before[s], values[s] * field.voxelSize);
  });
  progress.report("redistancing", 1);
  return result;
}

namespace {

constexpr const char* kRepairing = "correcting distances at seams";

// Where neighboring samples near the surface differ by more than their distance allows, grown by
// the samples around that are measured again; empty where there is no such place.
Array3D<std::uint8_t> samplesAtJumps(const DistanceField& field, const Progress& progress) {
  constexpr double kAllowed = 1.5;  // voxels between neighbors: 1, and some for blended fields
  constexpr double kNear = 2;       // voxels from the surface
  constexpr int kReach = 2;         // samples around a jump that are measured again
  const Vec3i n = field.size();
  const auto& values = field.values;
  const double allowed = kAllowed * field.voxelSize, near = kNear * field.voxelSize;
  const auto jumps = [&](float a, float b) {
    return std::abs(double{a} - b) > allowed && std::min(std::abs(a), std::abs(b)) < near;
  };
  // At the lower end of each step to the next sample; the reach is wide enough for both ends.
  Array3D<std::uint8_t> marks(n), crossings(n);
  parallelForEachCell(n, [&](const Vec3i& p) {
    if (p.x == 0) progress.check();
    const float a = values[p];
    const auto visit = [&](float b) {
      marks[p] |= jumps(a, b);
      crossings[p] |= (a < 0) != (b < 0);
    };
    if (p.x + 1 < n.x) visit(values(p.x + 1, p.y, p.z));
    if (p.y + 1 < n.y) visit(values(p.x, p.y + 1, p.z));
    if (p.z + 1 < n.z) visit(values(p.x, p.y, p.z + 1));
  });
  if (std::find(marks.values().begin(), marks.values().end(), 1) == marks.values().end()) {
    return {};
  }
  // Contouring looks no farther than two samples from a crossing.
  marks = dilated(std::move(marks), kReach);
  progress.report(kRepairing, 0.1);
  crossings = dilated(std::move(crossings), kReach);
  parallelForEachCell(n, [&](const Vec3i& p) { marks[p] &= crossings[p]; });
  return marks;
}

DistanceField redistanceJumpsInBox(const DistanceField& field, const Progress& progress) {
  constexpr double kFar = 4;  // voxels up to which distances are measured
  progress.report(kRepairing, 0);
  const Array3D<std::uint8_t> marks = samplesAtJumps(field, progress);
  if (marks.empty()) return field;
  const Vec3i n = field.size();
  const Array3D<std::uint8_t> around = dilated(marks, static_cast<int>(kFar) + 1);
  progress.report(kRepairing, 0.2);
  // Layer by layer: the triangles of a jumping field are many, and looking them up takes memory.
  constexpr int kLayers = 24;
  const std::vector<Corners> zeroTriangles = zeroSet(field.values, &around, progress);
  const Progress measuring = progress.part(0.3, 1);
  LoopProgress rows(measuring, kRepairing, static_cast<std::size_t>(n.z) * n.y);
  DistanceField result = field;
  for (int low = 0; low < n.z; low += kLayers) {
    const int high = std::min(n.z, low + kLayers);
    TriangleMesh surface;
    for (const Corners& corners : zeroTriangles) {
      Vec3i cell;
      for (int a = 0; a < 3; ++a) cell[a] = static_cast<int>(std::floor(corners[0][a]));
      cell = around.clamped(cell);
      if (!around[cell] || cell.z < low - kFar - 2 || cell.z > high + kFar + 2) continue;
      const auto first = static_cast<std::uint32_t>(surface.positions.size());
      surface.positions.insert(surface.positions.end(), corners.begin(), corners.end());
      surface.triangles.push_back({first, first + 1, first + 2});
    }
    const ExampleSurface zero(surface, measuring);
    const auto measureRow = [&](int j, int k) {
      for (int i = 0; i < n.x; ++i) {
        if (!marks(i, j, k)) continue;
        const auto nearest = zero.closest({double(i), double(j), double(k)}, {.radius = kFar});
        const double distance = nearest ? nearest->distance : kFar;
        result.values(i, j, k) = signedAs(field.values(i, j, k), distance * field.voxelSize);
      }
    };
    const auto ny = static_cast<std::size_t>(n.y);
    parallelFor(low * ny, high * ny, 4, [&](std::size_t row0, std::size_t row1) {
      for (std::size_t row = row0; row < row1; ++row) {
        measureRow(static_cast<int>(row % ny), static_cast<int>(row / ny));
        rows.advance();
      }
    });
  }
  return result;
}

}  // namespace

DistanceField redistanceJumps(const DistanceField& field, const Axes& wraps,
                              const Progress& progress) {
  constexpr int kMargin = 10;  // a sample's distance depends on what lies this near
  if (!wraps.any()) {
    DistanceField result = redistanceJumpsInBox(field, progress);
    progress.report(kRepairing, 1);
    return result;
  }
  // With a margin that shows what lies at the other side.
  const Vec3i n = field.size();
  Vec3i margin{};
  for (int a = 0; a < 3; ++a) margin[a] = wraps[a] ? kMargin : 0;
  DistanceField around = field;
  around.values = Array3D<float>(n + margin * 2);
  parallelForEachCell(around.size(), [&](const Vec3i& cell) {
    Vec3i p = cell - margin;
    for (int a = 0; a < 3; ++a) p[a] = ((p[a] % n[a]) + n[a]) % n[a];
    around.values[cell] = field.values[p];
  });
  around = redistanceJumpsInBox(around, progress);
  DistanceField result = field;
  parallelForEachCell(n, [&](const Vec3i& p) { result.values[p] = around.values[p + margin]; });
  progress.report(kRepairing, 1);
  return result;
}

}  // namespace exemplar
