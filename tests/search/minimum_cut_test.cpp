// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/minimum_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/array3d.h"
#include "core/random.h"
#include "search/graph_cut.h"
#include "search/lattice_cut.h"

namespace exemplar {
namespace {

struct Edge {
  int a, b, direction;
  std::int64_t cost, reverse;
};

/// A cut problem, so that its value can be taken of any labeling.
struct Problem {
  std::vector<std::int64_t> terminal;
  std::vector<Edge> edges;

  std::int64_t cost(std::uint32_t second) const {
    std::int64_t sum = 0;
    for (std::size_t n = 0; n < terminal.size(); ++n) {
      if (second >> n & 1) sum += terminal[n];
    }
    for (const Edge& e : edges) {
      const bool a = second >> e.a & 1, b = second >> e.b & 1;
      if (!a && b) sum += e.cost;
      if (a && !b) sum += e.reverse;
    }
    return sum;
  }
  std::uint32_t solve() const {
    LatticeCut cut(static_cast<int>(terminal.size()));
    for (std::size_t n = 0; n < terminal.size(); ++n) {
      // In two parts: they add up.
      cut.addTerminal(static_cast<int>(n), terminal[n] - 3);
      cut.addTerminal(static_cast<int>(n), 3);
    }
    for (const Edge& e : edges) cut.connect(e.a, e.b, e.direction, e.cost, e.reverse);
    cut.solve();
    std::uint32_t second = 0;
    for (std::size_t n = 0; n < terminal.size(); ++n) {
      if (cut.onSecondSide(static_cast<int>(n))) second |= 1u << n;
    }
    return second;
  }
  /// The same as a graph that knows of no lattice.
  std::vector<bool> solveAsGraph() const {
    GraphCut cut(static_cast<int>(terminal.size()));
    for (std::size_t n = 0; n < terminal.size(); ++n)
      cut.addTerminal(static_cast<int>(n), terminal[n]);
    for (const Edge& e : edges) cut.connect(e.a, e.b, e.cost, e.reverse);
    cut.solve();
    std::vector<bool> second;
    for (std::size_t n = 0; n < terminal.size(); ++n)
      second.push_back(cut.onSecondSide(static_cast<int>(n)));
    return second;
  }
  std::vector<bool> solveAsLattice() const {
    LatticeCut cut(static_cast<int>(terminal.size()));
    for (std::size_t n = 0; n < terminal.size(); ++n)
      cut.addTerminal(static_cast<int>(n), terminal[n]);
    for (const Edge& e : edges) cut.connect(e.a, e.b, e.direction, e.cost, e.reverse);
    cut.solve();
    std::vector<bool> second;
    for (std::size_t n = 0; n < terminal.size(); ++n)
      second.push_back(cut.onSecondSide(static_cast<int>(n)));
    return second;
  }
};

/// Random capacities below `range`, of which many are 0 and none is below; each pair of neighbors
/// is connected from either of its ends.
Problem randomProblem(const Vec3i& size, int range, std::uint64_t seed) {
  const Random random(seed);
  const Array3D<int> lattice(size);
  Problem problem;
  std::uint64_t draw = 0;
  const auto capacity = [&] {
    const int c = static_cast<int>(random.below(3 * range, draw++)) - 2 * range;
    return std::int64_t{std::max(c, 0)};
  };
  for (std::size_t n = 0; n < lattice.count(); ++n) {
    problem.terminal.push_back(static_cast<int>(random.below(4 * range + 1, draw++)) - 2 * range);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i next = lattice.ijk(n);
      ++next[axis];
      if (!lattice.contains(next) || random.below(8, draw++) == 0) continue;
      const int a = static_cast<int>(n), b = static_cast<int>(lattice.index(next));
      const std::int64_t cost = capacity(), reverse = capacity();
      if (random.below(2, draw++)) {
        problem.edges.push_back({a, b, 2 * axis, cost, reverse});
      } else {
        problem.edges.push_back({b, a, 2 * axis + 1, cost, reverse});
      }
    }
  }
  return problem;
}

TEST(LatticeCut, IsTheLeastOfAllLabelings) {
  int different = 0;
  for (const Vec3i& size : {Vec3i{12, 1, 1}, Vec3i{2, 2, 2}, Vec3i{3, 2, 2}, Vec3i{4, 3, 1},
                            Vec3i{1, 2, 6}, Vec3i{1, 1, 1}}) {
    for (int trial = 0; trial < 150; ++trial) {
      const Problem problem = randomProblem(size, trial % 3 == 0 ? 2 : 100, trial);
      std::int64_t least = std::numeric_limits<std::int64_t>::max();
      std::uint32_t fewest = 0;
      for (std::uint32_t labeling = 0; labeling < 1u << volume(size); ++labeling) {
        const std::int64_t cost = problem.cost(labeling);
        if (cost < least) {
          least = cost;
          fewest = labeling;
        } else if (cost == least) {
          fewest &= labeling;  // least cuts are closed under intersection
        }
      }
      const std::uint32_t found = problem.solve();
      ASSERT_EQ(problem.cost(found), least);
      ASSERT_EQ(found, fewest);
      different += problem.cost(found ^ 1) != least;
    }
  }
  EXPECT_GT(different, 300);  // that another labeling costs more can be seen
}

TEST(LatticeCut, TerminalsAloneDecideWhereNothingIsConnected) {
  const Problem problem{{5, -5, 0, -1, 1}, {}};
  EXPECT_EQ(problem.solve(), 0b01010u);
}

TEST(LatticeCut, ZeroCapacitiesConnectNothing) {
  Problem problem{{5, -5, 0, -1}, {}};
  for (int n = 0; n < 3; ++n) problem.edges.push_back({n, n + 1, 0, 0, 0});
  EXPECT_EQ(problem.solve(), 0b1010u);
}

TEST(LatticeCut, NothingAtAllStaysOnTheFirstSide) {
  Problem problem{{0, 0, 0, 0}, {}};
  for (int n = 0; n < 3; ++n) problem.edges.push_back({n, n + 1, 0, 7, 7});
  EXPECT_EQ(problem.solve(), 0u);
}

TEST(LatticeCut, AChainBreaksAtItsWeakestLink) {
  // The first wants the first side, the last the second; the link of cost 2 is the third.
  Problem problem{{100, 0, 0, 0, 0, -100}, {}};
  const std::int64_t cost[] = {9, 5, 2, 3, 8};
  for (int n = 0; n < 5; ++n) problem.edges.push_back({n, n + 1, 2, cost[n], 50});
  EXPECT_EQ(problem.solve(), 0b111000u);
}

TEST(LatticeCut, DirectionsOfAPairHaveCapacitiesOfTheirOwn) {
  EXPECT_EQ((Problem{{10, -10}, {{0, 1, 0, 0, 1000}}}.solve()), 0b10u);
  EXPECT_EQ((Problem{{10, -10}, {{0, 1, 0, 1000, 0}}}.solve()), 0u);
  EXPECT_EQ((Problem{{10, -11}, {{0, 1, 0, 1000, 0}}}.solve()), 0b11u);
}

TEST(LatticeCut, LargeCapacitiesDoNotOverflow) {
  const std::int64_t large = std::int64_t{1} << 60;
  EXPECT_EQ((Problem{{large, -large}, {{0, 1, 4, large - 1, large}}}.solve()), 0b10u);
}

TEST(GraphCut, CutsLatticesAsTheLatticeCutDoes) {
  std::size_t second = 0, all = 0;
  for (const Vec3i& size : {Vec3i{20, 15, 1}, Vec3i{9, 8, 7}, Vec3i{200, 2, 1}}) {
    for (int trial = 0; trial < 30; ++trial) {
      const Problem problem = randomProblem(size, trial % 2 ? 3 : 1000, trial);
      const std::vector<bool> found = problem.solveAsGraph();
      ASSERT_EQ(found, problem.solveAsLattice());
      second += static_cast<std::size_t>(std::ranges::count(found, true));
      all += found.size();
    }
  }
  EXPECT_GT(second, all / 10);  // both sides occur
  EXPECT_LT(second, all - all / 10);
}

TEST(GraphCut, IsTheLeastOfAllLabelingsOfAnyGraph) {
  for (int trial = 0; trial < 200; ++trial) {
    const Random random(static_cast<std::uint64_t>(trial));
    const int nodes = 3 + trial % 9;
    Problem problem;
    std::uint64_t draw = 0;
    for (int n = 0; n < nodes; ++n)
      problem.terminal.push_back(static_cast<int>(random.below(41, draw++)) - 20);
    for (int e = 0; e < 3 * nodes; ++e) {  // some pairs several times
      const int a = static_cast<int>(random.below(static_cast<std::uint32_t>(nodes), draw++));
      const int b = static_cast<int>(random.below(static_cast<std::uint32_t>(nodes), draw++));
      if (a == b) continue;
      problem.edges.push_back({a, b, 0, random.below(12, draw), random.below(12, draw + 1)});
      draw += 2;
    }
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (std::uint32_t labeling = 0; labeling < 1u << nodes; ++labeling)
      least = std::min(least, problem.cost(labeling));
    const std::vector<bool> found = problem.solveAsGraph();
    std::uint32_t labeling = 0;
    for (int n = 0; n < nodes; ++n) labeling |= static_cast<std::uint32_t>(found[n]) << n;
    ASSERT_EQ(problem.cost(labeling), least) << "trial " << trial;
  }
}

}  // namespace
}  // namespace exemplar
