// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/random.h"
#include "synth/model/problem.h"
#include "synth/model/resemblance.h"

namespace exemplar {

/// Picks labels at random with the weights that a request gives them: frequency in the example (or
/// one for all), times the user's weights and maps (thesis, section 3.5.3).
class LabelChooser {
 public:
  LabelChooser(const ModelProblem& problem, std::span<const LabelGrid> examples);

  /// One of `labels` (at least one) for a cell of the problem's network. Each (cell, draw) is a
  /// choice of its own.
  int choose(int cell, std::span<const LabelWord> labels, std::uint32_t draw) const;

  /// The label in place at a cell of the network, or -1.
  using Placed = std::function<int(int cell)>;
  /// The same, weighted by resemblance where the request asks for it.
  int choose(int cell, std::span<const LabelWord> labels, std::uint32_t draw,
             const Placed& placed) const;

 private:
  const ModelProblem* problem_;
  Random random_;
  std::vector<double> weights_, frequencies_;
  bool varies_;
  std::unique_ptr<Resemblance> resemblance_;
};

}  // namespace exemplar
