// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/drainage.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include "core/error.h"
#include "core/parallel.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kRowsAtOnce = 16;

/// A float's bits as a number of the same order; both zeros are one.
std::uint32_t ordered(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value + 0.0f);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

double stepLength(std::uint8_t direction) {
  return direction < 8 && direction % 2 == 1 ? std::numbers::sqrt2 : 1;
}

/// The cells of a grid and their neighbors by index.
class Cells {
 public:
  Cells(int width, int height) : width_(width), height_(height) {
    for (int n = 0; n < 8; ++n)
      steps_[n] = static_cast<std::ptrdiff_t>(kNeighbors[n].y) * width + kNeighbors[n].x;
  }

  /// Whether all eight neighbors of a cell are in the grid.
  bool isInside(std::size_t cell) const {
    const auto x = static_cast<int>(cell % static_cast<std::size_t>(width_));
    const auto y = static_cast<int>(cell / static_cast<std::size_t>(width_));
    return x > 0 && y > 0 && x + 1 < width_ && y + 1 < height_;
  }
  std::size_t neighbor(std::size_t cell, int n) const {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell) + steps_[n]);
  }
  /// Calls `body(number, index)` for the neighbors that are in the grid.
  template <class Body>
  void forNeighbors(std::size_t cell, const Body& body) const {
    if (isInside(cell)) {
      for (int n = 0; n < 8; ++n) body(n, neighbor(cell, n));
      return;
    }
    const auto x = static_cast<int>(cell % static_cast<std::size_t>(width_));
    const auto y = static_cast<int>(cell / static_cast<std::size_t>(width_));
    for (int n = 0; n < 8; ++n) {
      const int a = x + kNeighbors[n].x, b = y + kNeighbors[n].y;
      if (a >= 0 && b >= 0 && a < width_ && b < height_) body(n, neighbor(cell, n));
    }
  }
  /// Where a cell drains to, or `kNone`.
  std::uint32_t downstream(const Drainage& drainage, std::size_t cell) const {
    const std::uint8_t direction = drainage.directions[cell];
    return direction < 8 ? static_cast<std::uint32_t>(neighbor(cell, direction)) : kNone;
  }

 private:
  int width_, height_;
  std::ptrdiff_t steps_[8];
};

/// For cells on flats, how many steps through cells of the same height it is to higher ground, from
/// 1, at most 255; 0 for all others, and on flats that no higher ground touches.
Grid<std::uint8_t> stepsFromHigherGround(const Grid<float>& heights, const Cells& cells) {
  Grid<std::uint8_t> steps(heights.width(), heights.height());
  const auto rows = static_cast<std::size_t>(heights.height());
  const auto width = static_cast<std::size_t>(heights.width());
  parallelFor(0, rows, kRowsAtOnce, [&](std::size_t first, std::size_t last) {
    for (std::size_t cell = first * width; cell < last * width; ++cell) {
      bool flat = false, higher = false;
      cells.forNeighbors(cell, [&](int, std::size_t other) {
        flat |= heights[other] == heights[cell];
        higher |= heights[other] > heights[cell];
      });
      steps[cell] = flat && higher;
    }
  });
  std::vector<std::uint32_t> front, next;
  for (std::size_t cell = 0; cell < steps.count(); ++cell)
    if (steps[cell]) front.push_back(static_cast<std::uint32_t>(cell));
  for (std::uint8_t step = 2; !front.empty() && step != 0; ++step) {
    next.clear();
    for (const std::uint32_t cell : front) {
      cells.forNeighbors(cell, [&](int, std::size_t other) {
        if (steps[other] || heights[other] != heights[cell]) return;
        steps[other] = step;
        next.push_back(static_cast<std::uint32_t>(other));
      });
    }
    front.swap(next);
  }
  return steps;
}

/// The cells that the flood has met and not yet passed, the next one first: a heap with four
/// children a node, which is shallower than one with two.
class Front {
 public:
  bool empty() const { return heap_.empty(); }

  void push(float level, float height, std::uint8_t fromHigher, std::uint32_t cell) {
    const Entry entry{static_cast<std::uint64_t>(ordered(level)) << 32 | ordered(height),
                      static_cast<std::uint64_t>(255 - fromHigher) << 32 | met_++, cell};
    std::size_t at = heap_.size();
    heap_.push_back(entry);
    for (; at > 0; at = (at - 1) / 4) {
      const std::size_t above = (at - 1) / 4;
      if (!(entry < heap_[above])) break;
      heap_[at] = heap_[above];
    }
    heap_[at] = entry;
  }

  std::uint32_t pop() {
    const std::uint32_t cell = heap_.front().cell;
    const Entry entry = heap_.back();
    heap_.pop_back();
    if (heap_.empty()) return cell;
    std::size_t at = 0;
    for (;;) {
      const std::size_t first = 4 * at + 1, last = std::min(first + 4, heap_.size());
      if (first >= last) break;
      std::size_t least = first;
      for (std::size_t child = first + 1; child < last; ++child)
        if (heap_[child] < heap_[least]) least = child;
      if (!(heap_[least] < entry)) break;
      heap_[at] = heap_[least];
      at = least;
    }
    heap_[at] = entry;
    return cell;
  }

