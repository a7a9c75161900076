// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/camera.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/error.h"

namespace exemplar {
namespace {

struct NamedView {
  std::string_view name;
  double azimuth, elevation;  // degrees
};

constexpr NamedView kViews[] = {{"front", 0, 0},  {"back", 180, 0}, {"left", -90, 0},
                                {"right", 90, 0}, {"top", 0, 90},   {"bottom", 0, -90}};

double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

}  // namespace

View viewFromName(std::string_view name) {
  if (name == "iso") return {};
  for (const NamedView& v : kViews)
    if (name == v.name) return {radians(v.azimuth), radians(v.elevation)};

  double angles[2];
  const char* at = name.data();
  const char* const end = at + name.size();
  bool good = true;
  for (int n = 0; n < 2 && good; ++n) {
    const auto [next, error] = std::from_chars(at, end, angles[n]);
    good = error == std::errc{} && (n == 0 ? next != end && *next == ',' : next == end);
    at = good && n == 0 ? next + 1 : next;
  }
  if (good && std::abs(angles[0]) <= 360 && std::abs(angles[1]) <= 90)
    return {radians(angles[0]), radians(angles[1])};
  throw InputError(
      "view '" + std::string(name) +
      "' is unknown; views are iso, front, back, left, right, top, bottom, or AZ,EL in "
      "degrees (-360..360, -90..90), as -35,30");
}

// In the camera's axes a point (a, b, c) is inside the picture of a camera at (A, B, C) where
// |a - A| <= tx (c - C) and |b - B| <= ty (c - C). The first says A - tx C >= a - tx c and
// A + tx C <= a + tx c for every point, so the largest C that leaves room for some A is
// (min(a + tx c) - max(a - tx c)) / (2 tx); the same for B; the smaller of both C serves.
CameraFit::CameraFit(const RenderOptions& options) {
  const double ca = std::cos(options.view.azimuth), sa = std::sin(options.view.azimuth);
  const double ce = std::cos(options.view.elevation), se = std::sin(options.view.elevation);
  axes_.right = {ca, sa, 0};
  axes_.forward = {-sa * ce, ca * ce, -se};
  axes_.up = cross(axes_.right, axes_.forward);
  const double shorter = std::min(options.width, options.height);
  const double tangent = std::tan(options.fieldOfView / 2);
  axes_.tanX = tangent * options.width / shorter;
  axes_.tanY = tangent * options.height / shorter;
  const double free = 1 - 2 * options.margin;
  freeX_ = axes_.tanX * free;
  freeY_ = axes_.tanY * free;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  lowX_ = lowY_ = -kInfinity;
  highX_ = highY_ = nearest_ = kInfinity;
}

void CameraFit::add(const Vec3d& p) {
  const double a = dot(p, axes_.right), b = dot(p, axes_.up), c = dot(p, axes_.forward);
  lowX_ = std::max(lowX_, a - freeX_ * c);
  highX_ = std::min(highX_, a + freeX_ * c);
  lowY_ = std::max(lowY_, b - freeY_ * c);
  highY_ = std::min(highY_, b + freeY_ * c);
  nearest_ = std::min(nearest_, c);
}

Camera CameraFit::camera(double minimumDepth) const {
  const double depth = std::min(
      {(highX_ - lowX_) / (2 * freeX_), (highY_ - lowY_) / (2 * freeY_), nearest_ - minimumDepth});
  Camera camera = axes_;
  camera.position = camera.right * ((lowX_ + highX_) / 2) + camera.up * ((lowY_ + highY_) / 2) +
                    camera.forward * depth;
  return camera;
}

Camera pictureCamera(const TriangleMesh& mesh, const RenderOptions& options) {
  validate(mesh, "picture");
  CameraFit fit(options);
  Box3d held;
  forEachHeldPoint(mesh, options, [&](const Vec3d& p) {
    fit.add(p);
    held.add(p);
  });
  const Vec3d size = held.size();
  const double reach = std::max({size.x, size.y, size.z}) / 2;
  return fit.camera(reach > 0 ? 0.05 * reach : 1);
}

std::optional<std::array<double, 2>> pictureOf(const Camera& camera, const Vec3d& point) {
  const Vec3d d = point - camera.position;
  const double depth = dot(d, camera.forward);
  if (!(depth > 0)) return std::nullopt;
  return std::array<double, 2>{0.5 + dot(d, camera.right) / (2 * depth * camera.tanX),
                               0.5 - dot(d, camera.up) / (2 * depth * camera.tanY)};
}

Box3d frameOfSize(const Box3d& box, const Vec3d& size) {
  const Vec3d center = box.center();
  return {{center.x - size.x / 2, center.y - size.y / 2, box.min.z},
          {center.x + size.x / 2, center.y + size.y / 2, box.min.z + size.z}};
}

}  // namespace exemplar
