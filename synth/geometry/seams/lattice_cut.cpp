// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/seams/lattice_cut.h"

#include <algorithm>
#include <limits>

namespace exemplar {

void LatticeCut::connect(int a, int b, int direction, std::int64_t cost, std::int64_t reverse) {
  nodes_[a].neighbor[direction] = b;
  nodes_[b].neighbor[opposite(direction)] = a;
  nodes_[a].residual[direction] = cost;
  nodes_[b].residual[opposite(direction)] = reverse;
}

void LatticeCut::activate(int node) {
  if (nodes_[node].active) return;
  nodes_[node].active = true;
  active_.push_back(node);
}

std::int64_t LatticeCut::growable(int from, int direction) const {
  const Node& node = nodes_[from];
  if (node.tree == kFirst) return node.residual[direction];
  return nodes_[node.neighbor[direction]].residual[opposite(direction)];
}

void LatticeCut::orphan(int node) {
  nodes_[node].parent = kNoParent;
  orphans_.push_back(node);
}

void LatticeCut::augment(int first, int direction) {
  const int second = nodes_[first].neighbor[direction];
  std::int64_t flow = nodes_[first].residual[direction];
  for (int n = first;;) {
    const Node& node = nodes_[n];
    if (node.parent == kTerminal) {
      flow = std::min(flow, node.terminal);
      break;
    }
    const int up = node.neighbor[node.parent];
    flow = std::min(flow, nodes_[up].residual[opposite(node.parent)]);
    n = up;
  }
  for (int n = second;;) {
    const Node& node = nodes_[n];
    if (node.parent == kTerminal) {
      flow = std::min(flow, -node.terminal);
      break;
    }
    flow = std::min(flow, node.residual[node.parent]);
    n = node.neighbor[node.parent];
  }

  nodes_[first].residual[direction] -= flow;
  nodes_[second].residual[opposite(direction)] += flow;
  for (int n = first;;) {
    Node& node = nodes_[n];
    if (node.parent == kTerminal) {
      node.terminal -= flow;
      if (node.terminal == 0) orphan(n);
      break;
    }
    const int up = node.neighbor[node.parent];
    std::int64_t& residual = nodes_[up].residual[opposite(node.parent)];
    residual -= flow;
    node.residual[node.parent] += flow;
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
    const int up = node.neighbor[node.parent];
    nodes_[up].residual[opposite(node.parent)] += flow;
    std::int64_t& residual = node.residual[node.parent];
    residual -= flow;
    if (residual == 0) orphan(n);
    n = up;
  }
}

int LatticeCut::distanceToTerminal(int start) {
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
    n = node.neighbor[node.parent];
  }
  int left = steps;
  for (int n = start; nodes_[n].stamp != time_; --left) {
    nodes_[n].stamp = time_;
    nodes_[n].distance = left;
    if (nodes_[n].parent == kTerminal) break;
    n = nodes_[n].neighbor[nodes_[n].parent];
  }
  return steps;
}

void LatticeCut::adopt(int orphaned) {
  Node& node = nodes_[orphaned];
  int best = std::numeric_limits<int>::max();
  std::int8_t parent = kNoParent;
  for (std::int8_t d = 0; d < 6; ++d) {
    const int up = node.neighbor[d];
    if (up < 0 || nodes_[up].tree != node.tree) continue;
    const bool open =
        node.tree == kFirst ? nodes_[up].residual[opposite(d)] > 0 : node.residual[d] > 0;
    if (!open) continue;
    const int distance = distanceToTerminal(up);
    if (distance >= 0 && distance < best) {
      best = distance;
      parent = d;
    }
  }
  if (parent != kNoParent) {
    node.parent = parent;
    node.stamp = time_;
    node.distance = best + 1;
    return;
  }
  for (int d = 0; d < 6; ++d) {
    const int next = node.neighbor[d];
    if (next < 0 || nodes_[next].tree != node.tree) continue;
    const bool open =
        node.tree == kFirst ? nodes_[next].residual[opposite(d)] > 0 : node.residual[d] > 0;
    if (open) activate(next);
    if (nodes_[next].parent == opposite(d)) orphan(next);
  }
  node.tree = kFree;
}

void LatticeCut::solve(const Progress& progress) {
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
    for (std::int8_t d = 0; d < 6 && first < 0; ++d) {
      const int next = nodes_[n].neighbor[d];
      if (next < 0 || growable(n, d) <= 0) continue;
      Node& other = nodes_[next];
      if (other.tree == kFree) {
        other.tree = nodes_[n].tree;
        other.parent = static_cast<std::int8_t>(opposite(d));
        other.distance = nodes_[n].distance + 1;
        other.stamp = nodes_[n].stamp;
        activate(next);
      } else if (other.tree != nodes_[n].tree) {
        first = nodes_[n].tree == kFirst ? n : next;
        direction = nodes_[n].tree == kFirst ? d : opposite(d);
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
