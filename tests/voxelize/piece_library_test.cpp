// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/piece_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>

#include "core/file.h"
#include "core/origin.h"
#include "mesh/primitives.h"
#include "mesh/procedural/piece_scenes.h"

namespace exemplar {
namespace {

/// Integrals over the surface of a piece, its points moved, of 1, x, y, z and the products of two:
/// however it is cut into triangles, they are the same. Exact for these with a triangle's middles
/// of sides.
std::array<double, 10> momentsOf(const ModelPieces& pieces, Label label,
                                 const std::function<Vec3d(Vec3d)>& moved) {
  std::array<double, 10> sums{};
  for (std::uint32_t t = pieces.first[label]; t < pieces.first[label + 1]; ++t) {
    std::array<Vec3d, 3> p;
    for (int c = 0; c < 3; ++c) p[c] = moved(pieces.mesh.positions[pieces.mesh.triangles[t][c]]);
    const double area = length(cross(p[1] - p[0], p[2] - p[0])) / 2;
    for (int c = 0; c < 3; ++c) {
      const Vec3d m = (p[c] + p[(c + 1) % 3]) * 0.5;
      const std::array<double, 10> at{1,         m.x,       m.y,       m.z,       m.x * m.x,
                                      m.y * m.y, m.z * m.z, m.x * m.y, m.y * m.z, m.z * m.x};
      for (std::size_t n = 0; n < at.size(); ++n) sums[n] += area / 3 * at[n];
    }
  }
  return sums;
}

/// As `PieceForm` says, about the center of a cell.
Vec3d placed(Vec3d p, const PieceForm& form, const Vec3d& cell) {
  p = p - cell * 0.5;
  if (form.mirrored) p.x = -p.x;
  return turned(p, form.turns) + cell * 0.5;
}

ModelPieces castlePieces() {
  const ProcessSample sample = makeCastle();
  return cutIntoPieces(sample.mesh, {.cellSize = *sample.cell, .box = sample.box});
}

TEST(PieceForms, MakeEachPieceOfItsShape) {
  const ModelPieces pieces = castlePieces();
  const std::vector<PieceForm> forms = pieceForms(pieces);
  ASSERT_EQ(forms.size(), pieces.grid.labels.size());
  const Vec3d& cell = pieces.grid.cellSize;
  int turnedOnes = 0, mirroredOnes = 0, otherwise = 0;
  for (std::size_t l = 0; l < forms.size(); ++l) {
    const auto label = static_cast<Label>(l);
    EXPECT_LE(forms[l].shape, label);
    EXPECT_EQ(forms[forms[l].shape], (PieceForm{forms[l].shape, false, 0}));
    const auto as = [&](const PieceForm& form) {
      return momentsOf(pieces, form.shape, [&](Vec3d p) { return placed(p, form, cell); });
    };
    const auto own = momentsOf(pieces, label, [](Vec3d p) { return p; });
    const auto made = as(forms[l]);
    double size = 1e-9, apart = 0;
    for (std::size_t n = 0; n < own.size(); ++n) {
      size = std::max(size, std::abs(own[n]));
      // Points of equal pieces are within the tolerance, in cells.
      EXPECT_NEAR(made[n], own[n], 20 * pieces.tolerance * own[0] + 1e-9) << l << " " << n;
      apart = std::max(
          apart,
          std::abs(as({forms[l].shape, forms[l].mirrored, (forms[l].turns + 2) % 4})[n] - own[n]));
    }
    turnedOnes += forms[l].turns != 0;
    mirroredOnes += forms[l].mirrored;
    otherwise += forms[l].turns != 0 && apart > 0.01 * size;
  }
  EXPECT_GT(turnedOnes, 10);
  EXPECT_GT(mirroredOnes, 0);
  EXPECT_GT(otherwise, 10);  // another turn is seen
}

TEST(PieceForms, OfWhatNeitherTurnsNorMirrorsAreThemselves) {
  // Cells that are not square do not turn.
  const ProcessSample sample = makeCastle();
  Vec3d cell = *sample.cell;
  cell.y *= 2;
  for (const PieceForm& form : pieceForms(cutIntoPieces(sample.mesh, {.cellSize = cell})))
    EXPECT_EQ(form.turns, 0);
}

TEST(PieceName, IsPlainAndItsOwn) {
  ModelPieces pieces = castlePieces();
  std::set<std::string> names;
  for (std::size_t l = 0; l < pieces.grid.labels.size(); ++l) {
    const std::string name = pieceName(pieces, static_cast<Label>(l));
    EXPECT_THAT(name, testing::MatchesRegex("[A-Za-z0-9_]+"));
    EXPECT_TRUE(names.insert(name).second) << name;
  }
  pieces.grid.labels[1].name = " Dach 12, Ziegel-rot \xc3\xa4";
  pieces.grid.labels[2].name = ",";
  EXPECT_EQ(pieceName(pieces, 1), "Dach_12_Ziegel_rot");
  EXPECT_EQ(pieceName(pieces, 2), "piece_2");
}

TEST(WritePieceLibrary, HoldsEachShapeOnceByName) {
  const ModelPieces pieces = castlePieces();
  const auto path = std::filesystem::temp_directory_path() / "exemplar_piece_library_test.glb";
  const std::size_t count = writePieceLibrary(path, pieces);
  const std::string bytes = readFile(path);
  std::filesystem::remove(path);
  std::set<Label> shapes;
  for (const PieceForm& form : pieceForms(pieces))
    if (pieces.first[form.shape] != pieces.first[form.shape + 1]) shapes.insert(form.shape);
  EXPECT_EQ(count, shapes.size());
  EXPECT_LT(count, pieces.grid.labels.size() - 1);
  for (const Label shape : shapes) {
    // A node and a mesh.
    const std::string name = "\"name\":\"" + pieceName(pieces, shape) + "\"";
    std::size_t found = 0;
    for (std::size_t at = 0; (at = bytes.find(name, at)) != std::string::npos; ++at) ++found;
    EXPECT_EQ(found, 2u) << name;
  }
}

}  // namespace
}  // namespace exemplar
