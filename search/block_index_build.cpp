// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
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

// Blocks of cells from this many samples on are worth another level of features before they are
// summed.
constexpr std::int64_t kSmallestFineCell = 1000;
using kernels::kFeatures;
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

// Features at the eight positions of a brick, x first; beyond the last position that one's again.
using BrickCorners = std::array<const Numbers*, 8>;

Vec3i bricksOf(const Vec3i& positions) {
  return {(positions.x + 1) / 2, (positions.y + 1) / 2, (positions.z + 1) / 2};
}

template <class Visit>
void forBricks(const Array3D<Numbers>& of, const Visit& visit) {
  const Vec3i last = of.size() - Vec3i{1, 1, 1}, count = bricksOf(of.size());
  parallelFor(0, static_cast<std::size_t>(count.z), 1, [&](std::size_t begin, std::size_t end) {
    for (int k = static_cast<int>(begin); k < static_cast<int>(end); ++k)
      for (int j = 0; j < count.y; ++j)
        for (int i = 0; i < count.x; ++i) {
          BrickCorners corners;
          for (int p = 0; p < 8; ++p)
            corners[p] =
                &of[min(Vec3i{2 * i + (p & 1), 2 * j + (p >> 1 & 1), 2 * k + (p >> 2)}, last)];
          visit(Vec3i{i, j, k}, corners);
        }
  });
}

// The middle of a feature's range, as a brick's center.
int centerOf(const BrickCorners& corners, int f) {
  int low = 32767, high = 0;
  for (const Numbers* n : corners) {
    low = std::min<int>(low, (*n)[f]);
    high = std::max<int>(high, (*n)[f]);
  }
  constexpr int kStep = 1 << kernels::kCenterShift;
  return std::min(255, ((low + high) / 2 + kStep / 2) / kStep);
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
typename BlockIndexData<Sample>::CellArrays BlockIndexData<Sample>::cellNumbers(
    const Progress& progress) const {
  CellArrays arrays(sources.size());
  for (std::size_t s = 0; s < sources.size(); ++s)
    for (int c = 0; c < 8; ++c)
      if (layout->there(c) && cellArray(c) == c) {
        progress.check();
        arrays[s][c] = features->ofSource(sources[s].samples, layout->size[c]);
      }
  return arrays;
}

template <class Sample>
void BlockIndexData<Sample>::ranges(const CellArrays& cells, std::uint32_t entry, std::int16_t* low,
                                    std::int16_t* high) const {
  const int s = sourceOf(entry);
  const IndexedSource<Sample>& source = sources[s];
  const Vec3i first = source.samples.ijk(entry - source.offset);
  std::fill_n(low, FeatureTree::kFeatures, std::int16_t{32767});
  std::fill_n(high, FeatureTree::kFeatures, std::int16_t{0});
  // The index of each cell's features among a block's.
  const auto place = [](int cell, int f) {
    return f == 0 ? cell : FeatureTree::kMeans + kernels::detail(cell, f - 1);
  };
  const Vec3i last = min(first + Vec3i{side, side, side}, source.positions);
  for (int k = first.z; k < last.z; ++k)
    for (int j = first.y; j < last.y; ++j)
      for (int i = first.x; i < last.x; ++i) {
        if (!live[source.offset + source.samples.index(i, j, k)]) continue;
        for (int c = 0; c < 8; ++c) {
          if (!layout->there(c)) continue;
          const Numbers& numbers = cells[s][cellArray(c)][Vec3i{i, j, k} + layout->first[c]];
          for (int f = 0; f < kFeatures; ++f) {
            std::int16_t& l = low[place(c, f)];
            std::int16_t& h = high[place(c, f)];
            l = std::min(l, numbers[f]);
            h = std::max(h, numbers[f]);
          }
        }
      }
  for (int c = 0; c < 8; ++c)
    if (!layout->there(c))
      for (int f = 0; f < kFeatures; ++f) low[place(c, f)] = high[place(c, f)] = 0;
}

template <class Sample>
void BlockIndexData<Sample>::packBricks(const std::vector<Array3D<Numbers>>& numbers) {
  // The largest difference from a brick's center decides the step of all.
  std::atomic<int> widest = 0;
  for (const Array3D<Numbers>& of : numbers)
    forBricks(of, [&](const Vec3i&, const BrickCorners& corners) {
      int here = 0;
      for (int f = 0; f < kFeatures; ++f) {
        const int center = centerOf(corners, f) << kernels::kCenterShift;
        for (const Numbers* n : corners) here = std::max(here, std::abs((*n)[f] - center));
      }
      int seen = widest.load(std::memory_order_relaxed);
      while (here > seen && !widest.compare_exchange_weak(seen, here)) {
      }
    });
  brickShift = 0;
  while ((widest >> brickShift) + 2 > 127) ++brickShift;
  const int half = (1 << brickShift) / 2;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    sources[s].bricks = Array3D<kernels::Brick>(bricksOf(numbers[s].size()));
    forBricks(numbers[s], [&](const Vec3i& at, const BrickCorners& corners) {
      kernels::Brick& brick = sources[s].bricks[at];
      for (int f = 0; f < kFeatures; ++f) {
        const int center = centerOf(corners, f);
        brick.center[f] = static_cast<std::uint8_t>(center);
        for (int p = 0; p < 8; ++p) {
          const int difference = (*corners[p])[f] - (center << kernels::kCenterShift);
          brick.difference[p][f] =
              static_cast<std::uint8_t>(((difference + half) >> brickShift) + 128);
        }
      }
    });
  }
}

