// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/patch_likeness.h"

#include <gtest/gtest.h>

#include <optional>
#include <set>

#include "tests/measure/fields.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::ball;
using testing::ballPacking;
using testing::emptyField;
using testing::makeField;
using testing::moved;
using testing::noise;
using testing::solidField;

/// The definition again, cell by cell, without bounds, bits or threads.
class Slow {
 public:
  explicit Slow(const DistanceField& field) : field_(field) {}

  using Window = std::vector<unsigned char>;

  /// The surface windows that start at low, low + stride, ... and end at size + beyond or before.
  std::vector<Window> windows(int low, int beyond, int stride) const {
    std::vector<Window> all;
    const Vec3i n = field_.size();
    const auto starts = [&](int size) {
      std::vector<int> s;
      for (int x = low; x + kLikenessWindow <= size + beyond; x += stride) s.push_back(x);
      return s;
    };
    for (const int z : starts(n.z))
      for (const int y : starts(n.y))
        for (const int x : starts(n.x))
          if (const auto w = window({x, y, z})) all.push_back(*w);
    return all;
  }

 private:
  std::optional<Window> window(const Vec3i& at) const {
    Window cells;
    int core = 0;
    for (int z = 0; z < kLikenessWindow; ++z)
      for (int y = 0; y < kLikenessWindow; ++y)
        for (int x = 0; x < kLikenessWindow; ++x) {
          const Vec3i p = at + Vec3i{x, y, z};
          const bool solid = field_.values.contains(p) && field_.values[p] < 0;
          cells.push_back(solid);
          const auto central = [](int c) { return c >= 4 && c <= 6; };
          core += solid && central(x) && central(y) && central(z);
        }
    if (core == 0 || core == 27) return std::nullopt;
    return cells;
  }

  const DistanceField& field_;
};

PatchLikeness slowLikeness(const std::vector<Slow::Window>& asked,
                           const std::vector<Slow::Window>& reference, double threshold) {
  PatchLikeness likeness;
  likeness.windows = static_cast<std::int64_t>(asked.size());
  likeness.references = static_cast<std::int64_t>(reference.size());
  for (const auto& a : asked) {
    double best = 0;
    for (const auto& r : reference) {
      int both = 0, either = 0;
      for (std::size_t c = 0; c < a.size(); ++c) {
        both += a[c] & r[c];
        either += a[c] | r[c];
      }
      best = std::max(best, static_cast<double>(both) / either);
    }
    likeness.meanIou += best / static_cast<double>(asked.size());
    likeness.share += best > threshold ? 1.0 / static_cast<double>(asked.size()) : 0;
  }
  return likeness;
}

void expectSame(const PatchLikeness& fast, const PatchLikeness& slow) {
  EXPECT_EQ(fast.windows, slow.windows);
  EXPECT_EQ(fast.references, slow.references);
  EXPECT_NEAR(fast.share, slow.share, 1e-12);
  EXPECT_NEAR(fast.meanIou, slow.meanIou, 1e-6);  // each IoU is a float
}

TEST(PatchLikeness, AgreesWithItsDefinition) {
  // Sizes that leave remainders at every stride, fields with much and with nothing in common. The
  // threshold is low enough to have windows on either side of it.
  const std::vector<DistanceField> fields{
      ballPacking({23, 20, 19}, 1), ballPacking({19, 22, 24}, 2), noise({16, 18, 15}, 0.4, 3),
      makeField({26, 17, 18}, [](const Vec3d& p) { return p.z - 7 - 3 * std::sin(p.x / 4); })};
  const double threshold = 0.8;
  for (const auto& asked : fields)
    for (const auto& reference : fields) {
      const Occupancy a(asked), r(reference);
      PatchLikenessOptions options;
      options.threshold = threshold;
      options.averaged = options.windows;
      // Padding of 5 about both; a guard ring of 6 about the dense reference.
      expectSame(patchLikeness(a, r, options),
                 slowLikeness(Slow(asked).windows(-5, 5, 5), Slow(reference).windows(-6, 6, 1),
                              threshold));
      options.referenceStride = 5;
      expectSame(patchLikeness(a, r, options),
                 slowLikeness(Slow(asked).windows(-5, 5, 5), Slow(reference).windows(-5, 5, 5),
                              threshold));
      options.referenceStride = 1;
      options.border = WindowBorder::Interior;
      expectSame(
          patchLikeness(a, r, options),
          slowLikeness(Slow(asked).windows(0, 0, 5), Slow(reference).windows(0, 0, 1), threshold));
    }
}

TEST(PatchLikeness, AShiftedCopyIsAlikeWhenTheReferenceIsDense) {
  const DistanceField example = ballPacking({48, 48, 48}, 4, 4);
  const Occupancy e(example);
  for (const Vec3i shift : {Vec3i{0, 0, 0}, {1, 2, 3}, {-3, 0, 1}}) {
    const Occupancy copy(moved(example, shift));
    const PatchLikeness dense = patchLikeness(copy, e), back = patchLikeness(e, copy);
    EXPECT_EQ(dense.share, 1) << shift.x;
    EXPECT_EQ(dense.meanIou, 1) << shift.x;
    EXPECT_EQ(back.share, 1) << shift.x;
    EXPECT_GT(dense.windows, 100);

    // The published stride breaks on translation: why there is a dense figure at all.
    PatchLikenessOptions published;
    published.referenceStride = 5;
    const double share = patchLikeness(copy, e, published).share;
    if (shift == Vec3i{0, 0, 0}) {
      EXPECT_EQ(share, 1);
    } else {
      EXPECT_LT(share, 0.5) << shift.x;
    }
  }
}

