// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/block_index.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <memory>
#include <utility>

#include "core/error.h"
#include "search/block_index_data.h"

namespace exemplar {

namespace {

using kernels::kFeatures;
using kernels::kWide;

// The nearest block so far. `limit` is the largest sum that is still of interest.
template <class Sum>
struct BestBlock {
  static constexpr Sum kNoLimit = std::numeric_limits<Sum>::max();
  Sum limit = kNoLimit;
  std::uint32_t position = kNoPosition;

  // At distance 0 only a lower position can come before.
  bool hopeless(std::uint32_t lowest) const { return limit == 0 && lowest > position; }
  void offer(Sum sum, std::uint32_t at) {
    if (sum < limit || (sum == limit && at < position)) {
      limit = sum;
      position = at;
    }
  }
};

// Work in units of about a nanosecond; when the search has cost an eighth of a linear scan, the
// scan takes over.
struct Work {
  static constexpr std::int64_t kNode = 80, kLeaf = 80, kBox = 200, kFine = 800;
  static std::int64_t block(std::int64_t known) { return 150 + known / 15; }
  static std::int64_t scanned(std::int64_t known) { return 10 + known / 40; }
};

}  // namespace

template <class Sample>
class BlockIndexSearch {
 public:
  using Data = BlockIndexData<Sample>;
  using Sum = SquaredSum<Sample>;
  using Found = BestBlock<Sum>;

  BlockIndexSearch(const Data& index, const BlockQuery<Sample>& query)
      : index_(index), kernels_(kernels::kernels()) {
    if (query.samples.size() != index.block)
      throw InputError("a block index was asked for a block of another size than its own");
    for (const IndexedSource<Sample>& source : index.sources) {
      // Offsets of rows differ with the size of the source.
      const bool sameAsBefore =
          !sums_.empty() && source.samples.size() == index.sources[sums_.size() - 1].samples.size();
      if (!sameAsBefore) sumStore_.emplace_back(query, source.samples.size());
      sums_.push_back(sumStore_.size() - 1);
    }
    features_ = index.features->ofQuery(query, index.slopes);
    for (int c = 0; c < 8; ++c) {
      const bool says = features_.meanLow[c] > 0 || features_.meanHigh[c] < 32767;
      if (says) cells_[cellCount_++] = static_cast<std::uint8_t>(c);
    }
    if (index.fineFeatures) describeFine(query);
    known_ = sumStore_[0].known();
    budget_ = index.positionCount * Work::scanned(known_) / 8;
  }

  // The features of the eighths of each cell that says anything.
  void describeFine(const BlockQuery<Sample>& query) {
    const CellLayout& layout = *index_.layout;
    fine_.resize(static_cast<std::size_t>(cellCount_));
    BlockQuery<Sample> cell{Array3D<Sample>(layout.size[0]), {}};
    if (!query.known.empty()) cell.known = Array3D<std::uint8_t>(layout.size[0]);
    for (int n = 0; n < cellCount_; ++n) {
      const Vec3i first = layout.first[cells_[n]], size = layout.size[0];
      for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j) {
          const std::size_t from = query.samples.index(first.x, first.y + j, first.z + k);
          const std::size_t to = cell.samples.index(0, j, k);
          std::copy_n(query.samples.data() + from, size.x, cell.samples.data() + to);
          if (!query.known.empty())
            std::copy_n(query.known.data() + from, size.x, cell.known.data() + to);
        }
      Fine& fine = fine_[static_cast<std::size_t>(n)];
      fine.features = index_.fineFeatures->ofQuery(cell, index_.slopes);
      fine.count = 0;
      for (int c = 0; c < 8; ++c)
        if (fine.features.meanLow[c] > 0 || fine.features.meanHigh[c] < 32767) {
          fine.at[fine.count] = first + index_.fineLayout->first[c];
          fine.cells[fine.count++] = static_cast<std::uint8_t>(c);
        }
    }
  }

  const BlockSum<Sample>& sums(int source) const { return sumStore_[sums_[source]]; }

  void offer(std::uint32_t position, Found& found) {
    const int s = index_.sourceOf(position);
    const IndexedSource<Sample>& source = index_.sources[s];
    const Sum sum = sums(s).sum(source.samples.data() + (position - source.offset), found.limit);
    ++statistics_.blocks;
    budget_ -= Work::block(known_);
    if (sum <= found.limit) {
      found.offer(sum, position);
      updateBound(found.limit);
    }
  }

