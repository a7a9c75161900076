// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/transfer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <filesystem>

#include "core/error.h"
#include "core/file.h"
#include "core/origin.h"
#include "mesh/image.h"
#include "mesh/primitives.h"
#include "reconstruct/field_to_mesh.h"
#include "sdf/mesh_to_sdf.h"
#include "tests/reconstruct/fields.h"

namespace exemplar {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// A smooth color that differs from place to place.
std::array<float, 4> colorAt(const Vec3d& p) {
  return {static_cast<float>(0.5 + 0.4 * p.x), static_cast<float>(0.5 + 0.4 * p.y),
          static_cast<float>(0.5 + 0.4 * p.z), 1};
}

template <class Color>
void paintVertices(TriangleMesh& mesh, const Color& color) {
  mesh.colors.clear();
  for (const Vec3d& p : mesh.positions) mesh.colors.push_back(color(p));
}

Vec3d middle(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
}

/// An example and what its field contours to.
struct Sample {
  TriangleMesh example;
  DistanceField field;
  TriangleMesh result;

  Sample(TriangleMesh mesh, int resolution) : example(std::move(mesh)) {
    field = meshToSdf(example, {.resolution = resolution, .padding = 3});
    result = fieldToMesh(field);
  }
};

double colorError(const std::array<float, 4>& a, const std::array<float, 4>& b) {
  double worst = 0;
  for (int k = 0; k < 4; ++k) worst = std::max(worst, double{std::abs(a[k] - b[k])});
  return worst;
}

TEST(TransferAppearance, IdentityOriginsGiveTheExamplesColorsBack) {
  TriangleMesh box = makeBox({{-1, -1, -1}, {1, 1, 1}});
  paintVertices(box, colorAt);
  Sample s(box, 32);
  transferAppearance(s.result, s.field, identityOrigins(s.field.size()), s.example, s.field);
  validate(s.result, "result");
  ASSERT_TRUE(s.result.hasColors());
  // The colors are linear over each face, and where the surface is flat the nearest point is the
  // foot: exact but for the result's own distance from the face, below a tenth of a voxel (0.0063)
  // away from the box's edges.
  for (std::size_t v = 0; v < s.result.positions.size(); ++v) {
    const Vec3d& p = s.result.positions[v];
    const double nearEdge = 1 - 2 * s.field.voxelSize;
    const int inner =
        (std::abs(p.x) < nearEdge) + (std::abs(p.y) < nearEdge) + (std::abs(p.z) < nearEdge);
    ASSERT_LT(colorError(s.result.colors[v], colorAt(p)), inner >= 2 ? 0.003 : 0.03);
  }
}

TEST(TransferAppearance, ShiftedOriginsBringTheColorsAlong) {
  TriangleMesh ball = makeSphere({}, 1, 16);
  paintVertices(ball, colorAt);
  Sample s(ball, 32);
  // The same samples in a larger field, moved by whole cells.
  const Vec3i shift{4, 7, 2};
  DistanceField field = s.field;
  field.origin = {10, 20, 30};
  field.values = Array3D<float>(s.field.size() + Vec3i{9, 9, 9}, s.field.truncation);
  Origins origins(field.size());
  for (std::size_t n = 0; n < s.field.values.count(); ++n) {
    const Vec3i c = s.field.values.ijk(n);
    field.values[c + shift] = s.field.values.values()[n];
    origins[c + shift] = Origin(c);
  }
  TriangleMesh result = fieldToMesh(field);
  transferAppearance(result, field, origins, s.example, s.field);
  for (std::size_t v = 0; v < result.positions.size(); ++v) {
    const Vec3d there = s.field.position(field.index(result.positions[v]) - cast<double>(shift));
    ASSERT_LT(colorError(result.colors[v], colorAt(there)), 0.01);
  }
}

TEST(TransferAppearance, QuarterTurnsTurnTheColors) {
  TriangleMesh box = makeBox({{-1, -0.6, -0.5}, {1, 0.6, 0.5}});
  paintVertices(box, colorAt);
  Sample s(box, 36);
  for (int turns = 0; turns < 4; ++turns) {
    const Vec3i n = s.field.size();
    DistanceField field = s.field;
    field.values = Array3D<float>(turns % 2 ? Vec3i{n.y, n.x, n.z} : n);
    field.origin = {0, 0, 0};
    Origins origins(field.size());
    for (std::size_t m = 0; m < s.field.values.count(); ++m) {
      const Vec3i c = s.field.values.ijk(m);
      Vec3i to = turned(c, turns);
      if (turns == 1 || turns == 2) to.x += field.size().x - 1;
      if (turns == 2 || turns == 3) to.y += field.size().y - 1;
      field.values[to] = s.field.values.values()[m];
      origins[to] = Origin(c, 0, turns);
    }
    TriangleMesh result = fieldToMesh(field);
    transferAppearance(result, field, origins, s.example, s.field);
    const Vec3d middleHere = field.box().center(), middleThere = s.field.box().center();
    for (std::size_t v = 0; v < result.positions.size(); ++v) {
      const Vec3d there = middleThere + turned(result.positions[v] - middleHere, -turns);
      // Half a voxel is 0.028: the most the bevel of an edge takes from the color's 0.4 a unit.
      ASSERT_LT(colorError(result.colors[v], colorAt(there)), 0.02);
    }
  }
}

/// A ball in two materials by octants: 1 where x y z > 0.
TriangleMesh checkerBall(int frequency) {
  TriangleMesh ball = makeSphere({}, 1, frequency);
  ball.materials.resize(2);
  ball.materials[0].name = "dark";
  ball.materials[1].name = "light";
  for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
    const Vec3d p = middle(ball, t);
    ball.triangleMaterials.push_back(p.x * p.y * p.z > 0);
  }
  return ball;
}

