// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/wholeness.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "measure/solid_runs.h"

namespace exemplar {
namespace {

/// Empty cells between two components of which one lies upon the other.
constexpr int kGap = 2;
/// How far above the ground a component may begin and stand on it, cells.
constexpr int kGroundSlack = 2;

bool isAir(const ExampleNature& nature, int axis, int end) {
  return nature.sides[static_cast<std::size_t>(2 * axis + end)] == BoxSide::Air;
}

/// Pieces, the largest of them, and what floats. Returns the number of components, specks included.
std::int64_t findPieces(const Occupancy& o, const ExampleNature& nature, Integrity& found,
                        const Progress& progress) {
  struct Part {
    std::int64_t cells = 0;
    int lowest = 0;
    bool held = false;
  };
  const Vec3i n = o.size();
  SolidRuns runs(o, progress);
  std::vector<Part> parts(runs.count());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> upon;  // (below, above)
  for (int z = 0; z < n.z; ++z)
    for (int y = 0; y < n.y; ++y) {
      const bool edge = (y == 0 && !isAir(nature, 1, 0)) ||
                        (y == n.y - 1 && !isAir(nature, 1, 1)) ||
                        (z == 0 && !isAir(nature, 2, 0)) || (z == n.z - 1 && !isAir(nature, 2, 1));
      for (const SolidRuns::Run& run : runs.row(y, z)) {
        Part& part = parts[runs.component(run)];
        if (part.cells == 0) part.lowest = z;
        part.cells += run.x1 - run.x0;
        part.held |= edge || (run.x0 == 0 && !isAir(nature, 0, 0)) ||
                     (run.x1 == n.x && !isAir(nature, 0, 1));
      }
      for (int gap = 1; gap <= kGap && z - gap - 1 >= 0; ++gap)
        SolidRuns::forEachOverlap(runs.row(y, z - gap - 1), runs.row(y, z),
                                  [&](const SolidRuns::Run& below, const SolidRuns::Run& above) {
                                    const auto a = runs.component(below), b = runs.component(above);
                                    if (a != b && (upon.empty() || upon.back() != std::pair{a, b}))
                                      upon.emplace_back(a, b);
                                  });
    }
  const Part* largest = nullptr;
  for (const Part& part : parts)
    if (part.cells > 0 && (!largest || part.cells > largest->cells)) largest = &part;
  if (!largest) return 0;
  for (Part& part : parts)
    part.held |= part.cells > 0 && part.lowest <= largest->lowest + kGroundSlack;
  // What lies upon something held is held.
  std::ranges::sort(upon);
  upon.erase(std::unique(upon.begin(), upon.end()), upon.end());
  std::vector<std::uint32_t> next;
  for (std::uint32_t p = 0; p < parts.size(); ++p)
    if (parts[p].held) next.push_back(p);
  while (!next.empty()) {
    const std::uint32_t below = next.back();
    next.pop_back();
    const auto from = std::ranges::lower_bound(upon, std::pair{below, std::uint32_t{0}});
    for (auto above = from; above != upon.end() && above->first == below; ++above) {
      if (parts[above->second].held) continue;
      parts[above->second].held = true;
      next.push_back(above->second);
    }
  }
  std::int64_t floating = 0, components = 0;
  for (const Part& part : parts) {
    components += part.cells > 0;
    found.pieces += part.cells >= kSpeckCells;
    if (part.cells > 0 && !part.held) floating += part.cells;
  }
  const auto solid = static_cast<double>(o.solidCells());
  found.largestShare = static_cast<double>(largest->cells) / solid;
  found.floatingShare = static_cast<double>(floating) / solid;
  return components;
}

/// Ways through and pockets, by the Euler characteristic of the cells' centers, joined where they
/// share faces: components - tunnels + bubbles = cells - pairs + squares - cubes.
void findTunnels(const Occupancy& o, std::int64_t components, Integrity& found,
                 const Progress& progress) {
  const Vec3i n = o.size();
  const std::int64_t characteristic = parallelSum<std::int64_t>(
      0, static_cast<std::size_t>(n.z), 8, [&](std::size_t z0, std::size_t z1) {
        std::int64_t sum = 0;
        for (int z = static_cast<int>(z0); z < static_cast<int>(z1); ++z)
          for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; x += 64) {
              const std::uint64_t a = o.bits(x, y, z), ax = a & o.bits(x + 1, y, z);
              const std::uint64_t b = o.bits(x, y + 1, z), c = o.bits(x, y, z + 1);
              const std::uint64_t ay = a & b, az = a & c;
              const std::uint64_t bx = b & o.bits(x + 1, y + 1, z),
                                  cx = c & o.bits(x + 1, y, z + 1);
              const std::uint64_t d = o.bits(x, y + 1, z + 1), dx = d & o.bits(x + 1, y + 1, z + 1);
              sum += std::popcount(a) - std::popcount(ax) - std::popcount(ay) - std::popcount(az);
              sum += std::popcount(ax & bx) + std::popcount(ax & cx) + std::popcount(ay & c & d);
              sum -= std::popcount(ax & bx & cx & dx);
            }
        return sum;
      });

