// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/synthesize.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "core/random_streams.h"
#include "synth/continuous/filling.h"

namespace exemplar::continuous {
namespace {

/// The example's own planes in a box.
PlaneSets ownPlanes(const Solids& solids, const ExactBox& window) {
  const std::vector<ExactPlane> planes = planesOf(solids);
  PlaneLattice none;
  none.normals = normalsOf(planes);
  none.phases.assign(none.normals.size(), 0);
  none.steps.assign(none.normals.size(), 4 * kMostNormal * kMostCoordinate);
  PlaneSets sets = planesIn(none, window);
  for (std::size_t f = 0; f < none.normals.size(); ++f) {
    std::vector<std::int64_t>& offsets = sets.offsets[f];
    // `planesIn` has put 0 there, and the sides of the box.
    offsets.clear();
    for (const ExactPlane& plane : planes)
      if (plane.normal == none.normals[f]) offsets.push_back(plane.offset);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3l unit;
      unit[axis] = 1;
      if (none.normals[f] != unit) continue;
      offsets.push_back(window.low[axis]);
      offsets.push_back(window.high[axis]);
    }
    std::ranges::sort(offsets);
    offsets.erase(std::unique(offsets.begin(), offsets.end()), offsets.end());
  }
  return sets;
}

void describe(PolygonModel& model, const Solids& solids, const std::vector<Material>& looks,
              const Vec3i& size) {
  model.unit = solids.unit;
  model.origin = solids.origin;
  model.substances = solids.substances;
  model.looks = looks;
  model.size = size;
}

int rankOf(const Centrals& centrals, const Figure& figure) {
  return centrals.of(figure.support).rank;
}

/// Shares of figures by rank.
std::array<double, 4> sharesOf(const Centrals& centrals, const FigureSet& figures,
                               const std::vector<double>& counts) {
  std::array<double, 4> shares{};
  double all = 0;
  for (std::uint32_t f = 0; f < figures.size(); ++f) {
    shares[static_cast<std::size_t>(rankOf(centrals, figures[f]))] += counts[f];
    all += counts[f];
  }
  for (double& share : shares) share /= std::max(all, 1.0);
  return shares;
}

std::vector<double> countsOf(const std::vector<std::uint32_t>& figures, std::size_t size) {
  std::vector<double> counts(size);
  for (const std::uint32_t f : figures)
    if (f != FigureSet::kNone) counts[f] += 1;
  return counts;
}

class Synthesis {
 public:
  Synthesis(const Solids& example, const std::vector<Material>& looks,
            const ContinuousOptions& options)
      : example_(example),
        looks_(looks),
        options_(options),
        lattice_(latticeOf(example, options.spacing)),
        random_(options.seed, stream::kFigureChoice) {}

  ContinuousResult run(const Progress& progress) {
    const PlaneSets planes = planesIn(lattice_, windowOf(lattice_, options_.size));
    const Centrals centrals(planes.normals);
    const FigureSet figures = extractFigures(example_, centrals, progress.part(0, 0.1));
    const std::vector<double> counts = exampleCounts(centrals, figures, progress.part(0.1, 0.2));
    const Arrangement arrangement(planes, centrals, options_.mostVertices,
                                  progress.part(0.2, 0.45));
    Puzzle puzzle = makePuzzle(arrangement, figures, example_.ground, progress.part(0.45, 0.5));
    ContinuousStatistics& s = result_.statistics;
    s.directions = lattice_.normals.size();
    s.figures = figures.size();
    s.classes = puzzle.classes.size();
    s.vertices = arrangement.vertices();
    s.exampleShares = sharesOf(centrals, figures, counts);
    for (const VertexClass& c : puzzle.classes) s.labels = std::max(s.labels, c.labels());
    for (std::uint32_t v = 0; v < arrangement.vertices(); ++v)
      if (arrangement.inside(v)) vertices_.push_back(v);
    s.freeVertices = vertices_.size();
    setWeights(centrals, figures, counts);
    restrictThin(puzzle);
    restrictPlaced(puzzle);
    solve(puzzle, progress.part(0.5, 0.9));
    if (result_.outcome != Outcome::Complete) return std::move(result_);

    const LabelFilling filling(puzzle, puzzle.domains, example_.ground);
    s.shares = sharesOf(centrals, figures,
                        countsOf(figuresOf(arrangement, filling, figures), figures.size()));
    result_.model = outline(arrangement, filling, progress.part(0.9, 1));
    describe(result_.model, example_, looks_, options_.size);
    s.polygons = result_.model.polygons.size();
    return std::move(result_);
  }

 private:
  /// How often each figure is at an inner vertex of the example's own planes, continued.
  std::vector<double> exampleCounts(const Centrals& centrals, const FigureSet& figures,
                                    const Progress& progress) {
    PlaneSets planes = planesIn(lattice_, windowOf(lattice_, sizeInSpacings(lattice_, example_)));
    const Arrangement own(planes, centrals, options_.mostVertices, progress.part(0, 0.5));
    const SolidsFilling filling(own, example_, progress.part(0.5, 1));
    return countsOf(figuresOf(own, filling, figures), figures.size());
  }

  void setWeights(const Centrals& centrals, const FigureSet& figures,
                  const std::vector<double>& counts) {
    for (std::uint32_t f = 0; f < figures.size(); ++f) {
      const bool empty = figures[f] == Figure{0, {kAir}} || isBareGround(figures[f]);
      weights_.push_back((counts[f] + 0.5) * (empty ? 1 : options_.density));
    }
    (void)centrals;
  }
  bool isBareGround(const Figure& figure) const {
    if (!example_.ground) return false;
    return figure == Figure{0, {example_.ground->substance}} ||
           (__builtin_popcount(figure.support) == 1 &&
            figure.substances == std::vector<Substance>{example_.ground->substance, kAir});
  }

