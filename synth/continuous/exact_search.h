// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/outcome.h"
#include "core/progress.h"
#include "synth/continuous/search.h"

namespace exemplar::continuous {

/// Labels vertices by a SAT solver (Biere, Fazekas, Fleury, Heisinger: "CaDiCaL, Kissat, Paracooba,
/// Plingeling and Treengeling entering the SAT competition 2020"), where choices and backtracking
/// do not decide.
///
/// A vertex with several labels has a variable for each, an edge one for each edge label that both
/// ends may give it. A label implies its edge labels, an edge label one of the labels with it at
/// each end, and an edge has at most one. Labels of one vertex differ in some edge label, so they
/// exclude each other. Unit propagation is then arc consistency. Deterministic.
class ExactSearch {
 public:
  /// `domains` are those of `vertices` (ascending), arc consistent with what is around them. Throws
  /// `Cancelled`.
  ExactSearch(const Puzzle& puzzle, const Domains& domains, std::span<const std::uint32_t> vertices,
              const Progress& progress = {});
  ~ExactSearch();
  ExactSearch(const ExactSearch&) = delete;
  ExactSearch& operator=(const ExactSearch&) = delete;

  /// Has the solver try a label first.
  void prefer(std::uint32_t vertex, std::size_t label);
  /// A demand that can be switched on: while it is, vertices take one of some labels.
  int newDemand();
  void addToDemand(int demand, std::uint32_t vertex, std::span<const Word> labels);

  /// Solves with demands switched on: Complete, Impossible, or Unfinished after `conflicts`
  /// conflicts. Throws `Cancelled` within a fraction of a second.
  Outcome solve(std::span<const int> demands, std::int64_t conflicts,
                const Progress& progress = {});
  /// After Complete: leaves one label in each of the vertices' domains.
  void take(Domains& domains) const;
  /// After Impossible: whether the proof made use of a demand.
  bool used(int demand) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace exemplar::continuous
