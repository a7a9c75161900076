// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/network.h"

namespace exemplar {

std::vector<LabelSets> supportTables(const Adjacency& adjacency) {
  std::vector<LabelSets> tables;
  for (const PairRule& rule : adjacency.rules) {
    LabelSets along(adjacency.labelCount, adjacency.labelCount);
    LabelSets against(adjacency.labelCount, adjacency.labelCount);
    for (const LabelPair& p : rule.pairs) {
      addLabel(along[p.first], p.second);
      addLabel(against[p.second], p.first);
    }
    tables.push_back(std::move(along));
    tables.push_back(std::move(against));
  }
  return tables;
}

NetworkPart::NetworkPart(const LabelNetwork& whole) : whole_(&whole), local_(whole.cells, -1) {
  part_.labels = whole.labels;
  part_.slots = whole.slots;
  part_.support = whole.support;
}

void NetworkPart::select(std::span<const std::int32_t> cells) {
  for (const std::int32_t c : chosen_) local_[c] = -1;
  chosen_.assign(cells.begin(), cells.end());
  const int count = static_cast<int>(chosen_.size());
  for (int c = 0; c < count; ++c) local_[chosen_[c]] = c;

  part_.cells = count;
  part_.neighbor.resize(static_cast<std::size_t>(count) * part_.slots);
  part_.linkBegin.clear();
  part_.links.clear();
  for (int c = 0; c < count; ++c) {
    const auto near = whole_->neighbors(chosen_[c]);
    for (int s = 0; s < part_.slots; ++s) {
      const int there = near[s] == whole_->cells ? -1 : local_[near[s]];
      part_.neighbor[static_cast<std::size_t>(c) * part_.slots + s] = there < 0 ? count : there;
    }
  }
  if (whole_->linkBegin.empty()) return;
  part_.linkBegin.push_back(0);
  for (int c = 0; c < count; ++c) {
    for (const LabelNetwork::Link& l : whole_->linksOf(chosen_[c])) {
      if (local_[l.cell] >= 0) part_.links.push_back({local_[l.cell], l.relation});
    }
    part_.linkBegin.push_back(static_cast<std::int32_t>(part_.links.size()));
  }
}

void NetworkPart::restrictBySupport(std::span<LabelWord> domain, std::span<const LabelWord> far,
                                    const LabelSets& table) {
  constexpr int kWordsAtOnce = 16;
  for (std::size_t w0 = 0; w0 < domain.size(); w0 += kWordsAtOnce) {
    const std::size_t count = std::min<std::size_t>(kWordsAtOnce, domain.size() - w0);
    LabelWord supported[kWordsAtOnce] = {};
    forEachLabel(far, [&](int b) {
      const auto row = table[b];
      for (std::size_t w = 0; w < count; ++w) supported[w] |= row[w0 + w];
    });
    for (std::size_t w = 0; w < count; ++w) domain[w0 + w] &= supported[w];
  }
}

}  // namespace exemplar
