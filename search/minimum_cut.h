// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

#include "core/progress.h"

namespace exemplar {

/// A minimum cut of a graph: which side each node is on where the capacities cut are least.
///
/// The maximum flow is found by two search trees that meet (Boykov, Kolmogorov: "An experimental
/// comparison of min-cut/max-flow algorithms for energy minimization in vision", IEEE TPAMI 26(9),
/// 2004, doi:10.1109/TPAMI.2004.60, section 3). Capacities are integers, so the answer is exact and
/// the same everywhere, whatever the order of nodes and edges. Nearly linear in practice on the
/// graphs of seams.
///
/// How nodes are linked is the business of `Graph`, which derives from it: a node has directions
/// 0 .. degree(n) - 1; `Links` are what a node holds for that, `Direction` a signed integer type
/// that holds them. A graph has
///     int degree(int node) const;
///     int neighbor(int node, int direction) const;      // -1 for none
///     std::int64_t& residual(int node, int direction);  // what may still flow that way
///     Direction opposite(int node, int direction) const;  // the way back, at the neighbor
template <class Graph, class Links, class Direction>
class MinimumCut {
 public:
  /// What it costs to have `node` on the second side less what it costs on the first; adds up.
  void addTerminal(int node, std::int64_t secondLessFirst) {
    nodes_[node].terminal += secondLessFirst;
  }

  /// Finds the cut. Once. Throws `Cancelled`.
  void solve(const Progress& progress = {});

  /// After `solve`: whether the node is on the second side. Of several least cuts it is the one
  /// with the fewest nodes there.
  bool onSecondSide(int node) const { return nodes_[node].tree == kSecond; }

 protected:
  explicit MinimumCut(int nodes) : nodes_(static_cast<std::size_t>(nodes)) {}

  static constexpr std::uint8_t kFree = 0, kFirst = 1, kSecond = 2;
  static constexpr Direction kNoParent = -1, kTerminal = std::numeric_limits<Direction>::max();

  struct Node : Links {
    std::int64_t terminal = 0;             ///< > 0: from the first terminal, < 0: to the second
    std::int32_t distance = 0, stamp = 0;  ///< to the terminal, when that was known
    Direction parent = kNoParent;          ///< direction, or the terminal
    std::uint8_t tree = kFree;
    bool active = false;
  };
  std::vector<Node> nodes_;

 private:
  Graph& graph() { return static_cast<Graph&>(*this); }

  void activate(int node) {
    if (nodes_[node].active) return;
    nodes_[node].active = true;
    active_.push_back(node);
  }
  /// What may still flow from a tree's node `from` in `direction`, in the tree's sense.
  std::int64_t growable(int from, int direction) {
    if (nodes_[from].tree == kFirst) return graph().residual(from, direction);
    return graph().residual(graph().neighbor(from, direction), graph().opposite(from, direction));
  }
  /// What may still flow between a tree's node and its neighbor, from the tree's terminal's side.
  std::int64_t open(int node, int up, int direction) {
    return nodes_[node].tree == kFirst ? graph().residual(up, graph().opposite(node, direction))
                                       : graph().residual(node, direction);
  }
  void orphan(int node) {
    nodes_[node].parent = kNoParent;
    orphans_.push_back(node);
  }
  void augment(int first, int direction);
  void adopt(int node);
  /// The number of steps to the terminal, or -1 where the chain of parents is broken.
  int distanceToTerminal(int node);

