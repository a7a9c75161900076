// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/pieces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/measure/fields.h"

namespace exemplar {
namespace {

using testing::ball;
using testing::balls;
using testing::emptyField;
using testing::makeField;
using testing::noise;
using testing::solidField;

Occupancy cells(const Vec3i& size, const std::vector<Vec3i>& solid) {
  DistanceField field = emptyField(size);
  for (const Vec3i& c : solid) field.values[c] = -1;
  return Occupancy(field);
}

/// Flood fill, cell by cell.
std::vector<Component> slowComponents(const DistanceField& field) {
  Array3D<char> seen(field.size());
  std::vector<Component> components;
  const Vec3i n = field.size();
  for (std::size_t s = 0; s < seen.count(); ++s) {
    if (seen.data()[s] || !(field.values.data()[s] < 0)) continue;
    Component c;
    std::vector<Vec3i> stack{seen.ijk(s)};
    seen.data()[s] = 1;
    while (!stack.empty()) {
      const Vec3i p = stack.back();
      stack.pop_back();
      ++c.cells;
      for (int axis = 0; axis < 3; ++axis) {
        c.touchesFace |= p[axis] == 0 || p[axis] == n[axis] - 1;
        for (const int side : {-1, 1}) {
          Vec3i q = p;
          q[axis] += side;
          if (!seen.contains(q) || seen[q] || !(field.values[q] < 0)) continue;
          seen[q] = 1;
          stack.push_back(q);
        }
      }
    }
    components.push_back(c);
  }
  return components;
}

TEST(ConnectedComponents, AgreeWithAFloodFill) {
  // Near the percolation threshold of the cubic lattice, 0.3116, components wind the most.
  for (const double solid : {0.05, 0.31, 0.5})
    for (const Vec3i size :
         {Vec3i{64, 20, 20}, {65, 20, 21}, {130, 9, 9}, {1, 30, 30}, {7, 1, 1}}) {
      const DistanceField field = noise(size, solid, 1);
      EXPECT_EQ(connectedComponents(Occupancy(field)), slowComponents(field));
    }
}

TEST(ConnectedComponents, NeedAFaceInCommon) {
  EXPECT_EQ(connectedComponents(cells({9, 9, 9}, {{3, 3, 3}, {4, 3, 3}})).size(), 1u);
  EXPECT_EQ(connectedComponents(cells({9, 9, 9}, {{3, 3, 3}, {4, 4, 3}})).size(), 2u);
  EXPECT_EQ(connectedComponents(cells({9, 9, 9}, {{3, 3, 3}, {4, 4, 4}})).size(), 2u);
}

TEST(Pieces, AreComponentsThatTouchNoFace) {
  const Vec3i n{40, 40, 40};
  const Occupancy o(balls(n, 5, {{10, 10, 10}, {28, 28, 28}, {10, 38, 10}, {20, 10, 28}}));
  const Pieces pieces = comparePieces(o, o);
  EXPECT_EQ(pieces.example, 3);  // one leans over a face
  EXPECT_EQ(pieces.result, 3);
  EXPECT_DOUBLE_EQ(pieces.examplePerMillion, 3e6 / 64000);
  EXPECT_EQ(pieces.brokenShare, 0);
  EXPECT_GT(pieces.smallest, 450);  // 4/3 pi 125 = 524
  EXPECT_LT(pieces.smallest, 600);
}

TEST(Pieces, SmallerThanHalfOfTheSmallestAreBroken) {
  const Vec3i n{40, 40, 40};
  const Occupancy whole(balls(n, 6, {{12, 12, 12}, {27, 27, 27}}));
  const auto both = [&](double radius) {
    return Occupancy(makeField(n, [&](const Vec3d& p) {
      return std::min(length(p - Vec3d{12, 12, 12}) - 6, length(p - Vec3d{27, 27, 27}) - radius);
    }));
  };
  // A ball of 0.8 of the radius has 0.51 of the volume, one of 0.7 has 0.34. The digital volumes
  // are within 5 % of these at a radius of 4 and more.
  EXPECT_EQ(comparePieces(whole, both(4.95)).brokenShare, 0);
  const Pieces broken = comparePieces(whole, both(4.2));
  EXPECT_NEAR(broken.brokenShare, 0.343 / 1.343, 0.02);
  EXPECT_EQ(broken.result, 2);
}

TEST(Pieces, CutByAFaceAreNotBroken) {
  const Vec3i n{40, 40, 40};
  const Occupancy whole(ball(n, {20, 20, 20}, 6)), cut(balls(n, 6, {{20, 20, 20}, {-4, 10, 10}}));
  EXPECT_EQ(comparePieces(whole, cut).brokenShare, 0);
  EXPECT_EQ(comparePieces(whole, cut).result, 1);
}

TEST(Pieces, DebrisOverGroundIsBroken) {
  const Vec3i n{40, 40, 40};
  const auto ground = [](const Vec3d& p) { return p.z - 15 - 2 * std::sin(p.x / 5); };
  const Occupancy example(makeField(n, ground));
  EXPECT_EQ(comparePieces(example, example).brokenShare, 0);
  const Occupancy littered(makeField(n, [&](const Vec3d& p) {
    return std::min(ground(p), length(p - Vec3d{20, 20, 28}) - 3);
  }));
  const Pieces pieces = comparePieces(example, littered);
  EXPECT_EQ(pieces.example, 0);
  EXPECT_EQ(pieces.result, 1);
  EXPECT_GT(pieces.brokenShare, 0.003);
  EXPECT_LT(pieces.brokenShare, 0.006);  // a ball of 113 cells in 25,000
}

TEST(Pieces, OfNothingAreNone) {
  const Occupancy nothing(emptyField({20, 20, 20})), dot(ball({20, 20, 20}, {9, 9, 9}, 3));
  for (const Pieces& p :
       {comparePieces(nothing, dot), comparePieces(dot, nothing), comparePieces(nothing, nothing)})
    EXPECT_EQ(p.brokenShare, 0);
  EXPECT_EQ(comparePieces(Occupancy(solidField({9, 9, 9})), dot).result, 1);
}

}  // namespace
}  // namespace exemplar
