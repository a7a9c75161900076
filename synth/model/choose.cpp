// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/choose.h"

#include <algorithm>
#include <bit>

#include "core/cells.h"

namespace exemplar {
namespace {

/// How much a label counts that the examples show beside each of the neighbors, but not beside all.
constexpr double kUnseen = 0.01;
constexpr std::uint64_t kAnyLabel = 0xFFFF;

double uniformOf(const Random& random, int cell, int draw) {
  return random.uniform(static_cast<std::uint64_t>(cell), static_cast<std::uint32_t>(draw));
}

/// One of `labels` with chances in proportion to `weight(label)`, for `uniform` in [0, 1).
template <class Weight>
int pick(std::span<const LabelWord> labels, double uniform, const Weight& weight) {
  double total = 0;
  forEachLabel(labels, [&](int b) { total += weight(b); });
  double rest = uniform * total;
  int chosen = -1;
  bool found = false;
  forEachLabel(labels, [&](int b) {
    if (found) return;
    chosen = b;
    rest -= weight(b);
    found = rest < 0;
  });
  return chosen;
}

}  // namespace

LabelChooser::LabelChooser(const ModelProblem& problem, std::span<const LabelGrid> examples,
                           const Progress& progress)
    : problem_(&problem),
      random_(problem.options().seed, stream::kLabelChoice),
      varies_(problem.weightVaries() && !problem.options().metropolis),
      neighbors_(problem.options().choice == LabelChoice::Neighbors) {
  const ModelOptions& o = problem.options();
  for (int b = 0; b < problem.network().labels; ++b) {
    const bool frequent = o.choice == LabelChoice::Frequency || neighbors_;
    frequencies_.push_back(frequent ? static_cast<double>(problem.adjacency().frequency[b]) : 1.0);
    own_.push_back(o.weights.empty() || o.metropolis ? 1.0 : o.weights[b]);
    weights_.push_back(frequencies_[b] * own_[b]);
  }
  countHeights(examples);
  if (neighbors_) {
    countShares();
    countPlaces(examples, progress);
  }
  if (o.choice == LabelChoice::Resemblance) {
    resemblance_ = std::make_unique<Resemblance>(problem, examples, progress);
  }
}

void LabelChooser::countHeights(std::span<const LabelGrid> examples) {
  // All that they are at any height decides only between labels that are not there.
  std::vector<double> anywhere(problem_->adjacency().frequency.begin(),
                               problem_->adjacency().frequency.end());
  double all = 1;
  for (const double count : anywhere) all += count;
  for (double& count : anywhere) count /= all;
  int layers = 1;
  if (problem_->heightsDiffer())
    for (const LabelGrid& e : examples) layers = std::max(layers, e.size().z);
  atHeight_.assign(static_cast<std::size_t>(layers), anywhere);
  if (layers == 1) return;
  for (const LabelGrid& e : examples)
    forEachCell(e.size(), [&](const Vec3i& p) { ++atHeight_[p.z][e.cells[p]]; });
}

void LabelChooser::countShares() {
  const int labels = problem_->network().labels;
  for (const PairRule& rule : problem_->adjacency().rules) {
    for (const bool against : {false, true}) {
      std::vector<double> all(labels, 0);  // neighbors that a label has in this direction
      std::vector<std::int64_t> begin(static_cast<std::size_t>(labels) + 1, 0);
      for (const LabelPair& p : rule.pairs) {
        all[against ? p.second : p.first] += static_cast<double>(p.count);
        ++begin[(against ? p.first : p.second) + 1];
      }
      for (int b = 0; b < labels; ++b) begin[b + 1] += begin[b];
      std::vector<Share> shares(rule.pairs.size());
      std::vector<std::int64_t> next(begin.begin(), begin.end() - 1);
      for (const LabelPair& p : rule.pairs) {
        const Label label = against ? p.second : p.first, beside = against ? p.first : p.second;
        shares[next[beside]++] = {label,
                                  static_cast<float>(static_cast<double>(p.count) / all[label])};
      }
      shareBegin_.push_back(std::move(begin));
      shares_.push_back(std::move(shares));
    }
  }
}

void LabelChooser::countPlaces(std::span<const LabelGrid> examples, const Progress& progress) {
  for (int which = 0; which < 8; ++which) {
    if (std::popcount(static_cast<unsigned>(which)) < 2) continue;  // single ones are in `shares_`
    std::vector<std::uint64_t> found;
    for (const LabelGrid& e : examples) {
      forEachCell(e.size(), [&](const Vec3i& p) {
        if (p.x == 0 && p.y == 0) progress.check();
        std::uint64_t labels = e.cells[p];
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis) {
          Vec3i q = p;
          --q[axis];
          const bool counts = which >> axis & 1;
          inside = inside && (!counts || q[axis] >= 0);
          labels |= (counts && inside ? e.cells[q] : kAnyLabel) << (16 * (axis + 1));
        }
        if (inside) found.push_back(labels);
      });
    }
    std::sort(found.begin(), found.end());
    for (std::size_t i = 0; i < found.size();) {
      std::size_t end = i;
      while (end < found.size() && found[end] == found[i]) ++end;
      places_[which].push_back({found[i], static_cast<double>(end - i)});
      i = end;
    }
  }
}

