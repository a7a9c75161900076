// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/quilting/halves.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/parallel.h"

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// Halves are cut at least this far from the example's ends, of its length.
constexpr double kEnd = 0.25;
/// Of three parts, the one that is not divided is this much of the result, more or less, and the
/// other is divided not farther than this from its middle.
constexpr double kUndivided = 0.36, kSpread = 0.05, kMiddle = 0.06;
/// From this much on, voxels, both sides of a joint have no windows in common.
constexpr double kFits = 0.5;
/// What it costs besides that both sides of a joint differ by a voxel, in shares of the surface
/// that is whole no more; and by how much more than the best axis one may cost to get its turn.
constexpr double kDifference = 0.05, kWorse = 0.1;
/// Differences at a joint count up to here, voxels.
constexpr float kLimit = 4;
/// Halves overlap by at most this much of the example.
constexpr int kMostOverlap = 4;

/// The example's halves exchanged across an axis: what begins at `at` comes first, then the example
/// from its beginning on. They overlap by `overlap` samples, the joint in the middle of them.
struct Exchange {
  int axis = 0, at = 0, overlap = 0;
  int liftFirst = 0, liftSecond = 0;  ///< of what comes first and second, samples

  Vec3i source(const Vec3i& size, Vec3i p) const {
    const int n = size[axis];
    const bool first = p[axis] < n - at - overlap / 2;
    p[axis] += first ? at : at + overlap - n;
    p.z -= first ? liftFirst : liftSecond;
    return p;
  }
};

/// What to make of the example: its parts exchanged across an axis, and the larger of the two parts
/// divided and exchanged once more across another one. So no cyclic move of the example explains
/// more than a part of it.
struct Plan {
  Exchange across;
  std::optional<Exchange> within;
  bool inFirst = false;  ///< `within` divides what comes first

  Vec3i source(const Vec3i& size, const Vec3i& p) const {
    const bool first = p[across.axis] < size[across.axis] - across.at - across.overlap / 2;
    const Vec3i q = across.source(size, p);
    return within && first == inFirst ? within->source(size, q) : q;
  }
};

/// A place for each seed, 0..1, far from those of the seeds before: the ends, and then the middles
/// of what is between (van der Corput's sequence).
double farFromOthers(std::uint64_t seed) {
  if (seed < 2) return static_cast<double>(seed);
  double place = 0, digit = 0.5;
  for (std::uint64_t bits = seed - 1; bits > 0; bits /= 2, digit /= 2) {
    if (bits % 2) place += digit;
  }
  return place;
}

/// How far ground can be lifted and lowered with air left above it and solid below, samples.
struct Room {
  int up = 0, down = 0;
};

Room roomOf(const PyramidLevel& level) {
  const Vec3i n = level.source.parts[0].size();
  const auto all = [&](int k, bool solid) {
    for (int j = 0; j < n.y; ++j) {
      for (int i = 0; i < n.x; ++i) {
        if ((level.source.values[level.source.parts[0].begin + Vec3i{i, j, k}] < 0) != solid)
          return false;
      }
    }
    return true;
  };
  int solid = 0, air = 0;
  while (solid < n.z && all(solid, true)) ++solid;
  while (air < n.z && all(n.z - 1 - air, false)) ++air;
  return solid == 0 || air == 0 ? Room{} : Room{air - 1, solid - 1};
}

class Halves {
 public:
  Halves(const PyramidLevel& level, const HalvesOptions& options)
      : level_(level), options_(options), room_(roomOf(level)) {
    for (int axis = 0; axis < 3; ++axis) {
      const bool through = level.source.air.before[axis] == 0 && level.source.air.after[axis] == 0;
      if (!options.stationary[axis] || !through) continue;
      if (level.source.parts[0].size()[axis] >= 4 * options.window) axes_.push_back(axis);
    }
  }

  bool possible() const { return !axes_.empty(); }

