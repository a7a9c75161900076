// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "layered_baseline.h"

#include <cmath>
#include <cstdlib>

#include "core/parallel.h"

namespace exemplar::bench {

std::vector<BoundaryMatch> matchPlainly(const BoundaryPatches& set, const BoundaryPatches& examples,
                                        const std::vector<std::uint32_t>& uses) {
  struct Unit {
    std::uint32_t example;
    std::uint32_t nearest = 0;
    BoundaryMatch match;
  };
  std::vector<Unit> units;
  for (std::uint32_t e = 0; e < uses.size(); ++e)
    for (std::uint32_t n = 0; n < uses[e]; ++n) units.push_back({e, 0, {}});
  std::vector<std::uint32_t> waiting(set.count());
  for (std::uint32_t s = 0; s < waiting.size(); ++s) waiting[s] = s;
  std::vector<BoundaryMatch> served(set.count());
  while (!waiting.empty() && !units.empty()) {
    parallelFor(0, units.size(), 16, [&](std::size_t first, std::size_t last) {
      for (std::size_t u = first; u < last; ++u) {
        int least = 1 << 30;
        for (const std::uint32_t s : waiting) {
          for (int t = 0; t < examples.turns(); ++t) {
            const int distance = patchDistance(set, s, examples, units[u].example, t);
            if (distance >= least) continue;
            least = distance;
            units[u].nearest = s;
            units[u].match = {units[u].example, static_cast<std::uint16_t>(t),
                              static_cast<std::uint16_t>(distance)};
          }
        }
      }
    });
    std::vector<const Unit*> best(set.count());
    for (const Unit& unit : units) {
      const Unit*& at = best[unit.nearest];
      if (!at || unit.match.distance < at->match.distance) at = &unit;
    }
    std::vector<Unit> left;
    for (const Unit& unit : units) {
      if (best[unit.nearest] == &unit) {
        served[unit.nearest] = unit.match;
      } else {
        left.push_back(unit);
      }
    }
    std::erase_if(waiting, [&](std::uint32_t s) { return best[s] != nullptr; });
    units = std::move(left);
  }
  return served;
}

Shape optimizePlainly(Shape shape, const ShapeExample& example, int iterations,
                      const Random& random) {
  const auto target = std::llround(example.area * static_cast<double>(shape.count()));
  for (int n = 0; n < iterations; ++n) {
    PlacedPatches placed;
    placed.boundary = boundaryOf(shape, true);
    const BoundaryPatches patches(shape, placed.boundary, example.patches.side(), 1, true);
    placed.matches = matchPlainly(patches, example.patches,
                                  fairUses(patches.count(), example.patches.count(),
                                           random.fork(static_cast<std::uint64_t>(n))));
    const PatchVotes votes = votesOf(example.shape, example.patches, placed, shape.size(), false);
    Shape best = shape;
    long long least = -1;
    for (int t = 0; t <= 20; ++t) {
      const auto threshold = static_cast<float>(std::pow(10.0, -7 + t * 0.25));
      Shape changed = shape;
      for (std::size_t p = 0; p < shape.count(); ++p)
        if (votes.weight(p) >= threshold && votes.weight(p) > 0)
          changed.data()[p] = votes.inside.data()[p] > votes.outside.data()[p];
      const long long error = std::llabs(insideOf(changed) - target);
      if (least >= 0 && error >= least) continue;
      least = error;
      best = std::move(changed);
    }
    shape = std::move(best);
  }
  return shape;
}

}  // namespace exemplar::bench