  // Air, with a layer of it around the box, connected through corners: all components but the outer
  // one are bubbles.
  DisjointSets sets(1);  // 0 is what is outside
  using Row = std::vector<SolidRuns::Run>;
  std::vector<Row> below(static_cast<std::size_t>(n.y)), here(static_cast<std::size_t>(n.y));
  const auto touch = [&](const Row& a, const Row& b) {
    // Runs that share a corner: of x ranges that touch.
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
      if (a[i].x0 <= b[j].x1 && b[j].x0 <= a[i].x1) sets.join(a[i].id, b[j].id);
      if (a[i].x1 < b[j].x1) {
        ++i;
      } else {
        ++j;
      }
    }
  };
  for (int z = 0; z < n.z; ++z) {
    progress.report("finding bubbles", static_cast<double>(z) / n.z);
    for (int y = 0; y < n.y; ++y) {
      Row& row = here[static_cast<std::size_t>(y)];
      row.clear();
      const bool border = y == 0 || z == 0 || y == n.y - 1 || z == n.z - 1;
      for (int x = 0; x < n.x;) {
        const std::uint64_t cells = o.bits(x, y, z);
        if (cells & 1) {
          x += std::countr_one(cells);
          continue;
        }
        const int first = x;
        for (int air = 64; air == 64 && x < n.x; x += air) air = std::countr_zero(o.bits(x, y, z));
        x = std::min(x, n.x);
        row.push_back({first, x, sets.add()});
        if (border || first == 0 || x == n.x) sets.join(0, row.back().id);
      }
      if (y > 0) touch(here[static_cast<std::size_t>(y - 1)], row);
      for (int dy = -1; z > 0 && dy <= 1; ++dy)
        if (y + dy >= 0 && y + dy < n.y) touch(below[static_cast<std::size_t>(y + dy)], row);
    }
    std::swap(below, here);
  }
  std::uint32_t airs = 0;
  sets.numbered(&airs);
  found.bubbles = static_cast<std::int64_t>(airs) - 1;
  found.tunnels = components + found.bubbles - characteristic;
}

/// A plane of cells' faces, of which some are exposed.
class Plane {
 public:
  Plane(int width, int height)
      : width_(width), height_(height), cells_(static_cast<std::size_t>(width) * height) {}

  void clear() { std::ranges::fill(cells_, 0), exposed_ = 0; }
  void expose(int u, int v) {
    cells_[static_cast<std::size_t>(v) * width_ + u] = 1;
    ++exposed_;
  }
  std::int64_t exposed() const { return exposed_; }

  /// How many exposed faces are in squares of `side` exposed faces a side.
  std::int64_t inSquares(int side) {
    if (exposed_ < std::int64_t{side} * side) return 0;
    // The side of the largest square that ends at each face, by the three before it, up to `side`;
    // then the faces that such squares hold.
    largest_.assign(cells_.size(), 0);
    held_.assign(cells_.size(), 0);
    std::int64_t count = 0;
    const auto at = [&](int u, int v) { return static_cast<std::size_t>(v) * width_ + u; };
    for (int v = 0; v < height_; ++v)
      for (int u = 0; u < width_; ++u) {
        if (!cells_[at(u, v)]) continue;
        const int before = u == 0 || v == 0
                               ? 0
                               : std::min({largest_[at(u - 1, v)], largest_[at(u, v - 1)],
                                           largest_[at(u - 1, v - 1)]});
        largest_[at(u, v)] = static_cast<std::uint8_t>(std::min(before + 1, side));
      }
    // A face is held by a square that ends up to side - 1 further along both axes.
    for (int v = height_ - 1; v >= 0; --v)
      for (int u = width_ - 1; u >= 0; --u) {
        if (largest_[at(u, v)] < side) continue;
        for (int b = v - side + 1; b <= v; ++b)
          for (int a = u - side + 1; a <= u; ++a) {
            std::uint8_t& held = held_[at(a, b)];
            count += !held;
            held = 1;
          }
      }
    return count;
  }

 private:
  int width_, height_;
  std::vector<std::uint8_t> cells_, largest_, held_;
  std::int64_t exposed_ = 0;
};

