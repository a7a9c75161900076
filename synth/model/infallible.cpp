// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/infallible.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/cells.h"
#include "synth/model/catalog.h"
#include "synth/model/network.h"

namespace exemplar {
namespace {

/// The rule of an axis as its index, or -1 where the example is flat along it.
std::array<int, 3> axisRules(const Adjacency& adjacency) {
  std::array<int, 3> rules{-1, -1, -1};
  for (std::size_t r = 0; r < adjacency.rules.size(); ++r) {
    const CellOffset& o = adjacency.rules[r].offset;
    if (adjacency.rules[r].pairs.empty()) continue;
    if (o == CellOffset{1, 0, 0, 0}) rules[0] = static_cast<int>(r);
    if (o == CellOffset{0, 1, 0, 0}) rules[1] = static_cast<int>(r);
    if (o == CellOffset{0, 0, 1, 0}) rules[2] = static_cast<int>(r);
  }
  return rules;
}

/// Whether all rules are those of the axes: the proofs cover no others.
bool onlyAxes(const Adjacency& adjacency) {
  return std::all_of(adjacency.rules.begin(), adjacency.rules.end(), [](const PairRule& r) {
    const CellOffset& o = r.offset;
    return o.t == 0 && o.x + o.y + o.z == 1 && std::max({o.x, o.y, o.z}) == 1;
  });
}

bool intersects(std::span<const LabelWord> a, std::span<const LabelWord> b) {
  for (std::size_t w = 0; w < a.size(); ++w) {
    if ((a[w] & b[w]) != 0) return true;
  }
  return false;
}

/// A box of cells as a network, in column order.
LabelNetwork boxNetwork(const Adjacency& adjacency, const std::vector<LabelSets>& support,
                        const Vec3i& size) {
  LabelNetwork n;
  n.labels = adjacency.labelCount;
  n.cells = static_cast<int>(volume(size));
  n.slots = static_cast<int>(support.size());
  n.support = support;
  n.neighbor.assign(static_cast<std::size_t>(n.cells) * n.slots, n.cells);
  const auto index = [&](const Vec3i& p) { return (p.x * size.y + p.y) * size.z + p.z; };
  const CellBox box = CellBox::of(size);
  forEachCell(box, [&](const Vec3i& p) {
    for (std::size_t r = 0; r < adjacency.rules.size(); ++r) {
      const CellOffset& o = adjacency.rules[r].offset;
      for (int s = 0; s < 2; ++s) {
        const Vec3i q = s ? p - Vec3i{o.x, o.y, o.z} : p + Vec3i{o.x, o.y, o.z};
        if (!box.contains(q)) continue;
        n.neighbor[static_cast<std::size_t>(index(p)) * n.slots + 2 * r + s] = index(q);
      }
    }
  });
  return n;
}

/// Lists the contents of one box, whose cells before `last` in column order get labels one by one.
class RegionList {
 public:
  /// A region reaches `after` beyond its cell, where the box does.
  RegionList(const Adjacency& adjacency, const std::vector<LabelSets>& support, const Vec3i& size,
             const Vec3i& last, const Vec3i& after, std::int64_t& count, std::int64_t most,
             const Progress& progress)
      : adjacency_(adjacency),
        size_(size),
        after_(after),
        network_(boxNetwork(adjacency, support, size)),
        part_(network_),
        count_(count),
        most_(most),
        progress_(progress),
        all_(adjacency.labelCount, 1),
        labels_(network_.cells, -1) {
    for (int b = 0; b < adjacency.labelCount; ++b) {
      if (adjacency.frequency[b] > 0) addLabel(all_[0], b);
    }
    last_ = index(last);
  }

  /// False where the new cell may be left without labels, or after too many regions.
  bool proved() { return extend(0); }

 private:
  int index(const Vec3i& p) const { return (p.x * size_.y + p.y) * size_.z + p.z; }

  /// The labels that the region around `cell`, cut off at this box, leaves it (Algorithm 3.7).
  LabelSets possible(int cell) {
    const Vec3i p{cell / (size_.y * size_.z), cell / size_.z % size_.y, cell % size_.z};
    std::vector<std::int32_t> cells;
    for (int i = std::max(0, p.x - 1); i <= std::min(size_.x - 1, p.x + after_.x); ++i) {
      for (int j = std::max(0, p.y - 1); j <= std::min(size_.y - 1, p.y + after_.y); ++j) {
        for (int k = std::max(0, p.z - 1); k <= std::min(size_.z - 1, p.z + after_.z); ++k) {
          cells.push_back(index({i, j, k}));
        }
      }
    }
    part_.select(cells);
    Catalog catalog(part_.network());
    LabelSets set(adjacency_.labelCount, 1);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (cells[c] < cell) {
        std::fill_n(set.data(), set.words(), LabelWord{0});
        addLabel(set[0], labels_[cells[c]]);
        catalog.setDomain(static_cast<int>(c), set[0]);
      } else {
        catalog.setDomain(static_cast<int>(c), all_[0]);
      }
    }
    std::fill_n(set.data(), set.words(), LabelWord{0});
    if (catalog.propagateAll()) {
      const auto left = catalog.domain(part_.local(cell));
      std::copy(left.begin(), left.end(), set[0].begin());
    }
    return set;
  }

  bool extend(int cell) {
    if (++count_ > most_) return false;
    if (count_ % 64 == 0) progress_.check();
    const LabelSets set = possible(cell);
    const bool none = labelsIn(set[0]) == 0;
    if (cell == last_) return !none;
    // A cell that its own region leaves nothing is a failure that another box reports.
    bool sound = true;
    forEachLabel(set[0], [&](int b) {
      if (!sound) return;
      labels_[cell] = b;
      sound = extend(cell + 1);
    });
    labels_[cell] = -1;
    return sound;
  }