TEST(TransferAppearance, MaterialsLieWhereTheyLieOnTheExample) {
  Sample s(checkerBall(60), 48);
  const std::vector<Vec3d> before = s.result.positions;
  for (const bool cut : {false, true}) {
    TriangleMesh result = s.result;
    transferAppearance(result, s.field, identityOrigins(s.field.size()), s.example, s.field,
                       {.cutBorders = cut});
    validate(result, "result");
    EXPECT_EQ(result.materials, s.example.materials);
    expectSound(result);
    // Borders run along the example's triangles, of sides up to 0.021, whose middles were painted;
    // uncut, also along the result's, with middles up to 0.03 from their corners. A border moves by
    // up to a tenth of a side.
    const double clear = cut ? 0.024 : 0.05;
    for (std::size_t t = 0; t < result.triangles.size(); ++t) {
      const Vec3d p = middle(result, t);
      if (std::min({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < clear) continue;
      ASSERT_EQ(result.triangleMaterials[t], p.x * p.y * p.z > 0)
          << p.x << " " << p.y << " " << p.z;
    }
    // The surface is where it was.
    for (std::size_t v = 0; v < before.size(); ++v) ASSERT_EQ(result.positions[v], before[v]);
    EXPECT_NEAR(meshHealth(result).signedVolume, meshHealth(s.result).signedVolume, 1e-9);
  }
}

/// Two balls in an example, the second 30 voxels along x from the first, each of its own material.
Sample twoBalls() {
  TriangleMesh mesh = makeSphere({0, 0, 0}, 1, 16);
  append(mesh, makeSphere({3, 0, 0}, 1, 16));
  mesh.materials.resize(2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    mesh.triangleMaterials.push_back(middle(mesh, t).x > 1.5);
  }
  Sample s{mesh, 50};
  s.field = meshToSdf(mesh, {.voxelSize = 0.1, .padding = 3});
  return s;
}

/// One ball of `twoBalls`, its samples from `border` on taken from the other one; cut off above
/// `height` samples.
std::pair<DistanceField, Origins> halfAndHalf(const Sample& s, int border, int height = 26) {
  DistanceField field = s.field;
  field.values = Array3D<float>({26, 26, height});
  Origins origins(field.size());
  for (std::size_t n = 0; n < origins.count(); ++n) {
    const Vec3i c = origins.ijk(n);
    const Vec3i from = c + Vec3i{c.x >= border ? 30 : 0, 0, 0};
    origins.values()[n] = Origin(from);
    field.values.values()[n] = s.field.values[from];
  }
  return {field, origins};
}

TEST(TransferAppearance, ABallFromTwoBallsHasOneMaterial) {
  const Sample s = twoBalls();
  for (const auto& [border, height] :
       {std::pair{17, 26}, std::pair{9, 26}, std::pair{15, 12}, std::pair{13, 26}}) {
    const auto [field, origins] = halfAndHalf(s, border, height);
    TriangleMesh result = fieldToMesh(field);
    transferAppearance(result, field, origins, s.example, s.field);
    ASSERT_EQ(result.triangleMaterials.size(), result.triangles.size());
    const std::uint32_t first = result.triangleMaterials.front();
    // The larger part's, where one is clearly larger.
    if (border != 13) {
      EXPECT_EQ(first, border < 13) << border;
    }
    for (const std::uint32_t m : result.triangleMaterials) ASSERT_EQ(m, first) << border;
  }
}

TEST(TransferAppearance, BallsThatTouchKeepTheirMaterials) {
  // Two whole balls, their centers 19 voxels apart: one from each of the example's.
  const Sample s = twoBalls();
  DistanceField field = s.field;
  field.values = Array3D<float>({45, 26, 26});
  Origins origins(field.size());
  for (std::size_t n = 0; n < origins.count(); ++n) {
    const Vec3i c = origins.ijk(n);
    const bool second = c.x >= 13 + 9.5;
    const Vec3i from = c + Vec3i{second ? 30 - 19 : 0, 0, 0};
    origins.values()[n] = Origin(from);
    field.values.values()[n] = s.field.values[from];
  }
  TriangleMesh result = fieldToMesh(field);
  transferAppearance(result, field, origins, s.example, s.field);
  for (std::size_t t = 0; t < result.triangles.size(); ++t) {
    const double x = field.index(middle(result, t)).x - (12.5 + 9.5);
    if (std::abs(x) > 1) {
      ASSERT_EQ(result.triangleMaterials[t], x > 0) << x;
    }
  }
}

TEST(TransferAppearance, OneMaterialForAllIsGivenToAll) {
  TriangleMesh ball = makeSphere({}, 1, 8);
  ball.materials.resize(3);
  ball.triangleMaterials.assign(ball.triangles.size(), 2);
  Sample s(ball, 16);
  transferAppearance(s.result, s.field, identityOrigins(s.field.size()), s.example, s.field);
  for (const std::uint32_t m : s.result.triangleMaterials) EXPECT_EQ(m, 2u);
  EXPECT_EQ(s.result.triangleMaterials.size(), s.result.triangles.size());
}

TEST(TransferAppearance, AThinWallKeepsItsTwoSidesApart) {
  // 1.2 voxels thick, red above and blue below.
  TriangleMesh wall = makeBox({{0, 0, 0}, {3, 3, 0.12}});
  wall.materials.resize(2);
  for (std::size_t t = 0; t < wall.triangles.size(); ++t) {
    wall.triangleMaterials.push_back(normalized(areaNormal(wall, t)).z > 0.5);
  }
  DistanceField field = meshToSdf(wall, {.voxelSize = 0.1, .padding = 3});
  TriangleMesh result = fieldToMesh(field);
  transferAppearance(result, field, identityOrigins(field.size()), wall, field);
  int above = 0;
  for (std::size_t t = 0; t < result.triangles.size(); ++t) {
    const double up = normalized(areaNormal(result, t)).z;
    const Vec3d p = middle(result, t);
    if (std::min({p.x, p.y, 3 - p.x, 3 - p.y}) < 0.2) continue;
    ASSERT_EQ(result.triangleMaterials[t], up > 0) << up;
    above += up > 0;
  }
  EXPECT_GT(above, 100);
}

TEST(TransferAppearance, ColorsRunSmoothlyAcrossASeam) {
  // A rod painted along its length; its right half comes from 0.5 further left: a jump of 0.2.
  TriangleMesh rod = makeCapsule({-1, 0, 0}, {1, 0, 0}, 0.4, 48);
  // The color must be linear along the rod's triangles, which reach from end to end.
  paintVertices(rod, colorAt);
  Sample s(rod, 56);
  Origins origins = identityOrigins(s.field.size());
  const int shift = 10, seam = s.field.size().x / 2;
  DistanceField field = s.field;
  for (std::size_t n = 0; n < origins.count(); ++n) {
    const Vec3i c = origins.ijk(n);
    if (c.x < seam) continue;
    const Vec3i from = origins.clamped(c - Vec3i{shift, 0, 0});
    origins.values()[n] = Origin(from);
    field.values[c] = s.field.values[from];
  }
  TriangleMesh result = fieldToMesh(field);
  const auto steepest = [&](double blend) {
    transferAppearance(result, field, origins, s.example, s.field, {.blend = blend});
    double worst = 0;
    for (const auto& t : result.triangles) {
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t a = t[c], b = t[(c + 1) % 3];
        if (std::abs(field.index(result.positions[a]).x - seam) > 5) continue;
        worst = std::max(worst, std::abs(double{result.colors[a][0]} - result.colors[b][0]) /
                                    length(result.positions[a] - result.positions[b]));
      }
    }
    return worst * field.voxelSize;
  };
  const double jump = 0.4 * shift * field.voxelSize;
  // Over a ramp of about 2 (blend + 0.5) voxels the steepest step is twice the mean one.
  EXPECT_LT(steepest(2), 0.55 * jump);
  EXPECT_LT(steepest(3.5), 0.8 * steepest(1));
}

TEST(TransferAppearance, SamplesInTheAirHaveNoSay) {
  // Origins of everything two samples above the surface name a far corner.
  TriangleMesh ball = makeSphere({}, 1, 16);
  paintVertices(ball, colorAt);
  Sample s(ball, 32);
  Origins origins = identityOrigins(s.field.size());
  for (std::size_t n = 0; n < origins.count(); ++n) {
    if (s.field.values.values()[n] > 0.3 * s.field.voxelSize)
      origins.values()[n] = Origin(Vec3i{0, 0, 0});
  }
  transferAppearance(s.result, s.field, origins, s.example, s.field);
  for (std::size_t v = 0; v < s.result.positions.size(); ++v) {
    ASSERT_LT(colorError(s.result.colors[v], colorAt(s.result.positions[v])), 0.05);
  }
}

/// A picture of 64 x 64 texels: red along u, green along v.
std::string rampPng() {
  Image8 image{64, 64, 3, {}};
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      for (const int value : {4 * x + 2, 4 * (63 - y) + 2, 128}) {
        image.pixels.push_back(static_cast<std::uint8_t>(value));
      }
    }
  }
  const auto path = std::filesystem::temp_directory_path() /
                    ("exemplar_transfer_test_" + std::to_string(getpid()) + ".png");
  writePng(path, image);
  const std::string bytes = readFile(path);
  std::filesystem::remove(path);
  return bytes;
}

