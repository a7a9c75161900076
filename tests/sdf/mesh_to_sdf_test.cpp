// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/mesh_to_sdf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "mesh/mesh_file.h"
#include "mesh/primitives.h"
#include "sdf/triangle_tree.h"
#include "tests/sdf/cancellation.h"
#include "tests/sdf/shapes.h"

namespace exemplar {
namespace {

using test::inputError;
using test::Shape;
using test::withThreads;
using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A rotation about a random axis, and its inverse.
struct Rotation {
  Vec3d axis;
  double angle;

  explicit Rotation(int trial) {
    const Random random(17);
    axis = normalized(
        Vec3d{random.normal(trial, 0), random.normal(trial, 2), random.normal(trial, 4)});
    angle = random.uniform(0, 6.28, trial, 6);
  }
  Vec3d turn(const Vec3d& p, double by) const {
    return p * std::cos(by) + cross(axis, p) * std::sin(by) +
           axis * (dot(axis, p) * (1 - std::cos(by)));
  }
  Vec3d operator()(const Vec3d& p) const { return turn(p, angle); }
  Vec3d inverse(const Vec3d& p) const { return turn(p, -angle); }
};

template <class Move>
TriangleMesh moved(TriangleMesh mesh, const Move& move) {
  for (Vec3d& p : mesh.positions) p = move(p);
  return mesh;
}

TriangleMesh flipped(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  append(a, b);
  return a;
}

// Every triangle with vertices of its own, as .stl files have them, and every third one turned
// over.
TriangleMesh asSoup(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : t) soup.positions.push_back(mesh.positions[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
    if (soup.triangles.size() % 3 == 0)
      std::swap(soup.triangles.back()[0], soup.triangles.back()[1]);
  }
  return soup;
}

// A box without the two triangles of its top.
TriangleMesh openBox(const Box3d& box) {
  TriangleMesh mesh = makeBox(box);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    for (const std::uint32_t v : t)
      if (mesh.positions[v].z != box.max.z) return false;
    return true;
  });
  return mesh;
}

int countInside(const DistanceField& field) {
  int count = 0;
  for (const float v : field.values.values()) count += v < 0;
  return count;
}

// The numbers of connected parts (across faces) of the inside and of the outside.
std::pair<int, int> countParts(const DistanceField& field) {
  const auto& v = field.values;
  Array3D<std::uint8_t> seen(v.size());
  int parts[2] = {0, 0};
  std::vector<Vec3i> open;
  for (std::size_t s = 0; s < v.count(); ++s) {
    if (seen.values()[s]) continue;
    const bool inside = v.values()[s] < 0;
    ++parts[inside];
    open.assign(1, v.ijk(s));
    seen.values()[s] = 1;
    while (!open.empty()) {
      const Vec3i p = open.back();
      open.pop_back();
      for (int axis = 0; axis < 3; ++axis)
        for (const int step : {-1, 1}) {
          Vec3i q = p;
          q[axis] += step;
          if (!v.contains(q) || seen[q] || (v[q] < 0) != inside) continue;
          seen[q] = 1;
          open.push_back(q);
        }
    }
  }
  return {parts[1], parts[0]};
}

// The largest change between neighbors, in voxels: a distance changes by 1 at most.
double steepest(const DistanceField& field) {
  const auto& v = field.values;
  double worst = 0;
  for (std::size_t s = 0; s < v.count(); ++s)
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i b = v.ijk(s);
      if (++b[axis] >= v.size()[axis]) continue;
      worst = std::max(worst, std::abs(double{v[b]} - v.values()[s]));
    }
  return worst / field.voxelSize;
}

// A small tessellated solid whose triangles are nearly on the ideal surface: the sphere's facets
// lie up to e^2 / (6 r) inside it, here 0.0003, below a hundredth of the voxels used.
TriangleMesh fineSphere(const Vec3d& center = {}, double radius = 1) {
  return makeSphere(center, radius, 20);
}

TEST(MeshToSdf, AgreesWithTheAnalyticDistanceInEveryBand) {
  struct Case {
    const char* name;
    TriangleMesh mesh;
    Shape shape;
  };
  const Box3d box{{-0.9, -0.5, -0.31}, {0.83, 0.52, 0.4}};
  const std::vector<Case> cases{
      {"sphere", fineSphere(), test::sphere({}, 1)},
      {"torus", makeTorus({}, {0, 0, 1}, 0.7, 0.25, 192, 96), test::torus({}, 0.7, 0.25)},
      {"box", makeBox(box), test::box(box)}};
  for (const Case& c : cases)
    for (const double halfWidth : {0.5, 1.0, 3.0, 8.0, kInfinity}) {
      const DistanceField field =
          meshToSdf(c.mesh, {.resolution = 30, .padding = 5, .halfWidth = halfWidth});
      // Half a voxel is promised; what is left is the tessellation.
      EXPECT_LT(test::worstError(field, c.shape), 0.02) << c.name << ", half width " << halfWidth;
    }
}

