// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/search.h"

#include <bit>
#include <vector>

namespace exemplar {
namespace {

struct Decision {
  std::int32_t cell;
  int label;
  std::size_t at;  // index into the order
};

int highestBit(std::span<const std::uint64_t> set) {
  for (std::size_t w = set.size(); w-- > 0;) {
    if (set[w] != 0) return static_cast<int>(w * 64 + 63 - std::countl_zero(set[w]));
  }
  return -1;
}

}  // namespace

bool labelInOrder(Catalog& catalog, std::span<const std::int32_t> order, const ChooseLabel& choose,
                  std::int64_t& contradictions, const Progress& progress) {
  for (const std::int32_t cell : order) {
    progress.check();
    for (int draw = 0; !catalog.decided(cell); ++draw) {
      const int label = choose(cell, catalog.domain(cell), draw);
      catalog.mark();
      if (catalog.assign(cell, label) && catalog.propagate()) {
        catalog.commit();
        break;
      }
      ++contradictions;
      catalog.undoTo(0);
      // What the label's absence does is known before it is made final.
      catalog.mark();
      if (!catalog.remove(cell, label) || !catalog.propagate()) {
        catalog.undoTo(0);
        return false;
      }
      catalog.commit();
    }
  }
  return true;
}

Outcome searchLabels(Catalog& catalog, std::span<const std::int32_t> order,
                     const ChooseLabel& choose, std::int64_t conflicts, const Progress& progress,
                     std::int64_t lastStep) {
  catalog.keepReasons(static_cast<int>(order.size()) + 1);
  const int words = catalog.reasonWords();
  std::vector<Decision> decisions;
  std::vector<std::uint64_t> blame(words);
  int draw = 0;
  std::int64_t met = 0;

  for (std::size_t at = 0;;) {
    while (at < order.size() && catalog.decided(order[at])) ++at;
    if (at == order.size()) {
      catalog.commit();
      return Outcome::Complete;
    }
    progress.check();
    const int cell = order[at];
    const int label = choose(cell, catalog.domain(cell), draw++);
    const int depth = catalog.mark();
    decisions.push_back({cell, label, at});
    catalog.assign(cell, label);
    catalog.reason(cell)[depth / 64] |= std::uint64_t{1} << (depth % 64);
    bool sound = catalog.propagate();

    while (!sound) {
      progress.check();
      if (++met > conflicts || catalog.steps() > lastStep) {
        if (!decisions.empty()) catalog.undoTo(0);
        return Outcome::Unfinished;
      }
      const auto emptied = catalog.reason(catalog.contradiction());
      const auto from = catalog.reason(catalog.contradictionFrom());
      for (int w = 0; w < words; ++w) blame[w] = emptied[w] | from[w];
      const int last = highestBit(blame);
      if (last < 0) return Outcome::Impossible;
      blame[last / 64] &= ~(std::uint64_t{1} << (last % 64));

      const Decision wrong = decisions[last];
      decisions.resize(last);
      catalog.undoTo(last);
      at = wrong.at;
      sound = catalog.remove(wrong.cell, wrong.label);
      const auto reason = catalog.reason(wrong.cell);
      for (int w = 0; w < words; ++w) reason[w] |= blame[w];
      sound = sound && catalog.propagate();
    }
  }
}

}  // namespace exemplar
