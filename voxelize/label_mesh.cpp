// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/label_mesh.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace exemplar {
namespace {

constexpr std::uint32_t kUnset = 0xffffffff;

/// Faces of one label that fill a rectangle in a plane across `axis`: cells u0 <= u < u1 and
/// v0 <= v < v1 of layer `layer`, where u and v are the axes after `axis` in turn.
struct Rectangle {
  Label label;
  std::int8_t axis;
  bool far;  ///< the faces on the cells' far sides, which look along +axis
  int layer, u0, v0, u1, v1;
};

class Mesher {
 public:
  Mesher(const LabelGrid& grid, const LabelMeshOptions& options, const Progress& progress)
      : grid_(grid), options_(options), progress_(progress) {
    for (const LabelLook& look : grid.labels) empty_.push_back(isEmpty(look));
  }

  TriangleMesh make() {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool far : {false, true}) {
        progress_.report(kStage, (2 * axis + (far ? 1 : 0)) / 12.0);
        findRectangles(axis, far);
      }
    }
    // Every corner of a rectangle is a vertex; rectangles along whose rims it lies take it in.
    for (std::size_t n = 0; n < rectangles_.size(); ++n) {
      if (n % kAtOnce == 0) reportShare(0.5, n);
      const Rectangle& r = rectangles_[n];
      for (const auto& [u, v] : {std::pair{r.u0, r.v0}, std::pair{r.u1, r.v0},
                                 std::pair{r.u1, r.v1}, std::pair{r.u0, r.v1}}) {
        vertices_.try_emplace(keyAt(r, u, v), kUnset);
      }
    }
    for (std::size_t n = 0; n < rectangles_.size(); ++n) {
      if (n % kAtOnce == 0) reportShare(0.75, n);
      addRectangle(rectangles_[n]);
    }
    return std::move(mesh_);
  }

 private:
  static constexpr const char* kStage = "making boxes of cells";
  static constexpr std::size_t kAtOnce = 4096;  // rectangles between reports

  void reportShare(double from, std::size_t rectangle) const {
    progress_.report(kStage, from + 0.25 * static_cast<double>(rectangle) /
                                        static_cast<double>(rectangles_.size()));
  }
  Label at(const Vec3i& cell) const { return grid_.cells[cell]; }

  /// Whether a cell of label `a` shows its face towards `beyond`.
  bool showsFace(Label a, const Vec3i& beyond) const {
    if (empty_[a]) return false;
    if (!grid_.cells.contains(beyond)) return true;
    const Label b = at(beyond);
    return b != a && (options_.closedLabels || empty_[b]);
  }

  void findRectangles(int axis, bool far) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Vec3i size = grid_.size();
    // Label + 1 of each face in a layer, 0: none.
    std::vector<std::uint32_t> faces(static_cast<std::size_t>(size[u]) * size[v]);
    const auto face = [&](int i, int j) -> std::uint32_t& {
      return faces[static_cast<std::size_t>(j) * size[u] + i];
    };
    for (int layer = 0; layer < size[axis]; ++layer) {
      progress_.check();
      for (int j = 0; j < size[v]; ++j) {
        for (int i = 0; i < size[u]; ++i) {
          Vec3i cell;
          cell[axis] = layer;
          cell[u] = i;
          cell[v] = j;
          Vec3i beyond = cell;
          beyond[axis] += far ? 1 : -1;
          face(i, j) = showsFace(at(cell), beyond) ? at(cell) + 1u : 0u;
        }
      }
      for (int j = 0; j < size[v]; ++j) {
        for (int i = 0; i < size[u]; ++i) {
          const std::uint32_t label = face(i, j);
          if (label == 0) continue;
          int i1 = i + 1, j1 = j + 1;
          while (i1 < size[u] && face(i1, j) == label) ++i1;
          const auto rowIsAlike = [&](int row) {
            for (int n = i; n < i1; ++n) {
              if (face(n, row) != label) return false;
            }
            return true;
          };
          while (j1 < size[v] && rowIsAlike(j1)) ++j1;
          for (int row = j; row < j1; ++row) std::fill_n(&face(i, row), i1 - i, 0u);
          rectangles_.push_back({static_cast<Label>(label - 1), static_cast<std::int8_t>(axis), far,
                                 layer, i, j, i1, j1});
        }
      }
    }
  }

  /// The vertex at lattice point (u, v) on the rim of a rectangle: the point, and which of the
  /// cells around it belong together. Of the eight cells there, those of the label that hang
  /// together through faces share one vertex, which is named by the first of them.
  std::uint64_t keyAt(const Rectangle& r, int u, int v) const {
    const int ua = (r.axis + 1) % 3, va = (r.axis + 2) % 3;
    Vec3i point, cell;
    point[r.axis] = r.layer + (r.far ? 1 : 0);
    point[ua] = u;
    point[va] = v;
    cell[r.axis] = r.layer;
    cell[ua] = std::min(u, r.u1 - 1);
    cell[va] = std::min(v, r.v1 - 1);
    // Cell n of the eight lies at point - 1 + the bits of n.
    std::array<bool, 8> same;
    for (int n = 0; n < 8; ++n) {
      const Vec3i c = point - Vec3i{1, 1, 1} + Vec3i{n & 1, n >> 1 & 1, n >> 2};
      same[n] = grid_.cells.contains(c) && at(c) == r.label;
    }
    const Vec3i offset = cell - point + Vec3i{1, 1, 1};
    unsigned reached = 1u << (offset.x + 2 * offset.y + 4 * offset.z);
    for (unsigned before = 0; before != reached;) {
      before = reached;
      for (int n = 0; n < 8; ++n) {
        if (!(reached >> n & 1)) continue;
        for (const int next : {n ^ 1, n ^ 2, n ^ 4}) {
          if (same[next]) reached |= 1u << next;
        }
      }
    }
    int first = 0;
    while (!(reached >> first & 1)) ++first;
    const Vec3i size = grid_.size();
    const std::uint64_t index =
        (static_cast<std::uint64_t>(point.z) * (size.y + 1) + point.y) * (size.x + 1) + point.x;
    return index * 8 + first;
  }

  std::uint32_t vertex(std::uint64_t key) {
    std::uint32_t& index = vertices_.at(key);
    if (index == kUnset) {
      index = static_cast<std::uint32_t>(mesh_.positions.size());
      const Vec3i size = grid_.size();
      const std::uint64_t point = key / 8, nx = size.x + 1, ny = size.y + 1;
      mesh_.positions.push_back(grid_.origin + scaled(Vec3d{static_cast<double>(point % nx),
                                                            static_cast<double>(point / nx % ny),
                                                            static_cast<double>(point / nx / ny)},
                                                      grid_.cellSize));
    }
    return index;
  }

  std::uint32_t materialOf(Label label) {
    if (materials_.empty()) materials_.assign(grid_.labels.size(), kUnset);
    if (materials_[label] == kUnset) {
      materials_[label] = static_cast<std::uint32_t>(mesh_.materials.size());
      const LabelLook& look = grid_.labels[label];
      Material& material = mesh_.materials.emplace_back();
      material.name = look.name.empty() ? "label " + std::to_string(label) : look.name;
      material.baseColor = look.color;
    }
    return materials_[label];
  }

  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t material) {
    mesh_.triangles.push_back({a, b, c});
    mesh_.triangleMaterials.push_back(material);
  }

  void addRectangle(const Rectangle& r) {
    // The vertices along the rim, counterclockwise in (u, v), beginning at a corner.
    std::vector<std::uint32_t> rim;
    const auto visit = [&](int u, int v) {
      const std::uint64_t key = keyAt(r, u, v);
      if (vertices_.contains(key)) rim.push_back(vertex(key));
    };
    for (int u = r.u0; u < r.u1; ++u) visit(u, r.v0);
    for (int v = r.v0; v < r.v1; ++v) visit(r.u1, v);
    for (int u = r.u1; u > r.u0; --u) visit(u, r.v1);
    for (int v = r.v1; v > r.v0; --v) visit(r.u0, v);
    // Seen along -axis, u to v turns counterclockwise: right for faces that look along +axis.
    if (!r.far) std::reverse(rim.begin(), rim.end());
    const std::uint32_t material = materialOf(r.label);
    if (rim.size() == 4) {
      addTriangle(rim[0], rim[1], rim[2], material);
      addTriangle(rim[0], rim[2], rim[3], material);
      return;
    }
    // A fan from the middle: no triangle is without area, whatever lies along the rim.
    const auto middle = static_cast<std::uint32_t>(mesh_.positions.size());
    Vec3d at;
    at[r.axis] = r.layer + (r.far ? 1 : 0);
    at[(r.axis + 1) % 3] = (r.u0 + r.u1) / 2.0;
    at[(r.axis + 2) % 3] = (r.v0 + r.v1) / 2.0;
    mesh_.positions.push_back(grid_.origin + scaled(at, grid_.cellSize));
    for (std::size_t n = 0; n < rim.size(); ++n) {
      addTriangle(middle, rim[n], rim[(n + 1) % rim.size()], material);
    }
  }

  const LabelGrid& grid_;
  LabelMeshOptions options_;
  const Progress& progress_;
  std::vector<bool> empty_;
  std::vector<Rectangle> rectangles_;
  std::unordered_map<std::uint64_t, std::uint32_t> vertices_;
  std::vector<std::uint32_t> materials_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh labelMesh(const LabelGrid& grid, const LabelMeshOptions& options,
                       const Progress& progress) {
  return Mesher(grid, options, progress).make();
}

}  // namespace exemplar
