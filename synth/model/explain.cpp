// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/explain.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "synth/model/catalog.h"
#include "synth/model/exact.h"

namespace exemplar {
namespace {

/// The demands of a request as numbers: the pins, then the six sides.
class DemandSet {
 public:
  DemandSet(const ModelProblem& problem, const Progress& progress)
      : problem_(problem), progress_(progress), catalog_(problem.network()) {
    pins_ = static_cast<int>(problem.options().pins.size());
    for (int d = 0; d < pins_ + 6; ++d) {
      const bool rule = d < pins_ || problem.options().sides[d - pins_].excludes();
      if (rule) all_.push_back(d);
    }
  }

  const std::vector<int>& all() const { return all_; }
  bool isPin(int demand) const { return demand < pins_; }
  Side side(int demand) const { return static_cast<Side>(demand - pins_); }

  ModelDemands only(std::span<const int> demands) const {
    ModelDemands d;
    d.pins.assign(pins_, false);
    d.sides.fill(false);
    for (const int i : demands) {
      if (i < pins_) {
        d.pins[i] = true;
      } else {
        d.sides[i - pins_] = true;
      }
    }
    return d;
  }
  /// Whether propagation alone shows that the demands cannot be met.
  bool contradictory(std::span<const int> demands) {
    const LabelSets start = problem_.domains(only(demands));
    for (int c = 0; c < problem_.network().cells; ++c) catalog_.setDomain(c, start[c]);
    return !catalog_.propagateAll();
  }
  const ModelProblem& problem() const { return problem_; }
  const Progress& progress() const { return progress_; }
  const Catalog& catalog() const { return catalog_; }

 private:
  const ModelProblem& problem_;
  const Progress& progress_;
  Catalog catalog_;
  int pins_;
  std::vector<int> all_;
};

/// How many sets of demands are tried at most: with hundreds of pins that all have a part in the
/// conflict the set may stay larger than need be.
constexpr int kMostTests = 250;
constexpr const char* kStage = "finding a smallest conflict";
/// The exact solver's conflicts for one such set, and for all: leaving a demand in does no harm.
constexpr std::int64_t kConflictsPerTest = 1000, kConflictsInAll = 30000;

/// Leaves out of `demands`, in ever smaller pieces, what is not needed. `core(demands)` returns the
/// ones that suffice to be impossible, in the same order, or nothing where they are not impossible.
template <class Core>
std::vector<int> smallest(std::vector<int> demands, const Progress& progress, const Core& core) {
  int tests = 0;
  for (std::size_t piece = std::max<std::size_t>(1, demands.size() / 2);;
       piece = std::max<std::size_t>(1, std::min(piece, demands.size()) / 2)) {
    for (std::size_t at = 0; at < demands.size();) {
      progress.report(kStage, static_cast<double>(tests) / kMostTests);
      if (++tests > kMostTests) return demands;
      const std::size_t end = std::min(demands.size(), at + piece);
      std::vector<int> fewer(demands);
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(at),
                  fewer.begin() + static_cast<std::ptrdiff_t>(end));
      const auto left = core(fewer);
      if (!left) {
        at = end;
        continue;
      }
      // A proof may do without some of the demands before `at` too, if pieces are large.
      std::size_t before = 0;
      for (const int d : *left) before += at > 0 && d <= demands[at - 1];
      demands = *left;
      at = before;
    }
    if (piece == 1) return demands;
  }
}

/// The same by the exact solver: each demand is an assumption, and a proof names those it used.
std::vector<int> smallestExactly(DemandSet& set) {
  const ModelProblem& problem = set.problem();
  const LabelNetwork& network = problem.network();
  if (set.contradictory({})) return {};
  LabelSets free(network.labels, network.cells);
  for (int c = 0; c < network.cells; ++c) {
    std::copy(set.catalog().domain(c).begin(), set.catalog().domain(c).end(), free[c].begin());
  }
  ExactSolver exact(network, free, set.progress());
  std::vector<int> number(set.all().size());
  for (std::size_t i = 0; i < set.all().size(); ++i) {
    number[i] = exact.newDemand();
    set.progress().check();
    const LabelSets allowed = problem.domains(set.only(std::span(&set.all()[i], 1)));
    for (int c = 0; c < network.cells; ++c) exact.addToDemand(number[i], c, allowed[c]);
  }
  std::vector<int> needed = set.all();
  std::int64_t conflicts = problem.options().budget, spent = 0;
  const auto core = [&](const std::vector<int>& demands) -> std::optional<std::vector<int>> {
    std::vector<int> on;
    for (const int d : demands) {
      const auto at = std::lower_bound(set.all().begin(), set.all().end(), d) - set.all().begin();
      on.push_back(number[at]);
    }
    const auto outcome =
        spent > kConflictsInAll ? Outcome::Unfinished : exact.solve(on, conflicts, set.progress());
    conflicts = std::min(problem.options().budget, kConflictsPerTest);
    if (outcome == Outcome::Unfinished) spent += conflicts;
    if (outcome != Outcome::Impossible) return std::nullopt;
    std::vector<int> used;
    for (std::size_t i = 0; i < demands.size(); ++i) {
      if (exact.used(on[i])) used.push_back(demands[i]);
    }
    return used;
  };
  auto used = core(needed);
  if (!used) return needed;
  // A proof from the demands of a proof often needs fewer of them still.
  for (std::size_t before = needed.size() + 1; used->size() < before;) {
    before = used->size();
    if (const auto again = core(*used)) used = again;
  }
  return smallest(*used, set.progress(), core);
}

std::string labelNames(std::span<const Label> labels, std::span<const LabelLook> looks) {
  std::string text;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (i == 4 && labels.size() > 5) {
      return text + " or one of " + std::to_string(labels.size() - 4) + " others";
    }
    if (i > 0) text += i + 1 == labels.size() ? " or " : ", ";
    const bool named = labels[i] < looks.size() && !looks[labels[i]].name.empty();
    text += named ? "'" + looks[labels[i]].name + "'" : "label " + std::to_string(labels[i]);
  }
  return text;
}

