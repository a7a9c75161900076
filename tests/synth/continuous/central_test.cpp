// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/central.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace exemplar::continuous {
namespace {

Families allOf(const std::vector<Vec3l>& normals) {
  return static_cast<Families>((std::uint64_t{1} << normals.size()) - 1);
}

TEST(Central, PlanesInGeneralPositionHaveTheCellsOfTheFormula) {
  // No three of these normals are dependent: (1, t, t^2) for different t.
  std::vector<Vec3l> normals;
  for (std::int64_t t = -4; t <= 4; ++t) {
    normals.push_back({1, t, t * t});
    if (normals.size() < 3) continue;
    const auto p = static_cast<std::int64_t>(normals.size());
    const Centrals centrals(normals);
    const Central& central = centrals.of(allOf(normals));
    EXPECT_EQ(static_cast<std::int64_t>(central.cells.size()), p * (p - 1) + 2);
    EXPECT_EQ(static_cast<std::int64_t>(central.rays.size()), p * (p - 1));
    for (const Central::Ray& ray : central.rays) EXPECT_EQ(ray.around.size(), 4u);
  }
}

TEST(Central, RaysAreOrderedAndHaveTheirOpposites) {
  const std::vector<Vec3l> normals{{0, 0, 1}, {0, 1, -1}, {0, 1, 1}, {1, 0, -1}, {1, 0, 1}};
  const Centrals centrals(normals);
  const Central& pyramid = centrals.of(31);
  // Specification, section 12, test 9.
  EXPECT_EQ(pyramid.cells.size(), 18u);
  EXPECT_EQ(pyramid.rays.size(), 12u);
  EXPECT_EQ(centrals.of(30).cells.size(), 14u);
  EXPECT_EQ(centrals.of(30).rays.size(), 12u);
  for (std::uint32_t r = 0; r < pyramid.rays.size(); ++r) {
    const Central::Ray& ray = pyramid.rays[r];
    EXPECT_EQ(pyramid.rays[ray.opposite].direction, -ray.direction);
    EXPECT_EQ(pyramid.ray(ray.direction), r);
    EXPECT_EQ(ray.on, pyramid.rays[ray.opposite].on);
  }
}

TEST(Central, EveryDirectionIsInACell) {
  const std::vector<Vec3l> normals{{0, 0, 1},  {3, -4, 0}, {3, 4, 0}, {19, -6, 0},
                                   {19, 6, 0}, {0, 1, 0},  {1, 2, 3}};
  const Centrals centrals(normals);
  const Central& central = centrals.of(allOf(normals));
  std::mt19937 random(1);
  std::set<Families> seen;
  for (int trial = 0; trial < 20000; ++trial) {
    Vec3l d;
    for (int axis = 0; axis < 3; ++axis) d[axis] = static_cast<int>(random() % 2001) - 1000;
    Families above = 0;
    bool generic = true;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const std::int64_t level = dot(normals[i], d);
      generic = generic && level != 0;
      if (level > 0) above |= Families{1} << i;
    }
    if (!generic) continue;
    EXPECT_EQ(central.cells[central.cell(above)], above);
    seen.insert(above);
  }
  // And no cell is invented: each is seen by chance, or is too thin to be.
  EXPECT_GE(seen.size(), central.cells.size() * 9 / 10);
  for (std::size_t c = 0; c < central.cells.size(); ++c) {
    Vec3l inside;
    for (const std::uint32_t r : central.raysOfCell[c]) inside += central.rays[r].direction;
    for (std::size_t i = 0; i < normals.size(); ++i)
      EXPECT_EQ(dot(normals[i], inside) > 0, (central.cells[c] >> i & 1) != 0);
  }
}

TEST(Central, FewPlanesHaveSectorsAndHalves) {
  const std::vector<Vec3l> normals{{0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  const Centrals centrals(normals);
  EXPECT_EQ(centrals.of(0).cells, std::vector<Families>{0});
  EXPECT_EQ(centrals.of(2).cells, (std::vector<Families>{0, 2}));
  EXPECT_EQ(centrals.of(3).cells, (std::vector<Families>{0, 1, 2, 3}));
  EXPECT_EQ(centrals.of(7).cells.size(), 6u);
  EXPECT_EQ(centrals.of(7).rank, 2);
}

}  // namespace
}  // namespace exemplar::continuous