TEST(MeshToSdf, TheCheckerSeesHalfAVoxel) {
  const DistanceField field = meshToSdf(fineSphere(), {.resolution = 30, .padding = 5});
  EXPECT_GT(test::worstError(field, test::sphere({}, 1 + 0.5 * field.voxelSize)), 0.48);
}

TEST(MeshToSdf, IsExactOnBoxesAtAnyAngle) {
  const Box3d box{{-0.9, -0.5, -0.2}, {0.9, 0.5, 0.2}};
  for (int trial = 0; trial < 8; ++trial) {
    const Rotation turn(trial);
    const DistanceField field = meshToSdf(moved(makeBox(box), turn),
                                          {.resolution = 24, .padding = 3, .halfWidth = kInfinity});
    const Shape shape = [&](const Vec3d& p) { return test::box(box)(turn.inverse(p)); };
    // Planes are met exactly; floats of a few voxels have steps of 2e-7.
    EXPECT_LT(test::worstError(field, shape), 1e-5) << trial;
  }
}

TEST(MeshToSdf, IsTheDistanceOfTheNearestTriangle) {
  // Against brute force on a soup without any structure.
  const Random random(3);
  TriangleMesh soup;
  for (std::uint32_t t = 0; t < 60; ++t) {
    const Vec3d at{random.uniform(t, 0), random.uniform(t, 1), random.uniform(t, 2)};
    for (std::uint32_t c = 0; c < 3; ++c) {
      soup.positions.push_back(at + Vec3d{random.uniform(-0.2, 0.2, t, 3 + c),
                                          random.uniform(-0.2, 0.2, t, 6 + c),
                                          random.uniform(-0.2, 0.2, t, 9 + c)});
    }
    soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  // Ray parity leaves out no triangle, so that the size is that of the nearest one.
  const DistanceField field =
      meshToSdf(soup, {.resolution = 24, .halfWidth = kInfinity, .sign = SignSource::RayParity});
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const Vec3d p = field.position(cast<double>(field.values.ijk(s)));
    double nearest = kInfinity;
    for (const auto& [a, b, c] : soup.triangles)
      nearest = std::min(
          nearest, squaredDistance(p, {soup.positions[a], soup.positions[b], soup.positions[c]}));
    ASSERT_NEAR(std::abs(field.values.values()[s]), std::sqrt(nearest), 1e-6);
  }
}

TEST(MeshToSdf, PutsSamplesAtTheCentresOfTheBoxsVoxels) {
  const Box3d box{{1, 2, 3}, {2, 3.5, 3.3}};
  const DistanceField field = meshToSdf(makeBox(box), {.resolution = 15});
  EXPECT_DOUBLE_EQ(field.voxelSize, 0.1);
  EXPECT_EQ(field.size(), (Vec3i{10, 15, 3}));
  EXPECT_NEAR(length(field.origin - Vec3d{1.05, 2.05, 3.05}), 0, 1e-12);
  const DistanceField padded = meshToSdf(makeBox(box), {.voxelSize = 0.2, .padding = 2});
  EXPECT_EQ(padded.size(), (Vec3i{9, 12, 6}));  // sides of 5, 7.5 and 1.5 voxels, rounded up
  EXPECT_NEAR(length(padded.origin - Vec3d{0.7, 1.7, 2.7}), 0, 1e-12);
  EXPECT_FLOAT_EQ(padded.truncation, 0.6f);
}

