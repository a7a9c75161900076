// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/model_pieces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include "core/error.h"
#include "core/file.h"
#include "core/random.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_health.h"
#include "mesh/primitives.h"
#include "tests/voxelize/error_of.h"
#include "tests/voxelize/hears_cancellation.h"

namespace exemplar {
namespace {

using testing::HasSubstr;

/// The solid of a set of unit cells as one closed mesh: a tower block, a wall, whatever.
TriangleMesh solidOf(const Vec3i& size, const std::function<bool(Vec3i)>& filled) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> points;
  const auto point = [&](const Vec3i& p) {
    const auto [found, isNew] =
        points.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(mesh.positions.size()));
    if (isNew) mesh.positions.push_back(cast<double>(p));
    return found->second;
  };
  const Array3D<char> cells(size);
  const auto isFilled = [&](const Vec3i& c) { return cells.contains(c) && filled(c); };
  for (std::size_t n = 0; n < cells.count(); ++n) {
    const Vec3i cell = cells.ijk(n);
    if (!filled(cell)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int far : {0, 1}) {
        Vec3i beyond = cell, u{}, v{}, low = cell;
        beyond[axis] += far ? 1 : -1;
        if (isFilled(beyond)) continue;
        low[axis] += far;
        u[(axis + 1) % 3] = 1;
        v[(axis + 2) % 3] = 1;
        if (!far) std::swap(u, v);
        const std::uint32_t a = point(low), b = point(low + u), c = point(low + u + v),
                            d = point(low + v);
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      }
    }
  }
  return mesh;
}

/// The same surface, described otherwise: triangles and their corners in another order, vertices
/// renumbered and moved by up to `noise`, every triangle cut in three at its middle.
TriangleMesh describedOtherwise(const TriangleMesh& mesh, double noise, std::uint64_t seed) {
  const Random random(seed, 0x0711);
  TriangleMesh result = mesh;
  for (std::size_t v = 0; v < result.positions.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      result.positions[v][axis] += random.uniform(-noise, noise, v, axis);
    }
  }
  result.triangles.clear();
  result.triangleMaterials.clear();
  std::vector<std::size_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return random.bits(a, 7) < random.bits(b, 7); });
  for (const std::size_t t : order) {
    const auto& c = mesh.triangles[t];
    const auto middle = static_cast<std::uint32_t>(result.positions.size());
    result.positions.push_back(
        (result.positions[c[0]] + result.positions[c[1]] + result.positions[c[2]]) / 3.0);
    for (int k = 0; k < 3; ++k) {
      std::array<std::uint32_t, 3> part{c[k], c[(k + 1) % 3], middle};
      std::rotate(part.begin(), part.begin() + random.below(3, t, 8 + k), part.end());
      result.triangles.push_back(part);
      if (mesh.hasMaterials()) result.triangleMaterials.push_back(mesh.triangleMaterials[t]);
    }
  }
  return result;
}

/// A street of sloped roofs: cells whose surfaces are not along them.
TriangleMesh roofs() {
  TriangleMesh mesh;
  for (int house = 0; house < 3; ++house) {
    const double x = 4.0 * house;
    const std::array<Vec3d, 6> p{Vec3d{x, 0, 0}, {x + 3, 0, 0}, {x + 1.5, 0, 1.5},
                                 {x, 4, 0},      {x + 3, 4, 0}, {x + 1.5, 4, 1.5}};
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), p.begin(), p.end());
    for (const auto& [a, b, c] : std::initializer_list<std::array<std::uint32_t, 3>>{{0, 1, 2},
                                                                                     {3, 5, 4},
                                                                                     {0, 2, 5},
                                                                                     {0, 5, 3},
                                                                                     {1, 4, 5},
                                                                                     {1, 5, 2},
                                                                                     {0, 3, 4},
                                                                                     {0, 4, 1}}) {
      mesh.triangles.push_back({base + a, base + b, base + c});
    }
  }
  return mesh;
}

