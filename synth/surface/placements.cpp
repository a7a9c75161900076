// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/placements.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "core/parallel.h"
#include "core/random.h"

namespace exemplar::surface {
namespace {

constexpr std::uint32_t kNone = Placements::kNone;
/// At most so many nodes are compared, and so many asked how often their sources are used.
constexpr std::size_t kCompared = 400, kAsked = 64;

/// The nodes in an order that depends on the seed alone.
std::vector<std::uint32_t> shuffled(std::size_t nodes, std::uint64_t seed) {
  const Random random(seed, stream::kSurfaceSeeds);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(nodes);
  for (std::uint32_t v = 0; v < nodes; ++v) keys[v] = {random.bits(v), v};
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order;
  order.reserve(nodes);
  for (const auto& [key, v] : keys) order.push_back(v);
  return order;
}

/// Middles of discs that are at least `distance` apart and leave no node farther off than that.
std::vector<std::uint32_t> poissonDiscs(const LocalMapper& mapper, double distance,
                                        std::uint64_t seed, const Progress& progress) {
  const std::size_t nodes = mapper.sheet().positions.size();
  std::vector<std::uint8_t> taken(nodes, 0);
  std::vector<std::uint32_t> seeds;
  for (const std::uint32_t v : shuffled(nodes, seed)) {
    if (taken[v]) continue;
    progress.check();
    seeds.push_back(v);
    for (const auto& [node, far] : mapper.near(v, distance)) taken[node] = 1;
  }
  return seeds;
}

/// Makes the maps of the seeds, and of as many more as it takes until every node is inside one.
std::vector<LocalMap> coveringMaps(const LocalMapper& mapper, std::vector<std::uint32_t> seeds,
                                   std::vector<StretchShare>* stretch, const Progress& progress) {
  const std::size_t nodes = mapper.sheet().positions.size();
  std::vector<LocalMap> maps;
  std::vector<std::uint8_t> covered(nodes, 0);
  std::vector<std::vector<StretchShare>> shares;
  while (!seeds.empty()) {
    const std::size_t first = maps.size();
    maps.resize(first + seeds.size());
    shares.resize(maps.size());
    parallelFor(0, seeds.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t s = begin; s < end; ++s) {
        progress.check();
        maps[first + s] = mapper.map(seeds[s], stretch ? &shares[first + s] : nullptr);
      }
    });
    for (std::size_t m = first; m < maps.size(); ++m) {
      covered[maps[m].seed] = 1;
      for (std::size_t k = 0; k < maps[m].nodes.size(); ++k)
        if (maps[m].inner[k]) covered[maps[m].nodes[k]] = 1;
    }
    // What is left is mostly behind singularities. One seed a neighborhood, and round again.
    seeds.clear();
    std::vector<std::uint8_t> near(nodes, 0);
    const double apart = mapper.options().leastRadius * mapper.options().sample / 3;
    for (std::uint32_t v = 0; v < nodes; ++v) {
      if (covered[v] || near[v]) continue;
      seeds.push_back(v);
      for (const auto& [node, far] : mapper.near(v, apart)) near[node] = 1;
    }
  }
  if (stretch) {
    for (const std::vector<StretchShare>& own : shares)
      stretch->insert(stretch->end(), own.begin(), own.end());
  }
  return maps;
}

/// Placements in the order in which they are laid: outward from the first, part by part.
std::vector<std::uint32_t> growthOrder(const std::vector<LocalMap>& maps, std::size_t nodes) {
  std::vector<std::vector<std::uint32_t>> here(nodes);
  for (std::uint32_t p = 0; p < maps.size(); ++p)
    for (const std::uint32_t v : maps[p].nodes) here[v].push_back(p);
  std::vector<std::uint32_t> order;
  std::vector<std::uint8_t> seen(maps.size(), 0);
  for (std::uint32_t first = 0; first < maps.size(); ++first) {
    if (seen[first]) continue;
    std::deque<std::uint32_t> queue{first};
    seen[first] = 1;
    while (!queue.empty()) {
      const std::uint32_t p = queue.front();
      queue.pop_front();
      order.push_back(p);
      std::vector<std::uint32_t> next;
      for (const std::uint32_t v : maps[p].nodes) {
        for (const std::uint32_t q : here[v]) {
          if (seen[q]) continue;
          seen[q] = 1;
          next.push_back(q);
        }
      }
      std::sort(next.begin(), next.end());
      queue.insert(queue.end(), next.begin(), next.end());
    }
  }
  return order;
}

