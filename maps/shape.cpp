// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/shape.h"

#include <algorithm>
#include <functional>

#include "core/disjoint_sets.h"
#include "core/simd.h"

namespace exemplar {
namespace {

/// Consecutive cells of one value along x.
struct Run {
  std::uint32_t first, end;  ///< indices of cells
  bool inside;
};

/// A shape as runs, row by row, and which of them are connected by sides.
class Components {
 public:
  Components(const Shape& shape, bool wraps) {
    const Vec3i& size = shape.size();
    const auto rows = static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
    for (std::size_t row = 0; row < rows; ++row) {
      firstOfRow_.push_back(runs_.size());
      addRow(shape, row);
    }
    firstOfRow_.push_back(runs_.size());
    sets_.reset(runs_.size());
    for (int z = 0; z < size.z; ++z) {
      for (int y = 0; y < size.y; ++y) {
        const auto row = static_cast<std::size_t>(z) * size.y + y;
        if (wraps && size.x > 1) joinEnds(row);
        if (y > 0 || (wraps && size.y > 1))
          joinRows(size, row, y > 0 ? row - 1 : row + static_cast<std::size_t>(size.y - 1));
        if (z > 0 || (wraps && size.z > 1))
          joinRows(size, row,
                   z > 0 ? row - static_cast<std::size_t>(size.y)
                         : row + static_cast<std::size_t>(size.z - 1) * size.y);
      }
    }
    cells_.resize(runs_.size());
    for (std::uint32_t r = 0; r < runs_.size(); ++r)
      cells_[sets_.find(r)] += runs_[r].end - runs_[r].first;
  }

  /// Calls `body(run, cells, first)` for each run: how many cells its component has, and whether it
  /// is the first of it.
  template <class Body>
  void forEachRun(Body&& body) {
    for (std::uint32_t r = 0; r < runs_.size(); ++r) {
      const std::uint32_t root = sets_.find(r);
      body(runs_[r], cells_[root], root == r);
    }
  }