/// A cube with one square of the texture for each face, side by side with space between them.
TriangleMesh texturedCube() {
  TriangleMesh cube = makeBox({{-1, -1, -1}, {1, 1, 1}});
  cube.textures = {{"ramp.png", "image/png", rampPng()}};
  cube.materials.resize(1);
  cube.materials[0].baseColor = {1, 1, 1, 1};
  cube.materials[0].baseColorTexture = 0;
  for (std::size_t t = 0; t < cube.triangles.size(); ++t) {
    const Vec3d n = normalized(areaNormal(cube, t));
    const int axis = std::abs(n.x) > 0.5 ? 0 : std::abs(n.y) > 0.5 ? 1 : 2;
    const int face = 2 * axis + (n[axis] > 0);
    std::array<Vec2f, 3> uvs;
    for (int c = 0; c < 3; ++c) {
      const Vec3d& p = cube.positions[cube.triangles[t][c]];
      const double u = p[(axis + 1) % 3] * 0.5 + 0.5, v = p[(axis + 2) % 3] * 0.5 + 0.5;
      uvs[c] = {static_cast<float>((face % 3 + 0.1 + 0.8 * u) / 3),
                static_cast<float>((face / 3 + 0.1 + 0.8 * v) / 2)};
    }
    cube.uvs.push_back(uvs);
    cube.triangleMaterials.push_back(0);
  }
  return cube;
}

