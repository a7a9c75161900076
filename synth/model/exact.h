// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/outcome.h"
#include "core/progress.h"
#include "synth/model/network.h"

namespace exemplar {

/// Labels a network exactly, by a SAT solver (Biere, Fazekas, Fleury, Heisinger: "CaDiCaL,
/// Kissat, Paracooba, Plingeling and Treengeling entering the SAT competition 2020").
///
/// A cell with several labels has a variable for each and exactly one of them true; a label implies
/// one of those that support it at each neighbor (the support encoding of Gent, "Arc consistency in
/// SAT", ECAI 2002), so that the solver's unit propagation is at least as strong as arc
/// consistency. Labels that allow the same at a neighbor share the clause. Deterministic.
class ExactSolver {
 public:
  /// `domains` holds the labels possible at each cell, none of them empty. Throws `Cancelled`.
  ExactSolver(const LabelNetwork& network, const LabelSets& domains, const Progress& progress = {});
  ~ExactSolver();
  ExactSolver(const ExactSolver&) = delete;
  ExactSolver& operator=(const ExactSolver&) = delete;

  /// Has the solver try `label` first at `cell`.
  void prefer(int cell, int label);

  /// A demand that can be switched on: while it is, `cell` takes one of `labels`. Returns its
  /// number; several restrictions may belong to one demand (give it again).
  int newDemand();
  void addToDemand(int demand, int cell, std::span<const LabelWord> labels);

  /// Demands that one of the (cell, label) of `some` holds, or that one of `orNot` does not.
  void demandOne(std::span<const std::pair<int, int>> some,
                 std::span<const std::pair<int, int>> orNot);

  /// Solves with the demands switched on: Complete, or Impossible, or Unfinished after `conflicts`
  /// conflicts or `steps` of `steps()`, whichever comes first.
  ///
  /// Asks whether to stop between decisions, and throws `Cancelled`. While it simplifies clauses
  /// it asks more rarely: so `Cancelled` comes within about 0.2 s of CPU for each million
  /// literals, all in all.
  Outcome solve(std::span<const int> demands, std::int64_t conflicts, const Progress& progress = {},
                std::int64_t steps = std::numeric_limits<std::int64_t>::max());

  /// What it took so far, the same on every machine: the literals of all clauses, and how often
  /// the solver looked up from deciding and propagating, some 10 to 60 microseconds apart.
  std::int64_t literals() const;
  std::int64_t steps() const;
  /// After Complete: the label of a cell.
  int label(int cell) const;
  /// After Impossible: whether the proof made use of a demand.
  bool used(int demand) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace exemplar
