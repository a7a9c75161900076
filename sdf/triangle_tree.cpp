// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/triangle_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sdf/winding_lanes.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
constexpr std::uint32_t kParallelTriangles = 4096;
// How many times its radius a cluster must be away for its expansion to replace it.
constexpr double kFar = 2.3;

Vec3d centroid(const Corners& t) { return (t[0] + t[1] + t[2]) / 3.0; }
Vec3d areaVector(const Corners& t) { return cross(t[1] - t[0], t[2] - t[0]) * 0.5; }

// Leaves of a tree over n triangles, halved until a part fits in a leaf. At each depth the parts
// have one of two neighboring sizes, so the pair for (m, m + 1) follows from the pair for m / 2.
std::pair<std::uint32_t, std::uint32_t> leafCounts(std::uint32_t m) {
  if (m + 1 <= kLeafTriangles) return {1, 1};
  const auto [a, b] = leafCounts(m / 2);
  const std::uint32_t low = m <= kLeafTriangles ? 1 : m % 2 == 0 ? 2 * a : a + b;
  const std::uint32_t high = m % 2 == 0 ? a + b : 2 * b;
  return {low, high};
}
std::uint32_t leafCount(std::uint32_t n) { return leafCounts(n).first; }

double squaredBoxDistance(const Vec3d& p, const Vec3d& low, const Vec3d& high) {
  const Vec3d d = max(max(low - p, p - high), Vec3d{0, 0, 0});
  return dot(d, d);
}

}  // namespace

// What building needs besides the tree.
struct TriangleTree::Build {
  std::vector<Vec3d> centroids;
  Progress progress;
  For purpose;
};

TriangleTree::TriangleTree(std::vector<Corners> triangles, const Progress& progress, For purpose)
    : triangles_(std::move(triangles)) {
  const auto n = static_cast<std::uint32_t>(triangles_.size());
  if (n == 0) return;
  Build with{std::vector<Vec3d>(n), progress, purpose};
  order_.resize(n);
  for (std::uint32_t t = 0; t < n; ++t) {
    order_[t] = t;
    with.centroids[t] = centroid(triangles_[t]);
  }
  leaves_.resize(n);
  nodes_.resize(2 * static_cast<std::size_t>(leafCount(n)) - 1);
  moments_.resize(nodes_.size());
  discs_.resize(nodes_.size());
  build(with, 0, 0, n);
}

TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;
TriangleTree::~TriangleTree() = default;

void TriangleTree::build(const Build& with, std::uint32_t node, std::uint32_t first,
                         std::uint32_t count) {
  with.progress.check();
  Node& n = nodes_[node];
  n.first = first;
  n.count = count;
  if (count <= kLeafTriangles) {
    n.low = Vec3d{1, 1, 1} * std::numeric_limits<double>::infinity();
    n.high = -n.low;
    for (std::uint32_t i = first; i < first + count; ++i) {
      leaves_[i] = triangles_[order_[i]];
      for (const Vec3d& corner : leaves_[i]) {
        n.low = min(n.low, corner);
        n.high = max(n.high, corner);
      }
    }
    setMoments(node, with.purpose);
    return;
  }
  Vec3d low = Vec3d{1, 1, 1} * std::numeric_limits<double>::infinity(), high = -low;
  for (std::uint32_t i = first; i < first + count; ++i) {
    const Vec3d& c = with.centroids[order_[i]];
    low = min(low, c);
    high = max(high, c);
  }
  const Vec3d size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto begin = order_.begin() + first;
  // The index makes the order total, so that the same triangles always give the same tree.
  std::nth_element(begin, begin + count / 2, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    const double ca = with.centroids[a][axis], cb = with.centroids[b][axis];
    return ca != cb ? ca < cb : a < b;
  });
  const std::uint32_t half = count / 2;
  const std::uint32_t left = node + 1, right = node + 2 * leafCount(half);
  n.right = right;
  const auto buildLeft = [&] { build(with, left, first, half); };
  const auto buildRight = [&] { build(with, right, first + half, count - half); };
  if (count >= kParallelTriangles) {
    tbb::parallel_invoke(buildLeft, buildRight);
  } else {
    buildLeft();
    buildRight();
  }
  n.low = min(nodes_[left].low, nodes_[right].low);
  n.high = max(nodes_[left].high, nodes_[right].high);
  setMoments(node, with.purpose);
}