TEST(ModelPieces, EqualCellsShareALabel) {
  // Three equal houses with an empty cell between them: the second and third repeat the first.
  const ModelPieces pieces = cutIntoPieces(roofs(), {.air = 1});
  const Vec3i size = pieces.grid.size();
  ASSERT_EQ(size, (Vec3i{13, 6, 3}));
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 6; ++j) {
      for (int i = 1; i <= 4; ++i) {
        EXPECT_EQ(pieces.grid.cells(i, j, k), pieces.grid.cells(i + 4, j, k));
        if (i < 4) {
          EXPECT_EQ(pieces.grid.cells(i, j, k), pieces.grid.cells(i + 8, j, k));
        }
      }
    }
  }
  // Empty; a front, a middle and a back of a left slope, ridge and right slope below, and the
  // ridge's three above.
  EXPECT_EQ(pieces.grid.labelCount(), 1 + 9 + 3);
}

TEST(ModelPieces, LabelsDoNotDependOnHowTheSurfaceIsDescribed) {
  const TriangleMesh example = roofs();
  const ModelPieces pieces = cutIntoPieces(example);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const ModelPieces other =
        cutIntoPieces(describedOtherwise(example, 3e-6, seed), {.tolerance = 1e-4});
    // Noise moves the box by less than the grid's own tolerance of a cell.
    ASSERT_EQ(other.grid.size(), pieces.grid.size());
    EXPECT_EQ(other.grid.cells, pieces.grid.cells) << seed;
  }
}

TEST(ModelPieces, DifferencesBeyondTheToleranceMakeOtherPieces) {
  TriangleMesh example = roofs();
  example.positions[2].z += 0.01;  // one end of the first house's ridge
  EXPECT_GT(cutIntoPieces(example).grid.labelCount(), cutIntoPieces(roofs()).grid.labelCount());
  EXPECT_EQ(cutIntoPieces(example, {.tolerance = 0.05}).grid.labelCount(),
            cutIntoPieces(roofs(), {.tolerance = 0.05}).grid.labelCount());
}

TEST(ModelPieces, MaterialsTellPiecesApart) {
  TriangleMesh mesh;
  for (int n = 0; n < 3; ++n) {
    TriangleMesh box = makeBox({{2.0 * n, 0, 0}, {2.0 * n + 1, 1, 1}});
    setMaterial(box,
                {.name = n == 1 ? "wood" : "stone", .baseColor = {n == 1 ? 0.5f : 0, 0, 0, 1}});
    append(mesh, box);
  }
  const ModelPieces pieces = cutIntoPieces(mesh);
  EXPECT_EQ(pieces.grid.labelCount(), 3);
  EXPECT_EQ(pieces.grid.cells(0, 0, 0), pieces.grid.cells(4, 0, 0));
  EXPECT_NE(pieces.grid.cells(0, 0, 0), pieces.grid.cells(2, 0, 0));
  EXPECT_EQ(pieces.grid.labels[2].name, "ground 2, wood");
  EXPECT_FLOAT_EQ(pieces.grid.labels[2].color[0], 0.5f);
}

TEST(ModelPieces, NamesSayWherePiecesLie) {
  // A slab with a tower of three cells, a cube beside it, and a board that nothing is below; each
  // of another height, so that all differ.
  TriangleMesh mesh;
  const auto put = [&](const Vec3d& from, const Vec3d& to) { append(mesh, makeBox({from, to})); };
  put({0, 0, 0}, {7, 3, 1});
  put({1.1, 1.1, 1}, {1.9, 1.9, 2.95});
  put({1.2, 1.2, 2.95}, {1.8, 1.8, 3.9});
  put({3.1, 1.1, 1}, {3.9, 1.9, 1.7});
  put({5.1, 1.1, 3.2}, {5.9, 1.9, 3.4});
  ModelPiecesOptions options;
  options.box = Box3d{{0, 0, 0}, {7, 3, 4}};
  const ModelPieces pieces = cutIntoPieces(mesh, options);
  const auto nameAt = [&](int x, int y, int z) {
    const std::string& name = pieces.grid.labels[pieces.grid.cells(x, y, z)].name;
    return name.substr(0, name.find(' '));
  };
  EXPECT_EQ(nameAt(6, 1, 0), "ground");
  EXPECT_EQ(nameAt(1, 1, 1), "wall");
  EXPECT_EQ(nameAt(1, 1, 3), "roof");
  EXPECT_EQ(nameAt(3, 1, 1), "low");
  EXPECT_EQ(nameAt(5, 1, 3), "span");
}