/// Multiplies the weight of each label by how often it occurs beside the neighbors at -x, -y and -z
/// that are in place; where the examples do not show that, by its frequency and each of these
/// neighbors by itself, P(b) times P(a | b). Neighbors on the other sides, further away, and in
/// other frames always count by themselves.
void LabelChooser::weighByNeighbors(int cell, std::span<const LabelWord> labels,
                                    const Placed& placed, std::vector<double>& weights) const {
  const LabelNetwork& network = problem_->network();
  const auto near = network.neighbors(cell);
  std::array<std::uint64_t, 3> before{kAnyLabel, kAnyLabel, kAnyLabel};
  int known = 0;
  // By themselves: directions that only a symmetry adds have no counts.
  std::vector<double> single(weights.size(), 1.0);
  forEachLabel(labels,
               [&](int b) { single[b] = static_cast<double>(problem_->adjacency().frequency[b]); });
  const auto multiply = [&](std::size_t slot, int beside, std::vector<double>& by) {
    const auto& begin = shareBegin_[slot];
    for (std::int64_t i = begin[beside]; i < begin[beside + 1]; ++i) {
      const Share& share = shares_[slot][i];
      if (containsLabel(labels, share.label)) by[share.label] *= share.share;
    }
  };
  for (std::size_t s = 0; s < shares_.size(); ++s) {
    if (near[s] == network.cells || near[s] == cell) continue;
    const int beside = placed(near[s]);
    if (beside < 0) continue;
    if (s < 6 && s % 2 == 1) {
      before[s / 2] = static_cast<std::uint64_t>(beside);
      known |= 1 << (s / 2);
      multiply(s, beside, single);
    } else {
      multiply(s, beside, weights);
    }
  }
  if (std::popcount(static_cast<unsigned>(known)) < 2) {
    forEachLabel(labels, [&](int b) { weights[b] *= single[b]; });
    return;
  }
  forEachLabel(labels, [&](int b) { single[b] *= kUnseen; });
  std::uint64_t labelsBefore = 0;
  for (int axis = 0; axis < 3; ++axis) labelsBefore |= before[axis] << (16 * (axis + 1));
  const auto& places = places_[known];
  auto place = std::lower_bound(places.begin(), places.end(), labelsBefore,
                                [](const Place& p, std::uint64_t key) { return p.labels < key; });
  for (; place != places.end() && (place->labels & ~kAnyLabel) == labelsBefore; ++place) {
    const int b = static_cast<int>(place->labels & kAnyLabel);
    if (containsLabel(labels, b)) single[b] += place->count;
  }
  forEachLabel(labels, [&](int b) { weights[b] *= single[b]; });
}

int LabelChooser::choose(const Random& random, int cell, std::span<const LabelWord> labels,
                         int draw) const {
  const double uniform = uniformOf(random, cell, draw);
  if (!varies_) return pick(labels, uniform, [&](int b) { return weights_[b]; });
  return pick(labels, uniform, [&](int b) { return frequencies_[b] * problem_->weight(cell, b); });
}

int LabelChooser::choose(const Random& random, int cell, std::span<const LabelWord> labels,
                         int draw, const Placed& placed) const {
  if (neighbors_) {
    std::vector<double> likely(weights_.size());
    forEachLabel(labels, [&](int b) { likely[b] = varies_ ? problem_->weight(cell, b) : own_[b]; });
    weighByNeighbors(cell, labels, placed, likely);
    const double uniform = uniformOf(random, cell, draw);
    return pick(labels, uniform, [&](int b) { return likely[b]; });
  }
  if (!resemblance_) return choose(random, cell, labels, draw);
  const std::vector<double> likeness = resemblance_->likeness(cell, labels, placed);
  const double uniform = uniformOf(random, cell, draw);
  return pick(labels, uniform, [&](int b) {
    return likeness[b] * (varies_ ? problem_->weight(cell, b) : weights_[b]);
  });
}

int LabelChooser::mostFrequent(int cell, std::span<const LabelWord> labels) const {
  const int z = problem_->cellAt(problem_->positionOf(cell)).z;
  const std::vector<double>& often = atHeight_[std::min<std::size_t>(z, atHeight_.size() - 1)];
  int best = -1;
  forEachLabel(labels, [&](int b) {
    if (best < 0 || often[b] > often[best]) best = b;
  });
  return best;
}

}  // namespace exemplar
