// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/layered/auction.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "core/simd.h"

namespace exemplar {
namespace {

/// Prices and scaled costs: costs are shifted left, so that an ε below 1 / rows is an integer.
using Price = std::int32_t;
constexpr Price kFar = std::numeric_limits<Price>::max();
/// A sum of a scaled cost and a price stays below `kFar`.
constexpr Price kMostPrice = 1 << 30;

constexpr int kBlock = 64;  // columns whose least value is kept

/// The least of cost + price of each block of columns.
EXEMPLAR_MULTIVERSION
void leastOfBlocks(const std::uint16_t* costs, const Price* prices, int shift, int columns,
                   Price* least) {
  for (int first = 0; first < columns; first += kBlock) {
    const int end = first + kBlock < columns ? first + kBlock : columns;
    Price block = kFar;
    for (int c = first; c < end; ++c) {
      const Price value = (static_cast<Price>(costs[c]) << shift) + prices[c];
      block = value < block ? value : block;
    }
    *least++ = block;
  }
}

/// One auction at a time: prices stay from one ε to the next, what was sold does not.
class Auction {
 public:
  Auction(const Grid<std::uint16_t>& costs, std::span<const std::uint32_t> capacities)
      : costs_(costs),
        capacities_(capacities),
        columns_(costs.width()),
        shift_(std::bit_width(static_cast<unsigned>(costs.height()))),
        prices_(static_cast<std::size_t>(columns_)),
        sold_(static_cast<std::size_t>(columns_)),
        least_(static_cast<std::size_t>((columns_ + kBlock - 1) / kBlock)) {
    // What serves nobody is never bid for.
    for (std::size_t c = 0; c < prices_.size(); ++c)
      if (capacities_[c] == 0) prices_[c] = kMostPrice;
  }

  bool run(const Progress& progress) {
    const Price largest = *std::ranges::max_element(costs_.values());
    if (std::int64_t{largest} << shift_ >= kMostPrice) return false;
    for (Price epsilon = std::max(1, (largest << shift_) / 4);;
         epsilon = std::max(1, epsilon / 5)) {
      if (!sellAll(epsilon, progress)) return false;
      if (epsilon == 1) return true;
    }
  }

  std::vector<std::uint32_t> columnOfRow() const {
    std::vector<std::uint32_t> column(static_cast<std::size_t>(costs_.height()));
    for (std::uint32_t c = 0; c < sold_.size(); ++c)
      for (const Bid& bid : sold_[c]) column[bid.second] = c;
    return column;
  }

 private:
  using Bid = std::pair<Price, std::uint32_t>;  // and the row

  bool sellAll(Price epsilon, const Progress& progress) {
    for (std::vector<Bid>& bids : sold_) bids.clear();
    std::vector<std::uint32_t> waiting(static_cast<std::size_t>(costs_.height()));
    std::iota(waiting.rbegin(), waiting.rend(), 0u);
    for (std::size_t n = 0; !waiting.empty(); ++n) {
      if (n % 4096 == 0) progress.check();
      const std::uint32_t row = waiting.back();
      waiting.pop_back();
      if (!bidFor(row, epsilon, waiting)) return false;
    }
    return true;
  }

  /// Bids for the best column; who is outbid waits again.
  bool bidFor(std::uint32_t row, Price epsilon, std::vector<std::uint32_t>& waiting) {
    const std::uint16_t* costs = &costs_(0, static_cast<int>(row));
    leastOfBlocks(costs, prices_.data(), shift_, columns_, least_.data());
    const auto best = std::ranges::min_element(least_);
    const int first = static_cast<int>(best - least_.begin()) * kBlock;
    Price second = kFar;
    for (auto block = least_.begin(); block != least_.end(); ++block)
      if (block != best) second = std::min(second, *block);
    Price value = kFar;
    int column = 0;
    for (int c = first; c < std::min(first + kBlock, columns_); ++c) {
      const Price here = (Price{costs[c]} << shift_) + prices_[static_cast<std::size_t>(c)];
      if (here < value) {
        second = std::min(second, value);
        value = here;
        column = c;
      } else {
        second = std::min(second, here);
      }
    }
    const auto c = static_cast<std::size_t>(column);
    if (second == kFar) second = value;
    const std::int64_t bid = std::int64_t{prices_[c]} + (second - value) + epsilon;
    if (bid >= kMostPrice) return false;
    std::vector<Bid>& bids = sold_[c];  // a heap, the lowest first
    bids.emplace_back(static_cast<Price>(bid), row);
    std::ranges::push_heap(bids, std::greater{});
    if (bids.size() > capacities_[c]) {
      std::ranges::pop_heap(bids, std::greater{});
      waiting.push_back(bids.back().second);
      bids.pop_back();
    }
    if (bids.size() == capacities_[c]) prices_[c] = bids.front().first;
    return true;
  }

  const Grid<std::uint16_t>& costs_;
  std::span<const std::uint32_t> capacities_;
  int columns_, shift_;
  std::vector<Price> prices_;
  std::vector<std::vector<Bid>> sold_;
  std::vector<Price> least_;
};

}  // namespace

std::optional<std::vector<std::uint32_t>> assignByAuction(const Grid<std::uint16_t>& costs,
                                                          std::span<const std::uint32_t> capacities,
                                                          const Progress& progress) {
  assert(static_cast<std::size_t>(costs.width()) == capacities.size());
  assert(std::accumulate(capacities.begin(), capacities.end(), std::size_t{0}) ==
         static_cast<std::size_t>(costs.height()));
  Auction auction(costs, capacities);
  if (!auction.run(progress)) return std::nullopt;
  return auction.columnOfRow();
}

}  // namespace exemplar