TEST(PatchLikeness, PrecisionAloneIsGamedByAFlatWallAndCoverageIsNot) {
  // A wall with relief on a part of it, and a result whose relief has vanished.
  const auto wall = [](double relief) {
    return makeField({64, 24, 64}, [=](const Vec3d& p) {
      const double bump = p.x < 44 ? relief * std::sin(p.x / 3) * std::sin(p.z / 3) : 0;
      return p.y - 12.3 - bump;
    });
  };
  const Occupancy e(wall(3)), r(wall(0));
  EXPECT_GT(patchLikeness(r, e).share, 0.9);
  EXPECT_LT(patchLikeness(e, r).share, 0.7);
}

TEST(PatchLikeness, ACutEarnsCreditOnlyWhereWindowsLeanOverTheBox) {
  // Flat ground that fills the box, and noise below ground whose top is as flat: what they share
  // is a box's lower edges.
  const DistanceField example = solidField({40, 40, 40});
  const DistanceField result = makeField({40, 40, 40}, [](const Vec3d& p) {
    return p.x > 15 && p.x < 25 && p.y > 15 && p.y < 25 && p.z > 15 && p.z < 25 ? 1 : -1;
  });
  const Occupancy e(example), r(result);
  EXPECT_GT(patchLikeness(r, e).share, 0.5);
  PatchLikenessOptions options;
  options.border = WindowBorder::Interior;
  EXPECT_EQ(patchLikeness(r, e, options).share, 0);
}

TEST(PatchLikeness, WithoutSurfaceIsDefined) {
  const Occupancy nothing(emptyField({20, 20, 20})), something(ball({20, 20, 20}, {9, 9, 9}, 5));
  EXPECT_EQ(patchLikeness(nothing, something).share, 0);
  EXPECT_EQ(patchLikeness(nothing, something).windows, 0);
  EXPECT_EQ(patchLikeness(something, nothing).share, 0);
  EXPECT_EQ(patchLikeness(nothing, nothing).share, 1);
  EXPECT_GT(patchLikeness(something, nothing).windows, 0);
}

TEST(PatchLikeness, FindsTheSmallestObject) {
  for (int x = 6; x < 12; ++x) {
    DistanceField field = emptyField({24, 24, 24});
    field.values(x, 10, 9) = -1;
    const Occupancy dot(field);
    EXPECT_EQ(patchLikeness(dot, dot).share, 1) << x;
    EXPECT_GT(patchLikeness(dot, dot).windows, 0) << x;
  }
}

TEST(PatchLikeness, VolumesThinnerThanAWindowHaveNoInterior) {
  EXPECT_TRUE(hasInteriorWindows({11, 11, 11}));
  EXPECT_FALSE(hasInteriorWindows({64, 64, 10}));
  PatchLikenessOptions interior;
  interior.border = WindowBorder::Interior;
  const Occupancy thin(ball({30, 30, 8}, {15, 15, 4}, 6));
  EXPECT_EQ(patchLikeness(thin, thin, interior).windows, 0);
  EXPECT_EQ(patchLikeness(thin, thin).share, 1);
}

TEST(PatchLikeness, DrawsWindowsBySeed) {
  const Occupancy a(ballPacking({64, 48, 48}, 5)), b(ballPacking({48, 48, 48}, 6));
  PatchLikenessOptions options;
  options.windows = 100;
  std::set<double> seen;
  for (const std::uint64_t seed : {0, 1, 2}) {
    options.seed = seed;
    const PatchLikeness likeness = patchLikeness(a, b, options);
    EXPECT_EQ(likeness.windows, 100);
    seen.insert(likeness.meanIou);
  }
  EXPECT_EQ(seen.size(), 3u);

  // Many represent all: 300 of about 700 windows, an IoU's deviation about 0.1.
  PatchLikenessOptions all, some;
  all.windows = all.averaged = 1000000;
  some.windows = some.averaged = 300;
  EXPECT_NEAR(patchLikeness(a, b, some).meanIou, patchLikeness(a, b, all).meanIou, 0.03);
}

TEST(PatchLikeness, TheShareCountsAllWindowsAndTheMeanTheFirst) {
  const Occupancy a(ballPacking({64, 48, 48}, 5)), b(ballPacking({48, 48, 48}, 6));
  PatchLikenessOptions options;
  options.threshold = 0.7;
  options.averaged = options.windows;
  const PatchLikeness full = patchLikeness(a, b, options);
  EXPECT_GT(full.share, 0.2);
  EXPECT_LT(full.share, 0.9);
  options.averaged = 100;
  const PatchLikeness some = patchLikeness(a, b, options);
  EXPECT_EQ(some.share, full.share);
  EXPECT_NEAR(some.meanIou, full.meanIou, 0.04);  // a deviation of 0.1, of 100
  options.averaged = 0;
  EXPECT_EQ(patchLikeness(a, b, options).share, full.share);
}

TEST(PatchLikeness, IsTheSameAtOneAndEightThreads) {
  const Occupancy a(ballPacking({48, 48, 40}, 7)), b(ballPacking({40, 48, 48}, 8));
  const auto measure = [&] {
    const PatchLikeness p = patchLikeness(a, b);
    return std::array{p.share, p.meanIou, static_cast<double>(p.references)};
  };
  const auto expected = testing::onThreads(1, measure);
  for (int trial = 0; trial < 5; ++trial) EXPECT_EQ(testing::onThreads(8, measure), expected);
}

}  // namespace
}  // namespace exemplar
