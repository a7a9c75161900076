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

/// For each symmetry: which sample of the result's patch each sample of the example's becomes, and
/// back.
struct TurnTables {
  std::array<std::array<std::uint8_t, kSamples>, 8> toResult{}, toExample{};
  std::array<std::array<Pixel, 2>, 8> back{};  ///< what steps along x and y are in the example

  TurnTables() {
    for (int turn = 0; turn < 8; ++turn) {
      const auto t = static_cast<std::size_t>(turn);
      back[t] = {turnedStep({1, 0}, turnedBackBy(turn)), turnedStep({0, 1}, turnedBackBy(turn))};
      for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
          const Pixel p = turnedStep({2 * i - kSide + 1, 2 * j - kSide + 1}, turnedBackBy(turn));
          const int u = (p.x + kSide - 1) / 2, v = (p.y + kSide - 1) / 2;
          toExample[t][static_cast<std::size_t>(j * kSide + i)] =
              static_cast<std::uint8_t>(v * kSide + u);
          toResult[t][static_cast<std::size_t>(v * kSide + u)] =
              static_cast<std::uint8_t>(j * kSide + i);
        }
      }
    }
  }
};
const TurnTables& tables() {
  static const TurnTables made;
  return made;
}

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

/// The patches over a sample, along one axis: the first that begins less than a side before it.
struct Over {
  int first, count;
};
Over patchesOver(int at, int size, const std::vector<int>& places, bool wraps) {
  const int count = static_cast<int>(places.size());
  const int last = static_cast<int>(std::ranges::upper_bound(places, at) - places.begin()) - 1;
  int first = last;
  const auto begins = [&](int n) {
    return n >= 0 ? places[static_cast<std::size_t>(n)]
                  : places[static_cast<std::size_t>(n + count)] - size;
  };
  while ((wraps || first > 0) && last - first + 1 < count && begins(first - 1) > at - kSide)
    --first;
  return {first, last - first + 1};
}

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

void takeQuery(const Grid<float>& heights, Pixel at, std::span<const int> turns,
               HeightQuery& query) {
  const bool inside =
      at.x >= 0 && at.y >= 0 && at.x + kSide <= heights.width() && at.y + kSide <= heights.height();
  float plain[kSamples];
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      plain[j * kSide + i] =
          heights[inside ? heights.index(at.x + i, at.y + j) : heights.wrapped(at.x + i, at.y + j)];
    }
  }
  for (const int turn : turns) {
    const auto& order = tables().toResult[static_cast<std::size_t>(turn)];
    for (std::size_t k = 0; k < kSamples; ++k) query.heights[turn][k] = plain[order[k]];
  }
}

double shapeCost(const HeightSource& source, const HeightQuery& query, const HeightMatch& match,
                 double level, double slopes) {
  const std::size_t at = source.heights.index(match.x, match.y);
  Sums sums;
  sumDifferences(query.heights[match.turn], &source.heights[at], source.heights.width(), sums);
  const double ofMean = static_cast<double>(sums.difference) * sums.difference / kSamples;
  return (std::max(0.0, sums.squares - ofMean) + level * ofMean + slopes * sums.steps) *
         source.weights[at];
}

HeightOrigin originOfFirst(const HeightMatch& match) {
  const int k = tables().toExample[match.turn][0];
  return {static_cast<std::int16_t>(match.x + k % kSide),
          static_cast<std::int16_t>(match.y + k / kSide), match.example, match.turn};
}