  void run(Found& found) {
    updateBound(found.limit);
    if (bound_ == kernels::kLargestBound) {
      addBox(likelyEntry(index_.tree, features_), 0);
      workOnBoxes(found);
    }
    Visitor visitor{*this, found};
    FeatureTreeSearch(index_.tree, features_, visitor).run();
    if (budget_ < 0) scan(found);
  }

  BlockIndexStatistics statistics_;

 private:
  // What the tree's search asks and finds.
  struct Visitor {
    BlockIndexSearch& search;
    Found& found;

    std::uint32_t bound() const { return search.bound_; }
    bool hopeless(std::uint32_t lowest) const { return found.hopeless(lowest); }
    bool may(int, std::size_t, std::uint32_t) const { return true; }
    bool node() {
      ++search.statistics_.nodes;
      return (search.budget_ -= Work::kNode) >= 0;
    }
    void leaves(int count) {
      search.statistics_.leaves += count;
      search.budget_ -= count * Work::kLeaf;
    }
    void add(std::uint32_t entry, std::uint32_t gap) { search.addBox(entry, gap); }
    void flush() { search.workOnBoxes(found); }
  };

  // Sums of squared gaps above these belong to blocks beyond the limit.
  void updateBound(Sum limit) {
    const auto bound = [&](const CellFeatures& features) {
      return static_cast<double>(limit) * features.scale() * features.scale() * (1 + 1e-9);
    };
    bound_ = static_cast<std::uint32_t>(
        std::min<double>(bound(*index_.features), kernels::kLargestBound));
    if (index_.fineFeatures)
      fineBound_ =
          static_cast<std::uint64_t>(std::min(bound(*index_.fineFeatures), kLargestFineBound));
  }

  void workOnBoxes(Found& found) {
    // The nearest first, of equals the lowest: each may lower the limit for those behind it.
    std::pair<std::uint64_t, int> nearest[kWide * kWide];
    const int count = std::exchange(boxCount_, 0);
    for (int b = 0; b < count; ++b)
      nearest[b] = {std::uint64_t{boxes_[b].gap} << 32 | boxes_[b].entry, b};
    std::sort(nearest, nearest + count);
    for (int n = 0; n < count && nearest[n].first >> 32 <= bound_; ++n) {
      const Box& box = boxes_[nearest[n].second];
      if (found.hopeless(box.entry)) continue;
      if (index_.side == 1)
        offer(box.entry, found);
      else
        searchBox(box, found);
    }
  }

  struct Box {
    std::uint32_t gap, entry;
    int source;
    int x, y, z;  // the first position
    const kernels::Brick* bricks[8];
  };

  void addBox(std::uint32_t entry, std::uint32_t gap) {
    Box& box = boxes_[boxCount_++];
    box.gap = gap;
    box.entry = entry;
    if (index_.side == 1) return;
    box.source = index_.sourceOf(entry);
    const IndexedSource<Sample>& source = index_.sources[box.source];
    const Vec3i first = source.samples.ijk(entry - source.offset);
    box.x = first.x, box.y = first.y, box.z = first.z;
    for (int n = 0; n < cellCount_; ++n) {
      const Vec3i at = first + index_.layout->first[cells_[n]];
      box.bricks[n] = &source.bricks(at.x / 2, at.y / 2, at.z / 2);
      prefetch(*box.bricks[n]);
    }
  }

