// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/sheet_seams.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "core/parallel.h"
#include "search/graph_cut.h"

namespace exemplar::surface {
namespace {

/// Lengths of dual edges are in so many parts of their mean, at most this many times it.
constexpr double kParts = 16, kLongest = 4;

/// What seams cost.
class SeamEnergy {
 public:
  SeamEnergy(const Sheet& sheet, const Slab& slab, const Placements& placements,
             const SheetSeamOptions& options)
      : placements_(placements), heights_(static_cast<std::size_t>(slab.heights())) {
    columns_.resize(placements.memberships() * heights_);
    parallelFor(0, sheet.positions.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        for (const Placements::Membership& m : placements.at(static_cast<std::uint32_t>(v)))
          slab.column(placements.all[m.placement].source[m.number],
                      columns_.data() + placements.numberOf(m) * heights_);
      }
    });
    double mean = 0;
    for (const Sheet::Edge& e : sheet.edges) mean += e.weight * e.length;
    mean /= static_cast<double>(sheet.edges.size());
    for (const Sheet::Edge& e : sheet.edges) {
      const double parts = kParts * std::min(e.weight * e.length / mean, kLongest);
      dual_.push_back(std::max<std::int64_t>(1, std::llround(parts)));
    }
    length_ = std::llround(options.length * Slab::kSteps * static_cast<double>(heights_));
    slope_ = std::llround(options.slope * 16);
    unknown_ = static_cast<std::int64_t>(2 * Slab::kLimit * Slab::kSteps) *
               static_cast<std::int64_t>(heights_);
  }

  /// Of an edge between x, which shows a, and y, which shows b.
  std::int64_t edge(std::uint32_t e, std::uint32_t x, std::uint32_t a, std::uint32_t y,
                    std::uint32_t b) const {
    if (a == b) return 0;
    const Placements::Membership *xa = placements_.find(x, a), *xb = placements_.find(x, b),
                                 *ya = placements_.find(y, a), *yb = placements_.find(y, b);
    if (!xa || !xb || !ya || !yb) return dual_[e] * unknown_;
    const std::int8_t *pxa = columnOf(*xa), *pxb = columnOf(*xb), *pya = columnOf(*ya),
                      *pyb = columnOf(*yb);
    int values = 0, slopes = 0;
    for (std::size_t z = 0; z < heights_; ++z) {
      const int dx = pxa[z] - pxb[z], dy = pya[z] - pyb[z];
      values += std::abs(dx) + std::abs(dy);
      slopes += std::abs(dx - dy);
    }
    return dual_[e] * (values + slope_ * slopes / 16 + length_);
  }

 private:
  const std::int8_t* columnOf(const Placements::Membership& m) const {
    return columns_.data() + placements_.numberOf(m) * heights_;
  }

  const Placements& placements_;
  std::size_t heights_;
  std::vector<std::int8_t> columns_;
  std::vector<std::int64_t> dual_;
  std::int64_t length_ = 0, slope_ = 0, unknown_ = 0;
};

/// Placements in groups whose maps share no node.
std::vector<std::vector<std::uint32_t>> apart(const Placements& placements) {
  std::vector<std::vector<std::uint32_t>> groups;
  std::vector<int> group(placements.all.size(), -1);
  std::vector<std::uint32_t> seenBy;
  for (std::uint32_t p = 0; p < group.size(); ++p) {
    seenBy.assign(groups.size() + 1, 0);
    for (const std::uint32_t v : placements.all[p].map.nodes)
      for (const Placements::Membership& m : placements.at(v))
        if (group[m.placement] >= 0) seenBy[static_cast<std::size_t>(group[m.placement])] = 1;
    const auto free = std::find(seenBy.begin(), seenBy.end(), 0u) - seenBy.begin();
    group[p] = static_cast<int>(free);
    if (static_cast<std::size_t>(free) == groups.size()) groups.emplace_back();
    groups[static_cast<std::size_t>(free)].push_back(p);
  }
  return groups;
}

/// One placement takes what of its map lowers the sum.
void expand(const Sheet& sheet, const SeamEnergy& energy, Placements& placements, std::uint32_t p,
            const Progress& progress) {
  const LocalMap& map = placements.all[p].map;
  std::vector<std::int32_t> number(map.nodes.size(), -1);
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t k = 0; k < map.nodes.size(); ++k) {
    const std::uint32_t v = map.nodes[k];
    const Placements::Membership* m = placements.find(v, p);
    if (!m->possible || placements.owner[v] == p) continue;
    number[k] = static_cast<std::int32_t>(nodes.size());
    nodes.push_back(k);
  }
  if (nodes.empty()) return;
  GraphCut cut(static_cast<int>(nodes.size()));
  for (const std::uint32_t k : nodes) {
    const std::uint32_t x = map.nodes[k], fx = placements.owner[x];
    const int node = number[k];
    for (const Sheet::Link& link : sheet.links(x)) {
      const std::uint32_t y = link.node, fy = placements.owner[y], e = link.edge;
      const std::uint32_t there = map.find(y);
      const int other = there == LocalMap::kNowhere ? -1 : number[there];
      const std::int64_t stay = energy.edge(e, x, fx, y, fy);
      const std::int64_t takeX = energy.edge(e, x, p, y, fy);
      if (other < 0) {
        cut.addTerminal(node, takeX - stay);
        continue;
      }
      if (x > y) continue;
      // stay + (takeX - stay) x + (0 - takeX) y + (takeX + takeY - stay) (1 - x) y
      const std::int64_t takeY = energy.edge(e, x, fx, y, p);
      cut.addTerminal(node, takeX - stay);
      cut.addTerminal(other, -takeX);
      cut.connect(node, other, std::max<std::int64_t>(0, takeX + takeY - stay), 0);
    }
  }
  cut.solve(progress);
  for (const std::uint32_t k : nodes)
    if (cut.onSecondSide(number[k])) placements.owner[map.nodes[k]] = p;
}

std::int64_t total(const Sheet& sheet, const SeamEnergy& energy, const Placements& placements) {
  return parallelSum<std::int64_t>(
      0, sheet.edges.size(), 4096, [&](std::size_t begin, std::size_t end) {
        std::int64_t sum = 0;
        for (std::size_t e = begin; e < end; ++e) {
          const Sheet::Edge& edge = sheet.edges[e];
          sum += energy.edge(static_cast<std::uint32_t>(e), edge.a, placements.owner[edge.a],
                             edge.b, placements.owner[edge.b]);
        }
        return sum;
      });
}

}  // namespace

SheetSeams cutSeams(const Sheet& sheet, const Slab& slab, Placements& placements,
                    const SheetSeamOptions& options, const Progress& progress) {
  progress.report("cutting seams", 0);
  const SeamEnergy energy(sheet, slab, placements, options);
  SheetSeams result;
  result.before = total(sheet, energy, placements);
  const std::vector<std::vector<std::uint32_t>> groups = apart(placements);
  const double steps = options.passes * static_cast<double>(groups.size());
  for (int pass = 0; pass < options.passes; ++pass) {
    for (std::size_t g = 0; g < groups.size(); ++g) {
      progress.report("cutting seams",
                      (pass * static_cast<double>(groups.size()) + static_cast<double>(g)) / steps);
      parallelFor(0, groups[g].size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n)
          expand(sheet, energy, placements, groups[g][n], progress);
      });
    }
  }
  result.after = total(sheet, energy, placements);
  for (const Sheet::Edge& e : sheet.edges)
    result.seamEdges += placements.owner[e.a] != placements.owner[e.b];
  return result;
}

}  // namespace exemplar::surface
