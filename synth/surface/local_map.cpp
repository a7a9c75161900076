// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/local_map.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <unordered_map>
#include <utility>

namespace exemplar::surface {
namespace {

/// Ways along edges are longer than the shortest ones by up to this.
constexpr double kDetour = 1.3;
/// The share of a map's area that may be stretched too much, either way.
constexpr double kOutliers = 0.05;
constexpr std::uint32_t kNone = LocalMap::kNowhere;

/// The nodes of a disc in the order in which they were reached.
struct Disc {
  struct Reached {
    std::uint32_t node;
    double distance;
    std::uint32_t parent;  ///< its number here
    Sheet::Link link;      ///< from the parent
  };
  std::vector<Reached> order;
  std::unordered_map<std::uint32_t, std::uint32_t> number;

  Disc(const Sheet& sheet, std::uint32_t seed, double distance) {
    struct Entry {
      double distance;
      std::uint32_t node, parent;
      Sheet::Link link;
      bool operator>(const Entry& o) const {
        return std::tie(distance, node, parent) > std::tie(o.distance, o.node, o.parent);
      }
    };
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::unordered_map<std::uint32_t, double> best;
    queue.push({0, seed, kNone, {}});
    best[seed] = 0;
    while (!queue.empty()) {
      const Entry next = queue.top();
      queue.pop();
      const auto at = static_cast<std::uint32_t>(order.size());
      if (!number.emplace(next.node, at).second) continue;
      order.push_back({next.node, next.distance, next.parent, next.link});
      for (const Sheet::Link& link : sheet.links(next.node)) {
        const Sheet::Edge& edge = sheet.edges[link.edge];
        const double far = next.distance + edge.length / sheet.sizeOf(edge);
        if (far > distance) continue;
        const auto [found, fresh] = best.emplace(link.node, far);
        if (!fresh && found->second <= far) continue;
        found->second = far;
        queue.push({far, link.node, at, link});
      }
    }
  }
};

/// Singular values of the map of a triangle from the surface to the plane.
std::pair<double, double> stretchOf(const std::array<Vec3d, 3>& p, const std::array<Vec2d, 3>& at,
                                    double sample) {
  const Vec3d e1 = (p[1] - p[0]) / sample, e2 = (p[2] - p[0]) / sample;
  const Vec3d x = normalized(e1);
  const Vec3d n = normalized(cross(e1, e2));
  const Vec3d y = cross(n, x);
  const Mat2d from{dot(e1, x), dot(e2, x), 0, dot(e2, y)};
  const Vec2d f1 = at[1] - at[0], f2 = at[2] - at[0];
  const Mat2d j = Mat2d{f1.x, f2.x, f1.y, f2.y} * from.inverse();
  const double sum = std::hypot(j.xx + j.yy, j.yx - j.xy);
  const double difference = std::hypot(j.xx - j.yy, j.yx + j.xy);
  return {(sum - difference) / 2, (sum + difference) / 2};
}

}  // namespace

std::uint32_t LocalMap::find(std::uint32_t node) const {
  const auto found = std::lower_bound(nodes.begin(), nodes.end(), node);
  return found == nodes.end() || *found != node ? kNowhere
                                                : static_cast<std::uint32_t>(found - nodes.begin());
}

std::vector<std::pair<std::uint32_t, double>> LocalMapper::near(std::uint32_t seed,
                                                                double distance) const {
  std::vector<std::pair<std::uint32_t, double>> result;
  for (const Disc::Reached& r : Disc(sheet_, seed, distance).order)
    result.emplace_back(r.node, r.distance);
  return result;
}

bool LocalMapper::joined(const LocalMap& map, std::uint32_t a, std::uint32_t b,
                         const Sheet::Link& link) const {
  const Coordinates& c = coordinates_;
  const Coordinates::Step step = c.along(link);
  if ((map.turns[a] + step.turns) % c.symmetry != map.turns[b]) return false;
  if (c.lattice.periods == 0) return true;
  const Vec2d expected = c.turned(map.turns[a]) * step.by;
  const Vec2d off = c.lattice.basis().inverse() * (map.at[b] - map.at[a]) - expected;
  return std::abs(off.x) < 0.5 && (c.lattice.periods < 2 || std::abs(off.y) < 0.5);
}

LocalMap LocalMapper::map(std::uint32_t seed, std::vector<StretchShare>* stretch) const {
  const Coordinates& c = coordinates_;
  const Disc disc(sheet_, seed, kDetour * options_.radius * options_.sample);
  const std::size_t count = disc.order.size();

  // Combed, and added up along the tree, in lattice steps.
  LocalMap whole;
  whole.seed = seed;
  whole.turns.assign(count, 0);
  std::vector<Vec2d> t(count);
  if (c.lattice.periods > 0) t[0] = c.phases[seed];
  if (c.lattice.periods == 1) t[0].y = 0;
  for (std::size_t k = 1; k < count; ++k) {
    const Disc::Reached& r = disc.order[k];
    const Coordinates::Step step = c.along(r.link);
    whole.turns[k] = static_cast<std::uint8_t>((whole.turns[r.parent] + step.turns) % c.symmetry);
    t[k] = t[r.parent] + c.turned(whole.turns[r.parent]) * step.by;
  }
  const Mat2d basis = c.lattice.basis();
  for (std::size_t k = 0; k < count; ++k) {
    whole.nodes.push_back(disc.order[k].node);
    whole.at.push_back(basis * t[k]);
  }

  struct Inside {
    std::uint32_t a, b;
    Vec2d by;
    double weight;
  };
  std::vector<Inside> edges;
  for (std::uint32_t a = 0; a < count; ++a) {
    for (const Sheet::Link& link : sheet_.links(whole.nodes[a])) {
      if (!link.forward) continue;
      const auto found = disc.number.find(link.node);
      if (found == disc.number.end() || !joined(whole, a, found->second, link)) continue;
      edges.push_back({a, found->second, c.turned(whole.turns[a]) * c.along(link).by,
                       sheet_.edges[link.edge].weight});
    }
  }

  if (c.lattice.periods < 2) {
    const auto n = static_cast<Eigen::Index>(count);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, 2);
    for (const Inside& e : edges) {
      entries.emplace_back(e.a, e.a, e.weight);
      entries.emplace_back(e.b, e.b, e.weight);
      entries.emplace_back(std::max(e.a, e.b), std::min(e.a, e.b), -e.weight);
      const Eigen::RowVector2d by(e.weight * e.by.x, e.weight * e.by.y);
      right.row(e.a) -= by;
      right.row(e.b) += by;
    }
    // The seed stays where it is.
    constexpr double kHeld = 1e6;
    entries.emplace_back(0, 0, kHeld);
    right.row(0) += kHeld * Eigen::RowVector2d(t[0].x, t[0].y);
    for (Eigen::Index k = 1; k < n; ++k) entries.emplace_back(k, k, 1e-9);
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    const Eigen::MatrixXd solved = solver.solve(right);
    for (std::size_t k = 0; k < count; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      if (c.lattice.periods == 0) t[k].x = solved(row, 0);
      t[k].y = solved(row, 1);
      whole.at[k] = basis * t[k];
    }
  }

