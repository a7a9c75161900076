// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/doubts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/described.h"
#include "engine/engine.h"
#include "tests/example_shapes.h"
#include "tests/planted_faults.h"

namespace exemplar {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Example exampleOf(DistanceField field) {
  Example example;
  example.data = std::move(field);
  return example;
}

std::vector<std::string> warnings(const DistanceField& example, DistanceField made,
                                  const Request& request = {}) {
  const std::vector<Example> examples{exampleOf(example)};
  Result result;
  result.data = std::move(made);
  addDoubts(examples, request, result);
  return result.warnings;
}

TEST(AddDoubts, WarnsOfFaultsAndNamesASetting) {
  const DistanceField vase = testing::vase();
  EXPECT_THAT(warnings(vase, testing::rolledField(vase, {9, 0, 0})),
              Contains(AllOf(HasSubstr("moved by 9"), HasSubstr("`seed`"))));
  EXPECT_THAT(warnings(vase, testing::shards(vase)),
              Contains(AllOf(HasSubstr("pieces"), HasSubstr("`stationary`"))));
  EXPECT_THAT(warnings(vase, testing::cutByBox(vase)), Contains(HasSubstr("`padding`")));
  EXPECT_THAT(warnings(vase, testing::vase(64, 1)), IsEmpty());
}

TEST(AddDoubts, LeavesAloneWhatIsMeantToBeOtherwise) {
  const DistanceField vase = testing::vase(48);
  Request guided;
  guided.guide = Source("guide.vdb");
  EXPECT_THAT(warnings(vase, testing::shards(vase), guided), IsEmpty());
  Request kept;
  kept.decided.keep = Source("keep.vdb");
  EXPECT_THAT(warnings(vase, vase, kept), IsEmpty());
}

TEST(AddDoubts, LeavesAResultThatTilesItsOpenSides) {
  const DistanceField vase = testing::vase(48);
  Request tiling;
  tiling.periodic = {true, true, false};
  EXPECT_THAT(warnings(vase, testing::cutByBox(vase), tiling),
              Not(Contains(HasSubstr("`padding`"))));
}

TEST(AddDoubts, OfARunAreFoundOnce) {
  // Geometry has quilting or voting make its result, which are engines, too.
  const std::vector<Example> examples{exampleOf(testing::packing(32))};
  Request request;
  request.extent.scale = Vec3d{1, 1, 1};
  const Result result = engineNamed("geometry").run(examples, request);
  ASSERT_EQ(result.outcome, Outcome::Complete);
  int found = 0;
  for (const auto& [key, value] : result.statistics) found += key == "pieces";
  EXPECT_EQ(found, 1);
}

TEST(Describe, SaysWhatAnExampleIsAndWhyItsPartsMayMove) {
  const DescribedExample packing = describe(exampleOf(testing::packing()));
  EXPECT_EQ(packing.stationary, Axes::every());
  EXPECT_THAT(packing.why[0], HasSubstr("parts may move"));
  EXPECT_THAT(packing.why[0], HasSubstr("cuts it at both sides"));
  const DescribedExample terrain = describe(exampleOf(testing::terrain()));
  EXPECT_FALSE(terrain.stationary.z);
  EXPECT_THAT(terrain.why[2], HasSubstr("solid at one side and air at the other"));
  std::string text;
  for (const auto& [label, line] : readable(terrain, Form::Field))
    text += label + ": " + line + "\n";
  EXPECT_THAT(text, HasSubstr("samples: 96 x 96 x 32 samples of 1"));
  EXPECT_THAT(text, HasSubstr("air at +z; cut at -x"));
  EXPECT_THAT(text, HasSubstr("solid at -z"));
  for (const auto& [label, line] : readable(describe(exampleOf(testing::vase())), Form::Field)) {
    if (label == "solid") {
      EXPECT_THAT(line, HasSubstr("stands free"));
    }
  }
}

}  // namespace
}  // namespace exemplar
