// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/layered/layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "core/cells.h"
#include "core/disjoint_sets.h"
#include "core/error.h"
#include "maps/distance_transform.h"
#include "measure/layers.h"
#include "synth/layered/auction.h"
#include "synth/layered/texture_by_numbers.h"
#include "tests/progress_checks.h"
#include "tests/synth/layered/layer_samples.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::discs;
using testing::noiseLayers;

Shape randomShape(int width, int height, std::uint64_t seed) {
  return layerShape(noiseLayers(width, height, 2, seed), 2);
}

// --- Patches -----------------------------------------------------------------------------------

TEST(BoundaryPatches, DifferByAsManyPixelsAsAreCounted) {
  const Shape a = randomShape(60, 50, 1), b = randomShape(70, 45, 2);
  constexpr int kSide = 11, kHalf = kSide / 2;
  const std::vector<Vec3i> ofA = boundaryOf(a, true), ofB = boundaryOf(b, false);
  const BoundaryPatches set(a, ofA, kSide, 1, true), examples(b, ofB, kSide, 8, false);
  int partial = 0;
  for (std::size_t i = 0; i < ofA.size(); i += 7) {
    for (std::size_t j = 0; j < ofB.size(); j += 11) {
      for (int turn = 0; turn < 8; ++turn) {
        int differing = 0, known = 0;
        for (int dy = -kHalf; dy <= kHalf; ++dy) {
          for (int dx = -kHalf; dx <= kHalf; ++dx) {
            const Vec3i place = ofB[j] + turnedAboutZ({dx, dy, 0}, turn);
            if (!b.contains(place)) continue;
            ++known;
            differing += b[place] != a[wrappedPlace(ofA[i] + Vec3i{dx, dy, 0}, a.size())];
          }
        }
        partial += known < kSide * kSide;
        EXPECT_EQ(patchDistance(set, i, examples, j, turn),
                  std::lround(static_cast<double>(differing) * kSide * kSide / known));
      }
    }
  }
  EXPECT_GT(partial, 0);
}

TEST(BoundaryPatches, TurnFourTimesToWhatTheyWere) {
  for (int turn = 0; turn < 8; ++turn) {
    Vec3i step{3, -2, 5};
    for (int t = 0; t < 4; ++t) step = turnedAboutZ(step, turn);
    EXPECT_EQ(step, (Vec3i{3, -2, 5})) << turn;
  }
  // Eight different places.
  std::set<std::pair<int, int>> places;
  for (int turn = 0; turn < 8; ++turn) {
    const Vec3i step = turnedAboutZ({3, -2, 0}, turn);
    places.insert({step.x, step.y});
  }
  EXPECT_EQ(places.size(), 8u);
}

TEST(NearestPatches, AreThoseOfAFullSearch) {
  const Shape a = randomShape(60, 50, 1), b = randomShape(70, 45, 2);
  const std::vector<Vec3i> ofA = boundaryOf(a, true), ofB = boundaryOf(b, false);
  const BoundaryPatches set(a, ofA, 15, 1, true), examples(b, ofB, 15, 4, false);
  const NearestPatches nearest(examples);
  std::vector<std::uint32_t> left(examples.count());
  for (std::size_t e = 0; e < left.size(); ++e) left[e] = e % 3;
  for (const bool some : {false, true}) {
    for (std::size_t s = 0; s < set.count(); s += 5) {
      std::vector<std::pair<int, std::uint32_t>> all;
      for (std::uint32_t e = 0; e < examples.count(); ++e) {
        if (some && left[e] == 0) continue;
        int least = 1 << 30;
        for (int t = 0; t < 4; ++t) least = std::min(least, patchDistance(set, s, examples, e, t));
        all.emplace_back(least, e);
      }
      std::ranges::sort(all);
      std::vector<BoundaryMatch> found;
      nearest.find(set, s, 8,
                   some ? std::span<const std::uint32_t>(left) : std::span<const std::uint32_t>(),
                   found);
      ASSERT_EQ(found.size(), 8u);
      for (std::size_t n = 0; n < 8; ++n) {
        EXPECT_EQ(found[n].distance, all[n].first);
        EXPECT_EQ(found[n].patch, all[n].second);
        EXPECT_EQ(patchDistance(set, s, examples, found[n].patch, found[n].turn),
                  found[n].distance);
      }
    }
  }
}

