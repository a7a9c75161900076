// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What a request may demand: pins, masks, weights, symmetry, time, further offsets.

#include "synth/model/synthesize.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <set>

#include "core/error.h"
#include "synth/model/examples.h"
#include "synth/model/networks.h"
#include "voxelize/hears_cancellation.h"
#include "voxelize/violations.h"

namespace exemplar {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

int labelNamed(const LabelGrid& grid, const std::string& name) {
  for (int b = 0; b < grid.labelCount(); ++b) {
    if (grid.labels[b].name == name) return b;
  }
  ADD_FAILURE() << "no label " << name;
  return 0;
}

TEST(SynthesizeModel, HonorsPinsMasksAndWeights) {
  const LabelGrid example = test::figure36();
  ModelOptions o{.moves = 0};
  o.size = {20, 20, 1};
  o.choice = LabelChoice::Uniform;
  o.pins = {{{5, 5, 0}, {static_cast<Label>(labelNamed(example, "ew"))}},
            {{15, 9, 0}, {static_cast<Label>(labelNamed(example, "n"))}}};
  o.mask = Array3D<std::uint8_t>(o.size, 1);
  for (int i = 8; i < 12; ++i) o.mask(i, i, 0) = 0;
  o.weights.assign(example.labelCount(), 1);
  const Label banned = static_cast<Label>(labelNamed(example, "es"));
  o.weights[banned] = 0;
  for (const ModelMethod method : {ModelMethod::Whole, ModelMethod::Blocks}) {
    o.method = method;
    const ModelResult r = synthesizeModel(example, o);
    ASSERT_EQ(r.outcome, Outcome::Complete);
    for (const PinnedCell& p : o.pins) EXPECT_EQ(r.grid().cells[p.cell], p.labels[0]);
    for (const Label b : r.grid().cells.values()) EXPECT_NE(b, banned);
    for (int i = 8; i < 12; ++i) EXPECT_EQ(r.grid().cells(i, i, 0), 0);
    ViolationOptions v;
    v.mask = &o.mask;
    EXPECT_EQ(findViolations(r.grid(), example, v).count, 0);
  }
}

TEST(SynthesizeModel, PutsLabelsWhereAWeightMapWantsThem) {
  const LabelGrid example = test::figure36();
  ModelOptions o{.moves = 0};
  o.size = {30, 30, 1};
  WeightMap empty{{0}, Array3D<float>(o.size, 1.f)};
  for (int i = 0; i < 30; ++i) {
    for (int j = 0; j < 30; ++j) empty.weight(i, j, 0) = i < 15 ? 100.f : 0.01f;
  }
  o.weightMaps.push_back(empty);
  for (const ModelMethod method : {ModelMethod::Whole, ModelMethod::Blocks}) {
    o.method = method;
    const ModelResult r = synthesizeModel(example, o);
    ASSERT_EQ(r.outcome, Outcome::Complete);
    int left = 0, right = 0;
    for (int i = 1; i < 29; ++i) {
      for (int j = 1; j < 29; ++j) (i < 15 ? left : right) += r.grid().cells(i, j, 0) != 0;
    }
    EXPECT_GT(right, 3 * left);
  }
}

TEST(SynthesizeModel, RepeatsAlongPeriodicAxes) {
  const LabelGrid example = test::figure36();
  ModelOptions o{.moves = 0};
  o.size = {13, 11, 1};
  o.periodic = {true, true, false};
  o.choice = LabelChoice::Uniform;
  ViolationOptions v;
  v.periodic = o.periodic;
  for (const ModelMethod method : {ModelMethod::Whole, ModelMethod::Blocks}) {
    for (int seed = 0; seed < 5; ++seed) {
      o.method = method;
      o.seed = seed;
      const ModelResult r = synthesizeModel(example, o);
      ASSERT_EQ(r.outcome, Outcome::Complete);
      EXPECT_EQ(findViolations(r.grid(), example, v).count, 0);
    }
  }
}

TEST(SynthesizeModel, JoinsFarEnds) {
  // Six ends far apart and no others: three paths must find their ways.
  const LabelGrid example = test::figure36();
  std::vector<Label> ends;
  for (const char* name : {"e", "n", "w", "s"}) {
    ends.push_back(static_cast<Label>(labelNamed(example, name)));
  }
  ModelOptions o{.moves = 0};
  o.size = {24, 24, 1};
  o.choice = LabelChoice::Uniform;
  WeightMap elsewhere{ends, Array3D<float>(o.size, 0.f)};
  for (const Vec3i p : {Vec3i{2, 3, 0}, Vec3i{3, 19, 0}, Vec3i{9, 11, 0}, Vec3i{14, 4, 0},
                        Vec3i{21, 20, 0}, Vec3i{20, 7, 0}}) {
    elsewhere.weight[p] = 1;
    o.pins.push_back({p, ends});
  }
  o.weightMaps.push_back(elsewhere);
  for (int seed = 0; seed < 10; ++seed) {
    o.seed = seed;
    const ModelResult r = synthesizeModel(example, o);
    ASSERT_EQ(r.outcome, Outcome::Complete) << seed;
    EXPECT_EQ(findViolations(r.grid(), example).count, 0);
  }
}

/// Where a path label's exits go after a mirroring across x or y or a quarter turn.
std::vector<Label> mapped(const LabelGrid& example, const std::string& from,
                          const std::string& to) {
  std::vector<Label> table;
  for (const LabelLook& look : example.labels) {
    std::string name = look.name == "." ? "" : look.name;
    for (char& c : name) {
      if (const auto at = from.find(c); at != std::string::npos) c = to[at];
    }
    std::sort(name.begin(), name.end());
    table.push_back(static_cast<Label>(labelNamed(example, name.empty() ? "." : name)));
  }
  return table;
}

TEST(SynthesizeModel, IsSymmetricWhereAsked) {
  const LabelGrid example = test::figure36();
  const auto mirroredX = mapped(example, "ew", "we");
  const auto mirroredY = mapped(example, "ns", "sn");
  const auto turned = mapped(example, "enws", "nwse");
  for (const int n : {12, 13}) {
    for (int kind = 0; kind < 5; ++kind) {
      ModelOptions o{.moves = 0};
      o.size = {n, n, 1};
      o.choice = LabelChoice::Uniform;
      o.symmetry.mirroredX = mirroredX;
      o.symmetry.mirroredY = mirroredY;
      o.symmetry.turned = turned;
      o.symmetry.mirrorX = kind == 0 || kind == 3;
      o.symmetry.mirrorY = kind == 3;
      o.symmetry.turns = kind == 1 ? 2 : kind == 2 ? 4 : 1;
      if (kind == 4) o.symmetry.copies = {n == 12 ? 3 : 1, n == 12 ? 2 : 13, 1};
      const ModelResult r = synthesizeModel(example, o);
      ASSERT_EQ(r.outcome, Outcome::Complete) << kind;
      const Array3D<Label>& c = r.grid().cells;
      EXPECT_EQ(findViolations(r.grid(), example).count, 0) << kind << " " << n;
      int paths = 0;
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          paths += c(i, j, 0) != 0;
          if (o.symmetry.mirrorX) {
            EXPECT_EQ(c(n - 1 - i, j, 0), mirroredX[c(i, j, 0)]);
          }
          if (o.symmetry.mirrorY) {
            EXPECT_EQ(c(i, n - 1 - j, 0), mirroredY[c(i, j, 0)]);
          }
          if (kind == 2) {
            EXPECT_EQ(c(n - 1 - j, i, 0), turned[c(i, j, 0)]);
          }
          if (kind == 1) {
            EXPECT_EQ(c(n - 1 - i, n - 1 - j, 0), turned[turned[c(i, j, 0)]]);
          }
          if (kind == 4) {
            const Vec3i part{n / o.symmetry.copies.x, n / o.symmetry.copies.y, 1};
            EXPECT_EQ(c(i, j, 0), c(i % part.x, j % part.y, 0));
          }
        }
      }
      // Rows that are all alike can only be empty.
      if (kind != 4 || n == 12) {
        EXPECT_GT(paths, 0) << kind;
      }
    }
  }
}

