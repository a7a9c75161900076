// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/anneal.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstdio>

#include "core/parallel.h"
#include "core/random.h"
#include "synth/model/block_counts.h"
#include "synth/model/copied_windows.h"
#include "synth/model/patch_move.h"
#include "synth/model/region.h"
#include "synth/model/choose.h"

namespace exemplar {
namespace {

double env(const char* name, double value) {
  const char* text = std::getenv(name);
  return text ? std::atof(text) : value;
}

/// The random numbers of one move, one after the other.
class Draws {
 public:
  Draws(const Random& random, std::uint64_t move) : random_(random), move_(move) {}
  int below(int n) {
    return static_cast<int>(random_.below(static_cast<std::uint32_t>(n), move_, draw_++));
  }
  int between(int least, int most) { return least + below(most - least + 1); }
  double uniform() { return random_.uniform(move_, draw_++); }

 private:
  const Random& random_;
  std::uint64_t move_;
  std::uint32_t draw_ = 0;
};

class PatchAnnealing {
 public:
  PatchAnnealing(const ModelProblem& problem, const LabelSets& base,
                 const LabelChooser& chooser,
                 std::span<const LabelGrid> examples, std::vector<Label>& labels,
                 const Progress& progress);
  void run(ModelStatistics& statistics);

 private:
  struct Proposal {
    bool made = false;
    std::vector<std::pair<std::int32_t, Label>> before;  // of cells of the network
    std::vector<BlockCounts::Changed> changed;
    BlockCounts::Change blocks;
    Vec3i low, high;
    int why = 0;
    double threshold = 0;
  };
  using Window = PatchMove::Window;
  using Alignment = PatchMove::Alignment;

  std::vector<Vec3i> centers(Draws& draws) const;
  void propose(Proposal& proposal, std::uint64_t move, const Vec3i& center);
  Alignment align(Draws& draws, const Window& window, const CellBox& core, double& score);
  double agreement(const Window& window, const Alignment& alignment, const CellBox& core) const;
  bool closeRim(Proposal& proposal, const PatchMove& move, const Window& window,
                const Alignment& alignment, Draws& draws, std::uint64_t number);
  void put(Proposal& proposal);
  void takeAway(const Proposal& proposal);
  bool within(Vec3i& p) const;

