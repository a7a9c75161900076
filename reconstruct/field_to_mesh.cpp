// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/field_to_mesh.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "reconstruct/adjacency.h"
#include "reconstruct/dilate.h"
#include "reconstruct/example_surface.h"
#include "sdf/openvdb_ready.h"
#include "sdf/redistance.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 4096;

/// Samples are kept this far from zero, as a share of a typical difference of neighbours: a
/// crossing never falls on a sample, so the corners of a quad lie inside four different cells.
constexpr float kAwayFromZero = 0.005f;
/// Beyond this many typical differences a sample says no more than its sign.
constexpr float kSaturation = 8;

/// The field as it is contoured: in units in which neighbours differ by about 1 where the surface
/// runs through, one layer of samples added on each side, index space for positions.
class ContourField {
 public:
  ContourField(const DistanceField& field, const FieldToMeshOptions& options);

  /// The size without the added layers.
  const Vec3i& size() const { return size_; }
  bool close() const { return close_; }
  bool wraps(int axis) const { return wraps_[axis]; }
  bool wraps() const { return wraps_[0] || wraps_[1] || wraps_[2]; }
  const Array3D<float>& padded() const { return padded_; }
  Array3D<float>& padded() { return padded_; }

  float at(int i, int j, int k) const { return padded_(i + 1, j + 1, k + 1); }

  /// What the box's faces on the sides `side` (as of `face`) of outer sample `p` have: the sample's
  /// value carried on; half way between the first and the last sample where the field wraps.
  double atFace(const Vec3i& p, const Vec3i& side) const {
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      Vec3i q = p;
      for (int a = 0; a < 3; ++a) {
        if (side[a] != 0 && wraps_[a]) q[a] = (corner >> a & 1) ? 0 : size_[a] - 1;
      }
      sum += at(q.x, q.y, q.z);
    }
    return sum / 8;
  }

  /// Whether the cell from sample `cell` to its upper neighbour lies in the box's face of `axis`:
  /// -1 the lower one, 1 the upper one, 0 inside.
  int face(int cell, int axis) const { return cell < 0 ? -1 : cell >= size_[axis] - 1 ? 1 : 0; }
  /// Where the face lies.
  double facePlane(int side, int axis) const { return side < 0 ? -0.5 : size_[axis] - 0.5; }

  /// Between samples: tricubic, constant beyond the outer samples; cut by the box where it closes.
  double value(const Vec3d& p) const;
  /// The same without the cut, and its gradient.
  double smoothValue(const Vec3d& p, Vec3d* gradient) const;

 private:
  Vec3i size_;
  bool close_;
  std::array<bool, 3> wraps_;
  Array3D<float> padded_;
};

/// How much neighbouring samples differ where the sign changes between them, on average: one
/// voxel's length or less for a distance, anything for other scalars. 0 where there is no surface.
double typicalDifference(const DistanceField& field) {
  struct Sum {
    double total = 0;
    std::int64_t count = 0;
    Sum& operator+=(const Sum& other) {
      total += other.total;
      count += other.count;
      return *this;
    }
  };
  const Vec3i n = field.size();
  const auto& values = field.values;
  const Sum sum = parallelSum<Sum>(0, n.z, 1, [&](std::size_t k0, std::size_t k1) {
    Sum part;
    const auto visit = [&](float a, float b) {
      if ((a < 0) == (b < 0)) return;
      part.total += std::abs(double{a} - b);
      ++part.count;
    };
    for (int k = static_cast<int>(k0); k < static_cast<int>(k1); ++k) {
      for (int j = 0; j < n.y; ++j) {
        for (int i = 0; i < n.x; ++i) {
          const float a = values(i, j, k);
          if (i + 1 < n.x) visit(a, values(i + 1, j, k));
          if (j + 1 < n.y) visit(a, values(i, j + 1, k));
          if (k + 1 < n.z) visit(a, values(i, j, k + 1));
        }
      }
    }
    return part;
  });
  return sum.count == 0 ? 0 : sum.total / static_cast<double>(sum.count);
}

