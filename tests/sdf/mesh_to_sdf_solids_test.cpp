// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What counts as solid: soups, overlaps, open and double-sided meshes.

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
#include "tests/sdf/meshes.h"
#include "tests/sdf/shapes.h"

namespace exemplar {
namespace {

using test::asSoup;
using test::countInside;
using test::countParts;
using test::fineSphere;
using test::flipped;
using test::joined;
using test::openBox;
using test::Shape;
using test::steepest;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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
  // The outer side twice.
  TriangleMesh thrice = joined(box, box);
  for (const auto& [a, b, c, d] : faces) addFace(thrice, d, c, b, a);
  EXPECT_EQ(meshToSdf(thrice, options).values, once.values);
}

TEST(MeshToSdf, TheInnerSideOfAShellThatIsTooThinToBeSeenIsNone) {
  const auto shrunk = [](double by) { return makeBox({{by, by, by}, {2 - by, 3 - by, 4 - by}}); };
  const TriangleMesh box = shrunk(0);
  const MeshToSdfOptions options{.resolution = 24, .padding = 2};  // voxels of 1/6
  const DistanceField once = meshToSdf(box, options);
  for (const double thickness : {1e-6, 0.02}) {
    EXPECT_EQ(meshToSdf(joined(box, flipped(shrunk(thickness))), options).values, once.values);
    // The side that is turned inwards may lie outside, too; in voxels, at a corner.
    const DistanceField around = meshToSdf(joined(flipped(box), shrunk(thickness)), options);
    EXPECT_LT(test::worstError(around, test::box({{0, 0, 0}, {2, 3, 4}})), 10.5 * thickness + 2e-5);
  }
  // A shell that can be seen is hollow.
  const DistanceField hollow = meshToSdf(joined(box, flipped(shrunk(0.5))), options);
  EXPECT_GT(hollow.values(hollow.size().x / 2, hollow.size().y / 2, hollow.size().z / 2), 0);
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

}  // namespace
}  // namespace exemplar