TEST(MeshToSdf, GeometryOutsideTheBoxCounts) {
  const TriangleMesh torus = makeTorus({}, {0, 0, 1}, 0.7, 0.25);
  const DistanceField whole =
      meshToSdf(torus, {.voxelSize = 0.05, .box = Box3d{{-1, -1, -0.5}, {1, 1, 0.5}}});
  const Box3d window{{0.2, -0.3, -0.1}, {0.6, 0.4, 0.2}};
  const DistanceField part = meshToSdf(torus, {.voxelSize = 0.05, .box = window});
  ASSERT_EQ(part.size(), (Vec3i{8, 14, 6}));
  EXPECT_GT(countInside(part), 0);
  for (std::size_t s = 0; s < part.values.count(); ++s) {
    const Vec3i at = part.values.ijk(s) + Vec3i{24, 14, 8};
    ASSERT_NEAR(part.values.values()[s], whole.values[at], 1e-7);
  }
  // All the surface is outside this box: a corner cut out of the middle of a ball, and one beside
  // it.
  const DistanceField inner =
      meshToSdf(fineSphere(), {.resolution = 8, .box = Box3d{{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}});
  EXPECT_EQ(countInside(inner), 512);
  const DistanceField outer =
      meshToSdf(fineSphere(),
                {.resolution = 8, .box = Box3d{{9, 9, 9}, {10, 10, 10}}, .halfWidth = kInfinity});
  EXPECT_LT(test::worstError(outer, test::sphere({}, 1)), 0.02);
}

TEST(MeshToSdf, HasGradientOneInTheBand) {
  const DistanceField field =
      meshToSdf(makeTorus({}, {0.2, 0.3, 1}, 0.7, 0.3, 128, 64), {.resolution = 48, .padding = 4});
  const auto& v = field.values;
  int count = 0;
  for (int k = 1; k + 1 < v.size().z; ++k)
    for (int j = 1; j + 1 < v.size().y; ++j)
      for (int i = 1; i + 1 < v.size().x; ++i) {
        if (std::abs(v(i, j, k)) > field.truncation - 1.1 * field.voxelSize) continue;
        const Vec3d g{v(i + 1, j, k) - v(i - 1, j, k), v(i, j + 1, k) - v(i, j - 1, k),
                      v(i, j, k + 1) - v(i, j, k - 1)};
        // The band stays 4 voxels from the wire's center, where curvature is 1 / 4 a voxel: central
        // differences miss by (1 / 4)^2 / 6 = 0.01; facets of 0.4 voxels add as much.
        ASSERT_NEAR(length(g) / (2 * field.voxelSize), 1, 0.03);
        ++count;
      }
  EXPECT_GT(count, 5000);
}

TEST(MeshToSdf, IsClampedToTheTruncationAndReachesIt) {
  const DistanceField field =
      meshToSdf(fineSphere(), {.resolution = 32, .padding = 6, .halfWidth = 2.5});
  EXPECT_FLOAT_EQ(field.truncation, static_cast<float>(2.5 * field.voxelSize));
  int low = 0, high = 0;
  for (const float v : field.values.values()) {
    ASSERT_LE(std::abs(v), field.truncation);
    low += v == -field.truncation;
    high += v == field.truncation;
  }
  EXPECT_GT(low, 1000);
  EXPECT_GT(high, 1000);
}

TEST(MeshToSdf, OfAQuarterOfTheMeshIsAQuarterOfTheField) {
  const TriangleMesh mesh = makeTorus({1, 2, 3}, {1, 2, 3}, 0.7, 0.3);
  const DistanceField field = meshToSdf(mesh, {.resolution = 32});
  const DistanceField quarter =
      meshToSdf(moved(mesh, [](const Vec3d& p) { return p * 0.25; }), {.resolution = 32});
  ASSERT_EQ(field.size(), quarter.size());
  // Powers of two scale without rounding.
  for (std::size_t s = 0; s < field.values.count(); ++s)
    ASSERT_EQ(quarter.values.values()[s], field.values.values()[s] * 0.25f);
}

TEST(MeshToSdf, IsTheSameAtAnyScaleAndFarFromTheOrigin) {
  const TriangleMesh mesh = makeBox({{0, 0, 0}, {2, 3, 4}});
  const MeshToSdfOptions options{.resolution = 16, .padding = 2};
  const DistanceField field = meshToSdf(mesh, options);
  for (const double scale : {1e-20, 1e-7, 1e-4, 1e6})
    for (const double far : {0.0, 1e8}) {
      const DistanceField other = meshToSdf(moved(mesh,
                                                  [&](const Vec3d& p) {
                                                    return (p + Vec3d{far, -far, far}) * scale;
                                                  }),
                                            options);
      ASSERT_EQ(other.size(), field.size()) << scale << ", " << far;
      // Steps of doubles at 1e8 are 1.5e-8, 6e-8 voxels.
      for (std::size_t s = 0; s < field.values.count(); ++s)
        ASSERT_NEAR(other.values.values()[s] / scale, field.values.values()[s], 1e-6)
            << scale << ", " << far;
    }
}

TEST(MeshToSdf, FollowsARotationOfTheMesh) {
  const TriangleMesh mesh = joined(makeTorus({0.1, 0, 0}, {0, 0, 1}, 0.6, 0.2),
                                   makeBox({{-0.2, -0.3, -0.4}, {0.5, 0.3, 0.1}}));
  const TriangleTree tree([&] {
    std::vector<Corners> t;
    for (const auto& [a, b, c] : mesh.triangles)
      t.push_back({mesh.positions[a], mesh.positions[b], mesh.positions[c]});
    return t;
  }());
  const Box3d box{{-1, -1, -1}, {1, 1, 1}};
  for (int trial = 0; trial < 4; ++trial) {
    const Rotation turn(trial);
    const DistanceField field = meshToSdf(moved(mesh, turn), {.resolution = 32, .box = box});
    for (std::size_t s = 0; s < field.values.count(); ++s) {
      const Vec3d p = turn.inverse(field.position(cast<double>(field.values.ijk(s))));
      const double exact = tree.distance(p, field.truncation);
      const float v = field.values.values()[s];
      // Triangles buried in the other solid are not part of the surface, so the size may be larger.
      ASSERT_GE(std::abs(v), exact - 1e-6);
      const bool inside = std::abs(tree.windingNumber(p)) > 0.5;
      if (exact > 1e-6) {
        ASSERT_EQ(v < 0, inside);
      }
    }
  }
}

TEST(MeshToSdf, PadsAndCutsAxisByAxis) {
  // A wall of 4 by 0.5 by 2, cut across x only; its end is between samples.
  const TriangleMesh wall = makeBox({{0, 0, 0}, {4.03, 0.5, 2}});
  const DistanceField field = meshToSdf(wall, {.voxelSize = 0.1,
                                               .padding = Vec3i{0, 2, 3},
                                               .halfWidth = kInfinity,
                                               .cutByBox = {.x = true}});
  EXPECT_EQ(field.size(), (Vec3i{40, 9, 26}));
  EXPECT_NEAR(length(field.box().min - Vec3d{0, -0.2, -0.3}), 0, 1e-12);
  const Shape bar = test::box({{-100, 0, 0}, {100, 0.5, 2}});
  EXPECT_LT(test::worstError(field, bar), 1e-4);
}

TEST(MeshToSdf, MeasuresNoDistanceFromWhereTheBoxCutIt) {
  // Ground that fills the box's floor, its sides and bottom closed by the cut; one wall of it is
  // inside the box, and a surface.
  const TriangleMesh ground = makeBox({{0, 0.3, 0}, {1, 1, 0.45}});
  const Shape corner = [](const Vec3d& p) {
    const double up = p.z - 0.45, out = 0.3 - p.y;
    return up > 0 && out > 0 ? std::hypot(up, out) : std::max(up, out);
  };
  for (const SignSource sign : {SignSource::Automatic, SignSource::Flood, SignSource::RayParity}) {
    MeshToSdfOptions options{
        .resolution = 20, .box = Box3d{{0, 0, 0}, {1, 1, 1}}, .halfWidth = 30, .sign = sign};
    options.cutByBox = Axes::every();
    const DistanceField window = meshToSdf(ground, options);
    options.cutByBox = {};
    const DistanceField object = meshToSdf(ground, options);
    double different = 0;
    for (std::size_t s = 0; s < window.values.count(); ++s) {
      const Vec3d p = window.position(cast<double>(window.values.ijk(s)));
      ASSERT_NEAR(window.values.values()[s], corner(p), 1e-6);
      different = std::max(different, std::abs(object.values.values()[s] - corner(p)));
    }
    EXPECT_GT(different, 0.3);  // deep in the ground, the cut is near
  }
  EXPECT_THAT(inputError([&] { meshToSdf(ground, {.padding = 1, .cutByBox = Axes::every()}); }),
              HasSubstr("`padding` must be 0"));
}

// Distance of the union of two spheres, also inside it.
Shape twoSpheres(const Vec3d& a, double ra, const Vec3d& b, double rb) {
  return [=](const Vec3d& p) {
    double nearest = kInfinity;
    const auto consider = [&](const Vec3d& c, double r, const Vec3d& other, double ro) {
      const Vec3d q = c + normalized(p - c) * r;  // nearest on this sphere
      if (length(q - other) >= ro) nearest = std::min(nearest, length(p - q));
    };
    consider(a, ra, b, rb);
    consider(b, rb, a, ra);
    const Vec3d axis = normalized(b - a);
    const double d = length(b - a), along = (d * d + ra * ra - rb * rb) / (2 * d);
    const double ring = std::sqrt(ra * ra - along * along);
    const Vec3d fromRing = p - (a + axis * along);
    const double t = dot(fromRing, axis);
    nearest = std::min(nearest, std::hypot(t, length(fromRing - axis * t) - ring));
    const bool inside = length(p - a) < ra || length(p - b) < rb;
    return inside ? -nearest : nearest;
  };
}

TEST(MeshToSdf, OfOverlappingSolidsIsThatOfTheirUnion) {
  const Vec3d a{-0.3, 0.1, 0}, b{0.45, -0.1, 0.2};
  const TriangleMesh mesh = joined(fineSphere(a, 0.7), fineSphere(b, 0.5));
  for (const int resolution : {16, 40}) {
    const DistanceField field =
        meshToSdf(mesh, {.resolution = resolution, .padding = 3, .halfWidth = kInfinity});
    // The crease is cut to pieces of half a voxel: right to within a quarter.
    EXPECT_LT(test::worstError(field, twoSpheres(a, 0.7, b, 0.5)), 0.25) << resolution;
    EXPECT_EQ(countParts(field), std::make_pair(1, 1));
  }
}

TEST(MeshToSdf, ForgetsWhatIsBuriedInASolid) {
  const Box3d outer{{-1, -1, -1}, {1, 1, 1}};
  const TriangleMesh mesh = joined(makeBox(outer), fineSphere({0.1, 0, 0}, 0.5));
  const DistanceField field =
      meshToSdf(mesh, {.resolution = 24, .padding = 2, .halfWidth = kInfinity});
  EXPECT_LT(test::worstError(field, test::box(outer)), 1e-5);
}

TEST(MeshToSdf, HasNoWallWhereSolidsShareAFace) {
  // Of the same size and of different sizes, exactly face to face.
  const Box3d left{{0, 0, 0}, {1, 1, 1}}, right{{1, 0, 0}, {2, 1, 1}},
      small{{1, 0.25, 0.25}, {2, 0.75, 0.75}};
  const DistanceField same = meshToSdf(joined(makeBox(left), makeBox(right)),
                                       {.resolution = 20, .padding = 3, .halfWidth = kInfinity});
  EXPECT_LT(test::worstError(same, test::box({{0, 0, 0}, {2, 1, 1}})), 1e-5);
  const DistanceField other = meshToSdf(joined(makeBox(left), makeBox(small)),
                                        {.resolution = 20, .padding = 3, .halfWidth = kInfinity});
  EXPECT_EQ(countParts(other), std::make_pair(1, 1));
  // On the axis the walls of the smaller box, or the rim where it leaves the larger one, are
  // nearest.
  for (double x = 0.6; x < 1.8; x += 0.1) {
    const Vec3d at = other.index({x, 0.5, 0.5});
    const Vec3i i = cast<int>(at + Vec3d{0.5, 0.5, 0.5});
    const Vec3d p = other.position(cast<double>(i));
    const double side = std::min({p.y - 0.25, 0.75 - p.y, p.z - 0.25, 0.75 - p.z});
    const double end = 2 - p.x;
    const double expected = p.x >= 1 ? std::min(side, end) : std::hypot(1 - p.x, side);
    EXPECT_NEAR(other.values[i], -expected, 0.25 * other.voxelSize) << x;
  }
}

TEST(MeshToSdf, ManyTouchingAndOverlappingBallsAreOneSolidEach) {
  TriangleMesh mesh;
  std::vector<Vec3d> centers;
  const Random random(5);
  for (int b = 0; b < 40; ++b) {
    centers.push_back({random.uniform(b, 0), random.uniform(b, 1), random.uniform(b, 2)});
    append(mesh, makeSphere(centers.back(), 0.18, 8));
  }
  const DistanceField field = meshToSdf(mesh, {.resolution = 48, .padding = 2});
  const Shape balls = [&](const Vec3d& p) {
    double d = kInfinity;
    for (const Vec3d& c : centers) d = std::min(d, length(p - c) - 0.18);
    return d;
  };
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const double d = balls(field.position(cast<double>(field.values.ijk(s))));
    const float v = field.values.values()[s];
    // Facets lie up to 0.0014 inside the balls. Outside, the union's distance is the smallest one.
    if (d > 0.002) {
      ASSERT_NEAR(v, std::min<double>(d, field.truncation), 0.25 * field.voxelSize);
    }
    if (d < -0.002) {
      ASSERT_LE(v, std::max<double>(d + 0.25 * field.voxelSize, -field.truncation));
    }
  }
}

