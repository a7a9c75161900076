// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/self_intersection.h"

#include <algorithm>
#include <mutex>
#include <numeric>

#include "core/parallel.h"
#include "mesh/predicates.h"

namespace exemplar {
namespace {

constexpr std::size_t kLeafTriangles = 4;

Box3d boxOf(const TriangleMesh& mesh, std::uint32_t t) {
  Box3d box;
  for (const std::uint32_t v : mesh.triangles[t]) box.add(mesh.positions[v]);
  return box;
}

bool touch(const Box3d& a, const Box3d& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
         a.min.z <= b.max.z && b.min.z <= a.max.z;
}

/// A tree of boxes over the triangles: the ones of a node are cut at the median along the longest
/// side of their centers' box. Balanced, so that its shape follows from the number of triangles:
/// the children of node i are 2 i + 1 and 2 i + 2.
class BoxTree {
 public:
  explicit BoxTree(const TriangleMesh& mesh) : order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    boxes_.resize(order_.size());
    parallelFor(0, order_.size(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t)
        boxes_[t] = boxOf(mesh, static_cast<std::uint32_t>(t));
    });
    std::size_t leaves = 1;
    while (leaves * kLeafTriangles < order_.size()) leaves *= 2;
    nodes_.resize(2 * leaves - 1);
    build(0, 0, order_.size());
  }

  /// Calls `visit(u)` for every triangle whose box touches that of triangle `t`.
  template <class Visit>
  void visitTouching(std::uint32_t t, const Visit& visit) const {
    const Box3d& box = boxes_[t];
    std::size_t stack[64];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const std::size_t n = stack[--top];
      const Node& node = nodes_[n];
      if (!touch(node.box, box)) continue;
      if (2 * n + 1 >= nodes_.size()) {
        for (std::size_t i = node.begin; i < node.end; ++i) {
          if (touch(boxes_[order_[i]], box)) visit(order_[i]);
        }
      } else {
        stack[top++] = 2 * n + 1;
        stack[top++] = 2 * n + 2;
      }
    }
  }

 private:
  struct Node {
    Box3d box;
    std::size_t begin = 0, end = 0;
  };

  void build(std::size_t n, std::size_t begin, std::size_t end) {
    Node& node = nodes_[n];
    node.begin = begin;
    node.end = end;
    Box3d centers;
    for (std::size_t i = begin; i < end; ++i) {
      const Box3d& box = boxes_[order_[i]];
      node.box.add(box.min);
      node.box.add(box.max);
      centers.add(box.center());
    }
    if (2 * n + 1 >= nodes_.size()) return;
    const Vec3d size = centers.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double ca = boxes_[a].min[axis] + boxes_[a].max[axis];
                       const double cb = boxes_[b].min[axis] + boxes_[b].max[axis];
                       return ca != cb ? ca < cb : a < b;
                     });
    parallelFor(0, 2, 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t c = first; c < last; ++c) {
        build(2 * n + 1 + c, c == 0 ? begin : middle, c == 0 ? middle : end);
      }
    });
  }

  std::vector<std::uint32_t> order_;
  std::vector<Box3d> boxes_;
  std::vector<Node> nodes_;
};

bool shareVertex(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
  for (const std::uint32_t v : a) {
    if (v == b[0] || v == b[1] || v == b[2]) return true;
  }
  return false;
}

}  // namespace

std::int64_t countSelfIntersections(const TriangleMesh& mesh, const Progress& progress) {
  if (mesh.triangles.empty()) return 0;
  constexpr const char* kStage = "looking for crossings";
  constexpr std::size_t kGrain = 1024;
  progress.report(kStage, 0);
  const BoxTree tree(mesh);
  // Pieces are counted as they end; reports come one at a time.
  const double pieces = static_cast<double>((mesh.triangles.size() + kGrain - 1) / kGrain);
  std::size_t done = 0;
  std::mutex mutex;
  const std::int64_t crossings = parallelSum<std::int64_t>(
      0, mesh.triangles.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        std::int64_t count = 0;
        for (std::size_t t = begin; t < end; ++t) {
          if (t % 64 == 0) progress.check();
          const auto& triangle = mesh.triangles[t];
          const Vec3d corners[3] = {mesh.positions[triangle[0]], mesh.positions[triangle[1]],
                                    mesh.positions[triangle[2]]};
          tree.visitTouching(static_cast<std::uint32_t>(t), [&](std::uint32_t u) {
            const auto& other = mesh.triangles[u];
            if (u <= t || shareVertex(triangle, other)) return;
            const Vec3d otherCorners[3] = {mesh.positions[other[0]], mesh.positions[other[1]],
                                           mesh.positions[other[2]]};
            if (trianglesCross(corners, otherCorners)) ++count;
          });
        }
        const std::lock_guard lock(mutex);
        progress.report(kStage, 0.1 + 0.9 * static_cast<double>(++done) / pieces);
        return count;
      });
  return crossings;
}

}  // namespace exemplar