ContourField::ContourField(const DistanceField& field, const FieldToMeshOptions& options)
    : size_(field.size()),
      close_(options.close),
      wraps_(options.wraps),
      padded_(field.size() + Vec3i{2, 2, 2}) {
  const double difference = typicalDifference(field);
  const auto scale =
      static_cast<float>(1 / (difference > 0 ? std::min(difference, field.voxelSize) : 1.0));
  const auto tamed = [&](float v) {
    const float s = std::clamp(v * scale, -kSaturation, kSaturation);
    return v < 0 ? std::min(s, -kAwayFromZero) : std::max(s, kAwayFromZero);
  };
  parallelFor(0, padded_.size().z, 1, [&](std::size_t k0, std::size_t k1) {
    for (int k = static_cast<int>(k0); k < static_cast<int>(k1); ++k) {
      for (int j = 0; j < padded_.size().y; ++j) {
        for (int i = 0; i < padded_.size().x; ++i) {
          Vec3i at{i - 1, j - 1, k - 1};
          for (int a = 0; a < 3; ++a) {
            if (wraps_[a]) at[a] = (at[a] + size_[a]) % size_[a];
          }
          const Vec3i inside = field.values.clamped(at);
          const float v = tamed(field.values[inside]);
          padded_(i, j, k) = inside != at && close_ ? std::abs(v) : v;
        }
      }
    }
  });
}

/// The weights of four samples for a place `t` (0..1) between the middle two, and their
/// derivatives: Catmull and Rom's cubic, which unlike a linear blend follows the curvature of a
/// distance.
void cubicWeights(double t, std::array<double, 4>& weight, std::array<double, 4>& slope) {
  const double t2 = t * t, t3 = t2 * t;
  weight = {(-t3 + 2 * t2 - t) / 2, (3 * t3 - 5 * t2 + 2) / 2, (-3 * t3 + 4 * t2 + t) / 2,
            (t3 - t2) / 2};
  slope = {(-3 * t2 + 4 * t - 1) / 2, (9 * t2 - 10 * t) / 2, (-9 * t2 + 8 * t + 1) / 2,
           (3 * t2 - 2 * t) / 2};
}

double ContourField::smoothValue(const Vec3d& p, Vec3d* gradient) const {
  std::array<std::array<int, 4>, 3> at;
  std::array<std::array<double, 4>, 3> weight, slope;
  for (int a = 0; a < 3; ++a) {
    const int n = size_[a];
    const double x = wraps_[a] ? p[a] : std::clamp(p[a], 0.0, n - 1.0);
    const int base = wraps_[a] ? static_cast<int>(std::floor(x))
                               : std::clamp(static_cast<int>(x), 0, std::max(0, n - 2));
    for (int m = 0; m < 4; ++m) {
      const int i = base - 1 + m;
      at[a][m] = (wraps_[a] ? ((i % n) + n) % n : std::clamp(i, 0, n - 1)) + 1;
    }
    cubicWeights(x - base, weight[a], slope[a]);
  }
  double sum = 0;
  Vec3d slopes{};
  for (int k = 0; k < 4; ++k) {
    double plane = 0, planeX = 0, planeY = 0;
    for (int j = 0; j < 4; ++j) {
      double row = 0, rowX = 0;
      for (int i = 0; i < 4; ++i) {
        const double v = padded_(at[0][i], at[1][j], at[2][k]);
        row += weight[0][i] * v;
        rowX += slope[0][i] * v;
      }
      plane += weight[1][j] * row;
      planeX += weight[1][j] * rowX;
      planeY += slope[1][j] * row;
    }
    sum += weight[2][k] * plane;
    slopes.x += weight[2][k] * planeX;
    slopes.y += weight[2][k] * planeY;
    slopes.z += slope[2][k] * plane;
  }
  if (gradient) *gradient = slopes;
  return sum;
}

double ContourField::value(const Vec3d& p) const {
  double v = smoothValue(p, nullptr);
  if (close_) {
    for (int a = 0; a < 3; ++a) {
      if (!wraps_[a]) v = std::max({v, -0.5 - p[a], p[a] - (size_[a] - 0.5)});
    }
  }
  return v;
}

/// Polygons with three or four corners (the fourth is kNone for three), anticlockwise.
struct Polygons {
  std::vector<Vec3d> points;  // index space
  std::vector<std::array<std::uint32_t, 4>> corners;
};

