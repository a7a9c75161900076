// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/patch_move.h"

#include <algorithm>
#include <cstdlib>

namespace exemplar {
namespace {

/// More than this is not one patch any more.
constexpr int kMostChanged = 2000;        // cells
constexpr std::size_t kMostInRim = 1000;  // cells
/// Wrong choices in the search for a rim's labels: those that are found at all are found soon.
constexpr std::int64_t kRimConflicts = 20;

int wrapped(int i, int n) { return ((i % n) + n) % n; }

/// The shorter way around.
int wrappedStep(int step, int n, bool periodic) {
  if (!periodic) return step;
  step = wrapped(step, n);
  return 2 * step > n ? step - n : step;
}

}  // namespace

PatchMove::PatchMove(const ModelProblem& problem, const LabelSets& base,
                     const LabelChooser& chooser, std::span<const PatchSource> sources)
    : problem_(problem),
      network_(problem.network()),
      base_(base),
      chooser_(chooser),
      sources_(sources),
      region_(problem.network(), base),
      images_(problem.options().symmetry.any()),
      words_(problem.network().words()) {
  for (const LabelSets& table : network_.support) support_.push_back(table.data());
  for (const CellOffset& o : problem.offsets()) {
    steps_.push_back({{o.x, o.y, o.z}, o.t});
    steps_.push_back({{-o.x, -o.y, -o.z}, -o.t});
  }
}

std::size_t PatchMove::local(const Vec3i& step, int frameStep) const {
  const ModelOptions& o = problem_.options();
  const int wide = 2 * window_.reach + 1;
  int z = window_.center.z + step.z, t = window_.frame + frameStep;
  if (z < 0 || z >= o.size.z) z = wrapped(z, o.size.z);
  if (t < 0 || t >= o.frames) t = wrapped(t, o.frames);
  const int column = (step.x + window_.reach) * wide + (step.y + window_.reach);
  return (static_cast<std::size_t>(column) * o.size.z + z) * o.frames + t;
}

bool PatchMove::inGrown(const Vec3i& step) const {
  const CellBox& g = patch_.grown;
  return step.x >= g.begin.x && step.x < g.end.x && step.y >= g.begin.y && step.y < g.end.y;
}

Label PatchMove::sourceLabel(const Vec3i& step, int frameStep) const {
  const PatchSource& source = sources_[alignment_.source];
  const Vec3i from = alignment_.cell + step;
  const int frame = alignment_.frame + frameStep;
  return source.contains(from, frame) ? source.at(from, frame) : SymmetryGroup::kNoImage;
}

/// Lets a cell take the source's label, or finds a conflict there.
void PatchMove::add(std::int32_t cell, const Vec3i& step, int frameStep) {
  const Label label = sourceLabel(step, frameStep);
  if (label >= network_.labels || !containsLabel(base_[cell], label)) {
    conflicts_.emplace_back(step, frameStep);
    return;
  }
  const std::size_t here = local(step, frameStep);
  changed_ += label != labels_[cell];
  stamp_[here] = now_;
  member_[here] = static_cast<std::uint32_t>(members_.size());
  members_.push_back({cell, label, step, frameStep});
}

/// Looks across one link of a cell that takes the source's `label`.
void PatchMove::across(std::int32_t to, int relation, Label label, const Vec3i& step,
                       int frameStep) {
  const LabelWord* allowed = support_[relation] + static_cast<std::size_t>(label) * words_;
  const auto allows = [&](Label other) { return allowed[other / 64] >> (other % 64) & 1; };
  const bool in = inGrown(step);
  if (in) {
    const std::size_t there = local(step, frameStep);
    if (stamp_[there] == now_) {
      // Of a source that the request does not suit two labels may exclude each other.
      if (!allows(members_[member_[there]].label)) conflicts_.emplace_back(step, frameStep);
      return;
    }
  }
  if (allows(labels_[to])) return;
  if (!in) {
    conflicts_.emplace_back(step, frameStep);
    return;
  }
  const std::size_t before = members_.size();
  add(to, step, frameStep);
  if (members_.size() > before && !allows(members_.back().label))
    conflicts_.emplace_back(step, frameStep);
}

void PatchMove::stepTo(std::int32_t cell, Vec3i& step, int& frameStep) const {
  const ModelOptions& o = problem_.options();
  const std::int64_t at = problem_.positionOf(cell);
  const Vec3i d = problem_.cellAt(at) - window_.center;
  for (int axis = 0; axis < 3; ++axis)
    step[axis] = wrappedStep(d[axis], o.size[axis], o.periodic[axis]);
  frameStep = wrappedStep(problem_.frameAt(at) - window_.frame, o.frames, o.loop);
}

void PatchMove::follow(std::size_t number) {
  const Member member = members_[number];
  const auto near = network_.neighbors(member.cell);
  for (int s = 0; s < network_.slots; ++s) {
    const std::int32_t n = near[s];
    if (n == network_.cells) continue;
    Vec3i step = member.step + steps_[s].first;
    int frameStep = member.frameStep + steps_[s].second;
    if (images_) stepTo(n, step, frameStep);
    across(n, s, member.label, step, frameStep);
  }
  for (const LabelNetwork::Link& l : network_.linksOf(member.cell)) {
    Vec3i step;
    int frameStep = 0;
    stepTo(l.cell, step, frameStep);
    across(l.cell, l.relation, member.label, step, frameStep);
  }
}

void PatchMove::findMembers() {
  const ModelOptions& o = problem_.options();
  members_.clear();
  conflicts_.clear();
  changed_ = 0;
  const std::size_t wide = 2 * static_cast<std::size_t>(window_.reach) + 1;
  const std::size_t places = wide * wide * o.size.z * o.frames;
  if (places > stamp_.size() || ++now_ == 0) {
    stamp_.assign(places, 0);
    member_.resize(places);
    now_ = 1;
  }
  // Cells that have the source's label are at fault with nothing: they are not followed.
  const PatchSource& source = sources_[alignment_.source];
  const CellBox& core = patch_.core;
  Vec3i step;
  for (step.x = core.begin.x; step.x < core.end.x; ++step.x) {
    for (step.y = core.begin.y; step.y < core.end.y; ++step.y) {
      Vec3i p{window_.center.x + step.x, window_.center.y + step.y, 0};
      if (o.periodic.x) p.x = wrapped(p.x, o.size.x);
      if (o.periodic.y) p.y = wrapped(p.y, o.size.y);
      if (p.x < 0 || p.y < 0 || p.x >= o.size.x || p.y >= o.size.y) continue;
      for (step.z = core.begin.z; step.z < core.end.z; ++step.z) {
        const Vec3i from = alignment_.cell + step;
        if (!source.contains(from, alignment_.frame)) continue;
        p.z = window_.center.z + step.z;
        if (o.periodic.z) p.z = wrapped(p.z, o.size.z);
        if (p.z < 0 || p.z >= o.size.z) continue;
        const std::int64_t at = problem_.position(p, window_.frame);
        const std::int32_t cell = problem_.cell(at);
        if (cell < 0 || (images_ && problem_.positionOf(cell) != at)) continue;
        const Label label = source.at(from, alignment_.frame);
        if (label == labels_[cell] || label == SymmetryGroup::kNoImage) continue;
        if (stamp_[local(step, 0)] != now_) add(cell, step, 0);
      }
    }
  }
  for (std::size_t m = 0; m < members_.size(); ++m) {
    if (changed_ > kMostChanged || static_cast<int>(conflicts_.size()) > patch_.mostConflicts)
      return;
    follow(m);
  }
}

/// The cells near conflicts, ascending.
void PatchMove::findRim() {
  const ModelOptions& o = problem_.options();
  const int wide = 2 * window_.reach + 1, rim = patch_.rim;
  const int words = (o.size.z + 63) / 64;
  // A bit for each height of each column.
  marked_.assign(static_cast<std::size_t>(wide) * wide * words, 0);
  heights_.assign(static_cast<std::size_t>(words), 0);
  for (const auto& [step, frameStep] : conflicts_) {
    const int x = step.x + window_.reach, y = step.y + window_.reach;
    const int z = window_.center.z + step.z;
    std::fill(heights_.begin(), heights_.end(), 0);
    for (int k = z - rim; k <= z + rim; ++k) {
      if (!o.periodic.z && (k < 0 || k >= o.size.z)) continue;
      const int height = wrapped(k, o.size.z);
      heights_[height / 64] |= std::uint64_t{1} << (height % 64);
    }
    for (int i = std::max(x - rim, 0); i <= std::min(x + rim, wide - 1); ++i) {
      for (int j = std::max(y - rim, 0); j <= std::min(y + rim, wide - 1); ++j) {
        std::uint64_t* column = marked_.data() + (static_cast<std::size_t>(i) * wide + j) * words;
        for (int w = 0; w < words; ++w) column[w] |= heights_[w];
      }
    }
  }
  rim_.clear();
  for (int i = 0; i < wide; ++i) {
    Vec3i p{window_.center.x + i - window_.reach, 0, 0};
    if (o.periodic.x) p.x = wrapped(p.x, o.size.x);
    if (p.x < 0 || p.x >= o.size.x) continue;
    for (int j = 0; j < wide; ++j) {
      p.y = window_.center.y + j - window_.reach;
      if (o.periodic.y) p.y = wrapped(p.y, o.size.y);
      if (p.y < 0 || p.y >= o.size.y) continue;
      const std::uint64_t* column =
          marked_.data() + (static_cast<std::size_t>(i) * wide + j) * words;
      forEachLabel({column, static_cast<std::size_t>(words)}, [&](int z) {
        p.z = z;
        for (int t = 0; t < o.frames; ++t) {
          const int cell = problem_.cell(problem_.position(p, t));
          if (cell >= 0) rim_.push_back(cell);
        }
      });
    }
  }
  if (images_ || o.periodic.any()) {
    std::sort(rim_.begin(), rim_.end());
    rim_.erase(std::unique(rim_.begin(), rim_.end()), rim_.end());
  }
}

bool PatchMove::closeRim(const Random& random, std::vector<Before>& before,
                         const Progress& progress) {
  findRim();
  if (rim_.empty() || rim_.size() > kMostInRim) return false;
  if (!region_.takeBack(rim_, labels_, progress)) return false;
  RegionChoice choice{random};
  choice.choose = [&](const Random& numbers, int cell, std::span<const LabelWord> set, int draw) {
    // That is the source's where it could be put in.
    if (containsLabel(set, labels_[cell])) return static_cast<int>(labels_[cell]);
    Vec3i step;
    int frameStep = 0;
    stepTo(cell, step, frameStep);
    const Label shown = sourceLabel(step, frameStep);
    if (shown < network_.labels && containsLabel(set, shown)) return static_cast<int>(shown);
    return chooser_.choose(numbers, cell, set, draw, region_.placed());
  };
  const RegionEffort effort{
      .passes = 0, .searches = 1, .searchConflicts = kRimConflicts, .exactConflicts = 0};
  if (region_.relabel(effort, choice, progress) != exemplar::Outcome::Complete) return false;
  for (int i = 0; i < region_.count(); ++i) {
    const int cell = region_.cells()[i];
    if (region_.label(i) != labels_[cell]) before.push_back({cell, labels_[cell]});
  }
  region_.keep(labels_);
  return true;
}

PatchMove::Outcome PatchMove::make(const Window& window, const Alignment& alignment,
                                   const Patch& patch, const Random& random,
                                   std::span<Label> labels, std::vector<Before>& before,
                                   const std::function<bool()>& worth, const Progress& progress) {
  window_ = window;
  alignment_ = alignment;
  patch_ = patch;
  labels_ = labels;
  before.clear();
  findMembers();
  if (changed_ == 0 || changed_ > kMostChanged) return Outcome::Nothing;
  if (static_cast<int>(conflicts_.size()) > patch_.mostConflicts) return Outcome::Conflict;
  for (const Member& m : members_) {
    if (labels_[m.cell] == m.label) continue;
    before.push_back({m.cell, labels_[m.cell]});
    labels_[m.cell] = m.label;
  }
  if (conflicts_.empty() || (worth() && closeRim(random, before, progress))) return Outcome::Made;
  for (const Before& b : before) labels_[b.cell] = b.label;
  before.clear();
  return Outcome::Conflict;
}

}  // namespace exemplar
