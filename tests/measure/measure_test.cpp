// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What a sound measure must pass: the ends of its scale, on real data.

#include "measure/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "core/error.h"
#include "measure/figures.h"
#include "tests/measure/fields.h"
#include "tests/progress_checks.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::ballPacking;
using testing::box;
using testing::emptyField;
using testing::makeField;
using testing::makeOrigins;
using testing::moved;
using testing::noise;
using testing::solidField;

constexpr Vec3i kSize{48, 48, 48};

/// A random packing that fills its box, and another with room around it.
class Soundness : public ::testing::Test {
 protected:
  static const DistanceField& filling() {
    static const DistanceField field = ballPacking(kSize, 1);
    return field;
  }
  static const DistanceField& freestanding() {
    // With room for patches of surface to be moved by three voxels and stay wholly inside.
    static const DistanceField field = ballPacking(kSize, 2, 7);
    return field;
  }
  static double occupancy(const DistanceField& field) { return solidFraction(Occupancy(field)); }
  static void expectRatiosNearOne(const Likeness& l, double tolerance) {
    EXPECT_NEAR(*l.occupancyRatio, 1, tolerance);
    EXPECT_NEAR(*l.surfaceRatio, 1, tolerance);
  }
};

TEST_F(Soundness, TheExampleAgainstItselfScoresOne) {
  for (const DistanceField* example : {&filling(), &freestanding()}) {
    const Likeness l = measureLikeness(*example, *example);
    EXPECT_EQ(l.published.share, 1);
    EXPECT_EQ(l.dense.share, 1);
    EXPECT_EQ(l.coverage.share, 1);
    EXPECT_EQ(l.denseInterior->share, 1);
    EXPECT_EQ(l.coverageInterior->share, 1);
    EXPECT_EQ(l.patches->distance, l.patches->floor);
    EXPECT_EQ(l.occupancyRatio, 1);
    EXPECT_EQ(l.surfaceRatio, 1);
    EXPECT_EQ(l.pieces->brokenShare, 0);
    EXPECT_GT(l.pieces->example, 10);
    EXPECT_EQ(l.pieces->result, l.pieces->example);
  }
}

TEST_F(Soundness, AShiftedCopyScoresOne) {
  for (const Vec3i shift : {Vec3i{1, 0, 0}, {3, 3, 3}, {-2, 1, 3}}) {
    const Likeness l = measureLikeness(freestanding(), moved(freestanding(), shift));
    EXPECT_EQ(l.dense.share, 1);
    EXPECT_EQ(l.coverage.share, 1);
    EXPECT_LT(l.published.share, 0.5);
    // The patches are the same, drawn again: the floor, up to its own deviation.
    EXPECT_LT(l.patches->distance, 1.5 * l.patches->floor);
    EXPECT_GT(l.patches->distance, 0.5 * l.patches->floor);
    EXPECT_EQ(l.occupancyRatio, 1);
    EXPECT_NEAR(*l.surfaceRatio, 1, 1e-9);
    EXPECT_EQ(l.pieces->brokenShare, 0);
  }
}

TEST_F(Soundness, AnEmptyBoxFails) {
  for (const DistanceField* example : {&filling(), &freestanding()}) {
    const Measures m = measure(*example, emptyField(kSize));
    EXPECT_EQ(m.likeness.dense.share, 0);
    EXPECT_EQ(m.likeness.coverage.share, 0);
    EXPECT_FALSE(m.likeness.patches);
    EXPECT_EQ(m.likeness.occupancyRatio, 0);
    EXPECT_EQ(m.likeness.surfaceRatio, 0);
    EXPECT_EQ(m.collapse, Collapse::AllEmpty);
  }
}

TEST_F(Soundness, ASolidBoxFails) {
  for (const DistanceField* example : {&filling(), &freestanding()}) {
    const Measures m = measure(*example, solidField(kSize));
    EXPECT_LT(m.likeness.coverage.share, 0.05);
    EXPECT_EQ(m.likeness.coverageInterior->share, 0);
    EXPECT_GT(*m.likeness.occupancyRatio, 3);
    EXPECT_EQ(m.likeness.surfaceRatio, 0);
    EXPECT_EQ(m.collapse, Collapse::AllSolid);
  }
}