TEST(ModelPieces, NamesSayWhichObjectTheyAreOf) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  append(mesh, makeBox({{2, 0, 0}, {3, 1, 0.5}}));
  mesh.objects = {"gate.002", "tower"};
  mesh.triangleObjects.assign(mesh.triangles.size(), 0);
  std::fill_n(mesh.triangleObjects.begin(), mesh.triangles.size() / 2, 1u);
  const ModelPieces pieces = cutIntoPieces(mesh);
  const auto nameAt = [&](int x) { return pieces.grid.labels[pieces.grid.cells(x, 0, 0)].name; };
  EXPECT_THAT(nameAt(0), HasSubstr(", tower"));
  EXPECT_TRUE(nameAt(2).ends_with(", gate")) << nameAt(2);
}

TEST(ModelPieces, VertexColorsAndTextureCoordinatesTellPiecesApart) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  append(mesh, makeBox({{2, 0, 0}, {3, 1, 1}}));
  EXPECT_EQ(cutIntoPieces(mesh).grid.labelCount(), 2);
  TriangleMesh colored = mesh;
  colored.colors.assign(mesh.positions.size(), {1, 1, 1, 1});
  EXPECT_EQ(cutIntoPieces(colored).grid.labelCount(), 2);
  colored.colors[3] = {1, 0, 0, 1};
  EXPECT_EQ(cutIntoPieces(colored).grid.labelCount(), 3);
  TriangleMesh mapped = mesh;
  mapped.uvs.assign(mesh.triangles.size(), {Vec2f{0, 0}, {1, 0}, {1, 1}});
  mapped.uvs[5][1].x = 0.5f;
  EXPECT_EQ(cutIntoPieces(mapped).grid.labelCount(), 2);  // no texture: nobody sees them
  mapped.triangleMaterials.assign(mesh.triangles.size(), 0);
  mapped.materials.push_back({.baseColorTexture = 0});
  mapped.textures.push_back({"t.png", "image/png", "bytes"});
  EXPECT_EQ(cutIntoPieces(mapped).grid.labelCount(), 3);
}

TEST(ModelPieces, CellsInsideHaveALabelOfTheirOwn) {
  const ModelPieces pieces = cutIntoPieces(makeBox({{0, 0, 0}, {5, 5, 5}}), {.air = 1});
  const Label inside = pieces.grid.cells(3, 3, 2);
  EXPECT_EQ(pieces.grid.labels[inside].name, "inside");
  EXPECT_EQ(pieces.grid.cells(0, 0, 0), 0);
  EXPECT_NE(inside, 0);
  // 6 faces, 12 edges, 8 corners, inside and empty.
  EXPECT_EQ(pieces.grid.labelCount(), 6 + 12 + 8 + 2);
}

TEST(ModelPieces, ImagesOfABoxsPiecesAreItsOtherPieces) {
  const ModelPieces pieces = cutIntoPieces(makeBox({{0, 0, 0}, {3, 3, 3}}));
  const Vec3i size = pieces.grid.size();
  ASSERT_EQ(size, (Vec3i{3, 3, 3}));
  for (std::size_t n = 0; n < pieces.grid.cells.count(); ++n) {
    const Vec3i c = pieces.grid.cells.ijk(n);
    const Label label = pieces.grid.cells[c];
    EXPECT_EQ(pieces.mirroredX[label], pieces.grid.cells(2 - c.x, c.y, c.z));
    EXPECT_EQ(pieces.mirroredY[label], pieces.grid.cells(c.x, 2 - c.y, c.z));
    EXPECT_EQ(pieces.turned[label], pieces.grid.cells(2 - c.y, c.x, c.z));
  }
  // A roof has no image turned: its ridge runs one way.
  const ModelPieces roof = cutIntoPieces(roofs());
  EXPECT_EQ(roof.turned[roof.grid.cells(0, 1, 0)], ModelPieces::kNone);
  EXPECT_EQ(roof.mirroredX[roof.grid.cells(0, 1, 0)], roof.grid.cells(2, 1, 0));
}

