// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/height_patches.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/parallel.h"
#include "core/random.h"
#include "core/simd.h"
#include "synth/terrain/height_pieces.h"

namespace exemplar {
namespace {

constexpr int kSide = kHeightPatch, kSamples = kSide * kSide;
/// Side of the blocks of an example whose uses are counted, samples.
constexpr int kUseBlock = 4;
/// What differences of steps count in a patch's own variation, as they usually do in costs.
constexpr float kUsualSlopes = 4;
/// Patches of less variation than this, of the mean, are flat ground.
constexpr double kGentlest = 0.02;
/// What a patch counts at each of its rows and columns.
constexpr std::array<float, kSide> kKernel{1, 3, 5, 7, 7, 5, 3, 1};

/// For each symmetry: which sample of the result's patch each sample of the example's becomes.
struct TurnTables {
  std::array<std::array<std::uint8_t, kSamples>, 8> toResult{};
  std::array<Pixel, 8> first{};                ///< the sample that the result's first one is
  std::array<std::array<Pixel, 2>, 8> back{};  ///< what steps along x and y are in the example
  /// For each quarter of the example's patch, the quarter of the result's.
  std::array<std::array<std::uint8_t, 4>, 8> quarter{};

  TurnTables() {
    for (int turn = 0; turn < 8; ++turn) {
      const auto t = static_cast<std::size_t>(turn);
      back[t] = {turnedStep({1, 0}, turnedBackBy(turn)), turnedStep({0, 1}, turnedBackBy(turn))};
      for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
          const Pixel p = turnedStep({2 * i - kSide + 1, 2 * j - kSide + 1}, turnedBackBy(turn));
          const int u = (p.x + kSide - 1) / 2, v = (p.y + kSide - 1) / 2;
          if (i == 0 && j == 0) first[t] = {u, v};
          toResult[t][static_cast<std::size_t>(v * kSide + u)] =
              static_cast<std::uint8_t>(j * kSide + i);
        }
      }
      for (std::size_t n = 0; n < 4; ++n) {
        const int k = toResult[t][(n / 2) * (kSide - 1) * kSide + (n % 2) * (kSide - 1)];
        quarter[t][n] =
            static_cast<std::uint8_t>(2 * (k / kSide / (kSide / 2)) + k % kSide / (kSide / 2));
      }
    }
  }
};
const TurnTables kTables;

/// The sum of the differences of two patches, of their squares, and of the squares of their
/// differences' steps.
struct Sums {
  float difference, squares, steps;
};

EXEMPLAR_MULTIVERSION
void sumDifferences(const float* a, const float* b, std::ptrdiff_t stride, Sums& sums) {
  float d[kSide + 1][kSide];
  for (int v = 0; v < kSide; ++v)
    for (int u = 0; u < kSide; ++u) d[v][u] = a[v * kSide + u] - b[v * stride + u];
  float sum[kSide] = {}, squares[kSide] = {}, steps[kSide] = {};
  for (int v = 0; v < kSide; ++v) {
    for (int u = 0; u < kSide; ++u) {
      sum[u] += d[v][u];
      squares[u] += d[v][u] * d[v][u];
    }
  }
  for (int v = 0; v + 1 < kSide; ++v) {
    for (int u = 0; u < kSide; ++u) {
      const float step = d[v + 1][u] - d[v][u];
      steps[u] += step * step;
    }
  }
  // The last column has no neighbor to its right.
  constexpr float kCounts[kSide] = {1, 1, 1, 1, 1, 1, 1, 0};
  for (int u = 0; u < kSide; ++u) d[kSide][u] = 0;
  for (int v = 0; v < kSide; ++v) {
    const float* row = d[v];
    for (int u = 0; u < kSide; ++u) {
      const float step = (row[u + 1] - row[u]) * kCounts[u];
      steps[u] += step * step;
    }
  }
  sums = {};
  for (int u = 0; u < kSide; ++u) {
    sums.difference += sum[u];
    sums.squares += squares[u];
    sums.steps += steps[u];
  }
}

