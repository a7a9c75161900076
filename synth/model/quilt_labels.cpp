// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/quilt_labels.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <numeric>

#include "core/parallel.h"
#include "core/random.h"
#include "synth/model/patch_alignment.h"
#include "synth/model/patch_move.h"

namespace exemplar {
namespace {

/// How far beyond its window what crosses the border is followed, in columns, and how wide rims
/// are.
constexpr int kGrow = 12, kRim = 2, kWidestRim = 9;
/// Places looked at for each window, and how many of these are tried.
constexpr int kPlaces = 24, kTries = 3;
/// How much smaller a window is, on each side, that is tried where none of a size can be put in.
constexpr std::array<int, 3> kSmaller{0, 4, 9};
/// Columns along each side of the result that windows are taken from, and how many columns are
/// made at once.
constexpr int kSample = 96;
constexpr double kAtOnce = 12'000;

class Quilt {
 public:
  Quilt(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
        const LabelGrid& sample, int pitch, std::vector<Label>& labels, const Progress& progress)
      : problem_(problem),
        pitch_(pitch),
        options_(problem.options()),
        sources_(patchSources(problem, {&sample, 1}, progress)),
        alignments_(problem, sources_),
        labels_(labels),
        progress_(progress),
        moves_([this, &base, &chooser] { return PatchMove(problem_, base, chooser, sources_); }),
        places_(options_.seed, stream::kQuiltPlaces),
        rims_(options_.seed, stream::kQuiltRims) {
    for (int axis = 0; axis < 2; ++axis) count_[axis] = std::max(1, options_.size[axis] / pitch_);
    for (const CellOffset& o : problem.offsets())
      furthest_ = std::max({furthest_, std::abs(o.x) + 1, std::abs(o.y) + 1});
    grid_.assign(static_cast<std::size_t>(problem.positions()), SymmetryGroup::kNoImage);
    for (std::int64_t at = 0; at < problem.positions(); ++at) {
      const int cell = problem.cell(at);
      if (cell >= 0) grid_[at] = labels[cell];
    }
  }

  double run() {
    std::vector<int> phase;
    std::int64_t columns = 0;
    // Windows of one phase are two apart, so that none sees what another changes. Around a periodic
    // axis the last one of an odd number would touch the first: it has a phase of its own.
    const std::array<int, 2> phases{phasesAlong(0), phasesAlong(1)};
    double done = 0;
    for (int a = 0; a < phases[0]; ++a) {
      for (int b = 0; b < phases[1]; ++b) {
        phase.clear();
        for (int i = 0; i < count_[0]; ++i) {
          for (int j = 0; j < count_[1]; ++j) {
            if (phaseOf(0, i) == a && phaseOf(1, j) == b) phase.push_back(i * count_[1] + j);
          }
        }
        std::vector<int> covered(phase.size(), 0);
        parallelFor(0, phase.size(), 1, [&](std::size_t begin, std::size_t end) {
          for (std::size_t n = begin; n < end; ++n) {
            progress_.check();
            covered[n] = lay(phase[n] / count_[1], phase[n] % count_[1]);
          }
        });
        columns += std::accumulate(covered.begin(), covered.end(), std::int64_t{0});
        done += double(phase.size()) / (double(count_[0]) * count_[1]);
        progress_.report("laying windows of a smaller result", std::min(done, 1.0));
      }
    }
    return double(columns) / (double(options_.size.x) * options_.size.y);
  }

 private:
  int phasesAlong(int axis) const {
    return std::min(count_[axis], options_.periodic[axis] && count_[axis] % 2 == 1 ? 3 : 2);
  }
  int phaseOf(int axis, int i) const {
    return phasesAlong(axis) == 3 && i == count_[axis] - 1 ? 2 : i % 2;
  }
  /// Where a window of the example's kind can come from along an axis.
  int placeAlong(int axis, const CellBox& core, int center, Draws& draws) const {
    const int n = options_.size[axis], s = sources_[0].size[axis];
    if (s == n) return center;
    const int low = -core.begin[axis], high = s - core.end[axis];  // for the whole window
    if (options_.periodic[axis]) return draws.between(low, std::max(low, high));
    // Near a side as far from it as there, further in not near any.
    const int margin = std::min(kGrow, (high - low) / 4);
    if (center + core.begin[axis] < margin) return center;
    if (n - (center + core.end[axis]) < margin) return s - (n - center);
    return draws.between(std::min(low + margin, s / 2), std::max(s / 2, high - margin));
  }
  int lay(int i, int j);

