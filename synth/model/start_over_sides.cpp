// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/start_over_sides.h"

#include <algorithm>

#include "synth/model/anneal.h"
#include "synth/model/arc_consistency.h"
#include "synth/model/repeat_example.h"
#include "synth/model/stretch_example.h"
#include "synth/model/whole.h"

namespace exemplar {
namespace {

/// Which share of the request's moves each start is tried with.
constexpr double kTrial = 1.0 / 20;

/// The labels left where sides that are open are held as the example's; `base` where that cannot
/// be.
LabelSets heldAtSides(const ModelProblem& problem, const LabelSets& base,
                      const Progress& progress) {
  const ModelOptions& o = problem.options();
  LabelSets held = base;
  LabelSets shown(problem.network().labels, 1);
  for (int side = 0; side < 4; ++side) {
    if (o.sides[side].kind != SideRule::Kind::Open || o.periodic[side / 2]) continue;
    std::fill_n(shown.data(), shown.words(), LabelWord{0});
    for (const Label label : problem.adjacency().sides[side]) addLabel(shown[0], label);
    CellBox layer = CellBox::of(o.size);
    if (side % 2 == 0) {
      layer.end[side / 2] = 1;
    } else {
      layer.begin[side / 2] = o.size[side / 2] - 1;
    }
    for (const std::int32_t cell : problem.cellsIn(layer, 0, o.frames))
      for (int w = 0; w < held.words(); ++w) held[cell][w] &= shown[0][w];
  }
  const bool sound = makeArcConsistent(problem.network(), held, o.size.z * o.frames, progress);
  return sound ? held : base;
}

}  // namespace

std::optional<std::vector<Label>> startOverSides(const ModelProblem& problem, const LabelSets& base,
                                                 const LabelChooser& chooser,
                                                 std::span<const LabelGrid> examples,
                                                 ModelStatistics& statistics,
                                                 const Progress& progress) {
  const ModelOptions& options = problem.options();
  std::vector<std::vector<Label>> starts;
  if (auto drawn = stretchExample(problem, base, chooser, examples, progress.part(0, 0.1)))
    starts.push_back(std::move(*drawn));
  if (auto repeated =
          repeatExample(problem, base, chooser, examples[0], statistics, progress.part(0.1, 0.3)))
    starts.push_back(std::move(*repeated));
  const LabelSets held = options.symmetry.any() ? base : heldAtSides(problem, base, progress);
  for (const bool plain : {true, false}) {
    Labeling labeling = labelWhole(problem, held, chooser, statistics,
                                   plain ? progress.part(0.3, 0.4) : progress.part(0.4, 0.5),
                                   options.patience, plain);
    if (labeling.outcome == Outcome::Complete) starts.push_back(std::move(labeling.labels));
  }
  if (starts.empty()) return std::nullopt;
  if (starts.size() == 1) return std::move(starts[0]);

  const PatchGoal goal(problem, examples, progress);
  const AnnealSchedule trial{.moves = options.moves * kTrial};
  std::size_t best = 0;
  double least = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const double from = 0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(starts.size());
    const double to = 0.5 + 0.5 * static_cast<double>(i + 1) / static_cast<double>(starts.size());
    ModelStatistics tried;
    const double energy = annealPatches(problem, base, chooser, goal, options.seed, starts[i],
                                        trial, tried, progress.part(from, to));
    if (i > 0 && energy >= least) continue;
    best = i;
    least = energy;
  }
  return std::move(starts[best]);
}

}  // namespace exemplar