TEST(ForEachEdgeCell, AndComponentsAreThoseOfEveryPairOfCells) {
  const Random random(7);
  for (const Vec3i& size : {Vec3i{9, 7, 5}, Vec3i{12, 10, 1}, Vec3i{1, 6, 2}, Vec3i{2, 2, 2}}) {
    Shape shape(size);
    for (std::size_t p = 0; p < shape.count(); ++p) shape.data()[p] = random.uniform(p) < 0.5;
    for (const bool wraps : {false, true}) {
      std::vector<std::size_t> edges[2], found[2];
      DisjointSets sets(shape.count());
      std::size_t at = 0;
      forEachCell(size, [&](const Vec3i& p) {
        bool edge = false;
        forEachBeside(size, wraps, p, at, [&](std::size_t other) {
          edge |= shape.data()[other] != shape.data()[at];
          if (shape.data()[other] == shape.data()[at])
            sets.join(static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(other));
        });
        if (edge) edges[shape.data()[at]].push_back(at);
        ++at;
      });
      std::vector<std::uint32_t> cells(shape.count()), sizes[2];
      for (std::uint32_t p = 0; p < cells.size(); ++p) ++cells[sets.find(p)];
      for (std::size_t p = 0; p < cells.size(); ++p)
        if (cells[p] > 0) sizes[shape.data()[p]].push_back(cells[p]);
      for (const bool inside : {false, true}) {
        forEachEdgeCell(shape, inside, wraps, [&](const Vec3i& p, std::size_t index) {
          EXPECT_EQ(shape.index(p), index);
          found[inside].push_back(index);
        });
        EXPECT_EQ(found[inside], edges[inside]);
        EXPECT_EQ(componentSizes(shape, inside, wraps), sizes[inside]);
      }
    }
  }
}

TEST(RemoveSmall, TurnsOverWhatIsSmallAndNothingElse) {
  Shape shape(Vec3i{20, 20, 1});
  for (int y = 2; y < 8; ++y)
    for (int x = 2; x < 8; ++x) shape(x, y, 0) = 1;
  shape(4, 4, 0) = 0;    // a hole
  shape(15, 15, 0) = 1;  // a speck
  removeSmall(shape, {.least = 5}, {.least = 5}, true);
  EXPECT_EQ(shape(4, 4, 0), 1);
  EXPECT_EQ(shape(15, 15, 0), 0);
  EXPECT_EQ(componentSizes(shape, true, true), (std::vector<std::uint32_t>{36}));
  // The largest of more than may stay; those that are as large as the last stay with it.
  shape(15, 15, 0) = shape(17, 11, 0) = shape(17, 12, 0) = shape(12, 3, 0) = 1;
  Shape two = shape;
  removeSmall(two, {.most = 2}, {}, true);
  EXPECT_EQ(componentSizes(two, true, true), (std::vector<std::uint32_t>{36, 2}));
  Shape three = shape;
  removeSmall(three, {.most = 3}, {}, true);
  EXPECT_EQ(three, shape);
}

// --- Assignment --------------------------------------------------------------------------------

struct Instance {
  BoundaryPatches set, examples;
};
Instance instance(int side, std::uint64_t seed) {
  const Shape a = randomShape(side, side, seed), b = randomShape(side / 2, side / 2, seed + 1);
  return {BoundaryPatches(a, boundaryOf(a, true), 15, 1, true),
          BoundaryPatches(b, boundaryOf(b, true), 15, 4, true)};
}

