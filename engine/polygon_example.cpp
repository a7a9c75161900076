// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Examples as solids between planes.

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "engine/example_forms.h"
#include "engine/words.h"
#include "synth/continuous/snap.h"
#include "synth/continuous/synthesize.h"

namespace exemplar {
namespace {

using continuous::Solids;

/// A mesh, snapped: its materials are the looks of its solids.
void takeMesh(Example& example, const Progress& progress) {
  MeshFileOptions file = example.reading.mesh;
  file.warnings = &example.warnings;
  TriangleMesh mesh = readTriangles(example.source, file, progress.part(0, 0.3));
  Warnings warnings;
  const continuous::SnapOptions options{.unit = example.reading.unit,
                                        .tolerance = example.reading.snap,
                                        .ground = example.reading.ground,
                                        .warnings = &warnings};
  continuous::SnapReport report;
  continuous::SolidScene scene;
  try {
    scene.solids = continuous::snapMesh(mesh, options, &report, progress.part(0.3, 0.7));
  } catch (const InputError& error) {
    throw InputError(example.name() + ": " + error.what());
  }
  for (const std::string& warning : warnings)
    example.warnings.push_back(example.name() + ": " + warning);
  scene.name = example.name();
  for (const std::string& name : scene.solids.substances) {
    Material look;
    for (const Material& material : mesh.materials)
      if (material.name == name) look = material;
    look.name = name;
    look.baseColorTexture.reset();
    if (name == "ground" && example.reading.ground) look.baseColor = {0.25f, 0.32f, 0.16f, 1};
    scene.looks.push_back(std::move(look));
  }
  example.description = "mesh of " + counted(static_cast<std::size_t>(report.shells), "solid") +
                        ", moved by at most " + numberText(report.moved) + " to a grid of " +
                        numberText(scene.solids.unit);
  example.mesh = std::move(mesh);
  example.solids = std::move(scene);
}

}  // namespace

void readAsPolygons(Example& example, const Progress& progress) {
  if (example.kind == SourceKind::Mesh) {
    takeMesh(example, progress.part(0, 0.7));
  } else if (example.kind == SourceKind::Solids) {
    example.solids = readSolids(example.source);
    example.description = "scene of solids";
  } else {
    throw InputError(example.name() +
                     ": the engine continuous takes closed meshes and scenes of solids; try the "
                     "engine geometry");
  }
  const continuous::SolidScene& scene = *example.solids;
  continuous::PolygonModel model;
  try {
    model = continuous::polygonsOf(scene.solids, scene.looks, progress.part(0.7, 1));
  } catch (const InputError& error) {
    throw InputError(example.name() + ": " + error.what());
  }
  if (!example.mesh) example.mesh = continuous::triangulate(model);
  example.hints.scale = scene.scale;
  example.description +=
      ", " + withThousands(static_cast<long long>(model.polygons.size())) + " faces of " +
      counted(continuous::normalsOf(continuous::planesOf(scene.solids)).size(), "direction");
  example.data = std::move(model);
}

void paintFaces(const continuous::PolygonModel& model, const Example& example,
                std::span<const std::uint32_t> faces, TriangleMesh& mesh) {
  if (example.kind != SourceKind::Mesh || !example.mesh) return;
  const TriangleMesh& from = *example.mesh;
  if (!from.hasMaterials() && !from.hasUvs()) return;

  // For each substance and direction, the material with most area and its largest triangle.
  struct Looks {
    std::map<std::uint32_t, double> areas;
    std::map<std::uint32_t, std::pair<double, std::uint32_t>> largest;
  };
  std::map<std::tuple<int, std::int64_t, std::int64_t, std::int64_t>, Looks> origins;
  for (const continuous::Solid& solid : example.solids->solids.solids) {
    for (const continuous::ShellTriangle& triangle : solid.triangles) {
      const continuous::Vec3l& n = solid.sides[triangle.plane].normal;
      Looks& origin = origins[{solid.substance, n.x, n.y, n.z}];
      const std::uint32_t t = triangle.origin;
      const std::uint32_t material = from.hasMaterials() ? from.triangleMaterials[t] : 0;
      const double area = length(areaNormal(from, t));
      origin.areas[material] += area;
      auto& largest = origin.largest[material];
      if (area > largest.first) largest = {area, t};
    }
  }
  std::vector<Material> materials = from.materials;
  const auto own = static_cast<std::uint32_t>(materials.size());
  materials.insert(materials.end(), mesh.materials.begin(), mesh.materials.end());
  std::vector<std::array<Vec2f, 3>> uvs(from.hasUvs() ? mesh.triangles.size() : 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const continuous::Polygon& face = model.polygons[faces[t]];
    const int outside = face.outside();
    const continuous::Vec3l n = outside < 0 ? -face.plane.normal : face.plane.normal;
    const int substance = outside < 0 ? face.above : face.below;
    const auto found = origins.find({substance, n.x, n.y, n.z});
    if (mesh.hasMaterials()) mesh.triangleMaterials[t] += own;
    if (found == origins.end()) continue;  // the ground
    const auto most = std::ranges::max_element(found->second.areas, {},
                                               [](const auto& entry) { return entry.second; });
    if (mesh.hasMaterials() && from.hasMaterials()) mesh.triangleMaterials[t] = most->first;
    if (!from.hasUvs()) continue;
    // The origin's texture, continued over its plane from its first corner on.
    const std::uint32_t source = found->second.largest.at(most->first).second;
    const std::array<std::uint32_t, 3>& corners = from.triangles[source];
    const Vec3d a = from.positions[corners[0]], ab = from.positions[corners[1]] - a,
                ac = from.positions[corners[2]] - a;
    const double bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac);
    for (int c = 0; c < 3; ++c) {
      const Vec3d p = mesh.positions[mesh.triangles[t][c]] - a;
      const double pb = dot(p, ab), pc = dot(p, ac), whole = bb * cc - bc * bc;
      const auto s = static_cast<float>((pb * cc - pc * bc) / whole);
      const auto r = static_cast<float>((pc * bb - pb * bc) / whole);
      const std::array<Vec2f, 3>& uv = from.uvs[source];
      uvs[t][c] = {uv[0].x + s * (uv[1].x - uv[0].x) + r * (uv[2].x - uv[0].x),
                   uv[0].y + s * (uv[1].y - uv[0].y) + r * (uv[2].y - uv[0].y)};
    }
  }
  mesh.materials = std::move(materials);
  mesh.textures = from.textures;
  mesh.uvs = std::move(uvs);
}

}  // namespace exemplar
