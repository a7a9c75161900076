// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "label_samples.h"
#include "voxelize/label_file.h"

namespace exemplar {
namespace {

/// Two models of one voxel each, the second one `apart` cells away along every axis.
LabelGrid read(int apart) {
  const std::string model = voxModel({1, 1, 1}, std::string("\0\0\0\1", 4));
  const std::string move =
      std::to_string(apart) + " " + std::to_string(apart) + " " + std::to_string(apart);
  return parseVox(
      voxFile(model + model + voxTransform(0, 1, "", "") + voxGroup(1, {2, 4}) +
              voxTransform(2, 3, "", "0 0 0") + voxShape(3, 0) + voxTransform(4, 5, "", move) +
              voxShape(5, 1)),
      "f.vox");
}

TEST(SparseVox, ModelsFarApartAreRefusedBeforeTheirCellsAreMade) {
  EXPECT_EQ(read(100).size(), (Vec3i{101, 101, 101}));
  try {
    read(2000);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("f.vox: its models lie so far apart that 2001 x 2001 "
                                             "x 2001 cells hold only 2 voxels"));
  }
}

}  // namespace
}  // namespace exemplar
