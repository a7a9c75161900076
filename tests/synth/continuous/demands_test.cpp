// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Where things are, how they hang together, and what is cut off.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mesh/mesh_health.h"
#include "synth/continuous/synthesize.h"
#include "tests/synth/continuous/fixtures.h"
#include "tests/temporary_files.h"

namespace exemplar::continuous {
namespace {

ContinuousResult make(const Solids& solids, const ContinuousOptions& options) {
  std::vector<Material> looks(solids.substances.size());
  return synthesizeSolids(solids, looks, options);
}

using Text = std::set<std::string>;
/// The faces of a model, each by its corners from the first in order on, moved by `change`.
template <class Change>
Text facesOf(const PolygonModel& model, const Change& change) {
  Text faces;
  for (const Polygon& polygon : model.polygons) {
    std::set<std::string> corners;
    for (const auto& loop : polygon.loops) {
      for (const std::uint32_t c : loop) {
        const Vec3d p = change(model.points[c].approximately());
        corners.insert(std::to_string(p.x) + "," + std::to_string(p.y) + "," + std::to_string(p.z));
      }
    }
    std::string face;
    for (const std::string& corner : corners) face += corner + " ";
    faces.insert(face);
  }
  return faces;
}

TEST(Mirror, ResultsAreTheirOwnImage) {
  for (const char* name : {"gabled", "cube", "pyramid"}) {
    const Solids solids = solidsOf(name);
    const PlaneLattice lattice = latticeOf(solids);
    for (const Axes axes : {Axes{true, false, false}, Axes{true, true, false}}) {
      ContinuousOptions options{
          .size = {10, 10, 4}, .seed = 3, .density = 2, .learning = 2, .mirror = axes};
      const ContinuousResult result = make(solids, options);
      ASSERT_EQ(result.outcome, Outcome::Complete) << name;
      const ExactBox window = windowOf(lattice, options.size);
      EXPECT_GT(result.model.polygons.size(), 6u) << name;
      for (int axis = 0; axis < 2; ++axis) {
        if (!axes[axis]) continue;
        const double twice = static_cast<double>(window.low[axis] + window.high[axis]);
        const auto same = [](const Vec3d& p) { return p + Vec3d{}; };
        const auto image = [&](Vec3d p) {
          p[axis] = twice - p[axis] + 0.0;
          return p;
        };
        EXPECT_EQ(facesOf(result.model, same), facesOf(result.model, image)) << name;
      }
    }
  }
}

TEST(Mirror, SaysWhereThereIsNoImage) {
  // A wedge with one slope has no image of it.
  const Solids wedge = readSolidScene(R"(
kind = "solids"
[[part]]
substance = "brick"
points = [[0, 0, 0], [4, 0, 0], [0, 2, 0], [4, 2, 0], [0, 0, 4], [0, 2, 4]]
)",
                                      "wedge")
                           .solids;
  EXPECT_THAT(test::inputError([&] {
                make(wedge, {.size = {6, 4, 3}, .mirror = {true, false, false}});
              }),
              testing::HasSubstr("`mirror` x"));
}

TEST(Groups, SolidsHangTogether) {
  for (const char* name : {"cube", "cross-gabled"}) {
    const Solids solids = solidsOf(name);
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const ContinuousResult result = make(
          solids, {.size = {14, 14, 4}, .seed = seed, .density = 2, .learning = 3, .groups = 2});
      ASSERT_EQ(result.outcome, Outcome::Complete) << name;
      EXPECT_GE(result.statistics.groups, 1) << name;
      EXPECT_LE(result.statistics.groups, 2) << name;
      if (!solids.ground) {
        EXPECT_LE(meshHealth(triangulate(result.model)).components, 2) << name;
      }
    }
  }
}

