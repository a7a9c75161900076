// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/cells.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/array3d.h"

namespace exemplar {
namespace {

TEST(ForEachCell, GoesInTheOrderOfStorage) {
  const Array3D<int> grid({4, 3, 5});
  std::size_t next = 0;
  forEachCell(grid.size(), [&](const Vec3i& p) { EXPECT_EQ(grid.index(p), next++); });
  EXPECT_EQ(next, grid.count());
}

TEST(ForEachCell, VisitsEachCellOfABoxOnce) {
  for (const CellBox& box : {CellBox{{1, 0, 2}, {4, 3, 3}}, CellBox{{0, 0, 0}, {5, 6, 7}},
                             CellBox{{2, 2, 2}, {2, 5, 5}}, CellBox{{3, 3, 3}, {1, 5, 5}}}) {
    Array3D<int> serial({5, 6, 7}, 0), parallel({5, 6, 7}, 0);
    forEachCell(box, [&](const Vec3i& p) { ++serial[p]; });
    parallelForEachCell(box, [&](const Vec3i& p) { ++parallel[p]; });
    for (std::size_t s = 0; s < serial.count(); ++s) {
      EXPECT_EQ(serial.values()[s], box.contains(serial.ijk(s)) ? 1 : 0);
    }
    EXPECT_EQ(serial, parallel);
  }
}

TEST(CellBox, MeetsAndGrows) {
  const CellBox box{{1, 2, 3}, {4, 5, 6}};
  EXPECT_EQ(box.grown(2), (CellBox{{-1, 0, 1}, {6, 7, 8}}));
  EXPECT_EQ(box.grown(2) & CellBox::of({5, 5, 5}), (CellBox{{0, 0, 1}, {5, 5, 5}}));
  EXPECT_EQ(box.size(), (Vec3i{3, 3, 3}));
  EXPECT_TRUE((box & CellBox{{4, 0, 0}, {9, 9, 9}}).empty());
}

}  // namespace
}  // namespace exemplar
