// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/doubts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/example_shapes.h"
#include "tests/measure/fields.h"
#include "tests/planted_faults.h"

namespace exemplar {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<Doubt> doubts(const DistanceField& example, const DistanceField& result) {
  return doubtsOf(doubtSigns(Occupancy(example), Occupancy(result)));
}

TEST(Doubts, OfTheExampleMovedOrNot) {
  for (const testing::ShapeKind& kind : testing::shapeKinds()) {
    SCOPED_TRACE(kind.name);
    const DistanceField example = kind.make(48, 0);
    const Vec3i n = example.size();
    EXPECT_THAT(doubts(example, example), Contains(Doubt::Moved));
    const DistanceField moved = testing::rolledField(example, {n.x / 3, n.y / 2, 0});
    const DistanceField tiled = testing::rolledField(example, {0, 3, 0}, {2 * n.x, n.y, n.z});
    if (kind.freeStanding) {
      EXPECT_THAT(doubts(example, moved), Contains(Doubt::Moved));
      EXPECT_THAT(doubts(example, tiled), Contains(Doubt::Moved));
    } else {
      // A material's halves may be exchanged along axes that it fills.
      EXPECT_THAT(doubts(example, moved), Not(Contains(Doubt::Moved)));
    }
  }
}

TEST(Doubts, OfFreshSamplesAreNone) {
  // Vases, villages, packings and ground of the same process; what is the same in all of them (a
  // temple's roof) is no fault of these.
  for (const char* name : {"vase", "village", "packing", "porous", "terrain"})
    for (const testing::ShapeKind& kind : testing::shapeKinds()) {
      if (kind.name != std::string(name)) continue;
      for (const std::uint64_t seed : {1, 3}) {
        std::vector<Doubt> found = doubts(kind.make(kind.side, 0), kind.make(kind.side, seed));
        // How much solid there is varies from sample to sample.
        std::erase(found, Doubt::Occupancy);
        // A village's chimney or two.
        EXPECT_THAT(found, IsEmpty()) << name << " " << seed;
      }
    }
}

TEST(Doubts, OfPlantedFaults) {
  const DistanceField vase = testing::vase(), tree = testing::tree(), temple = testing::temple(),
                      village = testing::village(), boulder = testing::boulder();
  EXPECT_THAT(doubts(vase, testing::shards(vase)), Contains(Doubt::Pieces));
  EXPECT_THAT(doubts(vase, testing::shards(vase)), Contains(Doubt::Floating));
  EXPECT_THAT(doubts(tree, testing::shearedTop(tree)), Contains(Doubt::Sliced));
  EXPECT_THAT(doubts(boulder, testing::shearedTop(boulder)), Contains(Doubt::Sliced));
  EXPECT_THAT(doubts(temple, testing::shearedTop(temple)), Contains(Doubt::Sliced));
  EXPECT_THAT(doubts(village, testing::lostFloor(village)), Contains(Doubt::Pieces));
  EXPECT_THAT(doubts(village, testing::lostFloor(village)), Contains(Doubt::Occupancy));
  EXPECT_THAT(doubts(temple, testing::doubled(temple)), Contains(Doubt::Occupancy));
  EXPECT_THAT(doubts(tree, testing::cutByBox(tree)), Contains(Doubt::Open));
  EXPECT_THAT(doubts(tree, testing::emptyField(tree.size())), IsEmpty());  // a collapse
}

TEST(Doubts, OfALandmarkThatOccursTooOften) {
  const DistanceField one = testing::castle(66, {30});
  EXPECT_THAT(doubts(one, testing::castle(132, {20, 50, 80, 110})), Contains(Doubt::Repeated));
  // Of its own size, a second tower is one too many; twice as long, two may be.
  EXPECT_THAT(doubts(one, testing::castle(66, {18, 48})), Contains(Doubt::Repeated));
  EXPECT_THAT(doubts(one, testing::castle(132, {30, 96})), Not(Contains(Doubt::Repeated)));
  EXPECT_THAT(doubts(one, testing::castle(132, {90})), Not(Contains(Doubt::Repeated)));
  const DoubtSigns signs =
      doubtSigns(Occupancy(one), Occupancy(testing::castle(132, {20, 50, 80, 110})));
  EXPECT_THAT(doubtSentence(Doubt::Repeated, signs), HasSubstr("up to 4 times"));
}

TEST(Doubts, SayWhatIsWrongByFigures) {
  const DistanceField vase = testing::vase();
  const auto sentence = [&](Doubt doubt, const DistanceField& result) {
    return doubtSentence(doubt, doubtSigns(Occupancy(vase), Occupancy(result)));
  };
  EXPECT_EQ(sentence(Doubt::Moved, vase), "the result is the example itself");
  EXPECT_EQ(sentence(Doubt::Moved, testing::rolledField(vase, {60, 7, 0})),
            "the result is the example moved by -4, 7 and 0 voxels");
  EXPECT_EQ(sentence(Doubt::Moved, testing::rolledField(vase, {0, 0, 0}, {128, 54, 64})),
            "the result is the example repeated");
  EXPECT_THAT(sentence(Doubt::Pieces, testing::shards(vase)),
              HasSubstr("pieces, the example into 1"));
  EXPECT_THAT(sentence(Doubt::Open, testing::cutByBox(vase)),
              HasSubstr(" % of the result's surface"));
}

}  // namespace
}  // namespace exemplar
