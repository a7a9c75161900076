// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/triangle_soup.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/stoppable.h"

namespace exemplar {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// One side of a triangle, as an edge from its lower to its higher point.
struct Side {
  std::uint32_t low, high;
  std::uint32_t triangle;
  std::uint8_t side;
  bool upwards;  // the triangle runs from low to high

  bool sameEdge(const Side& o) const { return low == o.low && high == o.high; }
  bool operator<(const Side& o) const {
    return std::tie(low, high, triangle, side) < std::tie(o.low, o.high, o.triangle, o.side);
  }
};

std::vector<Side> sortedSides(const std::vector<Triangle>& triangles, const Progress& progress) {
  std::vector<Side> sides(triangles.size() * 3);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (looksUp(t)) progress.check();
    for (std::uint8_t s = 0; s < 3; ++s) {
      const std::uint32_t a = triangles[t][s], b = triangles[t][(s + 1) % 3];
      sides[3 * std::size_t{t} + s] = {std::min(a, b), std::max(a, b), t, s, a < b};
    }
  }
  sortInParallel(sides, progress);  // the keys are total
  return sides;
}

// Calls visit(begin, end) for the sides of each edge.
template <class Visit>
void forEdges(const std::vector<Side>& sides, const Progress& progress, const Visit& visit) {
  for (std::size_t b = 0, e = 0, edge = 0; b < sides.size(); b = e, ++edge) {
    if (looksUp(edge)) progress.check();
    while (e < sides.size() && sides[e].sameEdge(sides[b])) ++e;
    visit(b, e);
  }
}

// The points with equal ones joined; `indices` becomes each vertex's point.
std::vector<Vec3d> joinPoints(const TriangleMesh& mesh, const Vec3d& origin, double scale,
                              std::vector<std::uint32_t>& indices, const Progress& progress) {
  const auto& positions = mesh.positions;
  std::vector<std::uint32_t> order(positions.size());
  for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = v;
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    const Vec3d &p = positions[a], &q = positions[b];
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  };
  sortInParallel(order, progress, before);
  indices.resize(positions.size());
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (looksUp(i)) progress.check();
    const Vec3d& p = positions[order[i]];
    if (i == 0 || !(p == positions[order[i - 1]])) points.push_back((p - origin) / scale);
    indices[order[i]] = static_cast<std::uint32_t>(points.size() - 1);
  }
  return points;
}

// For each triangle the first one that is the same, begun at any corner.
std::vector<std::uint32_t> firstEqual(const std::vector<Triangle>& triangles,
                                      const Progress& progress) {
  std::vector<std::pair<Triangle, std::uint32_t>> turned(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (looksUp(t)) progress.check();
    Triangle key = triangles[t];
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    turned[t] = {key, t};
  }
  sortInParallel(turned, progress);
  std::vector<std::uint32_t> first(triangles.size());
  for (std::size_t i = 0; i < turned.size(); ++i) {
    if (looksUp(i)) progress.check();
    const bool same = i > 0 && turned[i].first == turned[i - 1].first;
    first[turned[i].second] = same ? first[turned[i - 1].second] : turned[i].second;
  }
  return first;
}

