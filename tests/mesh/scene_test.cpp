// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/error.h"
#include "core/file.h"
#include "mesh/mesh_health.h"
#include "mesh/procedural/processes.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

fs::path sceneFile(const std::string& name) {
  return fs::path(EXEMPLAR_SOURCE_DIR) / "scenes" / (name + ".toml");
}

class BundledScene : public testing::TestWithParam<std::string> {};

TEST_P(BundledScene, IsClosedManifoldOrientedAndReachesPastItsWindow) {
  const Scene scene = readScene(sceneFile(GetParam()));
  const MeshHealth health = meshHealth(scene.mesh);
  EXPECT_TRUE(health.closed());
  EXPECT_TRUE(health.manifold());
  EXPECT_TRUE(health.oriented());
  EXPECT_EQ(health.degenerateTriangles, 0);
  EXPECT_GT(health.signedVolume, 0);
  EXPECT_FALSE(scene.mesh.materials.empty());
  const Box3d mesh = boundingBox(scene.mesh);
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_LT(mesh.min[axis], scene.box.min[axis]);
    EXPECT_GT(mesh.max[axis], scene.box.max[axis]);
  }
}

TEST_P(BundledScene, IsTheSameEachTimeAndAnotherForAnotherSeed) {
  const Scene a = readScene(sceneFile(GetParam())), b = readScene(sceneFile(GetParam()));
  const Scene other = readScene(sceneFile(GetParam()), {.seed = 4711});
  EXPECT_EQ(a.mesh.positions, b.mesh.positions);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_NE(a.mesh.positions, other.mesh.positions);
}

TEST_P(BundledScene, GrowsWithItsExtent) {
  const Scene one = readScene(sceneFile(GetParam()));
  const Scene two = readScene(sceneFile(GetParam()), {.extent = {2, 1, 1}});
  EXPECT_NEAR(two.box.size().x, 2 * one.box.size().x, 1e-9);
  EXPECT_NEAR(two.box.size().y, one.box.size().y, 1e-9);
  EXPECT_GT(boundingBox(two.mesh).size().x, 1.5 * one.box.size().x);
}

/// Whether a scene is one that another room reads: of solids between planes (synth/continuous), or
/// a volume of labels (voxelize).
bool isReadElsewhere(const std::string& name) {
  const std::string text = readFile(sceneFile(name));
  return text.find("\nkind = \"solids\"") != std::string::npos ||
         text.find("\nkind = \"volume\"") != std::string::npos;
}

/// The other bundled scenes that are, or are not, made of model pieces.
std::vector<std::string> scenesOf(bool pieces) {
  std::vector<std::string> names;
  for (const std::string& name : bundledScenes()) {
    if (isReadElsewhere(name)) continue;
    if (isPieceScene(sceneFile(name)) == pieces) names.push_back(name);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, BundledScene, testing::ValuesIn(scenesOf(false)),
                         [](const auto& test) { return test.param; });

TEST(BundledScenes, AreTheSevenOfLagaesPaperThreeToLayOnSurfacesAndTheEightOfMerrellsThesis) {
  EXPECT_THAT(scenesOf(false),
              testing::ElementsAre("balls", "bark", "bricks", "chainmail", "fibers", "grass",
                                   "grid", "metal", "scales", "terrain"));
  EXPECT_THAT(scenesOf(true), testing::ElementsAre("canyon", "castle", "city", "cluster", "forest",
                                                   "gears", "library", "paths"));
}

class PieceScene : public testing::TestWithParam<std::string> {};

TEST_P(PieceScene, FillsItsBoxOfWholeCells) {
  const Scene scene = readScene(sceneFile(GetParam()));
  ASSERT_TRUE(scene.cell.has_value());
  const Vec3d size = scene.box.size();
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = size[axis] / (*scene.cell)[axis];
    EXPECT_EQ(cells, std::floor(cells));
    EXPECT_GE(cells, 5);
  }
  const Box3d mesh = boundingBox(scene.mesh);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GE(mesh.min[axis], scene.box.min[axis]);
    EXPECT_LE(mesh.max[axis], scene.box.max[axis]);
  }
  // Something reaches each side, so that results have sides, too; the top layer is air.
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_EQ(mesh.min[axis], scene.box.min[axis]);
    EXPECT_EQ(mesh.max[axis], scene.box.max[axis]);
  }
  EXPECT_LE(mesh.max.z, scene.box.max.z - 1 + 1e-9);
  EXPECT_FALSE(scene.mesh.materials.empty());
}

TEST_P(PieceScene, IsTheSameEachTimeAndOfOneSize) {
  const Scene a = readScene(sceneFile(GetParam())), b = readScene(sceneFile(GetParam()));
  EXPECT_EQ(a.mesh.positions, b.mesh.positions);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_THROW(readScene(sceneFile(GetParam()), {.extent = {2, 1, 1}}), InputError);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PieceScene, testing::ValuesIn(scenesOf(true)),
                         [](const auto& test) { return test.param; });