float meanOf(const float* first, std::ptrdiff_t stride) {
  float sum = 0;
  for (int v = 0; v < kSide; ++v)
    for (int u = 0; u < kSide; ++u) sum += first[v * stride + u];
  return sum / kSamples;
}

/// The first samples of patches along an axis.
std::vector<int> placesAlong(int size, int stride, bool wraps) {
  std::vector<int> places;
  const int end = wraps ? size : size - kSide + 1;
  for (int at = 0; at < end; at += stride) places.push_back(at);
  if (!wraps && places.back() != size - kSide) places.push_back(size - kSide);
  return places;
}

/// The patches over each sample, along one axis: the first that begins less than a side before it
/// (below 0 where that is one at the other end), and how many there are.
struct Over {
  int first, count;
};
std::vector<Over> patchesOver(int size, const std::vector<int>& places, bool wraps) {
  const int count = static_cast<int>(places.size());
  const auto begins = [&](int n) {
    return n >= 0 ? places[static_cast<std::size_t>(n)]
                  : places[static_cast<std::size_t>(n + count)] - size;
  };
  std::vector<Over> over(static_cast<std::size_t>(size));
  for (int at = 0; at < size; ++at) {
    const int last = static_cast<int>(std::ranges::upper_bound(places, at) - places.begin()) - 1;
    int first = last;
    while ((wraps || first > 0) && last - first + 1 < count && begins(first - 1) > at - kSide)
      --first;
    over[static_cast<std::size_t>(at)] = {first, last - first + 1};
  }
  return over;
}

/// What all patches over each sample count, along one axis.
std::vector<float> kernelSums(int size, const std::vector<int>& places) {
  std::vector<float> sums(static_cast<std::size_t>(size));
  for (const int place : places)
    for (std::size_t n = 0; n < kSide; ++n)
      sums[(static_cast<std::size_t>(place) + n) % sums.size()] += kKernel[n];
  return sums;
}

/// Adds a row of a patch to a row of votes.
EXEMPLAR_MULTIVERSION
void addRow(const float* from, std::ptrdiff_t step, float lift, float weight, float* to) {
  float row[kSide];
  if (step == 1) {
    for (int i = 0; i < kSide; ++i) row[i] = from[i];
  } else {
    for (int i = 0; i < kSide; ++i) row[i] = from[i * step];
  }
  for (int i = 0; i < kSide; ++i)
    to[i] += weight * kKernel[static_cast<std::size_t>(i)] * (row[i] + lift);
}

/// `HeightSource::blocks`.
void findBlocks(HeightSource& source) {
  constexpr int kBlock = kSide / 2;
  const Grid<float>& h = source.heights;
  source.blocks = Grid<float>(h.width(), h.height());
  const int rows = std::max(0, h.height() - kBlock + 1);
  parallelFor(0, static_cast<std::size_t>(rows), 16, [&](std::size_t y0, std::size_t y1) {
    std::vector<float> sums(static_cast<std::size_t>(h.width()));
    for (std::size_t r = y0; r < y1; ++r) {
      const int y = static_cast<int>(r);
      std::ranges::fill(sums, 0.0f);
      for (int v = 0; v < kBlock; ++v)
        for (int x = 0; x < h.width(); ++x) sums[static_cast<std::size_t>(x)] += h(x, y + v);
      for (std::size_t x = 0; x + kBlock <= sums.size(); ++x) {
        source.blocks(static_cast<int>(x), y) =
            (sums[x] + sums[x + 1] + sums[x + 2] + sums[x + 3]) / (kBlock * kBlock);
      }
    }
  });
}

