// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "core/simd.h"
#include "search/block_index_data.h"

namespace exemplar {

namespace {

constexpr int kDims = 8 * kernels::kFeatures;
using kernels::kFeatures;
using kernels::kWide;
using Numbers = CellFeatures::Numbers;

EXEMPLAR_MULTIVERSION void orInto(const std::uint8_t* in, std::uint8_t* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] |= in[i];
}

// Whether two samples are the same for every query.
template <class Sample>
void markDifferent(const Sample* a, const Sample* b, std::uint8_t* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] = a[i] != b[i];
}

// out[i] |= out[i + stride] | ... over `length` samples, in place: runs of doubling length.
void slide(Array3D<std::uint8_t>& field, std::size_t stride, int length) {
  std::size_t have = 1;
  const std::size_t want = static_cast<std::size_t>(length);
  while (have < want) {
    const std::size_t step = std::min(have, want - have);
    // What reaches beyond the array belongs to no position.
    if (step * stride >= field.count()) return;
    orInto(field.data() + step * stride, field.data(), field.count() - step * stride);
    have += step;
  }
}

}  // namespace

template <class Sample>
void BlockIndexData<Sample>::findPositions(const BlockIndexOptions& options) {
  if (!options.allowed.empty() && options.allowed.size() != sources.size())
    throw InputError("a block index of " + std::to_string(sources.size()) + " sources was given " +
                     std::to_string(options.allowed.size()) + " masks of allowed positions");
  std::uint64_t total = 0;
  for (IndexedSource<Sample>& source : sources) {
    source.positions = blockPositions(source.samples.size(), block);
    source.offset = static_cast<std::uint32_t>(total);
    total += source.samples.count();
    if (total > std::numeric_limits<std::int32_t>::max())
      throw InputError("the sources of a block index have more than 2^31 samples together");
  }
  live = Bits(total);
  for (const auto* mask : options.allowed) allAllowed = allAllowed && mask == nullptr;
  if (!allAllowed) allowedBits = Bits(total);
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const IndexedSource<Sample>& source = sources[s];
    const Array3D<std::uint8_t>* mask = options.allowed.empty() ? nullptr : options.allowed[s];
    if (mask && mask->size() != source.samples.size())
      throw InputError("a mask of allowed positions differs in size from its source");
    if (!mask) positionCount += volume(source.positions);
    if (allAllowed) continue;
    for (int k = 0; k < source.positions.z; ++k)
      for (int j = 0; j < source.positions.y; ++j)
        for (int i = 0; i < source.positions.x; ++i)
          if (!mask || (*mask)(i, j, k)) {
            allowedBits.set(source.offset + source.samples.index(i, j, k));
            if (mask) ++positionCount;
          }
  }
  if (positionCount == 0) throw InputError("a block index was given no position that is allowed");
}

template <class Sample>
void BlockIndexData<Sample>::measureSlopes() {
  for (const IndexedSource<Sample>& source : sources) {
    const Vec3i size = source.samples.size();
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i step{};
      step[axis] = 1;
      if (size[axis] < 2) continue;
      const std::size_t stride = source.samples.index(step);
      const Vec3i pairs = size - step;
      double largest = slopes[axis];
      for (int k = 0; k < pairs.z; ++k)
        for (int j = 0; j < pairs.y; ++j) {
          const Sample* row = source.samples.data() + source.samples.index(0, j, k);
          double inRow = 0;
          for (int i = 0; i < pairs.x; ++i)
            inRow = std::max(inRow, std::abs(static_cast<double>(row[i + stride]) - row[i]));
          largest = std::max(largest, inRow);
        }
      slopes[axis] = largest;
    }
  }
}

