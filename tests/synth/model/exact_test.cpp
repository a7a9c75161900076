// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/exact.h"

#include <gtest/gtest.h>

#include <atomic>

#include "synth/model/examples.h"
#include "synth/model/networks.h"

namespace exemplar {
namespace {

using test::freeOptions;
using test::randomAdjacency;

std::int64_t countSolutions(const Adjacency& a, const Vec3i& size) {
  Array3D<Label> cells(size, 0);
  for (std::int64_t count = 0;;) {
    count += test::allowedByRules(a, cells);
    std::size_t i = 0;
    while (i < cells.count() && ++cells.data()[i] == a.labelCount) cells.data()[i++] = 0;
    if (i == cells.count()) return count;
  }
}

TEST(ExactSolver, HasAsManySolutionsAsEnumerationFinds) {
  // Each solution found is forbidden and the next one asked for; labels up to 7, so that both ways
  // of saying "exactly one" are used.
  for (int trial = 0; trial < 40; ++trial) {
    const int labels = trial % 2 ? 3 : 7;
    const Vec3i size = trial % 2 ? Vec3i{2, 3, 1} : Vec3i{2, 2, 1};
    const Adjacency a = randomAdjacency(labels, trial % 2 ? 0.5 : 0.3, trial);
    const ModelOptions o = freeOptions(size);
    const ModelProblem problem(a, o);
    ExactSolver exact(problem.network(), problem.domains(problem.demands()));
    std::int64_t found = 0;
    while (exact.solve({}, 100000) == Outcome::Complete) {
      Array3D<Label> cells(size);
      std::vector<std::pair<int, int>> solution;
      for (int c = 0; c < problem.network().cells; ++c) {
        cells[problem.cellAt(problem.positionOf(c))] = static_cast<Label>(exact.label(c));
        solution.emplace_back(c, exact.label(c));
      }
      ASSERT_TRUE(test::allowedByRules(a, cells)) << trial;
      exact.demandOne({}, solution);
      ASSERT_LT(++found, 3000);
    }
    EXPECT_EQ(found, countSolutions(a, size)) << trial;
  }
}

TEST(ExactSolver, EndsAfterSoManySteps) {
  // Cells that must be decided one after another: a few steps do not do it, and what they left
  // undecided can be gone on with.
  const LabelGrid example = test::escheresque();
  const Adjacency a = findAdjacency(example);
  ModelOptions o;
  o.size = {12, 12, 10};
  const ModelProblem problem(a, o);
  const LabelSets domains = problem.domains(problem.demands());
  ExactSolver all(problem.network(), domains);
  ASSERT_EQ(all.solve({}, 100000), Outcome::Complete);
  ASSERT_GE(all.steps(), 20);
  ExactSolver some(problem.network(), domains);
  EXPECT_EQ(some.literals(), all.literals());
  EXPECT_EQ(some.solve({}, 100000, {}, 5), Outcome::Unfinished);
  EXPECT_LT(some.steps(), all.steps());
  EXPECT_EQ(some.solve({}, 100000), Outcome::Complete);
}

TEST(ExactSolver, HearsCancellation) {
  const Adjacency a = randomAdjacency(3, 0.6, 1);
  const ModelOptions o = freeOptions({5, 5, 1});
  const ModelProblem problem(a, o);
  const LabelSets domains = problem.domains(problem.demands());
  const std::atomic<bool> cancel = true;
  const Progress cancelled({}, &cancel);
  EXPECT_THROW(ExactSolver(problem.network(), domains, cancelled), Cancelled);
  ExactSolver exact(problem.network(), domains);
  EXPECT_THROW((void)exact.solve({}, 1000, cancelled), Cancelled);
  EXPECT_NE(exact.solve({}, 1000), Outcome::Unfinished) << "it can be used again";
}

TEST(ExactSolver, NamesTheDemandsThatAProofUses) {
  // A chain in which labels only rise: label 2 first and label 0 last exclude each other; a demand
  // on a chain of its own has no part in it.
  Adjacency a = randomAdjacency(3, 0, 0);
  a.rules[0].pairs.clear();
  a.rules[1].pairs.clear();
  for (int b = 0; b < 3; ++b) {
    for (int c = b; c < 3; ++c) a.rules[0].pairs.push_back({Label(b), Label(c), 1});
  }
  for (int b = 0; b < 9; ++b) a.rules[1].pairs.push_back({Label(b / 3), Label(b % 3), 1});
  const ModelOptions o = freeOptions({6, 2, 1});
  const ModelProblem problem(a, o);
  ExactSolver exact(problem.network(), problem.domains(problem.demands()));
  const auto demand = [&](Vec3i p, int label) {
    LabelSets one(3, 1);
    addLabel(one[0], label);
    const int d = exact.newDemand();
    exact.addToDemand(d, problem.cell(problem.position(p)), one[0]);
    return d;
  };
  const std::vector<int> on{demand({0, 0, 0}, 2), demand({3, 1, 0}, 1), demand({5, 0, 0}, 0)};
  ASSERT_EQ(exact.solve(on, 1000), Outcome::Impossible);
  EXPECT_TRUE(exact.used(on[0]));
  EXPECT_FALSE(exact.used(on[1]));
  EXPECT_TRUE(exact.used(on[2]));
  EXPECT_EQ(exact.solve(std::span(on).first(2), 1000), Outcome::Complete);
}

}  // namespace
}  // namespace exemplar