/// What the differences of the four blocks of two patches are sure to cost. Over each row, the
/// difference between its halves' means is a sum of its seven steps, weighted by 1, 2, 3, 4, 3, 2,
/// 1 quarters, whose squares sum to 2.75 (Cauchy and Schwarz); the same over each column.
float leastCost(const std::array<float, 4>& d, float level, float slopes) {
  const float mean = (d[0] + d[1] + d[2] + d[3]) / 4;
  float squares = 0;
  for (const float v : d) squares += (v - mean) * (v - mean);
  const float a = d[1] - d[0], b = d[3] - d[2], c = d[2] - d[0], e = d[3] - d[1];
  const float steps = (a * a + b * b + c * c + e * e) * (kSide / 2) / 2.75f;
  return kSamples / 4 * squares + level * kSamples * mean * mean + slopes * steps;
}

/// Where a patch would come from at sample (0, 0).
struct Begin {
  int x, y;
  std::uint8_t example, turn;
  bool operator==(const Begin&) const = default;
};

/// `HeightSource::weights`, relative to the mean patch.
void weigh(HeightSource& source) {
  source.weights = Grid<float>(source.whole.width(), source.whole.height());
  constexpr float kFlat[kSamples] = {};
  const int rows = std::max(0, source.whole.height() - kSide + 1);
  parallelFor(0, static_cast<std::size_t>(rows), 16, [&](std::size_t y0, std::size_t y1) {
    for (std::size_t r = y0; r < y1; ++r) {
      const int y = static_cast<int>(r);
      for (int x = 0; x + kSide <= source.whole.width(); ++x) {
        if (!source.whole(x, y)) continue;
        Sums sums;
        sumDifferences(kFlat, &source.heights(x, y), source.heights.width(), sums);
        const float ofMean = sums.difference * sums.difference / kSamples;
        source.weights(x, y) = std::max(0.0f, sums.squares - ofMean) + kUsualSlopes * sums.steps;
      }
    }
  });
  double mean = 0;
  for (const float variation : source.weights.values()) mean += variation;
  mean /= static_cast<double>(std::max<std::size_t>(1, source.places));
  for (float& w : source.weights.values())
    w = mean > 0 ? static_cast<float>(1 / std::sqrt(w / mean + kGentlest)) : 1.0f;
}

}  // namespace

void HeightQuery::take(const Grid<float>& heights, Pixel at) {
  const bool inside =
      at.x >= 0 && at.y >= 0 && at.x + kSide <= heights.width() && at.y + kSide <= heights.height();
  float* plain = heights_[0].data();
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      plain[j * kSide + i] =
          heights[inside ? heights.index(at.x + i, at.y + j) : heights.wrapped(at.x + i, at.y + j)];
    }
  }
  turned_ = 1;
  constexpr int kBlock = kSide / 2;
  for (int n = 0; n < 4; ++n) {
    float sum = 0;
    const float* first = plain + (n / 2) * kBlock * kSide + (n % 2) * kBlock;
    for (int v = 0; v < kBlock; ++v)
      for (int u = 0; u < kBlock; ++u) sum += first[v * kSide + u];
    blocks_[static_cast<std::size_t>(n)] = sum / (kBlock * kBlock);
  }
}

const float* HeightQuery::turned(int turn) {
  const auto t = static_cast<std::size_t>(turn);
  if (!(turned_ >> turn & 1)) {
    const auto& order = kTables.toResult[t];
    for (std::size_t k = 0; k < kSamples; ++k) heights_[t][k] = heights_[0][order[k]];
    turned_ |= 1u << turn;
  }
  return heights_[t].data();
}

void HeightQuery::turn(std::span<const int> turns) {
  for (const int turn : turns) turned(turn);
}