  void restrictThin(Puzzle& puzzle) const {
    for (const Thickness& thin : options_.thin) {
      const int family = lattice_.familyOf(thin.normal);
      if (family < 0) throw InputError("`thin`: the example has no faces of this direction");
      std::vector<std::vector<Word>> kept(puzzle.classes.size());
      for (std::size_t k = 0; k < kept.size(); ++k) {
        const VertexClass& c = puzzle.classes[k];
        if (!c.central || !(c.central->families >> family & 1)) continue;
        kept[k].assign(static_cast<std::size_t>(c.words), 0);
        for (std::size_t l = 0; l < c.labels(); ++l) {
          bool above = false, below = false;
          for (std::size_t cell = 0; cell < c.central->cells.size(); ++cell) {
            if (c.cells(l)[cell] != thin.substance) continue;
            (c.central->cells[cell] >> family & 1 ? above : below) = true;
          }
          if (!(above && below)) insert(kept[k], l);
        }
      }
      for (const std::uint32_t v : vertices_) {
        const std::vector<Word>& keep = kept[puzzle.arrangement.kind(v)];
        for (std::size_t w = 0; w < keep.size(); ++w) puzzle.domains[v][w] &= keep[w];
      }
    }
  }

  /// Which vertices are corners of the cell that a point is in, and which of their cells it is.
  void restrictPlaced(Puzzle& puzzle) const {
    const Arrangement& a = puzzle.arrangement;
    for (const PlacedSubstance& placed : options_.placed) {
      // Off the center, so that no plane goes through it: a third of a thousandth and more.
      const Vec3d share{0.5 + 0.000317, 0.5 + 0.000731, 0.5 + 0.001123};
      const Vec3d q = cast<double>(lattice_.origin) +
                      scaled(cast<double>(lattice_.spacing), cast<double>(placed.cell) + share);
      std::vector<int> slab;
      for (std::size_t f = 0; f < a.planes().normals.size(); ++f) {
        const double level = dot(cast<double>(a.planes().normals[f]), q);
        slab.push_back(static_cast<int>(std::ranges::upper_bound(a.planes().offsets[f],
                                                                 std::floor(level)) -
                                        a.planes().offsets[f].begin()) -
                       1);
      }
      for (const std::uint32_t v : vertices_) {
        Families above = 0;
        bool corner = true;
        for (std::size_t f = 0; f < slab.size() && corner; ++f) {
          const Arrangement::Level at = a.level(a.point(v), f);
          corner = at.plane == slab[f] || (at.on && at.plane == slab[f] + 1);
          if (at.on && at.plane == slab[f]) above |= Families{1} << f;
        }
        if (!corner) continue;
        const VertexClass& c = puzzle.classOf(v);
        const std::uint32_t cell = c.central->cell(above);
        for (std::size_t l = 0; l < c.labels(); ++l) {
          if (std::ranges::find(placed.substances, c.cells(l)[cell]) == placed.substances.end())
            erase(puzzle.domains[v], l);
        }
      }
    }
  }

  void solve(Puzzle& puzzle, const Progress& progress) {
    Search::Marks marks(puzzle.arrangement.vertices());
    Search search(puzzle, weights_, puzzle.domains, marks);
    ContinuousStatistics& s = result_.statistics;
    if (!search.begin(vertices_, 1)) {
      result_.outcome = Outcome::Impossible;
      result_.why = "impossible: what is required excludes everything somewhere";
      return;
    }
    const std::int64_t budget =
        options_.budget > 0 ? options_.budget
                            : 1000 + static_cast<std::int64_t>(vertices_.size()) / 10;
    for (int attempt = 0; attempt < options_.attempts && !options_.blocksOnly; ++attempt) {
      ++s.attempts;
      const Found found = search.run(random_.fork(static_cast<std::uint64_t>(attempt)), budget,
                                     progress);
      s.choices = search.counts().choices;
      s.failures = search.counts().failures;
      if (found == Found::All) {
        s.whole = true;
        return;
      }
      if (found == Found::Nothing) {
        result_.outcome = Outcome::Impossible;
        result_.why = "impossible: what is required cannot be met";
        return;
      }
    }
    result_.outcome = Outcome::Unfinished;
    result_.why = "no result within the budget; try another `seed`, or a larger `budget`";
  }

  const Solids& example_;
  const std::vector<Material>& looks_;
  const ContinuousOptions& options_;
  PlaneLattice lattice_;
  Random random_;
  std::vector<std::uint32_t> vertices_;  // inner ones
  std::vector<double> weights_;          // of figures
  ContinuousResult result_;
};

}  // namespace

PolygonModel polygonsOf(const Solids& solids, const std::vector<Material>& looks,
                        const Progress& progress) {
  const PlaneLattice lattice = latticeOf(solids);
  const Vec3i size = sizeInSpacings(lattice, solids);
  const PlaneSets planes = ownPlanes(solids, windowOf(lattice, size));
  const Centrals centrals(planes.normals);
  const Arrangement arrangement(planes, centrals, 20'000'000, progress.part(0, 0.4));
  const SolidsFilling filling(arrangement, solids, progress.part(0.4, 0.8));
  PolygonModel model = outline(arrangement, filling, progress.part(0.8, 1));
  describe(model, solids, looks, size);
  return model;
}

ContinuousResult synthesizeSolids(const Solids& example, const std::vector<Material>& looks,
                                  const ContinuousOptions& options, const Progress& progress) {
  return Synthesis(example, looks, options).run(progress);
}

}  // namespace exemplar::continuous
