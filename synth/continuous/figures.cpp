// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/figures.h"

#include <algorithm>
#include <set>

#include "core/loop_progress.h"
#include "core/parallel.h"

namespace exemplar::continuous {
namespace {

bool isCell(const Central& central, Families above) {
  return std::ranges::binary_search(central.cells, above);
}

/// Terms of a sum of products: on the positive side of `positive`, on the negative of `negative`.
struct Term {
  Families positive, negative;
  auto operator<=>(const Term&) const = default;
  bool absorbs(const Term& b) const {
    return (positive & ~b.positive) == 0 && (negative & ~b.negative) == 0;
  }
};

/// Whether all cells that a term covers are of a substance.
bool holds(const Central& central, const std::vector<Substance>& table, Substance substance,
           const Term& term) {
  for (std::size_t c = 0; c < table.size(); ++c) {
    const Families above = central.cells[c];
    const bool covered = (above & term.positive) == term.positive && (above & term.negative) == 0;
    if (covered && table[c] != substance) return false;
  }
  return true;
}

/// Each cell's term with factors dropped while it holds; then those that others absorb are dropped.
std::vector<Term> termsOf(const Central& central, const Figure& figure, Substance substance) {
  std::set<Term> terms;
  for (std::size_t c = 0; c < figure.substances.size(); ++c) {
    if (figure.substances[c] != substance) continue;
    Term term{central.cells[c], figure.support & ~central.cells[c]};
    forEachFamily(figure.support, [&](int i) {
      const Families bit = Families{1} << i;
      const Term fewer{term.positive & ~bit, term.negative & ~bit};
      if (holds(central, figure.substances, substance, fewer)) term = fewer;
    });
    terms.insert(term);
  }
  std::vector<Term> kept;
  for (const Term& t : terms) {
    const bool absorbed =
        std::ranges::any_of(terms, [&](const Term& o) { return o != t && o.absorbs(t); });
    if (!absorbed) kept.push_back(t);
  }
  return kept;
}

}  // namespace

Figure reduced(const Centrals& centrals, Families families, std::span<const Substance> table) {
  const Central& central = centrals.of(families);
  Families support = 0;
  for (std::size_t c = 0; c < table.size(); ++c) {
    forEachFamily(central.cells[c] & ~support, [&](int i) {
      const Families below = central.cells[c] & ~(Families{1} << i);
      const auto found = std::ranges::lower_bound(central.cells, below);
      if (found == central.cells.end() || *found != below) return;
      if (table[static_cast<std::size_t>(found - central.cells.begin())] != table[c])
        support |= Families{1} << i;
    });
  }
  if (support == families) return {support, {table.begin(), table.end()}};
  const Central& small = centrals.of(support);
  Figure figure{support, std::vector<Substance>(small.cells.size())};
  for (std::size_t c = 0; c < table.size(); ++c)
    figure.substances[small.cell(central.cells[c] & support)] = table[c];
  return figure;
}

std::vector<Substance> expanded(const Centrals& centrals, const Figure& figure, Families families) {
  const Central& small = centrals.of(figure.support);
  const Central& large = centrals.of(families);
  std::vector<Substance> table(large.cells.size());
  for (std::size_t c = 0; c < table.size(); ++c)
    table[c] = figure.substances[small.cell(large.cells[c] & figure.support)];
  return table;
}

std::uint32_t FigureSet::add(Figure figure) {
  const auto [entry, isNew] =
      numbers_.emplace(std::move(figure), static_cast<std::uint32_t>(figures_.size()));
  if (isNew) figures_.push_back(entry->first);
  return entry->second;
}

std::uint32_t FigureSet::find(const Figure& figure) const {
  const auto found = numbers_.find(figure);
  return found == numbers_.end() ? kNone : found->second;
}

void closeUnderRestriction(const Centrals& centrals, FigureSet& figures) {
  for (std::uint32_t n = 0; n < figures.size(); ++n) {
    const Figure figure = figures[n];
    const Central& central = centrals.of(figure.support);
    for (const Central::Ray& ray : central.rays) {
      std::vector<Substance> around;
      for (const std::uint32_t c : ray.around) around.push_back(figure.substances[c]);
      figures.add(reduced(centrals, ray.on, around));
    }
    for (std::size_t c = 0; c < central.cells.size(); ++c) {
      figures.add({0, {figure.substances[c]}});
      forEachFamily(central.cells[c], [&](int i) {
        const Families below = central.cells[c] & ~(Families{1} << i);
        if (!isCell(central, below)) return;
        const Substance under = figure.substances[central.cell(below)];
        if (under != figure.substances[c])
          figures.add({Families{1} << i, {under, figure.substances[c]}});
      });
    }
  }
}

std::optional<Figure> figureAt(const Solids& solids, const Centrals& centrals,
                               std::span<const ExactPlane> planes, const ExactPoint& point) {
  Families on = 0;
  for (std::size_t i = 0; i < centrals.normals().size(); ++i) {
    const Vec3l& normal = centrals.normals()[i];
    const std::int64_t level = dot(normal, point.n);
    if (level % point.d != 0) continue;
    const ExactPlane plane{normal, level / point.d};
    const auto found = std::ranges::lower_bound(
        planes, plane, [](const ExactPlane& a, const ExactPlane& b) { return before(a, b); });
    if (found != planes.end() && *found == plane) on |= Families{1} << i;
  }
  const Central& central = centrals.of(on);
  if (central.rank < 3) return std::nullopt;
  return reduced(centrals, on, substancesAround(solids, central, point));
}

FigureSet extractFigures(const Solids& solids, const Centrals& centrals, const Progress& progress) {
  const std::vector<ExactPlane> planes = planesOf(solids);
  const std::vector<ExactPoint> points = candidatePoints(solids);
  std::vector<std::optional<Figure>> found(points.size());
  LoopProgress loop(progress, "reading the example's figures", points.size());
  parallelFor(0, points.size(), 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p)
      found[p] = figureAt(solids, centrals, planes, points[p]);
    loop.advance(last - first);
  });
  // Bare ground, where no candidate point is on it alone.
  if (solids.ground) {
    for (std::uint32_t i = 0; i < centrals.normals().size(); ++i)
      if (centrals.normals()[i] == Vec3l{0, 0, 1})
        found.push_back(Figure{Families{1} << i, {solids.ground->substance, kAir}});
  }
  FigureSet closed;
  for (std::optional<Figure>& figure : found)
    if (figure) closed.add(std::move(*figure));
  closeUnderRestriction(centrals, closed);
  std::vector<Figure> sorted = closed.all();
  std::ranges::sort(sorted, [](const Figure& a, const Figure& b) {
    const int na = __builtin_popcount(a.support), nb = __builtin_popcount(b.support);
    return na != nb ? na < nb : a < b;
  });
  FigureSet figures;
  for (Figure& figure : sorted) figures.add(std::move(figure));
  return figures;
}

std::string readable(const Centrals& centrals, const Figure& figure) {
  if (figure.support == 0) return figure.substances[0] == kAir ? "air" : "inside";
  const Central& central = centrals.of(figure.support);
  std::set<Substance> present(figure.substances.begin(), figure.substances.end());
  present.erase(kAir);
  std::string text;
  for (const Substance substance : present) {
    if (!text.empty()) text += " + ";
    if (present.size() > 1 || substance != 1) text += std::to_string(substance) + " * ";
    bool firstTerm = true;
    for (const Term& term : termsOf(central, figure, substance)) {
      if (!firstTerm) text += " | ";
      firstTerm = false;
      bool firstFactor = true;
      forEachFamily(figure.support, [&](int i) {
        const Families bit = Families{1} << i;
        if (((term.positive | term.negative) & bit) == 0) return;
        text += (firstFactor ? "" : " & ") + std::string(term.negative & bit ? "!h" : "h") +
                std::to_string(i);
        firstFactor = false;
      });
    }
  }
  return text;
}

}  // namespace exemplar::continuous