float HeightQuery::cost(const HeightSource& source, const HeightMatch& match, float level,
                        float slopes, float most) {
  constexpr int kBlock = kSide / 2;
  /// Rounding must not make a bound of what is equal.
  constexpr float kSure = 0.99f;
  const std::size_t at = source.heights.index(match.x, match.y);
  const float weight = source.weights[at];
  const auto& quarter = kTables.quarter[match.turn];
  const auto down =
      static_cast<std::size_t>(kBlock) * static_cast<std::size_t>(source.blocks.width());
  const std::array<float, 4> differences{blocks_[quarter[0]] - source.blocks[at],
                                         blocks_[quarter[1]] - source.blocks[at + kBlock],
                                         blocks_[quarter[2]] - source.blocks[at + down],
                                         blocks_[quarter[3]] - source.blocks[at + down + kBlock]};
  if (kSure * leastCost(differences, level, slopes) * weight > most)
    return std::numeric_limits<float>::infinity();
  Sums sums;
  sumDifferences(turned(match.turn), &source.heights[at], source.heights.width(), sums);
  const float ofMean = sums.difference * sums.difference / kSamples;
  return (std::max(0.0f, sums.squares - ofMean) + level * ofMean + slopes * sums.steps) * weight;
}

HeightOrigin originOfFirst(const HeightMatch& match) {
  const Pixel first = kTables.first[match.turn];
  return {static_cast<std::int16_t>(match.x + first.x),
          static_cast<std::int16_t>(match.y + first.y), match.example, match.turn};
}

HeightSource heightSource(Grid<float> heights) {
  HeightSource source;
  source.heights = std::move(heights);
  const int width = source.heights.width(), height = source.heights.height();
  source.whole = Grid<std::uint8_t>(width, height);
  // The number of good samples to the left of and above each.
  Grid<std::uint32_t> good(width + 1, height + 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      good(x + 1, y + 1) = good(x, y + 1) + good(x + 1, y) - good(x, y) +
                           (std::isnan(source.heights(x, y)) ? 0u : 1u);
    }
  }
  for (int y = 0; y + kSide <= height; ++y) {
    for (int x = 0; x + kSide <= width; ++x) {
      const std::uint32_t count =
          good(x + kSide, y + kSide) - good(x, y + kSide) - good(x + kSide, y) + good(x, y);
      source.whole(x, y) = count == kSamples;
      source.places += source.whole(x, y);
    }
  }
  weigh(source);
  findBlocks(source);
  return source;
}

HeightField::HeightField(int width, int height, const HeightMatching& matching)
    : width_(width),
      height_(height),
      matching_(matching),
      xs_(placesAlong(width, matching.stride, matching.wrapsX)),
      ys_(placesAlong(height, matching.stride, matching.wrapsY)),
      matches_(columns(), rows()) {
  assert(width >= kSide && height >= kSide);
}

bool HeightField::consider(std::span<const HeightSource> sources, HeightQuery& query,
                           const HeightMatch& candidate, HeightMatch& best) const {
  const HeightSource& source = sources[candidate.example];
  if (!source.whole.contains(candidate.x, candidate.y) || !source.whole(candidate.x, candidate.y))
    return false;
  float used = 1;
  if (!uses_.empty()) {
    const Grid<float>& uses = uses_[candidate.example];
    const float use =
        uses((candidate.x + kSide / 2) / kUseBlock, (candidate.y + kSide / 2) / kUseBlock);
    used += static_cast<float>(matching_.evenness) * std::max(0.0f, use - 1);
  }
  const float cost = used * query.cost(source, candidate, static_cast<float>(matching_.level),
                                       static_cast<float>(matching_.slopes), best.cost / used);
  if (!(cost < best.cost)) return false;
  best = candidate;
  best.cost = cost;
  return true;
}

void HeightField::countUses(std::span<const HeightSource> sources) {
  if (matching_.evenness <= 0) return;
  uses_.clear();
  std::size_t places = 0;
  for (const HeightSource& source : sources) {
    uses_.emplace_back((source.heights.width() + kUseBlock - 1) / kUseBlock,
                       (source.heights.height() + kUseBlock - 1) / kUseBlock);
    places += source.places;
  }
  usesEach_ = static_cast<float>(static_cast<double>(matches_.count()) * kUseBlock * kUseBlock /
                                 static_cast<double>(std::max<std::size_t>(1, places)));
  for (const HeightMatch& match : matches_.values()) addUse(match, 1);
}

