// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <thread>

#include "synth/model/examples.h"
#include "synth/model/networks.h"
#include "synth/model/start.h"
#include "voxelize/hears_cancellation.h"

namespace exemplar {
namespace {

/// A labeled grid of paths (`test::figure36`) to take regions from.
class PathsRegion : public testing::Test {
 protected:
  PathsRegion()
      : example_(test::figure36()),
        adjacency_(findAdjacency(example_)),
        options_(optionsOf()),
        problem_(adjacency_, options_),
        base_(problem_.domains(problem_.demands())),
        region_(problem_.network(), base_) {
    const ModelResult result = synthesizeModel(example_, options_);
    labels_.resize(static_cast<std::size_t>(problem_.network().cells));
    for (int c = 0; c < problem_.network().cells; ++c) {
      labels_[c] = result.grid().cells[problem_.cellAt(problem_.positionOf(c))];
    }
  }

  static ModelOptions optionsOf() {
    ModelOptions o{.moves = 0};
    o.size = {20, 20, 1};
    o.choice = LabelChoice::Uniform;
    return o;
  }
  /// Labels at random, all with the same chance.
  static RegionChoice uniformly(std::uint64_t seed) {
    RegionChoice choice{Random(seed, 3)};
    choice.choose = [](const Random& random, int cell, std::span<const LabelWord> set, int draw) {
      int skip = static_cast<int>(random.below(static_cast<std::uint32_t>(labelsIn(set)), cell,
                                               static_cast<std::uint32_t>(draw)));
      int chosen = -1;
      forEachLabel(set, [&](int b) { chosen = skip-- == 0 ? b : chosen; });
      return chosen;
    };
    return choice;
  }
  std::vector<std::int32_t> boxAt(const Vec3i& corner, int side) const {
    return problem_.cellsIn({corner, corner + Vec3i{side, side, 1}}, 0, 1);
  }
  bool sound() const { return consistent(problem_.network(), labels_); }