// A flat quadrilateral that is there from both sides, cut along one diagonal on one side and along
// the other on the other: cuts both along the same one, so that its triangles are equal.
void matchDiagonalsOnce(const std::vector<Vec3d>& points, std::vector<Triangle>& triangles,
                        const Progress& progress) {
  struct Quad {
    Triangle left, right;              // from the diagonal's ends to a corner on each side
    std::array<std::uint32_t, 4> key;  // the corners, sorted
    std::uint32_t t, u;
    Vec3d normal;
    bool operator<(const Quad& o) const { return std::tie(key, t, u) < std::tie(o.key, o.t, o.u); }
  };
  const auto normalOf = [&](const Triangle& t) {
    return normalized(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]));
  };
  constexpr double kFlat = 0.9999;  // the cosine of the angle at the diagonal
  std::vector<Quad> quads;
  const std::vector<Side> sides = sortedSides(triangles, progress);
  forEdges(sides, progress, [&](std::size_t b, std::size_t e) {
    if (e - b != 2 || sides[b].upwards == sides[b + 1].upwards) return;
    const auto from = [&](const Side& s) {
      const Triangle& t = triangles[s.triangle];
      return Triangle{t[s.side], t[(s.side + 1) % 3], t[(s.side + 2) % 3]};
    };
    Quad q{from(sides[b]), from(sides[b + 1]), {}, sides[b].triangle, sides[b + 1].triangle, {}};
    q.normal = normalOf(q.left);
    if (!(dot(q.normal, normalOf(q.right)) > kFlat)) return;
    q.key = {q.left[0], q.left[1], q.left[2], q.right[2]};
    std::sort(q.key.begin(), q.key.end());
    quads.push_back(q);
  });
  sortInParallel(quads, progress);
  std::vector<std::uint8_t> used(triangles.size());
  for (std::size_t b = 0, e = 0; b < quads.size(); b = e) {
    while (e < quads.size() && quads[e].key == quads[b].key) ++e;
    const Quad& first = quads[b];
    for (const Quad& q : std::span<const Quad>(quads.data() + b + 1, quads.data() + e)) {
      const bool otherDiagonal =
          std::min(q.left[0], q.left[1]) != std::min(first.left[0], first.left[1]) ||
          std::max(q.left[0], q.left[1]) != std::max(first.left[0], first.left[1]);
      if (!otherDiagonal || dot(q.normal, first.normal) > -kFlat || used[q.t] || used[q.u])
        continue;
      used[q.t] = used[q.u] = 1;
      const auto [low, high, c] = q.left;
      const std::uint32_t d = q.right[2];
      triangles[q.t] = {low, d, c};
      triangles[q.u] = {d, high, c};
    }
    used[first.t] = used[first.u] = 1;
  }
}

// The same where triangles are there several times from one side: all of equal ones change alike.
void matchDiagonals(const std::vector<Vec3d>& points, std::vector<Triangle>& triangles,
                    const Progress& progress) {
  const std::vector<std::uint32_t> first = firstEqual(triangles, progress);
  std::vector<Triangle> different;
  std::vector<std::uint32_t> place(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (looksUp(t)) progress.check();
    place[t] = first[t] == t ? static_cast<std::uint32_t>(different.size()) : place[first[t]];
    if (first[t] == t) different.push_back(triangles[t]);
  }
  matchDiagonalsOnce(points, different, progress);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) triangles[t] = different[place[t]];
}

// Triangles without those that have no area, and of equal ones what is left when opposite ones have
// cancelled; and one of each set that cancelled.
struct Distinct {
  std::vector<Triangle> triangles;
  std::vector<Triangle> cancelled;
};

Distinct distinctTriangles(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles,
                           const Progress& progress) {
  struct Keyed {
    Triangle key;  // the corners, sorted
    std::uint32_t triangle;
    bool even;  // an even permutation of them
    bool operator<(const Keyed& o) const {
      return std::tie(key, triangle) < std::tie(o.key, o.triangle);
    }
  };
  std::vector<Keyed> keyed;
  keyed.reserve(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (looksUp(t)) progress.check();
    const auto [a, b, c] = triangles[t];
    if (a == b || b == c || c == a) continue;
    const Vec3d normal = cross(points[b] - points[a], points[c] - points[a]);
    if (!(dot(normal, normal) > 0)) continue;
    Keyed k{{a, b, c}, t, ((a < b) + (b < c) + (c < a)) == 2};
    std::sort(k.key.begin(), k.key.end());
    keyed.push_back(k);
  }
  sortInParallel(keyed, progress);
  std::vector<std::uint32_t> kept, cancelled;
  for (std::size_t b = 0, e = 0; b < keyed.size(); b = e) {
    int net = 0;
    for (; e < keyed.size() && keyed[e].key == keyed[b].key; ++e) net += keyed[e].even ? 1 : -1;
    if (net == 0) {
      cancelled.push_back(keyed[b].triangle);
      continue;
    }
    std::size_t k = b;
    while (keyed[k].even != (net > 0)) ++k;
    kept.push_back(keyed[k].triangle);
  }
  const auto inOrder = [&](std::vector<std::uint32_t>& which) {
    sortInParallel(which, progress);
    std::vector<Triangle> result;
    for (const std::uint32_t t : which) result.push_back(triangles[t]);
    return result;
  };
  return {inOrder(kept), inOrder(cancelled)};
}

