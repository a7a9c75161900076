// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/synthesize.h"

#include <algorithm>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "synth/model/blocks.h"
#include "synth/model/catalog.h"
#include "synth/model/choose.h"
#include "synth/model/explain.h"
#include "synth/model/limits.h"
#include "synth/model/origins.h"
#include "synth/model/problem.h"
#include "synth/model/start.h"
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
                "make it smaller");
}

void checkExamples(std::span<const LabelGrid> examples, const Adjacency& adjacency) {
  if (examples.empty()) throw InputError("model synthesis needs an example; there is none");
  for (const LabelGrid& e : examples) {
    if (e.labelCount() != adjacency.labelCount) {
      throw InputError("the examples are not those that the adjacency was found in");
    }
  }
}

/// The grids that a labelling of the network stands for.
std::vector<LabelGrid> gridsOf(const ModelProblem& problem, const LabelGrid& example,
                               const std::vector<Label>& labels) {
  LabelGrid blank;
  blank.cells = Array3D<Label>(problem.options().size, 0);
  blank.labels = example.labels;
  blank.cellSize = example.cellSize;
  blank.origin = example.origin;
  blank.name = example.name;
  std::vector<LabelGrid> grids(problem.options().frames, blank);
  parallelFor(0, static_cast<std::size_t>(problem.positions()), 1 << 14,
              [&](std::size_t begin, std::size_t end) {
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

Labelling label(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
                ModelStatistics& statistics, const Progress& progress) {
  // Metropolis needs something to compare with.
  const ModelMethod method =
      problem.options().metropolis ? ModelMethod::Blocks : problem.options().method;
  // Where blocks are an alternative the whole is not worked on for minutes.
  constexpr int kPatience = 8;
  const auto whole = [&](std::optional<int> patience) {
    return labelWhole(problem, base, chooser, statistics, progress, patience);
  };
  if (method == ModelMethod::Whole) return whole(std::nullopt);
  if (method == ModelMethod::Auto) {
    Labelling soon = whole(kPatience);
    if (soon.status != ModelStatus::Unfinished) return soon;
  }
  std::optional<std::vector<Label>> start =
      findTiledStart(problem, base, chooser, statistics, progress);
  if (!start) {
    // No small tile repeats: any labelling of the whole will do to begin with.
    Labelling patient = whole(std::nullopt);
    if (patient.status != ModelStatus::Complete || method == ModelMethod::Auto) return patient;
    start = std::move(patient.labels);
  }
  if (progress.cancelled()) return {ModelStatus::Cancelled, {}};
  statistics.whole = false;
  return labelInBlocks(problem, base, chooser, std::move(*start), statistics, progress);
}

}  // namespace

ModelResult synthesizeModel(std::span<const LabelGrid> examples, const Adjacency& adjacency,
                            const ModelOptions& options, const Progress& progress) {
  checkExamples(examples, adjacency);
  checkMemory(adjacency, options);
  const ModelProblem problem(adjacency, options);
  const LabelNetwork& network = problem.network();
  ModelResult result;
  result.statistics.cells = problem.positions();

  LabelSets base = problem.domains(problem.demands());
  bool possible;
  {
    Catalog catalog(network);
    for (int c = 0; c < network.cells; ++c) catalog.setDomain(c, base[c]);
    possible = catalog.propagateAll();
    for (int c = 0; c < network.cells && possible; ++c) {
      std::copy(catalog.domain(c).begin(), catalog.domain(c).end(), base[c].begin());
    }
  }
  Labelling labelling{ModelStatus::Impossible, {}};
  const LabelChooser chooser(problem, examples);
  if (possible) labelling = label(problem, base, chooser, result.statistics, progress);
  if (labelling.status == ModelStatus::Complete) {
    labelling = meetLimits(problem, base, chooser, std::move(labelling.labels), result.statistics,
                           progress);
  }

  result.status = labelling.status;
  if (result.status == ModelStatus::Impossible) {
    result.conflict = explainConflict(problem, examples[0].labels, progress);
    if (progress.cancelled()) result.status = ModelStatus::Cancelled;
  }
  if (result.status != ModelStatus::Complete) return result;
  result.frames = gridsOf(problem, examples[0], labelling.labels);
  for (const LabelGrid& frame : result.frames) {
    result.origins.push_back(findOrigins(frame, examples));
  }
  return result;
}

ModelResult synthesizeModel(const LabelGrid& example, const ModelOptions& options,
                            const Progress& progress) {
  return synthesizeModel(std::span(&example, 1), findAdjacency(example), options, progress);
}

}  // namespace exemplar