/// Exposed faces, flat ones, and those at sides where the example has air.
void findFlats(const Occupancy& o, const ExampleNature& nature, Integrity& found,
               const Progress& progress) {
  const Vec3i n = o.size();
  struct Sums {
    std::array<std::int64_t, 6> flat{};
    std::int64_t faces = 0, open = 0;
    Sums& operator+=(const Sums& s) {
      for (std::size_t d = 0; d < 6; ++d) flat[d] += s.flat[d];
      faces += s.faces;
      open += s.open;
      return *this;
    }
  };
  Sums sums;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    sums += parallelSum<Sums>(
        0, static_cast<std::size_t>(n[axis]), 4, [&](std::size_t first, std::size_t last) {
          Sums part;
          Plane plane(n[u], n[v]);
          for (int c = static_cast<int>(first); c < static_cast<int>(last); ++c) {
            progress.check();
            for (const int end : {0, 1}) {
              const int beyond = c + (end ? 1 : -1);
              const bool outside = beyond < 0 || beyond >= n[axis];
              if (outside && !isAir(nature, axis, end)) continue;
              plane.clear();
              Vec3i p, q;
              p[axis] = c;
              q[axis] = beyond;
              for (p[v] = 0; p[v] < n[v]; ++p[v]) {
                q[v] = p[v];
                if (axis == 0) {
                  for (p.y = 0; p.y < n.y; ++p.y)
                    if (o.solid(p.x, p.y, p.z) && (outside || !o.solid(beyond, p.y, p.z)))
                      plane.expose(p.y, p.z);
                  continue;
                }
                for (int x = 0; x < n.x; x += 64) {
                  std::uint64_t bits = o.bits(x, p.y, p.z);
                  if (!outside) bits &= ~o.bits(x, q.y, q.z);
                  for (; bits != 0; bits &= bits - 1)
                    plane.expose(x + std::countr_zero(bits), p[v]);
                }
              }
              part.faces += plane.exposed();
              if (outside) part.open += plane.exposed();
              part.flat[static_cast<std::size_t>(2 * axis + end)] += plane.inSquares(kFlatSide);
            }
          }
          return part;
        });
  }
  found.faces = sums.faces;
  if (sums.faces == 0) return;
  const auto all = static_cast<double>(sums.faces);
  for (std::size_t d = 0; d < 6; ++d) found.flat[d] = static_cast<double>(sums.flat[d]) / all;
  found.openShare = static_cast<double>(sums.open) / all;
}

void findLayers(const Occupancy& o, Integrity& found) {
  const Vec3i n = o.size();
  for (int z = 0; z < n.z; ++z) {
    std::int64_t solid = 0;
    for (int y = 0; y < n.y; ++y)
      for (int x = 0; x < n.x; x += 64) solid += std::popcount(o.bits(x, y, z));
    found.layers.push_back(static_cast<double>(solid) / (static_cast<double>(n.x) * n.y));
  }
}

double perTenThousand(std::int64_t count, std::int64_t faces) {
  return faces == 0 ? 0 : 1e4 * static_cast<double>(count) / static_cast<double>(faces);
}

}  // namespace

Integrity integrityOf(const Occupancy& volume, const ExampleNature& nature,
                      const Progress& progress) {
  Integrity found;
  const std::int64_t components = findPieces(volume, nature, found, progress.part(0, 0.3));
  findTunnels(volume, components, found, progress.part(0.3, 0.7));
  findFlats(volume, nature, found, progress.part(0.7, 1));
  findLayers(volume, found);
  return found;
}

Wholeness compareWholeness(const Integrity& example, const Integrity& result) {
  Wholeness w;
  w.pieces = result.pieces;
  w.examplePieces = example.pieces;
  w.largestShare = result.largestShare;
  w.exampleLargestShare = example.largestShare;
  w.floatingShare = result.floatingShare;
  w.exampleFloatingShare = example.floatingShare;
  for (std::size_t d = 0; d < 6; ++d) {
    w.flatShare += result.flat[d];
    w.exampleFlatShare += example.flat[d];
    w.slicedShare += std::max(0.0, result.flat[d] - example.flat[d]);
  }
  w.openShare = result.openShare;
  w.tunnels = perTenThousand(result.tunnels, result.faces);
  w.exampleTunnels = perTenThousand(example.tunnels, example.faces);
  w.bubbles = perTenThousand(result.bubbles, result.faces);
  w.exampleBubbles = perTenThousand(example.bubbles, example.faces);
  double apart = 0, all = 0;
  const std::size_t layers = result.layers.size();
  for (std::size_t z = 0; z < layers; ++z) {
    // The example's share over the same part of the height.
    const auto scale = static_cast<double>(example.layers.size()) / static_cast<double>(layers);
    const double low = static_cast<double>(z) * scale, high = low + scale;
    double share = 0;
    for (auto l = static_cast<std::size_t>(low);
         l < example.layers.size() && static_cast<double>(l) < high; ++l) {
      const double from = std::max(low, static_cast<double>(l));
      const double to = std::min(high, static_cast<double>(l + 1));
      share += example.layers[l] * std::max(0.0, to - from) / scale;
    }
    apart += std::abs(result.layers[z] - share);
    all += share;
  }
  if (all > 0) w.layers = apart / all;
  return w;
}

Wholeness measureWholeness(const Occupancy& example, const Occupancy& result,
                           const Progress& progress) {
  const ExampleNature nature = natureOf(example);
  const Integrity before = integrityOf(example, nature, progress.part(0, 0.4));
  return compareWholeness(before, integrityOf(result, nature, progress.part(0.4, 1)));
}

}  // namespace exemplar
