// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "search/minimum_cut.h"

namespace exemplar {

struct GraphLinks {
  std::int32_t begin = 0, end = 0;  ///< of the node's arcs
};

/// A minimum cut of any graph, as of a surface's nodes: the same cut as `LatticeCut`'s where the
/// graph is a lattice.
class GraphCut : public MinimumCut<GraphCut, GraphLinks, std::int32_t> {
 public:
  explicit GraphCut(int nodes) : MinimumCut(nodes) {}

  /// Makes `a` and `b`, which differ, neighbors: `cost` >= 0 where `a` is on the first side and `b`
  /// on the second, `reverse` >= 0 the other way round. Several edges of a pair add up.
  void connect(int a, int b, std::int64_t cost, std::int64_t reverse) {
    edges_.push_back({a, b, cost, reverse});
  }
  /// Finds the cut. Once. Throws `Cancelled`.
  void solve(const Progress& progress = {});

 private:
  friend MinimumCut;
  struct Edge {
    int a, b;
    std::int64_t cost, reverse;
  };
  struct Arc {
    std::int32_t neighbor, opposite;  ///< `opposite`: the direction back, at the neighbor
    std::int64_t residual;
  };

  int degree(int node) const { return nodes_[node].end - nodes_[node].begin; }
  const Arc& arc(int node, int direction) const { return arcs_[nodes_[node].begin + direction]; }
  int neighbor(int node, int direction) const { return arc(node, direction).neighbor; }
  std::int64_t& residual(int node, int direction) {
    return arcs_[nodes_[node].begin + direction].residual;
  }
  std::int32_t opposite(int node, int direction) const { return arc(node, direction).opposite; }

  std::vector<Edge> edges_;
  std::vector<Arc> arcs_;  ///< those of node 0, of node 1, ...; in the order of `connect`
};

extern template class MinimumCut<GraphCut, GraphLinks, std::int32_t>;

}  // namespace exemplar
