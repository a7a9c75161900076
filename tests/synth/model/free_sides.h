// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <gtest/gtest.h>

#include <span>
#include <utility>
#include <vector>

#include "synth/model/choose.h"
#include "synth/model/problem.h"
#include "synth/model/start.h"
#include "voxelize/adjacency.h"

namespace exemplar::test {

/// A request for more of an example whose vertical sides are free.
struct FreeSides {
  FreeSides(LabelGrid grid, const Vec3i& size)
      : example(std::move(grid)), adjacency(findAdjacency(example)) {
    options.size = size;
    for (int side = 0; side < 4; ++side) options.sides[side].kind = SideRule::Kind::Free;
  }
  /// What starts are found with.
  struct Prepared {
    explicit Prepared(const FreeSides& r)
        : problem(r.adjacency, r.options),
          base(problem.domains(problem.demands())),
          chooser(problem, std::span(&r.example, 1)) {}
    ModelProblem problem;
    LabelSets base;
    LabelChooser chooser;
    ModelStatistics statistics;
  };

  LabelGrid example;
  Adjacency adjacency;
  ModelOptions options;
};

/// Expects labels that the request allows, each beside what it may be beside.
inline void expectSound(const FreeSides::Prepared& p, const std::vector<Label>& labels) {
  EXPECT_TRUE(consistent(p.problem.network(), labels));
  for (int c = 0; c < p.problem.network().cells; ++c)
    EXPECT_TRUE(containsLabel(p.base[c], labels[c]));
}

}  // namespace exemplar::test
