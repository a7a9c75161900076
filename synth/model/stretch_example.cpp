// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/stretch_example.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "core/cells.h"
#include "core/random.h"
#include "synth/model/patch_alignment.h"
#include "synth/model/start.h"

namespace exemplar {
namespace {

/// The order of planes along one axis.
class PlaneOrder {
 public:
  PlaneOrder(const ModelProblem& problem, const LabelGrid& example, int axis)
      : problem_(problem),
        example_(example),
        axis_(axis),
        planes_(example.size()[axis]),
        length_(problem.options().size[axis]) {}

  /// Empty where there is none.
  std::vector<int> find(Draws& draws, const Progress& progress) {
    findFollowers();
    if (axis_ == 2 && problem_.heightsDiffer()) {
      if (std::vector<int> upright = uprightOrder(); !upright.empty()) return upright;
    }
    // Where a side is to be like the example's but need not, that is tried first.
    for (const bool strict : {true, false}) {
      strict_ = strict;
      if (std::vector<int> order = findBetweenEnds(draws, progress); !order.empty()) return order;
    }
    return {};
  }

 private:
  void findFollowers();
  std::vector<int> findBetweenEnds(Draws& draws, const Progress& progress);
  std::vector<int> uprightOrder() const;
  void findWaysToEnd(int first);
  std::vector<int> walk(int first, Draws& draws) const;
  bool follows(int p, int q) const { return follows_[p * planes_ + q] != 0; }
  /// Whether the last plane can be reached in so many steps.
  bool mayEnd(int steps, int p) const { return ends_[steps * planes_ + p] != 0; }
  bool allowedAt(int plane, int end) const;
  template <class Visit>
  void forEachInPlane(int plane, const Visit& visit) const {
    CellBox box = CellBox::of(example_.size());
    box.begin[axis_] = plane;
    box.end[axis_] = plane + 1;
    forEachCell(box, visit);
  }

