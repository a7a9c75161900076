// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/resemblance.h"

#include <map>

#include "core/cells.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kOutside = 0x10000;

Vec3i stepOf(int i) { return {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1}; }

}  // namespace

Resemblance::Resemblance(const ModelProblem& problem, std::span<const LabelGrid> examples,
                         const Progress& progress)
    : problem_(&problem), windows_(problem.network().labels) {
  std::map<std::array<std::uint32_t, kCells>, double> counts;
  for (const LabelGrid& e : examples) {
    forEachCell(e.size(), [&](const Vec3i& p) {
      if (p.x == 0) progress.check();
      std::array<std::uint32_t, kCells> window;
      for (int n = 0; n < kCells; ++n) {
        const Vec3i q = p + stepOf(n);
        window[n] = e.cells.contains(q) ? e.cells[q] : kOutside;
      }
      counts[window] += 1;
    });
  }
  for (const auto& [window, count] : counts) {
    windows_[window[kCells / 2]].push_back({window, count});
  }
}

std::vector<double> Resemblance::likeness(int cell, std::span<const LabelWord> labels,
                                          const std::function<int(int)>& placed) const {
  const ModelOptions& o = problem_->options();
  const std::int64_t at = problem_->positionOf(cell);
  const Vec3i p = problem_->cellAt(at);
  std::array<std::uint32_t, kCells> around;
  std::array<int, kCells> known;
  int count = 0;
  for (int n = 0; n < kCells; ++n) {
    if (n == kCells / 2) continue;
    Vec3i q = p + stepOf(n);
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) {
      if (o.periodic[axis]) q[axis] = (q[axis] + o.size[axis]) % o.size[axis];
      inside = inside && q[axis] >= 0 && q[axis] < o.size[axis];
    }
    if (!inside) continue;
    const std::int64_t there = problem_->position(q, problem_->frameAt(at));
    const int far = problem_->cell(there);
    const int label = far < 0 ? -1 : placed(far);
    if (label < 0) continue;
    around[n] = problem_->labelAt(there, static_cast<Label>(label));
    known[count++] = n;
  }

  std::vector<double> likeness(problem_->network().labels, 0.0);
  int least = kCells + 1;
  forEachLabel(labels, [&](int b) {
    for (const Window& w : windows_[b]) {
      int differ = 0;
      for (int i = 0; i < count && differ <= least; ++i) {
        differ += w.labels[known[i]] != around[known[i]];
      }
      if (differ > least) continue;
      if (differ < least) {
        std::fill(likeness.begin(), likeness.end(), 0.0);
        least = differ;
      }
      likeness[b] += w.count;
    }
  });
  return likeness;
}

}  // namespace exemplar