// Turns the triangles of each part that is connected across edges of two to face one way, unless
// the part is one-sided.
void orient(const std::vector<Vec3d>& points, std::vector<Triangle>& triangles,
            const Progress& progress) {
  constexpr std::uint32_t kNone = TriangleSoup::kNone;
  std::vector<std::array<std::uint32_t, 3>> across(triangles.size(), {kNone, kNone, kNone});
  std::vector<std::array<bool, 3>> turned(triangles.size());  // the one across faces the other way
  bool any = false;
  const std::vector<Side> sides = sortedSides(triangles, progress);
  forEdges(sides, progress, [&](std::size_t b, std::size_t e) {
    if (e - b != 2) return;
    const Side &p = sides[b], &q = sides[b + 1];
    across[p.triangle][p.side] = q.triangle;
    across[q.triangle][q.side] = p.triangle;
    turned[p.triangle][p.side] = turned[q.triangle][q.side] = p.upwards == q.upwards;
    any |= p.upwards == q.upwards;
  });
  if (!any) return;
  std::vector<std::int8_t> way(triangles.size(), 0);  // 1 as it is, -1 turned, 0 not reached
  std::vector<std::uint32_t> part;
  for (std::uint32_t seed = 0; seed < triangles.size(); ++seed) {
    if (looksUp(seed)) progress.check();
    if (way[seed]) continue;
    part.assign(1, seed);
    way[seed] = 1;
    bool twoSided = true;
    double balance = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (looksUp(i)) progress.check();
      const std::uint32_t t = part[i];
      const auto& [a, b, c] = triangles[t];
      balance += way[t] * length(cross(points[b] - points[a], points[c] - points[a]));
      for (int s = 0; s < 3; ++s) {
        const std::uint32_t u = across[t][s];
        if (u == kNone) continue;
        const auto wanted = static_cast<std::int8_t>(turned[t][s] ? -way[t] : way[t]);
        if (way[u] == 0) {
          way[u] = wanted;
          part.push_back(u);
        } else if (way[u] != wanted) {
          twoSided = false;
        }
      }
    }
    if (!twoSided) continue;
    for (const std::uint32_t t : part)
      if ((way[t] > 0) != (balance >= 0)) std::swap(triangles[t][1], triangles[t][2]);
  }
}

// Whether all triangles lie in parallel planes.
bool isFlat(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles) {
  Vec3d first{};
  for (const auto& [a, b, c] : triangles) {
    const Vec3d n = normalized(cross(points[b] - points[a], points[c] - points[a]));
    if (first == Vec3d{}) first = n;
    if (!(std::abs(dot(n, first)) > 1 - 1e-9)) return false;
  }
  return true;
}

double sixVolumes(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles) {
  const Vec3d base = points[triangles[0][0]];
  double sum = 0;
  for (const auto& [a, b, c] : triangles)
    sum += dot(points[a] - base, cross(points[b] - base, points[c] - base));
  return sum;
}

