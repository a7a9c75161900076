// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/patch_move.h"

#include <algorithm>
#include <cstdlib>

namespace exemplar {
namespace {

/// The shorter way around.
int wrappedStep(int step, int n, bool periodic) {
  if (!periodic) return step;
  step = ((step % n) + n) % n;
  return 2 * step > n ? step - n : step;
}

}  // namespace

PatchMove::PatchMove(const ModelProblem& problem, const LabelSets& base,
                     std::span<const PatchSource> sources)
    : problem_(problem),
      network_(problem.network()),
      base_(base),
      sources_(sources),
      images_(problem.options().symmetry.any()) {}

std::size_t PatchMove::local(const Vec3i& step, int frameStep) const {
  const ModelOptions& o = problem_.options();
  const int wide = 2 * window_.reach + 1;
  const int z = ((window_.center.z + step.z) % o.size.z + o.size.z) % o.size.z;
  const int t = ((window_.frame + frameStep) % o.frames + o.frames) % o.frames;
  return ((static_cast<std::size_t>(step.x + window_.reach) * wide + (step.y + window_.reach)) *
              o.size.z +
          z) *
             o.frames +
         t;
}

/// Adds a cell to the set, if it is not in it: Impossible where it cannot have the source's label.
PatchMove::Added PatchMove::add(std::int32_t cell, const Vec3i& step, int frameStep) {
  if (step.x < grown_.begin.x || step.x >= grown_.end.x || step.y < grown_.begin.y || step.y >= grown_.end.y)
    return Added::Impossible;
  const std::size_t here = local(step, frameStep);
  if (stamp_[here] == now_) return Added::No;
  const PatchSource& source = sources_[alignment_.source];
  const Vec3i from = alignment_.cell + step;
  const int frame = alignment_.frame + frameStep;
  if (!source.contains(from, frame)) return Added::Impossible;
  const Label label = source.at(from, frame);
  if (label >= network_.labels || !containsLabel(base_[cell], label)) return Added::Impossible;
  if (label != labels_[cell] && ++changed_ > most_) return Added::Impossible;
  stamp_[here] = now_;
  member_[here] = static_cast<std::uint32_t>(members_.size());
  members_.push_back({cell, label, step, frameStep});
  return Added::Yes;
}

/// Looks across one link: what stands there must suit, or comes along.
bool PatchMove::reach(std::int32_t to, int relation, Label label, const Vec3i& step,
                      int frameStep) {
  const auto allowed = network_.support[relation][label];
  if (std::abs(step.x) <= window_.reach && std::abs(step.y) <= window_.reach) {
    const std::size_t there = local(step, frameStep);
    if (stamp_[there] == now_) {
      if (!containsLabel(allowed, members_[member_[there]].label)) conflicts_.push_back({to, 0, step, frameStep});
      return true;
    }
  }
  if (containsLabel(allowed, labels_[to])) return true;
  if (add(to, step, frameStep) == Added::Impossible || !containsLabel(allowed, members_.back().label))
    conflicts_.push_back({to, 0, step, frameStep});
  return true;
}

bool PatchMove::follow(std::size_t number) {
  const Member member = members_[number];
  const auto near = network_.neighbors(member.cell);
  const auto stepTo = [&](std::int32_t cell, Vec3i& step, int& frameStep) {
    const ModelOptions& o = problem_.options();
    const std::int64_t at = problem_.positionOf(cell);
    const Vec3i d = problem_.cellAt(at) - window_.center;
    for (int axis = 0; axis < 3; ++axis)
      step[axis] = wrappedStep(d[axis], o.size[axis], o.periodic[axis]);
    frameStep = wrappedStep(problem_.frameAt(at) - window_.frame, o.frames, o.loop);
  };
  for (int s = 0; s < network_.slots; ++s) {
    const std::int32_t n = near[s];
    if (n == network_.cells) continue;
    const CellOffset& o = problem_.offsets()[s / 2];
    const int sign = s % 2 ? -1 : 1;
    Vec3i step = member.step + Vec3i{o.x, o.y, o.z} * sign;
    int frameStep = member.frameStep + o.t * sign;
    if (images_) stepTo(n, step, frameStep);
    if (!reach(n, s, member.label, step, frameStep)) return false;
  }
  for (const LabelNetwork::Link& l : network_.linksOf(member.cell)) {
    Vec3i step;
    int frameStep = 0;
    stepTo(l.cell, step, frameStep);
    if (!reach(l.cell, l.relation, member.label, step, frameStep)) return false;
  }
  return true;
}

bool PatchMove::close(const Window& window, const Alignment& alignment, const CellBox& core,
                      const CellBox& grown, std::span<const Label> labels, int most) {
  grown_ = grown;
  conflicts_.clear();
  const ModelOptions& o = problem_.options();
  window_ = window;
  alignment_ = alignment;
  labels_ = labels;
  changed_ = 0;
  most_ = most;
  members_.clear();
  const std::size_t wide = 2 * static_cast<std::size_t>(window.reach) + 1;
  const std::size_t places = wide * wide * o.size.z * o.frames;
  if (places > stamp_.size()) {
    stamp_.assign(places, 0);
    member_.resize(places);
    now_ = 0;
  }
  if (++now_ == 0) {
    std::fill(stamp_.begin(), stamp_.end(), 0);
    now_ = 1;
  }
  const PatchSource& source = sources_[alignment.source];
  bool possible = true;
  forEachCell(core, [&](const Vec3i& step) {
    if (!possible || !source.contains(alignment.cell + step, alignment.frame)) return;
    Vec3i p = window.center + step;
    for (int axis = 0; axis < 3; ++axis) {
      const int n = o.size[axis];
      if (o.periodic[axis]) p[axis] = ((p[axis] % n) + n) % n;
      if (p[axis] < 0 || p[axis] >= n) return;
    }
    const std::int64_t at = problem_.position(p, window.frame);
    const std::int32_t cell = problem_.cell(at);
    if (cell < 0 || (images_ && problem_.positionOf(cell) != at)) return;
    add(cell, step, 0);
  });
  for (std::size_t m = 0; possible && m < members_.size(); ++m) possible = follow(m) && changed_ <= most_ && conflicts_.size() < 200;
  return possible && changed_ > 0;
}

}  // namespace exemplar
