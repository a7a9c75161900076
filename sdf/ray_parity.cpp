// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/ray_parity.h"

#include <embree3/rtcore.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "sdf/soup_scene.h"

namespace exemplar {
namespace {

constexpr int kRays = 13;

// Directions spread evenly, none of them along an axis or a diagonal, where meshes have their
// edges: points of a Fibonacci lattice, turned by an arbitrary angle.
std::array<Vec3f, kRays> makeDirections() {
  std::array<Vec3f, kRays> directions;
  for (int r = 0; r < kRays; ++r) {
    const double z = 1 - (2 * r + 1.0) / kRays;
    const double angle = 0.7391 + r * std::numbers::pi * (3 - std::sqrt(5.0));
    const double s = std::sqrt(1 - z * z);
    directions[r] = cast<float>(Vec3d{s * std::cos(angle), s * std::sin(angle), z});
  }
  return directions;
}

struct CountingContext {
  RTCIntersectContext context;  // first, so that Embree's pointer to it is one to this
  unsigned hits;
};

// Counts a hit and refuses it, so that the ray continues.
void count(const RTCFilterFunctionNArguments* arguments) {
  ++reinterpret_cast<CountingContext*>(arguments->context)->hits;
  arguments->valid[0] = 0;
}

}  // namespace

struct ParityTest::Scene {
  // Robust: no ray slips between two triangles at their edge.
  explicit Scene(const TriangleSoup& soup)
      : triangles(soup, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                                   RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION)) {}

  SoupScene triangles;
  std::array<Vec3f, kRays> directions = makeDirections();
};

ParityTest::ParityTest(const TriangleSoup& soup) : scene_(std::make_unique<Scene>(soup)) {}

ParityTest::~ParityTest() = default;

bool ParityTest::inside(const Vec3d& p) const {
  int votes = 0;
  for (const Vec3f& direction : scene_->directions) {
    CountingContext counting;
    rtcInitIntersectContext(&counting.context);
    counting.context.filter = count;
    counting.hits = 0;
    RTCRay ray{};
    ray.org_x = static_cast<float>(p.x);
    ray.org_y = static_cast<float>(p.y);
    ray.org_z = static_cast<float>(p.z);
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tfar = std::numeric_limits<float>::infinity();
    ray.mask = 0xffffffff;
    rtcOccluded1(scene_->triangles.get(), &counting.context, &ray);
    votes += static_cast<int>(counting.hits & 1);
  }
  return 2 * votes > kRays;
}

void ParityTest::inside(std::span<const Vec3d> points, std::span<std::uint8_t> result) const {
  for (std::size_t p = 0; p < points.size(); ++p) result[p] = inside(points[p]);
}

}  // namespace exemplar
