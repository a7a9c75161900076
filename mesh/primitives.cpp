// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/primitives.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace exemplar {
namespace {

using Index = std::uint32_t;

constexpr double kPi = std::numbers::pi;

/// A unit vector across `d`, chosen by its smallest component so that it never degenerates.
Vec3d anyPerpendicular(const Vec3d& d) {
  const Vec3d a{std::abs(d.x), std::abs(d.y), std::abs(d.z)};
  const Vec3d axis = a.x <= a.y && a.x <= a.z ? Vec3d{1, 0, 0}
                     : a.y <= a.z             ? Vec3d{0, 1, 0}
                                              : Vec3d{0, 0, 1};
  return normalized(axis - d * (dot(axis, d) / dot(d, d)));
}

/// The cross sections of a half sphere of `radius` about `center`, without its pole and its
/// equator, from the pole to the equator where `towardsPole` is false. `d`: the sweep's direction.
void addCap(std::vector<SweepSection>& sections, const Vec3d& center, const Vec3d& d,
            const Vec3d& u, double radius, int segments, bool atEnd) {
  const int rings = std::max(1, segments / 4 - 1);
  const Vec3d v = cross(d, u);
  for (int n = 1; n <= rings; ++n) {
    const double angle = kPi / 2 * (atEnd ? n : rings + 1 - n) / (rings + 1);  // from the equator
    const double r = radius * std::cos(angle);
    const double along = (atEnd ? 1 : -1) * radius * std::sin(angle);
    sections.push_back({center + d * along, u * r, v * r});
  }
}

}  // namespace

TriangleMesh makeSphere(const Vec3d& center, double radius, int frequency) {
  assert(radius > 0 && frequency >= 1);
  // Twelve corners of the icosahedron with a pole up, and its twenty faces.
  std::array<Vec3d, 12> corners;
  corners[0] = {0, 0, 1};
  corners[11] = {0, 0, -1};
  const double height = 1 / std::sqrt(5.0), reach = 2 / std::sqrt(5.0);
  for (int n = 0; n < 5; ++n) {
    const double a = 2 * kPi * n / 5, b = a + kPi / 5;
    corners[1 + n] = {reach * std::cos(a), reach * std::sin(a), height};
    corners[6 + n] = {reach * std::cos(b), reach * std::sin(b), -height};
  }
  std::vector<std::array<Index, 3>> faces;
  for (Index n = 0; n < 5; ++n) {
    const Index m = (n + 1) % 5;
    faces.push_back({0, 1 + n, 1 + m});
    faces.push_back({1 + n, 6 + n, 1 + m});
    faces.push_back({1 + m, 6 + n, 6 + m});
    faces.push_back({6 + n, 11, 6 + m});
  }

  TriangleMesh mesh;
  // A vertex is named by what it is a mean of: up to three (corner, weight) pairs in corner order.
  // So neighboring faces share the vertices of their common edge.
  using Key = std::array<std::pair<Index, int>, 3>;
  std::map<Key, Index> known;
  const auto vertex = [&](const std::array<Index, 3>& face, int wa, int wb, int wc) {
    Key key{{{face[0], wa}, {face[1], wb}, {face[2], wc}}};
    for (auto& [corner, weight] : key)
      if (weight == 0) corner = 12;
    std::sort(key.begin(), key.end());
    const auto [entry, isNew] = known.try_emplace(key, static_cast<Index>(mesh.positions.size()));
    if (isNew) {
      // Summed in the key's order: the same bytes whichever face asks first.
      Vec3d p{};
      for (const auto& [corner, weight] : key)
        if (weight > 0) p += corners[corner] * static_cast<double>(weight);
      mesh.positions.push_back(center + normalized(p) * radius);
    }
    return entry->second;
  };
  for (const auto& face : faces)
    for (int i = 0; i < frequency; ++i)
      for (int j = 0; i + j < frequency; ++j) {
        const int k = frequency - i - j;
        const Index a = vertex(face, k, i, j), b = vertex(face, k - 1, i + 1, j),
                    c = vertex(face, k - 1, i, j + 1);
        mesh.triangles.push_back({a, b, c});
        if (k >= 2) mesh.triangles.push_back({b, vertex(face, k - 2, i + 1, j + 1), c});
      }
  return mesh;
}

