// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/feature_tree.h"

#include <tbb/parallel_invoke.h>

#include <numeric>
#include <utility>

#include "core/parallel.h"

namespace exemplar {

namespace {

constexpr int kMeans = FeatureTree::kMeans;
constexpr int kWide = FeatureTree::kWide;

// Sorts entries, by the middles of their means' ranges, so that aligned groups of 16^k leaves are
// compact.
class Splitter {
 public:
  Splitter(const std::vector<std::int16_t>& centers, std::vector<std::uint32_t>& order)
      : centers_(centers), order_(order), keys_(order.size()) {}

  void split(std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin;
    if (count <= kWide) return;
    // Cut at the largest power of two of full leaves that leaves something on the right.
    const std::size_t leaves = (count + kWide - 1) / kWide;
    const std::size_t left = std::bit_ceil(leaves) / 2 * kWide;
    const int axis = widest(begin, end);
    for (std::size_t i = begin; i < end; ++i)
      keys_[i] = {centers_[std::size_t{order_[i]} * kMeans + static_cast<std::size_t>(axis)],
                  order_[i]};
    const auto at = [this](std::size_t i) {
      return keys_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(begin), at(begin + left), at(end));
    for (std::size_t i = begin; i < end; ++i) order_[i] = keys_[i].second;
    if (count > 8192) {
      tbb::parallel_invoke([&] { split(begin, begin + left); }, [&] { split(begin + left, end); });
    } else {
      split(begin, begin + left);
      split(begin + left, end);
    }
  }

 private:
  // The dimension of largest variance, over at most 256 entries.
  int widest(std::size_t begin, std::size_t end) const {
    const std::size_t step = std::max<std::size_t>(1, (end - begin) / 256);
    std::int64_t sums[kMeans] = {}, squares[kMeans] = {}, count = 0;
    for (std::size_t i = begin; i < end; i += step, ++count) {
      const std::int16_t* center = centers_.data() + std::size_t{order_[i]} * kMeans;
      for (int d = 0; d < kMeans; ++d) {
        sums[d] += center[d];
        squares[d] += std::int64_t{center[d]} * center[d];
      }
    }
    int best = 0;
    std::int64_t largest = -1;
    for (int d = 0; d < kMeans; ++d)
      if (const std::int64_t v = count * squares[d] - sums[d] * sums[d]; v > largest) {
        largest = v;
        best = d;
      }
    return best;
  }

  const std::vector<std::int16_t>& centers_;
  std::vector<std::uint32_t>& order_;
  std::vector<std::pair<std::int16_t, std::uint32_t>> keys_;
};

// The box, in the space of means, around all blocks below a child of a node.
struct Box {
  int low[kMeans], high[kMeans];
  std::uint32_t lowest = FeatureTree::kNone;
  Box() {
    std::fill_n(low, kMeans, 32767);
    std::fill_n(high, kMeans, 0);
  }
};

// The shift at which a range of numbers fits into eight bits, rounding up included.
int shiftFor(int range) {
  int shift = 0;
  while ((range >> shift) + 1 > 255) ++shift;
  return shift;
}

HugeVector<FeatureTree::Node> nodesOver(const std::vector<Box>& boxes) {
  HugeVector<FeatureTree::Node> nodes((boxes.size() + kWide - 1) / kWide);
  parallelFor(0, nodes.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      FeatureTree::Node& node = nodes[n];
      const std::size_t first = n * kWide;
      const std::size_t count = std::min<std::size_t>(kWide, boxes.size() - first);
      int base[kMeans], range = 0;
      for (int d = 0; d < kMeans; ++d) {
        int top = 0;
        base[d] = 32767;
        for (std::size_t c = 0; c < count; ++c) {
          base[d] = std::min(base[d], boxes[first + c].low[d]);
          top = std::max(top, boxes[first + c].high[d]);
        }
        range = std::max(range, top - base[d]);
      }
      const int shift = shiftFor(range);
      node.boxes.shift = static_cast<std::uint8_t>(shift);
      for (int d = 0; d < kMeans; ++d) {
        node.boxes.base[d] = static_cast<std::int16_t>(base[d]);
        for (std::size_t c = 0; c < kWide; ++c) {
          const Box& box = boxes[first + std::min(c, count - 1)];
          node.boxes.low[d / 2][c][d % 2] =
              static_cast<std::uint8_t>((box.low[d] - base[d]) >> shift);
          node.boxes.high[d / 2][c][d % 2] =
              static_cast<std::uint8_t>((box.high[d] - base[d] + (1 << shift) - 1) >> shift);
          node.lowest[c] = box.lowest;
        }
      }
    }
  });
  return nodes;
}

