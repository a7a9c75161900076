// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/solids.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/parallel.h"

namespace exemplar::continuous {
namespace {

bool isShell(const Solid& solid) { return !solid.triangles.empty(); }

/// Whether a point is in a convex part or on its border.
bool touches(const Solid& part, const ExactPoint& p) {
  return std::ranges::all_of(part.sides, [&](const ExactPlane& s) { return s.side(p) <= 0; });
}

/// What is infinitely near a point in a direction.
bool insidePart(const Solid& part, const ExactPoint& p, const Vec3l& direction) {
  return std::ranges::all_of(part.sides, [&](const ExactPlane& s) {
    const int side = s.side(p);
    return side < 0 || (side == 0 && dot(s.normal, direction) < 0);
  });
}

enum class Hit { No, Yes, Unsure };

/// Whether a ray from `p` along `direction`, which is not along the triangle's plane, goes through
/// a triangle, where its plane is known to be ahead. The line passes left or right of each edge by
/// the sign of a triple product of corners relative to p.
///
/// Corners and p are within a few ulps, so their differences are wrong by less than 2^-49 M for
/// coordinates up to M, and with differences up to L the product by less than
/// |d| (2^-47 M L + 2^-49 L^2); the bound below is twice that and more.
Hit hits(const Solids& solids, const ShellTriangle& triangle, const Vec3d& p, const Vec3d& d) {
  Vec3d v[3];
  double reach = 0, most = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), 1.0});
  for (int c = 0; c < 3; ++c) {
    const Vec3d& corner = solids.nearPoints[triangle.corners[c]];
    v[c] = corner - p;
    reach = std::max(reach, length(v[c]));
    most = std::max({most, std::abs(corner.x), std::abs(corner.y), std::abs(corner.z)});
  }
  const double bound = 0x1p-45 * length(d) * reach * (reach + most);
  int left = 0, right = 0;
  for (int c = 0; c < 3; ++c) {
    const double volume = dot(d, cross(v[c], v[(c + 1) % 3]));
    left += volume > bound;
    right += volume < -bound;
  }
  if (left > 0 && right > 0) return Hit::No;
  return left == 3 || right == 3 ? Hit::Yes : Hit::Unsure;
}

/// How often a shell winds around what is infinitely near `p` in a direction; nothing where the
/// ray that would say so passes too near to an edge.
std::optional<int> winding(const Solids& solids, const Solid& shell, const ExactPoint& p,
                           const Vec3l& direction) {
  const Vec3d from = p.approximately(), d = cast<double>(direction);
  int count = 0;
  for (const ShellTriangle& triangle : shell.triangles) {
    const ExactPlane& plane = shell.sides[triangle.plane];
    const int along = sign(dot(plane.normal, direction));
    if (plane.side(p) * along >= 0) continue;  // behind, through p, or parallel
    switch (hits(solids, triangle, from, d)) {
      case Hit::Yes:
        count += along;
        break;
      case Hit::Unsure:
        return std::nullopt;
      case Hit::No:
        break;
    }
  }
  return count;
}

/// The sum of a cell's rays with positive weights, others at each attempt.
Vec3l directionInto(const Central& central, std::uint32_t cell, int attempt) {
  Vec3l sum;
  std::uint32_t state = static_cast<std::uint32_t>(attempt) * 2654435761u;
  for (const std::uint32_t r : central.raysOfCell[cell]) {
    state = state * 1664525u + 1013904223u;
    const std::int64_t weight = attempt == 0 ? 1 : 1 + (state >> 24) % 32;
    sum += weight * central.rays[r].direction;
  }
  return sum;
}

/// `near` are the solids that may have anything at the point, ascending.
Substance substanceOf(const Solids& solids, std::span<const std::uint32_t> near,
                      const Central& central, const ExactPoint& point, std::uint32_t cell) {
  const Vec3l inward = directionInto(central, cell, 0);
  for (std::size_t n = near.size(); n-- > 0;) {
    const Solid& solid = solids.solids[near[n]];
    if (!isShell(solid)) {
      if (insidePart(solid, point, inward)) return solid.substance;
      continue;
    }
    std::optional<int> winds;
    for (int attempt = 0; attempt < 200 && !winds; ++attempt)
      winds = winding(solids, solid, point, directionInto(central, cell, attempt));
    if (!winds)
      throw InputError(
          "the example has faces too thin to say what is inside; simplify it, or use a larger "
          "`unit`");
    if (*winds > 0) return solid.substance;
  }
  if (solids.ground) {
    const ExactPlane top{{0, 0, 1}, solids.ground->height};
    const int side = top.side(point);
    if (side < 0 || (side == 0 && inward.z < 0)) return solids.ground->substance;
  }
  return kAir;
}