TEST(MeshToSdf, OfAnInsideOutMeshIsTheSame) {
  const TriangleMesh mesh = makeTorus({}, {0, 0, 1}, 0.7, 0.25);
  EXPECT_LT(test::worstError(meshToSdf(flipped(mesh), {.resolution = 24}),
                             [&](const Vec3d& p) { return test::torus({}, 0.7, 0.25)(p); }),
            0.5);
  EXPECT_GT(countInside(meshToSdf(flipped(mesh), {.resolution = 24})), 500);
}

TEST(MeshToSdf, OfASoupWithFlippedTrianglesIsThatOfItsSolid) {
  const TriangleMesh mesh = makeTorus({}, {0, 0, 1}, 0.7, 0.25);
  const DistanceField expected = meshToSdf(mesh, {.resolution = 32});
  for (const SignSource sign :
       {SignSource::Automatic, SignSource::RayParity, SignSource::WindingNumber}) {
    const DistanceField field = meshToSdf(asSoup(mesh), {.resolution = 32, .sign = sign});
    for (std::size_t s = 0; s < field.values.count(); ++s)
      ASSERT_NEAR(field.values.values()[s], expected.values.values()[s], 1e-6);
  }
}

TEST(MeshToSdf, OfAMeshThatIsThereTwiceIsThatOfOne) {
  const TriangleMesh mesh = makeTorus({}, {0, 0, 1}, 0.7, 0.25);
  const DistanceField once = meshToSdf(mesh, {.resolution = 32}),
                      twice = meshToSdf(joined(mesh, mesh), {.resolution = 32});
  EXPECT_EQ(once.values, twice.values);
}

