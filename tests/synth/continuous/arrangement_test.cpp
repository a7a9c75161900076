// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/arrangement.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/error.h"
#include "synth/continuous/filling.h"
#include "synth/continuous/labels.h"
#include "tests/synth/continuous/fixtures.h"

namespace exemplar::continuous {
namespace {

/// Planes in a box around a fixture, and its figures.
struct Made {
  Solids solids;
  PlaneLattice lattice;
  PlaneSets planes;
  Centrals centrals;
  Arrangement arrangement;

  explicit Made(const std::string& name, const Vec3i& more = {1, 1, 1})
      : solids(solidsOf(name)),
        lattice(latticeOf(solids)),
        planes(planesIn(lattice, windowOf(lattice, sizeInSpacings(lattice, solids) + more))),
        centrals(planes.normals),
        arrangement(planes, centrals, 1'000'000) {}
};

TEST(LatticeOf, HasAllPlanesOfTheExample) {
  for (const Fixture& f : fixtures()) {
    const Solids solids = solidsOf(f.name);
    const PlaneLattice lattice = latticeOf(solids);
    for (const ExactPlane& plane : planesOf(solids)) {
      const int family = lattice.familyOf(plane.normal);
      ASSERT_GE(family, 0);
      EXPECT_EQ((plane.offset - lattice.phases[family]) % lattice.steps[family], 0) << f.name;
    }
    const PlaneLattice finer = latticeOf(solids, 1);
    for (const std::int64_t step : finer.steps) EXPECT_EQ(step, 1);
  }
}

TEST(LatticeOf, TakesTheCommonMeasureOfDistances) {
  const PlaneLattice house = latticeOf(solidsOf("gabled"));
  EXPECT_EQ(house.spacing, (Vec3l{4, 6, 2}));
  // One roof plane each way: their step is the measure of the axes'.
  EXPECT_EQ(house.steps[house.familyOf({1, 0, 1})], 2);
  EXPECT_EQ(latticeOf(solidsOf("tetrahedron")).steps, (std::vector<std::int64_t>{2, 2, 2, 2}));
}

TEST(Arrangement, FindsEveryPointAtWhichPlanesOfThreeDirectionsMeet) {
  for (const Fixture& f : fixtures()) {
    const Made made(f.name);
    const PlaneSets& planes = made.planes;
    std::vector<ExactPoint> expected;
    std::vector<ExactPlane> all;
    for (std::size_t family = 0; family < planes.normals.size(); ++family)
      for (const std::int64_t offset : planes.offsets[family])
        all.push_back({planes.normals[family], offset});
    ExactPoint p;
    for (std::size_t a = 0; a < all.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        for (std::size_t c = 0; c < b; ++c) {
          if (!meet(all[a], all[b], all[c], p)) continue;
          bool within = true;
          for (int axis = 0; axis < 3; ++axis)
            within = within && p.n[axis] >= planes.window.low[axis] * p.d &&
                     p.n[axis] <= planes.window.high[axis] * p.d;
          if (within) expected.push_back(p);
        }
      }
    }
    makeDistinct(expected);
    ASSERT_EQ(made.arrangement.vertices(), expected.size()) << f.name;
    for (std::uint32_t v = 0; v < expected.size(); ++v) {
      ASSERT_EQ(made.arrangement.point(v), expected[v]) << f.name;
      Families on = 0;
      for (std::size_t family = 0; family < planes.normals.size(); ++family) {
        for (const std::int64_t offset : planes.offsets[family])
          if (ExactPlane{planes.normals[family], offset}.side(expected[v]) == 0)
            on |= Families{1} << family;
      }
      EXPECT_EQ(made.arrangement.on(v), on);
    }
  }
}

TEST(Arrangement, JoinsEachVertexToTheNextOneOnEveryLine) {
  for (const Fixture& f : fixtures()) {
    const Made made(f.name);
    const Arrangement& a = made.arrangement;
    for (std::uint32_t v = 0; v < a.vertices(); ++v) {
      for (std::uint32_t r = 0; r < a.ends(v).size(); ++r) {
        const EdgeEnd end = a.ends(v)[r];
        const Vec3l d = a.central(v).rays[r].direction;
        if (end.vertex == EdgeEnd::kNone) {
          EXPECT_FALSE(a.inside(v)) << f.name;
          continue;
        }
        // Back the same way, along the same line, with nothing between.
        EXPECT_EQ(a.ends(end.vertex)[end.ray].vertex, v);
        EXPECT_EQ(a.central(end.vertex).rays[end.ray].direction, -d);
        EXPECT_EQ(a.central(end.vertex).rays[end.ray].on, a.central(v).rays[r].on);
        const ExactPoint p = a.point(v), q = a.point(end.vertex);
        const Vec3l along = q.n * p.d - p.n * q.d;
        EXPECT_EQ(cross(along, d), (Vec3l{}));
        EXPECT_GT(dot(along, d), 0);
        for (std::size_t family = 0; family < made.planes.normals.size(); ++family) {
          const Arrangement::Level at = a.level(p, family), there = a.level(q, family);
          if (dot(made.planes.normals[family], d) > 0) {
            EXPECT_LE(there.plane - at.plane, there.on ? 1 : 0) << f.name;
          }
        }
      }
    }
  }
}

TEST(ClassesOf, HaveTheLabelsThatTheSpecificationLists) {
  const auto labelsOf = [](const std::string& name) {
    const Made made(name);
    const FigureSet figures = extractFigures(made.solids, made.centrals);
    std::map<std::pair<std::size_t, std::size_t>, std::set<std::size_t>> labels;
    for (const VertexClass& c : classesOf(made.arrangement, figures))
      if (c.central) labels[{c.central->cells.size(), c.central->rays.size()}].insert(c.labels());
    return labels;
  };
  EXPECT_TRUE((labelsOf("cube")[{8, 6}].contains(28)));
  EXPECT_TRUE((labelsOf("pyramid")[{18, 12}].contains(20)));
  EXPECT_TRUE((labelsOf("pyramid")[{14, 12}].contains(11)));
  EXPECT_TRUE((labelsOf("cross-gabled")[{32, 22}].contains(55)));
  // Three planes of a tetrahedron and nothing else: nine labels, as in the thesis, figure 4.20.
  const Made made("tetrahedron");
  const FigureSet figures = extractFigures(made.solids, made.centrals);
  EXPECT_EQ(figuresWithin(figures, 7).size(), 9u);
}

TEST(SolidsFilling, TheExampleItselfIsAValidResult) {
  for (const Fixture& f : fixtures()) {
    const Made made(f.name);
    const FigureSet figures = extractFigures(made.solids, made.centrals);
    const SolidsFilling filling(made.arrangement, made.solids);
    const std::vector<VertexClass> classes = classesOf(made.arrangement, figures);
    const std::vector<std::uint32_t> found = figuresOf(made.arrangement, filling, figures);
    std::set<std::uint32_t> seen;
    for (std::uint32_t v = 0; v < found.size(); ++v) {
      if (!made.arrangement.inside(v)) continue;
      ASSERT_NE(found[v], FigureSet::kNone) << f.name;
      EXPECT_GE(classes[made.arrangement.kind(v)].labelOf(found[v]), 0) << f.name;
      seen.insert(found[v]);
    }
    // Every corner of the example is there; its edges may have no vertex in their middle.
    for (std::uint32_t n = 0; n < figures.size(); ++n) {
      if (made.centrals.of(figures[n].support).rank == 3) {
        EXPECT_TRUE(seen.contains(n)) << f.name;
      }
    }
  }
}

TEST(Arrangement, RefusesWhatIsTooLarge) {
  const Solids solids = solidsOf("cube");
  const PlaneLattice lattice = latticeOf(solids);
  EXPECT_THROW(planesIn(lattice, windowOf(lattice, {100000, 1, 1})), InputError);
  const PlaneSets planes = planesIn(lattice, windowOf(lattice, {50, 50, 50}));
  const Centrals centrals(planes.normals);
  EXPECT_THROW(Arrangement(planes, centrals, 1000), InputError);
}

}  // namespace
}  // namespace exemplar::continuous