  LabelGrid example_;
  Adjacency adjacency_;
  ModelOptions options_;
  ModelProblem problem_;
  LabelSets base_;
  Region region_;
  std::vector<Label> labels_;
};

TEST_F(PathsRegion, KeepsTheGridConsistentAndUndoBringsItBack) {
  ASSERT_TRUE(sound());
  int changed = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const std::vector<Label> before = labels_;
    const auto cells = boxAt({static_cast<int>(seed % 5) * 3, static_cast<int>(seed / 5), 0}, 7);
    ASSERT_TRUE(region_.takeBack(cells, labels_));
    ASSERT_EQ(region_.relabel({}, uniformly(seed)), Outcome::Complete);
    EXPECT_EQ(labels_, before) << "before they are kept";
    region_.keep(labels_);
    EXPECT_TRUE(sound());
    for (std::size_t c = 0; c < labels_.size(); ++c) {
      if (std::binary_search(cells.begin(), cells.end(), static_cast<std::int32_t>(c))) continue;
      ASSERT_EQ(labels_[c], before[c]) << "outside the region";
    }
    changed += labels_ != before;
    if (seed % 2) continue;
    region_.undo(labels_);
    EXPECT_EQ(labels_, before);
  }
  EXPECT_GT(changed, 35);
}

TEST_F(PathsRegion, ClosesTheGapAroundWhatIsPutIn) {
  // A piece of the example, 3 x 3 cells with a path in it, in the middle of a region of 9 x 9.
  Vec3i from{1, 1, 0};
  while (example_.cells[from] == 0) ++from.x;
  const auto cells = boxAt({5, 5, 0}, 9);
  ASSERT_TRUE(region_.takeBack(cells, labels_));
  LabelSets one(adjacency_.labelCount, 1);
  for (int i = 0; i < 9; ++i) {
    const Vec3i step{i % 3, i / 3, 0};
    const Label wanted = example_.cells[from - Vec3i{1, 1, 0} + step];
    const int cell = problem_.cell(problem_.position(Vec3i{8, 8, 0} + step));
    const std::int32_t which[1] = {
        static_cast<std::int32_t>(std::find(cells.begin(), cells.end(), cell) - cells.begin())};
    std::fill_n(one.data(), one.words(), LabelWord{0});
    addLabel(one[0], wanted);
    ASSERT_TRUE(region_.demand(which, one[0]));
  }
  ASSERT_EQ(region_.relabel({}, uniformly(1)), Outcome::Complete);
  region_.keep(labels_);
  EXPECT_TRUE(sound());
  for (int i = 0; i < 9; ++i) {
    const Vec3i step{i % 3, i / 3, 0};
    const int cell = problem_.cell(problem_.position(Vec3i{8, 8, 0} + step));
    const Vec3i source = from - Vec3i{1, 1, 0} + step;
    EXPECT_EQ(labels_[cell], example_.cells[source]) << i;
  }
}

TEST_F(PathsRegion, ADemandThatCannotBeMetChangesNothing) {
  const auto cells = boxAt({3, 3, 0}, 6);
  ASSERT_TRUE(region_.takeBack(cells, labels_));
  std::vector<std::vector<LabelWord>> before;
  for (int i = 0; i < region_.count(); ++i) {
    before.emplace_back(region_.possible(i).begin(), region_.possible(i).end());
  }
  std::vector<std::int32_t> all(cells.size());
  std::iota(all.begin(), all.end(), 0);
  // An end of a path everywhere: two ends side by side face each other or nothing.
  LabelSets end(adjacency_.labelCount, 1);
  for (int b = 0; b < adjacency_.labelCount; ++b) {
    if (example_.labels[b].name == "e") addLabel(end[0], b);
  }
  EXPECT_FALSE(region_.demand(all, end[0]));
  for (int i = 0; i < region_.count(); ++i) {
    EXPECT_TRUE(std::ranges::equal(region_.possible(i), before[i])) << i;
  }
  EXPECT_EQ(region_.relabel({}, uniformly(1)), Outcome::Complete);
}

TEST_F(PathsRegion, EachAttemptDrawsItsOwnNumbers) {
  const auto cells = boxAt({4, 4, 0}, 10);
  ASSERT_TRUE(region_.takeBack(cells, labels_));
  std::vector<std::vector<Label>> found;
  RegionChoice choice = uniformly(5);
  choice.fits = [&] {
    std::vector<Label>& labels = found.emplace_back();
    for (int i = 0; i < region_.count(); ++i) labels.push_back(region_.label(i));
    return false;
  };
  RegionEffort effort;
  effort.passes = 3;
  effort.searches = 3;
  effort.exactConflicts = 100000;
  EXPECT_EQ(region_.relabel(effort, choice), Outcome::Unfinished) << "nothing was good enough";
  // Passes may fail; three searches and the exact solver do not here.
  ASSERT_GE(found.size(), 4u);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(std::unique(found.begin(), found.end()), found.end());
  // The same region with the same numbers gives the same labels.
  const auto again = [&] {
    EXPECT_TRUE(region_.takeBack(cells, labels_));
    EXPECT_EQ(region_.relabel({}, uniformly(9)), Outcome::Complete);
    std::vector<Label> labels;
    for (int i = 0; i < region_.count(); ++i) labels.push_back(region_.label(i));
    return labels;
  };
  EXPECT_EQ(again(), again());
}

TEST_F(PathsRegion, EndsWhereWorkWouldTakeMore) {
  const auto cells = boxAt({4, 4, 0}, 10);
  ASSERT_TRUE(region_.takeBack(cells, labels_));
  RegionChoice choice = uniformly(5);
  choice.fits = [] { return false; };  // every way is tried
  RegionEffort effort;
  effort.passes = effort.searches = 1000;
  effort.work = 20'000;
  const std::int64_t before = region_.counts().work;
  EXPECT_EQ(region_.relabel(effort, choice), Outcome::Unfinished);
  const std::int64_t took = region_.counts().work - before;
  EXPECT_GE(took, effort.work / 2) << "it is used";
  EXPECT_LE(took, 2 * effort.work) << "one attempt in order may be under way at its end";
  EXPECT_EQ(region_.counts().exact, 0) << "a hundred cells are more literals than that";

  effort.passes = effort.searches = 0;
  effort.work = 50'000'000;
  EXPECT_EQ(region_.relabel(effort, choice), Outcome::Unfinished);
  EXPECT_EQ(region_.counts().exact, 1) << "where there is room, the exact solver is asked";
}

TEST_F(PathsRegion, RegionsThatDoNotTouchMayBeWorkedOnAtOnce) {
  // Two columns of regions, two cells apart, by one thread after another and by two at once.
  std::vector<Label> serial = labels_, parallel = labels_;
  const auto relabel = [&](std::vector<Label>& labels, int x) {
    Region region(problem_.network(), base_);
    for (int y = 0; y < 14; ++y) {
      if (!region.takeBack(boxAt({x, y, 0}, 6), labels)) continue;
      if (region.relabel({}, uniformly(static_cast<std::uint64_t>(y))) != Outcome::Complete)
        continue;
      region.keep(labels);
    }
  };
  relabel(serial, 2);
  relabel(serial, 10);
  std::thread other([&] { relabel(parallel, 2); });
  relabel(parallel, 10);
  other.join();
  EXPECT_EQ(serial, parallel);
  EXPECT_NE(serial, labels_);
}

TEST_F(PathsRegion, EveryStepHearsCancellation) {
  const std::atomic<bool> cancel = true;
  const Progress cancelled({}, &cancel);
  const auto cells = boxAt({3, 3, 0}, 6);
  ASSERT_TRUE(region_.takeBack(cells, labels_));
  for (const RegionEffort& effort : {RegionEffort{.passes = 1, .searches = 0, .exactConflicts = 0},
                                     RegionEffort{.passes = 0, .searches = 1, .exactConflicts = 0},
                                     RegionEffort{.passes = 0, .searches = 0}}) {
    EXPECT_THROW((void)region_.relabel(effort, uniformly(1), cancelled), Cancelled);
  }
}

TEST(Region, DecidesAsEnumerationDoes) {
  // The middle row of three of random rules, within all labelings of the other two: whether labels
  // exist for it, and which labels its cells may have.
  int solved = 0, impossible = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Adjacency a = test::randomAdjacency(3, 0.55, trial);
    const ModelOptions o = test::freeOptions({3, 3, 1});
    const ModelProblem problem(a, o);
    const LabelSets base = problem.domains(problem.demands());
    Region region(problem.network(), base);
    const Random random(trial, 8);
    std::vector<Label> labels(9);
    for (int c = 0; c < 9; ++c) labels[c] = static_cast<Label>(random.below(3, c));
    const std::vector<std::int32_t> cells{1, 4, 7};  // y = 1
    bool expected = false;
    for (int n = 0; n < 27; ++n) {
      std::vector<Label> all = labels;
      all[1] = static_cast<Label>(n % 3);
      all[4] = static_cast<Label>(n / 3 % 3);
      all[7] = static_cast<Label>(n / 9);
      // Only pairs with a cell of the region count.
      bool allowed = true;
      for (const std::int32_t c : cells) {
        problem.network().forEachNeighbor(c, [&](int far, int relation) {
          allowed = allowed && containsLabel(problem.network().support[relation][all[c]], all[far]);
        });
      }
      expected = expected || allowed;
    }
    RegionChoice choice{Random(trial)};
    choice.choose = [](const Random&, int, std::span<const LabelWord> set, int) {
      return std::countr_zero(set[0]);
    };
    const bool possible = region.takeBack(cells, labels);
    const Outcome outcome = possible ? region.relabel({}, choice) : Outcome::Impossible;
    ASSERT_EQ(outcome, expected ? Outcome::Complete : Outcome::Impossible) << trial;
    ++(expected ? solved : impossible);
    if (!expected) continue;
    region.keep(labels);
    for (const std::int32_t c : cells) {
      problem.network().forEachNeighbor(c, [&](int far, int relation) {
        EXPECT_TRUE(containsLabel(problem.network().support[relation][labels[c]], labels[far]));
      });
    }
  }
  EXPECT_GT(solved, 10);
  EXPECT_GT(impossible, 10);
}

}  // namespace
}  // namespace exemplar
