// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Examples as solids between planes.

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "engine/example_forms.h"
#include "engine/words.h"
#include "mesh/scene.h"
#include "synth/continuous/fit.h"
#include "synth/continuous/snap.h"
#include "synth/continuous/stand_ins.h"
#include "synth/continuous/synthesize.h"

namespace exemplar {
namespace {

using continuous::Solids;

/// A closed mesh that fits a grid exactly, or the union of its parts, fitted; says which.
Solids solidsOf(const TriangleMesh& mesh, Example& example, const Progress& progress) {
  const ReadOptions& reading = example.reading;
  Warnings warnings;
  const auto describe = [&](std::size_t solids, double moved, double unit) {
    char grid[96];
    std::snprintf(grid, sizeof grid, ", moved by at most %.3g to a grid of %.6g", moved, unit);
    example.description = "mesh of " + counted(solids, "solid") + grid;
    for (const std::string& warning : warnings)
      example.warnings.push_back(example.name() + ": " + warning);
  };
  std::string reason;
  try {
    continuous::SnapReport report;
    Solids solids = continuous::snapMesh(mesh,
                                         {.unit = reading.unit,
                                          .tolerance = reading.snap.value_or(1e-3),
                                          .ground = reading.ground,
                                          .warnings = &warnings},
                                         &report, progress.part(0, 0.3));
    describe(static_cast<std::size_t>(report.shells), report.moved, solids.unit);
    return solids;
  } catch (const InputError& error) {
    reason = error.what();
  }
  warnings.clear();
  continuous::FitReport report;
  Solids solids = continuous::fitParts(
      mesh, {.unit = reading.unit, .tolerance = reading.snap, .ground = reading.ground}, &report,
      progress.part(0.3, 1));
  // Why it cannot be read exactly, without the advice.
  std::string text = reason.substr(0, reason.find(';')) + ": read as the union of " +
                     counted(report.parts, "part");
  if (report.openings > 0) text += ", " + counted(report.openings, "opening") + " closed";
  if (report.sheets > 0) text += ", " + counted(report.sheets, "open sheet") + " left out";
  if (report.dropped > 0) text += ", " + counted(report.dropped, "narrow face") + " left out";
  const Vec3d size = boundingBox(mesh).size();
  char moved[160];
  std::snprintf(
      moved, sizeof moved,
      "; its surface was moved by at most %.3g (%.2g %% of the longest side) to a grid of "
      "%.4g; a smaller `snap` keeps more",
      report.moved, 100 * report.moved / std::max({size.x, size.y, size.z}), solids.unit);
  warnings.push_back(text + moved);
  describe(report.parts, report.moved, solids.unit);
  return solids;
}

/// A mesh, snapped: its materials are the looks of its solids.
void takeMesh(Example& example, const Progress& progress) {
  TriangleMesh mesh = readTriangles(example.source, meshReading(example), progress.part(0, 0.3));
  continuous::SolidScene scene;
  try {
    scene.solids = solidsOf(mesh, example, progress.part(0.3, 1));
  } catch (const InputError& error) {
    throw InputError(example.name() + ": " + error.what());
  }
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
  example.mesh = std::move(mesh);
  example.solids = std::move(scene);
}

}  // namespace

void readAsPolygons(Example& example, const Progress& progress) {
  if (example.kind == SourceKind::Mesh) {
    takeMesh(example, progress.part(0, 0.7));
  } else if (example.kind == SourceKind::Solids) {
    example.solids = readSolids(example.source, example.reading.unit, &example.warnings);
    example.description = example.solids->solids.flat ? "shapes of the plane" : "scene of solids";
  } else {
    throw InputError(example.name() +
                     ": the engine continuous takes closed meshes and scenes of solids; try the "
                     "engine geometry");
  }
  continuous::SolidScene& scene = *example.solids;
  for (continuous::StandIn& object : scene.standIns) {
    MeshFileOptions file;
    file.warnings = &example.warnings;
    file.beside = &example.beside;
    object.mesh = readMesh(findScene(example.name()).parent_path() / object.file, file, progress);
  }
  continuous::PolygonModel model;
  try {
    model = continuous::polygonsOf(scene.solids, scene.looks, progress.part(0.7, 1));
  } catch (const InputError& error) {
    throw InputError(example.name() + ": " + error.what());
  }
  if (!example.mesh) {
    continuous::PolygonModel shown = model;
    const auto placed = continuous::takeStandIns(shown, scene.standIns);
    example.mesh = continuous::triangulate(shown);
    for (const continuous::PlacedStandIn& box : placed)
      append(*example.mesh, continuous::stretched(*scene.standIns[box.standIn].mesh, box.box));
  }
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
  for (const continuous::FaceOrigin& face : example.solids->solids.origins) {
    Looks& origin = origins[{face.substance, face.normal.x, face.normal.y, face.normal.z}];
    const std::uint32_t t = face.triangle;
    const std::uint32_t material = from.hasMaterials() ? from.triangleMaterials[t] : 0;
    const double area = length(areaNormal(from, t));
    origin.areas[material] += area;
    auto& largest = origin.largest[material];
    if (area > largest.first) largest = {area, t};
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
