// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/mtl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace exemplar {
namespace {

TEST(Mtl, NumbersComeBackExactly) {
  std::vector<MtlEntry> materials(2);
  Material& rich = materials[0].material;
  rich.name = "a b";
  rich.baseColor = {0.1f, 1 / 3.0f, 1e-7f, 0.3f};
  rich.metallic = 0.7f;
  rich.roughness = 0.123f;
  rich.emission = {12.5f, 0, 1 / 7.0f};
  materials[0].baseColorFile = "pictures/a b.png";
  materials[1].material.name = "plain";
  const std::vector<MtlMaterial> read = parseMtl(formatMtl(materials), "f.mtl");
  ASSERT_EQ(read.size(), 2u);
  for (int m = 0; m < 2; ++m) {
    EXPECT_EQ(read[m].material, materials[m].material);
    EXPECT_EQ(read[m].baseColorFile, materials[m].baseColorFile);
  }
}

TEST(Mtl, SkipsTheOptionsOfMaps) {
  const auto file = [](const std::string& line) {
    return parseMtl("newmtl a\nmap_Kd " + line + "\n", "f.mtl")[0].baseColorFile;
  };
  EXPECT_EQ(file("wall.png"), "wall.png");
  EXPECT_EQ(file("two words.png  "), "two words.png");
  EXPECT_EQ(file("-s 2 2 2 -o 0.5 -clamp on wall.png"), "wall.png");
  EXPECT_EQ(file("-s 2 wall.png"), "wall.png");
  EXPECT_EQ(file("-mm 0 1 -bm 0.5 wall.png"), "wall.png");
  EXPECT_EQ(file("-s"), "");
}

// Where a picture goes is marked by a byte of its own, which a file may hold, too.
TEST(Mtl, IsNotMisledByControlCharacters) {
  for (const char* text : {"newmtl m\nab\x7f"
                           "9 1\nKd 1 0 0\n",
                           "newmtl m\nab 1 \x7f"
                           "9\n",
                           "newmtl m\nab\x01"
                           "c\x7f\n"}) {
    const auto materials = parseMtl(text, "f.mtl");
    ASSERT_EQ(materials.size(), 1u);
    EXPECT_EQ(withPictureNumbers(materials[0].lines, {}), materials[0].lines);
  }
}

TEST(Mtl, ReadsOlderConventions) {
  const auto material = [](const std::string& lines) {
    return parseMtl("# made by hand\nKd 9 9 9\nnewmtl a\n" + lines, "f.mtl")[0].material;
  };
  EXPECT_EQ(material("Tr 0.25\n").baseColor[3], 0.75f);
  EXPECT_EQ(material("d -halo 0.5\n").baseColor[3], 1.0f);
  EXPECT_EQ(material("Kd 0.5\n").baseColor[2], 0.5f);
  EXPECT_EQ(material("Kd spectral file.rfl\n").baseColor[0], 0.8f);
  EXPECT_EQ(material("Ns 250\n").roughness, 0.5f);
  EXPECT_EQ(material("Pr 0.25\nNs 0\n").roughness, 0.25f) << "Pr holds, in whatever order";
  EXPECT_EQ(material("Ns 0\nPr 0.25\n").roughness, 0.25f);
}

TEST(Mtl, NamesTheLineOfWhatIsWrongAndGoesOn) {
  Warnings warnings;
  const auto read = parseMtl("newmtl a\n\nKd 1 red 0\nPr 0.25\n", "f.mtl", &warnings);
  EXPECT_THAT(warnings, testing::ElementsAre("f.mtl:3: the diffuse color should be a number, not "
                                             "'red'; the line is left out"));
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].material.baseColor, Material{}.baseColor);
  EXPECT_EQ(read[0].material.roughness, 0.25f);
}

TEST(Mtl, ColorsMayCountTo255) {
  const auto read = parseMtl("newmtl a\nKd 255 0 51\n", "f.mtl");
  EXPECT_EQ(read[0].material.baseColor, (std::array<float, 4>{1, 0, 51 / 255.0f, 1}));
}

}  // namespace
}  // namespace exemplar
