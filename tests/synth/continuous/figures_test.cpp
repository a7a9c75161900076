// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/error.h"
#include "tests/synth/continuous/fixtures.h"

namespace exemplar::continuous {
namespace {

FigureSet figuresOf(const Solids& solids) {
  return extractFigures(solids, Centrals(normalsOf(planesOf(solids))));
}

std::size_t withSupport(const FigureSet& figures, int families) {
  return static_cast<std::size_t>(std::ranges::count_if(
      figures.all(), [&](const Figure& f) { return __builtin_popcount(f.support) == families; }));
}

TEST(ExtractFigures, FindsAsManyAsTheSpecificationLists) {
  for (const Fixture& f : fixtures())
    EXPECT_EQ(figuresOf(solidsOf(f.name)).size(), f.figures) << f.name;
}

TEST(ExtractFigures, KnowsFacesEdgesAndCorners) {
  const FigureSet cube = figuresOf(solidsOf("cube"));
  EXPECT_EQ(withSupport(cube, 0), 2u);
  EXPECT_EQ(withSupport(cube, 1), 6u);
  EXPECT_EQ(withSupport(cube, 2), 12u);
  EXPECT_EQ(withSupport(cube, 3), 8u);
  EXPECT_EQ(withSupport(figuresOf(solidsOf("pyramid")), 4), 1u);
  EXPECT_EQ(withSupport(figuresOf(solidsOf("cross-gabled")), 4), 3u);
}

TEST(ExtractFigures, IsClosedUnderRestriction) {
  for (const Fixture& f : fixtures()) {
    const Solids solids = solidsOf(f.name);
    const Centrals centrals(normalsOf(planesOf(solids)));
    FigureSet figures = extractFigures(solids, centrals);
    const std::size_t before = figures.size();
    closeUnderRestriction(centrals, figures);
    EXPECT_EQ(figures.size(), before) << f.name;
  }
}

TEST(ExtractFigures, DoesNotSeeWhereTheExampleIs) {
  for (const Fixture& f : fixtures()) {
    const Solids solids = solidsOf(f.name);
    if (solids.ground) continue;
    Solids moved = solids;
    for (Solid& solid : moved.solids)
      for (ExactPlane& side : solid.sides) side.offset += dot(side.normal, Vec3l{17, -5, 1001});
    EXPECT_EQ(figuresOf(moved).all(), figuresOf(solids).all()) << f.name;
  }
}

TEST(Reduced, LeavesOutFamiliesThatDoNotMatter) {
  const Solids solids = solidsOf("cross-gabled");
  const Centrals centrals(normalsOf(planesOf(solids)));
  const Families all = static_cast<Families>((1u << centrals.normals().size()) - 1);
  const FigureSet figures = extractFigures(solids, centrals);
  for (const Figure& figure : figures.all())
    EXPECT_EQ(reduced(centrals, all, expanded(centrals, figure, all)), figure);
}

TEST(Readable, IsASumOfProducts) {
  const Centrals centrals({{0, 0, 1}, {0, 1, 0}, {1, 0, 0}});
  EXPECT_EQ(readable(centrals, {0, {0}}), "air");
  EXPECT_EQ(readable(centrals, {1, {1, 0}}), "!h0");
  EXPECT_EQ(readable(centrals, {3, {0, 0, 0, 1}}), "h0 & h1");
  // In the order of cells: below both, above 0, above 1, above both.
  EXPECT_EQ(readable(centrals, {3, {0, 1, 1, 1}}), "h0 | h1");
  EXPECT_EQ(readable(centrals, {3, {2, 0, 0, 1}}), "1 * h0 & h1 + 2 * !h0 & !h1");
}

TEST(ReadSolidScene, SaysWhatIsWrongAndWhere) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      boxOf(readSolidScene(text, "s.toml").solids);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string head = "kind = \"solids\"\n[[part]]\nsubstance = \"a\"\n";
  using testing::HasSubstr;
  EXPECT_EQ(message(head + "box = [0, 0, 0, 1, 1, 1]"), "");
  EXPECT_THAT(message("kind = \"solids\""), HasSubstr("needs a [[part]]"));
  EXPECT_THAT(message(head + "box = [0, 0, 0, 1, 1]"), HasSubstr("s.toml:4: 'box' must have 6"));
  EXPECT_THAT(message(head + "box = [0, 0, 0, 1, 1, 0.5]"), HasSubstr("whole numbers"));
  EXPECT_THAT(message(head + "box = [0, 0, 0, 1, 1, 0]"), HasSubstr("low corner"));
  EXPECT_THAT(message(head + "bocks = 1"), HasSubstr("s.toml:4: unknown key 'bocks'"));
  EXPECT_THAT(message(head + "points = [[0,0,0],[1,0,0],[0,1,0],[1,1,0]]"), HasSubstr("one plane"));
  EXPECT_THAT(message(head + "planes = [[1,0,0,1],[0,1,0,1]]"), HasSubstr("unbounded"));
  EXPECT_THAT(message(head + "planes = [[0,0,0,1]]"), HasSubstr("normal is 0"));
  EXPECT_THAT(message(head), HasSubstr("needs one of"));
}

TEST(NormalsOf, RefusesWhatIsCurved) {
  std::vector<ExactPlane> planes;
  for (std::int64_t n = 0; n < 40; ++n) planes.push_back({primitive({1, n, 7}), n});
  EXPECT_THROW(normalsOf(planes), InputError);
}

}  // namespace
}  // namespace exemplar::continuous
