// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/patch_move.h"

#include <algorithm>
#include <cstdlib>

#include "core/disjoint_sets.h"

namespace exemplar {
namespace {

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
    for (const int sign : {1, -1})
      steps_.push_back({Vec3i{o.x, o.y, o.z} * sign, o.t * sign, support_[steps_.size()]});
    furthest_ = max(furthest_, Vec3i{std::abs(o.x), std::abs(o.y), std::abs(o.z)});
  }
  numbered_ = problem.positions() == problem.network().cells;
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
    conflicts_.push_back({step, frameStep, 0});
    return;
  }
  const std::size_t here = local(step, frameStep);
  changed_ += label != labels_[cell];
  implied_ += !patch_.core.contains(step);
  stamp_[here] = now_;
  member_[here] = static_cast<std::uint32_t>(members_.size());
  members_.push_back({cell, label, step, frameStep});
}

/// Looks across one link of a cell that takes the source's `label`.
void PatchMove::across(std::int32_t to, int relation, Label label, const Vec3i& step,
                       int frameStep) {
  const LabelWord* allowed = support_[relation] + static_cast<std::size_t>(label) * words_;
  const auto allows = [&](Label other) { return allowed[other / 64] >> (other % 64) & 1; };
  if (sound_.contains(step)) return;
  const bool in = inGrown(step);
  if (in) {
    const std::size_t there = local(step, frameStep);
    if (stamp_[there] == now_) {
      // Of a source that the request does not suit two labels may exclude each other.
      if (!allows(members_[member_[there]].label)) conflicts_.push_back({step, frameStep, 0});
      return;
    }
  }
  if (allows(labels_[to])) return;
  if (!in) {
    conflicts_.push_back({step, frameStep, 0});
    return;
  }
  const std::size_t before = members_.size();
  add(to, step, frameStep);
  if (members_.size() > before && !allows(members_.back().label))
    conflicts_.push_back({step, frameStep, 0});
}

void PatchMove::stepTo(std::int32_t cell, Vec3i& step, int& frameStep) const {
  const ModelOptions& o = problem_.options();
  const std::int64_t at = problem_.positionOf(cell);
  const Vec3i d = problem_.cellAt(at) - window_.center;
  for (int axis = 0; axis < 3; ++axis)
    step[axis] = wrappedStep(d[axis], o.size[axis], o.periodic[axis]);
  frameStep = wrappedStep(problem_.frameAt(at) - window_.frame, o.frames, o.loop);
}

void PatchMove::follow(const Member& member) {
  const auto near = network_.neighbors(member.cell);
  for (int s = 0; s < network_.slots; ++s) {
    const std::int32_t n = near[s];
    if (n == network_.cells) continue;
    Vec3i step = member.step + steps_[s].by;
    int frameStep = member.frameStep + steps_[s].frames;
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

void PatchMove::beginMembers() {
  const ModelOptions& o = problem_.options();
  members_.clear();
  conflicts_.clear();
  fromCore_.clear();
  changed_ = implied_ = 0;
  const std::size_t wide = 2 * static_cast<std::size_t>(window_.reach) + 1;
  const std::size_t places = wide * wide * o.size.z * o.frames;
  if (places > stamp_.size() || ++now_ == 0) {
    stamp_.assign(places, 0);
    member_.resize(places);
    now_ = 1;
  }
}

/// Lets the cells of the core take the source's labels, each by itself.
void PatchMove::addCore() {
  const ModelOptions& o = problem_.options();
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
}

/// The same where all pairs of the source are allowed, and the request leaves every cell of the
/// core the source's label: then pairs within the core are right, and only what is near its border
/// is looked at. False where that is not so.
bool PatchMove::addSoundCore() {
  const ModelOptions& o = problem_.options();
  const PatchSource& source = sources_[alignment_.source];
  if (!source.sound || images_ || o.frames > 1 || o.periodic.z) return false;
  const Vec3i& c = window_.center;
  CellBox core = patch_.core & CellBox{Vec3i{} - alignment_.cell, source.size - alignment_.cell};
  core.begin.z = std::max(core.begin.z, -c.z);
  core.end.z = std::min(core.end.z, o.size.z - c.z);
  for (int axis = 0; axis < 2; ++axis) {
    if (o.periodic[axis]) continue;
    core.begin[axis] = std::max(core.begin[axis], -c[axis]);
    core.end[axis] = std::min(core.end[axis], o.size[axis] - c[axis]);
  }
  if (core.empty()) return true;
  CellBox inner{core.begin + furthest_, core.end - furthest_};
  // Beyond the lowest and the highest layer there is nothing.
  if (core.begin.z == -c.z) inner.begin.z = core.begin.z;
  if (core.end.z == o.size.z - c.z) inner.end.z = core.end.z;
  sound_ = core;
  const int high = core.end.z - core.begin.z;
  Vec3i step{0, 0, core.begin.z};
  for (step.x = core.begin.x; step.x < core.end.x; ++step.x) {
    const int x = o.periodic.x ? wrapped(c.x + step.x, o.size.x) : c.x + step.x;
    for (step.y = core.begin.y; step.y < core.end.y; ++step.y) {
      const int y = o.periodic.y ? wrapped(c.y + step.y, o.size.y) : c.y + step.y;
      step.z = core.begin.z;
      const std::int64_t at = problem_.position({x, y, c.z + step.z});
      const Label* from = source.labels.data() + source.position(alignment_.cell + step, 0);
      if (numbered_ && std::equal(from, from + high, labels_.data() + at)) continue;
      const bool beside = step.x < inner.begin.x || step.x >= inner.end.x ||
                          step.y < inner.begin.y || step.y >= inner.end.y;
      for (int k = 0; k < high; ++k) {
        const std::int32_t cell = problem_.cell(at + k);
        if (cell < 0 || from[k] == labels_[cell]) continue;
        if (!containsLabel(base_[cell], from[k])) {
          sound_ = {};
          return false;
        }
        fromCore_.push_back({cell, from[k]});
        step.z = core.begin.z + k;
        if (!beside && step.z >= inner.begin.z && step.z < inner.end.z) continue;
        border_.push_back({cell, from[k], step, 0});
      }
    }
  }
  changed_ = static_cast<int>(fromCore_.size());
  return true;
}

void PatchMove::findMembers() {
  sound_ = {};
  border_.clear();
  beginMembers();
  if (addSoundCore()) {
    for (std::size_t m = 0; m < border_.size() && !tooMuch(); ++m) follow(border_[m]);
  } else {
    beginMembers();
    addCore();
  }
  for (std::size_t m = 0; m < members_.size() && !tooMuch(); ++m) follow(Member{members_[m]});
}

/// Conflicts whose rims meet are one group; groups come one after the other.
void PatchMove::groupConflicts() {
  DisjointSets sets(conflicts_.size());
  const int near = 2 * patch_.rim + 1;
  for (std::uint32_t a = 0; a < conflicts_.size(); ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      const Vec3i d = conflicts_[a].step - conflicts_[b].step;
      if (std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) <= near) sets.join(a, b);
    }
  }
  for (std::uint32_t a = 0; a < conflicts_.size(); ++a) conflicts_[a].group = sets.find(a);
  std::stable_sort(conflicts_.begin(), conflicts_.end(),
                   [](const Conflict& a, const Conflict& b) { return a.group < b.group; });
}