void HeightField::search(std::span<const HeightSource> sources, const Grid<float>& heights,
                         std::uint64_t seed, std::uint64_t round, int tries,
                         const Progress& progress) {
  countUses(sources);
  const Random random = Random(seed, stream::kTerrainPatches).fork(round);
  const Grid<HeightMatch> before = matches_;
  const int reach = round % 2 == 0 ? 1 : 3;
  parallelFor(0, static_cast<std::size_t>(rows()), 1, [&](std::size_t r0, std::size_t r1) {
    HeightQuery query;
    for (std::size_t r = r0; r < r1; ++r) {
      progress.check();
      const int row = static_cast<int>(r);
      for (int column = 0; column < columns(); ++column) {
        query.take(heights, place(column, row));
        HeightMatch best = before(column, row);
        best.cost = std::numeric_limits<float>::infinity();
        consider(sources, query, before(column, row), best);
        const Pixel here = place(column, row);
        for (const Pixel step : {Pixel{-1, 0}, Pixel{1, 0}, Pixel{0, -1}, Pixel{0, 1}}) {
          int c = column + step.x * reach, n = row + step.y * reach;
          Pixel offset{0, 0};
          if (matching_.wrapsX) {
            if (c < 0) c += columns(), offset.x = -width_;
            if (c >= columns()) c -= columns(), offset.x = width_;
          }
          if (matching_.wrapsY) {
            if (n < 0) n += rows(), offset.y = -height_;
            if (n >= rows()) n -= rows(), offset.y = height_;
          }
          if (!matches_.contains(c, n)) continue;
          HeightMatch near = before(c, n);
          const Pixel there = place(c, n);
          if (!reaches(near, best, here)) continue;
          const auto& back = kTables.back[near.turn];
          const int dx = here.x - there.x - offset.x, dy = here.y - there.y - offset.y;
          near.x = static_cast<std::int16_t>(near.x + back[0].x * dx + back[1].x * dy);
          near.y = static_cast<std::int16_t>(near.y + back[0].y * dx + back[1].y * dy);
          if (near.x == best.x && near.y == best.y && near.turn == best.turn &&
              near.example == best.example)
            continue;
          consider(sources, query, near, best);
        }
        const std::uint64_t cell = matches_.index(column, row);
        for (int n = 0; n < tries; ++n) {
          const std::uint64_t bits = random.bits(cell, static_cast<std::uint32_t>(n));
          const auto pick = [&](int part, std::size_t count) {
            return static_cast<int>((bits >> (16 * part) & 0xffff) * count >> 16);
          };
          HeightMatch other = best;
          if (n == 0) {
            // Anywhere, in any orientation.
            other.example = static_cast<std::uint8_t>(pick(0, sources.size()));
            const Grid<float>& from = sources[other.example].heights;
            other.turn = static_cast<std::uint8_t>(
                matching_.turns[static_cast<std::size_t>(pick(1, matching_.turns.size()))]);
            other.x = static_cast<std::int16_t>(
                pick(2, static_cast<std::size_t>(from.width() - kSide + 1)));
            other.y = static_cast<std::int16_t>(
                pick(3, static_cast<std::size_t>(from.height() - kSide + 1)));
          } else {
            const int radius = std::max(1, 16 >> (n - 1));
            const auto span = static_cast<std::size_t>(2 * radius + 1);
            other.x = static_cast<std::int16_t>(other.x - radius + pick(0, span));
            other.y = static_cast<std::int16_t>(other.y - radius + pick(1, span));
          }
          consider(sources, query, other, best);
        }
        matches_(column, row) = best;
      }
    }
  });
}

