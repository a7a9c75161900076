// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/choose.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kLabelStream = 0x4C424C31;  // the choice of labels

}  // namespace

LabelChooser::LabelChooser(const ModelProblem& problem)
    : problem_(&problem),
      random_(problem.options().seed, kLabelStream),
      varies_(problem.weightVaries()) {
  const ModelOptions& o = problem.options();
  for (int b = 0; b < problem.network().labels; ++b) {
    const double frequency = o.choice == LabelChoice::Uniform
                                 ? 1.0
                                 : static_cast<double>(problem.adjacency().frequency[b]);
    weights_.push_back(frequency * (o.weights.empty() ? 1.0 : o.weights[b]));
  }
}

int LabelChooser::choose(int cell, std::span<const LabelWord> labels, std::uint32_t draw) const {
  const auto weight = [&](int b) {
    if (!varies_) return weights_[b];
    const double frequency = problem_->options().choice == LabelChoice::Uniform
                                 ? 1.0
                                 : static_cast<double>(problem_->adjacency().frequency[b]);
    return frequency * problem_->weight(cell, b);
  };
  double total = 0;
  forEachLabel(labels, [&](int b) { total += weight(b); });
  double rest = random_.uniform(static_cast<std::uint64_t>(cell), draw) * total;
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

}  // namespace exemplar
