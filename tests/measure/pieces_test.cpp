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

Occupancy cellsOf(const Vec3i& size, const std::vector<Vec3i>& solid) {
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
  EXPECT_EQ(connectedComponents(cellsOf({9, 9, 9}, {{3, 3, 3}, {4, 3, 3}})).size(), 1u);
  EXPECT_EQ(connectedComponents(cellsOf({9, 9, 9}, {{3, 3, 3}, {4, 4, 3}})).size(), 2u);
  EXPECT_EQ(connectedComponents(cellsOf({9, 9, 9}, {{3, 3, 3}, {4, 4, 4}})).size(), 2u);
}

TEST(Pieces, AreComponentsThatTouchNoFace) {
  const Vec3i n{40, 40, 40};
  const DistanceField o = balls(n, 5, {{10, 10, 10}, {28, 28, 28}, {10, 38, 10}, {20, 10, 28}});
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
  const DistanceField whole = balls(n, 6, {{12, 12, 12}, {27, 27, 27}});
  const auto both = [&](double radius) {
    return makeField(n, [&](const Vec3d& p) {
      return std::min(length(p - Vec3d{12, 12, 12}) - 6, length(p - Vec3d{27, 27, 27}) - radius);
    });
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
  const DistanceField whole = ball(n, {20, 20, 20}, 6);
  const DistanceField cut = balls(n, 6, {{20, 20, 20}, {-4, 10, 10}});
  EXPECT_EQ(comparePieces(whole, cut).brokenShare, 0);
  EXPECT_EQ(comparePieces(whole, cut).result, 1);
}

TEST(Pieces, DebrisOverGroundIsBroken) {
  const Vec3i n{40, 40, 40};
  const auto ground = [](const Vec3d& p) { return p.z - 15 - 2 * std::sin(p.x / 5); };
  const DistanceField example = makeField(n, ground);
  EXPECT_EQ(comparePieces(example, example).brokenShare, 0);
  const DistanceField littered = makeField(n, [&](const Vec3d& p) {
    return std::min(ground(p), length(p - Vec3d{20, 20, 28}) - 3);
  });
  const Pieces pieces = comparePieces(example, littered);
  EXPECT_EQ(pieces.example, 0);
  EXPECT_EQ(pieces.result, 1);
  EXPECT_GT(pieces.brokenShare, 0.003);
  EXPECT_LT(pieces.brokenShare, 0.006);  // a ball of 113 cells in 25,000
}

TEST(Pieces, OfBodiesThatRestOnEachOtherBeginBelowTheSurface) {
  // 27 balls that touch each other, and one that touches them and the box: one component of cells.
  const Vec3i n{56, 56, 56};
  std::vector<Vec3d> centers;
  for (int b = 0; b < 27; ++b)
    centers.push_back({15.5 + 12 * (b % 3), 15.5 + 12 * (b / 3 % 3), 15.5 + 12 * (b / 9)});
  // `crack` is half the width of a crack through the lowest nine.
  const auto heap = [&](double crack) {
    return makeField(n, [&, crack](const Vec3d& p) {
      double phi = length(p - Vec3d{3.5, 15.5, 15.5}) - 6;
      for (std::size_t b = 0; b < centers.size(); ++b) {
        double ball = length(p - centers[b]) - 6;
        if (b < 9) ball = std::max(ball, crack - std::abs(p.x - centers[b].x));
        phi = std::min(phi, ball);
      }
      return phi;
    });
  };
  const DistanceField whole = heap(-1);
  EXPECT_EQ(connectedComponents(Occupancy(whole)).size(), 1u);
  const Pieces pieces = comparePieces(whole, whole);
  EXPECT_EQ(pieces.depth, 0.5);
  EXPECT_EQ(pieces.example, 27);
  EXPECT_EQ(pieces.brokenShare, 0);

  // Nine of them in halves that lack the crack's two layers of cells, a quarter of the ball.
  const Pieces cracked = comparePieces(whole, heap(0.6));
  EXPECT_EQ(cracked.result, 18 + 2 * 9);
  EXPECT_NEAR(cracked.brokenShare, 9 * 0.75 / (18 + 9 * 0.75), 0.04);
}

TEST(Pieces, AreCountedAtTheSurfaceWhereTheyAreWholeThere) {
  const Vec3i n{40, 40, 40};
  const DistanceField field = balls(n, 5, {{10, 10, 10}, {28, 28, 28}});
  EXPECT_EQ(comparePieces(field, field).depth, 0);
  const DistanceField ground = makeField(n, [](const Vec3d& p) { return p.z - 15; });
  EXPECT_EQ(comparePieces(ground, field).depth, 0);
}

TEST(Pieces, OfNothingAreNone) {
  const DistanceField nothing = emptyField({20, 20, 20}), dot = ball({20, 20, 20}, {9, 9, 9}, 3);
  for (const Pieces& p :
       {comparePieces(nothing, dot), comparePieces(dot, nothing), comparePieces(nothing, nothing)})
    EXPECT_EQ(p.brokenShare, 0);
  EXPECT_EQ(comparePieces(solidField({9, 9, 9}), dot).result, 1);
}

}  // namespace
}  // namespace exemplar