TriangleMesh makeBox(const Box3d& box) {
  assert(box.min.x <= box.max.x && box.min.y <= box.max.y && box.min.z <= box.max.z);
  TriangleMesh mesh;
  for (int n = 0; n < 8; ++n)  // bits: x, y, z
    mesh.positions.push_back({n & 1 ? box.max.x : box.min.x, n & 2 ? box.max.y : box.min.y,
                              n & 4 ? box.max.z : box.min.z});
  constexpr std::array<std::array<Index, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : kFaces) {
    mesh.triangles.push_back({f[0], f[1], f[2]});
    mesh.triangles.push_back({f[0], f[2], f[3]});
  }
  return mesh;
}

TriangleMesh makeRoundedBox(const Box3d& box, double radius, int frequency) {
  const Vec3d center = 0.5 * (box.min + box.max), half = 0.5 * box.size();
  assert(radius > 0 && radius <= std::min({half.x, half.y, half.z}) && frequency % 2 == 0);
  // An eighth of a sphere in each corner; what spans two of them is an edge, four of them a side.
  TriangleMesh mesh = makeSphere({}, radius, frequency);
  for (Vec3d& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis)
      p[axis] += center[axis] + std::copysign(half[axis] - radius, p[axis]);
  return mesh;
}

TriangleMesh makeTorus(const Vec3d& center, const Vec3d& axis, double ringRadius, double wireRadius,
                       int ringSegments, int wireSegments) {
  assert(wireRadius > 0 && wireRadius < ringRadius && ringSegments >= 3 && wireSegments >= 3);
  const Vec3d w = normalized(axis), u = anyPerpendicular(w), v = cross(w, u);
  TriangleMesh mesh;
  for (int i = 0; i < ringSegments; ++i) {
    const double a = 2 * kPi * i / ringSegments;
    const Vec3d outward = u * std::cos(a) + v * std::sin(a);
    for (int j = 0; j < wireSegments; ++j) {
      const double b = 2 * kPi * j / wireSegments;
      mesh.positions.push_back(center + outward * (ringRadius + wireRadius * std::cos(b)) +
                               w * (wireRadius * std::sin(b)));
    }
  }
  const auto at = [&](int i, int j) {
    return static_cast<Index>(i % ringSegments * wireSegments + j % wireSegments);
  };
  for (int i = 0; i < ringSegments; ++i)
    for (int j = 0; j < wireSegments; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

TriangleMesh makeSweep(const Vec3d& start, std::span<const SweepSection> sections, const Vec3d& end,
                       int segments) {
  assert(!sections.empty() && segments >= 3);
  TriangleMesh mesh;
  mesh.positions.push_back(start);
  for (const SweepSection& s : sections)
    for (int j = 0; j < segments; ++j) {
      const double a = 2 * kPi * j / segments;
      mesh.positions.push_back(s.center + s.u * std::cos(a) + s.v * std::sin(a));
    }
  mesh.positions.push_back(end);
  const int rings = static_cast<int>(sections.size());
  const auto at = [&](int i, int j) { return static_cast<Index>(1 + i * segments + j % segments); };
  const Index last = static_cast<Index>(mesh.positions.size() - 1);
  for (int j = 0; j < segments; ++j) mesh.triangles.push_back({0, at(0, j + 1), at(0, j)});
  for (int i = 0; i + 1 < rings; ++i)
    for (int j = 0; j < segments; ++j) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  for (int j = 0; j < segments; ++j)
    mesh.triangles.push_back({last, at(rings - 1, j), at(rings - 1, j + 1)});
  return mesh;
}

TriangleMesh makeCylinder(const Vec3d& a, const Vec3d& b, double radius, int segments) {
  assert(radius > 0 && !(a == b));
  const Vec3d d = normalized(b - a), u = anyPerpendicular(d) * radius, v = cross(d, u);
  const std::array<SweepSection, 2> sections{{{a, u, v}, {b, u, v}}};
  return makeSweep(a, sections, b, segments);
}

TriangleMesh makeCapsule(const Vec3d& a, const Vec3d& b, double radius, int segments) {
  const std::array<Vec3d, 2> path{a, b};
  return makeTube(path, std::span<const double>(&radius, 1), segments);
}

TriangleMesh makeTube(std::span<const Vec3d> path, std::span<const double> radii, int segments) {
  assert(path.size() >= 2 && (radii.size() == 1 || radii.size() == path.size()) && segments >= 4);
  const std::size_t n = path.size();
  const auto radius = [&](std::size_t i) { return radii[radii.size() == 1 ? 0 : i]; };

  // Frames that do not twist: the double reflection method (Wang, Juettler, Zheng, Liu:
  // "Computation of rotation minimizing frames", ACM TOG 27(1), 2008, doi:10.1145/1330511.1330513,
  // section 4).
  std::vector<Vec3d> tangent(n), u(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d in = i > 0 ? normalized(path[i] - path[i - 1]) : Vec3d{};
    const Vec3d out = i + 1 < n ? normalized(path[i + 1] - path[i]) : Vec3d{};
    tangent[i] = normalized(in + out);
    if (tangent[i] == Vec3d{}) tangent[i] = in;  // the path turns back on itself
  }
  u[0] = anyPerpendicular(tangent[0]);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Vec3d chord = path[i + 1] - path[i];
    const double c1 = dot(chord, chord);
    const Vec3d uLeft = u[i] - chord * (2 / c1 * dot(chord, u[i]));
    const Vec3d tLeft = tangent[i] - chord * (2 / c1 * dot(chord, tangent[i]));
    const Vec3d second = tangent[i + 1] - tLeft;
    const double c2 = dot(second, second);
    const Vec3d next = c2 > 0 ? uLeft - second * (2 / c2 * dot(second, uLeft)) : uLeft;
    // Rounding must not add up along a long path.
    u[i + 1] = normalized(next - tangent[i + 1] * dot(next, tangent[i + 1]));
  }

  std::vector<SweepSection> sections;
  addCap(sections, path[0], tangent[0], u[0], radius(0), segments, false);
  for (std::size_t i = 0; i < n; ++i)
    sections.push_back({path[i], u[i] * radius(i), cross(tangent[i], u[i]) * radius(i)});
  addCap(sections, path[n - 1], tangent[n - 1], u[n - 1], radius(n - 1), segments, true);
  return makeSweep(path[0] - tangent[0] * radius(0), sections,
                   path[n - 1] + tangent[n - 1] * radius(n - 1), segments);
}

TriangleMesh makeBlade(const Blade& blade, int sections, int segments) {
  assert(blade.length > 0 && blade.width > 0 && blade.thickness > 0 && sections >= 2 &&
         segments >= 4 && blade.tip >= 0 && blade.tip <= 1);
  const Vec3d up = normalized(blade.up);
  const Vec3d lean = normalized(blade.lean - up * dot(blade.lean, up));
  const Vec3d side = cross(up, lean);  // the axis about which the spine bends
  std::vector<SweepSection> out;
  Vec3d p = blade.root;
  // The bend grows along the blade as its own weight bends it: little at the stiff base, most near
  // the tip. The spine is integrated by the midpoint rule on that angle.
  const auto direction = [&](double t) {
    const double angle = blade.bend * std::pow(t, 1.5);
    return up * std::cos(angle) + lean * std::sin(angle);
  };
  for (int i = 0; i < sections; ++i) {
    const double t = static_cast<double>(i) / (sections - 1);
    if (i > 0) p += direction(t - 0.5 / (sections - 1)) * (blade.length / (sections - 1));
    const Vec3d d = direction(t), normal = cross(d, side);
    const double turn = blade.twist * t, c = std::cos(turn), s = std::sin(turn);
    const Vec3d u = side * c + normal * -s, v = cross(d, u);
    // Two thirds of the width at the base, all of it at a quarter, then down to the tip.
    const double rise = std::min(1.0, t / 0.25), fall = std::max(0.0, (t - 0.25) / 0.75);
    const double base = 2.0 / 3 + (1 - 2.0 / 3) * rise * (2 - rise);
    const double taper = base * (1 - (1 - blade.tip) * fall * fall);
    const double half = std::max(taper, 1e-3);
    const double thin = std::max(0.35 + 0.65 * taper, 1e-3) * std::min(1.0, half / 0.3);
    out.push_back({p, u * (half * blade.width / 2), v * (thin * blade.thickness / 2)});
  }
  const double cap = blade.thickness / 2;
  return makeSweep(blade.root - up * cap, out,
                   p + direction(1) * (blade.tip * blade.width / 2 + 1e-3 * blade.length),
                   segments);
}

TriangleMesh makeHeightFieldSolid(const Vec3d& corner, double cellSize, int columns, int rows,
                                  std::span<const double> heights, double floor) {
  assert(columns >= 2 && rows >= 2 && cellSize > 0 &&
         heights.size() == static_cast<std::size_t>(columns) * rows);
  TriangleMesh mesh;
  const auto at = [&](int c, int r) { return static_cast<Index>(r * columns + c); };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      assert(heights[at(c, r)] > floor);
      mesh.positions.push_back(corner + Vec3d{c * cellSize, r * cellSize, heights[at(c, r)]});
    }
  for (int r = 0; r + 1 < rows; ++r)
    for (int c = 0; c + 1 < columns; ++c) {
      const Index a = at(c, r), b = at(c + 1, r), d = at(c, r + 1), e = at(c + 1, r + 1);
      if (std::abs(heights[a] - heights[e]) <= std::abs(heights[b] - heights[d])) {
        mesh.triangles.push_back({a, b, e});
        mesh.triangles.push_back({a, e, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, e, d});
      }
    }
  // The border once around, counterclockwise seen from above; its copy on the floor; a fan beneath.
  std::vector<Index> border;
  for (int c = 0; c + 1 < columns; ++c) border.push_back(at(c, 0));
  for (int r = 0; r + 1 < rows; ++r) border.push_back(at(columns - 1, r));
  for (int c = columns - 1; c > 0; --c) border.push_back(at(c, rows - 1));
  for (int r = rows - 1; r > 0; --r) border.push_back(at(0, r));
  const Index below = static_cast<Index>(mesh.positions.size());
  const Index count = static_cast<Index>(border.size());
  for (const Index n : border) {
    const Vec3d p = mesh.positions[n];
    mesh.positions.push_back({p.x, p.y, corner.z + floor});
  }
  const Index middle = static_cast<Index>(mesh.positions.size());
  mesh.positions.push_back(corner +
                           Vec3d{(columns - 1) * cellSize / 2, (rows - 1) * cellSize / 2, floor});
  for (Index n = 0; n < count; ++n) {
    const Index m = (n + 1) % count;
    mesh.triangles.push_back({border[n], below + n, below + m});
    mesh.triangles.push_back({border[n], below + m, border[m]});
    mesh.triangles.push_back({below + n, middle, below + m});
  }
  return mesh;
}

void setMaterial(TriangleMesh& mesh, const Material& material) {
  mesh.materials = {material};
  mesh.triangleMaterials.assign(mesh.triangles.size(), 0);
}

}  // namespace exemplar
