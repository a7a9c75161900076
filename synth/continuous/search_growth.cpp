// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Searches in which what is built hangs together.

#include <algorithm>

#include "synth/continuous/search.h"

namespace exemplar::continuous {
namespace {

/// How often a place for a seed is drawn before what is undecided is gone through.
constexpr int kSeedDraws = 64;
/// Choices between two counts of what is built.
constexpr int kRecount = 64;

}  // namespace

Growth growthOf(const Puzzle& puzzle, std::optional<Substance> ground) {
  const auto built = [&](Substance s) { return s != kAir && s != ground; };
  Growth growth;
  growth.builtAt.resize(puzzle.classes.size());
  growth.builtAlong.resize(puzzle.classes.size());
  for (std::size_t k = 0; k < puzzle.classes.size(); ++k) {
    const VertexClass& c = puzzle.classes[k];
    if (c.labels() == 0) continue;
    growth.builtAlong[k].resize(c.central->rays.size());
    for (std::size_t l = 0; l < c.labels(); ++l) {
      growth.builtAt[k].push_back(std::ranges::any_of(c.cells(l), built));
      for (std::size_t r = 0; r < c.central->rays.size(); ++r) {
        growth.builtAlong[k][r].push_back(
            std::ranges::any_of(c.central->rays[r].around,
                                [&](std::uint32_t cell) { return built(c.cells(l)[cell]); }));
      }
    }
  }
  return growth;
}

Found Search::grow(const Growth& growth, const Random& random, std::int64_t budget,
                   const Progress& progress) {
  const std::size_t start = trailVertices_.size();
  const std::int64_t failuresAllowed = counts_.failures + budget;
  const Arrangement& a = puzzle_.arrangement;
  const auto isDecided = [&](std::uint32_t v) { return count(domains_[v]) == 1; };
  const auto labelOf = [&](std::uint32_t v) {
    std::size_t label = 0;
    forEach(domains_[v], [&](std::size_t l) { label = l; });
    return label;
  };
  // Undecided vertices next to something built, and some that were that before.
  std::vector<std::uint32_t> frontier;
  const auto isNext = [&](std::uint32_t v) {
    if (marks_.region[v] != region_ || isDecided(v)) return false;
    return std::ranges::any_of(a.ends(v), [&](const EdgeEnd& end) {
      return end.vertex != EdgeEnd::kNone && a.inside(end.vertex) && isDecided(end.vertex) &&
             growth.builtAlong[a.kind(end.vertex)][end.ray][labelOf(end.vertex)];
    });
  };
  const auto addNeighbors = [&](std::uint32_t v) {
    for (const EdgeEnd& end : a.ends(v))
      if (end.vertex != EdgeEnd::kNone && a.inside(end.vertex)) frontier.push_back(end.vertex);
  };
  const auto follow = [&](std::size_t from) {
    for (std::size_t n = from; n < trailVertices_.size(); ++n) {
      const std::uint32_t v = trailVertices_[n];
      if (isDecided(v) && growth.builtAt[a.kind(v)][labelOf(v)]) addNeighbors(v);
    }
  };
  // The label with the least of anything built, the background's where it may be.
  const auto emptiest = [&](std::uint32_t v) {
    const int background = puzzle_.background[v];
    if (background >= 0 && contains(domains_[v], static_cast<std::size_t>(background)))
      return static_cast<std::size_t>(background);
    std::size_t best = 0;
    std::ptrdiff_t least = -1;
    forEach(domains_[v], [&](std::size_t l) {
      const std::span<const Substance> cells = puzzle_.classOf(v).cells(l);
      const std::ptrdiff_t some =
          static_cast<std::ptrdiff_t>(cells.size()) - std::ranges::count(cells, kAir);
      if (least >= 0 && some >= least) return;
      least = some;
      best = l;
    });
    return best;
  };
  std::uint64_t draw = 0;
  int seeds = 0;
  double share = 0;
  std::size_t place = 0;
  for (const std::uint32_t v : vertices_)
    if (isDecided(v) && growth.builtAt[a.kind(v)][labelOf(v)]) addNeighbors(v);
  while (true) {
    progress.check();
    if (counts_.choices % kRecount == 0) {
      const auto built = std::ranges::count_if(vertices_, [&](std::uint32_t v) {
        return isDecided(v) && growth.builtAt[a.kind(v)][labelOf(v)];
      });
      share = static_cast<double>(built) /
              static_cast<double>(std::max<std::size_t>(1, vertices_.size()));
      progress.report("growing", std::min(1.0, share / std::max(1e-9, growth.share)));
    }
    Choice choice{0, 0, trailVertices_.size(), EdgeEnd::kNone};
    while (!frontier.empty() && choice.vertex == EdgeEnd::kNone) {
      const std::uint32_t n = random.below(static_cast<std::uint32_t>(frontier.size()), draw++, 1);
      std::swap(frontier[n], frontier.back());
      if (isNext(frontier.back())) choice.vertex = frontier.back();
      frontier.pop_back();
    }
    if (choice.vertex != EdgeEnd::kNone) {
      choice.label = share < growth.share ? choose(choice.vertex, random) : emptiest(choice.vertex);
    } else if (seeds < growth.seeds && share < growth.share) {
      for (int n = 0; n < kSeedDraws && choice.vertex == EdgeEnd::kNone; ++n) {
        const std::uint32_t v =
            vertices_[random.below(static_cast<std::uint32_t>(vertices_.size()), draw++, 2)];
        if (isDecided(v)) continue;
        std::vector<std::size_t> labels;
        forEach(domains_[v], [&](std::size_t l) {
          if (growth.builtAt[a.kind(v)][l] && weight(v, puzzle_.classOf(v).figures[l]) > 0)
            labels.push_back(l);
        });
        if (labels.empty()) continue;
        choice.vertex = v;
        choice.label = labels[random.below(static_cast<std::uint32_t>(labels.size()), draw++, 3)];
        choice.seed = true;
      }
      ++seeds;
      if (choice.vertex == EdgeEnd::kNone) continue;
    } else {
      while (place < vertices_.size() && isDecided(vertices_[place])) ++place;
      if (place == vertices_.size()) return Found::All;
      choice.vertex = vertices_[place];
      choice.label = emptiest(choice.vertex);
    }
    const std::size_t from = trailVertices_.size();
    if (assign(choice)) {
      follow(from);
      continue;
    }
    const std::size_t before = choices_.size();
    std::vector<std::uint32_t> undone(trailVertices_.begin() + static_cast<std::ptrdiff_t>(start),
                                      trailVertices_.end());
    std::vector<std::uint8_t> wasSeed;
    for (const Choice& c : choices_) wasSeed.push_back(c.seed);
    if (const std::optional<Found> end = backtrack(failuresAllowed, start)) return *end;
    for (std::size_t n = choices_.size(); n < before; ++n) seeds -= wasSeed[n];
    const std::size_t kept = choices_.empty() ? start : choices_.back().trail;
    frontier.insert(
        frontier.end(),
        undone.begin() + static_cast<std::ptrdiff_t>(std::min(kept - start, undone.size())),
        undone.end());
    follow(std::min(kept, trailVertices_.size()));
    place = 0;
  }
}

}  // namespace exemplar::continuous