 private:
  struct Entry {
    std::uint64_t place;  ///< level, then height
    std::uint64_t tie;    ///< steps from higher ground, most first, then the number of the meeting
    std::uint32_t cell;
    bool operator<(const Entry& other) const {
      return place != other.place ? place < other.place : tie < other.tie;
    }
  };
  std::vector<Entry> heap_;
  std::uint32_t met_ = 0;
};

/// Sets a cell's direction to where its level falls most steeply, if it falls anywhere.
void turnDownhill(Drainage& drainage, const Cells& cells, std::size_t cell) {
  const double level = drainage.levels[cell];
  double steepest = 0;
  cells.forNeighbors(cell, [&](int n, std::size_t other) {
    // Comparisons with NaN are false.
    const double slope =
        (level - drainage.levels[other]) / stepLength(static_cast<std::uint8_t>(n));
    if (slope > steepest) {
      steepest = slope;
      drainage.directions[cell] = static_cast<std::uint8_t>(n);
    }
  });
}

/// The cells upstream of each stream cell on whose course it goes on, `kNone` at sources.
std::vector<std::uint32_t> mainUpstream(const Drainage& drainage, const Cells& cells,
                                        const Grid<std::uint32_t>& accumulation,
                                        std::uint32_t threshold) {
  std::vector<std::uint32_t> main(accumulation.count(), kNone);
  for (std::size_t cell = 0; cell < main.size(); ++cell) {
    if (accumulation[cell] < threshold) continue;
    const std::uint32_t to = cells.downstream(drainage, cell);
    if (to == kNone) continue;
    if (main[to] == kNone || accumulation[cell] > accumulation[main[to]])
      main[to] = static_cast<std::uint32_t>(cell);
  }
  return main;
}

}  // namespace

Drainage drain(const Grid<float>& heights, const Progress& progress) {
  if (heights.empty()) throw InputError("a map without cells has no drainage");
  if (heights.count() >= kNone) {
    throw InputError("a map of " + std::to_string(heights.width()) + " x " +
                     std::to_string(heights.height()) +
                     " cells is too large for its drainage; use a smaller one");
  }
  const Cells cells(heights.width(), heights.height());
  const std::size_t count = heights.count();
  Drainage drainage{heights, Grid<std::uint8_t>(heights.width(), heights.height(), kNoData), {}};
  progress.report("draining", 0);
  const Grid<std::uint8_t> fromHigher = stepsFromHigherGround(heights, cells);
  Front front;
  std::size_t withData = 0;
  for (std::size_t cell = 0; cell < count; ++cell) {
    if (std::isnan(heights[cell])) continue;
    if (std::isinf(heights[cell])) throw InputError("the map has a height that is infinite");
    ++withData;
    bool leaves = !cells.isInside(cell);
    cells.forNeighbors(cell, [&](int, std::size_t other) { leaves |= std::isnan(heights[other]); });
    if (!leaves) continue;
    drainage.directions[cell] = kLeavesMap;
    front.push(heights[cell], heights[cell], fromHigher[cell], static_cast<std::uint32_t>(cell));
  }
  drainage.order.reserve(withData);
  while (!front.empty()) {
    const std::uint32_t cell = front.pop();
    if (drainage.order.size() % 65536 == 0)
      progress.report("draining", 0.9 * static_cast<double>(drainage.order.size()) /
                                      static_cast<double>(count));
    drainage.order.push_back(cell);
    cells.forNeighbors(cell, [&](int n, std::size_t other) {
      if (drainage.directions[other] != kNoData || std::isnan(heights[other])) return;
      drainage.directions[other] = static_cast<std::uint8_t>((n + 4) % 8);
      drainage.levels[other] = std::max(heights[other], drainage.levels[cell]);
      front.push(drainage.levels[other], heights[other], fromHigher[other],
                 static_cast<std::uint32_t>(other));
    });
  }
  // Cells are passed in the order of their levels: what a level falls to was passed before it.
  const auto width = static_cast<std::size_t>(heights.width());
  parallelFor(0, static_cast<std::size_t>(heights.height()), kRowsAtOnce,
              [&](std::size_t first, std::size_t last) {
                progress.check();
                for (std::size_t cell = first * width; cell < last * width; ++cell)
                  turnDownhill(drainage, cells, cell);
              });
  progress.report("draining", 1);
  return drainage;
}

Grid<float> negated(const Grid<float>& heights) {
  Grid<float> result = heights;
  for (float& h : result.values()) h = -h;
  return result;
}

