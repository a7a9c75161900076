// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/decimate.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
// The next one leans on what the first one includes.
#include <OpenMesh/Core/Geometry/QuadricT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModBaseT.hh>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/stoppable.h"
#include "mesh/mesh_health.h"

namespace exemplar {
namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
};
using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Quadric = OpenMesh::Geometry::QuadricT<double>;

/// What a collapse may make of the triangles around it.
struct Tolerance {
  double leastTurn;  ///< cosine of the largest turn of a triangle in one collapse
  /// Squared longest side over twice the area that no collapse makes worse: 1.15 where equilateral.
  double slender;
};
/// From good triangles to what only a number of triangles far below the shape's detail needs: where
/// balls are joined by necks, hardly a collapse turns nothing by more than 60 degrees.
constexpr Tolerance kTolerances[] = {{0.5, 30}, {0.1, 100}, {-0.5, 1000}};
/// Where the error is the same, short edges go first: what a unit of length counts as error.
constexpr double kLengthCost = 1e-3;

/// Decides which collapses are allowed, and in which order they go.
///
/// Unlike in OpenMesh's own quadric module, planes count the same whatever their triangles' area,
/// so that the root of the sum bounds the distance from every plane that went into it.
class SurfaceDistance : public OpenMesh::Decimater::ModBaseT<HalfedgeMesh> {
 public:
  using Base = OpenMesh::Decimater::ModBaseT<HalfedgeMesh>;
  using Handle = OpenMesh::Decimater::ModHandleT<SurfaceDistance>;

  explicit SurfaceDistance(HalfedgeMesh& halfedges) : Base(halfedges, false) {
    Base::mesh().add_property(quadrics_);
  }
  ~SurfaceDistance() override { Base::mesh().remove_property(quadrics_); }
  SurfaceDistance(const SurfaceDistance&) = delete;
  SurfaceDistance& operator=(const SurfaceDistance&) = delete;

  void configure(double error, std::vector<std::uint8_t> held, const Progress& progress) {
    error_ = error;
    held_ = std::move(held);
    progress_ = progress;
    vertices_ = Base::mesh().n_vertices();
  }
  void tolerate(const Tolerance& tolerance) { tolerance_ = tolerance; }

  void initialize() override {
    HalfedgeMesh& mesh = Base::mesh();
    for (const auto v : mesh.vertices()) mesh.property(quadrics_, v).clear();
    std::size_t done = 0;
    for (const auto f : mesh.faces()) {
      if (looksUp(done++)) progress_.check();
      const OpenMesh::Vec3d n = mesh.calc_face_normal(f);
      auto corner = mesh.cfv_iter(f);
      const Quadric q(n[0], n[1], n[2], -(mesh.point(*corner) | n));
      for (; corner.is_valid(); ++corner) mesh.property(quadrics_, *corner) += q;
    }
  }

  float collapse_priority(const CollapseInfo& info) override {
    HalfedgeMesh& mesh = Base::mesh();
    progress_.check();
    // What lies in a face of the box moves within it only.
    const std::uint8_t from = held_[info.v0.idx()], to = held_[info.v1.idx()];
    if ((from & to) != from) return Base::ILLEGAL_COLLAPSE;
    if (mesh.is_boundary(info.v0)) return Base::ILLEGAL_COLLAPSE;

    Quadric q = mesh.property(quadrics_, info.v0);
    q += mesh.property(quadrics_, info.v1);
    // Each triangle gave its plane to three vertices.
    const double distance = std::sqrt(std::max(0.0, q(info.p1)) / 3);
    if (distance > error_) return Base::ILLEGAL_COLLAPSE;
    for (auto h = mesh.cvoh_iter(info.v0); h.is_valid(); ++h) {
      const auto face = mesh.face_handle(*h);
      if (!face.is_valid()) continue;
      const auto b = mesh.to_vertex_handle(*h);
      const auto c = mesh.to_vertex_handle(mesh.next_halfedge_handle(*h));
      if (b == info.v1 || c == info.v1) continue;
      const OpenMesh::Vec3d before = (mesh.point(b) - info.p0) % (mesh.point(c) - info.p0);
      const OpenMesh::Vec3d after = (mesh.point(b) - info.p1) % (mesh.point(c) - info.p1);
      const double areaBefore = before.norm(), areaAfter = after.norm();
      if ((before | after) < tolerance_.leastTurn * areaBefore * areaAfter)
        return Base::ILLEGAL_COLLAPSE;
      const double slender = longest2(info.p1, mesh.point(b), mesh.point(c)) / areaAfter;
      if (!(slender < tolerance_.slender) &&
          !(slender < longest2(info.p0, mesh.point(b), mesh.point(c)) / areaBefore)) {
        return Base::ILLEGAL_COLLAPSE;
      }
    }
    return static_cast<float>(distance + kLengthCost * (info.p1 - info.p0).norm());
  }

