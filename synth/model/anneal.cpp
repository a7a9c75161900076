// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/anneal.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "core/parallel.h"
#include "core/random.h"
#include "synth/model/patch_alignment.h"
#include "synth/model/patch_move.h"

namespace exemplar {
namespace {

/// Columns around a move's center that may change, and how far the center may be shifted.
constexpr int kReach = 18;
/// How long cores are at most, in columns: first, and at last; and how wide.
constexpr int kLongest = 14, kLongestAtLast = 6, kWidest = 8;
/// How long they are at least, first: small patches alone would not begin anything large.
constexpr int kShortest = 7;
/// How far implications are followed at most, and how wide a rim is, in cells.
constexpr int kGrow = 14, kRim = 3;
/// Cells beyond the core that implications may come to; one move in so many may go on to any
/// number: nearly all that are kept have come to fewer, and nearly all that come to more end in
/// conflicts.
constexpr int kImplied = 160, kFar = 4;
/// Conflicts that a patch may have for each column along its border, at last; few at first: what
/// comes whole is to come before what must be mended.
constexpr double kConflicts = 1.6;
/// From this share of the moves on there may be so many conflicts in any case, and rims be so wide:
/// where all is slopes, as in a canyon, nothing comes whole, and slopes take some cells to meet.
constexpr double kWideFrom = 0.3;
constexpr int kConflictsWide = 60, kWidestRim = 6;
/// As long as rims have not taken more work than this for each column (`PatchMove::work`): where
/// most of them cannot be closed, wide ones are many times as much work.
constexpr double kWorkOnRims = 1500;
/// The share of the cells around a core that its place in the example must agree with, at last.
constexpr double kAgreement = 0.75;
/// One core in so many has a part of the height only.
constexpr int kLow = 4;
/// How much worse a patch may seem while its rim is open.
constexpr double kSlack = 100;
/// Blocks that a label is worth where a map makes it e times as probable.
constexpr double kMapWeight = 3;

class PatchAnnealing {
 public:
  PatchAnnealing(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
                 const PatchGoal& goal, std::uint64_t seed, std::vector<Label>& labels,
                 const AnnealSchedule& schedule, const Progress& progress);
  double run(ModelStatistics& statistics);

 private:
  struct Proposal {
    PatchMove::Outcome outcome = PatchMove::Outcome::Nothing;
    double threshold = 0;  // what it may add to the energy
    std::vector<PatchMove::Before> before;
    std::vector<BlockCounts::Changed> changed;
    BlockCounts::Change blocks;
    Vec3i low, high;        // the box of what changed
    std::int64_t work = 0;  // on rims
  };

  void findImages();
  std::vector<Vec3i> centers(Draws& draws) const;
  void propose(Proposal& proposal, std::uint64_t number, const Vec3i& place);
  Vec3i worst(Draws& draws, const Vec3i& place) const;
  double gainByMaps(const Proposal& proposal) const;
  void show(Proposal& proposal, bool estimate = false);
  void takeBack(const Proposal& proposal);
  bool weigh(const Proposal& proposal);

