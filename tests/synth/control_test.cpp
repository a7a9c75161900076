// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What users ask of `synthesizeByVoting` beyond size and seed.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/error.h"
#include "synth/geometry/voting/voting.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

VotingOptions sized(const Vec3i& size) { return {.size = size, .rounds = 3}; }

/// The mean step between neighbors along an axis, inside and across the wrap.
struct Steps {
  double inside = 0, across = 0;
};
Steps stepsAlong(const Array3D<float>& f, int axis) {
  Steps steps;
  double inside = 0, across = 0;
  for (std::size_t s = 0; s < f.count(); ++s) {
    Vec3i p = f.ijk(s), q = p;
    q[axis] = (p[axis] + 1) % f.size()[axis];
    const double step = std::abs(f[p] - f[q]);
    (q[axis] == 0 ? steps.across : steps.inside) += step;
    (q[axis] == 0 ? across : inside) += 1;
  }
  steps.inside /= inside;
  steps.across /= across;
  return steps;
}

TEST(Periodic, OppositeFacesMatch) {
  const DistanceField example = balls({40, 40, 40}, 5, 2);
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    VotingOptions options = sized({33, 30, 28});
    options.seed = seed;
    const Array3D<float> free = synthesizeByVoting(example, options).field.values;
    options.periodic = {true, true, false};
    const Array3D<float> wraps = synthesizeByVoting(example, options).field.values;
    for (const int axis : {0, 1}) {
      // Steps across the wrap are like those inside; without asking for it they are not.
      EXPECT_LT(stepsAlong(wraps, axis).across, 1.25 * stepsAlong(wraps, axis).inside);
      EXPECT_GT(stepsAlong(free, axis).across, 1.8 * stepsAlong(free, axis).inside);
    }
    EXPECT_GT(stepsAlong(wraps, 2).across, 1.8 * stepsAlong(wraps, 2).inside);
  }
}

TEST(Periodic, AnAxisOfAFreeStandingObjectMayWrap) {
  // A slab with air above and below, which the result keeps; along x it goes round.
  DistanceField example = constant({32, 32, 20}, 0);
  for (std::size_t s = 0; s < example.values.count(); ++s) {
    const Vec3i p = example.values.ijk(s);
    example.values.values()[s] = static_cast<float>(
        std::abs(p.z - 9.5) - 4 - 1.5 * std::sin(p.x * 0.9) * std::cos(p.y * 0.7));
  }
  VotingOptions options = sized({40, 32, 20});
  options.periodic.x = true;
  const Array3D<float> f = synthesizeByVoting(example, options).field.values;
  EXPECT_LT(stepsAlong(f, 0).across, 1.4 * stepsAlong(f, 0).inside);
  for (int j = 0; j < 32; ++j) {
    for (int i = 0; i < 40; ++i) {
      EXPECT_GT(f(i, j, 0), 0);
      EXPECT_GT(f(i, j, 19), 0);
    }
  }
}

/// A packing in which a cube was scanned badly: it is solid, as nothing else is.
struct Scan {
  DistanceField field = balls({40, 40, 40}, 5, 4);
  Array3D<std::uint8_t> kept{{40, 40, 40}, 1};

  Scan() {
    for (std::size_t s = 0; s < kept.count(); ++s) {
      const Vec3i p = kept.ijk(s);
      if (p.x < 13 || p.x > 26 || p.y < 13 || p.y > 26 || p.z < 13 || p.z > 26) continue;
      kept.values()[s] = 0;
      field.values.values()[s] = -8;
    }
  }
};

TEST(Kept, StaysToTheBitAndTheRestIsMadeOfIt) {
  const Scan scan;
  VotingOptions options = sized({40, 40, 40});
  options.kept = scan.kept;
  const SynthesisResult result = synthesizeByVoting(scan.field, options);
  std::int64_t solid = 0, hole = 0;
  for (std::size_t s = 0; s < scan.kept.count(); ++s) {
    const Vec3i from = result.origins.values()[s].cell();
    EXPECT_TRUE(scan.kept[from]);
    if (scan.kept.values()[s]) {
      ASSERT_EQ(result.field.values.values()[s], scan.field.values.values()[s]);
      ASSERT_EQ(from, scan.kept.ijk(s));
    } else {
      ++hole;
      solid += result.field.values.values()[s] < 0;
    }
  }
  // The hole is filled with balls, a quarter of the whole is solid: neither left as it was nor
  // empty.
  EXPECT_GT(static_cast<double>(solid) / static_cast<double>(hole), 0.1);
  EXPECT_LT(static_cast<double>(solid) / static_cast<double>(hole), 0.6);
}

TEST(Kept, AnExampleContinuesBeyondItself) {
  const DistanceField example = balls({32, 24, 24}, 4, 5);
  VotingOptions options = sized({56, 24, 24});
  options.kept = Array3D<std::uint8_t>(options.size, 1);  // beyond the example it says nothing
  const SynthesisResult result = synthesizeByVoting(example, options);
  for (std::size_t s = 0; s < result.origins.count(); ++s) {
    const Vec3i p = result.origins.ijk(s);
    if (example.values.contains(p)) {
      ASSERT_EQ(result.field.values[p], example.values[p]);
    }
  }
  EXPECT_LT(brokenFaces(example, result.field, result.origins, 1.5f), 0.02);
}

