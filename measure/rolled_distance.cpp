// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/rolled_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/fourier.h"
#include "core/parallel.h"

namespace exemplar {
namespace {

/// Shifts that are compared cell by cell after all were compared by FFT.
constexpr std::size_t kKept = 16;
/// No more larger cells than this along an axis.
constexpr int kMostAlong = 256;

/// How many cells the shifts are found on: the volume's own, or fewer, larger ones.
Vec3i searchSize(const Vec3i& size, std::int64_t cells) {
  const auto all = static_cast<double>(volume(size));
  const double shrink = std::max(1.0, std::cbrt(all / static_cast<double>(cells)));
  Vec3i found;
  for (int axis = 0; axis < 3; ++axis) {
    const int least = std::min(size[axis], kMostAlong);
    const int wanted = std::clamp(static_cast<int>(size[axis] / shrink), 1, least);
    found[axis] = wanted == size[axis] ? wanted : std::min(size[axis], quickLength(wanted));
  }
  return found;
}

/// How much of each cell of one axis lies in which of the larger cells: one or two of them.
struct Share {
  int cell = 0;
  float first = 1, next = 0;
};
std::vector<Share> shares(int from, int to) {
  std::vector<Share> all(static_cast<std::size_t>(from));
  for (int c = 0; c < from; ++c) {
    // In units of 1 / from of a larger cell, exactly.
    const std::int64_t low = std::int64_t{c} * to, high = low + to;
    Share& share = all[static_cast<std::size_t>(c)];
    share.cell = static_cast<int>(low / from);
    const std::int64_t border = std::int64_t{share.cell + 1} * from;
    share.first = static_cast<float>(std::min(high, border) - low) / static_cast<float>(to);
    share.next = 1 - share.first;
  }
  return all;
}

/// The solid of `window`, from the low corner of a grid that stands for `size` cells.
Array3D<float> solidOf(const Occupancy& occupancy, const CellBox& window, const Vec3i& size,
                       const Vec3i& grid) {
  Array3D<float> solid(grid);
  std::array<std::vector<Share>, 3> along;
  for (int axis = 0; axis < 3; ++axis) along[axis] = shares(size[axis], grid[axis]);
  forEachCell(window, [&](const Vec3i& p) {
    if (!occupancy.solid(p.x, p.y, p.z)) return;
    const Vec3i q = p - window.begin;
    for (int part = 0; part < 8; ++part) {
      float amount = 1;
      Vec3i to;
      for (int axis = 0; axis < 3; ++axis) {
        const Share& share = along[axis][static_cast<std::size_t>(q[axis])];
        const bool next = (part >> axis & 1) != 0;
        amount *= next ? share.next : share.first;
        to[axis] = (share.cell + next) % grid[axis];
      }
      if (amount > 0) solid[to] += amount;
    }
  });
  return solid;
}

/// Whether no neighbor, around the grid, is better.
bool isPeak(const Array3D<float>& score, const Vec3i& p) {
  const Vec3i n = score.size();
  for (int k = -1; k <= 1; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        if (score((p.x + i + n.x) % n.x, (p.y + j + n.y) % n.y, (p.z + k + n.z) % n.z) > score[p])
          return false;
  return true;
}

/// The best shifts of a score, the best first; of equal ones the first.
std::vector<Vec3i> bestShifts(const Array3D<float>& score, bool peaks) {
  std::vector<std::pair<float, std::size_t>> best;  // a heap with the worst on top
  const auto better = [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  };
  for (std::size_t s = 0; s < score.count(); ++s) {
    const std::pair candidate{score.data()[s], s};
    if (best.size() == kKept && !better(candidate, best.front())) continue;
    if (peaks && !isPeak(score, score.ijk(s))) continue;
    if (best.size() == kKept) {
      std::pop_heap(best.begin(), best.end(), better);
      best.pop_back();
    }
    best.push_back(candidate);
    std::push_heap(best.begin(), best.end(), better);
  }
  std::sort_heap(best.begin(), best.end(), better);
  std::vector<Vec3i> shifts;
  for (const auto& [value, s] : best) shifts.push_back(score.ijk(s));
  return shifts;
}

/// A shift and what it makes of a window.
struct Placed {
  Vec3i shift{};
  Overlap overlap;
};

/// `shift` moved to its best neighbor for as long as there is a better one.
Placed climbed(const Occupancy& result, const CellBox& window, const Occupancy& example,
               const Vec3i& shift, const Progress& progress) {
  const Vec3i n = example.size();
  Placed best{shift, rolledOverlap(result, window, example, shift)};
  for (bool moved = true; moved;) {
    progress.check();
    moved = false;
    const Vec3i from = best.shift;
    for (int step = 0; step < 27; ++step) {
      const Vec3i by{step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1};
      Vec3i to;
      for (int axis = 0; axis < 3; ++axis) to[axis] = (from[axis] + by[axis] + n[axis]) % n[axis];
      const Overlap overlap = rolledOverlap(result, window, example, to);
      if (overlap.iou() <= best.overlap.iou()) continue;
      best = {to, overlap};
      moved = true;
    }
  }
  return best;
}

/// One example, as it is or turned, against windows of one size.
class Roller {
 public:
  Roller(const Occupancy& example, const Vec3i& window, std::int64_t cells,
         const Progress& progress)
      : example_(example), grid_(searchSize(example.size(), cells)) {
    solid_ = solidOf(example, CellBox::of(example.size()), example.size(), grid_);
    if (window == example.size()) return;
    // How much of the rolled example a smaller window sees.
    Array3D<float> seen(grid_);
    std::array<std::vector<Share>, 3> along;
    for (int axis = 0; axis < 3; ++axis) along[axis] = shares(example.size()[axis], grid_[axis]);
    const auto part = [&](int axis, int cell) {
      float sum = 0;
      for (int c = 0; c < window[axis]; ++c) {
        const Share& share = along[axis][static_cast<std::size_t>(c)];
        if (share.cell == cell) sum += share.first;
        if (share.cell + 1 == cell) sum += share.next;
      }
      return sum * static_cast<float>(grid_[axis]) / static_cast<float>(example.size()[axis]);
    };
    std::array<std::vector<float>, 3> parts;
    for (int axis = 0; axis < 3; ++axis)
      for (int cell = 0; cell < grid_[axis]; ++cell) parts[axis].push_back(part(axis, cell));
    forEachCell(grid_, [&](const Vec3i& p) {
      seen[p] = parts[0][static_cast<std::size_t>(p.x)] * parts[1][static_cast<std::size_t>(p.y)] *
                parts[2][static_cast<std::size_t>(p.z)];
    });
    seen_ = circularCorrelation(seen, solid_, progress);
  }

  Placed best(const Occupancy& result, const CellBox& window, const Progress& progress) const {
    const Vec3i n = example_.size();
    const Array3D<float> solid = solidOf(result, window, n, grid_);
    Array3D<float> score = circularCorrelation(solid, solid_, progress.part(0, 0.5));
    if (!seen_.empty()) {
      // Cells of the grid stand for several: what is common is counted in products of their shares,
      // which is near enough to know which shifts to look at.
      double mine = 0;
      for (const float s : solid.values()) mine += s;
      const double each = static_cast<double>(volume(n)) / static_cast<double>(volume(grid_));
      for (std::size_t s = 0; s < score.count(); ++s) {
        const double both = score.data()[s] / each, either = mine + seen_.data()[s] - both;
        score.data()[s] = static_cast<float>(either > 0.5 ? both / either : 1);
      }
    }
    const bool exact = grid_ == n;
    const std::vector<Vec3i> shifts = bestShifts(score, !exact);
    std::vector<Placed> placed(shifts.size());
    parallelFor(0, shifts.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t s = first; s < last; ++s) {
        if (exact) {
          placed[s] = {shifts[s], rolledOverlap(result, window, example_, shifts[s])};
          continue;
        }
        Vec3i shift;
        for (int axis = 0; axis < 3; ++axis)
          shift[axis] = static_cast<int>(std::lround(static_cast<double>(shifts[s][axis]) *
                                                     n[axis] / grid_[axis])) %
                        n[axis];
        placed[s] = climbed(result, window, example_, shift, progress);
      }
    });
    Placed best = placed.front();
    for (const Placed& p : placed)
      if (p.overlap.iou() > best.overlap.iou()) best = p;
    return best;
  }