TEST(MeshToSdf, OfADoubleSidedMeshIsThatOfItsSolid) {
  const TriangleMesh box = makeBox({{0, 0, 0}, {2, 3, 4}});
  const MeshToSdfOptions options{.resolution = 24, .padding = 2};
  const DistanceField once = meshToSdf(box, options);
  ASSERT_GT(countInside(once), 1000);
  // All faces twice, in either order; some of them; and three times.
  EXPECT_EQ(meshToSdf(joined(box, flipped(box)), options).values, once.values);
  EXPECT_EQ(meshToSdf(joined(flipped(box), box), options).values, once.values);
  for (const std::size_t some : {1, 2, 5, 11}) {
    TriangleMesh part = flipped(box);
    part.triangles.resize(some);
    EXPECT_EQ(meshToSdf(joined(box, part), options).values, once.values) << some;
  }
  EXPECT_EQ(meshToSdf(joined(joined(box, box), flipped(box)), options).values, once.values);
  // Two double-sided solids that overlap, one of them facing inwards first.
  const TriangleMesh other = makeBox({{1, 1, 1}, {3, 2, 5}});
  const DistanceField both = meshToSdf(joined(box, other), options);
  const DistanceField doubled =
      meshToSdf(joined(joined(box, flipped(box)), joined(flipped(other), other)), options);
  ASSERT_EQ(doubled.size(), both.size());
  for (std::size_t s = 0; s < both.values.count(); ++s)
    ASSERT_NEAR(doubled.values.values()[s], both.values.values()[s], 0.25 * both.voxelSize);
  // Without a top, it is as the one-sided one.
  const TriangleMesh open = openBox({{0, 0, 0}, {2, 3, 4}});
  EXPECT_EQ(meshToSdf(joined(open, flipped(open)), options).values,
            meshToSdf(open, options).values);
}

