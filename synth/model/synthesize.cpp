// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/synthesize.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "synth/model/anneal.h"
#include "synth/model/arc_consistency.h"
#include "synth/model/blocks.h"
#include "synth/model/choose.h"
#include "synth/model/explain.h"
#include "synth/model/limits.h"
#include "synth/model/origins.h"
#include "synth/model/problem.h"
#include "synth/model/quilt_labels.h"
#include "synth/model/start.h"
#include "synth/model/start_over_sides.h"
#include "synth/model/stretch_example.h"
#include "synth/model/whole.h"

namespace exemplar {
namespace {

/// Asks for the memory that a request will take, before any of it is taken.
void checkMemory(const Adjacency& adjacency, const ModelOptions& o) {
  const double cells = double(o.size.x) * o.size.y * o.size.z * o.frames;
  const double slots = 2.0 * static_cast<double>(adjacency.rules.size());
  const double set = 8.0 * wordsForLabels(adjacency.labelCount);
  requireMemory(cells * (3 * set + 4 * slots + 48) + slots * adjacency.labelCount * set,
                "a result of " + std::to_string(o.size.x) + " x " + std::to_string(o.size.y) +
                    " x " + std::to_string(o.size.z) + " cells with " +
                    std::to_string(adjacency.labelCount) + " labels",
                "use a smaller `size`");
}

void checkExamples(std::span<const LabelGrid> examples, const Adjacency& adjacency) {
  if (examples.empty()) throw InputError("model synthesis needs an example, and none was given");
  for (const LabelGrid& e : examples) {
    if (e.labelCount() != adjacency.labelCount) {
      throw InputError("the examples are not those that the adjacency was found in");
    }
  }
}

/// The grids that a labeling of the network describes.
std::vector<LabelGrid> gridsOf(const ModelProblem& problem, const LabelGrid& example,
                               const std::vector<Label>& labels, const Progress& progress) {
  LabelGrid blank;
  blank.cells = Array3D<Label>(problem.options().size, 0);
  blank.labels = example.labels;
  blank.cellSize = example.cellSize;
  blank.origin = example.origin;
  blank.name = example.name;
  std::vector<LabelGrid> grids(problem.options().frames, blank);
  parallelFor(0, static_cast<std::size_t>(problem.positions()), 1 << 14,
              [&](std::size_t begin, std::size_t end) {
                progress.check();
                for (std::size_t i = begin; i < end; ++i) {
                  const auto at = static_cast<std::int64_t>(i);
                  const int cell = problem.cell(at);
                  if (cell < 0) continue;
                  grids[problem.frameAt(at)].cells[problem.cellAt(at)] =
                      problem.labelAt(at, labels[cell]);
                }
              });
  return grids;
}

/// How a result is annealed that windows of a smaller one have been laid in: only joints are left,
/// the fewer moves for each column the more columns there are.
AnnealSchedule quiltedSchedule(const ModelOptions& options) {
  constexpr double kColumns = 10'000, kShare = 0.25, kLeastShare = 0.02;
  const double columns = double(options.size.x) * options.size.y;
  const double share = std::max(kShare * std::sqrt(kColumns / columns), kLeastShare);
  return {.moves = options.moves * share, .hot = 4, .looks = 16, .shift = 16};
}

/// Brings a labeling to what the example holds.
void matchStatistics(const ModelProblem& problem, const LabelSets& base,
                     const LabelChooser& chooser, std::span<const LabelGrid> examples,
                     std::vector<Label>& labels, ModelStatistics& statistics,
                     const Progress& progress) {
  const ModelOptions& options = problem.options();
  AnnealSchedule schedule{.moves = options.moves};
  double done = 0;
  if (canQuilt(options)) {
    constexpr int kWindow = 32;  // columns
    // What the example holds is decided in a smaller result; few moves mend its joints.
    const ModelResult sample = synthesizeModel(examples, problem.adjacency(),
                                               quiltSampleOptions(options), progress.part(0, 0.2));
    if (sample.outcome == Outcome::Complete) {
      quiltLabels(problem, base, chooser, sample.grid(), kWindow, labels, progress.part(0.2, 0.4));
      schedule = quiltedSchedule(options);
    }
    done = 0.4;
  }
  annealPatches(problem, base, chooser, examples, labels, schedule, statistics,
                progress.part(done, 1));
}

/// Whether patches are put in whatever labeling is found first.
bool takesPatches(const ModelOptions& options) {
  return options.method == ModelMethod::Auto && !options.metropolis && options.moves > 0;
}

/// Whether a request is for a large result that is made up of windows, and nothing about it is to
/// be proved from the labels that are left.
bool soughtInWindows(const ModelOptions& options) {
  return takesPatches(options) && canQuilt(options) && options.pins.empty() &&
         options.counts.empty() && options.connected.empty();
}

/// Whether all vertical sides have a rule, so that what is there ends.
bool ends(const ModelOptions& options) {
  return std::all_of(options.sides.begin(), options.sides.begin() + 4,
                     [](const SideRule& s) { return s.excludes(); });
}

/// What patches go on from, where that is found at once. Patches bring what is to be there: ground
/// is enough to begin with. Where things run over the sides, though, patches have nothing to end
/// them with: there has to be something to go on from.
std::optional<std::vector<Label>> startForPatches(
    const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
    std::span<const LabelGrid> examples, ModelStatistics& statistics, const Progress& progress) {
  const ModelOptions& options = problem.options();
  if (!takesPatches(options)) return std::nullopt;
  const bool overSides = !ends(options) && options.size.z > 1;
  if (overSides && !canQuilt(options))
    return startOverSides(problem, base, chooser, examples, statistics, progress);
  if (overSides) {
    if (auto drawn = stretchExample(problem, base, chooser, examples, progress.part(0, 0.5)))
      return drawn;
  }
  if (!canQuilt(options)) return std::nullopt;
  // All that is to be there comes with windows of a smaller result.
  return findTiledStart(problem, base, chooser, statistics, progress.part(0.5, 1), true);
}

Labeling label(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
               std::span<const LabelGrid> examples, ModelStatistics& statistics,
               const Progress& progress) {
  // Metropolis needs something to compare with.
  const ModelMethod method =
      problem.options().metropolis ? ModelMethod::Blocks : problem.options().method;
  double done = 0;
  const auto whole = [&](std::optional<int> patience) {
    const Progress rest = progress.part(done, 1);
    Labeling labeling = labelWhole(problem, base, chooser, statistics, rest, patience);
    done += (1 - done) * labeling.share;
    return labeling;
  };
  if (method == ModelMethod::Whole) return whole(std::nullopt);
  if (auto start =
          startForPatches(problem, base, chooser, examples, statistics, progress.part(0, 0.1)))
    return {Outcome::Complete, std::move(*start), 1};
  if (canQuilt(problem.options())) done = 0.1;
  if (takesPatches(problem.options()) && ends(problem.options())) {
    const Progress first = progress.part(0, 0.2);
    Labeling plain =
        labelWhole(problem, base, chooser, statistics, first, problem.options().patience, true);
    if (plain.outcome != Outcome::Unfinished) return plain;
    done = 0.2;
  }
  if (method == ModelMethod::Auto) {
    // Where blocks are an alternative the whole is not worked on for minutes.
    Labeling soon = whole(problem.options().patience);
    if (soon.outcome != Outcome::Unfinished) return soon;
  }
  const double start = done + 0.1 * (1 - done);
  std::optional<std::vector<Label>> tiled =
      findTiledStart(problem, base, chooser, statistics, progress.part(done, start));
  done = start;
  if (!tiled) {
    // No small tile repeats: any labeling of the whole will do to begin with.
    const double half = (1 + done) / 2;
    Labeling patient = labelWhole(problem, base, chooser, statistics, progress.part(done, half));
    if (patient.outcome != Outcome::Complete || method == ModelMethod::Auto) return patient;
    tiled = std::move(patient.labels);
    done = half;
  }
  statistics.whole = false;
  const bool sparse = method == ModelMethod::Auto && problem.options().rounds == 1;
  return labelInBlocks(problem, base, chooser, std::move(*tiled), sparse, statistics,
                       progress.part(done, 1));
}

}  // namespace

ModelResult synthesizeModel(std::span<const LabelGrid> examples, const Adjacency& adjacency,
                            const ModelOptions& options, const Progress& progress) {
  checkExamples(examples, adjacency);
  checkMemory(adjacency, options);
  progress.report("preparing cells", 0);
  const ModelProblem problem(adjacency, options, progress);
  ModelResult result;
  result.statistics.cells = problem.positions();

  progress.report("removing labels without support", 0.03);
  LabelSets base = problem.domains(problem.demands(), progress);
  const LabelChooser chooser(problem, examples, progress);
  std::optional<std::vector<Label>> start;
  double begun = 0.1;
  if (soughtInWindows(options) && makeConsistentByTile(problem, base, progress)) {
    start = startForPatches(problem, base, chooser, examples, result.statistics,
                            progress.part(0.1, 0.15));
    begun = 0.15;
    // What these sets leave out is not proved impossible.
    if (!start) base = problem.domains(problem.demands(), progress);
  }
  Labeling labeling{Outcome::Impossible, {}};
  const double labeled = options.moves > 0 ? 0.3 : 0.85;
  if (start) {
    labeling = {Outcome::Complete, std::move(*start), 1};
  } else if (makeArcConsistent(problem.network(), base, options.size.z * options.frames,
                               progress)) {
    if (const auto why = impossibleLimit(problem, base)) {
      result.outcome = Outcome::Impossible;
      result.conflict.text = *why;
      return result;
    }
    labeling =
        label(problem, base, chooser, examples, result.statistics, progress.part(begun, labeled));
  }
  if (labeling.outcome == Outcome::Complete && options.moves > 0) {
    matchStatistics(problem, base, chooser, examples, labeling.labels, result.statistics,
                    progress.part(labeled, 0.85));
  }
  if (labeling.outcome == Outcome::Complete) {
    labeling = meetLimits(problem, base, chooser, std::move(labeling.labels), result.statistics,
                          progress.part(0.85, 0.95));
  }

  result.outcome = labeling.outcome;
  if (result.outcome == Outcome::Impossible) {
    result.conflict = explainConflict(problem, examples[0].labels, progress.part(0.85, 1));
  }
  if (result.outcome != Outcome::Complete) return result;
  progress.report("writing down labels", 0.95);
  result.frames = gridsOf(problem, examples[0], labeling.labels, progress);
  const double frames = static_cast<double>(result.frames.size());
  for (const LabelGrid& frame : result.frames) {
    const double at = static_cast<double>(result.origins.size()) / frames;
    result.origins.push_back(findOrigins(
        frame, examples, progress.part(0.96 + 0.04 * at, 0.96 + 0.04 * (at + 1 / frames))));
  }
  return result;
}

ModelResult synthesizeModel(const LabelGrid& example, const ModelOptions& options,
                            const Progress& progress) {
  return synthesizeModel(std::span(&example, 1), findAdjacency(example), options, progress);
}

}  // namespace exemplar
