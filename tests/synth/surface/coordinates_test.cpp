// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/coordinates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/synth/surface/surfaces.h"
#include "tests/threads.h"

namespace exemplar::surface {
namespace {

Lattice rectangular(double x, double y) { return {2, {x, 0}, {0, y}}; }

/// What the steps around a triangle add up to.
Vec2d around(const Sheet& sheet, const Coordinates& c, std::uint32_t t) {
  Vec2d sum{};
  int turns = 0;
  for (int corner = 0; corner < 3; ++corner) {
    const std::uint32_t e = sheet.sides[t][corner];
    const Coordinates::Step step = c.along({0, e, sheet.edges[e].a == sheet.triangles[t][corner]});
    sum += c.turned(turns) * step.by;
    turns = (turns + step.turns) % c.symmetry;
  }
  return sum;
}

TEST(Coordinates, GoOnAsTheFieldSaysWhereNothingRepeats) {
  const Sheet sheet = makeSheet(planeMesh(4, 20), {.edge = 0.2});
  const DirectionField field = smoothestField(sheet, 4);
  const Coordinates c = integrate(sheet, field, {}, 0.1);
  for (std::size_t e = 0; e < sheet.edges.size(); ++e)
    EXPECT_NEAR(length(c.steps[e].by), sheet.edges[e].length / 0.1, 1e-6);
  EXPECT_TRUE(c.phases.empty());
}

TEST(Coordinates, PeriodsFitAPlaneWithoutDislocations) {
  const Sheet sheet = makeSheet(planeMesh(4, 20), {.edge = 0.15});
  const Guidance up = along(sheet, {0, 1, 0}, 1);
  const DirectionField field = smoothestField(sheet, 2, &up);
  const Coordinates c = integrate(sheet, field, rectangular(10, 6), 0.1);
  EXPECT_TRUE(c.dislocations.empty());
  double off = 0;
  for (std::size_t e = 0; e < sheet.edges.size(); ++e)
    off = std::max(
        off, std::abs(length(c.lattice.basis() * c.steps[e].by) - sheet.edges[e].length / 0.1));
  EXPECT_LT(off, 0.15);  // samples, of 1.5
}

TEST(Coordinates, CloseAroundEveryTriangleThatIsNoDislocationOrSingularity) {
  const Sheet sheet = makeSheet(bodyMesh(), {.edge = 0.08});
  for (const int symmetry : {1, 2, 4}) {
    const DirectionField field = smoothestField(sheet, symmetry);
    const Coordinates c =
        integrate(sheet, field, symmetry == 4 ? rectangular(10, 10) : rectangular(12, 7), 0.05);
    std::vector<std::uint8_t> open(sheet.triangles.size(), 0);
    for (const Singularity& s : field.singularities) open[s.triangle] = 1;
    for (const std::uint32_t t : c.dislocations) open[t] = 1;
    std::size_t broken = 0;
    for (std::uint32_t t = 0; t < sheet.triangles.size(); ++t) {
      const Vec2d sum = around(sheet, c, t);
      if (open[t]) {
        ++broken;
      } else {
        // Whole periods are all that can be missing, and none are.
        ASSERT_LT(length(sum), 1e-6);
      }
    }
    EXPECT_LT(broken, sheet.triangles.size() / 50);
  }
}

TEST(Coordinates, StepsFitThePhasesOfTheirEnds) {
  const Sheet sheet = makeSheet(makeTorus({0, 0, 0}, {0, 0, 1}, 1, 0.4, 60, 30), {.edge = 0.08});
  const Coordinates c = integrate(sheet, smoothestField(sheet, 2), rectangular(12, 7), 0.05);
  for (std::size_t e = 0; e < sheet.edges.size(); ++e) {
    const Vec2d there = c.turned(c.steps[e].turns) * c.phases[sheet.edges[e].b];
    const Vec2d off = there - c.phases[sheet.edges[e].a] - c.steps[e].by;
    EXPECT_NEAR(off.x, std::round(off.x), 1e-9);
    EXPECT_NEAR(off.y, std::round(off.y), 1e-9);
  }
}

TEST(Coordinates, AreTheSameAtAnyNumberOfThreads) {
  const Sheet sheet = makeSheet(makeSphere({0, 0, 0}, 1, 6), {.edge = 0.15});
  const DirectionField field = smoothestField(sheet, 2);
  testing::expectSameAtAnyThreads([&] {
    std::vector<double> phases;
    for (const Vec2d& p : integrate(sheet, field, rectangular(12, 7), 0.1).phases) {
      phases.push_back(p.x);
      phases.push_back(p.y);
    }
    return phases;
  });
}

}  // namespace
}  // namespace exemplar::surface
