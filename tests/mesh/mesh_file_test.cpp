// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>

#include "core/error.h"
#include "core/file.h"
#include "mesh/color.h"
#include "mesh/mesh_health.h"
#include "mesh_samples.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

const std::vector<std::string> kEndings{".obj", ".ply", ".stl", ".off", ".glb"};

bool operator==(const Texture& a, const Texture& b) {
  return a.name == b.name && a.mimeType == b.mimeType && a.bytes == b.bytes;
}

TriangleMesh writtenAndRead(const TriangleMesh& mesh, const std::string& ending,
                            const MeshFileOptions& options = {}) {
  const TestFolder folder("round_trip");
  writeMesh(folder / ("m" + ending), mesh, options);
  return readMesh(folder / ("m" + ending), options);
}

std::string complaint(const std::string& ending, const std::string& bytes) {
  try {
    parse(ending, bytes);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

/// Not inline: GCC 12 takes a pair of neighboring roundings to float and back for no change.
[[gnu::noinline]] double roundedToFloat(double x) { return static_cast<float>(x); }

/// The corners of all triangles as coordinates, rounded to float where `asFloat`.
std::vector<std::array<Vec3d, 3>> soup(const TriangleMesh& mesh, bool asFloat) {
  std::vector<std::array<Vec3d, 3>> out;
  for (const auto& triangle : mesh.triangles) {
    auto& corners = out.emplace_back();
    for (int c = 0; c < 3; ++c) {
      const Vec3d p = mesh.positions[triangle[c]];
      corners[c] =
          asFloat ? Vec3d{roundedToFloat(p.x), roundedToFloat(p.y), roundedToFloat(p.z)} : p;
    }
  }
  return out;
}

class EveryFormat : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(MeshFile, EveryFormat, testing::ValuesIn(kEndings),
                         [](const auto& format) { return format.param.substr(1); });

TEST_P(EveryFormat, KeepsTrianglesInOrderAndTheMeshClosed) {
  const TriangleMesh torus = plainTorus();
  const TriangleMesh read = writtenAndRead(torus, GetParam());
  const bool asFloat = GetParam() == ".stl" || GetParam() == ".glb";
  EXPECT_TRUE(soup(read, false) == soup(torus, asFloat));
  EXPECT_EQ(read.positions.size(), torus.positions.size());
  EXPECT_TRUE(meshHealth(read).closed());
  EXPECT_GT(meshHealth(read).signedVolume, 0) << "turned inside out";
  EXPECT_FALSE(read.hasColors() || read.hasUvs() || read.hasMaterials());
  EXPECT_TRUE(read.materials.empty());
}

TEST_P(EveryFormat, KeepsTheUpAxisWhicheverWayItIsWritten) {
  for (const UpAxis up : {UpAxis::Default, UpAxis::Y, UpAxis::Z}) {
    const TriangleMesh torus = plainTorus();
    const TriangleMesh read = writtenAndRead(torus, GetParam(), {.up = up});
    EXPECT_TRUE(soup(read, true) == soup(torus, true));
  }
}

TEST_P(EveryFormat, GivesTheSameBytesEachTime) {
  EXPECT_EQ(format(GetParam(), fullMesh()), format(GetParam(), fullMesh()));
}

TEST_P(EveryFormat, LeavesNothingBehindWhenItCannotWrite) {
  const TestFolder folder("cannot_write");
  TriangleMesh broken = plainTorus();
  broken.positions[3].x = NAN;
  EXPECT_THROW(writeMesh(folder / ("m" + GetParam()), broken), InputError);
  EXPECT_THROW(writeMesh(folder / ("none/m" + GetParam()), plainTorus()), InputError);
  EXPECT_TRUE(fs::is_empty(folder / ""));
}

TEST_P(EveryFormat, RefusesAnEmptyFileByName) {
  const TestFolder folder("empty");
  const fs::path path = folder / ("m" + GetParam());
  std::ofstream(path).close();
  try {
    readMesh(path);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), StartsWith(path.string() + ": "));
    EXPECT_THAT(e.what(), HasSubstr("empty"));
  }
}