TEST(TransferAppearance, TextureCoordinatesStayInsideOneChartForEachTriangle) {
  Sample s(texturedCube(), 32);
  transferAppearance(s.result, s.field, identityOrigins(s.field.size()), s.example, s.field);
  validate(s.result, "result");
  ASSERT_TRUE(s.result.hasUvs());
  EXPECT_EQ(s.result.textures.size(), 1u);
  EXPECT_EQ(s.result.materials[0].baseColorTexture, 0u);
  const float slack = 1e-4f;
  for (const auto& corners : s.result.uvs) {
    // The faces' squares are thirds and halves of the texture with a margin that belongs to none.
    const int column = static_cast<int>(corners[0].x * 3), row = static_cast<int>(corners[0].y * 2);
    for (const Vec2f& uv : corners) {
      ASSERT_GE(uv.x * 3 - static_cast<float>(column), 0.1f - slack);
      ASSERT_LE(uv.x * 3 - static_cast<float>(column), 0.9f + slack);
      ASSERT_GE(uv.y * 2 - static_cast<float>(row), 0.1f - slack);
      ASSERT_LE(uv.y * 2 - static_cast<float>(row), 0.9f + slack);
    }
  }
}

TEST(TransferAppearance, TextureCoordinatesAreTheExamplesWhereItIsFlat) {
  Sample s(texturedCube(), 32);
  transferAppearance(s.result, s.field, identityOrigins(s.field.size()), s.example, s.field);
  int checked = 0;
  for (std::size_t t = 0; t < s.result.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const Vec3d& p = s.result.positions[s.result.triangles[t][c]];
      if (p.z < 0.999 || std::abs(p.x) > 0.8 || std::abs(p.y) > 0.8) continue;
      // Face 5, of +z: u along x, v along y.
      const Vec2f& uv = s.result.uvs[t][c];
      ASSERT_NEAR(uv.x, (2.1 + 0.8 * (p.x * 0.5 + 0.5)) / 3, 1e-5);
      ASSERT_NEAR(uv.y, (1.1 + 0.8 * (p.y * 0.5 + 0.5)) / 2, 1e-5);
      ++checked;
    }
  }
  EXPECT_GT(checked, 500);
}