  /// What to try, one after the other.
  std::vector<Plan> plans(const Progress& progress) const {
    std::vector<Exchange> fitting;
    std::vector<double> costs;
    for (const int axis : axes_) {
      const auto [exchange, cost] = fitted(axis, progress);
      fitting.push_back(exchange);
      costs.push_back(cost);
    }
    const double least = *std::min_element(costs.begin(), costs.end());
    std::vector<Exchange> good;
    for (std::size_t n = 0; n < fitting.size(); ++n) {
      if (costs[n] <= least + kWorse) good.push_back(fitting[n]);
    }
    const std::size_t turn = options_.seed % good.size();
    const double place = farFromOthers(options_.seed / good.size());
    std::vector<Plan> plans;
    // Three parts, the largest of them less than two fifths.
    for (std::size_t n = 0; options_.divide && n < good.size(); ++n) {
      const Exchange& exchange = good[(turn + n) % good.size()];
      const double undivided = kUndivided + kSpread * (place - 0.5);
      const bool inFirst = (options_.seed / good.size()) % 2 == 0;
      const double overlap = 0.5 * exchange.overlap / level_.source.parts[0].size()[exchange.axis];
      const double at = (inFirst ? undivided : 1 - undivided) - overlap;
      Plan plan{cutAt(exchange, at), std::nullopt, inFirst};
      for (std::size_t m = 0; m < fitting.size(); ++m) {
        const Exchange& other = fitting[(options_.seed / good.size() + m) % fitting.size()];
        if (other.axis == exchange.axis) continue;
        plan.within = cutAt(other, 0.5 + 2 * kMiddle * (place - 0.5));
        keepInRoom(plan);
        plans.push_back(plan);
      }
    }
    for (const double nearer : {0.0, 0.5, 1.0}) {
      for (std::size_t n = 0; n < good.size(); ++n) {
        const Exchange& exchange = good[(turn + n) % good.size()];
        const double at = kEnd + (1 - 2 * kEnd) * (place + nearer * (0.5 - place));
        plans.push_back({cutAt(exchange, at), std::nullopt, false});
      }
    }
    return plans;
  }

  PyramidSources sources(const Plan& plan) const {
    PyramidSources sources(level_.target.framed());
    const CellBox part = level_.source.parts[0];
    parallelForEachCell(sources.size(), [&](const Vec3i& cell) {
      const Vec3i p = plan.source(part.size(), cell - part.begin);
      sources[cell] = level_.source.values.clamped(p + part.begin);
    });
    return sources;
  }

 private:
  /// Across an axis, the overlap and the lifts with which halves fit best, and what they cost: the
  /// shares of the example's and of the result's surface that are whole no more.
  std::pair<Exchange, double> fitted(int axis, const Progress& progress) const {
    const double n = level_.source.parts[0].size()[axis];
    const bool lifts = axis != 2 && room_.up + room_.down > 0;
    const int most = lifts ? room_.up + room_.down : 0;
    const int narrowest = options_.window - 1;
    Exchange best{axis, 0, narrowest};
    double least = 0;
    int rise = 0;
    for (int overlap = narrowest; overlap * kMostOverlap <= n; ++overlap) {
      progress.check();
      for (int r = 0; r <= 2 * most; ++r) {
        const int lift = r % 2 ? -(r + 1) / 2 : r / 2;  // what is near to none first
        // Windows that lean over the result's faces and, of the example, what the overlap leaves
        // out; and at the joint those across it, unless both sides agree.
        const double difference = differenceAt(axis, overlap, lift);
        const double torn = 2 * narrowest * std::min(1.0, difference / kFits);
        const double cost = (narrowest + overlap + torn) / n + kDifference * difference;
        if ((overlap > narrowest || r > 0) && cost >= least) continue;
        least = cost;
        best.overlap = overlap;
        rise = lift;
      }
    }
    best.liftSecond = rise;
    return {best, least};
  }

