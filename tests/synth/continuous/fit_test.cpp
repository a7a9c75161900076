// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "mesh/mesh_health.h"
#include "mesh/primitives.h"
#include "synth/continuous/mesh_parts.h"
#include "synth/continuous/synthesize.h"

namespace exemplar::continuous {
namespace {

TriangleMesh surfaceOf(const Solids& solids) {
  return triangulate(polygonsOf(solids, std::vector<Material>(solids.substances.size())));
}

double volumeOf(const Solids& solids) { return meshHealth(surfaceOf(solids)).signedVolume; }

std::string message(const TriangleMesh& mesh, const FitOptions& options) {
  try {
    fitParts(mesh, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// A house of parts as kits have them: walls, a roof that reaches into them, a chimney without a
/// bottom through the roof, and a gap of a thousandth below a step.
TriangleMesh kitHouse() {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {4, 6, 3}});
  TriangleMesh roof = makeBox({{-0.5, -0.5, 2.9}, {4.5, 6.5, 5}});
  for (Vec3d& p : roof.positions)
    if (p.z > 4) p.x = 2;
  TriangleMesh chimney = makeBox({{3, 1, 2}, {3.5, 1.5, 5}});
  std::erase_if(chimney.triangles, [&](const auto& t) {
    return chimney.positions[t[0]].z < 3 && chimney.positions[t[1]].z < 3 &&
           chimney.positions[t[2]].z < 3;
  });
  for (const TriangleMesh& part : {roof, chimney, makeBox({{4.001, 2, 0}, {5, 4, 0.5}})})
    append(mesh, part);
  return mesh;
}

TEST(FitParts, ReadsKitPartsAsTheirUnion) {
  const TriangleMesh mesh = kitHouse();
  FitReport report;
  const Solids solids = fitParts(mesh, {}, &report);
  EXPECT_EQ(report.parts, 4u);
  EXPECT_EQ(report.openings, 1u);
  EXPECT_EQ(report.sheets, 0u);
  const MeshHealth health = meshHealth(surfaceOf(solids));
  EXPECT_TRUE(health.closed());
  EXPECT_TRUE(health.manifold());
  EXPECT_EQ(health.components, 1);  // the gap is closed
  // Walls 72 (to 3), a roof over 35 m2 of 2.1 / 2 less what is in the walls, a chimney, a step: no
  // part is lost, none counts twice. The surface has some 150 m2 and moves by at most `moved`.
  const double expected = 72 + 5 * 7 * 2.1 / 2 - 0.1 * 24 + 0.25 * 0.5 + 0.999;
  EXPECT_NEAR(health.signedVolume, expected, 150 * report.moved / 2);
  EXPECT_LE(report.moved, 0.07 * 7);
}

TEST(FitParts, IsExactWhereTheMeshIs) {
  // Overlapping boxes on a grid: closed, but not one surface.
  TriangleMesh mesh = makeBox({{0, 0, 0}, {4, 4, 1}});
  append(mesh, makeBox({{1, 1, 0.5}, {2, 3, 3}}));
  FitReport report;
  const Solids solids = fitParts(mesh, {}, &report);
  EXPECT_LT(report.moved, 1e-9);
  EXPECT_NEAR(volumeOf(solids), 16 + 2 * 2, 1e-9);
  EXPECT_DOUBLE_EQ(solids.unit, 0.5);
}

TEST(FitParts, StraightensFacesThatAreNotFlat) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {4, 4, 4}});
  const Random random(7, 1);
  for (std::uint64_t v = 0; v < mesh.positions.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis)
      mesh.positions[v][axis] += 0.02 * (random.uniform(v, static_cast<std::uint32_t>(axis)) - 0.5);
  }
  FitReport report;
  const Solids solids = fitParts(mesh, {}, &report);
  EXPECT_EQ(meshHealth(surfaceOf(solids)).triangles, 12);
  EXPECT_GT(report.moved, 0);
  EXPECT_LE(report.moved, 0.03);
}

TEST(FitParts, LaterPartsOfOtherMaterialsReplace) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {4, 4, 4}});
  mesh.triangleMaterials.assign(12, 0);
  mesh.materials.resize(2);
  mesh.materials[0].name = "stone";
  mesh.materials[1].name = "brick";
  TriangleMesh other = makeBox({{2, 0, 0}, {6, 4, 4}});
  other.materials = {mesh.materials[1]};
  other.triangleMaterials.assign(12, 0);
  append(mesh, other);
  // A sheet has no volume and is left out.
  TriangleMesh sheet = makeBox({{0, 0, 5}, {4, 4, 6}});
  std::erase_if(sheet.triangles,
                [&](const auto& t) { return areaNormal(sheet, 0).z == 0 && t[0] > 99; });
  sheet.triangles.resize(1);
  sheet.materials = {mesh.materials[0]};
  sheet.triangleMaterials.assign(1, 0);
  append(mesh, sheet);
  FitReport report;
  const Solids solids = fitParts(mesh, {}, &report);
  EXPECT_EQ(report.sheets, 1u);
  const PolygonModel model = polygonsOf(solids, std::vector<Material>(3));
  double stone = 0, brick = 0;
  const TriangleMesh shells = triangulate(model, Faces::Shells);
  EXPECT_THAT(model.substances, testing::ElementsAre("air", "stone", "brick"));
  for (std::size_t t = 0; t < shells.triangles.size(); ++t) {
    (shells.triangleMaterials[t] == 0 ? stone : brick) +=
        dot(shells.positions[shells.triangles[t][0]], areaNormal(shells, t)) / 6;
  }
  EXPECT_NEAR(stone, 32, 1e-9);
  EXPECT_NEAR(brick, 64, 1e-9);
}

TEST(FitParts, RefusesWhatIsTooFineWithTheCount) {
  const TriangleMesh sphere = makeSphere({0, 0, 0}, 1, 12);
  const std::string why = message(sphere, {.tolerance = 0.001});
  EXPECT_THAT(why, testing::HasSubstr("directions"));
  EXPECT_THAT(why, testing::HasSubstr("`snap`"));
  TriangleMesh flat = makeBox({{0, 0, 0}, {1, 1, 1}});
  flat.triangles.resize(1);
  EXPECT_THAT(message(flat, {}), testing::HasSubstr("no volume"));
}

TEST(PartsOf, OrientsAndClosesParts) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  mesh.triangles.pop_back();
  append(mesh, makeBox({{5, 0, 0}, {6, 1, 1}}));
  const MeshParts parts = partsOf(mesh, 1e-5);
  ASSERT_EQ(parts.parts.size(), 2u);
  EXPECT_EQ(parts.openings, 1u);
  for (const MeshPart& part : parts.parts) {
    EXPECT_NEAR(part.volume, 1, 1e-12);
    const double x = &part == &parts.parts[0] ? 0.3 : 5.3;
    EXPECT_NEAR(windingNumber(part, {x, 0.4, 0.6}), 1, 1e-9);
    EXPECT_NEAR(windingNumber(part, {x, 0.4, 1.6}), 0, 1e-9);
  }
}

}  // namespace
}  // namespace exemplar::continuous