 private:
  const Occupancy& example_;
  Vec3i grid_;
  Array3D<float> solid_;  ///< of the example
  Array3D<float> seen_;   ///< solid of the rolled example in the window; none where it is as large
};

/// The windows that cover a result, as few as possible, evenly spaced.
std::vector<CellBox> windowsOf(const Vec3i& result, const Vec3i& window) {
  Vec3i count;
  for (int axis = 0; axis < 3; ++axis)
    count[axis] = (result[axis] + window[axis] - 1) / window[axis];
  std::vector<CellBox> windows;
  forEachCell(count, [&](const Vec3i& w) {
    Vec3i begin;
    for (int axis = 0; axis < 3; ++axis) {
      const int room = result[axis] - window[axis];
      begin[axis] =
          count[axis] < 2 ? 0 : static_cast<int>(std::int64_t{room} * w[axis] / (count[axis] - 1));
    }
    windows.push_back({begin, begin + window});
  });
  return windows;
}

RolledDistance distanceOf(const Occupancy& example, const Occupancy& result, std::int64_t cells,
                          const Progress& progress) {
  const Vec3i window = min(example.size(), result.size());
  const Roller roller(example, window, cells, progress.part(0, 0.1));
  const std::vector<CellBox> windows = windowsOf(result.size(), window);
  RolledDistance found{.distance = 0, .least = 2, .windows = static_cast<int>(windows.size())};
  Overlap sum;
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const double from = 0.1 + 0.9 * static_cast<double>(w) / static_cast<double>(windows.size());
    progress.report("rolling the example", from);
    const Placed placed = roller.best(
        result, windows[w], progress.part(from, from + 0.9 / static_cast<double>(windows.size())));
    sum += placed.overlap;
    if (1 - placed.overlap.iou() >= found.least) continue;
    found.least = 1 - placed.overlap.iou();
    found.shift = placed.shift;
  }
  found.distance = 1 - sum.iou();
  return found;
}

}  // namespace