std::vector<Depression> depressions(const Grid<float>& heights, const Grid<float>& levels,
                                    float minDepth) {
  assert(heights.sameSize(levels));
  const Cells cells(heights.width(), heights.height());
  std::vector<Depression> found;
  std::vector<bool> seen(heights.count());
  std::vector<std::uint32_t> open;
  for (std::size_t start = 0; start < heights.count(); ++start) {
    if (seen[start] || !(levels[start] > heights[start])) continue;
    Depression depression{.level = levels[start], .lowest = static_cast<std::uint32_t>(start)};
    seen[start] = true;
    open.assign(1, static_cast<std::uint32_t>(start));
    while (!open.empty()) {
      const std::uint32_t cell = open.back();
      open.pop_back();
      ++depression.cells;
      const float h = heights[cell], lowest = heights[depression.lowest];
      if (h < lowest || (h == lowest && cell < depression.lowest)) depression.lowest = cell;
      cells.forNeighbors(cell, [&](int, std::size_t other) {
        if (seen[other] || !(levels[other] > heights[other])) return;
        seen[other] = true;
        open.push_back(static_cast<std::uint32_t>(other));
      });
    }
    depression.depth = depression.level - heights[depression.lowest];
    if (depression.depth >= minDepth) found.push_back(depression);
  }
  return found;
}

Grid<std::uint32_t> flowAccumulation(const Drainage& drainage) {
  const Cells cells(drainage.levels.width(), drainage.levels.height());
  Grid<std::uint32_t> sum(drainage.levels.width(), drainage.levels.height());
  for (std::size_t n = drainage.order.size(); n-- > 0;) {
    const std::uint32_t cell = drainage.order[n];
    ++sum[cell];
    const std::uint32_t to = cells.downstream(drainage, cell);
    if (to != kNone) sum[to] += sum[cell];
  }
  return sum;
}

double StreamNetwork::length() const {
  return std::accumulate(lengths.begin(), lengths.end(), 0.0);
}

std::optional<double> StreamNetwork::bifurcationRatio() const {
  double sum = 0, weights = 0;
  for (std::size_t k = 0; k + 1 < streams.size(); ++k) {
    const auto fewer = static_cast<double>(streams[k + 1]), more = static_cast<double>(streams[k]);
    sum += more / fewer * (more + fewer);
    weights += more + fewer;
  }
  return weights > 0 ? std::optional(sum / weights) : std::nullopt;
}

StreamNetwork streamNetwork(const Drainage& drainage, const Grid<std::uint32_t>& accumulation,
                            std::uint32_t threshold) {
  threshold = std::max(threshold, 1u);
  const Cells cells(drainage.levels.width(), drainage.levels.height());
  StreamNetwork network;
  network.orders = Grid<std::uint8_t>(drainage.levels.width(), drainage.levels.height());
  // Until a cell's turn, the highest order that flows into it, and whether it does twice.
  std::vector<bool> twice(accumulation.count());
  for (std::size_t n = drainage.order.size(); n-- > 0;) {
    const std::uint32_t cell = drainage.order[n];
    if (accumulation[cell] < threshold) continue;
    std::uint8_t& order = network.orders[cell];
    const bool begins = order == 0 || twice[cell];
    if (begins) ++order;
    if (network.streams.size() < order) {
      network.streams.resize(order);
      network.lengths.resize(order);
    }
    network.streams[order - 1u] += begins;
    network.lengths[order - 1u] += stepLength(drainage.directions[cell]);
    const std::uint32_t to = cells.downstream(drainage, cell);
    if (to == kNone) continue;
    std::uint8_t& highest = network.orders[to];
    if (order > highest) {
      highest = order;
      twice[to] = false;
    } else if (order == highest) {
      twice[to] = true;
    }
  }
  return network;
}

std::vector<FlowLine> flowLines(const Drainage& drainage, const Grid<std::uint32_t>& accumulation,
                                std::uint32_t threshold, const Grid<float>* heights) {
  threshold = std::max(threshold, 1u);
  const Cells cells(drainage.levels.width(), drainage.levels.height());
  const std::vector<std::uint32_t> main = mainUpstream(drainage, cells, accumulation, threshold);
  const auto flooded = [&](std::uint32_t cell) {
    return heights && drainage.levels[cell] > (*heights)[cell];
  };
  std::vector<FlowLine> lines;
  FlowLine line;
  const auto end = [&] {
    if (line.size() > 1) lines.push_back(line);
    line.clear();
  };
  for (std::size_t source = 0; source < main.size(); ++source) {
    if (accumulation[source] < threshold || main[source] != kNone) continue;
    auto cell = static_cast<std::uint32_t>(source);
    for (;;) {
      if (flooded(cell)) {
        end();
      } else {
        line.push_back(cell);
      }
      const std::uint32_t to = cells.downstream(drainage, cell);
      if (to == kNone) break;
      if (main[to] != cell) {  // the junction with a larger stream
        if (!flooded(to) && !flooded(cell)) line.push_back(to);
        break;
      }
      cell = to;
    }
    end();
  }
  return lines;
}

double lengthOf(const FlowLine& line, int width) {
  double length = 0;
  for (std::size_t n = 0; n + 1 < line.size(); ++n) {
    const std::uint32_t step =
        line[n] < line[n + 1] ? line[n + 1] - line[n] : line[n] - line[n + 1];
    const bool straight = step == 1 || step == static_cast<std::uint32_t>(width);
    length += straight ? 1 : std::numbers::sqrt2;
  }
  return length;
}

}  // namespace exemplar