// Of triangles that cancelled, those that are walls that a mesh has twice, once for each side:
// shells of their own that are not flat, turned outwards, and patches that close an opening which
// the other triangles leave. What is left are walls between two solids, and sheets.
std::vector<Triangle> doubledWalls(const std::vector<Vec3d>& points,
                                   const std::vector<Triangle>& others,
                                   const std::vector<Triangle>& cancelled,
                                   const Progress& progress) {
  if (cancelled.empty()) return {};
  // Groups that are connected across edges, and the edges of both kinds of triangles.
  std::vector<Triangle> all = cancelled;
  all.insert(all.end(), others.begin(), others.end());
  const std::size_t count = cancelled.size();
  const std::vector<Side> sides = sortedSides(all, progress);
  DisjointSets sets(count);
  forEdges(sides, progress, [&](std::size_t b, std::size_t e) {
    // In the order of triangles: those that cancelled come first.
    for (std::size_t i = b + 1; i < e && sides[i].triangle < count; ++i)
      sets.join(sides[b].triangle, sides[i].triangle);
  });
  std::vector<std::uint8_t> touches(count);  // by a group's root: an edge of other triangles
  std::vector<std::int64_t> opened(count);   // edges that it opens, less those that it closes
  forEdges(sides, progress, [&](std::size_t b, std::size_t e) {
    std::size_t mine = b;
    while (mine < e && sides[mine].triangle < count) ++mine;
    if (mine == b || mine == e) return;
    const std::size_t root = sets.find(sides[b].triangle);
    touches[root] = 1;
    const bool openBefore = (e - mine) % 2 != 0, openAfter = (e - b) % 2 != 0;
    opened[root] += int{openAfter} - int{openBefore};
  });
  std::vector<std::vector<Triangle>> groups(count);
  for (std::uint32_t t = 0; t < count; ++t) groups[sets.find(t)].push_back(cancelled[t]);
  std::vector<Triangle> walls;
  for (std::size_t root = 0; root < count; ++root) {
    std::vector<Triangle>& group = groups[root];
    if (group.empty()) continue;
    if (touches[root] ? opened[root] >= 0 : isFlat(points, group)) continue;
    if (!touches[root]) {
      orient(points, group, progress);
      if (sixVolumes(points, group) < 0)
        for (Triangle& t : group) std::swap(t[1], t[2]);
    }
    walls.insert(walls.end(), group.begin(), group.end());
  }
  return walls;
}

// Joins rim points that are less than kRimGap apart.
void joinRims(const std::vector<Vec3d>& points, const std::vector<std::uint8_t>& onRim,
              const Progress& progress, DisjointSets& sets) {
  constexpr double kRimGap = 0.25;
  using Cell = std::array<std::int64_t, 3>;
  const auto cellOf = [&](const Vec3d& p) {
    Cell cell;
    for (int axis = 0; axis < 3; ++axis)
      cell[axis] =
          static_cast<std::int64_t>(std::floor(std::clamp(p[axis] / kRimGap, -1e18, 1e18)));
    return cell;
  };
  std::vector<std::pair<Cell, std::uint32_t>> cells;
  for (std::uint32_t p = 0; p < points.size(); ++p)
    if (onRim[p]) cells.emplace_back(cellOf(points[p]), p);
  std::sort(cells.begin(), cells.end());
  for (const auto& [cell, p] : cells) {
    progress.check();
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        // The three cells along z follow each other in the order.
        const Cell first{cell[0] + dx, cell[1] + dy, cell[2] - 1};
        auto other =
            std::lower_bound(cells.begin(), cells.end(), std::make_pair(first, std::uint32_t{0}));
        for (; other != cells.end() && other->first[0] == first[0] && other->first[1] == first[1] &&
               other->first[2] <= cell[2] + 1;
             ++other) {
          if (length(points[p] - points[other->second]) < kRimGap) sets.join(p, other->second);
        }
      }
  }
}