TEST_F(Soundness, ABoxOfTheExamplesMeanOccupancyFails) {
  for (const DistanceField* example : {&filling(), &freestanding()}) {
    // As a slab through the box, and as a cube in its middle.
    const double share = occupancy(*example);
    const double depth = 48 * share, side = 48 * std::cbrt(share);
    const Vec3d center{23.5, 23.5, 23.5}, half{side / 2, side / 2, side / 2};
    for (const DistanceField& featureless :
         {makeField(kSize, [&](const Vec3d& p) { return p.z + 0.5 - depth; }),
          box(kSize, center - half, center + half)}) {
      const Measures m = measure(*example, featureless);
      // To whole cells: half a cell of the depth, half a cell of each side.
      EXPECT_NEAR(*m.likeness.occupancyRatio, 1, std::max(0.55 / depth, 1.6 / side));
      EXPECT_LT(m.likeness.coverage.share, 0.05);
      EXPECT_LT(m.likeness.coverageInterior->share, 0.05);
      EXPECT_LT(m.likeness.denseInterior->share, 0.05);
      EXPECT_LT(*m.likeness.surfaceRatio, 0.5);
      EXPECT_GT(m.likeness.patches->distance, 20 * m.likeness.patches->floor);
    }
  }
}

TEST_F(Soundness, WhiteNoiseFailsBoth) {
  for (const DistanceField* example : {&filling(), &freestanding()}) {
    const Likeness l = measureLikeness(*example, noise(kSize, occupancy(*example), 3));
    EXPECT_NEAR(*l.occupancyRatio, 1, 0.05);
    EXPECT_LT(l.dense.share, 0.01);
    EXPECT_LT(l.coverage.share, 0.01);
    EXPECT_LT(l.dense.meanIou, 0.4);
    EXPECT_GT(*l.surfaceRatio, 3);
    EXPECT_GT(l.patches->distance, 100 * l.patches->floor);
    EXPECT_GT(l.pieces->brokenShare, 0.1);
  }
}

TEST_F(Soundness, AFreshSampleScoresBetweenACopyAndNoise) {
  const Vec3i n{64, 64, 64};
  const DistanceField example = ballPacking(n, 1);
  const Likeness fresh = measureLikeness(example, ballPacking(n, 4));
  const Likeness larger = measureLikeness(example, ballPacking({96, 96, 64}, 5));
  const Likeness rough = measureLikeness(example, noise(n, occupancy(example), 3));
  for (const Likeness* l : {&fresh, &larger}) {
    expectRatiosNearOne(*l, 0.1);
    EXPECT_EQ(l->pieces->brokenShare, 0);
    // The floor knows the drawing of patches, not the drawing of the hundred balls of either box.
    EXPECT_LT(l->patches->distance, 6 * l->patches->floor);
    EXPECT_LT(l->patches->distance, 0.05 * rough.patches->distance);
    EXPECT_GT(l->dense.meanIou, rough.dense.meanIou + 0.3);
    EXPECT_LT(l->dense.meanIou, 0.95);
  }
  // The process at another size and another seed scores the same: what a perfect synthesizer is
  // expected to reach.
  EXPECT_NEAR(larger.dense.meanIou, fresh.dense.meanIou, 0.05);
  EXPECT_NEAR(larger.dense.share, fresh.dense.share, 0.05);
  EXPECT_GT(larger.coverage.meanIou, fresh.coverage.meanIou);
}

TEST_F(Soundness, BrokenBallsShow) {
  // The packing with a wedge cut out of every ball.
  const std::vector<Vec3d> centers = testing::packing(kSize, 5, 0.5, 1);
  const DistanceField whole = testing::balls(kSize, 5, centers);
  const DistanceField shattered = makeField(kSize, [&](const Vec3d& p) {
    const Vec3i c = cast<int>(p);
    return (c.x / 3 + c.y / 3 + c.z / 3) % 2 ? 1.0f : whole.values[c];
  });
  const Likeness l = measureLikeness(whole, shattered);
  EXPECT_GT(l.pieces->brokenShare, 0.3);
  EXPECT_LT(l.dense.share, 0.05);
}

TEST_F(Soundness, OneBlockRepeatedIsToldFromACopy) {
  const DistanceField& example = filling();
  const auto result = [&](int block) {
    const Origins origins = makeOrigins(kSize, [&](const Vec3i& p) {
      return Origin({p.x % block, p.y % block, p.z % block});
    });
    return measure(example, testing::gathered(example, origins), {.origins = &origins});
  };
  const Measures repeated = result(12), copied = result(48);
  EXPECT_EQ(repeated.collapse, Collapse::Repeated);
  EXPECT_LT(*repeated.novelty.usedShare, 0.04);
  EXPECT_EQ(copied.collapse, Collapse::None);
  EXPECT_EQ(copied.novelty.verbatimRun, 1);
}

TEST(Measure, SaysWhichInputsDoNotFit) {
  const DistanceField example = testing::ball({16, 16, 16}, {8, 8, 8}, 5);
  DistanceField fine = example;
  fine.voxelSize = 0.5;
  try {
    measure(example, fine);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "the example has voxels of 1 and the result of 0.5; measure both at the same voxel "
        "size");
  }
  EXPECT_THROW(measure(DistanceField{}, example), InputError);
  EXPECT_THROW(measure(example, DistanceField{}), InputError);
}

