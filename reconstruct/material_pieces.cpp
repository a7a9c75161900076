// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/material_pieces.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/disjoint_sets.h"

namespace exemplar {
namespace {

constexpr int kRounds = 30;     // for single pieces, and for what has grown together
constexpr double kGain = 1e-9;  // a step must lower the sum by more than rounding

/// What a piece weighs under each material that its parts came with.
using Weights = std::vector<std::pair<std::uint32_t, double>>;

double weightOf(const Weights& weights, std::uint32_t material) {
  for (const auto& [m, weight] : weights)
    if (m == material) return weight;
  return 0;
}

void add(Weights& weights, std::uint32_t material, double weight) {
  for (auto& [m, sum] : weights) {
    if (m != material) continue;
    sum += weight;
    return;
  }
  weights.emplace_back(material, weight);
}

/// Pieces, or groups of them, with what they came with, what they have now, and their neighbors.
struct Graph {
  std::vector<Weights> came;
  std::vector<std::uint32_t> material;
  std::vector<MaterialJoint> joints;  // a < b, each pair once, in order
  std::vector<std::uint32_t> begin;   // of each node's entries in `around`
  std::vector<std::uint32_t> around;  // joints

  std::size_t count() const { return material.size(); }

  void connect() {
    for (MaterialJoint& joint : joints)
      if (joint.a > joint.b) std::swap(joint.a, joint.b);
    std::stable_sort(joints.begin(), joints.end(), [](const auto& x, const auto& y) {
      return std::tie(x.a, x.b) < std::tie(y.a, y.b);
    });
    std::size_t kept = 0;
    for (const MaterialJoint& joint : joints) {
      if (joint.a == joint.b) continue;
      if (kept > 0 && joints[kept - 1].a == joint.a && joints[kept - 1].b == joint.b) {
        joints[kept - 1].length += joint.length;
        joints[kept - 1].cost += joint.cost;
      } else {
        joints[kept++] = joint;
      }
    }
    joints.resize(kept);
    begin.assign(count() + 1, 0);
    for (const MaterialJoint& joint : joints) {
      ++begin[joint.a + 1];
      ++begin[joint.b + 1];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    around.resize(2 * joints.size());
    std::vector<std::uint32_t> at(begin.begin(), begin.end() - 1);
    for (std::uint32_t j = 0; j < joints.size(); ++j) {
      around[at[joints[j].a]++] = j;
      around[at[joints[j].b]++] = j;
    }
  }

  /// The neighbors' material that suits a node best, or its own.
  std::uint32_t best(std::uint32_t node) const {
    Weights gain = came[node];  // of having each material, over having none of them
    for (std::uint32_t e = begin[node]; e < begin[node + 1]; ++e) {
      const MaterialJoint& joint = joints[around[e]];
      add(gain, material[joint.a == node ? joint.b : joint.a], joint.cost);
    }
    std::uint32_t choice = material[node];
    double most = weightOf(gain, choice) + kGain;
    for (const auto& [m, sum] : gain) {
      if (sum <= most) continue;
      most = sum;
      choice = m;
    }
    return choice;
  }

  /// Lets nodes change one after another, the lightest first, until none gains by it.
  void settle() {
    std::vector<std::pair<double, std::uint32_t>> order(count());
    for (std::uint32_t n = 0; n < count(); ++n) {
      order[n] = {0, n};
      for (const auto& [m, weight] : came[n]) order[n].first += weight;
    }
    std::sort(order.begin(), order.end());
    std::vector<std::uint8_t> awake(count(), 1);
    for (int round = 0; round < kRounds; ++round) {
      bool changed = false;
      for (const auto& [weight, n] : order) {
        if (!awake[n]) continue;
        awake[n] = 0;
        const std::uint32_t choice = best(n);
        if (choice == material[n]) continue;
        material[n] = choice;
        changed = true;
        for (std::uint32_t e = begin[n]; e < begin[n + 1]; ++e) {
          const MaterialJoint& joint = joints[around[e]];
          awake[joint.a == n ? joint.b : joint.a] = 1;
        }
      }
      if (!changed) return;
    }
  }

  /// Which group each node falls into, numbered by the groups' first nodes; returns how many.
  std::uint32_t groups(std::vector<std::uint32_t>& group) const {
    DisjointSets sets(count());
    for (const MaterialJoint& joint : joints) {
      if (material[joint.a] != material[joint.b] || joint.cost < 0.5 * joint.length) continue;
      sets.join(joint.a, joint.b);
    }
    std::uint32_t found = 0;
    group = sets.numbered(&found);
    return found;
  }
};

}  // namespace

std::vector<std::uint32_t> settleMaterials(std::span<const MaterialPiece> pieces,
                                           std::span<const MaterialJoint> joints) {
  Graph graph;
  for (const MaterialPiece& piece : pieces) {
    graph.came.push_back({{piece.material, piece.weight}});
    graph.material.push_back(piece.material);
  }
  graph.joints.assign(joints.begin(), joints.end());
  graph.connect();
  Graph single = graph;
  std::vector<std::uint32_t> node(pieces.size()), group;  // of each piece
  std::iota(node.begin(), node.end(), 0u);
  for (int round = 0; round < kRounds; ++round) {
    graph.settle();
    const std::uint32_t count = graph.groups(group);
    if (count == graph.count()) break;
    Graph merged;
    merged.came.resize(count);
    merged.material.resize(count);
    for (std::uint32_t n = 0; n < graph.count(); ++n) {
      for (const auto& [m, weight] : graph.came[n]) add(merged.came[group[n]], m, weight);
      merged.material[group[n]] = graph.material[n];
    }
    for (MaterialJoint joint : graph.joints) {
      joint.a = group[joint.a];
      joint.b = group[joint.b];
      merged.joints.push_back(joint);
    }
    merged.connect();
    for (std::uint32_t& n : node) n = group[n];
    graph = std::move(merged);
  }
  for (std::size_t p = 0; p < pieces.size(); ++p) single.material[p] = graph.material[node[p]];
  single.settle();  // for pieces that were moved with a group and suit it no longer
  return single.material;
}

}  // namespace exemplar