  void searchBox(const Box& box, Found& found) {
    ++statistics_.boxes;
    budget_ -= Work::kBox;
    const IndexedSource<Sample>& source = index_.sources[box.source];
    const Vec3i first{box.x, box.y, box.z};
    const auto width =
        static_cast<std::int16_t>((1 << index_.brickShift) / 2 + index_.features->margin());
    std::uint32_t gaps[8];
    if (index_.aligned) {
      kernels_.brickGaps(box.bricks, index_.brickShift, width, features_, cells_, cellCount_, gaps);
    } else {
      kernels::BrickNumbers numbers[8];
      const Vec3i last = source.bricks.size() - Vec3i{1, 1, 1};
      for (int n = 0; n < cellCount_; ++n)
        for (int p = 0; p < 8; ++p) {
          const Vec3i at =
              first + index_.layout->first[cells_[n]] + Vec3i{p & 1, p >> 1 & 1, p >> 2};
          const kernels::Brick& brick =
              source.bricks[min(Vec3i{at.x / 2, at.y / 2, at.z / 2}, last)];
          const int in = (at.x & 1) | (at.y & 1) << 1 | (at.z & 1) << 2;
          for (int f = 0; f < kFeatures; ++f)
            numbers[n].number[p][f] =
                static_cast<std::int16_t>((brick.center[f] << kernels::kCenterShift) +
                                          ((brick.difference[in][f] - 128) << index_.brickShift));
        }
      kernels_.numberGaps(numbers, width, features_, cells_, cellCount_, gaps);
    }
    std::uint32_t within = 0;
    for (int p = 0; p < 8; ++p) within |= static_cast<std::uint32_t>(gaps[p] <= bound_) << p;
    if (within != 0 && index_.fineFeatures) within = searchFine(source, first, within, gaps);
    int order[8], count = 0;
    for (; within != 0; within &= within - 1)
      insertByGap(gaps, order, count, std::countr_zero(within));
    for (int o = 0; o < count; ++o) {
      const int p = order[o];
      if (!index_.fineFeatures && gaps[p] > bound_) return;
      const Vec3i position = first + Vec3i{p & 1, p >> 1 & 1, p >> 2};
      if (min(position, source.positions - Vec3i{1, 1, 1}) != position) continue;
      const auto at = source.offset + static_cast<std::uint32_t>(source.samples.index(position));
      if (index_.live[at]) offer(at, found);
    }
  }

  // Which of the positions `within` a box are left by the features of the cells' eighths; their
  // gaps, in units that only serve to sort, take the place of the coarse ones.
  std::uint32_t searchFine(const IndexedSource<Sample>& source, const Vec3i& first,
                           std::uint32_t within, std::uint32_t* gaps) {
    budget_ -= Work::kFine;
    const auto bricks = [&](const Fine& fine, const kernels::ByteBrick** to) {
      for (int c = 0; c < fine.count; ++c) {
        const Vec3i at = first + fine.at[c];
        to[c] = &source.fineBricks(at.x / 2, at.y / 2, at.z / 2);
        prefetch(*to[c]);
      }
    };
    const kernels::ByteBrick* now[8];
    const kernels::ByteBrick* next[8];
    std::uint64_t sums[8] = {};
    if (!fine_.empty()) bricks(fine_[0], next);
    for (std::size_t n = 0; n < fine_.size() && within != 0; ++n) {
      std::copy_n(next, 8, now);
      if (n + 1 < fine_.size()) bricks(fine_[n + 1], next);
      std::uint32_t parts[8];
      kernels_.byteGaps(now, index_.fineScale, fine_[n].features, fine_[n].cells, fine_[n].count,
                        parts);
      for (int p = 0; p < 8; ++p) {
        sums[p] += parts[p];
        if (sums[p] > fineBound_) within &= ~(std::uint32_t{1} << p);
      }
    }
    for (int p = 0; p < 8; ++p)
      gaps[p] = static_cast<std::uint32_t>(std::min<std::uint64_t>(sums[p] >> 4, 0xffffffff));
    return within;
  }

  void scan(Found& found) {
    statistics_.scanned = true;
    // From the start, for ties go to the lowest index; what was found before is a limit and found
    // again.
    for (std::size_t s = 0; s < index_.sources.size(); ++s) {
      const IndexedSource<Sample>& source = index_.sources[s];
      for (int k = 0; k < source.positions.z; ++k)
        for (int j = 0; j < source.positions.y; ++j) {
          const std::size_t row = source.samples.index(0, j, k);
          const std::size_t end = static_cast<std::size_t>(source.positions.x);
          for (std::size_t i = 0; i < end; ++i) {
            Sum sum;
            i += sums(static_cast<int>(s))
                     .firstWithin(source.samples.data() + row + i, end - i, found.limit, sum);
            if (i >= end) break;
            const auto position = static_cast<std::uint32_t>(source.offset + row + i);
            if (index_.live[position]) found.offer(sum, position);
          }
        }
    }
  }

