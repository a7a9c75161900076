// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "synth/continuous/grounding.h"

namespace exemplar::continuous {
namespace {

/// What figures that the example's own planes do not show count as.
constexpr double kUnseen = 0.5;
/// Shares near this one and below count less when results are compared: they vary by chance.
constexpr double kSmallShare = 0.005;
/// The share of a class that the example's own planes do not show at all (no vertex is in the
/// middle of a face, say), above which it is held back.
constexpr double kUnseenShare = 0.02;
/// Trial results of a round, whose shares are averaged: a large one varies less by chance.
constexpr int kTrials = 2;
constexpr std::size_t kLargeTrial = 20'000;  // vertices, of which one is enough
/// Failures of a trial that is grown: one that goes on for long says nothing.
constexpr std::int64_t kGrownTrial = 60;
/// Shares that are this near to those wanted need no further round.
constexpr double kLearned = 1.2;

bool isEmpty(const Figure& figure, const std::optional<Ground>& ground) {
  if (figure == Figure{0, {kAir}}) return true;
  if (!ground) return false;
  return figure == Figure{0, {ground->substance}} ||
         (__builtin_popcount(figure.support) == 1 &&
          figure.substances == std::vector<Substance>{ground->substance, kAir});
}

}  // namespace

const char* figureClassName(FigureClass figureClass) {
  constexpr const char* names[] = {"empty", "within", "face", "edge", "corner"};
  return names[static_cast<int>(figureClass)];
}

std::vector<FigureClass> classify(const Centrals& centrals, const FigureSet& figures,
                                  const std::optional<Ground>& ground) {
  std::vector<FigureClass> classes;
  for (const Figure& figure : figures.all()) {
    constexpr FigureClass ofRank[] = {FigureClass::Within, FigureClass::Face, FigureClass::Edge,
                                      FigureClass::Corner};
    classes.push_back(isEmpty(figure, ground) ? FigureClass::Empty
                                              : ofRank[centrals.of(figure.support).rank]);
  }
  return classes;
}

Shares sharesOf(std::span<const FigureClass> classes, std::span<const double> counts) {
  Shares shares{};
  double all = 0;
  for (std::size_t f = 0; f < counts.size(); ++f) {
    shares[static_cast<std::size_t>(classes[f])] += counts[f];
    all += counts[f];
  }
  for (double& share : shares) share /= std::max(all, 1.0);
  return shares;
}

double largestFactor(const Shares& shares, const Shares& wanted) {
  double largest = 1;
  for (int c = 0; c < kFigureClasses; ++c) {
    const double share = wanted[c] > 0 ? wanted[c] : kUnseenShare;
    const double factor = (shares[c] + kSmallShare) / (share + kSmallShare);
    largest = std::max(largest, factor);
    if (wanted[c] > 0) largest = std::max(largest, 1 / factor);
  }
  return largest;
}

Shares sharesIn(const Puzzle& puzzle, const Domains& solved,
                std::span<const std::uint32_t> vertices, std::span<const FigureClass> classes) {
  Shares shares{};
  for (const std::uint32_t v : vertices) {
    const std::uint32_t figure = puzzle.classOf(v).figures[lowest(solved[v])];
    shares[static_cast<std::size_t>(classes[figure])] += 1;
  }
  for (double& share : shares)
    share /= static_cast<double>(std::max<std::size_t>(1, vertices.size()));
  return shares;
}

ClassWeights::ClassWeights(std::span<const FigureClass> classes, std::span<const double> counts,
                           double density, double objectSize)
    : classes_(classes), counts_(counts), density_(density), wanted_(sharesOf(classes, counts)) {
  factors_.fill(1);
  // n times as large, a solid has n^3 times what is within, n^2 faces, n edges and as many corners.
  double before = 0, after = 0;
  for (int c = 1; c < kFigureClasses; ++c) {
    before += wanted_[c];
    wanted_[c] *= std::pow(objectSize, 1 - c);
    after += wanted_[c];
  }
  double full = 0;
  for (int c = 1; c < kFigureClasses; ++c)
    full += wanted_[c] *= density * (after > 0 ? before / after : 1);
  wanted_[0] = std::max(0.0, 1 - full);
}

std::vector<double> ClassWeights::weights() const {
  std::vector<double> weights;
  for (std::size_t f = 0; f < counts_.size(); ++f)
    weights.push_back((counts_[f] + kUnseen) * factors_[static_cast<std::size_t>(classes_[f])]);
  return weights;
}

void ClassWeights::adapt(const Shares& shares, std::size_t vertices) {
  // A class that is not there at all counts as a quarter of a vertex.
  const double least = 0.25 / static_cast<double>(vertices);
  for (int c = 0; c < kFigureClasses; ++c) {
    const double share = wanted_[c] > 0 ? wanted_[c] : kUnseenShare;
    const double step = std::pow(share / std::max(shares[c], least), 0.6);
    factors_[c] *= std::clamp(step, 0.3, 3.0);
    if (wanted_[c] <= 0) factors_[c] = std::min(factors_[c], 1.0);
  }
}

void ClassWeights::forget() { std::fill(factors_.begin() + 1, factors_.end(), density_); }

void learnWeights(ClassWeights& weights, const Puzzle& puzzle, const Domains& consistent,
                  std::span<const std::uint32_t> vertices, std::span<const FigureClass> classes,
                  const Random& random, const LearnOptions& options, const Progress& progress) {
  ClassWeights best = weights;
  double nearest = std::numeric_limits<double>::infinity();
  Domains domains = consistent;
  std::vector<double> current = weights.weights();
  Search::Marks marks(puzzle);
  Search search(puzzle, current, domains, marks);
  if (!search.begin(vertices, 1)) return;
  const int trials = vertices.size() > kLargeTrial ? 1 : kTrials;
  const auto budget =
      options.growth ? kGrownTrial : 100 + static_cast<std::int64_t>(vertices.size()) / 50;
  std::optional<Domains> grounded;
  for (int round = 0; round < options.rounds && nearest > kLearned; ++round) {
    progress.report("learning weights", static_cast<double>(round) / options.rounds);
    std::ranges::copy(weights.weights(), current.begin());
    Shares shares{};
    int succeeded = 0;
    for (int trial = 0; trial < trials; ++trial) {
      search.again();
      const Random draws = random.fork(500 + static_cast<std::uint64_t>(round * trials + trial));
      const Found found =
          options.growth ? search.grow(*options.growth, draws, budget) : search.run(draws, budget);
      if (found != Found::All) continue;
      ++succeeded;
      if (options.ground) {
        grounded = domains;
        removeFloating(puzzle, consistent, vertices, *options.ground, *grounded);
      }
      const Shares made = sharesIn(puzzle, grounded ? *grounded : domains, vertices, classes);
      for (int c = 0; c < kFigureClasses; ++c) shares[c] += made[c];
    }
    if (succeeded == 0) continue;
    for (double& share : shares) share /= succeeded;
    if (const double distance = weights.distance(shares); distance < nearest) {
      nearest = distance;
      best = weights;
    }
    weights.adapt(shares, vertices.size());
  }
  weights = best;
}

}  // namespace exemplar::continuous