  const ModelProblem& problem_;
  const int pitch_;  // columns along each side of a window, and from one to the next
  const ModelOptions& options_;
  std::vector<PatchSource> sources_;
  PatchAlignments alignments_;
  std::vector<Label>& labels_;
  std::vector<Label> grid_;  // the label that each position shows
  const Progress& progress_;
  tbb::enumerable_thread_specific<PatchMove> moves_;
  Random places_, rims_;
  std::array<int, 2> count_{};
  int furthest_ = 2;  // how far neighbors are, and one more
};

/// Lays one window; returns how many columns it has, or 0.
int Quilt::lay(int i, int j) {
  const std::uint64_t number = static_cast<std::uint64_t>(i) * count_[1] + j;
  Draws draws(places_, number);
  const auto border = [&](int axis, int k) {
    return static_cast<int>(std::int64_t{k} * options_.size[axis] / count_[axis]);
  };
  const Vec3i begin{border(0, i), border(1, j), 0};
  const Vec3i end{border(0, i + 1), border(1, j + 1), options_.size.z};
  PatchMove::Window window{{(begin.x + end.x) / 2, (begin.y + end.y) / 2, 0}, 0, 0};
  CellBox whole{begin - window.center, end - window.center};
  // Two windows from here others are laid at the same time.
  window.reach = std::max(end.x - begin.x, end.y - begin.y) / 2 + kGrow + 2;
  for (int axis = 0; axis < 2; ++axis) {
    if (count_[axis] > 1)
      window.reach = std::min(window.reach, options_.size[axis] / count_[axis] - furthest_);
    if (options_.periodic[axis])
      window.reach = std::min(window.reach, (options_.size[axis] - 1) / 2);
  }
  const int inner = std::max(window.reach - 1, 0);
  const CellBox box{{-inner, -inner, -options_.size.z}, {inner + 1, inner + 1, options_.size.z}};
  whole = whole & box;
  struct Place {
    double agrees;
    PatchMove::Alignment alignment;
  };
  std::vector<Place> list;
  for (int n = 0; n < kPlaces; ++n) {
    PatchMove::Alignment a;
    for (int axis = 0; axis < 2; ++axis)
      a.cell[axis] = placeAlong(axis, whole, window.center[axis], draws);
    list.push_back({alignments_.agreement(window, a, whole, grid_), a});
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Place& a, const Place& b) { return a.agrees > b.agrees; });
  std::vector<PatchMove::Before> before;
  std::uint64_t attempt = 0;
  const Random rims = rims_.fork(number);
  for (const int smaller : kSmaller) {
    PatchMove::Patch patch;
    patch.core = whole;
    for (int axis = 0; axis < 2; ++axis) {
      // Sides of the result stay covered.
      if (begin[axis] > 0) patch.core.begin[axis] += smaller;
      if (end[axis] < options_.size[axis]) patch.core.end[axis] -= smaller;
    }
    if (patch.core.empty()) break;
    patch.grown = patch.core.grown(kGrow) & box;
    patch.rim = kRim;
    patch.widestRim = kWidestRim;
    patch.mostConflicts = patch.mostChanged = patch.mostImplied = 1 << 20;
    patch.mostInRim = 6000;
    patch.rimConflicts = 60;
    for (int n = 0; n < kTries; ++n) {
      const auto outcome = moves_.local().make(
          window, list[n].alignment, patch, rims.fork(attempt++), labels_, before,
          [] { return true; }, progress_);
      if (outcome == PatchMove::Outcome::Conflict) continue;
      for (const PatchMove::Before& b : before)
        grid_[problem_.positionOf(b.cell)] = labels_[b.cell];
      return patch.core.size().x * patch.core.size().y;
    }
  }
  return 0;
}

}  // namespace

bool canQuilt(const ModelOptions& options) {
  const Vec3i& n = options.size;
  return options.moves > 0 && options.frames == 1 && !options.symmetry.any() &&
         options.weightMaps.empty() && double(n.x) * n.y > kAtOnce && std::max(n.x, n.y) > kSample;
}

ModelOptions quiltSampleOptions(const ModelOptions& options) {
  ModelOptions sample = options;
  for (int axis = 0; axis < 2; ++axis) sample.size[axis] = std::min(sample.size[axis], kSample);
  sample.seed = Random(options.seed, stream::kQuiltPlaces).bits(0);
  sample.pins.clear();
  sample.mask = {};
  sample.counts.clear();
  sample.connected.clear();
  return sample;
}

double quiltLabels(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
                   const LabelGrid& sample, int pitch, std::vector<Label>& labels,
                   const Progress& progress) {
  return Quilt(problem, base, chooser, sample, pitch, labels, progress).run();
}

}  // namespace exemplar