/// A sheet of one material in two squares of a texture that meet along a line which runs askew to
/// the grid: the picture goes on to it from both sides, without teeth.
TEST(TransferAppearance, ChartsEndWhereTheyEndOnTheExample) {
  const auto beyond = [](const Vec3d& p) { return p.x + 0.37 * p.y > 0.11; };
  TriangleMesh sheet = makeBox({{-1, -1, -0.3}, {1, 1, 0.3}});
  const auto border = [](double y) { return 0.11 - 0.37 * y; };
  sheet.positions.clear();
  sheet.triangles.clear();
  for (const double z : {-0.3, 0.3}) {
    for (const double y : {-1.0, 1.0})
      for (const double x : {-1.0, border(y), 1.0}) sheet.positions.push_back({x, y, z});
  }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    sheet.triangles.push_back({a, b, c});
    sheet.triangles.push_back({a, c, d});
  };
  for (const std::uint32_t x : {0u, 1u}) {
    quad(x, x + 3, x + 4, x + 1);       // below
    quad(x + 6, x + 7, x + 10, x + 9);  // above
    quad(x, x + 1, x + 7, x + 6);       // the near side
    quad(x + 3, x + 9, x + 10, x + 4);  // the far one
  }
  quad(0, 6, 9, 3);
  quad(2, 5, 11, 8);
  const auto uvAt = [](const Vec3d& p, bool right) {
    return Vec2f{static_cast<float>(0.2 * p.x + (right ? 0.75 : 0.25)),
                 static_cast<float>(0.2 * p.y + 0.5)};
  };
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    auto& corners = sheet.uvs.emplace_back();
    for (int c = 0; c < 3; ++c)
      corners[c] = uvAt(sheet.positions[sheet.triangles[t][c]], beyond(middle(sheet, t)));
  }
  sheet.materials.resize(1);
  sheet.triangleMaterials.assign(sheet.triangles.size(), 0);

  Sample s(sheet, 40);
  ASSERT_TRUE(meshHealth(s.example).closed());
  const std::size_t before = s.result.triangles.size();
  transferAppearance(s.result, s.field, identityOrigins(s.field.size()), s.example, s.field);
  validate(s.result, "result");
  EXPECT_TRUE(meshHealth(s.result).closed());
  EXPECT_GT(s.result.triangles.size(), before);
  // Borders nearer to a vertex than a tenth of a side, which is a diagonal at most, go through it.
  const auto slack = static_cast<float>(0.2 * 0.15 * s.field.voxelSize);
  int checked = 0;
  for (std::size_t t = 0; t < s.result.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const Vec3d& p = s.result.positions[s.result.triangles[t][c]];
      if (std::abs(p.z) < 0.299 || std::abs(p.x) > 0.9 || std::abs(p.y) > 0.9) continue;
      const Vec2f uv = s.result.uvs[t][c], expected = uvAt(p, uv.x > 0.5f);
      ASSERT_NEAR(uv.x, expected.x, slack);
      ASSERT_NEAR(uv.y, expected.y, slack);
      ++checked;
    }
  }
  EXPECT_GT(checked, 2000);
}