TEST(MeshFile, ObjAndGlbAreYUpAndTheOthersZUp) {
  const TriangleMesh torus = plainTorus();  // flat along z: its box is 5.4 x 5.4 x 1.4
  for (const std::string& ending : kEndings) {
    const TriangleMesh inFile = parse(ending, format(ending, torus));
    EXPECT_LT(boundingBox(inFile).size().z, 2) << "format() writes z up";
    const TestFolder folder("up");
    writeMesh(folder / ("m" + ending), torus);
    const Vec3d size = boundingBox(parse(ending, readFile(folder / ("m" + ending)))).size();
    const bool yUp = ending == ".obj" || ending == ".glb";
    EXPECT_LT(yUp ? size.y : size.z, 2) << ending;
  }
}

TEST(MeshFile, OnlyKnownEndingsAreMeshFiles) {
  for (const char* name : {"a.obj", "a.PLY", "a.Stl", "b/c.off", "x.glb", "y.gltf"})
    EXPECT_TRUE(isMeshFile(name));
  for (const char* name : {"a", "a.gltf.gz", "obj", ".obj", "a.obj.gz"})
    EXPECT_FALSE(isMeshFile(name));
  try {
    readMesh("a.fbx");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("use .obj, .ply, .stl, .off, .glb or .gltf"));
  }
}

TEST(MeshFile, EverythingSurvivesObj) {
  const TriangleMesh full = fullMesh(), read = writtenAndRead(full, ".obj");
  EXPECT_EQ(read.positions, full.positions);
  EXPECT_EQ(read.triangles, full.triangles);
  EXPECT_EQ(read.colors, full.colors);
  EXPECT_EQ(read.uvs, full.uvs);
  EXPECT_EQ(read.triangleMaterials, full.triangleMaterials);
  EXPECT_EQ(read.materials, full.materials);
  ASSERT_EQ(read.textures.size(), 1u);
  EXPECT_EQ(read.textures[0].name, "brick_wall.png") << "blanks do not survive in file names";
  EXPECT_EQ(read.textures[0].mimeType, "image/png");
  EXPECT_EQ(read.textures[0].bytes, tinyPng());
}

TEST(MeshFile, EverythingSurvivesGlb) {
  const TriangleMesh full = fullMesh(), read = writtenAndRead(full, ".glb");
  EXPECT_EQ(read.positions, full.positions) << "vertices split for texture coordinates are joined";
  EXPECT_EQ(read.triangles, full.triangles);
  EXPECT_EQ(read.colors, full.colors);
  EXPECT_EQ(read.uvs, full.uvs);
  EXPECT_EQ(read.triangleMaterials, full.triangleMaterials);
  EXPECT_EQ(read.materials, full.materials);
  EXPECT_TRUE(std::equal(read.textures.begin(), read.textures.end(), full.textures.begin(),
                         full.textures.end(), [](const auto& a, const auto& b) { return a == b; }));
}

TEST(MeshFile, AllButTexturesSurvivesPly) {
  TriangleMesh full = fullMesh();
  const TriangleMesh read = writtenAndRead(full, ".ply");
  EXPECT_EQ(read.positions, full.positions);
  EXPECT_EQ(read.triangles, full.triangles);
  EXPECT_EQ(read.colors, full.colors);
  EXPECT_EQ(read.uvs, full.uvs);
  EXPECT_EQ(read.triangleMaterials, full.triangleMaterials);
  full.materials[1].baseColorTexture.reset();
  EXPECT_EQ(read.materials, full.materials);
}

TEST(MeshFile, OffKeepsVertexColorsAndTheColorsOfMaterials) {
  const TriangleMesh full = fullMesh(), read = writtenAndRead(full, ".off");
  EXPECT_EQ(read.positions, full.positions);
  EXPECT_EQ(read.triangles, full.triangles);
  EXPECT_EQ(read.colors, full.colors);
  EXPECT_EQ(read.triangleMaterials, full.triangleMaterials);
  ASSERT_EQ(read.materials.size(), 2u);
  for (int m = 0; m < 2; ++m) {
    EXPECT_EQ(toRgba8(read.materials[m].baseColor), toRgba8(full.materials[m].baseColor));
  }
}

TEST(MeshFile, ColorsThatEightBitsCannotHoldSurviveObjAndGlbExactly) {
  TriangleMesh torus = plainTorus();
  for (std::size_t v = 0; v < torus.positions.size(); ++v) {
    const float c = static_cast<float>(v) / static_cast<float>(torus.positions.size());
    torus.colors.push_back({c, c * c, 1 - c, c});
  }
  EXPECT_EQ(writtenAndRead(torus, ".obj").colors, torus.colors);
  EXPECT_EQ(writtenAndRead(torus, ".glb").colors, torus.colors);
}

