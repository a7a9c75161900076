// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/patch_sources.h"

#include <algorithm>
#include <cstdlib>

namespace exemplar {
namespace {

/// The clip of `frames` as element `e` of the group shows it.
PatchSource turnedSource(const SymmetryGroup& group, int e, std::span<const LabelGrid> frames) {
  PatchSource source;
  const Vec3i from = frames[0].size();
  const Vec3i x = group.turned(e, {1, 0, 0}), y = group.turned(e, {0, 1, 0});
  const bool swapped = x.x == 0;
  source.size = swapped ? Vec3i{from.y, from.x, from.z} : from;
  source.frames = static_cast<int>(frames.size());
  source.labels.resize(static_cast<std::size_t>(volume(from)) * frames.size());
  // Where the axes point backwards cells are counted from the other end.
  const Vec3i first{x.x + y.x < 0 ? source.size.x - 1 : 0, x.y + y.y < 0 ? source.size.y - 1 : 0,
                    0};
  for (int t = 0; t < source.frames; ++t) {
    forEachCell(from, [&](const Vec3i& p) {
      const Vec3i q = first + x * p.x + y * p.y + Vec3i{0, 0, p.z};
      source.labels[source.position(q, t)] = group.image(e, frames[t].cells[p]);
    });
  }
  return source;
}

/// Whether all pairs of cells in a source are allowed. Not so where neighbors are those that agree
/// in samples they share, up to a tolerance, or where a symmetry has taken pairs away.
bool soundSource(const ModelProblem& problem, const PatchSource& source) {
  if (source.frames > 1) return false;
  const LabelNetwork& network = problem.network();
  for (std::size_t r = 0; r < problem.offsets().size(); ++r) {
    const CellOffset& o = problem.offsets()[r];
    if (o.t != 0) continue;
    const LabelSets& allowed = network.support[2 * r];
    bool sound = true;
    forEachCell(source.size, [&](const Vec3i& p) {
      const Vec3i q = p + Vec3i{o.x, o.y, o.z};
      if (!sound || !source.contains(q, 0)) return;
      const Label a = source.at(p, 0), b = source.at(q, 0);
      sound = a < network.labels && b < network.labels && containsLabel(allowed[a], b);
    });
    if (!sound) return false;
  }
  return true;
}

}  // namespace

std::vector<PatchSource> patchSources(const ModelProblem& problem,
                                      std::span<const LabelGrid> examples,
                                      const Progress& progress) {
  const auto& rules = problem.adjacency().rules;
  const bool clip = std::any_of(rules.begin(), rules.end(),
                                [](const PairRule& rule) { return rule.offset.t != 0; });
  const std::size_t step = clip ? examples.size() : 1;
  const SymmetryGroup& group = problem.symmetry();
  std::vector<PatchSource> sources;
  double columns = 0;
  for (std::size_t first = 0; first < examples.size(); first += step) {
    for (int e = 0; e < group.elements(); ++e) {
      progress.check();
      sources.push_back(turnedSource(group, e, examples.subspan(first, step)));
      const Vec3i& n = sources.back().size;
      sources.back().share = double(n.x) * n.y;
      columns += sources.back().share;
    }
  }
  for (PatchSource& source : sources) {
    source.share /= columns;
    source.sound = soundSource(problem, source);
  }
  return sources;
}

}  // namespace exemplar