TEST(TransferAppearance, TexturesCanBeBakedIntoVertices) {
  Sample s(texturedCube(), 32);
  transferAppearance(s.result, s.field, identityOrigins(s.field.size()), s.example, s.field,
                     {.textures = TextureTransfer::VertexColors});
  validate(s.result, "result");
  EXPECT_FALSE(s.result.hasUvs());
  EXPECT_TRUE(s.result.textures.empty());
  EXPECT_FALSE(s.result.materials[0].baseColorTexture);
  ASSERT_TRUE(s.result.hasColors());
  // On the +z face red and green grow with x and y.
  for (std::size_t v = 0; v < s.result.positions.size(); ++v) {
    const Vec3d& p = s.result.positions[v];
    if (p.z < 0.999 || std::abs(p.x) > 0.8 || std::abs(p.y) > 0.8) continue;
    const double srgb = (2.1 + 0.8 * (p.x * 0.5 + 0.5)) / 3;
    ASSERT_NEAR(s.result.colors[v][0], std::pow((srgb + 0.055) / 1.055, 2.4), 0.02);
  }
}

TEST(TransferAppearance, CoordinatesAreKeptWithoutATextureAsWithOne) {
  TriangleMesh cube = texturedCube();
  Sample with(cube, 16);
  cube.textures.clear();
  cube.materials[0].baseColorTexture.reset();
  Sample s(cube, 16);
  const auto transfer = [](Sample& sample, TextureTransfer textures) {
    transferAppearance(sample.result, sample.field, identityOrigins(sample.field.size()),
                       sample.example, sample.field, {.textures = textures});
  };
  transfer(with, TextureTransfer::Automatic);
  transfer(s, TextureTransfer::Automatic);
  ASSERT_TRUE(s.result.hasUvs());
  EXPECT_EQ(s.result.uvs, with.result.uvs);
  EXPECT_EQ(s.result.positions, with.result.positions);
  EXPECT_TRUE(s.result.hasMaterials());
  transfer(s, TextureTransfer::Drop);
  EXPECT_FALSE(s.result.hasUvs());

  // Nor do they need a material.
  cube.materials.clear();
  cube.triangleMaterials.clear();
  Sample bare(cube, 16);
  transfer(bare, TextureTransfer::Automatic);
  EXPECT_EQ(bare.result.uvs, with.result.uvs);
  EXPECT_FALSE(bare.result.hasMaterials());
}