TEST(Measure, ThinAndTinyVolumesAreMeasured) {
  for (const Vec3i size : {Vec3i{1, 1, 1}, {40, 40, 1}, {3, 50, 7}, {11, 11, 11}}) {
    const DistanceField field = testing::ball(size, {1.5, 1.5, 0.3}, 2.2);
    const Measures m = measure(field, field);
    EXPECT_EQ(m.likeness.dense.share, 1) << size.x;
    EXPECT_EQ(m.likeness.denseInterior.has_value(), size == (Vec3i{11, 11, 11}));
    EXPECT_EQ(m.novelty.copyDistance, 0) << size.x;
  }
}

TEST(Measure, ReportsAndStops) {
  const DistanceField field = testing::ball({16, 16, 16}, {8, 8, 8}, 5);
  const Origins origins = makeOrigins(field.size(), [](const Vec3i& p) { return Origin(p); });
  testing::expectReportsAndStops(20, [&](const Progress& progress) {
    return measure(field, field, {.origins = &origins}, {}, progress);
  });
  testing::expectReportsAndStops(
      4, [&](const Progress& progress) { return seamJumps(field, field, origins, 0, progress); });
  testing::expectReportsAndStops(2, [&](const Progress& progress) {
    return surfaceUse(Occupancy(field), origins, 0, progress);
  });
}

TEST(Measure, ReportsTheMeshsHealth) {
  const DistanceField field = testing::ball({16, 16, 16}, {8, 8, 8}, 5);
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_FALSE(measure(field, field).mesh);
  const Measures m = measure(field, field, {.mesh = &mesh});
  ASSERT_TRUE(m.mesh);
  EXPECT_FALSE(m.mesh->closed());
}

TEST(Figures, HaveNamesOfTheirOwn) {
  const DistanceField example = ballPacking({24, 24, 24}, 1), result = ballPacking({24, 24, 24}, 2);
  const Origins origins = makeOrigins({24, 24, 24}, [](const Vec3i& p) { return Origin(p); });
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const auto all = figures(measure(example, result, {.origins = &origins, .mesh = &mesh}));
  std::set<std::string> names;
  std::vector<std::string> groups;
  for (const Figure& f : all) {
    EXPECT_TRUE(names.insert(f.group + "." + f.key).second) << f.key;
    for (const char c : f.key) EXPECT_TRUE(std::islower(c) || std::isdigit(c) || c == '_') << f.key;
    if (groups.empty() || groups.back() != f.group) groups.push_back(f.group);
    // A box of 24 has no room for patches of coarse samples.
    const bool coarse = f.key.starts_with("multiscale_") && f.key != "multiscale_1";
    EXPECT_EQ(std::holds_alternative<std::monostate>(f.value), coarse) << f.key;
  }
  EXPECT_EQ(groups, (std::vector<std::string>{"likeness", "wholeness", "landmarks", "novelty",
                                              "frontier", "seams", "mesh", "collapse", "doubts"}));
  for (const char* key : {"likeness.lp_dense", "likeness.coverage", "likeness.fpd",
                          "likeness.occupancy_ratio", "likeness.surface_ratio"})
    EXPECT_TRUE(names.contains(key)) << key;
}

TEST(Figures, OfATableAreAligned) {
  const DistanceField field = ballPacking({24, 24, 24}, 1);
  const auto all = figures(measure(field, field));
  const std::string table = figuresTable(all);
  EXPECT_NE(table.find("likeness\n  lp_dense "), std::string::npos);
  EXPECT_NE(table.find("\n\nnovelty\n"), std::string::npos);
  std::set<std::size_t> columns;
  std::size_t lines = 0;
  for (std::size_t at = 0; at < table.size(); at = table.find('\n', at) + 1) {
    const std::string line = table.substr(at, table.find('\n', at) - at);
    if (line.rfind("  ", 0) != 0) continue;
    ++lines;
    // Two spaces, the key, spaces, the value (right-aligned), two spaces.
    const std::size_t value = line.find_first_not_of(' ', line.find(' ', 2));
    columns.insert(line.find(' ', value));
  }
  EXPECT_EQ(lines, all.size());
  columns.erase(std::string::npos);
  EXPECT_EQ(columns.size(), 1u);
}

TEST(Measure, IsTheSameAtOneAndEightThreads) {
  const DistanceField example = ballPacking({40, 40, 40}, 1), result = ballPacking({48, 40, 40}, 2);
  const Origins origins = makeOrigins(result.size(), [](const Vec3i& p) {
    return Origin({p.x * 3 % 40, p.y, p.z});
  });
  const auto all = [&] {
    std::map<std::string, decltype(Figure::value)> values;
    for (const Figure& f : figures(measure(example, result, {.origins = &origins})))
      values[f.group + "." + f.key] = f.value;
    return values;
  };
  EXPECT_EQ(testing::onThreads(1, all), testing::onThreads(8, all));
}

}  // namespace
}  // namespace exemplar