TEST(AssignPatches, UsesEveryExampleAlike) {
  for (const AssignmentKind kind : {AssignmentKind::Greedy, AssignmentKind::Exact}) {
    // By auction where exact.
    const Instance i = instance(kind == AssignmentKind::Exact ? 160 : 70, 3);
    if (kind == AssignmentKind::Exact) {
      ASSERT_GT(i.set.count(), kMostByPaths);
    }
    const std::size_t wanted = i.set.count(), examples = i.examples.count();
    const std::vector<std::uint32_t> uses = fairUses(wanted, examples, Random(1));
    EXPECT_EQ(std::accumulate(uses.begin(), uses.end(), std::size_t{0}), wanted);
    for (const std::uint32_t u : uses) {
      EXPECT_GE(u, wanted / examples);
      EXPECT_LE(u, wanted / examples + 1);
    }
    const auto matches = assignPatches(i.set, i.examples, uses, kind, Random(2)).matches;
    std::vector<std::uint32_t> used(examples);
    for (std::size_t s = 0; s < matches.size(); ++s) {
      ++used[matches[s].patch];
      EXPECT_EQ(patchDistance(i.set, s, i.examples, matches[s].patch, matches[s].turn),
                matches[s].distance);
    }
    EXPECT_EQ(used, uses);
  }
}

TEST(AssignPatches, GreedyIsNearTheOptimum) {
  for (const std::uint64_t seed : {3u, 5u, 8u}) {
    const Instance i = instance(70, seed);
    ASSERT_LE(i.set.count(), 1000u);
    const auto uses = fairUses(i.set.count(), i.examples.count(), Random(1));
    const auto cost = [&](AssignmentKind kind) {
      double sum = 0;
      for (const auto& m : assignPatches(i.set, i.examples, uses, kind, Random(2)).matches)
        sum += m.distance;
      return sum;
    };
    const double greedy = cost(AssignmentKind::Greedy), exact = cost(AssignmentKind::Exact);
    EXPECT_LE(exact, greedy);
    EXPECT_LE(greedy, 1.15 * exact) << seed;
  }
}

TEST(AssignPatches, ExactIsTheOptimumOfSmallInstances) {
  // All permutations of seven patches.
  const Shape a = randomShape(50, 50, 1), b = randomShape(50, 50, 2);
  const auto some = [](const std::vector<Vec3i>& all) {
    std::vector<Vec3i> seven;
    for (std::size_t n = 0; n < 7; ++n) seven.push_back(all[n * all.size() / 7]);
    return seven;
  };
  const BoundaryPatches set(a, some(boundaryOf(a, true)), 15, 1, true);
  const BoundaryPatches examples(b, some(boundaryOf(b, true)), 15, 4, true);
  std::vector<std::size_t> order(7);
  std::iota(order.begin(), order.end(), std::size_t{0});
  int least = 1 << 30;
  do {
    int sum = 0;
    for (std::size_t s = 0; s < 7; ++s) {
      int best = 1 << 30;
      for (int t = 0; t < 4; ++t)
        best = std::min(best, patchDistance(set, s, examples, order[s], t));
      sum += best;
    }
    least = std::min(least, sum);
  } while (std::ranges::next_permutation(order).found);
  int sum = 0;
  const std::vector<std::uint32_t> once(7, 1);
  const Assignment dealt = assignPatches(set, examples, once, AssignmentKind::Exact, Random(1));
  EXPECT_EQ(dealt.kind, AssignmentKind::Exact);
  for (const auto& m : dealt.matches) sum += m.distance;
  EXPECT_EQ(sum, least);
  EXPECT_EQ(assignPatches(set, examples, once, AssignmentKind::Exact, Random(1), {}, 48).kind,
            AssignmentKind::Greedy);
}

TEST(AssignPatches, AuctionAndPathsCostTheSame) {
  // Few different costs tie often; many make long price wars.
  for (std::uint64_t trial = 0; trial < 24; ++trial) {
    const Random draws(trial);
    const auto columns = 1 + draws.below(40, 1), rows = 1 + draws.below(150, 2);
    Grid<std::uint16_t> costs(static_cast<int>(columns), static_cast<int>(rows));
    for (std::size_t p = 0; p < costs.count(); ++p)
      costs[p] = static_cast<std::uint16_t>(draws.below(trial % 2 ? 226 : 6, p, 3));
    const std::vector<std::uint32_t> uses = fairUses(rows, columns, draws);
    const auto sold = assignByAuction(costs, uses);
    if (!sold) {  // where one column alone serves, there is no second price
      EXPECT_EQ(columns - std::ranges::count(uses, 0u), 1) << trial;
      continue;
    }
    std::vector<std::uint32_t> used(columns);
    const auto costOf = [&](const std::vector<std::uint32_t>& columnOf) {
      std::int64_t sum = 0;
      for (std::uint32_t row = 0; row < rows; ++row)
        sum += costs(static_cast<int>(columnOf[row]), static_cast<int>(row));
      return sum;
    };
    for (const std::uint32_t column : *sold) ++used[column];
    EXPECT_EQ(used, uses) << trial;
    EXPECT_EQ(costOf(*sold), costOf(assignByPaths(costs, uses))) << trial;
  }
}

