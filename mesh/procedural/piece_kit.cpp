// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/procedural/piece_kit.h"

#include <cmath>
#include <numbers>

#include "mesh/primitives.h"

namespace exemplar {
namespace {

/// Points nearer than this are one: far below any detail, far above rounding.
constexpr double kGrain = 1.0 / (1 << 20);

std::array<double, 2> onCircle(double x, double y, double radius, int n, int sides) {
  // Half a step on, so that four and eight sides lie along the axes.
  const double angle = 2 * std::numbers::pi * (n + 0.5) / sides;
  return {x + radius * std::cos(angle), y + radius * std::sin(angle)};
}

}  // namespace

std::uint32_t PieceKit::material(const std::string& name, const std::array<float, 3>& color,
                                 float roughness, float metallic, float emission) {
  Material& m = mesh_.materials.emplace_back();
  m.name = name;
  m.baseColor = {color[0], color[1], color[2], 1};
  m.roughness = roughness;
  m.metallic = metallic;
  m.emission = Vec3f{color[0], color[1], color[2]} * emission;
  return static_cast<std::uint32_t>(mesh_.materials.size() - 1);
}

void PieceKit::at(const Vec3i& cell, int turns) { at(cell, turns, 0.5, 0.5); }

void PieceKit::at(const Vec3i& cell, int turns, double x, double y) {
  cell_ = cell;
  turns_ = turns & 3;
  axisX_ = x;
  axisY_ = y;
}

Vec3d PieceKit::placed(const Vec3d& p) const {
  double x = p.x - axisX_, y = p.y - axisY_;
  for (int n = 0; n < turns_; ++n) {
    const double turned = -y;
    y = x;
    x = turned;
  }
  return cast<double>(cell_) + Vec3d{x + axisX_, y + axisY_, p.z};
}

std::uint32_t PieceKit::point(const Vec3d& p) {
  std::array<std::int64_t, 3> key;
  for (int axis = 0; axis < 3; ++axis) key[axis] = std::llround(p[axis] / kGrain);
  const auto [found, isNew] =
      points_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
  if (isNew) {
    Vec3d rounded;
    for (int axis = 0; axis < 3; ++axis) rounded[axis] = static_cast<double>(key[axis]) * kGrain;
    mesh_.positions.push_back(rounded);
  }
  return found->second;
}

void PieceKit::triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, std::uint32_t material) {
  const std::array<std::uint32_t, 3> t{point(placed(a)), point(placed(b)), point(placed(c))};
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;
  mesh_.triangles.push_back(t);
  mesh_.triangleMaterials.push_back(material);
}

void PieceKit::face(std::span<const Vec3d> corners, std::uint32_t material) {
  for (std::size_t n = 2; n < corners.size(); ++n) {
    triangle(corners[0], corners[n - 1], corners[n], material);
  }
}

void PieceKit::box(const Vec3d& low, const Vec3d& high, std::uint32_t material, unsigned skip) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int far = 0; far < 2; ++far) {
      if (skip >> (2 * axis + far) & 1) continue;
      std::array<Vec3d, 4> corners;
      for (int n = 0; n < 4; ++n) {
        const bool uHigh = far ? n == 1 || n == 2 : n >= 2;
        const bool vHigh = far ? n >= 2 : n == 1 || n == 2;
        corners[n][axis] = far ? high[axis] : low[axis];
        corners[n][u] = uHigh ? high[u] : low[u];
        corners[n][v] = vHigh ? high[v] : low[v];
      }
      face(corners, material);
    }
  }
}

void PieceKit::prism(int axis, std::span<const std::array<double, 2>> polygon, double from,
                     double to, std::uint32_t material, unsigned caps) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto corner = [&](std::size_t n, double along) {
    Vec3d p;
    p[axis] = along;
    p[u] = polygon[n % polygon.size()][0];
    p[v] = polygon[n % polygon.size()][1];
    return p;
  };
  std::vector<Vec3d> near, far;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    near.push_back(corner(polygon.size() - n, from));
    far.push_back(corner(n, to));
    face(std::array{corner(n, from), corner(n + 1, from), corner(n + 1, to), corner(n, to)},
         material);
  }
  if (caps & 1) face(near, material);
  if (caps & 2) face(far, material);
}

void PieceKit::column(double x, double y, double radius, double z0, double z1, int sides,
                      std::uint32_t material) {
  std::vector<std::array<double, 2>> polygon;
  for (int n = 0; n < sides; ++n) polygon.push_back(onCircle(x, y, radius, n, sides));
  prism(2, polygon, z0, z1, material);
}