/// The rolling ball of the thesis' figure 3.27: empty, leaving to the right, moving within, coming
/// in from the left; one row of cells that changes over time.
std::vector<LabelGrid> rollingBall() {
  // Frame f: the ball crosses cell f / 2 from the left edge on, then leaves it for the next.
  std::vector<LabelGrid> frames;
  for (int f = 0; f < 8; ++f) {
    LabelGrid g;
    g.cells = Array3D<Label>({6, 1, 1}, 0);
    g.labels.resize(4);
    const int cell = f / 2 + 1;
    if (f % 2 == 0) {
      g.cells(cell, 0, 0) = 1;  // moves from the left edge to the right
    } else {
      g.cells(cell, 0, 0) = 2;  // goes out at the right
      g.cells(cell + 1, 0, 0) = 3;
    }
    frames.push_back(g);
  }
  return frames;
}

TEST(SynthesizeModel, MakesModelsThatChangeOverTime) {
  const std::vector<LabelGrid> example = rollingBall();
  AdjacencyOptions frames;
  frames.frames = true;
  const Adjacency a = findAdjacency(example, frames);
  ModelOptions o{.moves = 0};
  o.size = {40, 1, 1};
  o.frames = 30;
  o.choice = LabelChoice::Uniform;
  for (SideRule& s : o.sides) s.kind = SideRule::Kind::Free;
  o.pins = {{{3, 0, 0}, {1}, 2}};
  const ModelResult r = synthesizeModel(example, a, o);
  ASSERT_EQ(r.outcome, Outcome::Complete) << r.conflict.text;
  ASSERT_EQ(r.frames.size(), 30u);
  ViolationOptions v;
  v.adjacency = frames;
  EXPECT_EQ(findViolations(r.frames, example, v).count, 0);
  // A ball that moves in a cell goes out of it in the next frame and is in the next cell after.
  int balls = 0;
  for (int f = 0; f + 2 < o.frames; ++f) {
    for (int i = 0; i + 1 < o.size.x; ++i) {
      if (r.frames[f].cells(i, 0, 0) != 1) continue;
      ++balls;
      EXPECT_EQ(r.frames[f + 1].cells(i, 0, 0), 2);
      EXPECT_EQ(r.frames[f + 1].cells(i + 1, 0, 0), 3);
      EXPECT_EQ(r.frames[f + 2].cells(i + 1, 0, 0), 1);
    }
  }
  EXPECT_GT(balls, 5);
}

