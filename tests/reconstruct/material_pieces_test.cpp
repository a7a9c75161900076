// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/material_pieces.h"

#include <gtest/gtest.h>

#include <set>

#include "core/random.h"

namespace exemplar {
namespace {

double energy(const std::vector<MaterialPiece>& pieces, const std::vector<MaterialJoint>& joints,
              const std::vector<std::uint32_t>& materials) {
  double sum = 0;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    if (materials[p] != pieces[p].material) sum += pieces[p].weight;
  }
  for (const MaterialJoint& joint : joints) {
    if (materials[joint.a] != materials[joint.b]) sum += joint.cost;
  }
  return sum;
}

std::vector<std::uint32_t> asTheyCame(const std::vector<MaterialPiece>& pieces) {
  std::vector<std::uint32_t> materials;
  for (const MaterialPiece& piece : pieces) materials.push_back(piece.material);
  return materials;
}

TEST(SettleMaterials, TheSmallerPartOfOneThingGivesIn) {
  const std::vector<MaterialPiece> pieces{{3, 5}, {7, 4}};
  const std::vector<MaterialJoint> joints{{0, 1, 10, 10}};
  EXPECT_EQ(settleMaterials(pieces, joints), (std::vector<std::uint32_t>{3, 3}));
}

TEST(SettleMaterials, BordersOfTheExampleStay) {
  const std::vector<MaterialPiece> pieces{{3, 5}, {7, 4}};
  const std::vector<MaterialJoint> joints{{0, 1, 10, 0.5}};
  EXPECT_EQ(settleMaterials(pieces, joints), (std::vector<std::uint32_t>{3, 7}));
}

TEST(SettleMaterials, NothingMovesWithoutJoints) {
  const std::vector<MaterialPiece> pieces{{3, 0}, {7, 1}, {1, 2}};
  EXPECT_EQ(settleMaterials(pieces, {}), asTheyCame(pieces));
  EXPECT_TRUE(settleMaterials({}, {}).empty());
}

// Two pieces of one material hold each other by a long joint; only together do they gain by taking
// what is around them.
TEST(SettleMaterials, WhatHasGrownTogetherMovesAsOne) {
  const std::vector<MaterialPiece> pieces{{0, 100}, {1, 1}, {1, 1}};
  const std::vector<MaterialJoint> joints{{0, 1, 4, 4}, {0, 2, 4, 4}, {1, 2, 6, 6}};
  std::vector<std::uint32_t> one = asTheyCame(pieces);
  one[1] = 0;
  ASSERT_GT(energy(pieces, joints, one), energy(pieces, joints, asTheyCame(pieces)));
  EXPECT_EQ(settleMaterials(pieces, joints), (std::vector<std::uint32_t>{0, 0, 0}));
}

TEST(SettleMaterials, NeverRaisesTheSumAndInventsNoMaterial) {
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    const Random random(trial);
    std::uint64_t draw = 0;
    const auto below = [&](int n) { return static_cast<std::uint32_t>(random.below(n, draw++)); };
    std::vector<MaterialPiece> pieces(2 + below(30));
    std::set<std::uint32_t> came;
    for (MaterialPiece& piece : pieces) {
      piece = {below(4), 3 * random.uniform(draw++)};
      came.insert(piece.material);
    }
    std::vector<MaterialJoint> joints(below(80));
    const auto count = static_cast<int>(pieces.size());
    for (MaterialJoint& joint : joints) {
      joint = {below(count), below(count), random.uniform(draw), 0};
      ++draw;
      joint.cost = joint.length * random.uniform(draw++);
    }
    const auto settled = settleMaterials(pieces, joints);
    ASSERT_EQ(settled.size(), pieces.size());
    EXPECT_LE(energy(pieces, joints, settled),
              energy(pieces, joints, asTheyCame(pieces)) + 1e-9 * double(joints.size() + 1));
    for (const std::uint32_t m : settled) EXPECT_TRUE(came.contains(m));
    // No piece can do better alone.
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      for (const std::uint32_t m : came) {
        auto other = settled;
        other[p] = m;
        EXPECT_GE(energy(pieces, joints, other), energy(pieces, joints, settled) - 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace exemplar
