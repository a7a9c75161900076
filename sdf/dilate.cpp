// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/dilate.h"

#include <cassert>
#include <vector>

#include "core/parallel.h"

namespace exemplar {

Array3D<std::uint8_t> dilated(Array3D<std::uint8_t> marks, int reach) {
  assert(reach >= 0);
  const Vec3i n = marks.size();
  for (int axis = 0; axis < 3; ++axis) {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    parallelFor(0, static_cast<std::size_t>(n[b]) * n[c], 64, [&](std::size_t l0, std::size_t l1) {
      std::vector<std::uint8_t> line(n[axis]);
      for (std::size_t l = l0; l < l1; ++l) {
        Vec3i at;
        at[b] = static_cast<int>(l % n[b]);
        at[c] = static_cast<int>(l / n[b]);
        for (int i = 0; i < n[axis]; ++i) {
          at[axis] = i;
          line[i] = marks[at];
        }
        int last = -reach - 1, next = -1;  // the nearest marks behind and ahead
        for (int i = 0; i < n[axis]; ++i) {
          if (line[i]) last = i;
          if (next < i) {
            next = i;
            while (next < n[axis] && !line[next]) ++next;
          }
          at[axis] = i;
          marks[at] = i - last <= reach || (next < n[axis] && next - i <= reach);
        }
      }
    });
  }
  return marks;
}

}  // namespace exemplar