TEST(SynthesizeModel, KeepsRulesAtFurtherOffsets) {
  // Three colors on a hexagonal grid, no two alike side by side: with the axis (1, -1) there are
  // just six such patterns, without it there are many.
  LabelGrid example;
  example.cells = Array3D<Label>({9, 9, 1});
  example.labels.resize(3);
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) example.cells(i, j, 0) = static_cast<Label>((i + 2 * j) % 3);
  }
  AdjacencyOptions hexagonal;
  hexagonal.offsets = {{1, -1, 0, 0}, {2, 0, 0, 0}};
  const Adjacency a = findAdjacency(example, hexagonal);
  ASSERT_EQ(a.rules.size(), 5u);
  ModelOptions o{.moves = 0};
  o.size = {15, 12, 1};
  ViolationOptions v;
  v.adjacency = hexagonal;
  const ModelResult r = synthesizeModel(std::span(&example, 1), a, o);
  ASSERT_EQ(r.outcome, Outcome::Complete);
  EXPECT_EQ(findViolations(r.grid(), example, v).count, 0);
  for (int i = 0; i < 15; ++i) {
    for (int j = 0; j < 12; ++j) {
      EXPECT_EQ(r.grid().cells(i, j, 0), (r.grid().cells(0, 0, 0) + i + 2 * j) % 3);
    }
  }
}

TEST(SynthesizeModel, OriginsHaveTheLabelAndFollowTheExample) {
  const LabelGrid example = test::parliament();
  ModelOptions o{.moves = 0};
  o.size = {30, 30, 10};
  const ModelResult r = synthesizeModel(example, o);
  ASSERT_EQ(r.outcome, Outcome::Complete);
  ASSERT_EQ(r.origins.size(), 1u);
  int together = 0, pairs = 0;
  for (std::size_t i = 0; i < r.grid().cells.count(); ++i) {
    const Vec3i p = r.grid().cells.ijk(i);
    const Origin from = r.origins[0][p];
    ASSERT_TRUE(example.cells.contains(from.cell()));
    ASSERT_EQ(example.cells[from.cell()], r.grid().cells[p]);
    if (p.x == 0) continue;
    const Origin left = r.origins[0][p - Vec3i{1, 0, 0}];
    ++pairs;
    together += left.cell() + Vec3i{1, 0, 0} == from.cell();
  }
  EXPECT_GT(together, pairs / 2);
}