void TriangleTree::setMoments(std::uint32_t node, For purpose) {
  const Node& n = nodes_[node];
  ClusterMoments& m = moments_[node];
  Vec3d weighted{};
  double weight = 0;
  for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
    const Vec3d a = areaVector(leaves_[i]);
    const double area = length(a);
    m.area += a;
    weighted += centroid(leaves_[i]) * area;
    weight += area;
  }
  m.center = weight > 0 ? weighted / weight : (n.low + n.high) * 0.5;
  double radius2 = 0;
  for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
    for (const Vec3d& corner : leaves_[i]) {
      const Vec3d d = corner - m.center;
      radius2 = std::max(radius2, dot(d, d));
    }
    if (purpose == For::Distances) continue;
    const Vec3d a = areaVector(leaves_[i]);
    const Vec3d middle = centroid(leaves_[i]);
    const Vec3d c = middle - m.center;
    m.first[0] += c.x * a.x;
    m.first[1] += c.y * a.y;
    m.first[2] += c.z * a.z;
    m.first[3] += (c.x * a.y + c.y * a.x) * 0.5;
    m.first[4] += (c.x * a.z + c.z * a.x) * 0.5;
    m.first[5] += (c.y * a.z + c.z * a.y) * 0.5;
    // The mean of x x over the triangle: that of its centroid and its own around it.
    double xx = c.x * c.x, yy = c.y * c.y, zz = c.z * c.z;
    double xy = c.x * c.y, xz = c.x * c.z, yz = c.y * c.z;
    for (const Vec3d& corner : leaves_[i]) {
      const Vec3d o = corner - middle;
      xx += o.x * o.x / 12;
      yy += o.y * o.y / 12;
      zz += o.z * o.z / 12;
      xy += o.x * o.y / 12;
      xz += o.x * o.z / 12;
      yz += o.y * o.z / 12;
    }
    m.second[0] += xx * a.x;
    m.second[1] += yy * a.y;
    m.second[2] += zz * a.z;
    m.second[3] += (xx * a.y + 2 * xy * a.x) / 3;
    m.second[4] += (xx * a.z + 2 * xz * a.x) / 3;
    m.second[5] += (yy * a.x + 2 * xy * a.y) / 3;
    m.second[6] += (yy * a.z + 2 * yz * a.y) / 3;
    m.second[7] += (zz * a.x + 2 * xz * a.z) / 3;
    m.second[8] += (zz * a.y + 2 * yz * a.z) / 3;
    m.second[9] += (xy * a.z + xz * a.y + yz * a.x) / 3;
  }
  m.radius = std::sqrt(radius2);
  Disc& disc = discs_[node];
  disc.center = m.center;
  disc.axis = normalized(m.area);
  double across2 = 0;
  for (std::uint32_t i = n.first; i < n.first + n.count; ++i)
    for (const Vec3d& corner : leaves_[i]) {
      const Vec3d d = corner - m.center;
      const double along = dot(d, disc.axis);
      const Vec3d across = d - disc.axis * along;
      disc.halfHeight = std::max(disc.halfHeight, std::abs(along));
      across2 = std::max(across2, dot(across, across));
    }
  // Rounding must not make the bound too large.
  disc.radius = std::sqrt(across2) + 1e-12 * m.radius;
  disc.halfHeight += 1e-12 * m.radius;
}

// A lower bound on the squared distance of a node's triangles, or anything from `enough` up.
double TriangleTree::squaredBound(const Vec3d& p, std::uint32_t node, double enough) const {
  const double box2 = squaredBoxDistance(p, nodes_[node].low, nodes_[node].high);
  if (box2 >= enough) return box2;
  const Disc& disc = discs_[node];
  const Vec3d d = p - disc.center;
  const double along = dot(d, disc.axis), distance2 = dot(d, d);
  const double above = std::max(std::abs(along) - disc.halfHeight, 0.0);
  const double beside =
      std::max(std::sqrt(std::max(distance2 - along * along, 0.0)) - disc.radius, 0.0);
  // A hair less, for what rounding took from the squares above.
  const double disc2 = above * above + beside * beside - 1e-12 * distance2;
  return std::max(box2, disc2);
}

