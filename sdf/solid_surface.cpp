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
#include "core/loop_progress.h"
#include "sdf/triangle_overlap.h"

namespace exemplar {
namespace {

// The longest edge of a piece at the samples, in voxels, and how much longer it may be for each
// voxel that it is away from them.
constexpr double kPiece = 0.4;
constexpr double kPiecePerVoxel = 0.25;
// How far from a triangle its two sides are looked at, in voxels.
constexpr double kSide = 1e-3;
constexpr std::size_t kGrain = 256;

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
std::vector<T> gather(std::size_t count, const Progress& progress, const Work& work) {
  LoopProgress done(progress, "finding the surface", count);
  const std::size_t pieces = (count + kGrain - 1) / kGrain;
  std::vector<std::vector<T>> parts(pieces);
  parallelFor(0, pieces, 1, [&](std::size_t p0, std::size_t p1) {
    for (std::size_t p = p0; p < p1; ++p)
      for (std::size_t t = p * kGrain; t < std::min(count, (p + 1) * kGrain); ++t) {
        work(static_cast<std::uint32_t>(t), parts[p]);
        done.advance();
      }
  });
  std::vector<T> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Overlaps findOverlaps(const TriangleSoup& soup, const TriangleTree& tree,
                      const Progress& progress) {
  const auto sharedCorners = [&](std::uint32_t a, std::uint32_t b) {
    int shared = 0;
    for (const std::uint32_t p : soup.triangles[a])
      for (const std::uint32_t q : soup.triangles[b]) shared += p == q;
    return shared;
  };
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  const auto pairs =
      gather<Pair>(soup.triangles.size(), progress, [&](std::uint32_t t, std::vector<Pair>& out) {
        const Corners& corners = tree.triangle(t);
        const Extent box = extentOf(corners);
        tree.visitBox(box.low, box.high, [&](std::uint32_t u) {
          if (u <= t) return;
          const int shared = sharedCorners(t, u);
          const Corners& other = tree.triangle(u);
          if (shared == 0 ? trianglesMeet(corners, other)
                          : shared == 1 && trianglesOverlap(corners, other)) {
            out.push_back({t, u});
          }
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
  Sorter(const SolidTest& solid, const TriangleTree& tree, const Vec3i& size, double reach,
         bool closed, const Progress& progress)
      : progress_(progress),
        solid_(solid),
        tree_(tree),
        last_(cast<double>(size - Vec3i{1, 1, 1})),
        reach_(reach),
        closed_(closed) {}

  // How far the box of a triangle is from the samples, in voxels.
  double away(const Corners& t) const {
    const Extent e = extentOf(t);
    return length(max(max(e.low - last_, -e.high), Vec3d{}));
  }
  bool outOfReach(const Corners& t) const { return away(t) > reach_; }

  // Whether the solid is on one side only of a triangle, at its middle.
  bool bounds(const Corners& t) const {
    Looks looks;
    looks.add(middleOf(t), stepFrom(t));
    return looks.ask(solid_)[0];
  }

  // Appends the pieces of a whole triangle that bound the solid. `others` are the triangles that
  // overlap it.
  void sort(const Corners& t, std::span<const std::uint32_t> others,
            std::vector<Corners>& out) const {
    if (!closed_ && others.empty()) {
      // The most common case in one go: neither crossed nor beside an opening.
      Looks looks;
      const Vec3d step = stepFrom(t);
      looks.add(middleOf(t), step);
      for (const Vec3d& place : nearCorners(t)) looks.add(place, step);
      const auto at = looks.ask(solid_);
      if (at[1] == at[0] && at[2] == at[0] && at[3] == at[0]) {
        if (at[0]) out.push_back(t);
        return;
      }
    }
    sortPart(t, bounds(t), others, out);
  }

 private:
  // The same for a part of a triangle; `middle` is the answer at its middle.
  void sortPart(const Corners& t, bool middle, std::span<const std::uint32_t> others,
                std::vector<Corners>& out) const {
    progress_.check();  // a triangle that crosses many others takes long
    const double distance = away(t);
    if (distance > reach_) return;
    std::vector<std::uint32_t> crossing;
    bool uniform = longestEdge(t) <= kPiece + kPiecePerVoxel * distance;
    if (!uniform) {
      for (const std::uint32_t u : others)
        if (trianglesMeet(t, tree_.triangle(u))) crossing.push_back(u);
      uniform = crossing.empty() && (closed_ || sameAtCorners(t, middle));
    }
    if (uniform) {
      if (middle) out.push_back(t);
      return;
    }
    const Vec3d ab = (t[0] + t[1]) * 0.5, bc = (t[1] + t[2]) * 0.5, ca = (t[2] + t[0]) * 0.5;
    const std::array<Corners, 4> parts{
        {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}}};
    // All four are asked at once, which costs little more than one.
    Looks looks;
    for (const Corners& part : parts) looks.add(middleOf(part), stepFrom(part));
    const std::array<bool, 4> middles = looks.ask(solid_);
    for (int part = 0; part < 4; ++part) sortPart(parts[part], middles[part], crossing, out);
  }

  // Looks at both sides of up to four places.
  class Looks {
   public:
    void add(const Vec3d& place, const Vec3d& step) {
      points_[count_++] = place + step;
      points_[count_++] = place - step;
    }
    // Whether the solid is on one side only.
    std::array<bool, 4> ask(const SolidTest& solid) const {
      std::array<std::uint8_t, 8> in{};
      solid.inside({points_.data(), count_}, {in.data(), count_});
      return {in[0] != in[1], in[2] != in[3], in[4] != in[5], in[6] != in[7]};
    }

   private:
    std::array<Vec3d, 8> points_;
    std::size_t count_ = 0;
  };

  static Vec3d middleOf(const Corners& t) { return (t[0] + t[1] + t[2]) / 3.0; }

  static std::array<Vec3d, 3> nearCorners(const Corners& t) {
    const Vec3d m = middleOf(t) * 0.1;
    return {t[0] * 0.9 + m, t[1] * 0.9 + m, t[2] * 0.9 + m};
  }

  // From a triangle to where one of its sides is looked at: nearer for small ones, so that the
  // place stays beside the triangle.
  static Vec3d stepFrom(const Corners& t) {
    const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
    const double doubleArea = length(normal);
    if (!(doubleArea > 0)) return {};
    return normal * (std::clamp(0.05 * std::sqrt(doubleArea), 1e-6, kSide) / doubleArea);
  }

  // Beside an opening the winding number changes along a triangle.
  bool sameAtCorners(const Corners& t, bool middle) const {
    Looks looks;
    for (const Vec3d& place : nearCorners(t)) looks.add(place, stepFrom(t));
    const auto at = looks.ask(solid_);
    return at[0] == middle && at[1] == middle && at[2] == middle;
  }

 private:
  Progress progress_;
  const SolidTest& solid_;
  const TriangleTree& tree_;
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
      for (const std::uint32_t u : soup.neighbors[t])
        if (u != kNone && part[u] == kNone && overlaps.of(u).empty()) {
          part[u] = seed;
          open.push_back(u);
        }
    }
  }
  return part;
}

}  // namespace

std::vector<Corners> boundingTriangles(const TriangleSoup& soup, const TriangleTree& tree,
                                       const SolidTest& solid, const Vec3i& size, double reach,
                                       const Progress& progress) {
  const Progress sorting = progress.part(0.5, 1);
  const Sorter sorter(solid, tree, size, reach, soup.closed, sorting);
  const Overlaps overlaps = findOverlaps(soup, tree, progress.part(0, 0.5));
  const std::size_t count = soup.triangles.size();
  if (!soup.closed) {
    return gather<Corners>(count, sorting, [&](std::uint32_t t, std::vector<Corners>& out) {
      const Corners& corners = tree.triangle(t);
      if (sorter.outOfReach(corners)) return;
      sorter.sort(corners, overlaps.of(t), out);
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
    for (std::size_t t = b; t < e; ++t) {
      sorting.check();
      if (largest[t] != TriangleSoup::kNone) bounds[t] = sorter.bounds(tree.triangle(largest[t]));
    }
  });
  return gather<Corners>(count, sorting, [&](std::uint32_t t, std::vector<Corners>& out) {
    const Corners& corners = tree.triangle(t);
    if (sorter.outOfReach(corners)) return;
    if (part[t] == TriangleSoup::kNone) {
      sorter.sort(corners, overlaps.of(t), out);
    } else if (bounds[part[t]]) {
      out.push_back(corners);
    }
  });
}

}  // namespace exemplar
