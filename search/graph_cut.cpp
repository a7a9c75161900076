// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/graph_cut.h"

namespace exemplar {

template class MinimumCut<GraphCut, GraphLinks, std::int32_t>;

void GraphCut::solve(const Progress& progress) {
  for (const Edge& e : edges_) {
    ++nodes_[e.a].end;
    ++nodes_[e.b].end;
  }
  std::int32_t begin = 0;
  for (Node& node : nodes_) {
    node.begin = begin;
    begin += node.end;
    node.end = node.begin;
  }
  arcs_.resize(static_cast<std::size_t>(begin));
  for (const Edge& e : edges_) {
    Node &a = nodes_[e.a], &b = nodes_[e.b];
    arcs_[a.end] = {e.b, b.end - b.begin, e.cost};
    arcs_[b.end] = {e.a, a.end - a.begin, e.reverse};
    ++a.end;
    ++b.end;
  }
  edges_ = {};
  MinimumCut::solve(progress);
}

}  // namespace exemplar