TEST(AssemblePieces, GivesTheExampleAgain) {
  const TriangleMesh example = roofs();
  const MeshHealth before = meshHealth(example);
  for (const double cell : {1.0, 0.7, 0.31}) {
    const ModelPieces pieces = cutIntoPieces(example, {.cellSize = {cell, cell, cell}});
    const MeshHealth after = meshHealth(assemblePieces(pieces.grid, pieces));
    EXPECT_NEAR(after.signedVolume, before.signedVolume, 1e-6) << cell;
    EXPECT_TRUE(after.closed() && after.manifold() && after.oriented()) << cell;
    EXPECT_EQ(after.components, 3);
  }
}

TEST(AssemblePieces, PiecesOfOtherTrianglesFitWithoutCracks) {
  // A long wall, cut along its diagonals differently in every cell: each piece is that of the first
  // cell with its shape, whose edges are divided elsewhere than its neighbor's.
  const TriangleMesh wall = describedOtherwise(
      solidOf({9, 4, 4}, [](Vec3i c) { return c.x > 0 && c.x < 8 && c.y % 3 && c.z < 3; }), 1e-6,
      3);
  const ModelPieces pieces = cutIntoPieces(wall, {.cellSize = {0.75, 0.75, 0.75}, .air = 1});
  const MeshHealth health = meshHealth(assemblePieces(pieces.grid, pieces));
  EXPECT_TRUE(health.closed() && health.oriented());
  EXPECT_NEAR(health.signedVolume, 7 * 2 * 3, 1e-3);
}

TEST(AssemblePieces, APieceThatDoesNotFitLeavesAHole) {
  ModelPieces pieces = cutIntoPieces(roofs(), {.air = 1});
  pieces.grid.cells(2, 2, 0) = 0;
  EXPECT_FALSE(meshHealth(assemblePieces(pieces.grid, pieces)).closed());
}

TEST(AssemblePieces, KeepsMaterialsTexturesAndTextureCoordinates) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {4, 4, 4}});
  setMaterial(mesh, {.name = "brick", .baseColorTexture = 0});
  mesh.textures.push_back({"t.png", "image/png", "bytes"});
  // Texture coordinates that follow the position: linear on every face.
  const auto uvOf = [](const Vec3d& p) {
    return Vec2f{static_cast<float>(p.x + 2 * p.z), static_cast<float>(p.y - p.z)};
  };
  for (const auto& t : mesh.triangles) {
    mesh.uvs.push_back(
        {uvOf(mesh.positions[t[0]]), uvOf(mesh.positions[t[1]]), uvOf(mesh.positions[t[2]])});
  }
  const ModelPieces pieces = cutIntoPieces(mesh, {.cellSize = {1.5, 1.5, 1.5}});
  const TriangleMesh back = assemblePieces(pieces.grid, pieces);
  validate(back, "back");
  ASSERT_EQ(back.materials.size(), 1u);
  EXPECT_EQ(back.materials[0].name, "brick");
  EXPECT_EQ(back.textures.size(), 1u);
  for (std::size_t t = 0; t < back.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Vec2f expected = uvOf(back.positions[back.triangles[t][k]]);
      EXPECT_NEAR(back.uvs[t][k].x, expected.x, 1e-4);
      EXPECT_NEAR(back.uvs[t][k].y, expected.y, 1e-4);
    }
  }
}