TEST(MeshToSdf, SidesOfADoubleSidedMeshMayBeCutAlongOtherDiagonals) {
  // Quadrilaterals as files have them: the fan of the reversed one begins at another corner.
  const std::array<std::array<std::uint32_t, 4>, 6> faces{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  TriangleMesh box;
  box.positions = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0},
                   {0, 0, 4}, {2, 0, 4}, {2, 3, 4}, {0, 3, 4}};
  const auto addFace = [](TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                          std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (const auto& [a, b, c, d] : faces) addFace(box, a, b, c, d);
  const MeshToSdfOptions options{.resolution = 24, .padding = 2};
  const DistanceField once = meshToSdf(box, options);
  ASSERT_GT(countInside(once), 1000);
  // All faces, some of them, and with some cut alike; with the points of each face its own.
  for (const std::size_t some : {1, 3, 6})
    for (const std::size_t alike : {0, 1, 2}) {
      TriangleMesh doubled = box;
      for (std::size_t f = 0; f < some; ++f) {
        const auto& [a, b, c, d] = faces[f];
        if (f < alike) {
          addFace(doubled, c, b, a, d);
        } else {
          addFace(doubled, d, c, b, a);
        }
      }
      EXPECT_LT(test::worstError(meshToSdf(doubled, options), test::box({{0, 0, 0}, {2, 3, 4}})),
                1e-5)
          << some << ", " << alike;
    }
}

TEST(MeshToSdf, KeepsHollowsThatFaceOutwards) {
  const TriangleMesh shell = joined(fineSphere({}, 1), flipped(fineSphere({}, 0.6)));
  const Shape exact = [](const Vec3d& p) { return std::max(length(p) - 1, 0.6 - length(p)); };
  const DistanceField field =
      meshToSdf(shell, {.resolution = 32, .padding = 2, .halfWidth = kInfinity});
  EXPECT_LT(test::worstError(field, exact), 0.02);
  // A flood from outside cannot see them.
  const DistanceField flooded =
      meshToSdf(shell, {.resolution = 32, .padding = 2, .sign = SignSource::Flood});
  EXPECT_EQ(countParts(flooded), std::make_pair(1, 1));
}

TEST(MeshToSdf, FloodAgreesOnClosedMeshesHoweverTheyFace) {
  const TriangleMesh mesh = makeTorus({}, {0.3, 0.2, 1}, 0.7, 0.25);
  const DistanceField winding = meshToSdf(mesh, {.resolution = 40, .padding = 2});
  const DistanceField flood =
      meshToSdf(asSoup(mesh), {.resolution = 40, .padding = 2, .sign = SignSource::Flood});
  // OpenVDB decides the sign of samples next to the surface by those of their neighbors.
  for (std::size_t s = 0; s < flood.values.count(); ++s) {
    const float a = flood.values.values()[s], b = winding.values.values()[s];
    ASSERT_NEAR(std::abs(a), std::abs(b), 1e-6);
    if (std::abs(b) > 0.25 * flood.voxelSize) {
      ASSERT_EQ(a < 0, b < 0);
    }
  }
}

TEST(MeshToSdf, ClosesAnOpeningWithoutLeaksOrSpecks) {
  const Box3d box{{-0.8, -0.6, -0.5}, {0.8, 0.6, 0.5}};
  const DistanceField field = meshToSdf(openBox(box), {.resolution = 40, .padding = 4});
  EXPECT_EQ(countParts(field), std::make_pair(1, 1));
  // Below the opening, as far as a third of its width, the box is as if it were closed.
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const Vec3d p = field.position(cast<double>(field.values.ijk(s)));
    if (p.z > 0.1) continue;
    const double d = std::clamp<double>(test::box(box)(p), -field.truncation, field.truncation);
    ASSERT_NEAR(field.values.values()[s], d, 1e-5);
  }
  // The winding number of the missing face is 1/2 on its plane: the cap is near it, at most a
  // quarter of the width below, and part of the surface, so that the field is a distance there too.
  EXPECT_LT(steepest(field), 1.5);
  const Vec3d top = field.index({0, 0, 0.5});
  double crossing = 0;
  for (int k = 0; k + 1 < field.size().z; ++k) {
    const float a = field.values(static_cast<int>(top.x), static_cast<int>(top.y), k);
    const float b = field.values(static_cast<int>(top.x), static_cast<int>(top.y), k + 1);
    if (a < 0 && b >= 0) crossing = k + a / (a - b);
  }
  EXPECT_NEAR(crossing, top.z, 1.5);
}

