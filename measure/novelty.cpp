// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/novelty.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <vector>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "measure/same_voxels.h"
#include "core/disjoint_sets.h"

namespace exemplar {
namespace {

std::string text(const Vec3i& size) {
  std::ostringstream out;
  out << size.x << " x " << size.y << " x " << size.z;
  return out.str();
}

/// Shifts of the example, cell 0 of which falls on cell `shift` of the result: low..high of each
/// axis, included.
struct Shifts {
  Vec3i low, high;

  Vec3i count(int stride) const {
    Vec3i c;
    for (int a = 0; a < 3; ++a) c[a] = (high[a] - low[a]) / stride + 1;
    return c;
  }
};

/// The IoU of many placements, in their order.
std::vector<double> ious(const Occupancy& example, const Occupancy& result,
                         const std::vector<Vec3i>& shifts) {
  std::vector<double> iou(shifts.size());
  parallelFor(0, shifts.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s)
      iou[s] = intersectionOverUnion(result, example, shifts[s]);
  });
  return iou;
}

double verbatimRun(const Origins& origins, const DistanceField& example) {
  const Vec3i n = origins.size();
  if (origins.count() > 0xffffffffu)
    throw InputError("the result has " + text(n) +
                     " samples; regions of origins are measured up to 4,294,967,295 samples");
  requireMemory(static_cast<double>(origins.count()) * 8, "measuring regions of origins",
                "measure a smaller result");
  DisjointSets regions(origins.count());
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        const auto at = static_cast<std::uint32_t>(origins.index(i, j, k));
        const Origin& a = origins.data()[at];
        for (int axis = 0; axis < 3; ++axis) {
          Vec3i step{};
          step[axis] = 1;
          const Vec3i b = Vec3i{i, j, k} + step;
          if (origins.contains(b) && continues(a, origins[b], step))
            regions.join(at, static_cast<std::uint32_t>(origins.index(b)));
        }
      }
  std::vector<std::uint32_t> cells(origins.count());
  for (std::size_t c = 0; c < cells.size(); ++c)
    ++cells[regions.find(static_cast<std::uint32_t>(c))];
  double squares = 0;
  for (const std::uint32_t size : cells) squares += static_cast<double>(size) * size;
  return squares / static_cast<double>(origins.count()) /
         static_cast<double>(example.values.count());
}

/// How often the example's surface cells were used as origins.
struct Uses {
  std::int64_t surface = 0, total = 0;  ///< surface cells, uses of them
  double entropy = 0, most = 0;         ///< in nats, and the most it could be
};

Uses countUses(const Origins& origins, const Occupancy& example, int exampleIndex) {
  const Vec3i n = example.size();
  Array3D<std::uint32_t> uses(n);
  Uses u;
  for (const Origin& o : origins.values())
    if (o.example == exampleIndex) ++uses[o.cell()];
  std::vector<std::uint32_t> counts;
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        if (!example.solid(i, j, k)) continue;
        bool open = false;
        for (int axis = 0; axis < 3; ++axis)
          for (const int side : {-1, 1}) {
            Vec3i p{i, j, k};
            p[axis] += side;
            // What lies beyond the box is unknown, and is no surface.
            open |= p[axis] >= 0 && p[axis] < n[axis] && !example.solid(p.x, p.y, p.z);
          }
        if (!open) continue;
        ++u.surface;
        u.total += uses(i, j, k);
        if (uses(i, j, k) > 0) counts.push_back(uses(i, j, k));
      }
  for (const std::uint32_t c : counts) {
    const double p = static_cast<double>(c) / static_cast<double>(u.total);
    u.entropy -= p * std::log(p);
  }
  u.most = std::log(static_cast<double>(std::max<std::int64_t>(1, std::min(u.surface, u.total))));
  return u;
}

}  // namespace