// --- Shapes ------------------------------------------------------------------------------------

TEST(OptimizeShape, LeavesTheExampleItselfAsItIs) {
  const Shape shape = randomShape(64, 64, 4);
  ShapeOptions options;
  options.exampleWraps = true;
  const ShapeExample example = shapeExample(shape, nullptr, nullptr, options, Random(1));
  const OptimizedShape made = optimizeShape(shape, example, {}, options, Random(2));
  EXPECT_EQ(made.shape, shape);
  EXPECT_EQ(made.iterations, 1);
  for (const BoundaryMatch& match : made.placed.matches) EXPECT_EQ(match.distance, 0);
}

TEST(OptimizeShape, BeginsShapesWhereTheExampleIsNeverAsEmpty) {
  // Discs in the left half alone: no boundary patch reaches the middle of the right one.
  const Shape example = layerShape(discs(120, 120, 6, 1), 2);
  Shape start(Vec3i{160, 120, 1});
  forEachCell(start.size(), [&](const Vec3i& p) { start[p] = p.x < 80 && example[p]; });
  const auto deepest = [](const Shape& shape) {
    return *std::ranges::max_element(distanceTo(shape, true).values());
  };
  ASSERT_GT(deepest(start), 30);
  const ShapeExample likeness = shapeExample(example, nullptr, nullptr, {}, Random(1));
  const OptimizedShape made = optimizeShape(start, likeness, {}, {}, Random(2));
  // Where the gap was there are discs; what remains has no room for one more.
  EXPECT_LT(deepest(made.shape), 2 * deepest(example));
}

TEST(SetArea, AddsAndTakesExactlyAndStaysInTheMask) {
  const Shape shape = randomShape(64, 64, 4);
  const Vec3i size{64, 64, 1};
  const PatchVotes votes{Array3D<float>(size), Array3D<float>(size)};
  for (const std::int64_t target : {200, 1500, 3000, 4000}) {
    Shape changed = shape;
    EXPECT_TRUE(setArea(changed, target, votes, {}, Random(1)));
    EXPECT_EQ(std::ranges::count(changed.values(), 1), target);
  }
  Shape mask(size);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 32; ++x) mask(x, y, 0) = 1;
  Shape within = shape;
  for (std::size_t p = 0; p < within.count(); ++p) within.data()[p] &= mask.data()[p];
  EXPECT_FALSE(setArea(within, 4000, votes, {.mask = &mask}, Random(1)));
  EXPECT_EQ(within, mask);
}

// --- Layers ------------------------------------------------------------------------------------

TEST(SynthesizeLayers, KeepsAreasNestingAndLikeness) {
  for (const LayerVolume& example : {discs(160, 120, 9, 1), noiseLayers(160, 120, 4, 2)}) {
    const SynthesizedLayers made = synthesizeLayers(example, {240, 200, 1}, {});
    const int layers = layerCount(example);
    for (int i = 2; i <= layers; ++i) {
      const double wanted = areaOf(layerShape(example, i)), got = areaOf(layerShape(made.map, i));
      EXPECT_NEAR(got, wanted, 1.0 / static_cast<double>(made.map.count())) << i;
    }
    EXPECT_LE(skippingShare(made.map), skippingShare(example));
    const LayersLikeness likeness = measureLayers(example, false, made.map);
    for (const LayerLikeness& layer : likeness.layers) {
      const double distance = (*layer.toExample + *layer.toResult) / 2;
      EXPECT_LE(distance, layer.layer == 2 ? 0.02 : 0.04) << layer.layer;
      EXPECT_NEAR(*layer.boundaryRatio, 1, 0.1) << layer.layer;
    }
  }
}