/// A way to lay the example on a map: source = turn * place + shift.
struct Candidate {
  int turn;
  Vec2d shift;
};

/// Lays the example on one map after another.
class Layer {
 public:
  Layer(const LocalMapper& mapper, const Slab& slab, const PlacementOptions& options,
        std::vector<LocalMap> maps, Placements& result)
      : coordinates_(mapper.coordinates()),
        slab_(slab),
        options_(options),
        result_(result),
        used_(static_cast<std::size_t>(slab.size().x) * slab.size().y, 0),
        nearness_(mapper.sheet().positions.size(), std::numeric_limits<double>::max()) {
    result_.owner.assign(nearness_.size(), kNone);
    shown_.assign(nearness_.size(), {});
    for (LocalMap& map : maps) result_.all.push_back({.map = std::move(map)});
  }

  void lay(std::uint32_t p) {
    Placement& placement = result_.all[p];
    const LocalMap& map = placement.map;
    std::vector<std::uint32_t> known;
    for (std::uint32_t k = 0; k < map.nodes.size(); ++k)
      if (result_.owner[map.nodes[k]] != kNone) known.push_back(k);
    placement.met = !known.empty();
    const std::vector<Candidate> candidates = candidatesFor(map);
    const std::vector<std::uint32_t> compared = some(known, kCompared);
    std::vector<std::uint32_t> everyone(map.nodes.size());
    std::iota(everyone.begin(), everyone.end(), 0u);
    const std::vector<std::uint32_t> asked = some(everyone, kAsked);

    const Random random(options_.seed, stream::kSurfacePlaces);
    std::vector<double> costs(candidates.size());
    parallelFor(0, candidates.size(), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) {
        costs[c] = disagreement(map, candidates[c], compared) +
                   options_.use * use(map, candidates[c], asked);
        // The first ones agree with everything: any will do.
        if (compared.empty()) costs[c] += random.uniform(map.seed, static_cast<std::uint32_t>(c));
      }
    });
    const auto best =
        static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
    Candidate chosen = candidates[best];
    if (!compared.empty()) chosen = refined(map, chosen, compared);
    placement.turn = chosen.turn;
    placement.disagreement = disagreement(map, chosen, compared);
    const Mat2d turn = rotation(chosen.turn, coordinates_.symmetry);
    placement.source.reserve(map.nodes.size());
    for (const Vec2d& at : map.at) placement.source.push_back(turn * at + chosen.shift);
    take(p);
  }

 private:
  static std::vector<std::uint32_t> some(const std::vector<std::uint32_t>& all, std::size_t most) {
    if (all.size() <= most) return all;
    std::vector<std::uint32_t> result;
    for (std::size_t k = 0; k < most; ++k)
      result.push_back(all[k * all.size() / most + all.size() / most / 2]);
    return result;
  }

  /// All ways whose sources lie in the example, as far as it is large enough.
  std::vector<Candidate> candidatesFor(const LocalMap& map) const {
    std::vector<Candidate> candidates;
    const Lattice& lattice = coordinates_.lattice;
    const Vec2d most{slab_.size().x - 1.0, slab_.size().y - 1.0};
    for (int turn = 0; turn < coordinates_.symmetry; ++turn) {
      const Mat2d by = rotation(turn, coordinates_.symmetry);
      Vec2d low{1e300, 1e300}, high{-1e300, -1e300};
      for (std::size_t k = 0; k < map.at.size(); ++k) {
        if (!map.inner[k] && map.at.size() > 1 && map.nodes[k] != map.seed) continue;
        const Vec2d at = by * map.at[k];
        low = {std::min(low.x, at.x), std::min(low.y, at.y)};
        high = {std::max(high.x, at.x), std::max(high.y, at.y)};
      }
      // Where shifts may lie; where the map is larger than the example, it sticks out on both
      // sides.
      Vec2d from{-low.x, -low.y}, to{most.x - high.x, most.y - high.y};
      if (from.x > to.x) from.x = to.x = (from.x + to.x) / 2;
      if (from.y > to.y) from.y = to.y = (from.y + to.y) / 2;
      if (lattice.periods == 0) {
        for (double y = std::ceil(from.y); y <= std::max(to.y, std::ceil(from.y)); ++y)
          for (double x = std::ceil(from.x); x <= std::max(to.x, std::ceil(from.x)); ++x)
            candidates.push_back({turn, {x, y}});
      } else {
        addSteps(lattice, turn, from, to, candidates);
      }
    }
    return candidates;
  }

  /// The whole steps of the lattice, from the middle of the symmetry, that are between; at least
  /// the one that is nearest to it.
  void addSteps(const Lattice& lattice, int turn, const Vec2d& from, const Vec2d& to,
                std::vector<Candidate>& candidates) const {
    const Vec2d middle = options_.symmetry.middle, center = (from + to) * 0.5;
    const Vec2d steps = lattice.basis().inverse() * (center - middle);
    const double reach = length(to - from) / 2;
    // How far apart rows are is at least the area of a cell over its longer side.
    const double cell = std::abs(lattice.basis().determinant());
    const double row = cell / std::max(length(lattice.first), length(lattice.second));
    const int most = static_cast<int>(std::ceil(reach / std::max(row, 1.0))) + 1;
    const int mostSecond = lattice.periods == 2 ? most : static_cast<int>(std::ceil(reach)) + 1;
    constexpr double kOut = 0.75;  // samples; sources a little outside count as at the rim
    Candidate nearest{turn, {}};
    double least = std::numeric_limits<double>::max();
    bool any = false;
    for (int j = -mostSecond; j <= mostSecond; ++j) {
      for (int i = -most; i <= most; ++i) {
        const Vec2d whole{std::round(steps.x) + i, std::round(steps.y) + j};
        const Vec2d shift = middle + lattice.basis() * whole;
        const double off =
            std::max({from.x - shift.x, shift.x - to.x, from.y - shift.y, shift.y - to.y});
        if (off <= kOut) {
          candidates.push_back({turn, shift});
          any = true;
        }
        const double far = length(shift - center);
        if (far < least) {
          least = far;
          nearest.shift = shift;
        }
      }
    }
    if (!any) candidates.push_back(nearest);
  }

  double disagreement(const LocalMap& map, const Candidate& candidate,
                      const std::vector<std::uint32_t>& nodes) const {
    if (nodes.empty()) return 0;
    const Mat2d turn = rotation(candidate.turn, coordinates_.symmetry);
    std::int64_t sum = 0;
    const int heights = slab_.heights();
    for (const std::uint32_t k : nodes) {
      const std::int8_t* a = slab_.column(turn * map.at[k] + candidate.shift).data();
      const std::int8_t* b = slab_.column(shown_[map.nodes[k]]).data();
      int difference = 0;
      for (int z = 0; z < heights; ++z) difference += std::abs(a[z] - b[z]);
      sum += difference;
    }
    return static_cast<double>(sum) / (static_cast<double>(nodes.size()) * heights * Slab::kSteps);
  }

  /// How often the sources were used, of how often all were on average.
  double use(const LocalMap& map, const Candidate& candidate,
             const std::vector<std::uint32_t>& nodes) const {
    if (total_ == 0) return 0;
    const Mat2d turn = rotation(candidate.turn, coordinates_.symmetry);
    double sum = 0;
    for (const std::uint32_t k : nodes) sum += used_[cellOf(turn * map.at[k] + candidate.shift)];
    const double mean = static_cast<double>(total_) / static_cast<double>(used_.size());
    return sum / static_cast<double>(nodes.size()) / std::max(mean, 1.0);
  }
  std::size_t cellOf(const Vec2d& at) const {
    const int i = std::clamp(static_cast<int>(std::lround(at.x)), 0, slab_.size().x - 1);
    const int j = std::clamp(static_cast<int>(std::lround(at.y)), 0, slab_.size().y - 1);
    return static_cast<std::size_t>(j) * slab_.size().x + i;
  }

  /// By half a sample along what does not repeat, where that agrees better.
  Candidate refined(const LocalMap& map, const Candidate& from,
                    const std::vector<std::uint32_t>& compared) const {
    if (coordinates_.lattice.periods > 0) return from;
    Candidate best = from;
    double least = disagreement(map, from, compared);
    for (int n = 0; n < 9; ++n) {
      const Candidate next{from.turn, from.shift + Vec2d{(n % 3 - 1) * 0.5, (n / 3 - 1) * 0.5}};
      const double cost = disagreement(map, next, compared);
      if (cost < least) {
        least = cost;
        best = next;
      }
    }
    return best;
  }

  /// Nodes show the placement in whose map they are nearest to the middle.
  void take(std::uint32_t p) {
    const Placement& placement = result_.all[p];
    const LocalMap& map = placement.map;
    const Vec2d middle = map.at[map.find(map.seed)];
    for (std::size_t k = 0; k < map.nodes.size(); ++k) {
      const std::uint32_t v = map.nodes[k];
      const bool can = map.inner[k] && slab_.has(placement.source[k]);
      // What no map has inside goes to whoever is nearest, after all others.
      constexpr double kLast = 1e6;
      const double nearness = length(map.at[k] - middle) / map.radius + (can ? 0 : kLast);
      if (nearness >= nearness_[v]) continue;
      nearness_[v] = nearness;
      if (result_.owner[v] != kNone) --used_[cellOf(shown_[v])];
      result_.owner[v] = p;
      shown_[v] = placement.source[k];
      ++used_[cellOf(shown_[v])];
    }
    total_ = 0;
    for (const std::int32_t n : used_) total_ += n;
  }

  const Coordinates& coordinates_;
  const Slab& slab_;
  const PlacementOptions& options_;
  Placements& result_;
  std::vector<std::int32_t> used_;
  std::int64_t total_ = 0;
  std::vector<double> nearness_;
  std::vector<Vec2d> shown_;
};

}  // namespace