/// The cells near conflicts, ascending.
void PatchMove::findRim(std::span<const Conflict> conflicts, int rim) {
  const ModelOptions& o = problem_.options();
  const int wide = 2 * window_.reach + 1;
  const int words = (o.size.z + 63) / 64;
  // A bit for each height of each column.
  marked_.assign(static_cast<std::size_t>(wide) * wide * words, 0);
  heights_.assign(static_cast<std::size_t>(words), 0);
  for (const Conflict& c : conflicts) {
    const Vec3i& step = c.step;
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

bool PatchMove::closeRims(const Random& random, std::vector<Before>& before,
                          const Progress& progress) {
  groupConflicts();
  std::uint64_t attempt = 0;
  for (std::size_t first = 0, last = 0; first < conflicts_.size(); first = last) {
    while (last < conflicts_.size() && conflicts_[last].group == conflicts_[first].group) ++last;
    const std::span<const Conflict> group(conflicts_.data() + first, last - first);
    bool closed = false;
    const int widest = std::max(patch_.rim, patch_.widestRim);
    for (int rim = patch_.rim; !closed && rim <= widest; rim += rim / 2 + 1) {
      findRim(group, rim);
      closed = closeRim(random.fork(attempt++), before, progress);
    }
    if (!closed) return false;
  }
  return true;
}

/// Labels the rim.
bool PatchMove::closeRim(const Random& random, std::vector<Before>& before,
                         const Progress& progress) {
  if (rim_.empty() || static_cast<int>(rim_.size()) > patch_.mostInRim) return false;
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
      .passes = 0, .searches = 1, .searchConflicts = patch_.rimConflicts, .exactConflicts = 0};
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
  if (changed_ == 0 || changed_ > patch_.mostChanged || implied_ > patch_.mostImplied)
    return Outcome::Nothing;
  if (static_cast<int>(conflicts_.size()) > patch_.mostConflicts) return Outcome::Conflict;
  const auto put = [&](std::int32_t cell, Label label) {
    if (labels_[cell] == label) return;
    before.push_back({cell, labels_[cell]});
    labels_[cell] = label;
  };
  for (const Before& c : fromCore_) put(c.cell, c.label);
  for (const Member& m : members_) put(m.cell, m.label);
  if (conflicts_.empty() || (worth() && closeRims(random, before, progress))) return Outcome::Made;
  for (auto b = before.rbegin(); b != before.rend(); ++b) labels_[b->cell] = b->label;
  before.clear();
  return Outcome::Conflict;
}

}  // namespace exemplar
