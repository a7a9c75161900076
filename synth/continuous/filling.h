// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "synth/continuous/arrangement.h"
#include "synth/continuous/polygons.h"
#include "synth/continuous/search.h"
#include "synth/continuous/solids.h"

/// What an arrangement's cells are filled with.
namespace exemplar::continuous {

/// Tables of substances, each kept once.
class Tables {
 public:
  const Substance* add(std::uint32_t kind, std::vector<Substance> table) {
    return kept_.emplace(kind, std::move(table)).first->second.data();
  }

 private:
  std::set<std::pair<std::uint32_t, std::vector<Substance>>> kept_;
};

/// The example itself; beyond the box there is air.
class SolidsFilling final : public Filling {
 public:
  SolidsFilling(const Arrangement& arrangement, const Solids& solids,
                const Progress& progress = {});
  const Substance* cells(std::uint32_t vertex) const override { return cells_[vertex]; }

 private:
  Tables tables_;
  std::vector<const Substance*> cells_;
};

/// A solved puzzle: what its labels say, and on the sides of the box the background.
class LabelFilling final : public Filling {
 public:
  LabelFilling(const Puzzle& puzzle, const Domains& solved, const std::optional<Ground>& ground);
  const Substance* cells(std::uint32_t vertex) const override { return cells_[vertex]; }

 private:
  Tables tables_;
  std::vector<const Substance*> cells_;
};

/// What of a filling is within a box whose sides are planes of the arrangement, or beyond it; air
/// elsewhere.
class CroppedFilling final : public Filling {
 public:
  CroppedFilling(const Arrangement& arrangement, const Filling& whole, const ExactBox& box);
  const Substance* cells(std::uint32_t vertex) const override { return cells_[vertex]; }

 private:
  Tables tables_;
  std::vector<const Substance*> cells_;
};

/// The figure at each inner vertex of a filling, or `FigureSet::kNone` where it is none of them.
std::vector<std::uint32_t> figuresOf(const Arrangement& arrangement, const Filling& filling,
                                     const FigureSet& figures);

}  // namespace exemplar::continuous