std::string pinText(const PinnedCell& pin, std::span<const LabelLook> looks) {
  std::string text = "cell (" + std::to_string(pin.cell.x) + ", " + std::to_string(pin.cell.y) +
                     ", " + std::to_string(pin.cell.z) + ")";
  if (pin.frame > 0) text += " of frame " + std::to_string(pin.frame);
  return text + " must be " + labelNames(pin.labels, looks);
}

std::string sideText(Side side, const SideRule& rule, std::span<const LabelLook> looks) {
  static constexpr std::array<const char*, 6> kNames{"lowest x",  "highest x", "lowest y",
                                                     "highest y", "bottom",    "top"};
  const std::string name = kNames[static_cast<int>(side)];
  const std::string layer = "the " + name + (side < Side::MinZ ? " layer" : "");
  if (rule.kind == SideRule::Kind::Example) return layer + " must show what the example's shows";
  return layer + " must be " + labelNames(rule.labels, looks);
}

}  // namespace

ModelConflict explainConflict(const ModelProblem& problem, std::span<const LabelLook> looks,
                              const Progress& progress) {
  DemandSet set(problem, progress);
  std::vector<int> needed;
  if (set.contradictory(set.all())) {
    needed = smallest(set.all(), progress,
                      [&](const std::vector<int>& fewer) -> std::optional<std::vector<int>> {
                        if (!set.contradictory(fewer)) return std::nullopt;
                        return fewer;
                      });
  } else {
    needed = smallestExactly(set);
  }

  ModelConflict conflict;
  std::string list;
  for (const int d : needed) {
    if (!list.empty()) list += "; ";
    if (set.isPin(d)) {
      conflict.pins.push_back(d);
      list += pinText(problem.options().pins[d], looks);
    } else {
      conflict.sides.push_back(set.side(d));
      list += sideText(set.side(d), problem.options().sides[static_cast<int>(set.side(d))], looks);
    }
  }
  const Vec3i& n = problem.options().size;
  const std::string size =
      std::to_string(n.x) + " x " + std::to_string(n.y) + " x " + std::to_string(n.z) + " cells";
  if (needed.empty()) {
    conflict.text = "no grid of " + size + " can be made of the pairs of labels in the example";
  } else if (needed.size() == 1) {
    conflict.text = "in a grid of " + size + " this cannot be met: " + list;
  } else {
    conflict.text = "in a grid of " + size + " these exclude each other: " + list;
  }
  return conflict;
}

}  // namespace exemplar
