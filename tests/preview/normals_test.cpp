// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/random.h"
#include "mesh/primitives.h"
#include "mesh/shading_normals.h"

namespace exemplar {
namespace {

constexpr double kCrease = 0.7;

/// A coarse torus, whose facets meet at less than the crease angle and far apart at more, and a
/// box.
TriangleMesh sample() {
  TriangleMesh mesh = makeTorus({0, 0, 0}, {0, 0, 1}, 2, 0.7, 20, 10);
  append(mesh, makeBox({{4, 0, 0}, {5, 1, 2}}));
  return mesh;
}

TEST(CornerNormals, AreThoseThatFilesGet) {
  const TriangleMesh mesh = sample();
  const auto normals = cornerNormals(mesh, kCrease);
  const ShadingNormals inFiles = shadingNormals(mesh, MeshNormals::Crease);
  ASSERT_EQ(normals.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const Vec3f& inFile = inFiles.normals[inFiles.corners[t][c]];
      EXPECT_GT(dot(normals[t][c], inFile), std::cos(0.0175)) << t;  // a degree
    }
  }
}

TEST(CornerNormals, OfTrianglesThatAreWoundAnyhowAreTheSameOnTheirOwnSide) {
  const TriangleMesh mesh = sample();
  const auto wanted = cornerNormals(mesh, kCrease);
  const Random random(5);
  TriangleMesh soup;
  std::vector<bool> turned;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto n = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : mesh.triangles[t]) soup.positions.push_back(mesh.positions[v]);
    turned.push_back(random.below(2, t, 0) == 1);
    soup.triangles.push_back({n, n + 1, n + 2});
    if (turned.back()) std::swap(soup.triangles.back()[1], soup.triangles.back()[2]);
  }
  const auto normals = cornerNormals(soup, kCrease);
  for (std::size_t t = 0; t < normals.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const Vec3f& own = normals[t][turned[t] && c > 0 ? 3 - c : c];
      EXPECT_GT(dot(own, wanted[t][c]) * (turned[t] ? -1 : 1), 0.9999) << t;
    }
  }
}

TEST(CornerNormals, OfAStripWithATwistAreUnit) {
  // A Moebius strip has no side that could be out.
  constexpr int kParts = 24;
  TriangleMesh strip;
  for (int i = 0; i < kParts; ++i) {
    const double a = 6.283185307179586 * i / kParts, half = a / 2;
    for (const double w : {-0.4, 0.4}) {
      const double r = 2 + w * std::cos(half);
      strip.positions.push_back({r * std::cos(a), r * std::sin(a), w * std::sin(half)});
    }
  }
  for (std::uint32_t i = 0; i < kParts; ++i) {
    const bool last = i + 1 == kParts;
    const std::uint32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    strip.triangles.push_back({a, c, b});
    strip.triangles.push_back({b, c, d});
  }
  for (const auto& corners : cornerNormals(strip, kCrease))
    for (const Vec3f& normal : corners) EXPECT_NEAR(length(cast<double>(normal)), 1, 1e-5);
}

}  // namespace
}  // namespace exemplar