  std::deque<int> active_, orphans_;
  std::int32_t time_ = 0;
};

template <class Graph, class Links, class Direction>
void MinimumCut<Graph, Links, Direction>::augment(int first, int direction) {
  Graph& g = graph();
  const int second = g.neighbor(first, direction);
  std::int64_t flow = g.residual(first, direction);
  for (int n = first;;) {
    const Node& node = nodes_[n];
    if (node.parent == kTerminal) {
      flow = std::min(flow, node.terminal);
      break;
    }
    const int up = g.neighbor(n, node.parent);
    flow = std::min(flow, g.residual(up, g.opposite(n, node.parent)));
    n = up;
  }
  for (int n = second;;) {
    const Node& node = nodes_[n];
    if (node.parent == kTerminal) {
      flow = std::min(flow, -node.terminal);
      break;
    }
    flow = std::min(flow, g.residual(n, node.parent));
    n = g.neighbor(n, node.parent);
  }

  g.residual(second, g.opposite(first, direction)) += flow;
  g.residual(first, direction) -= flow;
  for (int n = first;;) {
    Node& node = nodes_[n];
    if (node.parent == kTerminal) {
      node.terminal -= flow;
      if (node.terminal == 0) orphan(n);
      break;
    }
    const int up = g.neighbor(n, node.parent);
    std::int64_t& residual = g.residual(up, g.opposite(n, node.parent));
    residual -= flow;
    g.residual(n, node.parent) += flow;
    if (residual == 0) orphan(n);
    n = up;
  }
  for (int n = second;;) {
    Node& node = nodes_[n];
    if (node.parent == kTerminal) {
      node.terminal += flow;
      if (node.terminal == 0) orphan(n);
      break;
    }
    const int up = g.neighbor(n, node.parent);
    g.residual(up, g.opposite(n, node.parent)) += flow;
    std::int64_t& residual = g.residual(n, node.parent);
    residual -= flow;
    if (residual == 0) orphan(n);
    n = up;
  }
}

template <class Graph, class Links, class Direction>
int MinimumCut<Graph, Links, Direction>::distanceToTerminal(int start) {
  int steps = 0;
  for (int n = start;; ++steps) {
    const Node& node = nodes_[n];
    if (node.stamp == time_) {
      steps += node.distance;
      break;
    }
    if (node.parent == kNoParent) return -1;
    if (node.parent == kTerminal) {
      ++steps;
      break;
    }
    n = graph().neighbor(n, node.parent);
  }
  int left = steps;
  for (int n = start; nodes_[n].stamp != time_; --left) {
    nodes_[n].stamp = time_;
    nodes_[n].distance = left;
    if (nodes_[n].parent == kTerminal) break;
    n = graph().neighbor(n, nodes_[n].parent);
  }
  return steps;
}

template <class Graph, class Links, class Direction>
void MinimumCut<Graph, Links, Direction>::adopt(int orphaned) {
  Graph& g = graph();
  Node& node = nodes_[orphaned];
  const int degree = g.degree(orphaned);
  int best = std::numeric_limits<int>::max();
  Direction parent = kNoParent;
  for (int d = 0; d < degree; ++d) {
    const int up = g.neighbor(orphaned, d);
    if (up < 0 || nodes_[up].tree != node.tree || open(orphaned, up, d) <= 0) continue;
    const int distance = distanceToTerminal(up);
    if (distance >= 0 && distance < best) {
      best = distance;
      parent = static_cast<Direction>(d);
    }
  }
  if (parent != kNoParent) {
    node.parent = parent;
    node.stamp = time_;
    node.distance = best + 1;
    return;
  }
  for (int d = 0; d < degree; ++d) {
    const int next = g.neighbor(orphaned, d);
    if (next < 0 || nodes_[next].tree != node.tree) continue;
    if (open(orphaned, next, d) > 0) activate(next);
    if (nodes_[next].parent == g.opposite(orphaned, d)) orphan(next);
  }
  node.tree = kFree;
}

template <class Graph, class Links, class Direction>
void MinimumCut<Graph, Links, Direction>::solve(const Progress& progress) {
  Graph& g = graph();
  for (int n = 0; n < static_cast<int>(nodes_.size()); ++n) {
    Node& node = nodes_[n];
    if (node.terminal == 0) continue;
    node.tree = node.terminal > 0 ? kFirst : kSecond;
    node.parent = kTerminal;
    node.distance = 1;
    activate(n);
  }
  constexpr std::uint32_t kChecked = 1 << 14;  // steps between checks
  for (std::uint32_t step = 0; !active_.empty(); ++step) {
    if (step % kChecked == 0) progress.check();
    const int n = active_.front();
    if (nodes_[n].tree == kFree) {
      active_.pop_front();
      nodes_[n].active = false;
      continue;
    }
    int first = -1, direction = -1;
    const int degree = g.degree(n);
    for (int d = 0; d < degree && first < 0; ++d) {
      const int next = g.neighbor(n, d);
      if (next < 0 || growable(n, d) <= 0) continue;
      Node& other = nodes_[next];
      if (other.tree == kFree) {
        other.tree = nodes_[n].tree;
        other.parent = g.opposite(n, d);
        other.distance = nodes_[n].distance + 1;
        other.stamp = nodes_[n].stamp;
        activate(next);
      } else if (other.tree != nodes_[n].tree) {
        first = nodes_[n].tree == kFirst ? n : next;
        direction = nodes_[n].tree == kFirst ? d : g.opposite(n, d);
      }
    }
    if (first < 0) {
      active_.pop_front();
      nodes_[n].active = false;
      continue;
    }
    ++time_;
    augment(first, direction);
    while (!orphans_.empty()) {
      const int orphaned = orphans_.front();
      orphans_.pop_front();
      adopt(orphaned);
    }
  }
}

}  // namespace exemplar