HeightSource heightSource(Grid<float> heights) {
  HeightSource source{std::move(heights), {}, {}, 0};
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

double HeightField::costOf(const HeightSource& source, const HeightQuery& query,
                           const HeightMatch& match) const {
  const double cost = shapeCost(source, query, match, matching_.level, matching_.slopes);
  if (uses_.empty()) return cost;
  const Grid<float>& uses = uses_[match.example];
  const float use = uses((match.x + kSide / 2) / kUseBlock, (match.y + kSide / 2) / kUseBlock);
  return cost * (1 + matching_.evenness * std::max(0.0f, use - 1));
}

bool HeightField::consider(std::span<const HeightSource> sources, const HeightQuery& query,
                           const HeightMatch& candidate, HeightMatch& best) const {
  const HeightSource& source = sources[candidate.example];
  if (!source.whole.contains(candidate.x, candidate.y) || !source.whole(candidate.x, candidate.y))
    return false;
  const auto cost = static_cast<float>(costOf(source, query, candidate));
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
        takeQuery(heights, place(column, row), matching_.turns, query);
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
          const auto& back = tables().back[near.turn];
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
          const auto draw = static_cast<std::uint32_t>(4 * n);
          HeightMatch other = best;
          if (n == 0) {
            // Anywhere, in any orientation.
            other.example = static_cast<std::uint8_t>(
                random.below(static_cast<std::uint32_t>(sources.size()), cell, draw));
            const Grid<float>& from = sources[other.example].heights;
            other.turn = static_cast<std::uint8_t>(matching_.turns[random.below(
                static_cast<std::uint32_t>(matching_.turns.size()), cell, draw + 1)]);
            other.x = static_cast<std::int16_t>(
                random.below(static_cast<std::uint32_t>(from.width() - kSide + 1), cell, draw + 2));
            other.y = static_cast<std::int16_t>(random.below(
                static_cast<std::uint32_t>(from.height() - kSide + 1), cell, draw + 3));
          } else {
            const int radius = std::max(1, 16 >> (n - 1));
            const auto span = static_cast<std::uint32_t>(2 * radius + 1);
            other.x = static_cast<std::int16_t>(other.x - radius +
                                                static_cast<int>(random.below(span, cell, draw)));
            other.y = static_cast<std::int16_t>(
                other.y - radius + static_cast<int>(random.below(span, cell, draw + 1)));
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
    takeQuery(heights, place(column, row), matching_.turns, query);
    HeightMatch best;
    best.cost = std::numeric_limits<float>::infinity();
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

/// Calls `body(column, row, i, j)` for each patch over a sample, which is sample (i, j) of it.
template <class Body>
void HeightField::forPatchesOver(int x, int y, const Body& body) const {
  const Over across = patchesOver(x, width_, xs_, matching_.wrapsX);
  const Over down = patchesOver(y, height_, ys_, matching_.wrapsY);
  for (int r = down.first; r < down.first + down.count; ++r) {
    const int row = r < 0 ? r + rows() : r;
    int j = y - ys_[static_cast<std::size_t>(row)];
    if (j < 0) j += height_;
    for (int c = across.first; c < across.first + across.count; ++c) {
      const int column = c < 0 ? c + columns() : c;
      int i = x - xs_[static_cast<std::size_t>(column)];
      if (i < 0) i += width_;
      body(column, row, i, j);
    }
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
  Grid<float> voted(width_, height_);
  parallelFor(0, static_cast<std::size_t>(height_), 8, [&](std::size_t y0, std::size_t y1) {
    for (std::size_t y = y0; y < y1; ++y) {
      progress.check();
      for (int x = 0; x < width_; ++x) {
        float sum = 0, weights = 0;
        forPatchesOver(x, static_cast<int>(y), [&](int column, int row, int i, int j) {
          const HeightMatch& match = matches_(column, row);
          const Grid<float>& from = sources[match.example].heights;
          const int k = tables().toExample[match.turn][static_cast<std::size_t>(j * kSide + i)];
          const float weight =
              kKernel[static_cast<std::size_t>(i)] * kKernel[static_cast<std::size_t>(j)];
          sum += weight *
                 (from[from.index(match.x + k % kSide, match.y + k / kSide)] + lift(column, row));
          weights += weight;
        });
        voted(x, static_cast<int>(y)) = sum / weights;
      }
    }
  });
  return voted;
}

Grid<HeightOrigin> HeightField::origins(const Progress& progress) const {
  Grid<HeightOrigin> origins(width_, height_);
  parallelFor(0, static_cast<std::size_t>(height_), 8, [&](std::size_t y0, std::size_t y1) {
    HeightOrigin found[kSamples];
    float weights[kSamples];
    for (std::size_t y = y0; y < y1; ++y) {
      progress.check();
      for (int x = 0; x < width_; ++x) {
        int count = 0;
        forPatchesOver(x, static_cast<int>(y), [&](int column, int row, int i, int j) {
          const HeightMatch& match = matches_(column, row);
          const int k = tables().toExample[match.turn][static_cast<std::size_t>(j * kSide + i)];
          const HeightOrigin origin{static_cast<std::int16_t>(match.x + k % kSide),
                                    static_cast<std::int16_t>(match.y + k / kSide), match.example,
                                    match.turn};
          const float weight =
              kKernel[static_cast<std::size_t>(i)] * kKernel[static_cast<std::size_t>(j)];
          for (int n = 0; n < count; ++n) {
            if (found[n] == origin) {
              weights[n] += weight;
              return;
            }
          }
          found[count] = origin;
          weights[count++] = weight;
        });
        int best = 0;
        for (int n = 1; n < count; ++n)
          if (weights[n] > weights[best]) best = n;
        origins(x, static_cast<int>(y)) = found[best];
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