TEST(MeshFile, ObjColorsAreSrgb) {
  const TriangleMesh read =
      parse(".obj", "v 0 0 0 0.5 1 0\nv 1 0 0\nv 0 1 0 0 0 0 0.25\nf 1 2 3\n");
  // IEC 61966-2-1: sRGB 0.5 is linear 0.2140.
  EXPECT_NEAR(read.colors[0][0], 0.21404, 1e-5);
  EXPECT_EQ(read.colors[0][1], 1);
  EXPECT_EQ(read.colors[1], (std::array<float, 4>{1, 1, 1, 1})) << "no color is white";
  EXPECT_EQ(read.colors[2][3], 0.25f);
}

TEST(MeshFile, GlbColorsAreLinear) {
  TriangleMesh mesh = plainTorus();
  mesh.colors.assign(mesh.positions.size(), {0.5f, 0.25f, 1, 1});
  const std::string bytes = format(".glb", mesh);
  const std::size_t json = bytes.find('{');
  EXPECT_THAT(bytes.substr(json, 400), HasSubstr("\"COLOR_0\":2"));
  const float half = 0.5f, quarter = 0.25f;
  std::string pair(8, '\0');
  std::memcpy(pair.data(), &half, 4);
  std::memcpy(pair.data() + 4, &quarter, 4);
  EXPECT_NE(bytes.find(pair), std::string::npos) << "the floats are in the file as they are";
}

TEST(MeshFile, AnObjWithTexturesDoesNotOverwriteOtherPictures) {
  const TestFolder folder("textures");
  writeFile(folder / "brick_wall.png", "mine");
  writeMesh(folder / "castle.obj", fullMesh());
  EXPECT_EQ(readFile(folder / "brick_wall.png"), "mine");
  EXPECT_EQ(readFile(folder / "castle_brick_wall.png"), tinyPng());
  EXPECT_THAT(readFile(folder / "castle.mtl"), HasSubstr("map_Kd castle_brick_wall.png\n"));
}

