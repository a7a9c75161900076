// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "synth/continuous/central.h"
#include "synth/continuous/solids.h"

/// What an example looks like infinitely near its points.
namespace exemplar::continuous {

/// What is around a point: a truth table over the cells of a central arrangement. Merrell's thesis,
/// sections 4.5.1 and 4.5.3, writes it as a Boolean expression of half-spaces; the table says the
/// same and is canonical, because its families are those that it depends on.
struct Figure {
  Families support = 0;               ///< none: within a substance; one: on a face; ...
  std::vector<Substance> substances;  ///< of the cells of `Centrals::of(support)`

  bool operator==(const Figure&) const = default;
  auto operator<=>(const Figure&) const = default;
};

/// The figure of a table over the cells of `families`: families across whose plane nothing changes
/// are left out.
Figure reduced(const Centrals& centrals, Families families, std::span<const Substance> table);

/// The table of a figure over the cells of `families`, which contain its support.
std::vector<Substance> expanded(const Centrals& centrals, const Figure& figure, Families families);

/// A set of figures, numbered in the order in which they were added.
class FigureSet {
 public:
  /// Returns the number of a figure, which it may have already.
  std::uint32_t add(Figure figure);
  /// The number of a figure, or `kNone`.
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::uint32_t find(const Figure& figure) const;

  std::size_t size() const { return figures_.size(); }
  const Figure& operator[](std::uint32_t n) const { return figures_[n]; }
  const std::vector<Figure>& all() const { return figures_; }

 private:
  std::vector<Figure> figures_;
  std::map<Figure, std::uint32_t> numbers_;
};

/// Adds what is near the points of each figure's rays, faces and cells: of every point near a point
/// of the example there is one of the example.
void closeUnderRestriction(const Centrals& centrals, FigureSet& figures);

/// All figures of the solids, closed under restriction. `centrals` has the normals of their planes,
/// and maybe more. Sorted: the same solids have the same numbers. Time grows with the number of
/// candidate points, and for shells with that of triangles, too. Throws `InputError`, `Cancelled`.
FigureSet extractFigures(const Solids& solids, const Centrals& centrals,
                         const Progress& progress = {});

/// The figure at a point through which planes of three directions go; nothing at other points,
/// whose figures are restrictions of those. `planes` are those of the solids, sorted.
std::optional<Figure> figureAt(const Solids& solids, const Centrals& centrals,
                               std::span<const ExactPlane> planes, const ExactPoint& point);

/// "h0 & !h2 | h1" for each substance but air: sums of products over the half-spaces h_i on the
/// positive side of family i, absorbed; for people.
std::string readable(const Centrals& centrals, const Figure& figure);

}  // namespace exemplar::continuous
