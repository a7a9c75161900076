// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/catalog.h"

#include <gtest/gtest.h>

#include "synth/model/networks.h"
#include "synth/model/search.h"

namespace exemplar {
namespace {

using test::freeOptions;
using test::randomAdjacency;

std::vector<std::vector<bool>> setsOf(const Catalog& catalog) {
  const LabelNetwork& n = catalog.network();
  std::vector<std::vector<bool>> sets(n.cells, std::vector<bool>(n.labels));
  for (int c = 0; c < n.cells; ++c) {
    forEachLabel(catalog.domain(c), [&](int b) { sets[c][b] = true; });
  }
  return sets;
}

void fill(Catalog& catalog, const ModelProblem& problem) {
  const LabelSets start = problem.domains(problem.demands());
  for (int c = 0; c < problem.network().cells; ++c) catalog.setDomain(c, start[c]);
}

/// Label counts of one to several words of bits, so that each width of the kernel is used.
class CatalogOfLabels : public testing::TestWithParam<int> {};

TEST_P(CatalogOfLabels, EqualsBruteForceArcConsistency) {
  const int labels = GetParam();
  int sound = 0, contradictory = 0;
  for (int trial = 0; trial < (labels < 100 ? 30 : 12); ++trial) {
    const Adjacency a =
        randomAdjacency(labels, (1 + (labels < 100 ? 0.3 : 0.75) * trial) / labels, trial, 3);
    ModelOptions o = freeOptions({4, 3, 2});
    if (trial % 3 == 1) o.periodic.x = true;
    if (trial % 3 == 2) {
      o.mask = Array3D<std::uint8_t>(o.size, 1);
      o.mask(1, 1, 0) = 0;
    }
    const ModelProblem problem(a, o);
    Catalog catalog(problem.network());
    fill(catalog, problem);
    auto sets = setsOf(catalog);
    const Random random(trial, 5);
    bool fast = catalog.propagateAll();
    bool slow = test::bruteForceConsistency(problem.network(), sets);
    ASSERT_EQ(fast, slow) << trial;
    for (int step = 0; step < 6 && fast; ++step) {
      ASSERT_EQ(setsOf(catalog), sets) << trial << " " << step;
      const int cell = static_cast<int>(random.below(problem.network().cells, step));
      const int label = catalog.firstLabel(cell);
      fast = catalog.assign(cell, label) && catalog.propagate();
      sets[cell].assign(labels, false);
      sets[cell][label] = true;
      slow = test::bruteForceConsistency(problem.network(), sets);
      ASSERT_EQ(fast, slow) << trial << " " << step;
      sound += fast;
    }
    contradictory += !fast;
  }
  EXPECT_GT(sound, 0);
  EXPECT_GT(contradictory, 0);
}

INSTANTIATE_TEST_SUITE_P(Words, CatalogOfLabels, testing::Values(5, 64, 65, 130, 200, 300));

TEST(Catalog, UndoBringsBackEverySet) {
  const Adjacency a = randomAdjacency(70, 0.05, 3, 2);
  const ModelOptions o = freeOptions({6, 6, 1});
  const ModelProblem problem(a, o);
  Catalog catalog(problem.network());
  fill(catalog, problem);
  ASSERT_TRUE(catalog.propagateAll());
  const auto before = setsOf(catalog);
  int contradictions = 0;
  for (int cell = 0; cell < 36; ++cell) {
    const int first = catalog.mark();
    bool sound = true;
    for (int c = cell; c < 36 && sound; ++c) {
      catalog.mark();
      sound = catalog.assign(c, catalog.firstLabel(c)) && catalog.propagate();
    }
    contradictions += !sound;
    catalog.undoTo(first);
    ASSERT_EQ(setsOf(catalog), before);
  }
  EXPECT_GT(contradictions, 0);
}

/// Every labeling of a small grid, one after the other.
bool satisfiable(const Adjacency& a, const Vec3i& size) {
  Array3D<Label> cells(size, 0);
  for (;;) {
    if (test::allowedByRules(a, cells)) return true;
    std::size_t i = 0;
    while (i < cells.count() && ++cells.data()[i] == a.labelCount) cells.data()[i++] = 0;
    if (i == cells.count()) return false;
  }
}

TEST(SearchLabels, DecidesAsEnumerationDoes) {
  int solved = 0, impossible = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const Adjacency a = randomAdjacency(3, 0.3 + 0.002 * trial, trial);
    const ModelOptions o = freeOptions({3, 3, 1});
    const ModelProblem problem(a, o);
    Catalog catalog(problem.network());
    fill(catalog, problem);
    const bool expected = satisfiable(a, o.size);
    if (!catalog.propagateAll()) {
      EXPECT_FALSE(expected) << trial;
      ++impossible;
      continue;
    }
    std::vector<std::int32_t> order(9);
    for (int i = 0; i < 9; ++i) order[i] = i * 4 % 9;
    const auto outcome = searchLabels(
        catalog, order,
        [](int, std::span<const LabelWord> set, int) { return std::countr_zero(set[0]); }, 100000);
    ASSERT_EQ(outcome == Outcome::Complete, expected) << trial;
    ASSERT_NE(outcome, Outcome::Unfinished);
    if (!expected) {
      ++impossible;
      continue;
    }
    ++solved;
    Array3D<Label> cells(o.size);
    for (int c = 0; c < 9; ++c) {
      cells[problem.cellAt(problem.positionOf(c))] = static_cast<Label>(catalog.firstLabel(c));
    }
    EXPECT_TRUE(test::allowedByRules(a, cells)) << trial;
  }
  EXPECT_GT(solved, 20);
  EXPECT_GT(impossible, 20);
}

TEST(SearchLabels, GivesUpWithTheSetsItBeganWith) {
  // Two labels that are never their own neighbors, on an odd ring: impossible, but
  // propagation does not see it.
  Adjacency a = randomAdjacency(3, 0, 0);
  a.rules[0].pairs.clear();
  for (int b = 0; b < 3; ++b) {
    for (int c = 0; c < 3; ++c) {
      if (b != c && b + c != 3) a.rules[0].pairs.push_back({Label(b), Label(c), 1});
    }
  }
  ModelOptions o = freeOptions({5, 1, 1});
  o.periodic.x = true;
  const ModelProblem problem(a, o);
  Catalog catalog(problem.network());
  fill(catalog, problem);
  ASSERT_TRUE(catalog.propagateAll());
  const auto before = setsOf(catalog);
  std::vector<std::int32_t> order{0, 1, 2, 3, 4};
  const auto first = [](int, std::span<const LabelWord> set, int) {
    return std::countr_zero(set[0]);
  };
  EXPECT_EQ(searchLabels(catalog, order, first, 0), Outcome::Unfinished);
  EXPECT_EQ(setsOf(catalog), before);
  EXPECT_EQ(searchLabels(catalog, order, first, 1000), Outcome::Impossible);
}

}  // namespace
}  // namespace exemplar