TEST(MeshFile, FindsATextureByNameWhenItsFolderIsAnotherMachines) {
  const TestFolder folder("far_texture");
  writeFile(folder / "m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  writeFile(folder / "m.mtl", "newmtl a\nmap_Kd C:\\art\\brick.png\n");
  EXPECT_TRUE(readMesh(folder / "m.obj").textures.empty()) << "missing is no error";
  writeFile(folder / "brick.png", "not a picture");
  EXPECT_TRUE(readMesh(folder / "m.obj").textures.empty());
  writeFile(folder / "brick.png", tinyPng());
  const TriangleMesh mesh = readMesh(folder / "m.obj");
  ASSERT_EQ(mesh.textures.size(), 1u);
  EXPECT_EQ(mesh.textures[0].name, "brick.png");
  EXPECT_EQ(mesh.materials[0].baseColorTexture, 0u);
}

TEST(MeshFile, ObjMaterialsWithOneNameStayApart) {
  TriangleMesh full = fullMesh();
  full.materials[0].name = full.materials[1].name = "line\nbreak";
  const TriangleMesh read = writtenAndRead(full, ".obj");
  ASSERT_EQ(read.materials.size(), 2u);
  EXPECT_EQ(read.materials[0].name, "line_break");
  EXPECT_EQ(read.materials[1].name, "line_break_2");
  EXPECT_EQ(read.materials[0].roughness, full.materials[0].roughness);
}

TEST(MeshFile, ReadsWhatOtherProgramsWriteAsObj) {
  const std::string text =
      "\xef\xbb\xbf# a comment\r\nmtllib m.mtl\r\no thing\r\n"
      "v 0 0 0\r\nv +1.0e0 0 0 1.0\r\nv 1 1 0\r\nv 0 1 0\r\nvt 0 0\r\nvt 1 0 0\r\nvt 1 1\r\nvn 0 0 "
      "1\r\n"
      "s off\r\nf 1 2 3 \\\r\n 4\r\nusemtl a\r\nf -4/-3/-1 -3/2/1 -2/3\r\nusemtl c d\r\nf 1//1 "
      "3//1 4//1\r\n";
  const TriangleMesh mesh = parse(".obj", text);
  ASSERT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.triangles[2], (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(mesh.uvs[2][1], (Vec2f{1, 0}));
  EXPECT_EQ(mesh.uvs[3][1], (Vec2f{0, 0}));
  ASSERT_EQ(mesh.materials.size(), 3u) << "of the library only what faces use";
  EXPECT_EQ(mesh.materials[0].name, "a");
  EXPECT_EQ(mesh.materials[0].baseColor, (std::array<float, 4>{0.5f, 0.25f, 0.125f, 0.5f}));
  EXPECT_TRUE(mesh.materials[0].baseColorTexture.has_value());
  EXPECT_EQ(mesh.materials[1].name, "c d") << "a name without a library";
  EXPECT_EQ(mesh.materials[2], Material{}) << "faces before the first usemtl";
  EXPECT_EQ(mesh.triangleMaterials, (std::vector<std::uint32_t>{2, 2, 0, 1}));
  EXPECT_EQ(parse(".obj", text, false).triangleMaterials, (std::vector<std::uint32_t>{2, 2, 0, 1}))
      << "without its .mtl the materials keep their names";
}

TEST(MeshFile, ObjSaysWhichObjectATriangleIsOf) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  // A face that names a vertex which comes later is added at the end, and keeps its object.
  const TriangleMesh two =
      parse(".obj", corners + "o tower\nf 1 2 5\no wall\nf 1 2 3 4\nv 2 2 2\no tower\nf 2 3 4\n");
  EXPECT_EQ(two.objects, (std::vector<std::string>{"", "tower", "wall"}));
  EXPECT_EQ(two.triangleObjects, (std::vector<std::uint32_t>{1, 2, 2, 1}));
  EXPECT_EQ(two.name, "");
  const TriangleMesh one = parse(".obj", corners + "o thing\nf 1 2 3 4\n");
  EXPECT_TRUE(one.objects.empty() && one.triangleObjects.empty());
  EXPECT_EQ(one.name, "thing");
}

TEST(MeshFile, ReadsWhatOtherProgramsWriteAsPly) {
  // Face before other elements, per-vertex texture coordinates, a quad, an element nobody knows.
  const TriangleMesh mesh = parse(
      ".ply",
      "ply\nformat ascii 1.0\ncomment hello\nobj_info x\nelement vertex 4\nproperty float32 x\n"
      "property float32 y\nproperty float32 z\nproperty uint8 red\nproperty uint8 green\n"
      "property uint8 blue\nproperty float s\nproperty float t\nelement thing 1\n"
      "property list uchar int stuff\nelement face 1\nproperty list uint8 int32 "
      "vertex_index\nend_header\n"
      "0 0 0 255 0 0 0 0\n1 0 0 0 255 0 1 0\n1 1 0 0 0 255 1 1\n\n0 1 0 128 128 128 0 1\n"
      "2 7 8\n4 0 1 2 3\n");
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.colors[0], (std::array<float, 4>{1, 0, 0, 1}));
  EXPECT_NEAR(mesh.colors[3][0], 0.21586, 1e-5) << "sRGB 128";
  EXPECT_EQ(mesh.uvs[0][2], (Vec2f{1, 1}));
}

TEST(MeshFile, ReadsBigEndianPlyAndTriangleStrips) {
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty short x\nproperty short y\n"
      "property double z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  const auto big = [&](std::uint64_t value, int size) {
    for (int i = size - 1; i >= 0; --i) bytes += static_cast<char>(value >> (8 * i) & 255);
  };
  for (int v = 0; v < 4; ++v) {
    big(static_cast<std::uint64_t>(v / 2), 2);
    big(static_cast<std::uint64_t>(-(v % 2)), 2);
    big(std::bit_cast<std::uint64_t>(0.1), 8);
  }
  big(8, 4);
  for (const int i : {0, 1, 2, 3, -1, 1, 0, 3}) big(static_cast<std::uint64_t>(i), 4);
  const TriangleMesh mesh = parse(".ply", bytes);
  EXPECT_EQ(mesh.positions[3], (Vec3d{1, -1, 0.1}));
  EXPECT_EQ(mesh.triangles,
            (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {2, 1, 3}, {1, 0, 3}}));
}

