// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/stand_ins.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh/mesh_health.h"
#include "mesh/primitives.h"
#include "synth/continuous/synthesize.h"
#include "tests/temporary_files.h"

namespace exemplar::continuous {
namespace {

const char* const kScene = R"(
kind = "solids"
ground = { height = 0, substance = "grass" }
[[object]]
file = "tree.obj"
box = [0, 0, 0, 2, 2, 4]
)";

TEST(StandIns, KeepTheProportionsOfTheirBox) {
  const SolidScene scene = readSolidScene(kScene, "trees.toml");
  ASSERT_EQ(scene.standIns.size(), 1u);
  EXPECT_EQ(scene.solids.solids.size(), 2u);
  int found = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    ContinuousResult result =
        synthesizeSolids(scene.solids, scene.looks,
                         {.size = {12, 12, 4}, .seed = seed, .density = 4, .learning = 4});
    ASSERT_EQ(result.outcome, Outcome::Complete);
    const auto placed = takeStandIns(result.model, scene.standIns);
    found += static_cast<int>(placed.size());
    for (const PlacedStandIn& box : placed) {
      const Vec3d size = box.box.size();
      EXPECT_NEAR(size.y, size.x, 1e-9);
      EXPECT_NEAR(size.z, 2 * size.x, 1e-9);
      EXPECT_EQ(box.box.min.z, 0);
    }
    // What is left is the ground alone, closed.
    const MeshHealth health = meshHealth(triangulate(result.model));
    EXPECT_TRUE(health.closed());
    EXPECT_NEAR(boundingBox(triangulate(result.model)).max.z, 0, 1e-12);
  }
  EXPECT_GT(found, 4);
}

TEST(StandIns, AreStretchedToTheirBox) {
  const TriangleMesh mesh = stretched(makeSphere({1, 2, 3}, 0.5, 12), {{0, 0, 0}, {2, 4, 8}});
  const Box3d box = boundingBox(mesh);
  EXPECT_NEAR(length(box.min), 0, 1e-12);
  EXPECT_NEAR(length(box.max - Vec3d{2, 4, 8}), 0, 1e-12);
}

TEST(StandIns, SayWhatIsWrong) {
  const auto message = [](const std::string& object) {
    return test::inputError(
        [&] { readSolidScene("kind = \"solids\"\n[[object]]\n" + object, "a.toml"); });
  };
  EXPECT_THAT(message("file = \"a.obj\""), testing::HasSubstr("'box'"));
  EXPECT_THAT(message("file = \"a.obj\"\nbox = [0, 0, 0, 2, 2, 0]"),
              testing::HasSubstr("low corner"));
  EXPECT_THAT(message("file = \"a.obj\"\nbox = [0, 0, 0, 71, 73, 4]"), testing::HasSubstr("64"));
  EXPECT_THAT(message("file = \"a.obj\"\nbox = [0, 0, 0, 2, 2, 2]\nkeep = \"yx\""),
              testing::HasSubstr("'keep'"));
}

}  // namespace
}  // namespace exemplar::continuous
