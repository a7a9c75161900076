// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/arrangement.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/loop_progress.h"
#include "core/parallel.h"
#include "core/text.h"

namespace exemplar::continuous {
namespace {

/// A vertex while it is being found.
struct Found {
  ExactPoint point;
  Families on = 0;
};

/// All vertices whose first independent families are i, j, k and that lie on one plane of i.
struct Slice {
  int i, j, k;
  std::size_t plane;
};

class Finder {
 public:
  explicit Finder(const PlaneSets& planes) : planes_(planes) {}

  std::vector<Slice> slices() const {
    std::vector<Slice> all;
    const int m = static_cast<int>(planes_.normals.size());
    for (int i = 0; i < m; ++i) {
      for (int j = i + 1; j < m; ++j) {
        for (int k = j + 1; k < m; ++k) {
          if (determinant(planes_.normals[i], planes_.normals[j], planes_.normals[k]) == 0)
            continue;
          for (std::size_t plane = 0; plane < planes_.offsets[i].size(); ++plane)
            all.push_back({i, j, k, plane});
        }
      }
    }
    return all;
  }

  void find(const Slice& s, std::vector<Found>& found) const {
    const ExactPlane a{planes_.normals[s.i], planes_.offsets[s.i][s.plane]};
    const std::vector<std::int64_t>& third = planes_.offsets[s.k];
    for (const std::int64_t offset : planes_.offsets[s.j]) {
      const ExactPlane b{planes_.normals[s.j], offset};
      double low = 0, high = 0;
      if (!range(a, b, planes_.normals[s.k], low, high)) continue;
      auto c = std::ranges::lower_bound(third, static_cast<std::int64_t>(std::ceil(low)));
      for (; c != third.end() && static_cast<double>(*c) <= high; ++c) {
        Found vertex;
        if (!meet(a, b, {planes_.normals[s.k], *c}, vertex.point)) continue;
        if (inWindow(vertex.point) && firstHere(s, vertex)) found.push_back(vertex);
      }
    }
  }

 private:
  /// The levels of a third family where the line of two planes is in the window, and a little more.
  bool range(const ExactPlane& a, const ExactPlane& b, const Vec3l& third, double& low,
             double& high) const {
    const Vec3d na = cast<double>(a.normal), nb = cast<double>(b.normal), d = cross(na, nb);
    const Vec3d p = (cross(nb, d) * static_cast<double>(a.offset) +
                     cross(d, na) * static_cast<double>(b.offset)) /
                    dot(d, d);
    double from = -1e300, to = 1e300;
    for (int axis = 0; axis < 3; ++axis) {
      const double l = static_cast<double>(planes_.window.low[axis]) - 1e-3 - p[axis];
      const double h = static_cast<double>(planes_.window.high[axis]) + 1e-3 - p[axis];
      if (d[axis] == 0) {
        if (l > 0 || h < 0) return false;
        continue;
      }
      from = std::max(from, std::min(l / d[axis], h / d[axis]));
      to = std::min(to, std::max(l / d[axis], h / d[axis]));
    }
    if (from > to) return false;
    const Vec3d n = cast<double>(third);
    const double start = dot(n, p), along = dot(n, d);
    low = std::min(start + from * along, start + to * along) - 1e-3;
    high = std::max(start + from * along, start + to * along) + 1e-3;
    return true;
  }

  bool inWindow(const ExactPoint& p) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (p.n[axis] < planes_.window.low[axis] * p.d || p.n[axis] > planes_.window.high[axis] * p.d)
        return false;
    }
    return true;
  }

  /// Whether the slice's families are the first independent ones at a point, so that it is found
  /// once; finds all families there.
  bool firstHere(const Slice& s, Found& vertex) const {
    const ExactPoint& p = vertex.point;
    const auto m = static_cast<int>(planes_.normals.size());
    for (int f = 0; f < m; ++f) {
      if (f != s.i && f != s.j && f != s.k) {
        const std::int64_t level = dot(planes_.normals[f], p.n);
        if (level % p.d != 0 || !std::ranges::binary_search(planes_.offsets[f], level / p.d))
          continue;
        if (f < s.j) return false;
        if (f < s.k &&
            determinant(planes_.normals[s.i], planes_.normals[s.j], planes_.normals[f]) != 0)
          return false;
      }
      vertex.on |= Families{1} << f;
    }
    return true;
  }

  const PlaneSets& planes_;
};

}  // namespace

Arrangement::Arrangement(const PlaneSets& planes, const Centrals& centrals,
                         std::size_t mostVertices, const Progress& progress)
    : planes_(planes), centrals_(&centrals) {
  findPoints(mostVertices, progress.part(0, 0.6));
  joinLines(progress.part(0.6, 1));
}