void PieceKit::spire(double x, double y, double radius, double z0, double z1, int sides,
                     std::uint32_t material) {
  std::vector<Vec3d> base;
  const Vec3d tip{x, y, z1};
  for (int n = 0; n < sides; ++n) {
    const auto a = onCircle(x, y, radius, n, sides), b = onCircle(x, y, radius, n + 1, sides);
    face(std::array{Vec3d{a[0], a[1], z0}, Vec3d{b[0], b[1], z0}, tip}, material);
    const auto below = onCircle(x, y, radius, sides - n, sides);
    base.push_back({below[0], below[1], z0});
  }
  face(base, material);
}

void PieceKit::taper(double x, double y, double r0, double r1, double z0, double z1, int sides,
                     std::uint32_t material) {
  std::vector<Vec3d> base, top;
  for (int n = 0; n < sides; ++n) {
    const auto a = onCircle(x, y, r0, n, sides), b = onCircle(x, y, r0, n + 1, sides);
    const auto c = onCircle(x, y, r1, n + 1, sides), d = onCircle(x, y, r1, n, sides);
    face(std::array{Vec3d{a[0], a[1], z0}, Vec3d{b[0], b[1], z0}, Vec3d{c[0], c[1], z1},
                    Vec3d{d[0], d[1], z1}},
         material);
    const auto below = onCircle(x, y, r0, sides - n, sides);
    base.push_back({below[0], below[1], z0});
    top.push_back({d[0], d[1], z1});
  }
  face(base, material);
  face(top, material);
}

void PieceKit::ball(const Vec3d& center, const Vec3d& radii, std::uint32_t material,
                    int frequency) {
  const TriangleMesh sphere = makeSphere({0, 0, 0}, 1, frequency);
  for (const auto& [a, b, c] : sphere.triangles) {
    const auto corner = [&](std::uint32_t v) {
      return center + scaled(sphere.positions[v], radii);
    };
    triangle(corner(a), corner(b), corner(c), material);
  }
}

void PieceKit::beams(unsigned sides, double half, double z0, double z1, std::uint32_t material,
                     unsigned closed) {
  const double low = 0.5 - half, high = 0.5 + half;
  const unsigned open = sides & ~closed;
  const unsigned ends = (open & kEast ? kMaxX : 0u) | (open & kNorth ? kMaxY : 0u) |
                        (open & kWest ? kMinX : 0u) | (open & kSouth ? kMinY : 0u);
  // Opposite sides without others make one beam; else arms meet a middle of their own width.
  if (sides == (kEast | kWest)) return box({0, low, z0}, {1, high, z1}, material, ends);
  if (sides == (kNorth | kSouth)) return box({low, 0, z0}, {high, 1, z1}, material, ends);
  box({low, low, z0}, {high, high, z1}, material,
      (sides & kEast ? kMaxX : 0u) | (sides & kNorth ? kMaxY : 0u) | (sides & kWest ? kMinX : 0u) |
          (sides & kSouth ? kMinY : 0u));
  if (sides & kEast) box({high, low, z0}, {1, high, z1}, material, kMinX | (ends & kMaxX));
  if (sides & kWest) box({0, low, z0}, {low, high, z1}, material, kMaxX | (ends & kMinX));
  if (sides & kNorth) box({low, high, z0}, {high, 1, z1}, material, kMinY | (ends & kMaxY));
  if (sides & kSouth) box({low, 0, z0}, {high, low, z1}, material, kMaxY | (ends & kMinY));
}

void PieceKit::ground(double bottom, const std::function<std::uint32_t(int, int)>& top,
                      std::uint32_t side) {
  for (int y = 0; y < size_.y; ++y) {
    for (int x = 0; x < size_.x; ++x) {
      at({x, y, 0});
      const std::uint32_t above = top(x, y);
      if (above != kNone) {
        face(std::array{Vec3d{0, 0, 1}, Vec3d{1, 0, 1}, Vec3d{1, 1, 1}, Vec3d{0, 1, 1}}, above);
      }
      const unsigned inner = (x > 0 ? kMinX : 0u) | (x + 1 < size_.x ? kMaxX : 0u) |
                             (y > 0 ? kMinY : 0u) | (y + 1 < size_.y ? kMaxY : 0u);
      box({0, 0, bottom}, {1, 1, 1}, side, inner | kMaxZ);
    }
  }
}

ProcessSample PieceKit::take() {
  // Only materials that triangles use.
  std::vector<std::uint32_t> number(mesh_.materials.size(), kNone);
  std::vector<Material> used;
  for (std::uint32_t& m : mesh_.triangleMaterials) {
    if (number[m] == kNone) {
      number[m] = static_cast<std::uint32_t>(used.size());
      used.push_back(mesh_.materials[m]);
    }
    m = number[m];
  }
  mesh_.materials = std::move(used);
  ProcessSample sample;
  sample.mesh = std::move(mesh_);
  sample.box = {{0, 0, 0}, cast<double>(size_)};
  sample.cell = Vec3d{1, 1, 1};
  return sample;
}

}  // namespace exemplar