TEST(Kept, WhereOnlySolidIsKeptTheRestOfTheExampleShowsWhatIsAroundIt) {
  const DistanceField example = balls({32, 28, 28}, 5, 5);
  VotingOptions options = sized({40, 28, 28});
  options.kept = Array3D<std::uint8_t>(options.size);
  std::int64_t solid = 0, wanted = 0;
  for (std::size_t s = 0; s < example.values.count(); ++s) {
    (*options.kept)[example.values.ijk(s)] = example.values.values()[s] < 0;
    wanted += example.values.values()[s] < 0;
  }
  const SynthesisResult result = synthesizeByVoting(example, options);
  for (std::size_t s = 0; s < result.origins.count(); ++s) {
    const Vec3i p = result.origins.ijk(s);
    solid += result.field.values[p] < 0;
    if ((*options.kept)[p]) {
      ASSERT_EQ(result.field.values[p], example.values[p]);
    }
  }
  EXPECT_GE(solid, wanted);
  EXPECT_LT(static_cast<double>(solid), 2.0 * static_cast<double>(wanted));
}

TEST(Guide, SteersWhereTheSolidIs) {
  // Rolling ground of which the guide wants the high parts at one end, the low ones at the other;
  // and the other way round.
  const DistanceField example = ground({48, 48, 32}, 6);
  const auto rise = [&](double sign) {
    VotingOptions options = sized({64, 32, 32});
    options.guide = Array3D<float>(options.size);
    for (std::size_t s = 0; s < options.guide->count(); ++s) {
      const Vec3i p = options.guide->ijk(s);
      options.guide->values()[s] = static_cast<float>(p.z - 13 - sign * (p.x - 31.5) / 8);
    }
    const Array3D<float> f = synthesizeByVoting(example, options).field.values;
    double left = 0, right = 0;
    for (std::size_t s = 0; s < f.count(); ++s) {
      const int x = f.ijk(s).x;
      if (x < 20) left += f.values()[s] < 0;
      if (x >= 44) right += f.values()[s] < 0;
    }
    return (right - left) / (20 * 32);  // of the mean height, voxels; the guide's is 5.5
  };
  EXPECT_GT(rise(1), 1.5);
  EXPECT_LT(rise(-1), -1.5);
}

TEST(SeveralExamples, AllTakePartAndOriginsSayWhich) {
  const DistanceField fine = balls({32, 32, 32}, 3, 7), coarse = balls({36, 28, 24}, 6, 8);
  const DistanceField* examples[] = {&fine, &coarse};
  const SynthesisResult result = synthesizeByVoting(examples, sized({48, 40, 24}));
  std::int64_t from[2] = {}, wrong = 0;
  for (std::size_t s = 0; s < result.origins.count(); ++s) {
    const Origin origin = result.origins.values()[s];
    ASSERT_LT(origin.example, 2);
    const DistanceField& example = *examples[origin.example];
    ASSERT_TRUE(example.values.contains(origin.cell()));
    ++from[origin.example];
    wrong += (example.values[origin.cell()] < 0) != (result.field.values.values()[s] < 0);
  }
  EXPECT_GT(from[0], 2000);
  EXPECT_GT(from[1], 2000);
  EXPECT_EQ(wrong, 0);
}

/// The second example's share of the surface: of all faces between solid and air, by what is solid.
double surfaceOfSecond(const SynthesisResult& result) {
  std::int64_t faces[2] = {};
  const Array3D<float>& values = result.field.values;
  for (std::size_t s = 0; s < values.count(); ++s) {
    const Vec3i p = values.ijk(s);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i q = p;
      if (++q[axis] >= values.size()[axis] || (values[p] < 0) == (values[q] < 0)) continue;
      ++faces[result.origins[values[p] < 0 ? p : q].example];
    }
  }
  return static_cast<double>(faces[1]) / static_cast<double>(faces[0] + faces[1]);
}

TEST(SeveralExamples, HaveTheSharesThatAreAskedForEvenWhereTheyDoNotGoTogether) {
  // Balls of one size never become balls of another, and ground is no packing at all.
  const DistanceField fine = balls({32, 32, 32}, 3, 7), coarse = balls({36, 32, 32}, 7, 8),
                      land = ground({32, 32, 32}, 6);
  const auto share = [&](const DistanceField& a, const DistanceField& b, double wanted) {
    const DistanceField* examples[] = {&a, &b};
    VotingOptions options = sized({64, 56, 32});
    options.mix.shares = {1 - wanted, wanted};
    return surfaceOfSecond(synthesizeByVoting(examples, options));
  };
  EXPECT_NEAR(share(fine, coarse, 0.5), 0.5, 0.1);
  EXPECT_NEAR(share(coarse, fine, 0.3), 0.3, 0.1);
  EXPECT_NEAR(share(coarse, land, 0.5), 0.5, 0.1);
  EXPECT_EQ(share(fine, coarse, 0), 0);
}