void HeightField::addUse(const HeightMatch& match, float by) {
  if (uses_.empty()) return;
  Grid<float>& uses = uses_[match.example];
  const int x = (match.x + kSide / 2) / kUseBlock, y = (match.y + kSide / 2) / kUseBlock;
  int count = 0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) count += uses.contains(x + dx, y + dy);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (uses.contains(x + dx, y + dy))
        uses(x + dx, y + dy) += by / (static_cast<float>(count) * usesEach_);
    }
  }
}

void HeightField::searchAll(std::span<const HeightSource> sources, const Grid<float>& heights,
                            const Progress& progress) {
  countUses(sources);
  // One patch after another, in an order without direction, so that each sees what the others use;
  // its comparisons in parallel.
  const std::size_t count = matches_.count();
  std::size_t stride =
      std::max<std::size_t>(1, static_cast<std::size_t>(0.618 * static_cast<double>(count)));
  while (std::gcd(stride, count) != 1) ++stride;
  HeightQuery query;
  std::vector<HeightMatch> rows;
  for (std::size_t n = 0, at = 0; n < count; ++n, at = (at + stride) % count) {
    if (n % 16 == 0) progress.check();
    const int column = static_cast<int>(at % static_cast<std::size_t>(columns()));
    const int row = static_cast<int>(at / static_cast<std::size_t>(columns()));
    addUse(matches_[at], -1);
    query.take(heights, place(column, row));
    query.turn(matching_.turns);
    HeightMatch best;
    best.cost = std::numeric_limits<float>::infinity();
    // What there is says what is worth comparing.
    consider(sources, query, HeightMatch(matches_[at]), best);
    for (std::size_t e = 0; e < sources.size(); ++e) {
      const Grid<std::uint8_t>& whole = sources[e].whole;
      rows.assign(static_cast<std::size_t>(whole.height() - kSide + 1), best);
      parallelFor(0, rows.size(), 4, [&](std::size_t y0, std::size_t y1) {
        for (std::size_t y = y0; y < y1; ++y) {
          for (int x = 0; x + kSide <= whole.width(); ++x) {
            for (const int turn : matching_.turns) {
              consider(sources, query,
                       {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y),
                        static_cast<std::uint8_t>(e), static_cast<std::uint8_t>(turn), 0},
                       rows[y]);
            }
          }
        }
      });
      for (const HeightMatch& found : rows)
        if (found.cost < best.cost) best = found;
    }
    matches_[at] = best;
    addUse(best, 1);
  }
}

