// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/dual_contour.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/parallel.h"
#include "reconstruct/adjacency.h"
#include "sdf/openvdb_ready.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 4096;

/// Polygons with three or four corners (the fourth is kNone for three), anticlockwise.
struct Polygons {
  std::vector<Vec3d> points;  // index space
  std::vector<std::array<std::uint32_t, 4>> corners;
};

Polygons contour(const ContourField& field) {
  openvdbReady();
  const Vec3i n = field.size();
  auto grid = openvdb::FloatGrid::create(ContourField::kSaturation);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  const openvdb::CoordBBox box(openvdb::Coord(-1), openvdb::Coord(n.x, n.y, n.z));
  // The view is only read, but OpenVDB has none of constant samples.
  const openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(
      box, const_cast<float*>(field.padded().data()));
  openvdb::tools::copyFromDense(dense, *grid, 0.0f);

  openvdb::tools::VolumeToMesh mesher(0.0);
  mesher(*grid);

  Polygons polygons;
  polygons.points.resize(mesher.pointListSize());
  for (std::size_t v = 0; v < polygons.points.size(); ++v) {
    const openvdb::Vec3s& p = mesher.pointList()[v];
    polygons.points[v] = {p.x(), p.y(), p.z()};
  }
  // OpenVDB winds clockwise seen from outside.
  for (std::size_t pool = 0; pool < mesher.polygonPoolListSize(); ++pool) {
    const openvdb::tools::PolygonPool& list = mesher.polygonPoolList()[pool];
    for (std::size_t q = 0; q < list.numQuads(); ++q) {
      const openvdb::Vec4I& c = list.quad(q);
      polygons.corners.push_back({c[3], c[2], c[1], c[0]});
    }
    for (std::size_t t = 0; t < list.numTriangles(); ++t) {
      const openvdb::Vec3I& c = list.triangle(t);
      polygons.corners.push_back({c[2], c[1], c[0], kNone});
    }
  }
  return polygons;
}

Vec3i cellOf(const Vec3d& p) {
  return {static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)),
          static_cast<int>(std::floor(p.z))};
}

/// How many of the contour's points each cell holds, for cells from -1 on.
Array3D<std::uint8_t> pointsInCells(const ContourField& field, const Polygons& polygons) {
  Array3D<std::uint8_t> count(field.size() + Vec3i{1, 1, 1});
  for (const Vec3d& p : polygons.points) {
    const Vec3i c = cellOf(p) + Vec3i{1, 1, 1};
    if (count.contains(c)) ++count[c];
  }
  return count;
}

/// Puts the vertices of cells in the box's faces onto the faces. Where the surface meets the face
/// the vertex goes to where the outer samples, carried on unchanged to the face, cross zero;
/// OpenVDB's point is the average with the crossings of the cut and would bevel the rim.
void snapToBox(const ContourField& field, const Array3D<std::uint8_t>& inCell,
               const Progress& progress, Polygons& polygons) {
  parallelFor(0, polygons.points.size(), kGrain, [&](std::size_t v0, std::size_t v1) {
    progress.check();
    for (std::size_t v = v0; v < v1; ++v) {
      Vec3d& p = polygons.points[v];
      const Vec3i cell = cellOf(p);
      Vec3i side;
      for (int a = 0; a < 3; ++a) side[a] = field.face(cell[a], a);
      if (side == Vec3i{0, 0, 0}) continue;
      const Vec3i slot = cell + Vec3i{1, 1, 1};
      if (inCell.contains(slot) && inCell[slot] == 1) {
        Vec3d sum{};
        int crossings = 0;
        Vec3d center = cast<double>(cell) + Vec3d{0.5, 0.5, 0.5};
        for (int along = 0; along < 3; ++along) {
          if (side[along] != 0) continue;
          const int b = (along + 1) % 3, c = (along + 2) % 3;
          for (int corner = 0; corner < 4; ++corner) {
            if ((side[b] != 0 && (corner & 1)) || (side[c] != 0 && (corner & 2))) continue;
            Vec3i low = cell;
            low[b] = side[b] < 0 ? 0 : side[b] > 0 ? cell[b] : cell[b] + (corner & 1);
            low[c] = side[c] < 0 ? 0 : side[c] > 0 ? cell[c] : cell[c] + (corner >> 1);
            Vec3i high = low;
            ++high[along];
            const double from = field.atFace(low, side), to = field.atFace(high, side);
            if ((from < 0) == (to < 0)) continue;
            Vec3d crossing = cast<double>(low);
            crossing[along] += from / (from - to);
            sum += crossing;
            ++crossings;
          }
        }
        p = crossings > 0 ? sum / crossings : center;
      }
      for (int a = 0; a < 3; ++a) {
        if (side[a] != 0) p[a] = field.facePlane(side[a], a);
      }
    }
  });
}