/// The place of an example that a source names.
Vec3d placeOf(const TriangleMesh& example, const SourcePoint& source) {
  const auto& [a, b, c] = example.triangles.at(source.triangle);
  const double u = source.weights[0], v = source.weights[1];
  return example.positions[a] * u + example.positions[b] * v + example.positions[c] * (1 - u - v);
}

TEST(TransferAppearance, SourcesNameThePlacesThatEverythingComesFrom) {
  for (const bool textured : {true, false}) {
    TriangleMesh cube = texturedCube();
    if (!textured) cube.uvs.clear();
    Sample s(cube, 24);
    transferAppearance(s.result, s.field, identityOrigins(s.field.size()), s.example, s.field,
                       {.sources = true});
    ASSERT_EQ(s.result.sources.size(), s.result.triangles.size());
    EXPECT_EQ(s.result.hasUvs(), textured);
    for (std::size_t t = 0; t < s.result.triangles.size(); ++t) {
      for (int c = 0; c < 3; ++c) {
        const SourcePoint& source = s.result.sources[t][c];
        EXPECT_EQ(source.example, 0u);
        const Vec3d& p = s.result.positions[s.result.triangles[t][c]];
        // A contour is within a voxel of its example, and corners keep inside their triangle's
        // chart, the diagonal of a voxel away at most.
        EXPECT_LT(length(placeOf(cube, source) - p), 2 * s.field.voxelSize);
        if (!textured) continue;
        const Vec2f* uv = cube.uvs[source.triangle].data();
        const float u = source.weights[0], v = source.weights[1], w = 1 - u - v;
        EXPECT_NEAR(s.result.uvs[t][c].x, u * uv[0].x + v * uv[1].x + w * uv[2].x, 1e-5);
        EXPECT_NEAR(s.result.uvs[t][c].y, u * uv[0].y + v * uv[1].y + w * uv[2].y, 1e-5);
      }
    }
    transferAppearance(s.result, s.field, identityOrigins(s.field.size()), s.example, s.field);
    EXPECT_TRUE(s.result.sources.empty()) << "unless they are asked for";
  }
}

TEST(TransferAppearance, MaterialsKeepWhatTheirFileSaid) {
  TriangleMesh cube = texturedCube();
  cube.materials[0].source = std::make_shared<MaterialSource>(
      MaterialSource{MaterialSource::Format::Gltf, R"({"material":{"doubleSided":true}})"});
  cube.materials[0].pictures = {0};
  cube.materials[0].baseColorTexture.reset();
  Sample s(cube, 16);
  const auto transfer = [&](TextureTransfer textures) {
    transferAppearance(s.result, s.field, identityOrigins(s.field.size()), s.example, s.field,
                       {.textures = textures});
    validate(s.result, "result");
  };
  transfer(TextureTransfer::Automatic);
  EXPECT_EQ(s.result.materials, cube.materials);
  EXPECT_TRUE(s.result.hasUvs()) << "maps need coordinates as the base color's texture does";
  EXPECT_EQ(s.result.textures.size(), 1u);
  transfer(TextureTransfer::Drop);
  EXPECT_FALSE(s.result.materials[0].source);
  EXPECT_TRUE(s.result.textures.empty());
  // Without coordinates the rest of it stays.
  s.example.uvs.clear();
  transfer(TextureTransfer::Automatic);
  EXPECT_EQ(s.result.materials, cube.materials);
}

TEST(TransferAppearance, CoordinatesThatAreTheSameEverywhereAreDropped) {
  TriangleMesh cube = texturedCube();
  cube.textures.clear();
  cube.materials[0].baseColorTexture.reset();
  cube.uvs.assign(cube.triangles.size(), {Vec2f{0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}});
  Sample s(cube, 16);
  transferAppearance(s.result, s.field, identityOrigins(s.field.size()), s.example, s.field);
  EXPECT_FALSE(s.result.hasUvs());
}