  const ModelProblem& problem_;
  const ModelOptions& options_;
  const AnnealSchedule schedule_;
  const std::uint64_t seed_;
  const std::vector<PatchSource>& sources_;
  BlockCounts counts_;
  CopiedWindows copies_;
  CopiedWindows::Change copied_;
  PatchAlignments alignments_;
  std::vector<Label>& labels_;
  std::vector<Label> grid_;                        // the label that each position shows
  std::vector<std::int64_t> imageBegin_, images_;  // the positions of each cell, with symmetry
  const Progress& progress_;
  tbb::enumerable_thread_specific<PatchMove> moves_;
  Random random_, rims_;
  double done_ = 0, temperature_ = 0;
  std::int64_t work_ = 0;
};

PatchAnnealing::PatchAnnealing(const ModelProblem& problem, const LabelSets& base,
                               const LabelChooser& chooser, const PatchGoal& goal,
                               std::uint64_t seed, std::vector<Label>& labels,
                               const AnnealSchedule& schedule, const Progress& progress)
    : problem_(problem),
      options_(problem.options()),
      schedule_(schedule),
      seed_(seed),
      sources_(goal.sources),
      counts_(goal.counts),
      copies_(goal.copies),
      alignments_(problem, sources_, &counts_),
      labels_(labels),
      progress_(progress),
      moves_([this, &problem, &base, &chooser] {
        return PatchMove(problem, base, chooser, sources_);
      }),
      random_(seed, stream::kPatchMoves),
      rims_(seed, stream::kPatchRims) {
  grid_.assign(static_cast<std::size_t>(problem.positions()), SymmetryGroup::kNoImage);
  for (std::int64_t at = 0; at < problem.positions(); ++at) {
    const int cell = problem.cell(at);
    if (cell >= 0) grid_[at] = problem.labelAt(at, labels[cell]);
  }
  if (options_.symmetry.any()) findImages();
}

void PatchAnnealing::findImages() {
  imageBegin_.assign(static_cast<std::size_t>(problem_.network().cells) + 1, 0);
  for (std::int64_t at = 0; at < problem_.positions(); ++at) {
    if (problem_.cell(at) >= 0) ++imageBegin_[problem_.cell(at) + 1];
  }
  for (std::size_t c = 1; c < imageBegin_.size(); ++c) imageBegin_[c] += imageBegin_[c - 1];
  images_.resize(static_cast<std::size_t>(imageBegin_.back()));
  std::vector<std::int64_t> next(imageBegin_.begin(), imageBegin_.end() - 1);
  for (std::int64_t at = 0; at < problem_.positions(); ++at) {
    if (problem_.cell(at) >= 0) images_[next[problem_.cell(at)]++] = at;
  }
}

/// Where moves are tried at once: so far apart that none touches what another looks at.
std::vector<Vec3i> PatchAnnealing::centers(Draws& draws) const {
  int apart = 3;
  for (const CellOffset& o : problem_.offsets())
    apart = std::max({apart, std::abs(o.x) + 1, std::abs(o.y) + 1});
  const int pitch = 2 * (kReach + schedule_.shift) + apart;
  std::array<std::vector<int>, 2> along;
  for (int axis = 0; axis < 2; ++axis) {
    const int n = options_.size[axis];
    if (!images_.empty() || n <= pitch) {
      along[axis].push_back(draws.below(n));
    } else if (options_.periodic[axis]) {
      const int first = draws.below(n);
      for (int i = 0; i < n / pitch; ++i) along[axis].push_back((first + i * pitch) % n);
    } else {
      for (int at = draws.below(pitch); at < n; at += pitch) along[axis].push_back(at);
    }
  }
  std::vector<Vec3i> list;
  for (const int x : along[0]) {
    for (const int y : along[1]) list.push_back({x, y, 0});
  }
  return list;
}

/// Of some columns near `place` one with a block that the example does not show, or too many of.
Vec3i PatchAnnealing::worst(Draws& draws, const Vec3i& place) const {
  Vec3i best = place;
  double most = 0;
  for (int i = 0; i < schedule_.looks; ++i) {
    Vec3i p{place.x + draws.between(-schedule_.shift, schedule_.shift),
            place.y + draws.between(-schedule_.shift, schedule_.shift),
            draws.below(options_.size.z)};
    bool inside = true;
    for (int axis = 0; axis < 2; ++axis) {
      const int n = options_.size[axis];
      if (options_.periodic[axis]) p[axis] = ((p[axis] % n) + n) % n;
      inside = inside && p[axis] >= 0 && p[axis] < n;
    }
    if (!inside) continue;
    const std::int32_t block = counts_.blockAt(problem_.position(p));
    const double bad = block == BlockCounts::kUnknown ? 2 : counts_.surplus(block) > 0.5 ? 1 : 0.5;
    if (bad <= most) continue;
    most = bad;
    best = {p.x, p.y, 0};
  }
  return best;
}

void PatchAnnealing::propose(Proposal& proposal, std::uint64_t number, const Vec3i& place) {
  Draws draws(random_, number);
  PatchMove::Window window{worst(draws, place),
                           options_.frames > 1 ? draws.below(options_.frames) : 0, kReach};
  for (int axis = 0; axis < 2; ++axis) {
    if (options_.periodic[axis])
      window.reach = std::max(1, std::min(window.reach, (options_.size[axis] - 1) / 2));
  }
  const int most = static_cast<int>(std::lround(kLongest + (kLongestAtLast - kLongest) * done_));
  const int least = std::max(1, static_cast<int>(kShortest * (1 - done_)));
  int a = draws.between(least, most), b = draws.between(least, std::min(most, kWidest));
  if (draws.below(2)) std::swap(a, b);
  PatchMove::Patch patch;
  patch.core = {{-(a / 2), -(b / 2), 0}, {a - a / 2, b - b / 2, options_.size.z}};
  if (draws.below(kLow) == 0) {
    patch.core.begin.z = draws.below(options_.size.z);
    patch.core.end.z = patch.core.begin.z + draws.between(1, options_.size.z - patch.core.begin.z);
  }
  const int inner = window.reach - 1;
  const CellBox box{{-inner, -inner, -options_.size.z}, {inner + 1, inner + 1, options_.size.z}};
  patch.core = patch.core & box;
  patch.grown = patch.core.grown(draws.between(0, kGrow)) & box;
  const Vec3i grown = min(patch.core.size() + Vec3i{8, 8, 0}, patch.grown.size());
  patch.mostConflicts = 2 + static_cast<int>(kConflicts * 2 * (grown.x + grown.y) * done_);
  patch.rim = draws.between(1, kRim);
  const double columns = double(options_.size.x) * options_.size.y;
  if (done_ >= kWideFrom && static_cast<double>(work_) <= kWorkOnRims * columns * done_) {
    patch.mostConflicts = std::max(patch.mostConflicts, kConflictsWide);
    patch.widestRim = kWidestRim;
  }
  if (draws.below(kFar) > 0) patch.mostImplied = kImplied;
  proposal.threshold = -temperature_ * std::log(1 - draws.uniform());
  proposal.outcome = PatchMove::Outcome::Nothing;
  proposal.work = 0;
  const auto alignment = alignments_.find(draws, window, patch.core, grid_, kAgreement * done_);
  if (!alignment) return;
  const auto worth = [&] {
    show(proposal, true);
    for (const auto& c : proposal.changed) grid_[problem_.position(c.cell, c.frame)] = c.before;
    return counts_.estimate(proposal.blocks) <= proposal.threshold + kSlack;
  };
  PatchMove& move = moves_.local();
  const std::int64_t before = move.work();
  proposal.outcome = move.make(window, *alignment, patch, rims_.fork(number), labels_,
                               proposal.before, worth, progress_);
  proposal.work = move.work() - before;
  if (proposal.outcome != PatchMove::Outcome::Made) return;
  show(proposal);
  if (proposal.changed.empty()) {
    takeBack(proposal);  // a cell that changed twice may be what it was
    proposal.outcome = PatchMove::Outcome::Nothing;
  }
  if (problem_.weightVaries()) proposal.threshold += kMapWeight * gainByMaps(proposal);
}

/// Log of how much more the user's maps want what is there now.
double PatchAnnealing::gainByMaps(const Proposal& proposal) const {
  double gain = 0;
  for (const auto& c : proposal.changed) {
    const int cell = problem_.cell(problem_.position(c.cell, c.frame));
    if (c.before >= problem_.network().labels) continue;
    gain +=
        std::log(problem_.weight(cell, labels_[cell])) - std::log(problem_.weight(cell, c.before));
  }
  return gain;
}

/// Shows the changed labels in the grid, and finds out which blocks they touch.
void PatchAnnealing::show(Proposal& proposal, bool estimate) {
  proposal.changed.clear();
  proposal.low = options_.size;
  proposal.high = {0, 0, 0};
  const auto change = [&](std::int64_t at, Label label) {
    const Label now = problem_.labelAt(at, label);
    if (now == grid_[at]) return;
    const Vec3i p = problem_.cellAt(at);
    proposal.changed.push_back({p, problem_.frameAt(at), grid_[at]});
    grid_[at] = now;
    proposal.low = min(proposal.low, p);
    proposal.high = max(proposal.high, p + Vec3i{1, 1, 1});
  };
  for (const PatchMove::Before& b : proposal.before) {
    if (images_.empty()) {
      change(problem_.positionOf(b.cell), labels_[b.cell]);
      continue;
    }
    for (std::int64_t i = imageBegin_[b.cell]; i < imageBegin_[b.cell + 1]; ++i)
      change(images_[i], labels_[b.cell]);
  }
  counts_.look(grid_, proposal.changed, proposal.blocks, estimate);
}

void PatchAnnealing::takeBack(const Proposal& proposal) {
  for (auto b = proposal.before.rbegin(); b != proposal.before.rend(); ++b)
    labels_[b->cell] = b->label;
  for (const auto& c : proposal.changed) grid_[problem_.position(c.cell, c.frame)] = c.before;
}

/// Metropolis: keeps the move, or takes it back.
bool PatchAnnealing::weigh(const Proposal& proposal) {
  double more = counts_.add(proposal.blocks);
  if (more <= proposal.threshold && options_.copyPrice > 0) {
    more += options_.copyPrice * copies_.look(grid_, proposal.low, proposal.high, copied_);
  }
  if (more > proposal.threshold) {
    counts_.takeOut(proposal.blocks);
    takeBack(proposal);
    return false;
  }
  counts_.keep(proposal.blocks);
  if (options_.copyPrice > 0) copies_.keep(copied_);
  return true;
}

double PatchAnnealing::run(ModelStatistics& statistics) {
  counts_.count(grid_, progress_);
  copies_.count(grid_, progress_);
  const double columns = double(options_.size.x) * options_.size.y;
  const auto total = static_cast<std::uint64_t>(columns * schedule_.moves);
  const Random places(seed_, stream::kPatchPlaces);
  std::vector<Proposal> proposals;
  std::uint64_t number = 0;
  for (std::uint64_t batch = 0; number < total; ++batch) {
    done_ = double(number) / double(total);
    progress_.report("matching the example's statistics", done_);
    temperature_ = schedule_.hot * (1 - done_);
    Draws draws(places, batch);
    const std::vector<Vec3i> at = centers(draws);
    if (proposals.size() < at.size()) proposals.resize(at.size());
    parallelFor(0, at.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) propose(proposals[i], number + i, at[i]);
    });
    number += at.size();
    for (std::size_t i = 0; i < at.size(); ++i) work_ += proposals[i].work;
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (proposals[i].outcome == PatchMove::Outcome::Made && weigh(proposals[i]))
        ++statistics.movesKept;
    }
  }
  statistics.moves += static_cast<std::int64_t>(number);
  return counts_.energy() + options_.copyPrice * static_cast<double>(copies_.copies());
}

}  // namespace

void annealPatches(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
                   std::span<const LabelGrid> examples, std::vector<Label>& labels,
                   const AnnealSchedule& schedule, ModelStatistics& statistics,
                   const Progress& progress) {
  annealPatches(problem, base, chooser, PatchGoal(problem, examples, progress),
                problem.options().seed, labels, schedule, statistics, progress);
}

double annealPatches(const ModelProblem& problem, const LabelSets& base,
                     const LabelChooser& chooser, const PatchGoal& goal, std::uint64_t seed,
                     std::vector<Label>& labels, const AnnealSchedule& schedule,
                     ModelStatistics& statistics, const Progress& progress) {
  return PatchAnnealing(problem, base, chooser, goal, seed, labels, schedule, progress)
      .run(statistics);
}

}  // namespace exemplar