template <class Sample>
void BlockIndexData<Sample>::packFineBricks(const std::vector<Array3D<Numbers>>& numbers) {
  int low[kFeatures], high[kFeatures];
  std::fill_n(low, kFeatures, 32767);
  std::fill_n(high, kFeatures, 0);
  for (const Array3D<Numbers>& of : numbers)
    for (const Numbers& n : of.values())
      for (int f = 0; f < kFeatures; ++f) {
        low[f] = std::min<int>(low[f], n[f]);
        high[f] = std::max<int>(high[f], n[f]);
      }
  for (int f = 0; f < kFeatures; ++f) {
    const int step = std::max(1, (high[f] - low[f] + 254) / 255);
    fineScale.base[f] = static_cast<std::int16_t>(low[f]);
    fineScale.step[f] = static_cast<std::int16_t>(step);
    fineScale.width[f] = static_cast<std::int16_t>(step / 2 + fineFeatures->margin());
  }
  for (std::size_t s = 0; s < sources.size(); ++s) {
    sources[s].fineBricks = Array3D<kernels::ByteBrick>(bricksOf(numbers[s].size()));
    forBricks(numbers[s], [&](const Vec3i& at, const BrickCorners& corners) {
      for (int p = 0; p < 8; ++p)
        for (int f = 0; f < kFeatures; ++f) {
          const int step = fineScale.step[f];
          const int value = ((*corners[p])[f] - low[f] + step / 2) / step;
          sources[s].fineBricks[at].value[p][f] = static_cast<std::uint8_t>(value);
        }
    });
  }
}

template <class Sample>
void BlockIndexData<Sample>::build(const BlockIndexOptions& options, const Progress& progress) {
  progress.report("indexing blocks", 0);
  findPositions(options);
  if (options.boxSide < 0 || options.boxSide > 2)
    throw InputError("the box side of a block index must be 1, 2, or 0 for automatic");
  side = options.boxSide != 0 ? options.boxSide : positionCount <= 1 << 21 ? 1 : 2;
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
  progress.report("indexing blocks", 0.1);
  CellArrays cells = cellNumbers(progress);
  progress.report("indexing blocks", 0.3);

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
  tree = FeatureTree(
      entries,
      [&](std::uint32_t entry, std::int16_t* l, std::int16_t* h) {
        progress.check();
        ranges(cells, entry, l, h);
      },
      features->margin());
  progress.report("indexing blocks", 0.8);

  if (side == 2) {
    for (int c = 0; c < 8; ++c)
      for (int axis = 0; axis < 3; ++axis) aligned = aligned && layout->first[c][axis] % 2 == 0;
    std::vector<Array3D<Numbers>> numbers;
    for (auto& ofSource : cells) numbers.push_back(std::move(ofSource[0]));
    packBricks(numbers);

    const Vec3i cell = layout->size[0];
    fineLayout.emplace(cell, true);
    bool fine = aligned && volume(cell) >= kSmallestFineCell;
    for (int c = 0; c < 8; ++c)
      for (int axis = 0; axis < 3; ++axis)
        fine = fine && fineLayout->there(c) && fineLayout->first[c][axis] % 2 == 0;
    if (fine) {
      fineFeatures.emplace(*fineLayout, std::span<const Array3D<Sample>* const>(arrays), low, high);
      numbers.clear();
      for (const IndexedSource<Sample>& source : sources)
        numbers.push_back(fineFeatures->ofSource(source.samples, fineLayout->size[0]));
      packFineBricks(numbers);
    }
  }
}

template struct BlockIndexData<std::uint8_t>;
template struct BlockIndexData<float>;

}  // namespace exemplar
