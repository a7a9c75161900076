// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "synth/continuous/arrangement.h"
#include "synth/continuous/solids.h"

/// Solids by the polygons between them.
namespace exemplar::continuous {

/// A flat face with one substance on each side; the corners of its first loop run counterclockwise
/// seen from the tip of the normal, those of holes clockwise.
struct Polygon {
  ExactPlane plane;                ///< with a canonical normal
  Substance below = 0, above = 0;  ///< on the negative and the positive side
  std::vector<std::vector<std::uint32_t>> loops;

  /// The side that is seen, where one is air: 1 where that is above, -1 where below, else 0.
  int outside() const { return above == kAir ? 1 : below == kAir ? -1 : 0; }
};

/// Faces between substances, with exact corners.
struct PolygonModel {
  std::vector<ExactPoint> points;
  std::vector<Polygon> polygons;
  double unit = 1;  ///< world = origin + unit * point
  Vec3d origin;
  std::vector<std::string> substances;  ///< names; the first is "air"
  std::vector<Material> looks;          ///< of each substance
  Vec3i size;                           ///< of the box, in spacings
  bool flat = false;                    ///< prisms of one height that stand for shapes of the plane

  Vec3d toWorld(const ExactPoint& p) const { return origin + unit * p.approximately(); }
};

/// What is in each cell around each vertex of an arrangement.
class Filling {
 public:
  virtual ~Filling() = default;
  /// In the order of `Central::cells`; all the same where nothing changes at the vertex.
  virtual const Substance* cells(std::uint32_t vertex) const = 0;
};

/// The faces of a filling: in each plane, what has the same two substances on its sides and hangs
/// together along edges becomes one polygon. A corner is where three directions of faces meet; at
/// others every face goes straight on, so they are left out of all of them alike, and the faces fit
/// together without gaps. Deterministic; linear in the vertices on faces.
PolygonModel outline(const Arrangement& arrangement, const Filling& filling,
                     const Progress& progress = {});

/// Which faces become triangles.
enum class Faces {
  Seen,    ///< those next to air: the surface of all solids together
  Shells,  ///< those of each substance, as a closed shell with vertices of its own
};

/// Triangles of a model's faces, outward: closed, because faces share their corners and edges. The
/// materials are the substances' looks. `facesOf` receives the polygon of each triangle.
TriangleMesh triangulate(const PolygonModel& model, Faces faces = Faces::Seen,
                         std::vector<std::uint32_t>* facesOf = nullptr,
                         const Progress& progress = {});

}  // namespace exemplar::continuous