  const ModelProblem& problem_;
  const ModelOptions& options_;
  std::vector<PatchSource> sources_;
  BlockCounts counts_;
  CopiedWindows copies_;
  std::vector<Label>& labels_;
  std::vector<Label> grid_;  // the label that each position shows
  std::vector<std::int64_t> imageBegin_, images_;  // the positions of each cell, with symmetry
  const Progress& progress_;
  const LabelChooser& chooser_;
  std::int64_t rims_ = 0, rimCells_ = 0, rimsBegun_ = 0;
  tbb::enumerable_thread_specific<Region> regions_;
  tbb::enumerable_thread_specific<PatchMove> moves_;
  Random random_;
  double temperature_ = 0;
  Vec3i reach_;
  int most_ = 600;
};

PatchAnnealing::PatchAnnealing(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
                               std::span<const LabelGrid> examples, std::vector<Label>& labels,
                               const Progress& progress)
    : problem_(problem),
      options_(problem.options()),
      sources_(patchSources(problem, examples, progress)),
      counts_(problem, sources_, progress),
      copies_(problem, sources_),
      labels_(labels),
      progress_(progress),
      chooser_(chooser), regions_([&problem, &base] { return Region(problem.network(), base); }),
      moves_([this, &problem, &base] { return PatchMove(problem, base, sources_); }),
      random_(problem.options().seed, stream::kPatchMoves) {
  grid_.assign(static_cast<std::size_t>(problem.positions()), SymmetryGroup::kNoImage);
  for (std::int64_t at = 0; at < problem.positions(); ++at) {
    const int cell = problem.cell(at);
    if (cell >= 0) grid_[at] = problem.labelAt(at, labels[cell]);
  }
  if (options_.symmetry.any()) {
    imageBegin_.assign(static_cast<std::size_t>(problem.network().cells) + 1, 0);
    for (std::int64_t at = 0; at < problem.positions(); ++at) {
      if (problem.cell(at) >= 0) ++imageBegin_[problem.cell(at) + 1];
    }
    for (std::size_t c = 1; c < imageBegin_.size(); ++c) imageBegin_[c] += imageBegin_[c - 1];
    images_.resize(imageBegin_.back());
    std::vector<std::int64_t> next(imageBegin_.begin(), imageBegin_.end() - 1);
    for (std::int64_t at = 0; at < problem.positions(); ++at) {
      if (problem.cell(at) >= 0) images_[next[problem.cell(at)]++] = at;
    }
  }
  most_ = static_cast<int>(env("MOST", 600));
}

bool PatchAnnealing::within(Vec3i& p) const {
  for (int axis = 0; axis < 3; ++axis) {
    const int n = options_.size[axis];
    if (p[axis] >= 0 && p[axis] < n) continue;
    if (!options_.periodic[axis]) return false;
    p[axis] = ((p[axis] % n) + n) % n;
  }
  return true;
}

std::vector<Vec3i> PatchAnnealing::centers(Draws& draws) const {
  const int reach = static_cast<int>(env("REACH", 8));
  const int pitch = 2 * reach + 3;
  const bool one = options_.symmetry.any();
  std::array<std::vector<int>, 2> along;
  for (int axis = 0; axis < 2; ++axis) {
    const int n = options_.size[axis];
    if (one || n <= pitch) {
      along[axis].push_back(draws.below(n));
      continue;
    }
    if (options_.periodic[axis]) {
      const int first = draws.below(n);
      for (int i = 0; i < n / pitch; ++i) along[axis].push_back((first + i * pitch) % n);
      continue;
    }
    for (int at = draws.below(pitch); at < n; at += pitch) along[axis].push_back(at);
  }
  std::vector<Vec3i> list;
  for (const int x : along[0]) {
    for (const int y : along[1]) list.push_back({x, y, 0});
  }
  return list;
}

double PatchAnnealing::agreement(const Window& window, const Alignment& alignment,
                                 const CellBox& core) const {
  const PatchSource& source = sources_[alignment.source];
  int same = 0, all = 0;
  Vec3i step;
  const Vec3i high{core.end.x + 2, core.end.y + 2, core.end.z};
  for (step.x = core.begin.x - 2; step.x < high.x; ++step.x) {
    for (step.y = core.begin.y - 2; step.y < high.y; ++step.y) {
      if (step.x >= core.begin.x && step.x < core.end.x && step.y >= core.begin.y &&
          step.y < core.end.y) {
        continue;
      }
      for (step.z = core.begin.z; step.z < core.end.z; ++step.z) {
        Vec3i p = window.center + step;
        const Vec3i q = alignment.cell + step;
        const bool here = within(p), there = source.contains(q, alignment.frame);
        if (!here && !there) continue;
        ++all;
        same += here && there &&
                grid_[problem_.position(p, window.frame)] == source.at(q, alignment.frame);
      }
    }
  }
  return all ? double(same) / all : 0;
}

PatchAnnealing::Alignment PatchAnnealing::align(Draws& draws, const Window& window,
                                                const CellBox& core, double& score) {
  Alignment best;
  score = -1;
  const int tries = static_cast<int>(env("TRIES", 8));
  for (int i = 0; i < tries; ++i) {
    Alignment a;
    a.source = draws.below(static_cast<int>(sources_.size()));
    const PatchSource& source = sources_[a.source];
    a.frame = source.frames > 1 ? draws.below(source.frames) : 0;
    bool found = false;
    if (i % 2) {
      for (int j = 0; j < 4 && !found; ++j) {
        // A block beside the core, or at its border.
        Vec3i step{draws.between(core.begin.x - 3, core.end.x),
                   draws.between(core.begin.y - 3, core.end.y),
                   draws.between(core.begin.z, core.end.z - 1)};
        Vec3i p = window.center + step;
        if (!within(p)) continue;
        const std::int32_t block = counts_.blockAt(problem_.position(p, window.frame));
        if (block < 0) continue;
        const auto places = counts_.places(block);
        if (j < 3 && places.size() > 24) continue;
        const auto& place = places[draws.below(static_cast<int>(places.size()))];
        const PatchSource& s = sources_[place.source];
        std::int64_t at = place.position;
        a.source = place.source;
        a.frame = static_cast<int>(at % s.frames);
        at /= s.frames;
        const Vec3i q{static_cast<int>(at / s.size.z / s.size.y),
                      static_cast<int>(at / s.size.z % s.size.y), static_cast<int>(at % s.size.z)};
        a.cell = q - step;
        found = true;
      }
    }
    if (!found) {
      a.cell = {draws.below(source.size.x), draws.below(source.size.y), window.center.z};
      for (int axis = 0; axis < 2; ++axis) {
        const int c = window.center[axis], n = options_.size[axis];
        if (options_.periodic[axis]) continue;
        if (c < 4 && draws.below(4)) a.cell[axis] = c;
        if (n - 1 - c < 4 && draws.below(4)) a.cell[axis] = source.size[axis] - (n - c);
      }
    }
    const double s = agreement(window, a, core);
    if (s > score) {
      score = s;
      best = a;
    }
  }
  return best;
}

void PatchAnnealing::propose(Proposal& proposal, std::uint64_t number, const Vec3i& center) {
  Draws draws(random_, number);
  proposal.made = false;
  const int largest = static_cast<int>(env("CORE", 6));
  Window window{center, options_.frames > 1 ? draws.below(options_.frames) : 0,
                static_cast<int>(env("REACH", 8))};
  for (int axis = 0; axis < 2; ++axis) {
    if (options_.periodic[axis])
      window.reach = std::max(1, std::min(window.reach, (options_.size[axis] - 1) / 2));
  }
  const int a = draws.between(1, largest), b = draws.between(1, largest);
  CellBox core{{-(a / 2), -(b / 2), 0}, {a - a / 2, b - b / 2, options_.size.z}};
  if (draws.below(4) == 0) {
    core.begin.z = draws.below(options_.size.z);
    core.end.z = core.begin.z + draws.between(1, options_.size.z - core.begin.z);
  }
  proposal.threshold = -temperature_ * std::log(1 - draws.uniform());
  double score;
  const Alignment alignment = align(draws, window, core, score);
  PatchMove& move = moves_.local();
  proposal.why = 1;
  const int grow = draws.between(0, static_cast<int>(env("GROW", 4)));
  CellBox grown = core.grown(grow);
  const int inner = window.reach - 1;
  grown.begin.x = std::max(grown.begin.x, -inner);
  grown.begin.y = std::max(grown.begin.y, -inner);
  grown.end.x = std::min(grown.end.x, inner + 1);
  grown.end.y = std::min(grown.end.y, inner + 1);
  if (!move.close(window, alignment, core, grown, labels_, most_)) return;
  proposal.why = 2;
  if (int(move.conflicts().size()) > env("CONF", 60)) return;
  proposal.why = 3;
  proposal.before.clear();
  for (const PatchMove::Member& m : move.members()) {
    const Label before = labels_[m.cell];
    if (before == m.label) continue;
    proposal.before.emplace_back(m.cell, before);
    labels_[m.cell] = m.label;
  }
  if (!move.conflicts().empty()) {
    if (!closeRim(proposal, move, window, alignment, draws, number)) {
      for (const auto& [cell, before] : proposal.before) labels_[cell] = before;
      return;
    }
  }
  proposal.why = move.conflicts().empty() ? 4 : 5;
  put(proposal);
  proposal.made = true;
}

bool PatchAnnealing::closeRim(Proposal& proposal, const PatchMove& move, const Window& window,
                              const Alignment& alignment, Draws& draws, std::uint64_t number) {
  const int rim = draws.between(1, static_cast<int>(env("RIM", 3)));
  std::vector<std::int32_t> cells;
  for (const PatchMove::Member& c : move.conflicts()) {
    Vec3i d;
    for (d.x = -rim; d.x <= rim; ++d.x) {
      for (d.y = -rim; d.y <= rim; ++d.y) {
        const Vec3i step{c.step.x + d.x, c.step.y + d.y, 0};
        if (std::abs(step.x) > window.reach || std::abs(step.y) > window.reach) continue;
        for (d.z = -rim; d.z <= rim; ++d.z) {
          Vec3i p = window.center + c.step + d;
          if (!within(p)) continue;
          for (int t = 0; t < options_.frames; ++t) {
            const int cell = problem_.cell(problem_.position(p, t));
            if (cell >= 0) cells.push_back(cell);
          }
        }
      }
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  if (static_cast<int>(cells.size()) > env("RIMCELLS", 800)) return false;
  rimCells_ += cells.size();
  ++rims_;
  Region& region = regions_.local();
  if (!region.takeBack(cells, labels_, progress_)) return false;
  ++rimsBegun_;
  RegionChoice choice{random_.fork(number)};
  const PatchSource& source = sources_[alignment.source];
  choice.choose = [&](const Random& random, int cell, std::span<const LabelWord> set, int draw) {
    const Label old = labels_[cell];
    if (containsLabel(set, old)) return static_cast<int>(old);
    const Vec3i p = problem_.cellAt(problem_.positionOf(cell));
    Vec3i step = p - window.center;
    for (int axis = 0; axis < 2; ++axis) {
      if (!options_.periodic[axis]) continue;
      const int n = options_.size[axis];
      step[axis] = ((step[axis] % n) + n) % n;
      if (2 * step[axis] > n) step[axis] -= n;
    }
    const Vec3i q = alignment.cell + step;
    if (source.contains(q, alignment.frame)) {
      const Label b = source.at(q, alignment.frame);
      if (b < problem_.network().labels && containsLabel(set, b)) return static_cast<int>(b);
    }
    return chooser_.choose(random, cell, set, draw, region.placed());
  };
  static const RegionEffort effort{.passes = 0, .searches = 1, .searchConflicts = (int)env("TURNS", 20), .exactConflicts = 0};
  if (region.relabel(effort, choice, progress_) != Outcome::Complete) return false;
  for (int i = 0; i < region.count(); ++i) {
    const int cell = region.cells()[i];
    if (region.label(i) == labels_[cell]) continue;
    proposal.before.emplace_back(cell, labels_[cell]);
  }
  region.keep(labels_);
  return true;
}

void PatchAnnealing::put(Proposal& proposal) {
  proposal.changed.clear();
  proposal.low = options_.size;
  proposal.high = {0, 0, 0};
  for (const auto& [cell, before] : proposal.before) {
    const auto change = [&](std::int64_t at) {
      const Label now = problem_.labelAt(at, labels_[cell]);
      if (now == grid_[at]) return;
      const Vec3i p = problem_.cellAt(at);
      proposal.changed.push_back({p, problem_.frameAt(at), grid_[at]});
      grid_[at] = now;
      proposal.low = min(proposal.low, p);
      proposal.high = max(proposal.high, p + Vec3i{1, 1, 1});
    };
    if (images_.empty()) {
      change(problem_.positionOf(cell));
    } else {
      for (std::int64_t i = imageBegin_[cell]; i < imageBegin_[cell + 1]; ++i)
        change(images_[i]);
    }
  }
  counts_.look(grid_, proposal.changed, proposal.blocks);
}

void PatchAnnealing::takeAway(const Proposal& proposal) {
  for (std::size_t i = proposal.before.size(); i-- > 0;)
    labels_[proposal.before[i].first] = proposal.before[i].second;
  for (const auto& c : proposal.changed) grid_[problem_.position(c.cell, c.frame)] = c.before;
}

void PatchAnnealing::run(ModelStatistics& statistics) {
  counts_.count(grid_, progress_);
  copies_.count(grid_, progress_);
  const double columns = double(options_.size.x) * options_.size.y;
  const auto total = static_cast<std::uint64_t>(columns * options_.moves);
  const double hot = env("HOT", 8);
  const Random places(options_.seed, stream::kPatchPlaces);
  std::vector<Proposal> proposals;
  CopiedWindows::Change copied;
  std::int64_t why[6] = {}, whyKept[6] = {};
  std::int64_t made = 0, kept = 0, cells = 0;
  std::uint64_t number = 0;
  const double before = counts_.energy();
  for (std::uint64_t batch = 0; number < total; ++batch) {
    const double done = double(number) / double(total);
    progress_.report("matching the example's statistics", done);
    temperature_ = hot * (1 - done);
    Draws draws(places, batch);
    const std::vector<Vec3i> at = centers(draws);
    if (proposals.size() < at.size()) proposals.resize(at.size());
    parallelFor(0, at.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) propose(proposals[i], number + i, at[i]);
    });
    number += at.size();
    for (std::size_t i = 0; i < at.size(); ++i) {
      Proposal& p = proposals[i];
      ++why[p.why];
      if (!p.made) continue;
      ++made;
      cells += p.changed.size();
      double more = counts_.add(p.blocks);
      bool accept = more <= p.threshold;
      if (accept && options_.copyPrice > 0) {
        more += options_.copyPrice * copies_.look(grid_, p.low, p.high, copied);
        accept = more <= p.threshold;
      }
      if (!accept) {
        counts_.takeOut(p.blocks);
        takeAway(p);
        continue;
      }
      ++kept;
      ++whyKept[p.why];
      counts_.keep(p.blocks);
      copies_.keep(copied);
    }
  }
  statistics.moves = static_cast<std::int64_t>(number);
  statistics.movesKept = kept;
  if (std::getenv("TALK"))
    std::fprintf(stderr, "moves nothing/too-far %lld conflicts %lld rim-failed %lld direct %lld (%lld) rim %lld (%lld) rims %lld begun %lld cells %.0f\n", (long long)why[1], (long long)why[2], (long long)why[3], (long long)why[4], (long long)whyKept[4], (long long)why[5], (long long)whyKept[5], (long long)rims_, (long long)rimsBegun_, double(rimCells_)/rims_);
  if (std::getenv("TALK"))
    std::fprintf(stderr, "moves %lld made %lld kept %lld cells/made %.1f energy %.0f -> %.0f copies %lld\n",
                 (long long)number, (long long)made, (long long)kept, double(cells) / double(made + 1), before,
                 counts_.energy(), (long long)copies_.copies());
}

}  // namespace

void annealPatches(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
                   std::span<const LabelGrid> examples, std::vector<Label>& labels,
                   ModelStatistics& statistics, const Progress& progress) {
  PatchAnnealing(problem, base, chooser, examples, labels, progress).run(statistics);
}

}  // namespace exemplar
