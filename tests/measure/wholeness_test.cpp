// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/wholeness.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "measure/pieces.h"
#include "tests/example_shapes.h"
#include "tests/measure/fields.h"
#include "tests/planted_faults.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::box;
using testing::makeField;

Wholeness of(const DistanceField& example, const DistanceField& result) {
  return measureWholeness(Occupancy(example), Occupancy(result));
}
Integrity integrity(const DistanceField& field) {
  const Occupancy o(field);
  return integrityOf(o, natureOf(o));
}

TEST(Integrity, CountsTunnelsAndBubbles) {
  const Vec3i n{40, 40, 24};
  const auto torus = [](const Vec3d& p, double x) {
    return std::hypot(std::hypot(p.x - x, p.y - 20) - 6, p.z - 12) - 2.5;
  };
  Integrity found = integrity(makeField(n, [&](const Vec3d& p) { return torus(p, 12); }));
  EXPECT_EQ(found.pieces, 1);
  EXPECT_EQ(found.tunnels, 1);
  EXPECT_EQ(found.bubbles, 0);
  // Two linked bodies with a hole each, one of them with a pocket of air.
  found = integrity(makeField(n, [&](const Vec3d& p) {
    const double two = std::min(torus(p, 10), torus(p, 29));
    return std::max(two, 1.4 - length(p - Vec3d{16, 20, 12}));
  }));
  EXPECT_EQ(found.pieces, 2);
  EXPECT_EQ(found.tunnels, 2);
  EXPECT_EQ(found.bubbles, 1);
  // A hollow ball.
  found = integrity(makeField({32, 32, 32}, [](const Vec3d& p) {
    return std::abs(length(p - Vec3d{15, 16, 16}) - 10) - 2;
  }));
  EXPECT_EQ(found.tunnels, 0);
  EXPECT_EQ(found.bubbles, 1);
  // Cut open, it has none.
  found = integrity(makeField({32, 32, 32}, [](const Vec3d& p) {
    return std::max(std::abs(length(p - Vec3d{15, 16, 16}) - 10) - 2, p.z - 18);
  }));
  EXPECT_EQ(found.tunnels, 0);
  EXPECT_EQ(found.bubbles, 0);
}

TEST(Integrity, OfNoiseFitsTheEulerCharacteristic) {
  // Components and bubbles are counted on their own; here against each other's definitions.
  for (const std::uint64_t seed : {1, 2, 3}) {
    const DistanceField noise = testing::noise({20, 17, 70}, 0.45, seed);
    const Occupancy o(noise);
    const Integrity found = integrityOf(o, natureOf(o));
    std::int64_t characteristic = 0, large = 0;
    // Cells, pairs, squares and cubes, one by one.
    forEachCell(o.size(), [&](const Vec3i& p) {
      for (int set = 0; set < 8; ++set) {
        bool all = true;
        for (int corner = 0; corner < 8; ++corner) {
          if ((corner & set) != corner) continue;
          all = all && o.solid(p.x + (corner & 1), p.y + (corner >> 1 & 1), p.z + (corner >> 2));
        }
        const int dimension = (set & 1) + (set >> 1 & 1) + (set >> 2);
        characteristic += all ? (dimension % 2 ? -1 : 1) : 0;
      }
    });
    const auto components = connectedComponents(o);
    for (const Component& c : components) large += c.cells >= kSpeckCells;
    EXPECT_EQ(found.pieces, large);
    EXPECT_EQ(static_cast<std::int64_t>(components.size()) - found.tunnels + found.bubbles,
              characteristic);
  }
}

TEST(Integrity, FlatSquaresAreCountedByTheirFaces) {
  // 12 x 10 x 5 cells of solid, with air around: six sides, of which those 5 high hold no square of
  // 6; the top and the bottom count whole.
  const DistanceField slab = box({20, 20, 20}, {3.5, 4.5, 7.5}, {15.5, 14.5, 12.5});
  const Integrity found = integrity(slab);
  EXPECT_EQ(found.faces, 2 * (12 * 10 + 12 * 5 + 10 * 5));
  EXPECT_DOUBLE_EQ(found.flat[4] * static_cast<double>(found.faces), 120);
  EXPECT_DOUBLE_EQ(found.flat[5] * static_cast<double>(found.faces), 120);
  for (std::size_t d = 0; d < 4; ++d) EXPECT_EQ(found.flat[d], 0);
  // A ball has small flat caps at the most.
  const Integrity ball = integrity(testing::ball({40, 40, 40}, {20, 20, 20}, 12));
  double flat = 0;
  for (const double f : ball.flat) flat += f;
  EXPECT_LT(flat, 0.12);
}

TEST(Wholeness, OfTheExampleItselfIsWhole) {
  for (const testing::ShapeKind& kind : testing::shapeKinds()) {
    const DistanceField example = kind.make(kind.side, 0);
    const Wholeness w = of(example, example);
    EXPECT_EQ(w.pieces, w.examplePieces) << kind.name;
    EXPECT_EQ(w.slicedShare, 0) << kind.name;
    EXPECT_EQ(w.openShare, 0) << kind.name;
    EXPECT_EQ(*w.layers, 0) << kind.name;
    EXPECT_EQ(w.tunnels, w.exampleTunnels) << kind.name;
    if (kind.freeStanding) {
      EXPECT_EQ(w.pieces, 1) << kind.name;
      EXPECT_LT(w.floatingShare, 0.005) << kind.name;
    }
  }
}