TEST(TransferAppearance, SeveralExamplesBringTheirOwn) {
  TriangleMesh red = makeSphere({}, 1, 10), blue = makeBox({{-1, -1, -1}, {1, 1, 1}});
  red.materials.resize(1);
  red.materials[0].name = "red";
  red.triangleMaterials.assign(red.triangles.size(), 0);
  blue.materials.resize(1);
  blue.materials[0].name = "blue";
  blue.triangleMaterials.assign(blue.triangles.size(), 0);
  const DistanceField redField = meshToSdf(red, {.voxelSize = 0.1, .padding = 3});
  const DistanceField blueField = meshToSdf(blue, {.voxelSize = 0.1, .padding = 3});
  // Left the ball, right the box.
  DistanceField field = redField;
  const int half = redField.size().x;
  ASSERT_EQ(redField.size(), blueField.size());
  field.values = Array3D<float>({2 * half, half, half});
  Origins origins(field.size());
  for (std::size_t n = 0; n < origins.count(); ++n) {
    const Vec3i c = origins.ijk(n);
    const int example = c.x >= half;
    const Vec3i from = c - Vec3i{example * half, 0, 0};
    origins.values()[n] = Origin(from, example);
    field.values[c] = example ? blueField.values[from] : redField.values[from];
  }
  TriangleMesh result = fieldToMesh(field);
  const std::array<ExampleView, 2> examples{ExampleView{red, redField}, {blue, blueField}};
  transferAppearance(result, field, origins, examples);
  ASSERT_EQ(result.materials.size(), 2u);
  for (std::size_t t = 0; t < result.triangles.size(); ++t) {
    const bool right = field.index(middle(result, t)).x > half - 0.5;
    ASSERT_EQ(result.materials[result.triangleMaterials[t]].name, right ? "blue" : "red");
  }
  EXPECT_THAT([&] { transferAppearance(result, field, origins, red, redField); },
              ThrowsMessage<InputError>(HasSubstr("example 2")));
}

TEST(TransferAppearance, APlainExampleLeavesAPlainResult) {
  Sample s(makeSphere({}, 1, 6), 12);
  s.result.colors.assign(s.result.positions.size(), {1, 0, 0, 1});
  transferAppearance(s.result, s.field, identityOrigins(s.field.size()), s.example, s.field);
  EXPECT_FALSE(s.result.hasColors() || s.result.hasUvs() || s.result.hasMaterials());
  validate(s.result, "result");
}

TEST(TransferAppearance, IsTheSameAtAnyNumberOfThreads) {
  TriangleMesh ball = checkerBall(20);
  paintVertices(ball, colorAt);
  Sample s(ball, 32);
  TriangleMesh one = s.result, eight = s.result;
  const Origins origins = identityOrigins(s.field.size());
  tbb::task_arena(1).execute(
      [&] { transferAppearance(one, s.field, origins, s.example, s.field); });
  tbb::task_arena(8).execute(
      [&] { transferAppearance(eight, s.field, origins, s.example, s.field); });
  EXPECT_EQ(one.colors, eight.colors);
  EXPECT_EQ(one.triangleMaterials, eight.triangleMaterials);
  EXPECT_EQ(one.positions, eight.positions);
}

TEST(TransferAppearance, BadInputIsRefused) {
  TriangleMesh ball = makeSphere({}, 1, 4);
  paintVertices(ball, colorAt);
  Sample s(ball, 10);
  EXPECT_THAT(
      [&] {
        transferAppearance(s.result, s.field, Origins({3, 3, 3}), s.example, s.field);
      },
      ThrowsMessage<InputError>(HasSubstr("origins")));
  const Origins origins = identityOrigins(s.field.size());
  EXPECT_THAT(
      [&] { transferAppearance(s.result, s.field, origins, s.example, s.field, {.blend = 9}); },
      ThrowsMessage<InputError>(HasSubstr("`blend` is 9")));
  EXPECT_THAT(
      [&] {
        transferAppearance(s.result, s.field, origins, s.example, s.field, {.materialRounds = -1});
      },
      ThrowsMessage<InputError>(HasSubstr("`materialRounds` is -1")));
}

}  // namespace
}  // namespace exemplar