Grid<float> HeightField::vote(std::span<const HeightSource> sources, const Grid<float>& heights,
                              const Progress& progress) const {
  // How much higher each patch lies in the result; as far as levels count it is drawn to its own.
  const auto keep = static_cast<float>(1 - matching_.level);
  Grid<float> lift(columns(), rows());
  parallelFor(0, static_cast<std::size_t>(rows()), 4, [&](std::size_t r0, std::size_t r1) {
    for (std::size_t r = r0; r < r1; ++r) {
      for (int column = 0; column < columns(); ++column) {
        const Pixel at = place(column, static_cast<int>(r));
        float mean = 0;
        for (int j = 0; j < kSide; ++j)
          for (int i = 0; i < kSide; ++i) mean += heights[heights.wrapped(at.x + i, at.y + j)];
        const HeightMatch& match = matches_(column, static_cast<int>(r));
        const Grid<float>& from = sources[match.example].heights;
        lift(column, static_cast<int>(r)) =
            keep * (mean / kSamples - meanOf(&from[from.index(match.x, match.y)], from.width()));
      }
    }
  });
  const std::vector<float> across = kernelSums(width_, xs_), down = kernelSums(height_, ys_);
  Grid<float> voted(width_, height_);
  // Bands of rows: each sample sums up its patches in the order of their rows and columns.
  parallelFor(0, static_cast<std::size_t>(height_), 32, [&](std::size_t y0, std::size_t y1) {
    progress.check();
    const auto inBand = [&](int y) {
      return static_cast<std::size_t>(y) >= y0 && static_cast<std::size_t>(y) < y1;
    };
    for (int row = 0; row < rows(); ++row) {
      const int top = ys_[static_cast<std::size_t>(row)];
      for (int j = 0; j < kSide; ++j) {
        const int y = top + j < height_ ? top + j : top + j - height_;
        if (!inBand(y)) continue;
        const float weight = kKernel[static_cast<std::size_t>(j)];
        for (int column = 0; column < columns(); ++column) {
          const HeightMatch& match = matches_(column, row);
          const Grid<float>& from = sources[match.example].heights;
          const auto& back = kTables.back[match.turn];
          const Pixel first = kTables.first[match.turn];
          const float* begin =
              &from(match.x + first.x + j * back[1].x, match.y + first.y + j * back[1].y);
          const std::ptrdiff_t step = back[0].x + std::ptrdiff_t{back[0].y} * from.width();
          const int x = xs_[static_cast<std::size_t>(column)];
          if (x + kSide <= width_) {
            addRow(begin, step, lift(column, row), weight, &voted(x, y));
            continue;
          }
          std::array<float, kSide> votes{};
          addRow(begin, step, lift(column, row), weight, votes.data());
          for (int i = 0; i < kSide; ++i)
            voted((x + i) % width_, y) += votes[static_cast<std::size_t>(i)];
        }
      }
    }
    for (std::size_t y = y0; y < y1; ++y) {
      for (int x = 0; x < width_; ++x)
        voted(x, static_cast<int>(y)) /= across[static_cast<std::size_t>(x)] * down[y];
    }
  });
  return voted;
}

Grid<HeightOrigin> HeightField::origins(const Progress& progress) const {
  // What the sample (0, 0) would come from if each patch went on to there: patches agree on all
  // samples or on none. Patches that go over an end also go on from beyond it.
  const auto beginOf = [&](int column, int row, Pixel offset) {
    const Pixel at = place(column, row);
    const HeightOrigin first = originOfFirst(matches_(column, row));
    const auto& back = kTables.back[first.turn];
    const int dx = at.x - offset.x, dy = at.y - offset.y;
    return Begin{first.x - back[0].x * dx - back[1].x * dy,
                 first.y - back[0].y * dx - back[1].y * dy, first.example, first.turn};
  };
  Grid<Begin> begins(columns(), rows());
  parallelFor(0, static_cast<std::size_t>(rows()), 8, [&](std::size_t r0, std::size_t r1) {
    for (std::size_t r = r0; r < r1; ++r)
      for (int column = 0; column < columns(); ++column)
        begins(column, static_cast<int>(r)) = beginOf(column, static_cast<int>(r), {0, 0});
  });
  const std::vector<Over> across = patchesOver(width_, xs_, matching_.wrapsX);
  const std::vector<Over> down = patchesOver(height_, ys_, matching_.wrapsY);
  Grid<HeightOrigin> origins(width_, height_);
  parallelFor(0, static_cast<std::size_t>(height_), 8, [&](std::size_t y0, std::size_t y1) {
    Begin found[kSamples];
    float weights[kSamples];
    for (std::size_t y = y0; y < y1; ++y) {
      progress.check();
      for (int x = 0; x < width_; ++x) {
        const Over overX = across[static_cast<std::size_t>(x)], overY = down[y];
        int count = 0;
        for (int r = overY.first; r < overY.first + overY.count; ++r) {
          const int row = r < 0 ? r + rows() : r;
          const int top = ys_[static_cast<std::size_t>(row)] - (r < 0 ? height_ : 0);
          const float weight = kKernel[y - static_cast<std::size_t>(top)];
          for (int c = overX.first; c < overX.first + overX.count; ++c) {
            const int column = c < 0 ? c + columns() : c;
            const int left = xs_[static_cast<std::size_t>(column)] - (c < 0 ? width_ : 0);
            const Begin begin =
                r >= 0 && c >= 0 ? begins(column, row)
                                 : beginOf(column, row, {c < 0 ? width_ : 0, r < 0 ? height_ : 0});
            const float own = weight * kKernel[static_cast<std::size_t>(x - left)];
            int n = 0;
            while (n < count && !(found[n] == begin)) ++n;
            if (n == count) {
              found[count] = begin;
              weights[count++] = 0;
            }
            weights[n] += own;
          }
        }
        int best = 0;
        for (int n = 1; n < count; ++n)
          if (weights[n] > weights[best]) best = n;
        const Begin& begin = found[best];
        const auto& back = kTables.back[begin.turn];
        const int row = static_cast<int>(y);
        origins(x, row) = {static_cast<std::int16_t>(begin.x + back[0].x * x + back[1].x * row),
                           static_cast<std::int16_t>(begin.y + back[0].y * x + back[1].y * row),
                           begin.example, begin.turn};
      }
    }
  });
  return origins;
}