TEST(AssemblePieces, TellsWhichCellATriangleIsFrom) {
  const ModelPieces pieces = cutIntoPieces(roofs(), {.air = 1});
  std::vector<std::uint32_t> cellOf;
  const TriangleMesh mesh = assemblePieces(pieces.grid, pieces, &cellOf);
  ASSERT_EQ(cellOf.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < cellOf.size(); ++t) {
    const Vec3i cell = pieces.grid.cells.ijk(cellOf[t]);
    for (const std::uint32_t v : mesh.triangles[t]) {
      const Vec3d p = mesh.positions[v] - pieces.grid.origin - cast<double>(cell);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GT(p[axis], -1e-3);
        EXPECT_LT(p[axis], 1 + 1e-3);
      }
    }
  }
}

TEST(WritePieceInstances, HoldsEachPieceOnceAndReadsBackWhole) {
  const ModelPieces pieces = cutIntoPieces(roofs(), {.air = 1});
  const auto path = std::filesystem::temp_directory_path() / "exemplar_instances_test.glb";
  const std::size_t nodes = writePieceInstances(path, pieces.grid, pieces);
  std::size_t filled = 0;
  for (const Label label : pieces.grid.cells.values()) filled += label != 0;
  EXPECT_EQ(nodes, filled);
  const std::string bytes = readFile(path);
  std::size_t meshes = 0;
  for (std::size_t at = 0; (at = bytes.find("\"primitives\"", at)) != std::string::npos; ++at) {
    ++meshes;
  }
  EXPECT_EQ(meshes, 12u);  // pieces, not cells
  const TriangleMesh back = readMesh(path);
  std::filesystem::remove(path);
  EXPECT_NEAR(meshHealth(back).signedVolume, meshHealth(roofs()).signedVolume, 1e-4);
}

TEST(ModelPieces, OneThreadEqualsEight) {
  const TriangleMesh mesh = makeTorus({0, 0, 0}, {0, 0, 1}, 4, 1.5);
  ModelPieces one, eight;
  tbb::task_arena(1).execute([&] { one = cutIntoPieces(mesh); });
  tbb::task_arena(8).execute([&] { eight = cutIntoPieces(mesh); });
  EXPECT_EQ(one.grid.cells, eight.grid.cells);
  EXPECT_EQ(one.mesh.positions, eight.mesh.positions);
  EXPECT_EQ(one.turned, eight.turned);
}

TEST(ModelPieces, BadInputIsRefused) {
  const TriangleMesh mesh = roofs();
  const auto error = [&](const ModelPiecesOptions& options) {
    return test::errorOf([&] { return cutIntoPieces(mesh, options); });
  };
  EXPECT_THAT(test::errorOf([] { return cutIntoPieces(TriangleMesh{}); }), HasSubstr("the mesh"));
  EXPECT_THAT(error({.cellSize = {0, 1, 1}}), HasSubstr("`cell` 0.000000: must be a positive"));
  EXPECT_THAT(error({.cellSize = {1e-9, 1, 1}}), HasSubstr("longer than 32,767 cells"));
  EXPECT_THAT(error({.air = 1025}), HasSubstr("`air` 1025: must be 0 to 1024"));
  EXPECT_THAT(error({.tolerance = 0}), HasSubstr("`tolerance`: must be 1e-7 to 0.1 cells"));
  const ModelPieces pieces = cutIntoPieces(mesh);
  LabelGrid grid = pieces.grid;
  for (Label& label : grid.cells.values()) label = 0;
  const auto assemble = [&] { return assemblePieces(grid, pieces); };
  EXPECT_THAT(test::errorOf(assemble), HasSubstr("has no geometry"));
  grid.cells(0, 0, 0) = 999;
  EXPECT_THAT(test::errorOf(assemble), HasSubstr("label 999"));
  EXPECT_THAT(test::errorOf([&] { return writePieceInstances("never.glb", grid, pieces); }),
              HasSubstr("label 999"));
}

TEST(ModelPieces, EveryStepHearsCancellation) {
  const TriangleMesh mesh = roofs();
  test::expectHearsCancellation([&](const Progress& p) { (void)cutIntoPieces(mesh, {}, p); });
  const ModelPieces pieces = cutIntoPieces(mesh);
  test::expectHearsCancellation(
      [&](const Progress& p) { (void)assemblePieces(pieces.grid, pieces, nullptr, p); });
}

}  // namespace
}  // namespace exemplar