TEST(MeshFile, FaceColorsOfPlyBecomeMaterials) {
  const TriangleMesh mesh = parse(".ply",
                                  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float "
                                  "x\nproperty float y\nproperty float z\n"
                                  "element face 3\nproperty list uchar int "
                                  "vertex_indices\nproperty uchar red\nproperty uchar green\n"
                                  "property uchar blue\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 "
                                  "255 0 0\n3 0 2 1 0 255 0\n3 1 2 0 255 0 0\n");
  EXPECT_EQ(mesh.triangleMaterials, (std::vector<std::uint32_t>{0, 1, 0}));
  ASSERT_EQ(mesh.materials.size(), 2u);
  EXPECT_EQ(mesh.materials[1].baseColor, (std::array<float, 4>{0, 1, 0, 1}));
  EXPECT_EQ(mesh.materials[1].name, "color_00ff00ff");
}

TEST(MeshFile, ReadsAsciiStlAndJoinsVertices) {
  const TriangleMesh mesh =
      parse(".stl",
            "solid two words\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 0\n"
            "  vertex 1 0 -0\n  vertex 0 1 0\n endloop\nendfacet\nfacet normal 0 0 1\n"
            "outer loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\n"
            "endsolid two words\n");
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{1, 3, 2}));
}

TEST(MeshFile, ABinaryStlThatBeginsWithSolidIsStillBinary) {
  std::string bytes = format(".stl", plainTorus());
  bytes.replace(0, 5, "solid");
  EXPECT_EQ(parse(".stl", bytes).triangles.size(), plainTorus().triangles.size());
}

