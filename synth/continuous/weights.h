// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "core/random.h"
#include "synth/continuous/search.h"

/// How likely each figure is chosen. The papers choose among all with equal probability, which
/// crowds the result; here it is as full as the example.
namespace exemplar::continuous {

/// Classes of figures whose shares of a result's vertices are held near the example's.
enum class FigureClass {
  Empty,   ///< air, bare ground, and what is below
  Within,  ///< within any other substance
  Face,    ///< on a face
  Edge,    ///< on a straight edge
  Corner,
};
inline constexpr int kFigureClasses = 5;
/// "empty", "within", "face", "edge", "corner".
const char* figureClassName(FigureClass figureClass);

using Shares = std::array<double, kFigureClasses>;

std::vector<FigureClass> classify(const Centrals& centrals, const FigureSet& figures,
                                  const std::optional<Ground>& ground);

/// Shares of classes among vertices, by how often each figure is there.
Shares sharesOf(std::span<const FigureClass> classes, std::span<const double> counts);

/// The largest factor between two results' shares of a class that both should have; 1 is equal.
/// Shares below half a percent count less; a class that should not be there, from two percent on.
double largestFactor(const Shares& shares, const Shares& wanted);

/// Weights of figures: how often each is in the example, times a factor for each class that is
/// adapted until results have the example's shares.
class ClassWeights {
 public:
  /// `density` is of all classes but the empty one, in shares of the example's, > 0; `objectSize`
  /// is how large solids are, in sizes of the example's, > 0: the larger, the fewer corners, edges
  /// and faces are around as much.
  ClassWeights(std::span<const FigureClass> classes, std::span<const double> counts, double density,
               double objectSize);

  std::vector<double> weights() const;
  /// How far a result's shares are from those that are wanted (`largestFactor`).
  double distance(const Shares& shares) const { return largestFactor(shares, wanted_); }
  /// Classes of which a result has too little become likelier. `vertices` is how many it has.
  void adapt(const Shares& shares, std::size_t vertices);
  /// Classes as the example has them, with nothing learned.
  void forget();

 private:
  std::span<const FigureClass> classes_;
  std::span<const double> counts_;
  double density_;
  Shares wanted_{}, factors_{};
};

struct LearnOptions {
  int rounds = 8;  ///< of trial results, >= 0
  /// Where given, trial results lose what is not joined to this ground (`removeFloating`).
  std::optional<Substance> ground;
  const Growth* growth = nullptr;  ///< where given, trial results are grown
};

/// Adapts weights in trial results of a puzzle. `consistent` are the puzzle's domains, arc
/// consistent. The trials are results of other seeds. Throws `Cancelled`.
void learnWeights(ClassWeights& weights, const Puzzle& puzzle, const Domains& consistent,
                  std::span<const std::uint32_t> vertices, std::span<const FigureClass> classes,
                  const Random& random, const LearnOptions& options, const Progress& progress = {});

/// Shares of classes among some vertices of a solved puzzle.
Shares sharesIn(const Puzzle& puzzle, const Domains& solved,
                std::span<const std::uint32_t> vertices, std::span<const FigureClass> classes);

}  // namespace exemplar::continuous