TEST(MeshToSdf, APunchedSphereIsStillOneBall) {
  TriangleMesh mesh = fineSphere();
  const Random random(9);
  std::size_t t = 0;
  std::erase_if(mesh.triangles, [&](const auto&) { return random.uniform(t++) < 0.1; });
  const DistanceField field = meshToSdf(mesh, {.resolution = 32, .padding = 3});
  EXPECT_EQ(countParts(field), std::make_pair(1, 1));
  // Holes of single triangles, a third of a voxel: the caps sink in by less than that.
  EXPECT_LT(test::worstError(field, test::sphere({}, 1)), 0.5);
}

TEST(MeshToSdf, SheetsWithoutThicknessVanish) {
  TriangleMesh sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  const DistanceField flat = meshToSdf(sheet, {.resolution = 16, .padding = 2});
  EXPECT_EQ(countInside(flat), 0);
  // Two-sided: each triangle twice, back to back.
  const DistanceField twoSided = meshToSdf(
      joined(sheet, flipped(sheet)), {.resolution = 16, .padding = 2, .halfWidth = kInfinity});
  EXPECT_EQ(countInside(twoSided), 0);
  for (const float v : twoSided.values.values()) ASSERT_TRUE(std::isfinite(v));
  // Beside a solid, the solid is what is left.
  const Box3d box{{0.2, 0.2, -0.3}, {0.8, 0.8, 0.3}};
  const DistanceField both = meshToSdf(joined(makeBox(box), joined(sheet, flipped(sheet))),
                                       {.resolution = 32, .padding = 2});
  EXPECT_LT(test::worstError(both, test::box(box)), 0.25);
}

TEST(MeshToSdf, IsTheSameAtAnyNumberOfThreads) {
  TriangleMesh overlapping =
      joined(makeSphere({-0.3, 0, 0}, 0.6, 12), makeTorus({0.2, 0, 0}, {0, 1, 1}, 0.6, 0.2));
  TriangleMesh open = overlapping;
  open.triangles.resize(open.triangles.size() - 300);
  for (const TriangleMesh* mesh : {&overlapping, &open})
    for (const SignSource sign :
         {SignSource::Automatic, SignSource::Flood, SignSource::RayParity}) {
      const auto run = [&] {
        return meshToSdf(*mesh, {.resolution = 32, .padding = 2, .sign = sign}).values;
      };
      EXPECT_EQ(withThreads(1, run), withThreads(8, run));
    }
}

TEST(MeshToSdf, ReportsItsProgressAndStopsWhereItIsCancelled) {
  // Spheres that cross each other; the same without some of their triangles; and each with
  // every source of signs.
  TriangleMesh crossing;
  for (int s = 0; s < 5; ++s) append(crossing, makeSphere({0.4 * s, 0.2 * s, 0}, 0.5, 12));
  TriangleMesh open = crossing;
  open.triangles.resize(open.triangles.size() - 40);
  for (const TriangleMesh* mesh : {&crossing, &open})
    for (const SignSource sign :
         {SignSource::WindingNumber, SignSource::Flood, SignSource::RayParity}) {
      SCOPED_TRACE(static_cast<int>(sign));
      expectReportsAndStops(
          [&](const Progress& progress) {
            meshToSdf(*mesh, {.resolution = 32, .padding = 2, .sign = sign}, progress);
          },
          20);
    }
}

// The solid angle of a triangle in units of the full sphere (van Oosterom, Strackee 1983).
double windingOf(const Corners& t, const Vec3d& p) {
  const Vec3d a = t[0] - p, b = t[1] - p, c = t[2] - p;
  const double la = length(a), lb = length(b), lc = length(c);
  return std::atan2(dot(a, cross(b, c)),
                    la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb) /
         6.28318530717958648;
}

// Single triangles that cross each other everywhere.
TriangleMesh crossingTriangles(int count, int seed) {
  const Random random(static_cast<std::uint64_t>(seed));
  TriangleMesh soup;
  for (int t = 0; t < count; ++t) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (int c = 0; c < 3; ++c)
      soup.positions.push_back(
          {random.uniform(t, 3 * c), random.uniform(t, 3 * c + 1), random.uniform(t, 3 * c + 2)});
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

// Samples whose sign differs from that of the sum over all triangles, and how many samples have
// one.
std::pair<int, int> wrongSigns(const TriangleMesh& mesh, const DistanceField& field) {
  int wrong = 0, sure = 0;
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const Vec3d p = field.position(cast<double>(field.values.ijk(s)));
    double winding = 0;
    for (const auto& [a, b, c] : mesh.triangles)
      winding += windingOf({mesh.positions[a], mesh.positions[b], mesh.positions[c]}, p);
    // Winding numbers are right to within 0.01.
    if (std::abs(std::abs(winding) - 0.5) < 0.01) continue;
    ++sure;
    wrong += (std::abs(winding) > 0.5) != (field.values.values()[s] < 0);
  }
  return {wrong, sure};
}

