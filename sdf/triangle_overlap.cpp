// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/triangle_overlap.h"

#include <algorithm>
#include <cmath>

namespace exemplar {
namespace {

struct Interval {
  double low, high;
};

Interval along(const Vec3d& axis, const Corners& t) {
  const double p = dot(axis, t[0]), q = dot(axis, t[1]), r = dot(axis, t[2]);
  return {std::min({p, q, r}), std::max({p, q, r})};
}

// Two convex sets are apart exactly if a normal of one or a cross product of two edges separates
// them (Gottschalk, Lin, Manocha: "OBBTree", SIGGRAPH 1996); for triangles in one plane, a normal
// of an edge within it.
bool meet(const Corners& a, const Corners& b, bool touching) {
  // Relative to a corner, so that large coordinates cost no digits.
  const Vec3d base = a[0];
  const Corners p{a[0] - base, a[1] - base, a[2] - base}, q{b[0] - base, b[1] - base, b[2] - base};
  const std::array<Vec3d, 3> pe{p[1] - p[0], p[2] - p[1], p[0] - p[2]};
  const std::array<Vec3d, 3> qe{q[1] - q[0], q[2] - q[1], q[0] - q[2]};
  double size = 0;
  for (const Corners* t : {&p, &q})
    for (const Vec3d& c : *t) size = std::max({size, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  const double slack = 1e-9 * size;
  // On a face's own normal touching always counts, or triangles in one plane would never meet.
  const double rim = touching ? slack : -slack;
  const auto separates = [&](Vec3d axis, double allowed) {
    const double l = length(axis);
    if (!(l > 1e-12 * size * size)) return false;  // parallel edges: no direction of their own
    axis = axis / l;
    const Interval i = along(axis, p), j = along(axis, q);
    return i.low > j.high + allowed || j.low > i.high + allowed;
  };
  const Vec3d pn = cross(pe[0], pe[1]), qn = cross(qe[0], qe[1]);
  if (separates(pn, slack) || separates(qn, slack)) return false;
  // Two edges in one face's plane have its normal for their product.
  const auto parallel = [](const Vec3d& u, const Vec3d& v) {
    const Vec3d w = cross(u, v);
    return dot(w, w) <= 1e-18 * dot(u, u) * dot(v, v);
  };
  for (const Vec3d& e : pe)
    for (const Vec3d& f : qe) {
      const Vec3d axis = cross(e, f);
      if (separates(axis, parallel(axis, pn) || parallel(axis, qn) ? slack : rim)) return false;
    }
  for (const Vec3d& e : pe)
    if (separates(cross(pn / size, e), rim)) return false;
  for (const Vec3d& f : qe)
    if (separates(cross(qn / size, f), rim)) return false;
  return true;
}

}  // namespace

bool trianglesMeet(const Corners& a, const Corners& b) { return meet(a, b, true); }
bool trianglesOverlap(const Corners& a, const Corners& b) { return meet(a, b, false); }

}  // namespace exemplar