// A block that equals the one a step before it along an axis can be no answer where that one is
// allowed: its index is higher. Constant regions and extruded shapes hold millions of them. Whoever
// wants all equal blocks (k nearest) follows the steps from those that are kept.
template <class Sample>
void BlockIndexData<Sample>::dropRepeats(IndexedSource<Sample>& source) {
  const Vec3i size = source.samples.size();
  Array3D<std::uint8_t> different(size);
  std::vector<std::uint8_t> repeated(source.samples.count(), 0);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3i step{};
    step[axis] = 1;
    if (source.positions[axis] < 2) continue;
    const std::size_t stride = source.samples.index(step), count = source.samples.count();
    // Pairs that straddle two rows belong to no block's inside and are looked at by none.
    markDifferent(source.samples.data(), source.samples.data() + stride, different.data(),
                  count - stride);
    slide(different, 1, block.x);
    slide(different, static_cast<std::size_t>(size.x), block.y);
    slide(different, static_cast<std::size_t>(size.x) * size.y, block.z);
    const Vec3i last = source.positions - step;
    for (int k = 0; k < last.z; ++k)
      for (int j = 0; j < last.y; ++j)
        for (int i = 0; i < last.x; ++i) {
          const std::size_t at = source.samples.index(i, j, k);
          if (different.data()[at] == 0 && allowed(source.offset + static_cast<std::uint32_t>(at)))
            repeated[at + stride] = 1;
        }
  }
  for (int k = 0; k < source.positions.z; ++k)
    for (int j = 0; j < source.positions.y; ++j)
      for (int i = 0; i < source.positions.x; ++i) {
        const auto at = static_cast<std::uint32_t>(source.samples.index(i, j, k));
        if (!repeated[at] && allowed(source.offset + at)) live.set(source.offset + at);
      }
}

// Cells of the same size share their array.
template <class Sample>
int BlockIndexData<Sample>::cellArray(int cell) const {
  int c = 0;
  while (layout->size[c] != layout->size[cell]) ++c;
  return c;
}

template <class Sample>
typename BlockIndexData<Sample>::CellArrays BlockIndexData<Sample>::cellNumbers() const {
  CellArrays arrays(sources.size());
  for (std::size_t s = 0; s < sources.size(); ++s)
    for (int c = 0; c < 8; ++c)
      if (layout->there(c) && cellArray(c) == c)
        arrays[s][c] = features->ofSource(sources[s].samples, layout->size[c]);
  return arrays;
}

template <class Sample>
void BlockIndexData<Sample>::ranges(const CellArrays& cells, std::uint32_t entry, std::int16_t* low,
                                    std::int16_t* high) const {
  const int s = sourceOf(entry);
  const IndexedSource<Sample>& source = sources[s];
  const Vec3i first = source.samples.ijk(entry - source.offset);
  std::fill_n(low, kDims, std::int16_t{32767});
  std::fill_n(high, kDims, std::int16_t{0});
  const Vec3i last = min(first + Vec3i{side, side, side}, source.positions);
  for (int k = first.z; k < last.z; ++k)
    for (int j = first.y; j < last.y; ++j)
      for (int i = first.x; i < last.x; ++i) {
        if (!live[source.offset + source.samples.index(i, j, k)]) continue;
        for (int c = 0; c < 8; ++c) {
          if (!layout->there(c)) continue;
          const Numbers& numbers = cells[s][cellArray(c)][Vec3i{i, j, k} + layout->first[c]];
          for (int f = 0; f < kFeatures; ++f) {
            std::int16_t& l = low[c * kFeatures + f];
            std::int16_t& h = high[c * kFeatures + f];
            l = std::min(l, numbers[f]);
            h = std::max(h, numbers[f]);
          }
        }
      }
  for (int c = 0; c < 8; ++c)
    if (!layout->there(c))
      for (int f = 0; f < kFeatures; ++f) low[c * kFeatures + f] = high[c * kFeatures + f] = 0;
}

template <class Sample>
void BlockIndexData<Sample>::packBricks(IndexedSource<Sample>& source,
                                        const Array3D<Numbers>& numbers) {
  const Vec3i size = numbers.size();
  source.bricks = Array3D<kernels::Brick>({(size.x + 1) / 2, (size.y + 1) / 2, (size.z + 1) / 2});
  const Vec3i last = size - Vec3i{1, 1, 1};
  const int half = (1 << brickShift) / 2;
  parallelFor(0, source.bricks.count(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      kernels::Brick& brick = source.bricks.data()[b];
      const Vec3i first = source.bricks.ijk(b) * 2;
      for (int f = 0; f < kFeatures; ++f) {
        int number[8], low = 32767, high = 0;
        for (int p = 0; p < 8; ++p) {
          number[p] = numbers[min(first + Vec3i{p & 1, p >> 1 & 1, p >> 2}, last)][f];
          low = std::min(low, number[p]);
          high = std::max(high, number[p]);
        }
        const int center = (low + high) / 2;
        brick.center[f] = static_cast<std::int16_t>(center);
        for (int p = 0; p < 8; ++p)
          brick.difference[p][f] =
              static_cast<std::uint8_t>(((number[p] - center + half) >> brickShift) + 128);
      }
    }
  });
}

