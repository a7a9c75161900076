// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Model pieces put back in place, and what they leave open closed: points joined, edges divided.

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/error.h"
#include "core/file.h"
#include "core/memory.h"
#include "mesh/mesh_formats.h"
#include "voxelize/model_pieces.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

/// Points by the box of a regular grid that they are in, positions in units of its side.
class PointIndex {
 public:
  void add(const Vec3d& p, std::uint32_t point) { boxes_[keyOf(floored(p))].push_back(point); }

  /// Calls `visit` with the points in the boxes that [low, high] touches.
  template <class Visit>
  void visit(const Vec3d& low, const Vec3d& high, const Visit& visit) const {
    const Box a = floored(low), b = floored(high);
    for (std::int64_t k = a[2]; k <= b[2]; ++k) {
      for (std::int64_t j = a[1]; j <= b[1]; ++j) {
        for (std::int64_t i = a[0]; i <= b[0]; ++i) {
          const auto found = boxes_.find(keyOf({i, j, k}));
          if (found == boxes_.end()) continue;
          for (const std::uint32_t point : found->second) visit(point);
        }
      }
    }
  }

 private:
  using Box = std::array<std::int64_t, 3>;
  static Box floored(const Vec3d& p) {
    return {static_cast<std::int64_t>(std::floor(p.x)), static_cast<std::int64_t>(std::floor(p.y)),
            static_cast<std::int64_t>(std::floor(p.z))};
  }
  /// Boxes whose keys agree by chance only make `visit` see more.
  static std::uint64_t keyOf(const Box& b) {
    std::uint64_t key = 0;
    for (const std::int64_t i : b) {
      key = (key ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15u;
      key ^= key >> 29;
    }
    return key;
  }
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> boxes_;
};

/// Refuses a grid with labels that are no pieces, or without triangles; returns their number.
double countTriangles(const LabelGrid& grid, const ModelPieces& pieces) {
  double triangles = 0;
  const std::size_t labels = pieces.first.size() - 1;
  for (const Label label : grid.cells.values()) {
    if (label >= labels) {
      throw InputError("the grid has label " + std::to_string(label) + ", and there are " +
                       std::to_string(labels) + " pieces");
    }
    triangles += pieces.first[label + 1] - pieces.first[label];
  }
  if (triangles == 0) throw InputError("the result has no geometry: all of its cells are empty");
  return triangles;
}

class Assembler {
 public:
  Assembler(const LabelGrid& grid, const ModelPieces& pieces, const Progress& progress)
      : grid_(grid), pieces_(pieces), progress_(progress), joined_(2.5 * pieces.tolerance) {}

  TriangleMesh assemble(std::vector<std::uint32_t>* cellOf) {
    requireMemory(200 * countTriangles(grid_, pieces_), "the mesh of the result",
                  "use a smaller `size`");
    copy();
    divideEdges();
    if (cellOf) *cellOf = std::move(cells_);
    return std::move(mesh_);
  }

 private:
  static constexpr std::size_t kAtOnce = 1024;  // cells or triangles between reports

  void reportShare(double from, double to, std::size_t done, std::size_t all) const {
    progress_.report("putting pieces together",
                     from + (to - from) * static_cast<double>(done) / static_cast<double>(all));
  }

  /// The pieces' triangles; points on the sides of cells become one with those already there.
  void copy() {
    const TriangleMesh& stock = pieces_.mesh;
    mesh_.materials = stock.materials;
    mesh_.textures = stock.textures;
    const double box = 4 * joined_;
    PointIndex rims;
    std::vector<std::uint32_t> vertexOf(stock.positions.size());
    const std::size_t cells = grid_.cells.count();
    for (std::size_t c = 0; c < cells; ++c) {
      if (c % kAtOnce == 0) reportShare(0, 0.4, c, cells);
      const Label label = grid_.cells.values()[c];
      const Vec3d corner = cast<double>(grid_.cells.ijk(c));
      const std::uint32_t begin = pieces_.first[label], end = pieces_.first[label + 1];
      for (std::uint32_t t = begin; t < end; ++t) {
        for (const std::uint32_t v : stock.triangles[t]) vertexOf[v] = kNone;
      }
      for (std::uint32_t t = begin; t < end; ++t) {
        std::array<std::uint32_t, 3> triangle;
        for (int k = 0; k < 3; ++k) {
          const std::uint32_t v = stock.triangles[t][k];
          if (vertexOf[v] == kNone) vertexOf[v] = addPoint(v, corner, rims, box);
          triangle[k] = vertexOf[v];
        }
        if (triangle[0] == triangle[1] || triangle[1] == triangle[2] ||
            triangle[2] == triangle[0]) {
          continue;
        }
        mesh_.triangles.push_back(triangle);
        if (stock.hasMaterials()) {
          mesh_.triangleMaterials.push_back(stock.triangleMaterials[t]);
        }
        if (stock.hasUvs()) mesh_.uvs.push_back(stock.uvs[t]);
        cells_.push_back(static_cast<std::uint32_t>(c));
      }
    }
  }

