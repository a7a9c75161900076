// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Deciding whether a model can be completed is NP-complete (Merrell 2007, appendix; thesis, section
// 3.3.5): formulas with three literals a clause become grids with wires, gates that negate and
// gates that ask for one true input. Satisfiable formulas complete, the others are proved not to.

#include <gtest/gtest.h>

#include <array>

#include "synth/model/networks.h"
#include "synth/model/synthesize.h"

namespace exemplar {
namespace {

using Clause = std::array<int, 3>;  // literals: variable + 1, negative where negated

/// What a label shows at its left, right, lower and upper face: a wall, false, true, or either.
struct Ports {
  char left, right, down, up;
};

// Wall; wire false, wire true; two wires that cross without touching, in four states; a gate that
// negates from left to right, in two; a gate of three inputs, one of which (left, up, down) is
// true.
constexpr std::array<Ports, 12> kLabels{{{'-', '-', '-', '-'},
                                         {'0', '0', '0', '0'},
                                         {'1', '1', '1', '1'},
                                         {'0', '0', '0', '0'},
                                         {'0', '0', '1', '1'},
                                         {'1', '1', '0', '0'},
                                         {'1', '1', '1', '1'},
                                         {'0', '1', '-', '-'},
                                         {'1', '0', '-', '-'},
                                         {'1', '-', '*', '*'},
                                         {'*', '-', '*', '1'},
                                         {'*', '-', '1', '*'}}};
const std::vector<Label> kWire{1, 2}, kCrossing{3, 4, 5, 6}, kNot{7, 8}, kOr{9, 10, 11};

bool match(char a, char b) { return a == '-' || b == '-' || a == '*' || b == '*' || a == b; }

Adjacency gateRules() {
  Adjacency a = test::randomAdjacency(static_cast<int>(kLabels.size()), 0, 0);
  for (int axis = 0; axis < 2; ++axis) a.rules[axis].pairs.clear();
  for (int b = 0; b < a.labelCount; ++b) {
    for (int c = 0; c < a.labelCount; ++c) {
      const LabelPair pair{static_cast<Label>(b), static_cast<Label>(c), 1};
      if (match(kLabels[b].right, kLabels[c].left)) a.rules[0].pairs.push_back(pair);
      if (match(kLabels[b].up, kLabels[c].down)) a.rules[1].pairs.push_back(pair);
    }
  }
  return a;
}

/// Variables run upwards at every third column; each clause takes six rows: three wires leave three
/// of them to the right, cross the others, and end in one gate.
ModelOptions gridOf(const std::vector<Clause>& formula, int variables) {
  const int width = 3 * variables + 4, end = width - 2;
  ModelOptions o = test::freeOptions({width, 6 * static_cast<int>(formula.size()) + 1, 1});
  Array3D<const std::vector<Label>*> allowed(o.size, nullptr);
  for (int v = 0; v < variables; ++v) {
    for (int y = 0; y < o.size.y; ++y) allowed(3 * v + 1, y, 0) = &kWire;
  }
  for (std::size_t c = 0; c < formula.size(); ++c) {
    for (int l = 0; l < 3; ++l) {
      const int y = 6 * static_cast<int>(c) + 1 + 2 * l;
      const int from = 3 * (std::abs(formula[c][l]) - 1) + 1;
      for (int x = from + 1; x <= end; ++x) {
        const bool crossing = x % 3 == 1 && x < 3 * variables;
        allowed(x, y, 0) = crossing ? &kCrossing : &kWire;
      }
      if (formula[c][l] < 0) allowed(from + 1, y, 0) = &kNot;
      if (l != 1) allowed(end, y + (l == 0 ? 1 : -1), 0) = &kWire;
    }
    allowed(end, 6 * static_cast<int>(c) + 3, 0) = &kOr;
  }
  static const std::vector<Label> wall{0};
  for (std::size_t i = 0; i < allowed.count(); ++i) {
    const std::vector<Label>* labels = allowed.data()[i];
    o.pins.push_back({allowed.ijk(i), labels ? *labels : wall});
  }
  return o;
}

bool satisfied(const std::vector<Clause>& formula, unsigned values) {
  for (const Clause& c : formula) {
    bool any = false;
    for (const int l : c) any = any || ((values >> (std::abs(l) - 1) & 1) != 0) == (l > 0);
    if (!any) return false;
  }
  return true;
}

bool satisfiable(const std::vector<Clause>& formula, int variables) {
  for (unsigned v = 0; v < 1u << variables; ++v) {
    if (satisfied(formula, v)) return true;
  }
  return false;
}

void expectDecided(const std::vector<Clause>& formula, int variables, std::uint64_t seed) {
  const Adjacency rules = gateRules();
  const LabelGrid labels = test::gridOfLabels(rules.labelCount);
  ModelOptions o = gridOf(formula, variables);
  o.seed = seed;
  const ModelResult r = synthesizeModel(std::span(&labels, 1), rules, o);
  if (!satisfiable(formula, variables)) {
    EXPECT_EQ(r.outcome, Outcome::Impossible);
    EXPECT_FALSE(r.conflict.pins.empty());
    return;
  }
  ASSERT_EQ(r.outcome, Outcome::Complete);
  unsigned values = 0;
  for (int v = 0; v < variables; ++v) values |= (r.grid().cells(3 * v + 1, 0, 0) == 2) << v;
  EXPECT_TRUE(satisfied(formula, values));
}

TEST(ThreeSat, TheThesisFormulaIsSatisfied) {
  expectDecided({{1, 2, 4}, {2, 3, 4}, {-1, 2, -4}}, 4, 0);
}

TEST(ThreeSat, AVariableCannotBeTrueAndFalse) { expectDecided({{1, 1, 1}, {-1, -1, -1}}, 1, 0); }

TEST(ThreeSat, RandomFormulasAreDecidedAsByTruthTable) {
  int yes = 0, no = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const Random random(trial, 9);
    const int variables = 3;
    std::vector<Clause> formula(8 + 2 * trial);
    for (std::size_t c = 0; c < formula.size(); ++c) {
      for (int l = 0; l < 3; ++l) {
        const int v = static_cast<int>(random.below(variables, 3 * c + l)) + 1;
        formula[c][l] = random.below(2, 3 * c + l, 1) ? v : -v;
      }
    }
    ++(satisfiable(formula, variables) ? yes : no);
    expectDecided(formula, variables, trial);
  }
  EXPECT_GE(yes, 2);
  EXPECT_GE(no, 1);
}

}  // namespace
}  // namespace exemplar
