// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "core/vec.h"
#include "sdf/closest_point.h"

namespace exemplar {

struct ClusterMoments;

/// A tree of boxes around triangles that answers how far the nearest one is and how often they wind
/// around a point. Immutable, so any number of threads may ask. O(n log n) to build for n
/// triangles, about 400 bytes a triangle; the same tree at any number of threads.
class TriangleTree {
 public:
  enum class For {
    Everything,
    Distances,  ///< no winding numbers: built in half the time
  };
  /// Throws `Cancelled`.
  explicit TriangleTree(std::vector<Corners> triangles, const Progress& progress = {},
                        For purpose = For::Everything);
  TriangleTree(TriangleTree&&) noexcept;
  TriangleTree& operator=(TriangleTree&&) noexcept;
  ~TriangleTree();

  std::size_t count() const { return triangles_.size(); }
  /// Triangle `t` in the order of the constructor's argument.
  const Corners& triangle(std::uint32_t t) const { return triangles_[t]; }
  const std::vector<Corners>& triangles() const { return triangles_; }
  /// All triangles, those that are close together mostly one after the other.
  std::span<const std::uint32_t> order() const { return order_; }

  /// The exact distance of `p` from the nearest triangle, or `limit` where none is nearer than
  /// that.
  double distance(const Vec3d& p, double limit) const;
  /// The same, starting from a triangle that may be near (kNone: from nothing), which becomes the
  /// nearest one.
  double distance(const Vec3d& p, double limit, std::uint32_t& near) const;
  static constexpr std::uint32_t kNone = 0xffffffff;

  /// The generalized winding number of the triangles around `p`: for closed surfaces that wind
  /// anticlockwise seen from outside 1 inside and 0 outside, the sum over overlapping ones, and
  /// harmonic off the triangles for open ones (Jacobson, Kavan, Sorkine-Hornung: "Robust
  /// inside-outside segmentation using generalized winding numbers", SIGGRAPH 2013, equation 3).
  ///
  /// Far clusters of triangles are replaced by the first three terms of their multipole expansion
  /// (Barill, Dickson, Schmidt, Levin, Jacobson: "Fast winding numbers for soups and clouds",
  /// SIGGRAPH 2018, section 3), near ones count exactly, so the error is below 0.01 and there is
  /// none that grows towards the surface.
  double windingNumber(const Vec3d& p) const;

  /// The same at many points. Those that are close together, as the samples of a block do, share
  /// the way through the tree and are about ten times as fast as one by one.
  void windingNumbers(std::span<const Vec3d> points, std::span<double> result) const;

  /// Calls `visit` with each triangle whose bounding box meets the box.
  void visitBox(const Vec3d& low, const Vec3d& high,
                const std::function<void(std::uint32_t)>& visit) const;

  /// Calls `visit` with the corners of all triangles that a line along x from `p` on may meet, and
  /// of some others.
  template <class Visit>
  void visitRow(const Vec3d& p, const Visit& visit) const {
    if (nodes_.empty()) return;
    std::array<std::uint32_t, kMaxDepth> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const std::uint32_t node = stack[--depth];
      const Node& n = nodes_[node];
      if (n.high.x < p.x || n.low.y > p.y || n.high.y < p.y || n.low.z > p.z || n.high.z < p.z)
        continue;
      if (n.right == 0) {
        for (std::uint32_t i = n.first; i < n.first + n.count; ++i) visit(leaves_[i]);
      } else {
        stack[depth++] = n.right;
        stack[depth++] = node + 1;
      }
    }
  }

 private:
  static constexpr std::size_t kMaxDepth = 64;

  struct Node {
    Vec3d low, high;          // bounding box
    std::uint32_t first = 0;  // the first triangle in `order_`
    std::uint32_t count = 0;  // triangles below this node
    std::uint32_t right = 0;  // the right child; the left one is the next node; 0: a leaf
  };
  // A flat cylinder around a node's triangles: their surface is flat enough at a small scale for it
  // to be far tighter than the box, seen from afar.
  struct Disc {
    Vec3d center, axis;  // axis of length 1, or 0 where the triangles have no direction in common
    double radius = 0, halfHeight = 0;
  };

  double squaredBound(const Vec3d& p, std::uint32_t node, double enough) const;
  struct Build;
  void build(const Build& with, std::uint32_t node, std::uint32_t first, std::uint32_t count);
  void setMoments(std::uint32_t node, For purpose);

  std::vector<Corners> triangles_;
  std::vector<std::uint32_t> order_;  // triangles as the leaves hold them
  std::vector<Corners> leaves_;       // their corners in that order
  std::vector<Node> nodes_;
  std::vector<Disc> discs_;
  std::vector<ClusterMoments> moments_;
};

}  // namespace exemplar
