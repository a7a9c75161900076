// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/layered/assignment.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "core/parallel.h"
#include "synth/layered/auction.h"

namespace exemplar {
namespace {

/// So many nearest patches are candidates in one round.
constexpr std::size_t kCandidates = 8;

/// A patch and one that may serve it.
struct Pair {
  std::uint32_t patch;
  BoundaryMatch match;
  std::uint32_t order;  ///< drawn: among equals, lower first
};

/// Rounds: the cheapest pairs first, until every patch is served (figure 3).
std::vector<BoundaryMatch> assignGreedily(const BoundaryPatches& set,
                                          const BoundaryPatches& examples,
                                          std::vector<std::uint32_t> left, const Random& random,
                                          const Progress& progress) {
  const NearestPatches nearest(examples);
  std::vector<BoundaryMatch> served(set.count());
  std::vector<std::uint32_t> waiting(set.count());
  std::iota(waiting.begin(), waiting.end(), 0u);
  for (std::uint32_t round = 0; !waiting.empty(); ++round) {
    std::vector<std::vector<BoundaryMatch>> candidates(waiting.size());
    parallelFor(0, waiting.size(), 64, [&](std::size_t first, std::size_t last) {
      progress.check();
      for (std::size_t n = first; n < last; ++n)
        nearest.find(set, waiting[n], kCandidates, left, candidates[n]);
    });
    std::vector<Pair> pairs;
    for (std::size_t n = 0; n < waiting.size(); ++n) {
      for (const BoundaryMatch& match : candidates[n]) {
        const auto order =
            static_cast<std::uint32_t>(random.bits(waiting[n], round * 8191 + match.patch));
        pairs.push_back({waiting[n], match, order});
      }
    }
    std::ranges::sort(pairs, [](const Pair& a, const Pair& b) {
      if (a.match.distance != b.match.distance) return a.match.distance < b.match.distance;
      if (a.order != b.order) return a.order < b.order;
      return a.patch != b.patch ? a.patch < b.patch : a.match.patch < b.match.patch;
    });
    std::vector<std::uint8_t> done(set.count());
    for (const Pair& pair : pairs) {
      if (done[pair.patch] || left[pair.match.patch] == 0) continue;
      done[pair.patch] = 1;
      --left[pair.match.patch];
      served[pair.patch] = pair.match;
    }
    std::erase_if(waiting, [&](std::uint32_t patch) { return done[patch] != 0; });
  }
  return served;
}

/// The orientation in which a patch of the example is nearest to one of the set.
BoundaryMatch bestTurn(const BoundaryPatches& set, std::size_t s, const BoundaryPatches& examples,
                       std::size_t e) {
  int least = 1 << 30, turn = 0;
  for (int t = 0; t < examples.turns(); ++t) {
    const int distance = patchDistance(set, s, examples, e, t);
    if (distance >= least) continue;
    least = distance;
    turn = t;
  }
  return {static_cast<std::uint32_t>(e), static_cast<std::uint16_t>(turn),
          static_cast<std::uint16_t>(least)};
}

/// The distances of all of the set (rows) to all of the examples (columns).
Grid<std::uint16_t> distancesOf(const BoundaryPatches& set, const BoundaryPatches& examples,
                                const Progress& progress) {
  Grid<std::uint16_t> distances(static_cast<int>(examples.count()), static_cast<int>(set.count()));
  parallelFor(0, set.count(), 16, [&](std::size_t first, std::size_t last) {
    progress.check();
    for (std::size_t s = first; s < last; ++s)
      for (std::size_t e = 0; e < examples.count(); ++e)
        distances(static_cast<int>(e), static_cast<int>(s)) =
            bestTurn(set, s, examples, e).distance;
  });
  return distances;
}

/// Nothing where one patch of the example serves all, so that there is nothing to choose.
std::optional<std::vector<BoundaryMatch>> assignExactly(const BoundaryPatches& set,
                                                        const BoundaryPatches& examples,
                                                        const std::vector<std::uint32_t>& uses,
                                                        const Progress& progress) {
  const Grid<std::uint16_t> distances = distancesOf(set, examples, progress);
  const std::optional<std::vector<std::uint32_t>> columns =
      set.count() > kMostByPaths ? assignByAuction(distances, uses, progress)
                                 : assignByPaths(distances, uses, progress);
  if (!columns) return std::nullopt;
  std::vector<BoundaryMatch> served;
  for (std::size_t s = 0; s < set.count(); ++s)
    served.push_back(bestTurn(set, s, examples, (*columns)[s]));
  return served;
}

}  // namespace

std::vector<std::uint32_t> assignByPaths(const Grid<std::uint16_t>& costs,
                                         const std::vector<std::uint32_t>& uses,
                                         const Progress& progress) {
  // A column for each use of a patch.
  std::vector<std::uint32_t> columns;
  for (std::uint32_t e = 0; e < uses.size(); ++e) columns.insert(columns.end(), uses[e], e);
  const auto n = static_cast<std::size_t>(costs.height());
  constexpr int kFar = std::numeric_limits<int>::max() / 2;
  // Rows and columns count from 1; column 0 stands for the row that is being placed.
  std::vector<int> rowPotential(n + 1), columnPotential(n + 1);
  std::vector<std::size_t> rowOf(n + 1), cameFrom(n + 1);
  for (std::size_t row = 1; row <= n; ++row) {
    progress.check();
    rowOf[0] = row;
    std::vector<int> slack(n + 1, kFar);
    std::vector<std::uint8_t> reached(n + 1);
    std::size_t column = 0;
    do {
      reached[column] = 1;
      const std::size_t r = rowOf[column];
      int least = kFar;
      std::size_t next = 0;
      for (std::size_t c = 1; c <= n; ++c) {
        if (reached[c]) continue;
        const int reduced = costs(static_cast<int>(columns[c - 1]), static_cast<int>(r - 1)) -
                            rowPotential[r] - columnPotential[c];
        if (reduced < slack[c]) {
          slack[c] = reduced;
          cameFrom[c] = column;
        }
        if (slack[c] < least) {
          least = slack[c];
          next = c;
        }
      }
      for (std::size_t c = 0; c <= n; ++c) {
        if (reached[c]) {
          rowPotential[rowOf[c]] += least;
          columnPotential[c] -= least;
        } else {
          slack[c] -= least;
        }
      }
      column = next;
    } while (rowOf[column] != 0);
    for (; column != 0; column = cameFrom[column]) rowOf[column] = rowOf[cameFrom[column]];
  }
  std::vector<std::uint32_t> columnOf(n);
  for (std::size_t c = 1; c <= n; ++c) columnOf[rowOf[c] - 1] = columns[c - 1];
  return columnOf;
}

std::vector<std::uint32_t> fairUses(std::size_t wanted, std::size_t examples,
                                    const Random& random) {
  std::vector<std::uint32_t> uses(examples, static_cast<std::uint32_t>(wanted / examples));
  std::vector<std::size_t> order(examples);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t n = 0; n < wanted % examples; ++n) {
    const std::size_t other = n + random.below(static_cast<std::uint32_t>(examples - n), n);
    std::swap(order[n], order[other]);
    ++uses[order[n]];
  }
  return uses;
}

Assignment assignPatches(const BoundaryPatches& set, const BoundaryPatches& examples,
                         std::vector<std::uint32_t> uses, AssignmentKind kind, const Random& random,
                         const Progress& progress, std::size_t mostExactPairs) {
  if (set.count() * examples.count() > mostExactPairs) kind = AssignmentKind::Greedy;
  if (kind == AssignmentKind::Exact)
    if (auto exact = assignExactly(set, examples, uses, progress)) return {*std::move(exact), kind};
  return {assignGreedily(set, examples, std::move(uses), random, progress), kind};
}

}  // namespace exemplar
