// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// The bundled scenes of model pieces, taken apart and put together.

#include <gtest/gtest.h>

#include <filesystem>

#include "mesh/mesh_health.h"
#include "mesh/scene.h"
#include "voxelize/model_pieces.h"

namespace exemplar {
namespace {

/// A scene, and how many labels its counterpart in the thesis has (Merrell, table 3.1 and the
/// reference tool's samples).
struct Kind {
  const char* name;
  int labels;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

class PieceSceneTest : public testing::TestWithParam<Kind> {};

TEST_P(PieceSceneTest, HasTheLabelsOfItsCounterpartAndIsPutTogetherAgain) {
  const Scene scene = readScene(std::filesystem::path(EXEMPLAR_SOURCE_DIR) / "scenes" /
                                (std::string(GetParam().name) + ".toml"));
  const ModelPieces pieces = cutIntoPieces(scene.mesh, {.cellSize = *scene.cell, .box = scene.box});
  EXPECT_GE(pieces.grid.labelCount(), GetParam().labels);
  // Most pieces occur several times: synthesis has something to choose from.
  std::vector<int> cells(pieces.grid.labels.size(), 0);
  for (const Label label : pieces.grid.cells.values()) ++cells[label];
  int filled = 0, again = 0;
  for (std::size_t label = 1; label < cells.size(); ++label) {
    filled += cells[label];
    if (cells[label] > 1) again += cells[label];
  }
  EXPECT_GT(again, 0.8 * filled);

  const TriangleMesh back = assemblePieces(pieces.grid, pieces);
  double before = 0, after = 0;
  for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    before += length(areaNormal(scene.mesh, t));
  }
  for (std::size_t t = 0; t < back.triangles.size(); ++t) after += length(areaNormal(back, t));
  // Points within the pieces' tolerance of each other move by as much.
  EXPECT_NEAR(after, before, 1e-3 * before);
  EXPECT_NEAR(meshHealth(back).signedVolume, meshHealth(scene.mesh).signedVolume,
              1e-3 * meshHealth(scene.mesh).signedVolume);
}

INSTANTIATE_TEST_SUITE_P(Kinds, PieceSceneTest,
                         testing::Values(Kind{"castle", 62}, Kind{"city", 120}, Kind{"canyon", 53},
                                         Kind{"cluster", 95}, Kind{"paths", 107}, Kind{"gears", 43},
                                         Kind{"forest", 33}, Kind{"library", 71}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace exemplar