double diversity(std::span<const Occupancy> results) {
  double sum = 0;
  std::int64_t pairs = 0;
  for (std::size_t a = 0; a < results.size(); ++a)
    for (std::size_t b = a + 1; b < results.size(); ++b, ++pairs) {
      if (results[a].size() != results[b].size())
        throw InputError("results of " + text(results[a].size()) + " and " +
                         text(results[b].size()) +
                         " samples have no diversity; give results of one size");
      sum += 1 - intersectionOverUnion(results[a], results[b]);
    }
  return pairs == 0 ? 0 : sum / static_cast<double>(pairs);
}

double copyDistance(const Occupancy& example, const Occupancy& result,
                    const CopyDistanceOptions& options) {
  Shifts shifts;
  for (int a = 0; a < 3; ++a) {
    const int room = result.size()[a] - example.size()[a];
    const int beyond = std::min(options.reach, std::min(result.size()[a], example.size()[a]) / 8);
    shifts.low[a] = std::min(0, room) - beyond;
    shifts.high[a] = std::max(0, room) + beyond;
  }
  int stride = 1;
  while (volume(shifts.count(stride)) > options.placements) ++stride;

  std::vector<Vec3i> tried;
  for (int z = shifts.low.z; z <= shifts.high.z; z += stride)
    for (int y = shifts.low.y; y <= shifts.high.y; y += stride)
      for (int x = shifts.low.x; x <= shifts.high.x; x += stride) tried.push_back({x, y, z});
  const std::vector<double> iou = ious(example, result, tried);
  double best = *std::max_element(iou.begin(), iou.end());
  if (stride > 1) {
    // Ties by lowest index.
    std::vector<std::size_t> order(tried.size());
    for (std::size_t o = 0; o < order.size(); ++o) order[o] = o;
    const std::size_t kept = std::min<std::size_t>(8, order.size());
    std::partial_sort(
        order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end(),
        [&](std::size_t a, std::size_t b) { return iou[a] != iou[b] ? iou[a] > iou[b] : a < b; });
    std::vector<Vec3i> near;
    for (std::size_t o = 0; o < kept; ++o) {
      const Vec3i reach{stride - 1, stride - 1, stride - 1};
      const Vec3i low = max(shifts.low, tried[order[o]] - reach);
      const Vec3i high = min(shifts.high, tried[order[o]] + reach);
      for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
          for (int x = low.x; x <= high.x; ++x) near.push_back({x, y, z});
    }
    const std::vector<double> refined = ious(example, result, near);
    best = std::max(best, *std::max_element(refined.begin(), refined.end()));
  }
  return 1 - best;
}

void requireOriginsFit(const Origins& origins, const DistanceField& example,
                       const DistanceField& result, int exampleIndex) {
  if (origins.size() != result.size())
    throw InputError("there are " + text(origins.size()) + " origins for a result of " +
                     text(result.size()) + " samples; give one for each sample");
  for (const Origin& o : origins.values())
    if (o.example == exampleIndex && !example.values.contains(o.cell()))
      throw InputError("the origins name sample (" + std::to_string(o.i) + ", " +
                       std::to_string(o.j) + ", " + std::to_string(o.k) +
                       "), and the example has " + text(example.size()) +
                       "; give the example that the result was made from");
}

SurfaceUse surfaceUse(const Occupancy& example, const Origins& origins, int exampleIndex) {
  const Uses uses = countUses(origins, example, exampleIndex);
  if (uses.total == 0 && uses.surface > 1) return {0, 0};
  return {uses.most > 0 ? uses.entropy / uses.most : 1, std::exp(uses.entropy - uses.most)};
}

Novelty measureNovelty(const DistanceField& example, const DistanceField& result,
                       const Origins* origins, int exampleIndex) {
  requireSameVoxels(example, result);
  const Occupancy e(example), r(result);
  Novelty novelty;
  if (e.size() == r.size()) novelty.distance = 1 - intersectionOverUnion(e, r);
  novelty.copyDistance = copyDistance(e, r);
  if (!origins) return novelty;

  requireOriginsFit(*origins, example, result, exampleIndex);
  novelty.verbatimRun = verbatimRun(*origins, example);
  const SurfaceUse used = surfaceUse(e, *origins, exampleIndex);
  novelty.use = used.use;
  novelty.usedShare = used.usedShare;
  return novelty;
}

}  // namespace exemplar
