// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/flat.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "synth/continuous/synthesize.h"
#include "tests/temporary_files.h"

namespace exemplar::continuous {
namespace {

const char* const kTriangle = R"(
kind = "solids"
flat = true
[[part]]
substance = "ink"
outline = [[0, 0], [4, 0], [2, 2]]
)";

/// The figures of the plane: those that do not depend on the ends of the prisms.
std::vector<Figure> flatFigures(const FigureSet& figures, const Centrals& centrals) {
  std::vector<Figure> flat;
  for (const Figure& figure : figures.all()) {
    bool upright = true;
    forEachFamily(figure.support, [&](int i) {
      upright = upright && centrals.normals()[static_cast<std::size_t>(i)].z == 0;
    });
    if (upright) flat.push_back(figure);
  }
  return flat;
}

std::vector<Figure> flatFiguresOf(const Solids& solids) {
  const Centrals centrals(normalsOf(planesOf(solids)));
  return flatFigures(extractFigures(solids, centrals), centrals);
}

double areaOf(const Drawing& drawing) {
  double area = 0;
  for (const DrawnShape& shape : drawing.shapes) {
    for (const auto& loop : shape.loops) {
      for (std::size_t n = 0; n < loop.size(); ++n) {
        const auto &a = loop[n], &b = loop[(n + 1) % loop.size()];
        area += (a[0] * b[1] - a[1] * b[0]) / 2;
      }
    }
  }
  return area;
}

TEST(FlatScene, ATriangleHasEightFigures) {
  // Merrell and Manocha 2008, section 4: two constant ones, three sides, three corners.
  const Solids solids = readSolidScene(kTriangle, "triangle").solids;
  EXPECT_TRUE(solids.flat);
  EXPECT_EQ(flatFiguresOf(solids).size(), 8u);
  // At a vertex where two lines cross, five of them fit: two constant, two sides, one corner. On a
  // line alone three: two constant, and the side.
  const Centrals centrals(normalsOf(planesOf(solids)));
  const std::vector<Figure> flat = flatFiguresOf(solids);
  for (std::size_t i = 0; i < centrals.normals().size(); ++i) {
    if (centrals.normals()[i].z != 0) continue;
    for (std::size_t j = 0; j <= i; ++j) {
      if (centrals.normals()[j].z != 0) continue;
      const Families both = Families{1} << i | Families{1} << j;
      const auto fit =
          std::ranges::count_if(flat, [&](const Figure& f) { return (f.support & ~both) == 0; });
      EXPECT_EQ(fit, i == j ? 3 : 5);
    }
  }
}

TEST(FlatScene, ResultsHaveTheFiguresOfTheExampleAlone) {
  const SolidScene scene = readSolidScene(kTriangle, "triangle");
  const std::vector<Figure> known = flatFiguresOf(scene.solids);
  int shapes = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const ContinuousResult result = synthesizeSolids(
        scene.solids, scene.looks, {.size = {10, 8, 1}, .seed = seed, .density = 2, .learning = 3});
    ASSERT_EQ(result.outcome, Outcome::Complete);
    // Written, read again, and looked at anew.
    const Drawing drawing =
        readDrawing(drawingText(drawingOf(result.model)), "result.svg", nullptr);
    shapes += static_cast<int>(drawing.shapes.size());
    const SolidScene read = solidsOfDrawing(drawing, "result.svg", 1.0);
    for (const Figure& figure : flatFiguresOf(read.solids)) {
      // The same directions, so that figures compare as they are.
      ASSERT_EQ(normalsOf(planesOf(read.solids)), normalsOf(planesOf(scene.solids)));
      EXPECT_THAT(known, testing::Contains(figure));
    }
  }
  EXPECT_GT(shapes, 10);
}

TEST(SolidsOfDrawing, KeepsHolesAndOrder) {
  Drawing drawing;
  drawing.shapes.push_back({"wall",
                            {100, 50, 50},
                            {{{0, 0}, {6, 0}, {6, 6}, {0, 6}}, {{2, 2}, {4, 2}, {4, 4}, {2, 4}}}});
  drawing.shapes.push_back({"sign", {0, 0, 200}, {{{4, 4}, {8, 4}, {8, 8}, {4, 8}}}});
  drawing.shapes.push_back({"cut", {255, 255, 255}, {{{6, 6}, {8, 6}, {8, 8}}}});
  const SolidScene scene = solidsOfDrawing(drawing, "a.svg");
  EXPECT_DOUBLE_EQ(scene.solids.unit, 2);
  const Drawing back = drawingOf(polygonsOf(scene.solids, scene.looks));
  double wall = 0, sign = 0;
  for (const DrawnShape& shape : back.shapes)
    (shape.material == "wall" ? wall : sign) += areaOf({{shape}});
  EXPECT_NEAR(wall, 36 - 4 - 4, 1e-9);
  EXPECT_NEAR(sign, 16 - 2, 1e-9);
}

TEST(SolidsOfDrawing, SaysWhatFitsNoGrid) {
  Drawing drawing;
  drawing.shapes.push_back({"ink", {0, 0, 0}, {{{0, 0}, {1, 0}, {0.61803398875, 1}}}});
  EXPECT_THAT(test::inputError([&] { solidsOfDrawing(drawing, "a.svg"); }),
              testing::HasSubstr("`unit`"));
  Warnings warnings;
  const SolidScene scene = solidsOfDrawing(drawing, "a.svg", 0.1, &warnings);
  EXPECT_EQ(warnings.size(), 1u);
  EXPECT_NEAR(areaOf(drawingOf(polygonsOf(scene.solids, scene.looks))), 0.5, 1e-9);
  EXPECT_THAT(test::inputError([] { drawingOf(PolygonModel{}); }), testing::HasSubstr("plane"));
}

}  // namespace
}  // namespace exemplar::continuous
