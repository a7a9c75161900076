// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/sheet.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <string>
#include <tuple>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/error.h"
#include "core/memory.h"

namespace exemplar::surface {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kNone = 0xffffffff;
/// Cotangents below count as this: weights stay positive, whatever the triangles.
constexpr double kLeastWeight = 0.02, kMostWeight = 50;
/// About what a node takes: itself, its edges and triangles, its share of the equations and maps.
constexpr double kBytesPerNode = 4000;

using Triangle = std::array<std::uint32_t, 3>;

/// The sides of triangles, sorted by their lower, then their higher node.
struct Sides {
  struct Side {
    std::uint32_t low, high, triangle;
    std::uint8_t corner;
    bool operator<(const Side& o) const {
      return std::tie(low, high, triangle, corner) < std::tie(o.low, o.high, o.triangle, o.corner);
    }
    bool sameEdge(const Side& o) const { return low == o.low && high == o.high; }
  };
  std::vector<Side> sorted;

  explicit Sides(const std::vector<Triangle>& triangles) {
    sorted.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      for (std::uint8_t c = 0; c < 3; ++c) {
        const std::uint32_t a = triangles[t][c], b = triangles[t][(c + 1) % 3];
        sorted.push_back({std::min(a, b), std::max(a, b), t, c});
      }
    }
    std::sort(sorted.begin(), sorted.end());
  }
  /// Calls `visit(first, last)` with the sides of each edge.
  template <class Visit>
  void forEachEdge(const Visit& visit) const {
    for (auto first = sorted.begin(); first != sorted.end();) {
      auto last = first + 1;
      while (last != sorted.end() && last->sameEdge(*first)) ++last;
      visit(first, last);
      first = last;
    }
  }
};

double angleBetween(const Vec3d& a, const Vec3d& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

}  // namespace

