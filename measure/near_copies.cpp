// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/near_copies.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/parallel.h"

namespace exemplar {
namespace {

constexpr int kWindow = 8;            // columns a side
constexpr int kAgree = 19, kOf = 20;  // 95 %

/// A table over the columns of two grids' overlap.
struct Table {
  int x = 0, y = 0;
  std::vector<std::int32_t> values;

  void reset(int nx, int ny) {
    x = nx;
    y = ny;
    values.assign(static_cast<std::size_t>(nx) * ny, 0);
  }
  std::int32_t* row(int j) { return values.data() + static_cast<std::size_t>(j) * x; }
  /// Sums windows of w x h, in place: what does not begin a whole one is left as it is.
  void sumWindows(int w, int h) {
    for (int j = 0; j < y; ++j) {
      std::int32_t* r = row(j);
      for (int i = 0; i + w <= x; ++i) {
        for (int k = 1; k < w; ++k) r[i] += r[i + k];
      }
    }
    for (int j = 0; j + h <= y; ++j) {
      for (int k = 1; k < h; ++k) {
        const std::int32_t* from = row(j + k);
        std::int32_t* to = row(j);
        for (int i = 0; i < x; ++i) to[i] += from[i];
      }
    }
  }
};

/// The windows that agree at one offset, and the largest area that they cover.
class Offset {
 public:
  /// `near` has a flag for each column of the result, set where a window begins that agrees.
  std::int64_t compare(const BuiltLabels& example, const BuiltLabels& result, const Vec3i& window,
                       int dx, int dy, std::vector<std::uint8_t>& near) {
    const Vec3i n = result.size(), m = example.size();
    const int x0 = std::max(0, dx), y0 = std::max(0, dy);
    const int nx = std::min(n.x, m.x + dx) - x0, ny = std::min(n.y, m.y + dy) - y0;
    if (nx < window.x || ny < window.y) return 0;
    agree_.reset(nx, ny);
    built_.reset(nx, ny);
    for (int z = 0; z < n.z; ++z) {
      for (int j = 0; j < ny; ++j) {
        const Label* a = &result(x0, y0 + j, z);
        std::int32_t *agree = agree_.row(j), *built = built_.row(j);
        if (z >= m.z) {
          for (int i = 0; i < nx; ++i) built[i] += a[i] != kNotBuilt;
          continue;
        }
        const Label* b = &example(x0 - dx, y0 + j - dy, z);
        for (int i = 0; i < nx; ++i) {
          const bool here = a[i] != kNotBuilt, there = b[i] != kNotBuilt;
          agree[i] += here & (a[i] == b[i]);
          built[i] += here | there;
        }
      }
    }
    agree_.sumWindows(window.x, window.y);
    built_.sumWindows(window.x, window.y);
    bool any = false;
    const int wx = nx - window.x + 1, wy = ny - window.y + 1;
    alike_.assign(static_cast<std::size_t>(wx) * wy, 0);
    for (int j = 0; j < wy; ++j) {
      const std::int32_t *agree = agree_.row(j), *built = built_.row(j);
      for (int i = 0; i < wx; ++i) {
        if (built[i] == 0 || kOf * agree[i] < kAgree * built[i]) continue;
        any = true;
        alike_[static_cast<std::size_t>(j) * wx + i] = 1;
        std::atomic_ref(near[static_cast<std::size_t>(y0 + j) * n.x + x0 + i])
            .store(1, std::memory_order_relaxed);
      }
    }
    return any ? largestArea(wx, wy, window) : 0;
  }

 private:
  std::int64_t largestArea(int wx, int wy, const Vec3i& window) {
    DisjointSets sets(alike_.size());
    for (int j = 0; j < wy; ++j) {
      for (int i = 0; i < wx; ++i) {
        const auto at = static_cast<std::uint32_t>(j * wx + i);
        if (!alike_[at]) continue;
        if (i > 0 && alike_[at - 1]) sets.join(at, at - 1);
        if (j > 0 && alike_[at - wx]) sets.join(at, at - static_cast<std::uint32_t>(wx));
      }
    }
    // Each column belongs to the first set that covers it.
    const int nx = wx + window.x - 1, ny = wy + window.y - 1;
    std::vector<std::int64_t> columns(alike_.size(), 0);
    std::vector<std::uint32_t> of(static_cast<std::size_t>(nx) * ny, ~std::uint32_t{0});
    std::int64_t most = 0;
    for (int j = 0; j < wy; ++j) {
      for (int i = 0; i < wx; ++i) {
        const auto at = static_cast<std::uint32_t>(j * wx + i);
        if (!alike_[at]) continue;
        const std::uint32_t set = sets.find(at);
        for (int v = j; v < j + window.y; ++v) {
          for (int u = i; u < i + window.x; ++u) {
            std::uint32_t& owner = of[static_cast<std::size_t>(v) * nx + u];
            if (owner != ~std::uint32_t{0}) continue;
            owner = set;
            most = std::max(most, ++columns[set]);
          }
        }
      }
    }
    return most;
  }

  Table agree_, built_;
  std::vector<std::uint8_t> alike_;
};

}  // namespace

NearCopies findNearCopies(std::span<const BuiltLabels> examples, const BuiltLabels& result,
                          const Progress& progress) {
  const Vec3i n = result.size();
  Vec3i window{std::min(kWindow, n.x), std::min(kWindow, n.y), n.z};
  for (const BuiltLabels& example : examples)
    window = min(window, Vec3i{example.size().x, example.size().y, n.z});
  std::vector<std::uint8_t> near(static_cast<std::size_t>(n.x) * n.y, 0);
  NearCopies found;
  for (const BuiltLabels& example : examples) {
    const Vec3i m = example.size();
    const int first = window.x - m.x, count = n.x - window.x - first + 1;
    std::vector<std::int64_t> largest(static_cast<std::size_t>(count), 0);
    parallelFor(0, static_cast<std::size_t>(count), 4, [&](std::size_t begin, std::size_t end) {
      Offset offset;
      for (std::size_t i = begin; i < end; ++i) {
        progress.check();
        for (int dy = window.y - m.y; dy <= n.y - window.y; ++dy) {
          largest[i] = std::max(largest[i], offset.compare(example, result, window,
                                                           first + static_cast<int>(i), dy, near));
        }
      }
    });
    const double most = static_cast<double>(*std::ranges::max_element(largest));
    found.largest = std::max(found.largest, most / (static_cast<double>(m.x) * m.y));
  }
  Table built;
  built.reset(n.x, n.y);
  for (int z = 0; z < n.z; ++z) {
    for (int y = 0; y < n.y; ++y) {
      const Label* labels = &result(0, y, z);
      for (int x = 0; x < n.x; ++x) built.row(y)[x] += labels[x] != kNotBuilt;
    }
  }
  built.sumWindows(window.x, window.y);
  std::int64_t windows = 0, alike = 0;
  for (int y = 0; y + window.y <= n.y; ++y) {
    for (int x = 0; x + window.x <= n.x; ++x) {
      if (built.row(y)[x] == 0) continue;
      ++windows;
      alike += near[static_cast<std::size_t>(y) * n.x + x];
    }
  }
  if (windows > 0) found.windows = static_cast<double>(alike) / static_cast<double>(windows);
  return found;
}

}  // namespace exemplar