TEST(SynthesizeLayers, ComesNearerToTheExampleThanItBegan) {
  const LayerVolume example = noiseLayers(160, 120, 3, 2);
  LayerOptions once;
  once.shape.iterations = 1;
  once.shape.levels = 1;
  const auto distance = [&](const LayerOptions& options) {
    const LayersLikeness l =
        measureLayers(example, false, synthesizeLayers(example, {160, 120, 1}, options).map);
    return *l.layers[0].toExample + *l.layers[0].toResult;
  };
  EXPECT_LT(distance({}), 0.7 * distance(once));
}

TEST(OptimizeShape, ComesNearerOnEveryResolution) {
  const Shape fine = layerShape(noiseLayers(256, 192, 2, 2), 2);
  for (int factor = 1; factor <= 4; factor *= 2) {
    Shape shape(Vec3i{256 / factor, 192 / factor, 1});
    forEachCell(shape.size(), [&](const Vec3i& p) { shape[p] = fine[p * factor]; });
    const ShapeExample example = shapeExample(shape, nullptr, nullptr, {}, Random(1));
    // The mean distance of the boundary's patches to the patches that they are given.
    const auto distance = [&](const Shape& of) {
      const std::vector<Vec3i> boundary = boundaryOf(of, true);
      const BoundaryPatches patches(of, boundary, 15, 1, true);
      double sum = 0;
      for (const BoundaryMatch& match :
           assignPatches(patches, example.patches,
                         fairUses(patches.count(), example.patches.count(), Random(2)),
                         AssignmentKind::Greedy, Random(3))
               .matches)
        sum += match.distance;
      return sum / static_cast<double>(patches.count());
    };
    // Noise: half of all squares of 4 x 4.
    Shape start(shape.size());
    const Random draws(5);
    forEachCell(start.size(), [&](const Vec3i& p) {
      start[p] = draws.uniform(static_cast<std::uint64_t>(p.y / 4 * 1000 + p.x / 4)) < 0.5;
    });
    const OptimizedShape made = optimizeShape(start, example, {}, {}, Random(6));
    EXPECT_LT(distance(made.shape), 0.7 * distance(start)) << factor;
  }
}

TEST(SynthesizeLayers, MakesDiscsOfDiscs) {
  const LayerVolume example = discs(200, 200, 10, 1);
  const SynthesizedLayers made = synthesizeLayers(example, {240, 240, 1}, {});
  const double disc = 3.1416 * 10 * 10;
  int whole = 0, all = 0;
  for (const std::uint32_t size : componentSizes(layerShape(made.map, 2), true, true)) {
    whole += std::abs(size / disc - 1) <= 0.15;
    ++all;
  }
  EXPECT_GE(whole, 0.8 * all) << whole << " of " << all;
}

TEST(SynthesizeLayers, IsTheSameForASeedAtAnyNumberOfThreadsAndAnotherForAnother) {
  const LayerVolume example = noiseLayers(96, 96, 3, 2);
  LayerOptions options;
  const auto made = testing::onThreads(1, [&] {
    return synthesizeLayers(example, {128, 96, 1}, options).map;
  });
  EXPECT_EQ(testing::onThreads(8,
                               [&] {
                                 return synthesizeLayers(example, {128, 96, 1}, options).map;
                               }),
            made);
  options.seed = 1;
  const LayerVolume other = synthesizeLayers(example, {128, 96, 1}, options).map;
  std::size_t differing = 0;
  for (std::size_t p = 0; p < made.count(); ++p) differing += made.data()[p] != other.data()[p];
  EXPECT_GT(differing, made.count() / 20);
}

TEST(SynthesizeLayers, TakesTinyAndOneSidedExamples) {
  LayerVolume tiny(Vec3i{5, 4, 1}, 1);
  tiny(2, 2, 0) = tiny(3, 2, 0) = 2;
  EXPECT_EQ(synthesizeLayers(tiny, {9, 7, 1}, {}).map.count(), 63u);
  // A layer that covers nearly everything, and one of a single pixel.
  LayerVolume extreme(Vec3i{40, 40, 1}, 2);
  extreme(0, 0, 0) = 1;
  extreme(20, 20, 0) = 3;
  EXPECT_EQ(synthesizeLayers(extreme, {50, 50, 1}, {}).map.count(), 2500u);
}