 private:
  void addRow(const Shape& shape, std::size_t row) {
    const auto length = static_cast<std::uint32_t>(shape.size().x);
    const std::uint8_t* inside = shape.data();
    const auto begin = static_cast<std::uint32_t>(row * length), end = begin + length;
    for (std::uint32_t first = begin, p = begin; p < end; first = p) {
      do {
        ++p;
      } while (p < end && inside[p] == inside[first]);
      runs_.push_back({first, p, inside[first] != 0});
    }
  }
  void joinEnds(std::size_t row) {
    const std::size_t first = firstOfRow_[row], last = firstOfRow_[row + 1] - 1;
    if (runs_[first].inside == runs_[last].inside) join(first, last);
  }
  void joinRows(const Vec3i& size, std::size_t a, std::size_t b) {
    const auto length = static_cast<std::size_t>(size.x);
    std::size_t i = firstOfRow_[a], j = firstOfRow_[b];
    while (i < firstOfRow_[a + 1] && j < firstOfRow_[b + 1]) {
      if (runs_[i].inside == runs_[j].inside) join(i, j);
      const std::size_t endA = runs_[i].end - a * length, endB = runs_[j].end - b * length;
      i += endA <= endB;
      j += endB <= endA;
    }
  }
  void join(std::size_t i, std::size_t j) {
    sets_.join(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
  }

  std::vector<Run> runs_;
  std::vector<std::size_t> firstOfRow_;
  DisjointSets sets_;
  std::vector<std::uint32_t> cells_;  // of each set, at its first run
};

/// Where a row differs from rows beside it and from itself moved by a cell either way; what lies
/// before and after it is given.
EXEMPLAR_MULTIVERSION
void edgesAmong(const std::uint8_t* row, const std::uint8_t* const* beside, std::uint8_t before,
                std::uint8_t after, std::uint8_t side, int length, std::uint8_t* edges) {
  const std::uint8_t *a = beside[0], *b = beside[1], *c = beside[2], *d = beside[3];
  for (int x = 0; x < length; ++x)
    edges[x] = static_cast<std::uint8_t>((row[x] ^ a[x]) | (row[x] ^ b[x]) | (row[x] ^ c[x]) |
                                         (row[x] ^ d[x]));
  for (int x = 1; x < length; ++x) edges[x] |= static_cast<std::uint8_t>(row[x] ^ row[x - 1]);
  for (int x = 0; x + 1 < length; ++x) edges[x] |= static_cast<std::uint8_t>(row[x] ^ row[x + 1]);
  edges[0] |= static_cast<std::uint8_t>(row[0] ^ before);
  edges[length - 1] |= static_cast<std::uint8_t>(row[length - 1] ^ after);
  for (int x = 0; x < length; ++x)
    edges[x] &= static_cast<std::uint8_t>(row[x] ^ side ^ std::uint8_t{1});
}

}  // namespace

void edgesOfRow(const Shape& shape, bool inside, bool wraps, int y, int z,
                std::span<std::uint8_t> edges) {
  const Vec3i& size = shape.size();
  // What lies beyond the grid differs from nothing: the row itself stands for it.
  const auto rowAt = [&](Vec3i p) {
    if (wraps) p = wrappedPlace(p, size);
    return shape.contains(p) ? &shape[p] : &shape(0, y, z);
  };
  const std::uint8_t* row = &shape(0, y, z);
  const std::uint8_t* beside[] = {rowAt({0, y - 1, z}), rowAt({0, y + 1, z}), rowAt({0, y, z - 1}),
                                  rowAt({0, y, z + 1})};
  edgesAmong(row, beside, wraps ? row[size.x - 1] : row[0], wraps ? row[0] : row[size.x - 1],
             inside, size.x, edges.data());
}

std::vector<std::uint32_t> componentSizes(const Shape& shape, bool inside, bool wraps) {
  std::vector<std::uint32_t> sizes;
  Components(shape, wraps).forEachRun([&](const Run& run, std::uint32_t cells, bool first) {
    if (first && run.inside == inside) sizes.push_back(cells);
  });
  return sizes;
}

void removeSmall(Shape& shape, const ComponentLimits& inside, const ComponentLimits& outside,
                 bool wraps) {
  Components components(shape, wraps);
  std::vector<std::uint32_t> sizes[2];
  components.forEachRun([&](const Run& run, std::uint32_t cells, bool first) {
    if (first) sizes[run.inside].push_back(cells);
  });
  const auto leastOf = [&](bool side, const ComponentLimits& limits) {
    std::vector<std::uint32_t>& all = sizes[side];
    if (all.size() <= limits.most) return limits.least;
    const auto last = all.begin() + static_cast<std::ptrdiff_t>(limits.most);
    std::ranges::nth_element(all, last, std::greater{});
    return std::max(limits.least,
                    limits.most == 0 ? *last + 1 : *std::min_element(all.begin(), last));
  };
  const std::uint32_t least[] = {leastOf(false, outside), leastOf(true, inside)};
  components.forEachRun([&](const Run& run, std::uint32_t cells, bool) {
    if (cells < least[run.inside])
      std::fill(shape.data() + run.first, shape.data() + run.end, !run.inside);
  });
}

std::vector<Vec3i> boundaryOf(const Shape& shape, bool wraps) {
  std::vector<Vec3i> boundary;
  forEachEdgeCell(shape, true, wraps, [&](const Vec3i& p, std::size_t) { boundary.push_back(p); });
  return boundary;
}

std::int64_t insideOf(const Shape& shape, const Shape* among) {
  std::int64_t inside = 0;
  for (std::size_t p = 0; p < shape.count(); ++p)
    inside += shape.data()[p] != 0 && (!among || among->data()[p]);
  return inside;
}

std::int64_t boundaryCount(const Shape& shape, bool wraps, const Shape* among) {
  std::int64_t count = 0;
  forEachEdgeCell(shape, true, wraps,
                  [&](const Vec3i&, std::size_t at) { count += !among || among->data()[at]; });
  return count;
}

Shape outsideOf(const Shape& shape) {
  Shape outside(shape.size());
  for (std::size_t p = 0; p < shape.count(); ++p) outside.data()[p] = !shape.data()[p];
  return outside;
}

double areaOf(const Shape& shape) {
  return static_cast<double>(insideOf(shape)) / static_cast<double>(shape.count());
}

}  // namespace exemplar