/// The vertices of each connected component, in the order of their first vertex.
std::vector<std::vector<Vec3d>> components(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> root(mesh.positions.size());
  for (std::uint32_t v = 0; v < root.size(); ++v) root[v] = v;
  const auto find = [&](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& t : mesh.triangles) {
    for (int corner = 1; corner < 3; ++corner) {
      const std::uint32_t a = find(t[0]), b = find(t[corner]);
      root[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<std::vector<Vec3d>> parts(mesh.positions.size());
  for (std::uint32_t v = 0; v < root.size(); ++v) parts[find(v)].push_back(mesh.positions[v]);
  std::erase_if(parts, [](const auto& part) { return part.empty(); });
  return parts;
}

struct Ring {
  Vec3d center;
  std::vector<Vec3d> wire;  ///< the middle of the wire, in order around the ring
};

/// The middle of a torus' wire, from its 64 x 16 vertices in rows around the wire.
Ring ringOf(const std::vector<Vec3d>& vertices) {
  Ring ring;
  const std::size_t around = vertices.size() / 64;
  for (std::size_t n = 0; n < 64; ++n) {
    Vec3d sum{};
    for (std::size_t m = 0; m < around; ++m) sum += vertices[n * around + m];
    ring.wire.push_back(sum / static_cast<double>(around));
    ring.center += ring.wire.back() / 64.0;
  }
  return ring;
}

double leastDistance(const Ring& a, const Ring& b) {
  double least = 1e30;
  for (const Vec3d& p : a.wire) {
    for (const Vec3d& q : b.wire) least = std::min(least, length(p - q));
  }
  return least;
}

/// Gauss' linking integral of two closed polygons, by the midpoint rule; near a whole number while
/// segments are short beside the curves' distance.
double linkingNumber(const Ring& a, const Ring& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.wire.size(); ++i) {
    const Vec3d p = a.wire[i], dp = a.wire[(i + 1) % a.wire.size()] - p;
    for (std::size_t j = 0; j < b.wire.size(); ++j) {
      const Vec3d q = b.wire[j], dq = b.wire[(j + 1) % b.wire.size()] - q;
      const Vec3d r = p + dp * 0.5 - q - dq * 0.5;
      sum += dot(r, cross(dp, dq)) / std::pow(length(r), 3);
    }
  }
  return sum / (4 * std::numbers::pi);
}

TEST(Chainmail, EveryRingPassesThroughFourOthersAndTouchesNone) {
  const ChainmailProcess process;
  const ProcessSample sample = makeChainmail(process, {1, 1, 1}, 5);
  std::vector<Ring> rings;
  for (const auto& part : components(sample.mesh)) rings.push_back(ringOf(part));
  int inner = 0;
  for (const Ring& ring : rings) {
    if (!sample.box.contains(ring.center)) continue;
    ++inner;
    int linked = 0;
    for (const Ring& other : rings) {
      if (&other == &ring || length(other.center - ring.center) > 2.2 * process.ringRadius)
        continue;
      EXPECT_GT(leastDistance(ring, other), 2 * process.wireRadius);
      linked += std::abs(linkingNumber(ring, other)) > 0.5;
    }
    EXPECT_EQ(linked, 4);
  }
  EXPECT_GE(inner, 25);
}

TEST(Balls, RestOnOneAnotherWithoutOverlap) {
  const BallsProcess process;
  const ProcessSample sample = makeBalls(process, {1, 1, 1}, 3);
  std::vector<Vec3d> centers;
  double radius = 0;
  for (const auto& part : components(sample.mesh)) {
    Vec3d sum{};
    for (const Vec3d& p : part) sum += p;
    centers.push_back(sum / static_cast<double>(part.size()));
    radius = length(part.front() - centers.back());
  }
  int inner = 0, touching = 0;
  for (const Vec3d& a : centers) {
    if (!sample.box.contains(a)) continue;
    ++inner;
    int contacts = 0;
    for (const Vec3d& b : centers) {
      if (&a == &b) continue;
      EXPECT_GT(length(a - b), 2 * radius * (1 - 1e-9));
      contacts += length(a - b) < 2 * radius * 1.02;
    }
    touching += contacts >= 3;
  }
  // A random packing: between the loosest that stands (0.52) and the densest (0.64). The window's
  // border moves the count of centers by a few of about 140.
  const double share = inner * 4.18879 * std::pow(radius, 3) / std::pow(process.side, 3);
  EXPECT_GT(share, 0.5);
  EXPECT_LT(share, 0.66);
  EXPECT_GT(touching, 0.95 * inner);
}

struct BadScene {
  const char* text;
  const char* says;
};

TEST(ReadScene, NamesTheLineAndTheKeyThatIsWrong) {
  const fs::path path = fs::temp_directory_path() / "exemplar_bad_scene.toml";
  for (const BadScene& bad : std::initializer_list<BadScene>{
           {"kind = \"balls\"\nradios = 3\n", ":2: unknown key 'radios'"},
           {"kind = \"balls\"\n\nradius = -1\n", ":3: 'radius' must be"},
           {"kind = \"balls\"\nradius = nan\n", ":2: 'radius' must be"},
           {"kind = \"balls\"\ncolors = 2.5\n", ":2: 'colors' must be a whole number"},
           {"kind = \"balls\"\nscale = [2, 2]\n", ":2: 'scale' must be three numbers"},
           {"kind = \"cheese\"\n", ":1: unknown kind 'cheese'"},
           {"kind = 3\n", ":1: 'kind' must be a string"},
           {"seed = 3\n", "'kind' is missing"},
           {"kind = = 3\n", ":1: "},
           {"kind = \"\"\"a\nb\"\"\"\n", ":1: unknown kind 'a b'"},
           {"[# to\n", ": not valid TOML"},
           {"kind = \"balls\"\nr\xC3\xA4"
            "dius = 3\n",
            ":2: "},
           {"a = \"\"\"\\\xEF\xB7\xBB\"\"\"\n", ":1: "},
       }) {
    std::ofstream(path) << bad.text;
    try {
      readScene(path);
      ADD_FAILURE() << bad.text;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr(bad.says));
    }
  }
  fs::remove(path);
}

TEST(FindScene, ListsTheNamesThereAre) {
  EXPECT_EQ(findScene("balls"), sceneFile("balls"));
  try {
    findScene("cheese");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("chainmail"));
  }
}

}  // namespace
}  // namespace exemplar