/// Builds a sheet step by step.
class SheetBuilder {
 public:
  SheetBuilder(const TriangleMesh& mesh, const SheetOptions& options) : options_(options) {
    s_.positions = mesh.positions;
    for (const Triangle& t : mesh.triangles) {
      const Vec3d n =
          cross(s_.positions[t[1]] - s_.positions[t[0]], s_.positions[t[2]] - s_.positions[t[0]]);
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0] && length(n) > 0) s_.triangles.push_back(t);
    }
    if (s_.triangles.empty()) throw InputError("the surface has no triangle with area");
    s_.sizes = options.sizes;
    if (s_.sizes.empty()) s_.sizes.assign(s_.positions.size(), 1);
  }

  Sheet build(const Progress& progress) {
    requireRoom();
    connect();
    findNormals();
    progress.report("cutting the surface finely", 0.2);
    while (refine()) progress.report("cutting the surface finely", 0.5);
    dropUnused();
    connect();
    makeEdges();
    makeFans();
    makeAngles();
    findComponents();
    progress.report("cutting the surface finely", 1);
    return std::move(s_);
  }

 private:
  void requireRoom() const {
    double area = 0;  // in squares of the example's size there
    for (const Triangle& t : s_.triangles) {
      const double size = (s_.sizes[t[0]] + s_.sizes[t[1]] + s_.sizes[t[2]]) / 3;
      area += length(areaNormalOf(t)) / 2 / (size * size);
    }
    // An edge that is halved is between one half and all of the limit.
    const double nodes =
        static_cast<double>(s_.positions.size()) + area / (0.35 * options_.edge * options_.edge);
    requireMemory(
        kBytesPerNode * nodes,
        "a surface of about " + std::to_string(static_cast<long long>(nodes)) + " samples",
        "use a lower `resolution` or a larger `span`");
  }
  Vec3d areaNormalOf(const Triangle& t) const {
    return cross(s_.positions[t[1]] - s_.positions[t[0]], s_.positions[t[2]] - s_.positions[t[0]]);
  }
  /// The angle of a triangle at one of its corners.
  double cornerAngle(const Triangle& t, int c) const {
    const Vec3d& p = s_.positions[t[c]];
    return angleBetween(s_.positions[t[(c + 1) % 3]] - p, s_.positions[t[(c + 2) % 3]] - p);
  }

  /// Which triangle is across each side.
  void connect() {
    s_.across.assign(s_.triangles.size(), {-1, -1, -1});
    Sides(s_.triangles).forEachEdge([&](auto first, auto last) {
      if (last - first == 1) return;
      const auto& a = *first;
      const auto& b = *(first + 1);
      const bool opposed = s_.triangles[a.triangle][a.corner] != s_.triangles[b.triangle][b.corner];
      if (last - first > 2 || !opposed)
        throw InputError(
            "the surface is no manifold: an edge has more than two triangles, or two "
            "that are turned against each other");
      s_.across[a.triangle][a.corner] = static_cast<std::int32_t>(b.triangle);
      s_.across[b.triangle][b.corner] = static_cast<std::int32_t>(a.triangle);
    });
  }
  int cornerOf(std::uint32_t triangle, std::uint32_t node) const {
    const Triangle& t = s_.triangles[triangle];
    return t[0] == node ? 0 : t[1] == node ? 1 : 2;
  }

  /// Each corner's normal: the mean of those of the triangles around it, by their angles, as far as
  /// they meet smoothly.
  void findNormals() {
    std::vector<Vec3d> unit(s_.triangles.size());
    for (std::size_t t = 0; t < unit.size(); ++t)
      unit[t] = normalized(areaNormalOf(s_.triangles[t]));
    const double smooth = std::cos(options_.crease);
    DisjointSets fans(3 * s_.triangles.size());
    for (std::uint32_t t = 0; t < unit.size(); ++t) {
      for (int c = 0; c < 3; ++c) {
        const std::int32_t other = s_.across[t][c];
        if (other < 0 || dot(unit[t], unit[other]) < smooth) continue;
        for (const int end : {c, (c + 1) % 3}) {
          const int there = cornerOf(static_cast<std::uint32_t>(other), s_.triangles[t][end]);
          fans.join(3 * t + end, 3 * static_cast<std::uint32_t>(other) + there);
        }
      }
    }
    std::vector<Vec3d> sums(3 * s_.triangles.size());
    for (std::uint32_t h = 0; h < sums.size(); ++h)
      sums[fans.find(h)] += unit[h / 3] * cornerAngle(s_.triangles[h / 3], h % 3);
    s_.normals.resize(s_.triangles.size());
    for (std::uint32_t h = 0; h < sums.size(); ++h) {
      const Vec3d n = normalized(sums[fans.find(h)]);
      s_.normals[h / 3][h % 3] = n == Vec3d{} ? unit[h / 3] : n;
    }
  }

  /// Halves all edges that are too long, once. Returns whether there were any.
  bool refine() {
    std::vector<Triangle> middle(s_.triangles.size(), {kNone, kNone, kNone});
    bool any = false;
    Sides(s_.triangles).forEachEdge([&](auto first, auto last) {
      const Vec3d along = s_.positions[first->high] - s_.positions[first->low];
      const double size = (s_.sizes[first->low] + s_.sizes[first->high]) / 2;
      const double limit = options_.edge * size;
      if (dot(along, along) <= limit * limit) return;
      any = true;
      const auto node = static_cast<std::uint32_t>(s_.positions.size());
      s_.sizes.push_back(size);
      s_.positions.push_back((s_.positions[first->low] + s_.positions[first->high]) * 0.5);
      for (auto side = first; side != last; ++side) middle[side->triangle][side->corner] = node;
    });
    if (!any) return false;
    std::vector<Triangle> triangles;
    std::vector<std::array<Vec3d, 3>> normals;
    triangles.reserve(4 * s_.triangles.size());
    normals.reserve(4 * s_.triangles.size());
    for (std::size_t t = 0; t < s_.triangles.size(); ++t)
      cut(s_.triangles[t], s_.normals[t], middle[t], triangles, normals);
    s_.triangles = std::move(triangles);
    s_.normals = std::move(normals);
    return true;
  }

  /// A triangle cut at those of its sides that have a node in the middle.
  void cut(const Triangle& t, const std::array<Vec3d, 3>& n, const Triangle& middle,
           std::vector<Triangle>& triangles, std::vector<std::array<Vec3d, 3>>& normals) const {
    using Corner = std::pair<std::uint32_t, Vec3d>;
    const auto add = [&](const Corner& a, const Corner& b, const Corner& c) {
      triangles.push_back({a.first, b.first, c.first});
      normals.push_back({a.second, b.second, c.second});
    };
    std::array<Corner, 3> corner, between;
    int cuts = 0, uncut = 0, lone = 0;
    for (int c = 0; c < 3; ++c) {
      corner[c] = {t[c], n[c]};
      between[c] = {middle[c], normalized(n[c] + n[(c + 1) % 3])};
      if (middle[c] == kNone) {
        uncut = c;
      } else {
        ++cuts;
        lone = c;
      }
    }
    if (cuts == 0) return add(corner[0], corner[1], corner[2]);
    if (cuts == 3) {
      for (int c = 0; c < 3; ++c) add(corner[c], between[c], between[(c + 2) % 3]);
      return add(between[0], between[1], between[2]);
    }
    if (cuts == 1) {
      const int a = lone, b = (lone + 1) % 3, c = (lone + 2) % 3;
      add(corner[a], between[a], corner[c]);
      return add(between[a], corner[b], corner[c]);
    }
    // Corner c is opposite the side that stays; the rest is cut along its shorter diagonal.
    const int a = uncut, b = (uncut + 1) % 3, c = (uncut + 2) % 3;
    add(between[b], corner[c], between[c]);
    const Vec3d fromA = s_.positions[between[b].first] - s_.positions[t[a]];
    const Vec3d fromB = s_.positions[between[c].first] - s_.positions[t[b]];
    if (dot(fromA, fromA) <= dot(fromB, fromB)) {
      add(corner[a], corner[b], between[b]);
      add(corner[a], between[b], between[c]);
    } else {
      add(corner[a], corner[b], between[c]);
      add(corner[b], between[b], between[c]);
    }
  }

  void dropUnused() {
    std::vector<std::uint32_t> number(s_.positions.size(), kNone);
    std::vector<Vec3d> positions;
    std::vector<double> sizes;
    for (Triangle& t : s_.triangles) {
      for (std::uint32_t& node : t) {
        if (number[node] == kNone) {
          number[node] = static_cast<std::uint32_t>(positions.size());
          positions.push_back(s_.positions[node]);
          sizes.push_back(s_.sizes[node]);
        }
        node = number[node];
      }
    }
    s_.positions = std::move(positions);
    s_.sizes = std::move(sizes);
  }

  void makeEdges() {
    s_.sides.resize(s_.triangles.size());
    s_.atBorder.assign(s_.positions.size(), 0);
    Sides(s_.triangles).forEachEdge([&](auto first, auto last) {
      Sheet::Edge edge{.a = first->low, .b = first->high};
      edge.length = length(s_.positions[edge.b] - s_.positions[edge.a]);
      for (auto side = first; side != last; ++side) {
        const double angle = cornerAngle(s_.triangles[side->triangle], (side->corner + 2) % 3);
        edge.weight += std::clamp(std::cos(angle) / std::max(std::sin(angle), 1e-9), -kMostWeight,
                                  kMostWeight) /
                       2;
        s_.sides[side->triangle][side->corner] = static_cast<std::uint32_t>(s_.edges.size());
      }
      edge.weight = std::max(edge.weight, kLeastWeight);
      if (last - first == 1) s_.atBorder[edge.a] = s_.atBorder[edge.b] = 1;
      s_.edges.push_back(edge);
    });
    const std::size_t n = s_.positions.size();
    s_.begin_.assign(n + 1, 0);
    for (const Sheet::Edge& e : s_.edges) {
      ++s_.begin_[e.a + 1];
      ++s_.begin_[e.b + 1];
    }
    for (std::size_t v = 0; v < n; ++v) s_.begin_[v + 1] += s_.begin_[v];
    s_.links_.resize(2 * s_.edges.size());
    std::vector<std::uint32_t> end(s_.begin_.begin(), s_.begin_.end() - 1);
    for (std::uint32_t e = 0; e < s_.edges.size(); ++e) {
      s_.links_[end[s_.edges[e].a]++] = {s_.edges[e].b, e, true};
      s_.links_[end[s_.edges[e].b]++] = {s_.edges[e].a, e, false};
    }
  }

  /// The triangles around each node, anticlockwise; at a border from its first triangle on.
  void makeFans() {
    const std::size_t n = s_.positions.size();
    std::vector<std::uint32_t> count(n, 0), first(n, kNone);
    for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) {
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t v = s_.triangles[t][c];
        ++count[v];
        // Clockwise of it there is nothing: the fan begins here.
        if (first[v] == kNone || s_.across[t][c] < 0) first[v] = t;
      }
    }
    s_.fanBegin_.assign(n + 1, 0);
    for (std::size_t v = 0; v < n; ++v) s_.fanBegin_[v + 1] = s_.fanBegin_[v] + count[v];
    s_.fans_.resize(3 * s_.triangles.size());
    for (std::uint32_t v = 0; v < n; ++v) {
      std::uint32_t t = first[v], at = s_.fanBegin_[v];
      for (;;) {
        s_.fans_[at++] = t;
        const std::int32_t next = s_.across[t][(cornerOf(t, v) + 2) % 3];
        if (next < 0 || static_cast<std::uint32_t>(next) == first[v]) break;
        t = static_cast<std::uint32_t>(next);
      }
      if (at != s_.fanBegin_[v + 1])
        throw InputError("the surface is no manifold: parts of it touch in a single point");
    }
  }

  void makeAngles() {
    const std::size_t n = s_.positions.size();
    s_.nodeNormals.resize(n);
    s_.axes.resize(n);
    s_.areas.assign(n, 0);
    for (std::uint32_t v = 0; v < n; ++v) {
      double around = 0;
      Vec3d normal{};
      for (const std::uint32_t t : s_.trianglesAt(v)) {
        const int c = cornerOf(t, v);
        const double angle = cornerAngle(s_.triangles[t], c);
        around += angle;
        normal += s_.normals[t][c] * angle;
        s_.areas[v] += length(areaNormalOf(s_.triangles[t])) / 6;
      }
      s_.area += s_.areas[v];
      normal = normalized(normal);
      const std::uint32_t first = s_.trianglesAt(v).front();
      if (normal == Vec3d{}) normal = normalized(areaNormalOf(s_.triangles[first]));
      s_.nodeNormals[v] = normal;
      const std::uint32_t next = s_.triangles[first][(cornerOf(first, v) + 1) % 3];
      const Vec3d along = s_.positions[next] - s_.positions[v];
      Vec3d axis = normalized(along - normal * dot(along, normal));
      if (axis == Vec3d{})
        axis =
            normalized(cross(normal, std::abs(normal.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
      s_.axes[v] = axis;
      const double stretch = s_.atBorder[v] ? 1 : 2 * kPi / around;
      double angle = 0;
      for (const std::uint32_t t : s_.trianglesAt(v)) {
        const int c = cornerOf(t, v);
        setAngle(s_.sides[t][c], v, angle * stretch);
        angle += cornerAngle(s_.triangles[t], c);
        if (s_.across[t][(c + 2) % 3] < 0) setAngle(s_.sides[t][(c + 2) % 3], v, angle * stretch);
      }
    }
  }
  void setAngle(std::uint32_t edge, std::uint32_t node, double angle) {
    Sheet::Edge& e = s_.edges[edge];
    (e.a == node ? e.angleA : e.angleB) = angle;
  }

  void findComponents() {
    DisjointSets sets(s_.positions.size());
    for (const Sheet::Edge& e : s_.edges) sets.join(e.a, e.b);
    s_.component = sets.numbered(&s_.components);
  }

  SheetOptions options_;
  Sheet s_;
};

double Sheet::Edge::transport() const { return angleB + kPi - angleA; }

bool Sheet::closed() const {
  return std::find(atBorder.begin(), atBorder.end(), 1) == atBorder.end();
}

std::int64_t Sheet::eulerCharacteristic() const {
  return static_cast<std::int64_t>(positions.size()) - static_cast<std::int64_t>(edges.size()) +
         static_cast<std::int64_t>(triangles.size());
}

double Sheet::angleOf(std::uint32_t node, const Vec3d& direction) const {
  const Vec3d left = cross(nodeNormals[node], axes[node]);
  return std::atan2(dot(direction, left), dot(direction, axes[node]));
}

Vec3d Sheet::directionOf(std::uint32_t node, double angle) const {
  const Vec3d left = cross(nodeNormals[node], axes[node]);
  return axes[node] * std::cos(angle) + left * std::sin(angle);
}

double Sheet::sizeAt(std::uint32_t triangle, const std::array<double, 3>& weights) const {
  double size = 0;
  for (int c = 0; c < 3; ++c) size += weights[c] * sizes[triangles[triangle][c]];
  return size;
}

void evenSizes(Sheet& sheet, double rate) {
  using Entry = std::pair<double, std::uint32_t>;  // logarithm of a size, node
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::uint32_t v = 0; v < sheet.sizes.size(); ++v) queue.push({std::log(sheet.sizes[v]), v});
  std::vector<std::uint8_t> done(sheet.sizes.size(), 0);
  while (!queue.empty()) {
    const auto [size, v] = queue.top();
    queue.pop();
    if (done[v]) continue;
    done[v] = 1;
    for (const Sheet::Link& link : sheet.links(v)) {
      const double most = size + rate * sheet.edges[link.edge].length;
      if (std::log(sheet.sizes[link.node]) <= most) continue;
      sheet.sizes[link.node] = std::exp(most);
      queue.push({most, link.node});
    }
  }
}

Sheet makeSheet(const TriangleMesh& mesh, const SheetOptions& options, const Progress& progress) {
  if (!(options.edge > 0)) throw InputError("the length of a sheet's edges must be above 0");
  validate(mesh, "the surface");
  if (!options.sizes.empty() && options.sizes.size() != mesh.positions.size())
    throw InputError("the surface needs a size for each vertex, or none");
  for (const double size : options.sizes)
    if (!(size > 0) || !std::isfinite(size)) throw InputError("sizes on a surface must be above 0");
  return SheetBuilder(mesh, options).build(progress);
}

}  // namespace exemplar::surface