Polygons contour(ContourField& field, double adaptivity) {
  openvdbReady();
  const Vec3i n = field.size();
  auto grid = openvdb::FloatGrid::create(kSaturation);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  const openvdb::CoordBBox box(openvdb::Coord(-1), openvdb::Coord(n.x, n.y, n.z));
  const openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, field.padded().data());
  openvdb::tools::copyFromDense(dense, *grid, 0.0f);

  openvdb::tools::VolumeToMesh mesher(0.0, adaptivity);
  if (adaptivity > 0) {
    // Cells in the box's faces stay single: their vertices are put onto the face afterwards.
    auto mask = std::make_shared<openvdb::BoolTree>(false);
    for (int a = 0; a < 3; ++a) {
      for (const int layer : {-1, n[a] - 1}) {
        openvdb::CoordBBox slab = box;
        slab.min()[a] = slab.max()[a] = layer;
        mask->fill(slab, true, true);
      }
    }
    mesher.setAdaptivityMask(mask);
  }
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
void snapToBox(const ContourField& field, const Array3D<std::uint8_t>& inCell, Polygons& polygons) {
  parallelFor(0, polygons.points.size(), kGrain, [&](std::size_t v0, std::size_t v1) {
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
void project(const ContourField& field, const Array3D<std::uint8_t>& inCell, Polygons& polygons) {
  constexpr double kMargin = 0.005, kLongest = 0.8;
  parallelFor(0, polygons.points.size(), kGrain, [&](std::size_t v0, std::size_t v1) {
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
TriangleMesh triangulate(const ContourField& field, const Polygons& polygons) {
  TriangleMesh mesh;
  mesh.positions = polygons.points;
  std::vector<std::uint8_t> second(polygons.corners.size());
  parallelFor(0, polygons.corners.size(), kGrain, [&](std::size_t q0, std::size_t q1) {
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
    std::array<bool, 3> inLower{field.wraps(0), field.wraps(1), field.wraps(2)};
    for (const std::uint32_t v : corners) {
      if (v == kNone) continue;
      const Vec3i cell = cellOf(polygons.points[v]);
      for (int a = 0; a < 3; ++a) {
        if (cell[a] < -1 || cell[a] > field.size()[a] - 1) return true;
        inLower[a] = inLower[a] && cell[a] == -1;
      }
    }
    return inLower[0] || inLower[1] || inLower[2];
  });
}

/// Vertices that were moved a little off the box's faces go back.
void returnToBox(const ContourField& field, TriangleMesh& mesh) {
  for (Vec3d& p : mesh.positions) {
    for (int a = 0; a < 3; ++a) {
      for (const int side : {-1, 1}) {
        const double plane = field.facePlane(side, a);
        if (side * (p[a] - plane) > -0.3) p[a] = plane;
      }
    }
  }
}

/// Drops the closed parts that enclose less than `smallest` voxels and do not touch the box.
std::int64_t dropSpecks(const ContourField& field, double smallest, TriangleMesh& mesh) {
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> part =
      vertexComponents(mesh.triangles, mesh.positions.size(), &count);
  std::vector<double> volumes(count, 0);
  std::vector<std::uint8_t> touches(count, 0);
  std::vector<Vec3d> anchor(count);
  std::vector<std::uint8_t> anchored(count, 0);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3d& p = mesh.positions[v];
    for (int a = 0; a < 3; ++a) {
      if (p[a] <= -0.5 || p[a] >= field.size()[a] - 0.5) touches[part[v]] = 1;
    }
    if (!anchored[part[v]]) {
      anchored[part[v]] = 1;
      anchor[part[v]] = p;
    }
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t p = part[a];
    volumes[p] += dot(mesh.positions[a] - anchor[p],
                      cross(mesh.positions[b] - anchor[p], mesh.positions[c] - anchor[p])) /
                  6;
  }
  std::vector<std::uint8_t> hasTriangles(count, 0), keep(mesh.triangles.size());
  std::int64_t dropped = 0;
  for (std::size_t t = 0; t < keep.size(); ++t) {
    const std::uint32_t p = part[mesh.triangles[t][0]];
    keep[t] = touches[p] || std::abs(volumes[p]) >= smallest;
    if (!keep[t] && !hasTriangles[p]) {
      hasTriangles[p] = 1;
      ++dropped;
    }
  }
  keepTriangles(mesh, keep);
  return dropped;
}

/// The field with its distances made right again around jumps: where neighbouring samples near the
/// surface differ by more than their distance allows. Elsewhere it stays as it is, for a distance
/// measured to the samples' own zero is less exact than one measured to the example.
DistanceField repaired(const DistanceField& field) {
  constexpr double kAllowed = 1.5;  // voxels between neighbours: 1, and some for blended fields
  constexpr double kNear = 2;       // voxels from the surface
  constexpr int kReach = 2;         // samples around a jump that are taken anew
  constexpr int kFar = 4;           // voxels up to which distances are measured
  const Vec3i n = field.size();
  const auto& values = field.values;
  const double allowed = kAllowed * field.voxelSize, near = kNear * field.voxelSize;
  const auto jumps = [&](float a, float b) {
    return std::abs(double{a} - b) > allowed && std::min(std::abs(a), std::abs(b)) < near;
  };
  // At the lower end of each step to the next sample; the reach is wide enough for both ends.
  Array3D<std::uint8_t> marks(n), crossings(n);
  parallelFor(0, n.z, 1, [&](std::size_t k0, std::size_t k1) {
    for (int k = static_cast<int>(k0); k < static_cast<int>(k1); ++k) {
      for (int j = 0; j < n.y; ++j) {
        for (int i = 0; i < n.x; ++i) {
          const float a = values(i, j, k);
          const auto visit = [&](float b) {
            marks(i, j, k) |= jumps(a, b);
            crossings(i, j, k) |= (a < 0) != (b < 0);
          };
          if (i + 1 < n.x) visit(values(i + 1, j, k));
          if (j + 1 < n.y) visit(values(i, j + 1, k));
          if (k + 1 < n.z) visit(values(i, j, k + 1));
        }
      }
    }
  });
  if (std::find(marks.values().begin(), marks.values().end(), 1) == marks.values().end()) {
    return field;
  }

  // Contouring looks no further than two samples from a crossing.
  marks = dilated(std::move(marks), kReach);
  crossings = dilated(std::move(crossings), kReach);
  for (std::size_t s = 0; s < marks.count(); ++s) marks.values()[s] &= crossings.values()[s];
  const Array3D<std::uint8_t> around = dilated(marks, kFar + 1);
  // Layer by layer: the triangles of a jumping field are many, and looking them up takes memory.
  constexpr int kLayers = 24;
  const auto zeroTriangles = zeroSet(values, &around);
  DistanceField result = field;
  for (int low = 0; low < n.z; low += kLayers) {
    const int high = std::min(n.z, low + kLayers);
    TriangleMesh surface;
    for (const Corners& corners : zeroTriangles) {
      const Vec3i cell = around.clamped(cellOf(corners[0]));
      if (!around[cell] || cell.z < low - kFar - 2 || cell.z > high + kFar + 2) continue;
      const auto first = static_cast<std::uint32_t>(surface.positions.size());
      surface.positions.insert(surface.positions.end(), corners.begin(), corners.end());
      surface.triangles.push_back({first, first + 1, first + 2});
    }
    const ExampleSurface zero(surface);
    parallelFor(low, high, 1, [&](std::size_t k0, std::size_t k1) {
      for (int k = static_cast<int>(k0); k < static_cast<int>(k1); ++k) {
        for (int j = 0; j < n.y; ++j) {
          for (int i = 0; i < n.x; ++i) {
            if (!marks(i, j, k)) continue;
            const auto nearest =
                zero.closest({double(i), double(j), double(k)}, {.radius = double{kFar}});
            const auto d =
                static_cast<float>((nearest ? nearest->distance : kFar) * field.voxelSize);
            // The sign stays: -0 would count as outside.
            result.values(i, j, k) =
                values(i, j, k) < 0 ? -std::max(d, std::numeric_limits<float>::min()) : d;
          }
        }
      }
    });
  }
  return result;
}

/// The same for a field that goes round: with a margin that shows what lies at the other side.
DistanceField repairedAround(const DistanceField& field, const std::array<bool, 3>& wraps) {
  constexpr int kMargin = 10;  // a sample's distance depends on what lies this near
  if (!wraps[0] && !wraps[1] && !wraps[2]) return repaired(field);
  const Vec3i n = field.size();
  Vec3i margin{};
  for (int a = 0; a < 3; ++a) margin[a] = wraps[a] ? kMargin : 0;
  DistanceField around = field;
  around.values = Array3D<float>(n + margin * 2);
  for (std::size_t s = 0; s < around.values.count(); ++s) {
    Vec3i p = around.values.ijk(s) - margin;
    for (int a = 0; a < 3; ++a) p[a] = ((p[a] % n[a]) + n[a]) % n[a];
    around.values.values()[s] = field.values[p];
  }
  around = repaired(around);
  DistanceField result = field;
  for (std::size_t s = 0; s < result.values.count(); ++s) {
    result.values.values()[s] = around.values[result.values.ijk(s) + margin];
  }
  return result;
}

void check(const DistanceField& field, const FieldToMeshOptions& options) {
  if (!(options.adaptivity >= 0 && options.adaptivity <= 1)) {
    throw InputError("adaptivity: " + std::to_string(options.adaptivity) +
                     " is out of range; 0 to 1 is right");
  }
  if (!(options.smallestPiece >= 0)) {
    throw InputError("smallest piece: " + std::to_string(options.smallestPiece) +
                     " voxels is out of range; 0 or more is right");
  }
  if (field.values.empty()) throw InputError("the field has no samples and so no surface");
  requireMemory((options.redistance ? 24.0 : 6.0) * static_cast<double>(field.values.count()),
                "contouring the field", "use a lower --resolution or a smaller --scale");
  const auto values = field.values.values();
  const auto bad =
      std::find_if(values.begin(), values.end(), [](float v) { return std::isnan(v); });
  if (bad != values.end()) {
    const Vec3i at = field.values.ijk(static_cast<std::size_t>(bad - values.begin()));
    throw InputError("the field holds no number (NaN) at sample " + std::to_string(at.x) + ", " +
                     std::to_string(at.y) + ", " + std::to_string(at.z) +
                     "; every sample must be a signed distance");
  }
}

[[noreturn]] void throwNoSurface(const DistanceField& field, std::int64_t dropped) {
  if (dropped > 0) {
    throw InputError("the field's surface consists of " + std::to_string(dropped) +
                     " specks below the smallest piece that is kept; lower that limit, or use a "
                     "higher --resolution");
  }
  const bool inside = field.values.values().front() < 0;
  throw InputError(
      std::string("the field has no surface: all of its samples are ") +
      (inside ? "inside" : "outside") +
      "; use a higher --resolution, another --seed, or an example whose box holds both "
      "solid and empty space");
}

TriangleMesh contourToTriangles(ContourField& field, const FieldToMeshOptions& options,
                                double adaptivity, ManifoldReport& report) {
  Polygons polygons = contour(field, adaptivity);
  if (!field.close() || field.wraps()) cutOpen(field, polygons);
  const Array3D<std::uint8_t> inCell = pointsInCells(field, polygons);
  snapToBox(field, inCell, polygons);
  if (options.project) project(field, inCell, polygons);
  TriangleMesh mesh = triangulate(field, polygons);
  report = makeManifold(mesh, {.separation = 0.1});
  returnToBox(field, mesh);
  return mesh;
}

}  // namespace

TriangleMesh fieldToMesh(const DistanceField& field, const FieldToMeshOptions& options,
                         FieldToMeshReport* report) {
  check(field, options);
  FieldToMeshReport done;
  ContourField contourField(options.redistance ? repairedAround(field, options.wraps) : field,
                            options);
  done.uniform = options.adaptivity == 0;
  TriangleMesh mesh = contourToTriangles(contourField, options, options.adaptivity, done.manifold);
  const bool sound = (done.manifold.boundaryEdges == 0 || !options.close || contourField.wraps()) &&
                     done.manifold.degenerateTriangles == 0;
  if (!done.uniform && !sound) {
    done.uniform = true;
    mesh = contourToTriangles(contourField, options, 0, done.manifold);
  }
  done.droppedPieces = dropSpecks(contourField, options.smallestPiece, mesh);
  if (mesh.triangles.empty()) throwNoSurface(field, done.droppedPieces);
  for (Vec3d& p : mesh.positions) p = field.position(p);
  if (report) {
    if (options.checkHealth) done.health = meshHealth(mesh);
    *report = done;
  }
  return mesh;
}

}  // namespace exemplar
