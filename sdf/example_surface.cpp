// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/example_surface.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/memory.h"
#include "sdf/closest_point.h"

namespace exemplar {

namespace {

/// What a visit reads, side by side in memory: mostly the first of two cache lines only.
struct alignas(64) ExampleTriangle {
  Vec3d normal;
  Vec3d center;      // of a ball that holds the triangle
  double reach = 0;  // its radius
  Corners corners;
};

}  // namespace

struct ExampleSurface::Data {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  Vec3d center{};  // Embree's floats are relative to it
  std::vector<ExampleTriangle> triangles;
  double meanSide = 0;  // of the triangles

  ~Data() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// The spheres that are searched first: the radius of the first, in mean sides of triangles, by how
// much each is wider than the one before, and how many.
constexpr double kFirst = 0.2, kWider = 3;
constexpr int kSpheres = 4;

/// What a running query knows; Embree hands it to `visit` with each triangle that is near enough.
struct Search {
  const std::vector<ExampleTriangle>& triangles;
  const Vec3d& point;
  const ClosestOptions& options;
  double cost = kInfinity;
  SurfacePoint best;
};

/// Floats in the tree are rounded: look a little further than the best so far, so that what is
/// found does not depend on the order of the visits.
float lookWithin(double distance) { return static_cast<float>(distance * (1 + 1e-5) + 1e-30); }

bool visit(RTCPointQueryFunctionArguments* args) {
  Search& search = *static_cast<Search*>(args->userPtr);
  const ClosestOptions& options = search.options;
  const std::uint32_t t = args->primID;
  if (!options.groups.empty() && options.groups[t] != options.group) return false;
  const ExampleTriangle& triangle = search.triangles[t];
  const double turned = options.facingCost * (1 - dot(triangle.normal, options.facing)) / 2;
  if (turned > search.cost) return false;
  // Most are too far by the ball around them already; a hair more, for what rounding takes.
  const Vec3d away = search.point - triangle.center;
  const double far = (std::min(search.cost - turned, options.radius) + triangle.reach) * (1 + 1e-9);
  if (dot(away, away) > far * far) return false;
  const auto& [a, b, c] = triangle.corners;
  const auto weights =
      atClosestPoint(search.point, triangle.corners,
                     [](const std::array<double, 3>& w, const Vec3d&) { return w; });
  const Vec3d position = a * weights[0] + b * weights[1] + c * weights[2];
  const double distance = length(position - search.point);
  if (distance > options.radius) return false;
  const double cost = distance + turned;
  if (cost > search.cost || (cost == search.cost && t >= search.best.triangle)) return false;
  search.cost = cost;
  search.best = {t, weights, position, distance};
  const float within = lookWithin(std::min(cost, options.radius));
  if (!(within < args->query->radius)) return false;
  args->query->radius = within;
  return true;
}

}  // namespace

ExampleSurface::ExampleSurface(const TriangleMesh& mesh, const Progress& progress)
    : data_(std::make_unique<Data>()) {
  progress.check();
  requireMemory(330.0 * static_cast<double>(mesh.triangles.size()),
                "looking up the example's surface", "use an example with fewer triangles");
  const Box3d box = boundingBox(mesh);
  data_->center = box.empty() ? Vec3d{} : box.center();
  data_->triangles.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    ExampleTriangle& triangle = data_->triangles[t];
    triangle.corners = {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
    triangle.normal = normalized(areaNormal(mesh, t));
    triangle.center = (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3.0;
    for (const Vec3d& corner : triangle.corners) {
      triangle.reach = std::max(triangle.reach, length(corner - triangle.center));
    }
  }

  for (const ExampleTriangle& t : data_->triangles) {
    data_->meanSide += length(t.corners[1] - t.corners[0]) / double(data_->triangles.size());
  }

  progress.check();
  data_->device = rtcNewDevice(nullptr);
  if (!data_->device) {
    throw std::runtime_error("Embree cannot start: error " +
                             std::to_string(rtcGetDeviceError(nullptr)));
  }
  data_->scene = rtcNewScene(data_->device);
  RTCGeometry geometry = rtcNewGeometry(data_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), std::max<std::size_t>(1, mesh.positions.size())));
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
      std::max<std::size_t>(1, mesh.triangles.size())));
  if (!points || !indices) {
    rtcReleaseGeometry(geometry);
    throw InputError("the surface does not fit in memory; use one with fewer triangles");
  }
  for (const Vec3d& p : mesh.positions) {
    for (int a = 0; a < 3; ++a) *points++ = static_cast<float>(p[a] - data_->center[a]);
  }
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) *indices++ = v;
  }
  rtcSetGeometryPointQueryFunction(geometry, visit);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(data_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(data_->scene);
}

ExampleSurface::~ExampleSurface() = default;
ExampleSurface::ExampleSurface(ExampleSurface&&) noexcept = default;
ExampleSurface& ExampleSurface::operator=(ExampleSurface&&) noexcept = default;

std::optional<SurfacePoint> ExampleSurface::closest(const Vec3d& point,
                                                    const ClosestOptions& options) const {
  // Small spheres first: they hold few triangles, and mostly the nearest one. What lies beyond a
  // sphere costs more than its radius.
  double radius = kFirst * data_->meanSide;
  for (int sphere = 0;; ++sphere, radius *= kWider) {
    const bool last = sphere == kSpheres || !(radius < options.radius);
    ClosestOptions within = options;
    if (!last) within.radius = radius;
    Search search{data_->triangles, point, within, kInfinity, {}};
    RTCPointQuery query;
    query.x = static_cast<float>(point.x - data_->center.x);
    query.y = static_cast<float>(point.y - data_->center.y);
    query.z = static_cast<float>(point.z - data_->center.z);
    query.time = 0;
    query.radius = lookWithin(within.radius);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(data_->scene, &query, &context, nullptr, &search);
    if (search.cost < radius || (last && search.cost < kInfinity)) return search.best;
    if (last) return std::nullopt;
  }
}

const Vec3d& ExampleSurface::normal(std::uint32_t triangle) const {
  return data_->triangles[triangle].normal;
}

}  // namespace exemplar
