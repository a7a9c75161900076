// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/offsets.h"

#include <gtest/gtest.h>

#include "measure/novelty.h"
#include "tests/example_shapes.h"
#include "tests/measure/fields.h"

namespace exemplar {
namespace {

using testing::gathered;
using testing::makeOrigins;

const DistanceField& example() {
  static const DistanceField field = testing::packing(32);
  return field;
}

/// What a result of `size` with these origins used.
template <class From>
OffsetUse used(const Vec3i& size, const From& from) {
  const Origins origins = makeOrigins(size, from);
  return *measureNovelty(example(), gathered(example(), origins), &origins).offsets;
}

TEST(OffsetUse, OfACopyIsOneOffset) {
  const OffsetUse use = used({32, 32, 32}, [](const Vec3i& p) { return Origin(p); });
  EXPECT_EQ(use.top, 1);
  EXPECT_EQ(use.topRolled, 1);
  EXPECT_EQ(use.offsets95, 1);
}

TEST(OffsetUse, OfHalvesExchangedIsTwoAndRolledOne) {
  const OffsetUse use = used({32, 32, 32}, [](const Vec3i& p) {
    return Origin({(p.x + 12) % 32, p.y, p.z});
  });
  EXPECT_NEAR(use.top, 20.0 / 32, 0.08);  // by area, which is not quite even
  EXPECT_EQ(use.topRolled, 1);
  EXPECT_EQ(use.offsets95, 2);
}

TEST(SurfaceShares, AreThoseOfTheExamplesThatCellsCameFrom) {
  const Origins origins = makeOrigins({64, 32, 32}, [](const Vec3i& p) {
    return Origin({p.x % 32, p.y, p.z}, p.x < 32 ? 2 : 0);
  });
  const Occupancy result(gathered(example(), origins));
  const std::vector<double> shares = surfaceShares(result, origins, 3);
  ASSERT_EQ(shares.size(), 3u);
  EXPECT_NEAR(shares[0], 0.5, 0.02);  // what is beside the border counts as surface or not
  EXPECT_EQ(shares[1], 0);
  EXPECT_NEAR(shares[2], 0.5, 0.02);
  EXPECT_EQ(surfaceShares(Occupancy(gathered(example(), origins), 100), origins, 2),
            (std::vector<double>{0, 0}));
}

TEST(OffsetUse, OfATilingIsOneForEachTileAndRolledOne) {
  const OffsetUse use = used({64, 64, 32}, [](const Vec3i& p) {
    return Origin({p.x % 32, p.y % 32, p.z});
  });
  EXPECT_NEAR(use.top, 0.25, 0.02);
  EXPECT_EQ(use.topRolled, 1);
  EXPECT_EQ(use.offsets95, 4);
}

TEST(OffsetUse, TremblingMakesNoNewOffsets) {
  const OffsetUse use = used({24, 24, 24}, [](const Vec3i& p) {
    return Origin({p.x + p.y % 3, p.y + p.z % 2, p.z});
  });
  EXPECT_EQ(use.top, 1);
  EXPECT_EQ(use.offsets95, 1);
}

TEST(OffsetUse, OfBlocksIsManyOffsets) {
  // Blocks of 8³ exchanged about the middle: 64 offsets, all of like shares.
  const OffsetUse use = used({32, 32, 32}, [](const Vec3i& p) {
    return Origin(
        {p.x % 8 + 8 * (3 - p.x / 8), p.y % 8 + 8 * (3 - p.y / 8), p.z % 8 + 8 * (3 - p.z / 8)});
  });
  EXPECT_LT(use.top, 0.06);
  EXPECT_GT(use.offsets95, 40);
}

TEST(OffsetUse, ToldApartByTurns) {
  const OffsetUse use = used({32, 32, 32}, [](const Vec3i& p) {
    return p.z < 16 ? Origin(p) : Origin({p.y, 31 - p.x, p.z}, 0, 1);
  });
  EXPECT_EQ(use.offsets95, 2);
  EXPECT_NEAR(use.topRolled, 0.5, 0.1);
}

TEST(OffsetUse, WithoutSurfaceIsNone) {
  const OffsetUse use = used({32, 32, 32}, [](const Vec3i&) { return Origin({0, 0, 0}); });
  EXPECT_EQ(use.top, 0);
  EXPECT_EQ(use.offsets95, 0);
}

}  // namespace
}  // namespace exemplar