const Placements::Membership* Placements::find(std::uint32_t node, std::uint32_t placement) const {
  for (const Membership& m : at(node))
    if (m.placement == placement) return &m;
  return nullptr;
}

void Placements::index(std::size_t nodes, const Slab& slab) {
  begin_.assign(nodes + 1, 0);
  for (const Placement& p : all)
    for (const std::uint32_t v : p.map.nodes) ++begin_[v + 1];
  for (std::size_t v = 0; v < nodes; ++v) begin_[v + 1] += begin_[v];
  members_.resize(begin_.back());
  std::vector<std::uint32_t> end(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t p = 0; p < all.size(); ++p) {
    const LocalMap& map = all[p].map;
    for (std::uint32_t k = 0; k < map.nodes.size(); ++k)
      members_[end[map.nodes[k]]++] = {p, k, map.inner[k] && slab.has(all[p].source[k])};
  }
}

Placements place(const LocalMapper& mapper, const Slab& slab, const PlacementOptions& options,
                 std::vector<StretchShare>* stretch, const Progress& progress) {
  progress.report("laying discs out", 0);
  const double distance = options.spacing * mapper.options().radius * mapper.options().sample;
  std::vector<LocalMap> maps = coveringMaps(
      mapper, poissonDiscs(mapper, distance, options.seed, progress), stretch, progress);
  const std::size_t nodes = mapper.sheet().positions.size();
  const std::vector<std::uint32_t> order = growthOrder(maps, nodes);
  Placements result;
  Layer layer(mapper, slab, options, std::move(maps), result);
  for (std::size_t n = 0; n < order.size(); ++n) {
    progress.report("placing the example",
                    0.5 + 0.5 * static_cast<double>(n) / static_cast<double>(order.size()));
    layer.lay(order[n]);
  }
  result.index(nodes, slab);
  return result;
}

}  // namespace exemplar::surface
