// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What may be asked of the engine continuous, by the command, judged by the files it writes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/disjoint_sets.h"
#include "core/file.h"
#include "mesh/image.h"
#include "mesh/mesh_file.h"
#include "tests/apps/run_command.h"

namespace exemplar {
namespace {

using testing::HasSubstr;

struct Made {
  TriangleMesh mesh;
  nlohmann::json stats;
  std::string out;
};

/// Makes `example` and reads what was written.
Made make(const TestFolder& folder, const std::string& example, const std::string& arguments) {
  const CommandResult run =
      runExemplar("synth " + example + " -o o.obj --engine continuous --stats s.json " + arguments,
                  folder.path());
  EXPECT_EQ(run.status, 0) << run.err;
  if (run.status != 0) return {};
  return {readMesh(folder / "o.obj"), nlohmann::json::parse(readFile(folder / "s.json")),
          run.out + run.err};
}

/// Corners of what is built on the ground, which is at height 0, rounded to thousandths.
std::set<std::array<std::int64_t, 3>> cornersAbove(const TriangleMesh& mesh) {
  std::set<std::array<std::int64_t, 3>> corners;
  for (const Vec3d& p : mesh.positions) {
    if (p.z > 1e-6)
      corners.insert({std::llround(1e3 * p.x), std::llround(1e3 * p.y), std::llround(1e3 * p.z)});
  }
  return corners;
}

/// Sets of triangles that share corners.
int piecesOf(const TriangleMesh& mesh) {
  DisjointSets pieces(mesh.positions.size());
  for (const auto& t : mesh.triangles) {
    pieces.join(t[0], t[1]);
    pieces.join(t[0], t[2]);
  }
  std::set<std::uint32_t> roots;
  for (const auto& t : mesh.triangles) roots.insert(pieces.find(t[0]));
  return static_cast<int>(roots.size());
}

TEST(ContinuousCommand, GroupsHangTogether) {
  const TestFolder folder;
  const Made one = make(folder, "plumbing", "--scale 1.2,1.2,1 --groups 2 --seed 4");
  EXPECT_GE(one.stats["groups"], 1);
  EXPECT_LE(one.stats["groups"], 2);
  EXPECT_GT(one.mesh.triangles.size(), 100u);
  EXPECT_LE(piecesOf(one.mesh), 2);
  // Without it, pipes hang in more pieces.
  EXPECT_GT(piecesOf(make(folder, "plumbing", "--scale 1.2,1.2,1 --groups 0 --seed 4").mesh), 2);
}

TEST(ContinuousCommand, AGuideSaysWhereNothingIs) {
  const TestFolder folder;
  Image8 left{8, 8, 1, {}};
  for (int n = 0; n < 64; ++n) left.pixels.push_back(n % 8 < 4 ? 230 : 0);
  writePng(folder / "left.png", left);
  const Made all = make(folder, "houses", "--scale 2,2,1.5"),
             half = make(folder, "houses", "--scale 2,2,1.5 --guide left.png");
  const Box3d box = boundingBox(half.mesh);
  const double middle = (box.min.x + box.max.x) / 2;
  const auto right = [&](const TriangleMesh& mesh) {
    return std::ranges::count_if(mesh.positions,
                                 [&](const Vec3d& p) { return p.z > 1e-6 && p.x > middle + 1e-6; });
  };
  EXPECT_GT(right(all.mesh), 0);
  EXPECT_EQ(right(half.mesh), 0);
  EXPECT_FALSE(cornersAbove(half.mesh).empty());
}

TEST(ContinuousCommand, MirroredResultsAreTheirImage) {
  const TestFolder folder;
  const Made made = make(folder, "skyscrapers", "--size 21,14,5 --mirror x");
  const auto corners = cornersAbove(made.mesh);
  ASSERT_FALSE(corners.empty());
  const Box3d box = boundingBox(made.mesh);
  const std::int64_t twice = std::llround(1e3 * (box.min.x + box.max.x));
  for (const auto& [x, y, z] : corners)
    EXPECT_TRUE(corners.contains({twice - x, y, z})) << x << " " << y << " " << z;
  const auto plain = cornersAbove(make(folder, "skyscrapers", "--size 21,14,5").mesh);
  EXPECT_TRUE(std::ranges::any_of(plain, [&](const auto& c) {
    return !plain.contains({twice - c[0], c[1], c[2]});
  }));
}

TEST(ContinuousCommand, OpenSidesCutThroughWhatIsBuilt) {
  const TestFolder folder;
  const auto onSides = [](const TriangleMesh& mesh) {
    const Box3d box = boundingBox(mesh);
    return std::ranges::count_if(mesh.positions, [&](const Vec3d& p) {
      return p.z > 1e-6 && (p.x < box.min.x + 1e-6 || p.x > box.max.x - 1e-6);
    });
  };
  const Made open = make(folder, "houses", "--scale 2,2,1.5 --open-sides x,y");
  EXPECT_GT(onSides(open.mesh), 0);
  EXPECT_TRUE(open.stats["mesh"]["closed"]);
  EXPECT_EQ(onSides(make(folder, "houses", "--scale 2,2,1.5").mesh), 0);
}

TEST(ContinuousCommand, LargerObjectsHaveFewerCorners) {
  const TestFolder folder;
  const auto corners = [&](const std::string& size) {
    double sum = 0;
    for (const char* seed : {"1", "2", "3"})
      sum += make(folder, "skyscrapers", "--object-size " + size + " --seed " + seed)
                 .stats["share_corner"]
                 .get<double>();
    return sum;
  };
  EXPECT_LT(corners("2"), 0.8 * corners("1"));
}

TEST(ContinuousCommand, JitterMovesFacesOutOfTheirRows) {
  const TestFolder folder;
  const auto offRows = [](const TriangleMesh& mesh) {
    int off = 0;  // skyscrapers: planes every 10 meters
    for (const auto& [x, y, z] : cornersAbove(mesh)) off += x % 10'000 != 0 || y % 10'000 != 0;
    return off;
  };
  const Made moved = make(folder, "skyscrapers", "--jitter 0.6");
  EXPECT_GT(offRows(moved.mesh), 20);
  EXPECT_TRUE(moved.stats["mesh"]["closed"]);
  const Made straight = make(folder, "skyscrapers", "");
  EXPECT_EQ(offRows(straight.mesh), 0);
  EXPECT_EQ(moved.mesh.triangles.size(), straight.mesh.triangles.size());
}

TEST(ContinuousCommand, MeshesComeBackIntoTheirBoxesScaledAlike) {
  const TestFolder folder;
  // A pointed roof of its own color, 2 x 2 x 2 in a box of 4 x 4 x 4 units.
  writeFile(folder / "tip.obj",
            "v 0 0 0\nv 2 0 0\nv 2 0 -2\nv 0 0 -2\nv 1 2 -1\n"
            "f 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
  writeFile(folder / "tips.toml", R"(kind = "solids"
scale = [4, 4, 2]
ground = { height = 0, substance = "grass" }
[[part]]
substance = "stone"
box = [0, 0, 0, 4, 4, 4]
[[object]]
file = "tip.obj"
box = [0, 0, 4, 4, 4, 8]
)");
  int tips = 0;
  for (const char* seed : {"1", "2", "3"}) {
    const Made made = make(folder, "tips.toml", std::string("--density 2 --seed ") + seed);
    // A corner in the middle of four others at the same height, below by the width of their square.
    std::map<std::array<std::int64_t, 3>, int> corners;
    for (const Vec3d& p : made.mesh.positions)
      ++corners[{std::llround(1e3 * p.x), std::llround(1e3 * p.y), std::llround(1e3 * p.z)}];
    for (const auto& [at, count] : corners) {
      for (std::int64_t half = 500; half <= 20'000; half += 500) {
        const auto [x, y, z] = at;
        const std::int64_t base = z - 2 * half;
        if (corners.contains({x - half, y - half, base}) &&
            corners.contains({x + half, y + half, base}) &&
            corners.contains({x + half, y - half, base}) &&
            corners.contains({x - half, y + half, base}))
          ++tips;
      }
    }
    EXPECT_TRUE(made.stats["mesh"]["closed"]);
  }
  EXPECT_GT(tips, 0);
}

TEST(ContinuousCommand, ScenesBringTheirOwnSettings) {
  const TestFolder folder;
  const auto write = [&](const std::string& settings) {
    writeFile(folder / "s.toml", "kind = \"solids\"\n[settings]\n" + settings +
                                     "[[part]]\nsubstance = \"brick\"\nbox = [0, 0, 0, 2, 2, 2]\n");
  };
  write("thin = [\"brick=x\", \"brick=y\"]\ndensity = 2\n");
  const auto width = [](const Made& made) {
    double widest = 0;  // of a face of one triangle: its extent along x
    for (const auto& t : made.mesh.triangles) {
      double low = 1e9, high = -1e9;
      for (const std::uint32_t c : t) {
        low = std::min(low, made.mesh.positions[c].x);
        high = std::max(high, made.mesh.positions[c].x);
      }
      widest = std::max(widest, high - low);
    }
    return widest;
  };
  const Made thin = make(folder, "s.toml", "--size 8,8,4");
  EXPECT_THAT(thin.out, HasSubstr("density 2, thin brick=x, thin brick=y"));
  EXPECT_EQ(width(thin), 2);
  // A request replaces them, each by itself.
  const Made along = make(folder, "s.toml", "--size 8,8,4 --thin brick=y");
  EXPECT_THAT(along.out, testing::Not(HasSubstr("thin brick=x")));
  EXPECT_THAT(along.out, HasSubstr("density 2"));
  EXPECT_GT(width(along), 2);

  write("thickness = 3\n");
  const CommandResult run = runExemplar("synth s.toml -o p.obj", folder.path());
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("[settings]: the engine continuous has no"));
}

}  // namespace
}  // namespace exemplar