// Numbers the components and each triangle's.
void connect(const std::vector<std::uint8_t>& onRim, const Progress& progress, TriangleSoup& soup) {
  DisjointSets sets(soup.points.size());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (looksUp(t)) progress.check();
    const auto& [a, b, c] = soup.triangles[t];
    sets.join(a, b);
    sets.join(a, c);
  }
  joinRims(soup.points, onRim, progress, sets);
  std::vector<std::uint32_t> number(soup.points.size(), TriangleSoup::kNone);
  soup.component.resize(soup.triangles.size());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (looksUp(t)) progress.check();
    std::uint32_t& n = number[sets.find(soup.triangles[t][0])];
    if (n == TriangleSoup::kNone) {
      n = static_cast<std::uint32_t>(soup.componentClosed.size());
      soup.componentClosed.push_back(1);
    }
    soup.component[t] = n;
    for (const std::uint32_t p : soup.triangles[t])
      if (onRim[p]) soup.componentClosed[n] = 0;
  }
}

// What a soup's points and triangles are together: `closed`, `even`, neighbors and components.
void describe(TriangleSoup& soup, const Progress& progress) {
  std::vector<std::uint8_t> onRim(soup.points.size());
  const std::vector<Side> sides = sortedSides(soup.triangles, progress);
  soup.closed = soup.even = true;
  constexpr std::uint32_t kNone = TriangleSoup::kNone;
  soup.neighbors.assign(soup.triangles.size(), {kNone, kNone, kNone});
  soup.componentClosed.clear();
  forEdges(sides, progress, [&](std::size_t b, std::size_t e) {
    int net = 0;
    for (std::size_t i = b; i < e; ++i) net += sides[i].upwards ? 1 : -1;
    soup.closed &= net == 0;
    if (net != 0) onRim[sides[b].low] = onRim[sides[b].high] = 1;
    soup.even &= (e - b) % 2 == 0;
    if (e - b == 2 && net == 0) {
      soup.neighbors[sides[b].triangle][sides[b].side] = sides[b + 1].triangle;
      soup.neighbors[sides[b + 1].triangle][sides[b + 1].side] = sides[b].triangle;
    }
  });
  connect(onRim, progress, soup);
}

// A component as a whole.
struct Whole {
  std::vector<std::uint32_t> triangles;
  Box3d box;
  double area = 0;  // twice
};

// Six times the volume of each closed component, below 0 where it is turned inwards; 0 of others.
std::vector<double> volumesOf(const TriangleSoup& soup, const Progress& progress) {
  std::vector<double> volumes(soup.componentClosed.size());
  std::vector<std::uint32_t> first(volumes.size(), TriangleSoup::kNone);
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    if (looksUp(t)) progress.check();
    const std::uint32_t c = soup.component[t];
    if (!soup.componentClosed[c]) continue;
    if (first[c] == TriangleSoup::kNone) first[c] = t;
    const Vec3d base = soup.points[soup.triangles[first[c]][0]];
    const auto [p, q, r] = cornersOf(soup, t);
    volumes[c] += dot(p - base, cross(q - base, r - base));
  }
  return volumes;
}

std::vector<Whole> wholes(const TriangleSoup& soup, const Progress& progress) {
  std::vector<Whole> result(soup.componentClosed.size());
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    if (looksUp(t)) progress.check();
    Whole& whole = result[soup.component[t]];
    const auto [a, b, c] = cornersOf(soup, t);
    for (const Vec3d& corner : {a, b, c}) whole.box.add(corner);
    whole.area += length(cross(b - a, c - a));
    whole.triangles.push_back(t);
  }
  return result;
}

// Whether a triangle's corners, middles of sides and middle are less than `reach` from a surface.
bool liesBeside(const Corners& t, const TriangleTree& surface, double reach) {
  const Vec3d points[] = {t[0],
                          t[1],
                          t[2],
                          (t[0] + t[1]) / 2,
                          (t[1] + t[2]) / 2,
                          (t[2] + t[0]) / 2,
                          (t[0] + t[1] + t[2]) / 3};
  return std::ranges::all_of(points,
                             [&](const Vec3d& p) { return surface.distance(p, reach) < reach; });
}

