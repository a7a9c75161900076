// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/collapse.h"

#include <gtest/gtest.h>

namespace exemplar {
namespace {

/// An example a third solid, and a result that is as good as one can be.
CollapseSigns sound() {
  return {.exampleOccupancy = 0.3,
          .resultOccupancy = 0.31,
          .exampleSurface = 0.1,
          .resultSurface = 0.098,
          .usedShare = 0.7,
          .likeness = 0.8,
          .coverage = 0.8};
}

TEST(DetectCollapse, FindsNoneInASoundResult) {
  EXPECT_EQ(detectCollapse(sound()), Collapse::None);
  CollapseSigns bare = sound();
  bare.usedShare = bare.likeness = bare.coverage = std::nullopt;
  EXPECT_EQ(detectCollapse(bare), Collapse::None);
}

TEST(DetectCollapse, TellsEmptyFromSolid) {
  CollapseSigns signs = sound();
  signs.resultOccupancy = 0.01;
  signs.resultSurface = 0.004;
  EXPECT_EQ(detectCollapse(signs), Collapse::AllEmpty);
  signs.resultOccupancy = 0.99;
  EXPECT_EQ(detectCollapse(signs), Collapse::AllSolid);
  // A big featureless part: the nearer of the two.
  signs.resultOccupancy = 0.5;
  EXPECT_EQ(detectCollapse(signs), Collapse::AllSolid);
  signs.resultOccupancy = 0.2;
  EXPECT_EQ(detectCollapse(signs), Collapse::AllEmpty);
}

TEST(DetectCollapse, LeavesSparseAndDenseExamplesAlone) {
  CollapseSigns sparse = sound();
  sparse.exampleOccupancy = 0.004;
  sparse.resultOccupancy = 0.003;
  EXPECT_EQ(detectCollapse(sparse), Collapse::None);
  CollapseSigns dense = sound();
  dense.exampleOccupancy = 0.996;
  dense.resultOccupancy = 0.997;
  EXPECT_EQ(detectCollapse(dense), Collapse::None);
  CollapseSigns empty;  // an empty example
  EXPECT_EQ(detectCollapse(empty), Collapse::None);
}

TEST(DetectCollapse, FindsOneBlockRepeated) {
  CollapseSigns signs = sound();
  signs.usedShare = 1.0 / 64;  // one block of 16³ of an example of 64³
  signs.coverage = 0.1;
  EXPECT_EQ(detectCollapse(signs), Collapse::Repeated);
  signs.coverage.reset();
  EXPECT_EQ(detectCollapse(signs), Collapse::Repeated);
  // An example that repeats itself is covered by one part of it.
  signs.coverage = 0.9;
  EXPECT_EQ(detectCollapse(signs), Collapse::None);
}

TEST(DetectCollapse, FindsRepetitionWithoutOrigins) {
  CollapseSigns signs = sound();
  signs.usedShare.reset();
  signs.likeness = 0.9;
  signs.coverage = 0.1;
  EXPECT_EQ(detectCollapse(signs), Collapse::Repeated);
  signs.likeness = 0.1;  // garbage is no repetition
  EXPECT_EQ(detectCollapse(signs), Collapse::None);
}

TEST(CollapseSentence, NamesTheFigures) {
  CollapseSigns signs = sound();
  signs.usedShare = 0.015;
  signs.resultOccupancy = 0.99;
  EXPECT_EQ(collapseSentence(Collapse::AllSolid, signs),
            "the result is nearly solid: 99 % of it is solid, 30 % of the example");
  EXPECT_EQ(collapseSentence(Collapse::Repeated, signs),
            "the result repeats one part of the example: it uses 1.5 % of its surface");
  EXPECT_EQ(collapseSentence(Collapse::None, signs), "");
  EXPECT_EQ(collapseName(Collapse::AllEmpty), "all_empty");
  EXPECT_EQ(collapseName(Collapse::None), "none");
}

}  // namespace
}  // namespace exemplar