/// The two planes of each edge of a shell where it bends, and the edge's ends.
struct ShellEdge {
  ExactPlane a, b;
  std::uint32_t from = 0, to = 0;
  std::size_t solid = 0;
};
std::vector<ShellEdge> shellEdges(const Solids& solids) {
  std::vector<ShellEdge> edges;
  for (std::size_t s = 0; s < solids.solids.size(); ++s) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> first;
    for (const ShellTriangle& t : solids.solids[s].triangles) {
      for (int c = 0; c < 3; ++c) {
        const std::pair<std::uint32_t, std::uint32_t> ends =
            std::minmax({t.corners[c], t.corners[(c + 1) % 3]});
        const auto [known, isNew] = first.emplace(ends, t.plane);
        const std::vector<ExactPlane>& sides = solids.solids[s].sides;
        if (!isNew && sides[known->second].normal != sides[t.plane].normal)
          edges.push_back({sides[known->second], sides[t.plane], ends.first, ends.second, s});
      }
    }
  }
  return edges;
}

/// Whether a point is in the box of an edge's ends, with room for rounding.
bool nearEdge(const Solids& solids, const ShellEdge& edge, const Vec3d& p) {
  const Vec3d a = solids.nearPoints[edge.from], b = solids.nearPoints[edge.to];
  const Vec3d room{1e-6, 1e-6, 1e-6};
  const Vec3d low = min(a, b) - room, high = max(a, b) + room;
  return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y &&
         p.z <= high.z;
}

std::vector<ExactPlane> partPlanes(const Solids& solids) {
  std::vector<ExactPlane> planes;
  for (const Solid& solid : solids.solids) {
    if (isShell(solid)) continue;
    for (const ExactPlane& side : solid.sides) planes.push_back(canonical(side));
  }
  if (solids.ground) planes.push_back({{0, 0, 1}, solids.ground->height});
  makeDistinct(planes);
  return planes;
}

constexpr ExactBox kEmptyBox{{kMostCoordinate, kMostCoordinate, kMostCoordinate},
                             {-kMostCoordinate, -kMostCoordinate, -kMostCoordinate}};
void add(ExactBox& box, const ExactPoint& p) {
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(box.low[axis], floorDivide(p.n[axis], p.d));
    box.high[axis] = std::max(box.high[axis], -floorDivide(-p.n[axis], p.d));
  }
}

/// The smallest whole box around a convex part; `kEmptyBox` without corners.
ExactBox partBox(const Solid& part) {
  ExactBox box = kEmptyBox;
  ExactPoint p;
  const std::vector<ExactPlane>& sides = part.sides;
  for (std::size_t a = 0; a < sides.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      for (std::size_t c = 0; c < b; ++c)
        if (meet(sides[a], sides[b], sides[c], p) && touches(part, p)) add(box, p);
    }
  }
  return box;
}

bool overlap(const ExactBox& a, const ExactBox& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.low[axis] > b.high[axis] || b.low[axis] > a.high[axis]) return false;
  return true;
}

/// Points of each convex part at which planes of it and of parts next to it meet.
void addPartPoints(const Solids& solids, std::vector<ExactPoint>& points) {
  std::vector<std::size_t> parts;
  std::vector<ExactBox> boxes;
  for (std::size_t s = 0; s < solids.solids.size(); ++s) {
    if (isShell(solids.solids[s])) continue;
    parts.push_back(s);
    boxes.push_back(partBox(solids.solids[s]));
  }
  std::vector<std::vector<ExactPoint>> found(parts.size());
  parallelFor(0, parts.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) {
      const Solid& part = solids.solids[parts[n]];
      std::vector<ExactPlane> planes;
      for (std::size_t m = 0; m < parts.size(); ++m) {
        if (!overlap(boxes[n], boxes[m])) continue;
        for (const ExactPlane& side : solids.solids[parts[m]].sides)
          planes.push_back(canonical(side));
      }
      if (solids.ground) planes.push_back({{0, 0, 1}, solids.ground->height});
      makeDistinct(planes);
      ExactPoint p;
      for (std::size_t a = 0; a < planes.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
          for (std::size_t c = 0; c < b; ++c)
            if (meet(planes[a], planes[b], planes[c], p) && touches(part, p)) found[n].push_back(p);
        }
      }
      makeDistinct(found[n]);
    }
  });
  for (const std::vector<ExactPoint>& some : found)
    points.insert(points.end(), some.begin(), some.end());
}

