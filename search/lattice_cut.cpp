// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/lattice_cut.h"

namespace exemplar {

template class MinimumCut<LatticeCut, LatticeLinks, std::int8_t>;

void LatticeCut::connect(int a, int b, int direction, std::int64_t cost, std::int64_t reverse) {
  nodes_[a].neighbor[direction] = b;
  nodes_[b].neighbor[opposite(direction)] = a;
  nodes_[a].residual[direction] = cost;
  nodes_[b].residual[opposite(direction)] = reverse;
}

}  // namespace exemplar