  const Data& index_;
  const kernels::Kernels& kernels_;
  kernels::QueryFeatures features_;
  Box boxes_[kWide * kWide];
  int boxCount_ = 0;
  std::uint8_t cells_[8] = {};
  int cellCount_ = 0;
  std::vector<BlockSum<Sample>> sumStore_;
  std::vector<std::size_t> sums_;
  std::int64_t known_ = 0, budget_ = 0;
  std::uint32_t bound_ = 0;
  // No sum over the eighths of all cells is larger.
  static constexpr double kLargestFineBound = 8.0 * kernels::kLargestBound;
  std::uint64_t fineBound_ = 0;

  struct Fine {
    kernels::QueryFeatures features;
    Vec3i at[8];  // of each of its cells that says anything, from the block's first sample
    std::uint8_t cells[8];
    int count;
  };
  std::vector<Fine> fine_;  // of each of cells_
};

namespace {

template <class Sample>
BlockMatch matchAt(const BlockIndexData<Sample>& index, const BlockSum<Sample>& sums,
                   SquaredSum<Sample> sum, std::uint32_t position) {
  const int s = index.sourceOf(position);
  const IndexedSource<Sample>& source = index.sources[s];
  return {source.samples.ijk(position - source.offset), sums.distance(sum), s};
}

}  // namespace

template <class Sample>
BlockIndex<Sample>::BlockIndex(std::vector<Array3D<Sample>> sources, const Vec3i& block,
                               const BlockIndexOptions& options, const Progress& progress) {
  if (sources.empty()) throw InputError("a block index needs at least one source");
  auto data = std::make_unique<BlockIndexData<Sample>>();
  data->block = block;
  for (Array3D<Sample>& source : sources) {
    data->sources.emplace_back();
    data->sources.back().samples = std::move(source);
  }
  data->build(options, progress);
  data_ = std::move(data);
}

template <class Sample>
BlockIndex<Sample>::BlockIndex(Array3D<Sample> source, const Vec3i& block,
                               const BlockIndexOptions& options, const Progress& progress)
    : BlockIndex(
          [&] {
            std::vector<Array3D<Sample>> sources;
            sources.push_back(std::move(source));
            return sources;
          }(),
          block, options, progress) {}

template <class Sample>
BlockIndex<Sample>::BlockIndex(BlockIndex&&) noexcept = default;
template <class Sample>
BlockIndex<Sample>& BlockIndex<Sample>::operator=(BlockIndex&&) noexcept = default;
template <class Sample>
BlockIndex<Sample>::~BlockIndex() = default;

template <class Sample>
BlockMatch BlockIndex<Sample>::findBest(const BlockQuery<Sample>& query,
                                        std::span<const BlockMatch> hints,
                                        BlockIndexStatistics* statistics) const {
  BlockIndexSearch<Sample> search(*data_, query);
  BestBlock<SquaredSum<Sample>> found;
  for (const BlockMatch& hint : hints) {
    if (hint.source < 0 || hint.source >= sources()) continue;
    const IndexedSource<Sample>& source = data_->sources[hint.source];
    if (max(hint.position, Vec3i{}) != hint.position ||
        min(hint.position, source.positions - Vec3i{1, 1, 1}) != hint.position)
      continue;
    const auto at = static_cast<std::uint32_t>(source.offset + source.samples.index(hint.position));
    if (data_->allowed(at)) search.offer(at, found);
  }
  search.run(found);
  if (statistics) *statistics = search.statistics_;
  const int s = data_->sourceOf(found.position);
  return matchAt<Sample>(*data_, search.sums(s), found.limit, found.position);
}

template <class Sample>
const Vec3i& BlockIndex<Sample>::block() const {
  return data_->block;
}
template <class Sample>
int BlockIndex<Sample>::sources() const {
  return static_cast<int>(data_->sources.size());
}
template <class Sample>
const Array3D<Sample>& BlockIndex<Sample>::source(int number) const {
  return data_->sources[number].samples;
}
template <class Sample>
std::int64_t BlockIndex<Sample>::positions() const {
  return data_->positionCount;
}
template <class Sample>
std::int64_t BlockIndex<Sample>::bytes() const {
  std::size_t bytes = data_->tree.bytes() + data_->live.bytes() + data_->allowedBits.bytes();
  for (const IndexedSource<Sample>& source : data_->sources)
    bytes += source.bricks.count() * sizeof(kernels::Brick) +
             source.fineBricks.count() * sizeof(kernels::ByteBrick);
  return static_cast<std::int64_t>(bytes);
}

template class BlockIndex<std::uint8_t>;
template class BlockIndex<float>;

}  // namespace exemplar