  /// Lifts of both exchanges add up: those within become smaller where the box has no room.
  void keepInRoom(Plan& plan) const {
    const int lift = plan.inFirst ? plan.across.liftFirst : plan.across.liftSecond;
    for (int* within : {&plan.within->liftFirst, &plan.within->liftSecond}) {
      *within = std::clamp(*within, -room_.down - lift, room_.up - lift);
    }
  }

  /// The exchange cut at a share of the length, as much of it lifted as is lowered.
  Exchange cutAt(Exchange exchange, double place) const {
    const int n = level_.source.parts[0].size()[exchange.axis];
    exchange.at = static_cast<int>(std::lround(n * place));
    const int rise = exchange.liftSecond;  // of the second above the first; |rise| <= up + down
    const double share = 1 - static_cast<double>(exchange.at) / n;
    exchange.liftSecond =
        std::clamp(static_cast<int>(std::lround(rise * share)),
                   std::max(-room_.down, rise - room_.down), std::min(room_.up, rise + room_.up));
    exchange.liftFirst = exchange.liftSecond - rise;
    return exchange;
  }

  /// The mean of how much the example's last samples along an axis differ from its first, laid over
  /// them with an overlap and lifted, near the surface; voxels.
  double differenceAt(int axis, int overlap, int lift) const {
    const Vec3i n = level_.source.parts[0].size(), first = level_.source.parts[0].begin;
    Vec3i size = n, last{0, 0, 0};
    size[axis] = overlap;
    last[axis] = n[axis] - overlap;
    const auto at = [&](const Vec3i& p) {
      return std::clamp(level_.source.values[level_.source.values.clamped(p + first)], -kLimit,
                        kLimit);
    };
    struct Sum {
      double difference = 0;
      std::int64_t count = 0;
    };
    std::vector<Sum> layers(static_cast<std::size_t>(size.z));
    parallelFor(0, layers.size(), 1, [&](std::size_t from, std::size_t to) {
      for (std::size_t k = from; k < to; ++k) {
        for (int j = 0; j < size.y; ++j) {
          for (int i = 0; i < size.x; ++i) {
            const Vec3i p{i, j, static_cast<int>(k)};
            const float a = at(p + last), b = at(p - Vec3i{0, 0, lift});
            if (std::min(std::abs(a), std::abs(b)) >= 1) continue;
            layers[k].difference += std::abs(a - b);
            ++layers[k].count;
          }
        }
      }
    });
    Sum all;
    for (const Sum& layer : layers) {
      all.difference += layer.difference;
      all.count += layer.count;
    }
    return all.count == 0 ? 0 : all.difference / static_cast<double>(all.count);
  }

  const PyramidLevel& level_;
  const HalvesOptions& options_;
  Room room_;
  std::vector<int> axes_;
};

}  // namespace

PyramidSources exchangedHalves(const PyramidLevel& level, const HalvesOptions& options,
                               const Progress& progress) {
  if (level.target.size != level.source.parts[0].size()) return {};
  const Halves halves(level, options);
  if (!halves.possible()) return {};
  PyramidSources farthest;
  double most = -1;
  const std::vector<Plan> plans = halves.plans(progress);
  for (std::size_t n = 0; n < plans.size(); ++n) {
    // Each plan is as likely as not the last: it gets half of what is left to report.
    const int before = static_cast<int>(n);
    const Progress trying =
        progress.part(1 - std::ldexp(1, -before), 1 - std::ldexp(1, -before - 1));
    trying.report("exchanging halves", 0);
    PyramidSources sources = halves.sources(plans[n]);
    if (options.cut) options.cut(sources, trying);
    const double distance = distanceToSource(level, sources, kCopyReach);
    if (distance <= most) continue;
    most = distance;
    farthest = std::move(sources);
    if (most >= options.novelty) break;
  }
  return farthest;
}

}  // namespace exemplar
