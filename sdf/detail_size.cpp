// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/detail_size.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"
#include "sdf/solid_test.h"
#include "sdf/soup_scene.h"
#include "sdf/triangle_soup.h"
#include "sdf/triangle_tree.h"

namespace exemplar {
namespace {

constexpr std::size_t kPoints = 4096;
constexpr double kShare = 0.03;
constexpr double kOpposite = 0.95;  // the cosine between a ray and the normal where it arrives
// The mesh is looked at as if its longest side had this many voxels; steps off the surface are a
// thousandth of one, and parts thinner than that are sheets.
constexpr double kSide = 64, kStep = 1e-3;
// Faces buried in the solid that a ray goes through before it is given up.
constexpr int kBuried = 16;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct SurfacePoint {
  Vec3d place, normal;
};

// A ray from the surface until the side of the solid changes.
struct Ray {
  Vec3d from, along;
  bool inwards;
  double length = 0;  // so far
  double cosine = 0;  // of the normal where it is
  bool done = false, opposite = false;
};

// Points spread over the area, each in a stretch of its own.
std::vector<SurfacePoint> spread(const TriangleSoup& soup, const TriangleTree& tree) {
  std::vector<double> upTo(1, 0);
  for (const std::uint32_t t : tree.order()) {
    const Corners c = cornersOf(soup, t);
    upTo.push_back(upTo.back() + length(cross(c[1] - c[0], c[2] - c[0])));
  }
  std::vector<SurfacePoint> points;
  const Random random(0, stream::kDetailPlaces);
  std::size_t t = 0;
  for (std::size_t p = 0; p < kPoints; ++p) {
    const double at = (static_cast<double>(p) + random.uniform(p, 0)) /
                      static_cast<double>(kPoints) * upTo.back();
    while (t + 1 < tree.count() && upTo[t + 1] <= at) ++t;
    const Corners c = cornersOf(soup, tree.order()[t]);
    double u = random.uniform(p, 1), v = random.uniform(p, 2);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vec3d ab = c[1] - c[0], ac = c[2] - c[0];
    points.push_back({c[0] + ab * u + ac * v, normalized(cross(ab, ac))});
  }
  return points;
}

// Which points are inside, neighbors asked together.
std::vector<std::uint8_t> insideOf(const SolidTest& solid, const std::vector<Vec3d>& points) {
  std::vector<std::uint8_t> inside(points.size());
  constexpr std::size_t kTogether = 16;
  parallelFor(0, points.size(), kTogether, [&](std::size_t b, std::size_t e) {
    solid.inside({points.data() + b, e - b}, {inside.data() + b, e - b});
  });
  return inside;
}

// Takes a ray on to the next triangle; false where there is none.
bool advance(RTCScene scene, Ray& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit hit{};
  const Vec3d at = ray.from + ray.along * ray.length;
  hit.ray.org_x = static_cast<float>(at.x);
  hit.ray.org_y = static_cast<float>(at.y);
  hit.ray.org_z = static_cast<float>(at.z);
  hit.ray.dir_x = static_cast<float>(ray.along.x);
  hit.ray.dir_y = static_cast<float>(ray.along.y);
  hit.ray.dir_z = static_cast<float>(ray.along.z);
  hit.ray.tnear = static_cast<float>(kStep);
  hit.ray.tfar = std::numeric_limits<float>::infinity();
  hit.ray.mask = 0xffffffff;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &hit);
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  ray.length += hit.ray.tfar;
  const Vec3d normal = normalized(Vec3d{hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z});
  ray.cosine = std::abs(dot(normal, ray.along));
  return true;
}

// Follows all rays to where the side changes.
void follow(const SolidTest& solid, RTCScene scene, std::vector<Ray>& rays,
            const Progress& progress) {
  for (int round = 0; round < kBuried; ++round) {
    progress.check();
    std::vector<std::size_t> going;
    std::vector<std::uint8_t> hit(rays.size());
    parallelFor(0, rays.size(), 64, [&](std::size_t b, std::size_t e) {
      for (std::size_t r = b; r < e; ++r)
        if (!rays[r].done) hit[r] = advance(scene, rays[r]);
    });
    std::vector<Vec3d> beyond;
    for (std::size_t r = 0; r < rays.size(); ++r) {
      if (rays[r].done) continue;
      rays[r].done = !hit[r];
      if (!hit[r]) continue;
      going.push_back(r);
      beyond.push_back(rays[r].from + rays[r].along * (rays[r].length + kStep));
    }
    if (going.empty()) return;
    const std::vector<std::uint8_t> inside = insideOf(solid, beyond);
    for (std::size_t g = 0; g < going.size(); ++g) {
      Ray& ray = rays[going[g]];
      if ((inside[g] != 0) == ray.inwards) continue;
      ray.done = true;
      ray.opposite = ray.cosine > kOpposite;
    }
  }
}

double lowShare(std::vector<double> lengths, std::size_t points) {
  const auto n = static_cast<std::size_t>(kShare * static_cast<double>(points));
  if (n >= lengths.size()) return kInfinity;
  std::nth_element(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(n),
                   lengths.end());
  return lengths[n];
}

}  // namespace

DetailSize detailSize(const TriangleMesh& mesh, const Progress& progress) {
  progress.report("looking at detail", 0);
  const Box3d box = boundingBox(mesh);
  const Vec3d size = box.size();
  const double scale = std::max({size.x, size.y, size.z}) / kSide;
  if (!(scale > 0)) return {kInfinity, kInfinity};
  const TriangleSoup soup = makeSoup(mesh, box.center(), scale, progress.part(0, 0.3));
  const auto tree = std::make_shared<const TriangleTree>(
      cornersOf(soup), progress,
      soup.closed ? TriangleTree::For::Distances : TriangleTree::For::Everything);
  if (tree->count() == 0) return {kInfinity, kInfinity};
  const SolidTest solid(soup, tree, progress);
  const SoupScene scene(soup, RTC_SCENE_FLAG_ROBUST);
  progress.report("looking at detail", 0.5);

  const std::vector<SurfacePoint> points = spread(soup, *tree);
  std::vector<Vec3d> sides;
  for (const SurfacePoint& p : points)
    for (const double way : {kStep, -kStep}) sides.push_back(p.place + p.normal * way);
  const std::vector<std::uint8_t> inside = insideOf(solid, sides);
  std::vector<Ray> rays;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (inside[2 * p] == inside[2 * p + 1]) continue;  // buried, or a sheet
    const Vec3d out = inside[2 * p] ? -points[p].normal : points[p].normal;
    rays.push_back({points[p].place, -out, true});
    rays.push_back({points[p].place, out, false});
  }
  follow(solid, scene.get(), rays, progress);
  std::vector<double> through, across;
  for (const Ray& ray : rays)
    if (ray.opposite) (ray.inwards ? through : across).push_back(ray.length * scale);
  progress.report("looking at detail", 1);
  return {lowShare(std::move(through), rays.size() / 2),
          lowShare(std::move(across), rays.size() / 2)};
}

}  // namespace exemplar