  // The triangles that are there in one piece, each once, with the largest distance of a corner.
  const Vec2d middle = whole.at[0];
  const auto far = [&](std::uint32_t k) { return length(whole.at[k] - middle); };
  struct Piece {
    double far;
    StretchShare share;
  };
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> wholeTriangles(count, 0);
  std::vector<double> farthestAround(count, 0);
  for (std::uint32_t a = 0; a < count; ++a) {
    for (const std::uint32_t triangle : sheet_.trianglesAt(whole.nodes[a])) {
      std::array<std::uint32_t, 3> k{};
      bool there = !c.singular[triangle];
      for (int corner = 0; corner < 3 && there; ++corner) {
        const auto found = disc.number.find(sheet_.triangles[triangle][corner]);
        there = found != disc.number.end();
        if (there) k[corner] = found->second;
      }
      for (int corner = 0; corner < 3 && there; ++corner) {
        const std::uint32_t e = sheet_.sides[triangle][corner];
        const bool forward = sheet_.edges[e].a == sheet_.triangles[triangle][corner];
        const std::uint32_t next = sheet_.triangles[triangle][(corner + 1) % 3];
        there = joined(whole, k[corner], k[(corner + 1) % 3], {next, e, forward});
      }
      if (!there) continue;
      const Vec2d u = whole.at[k[1]] - whole.at[k[0]], v = whole.at[k[2]] - whole.at[k[0]];
      if (!(u.x * v.y - u.y * v.x > 0)) continue;  // turned over
      ++wholeTriangles[a];
      const double farthest = std::max({far(k[0]), far(k[1]), far(k[2])});
      farthestAround[a] = std::max(farthestAround[a], farthest);
      if (a != std::min({k[0], k[1], k[2]})) continue;
      const std::array<Vec3d, 3> p{sheet_.positions[whole.nodes[k[0]]],
                                   sheet_.positions[whole.nodes[k[1]]],
                                   sheet_.positions[whole.nodes[k[2]]]};
      const double size = sheet_.sizeAt(triangle, {1.0 / 3, 1.0 / 3, 1.0 / 3});
      const auto [least, most] =
          stretchOf(p, {whole.at[k[0]], whole.at[k[1]], whole.at[k[2]]}, options_.sample * size);
      pieces.push_back({farthest, {least, most, length(cross(p[1] - p[0], p[2] - p[0])) / 2}});
    }
  }

  // The largest radius within which little is stretched too much.
  std::sort(pieces.begin(), pieces.end(),
            [](const Piece& a, const Piece& b) { return a.far < b.far; });
  double area = 0, tooSmall = 0, tooLarge = 0;
  whole.radius = std::min(options_.leastRadius, options_.radius);
  for (const Piece& piece : pieces) {
    if (piece.far > options_.radius) break;
    area += piece.share.area;
    if (piece.share.least < options_.shrink) tooSmall += piece.share.area;
    if (piece.share.most > options_.stretch) tooLarge += piece.share.area;
    if (std::max(tooSmall, tooLarge) <= kOutliers * area)
      whole.radius = std::max(whole.radius, piece.far);
  }
  if (stretch) {
    for (const Piece& piece : pieces)
      if (piece.far <= whole.radius) stretch->push_back(piece.share);
  }

  std::vector<std::uint32_t> kept;
  for (std::uint32_t k = 0; k < count; ++k)
    if (k == 0 || far(k) <= whole.radius) kept.push_back(k);
  std::sort(kept.begin(), kept.end(),
            [&](std::uint32_t a, std::uint32_t b) { return whole.nodes[a] < whole.nodes[b]; });
  LocalMap result;
  result.seed = seed;
  result.radius = whole.radius;
  for (const std::uint32_t k : kept) {
    result.nodes.push_back(whole.nodes[k]);
    result.at.push_back(whole.at[k]);
    result.turns.push_back(whole.turns[k]);
    const bool all = wholeTriangles[k] == sheet_.trianglesAt(whole.nodes[k]).size();
    result.inner.push_back(all && farthestAround[k] <= whole.radius);
  }
  return result;
}

}  // namespace exemplar::surface