TEST(MeshFile, ReadsWhatOtherProgramsWriteAsOff) {
  const std::string faces = "3 0 1 2 255 0 0\n4 0 1 2 3 # a quad\n2 0 1\n";
  const TriangleMesh plain =
      parse(".off", "OFF # shape\n\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + faces);
  EXPECT_EQ(plain.triangles.size(), 3u);
  ASSERT_EQ(plain.materials.size(), 2u);
  EXPECT_EQ(plain.materials[0].baseColor, (std::array<float, 4>{1, 0, 0, 1}));
  EXPECT_EQ(parse(".off", "OFF4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + faces).triangles,
            plain.triangles);
  const TriangleMesh rich = parse(".off",
                                  "STCN"
                                  "OFF\n3 1 0\n0 0 0 0 0 1 0.5 0 0 1 0 0\n1 0 0 0 0 1 0 1 0 1 1 "
                                  "0\n0 1 0 0 0 1 0 0 1 1 1 1\n3 0 1 2\n");
  EXPECT_EQ(rich.uvs[0][2], (Vec2f{1, 1}));
  EXPECT_NEAR(rich.colors[0][0], 0.2159, 1e-4) << "colors in 0..1, in 8 bits";
}

TEST(MeshFile, MalformedTextNamesTheLine) {
  const struct {
    const char *ending, *bytes, *complaint;
  } cases[] = {
      {".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
       "f.obj:4: vertex 4 does not exist: the file has 3"},
      {".obj", "v 0 0 0\nf -1 -2 -1\n", "f.obj:2: vertex -2 does not exist"},
      {".obj", "v 0 0 0\nf 0 1 1\n", "f.obj:2: vertex 0 does not exist"},
      {".obj", "v 0 0\n", "f.obj:1: z is missing"},
      {".obj", "v 0 0 x1\n", "f.obj:1: z should be a number, not 'x1'"},
      {".obj", "v 0 0 1.5abc\n", "f.obj:1: z should be a number"},
      {".obj", "v 0 nan 0\n", "f.obj:1: the vertex has a NaN or infinite coordinate"},
      {".obj", "v 0 -inf 0\n", "f.obj:1: the vertex has a NaN or infinite coordinate"},
      {".obj", "v 0 1e400 0\n", "f.obj:1: y is too large"},
      {".obj", "v 0 0 1e16\n", "f.obj:1: the vertex has a coordinate of 1e15 or more"},
      {".obj", "v 0 0 0\nf 1 1\n", "f.obj: the mesh has no triangles"},
      {".obj", "f 1 2 3\nv 0 0 0\n", "f.obj:1: vertex 2 does not exist: the file has 1"},
      {".obj", "v 0 0 0\nf 1,2,3\n", "f.obj:2: a face's corner should be"},
      {".obj", "v 0 0 0\nf 99999999999999999999 1 1\n", "f.obj:2: vertex should be a whole number"},
      {".obj", "v 0 0 0\nv 1 1 1\n", "f.obj: the mesh has no triangles"},
      {".obj", "hello\n", "f.obj: the mesh has no triangles"},
      {".ply", "hello\n", "f.ply:1: not a PLY file"},
      {".ply", "ply\nformat binary 1.0\n", "f.ply:2: 'binary' is not a PLY format"},
      {".ply", "ply\nelement vertex -1\n", "f.ply:2: an element's count should not be negative"},
      {".ply", "ply\nproperty float x\n", "f.ply:2: a property comes before"},
      {".ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n",
       "no x, y and z"},
      {".ply",
       "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
       "property float z\nend_header\n0 0 0\n",
       "truncated: its header promises 4000000000"},
      {".ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 9000000000000000000\nproperty float "
       "x\n"
       "property float y\nproperty float z\nend_header\n0 0 0\n",
       "f.ply: the file is truncated"},
      {".ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
       "float z\n"
       "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n3 0 0 1\n",
       "f.ply:11: a face names vertex 1 of 1"},
      {".ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
       "float z\n"
       "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 nan\n3 0 0 0\n",
       "f.ply:10: vertex 0 has a NaN"},
      {".stl", "solid\nfacet\nvertex 0 0 0\nendfacet\n",
       "f.stl:4: a facet should have three vertices"},
      {".stl", "solid\nfacet\nvertex 0 0 inf\n", "f.stl:3: the vertex has a NaN or infinite"},
      {".stl", "solid\nhello\n", "f.stl:2: 'hello' is not a word of an STL file"},
      {".stl", "solid\nendsolid\n", "f.stl: the mesh has no triangles"},
      {".stl", "solid a\n", "f.stl:1: the file is truncated"},
      {".stl", "short", "f.stl: not an STL file"},
      {".off", "PLY\n", "f.off:1: not an OFF file"},
      {".off", "4OFF\n", "f.off:1: not an OFF file"},
      {".off", "OFF BINARY\n", "f.off:1: a binary OFF file"},
      {".off", "OFF\n1000000000 1 0\n0 0 0\n",
       "f.off:2: the file is truncated: it promises 1000000000"},
      {".off", "OFF\n1 1 0\n0 0 0\n3 0 0 1\n", "f.off:4: a face names vertex 1 of 1"},
      {".off", "OFF\n1 1 0\n0 0 0\n-3 0 0 1\n", "should not be negative"},
      {".off", "OFF\n1 0 0\n0 0 0\n", "f.off: the mesh has no triangles"},
      {".off", "OFF\n1 0 0\n0 nan 0\n", "f.off:3: the vertex has a NaN"},
  };
  for (const auto& c : cases) {
    EXPECT_THAT(complaint(c.ending, c.bytes), HasSubstr(c.complaint)) << c.bytes;
  }
}

TEST(MeshFile, ABinaryStlWithALyingCountIsTruncated) {
  std::string bytes = format(".stl", plainTorus());
  bytes[83] = '\x7f';
  EXPECT_THAT(complaint(".stl", bytes), HasSubstr("truncated: its header promises 21307"));
  bytes = format(".stl", plainTorus());
  bytes[84 + 12 + 3] = bytes[84 + 12 + 2] = '\xff';  // the first corner's x becomes NaN
  EXPECT_THAT(complaint(".stl", bytes), HasSubstr("triangle 0 has a NaN"));
}

TEST(MeshFile, ReadsRealMeshes) {
  const fs::path data = fs::path(EXEMPLAR_SOURCE_DIR) / "../shared/data";
  if (!fs::exists(data)) GTEST_SKIP() << "no real inputs beside the repository";
  int read = 0;
  for (const fs::path& folder : {data / "kaykit", data / "meshes"}) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (!isMeshFile(entry.path())) continue;
      const TriangleMesh mesh = readMesh(entry.path());
      EXPECT_TRUE(mesh.hasUvs() && mesh.hasMaterials()) << entry.path();
      EXPECT_EQ(mesh.materials.size(), 1u) << entry.path();
      EXPECT_GT(meshHealth(mesh).signedVolume, 0) << entry.path();
      ++read;
      for (const std::string& ending : kEndings) {
        const TriangleMesh again = writtenAndRead(mesh, ending);
        EXPECT_TRUE(soup(again, true) == soup(mesh, true)) << entry.path() << ending;
      }
    }
  }
  EXPECT_EQ(read, 10);
}

}  // namespace
}  // namespace exemplar
