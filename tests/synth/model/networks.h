// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/random.h"
#include "synth/model/catalog.h"
#include "synth/model/problem.h"

namespace exemplar::test {

/// Rules in which each ordered pair of labels is allowed along each of x and y (and z) with a
/// chance.
inline Adjacency randomAdjacency(int labels, double chance, std::uint64_t seed, int axes = 2) {
  const Random random(seed, 77);
  Adjacency a;
  a.labelCount = labels;
  a.frequency.assign(labels, 1);
  for (int axis = 0; axis < 3; ++axis) {
    CellOffset o;
    (axis == 0 ? o.x : axis == 1 ? o.y : o.z) = 1;
    PairRule rule{o, {}};
    for (int b = 0; b < labels && axis < axes; ++b) {
      for (int c = 0; c < labels; ++c) {
        const std::uint64_t cell = (axis * 64u + b) * 64u + c;
        if (random.uniform(cell) < chance) {
          rule.pairs.push_back({static_cast<Label>(b), static_cast<Label>(c), 1});
        }
      }
    }
    if (axis < axes && rule.pairs.empty()) rule.pairs.push_back({0, 0, 1});
    a.rules.push_back(rule);
  }
  return a;
}

/// A grid in which each label occurs once: an example in name, for rules made by hand.
inline LabelGrid gridOfLabels(int labels) {
  LabelGrid grid;
  grid.cells = Array3D<Label>({labels, 1, 1});
  for (int b = 0; b < labels; ++b) grid.cells(b, 0, 0) = static_cast<Label>(b);
  grid.labels.resize(labels);
  return grid;
}

inline ModelOptions freeOptions(const Vec3i& size) {
  ModelOptions o;
  o.size = size;
  for (SideRule& s : o.sides) s.kind = SideRule::Kind::Free;
  return o;
}

/// Whether `labels` meets every rule: straight from the rules, without the solver's tables.
inline bool allowedByRules(const Adjacency& a, const Array3D<Label>& labels) {
  for (std::size_t i = 0; i < labels.count(); ++i) {
    const Vec3i p = labels.ijk(i);
    for (const PairRule& r : a.rules) {
      const Vec3i q = p + Vec3i{r.offset.x, r.offset.y, r.offset.z};
      if (labels.contains(q) && !r.allows(labels[p], labels[q])) return false;
    }
  }
  return true;
}

/// Arc-consistent sets by repeating the definition (statement 3.6) until nothing changes; true
/// where no set is empty. `sets[cell][label]`.
inline bool bruteForceConsistency(const LabelNetwork& network,
                                  std::vector<std::vector<bool>>& sets) {
  for (bool changed = true; changed;) {
    changed = false;
    for (int c = 0; c < network.cells; ++c) {
      for (int b = 0; b < network.labels; ++b) {
        if (!sets[c][b]) continue;
        bool supported = true;
        network.forEachNeighbor(c, [&](int n, int relation) {
          bool any = false;
          for (int l = 0; l < network.labels; ++l) {
            any = any || (sets[n][l] && containsLabel(network.support[relation][b], l));
          }
          supported = supported && any;
        });
        if (supported) continue;
        sets[c][b] = false;
        changed = true;
      }
    }
  }
  for (const auto& set : sets) {
    if (std::find(set.begin(), set.end(), true) == set.end()) return false;
  }
  return true;
}

/// Algorithm 3.1 as published: nothing is taken back. True where it finishes.
inline bool plainPass(const ModelProblem& problem, std::uint64_t seed) {
  const LabelNetwork& network = problem.network();
  const LabelSets start = problem.domains(problem.demands());
  Catalog catalog(network);
  for (int c = 0; c < network.cells; ++c) catalog.setDomain(c, start[c]);
  if (!catalog.propagateAll()) return false;
  const Random random(seed, 78);
  for (int c = 0; c < network.cells; ++c) {
    if (catalog.decided(c)) continue;
    int skip = static_cast<int>(random.below(labelsIn(catalog.domain(c)), c));
    int chosen = -1;
    forEachLabel(catalog.domain(c), [&](int b) {
      if (skip-- == 0) chosen = b;
    });
    if (!catalog.assign(c, chosen) || !catalog.propagate()) return false;
  }
  return true;
}

}  // namespace exemplar::test