  std::uint32_t addPoint(std::uint32_t v, const Vec3d& corner, PointIndex& rims, double box) {
    Vec3d local = pieces_.mesh.positions[v];
    bool onRim = false;
    for (int axis = 0; axis < 3; ++axis) {
      local[axis] /= grid_.cellSize[axis];
      onRim = onRim || local[axis] <= joined_ || local[axis] >= 1 - joined_;
    }
    const Vec3d p = corner + local;
    if (onRim) {
      std::uint32_t nearest = kNone;
      double least = joined_;
      const Vec3d reach{joined_, joined_, joined_};
      rims.visit((p - reach) / box, (p + reach) / box, [&](std::uint32_t candidate) {
        const double d = length(inCells_[candidate] - p);
        if (d < least || (d == least && candidate < nearest)) {
          least = d;
          nearest = candidate;
        }
      });
      if (nearest != kNone) return nearest;
    }
    const auto point = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.push_back(grid_.origin + scaled(p, grid_.cellSize));
    inCells_.push_back(p);
    if (pieces_.mesh.hasColors()) mesh_.colors.push_back(pieces_.mesh.colors[v]);
    if (onRim) rims.add(p / box, point);
    return point;
  }

  static std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::uint64_t>(a) << 32 | b;
  }

  /// Divides edges that no triangle runs through the other way where points of such edges lie on
  /// them.
  void divideEdges() {
    std::unordered_map<std::uint64_t, int> runs;
    runs.reserve(3 * mesh_.triangles.size());
    const std::size_t count = mesh_.triangles.size();
    for (std::size_t n = 0; n < count; ++n) {
      if (n % kAtOnce == 0) reportShare(0.4, 0.7, n, count);
      const auto& t = mesh_.triangles[n];
      for (int k = 0; k < 3; ++k) ++runs[edgeKey(t[k], t[(k + 1) % 3])];
    }
    const auto isOpen = [&](std::uint32_t a, std::uint32_t b) {
      const auto back = runs.find(edgeKey(b, a));
      return back == runs.end() || back->second != runs.at(edgeKey(a, b));
    };
    constexpr double kBox = 0.125;
    PointIndex ends;
    std::vector<bool> known(mesh_.positions.size(), false);
    std::vector<std::uint32_t> divided;  // triangles with open edges
    for (std::size_t t = 0; t < count; ++t) {
      if (t % kAtOnce == 0) reportShare(0.7, 0.9, t, count);
      const auto& triangle = mesh_.triangles[t];
      bool any = false;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
        if (!isOpen(a, b)) continue;
        any = true;
        for (const std::uint32_t v : {a, b}) {
          if (!known[v]) ends.add(inCells_[v] / kBox, v);
          known[v] = true;
        }
      }
      if (any) divided.push_back(static_cast<std::uint32_t>(t));
    }
    for (std::size_t n = 0; n < divided.size(); ++n) {
      if (n % kAtOnce == 0) reportShare(0.9, 1, n, divided.size());
      const std::uint32_t t = divided[n];
      std::array<std::vector<std::pair<double, std::uint32_t>>, 3> points;
      bool any = false;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh_.triangles[t][k], b = mesh_.triangles[t][(k + 1) % 3];
        if (!isOpen(a, b)) continue;
        const Vec3d p = inCells_[a], q = inCells_[b], along = q - p;
        const double squared = dot(along, along);
        const Vec3d reach{joined_, joined_, joined_};
        ends.visit((min(p, q) - reach) / kBox, (max(p, q) + reach) / kBox, [&](std::uint32_t v) {
          if (v == a || v == b) return;
          const double s = dot(inCells_[v] - p, along) / squared;
          if (!(s > 0 && s < 1)) return;
          if (length(inCells_[v] - (p + along * s)) > joined_) return;
          points[k].emplace_back(s, v);
        });
        std::sort(points[k].begin(), points[k].end());
        points[k].erase(std::unique(points[k].begin(), points[k].end()), points[k].end());
        any = any || !points[k].empty();
      }
      if (any) divide(t, points);
    }
  }

  /// One triangle as a fan from the corner across its first side with points on it; the fan's outer
  /// triangles keep the points of the other two sides and are divided in turn.
  void divide(std::uint32_t t,
              const std::array<std::vector<std::pair<double, std::uint32_t>>, 3>& points) {
    const auto corners = mesh_.triangles[t];
    std::array<Vec2f, 3> uvs{};
    if (mesh_.hasUvs()) uvs = mesh_.uvs[t];
    int k = 0;
    while (points[k].empty()) ++k;
    const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    std::vector<std::uint32_t> chain{corners[k]};
    std::vector<Vec2f> chainUvs{uvs[k]};
    for (const auto& [s, v] : points[k]) {
      chain.push_back(v);
      const auto w = static_cast<float>(s);
      chainUvs.push_back(
          {uvs[k].x + (uvs[k1].x - uvs[k].x) * w, uvs[k].y + (uvs[k1].y - uvs[k].y) * w});
    }
    chain.push_back(corners[k1]);
    chainUvs.push_back(uvs[k1]);
    for (std::size_t n = 0; n + 1 < chain.size(); ++n) {
      std::uint32_t part = t;
      if (n > 0) {
        part = static_cast<std::uint32_t>(mesh_.triangles.size());
        mesh_.triangles.emplace_back();
        if (mesh_.hasMaterials()) mesh_.triangleMaterials.push_back(mesh_.triangleMaterials[t]);
        if (mesh_.hasUvs()) mesh_.uvs.emplace_back();
        cells_.push_back(cells_[t]);
      }
      mesh_.triangles[part] = {chain[n], chain[n + 1], corners[k2]};
      if (mesh_.hasUvs()) mesh_.uvs[part] = {chainUvs[n], chainUvs[n + 1], uvs[k2]};
      std::array<std::vector<std::pair<double, std::uint32_t>>, 3> left;
      if (n + 2 == chain.size()) left[1] = points[k1];
      if (n == 0) left[2] = points[k2];
      if (!left[1].empty() || !left[2].empty()) divide(part, left);
    }
  }

  const LabelGrid& grid_;
  const ModelPieces& pieces_;
  const Progress& progress_;
  double joined_;  // points nearer than this are one, in cells
  TriangleMesh mesh_;
  std::vector<Vec3d> inCells_;  // of each vertex
  std::vector<std::uint32_t> cells_;
};

}  // namespace

std::size_t writePieceInstances(const std::filesystem::path& path, const LabelGrid& grid,
                                const ModelPieces& pieces, const Progress& progress) {
  countTriangles(grid, pieces);
  MeshInstances instances;
  instances.first = pieces.first;
  for (std::size_t c = 0; c < grid.cells.count(); ++c) {
    if (c % 65536 == 0) {
      progress.report("placing pieces",
                      0.5 * static_cast<double>(c) / static_cast<double>(grid.cells.count()));
    }
    const Label label = grid.cells.values()[c];
    if (pieces.first[label] == pieces.first[label + 1]) continue;
    const Vec3d corner = grid.origin + scaled(cast<double>(grid.cells.ijk(c)), grid.cellSize);
    instances.placements.push_back({label, corner});
  }
  progress.report("writing pieces", 0.5);
  writeFile(path, formatGlb(pieces.mesh, instances, /*yUp=*/true));
  return instances.placements.size();
}

TriangleMesh assemblePieces(const LabelGrid& grid, const ModelPieces& pieces,
                            std::vector<std::uint32_t>* cellOf, const Progress& progress) {
  return Assembler(grid, pieces, progress).assemble(cellOf);
}

}  // namespace exemplar
