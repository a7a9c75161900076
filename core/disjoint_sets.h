// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace exemplar {

/// Disjoint sets of the numbers 0, 1, 2, ..., joined one pair after another (union-find with path
/// halving). The smallest member represents its set, whatever the order of the joins.
/// Nearly O(1) a call.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count = 0) { reset(count); }
  /// Starts over with `count` numbers, each a set of its own; keeps the memory.
  void reset(std::size_t count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  /// How many numbers there are, not how many sets.
  std::size_t count() const { return parent_.size(); }

  /// Adds a number, a set of its own, and returns it.
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }
  /// The smallest member of the set of `a`.
  std::uint32_t find(std::uint32_t a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  /// Returns whether the two were in different sets until now.
  bool join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }
  /// The number of each member's set; sets are numbered 0, 1, ... in the order of their smallest
  /// members. `sets`, where not null, receives how many there are.
  std::vector<std::uint32_t> numbered(std::uint32_t* sets = nullptr) {
    std::vector<std::uint32_t> number(count());
    std::uint32_t found = 0;
    for (std::uint32_t a = 0; a < number.size(); ++a) {
      const std::uint32_t root = find(a);
      number[a] = root == a ? found++ : number[root];
    }
    if (sets) *sets = found;
    return number;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace exemplar
