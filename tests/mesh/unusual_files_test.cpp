// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Files as people have them: what other programs write, at the edge of the formats and beyond.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "core/error.h"
#include "core/file.h"
#include "mesh/color.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_health.h"
#include "mesh/mtl.h"
#include "mesh_samples.h"

namespace exemplar {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A box of 2 x 3 x 4: eight vertices and six quads, each line with something behind it.
std::string boxVertices(const std::string& begin, const std::string& tail = "") {
  std::string text;
  for (int v = 0; v < 8; ++v) {
    const int x = v % 4 == 1 || v % 4 == 2 ? 2 : 0, y = v % 4 >= 2 ? 3 : 0, z = v >= 4 ? 4 : 0;
    text +=
        begin + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + tail + "\n";
  }
  return text;
}
constexpr int kQuads[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                              {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
std::string boxFaces(const std::string& begin, int first, const std::string& tail = "") {
  std::string text;
  for (const auto& quad : kQuads) {
    text += begin;
    for (int c = 0; c < 4; ++c) text += (c ? " " : "") + std::to_string(quad[c] + first);
    text += tail + "\n";
  }
  return text;
}
std::string objFaces(const std::string& tail = "") { return boxFaces("f ", 1, tail); }

/// The same text with other line ends.
std::string withLineEnds(std::string text, const std::string& end) {
  for (std::size_t i = 0; (i = text.find('\n', i)) != std::string::npos; i += end.size())
    text.replace(i, 1, end);
  return text;
}

std::string asUtf16(const std::string& text, bool big) {
  std::string bytes = big ? "\xfe\xff" : "\xff\xfe";
  for (const char c : text) {
    if (big) bytes += '\0';
    bytes += c;
    if (!big) bytes += '\0';
  }
  return bytes;
}

void expectBox(const TriangleMesh& mesh, const std::string& what) {
  const MeshHealth health = meshHealth(mesh);
  EXPECT_EQ(health.vertices, 8) << what;
  EXPECT_EQ(health.triangles, 12) << what;
  EXPECT_TRUE(health.closed() && health.manifold() && health.oriented()) << what;
  EXPECT_DOUBLE_EQ(health.signedVolume, 24) << what;
}

struct Read {
  TriangleMesh mesh;
  Warnings warnings;
};
Read read(const std::string& ending, const std::string& bytes, bool withSiblings = true) {
  Read result;
  result.mesh = parse(ending, bytes, withSiblings, &result.warnings);
  for (const std::string& line : result.warnings) {
    EXPECT_TRUE(line.starts_with("f" + ending + ":")) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
  return result;
}

const std::array<std::uint8_t, 4> kRed{255, 0, 0, 255};

TEST(UnusualText, EncodingsAndLineEndsMakeNoDifference) {
  const std::string obj = boxVertices("v ") + objFaces();
  const std::string off = "OFF\n8 6 0\n" + boxVertices("") + boxFaces("4 ", 0);
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n" +
      boxVertices("") + boxFaces("4 ", 0);
  std::string stl = "solid box\n";
  const TriangleMesh box = parse(".obj", obj);
  for (const auto& triangle : box.triangles) {
    stl += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t v : triangle) {
      const Vec3d& p = box.positions[v];
      stl += "vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
             std::to_string(p.z) + "\n";
    }
    stl += "endloop\nendfacet\n";
  }
  stl += "endsolid box\n";
  const std::pair<std::string, std::string> files[] = {
      {".obj", obj}, {".off", off}, {".ply", ply}, {".stl", stl}};
  for (const auto& file : files) {
    const std::string& ending = file.first;
    const std::string& text = file.second;
    const auto check = [&](const std::string& bytes, const std::string& what) {
      const Read r = read(ending, bytes);
      expectBox(r.mesh, ending + " " + what);
      EXPECT_THAT(r.warnings, IsEmpty()) << ending << " " << what;
    };
    check(text, "as it is");
    check("\xef\xbb\xbf" + text, "with a byte-order mark");
    check(asUtf16(text, false), "in UTF-16, little-endian");
    check(asUtf16(text, true), "in UTF-16, big-endian");
    check(withLineEnds(text, "\r\n"), "with CR LF");
    check(withLineEnds(text, "\r"), "with CR");
    check(withLineEnds(text, "\r\r\n"), "with CR CR LF");
    check(text + std::string("\x1a\0\0\n\n", 5), "with trailing bytes");
    if (ending != ".ply") check("\n  \n \t" + text, "with blanks in front");
  }
}

TEST(UnusualObj, CommentsMayFollowData) {
  for (const char* tail : {" # side", "\t#side", " #", "# glued"}) {
    const Read r = read(".obj", boxVertices("v ", tail) + objFaces(tail));
    expectBox(r.mesh, tail);
    EXPECT_THAT(r.warnings, IsEmpty());
  }
  // A material's name may hold '#'; only the library distinguishes it from a comment.
  const std::string faces = "usemtl a # the red one\n" + objFaces();
  const Read r = read(".obj", "mtllib m.mtl # materials\n" + boxVertices("v ") + faces);
  ASSERT_EQ(r.mesh.materials.size(), 1u);
  EXPECT_EQ(r.mesh.materials[0].name, "a");
  EXPECT_EQ(r.mesh.materials[0].baseColor[1], 0.25f);
  EXPECT_EQ(read(".obj", boxVertices("v ") + faces).mesh.materials[0].name, "a # the red one");
}

TEST(UnusualObj, FacesMayComeBeforeTheirVertices) {
  expectBox(read(".obj", objFaces() + boxVertices("v ")).mesh, "all faces first");
  // In between: what is known already and what is not keep the file's order and materials.
  const Read r = read(".obj",
                      "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 4\nusemtl c\n"
                      "f -3 -2 -1\nv 0 0 1\nf -1 -2 -3\n");
  EXPECT_EQ(r.mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{
                                  {0, 1, 2}, {0, 1, 3}, {0, 1, 2}, {3, 2, 1}}));
  EXPECT_EQ(r.mesh.materials[r.mesh.triangleMaterials[1]].name, "b");
  EXPECT_EQ(r.mesh.materials[r.mesh.triangleMaterials[2]].name, "c");
}

TEST(UnusualObj, FacesWithFewerThanThreeCornersAreLeftOut) {
  const Read r = read(".obj", boxVertices("v ") + objFaces() + "f 1 2\nf 3\nf\n");
  expectBox(r.mesh, "with an edge as a face");
  EXPECT_THAT(r.warnings, ElementsAre("f.obj: leaving out 3 faces with fewer than three corners"));
}

TEST(UnusualObj, MissingTextureCoordinatesAndNormalsDoNotMatter) {
  const std::string face = "f 1/1/1 4/4/4 3/3/3\n";
  Read r = read(".obj", boxVertices("v ") + face);
  EXPECT_FALSE(r.mesh.hasUvs());
  EXPECT_THAT(r.warnings,
              ElementsAre(HasSubstr("texture coordinates that the file does not have")));
  r = read(".obj",
           boxVertices("v ") + "vt 0.5 0.25\nvt nan 0\n" + "f 1/1 4/4 3/-1\nf 1/-9 2/0 3/1\n");
  ASSERT_TRUE(r.mesh.hasUvs());
  EXPECT_EQ(r.mesh.uvs[0][0], (Vec2f{0.5f, 0.25f}));
  EXPECT_EQ(r.mesh.uvs[0][1], (Vec2f{0, 0}));
  EXPECT_EQ(r.mesh.uvs[0][2], (Vec2f{0, 0})) << "NaN";
  EXPECT_EQ(r.warnings.size(), 2u);
}

TEST(UnusualObj, VertexColorsMayCountTo255) {
  const float half = srgb8ToLinear(128);
  for (const char* color : {" 255 0 128", " 255 0 128 255", " 255.0 0.0 128.0 1"}) {
    const Read r = read(".obj", boxVertices("v ", color) + objFaces());
    EXPECT_EQ(r.mesh.colors[5], (std::array<float, 4>{1, 0, half, 1})) << color;
  }
  // Every number at most 1: they count to 1, and 1 1 1 is white.
  EXPECT_EQ(read(".obj", boxVertices("v ", " 1 1 0") + objFaces()).mesh.colors[0],
            (std::array<float, 4>{1, 1, 0, 1}));
  // A dark color of a file that counts to 255, and a vertex without one.
  const Read r = read(".obj", "v 0 0 0 1 1 1\nv 1 0 0 200 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(r.mesh.colors[0][0], srgb8ToLinear(1));
  EXPECT_EQ(r.mesh.colors[2], (std::array<float, 4>{1, 1, 1, 1}));
}

TEST(UnusualObj, WhatIsNotThereIsSaid) {
  const std::string body = boxVertices("v ") + "usemtl a\n" + objFaces();
  EXPECT_THAT(read(".obj", "mtllib none.mtl\n" + body).warnings,
              ElementsAre("f.obj: its material library none.mtl is not found; materials keep their "
                          "names only"));
  EXPECT_THAT(read(".obj", "mtllib m.mtl\n" + body).warnings, IsEmpty());
  const auto withLibrary = [&](const std::string& library) {
    Read r;
    const MeshSource source{.name = "f.obj",
                            .sibling = [&](const std::string& name) -> std::optional<std::string> {
                              if (name == "l.mtl") return library;
                              if (name == "t.tga") return std::string("\0\0\2", 3);
                              if (name == "t.png") return tinyPng();
                              return std::nullopt;
                            },
                            .warnings = &r.warnings};
    r.mesh = parseObj("mtllib l.mtl\n" + body, source);
    validate(r.mesh, "f.obj");
    return r;
  };
  Read r = withLibrary("newmtl a\nmap_Kd t.tga\n");
  EXPECT_THAT(r.warnings,
              ElementsAre("f.obj: the texture t.tga is neither PNG nor JPEG: it is copied with its "
                          "material, and not shown"));
  EXPECT_FALSE(r.mesh.materials[0].baseColorTexture);
  EXPECT_THAT(withLibrary("newmtl a\nmap_Kd gone.png\n").warnings,
              ElementsAre("f.obj: the texture gone.png is not found and is left out"));
  // Light comes with its map or not at all.
  EXPECT_EQ(withLibrary("newmtl a\nmap_Kd \"t.png\"\n").mesh.textures.size(), 1u) << "in quotes";
  r = withLibrary("newmtl a\nKe 1 1 1\nmap_Ke t.png\nmap_Bump -bm 1 t.png\nMAP_KD t.png # x\n");
  EXPECT_EQ(r.mesh.materials[0].emission, (Vec3f{0, 0, 0}));
  EXPECT_TRUE(r.mesh.materials[0].baseColorTexture.has_value());
  EXPECT_THAT(r.warnings, IsEmpty()) << "other maps are kept with the material";
  EXPECT_THAT(withLibrary("newmtl other\nmap_Bump t.png\nnewmtl a\nKd 1 0 0\n").warnings, IsEmpty())
      << "no face uses that one";
  // A bad line costs that line only.
  r = withLibrary("newmtl m\nnewmtl a\nKd 1 0 0\nNs nan\nNi\nd \nPr x\n");
  EXPECT_EQ(r.mesh.materials[0].baseColor, (std::array<float, 4>{1, 0, 0, 1}));
  EXPECT_EQ(r.mesh.materials[0].roughness, Material{}.roughness);
  EXPECT_THAT(r.warnings, ElementsAre(AllOf(HasSubstr("f.obj: l.mtl:4: "), HasSubstr("left out")),
                                      HasSubstr("f.obj: l.mtl:6: the opacity is missing"),
                                      HasSubstr("f.obj: l.mtl:7: ")));
}

TEST(UnusualObj, FilesBesideItAreFoundWhateverTheirCapitals) {
  const TestFolder folder("capitals");
  writeFile(folder / "m.obj", "mtllib Wall.MTL\n" + boxVertices("v ") + "usemtl a\n" + objFaces());
  writeFile(folder / "wall.mtl", "newmtl a\nmap_Kd Brick.PNG\n");
  writeFile(folder / "brick.png", tinyPng());
  Warnings warnings;
  EXPECT_EQ(readMesh(folder / "m.obj", {.warnings = &warnings}).textures.size(), 1u);
  EXPECT_THAT(warnings, IsEmpty());
}

std::string plyHeader(const std::string& vertexMore, const std::string& faceMore,
                      const std::string& comment = "") {
  return "ply\nformat ascii 1.0\n" + comment +
         "element vertex 8\nproperty float x\nproperty float y\nproperty float z\n" + vertexMore +
         "element face 6\nproperty list uchar int vertex_indices\n" + faceMore + "end_header\n";
}

TEST(UnusualPly, NotANumberMattersOnlyWhereItIsUsed) {
  const std::string normals = "property float nx\nproperty float ny\nproperty float nz\n";
  for (const char* nan : {" nan nan nan", " -nan(ind) -1.#IND 0", " 1.#QNAN 1e999 inf"}) {
    expectBox(read(".ply", plyHeader(normals, "") + boxVertices("", nan) + boxFaces("4 ", 0)).mesh,
              nan);
  }
  std::string bad = plyHeader(normals, "") + boxVertices("", " 0 0 1") + boxFaces("4 ", 0);
  bad.replace(bad.find("end_header\n0") + 11, 1, "-1.#IND");
  try {
    parse(".ply", bad);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "f.ply:13: vertex 0 has a NaN or infinite coordinate");
  }
}

TEST(UnusualFiles, VerticesWithoutAPlaceMatterOnlyWhereAFaceNamesThem) {
  // As scanners write points that they did not see; the box's own vertices come first.
  const std::string nan = "nan nan nan\n";
  std::string ply = plyHeader("", "");
  ply.replace(ply.find("vertex 8"), 8, "vertex 9");
  const std::pair<std::string, std::string> files[] = {
      {".obj", boxVertices("v ") + "v " + nan + objFaces()},
      {".off", "OFF\n9 6 0\n" + boxVertices("") + nan + boxFaces("4 ", 0)},
      {".ply", ply + boxVertices("") + "1.#QNAN -1.#IND inf\n" + boxFaces("4 ", 0)}};
  for (const auto& [ending, text] : files) {
    const Read r = read(ending, text);
    EXPECT_EQ(meshHealth(r.mesh).signedVolume, 24) << ending;
    EXPECT_THAT(r.warnings, ElementsAre(HasSubstr("which no face uses, are left out: 1")))
        << ending;
    std::string used = text;
    used.replace(used.rfind(ending == ".obj" ? '8' : '7'), 1, ending == ".obj" ? "9" : "8");
    EXPECT_THROW(parse(ending, used), InputError) << ending;
  }
}

TEST(UnusualFiles, ColorsThatAreNaNAreNone) {
  const std::array<std::uint8_t, 4> white{255, 255, 255, 255};
  const auto check = [&](const std::string& ending, const std::string& text) {
    std::string broken = text;
    broken.replace(broken.find("255 0 0"), 3, "nan");
    const Read r = read(ending, broken);
    EXPECT_THAT(r.warnings, ElementsAre(HasSubstr("colors that are NaN are left out"))) << ending;
    EXPECT_EQ(toRgba8(r.mesh.colors[5]), kRed) << ending;
    if (ending != ".off") {
      EXPECT_EQ(toRgba8(r.mesh.colors[0]), white) << ending;
    }
  };
  check(".obj", boxVertices("v ", " 255 0 0") + objFaces());
  check(".off", "COFF\n8 6 0\n" + boxVertices("", " 255 0 0") + boxFaces("4 ", 0));
  check(".ply", plyHeader("property float red\nproperty float green\nproperty float blue\n", "") +
                    boxVertices("", " 255 0 0") + boxFaces("4 ", 0));
}

TEST(UnusualPly, TexturesAreNamedInComments) {
  const std::string uvs = "property list uchar float texcoord\n";
  const std::string faces = boxFaces("4 ", 0, " 8 0 0 1 0 1 1 0 1");
  Read r =
      read(".ply", plyHeader("", uvs, "comment TextureFile t.png\n") + boxVertices("") + faces);
  expectBox(r.mesh, "textured");
  ASSERT_EQ(r.mesh.textures.size(), 1u);
  EXPECT_EQ(r.mesh.textures[0].bytes, tinyPng());
  ASSERT_EQ(r.mesh.materials.size(), 1u);
  EXPECT_EQ(r.mesh.materials[0].baseColorTexture, 0u);
  EXPECT_EQ(r.mesh.materials[0].baseColor, (std::array<float, 4>{1, 1, 1, 1}));
  EXPECT_THAT(r.warnings, IsEmpty());
  r = read(".ply", plyHeader("", uvs, "comment TextureFile gone.png\n") + boxVertices("") + faces);
  EXPECT_THAT(r.warnings, ElementsAre("f.ply: the texture gone.png is not found and is left out"));
  EXPECT_FALSE(r.mesh.hasMaterials());
  // Several pictures, and which one a face shows.
  r = read(".ply", plyHeader("", uvs + "property int texnumber\n",
                             "comment TextureFile gone.png\ncomment texturefile t.png\n") +
                       boxVertices("") + boxFaces("4 ", 0, " 8 0 0 1 0 1 1 0 1 1"));
  ASSERT_EQ(r.mesh.materials.size(), 2u);
  EXPECT_EQ(r.mesh.triangleMaterials, std::vector<std::uint32_t>(12, 1));
  EXPECT_EQ(r.mesh.materials[1].baseColorTexture, 0u);
}

TEST(UnusualPly, FacesMayComeBeforeVerticesAndShortOnesAreLeftOut) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement face 7\nproperty list uchar int vertex_index\nproperty uchar "
      "red\nproperty uchar green\nproperty uchar blue\nelement vertex 8\nproperty float "
      "x\nproperty "
      "float y\nproperty float z\nend_header\n" +
      boxFaces("4 ", 0, " 255 0 0") + "2 0 1 9 9 9\n" + boxVertices("");
  const Read r = read(".ply", text);
  expectBox(r.mesh, "faces first");
  ASSERT_EQ(r.mesh.materials.size(), 1u) << "the left-out face's color is none";
  EXPECT_EQ(toRgba8(r.mesh.materials[0].baseColor), kRed);
  EXPECT_THAT(r.warnings, ElementsAre("f.ply: leaving out 1 face with fewer than three corners"));
}

TEST(UnusualPly, ColorsOfAnyTypeCountToWhatTheyCountTo) {
  const auto colorOf = [](const std::string& type, const std::string& color) {
    std::string properties;
    for (const char* name : {"red", "green", "blue", "alpha"})
      properties += "property " + type + " " + name + "\n";
    return toRgba8(
        parse(".ply", plyHeader(properties, "") + boxVertices("", color) + boxFaces("4 ", 0))
            .colors[3]);
  };
  const std::array<std::uint8_t, 4> wanted{255, 0, 128, 255};
  EXPECT_EQ(colorOf("uchar", " 255 0 128 255"), wanted);
  EXPECT_EQ(colorOf("float", " 1 0 0.502 1"), wanted);
  EXPECT_EQ(colorOf("float", " 255 0 128 255"), wanted);
  EXPECT_EQ(colorOf("double", " 255 0 128 1"), wanted);
  EXPECT_EQ(colorOf("ushort", " 65535 0 32896 65535"), wanted);
  EXPECT_EQ(colorOf("ushort", " 255 0 128 255"), wanted);
  EXPECT_EQ(colorOf("int", " 255 0 128 255"), wanted);
}

TEST(UnusualPly, ABinaryBodyBeginsRightAfterALoneReturn) {
  // The first byte of the body is a line feed, which is no part of the header's last line end.
  std::string bytes = withLineEnds(
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar "
      "y\nproperty uchar z\nelement face 1\nproperty list uchar uchar vertex_indices\nend_header\n",
      "\r");
  bytes += std::string("\x0a\0\0\0\1\0\0\0\1\3\0\1\2", 13);
  EXPECT_EQ(parse(".ply", bytes).positions[0], (Vec3d{10, 0, 0}));
}

std::string binaryStl(const std::string& header, const std::vector<std::uint16_t>& flags) {
  std::string bytes = format(".stl", parse(".obj", boxVertices("v ") + objFaces()));
  bytes.replace(0, 80, std::string(80, ' ')).replace(0, header.size(), header);
  for (std::size_t t = 0; t < flags.size(); ++t) {
    bytes[84 + 50 * t + 48] = static_cast<char>(flags[t] & 255);
    bytes[84 + 50 * t + 49] = static_cast<char>(flags[t] >> 8);
  }
  return bytes;
}

TEST(UnusualStl, ColorsOfMagicsAndVisCamAreRead) {
  std::vector<std::uint16_t> flags(12, 31);  // red in the lowest bits
  flags[3] = 0x8000;                         // Magics: as the header says
  const TriangleMesh magics =
      parse(".stl", binaryStl(std::string("COLOR=\x00\xff\x00\xff", 10), flags));
  expectBox(magics, "Magics");
  ASSERT_EQ(magics.materials.size(), 2u);
  EXPECT_EQ(toRgba8(magics.materials[magics.triangleMaterials[0]].baseColor), kRed);
  EXPECT_EQ(toRgba8(magics.materials[magics.triangleMaterials[3]].baseColor),
            (std::array<std::uint8_t, 4>{0, 255, 0, 255}));
  // VisCAM: red in the highest bits, with a flag.
  const TriangleMesh visCam =
      parse(".stl", binaryStl("", std::vector<std::uint16_t>(12, 0x8000 | 31 << 10)));
  ASSERT_EQ(visCam.materials.size(), 1u);
  EXPECT_EQ(toRgba8(visCam.materials[0].baseColor), kRed);
  // A header's color alone; and bits without the flag, which mean nothing.
  const TriangleMesh whole =
      parse(".stl", binaryStl("COLOR=\xff\x80\x01\xff", std::vector<std::uint16_t>(12, 0)));
  EXPECT_EQ(toRgba8(whole.materials[0].baseColor), (std::array<std::uint8_t, 4>{255, 128, 1, 255}));
  EXPECT_FALSE(parse(".stl", binaryStl("", std::vector<std::uint16_t>(12, 7))).hasMaterials());
}

TEST(UnusualStl, WhatIsTextShowsInTheContent) {
  expectBox(parse(".stl", binaryStl("solid box", {})), "a binary file called solid");
  expectBox(parse(".stl", binaryStl("solid box", {}) + "tail"), "with trailing bytes");
  expectBox(parse(".stl", binaryStl("solid facet", {}) + "tail"), "and a word of text");
  const std::string facet =
      "FACET NORMAL nan -1.#IND 0 OUTER LOOP VERTEX 0 0 0 VERTEX 1 0 0 VERTEX 0 1 0 ENDLOOP "
      "ENDFACET ";
  EXPECT_EQ(parse(".stl", "SOLID big letters\n" + facet + "\nENDSOLID\n").triangles.size(), 1u);
  EXPECT_EQ(parse(".stl", " \r\n solid x " + facet + facet + "endsolid x").triangles.size(), 2u)
      << "all on one line";
  EXPECT_EQ(parse(".stl", "solid my facet thing\n" + facet + "endsolid").triangles.size(), 1u)
      << "a name with a word of text";
  EXPECT_THROW(parse(".stl", binaryStl("solid box", {}).substr(0, 600)), InputError);
  std::string colored = facet;
  colored.insert(colored.find("OUTER"), "color 1 0 0 ");
  const Read r = read(".stl", "solid x\n" + colored + "endsolid x\n");
  EXPECT_THAT(r.warnings, ElementsAre(HasSubstr("colors of facets in text")));
}

TEST(UnusualStl, AHeaderMayNotKnowHowManyTrianglesFollow) {
  for (const char byte : {'\0', '\xff'}) {
    const Read r = read(".stl", binaryStl("", {}).replace(80, 4, 4, byte));
    expectBox(r.mesh, "without a count");
    EXPECT_THAT(r.warnings, ElementsAre(HasSubstr("all 12 are read")));
    EXPECT_THROW(parse(".stl", binaryStl("", {}).replace(80, 4, 4, byte).substr(0, 600)),
                 InputError);
  }
}

TEST(UnusualStl, WhatItsFloatsLoseIsSaid) {
  const TestFolder folder("far_stl");
  TriangleMesh mesh = plainTorus();
  const auto warningsOf = [&](const char* name) {
    Warnings warnings;
    writeMesh(folder / name, mesh, {.warnings = &warnings});
    return warnings;
  };
  EXPECT_THAT(warningsOf("near.stl"), IsEmpty());
  for (Vec3d& p : mesh.positions) p += Vec3d{500000.25, 4649776.5, 1200};
  EXPECT_THAT(warningsOf("far.stl"), ElementsAre(HasSubstr("far.stl: coordinates are so far")));
  EXPECT_THAT(warningsOf("far.glb"), IsEmpty());
  EXPECT_THAT(warningsOf("far.obj"), IsEmpty());
}

TEST(UnusualOff, TheFirstWordMayBeMissing) {
  for (const char* begin :
       {"8 6 0\n", "8 6\n", "# a box\n8 6 12\n", "off\n8 6 0\n", "OFF8 6 0\n"}) {
    expectBox(read(".off", begin + boxVertices("") + boxFaces("4 ", 0, " # side")).mesh, begin);
  }
}

TEST(UnusualOff, ColorsComeBeforeNormalsOrBehindThem) {
  const auto colorOf = [](const std::string& kind, const std::string& row) {
    const Read r = read(".off", kind + "\n8 6 0\n" + boxVertices("", row) + boxFaces("4 ", 0));
    expectBox(r.mesh, kind + row);
    return toRgba8(r.mesh.colors[2]);
  };
  EXPECT_EQ(colorOf("NCOFF", " 255 0 0 255 0 0 1"), kRed) << "MeshLab";
  EXPECT_EQ(colorOf("NCOFF", " 255 0 0 0 -1 0"), kRed) << "MeshLab without alpha";
  EXPECT_EQ(colorOf("CNOFF", " 0 0 1 255 0 0 255"), kRed) << "Geomview";
  EXPECT_EQ(colorOf("CNOFF", " 0 -0.6 0.8 1 0 0 1"), kRed) << "Geomview, to 1";
  EXPECT_EQ(colorOf("COFF", " 255 0 0 255"), kRed);
}

TEST(UnusualOff, NumbersThatNothingAnnouncesAreSaid) {
  Read r = read(".off", "OFF\n8 6 0\n" + boxVertices("", " 255 0 0") + boxFaces("4 ", 0));
  expectBox(r.mesh, "colors without COFF");
  EXPECT_THAT(r.warnings, ElementsAre(HasSubstr("numbers after a vertex's coordinates")));
  r = read(".off", "OFF\n8 6 0\n" + boxVertices("") + boxFaces("4 ", 0, " 3"));
  expectBox(r.mesh, "colors by number");
  EXPECT_THAT(r.warnings, ElementsAre(HasSubstr("a table's rows")));
}

TEST(UnusualOff, PointsAndEdgesAmongItsFacesAreSaid) {
  const Read r =
      read(".off", "OFF\n8 8 0\n" + boxVertices("") + boxFaces("4 ", 0) + "2 0 1\n1 3\n");
  expectBox(r.mesh, "with an edge and a point");
  EXPECT_THAT(r.warnings, ElementsAre("f.off: faces with fewer than three corners are left out"));
}

}  // namespace
}  // namespace exemplar
