// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/novelty.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <vector>

#include "core/cells.h"
#include "core/disjoint_sets.h"
#include "core/error.h"
#include "core/loop_progress.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "measure/example_nature.h"
#include "measure/same_voxels.h"

namespace exemplar {
namespace {

/// Turned examples of more cells are rolled on a coarser grid first.
constexpr std::int64_t kTurnedCells = std::int64_t{1} << 18;

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
                         const std::vector<Vec3i>& shifts, const Progress& progress) {
  std::vector<double> iou(shifts.size());
  LoopProgress placements(progress, "looking for copies", shifts.size());
  parallelFor(0, shifts.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      placements.check();
      iou[s] = intersectionOverUnion(result, example, shifts[s]);
    }
    placements.advance(end - begin);
  });
  return iou;
}

double verbatimRun(const Origins& origins, const DistanceField& example, const Progress& progress) {
  const Vec3i n = origins.size();
  if (origins.count() > 0xffffffffu)
    throw InputError("the result has " + text(n) +
                     " samples; regions of origins are measured up to 4,294,967,295 samples");
  requireMemory(static_cast<double>(origins.count()) * 8, "measuring regions of origins",
                "measure a smaller result");
  DisjointSets regions(origins.count());
  for (int k = 0; k < n.z; ++k) {
    progress.report("measuring copied regions", static_cast<double>(k) / n.z);
    forEachCell(CellBox{{0, 0, k}, {n.x, n.y, k + 1}}, [&](const Vec3i& p) {
      const auto at = static_cast<std::uint32_t>(origins.index(p));
      const Origin& a = origins.data()[at];
      for (const Vec3i& step : {Vec3i{1, 0, 0}, Vec3i{0, 1, 0}, Vec3i{0, 0, 1}}) {
        const Vec3i q = p + step;
        if (origins.contains(q) && continues(a, origins[q], step))
          regions.join(at, static_cast<std::uint32_t>(origins.index(q)));
      }
    });
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

Uses countUses(const Origins& origins, const Occupancy& example, int exampleIndex,
               const Progress& progress) {
  const CellBox box = CellBox::of(example.size());
  Array3D<std::uint32_t> uses(example.size());
  Uses u;
  progress.report("measuring the use of the surface", 0);
  for (std::size_t s = 0; s < origins.count(); ++s) {
    if (s % 65536 == 0) progress.check();
    const Origin& o = origins.values()[s];
    if (o.example == exampleIndex) ++uses[o.cell()];
  }
  progress.report("measuring the use of the surface", 0.5);
  std::vector<std::uint32_t> counts;
  forEachCell(box, [&](const Vec3i& p) {
    if (!example.solid(p.x, p.y, p.z)) return;
    bool open = false;
    for (const Vec3i& step : kFaceSteps) {
      const Vec3i q = p + step;
      // What lies beyond the box is unknown, and is no surface.
      open |= box.contains(q) && !example.solid(q.x, q.y, q.z);
    }
    if (!open) return;
    ++u.surface;
    u.total += uses[p];
    if (uses[p] > 0) counts.push_back(uses[p]);
  });
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
                         " samples cannot be compared; give results of one size");
      sum += 1 - intersectionOverUnion(results[a], results[b]);
    }
  return pairs == 0 ? 0 : sum / static_cast<double>(pairs);
}

double copyDistance(const Occupancy& example, const Occupancy& result,
                    const CopyDistanceOptions& options, const Progress& progress) {
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
  const double lattice = stride > 1 ? 0.8 : 1;  // of the work
  const std::vector<double> iou = ious(example, result, tried, progress.part(0, lattice));
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
    const std::vector<double> refined = ious(example, result, near, progress.part(lattice, 1));
    best = std::max(best, *std::max_element(refined.begin(), refined.end()));
  }
  return 1 - best;
}

void requireOriginsFit(const Origins& origins, const DistanceField& example,
                       const DistanceField& result, int exampleIndex) {
  if (origins.size() != result.size())
    throw InputError("the result has " + text(result.size()) + " samples and " +
                     text(origins.size()) + " origins; give one origin for each sample");
  for (const Origin& o : origins.values())
    if (o.example == exampleIndex && !example.values.contains(o.cell()))
      throw InputError("the origins name sample (" + std::to_string(o.i) + ", " +
                       std::to_string(o.j) + ", " + std::to_string(o.k) +
                       "), and the example has " + text(example.size()) +
                       "; give the example that the result was made from");
}

SurfaceUse surfaceUse(const Occupancy& example, const Origins& origins, int exampleIndex,
                      const Progress& progress) {
  const Uses uses = countUses(origins, example, exampleIndex, progress);
  if (uses.total == 0 && uses.surface > 1) return {0, 0};
  return {uses.most > 0 ? uses.entropy / uses.most : 1, std::exp(uses.entropy - uses.most)};
}

Novelty measureNovelty(const DistanceField& example, const DistanceField& result,
                       const Origins* origins, int exampleIndex, const Progress& progress) {
  progress.report("measuring novelty", 0);
  requireSameVoxels(example, result);
  const Occupancy e(example), r(result);
  Novelty novelty;
  if (e.size() == r.size()) novelty.distance = 1 - intersectionOverUnion(e, r);
  novelty.copyDistance = copyDistance(e, r, {}, progress.part(0, 0.3));
  novelty.rolled = rolledDistance(e, r, {}, progress.part(0.3, 0.5));
  novelty.turned =
      rolledDistance(e, r, {.turned = true, .cells = kTurnedCells}, progress.part(0.5, 0.7));
  if (novelty.rolled.distance < novelty.turned.distance) novelty.turned = novelty.rolled;
  novelty.rollingIsFair = natureOf(e).fillsEvenly;
  if (!origins) return novelty;

  requireOriginsFit(*origins, example, result, exampleIndex);
  novelty.verbatimRun = verbatimRun(*origins, example, progress.part(0.7, 0.9));
  const SurfaceUse used = surfaceUse(e, *origins, exampleIndex, progress.part(0.9, 0.95));
  novelty.offsets = offsetUse(r, *origins, e.size(), progress.part(0.95, 1));
  novelty.use = used.use;
  novelty.usedShare = used.usedShare;
  return novelty;
}

}  // namespace exemplar