RolledDistance rolledDistance(const Occupancy& example, const Occupancy& result,
                              const RolledDistanceOptions& options, const Progress& progress) {
  if (volume(example.size()) == 0 || volume(result.size()) == 0)
    throw InputError("a volume without cells cannot be compared; give one with at least one");
  if (!options.turned) return distanceOf(example, result, options.cells, progress);
  std::optional<RolledDistance> best;
  for (int way = 0; way < 8; ++way) {
    const Progress part = progress.part(way / 8.0, (way + 1) / 8.0);
    const RolledDistance found =
        distanceOf(turnedOccupancy(example, way & 3, way >= 4), result, options.cells, part);
    if (!best || found.distance < best->distance) best = found;
  }
  return *best;
}

double rolledDiversity(std::span<const Occupancy> results, const RolledDistanceOptions& options,
                       const Progress& progress) {
  double sum = 0;
  const double pairs =
      static_cast<double>(results.size()) * (static_cast<double>(results.size()) - 1) / 2;
  std::int64_t done = 0;
  for (std::size_t a = 0; a < results.size(); ++a)
    for (std::size_t b = a + 1; b < results.size(); ++b, ++done) {
      if (results[a].size() != results[b].size())
        throw InputError("results of different sizes cannot be compared; give results of one size");
      const double from = static_cast<double>(done) / pairs;
      sum += rolledDistance(results[a], results[b], options, progress.part(from, from + 1 / pairs))
                 .distance;
    }
  return done == 0 ? 0 : sum / static_cast<double>(done);
}

}  // namespace exemplar