// Sorts the entries so that aligned groups of 16^k leaves are nodes, and fills leaves and nodes.
namespace {

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
      keys_[i] = {centers_[std::size_t{order_[i]} * kDims + static_cast<std::size_t>(axis)],
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
    std::int64_t sums[kDims] = {}, squares[kDims] = {}, count = 0;
    for (std::size_t i = begin; i < end; i += step, ++count) {
      const std::int16_t* center = centers_.data() + std::size_t{order_[i]} * kDims;
      for (int d = 0; d < kDims; ++d) {
        sums[d] += center[d];
        squares[d] += std::int64_t{center[d]} * center[d];
      }
    }
    int best = 0;
    std::int64_t largest = -1;
    for (int d = 0; d < kDims; d += kFeatures)
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
  int low[kernels::kMeans], high[kernels::kMeans];
  std::uint32_t lowest = kNoPosition;
  Box() {
    std::fill_n(low, kernels::kMeans, 32767);
    std::fill_n(high, kernels::kMeans, 0);
  }
};

// The shift at which a range of numbers fits into eight bits, rounding up included.
int shiftFor(int range) {
  int shift = 0;
  while ((range >> shift) + 1 > 255) ++shift;
  return shift;
}

std::vector<IndexNode> nodesOver(const std::vector<Box>& boxes) {
  std::vector<IndexNode> nodes((boxes.size() + kWide - 1) / kWide);
  parallelFor(0, nodes.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      IndexNode& node = nodes[n];
      const std::size_t first = n * kWide;
      const std::size_t count = std::min<std::size_t>(kWide, boxes.size() - first);
      int base[kernels::kMeans], range = 0;
      for (int d = 0; d < kernels::kMeans; ++d) {
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
      for (int d = 0; d < kernels::kMeans; ++d) {
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
    for (int d = 0; d < kernels::kMeans; ++d) {
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

template <class Sample>
void BlockIndexData<Sample>::build(const BlockIndexOptions& options) {
  findPositions(options);
  if (options.boxSide < 0 || options.boxSide > 2)
    throw InputError("the box side of a block index must be 1, 2, or 0 for automatic");
  side = options.boxSide != 0 ? options.boxSide : positionCount <= 1 << 20 ? 1 : 2;
  requireMemory(static_cast<double>(positionCount) * (side == 1 ? 160 : 45), "the block index",
                "use a smaller example or resolution");
  measureSlopes();
  for (IndexedSource<Sample>& source : sources) dropRepeats(source);

  double low = std::numeric_limits<double>::infinity(), high = -low;
  std::vector<const Array3D<Sample>*> arrays;
  for (const IndexedSource<Sample>& source : sources) {
    const auto [least, most] = std::ranges::minmax(source.samples.values());
    low = std::min(low, static_cast<double>(least));
    high = std::max(high, static_cast<double>(most));
    arrays.push_back(&source.samples);
  }
  layout.emplace(block, side > 1);
  features.emplace(*layout, std::span<const Array3D<Sample>* const>(arrays), low, high);
  CellArrays cells = cellNumbers();

  // One entry for each box that has a live position.
  std::vector<std::uint32_t> entries;
  for (const IndexedSource<Sample>& source : sources)
    for (int k = 0; k < source.positions.z; k += side)
      for (int j = 0; j < source.positions.y; j += side)
        for (int i = 0; i < source.positions.x; i += side) {
          const Vec3i last = min(Vec3i{i + side, j + side, k + side}, source.positions);
          bool any = false;
          for (int z = k; z < last.z; ++z)
            for (int y = j; y < last.y; ++y)
              for (int x = i; x < last.x; ++x)
                any = any || live[source.offset + source.samples.index(x, y, z)];
          if (any)
            entries.push_back(source.offset +
                              static_cast<std::uint32_t>(source.samples.index(i, j, k)));
        }
  std::vector<std::uint32_t> order(entries.size());
  std::iota(order.begin(), order.end(), 0u);
  {
    std::vector<std::int16_t> centers(entries.size() * kDims);
    parallelFor(0, entries.size(), 1024, [&](std::size_t begin, std::size_t end) {
      std::int16_t l[kDims], h[kDims];
      for (std::size_t e = begin; e < end; ++e) {
        ranges(cells, entries[e], l, h);
        for (int d = 0; d < kDims; ++d)
          centers[e * kDims + static_cast<std::size_t>(d)] =
              static_cast<std::int16_t>((l[d] + h[d]) / 2);
      }
    });
    Splitter(centers, order).split(0, order.size());
  }

  entryCount = entries.size();
  const std::size_t leafCount = (entries.size() + kWide - 1) / kWide;
  leaves.resize(leafCount);
  details.resize(leafCount);
  std::vector<Box> boxes(leafCount);
  const int margin = features->margin();
  parallelFor(0, leafCount, 64, [&](std::size_t begin, std::size_t end) {
    std::int16_t l[kWide][kDims], h[kWide][kDims];
    int low_[kDims][kWide], high_[kDims][kWide];
    for (std::size_t n = begin; n < end; ++n) {
      IndexLeaf& leaf = leaves[n];
      const std::size_t first = n * kWide;
      const std::size_t count = std::min<std::size_t>(kWide, order.size() - first);
      for (std::size_t c = 0; c < kWide; ++c)
        leaf.entry[c] = c < count ? entries[order[first + c]] : kNoPosition;
      std::sort(leaf.entry, leaf.entry + count);
      boxes[n].lowest = leaf.entry[0];
      for (std::size_t c = 0; c < count; ++c) ranges(cells, leaf.entry[c], l[c], h[c]);
      int meanRange = 0, detailRange = 0;
      for (int d = 0; d < kDims; ++d) {
        int least = 32767, most = 0;
        for (std::size_t c = 0; c < count; ++c) {
          low_[d][c] = l[c][d];
          high_[d][c] = h[c][d];
          least = std::min(least, (l[c][d] + h[c][d]) / 2);
          most = std::max(most, (l[c][d] + h[c][d]) / 2);
        }
        int& range = d % kFeatures == 0 ? meanRange : detailRange;
        range = std::max(range, most - least);
      }
      leaf.means.shift = static_cast<std::uint8_t>(shiftFor(meanRange));
      details[n].shift = static_cast<std::uint8_t>(shiftFor(detailRange));
      for (int c = 0; c < 8; ++c)
        for (int f = 0; f < kFeatures; ++f) {
          const int d = c * kFeatures + f;
          if (f == 0) {
            pack(low_[d], high_[d], count, margin, c, leaf.means);
            boxes[n].low[c] = std::max(0, *std::min_element(low_[d], low_[d] + count) - margin);
            boxes[n].high[c] =
                std::min(32767, *std::max_element(high_[d], high_[d] + count) + margin);
          } else {
            pack(low_[d], high_[d], count, margin, kernels::detail(c, f - 1), details[n]);
          }
        }
    }
  });
  std::vector<Box> below = std::move(boxes);
  do {
    levels.push_back(nodesOver(below));
    below = boxesOver(below);
  } while (below.size() > 1);

  if (side == 2) {
    for (int c = 0; c < 8; ++c)
      for (int axis = 0; axis < 3; ++axis) aligned = aligned && layout->first[c][axis] % 2 == 0;
    // The largest difference from a brick's middle decides the step of all.
    int largest = 1;
    for (const auto& ofSource : cells) {
      const Array3D<Numbers>& numbers = ofSource[0];
      const Vec3i size = numbers.size();
      for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
          for (int i = 0; i < size.x; ++i) {
            // Against the brick's first number, which is at least as far as the middle from one of
            // them.
            const Numbers& a = numbers(i & ~1, j & ~1, k & ~1);
            const Numbers& b = numbers(i, j, k);
            for (int f = 0; f < kFeatures; ++f) largest = std::max(largest, std::abs(a[f] - b[f]));
          }
    }
    while ((largest >> brickShift) + 2 > 127) ++brickShift;
    for (std::size_t s = 0; s < sources.size(); ++s) packBricks(sources[s], cells[s][0]);
  }
}

template struct BlockIndexData<std::uint8_t>;
template struct BlockIndexData<float>;

}  // namespace exemplar