std::vector<Box> boxesOver(const std::vector<Box>& below) {
  std::vector<Box> boxes((below.size() + kWide - 1) / kWide);
  for (std::size_t c = 0; c < below.size(); ++c) {
    Box& box = boxes[c / kWide];
    for (int d = 0; d < kMeans; ++d) {
      box.low[d] = std::min(box.low[d], below[c].low[d]);
      box.high[d] = std::max(box.high[d], below[c].high[d]);
    }
    box.lowest = std::min(box.lowest, below[c].lowest);
  }
  return boxes;
}

// Stores the ranges of up to sixteen entries, one after another in `low` and `high`, in dimension
// `d` of a leaf; `shift` is the leaf's.
template <int dimensions>
void pack(const int* low, const int* high, std::size_t count, int margin, int d,
          kernels::Points<dimensions>& points) {
  const int shift = points.shift, half = (1 << shift) / 2;
  int base = 32767, width = 0;
  for (std::size_t c = 0; c < count; ++c) base = std::min(base, (low[c] + high[c]) / 2);
  for (std::size_t c = 0; c < kWide; ++c) {
    const std::size_t from = std::min(c, count - 1);
    const int value = ((low[from] + high[from]) / 2 - base + half) >> shift;
    const int stored = base + (value << shift);
    points.value[d / 2][c][d % 2] = static_cast<std::uint8_t>(value);
    width = std::max({width, stored - low[from], high[from] - stored});
  }
  points.base[d] = static_cast<std::int16_t>(base);
  points.width[d] = static_cast<std::int16_t>(std::min(32767, width + margin));
}

}  // namespace

FeatureTree::FeatureTree(const std::vector<std::uint32_t>& entries, const Ranges& ranges,
                         int margin)
    : entryCount_(entries.size()) {
  std::vector<std::uint32_t> order(entries.size());
  std::iota(order.begin(), order.end(), 0u);
  {
    std::vector<std::int16_t> centers(entries.size() * kMeans);
    parallelFor(0, entries.size(), 1024, [&](std::size_t begin, std::size_t end) {
      std::int16_t low[kFeatures], high[kFeatures];
      for (std::size_t e = begin; e < end; ++e) {
        ranges(entries[e], low, high);
        for (int d = 0; d < kMeans; ++d)
          centers[e * kMeans + static_cast<std::size_t>(d)] =
              static_cast<std::int16_t>((low[d] + high[d]) / 2);
      }
    });
    Splitter(centers, order).split(0, order.size());
  }

  leaves_.resize((entries.size() + kWide - 1) / kWide);
  details_.resize(leaves_.size());
  std::vector<Box> boxes(leaves_.size());
  parallelFor(0, leaves_.size(), 64, [&](std::size_t begin, std::size_t end) {
    std::int16_t l[kFeatures], h[kFeatures];
    int low[kFeatures][kWide], high[kFeatures][kWide];
    for (std::size_t n = begin; n < end; ++n) {
      Leaf& leaf = leaves_[n];
      const std::size_t first = n * kWide;
      const std::size_t count = std::min<std::size_t>(kWide, order.size() - first);
      for (std::size_t c = 0; c < kWide; ++c)
        leaf.entry[c] = c < count ? entries[order[first + c]] : kNone;
      std::sort(leaf.entry, leaf.entry + count);
      for (std::size_t c = 0; c < count; ++c) {
        ranges(leaf.entry[c], l, h);
        for (int d = 0; d < kFeatures; ++d) {
          low[d][c] = l[d];
          high[d][c] = h[d];
        }
      }
      // One step for all means, and one for all details.
      int spread[2] = {};
      for (int d = 0; d < kFeatures; ++d) {
        int least = 32767, most = 0;
        for (std::size_t c = 0; c < count; ++c) {
          least = std::min(least, (low[d][c] + high[d][c]) / 2);
          most = std::max(most, (low[d][c] + high[d][c]) / 2);
        }
        int& s = spread[d < kMeans ? 0 : 1];
        s = std::max(s, most - least);
      }
      leaf.means.shift = static_cast<std::uint8_t>(shiftFor(spread[0]));
      details_[n].shift = static_cast<std::uint8_t>(shiftFor(spread[1]));
      for (int d = 0; d < kMeans; ++d) {
        pack(low[d], high[d], count, margin, d, leaf.means);
        boxes[n].low[d] = std::max(0, *std::min_element(low[d], low[d] + count) - margin);
        boxes[n].high[d] = std::min(32767, *std::max_element(high[d], high[d] + count) + margin);
      }
      for (int d = kMeans; d < kFeatures; ++d)
        pack(low[d], high[d], count, margin, d - kMeans, details_[n]);
      boxes[n].lowest = leaf.entry[0];
    }
  });
  do {
    levels_.push_back(nodesOver(boxes));
    boxes = boxesOver(boxes);
  } while (boxes.size() > 1);
}

std::size_t FeatureTree::bytes() const {
  std::size_t bytes = leaves_.size() * (sizeof(Leaf) + sizeof(kernels::DetailPoints));
  for (const auto& level : levels_) bytes += level.size() * sizeof(Node);
  return bytes;
}

}  // namespace exemplar