TEST(SynthesizeLayers, ReportsAndHearsCancellation) {
  const LayerVolume example = noiseLayers(96, 96, 3, 2);
  testing::expectReportsAndStops(5, [&](const Progress& progress) {
    synthesizeLayers(example, {96, 96, 1}, {}, progress);
  });
}

// --- Decomposition -----------------------------------------------------------------------------

/// A picture whose layers differ in color, with noise.
MapLayer painted(const LayerVolume& map, std::uint64_t seed) {
  MapLayer layer{"color", std::vector<Grid<float>>(3, Grid<float>(map.size().x, map.size().y)), 8};
  const Random random(seed);
  for (std::size_t p = 0; p < map.count(); ++p)
    for (std::uint32_t c = 0; c < 3; ++c)
      layer.planes[c][p] = static_cast<float>(0.15 + 0.17 * map.data()[p] * (c == 0 ? 1 : 0.7) +
                                              0.05 * random.uniform(p, c));
  return layer;
}

TEST(DecomposeTexture, FindsPaintedLayers) {
  const LayerVolume map = noiseLayers(160, 120, 4, 2);
  DecompositionOptions options;
  options.neighborhood = 5;
  const Decomposition found = decomposeTexture(painted(map, 1), options, 0);
  // Bottom up or top down, as the larger end says; equal here.
  std::size_t same = 0, reversed = 0;
  for (std::size_t p = 0; p < map.count(); ++p) {
    same += found.map.data()[p] == map.data()[p];
    reversed += found.map.data()[p] == 5 - map.data()[p];
  }
  EXPECT_GT(std::max(same, reversed), map.count() * 8 / 10);
  EXPECT_LT(found.skipping, 0.02);
}

TEST(DecomposeTexture, RefusesWhatHasNoLayers) {
  const MapLayer gray{"color", {Grid<float>(40, 40, 0.5f)}, 8};
  EXPECT_THROW(decomposeTexture(gray, {}, 0), InputError);
  EXPECT_THROW(decomposeHeights(gray.planes[0], {}), InputError);
}

TEST(DecomposeHeights, CutsAtEqualAreas) {
  Grid<float> heights(100, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) heights(x, y) = static_cast<float>(x * x + y) / 20000;
  DecompositionOptions options;
  options.layers = 5;
  const Decomposition found = decomposeHeights(heights, options);
  for (const double share : found.shares) EXPECT_NEAR(share, 0.2, 0.01);
  EXPECT_EQ(found.skipping, 0);
}

// --- Control maps ------------------------------------------------------------------------------

TEST(DistanceTo, IsTheNearestPixels) {
  const Random random(3);
  for (const bool wraps : {false, true}) {
    Shape shape(Vec3i{37, 23, 1});
    for (std::size_t p = 0; p < shape.count(); ++p) shape.data()[p] = random.uniform(p) < 0.02;
    const Array3D<float> distance = distanceTo(shape, wraps);
    for (int y = 0; y < 23; ++y) {
      for (int x = 0; x < 37; ++x) {
        double least = 1e9;
        for (int v = 0; v < 23; ++v) {
          for (int u = 0; u < 37; ++u) {
            if (!shape(u, v, 0)) continue;
            double dx = std::abs(u - x), dy = std::abs(v - y);
            if (wraps) {
              dx = std::min(dx, 37 - dx);
              dy = std::min(dy, 23 - dy);
            }
            least = std::min(least, std::hypot(dx, dy));
          }
        }
        EXPECT_NEAR(distance(x, y, 0), least, 1e-4);
      }
    }
  }
  const Array3D<float> none = distanceTo(Shape(Vec3i{4, 4, 1}), false);
  EXPECT_TRUE(std::isinf(none(1, 1, 0)));
}