bool touchesAnyPart(const Solids& solids, const ExactPoint& p) {
  if (solids.ground && p.n.z <= solids.ground->height * p.d) return true;
  return std::ranges::any_of(solids.solids,
                             [&](const Solid& s) { return !isShell(s) && touches(s, p); });
}

/// Throws where a convex part goes on for ever: along one of the lines in which two sides meet.
void requireBounded(const Solid& part) {
  bool corner = false;
  for (const ExactPlane& a : part.sides) {
    for (const ExactPlane& b : part.sides) {
      const Vec3l d = cross(a.normal, b.normal);
      if (d == Vec3l{}) continue;
      bool open = true;
      for (const ExactPlane& side : part.sides) {
        open = open && dot(side.normal, d) <= 0;
        corner = corner || dot(side.normal, d) != 0;
      }
      if (open) throw InputError("a part of the example is unbounded; give it planes all around");
    }
  }
  if (!corner) throw InputError("a part of the example is unbounded; give it planes all around");
}

}  // namespace

std::vector<ExactPlane> planesOf(const Solids& solids) {
  std::vector<ExactPlane> planes = partPlanes(solids);
  for (const Solid& solid : solids.solids)
    for (const ExactPlane& side : solid.sides) planes.push_back(canonical(side));
  makeDistinct(planes);
  return planes;
}

std::vector<Vec3l> normalsOf(std::span<const ExactPlane> planes) {
  std::vector<Vec3l> normals;
  for (const ExactPlane& plane : planes) normals.push_back(plane.normal);
  std::ranges::sort(normals, [](const Vec3l& a, const Vec3l& b) { return before(a, b); });
  normals.erase(std::unique(normals.begin(), normals.end()), normals.end());
  if (normals.size() > kMostFamilies) {
    throw InputError("the example has faces of " + std::to_string(normals.size()) +
                     " directions, and at most " + std::to_string(kMostFamilies) +
                     " can be handled; replace what is curved by fewer planes");
  }
  return normals;
}

std::vector<ExactPoint> candidatePoints(const Solids& solids) {
  std::vector<ExactPoint> points = solids.points;
  addPartPoints(solids, points);
  const std::vector<ExactPlane> parts = partPlanes(solids);
  ExactPoint p;
  const std::vector<ExactPlane> all = planesOf(solids);
  for (const ShellEdge& edge : shellEdges(solids)) {
    for (const ExactPlane& plane : all)
      if (meet(edge.a, edge.b, plane, p) && nearEdge(solids, edge, p.approximately()))
        points.push_back(p);
  }
  const bool shells = std::ranges::any_of(solids.solids, isShell);
  for (std::size_t a = 0; shells && a < parts.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      for (const ExactPlane& plane : all)
        if (meet(parts[a], parts[b], plane, p) && touchesAnyPart(solids, p)) points.push_back(p);
    }
  }
  makeDistinct(points);
  return points;
}

ExactBox boxOf(const Solids& solids) {
  ExactBox box = kEmptyBox;
  for (const Solid& solid : solids.solids) {
    if (isShell(solid)) continue;
    requireBounded(solid);
    const ExactBox part = partBox(solid);
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], part.low[axis]);
      box.high[axis] = std::max(box.high[axis], part.high[axis]);
    }
  }
  for (const ExactPoint& p : solids.points) add(box, p);
  if (box.low.x > box.high.x) throw InputError("the example has no solids");
  return box;
}

std::vector<Substance> substancesAround(const Solids& solids, const Central& central,
                                        const ExactPoint& point) {
  std::vector<std::uint32_t> near;
  for (std::uint32_t s = 0; s < solids.solids.size(); ++s)
    if (isShell(solids.solids[s]) || touches(solids.solids[s], point)) near.push_back(s);
  std::vector<Substance> found(central.cells.size());
  for (std::uint32_t c = 0; c < found.size(); ++c)
    found[c] = substanceOf(solids, near, central, point, c);
  return found;
}

}  // namespace exemplar::continuous