TEST(SynthesizeModel, TurnsDownWhatCannotBeHonored) {
  const LabelGrid example = test::figure36();
  const auto message = [&](const auto& change) -> std::string {
    ModelOptions o{.moves = 0};
    o.size = {8, 8, 1};
    change(o);
    try {
      (void)synthesizeModel(example, o);
    } catch (const InputError& e) {
      return e.what();
    }
    return "nothing";
  };
  EXPECT_THAT(message([](ModelOptions& o) {
                o.size = {8, 0, 1};
              }),
              StartsWith("`size` 8 x 0 x 1: each side must be 1 or more"));
  EXPECT_THAT(message([](ModelOptions& o) { o.size.z = 3; }),
              StartsWith("`size` 8 x 8 x 3: the example is one cell thick along z"));
  EXPECT_THAT(message([](ModelOptions& o) { o.frames = 2; }),
              StartsWith("`frames` 2: the example has no frames"));
  EXPECT_THAT(message([](ModelOptions& o) {
                o.pins = {{{8, 0, 0}, {0}}};
              }),
              StartsWith("`pin` number 1: cell (8, 0, 0) is outside"));
  EXPECT_THAT(message([](ModelOptions& o) {
                o.pins = {{{1, 0, 0}, {999}}};
              }),
              StartsWith("`pin` number 1: names label 999"));
  EXPECT_THAT(message([](ModelOptions& o) {
                o.pins = {{{1, 0, 0}, {}}};
              }),
              StartsWith("`pin` number 1: allows no label"));
  EXPECT_THAT(message([](ModelOptions& o) {
                o.weights = {1, 2};
              }),
              StartsWith("`weight`: there are 2 weights"));
  EXPECT_THAT(message([](ModelOptions& o) {
                o.weightMaps = {{{0}, Array3D<float>({3, 3, 1}, 1.f)}};
              }),
              StartsWith("`weight-map`: it is 3 x 3 x 1 cells"));
  EXPECT_THAT(message([](ModelOptions& o) {
                o.mask = Array3D<std::uint8_t>({2, 2, 1}, 1);
              }),
              StartsWith("`mask`: it is 2 x 2 x 1 cells"));
  EXPECT_THAT(message([](ModelOptions& o) { o.rounds = 0; }), StartsWith("`rounds` 0: must be 1"));
  EXPECT_THAT(message([](ModelOptions& o) { o.budget = 0; }), StartsWith("`budget` 0: must be 1"));
  EXPECT_THAT(message([](ModelOptions& o) { o.patience = -1; }), StartsWith("`patience` -1: must"));
  EXPECT_THAT(message([](ModelOptions& o) {
                o.counts = {{{0}, 5, 3}};
              }),
              StartsWith("`count`: at least 5 and at most 3 exclude each other"));
  EXPECT_THAT(message([](ModelOptions& o) {
                o.sides[0] = {SideRule::Kind::Labels, {}};
              }),
              StartsWith("`side`: allows no label"));
  EXPECT_THAT(message([](ModelOptions& o) {
                o.block = {1, 4, 4};
              }),
              StartsWith("`block` 1 x 4 x 4: each side must be 2"));
  EXPECT_THAT(message([](ModelOptions& o) { o.symmetry.turns = 3; }),
              StartsWith("`turns` 3: must be 1, 2 or 4"));
  EXPECT_THAT(message([](ModelOptions& o) {
                o.symmetry.copies = {3, 1, 1};
              }),
              StartsWith("`copies` 3: they do not divide"));
  EXPECT_THAT(message([](ModelOptions& o) {
                o.size = {100000, 100000, 1};
              }),
              HasSubstr("use a smaller `size`"));
}

}  // namespace
}  // namespace exemplar