void Arrangement::findPoints(std::size_t mostVertices, const Progress& progress) {
  const Finder finder(planes_);
  const std::vector<Slice> slices = finder.slices();
  std::vector<std::vector<Found>> found(slices.size());
  std::atomic<std::size_t> count = 0;
  LoopProgress loop(progress, "intersecting planes", slices.size());
  parallelFor(0, slices.size(), 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t s = from; s < to; ++s) {
      finder.find(slices[s], found[s]);
      count += found[s].size();
      if (count > mostVertices) {
        throw InputError("the planes of the result meet in more than " +
                         counted(mostVertices, "point") +
                         "; use a smaller `scale`, a larger `spacing`, or fewer directions of "
                         "faces");
      }
      loop.advance();
    }
  });
  std::vector<Found> all;
  all.reserve(count);
  for (std::vector<Found>& slice : found) {
    all.insert(all.end(), slice.begin(), slice.end());
    slice = {};
  }
  tbb::parallel_sort(all.begin(), all.end(),
                     [](const Found& a, const Found& b) { return before(a.point, b.point); });
  std::map<Families, std::uint32_t> kinds;
  points_.reserve(all.size());
  kind_.reserve(all.size());
  inside_.reserve(all.size());
  first_.reserve(all.size() + 1);
  first_.push_back(0);
  for (const Found& vertex : all) {
    const auto [entry, isNew] = kinds.emplace(vertex.on, static_cast<std::uint32_t>(kinds_.size()));
    if (isNew) kinds_.push_back(&centrals_->of(vertex.on));
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t x = vertex.point.n[axis], d = vertex.point.d;
      inside = inside && x > planes_.window.low[axis] * d && x < planes_.window.high[axis] * d;
    }
    points_.push_back(vertex.point);
    kind_.push_back(entry->second);
    inside_.push_back(inside);
    first_.push_back(first_.back() + kinds_[entry->second]->rays.size());
  }
}

Arrangement::Level Arrangement::level(const ExactPoint& p, std::size_t family) const {
  const std::int64_t at = dot(planes_.normals[family], p.n);
  const std::int64_t floor = floorDivide(at, p.d);
  const std::vector<std::int64_t>& offsets = planes_.offsets[family];
  const auto above = std::ranges::upper_bound(offsets, floor);
  const int plane = static_cast<int>(above - offsets.begin()) - 1;
  return {plane, plane >= 0 && offsets[plane] * p.d == at};
}

void Arrangement::joinLines(const Progress& progress) {
  // A line is known by its first two families and their planes, so it has a place in a table of
  // all pairs of planes. Along a line the order of vertices is their order along the canonical one
  // of its two directions: each one is joined to the last that was on its line.
  const std::size_t families = planes_.normals.size();
  std::vector<std::size_t> pairStart(families * families + 1);
  for (std::size_t a = 0; a < families; ++a) {
    for (std::size_t b = 0; b < families; ++b) {
      const std::size_t pair = a * families + b;
      const std::size_t lines = a < b ? planes_.offsets[a].size() * planes_.offsets[b].size() : 0;
      pairStart[pair + 1] = pairStart[pair] + lines;
    }
  }
  std::vector<EdgeEnd> last(pairStart.back());
  ends_.resize(first_.back());
  std::array<std::size_t, kMostFamilies> plane{};
  for (std::uint32_t v = 0; v < points_.size(); ++v) {
    if (v % 4096 == 0)
      progress.report("joining lines",
                      static_cast<double>(v) / static_cast<double>(points_.size()));
    const Central& central = *kinds_[kind_[v]];
    forEachFamily(central.families, [&](int f) {
      plane[f] = static_cast<std::size_t>(level(points_[v], static_cast<std::size_t>(f)).plane);
    });
    for (std::uint32_t r = 0; r < central.rays.size(); ++r) {
      const Central::Ray& ray = central.rays[r];
      if (!isCanonical(ray.direction)) continue;
      const auto a = static_cast<std::size_t>(__builtin_ctz(ray.on));
      const auto b = static_cast<std::size_t>(__builtin_ctz(ray.on & (ray.on - 1)));
      const std::size_t line =
          pairStart[a * families + b] + plane[a] * planes_.offsets[b].size() + plane[b];
      const EdgeEnd before = last[line];
      last[line] = {v, r};
      if (before.vertex == EdgeEnd::kNone) continue;
      ends_[first_[before.vertex] + before.ray] = {v, ray.opposite};
      ends_[first_[v] + ray.opposite] = before;
    }
  }
}

}  // namespace exemplar::continuous