// Leaves out closed components that are turned inwards and lie beside one that is turned outwards
// and as large: the inner side of a shell without a thickness that could be seen, which bounds the
// solid that it looks like.
void dropInnerSides(TriangleSoup& soup, const Progress& progress) {
  constexpr double kThin = 0.25;  // what a surface is right to where triangles cross, too
  constexpr double kAlike = 1.5;  // of areas
  const std::vector<double> volumes = volumesOf(soup, progress);
  if (std::ranges::none_of(volumes, [](double volume) { return volume < 0; })) return;
  const std::vector<Whole> all = wholes(soup, progress);
  std::vector<std::uint32_t> inner, outer;
  for (std::uint32_t c = 0; c < all.size(); ++c)
    if (soup.componentClosed[c]) (volumes[c] < 0 ? inner : outer).push_back(c);
  const auto before = [&](std::uint32_t c, std::uint32_t d) {
    return std::tuple(all[c].box.min.x, c) < std::tuple(all[d].box.min.x, d);
  };
  std::sort(outer.begin(), outer.end(), before);
  std::vector<std::uint8_t> drop(all.size());
  for (const std::uint32_t i : inner) {
    const Whole& in = all[i];
    const auto isSideOf = [&](const Whole& out) {
      for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(in.box.min[axis] - out.box.min[axis]) < kThin &&
              std::abs(in.box.max[axis] - out.box.max[axis]) < kThin))
          return false;
      if (!(in.area < kAlike * out.area && out.area < kAlike * in.area)) return false;
      std::vector<Corners> corners;
      for (const std::uint32_t t : out.triangles) corners.push_back(cornersOf(soup, t));
      const TriangleTree surface(std::move(corners), progress, TriangleTree::For::Distances);
      return std::ranges::all_of(in.triangles, [&](std::uint32_t t) {
        return liesBeside(cornersOf(soup, t), surface, kThin);
      });
    };
    auto o = std::partition_point(outer.begin(), outer.end(), [&](std::uint32_t c) {
      return all[c].box.min.x < in.box.min.x - kThin;
    });
    for (; o != outer.end() && all[*o].box.min.x < in.box.min.x + kThin && !drop[i]; ++o)
      drop[i] = isSideOf(all[*o]);
  }
  if (std::ranges::none_of(drop, [](std::uint8_t d) { return d != 0; })) return;
  std::vector<Triangle> kept;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
    if (!drop[soup.component[t]]) kept.push_back(soup.triangles[t]);
  soup.triangles = std::move(kept);
  describe(soup, progress);
}

}  // namespace

std::vector<Corners> cornersOf(const TriangleSoup& soup) {
  std::vector<Corners> corners(soup.triangles.size());
  for (std::uint32_t t = 0; t < corners.size(); ++t) corners[t] = cornersOf(soup, t);
  return corners;
}

TriangleSoup makeSoup(const TriangleMesh& mesh, const Vec3d& origin, double scale,
                      const Progress& progress) {
  const auto report = [&](double fraction) { progress.report("reading the mesh", fraction); };
  report(0);
  TriangleSoup soup;
  std::vector<std::uint32_t> indices;
  soup.points = joinPoints(mesh, origin, scale, indices, progress);
  soup.triangles = mesh.triangles;
  for (auto& t : soup.triangles)
    for (std::uint32_t& v : t) v = indices[v];
  report(0.2);
  {
    matchDiagonals(soup.points, soup.triangles, progress);
    Distinct distinct = distinctTriangles(soup.points, soup.triangles, progress);
    const std::vector<Triangle> walls =
        doubledWalls(soup.points, distinct.triangles, distinct.cancelled, progress);
    soup.triangles = std::move(distinct.triangles);
    soup.triangles.insert(soup.triangles.end(), walls.begin(), walls.end());
  }
  report(0.4);
  orient(soup.points, soup.triangles, progress);
  report(0.6);
  describe(soup, progress);
  report(0.9);
  dropInnerSides(soup, progress);
  return soup;
}

}  // namespace exemplar