TEST(SeveralExamples, AreWhereTheyArePainted) {
  const DistanceField fine = balls({32, 32, 32}, 3, 7), coarse = balls({32, 32, 32}, 7, 8);
  const DistanceField* examples[] = {&fine, &coarse};
  VotingOptions options = sized({64, 40, 32});
  options.mix.map = Array3D<float>(options.size);
  for (std::size_t s = 0; s < options.mix.map->count(); ++s)
    options.mix.map->values()[s] = options.mix.map->ijk(s).x < 32 ? 1 : 0;
  const SynthesisResult result = synthesizeByVoting(examples, options);
  std::int64_t wrong = 0;
  for (std::size_t s = 0; s < result.origins.count(); ++s) {
    // Where both meet, seams go where they agree best, and what is cleared away becomes air of
    // either.
    const int x = result.origins.ijk(s).x;
    if (std::abs(x - 31.5) > 12 && result.field.values.values()[s] < 0)
      wrong += result.origins.values()[s].example != (x < 32 ? 1 : 0);
  }
  EXPECT_EQ(wrong, 0);
}

TEST(Rotations, PartsAreTurnedAndOriginsSayHow) {
  const DistanceField example = balls({32, 28, 24}, 4, 9);
  VotingOptions options = sized({40, 40, 24});
  options.stationary = Axes::every();
  options.rotations = true;
  const SynthesisResult result = synthesizeByVoting(example, options);
  std::set<int> turns;
  for (std::size_t s = 0; s < result.origins.count(); ++s) {
    const Origin origin = result.origins.values()[s];
    turns.insert(origin.turns);
    ASSERT_TRUE(example.values.contains(origin.cell()));
    ASSERT_EQ(example.values[origin.cell()] < 0, result.field.values.values()[s] < 0);
    // The next sample of the same turn and piece comes from the next one there, turned back.
    const Vec3i p = result.origins.ijk(s);
    if (p.x + 1 == 40) continue;
    const Origin next = result.origins[p + Vec3i{1, 0, 0}];
    const Vec3i back[] = {{1, 0, 0}, {0, -1, 0}, {-1, 0, 0}, {0, 1, 0}};
    turns.insert(next.cell() - origin.cell() == back[origin.turns] ? 10 + origin.turns : 20);
  }
  // Some part lies across, and each turn that occurs continues by its own step somewhere.
  EXPECT_TRUE(turns.count(1) || turns.count(3));
  for (const int t : {0, 1, 2, 3}) EXPECT_EQ(turns.count(t), turns.count(10 + t));
  options.rotations = false;
  for (const Origin& origin : synthesizeByVoting(example, options).origins.values()) {
    ASSERT_EQ(origin.turns, 0);
  }
}

TEST(Rotations, AreRefusedWherePlacesMatter) {
  VotingOptions options = sized({16, 16, 16});
  options.rotations = true;
  options.stationary = Axes{false, true, true};
  EXPECT_THROW(synthesizeByVoting(balls({16, 16, 16}, 4, 9), options), InputError);
}

TEST(Control, IsTheSameAtAnyNumberOfThreads) {
  const DistanceField a = balls({24, 24, 24}, 4, 7), b = balls({22, 26, 24}, 4, 8);
  const DistanceField* examples[] = {&a, &b};
  VotingOptions options = sized({32, 24, 24});
  options.periodic = {false, true, false};
  options.rotations = true;
  options.stationary = Axes::every();
  options.kept = Array3D<std::uint8_t>(options.size);
  for (std::size_t s = 0; s < options.kept->count(); ++s) {
    options.kept->values()[s] = options.kept->ijk(s).x < 12;
  }
  options.guide = Array3D<float>(options.size, -1);
  SynthesisResult one, eight;
  withThreads(1, [&] { one = synthesizeByVoting(examples, options); });
  withThreads(8, [&] { eight = synthesizeByVoting(examples, options); });
  EXPECT_EQ(one.origins, eight.origins);
  EXPECT_EQ(one.field.values, eight.field.values);
}

TEST(Control, BadInputIsRefused) {
  const DistanceField example = balls({20, 20, 20}, 4, 7);
  DistanceField other = example;
  other.voxelSize = 2;
  const DistanceField* examples[] = {&example, &other};
  EXPECT_THROW(synthesizeByVoting(examples, sized({16, 16, 16})), InputError);
  VotingOptions options = sized({16, 16, 16});
  options.kept = Array3D<std::uint8_t>({8, 8, 8});
  EXPECT_THROW(synthesizeByVoting(example, options), InputError);
  options.kept.reset();
  options.guide = Array3D<float>({8, 8, 8});
  EXPECT_THROW(synthesizeByVoting(example, options), InputError);
}

}  // namespace
}  // namespace exemplar
