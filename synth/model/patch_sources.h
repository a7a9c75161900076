// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "synth/model/problem.h"

namespace exemplar {

/// What patches are copied from: an example, all of its frames, perhaps mirrored or turned.
struct PatchSource {
  Vec3i size;
  int frames = 1;
  double share = 1;           ///< of what all sources together stand for
  bool sound = false;         ///< whether all pairs in it are allowed, so that it can be relied on
  std::vector<Label> labels;  ///< in column order, as `ModelProblem` numbers positions

  bool contains(const Vec3i& p, int frame) const {
    return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < size.x && p.y < size.y && p.z < size.z &&
           frame >= 0 && frame < frames;
  }
  std::int64_t position(const Vec3i& p, int frame) const {
    return ((std::int64_t{p.x} * size.y + p.y) * size.z + p.z) * frames + frame;
  }
  Label at(const Vec3i& p, int frame) const { return labels[position(p, frame)]; }
};

/// The examples, each in all of the ways in which the request's symmetry turns them: under a
/// symmetry a turned example is an example, too. Labels without an image there are
/// `SymmetryGroup::kNoImage`. O(cells of the examples) for each.
std::vector<PatchSource> patchSources(const ModelProblem& problem,
                                      std::span<const LabelGrid> examples,
                                      const Progress& progress = {});

}  // namespace exemplar