  const Adjacency& adjacency_;
  Vec3i size_, after_;
  LabelNetwork network_;
  NetworkPart part_;
  std::int64_t& count_;
  std::int64_t most_;
  const Progress& progress_;
  LabelSets all_;
  std::vector<int> labels_;
  int last_;
};

}  // namespace

bool meetsStatement311(const Adjacency& adjacency) {
  if (!onlyAxes(adjacency)) return false;
  const std::vector<LabelSets> support = supportTables(adjacency);
  const std::array<int, 3> rules = axisRules(adjacency);
  std::vector<int> axes;
  for (int a = 0; a < 3; ++a) {
    if (rules[a] >= 0) axes.push_back(a);
  }
  const int labels = adjacency.labelCount;
  const auto occurs = [&](int b) { return adjacency.frequency[b] > 0; };
  const auto along = [&](int axis, int b) { return support[2 * rules[axis]][b]; };
  const auto against = [&](int axis, int b) { return support[2 * rules[axis] + 1][b]; };

  // A cell at the grid's near sides has fewer cells before it.
  for (const int p : axes) {
    for (int b = 0; b < labels; ++b) {
      if (occurs(b) && labelsIn(along(p, b)) == 0) return false;
    }
  }
  // Labels b before the new cell along p and c before it along q that share a neighbor before both.
  const auto together = [&](int p, int q, int b, int c) {
    return intersects(against(q, b), against(p, c));
  };
  for (std::size_t i = 0; i < axes.size(); ++i) {
    for (std::size_t j = i + 1; j < axes.size(); ++j) {
      const int p = axes[i], q = axes[j];
      for (int b = 0; b < labels; ++b) {
        for (int c = 0; c < labels; ++c) {
          if (!occurs(b) || !occurs(c) || !together(p, q, b, c)) continue;
          if (!intersects(along(p, b), along(q, c))) return false;
        }
      }
    }
  }
  if (axes.size() < 3) return true;
  std::vector<LabelWord> both(support[0].words());
  for (int b = 0; b < labels; ++b) {
    for (int c = 0; c < labels; ++c) {
      if (!occurs(b) || !occurs(c) || !together(0, 1, b, c)) continue;
      for (std::size_t w = 0; w < both.size(); ++w) both[w] = along(0, b)[w] & along(1, c)[w];
      for (int d = 0; d < labels; ++d) {
        if (!occurs(d) || !together(0, 2, b, d) || !together(1, 2, c, d)) continue;
        if (!intersects(both, along(2, d))) return false;
      }
    }
  }
  return true;
}

InfallibleProof proveInfallible(const Adjacency& adjacency, const Vec3i& region,
                                std::int64_t mostRegions, const Progress& progress) {
  InfallibleProof proof;
  proof.region = region;
  if (!onlyAxes(adjacency)) return proof;
  const std::vector<LabelSets> support = supportTables(adjacency);
  const std::array<int, 3> rules = axisRules(adjacency);
  // The box as it is, and cut off before the new cell or after it, along each axis.
  std::array<std::vector<std::array<int, 2>>, 3> cuts;  // cells before, cells after
  for (int a = 0; a < 3; ++a) {
    if (rules[a] < 0) {
      cuts[a] = {{0, 0}};
      continue;
    }
    for (int before = 1; before >= 0; --before) {
      for (int after = region[a] - 2; after >= 0; --after) cuts[a].push_back({before, after});
    }
  }
  for (const auto& x : cuts[0]) {
    for (const auto& y : cuts[1]) {
      for (const auto& z : cuts[2]) {
        const Vec3i last{x[0], y[0], z[0]};
        const Vec3i size{x[0] + x[1] + 1, y[0] + y[1] + 1, z[0] + z[1] + 1};
        const Vec3i after = max(region - Vec3i{2, 2, 2}, Vec3i{0, 0, 0});
        RegionList list(adjacency, support, size, last, after, proof.regions, mostRegions,
                        progress);
        if (list.proved()) continue;
        proof.verdict = proof.regions > mostRegions ? InfallibleProof::Verdict::TooMany
                                                    : InfallibleProof::Verdict::NotProved;
        return proof;
      }
    }
  }
  proof.verdict = InfallibleProof::Verdict::Proved;
  return proof;
}

RuleSummary summarizeRules(const Adjacency& adjacency, std::int64_t mostRegions,
                           const Progress& progress) {
  RuleSummary summary;
  for (const std::int64_t f : adjacency.frequency) summary.labels += f > 0;
  for (const PairRule& r : adjacency.rules) {
    summary.density.push_back(static_cast<double>(r.pairs.size()) /
                              (static_cast<double>(summary.labels) * summary.labels));
  }
  summary.statement311 = meetsStatement311(adjacency);
  const std::array<int, 3> rules = axisRules(adjacency);
  const auto region = [&](int x, int y, int z) {
    return Vec3i{rules[0] < 0 ? 1 : x, rules[1] < 0 ? 1 : y, rules[2] < 0 ? 1 : z};
  };
  const std::array<Vec3i, 6> regions{region(2, 2, 2), region(2, 3, 2), region(2, 2, 3),
                                     region(2, 3, 3), region(3, 3, 2), region(2, 4, 2)};
  for (std::size_t i = 0; i < regions.size(); ++i) {
    progress.report("proving that propagation cannot fail",
                    static_cast<double>(i) / static_cast<double>(regions.size()));
    if (regions[i] == summary.proof.region) continue;
    summary.proof = proveInfallible(adjacency, regions[i], mostRegions, progress);
    if (summary.proof.verdict == InfallibleProof::Verdict::Proved) break;
  }
  return summary;
}

}  // namespace exemplar