TEST(MeshToSdf, HasTheSignOfTheWindingNumberInSoups) {
  // From few triangles, which are cut finely, to so many crossings that pieces get longer.
  for (const int count : {3, 20, 120}) {
    const TriangleMesh soup = crossingTriangles(count, count);
    const DistanceField field = meshToSdf(soup, {.resolution = 20, .padding = 1});
    const auto [wrong, sure] = wrongSigns(soup, field);
    EXPECT_EQ(wrong, 0) << count;
    EXPECT_GT(sure, 5000) << count;
    // And where the sign changes, the surface is near: the field is a distance.
    EXPECT_LT(steepest(field), 2.0) << count;
  }
}

TEST(MeshToSdf, HasTheSignOfTheWindingNumberInClosedMeshesThatCrossThemselves) {
  // Each triangle crosses several others.
  TriangleMesh mesh = makeSphere({}, 1, 9);
  const Random random(3);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    mesh.positions[v] +=
        Vec3d{random.normal(v, 0), random.normal(v, 2), random.normal(v, 4)} * 0.15;
  const DistanceField field = meshToSdf(mesh, {.resolution = 20, .padding = 1});
  const auto [wrong, sure] = wrongSigns(mesh, field);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(sure, 5000);
  EXPECT_LT(steepest(field), 2.0);
}

TEST(MeshToSdf, RefusesOptionsOutOfRangeInOneLine) {
  const TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  const auto error = [&](const MeshToSdfOptions& options) {
    return inputError([&] { meshToSdf(mesh, options); });
  };
  EXPECT_THAT(error({.resolution = 100000}),
              HasSubstr("`resolution` is 100000; it must be 1..4096"));
  EXPECT_THAT(error({.resolution = 0}), HasSubstr("`resolution` is 0"));
  EXPECT_THAT(error({.voxelSize = -1}), HasSubstr("`voxelSize` is -1"));
  EXPECT_THAT(error({.voxelSize = std::nan("")}), HasSubstr("`voxelSize` is"));
  EXPECT_THAT(error({.voxelSize = kInfinity}), HasSubstr("`voxelSize` is"));
  EXPECT_THAT(error({.padding = -1}), HasSubstr("`padding` is -1"));
  EXPECT_THAT(error({.halfWidth = 0}), HasSubstr("`halfWidth` is 0"));
  EXPECT_THAT(error({.halfWidth = std::nan("")}), HasSubstr("`halfWidth` is nan"));
  EXPECT_THAT(error({.box = Box3d{}}), HasSubstr("box"));
  EXPECT_THAT(error({.box = Box3d{{0, 0, 0}, {kInfinity, 1, 1}}}), HasSubstr("box"));
  EXPECT_THAT(error({.box = Box3d{{1, 1, 1}, {1, 1, 1}}}), HasSubstr("box"));
  for (const MeshToSdfOptions& options :
       {MeshToSdfOptions{.voxelSize = 1e-5}, MeshToSdfOptions{.voxelSize = 1e-300},
        MeshToSdfOptions{.resolution = 4096}, MeshToSdfOptions{.padding = 2000000000}}) {
    EXPECT_THAT(error(options), HasSubstr("lower `resolution`"));
    EXPECT_THAT(error(options), testing::Not(HasSubstr("\n")));
  }
}

TEST(MeshToSdf, RefusesMeshesThatAreNone) {
  EXPECT_THAT(inputError([] { meshToSdf(TriangleMesh{}); }), testing::Not(""));
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  mesh.positions[3].y = std::nan("");
  EXPECT_THAT(inputError([&] { meshToSdf(mesh); }), testing::Not(""));
}

TEST(MeshToSdf, LeavesRealModelsWhole) {
  const std::filesystem::path data = std::filesystem::path(EXEMPLAR_SOURCE_DIR) / "../shared/data";
  struct Case {
    const char* file;
    int resolution;
  };
  for (const Case& c : {Case{"meshes/towerruins.obj", 64}, Case{"kaykit/column.obj", 64},
                        Case{"kaykit/wall_broken.obj", 64}, Case{"kaykit/stairs_walled.obj", 64}}) {
    if (!std::filesystem::exists(data / c.file))
      GTEST_SKIP() << "no " << (data / c.file) << " beside the checkout";
    const DistanceField field =
        meshToSdf(readMesh(data / c.file), {.resolution = c.resolution, .padding = 2});
    EXPECT_EQ(countParts(field).first, 1) << c.file;
    EXPECT_LT(steepest(field), 1.9) << c.file;
  }
}

}  // namespace
}  // namespace exemplar