double TriangleTree::distance(const Vec3d& p, double limit) const {
  std::uint32_t near = kNone;
  return distance(p, limit, near);
}

double TriangleTree::distance(const Vec3d& p, double limit, std::uint32_t& near) const {
  if (nodes_.empty()) return limit;
  double best2 = limit * limit;
  std::uint32_t best = kNone;
  if (near != kNone) {
    const double d2 = squaredDistance(p, triangles_[near]);
    if (d2 < best2) {
      best2 = d2;
      best = near;
    }
  }
  std::array<std::pair<std::uint32_t, double>, kMaxDepth> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, squaredBound(p, 0, best2)};
  while (depth > 0) {
    const auto [node, bound2] = stack[--depth];
    if (bound2 >= best2) continue;
    const Node& n = nodes_[node];
    if (n.right == 0) {
      for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
        const double d2 = squaredDistance(p, leaves_[i]);
        if (d2 < best2) {
          best2 = d2;
          best = order_[i];
        }
      }
      continue;
    }
    const double left2 = squaredBound(p, node + 1, best2);
    const double right2 = squaredBound(p, n.right, best2);
    // The nearer child last, so that it comes off the stack first.
    if (left2 <= right2) {
      if (right2 < best2) stack[depth++] = {n.right, right2};
      if (left2 < best2) stack[depth++] = {node + 1, left2};
    } else {
      if (left2 < best2) stack[depth++] = {node + 1, left2};
      if (right2 < best2) stack[depth++] = {n.right, right2};
    }
  }
  near = best;
  return best == kNone ? limit : std::sqrt(best2);
}

double TriangleTree::windingNumber(const Vec3d& p) const {
  double result = 0;
  windingNumbers({&p, 1}, {&result, 1});
  return result;
}

void TriangleTree::windingNumbers(std::span<const Vec3d> points, std::span<double> result) const {
  if (nodes_.empty()) {
    std::fill(result.begin(), result.end(), 0.0);
    return;
  }
  for (std::size_t begin = 0; begin < points.size(); begin += WindingLanes::kMost) {
    const auto some =
        points.subspan(begin, std::min<std::size_t>(WindingLanes::kMost, points.size() - begin));
    Vec3d low = some[0], high = some[0];
    for (const Vec3d& p : some) {
      low = min(low, p);
      high = max(high, p);
    }
    const Vec3d middle = (low + high) * 0.5;
    const double radius = length(high - middle);
    WindingLanes lanes(some.data(), static_cast<int>(some.size()));
    std::array<std::uint32_t, kMaxDepth> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const std::uint32_t node = stack[--depth];
      const Node& n = nodes_[node];
      const ClusterMoments& m = moments_[node];
      const Vec3d d = m.center - middle;
      const double reach = kFar * m.radius + radius;  // far for all of the points
      if (dot(d, d) > reach * reach) {
        lanes.add(m);
      } else if (n.right == 0) {
        for (std::uint32_t i = n.first; i < n.first + n.count; ++i) lanes.add(leaves_[i]);
      } else {
        stack[depth++] = n.right;
        stack[depth++] = node + 1;
      }
    }
    lanes.finish(result.data() + begin);
  }
}

void TriangleTree::visitBox(const Vec3d& low, const Vec3d& high,
                            const std::function<void(std::uint32_t)>& visit) const {
  if (nodes_.empty()) return;
  const auto meets = [&](const Vec3d& l, const Vec3d& h) {
    return l.x <= high.x && l.y <= high.y && l.z <= high.z && h.x >= low.x && h.y >= low.y &&
           h.z >= low.z;
  };
  std::array<std::uint32_t, kMaxDepth> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t node = stack[--depth];
    const Node& n = nodes_[node];
    if (!meets(n.low, n.high)) continue;
    if (n.right == 0) {
      for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
        const Corners& t = leaves_[i];
        if (meets(min(min(t[0], t[1]), t[2]), max(max(t[0], t[1]), t[2]))) visit(order_[i]);
      }
    } else {
      stack[depth++] = n.right;
      stack[depth++] = node + 1;
    }
  }
}

}  // namespace exemplar
