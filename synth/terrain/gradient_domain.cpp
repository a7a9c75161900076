// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/gradient_domain.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "core/parallel.h"
#include "core/simd.h"

namespace exemplar {
namespace {

/// What a held sample's own height counts, beside steps of weight 1.
constexpr float kHeld = 1e4f;

/// One resolution: `edge` times the sum of the differences to the neighbors, and `own` times the
/// height, is `right`.
struct Level {
  Grid<float> own, right, value;
  float edge = 1;
  bool wrapsX = false, wrapsY = false;
};

std::size_t rowGrain(int width) {
  return static_cast<std::size_t>(std::max(1, 16384 / std::max(1, width)));
}

template <class Body>
void forRows(const Grid<float>& grid, const Body& body) {
  parallelFor(0, static_cast<std::size_t>(grid.height()), rowGrain(grid.width()),
              [&](std::size_t first, std::size_t last) {
                for (std::size_t y = first; y < last; ++y) body(static_cast<int>(y));
              });
}

/// The rows above and below; null past an end that does not wrap.
struct Rows {
  const float *above, *here, *below;
};
Rows rowsAt(const Grid<float>& v, int y, bool wraps) {
  const auto row = [&](int at) -> const float* {
    if (at < 0 || at >= v.height()) {
      if (!wraps) return nullptr;
      at = at < 0 ? at + v.height() : at - v.height();
    }
    return &v.values()[static_cast<std::size_t>(at) * v.width()];
  };
  return {row(y - 1), row(y), row(y + 1)};
}

/// The sum of the neighbors' values, and how many they are.
inline std::pair<float, float> neighbors(const Rows& rows, int x, int width, bool wraps) {
  float sum = 0, count = 0;
  if (rows.above) sum += rows.above[x], count += 1;
  if (rows.below) sum += rows.below[x], count += 1;
  if (x > 0) {
    sum += rows.here[x - 1], count += 1;
  } else if (wraps) {
    sum += rows.here[width - 1], count += 1;
  }
  if (x + 1 < width) {
    sum += rows.here[x + 1], count += 1;
  } else if (wraps) {
    sum += rows.here[0], count += 1;
  }
  return {sum, count};
}

/// One sweep over the samples of one color. On a torus of odd size two neighbors are of one color
/// at its seam; rows are then visited in order, so that the bytes stay the same.
void relax(Level& level, int color) {
  const int width = level.value.width(), height = level.value.height();
  const bool odd = level.wrapsY && height % 2 == 1;
  const auto row = [&](int y) {
    const Rows rows = rowsAt(level.value, y, level.wrapsY);
    float* value = &level.value(0, y);
    const float* own = &level.own(0, y);
    const float* right = &level.right(0, y);
    for (int x = (y + color) & 1; x < width; x += 2) {
      const auto [sum, count] = neighbors(rows, x, width, level.wrapsX);
      value[x] = (right[x] + level.edge * sum) / (own[x] + level.edge * count);
    }
  };
  if (odd) {
    for (int y = 0; y < height; ++y) row(y);
  } else {
    forRows(level.value, row);
  }
}

/// The means of what is left of the equations, over 2 x 2 samples.
void restrictResidual(const Level& fine, Level& coarse) {
  const int width = fine.value.width(), height = fine.value.height();
  forRows(coarse.value, [&](int cy) {
    for (int cx = 0; cx < coarse.value.width(); ++cx) {
      float sum = 0, count = 0;
      for (int y = 2 * cy; y < std::min(2 * cy + 2, height); ++y) {
        const Rows rows = rowsAt(fine.value, y, fine.wrapsY);
        for (int x = 2 * cx; x < std::min(2 * cx + 2, width); ++x) {
          const auto [near, n] = neighbors(rows, x, width, fine.wrapsX);
          sum += fine.right(x, y) - fine.own(x, y) * rows.here[x] -
                 fine.edge * (n * rows.here[x] - near);
          count += 1;
        }
      }
      coarse.right(cx, cy) = sum / count;
      coarse.value(cx, cy) = 0;
    }
  });
}

/// Adds the coarse correction, linearly between its samples.
void addCorrection(const Level& coarse, Level& fine) {
  const int cw = coarse.value.width(), ch = coarse.value.height();
  const auto at = [](int c, int n, bool wraps) {
    return c < 0 ? (wraps ? n - 1 : 0) : c >= n ? (wraps ? 0 : n - 1) : c;
  };
  forRows(fine.value, [&](int y) {
    const int cy = y / 2, oy = at(cy + (y % 2 == 0 ? -1 : 1), ch, fine.wrapsY);
    for (int x = 0; x < fine.value.width(); ++x) {
      const int cx = x / 2, ox = at(cx + (x % 2 == 0 ? -1 : 1), cw, fine.wrapsX);
      fine.value(x, y) += (9 * coarse.value(cx, cy) + 3 * coarse.value(ox, cy) +
                           3 * coarse.value(cx, oy) + coarse.value(ox, oy)) /
                          16;
    }
  });
}

Level coarser(const Level& fine) {
  const int width = (fine.value.width() + 1) / 2, height = (fine.value.height() + 1) / 2;
  Level level{Grid<float>(width, height),
              Grid<float>(width, height),
              Grid<float>(width, height),
              fine.edge / 4,
              fine.wrapsX,
              fine.wrapsY};
  forRows(level.own, [&](int cy) {
    for (int cx = 0; cx < width; ++cx) {
      float sum = 0, count = 0;
      for (int y = 2 * cy; y < std::min(2 * cy + 2, fine.own.height()); ++y)
        for (int x = 2 * cx; x < std::min(2 * cx + 2, fine.own.width()); ++x)
          sum += fine.own(x, y), count += 1;
      level.own(cx, cy) = sum / count;
    }
  });
  return level;
}

void cycle(std::vector<Level>& levels, std::size_t at) {
  const bool last = at + 1 == levels.size();
  for (int sweep = 0; sweep < (last ? 24 : 2); ++sweep) {
    relax(levels[at], 0);
    relax(levels[at], 1);
  }
  if (last) return;
  restrictResidual(levels[at], levels[at + 1]);
  cycle(levels, at + 1);
  addCorrection(levels[at + 1], levels[at]);
  for (int sweep = 0; sweep < 2; ++sweep) {
    relax(levels[at], 1);
    relax(levels[at], 0);
  }
}

}  // namespace

void followSteps(Grid<float>& heights, const HeightSteps2D& steps, const Grid<float>& hold,
                 const GradientDomainOptions& options, const Progress& progress) {
  assert(steps.right.sameSize(heights) && steps.down.sameSize(heights));
  const int width = heights.width(), height = heights.height();
  const auto screen = static_cast<float>(options.screen);
  // The unknown is the change of the heights, so that large heights cost no accuracy.
  std::vector<Level> levels(1);
  levels[0] = {Grid<float>(width, height),
               Grid<float>(width, height),
               Grid<float>(width, height),
               1,
               options.wrapsX,
               options.wrapsY};
  Level& finest = levels[0];
  forRows(heights, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float h = heights(x, y);
      const bool isLastX = x + 1 == width, isLastY = y + 1 == height;
      float sum = 0;
      if (!isLastX || options.wrapsX)
        sum -= steps.right(x, y) - (heights(isLastX ? 0 : x + 1, y) - h);
      if (!isLastY || options.wrapsY)
        sum -= steps.down(x, y) - (heights(x, isLastY ? 0 : y + 1) - h);
      if (x > 0 || options.wrapsX) {
        const int at = x > 0 ? x - 1 : width - 1;
        sum += steps.right(at, y) - (h - heights(at, y));
      }
      if (y > 0 || options.wrapsY) {
        const int at = y > 0 ? y - 1 : height - 1;
        sum += steps.down(x, at) - (h - heights(x, at));
      }
      finest.right(x, y) = sum;
      finest.own(x, y) = screen + (hold.empty() ? 0 : kHeld * hold(x, y) * hold(x, y));
    }
  });
  while (std::min(levels.back().value.width(), levels.back().value.height()) > 8)
    levels.push_back(coarser(levels.back()));
  for (int n = 0; n < options.cycles; ++n) {
    progress.report("joining pieces", static_cast<double>(n) / options.cycles);
    cycle(levels, 0);
  }
  forRows(heights, [&](int y) {
    for (int x = 0; x < width; ++x)
      if (hold.empty() || hold(x, y) < 1) heights(x, y) += levels[0].value(x, y);
  });
}

}  // namespace exemplar
