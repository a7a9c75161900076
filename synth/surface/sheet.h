// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "core/vec.h"
#include "mesh/triangle_mesh.h"

/// Geometry synthesis over surfaces of any topology: "one could model the shape of cloth, and then
/// synthesize cloth fiber geometry over the surface" (Lagae, Dumont, Dutré 2004, section 7).
namespace exemplar::surface {

/// A surface cut finely enough for an example to be laid on it: nodes about a sample apart, with
/// tangent planes that know each other.
///
/// Directions at a node are angles, measured anticlockwise seen from outside, from its first edge
/// on, and stretched so that all around an inner node they make 2 pi (Knöppel, Crane, Pinkall,
/// Schröder: "Globally optimal direction fields", SIGGRAPH 2013, section 3).
struct Sheet {
  struct Edge {
    std::uint32_t a = 0, b = 0;
    double length = 0;
    double weight = 0;              ///< mean cotangent of the angles opposite, kept positive
    double angleA = 0, angleB = 0;  ///< the edge's direction at either end, away from that end

    /// What an angle at `a` has to be turned by to be the parallel one at `b`.
    double transport() const;
  };
  /// An edge as one of its nodes sees it.
  struct Link {
    std::uint32_t node = 0, edge = 0;
    bool forward = true;  ///< whether the edge leads from here to `node`
  };

  std::vector<Vec3d> positions;                         ///< n nodes
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< m
  /// m: unit normals of the corners, of the coarse surface's corners in between: smooth where the
  /// surface stands for something smooth, apart at its creases.
  std::vector<std::array<Vec3d, 3>> normals;
  std::vector<Edge> edges;
  std::vector<std::array<std::uint32_t, 3>> sides;  ///< m: the edge from corner c to corner c + 1
  std::vector<std::array<std::int32_t, 3>> across;  ///< m: the triangle beyond it; -1 at a border

  std::vector<Vec3d> nodeNormals;  ///< n, unit
  std::vector<Vec3d> axes;         ///< n, unit: where the angle 0 points
  std::vector<double> areas;       ///< n: a third of that of the triangles around
  std::vector<double> sizes;       ///< n: of the example there, of its own
  std::vector<std::uint8_t> atBorder;
  std::vector<std::uint32_t> component;  ///< n: numbered by their lowest nodes, ascending
  std::uint32_t components = 0;
  double area = 0;

  std::span<const Link> links(std::uint32_t node) const {
    return {links_.data() + begin_[node], begin_[node + 1] - begin_[node]};
  }
  std::span<const std::uint32_t> trianglesAt(std::uint32_t node) const {
    return {fans_.data() + fanBegin_[node], fanBegin_[node + 1] - fanBegin_[node]};
  }
  bool closed() const;
  /// The example's size along an edge, and on a triangle at a place that corners weigh.
  double sizeOf(const Edge& edge) const { return (sizes[edge.a] + sizes[edge.b]) / 2; }
  double sizeAt(std::uint32_t triangle, const std::array<double, 3>& weights) const;
  /// Vertices less edges plus triangles.
  std::int64_t eulerCharacteristic() const;

  /// A direction in space as an angle at a node, and back.
  double angleOf(std::uint32_t node, const Vec3d& direction) const;
  Vec3d directionOf(std::uint32_t node, double angle) const;

 private:
  friend class SheetBuilder;
  std::vector<Link> links_;
  std::vector<std::uint32_t> begin_, fans_, fanBegin_;
};

struct SheetOptions {
  /// Edges are cut until they are no longer than this times the example's size, world units, > 0.
  double edge = 1;
  /// The example's size at each vertex, of its own, > 0; empty: 1 everywhere.
  std::vector<double> sizes;
  /// Where two triangles meet at a larger angle there is a crease: normals do not go on across it;
  /// radians.
  double crease = 0.7;
};

/// Makes it of a mesh whose edges have at most two triangles, running through them in opposite
/// directions, and whose vertices one fan. Open is fine. Triangles without area are left out. The
/// shape stays exactly as it is: triangles are cut, no vertex moves.
///
/// O(n log n) for n nodes, about 1 kB a node; the same at any number of threads. Throws
/// `InputError` where the mesh is not so, has nothing, or would have too many nodes for the memory,
/// and `Cancelled`.
Sheet makeSheet(const TriangleMesh& mesh, const SheetOptions& options,
                const Progress& progress = {});

/// Makes sizes smaller where they change by more than a factor e^(`rate` d) over a way of length d
/// along edges: the largest ones that do not, and are nowhere above the given (Dijkstra's
/// algorithm, from the smallest). Pieces of the example on both sides of such a place would not fit
/// together.
void evenSizes(Sheet& sheet, double rate);

}  // namespace exemplar::surface
