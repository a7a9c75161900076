// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/cells.h"
#include "engine/example.h"
#include "mesh/primitives.h"

namespace exemplar {

/// Bumps that repeat along x and y: a field that every engine can continue.
inline DistanceField bumps(const Vec3i& size = {24, 24, 12}) {
  DistanceField field;
  field.voxelSize = 1;
  field.truncation = 16;
  field.values = Array3D<float>(size);
  forEachCell(size, [&](const Vec3i& p) {
    const int height = 4 + std::abs(p.x % 8 - 4) / 2 + std::abs(p.y % 8 - 4) / 2;
    field.values[p] = static_cast<float>(p.z - height) + 0.5f;
  });
  return field;
}

/// Closed rings (5 to 8, with sides 1 to 4) on empty ground.
inline LabelGrid rings() {
  LabelGrid grid;
  grid.cells = Array3D<Label>({8, 8, 1}, 0);
  const int rows[4][4] = {{5, 2, 2, 6}, {1, 0, 0, 3}, {1, 0, 0, 3}, {7, 4, 4, 8}};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) grid.cells(x + 2, y + 2, 0) = static_cast<Label>(rows[y][x]);
  grid.labels.resize(9);
  grid.labels[0] = emptyLook();
  for (int label = 1; label < 9; ++label) grid.labels[label].color = distinctColor(label);
  grid.labels[5].name = "corner";
  return grid;
}

/// Two boxes beside each other, of two materials.
inline TriangleMesh boxes() {
  TriangleMesh mesh;
  for (int n = 0; n < 2; ++n) append(mesh, makeBox({{5.0 * n, 0, 0}, {5.0 * n + 3, 3, 2}}));
  return mesh;
}

}  // namespace exemplar
