// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/solid_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "core/parallel.h"
#include "sdf/triangle_overlap.h"

namespace exemplar {
namespace {

// The longest edge of a piece at the samples, in voxels, and how much longer it may be for each
// voxel that it is away from them.
constexpr double kPiece = 0.5;
constexpr double kPiecePerVoxel = 0.25;
// How far from a triangle its two sides are looked at, in voxels.
constexpr double kSide = 1e-3;
constexpr std::size_t kGrain = 256;

Corners cornersOf(const TriangleSoup& soup, std::uint32_t t) {
  const auto& [a, b, c] = soup.triangles[t];
  return {soup.points[a], soup.points[b], soup.points[c]};
}

double longestEdge(const Corners& t) {
  return std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
}

struct Extent {
  Vec3d low, high;
};

Extent extentOf(const Corners& t) {
  return {min(min(t[0], t[1]), t[2]), max(max(t[0], t[1]), t[2])};
}

// The triangles that overlap each triangle, as one list and where each triangle's part begins.
struct Overlaps {
  std::vector<std::uint32_t> first;   // n + 1
  std::vector<std::uint32_t> others;  // ascending for each triangle

  std::span<const std::uint32_t> of(std::uint32_t t) const {
    return {others.data() + first[t], others.data() + first[t + 1]};
  }
};

// Work on each triangle that makes any number of results, joined in the triangles' order.
template <class T, class Work>
std::vector<T> gather(std::size_t count, const Work& work) {
  const std::size_t pieces = (count + kGrain - 1) / kGrain;
  std::vector<std::vector<T>> parts(pieces);
  parallelFor(0, pieces, 1, [&](std::size_t p0, std::size_t p1) {
    for (std::size_t p = p0; p < p1; ++p)
      for (std::size_t t = p * kGrain; t < std::min(count, (p + 1) * kGrain); ++t)
        work(static_cast<std::uint32_t>(t), parts[p]);
  });
  std::vector<T> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Overlaps findOverlaps(const TriangleSoup& soup, const TriangleTree& tree) {
  const auto sharesEdge = [&](std::uint32_t a, std::uint32_t b) {
    int shared = 0;
    for (const std::uint32_t p : soup.triangles[a])
      for (const std::uint32_t q : soup.triangles[b]) shared += p == q;
    return shared >= 2;
  };
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  const auto pairs =
      gather<Pair>(soup.triangles.size(), [&](std::uint32_t t, std::vector<Pair>& out) {
        const Corners corners = tree.triangle(t);
        const Extent box = extentOf(corners);
        tree.visitBox(box.low, box.high, [&](std::uint32_t u) {
          if (u > t && !sharesEdge(t, u) && trianglesOverlap(corners, tree.triangle(u)))
            out.push_back({t, u});
        });
      });
  Overlaps result;
  result.first.assign(soup.triangles.size() + 1, 0);
  for (const auto& [t, u] : pairs) {
    ++result.first[t + 1];
    ++result.first[u + 1];
  }
  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
  result.others.resize(pairs.size() * 2);
  auto next = result.first;
  for (const auto& [t, u] : pairs) {
    result.others[next[t]++] = u;
    result.others[next[u]++] = t;
  }
  return result;
}

// Decides which triangles, or pieces of them, bound the solid.
class Sorter {
 public:
  Sorter(const SolidTest& solid, const Vec3i& size, double reach, bool closed)
      : solid_(solid), last_(cast<double>(size - Vec3i{1, 1, 1})), reach_(reach), closed_(closed) {}

  // How far the box of a triangle is from the samples, in voxels.
  double away(const Corners& t) const {
    const Extent e = extentOf(t);
    return length(max(max(e.low - last_, -e.high), Vec3d{}));
  }
  bool outOfReach(const Corners& t) const { return away(t) > reach_; }

  // Whether the solid is on one side only of a triangle, at the point a share `s` of the way from
  // its middle to corner `c`.
  bool bounds(const Corners& t, int c = 0, double s = 0) const {
    const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
    const double doubleArea = length(normal);
    const Vec3d middle = (t[0] + t[1] + t[2]) / 3.0;
    const Vec3d p = middle + (t[c] - middle) * s;
    // Small triangles are looked at from nearer, so that the points stay beside them.
    const Vec3d step =
        normal * (std::clamp(0.05 * std::sqrt(doubleArea), 1e-6, kSide) / doubleArea);
    return solid_.inside(p + step) != solid_.inside(p - step);
  }

  // Appends the pieces of `t` that bound the solid. `others` are the triangles that overlap it.
  void sort(const Corners& t, std::span<const std::uint32_t> others,
            std::vector<Corners>& out) const {
    const double distance = away(t);
    if (distance > reach_) return;
    std::vector<std::uint32_t> crossing;
    const bool small = longestEdge(t) <= kPiece + kPiecePerVoxel * distance;
    if (!small) {
      for (const std::uint32_t u : others)
        if (trianglesOverlap(t, solid_.tree().triangle(u))) crossing.push_back(u);
    }
    const bool keep = bounds(t);
    const bool uniform = small || (crossing.empty() && (closed_ || agrees(t, keep)));
    if (uniform) {
      if (keep) out.push_back(t);
      return;
    }
    const Vec3d ab = (t[0] + t[1]) * 0.5, bc = (t[1] + t[2]) * 0.5, ca = (t[2] + t[0]) * 0.5;
    sort({t[0], ab, ca}, crossing, out);
    sort({ab, t[1], bc}, crossing, out);
    sort({ca, bc, t[2]}, crossing, out);
    sort({ab, bc, ca}, crossing, out);
  }

 private:
  // Beside an opening the winding number changes along a triangle; look near its corners too.
  bool agrees(const Corners& t, bool keep) const {
    for (int c = 0; c < 3; ++c)
      if (bounds(t, c, 0.9) != keep) return false;
    return true;
  }

  const SolidTest& solid_;
  Vec3d last_;
  double reach_;
  bool closed_;
};

// A name for each triangle's part: triangles connected across edges without any crossing between
// have the solid on the same sides. `kNone` for those that overlap others.
std::vector<std::uint32_t> partsOf(const TriangleSoup& soup, const Overlaps& overlaps) {
  constexpr std::uint32_t kNone = TriangleSoup::kNone;
  std::vector<std::uint32_t> part(soup.triangles.size(), kNone), open;
  for (std::uint32_t seed = 0; seed < part.size(); ++seed) {
    if (part[seed] != kNone || !overlaps.of(seed).empty()) continue;
    part[seed] = seed;
    open.assign(1, seed);
    while (!open.empty()) {
      const std::uint32_t t = open.back();
      open.pop_back();
      for (const std::uint32_t u : soup.neighbours[t])
        if (u != kNone && part[u] == kNone && overlaps.of(u).empty()) {
          part[u] = seed;
          open.push_back(u);
        }
    }
  }
  return part;
}

}  // namespace

SolidTest::SolidTest(const TriangleSoup& soup) {
  std::vector<Corners> corners(soup.triangles.size());
  for (std::uint32_t t = 0; t < corners.size(); ++t) corners[t] = cornersOf(soup, t);
  tree_ = std::make_unique<TriangleTree>(std::move(corners));
}

double SolidTest::depth(const Vec3d& p) const { return std::abs(tree_->windingNumber(p)) - 0.5; }

std::vector<Corners> boundingTriangles(const TriangleSoup& soup, const SolidTest& solid,
                                       const Vec3i& size, double reach) {
  const TriangleTree& tree = solid.tree();
  const Sorter sorter(solid, size, reach, soup.closed);
  const Overlaps overlaps = findOverlaps(soup, tree);
  const std::size_t count = soup.triangles.size();
  if (!soup.closed) {
    return gather<Corners>(count, [&](std::uint32_t t, std::vector<Corners>& out) {
      sorter.sort(tree.triangle(t), overlaps.of(t), out);
    });
  }
  // One look at each part, at its largest triangle, where the look is surest.
  const std::vector<std::uint32_t> part = partsOf(soup, overlaps);
  std::vector<std::uint32_t> largest(count, TriangleSoup::kNone);
  const auto area = [&](std::uint32_t t) {
    const Corners& c = tree.triangle(t);
    return length(cross(c[1] - c[0], c[2] - c[0]));
  };
  for (std::uint32_t t = 0; t < count; ++t) {
    if (part[t] == TriangleSoup::kNone) continue;
    std::uint32_t& best = largest[part[t]];
    if (best == TriangleSoup::kNone || area(t) > area(best)) best = t;
  }
  std::vector<char> bounds(count);
  parallelFor(0, count, kGrain, [&](std::size_t b, std::size_t e) {
    for (std::size_t t = b; t < e; ++t)
      if (largest[t] != TriangleSoup::kNone) bounds[t] = sorter.bounds(tree.triangle(largest[t]));
  });
  return gather<Corners>(count, [&](std::uint32_t t, std::vector<Corners>& out) {
    const Corners& corners = tree.triangle(t);
    if (part[t] == TriangleSoup::kNone) {
      sorter.sort(corners, overlaps.of(t), out);
    } else if (bounds[part[t]] && !sorter.outOfReach(corners)) {
      out.push_back(corners);
    }
  });
}

}  // namespace exemplar