TEST(Wholeness, SeesShards) {
  for (const testing::ShapeKind& kind : testing::shapeKinds()) {
    if (!kind.freeStanding) continue;
    const DistanceField example = kind.make(kind.side, 0);
    const Wholeness w = of(example, testing::shards(example));
    EXPECT_GT(w.pieces, 5) << kind.name;
    EXPECT_LT(w.largestShare, 0.6) << kind.name;
  }
  EXPECT_GT(of(testing::vase(), testing::shards(testing::vase())).floatingShare, 0.1);
}

TEST(Wholeness, SeesAShearedTop) {
  for (const char* name : {"tree", "village", "arch", "boulder", "temple", "terrain"})
    for (const testing::ShapeKind& kind : testing::shapeKinds()) {
      if (kind.name != std::string(name)) continue;
      const DistanceField example = kind.make(kind.side, 0);
      const double sheared = of(example, testing::shearedTop(example)).slicedShare;
      EXPECT_GT(sheared, 0.02) << name;
      // More than other samples of the same process have, by far.
      for (const std::uint64_t seed : {1, 2})
        EXPECT_GT(sheared, 3 * of(example, kind.make(kind.side, seed)).slicedShare) << name;
    }
  // A rim is too thin for squares: the heights show it.
  const DistanceField vase = testing::vase();
  EXPECT_GT(of(vase, testing::shearedTop(vase)).layers, 0.2);
  EXPECT_LT(of(vase, testing::vase(64, 1)).layers, 0.1);
}

TEST(Wholeness, SeesALostFloor) {
  const DistanceField village = testing::village();
  const Wholeness w = of(village, testing::lostFloor(village));
  EXPECT_EQ(w.pieces, 8);  // eight houses, joined by the plate before
  EXPECT_GT(w.layers, 0.3);
  EXPECT_LT(of(village, testing::village(64, 1)).layers, 0.1);
  const DistanceField terrain = testing::terrain();
  EXPECT_GT(of(terrain, testing::lostFloor(terrain)).slicedShare, 0.2);
}

TEST(Wholeness, SeesADoubledTower) {
  for (const char* name : {"vase", "tree", "temple"})
    for (const testing::ShapeKind& kind : testing::shapeKinds()) {
      if (kind.name != std::string(name)) continue;
      const DistanceField example = kind.make(kind.side, 0);
      EXPECT_GT(of(example, testing::doubled(example)).layers, 0.5) << name;
    }
}

TEST(Wholeness, SeesWhatTheBoxCuts) {
  for (const testing::ShapeKind& kind : testing::shapeKinds()) {
    const DistanceField example = kind.make(kind.side, 0);
    const Wholeness w = of(example, testing::cutByBox(example));
    // Ground and materials are cut there themselves.
    if (kind.freeStanding) {
      EXPECT_GT(w.openShare, 0.01) << kind.name;
    } else {
      EXPECT_EQ(w.openShare, 0) << kind.name;
    }
  }
}

TEST(Wholeness, SeesTornShells) {
  const DistanceField vase = testing::vase();
  const Wholeness w = of(vase, testing::torn(vase));
  EXPECT_GT(w.tunnels, 4 * w.exampleTunnels);
  EXPECT_GT(w.exampleTunnels, 0);  // the handle
}

TEST(Wholeness, SeesWhatFloats) {
  // A table and a cup: on the table, half a voxel over it, and in the air.
  const auto scene = [](double gap) {
    return makeField({40, 40, 40}, [=](const Vec3d& p) {
      const double table = std::min(testing::boxDistance(p, {8, 8, 16}, {32, 32, 19}),
                                    testing::boxDistance(p, {18, 18, 4}, {22, 22, 17}));
      return std::min(table, testing::boxDistance(p, {16, 16, 19.4 + gap}, {24, 24, 26 + gap}));
    });
  };
  EXPECT_EQ(integrity(scene(0)).floatingShare, 0);
  EXPECT_EQ(integrity(scene(1.5)).floatingShare, 0);
  EXPECT_EQ(integrity(scene(1.5)).pieces, 2);
  EXPECT_GT(integrity(scene(6)).floatingShare, 0.1);
  // In a packing balls float, as they do in the example.
  const Wholeness packed = of(testing::packing(), testing::packing(64, 2));
  EXPECT_GT(packed.exampleFloatingShare, 0);
}

TEST(Wholeness, LayersOfAHigherResultCorrespondInProportion) {
  // A wedge, and one twice as high.
  const auto wedge = [](int height) {
    return makeField({32, 8, height},
                     [=](const Vec3d& p) { return p.x - 32 * (p.z + 0.5) / height; });
  };
  EXPECT_LT(*of(wedge(32), wedge(64)).layers, 0.03);
  EXPECT_GT(
      *of(wedge(32), makeField({32, 8, 64}, [](const Vec3d& p) { return p.x - 15.5; })).layers,
      0.3);
}

TEST(Wholeness, OfNothing) {
  const DistanceField empty = testing::emptyField({16, 16, 16}), vase = testing::vase(32);
  EXPECT_FALSE(of(empty, vase).layers);
  const Wholeness w = of(vase, empty);
  EXPECT_EQ(w.pieces, 0);
  EXPECT_DOUBLE_EQ(*w.layers, 1);
}

TEST(Wholeness, IsTheSameAtOneAndEightThreads) {
  const DistanceField a = testing::village(40, 1), b = testing::village(48, 2);
  const auto measure = [&] {
    const Wholeness w = of(a, b);
    return std::array{w.slicedShare, w.tunnels, w.floatingShare, *w.layers};
  };
  EXPECT_EQ(testing::onThreads(1, measure), testing::onThreads(8, measure));
}

}  // namespace
}  // namespace exemplar
