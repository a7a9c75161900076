// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/query_rows.h"

#include <algorithm>
#include <numeric>

#include "core/simd.h"

namespace exemplar {

namespace {

// Sums stay in eight lanes, so that the order of floating-point additions does not depend on the
// machine's vectors.
constexpr int kLanes = 8;

// Rows between two looks at the limit: a look costs about as much as two rows of eight.
constexpr std::size_t kRowsPerLook = 4;

template <class Lane, bool masked, class Sample, class Value>
inline __attribute__((always_inline)) void addRow(const Sample* a, const Value* q, const Sample* m,
                                                  std::uint32_t length, Lane* lanes) {
  using Difference = std::conditional_t<std::is_same_v<Sample, std::uint8_t>, Value, Sample>;
  const auto square = [&](std::uint32_t i) {
    Difference d;
    if constexpr (!masked)
      d = static_cast<Difference>(a[i] - q[i]);
    else if constexpr (std::is_same_v<Sample, std::uint8_t>)
      d = static_cast<Difference>((a[i] & m[i]) - q[i]);
    else
      d = a[i] * m[i] - q[i];
    return static_cast<Lane>(d) * static_cast<Lane>(d);
  };
  std::uint32_t i = 0;
  for (; i + kLanes <= length; i += kLanes)
    for (int l = 0; l < kLanes; ++l) lanes[l] += square(i + l);
  if (i + 4 <= length) {
    for (int l = 0; l < 4; ++l) lanes[l] += square(i + l);
    i += 4;
  }
  for (int l = 0; i < length; ++i, ++l) lanes[l] += square(i);
}

template <class Lane, class Sample>
inline __attribute__((always_inline)) std::size_t scanRows(
    const typename QueryRows<Sample>::Data& data, const Sample* block, std::size_t count,
    SquaredSum<Sample> limit, SquaredSum<Sample>& found) {
  const auto* rows = data.rows.data();
  const std::size_t rowCount = data.rows.size();
  const auto* values = data.values.data();
  const Sample* masks = data.masks.data();
  for (std::size_t b = 0; b < count; ++b) {
    SquaredSum<Sample> sum = 0;
    [[maybe_unused]] Lane running[kLanes] = {};
    for (std::size_t r = 0; r < rowCount && sum <= limit;) {
      const std::size_t end = std::min(rowCount, r + kRowsPerLook);
      Lane lanes[kLanes] = {};
      if constexpr (!std::is_integral_v<Lane>)
        for (int l = 0; l < kLanes; ++l) lanes[l] = running[l];
      for (; r < end; ++r) {
        const auto& row = rows[r];
        if (row.masked)
          addRow<Lane, true>(block + b + row.source, values + row.query, masks + row.query,
                             row.length, lanes);
        else
          addRow<Lane, false>(block + b + row.source, values + row.query, masks + row.query,
                              row.length, lanes);
      }
      if constexpr (std::is_integral_v<Lane>) {
        for (int l = 0; l < kLanes; ++l) sum += lanes[l];
      } else {
        // The sum of all lanes from first to last grows with each of them, in floating point too.
        sum = 0;
        for (int l = 0; l < kLanes; ++l) sum += running[l] = lanes[l];
      }
    }
    if (sum <= limit) {
      found = sum;
      return b;
    }
  }
  return count;
}

// 32-bit lanes hold kRowsPerLook rows of up to 60,000 samples of 255² in eight lanes.
EXEMPLAR_MULTIVERSION std::size_t scan(const QueryRows<std::uint8_t>::Data& data,
                                       const std::uint8_t* block, std::size_t count,
                                       std::int64_t limit, std::int64_t& found) {
  return scanRows<std::int32_t, std::uint8_t>(data, block, count, limit, found);
}

EXEMPLAR_MULTIVERSION std::size_t scan(const QueryRows<float>::Data& data, const float* block,
                                       std::size_t count, double limit, double& found) {
  return scanRows<double, float>(data, block, count, limit, found);
}

}  // namespace

template <class Sample>
QueryRows<Sample>::QueryRows(const BlockQuery<Sample>& query, const Vec3i& sourceSize) {
  const Vec3i size = query.samples.size();
  blockPositions(sourceSize, size);
  known_ = knownSamples(query);

  const bool all = query.known.empty();
  std::vector<Row> rows;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j) {
      const std::size_t at = query.samples.index(0, j, k);
      const auto known = [&](int i) { return all || query.known.data()[at + i] != 0; };
      int first = 0, last = size.x;
      while (first < last && !known(first)) ++first;
      while (first < last && !known(last - 1)) --last;
      if (first == last) continue;
      Row row;
      row.source = static_cast<std::uint32_t>(
          (static_cast<std::size_t>(k) * sourceSize.y + j) * sourceSize.x + first);
      row.query = static_cast<std::uint32_t>(data_.values.size());
      row.length = static_cast<std::uint32_t>(last - first);
      row.masked = false;
      for (int i = first; i < last; ++i) {
        row.masked = row.masked || !known(i);
        using Value = typename decltype(data_.values)::value_type;
        data_.values.push_back(known(i) ? static_cast<Value>(query.samples.data()[at + i])
                                        : Value{0});
        if constexpr (std::is_same_v<Sample, std::uint8_t>)
          data_.masks.push_back(known(i) ? 255 : 0);
        else
          data_.masks.push_back(known(i) ? 1.0f : 0.0f);
      }
      rows.push_back(row);
    }

  // Steps of about the golden ratio visit the rows evenly from the start on.
  const std::size_t n = rows.size();
  std::size_t step = static_cast<std::size_t>(0.618 * static_cast<double>(n)) | 1;
  while (n > 1 && std::gcd(step, n) != 1) ++step;
  data_.rows.reserve(n);
  for (std::size_t r = 0, at = 0; r < n; ++r, at = (at + step) % n) data_.rows.push_back(rows[at]);
}

template <class Sample>
SquaredSum<Sample> QueryRows<Sample>::sum(const Sample* block, Sum limit) const {
  Sum found;
  return scan(data_, block, 1, limit, found) == 0 ? found : limit + 1;
}

template <class Sample>
std::size_t QueryRows<Sample>::firstWithin(const Sample* block, std::size_t count, Sum limit,
                                           Sum& found) const {
  return scan(data_, block, count, limit, found);
}

template class QueryRows<std::uint8_t>;
template class QueryRows<float>;

}  // namespace exemplar
