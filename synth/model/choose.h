// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/random.h"
#include "synth/model/problem.h"
#include "synth/model/resemblance.h"

namespace exemplar {

/// Picks labels at random with the weights that a request gives them: frequency in the example
/// (beside the labels in place, all over, or where the surroundings are alike; or one for all),
/// times the user's weights and maps (thesis, section 3.5.3).
class LabelChooser {
 public:
  LabelChooser(const ModelProblem& problem, std::span<const LabelGrid> examples,
               const Progress& progress = {});

  /// Random numbers to choose with, for each purpose its own: what is tried again there draws from
  /// a fork for each attempt (`core/random.h`).
  enum class Purpose : std::uint64_t { Repairs, Blocks, Limits, Start };
  Random numbersFor(Purpose purpose) const {
    return random_.fork(static_cast<std::uint64_t>(purpose));
  }
  /// The numbers of the one pass over the whole grid, in which every cell is decided once.
  const Random& numbersForPass() const { return random_; }

  /// One of `labels` (at least one) for a cell of the problem's network. Each (cell, draw) is a
  /// choice of its own. What is around the cell does not count.
  int choose(const Random& random, int cell, std::span<const LabelWord> labels, int draw) const;

  /// The label in place at a cell of the network, or -1.
  using Placed = std::function<int(int cell)>;
  /// The same, weighted by what is around the cell where the request asks for it.
  int choose(const Random& random, int cell, std::span<const LabelWord> labels, int draw,
             const Placed& placed) const;

  /// Of a set of labels for a cell the one that is most frequent in the examples at the cell's
  /// height, the first of several; -1 where the set is empty. Heights count from the bottom; above
  /// the examples' uppermost layer it goes on. Of labels that no example shows at that height the
  /// one that is most frequent at all, and all heights are alike where neither bottom nor top has a
  /// rule, or the result tiles along z.
  int mostFrequent(int cell, std::span<const LabelWord> labels) const;

 private:
  /// How often a label has the neighbor in question, of all the times that it has one there.
  struct Share {
    std::int32_t label;
    float share;
  };
  /// A label with its neighbors at -x, -y and -z, those that count, and how often the examples show
  /// that: labels of 16 bits, the neighbors' first.
  struct Place {
    std::uint64_t labels;
    double count;
  };

  void countHeights(std::span<const LabelGrid> examples);
  void countShares();
  void countPlaces(std::span<const LabelGrid> examples, const Progress& progress);
  void weighByNeighbors(int cell, std::span<const LabelWord> labels, const Placed& placed,
                        std::vector<double>& weights) const;

  const ModelProblem* problem_;
  Random random_;
  std::vector<double> own_, frequencies_, weights_;  // the user's; theirs times frequencies
  std::vector<std::vector<double>> atHeight_;        // how often each label is there
  bool varies_, neighbors_;
  std::vector<std::vector<std::int64_t>> shareBegin_;  // of each slot: of each neighbor's label
  std::vector<std::vector<Share>> shares_;
  std::array<std::vector<Place>, 8> places_;  // by which of the three neighbors count, as bits
  std::unique_ptr<Resemblance> resemblance_;
};

}  // namespace exemplar