TEST(ControlMaps, StayWithinTheirLayer) {
  const LayerVolume example = noiseLayers(80, 60, 4, 2), result = noiseLayers(90, 70, 4, 3);
  const ControlMaps maps = controlMaps(example, false, result, true);
  for (const auto& [map, control] : {std::pair{&example, &maps.example}, {&result, &maps.result}}) {
    for (std::size_t p = 0; p < map->count(); ++p) {
      EXPECT_GE(control->data()[p], map->data()[p]);
      EXPECT_LE(control->data()[p], map->data()[p] + 1);
    }
  }
}

TEST(ControlMaps, GoNoFartherThanTheExample) {
  const auto steps = [](int second, int third) {
    LayerVolume map(Vec3i{third + 10, 6, 1}, 1);
    forEachCell(map.size(), [&](const Vec3i& p) {
      if (p.x >= second) map[p] = p.x >= third ? 3 : 2;
    });
    return map;
  };
  // Layer 2 is 10 cells wide, and 60: there 6 from the lower layer, and more than 10 from the
  // higher.
  const ControlMaps maps = controlMaps(steps(20, 30), false, steps(20, 80), false);
  EXPECT_NEAR(maps.result(25, 3, 0), 2 + 6.0 / 16, 1e-5);
  EXPECT_NEAR(maps.example(25, 3, 0), 2 + 6.0 / 11, 1e-5);
}

TEST(ControlMaps, SoftenedStayInTheirLayers) {
  const LayerVolume example = noiseLayers(80, 60, 4, 2), result = noiseLayers(90, 70, 4, 3);
  const ControlMaps whole = controlMaps(example, false, result, true);
  ControlMaps soft = whole;
  soft.soften(0.25f);
  for (std::size_t p = 0; p < result.count(); ++p) {
    const float middle = static_cast<float>(result.data()[p]) + 0.5f;
    EXPECT_NEAR(soft.result.data()[p], middle + 0.25f * (whole.result.data()[p] - middle), 1e-5);
  }
}

// --- Textures ----------------------------------------------------------------------------------

TEST(SynthesizeTexture, FollowsTheLayers) {
  const LayerVolume example = noiseLayers(96, 96, 3, 2), wanted = noiseLayers(112, 96, 3, 5);
  Map map;
  map.layers.push_back(painted(example, 1));
  // A second picture that says which layer a pixel shows: it must come out aligned.
  MapLayer which{"layer", {Grid<float>(96, 96)}, 8};
  for (std::size_t p = 0; p < example.count(); ++p) which.planes[0][p] = 0.1f * example.data()[p];
  map.layers.push_back(which);
  for (const float share : {1.0f, 1.0f / 3}) {
    ControlMaps control = controlMaps(example, false, wanted, true);
    control.soften(share);
    const TextureOptions options{.guide = 3};
    const GuidedTexture made =
        synthesizeTexture(map, {control.example}, {control.result}, {}, options);
    std::size_t right = 0, all = 0, aligned = 0;
    for (int y = 0; y < 96; ++y) {
      for (int x = 0; x < 112; ++x) {
        bool far = true;
        for (int dy = -4; dy <= 4; ++dy)
          for (int dx = -4; dx <= 4; ++dx)
            far &= wanted[wrappedPlace({x + dx, y + dy, 0}, wanted.size())] == wanted(x, y, 0);
        if (!far) continue;
        ++all;
        const Vec3i& from = made.origins(x, y, 0);
        right += example[from] == wanted(x, y, 0);
        aligned += std::lround(10 * made.map.layers[1].planes[0](x, y)) == wanted(x, y, 0);
      }
    }
    ASSERT_GT(all, 400u);
    EXPECT_GE(static_cast<double>(right), 0.98 * static_cast<double>(all));
    EXPECT_GE(static_cast<double>(aligned), 0.98 * static_cast<double>(all));
  }
}

TEST(SynthesizeTexture, IsTheSameAtAnyNumberOfThreads) {
  const LayerVolume example = noiseLayers(64, 64, 3, 2), wanted = noiseLayers(64, 64, 3, 5);
  Map map;
  map.layers.push_back(painted(example, 1));
  const ControlMaps control = controlMaps(example, false, wanted, true);
  const auto make = [&] {
    return synthesizeTexture(map, {control.example}, {control.result}, {}, {});
  };
  const GuidedTexture one = testing::onThreads(1, make), eight = testing::onThreads(8, make);
  EXPECT_EQ(one.map.layers[0].planes, eight.map.layers[0].planes);
}

