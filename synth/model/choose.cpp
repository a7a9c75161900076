// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/choose.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kLabelStream = 0x4C424C31;  // the choice of labels

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

LabelChooser::LabelChooser(const ModelProblem& problem, std::span<const LabelGrid> examples)
    : problem_(&problem),
      random_(problem.options().seed, kLabelStream),
      varies_(problem.weightVaries() && !problem.options().metropolis) {
  const ModelOptions& o = problem.options();
  for (int b = 0; b < problem.network().labels; ++b) {
    frequencies_.push_back(o.choice == LabelChoice::Frequency
                               ? static_cast<double>(problem.adjacency().frequency[b])
                               : 1.0);
    weights_.push_back(frequencies_[b] * (o.weights.empty() || o.metropolis ? 1.0 : o.weights[b]));
  }
  if (o.choice == LabelChoice::Resemblance) {
    resemblance_ = std::make_unique<Resemblance>(problem, examples);
  }
}

int LabelChooser::choose(int cell, std::span<const LabelWord> labels, std::uint32_t draw) const {
  const double uniform = random_.uniform(static_cast<std::uint64_t>(cell), draw);
  if (!varies_) return pick(labels, uniform, [&](int b) { return weights_[b]; });
  return pick(labels, uniform, [&](int b) { return frequencies_[b] * problem_->weight(cell, b); });
}

int LabelChooser::choose(int cell, std::span<const LabelWord> labels, std::uint32_t draw,
                         const Placed& placed) const {
  if (!resemblance_) return choose(cell, labels, draw);
  const std::vector<double> likeness = resemblance_->likeness(cell, labels, placed);
  const double uniform = random_.uniform(static_cast<std::uint64_t>(cell), draw);
  return pick(labels, uniform, [&](int b) {
    return likeness[b] * (varies_ ? problem_->weight(cell, b) : weights_[b]);
  });
}

}  // namespace exemplar