/// Newton steps onto the field's zero, inside the vertex's own cell so that no quad turns over.
void project(const ContourField& field, const Array3D<std::uint8_t>& inCell,
             const Progress& progress, Polygons& polygons) {
  constexpr double kMargin = 0.005, kLongest = 0.8;
  parallelFor(0, polygons.points.size(), kGrain, [&](std::size_t v0, std::size_t v1) {
    progress.check();
    for (std::size_t v = v0; v < v1; ++v) {
      Vec3d& p = polygons.points[v];
      const Vec3i cell = cellOf(p), slot = cell + Vec3i{1, 1, 1};
      if (!inCell.contains(slot) || inCell[slot] != 1) continue;
      Vec3i side;
      for (int a = 0; a < 3; ++a) side[a] = field.face(cell[a], a);
      const Vec3d start = p;
      for (int step = 0; step < 2; ++step) {
        Vec3d gradient;
        const double value = field.smoothValue(p, &gradient);
        for (int a = 0; a < 3; ++a) {
          if (side[a] != 0) gradient[a] = 0;
        }
        const double slope2 = dot(gradient, gradient);
        if (slope2 < 0.05) break;
        Vec3d move = p - gradient * (value / slope2) - start;
        const double far = length(move);
        if (far > kLongest) {
          // Far from linear: a seam, or the inside of a cut face.
          p = start;
          break;
        }
        p = start + move;
        for (int a = 0; a < 3; ++a) {
          if (side[a] == 0) p[a] = std::clamp(p[a], cell[a] + kMargin, cell[a] + 1 - kMargin);
        }
      }
    }
  });
}

/// Cuts quads along the diagonal whose middle is nearer to the surface; where both are equally
/// near, along the shorter one. Never so that a triangle has no area, if the other way has.
TriangleMesh triangulate(const ContourField& field, const Progress& progress,
                         const Polygons& polygons) {
  TriangleMesh mesh;
  mesh.positions = polygons.points;
  std::vector<std::uint8_t> second(polygons.corners.size());
  parallelFor(0, polygons.corners.size(), kGrain, [&](std::size_t q0, std::size_t q1) {
    progress.check();
    for (std::size_t q = q0; q < q1; ++q) {
      const auto& c = polygons.corners[q];
      if (c[3] == kNone) continue;
      std::array<Vec3d, 4> p;
      for (int n = 0; n < 4; ++n) p[n] = polygons.points[c[n]];
      const auto thinnest = [&](int a, int b, int d, int e) {
        return std::min(length(cross(p[b] - p[a], p[d] - p[a])),
                        length(cross(p[d] - p[a], p[e] - p[a])));
      };
      const double area0 = thinnest(0, 1, 2, 3), area1 = thinnest(1, 2, 3, 0);
      if (std::min(area0, area1) < 1e-4 * std::max(area0, area1)) {
        second[q] = area1 > area0;
        continue;
      }
      const double off0 = std::abs(field.value((p[0] + p[2]) * 0.5));
      const double off1 = std::abs(field.value((p[1] + p[3]) * 0.5));
      if (std::abs(off0 - off1) > 0.01) {
        second[q] = off1 < off0;
      } else {
        second[q] = length(p[3] - p[1]) < length(p[2] - p[0]) - 1e-6;
      }
    }
  });
  mesh.triangles.reserve(2 * polygons.corners.size());
  for (std::size_t q = 0; q < polygons.corners.size(); ++q) {
    const auto& c = polygons.corners[q];
    const int s = second[q];
    if (c[3] == kNone) {
      mesh.triangles.push_back({c[0], c[1], c[2]});
    } else {
      mesh.triangles.push_back({c[s], c[s + 1], c[s + 2]});
      mesh.triangles.push_back({c[s], c[s + 2], c[(s + 3) % 4]});
    }
  }
  return mesh;
}

/// Without closing, the surface went on through the added layer; what lies beyond the box's faces
/// goes, and what lies in the lower one of two faces that are the same.
void cutOpen(const ContourField& field, Polygons& polygons) {
  std::erase_if(polygons.corners, [&](const std::array<std::uint32_t, 4>& corners) {
    Axes inLower = field.wraps();
    for (const std::uint32_t v : corners) {
      if (v == kNone) continue;
      const Vec3i cell = cellOf(polygons.points[v]);
      for (int a = 0; a < 3; ++a) {
        if (cell[a] < -1 || cell[a] > field.size()[a] - 1) return true;
        inLower[a] = inLower[a] && cell[a] == -1;
      }
    }
    return inLower.any();
  });
}

}  // namespace

TriangleMesh dualContour(const ContourField& field, bool onZero, const Progress& progress) {
  progress.report("contouring", 0);
  Polygons polygons = contour(field);
  if (!field.close() || field.wraps().any()) cutOpen(field, polygons);
  progress.report("contouring", 0.5);
  const Array3D<std::uint8_t> inCell = pointsInCells(field, polygons);
  snapToBox(field, inCell, progress, polygons);
  progress.report("contouring", 0.6);
  if (onZero) project(field, inCell, progress, polygons);
  progress.report("contouring", 0.8);
  TriangleMesh mesh = triangulate(field, progress, polygons);
  progress.report("contouring", 1);
  return mesh;
}

}  // namespace exemplar