TEST(DensityMap, NothingIsWhereItIsBlack) {
  const Solids solids = solidsOf("gabled");
  const PlaneLattice lattice = latticeOf(solids);
  ContinuousOptions options{.size = {16, 8, 4}, .seed = 1, .density = 2, .learning = 3};
  const ContinuousResult all = make(solids, options);
  DensityMap map{{2, 1, 1}, {0, 0.9f}};
  options.map = map;
  const ContinuousResult half = make(solids, options);
  ASSERT_EQ(half.outcome, Outcome::Complete);
  const ExactBox box = windowOf(lattice, options.size);
  const double middle = static_cast<double>(box.low.x + box.high.x) / 2;
  const auto built = [&](const PolygonModel& model, bool left) {
    int corners = 0;
    for (const ExactPoint& p : model.points) {
      const Vec3d q = p.approximately();
      if (q.z > 0 && (q.x < middle) == left) ++corners;
    }
    return corners;
  };
  EXPECT_GT(built(all.model, true), 0);
  EXPECT_EQ(built(half.model, true), 0);
  EXPECT_GT(built(half.model, false), 0);
}

TEST(OpenSides, CutThroughSolids) {
  const Solids solids = solidsOf("gabled");
  const PlaneLattice lattice = latticeOf(solids);
  int cut = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const ContinuousOptions options{.size = {10, 10, 4},
                                    .seed = seed,
                                    .density = 2,
                                    .learning = 3,
                                    .open = {true, true, false}};
    const ContinuousResult result = make(solids, options);
    ASSERT_EQ(result.outcome, Outcome::Complete);
    const MeshHealth health = meshHealth(triangulate(result.model));
    EXPECT_TRUE(health.closed());
    EXPECT_TRUE(health.oriented());
    const double low = static_cast<double>(lattice.origin.x);
    const double high = low + 10.0 * static_cast<double>(lattice.spacing.x);
    for (const ExactPoint& p : result.model.points) {
      const Vec3d q = p.approximately();
      EXPECT_GE(q.x, low);
      EXPECT_LE(q.x, high);
      cut += q.z > 0 && (q.x == low || q.x == high);
    }
  }
  EXPECT_GT(cut, 0);
}

TEST(Jitter, MovesFacesAndKeepsTheirOrder) {
  const Solids solids = solidsOf("arch");
  ContinuousOptions options{.size = {12, 12, 4}, .seed = 2, .density = 2, .learning = 3};
  const ContinuousResult straight = make(solids, options);
  options.jitter = 0.8;
  const ContinuousResult moved = make(solids, options);
  ASSERT_EQ(moved.model.polygons.size(), straight.model.polygons.size());
  int differ = 0;
  for (std::size_t p = 0; p < moved.model.points.size(); ++p) {
    const Vec3d a = straight.model.toWorld(straight.model.points[p]),
                b = moved.model.toWorld(moved.model.points[p]);
    differ += length(a - b) > 0;
    // Less than half a step of two units along each axis.
    for (int axis = 0; axis < 3; ++axis) EXPECT_LT(std::abs(a[axis] - b[axis]), 1);
    if (a.z == 0) {
      EXPECT_EQ(b.z, 0);
    }
  }
  EXPECT_GT(differ, 0);
  const MeshHealth health = meshHealth(triangulate(moved.model));
  EXPECT_TRUE(health.closed());
  EXPECT_TRUE(health.oriented());
  EXPECT_EQ(health.degenerateTriangles, 0);
  EXPECT_THAT(test::inputError([&] {
                make(solidsOf("gabled"), {.size = {6, 6, 4}, .jitter = 0.5});
              }),
              testing::HasSubstr("`jitter`"));
}

TEST(ObjectSize, LargerSolidsHaveFewerCorners) {
  const Solids solids = readSolidScene(R"(
kind = "solids"
[[part]]
substance = "brick"
box = [0, 0, 0, 6, 6, 6]
[[part]]
substance = "brick"
box = [10, 0, 0, 12, 2, 2]
)",
                                       "boxes")
                            .solids;
  double corners[2] = {}, within[2] = {};
  for (int large = 0; large < 2; ++large) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const ContinuousResult result = make(solids, {.size = {12, 12, 12},
                                                    .seed = seed,
                                                    .density = 1.5,
                                                    .learning = 10,
                                                    .objectSize = large ? 2.0 : 0.6});
      corners[large] += result.statistics.shares[static_cast<int>(FigureClass::Corner)];
      within[large] += 1 - result.statistics.shares[static_cast<int>(FigureClass::Empty)];
    }
  }
  EXPECT_LT(corners[1] / within[1], corners[0] / within[0]);
}

}  // namespace
}  // namespace exemplar::continuous