void HeightField::leaveHoles(std::span<const HeightSource> sources) {
  for (HeightMatch& match : matches_.values()) {
    const Grid<std::uint8_t>& whole = sources[match.example].whole;
    if (whole(match.x, match.y)) continue;
    // The nearest in rings of squares.
    const int most = std::max(whole.width(), whole.height());
    for (int radius = 1, found = 0; radius < most && !found; ++radius) {
      for (int dy = -radius; dy <= radius && !found; ++dy) {
        const int step = std::abs(dy) == radius ? 1 : 2 * radius;
        for (int dx = -radius; dx <= radius && !found; dx += step) {
          const int x = match.x + dx, y = match.y + dy;
          if (!whole.contains(x, y) || !whole(x, y)) continue;
          match.x = static_cast<std::int16_t>(x);
          match.y = static_cast<std::int16_t>(y);
          found = 1;
        }
      }
    }
  }
}

bool HeightField::reaches(const HeightMatch& from, const HeightMatch& own, Pixel at) const {
  if (pieces_ == nullptr || from.piece == own.piece) return true;
  const Pixel middle = pieces_->middles[from.piece];
  const auto apart = [](int a, int b, int size, bool wraps) {
    const int d = std::abs(a - b);
    return wraps ? std::min(d, size - d) : d;
  };
  const int dx = apart(at.x + kSide / 2, middle.x, width_, matching_.wrapsX);
  const int dy = apart(at.y + kSide / 2, middle.y, height_, matching_.wrapsY);
  return dx * dx + dy * dy <= pieces_->reach * pieces_->reach;
}

void HeightField::begin(const HeightPieces& pieces, std::span<const HeightSource> sources) {
  pieces_ = &pieces;
  for (int row = 0; row < rows(); ++row) {
    for (int column = 0; column < columns(); ++column) {
      const Pixel at = place(column, row);
      const HeightPieces::Share share = pieces.over({at.x + kSide / 2, at.y + kSide / 2});
      const HeightOrigin origin = stepped(pieces.origins[share.piece],
                                          {share.step.x - kSide / 2, share.step.y - kSide / 2});
      const Grid<float>& from = sources[origin.example].heights;
      const HeightOrigin first = originOfFirst({0, 0, origin.example, origin.turn});
      HeightMatch match;
      match.example = origin.example;
      match.turn = origin.turn;
      match.piece = share.piece;
      match.x = static_cast<std::int16_t>(std::clamp(origin.x - first.x, 0, from.width() - kSide));
      match.y = static_cast<std::int16_t>(std::clamp(origin.y - first.y, 0, from.height() - kSide));
      matches_(column, row) = match;
    }
  }
  leaveHoles(sources);
}

}  // namespace exemplar