TEST(SynthesizeTexture, RefusesExamplesSmallerThanAPatch) {
  Map map;
  map.layers.push_back({"color", {Grid<float>(4, 4)}, 8});
  EXPECT_THROW(synthesizeTexture(map, {Array3D<float>(Vec3i{4, 4, 1})},
                                 {Array3D<float>(Vec3i{32, 32, 1})}, {}, {}),
               InputError);
}

// --- Figures -----------------------------------------------------------------------------------

TEST(MeasureLayers, OfTheExampleItselfIsPerfect) {
  const LayerVolume map = noiseLayers(128, 128, 3, 2);
  for (const LayerLikeness& layer : measureLayers(map, true, map).layers) {
    EXPECT_EQ(layer.areaError, 0);
    EXPECT_EQ(layer.boundaryRatio, 1);
    EXPECT_EQ(layer.toExample, 0);
    EXPECT_EQ(layer.toResult, 0);
    EXPECT_EQ(layer.componentSizes, 0);
  }
}

TEST(MeasureLayers, TellsNoiseStripesAndCopiesApart) {
  const LayerVolume map = noiseLayers(128, 128, 3, 2);
  // White noise of the same areas is like nothing; vertical stripes lack what the example has.
  const Vec3i size{128, 128, 1};
  LayerVolume noise(size), stripes(size);
  const Random random(1);
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) {
      noise(x, y, 0) = static_cast<std::uint8_t>(1 + random.below(3, noise.index(x, y, 0)));
      stripes(x, y, 0) = static_cast<std::uint8_t>(1 + x / 16 % 3);
    }
  }
  const LayersLikeness ofNoise = measureLayers(map, true, noise);
  EXPECT_GT(*ofNoise.layers[0].toExample, 0.2);
  EXPECT_GT(*ofNoise.layers[0].boundaryRatio, 4);
  const LayersLikeness ofStripes = measureLayers(map, true, stripes);
  EXPECT_GT(*ofStripes.layers[0].toResult, 2 * *ofStripes.layers[0].toExample);
  // The example twice, side by side: every window occurs twice.
  LayerVolume twice(Vec3i{256, 128, 1});
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 256; ++x) twice(x, y, 0) = map(x % 128, y, 0);
  const LayersLikeness tiled = measureLayers(map, true, twice);
  EXPECT_GT(*tiled.repeated, 0.5);
  EXPECT_LT(*tiled.exampleRepeated, 0.2);
}

TEST(MeasureLayers, FindsContoursThatWereCopiedAndTurned) {
  const LayerVolume map = noiseLayers(192, 192, 2, 2), other = noiseLayers(192, 192, 2, 3);
  const auto lowest = [&](const LayerVolume& result) {
    return measureLayers(map, false, result).layers[0];
  };
  const LayerLikeness independent = lowest(other);
  // A square of the example, turned by a quarter, in a map of its own.
  constexpr int kSide = 96;
  LayerVolume planted = other;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) planted(40 + x, 40 + y, 0) = map(30 + y, 125 - x, 0);
  std::int64_t copied = 0;  // of the boundary inside the square, where patches are whole
  for (const Vec3i& p : boundaryOf(layerShape(planted, 2), true))
    copied += std::min(p.x, p.y) >= 48 && std::max(p.x, p.y) < 128;
  const LayerLikeness withCopy = lowest(planted);
  // The square may hold several contours.
  EXPECT_GT(*withCopy.longestRun, copied / 3);
  EXPECT_GT(*withCopy.longestRun, 2 * *independent.longestRun);
  EXPECT_EQ(*lowest(map).longestRun > *withCopy.longestRun, true);
  // One small square of it again and again: few places serve all.
  LayerVolume few(map.size());
  forEachCell(few.size(), [&](const Vec3i& p) { few[p] = map(60 + p.x % 32, 60 + p.y % 32, 0); });
  EXPECT_LT(*lowest(few).usage, 0.5 * *independent.usage);
}

}  // namespace
}  // namespace exemplar