  const ModelProblem& problem_;
  const LabelGrid& example_;
  const int axis_, planes_, length_;
  bool strict_ = true;
  std::vector<std::uint8_t> follows_, ends_;
};

bool PlaneOrder::allowedAt(int plane, int end) const {
  const ModelOptions& o = problem_.options();
  const int side = 2 * axis_ + end;
  const SideRule& rule = o.sides[side];
  if (strict_ && rule.kind == SideRule::Kind::Open && !o.periodic[axis_])
    return plane == (end == 0 ? 0 : planes_ - 1);
  if (o.periodic[axis_] || !rule.excludes()) return true;
  const std::vector<Label>& list =
      rule.kind == SideRule::Kind::Example ? problem_.adjacency().sides[side] : rule.labels;
  bool all = true;
  forEachInPlane(plane, [&](const Vec3i& p) {
    all = all && std::ranges::find(list, example_.cells[p]) != list.end();
  });
  return all;
}

void PlaneOrder::findFollowers() {
  follows_.assign(static_cast<std::size_t>(planes_) * planes_, 0);
  const auto& offsets = problem_.offsets();
  for (std::size_t r = 0; r < offsets.size(); ++r) {
    const CellOffset& o = offsets[r];
    const Vec3i step{o.x, o.y, o.z};
    if (std::abs(step[axis_]) != 1) continue;
    const LabelSets& allowed = problem_.network().support[2 * r + (step[axis_] < 0)];
    for (int p = 0; p < planes_; ++p) {
      for (int q = 0; q < planes_; ++q) {
        bool all = true;
        forEachInPlane(p, [&](Vec3i cell) {
          if (!all) return;
          const Label here = example_.cells[cell];
          cell[axis_] = q;
          all = containsLabel(allowed[here], example_.cells[cell]);
        });
        follows_[p * planes_ + q] = all;
      }
    }
  }
}

std::vector<int> PlaneOrder::findBetweenEnds(Draws& draws, const Progress& progress) {
  std::vector<int> firsts;
  for (int p = 0; p < planes_; ++p)
    if (allowedAt(p, 0)) firsts.push_back(p);
  for (std::size_t i = firsts.size(); i > 1; --i)  // any of them may do
    std::swap(firsts[i - 1], firsts[draws.below(static_cast<int>(i))]);
  for (const int first : firsts) {
    progress.check();
    findWaysToEnd(first);
    if (mayEnd(length_ - 1, first)) return walk(first, draws);
  }
  return {};
}

/// The layers as they are, the uppermost again and again; empty where that cannot be.
std::vector<int> PlaneOrder::uprightOrder() const {
  std::vector<int> order;
  for (int z = 0; z < length_; ++z) order.push_back(std::min(z, planes_ - 1));
  for (int z = 1; z < length_; ++z)
    if (!follows(order[z - 1], order[z])) return {};
  if (!allowedAt(order.front(), 0) || !allowedAt(order.back(), 1)) return {};
  return order;
}

void PlaneOrder::findWaysToEnd(int first) {
  const bool periodic = problem_.options().periodic[axis_];
  ends_.assign(static_cast<std::size_t>(length_) * planes_, 0);
  for (int p = 0; p < planes_; ++p) ends_[p] = periodic ? follows(p, first) : allowedAt(p, 1);
  for (int steps = 1; steps < length_; ++steps) {
    for (int p = 0; p < planes_; ++p) {
      for (int q = 0; q < planes_; ++q)
        if (follows(p, q) && mayEnd(steps - 1, q)) ends_[steps * planes_ + p] = 1;
    }
  }
}

std::vector<int> PlaneOrder::walk(int first, Draws& draws) const {
  std::vector<int> order{first}, used(static_cast<std::size_t>(planes_), 0);
  used[first] = 1;
  std::vector<double> weights(static_cast<std::size_t>(planes_));
  constexpr double kGoOn = 4;  // how much rather the example's own order
  while (static_cast<int>(order.size()) < length_) {
    const int here = order.back(), steps = length_ - 1 - static_cast<int>(order.size());
    double all = 0;
    for (int q = 0; q < planes_; ++q) {
      const double seldom = 1.0 / (1 + used[q]);
      const bool may = follows(here, q) && mayEnd(steps, q);
      weights[q] = may ? seldom * seldom * (q == here + 1 ? kGoOn : 1) : 0;
      all += weights[q];
    }
    double at = draws.uniform() * all;
    int next = -1;
    for (int q = 0; q < planes_; ++q) {
      if (weights[q] == 0) continue;
      next = q;
      at -= weights[q];
      if (at < 0) break;
    }
    order.push_back(next);
    ++used[next];
  }
  return order;
}

}  // namespace

std::optional<std::vector<Label>> stretchExample(const ModelProblem& problem, const LabelSets& base,
                                                 const LabelChooser& chooser,
                                                 std::span<const LabelGrid> examples,
                                                 const Progress& progress) {
  const ModelOptions& o = problem.options();
  if (o.frames > 1 || o.symmetry.any() || !o.mask.empty()) return std::nullopt;
  for (const CellOffset& step : problem.offsets())
    if (std::abs(step.x) + std::abs(step.y) + std::abs(step.z) != 1) return std::nullopt;
  // Not those of tiles that are tried to begin with.
  const Random random = chooser.numbersFor(LabelChooser::Purpose::Start).fork(1 << 16);
  for (std::size_t e = 0; e < examples.size(); ++e) {
    Draws draws(random, e);
    std::array<std::vector<int>, 3> order;
    for (int axis = 0; axis < 3; ++axis) {
      order[axis] = PlaneOrder(problem, examples[e], axis).find(draws, progress);
      if (order[axis].empty()) break;
    }
    if (order[2].empty()) continue;
    std::vector<Label> labels(static_cast<std::size_t>(problem.network().cells));
    bool suits = true;
    for (int c = 0; c < problem.network().cells && suits; ++c) {
      const Vec3i p = problem.cellAt(problem.positionOf(c));
      labels[c] = examples[e].cells(order[0][p.x], order[1][p.y], order[2][p.z]);
      suits = containsLabel(base[c], labels[c]);
    }
    if (suits && consistent(problem.network(), labels)) return labels;
  }
  return std::nullopt;
}

}  // namespace exemplar