  void postprocess_collapse(const CollapseInfo& info) override {
    Base::mesh().property(quadrics_, info.v1) += Base::mesh().property(quadrics_, info.v0);
    if (++collapses_ % 4096 == 0) {
      progress_.report("simplifying", double(collapses_) / double(vertices_));
    }
  }

 private:
  static double longest2(const OpenMesh::Vec3d& a, const OpenMesh::Vec3d& b,
                         const OpenMesh::Vec3d& c) {
    return std::max({(b - a).sqrnorm(), (c - b).sqrnorm(), (a - c).sqrnorm()});
  }

  OpenMesh::VPropHandleT<Quadric> quadrics_;
  Progress progress_;
  std::size_t vertices_ = 0, collapses_ = 0;
  double error_ = 0;
  Tolerance tolerance_ = kTolerances[0];
  std::vector<std::uint8_t> held_;  // bits of the axes along which a vertex may not move
};

std::size_t facesThere(const HalfedgeMesh& halfedges) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto f : halfedges.faces()) ++count;
  return count;
}

void check(const TriangleMesh& mesh, const DecimateOptions& options, const Progress& progress) {
  if (!(options.error >= 0)) {
    throw InputError("decimation: `error` is " + std::to_string(options.error) +
                     "; it must be >= 0 world units");
  }
  if (options.triangles < 0) {
    throw InputError("decimation: `triangles` is " + std::to_string(options.triangles) +
                     "; it must be >= 0");
  }
  if (mesh.hasColors() || mesh.hasUvs() || mesh.hasMaterials()) {
    throw InputError("decimation would lose materials; decimate first, then transfer them");
  }
  const MeshHealth health = meshHealth(mesh, progress);
  if (!health.manifold() || !health.oriented()) {
    throw InputError("decimation needs a manifold, oriented mesh; call `makeManifold` first");
  }
}

}  // namespace

void decimate(TriangleMesh& mesh, const DecimateOptions& options, const Progress& progress) {
  progress.report("simplifying", 0);
  check(mesh, options, progress.part(0, 0.1));
  HalfedgeMesh halfedges;
  halfedges.reserve(mesh.positions.size(), 3 * mesh.triangles.size() / 2, mesh.triangles.size());
  std::vector<std::uint8_t> held(mesh.positions.size(), 0);
  const Vec3d size = options.box ? options.box->size() : Vec3d{};
  const double near = 1e-9 * std::max({size.x, size.y, size.z, 1e-300});
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (looksUp(v)) progress.check();
    const Vec3d& p = mesh.positions[v];
    halfedges.new_vertex({p.x, p.y, p.z});
    for (int a = 0; options.box && a < 3; ++a) {
      if (std::abs(p[a] - options.box->min[a]) <= near) held[v] |= std::uint8_t(1 << a);
      if (std::abs(p[a] - options.box->max[a]) <= near) held[v] |= std::uint8_t(1 << a);
    }
  }
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    if (looksUp(n)) progress.check();
    const auto& t = mesh.triangles[n];
    const auto handle = [](std::uint32_t v) { return OpenMesh::VertexHandle(static_cast<int>(v)); };
    halfedges.add_face(handle(t[0]), handle(t[1]), handle(t[2]));
  }

  OpenMesh::Decimater::DecimaterT<HalfedgeMesh> decimater(halfedges);
  SurfaceDistance::Handle distance;
  decimater.add(distance);
  decimater.module(distance).configure(options.error, std::move(held), progress.part(0.2, 0.95));
  decimater.initialize();
  const auto wanted = static_cast<std::size_t>(options.triangles);
  for (const Tolerance& tolerance : kTolerances) {
    decimater.module(distance).tolerate(tolerance);
    // The decimater counts faces that are gone already, too.
    const std::size_t gone = halfedges.n_faces() - facesThere(halfedges);
    decimater.decimate_to_faces(0, wanted + gone);
    if (wanted == 0 || facesThere(halfedges) <= wanted) break;
  }
  halfedges.garbage_collection();

  mesh.positions.resize(halfedges.n_vertices());
  for (const auto v : halfedges.vertices()) {
    const OpenMesh::Vec3d& p = halfedges.point(v);
    mesh.positions[v.idx()] = {p[0], p[1], p[2]};
  }
  mesh.triangles.clear();
  for (const auto f : halfedges.faces()) {
    auto v = halfedges.cfv_iter(f);
    const auto a = static_cast<std::uint32_t>(v->idx());
    const auto b = static_cast<std::uint32_t>((++v)->idx());
    const auto c = static_cast<std::uint32_t>((++v)->idx());
    mesh.triangles.push_back({a, b, c});
  }
  progress.report("simplifying", 1);
}

}  // namespace exemplar
