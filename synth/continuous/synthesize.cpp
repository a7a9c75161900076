// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/synthesize.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/random_streams.h"
#include "synth/continuous/blocks.h"
#include "synth/continuous/exact_search.h"
#include "synth/continuous/filling.h"
#include "synth/continuous/grounding.h"
#include "synth/continuous/jitter.h"
#include "synth/continuous/mirror.h"

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
  model.flat = solids.flat;
}

std::vector<double> countsOf(const std::vector<std::uint32_t>& figures, std::size_t size) {
  std::vector<double> counts(size);
  for (const std::uint32_t f : figures)
    if (f != FigureSet::kNone) counts[f] += 1;
  return counts;
}

/// The free vertices of an arrangement.
std::vector<std::uint32_t> innerVertices(const Arrangement& arrangement) {
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < arrangement.vertices(); ++v)
    if (arrangement.inside(v)) vertices.push_back(v);
  return vertices;
}

/// What a vertex may be where a demand is met.
struct Allowed {
  std::uint32_t vertex;
  std::vector<Word> labels;
};

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
    const ExactBox window = outerWindow(), inner = resultBox();
    const PlaneSets planes = planesIn(lattice_, window, inner);
    const Centrals centrals(planes.normals);
    const FigureSet figures = extractFigures(example_, centrals, progress.part(0, 0.1));
    counts_ = exampleCounts(centrals, figures, progress.part(0.1, 0.2));
    classes_ = classify(centrals, figures, example_.ground);
    const Arrangement arrangement(planes, centrals, options_.mostVertices,
                                  progress.part(0.2, 0.35));
    Puzzle puzzle = makePuzzle(arrangement, figures, example_.ground, progress.part(0.35, 0.4));
    inner_ = vertices_ = innerVertices(arrangement);
    noteSizes(puzzle);
    restrictThin(puzzle, vertices_);
    if (options_.map)
      guide_ = applyDensityMap(*options_.map, inner, example_.ground, puzzle, vertices_);
    if (options_.groups > 0) growth_ = planGrowth(puzzle);
    Domains open = puzzle.domains;
    std::vector<std::vector<Allowed>> demands;
    for (const PlacedSubstance& placed : options_.placed)
      demands.push_back(allowedFor(puzzle, placed));
    for (const std::vector<Allowed>& demand : demands) {
      for (const Allowed& a : demand)
        for (std::size_t w = 0; w < a.labels.size(); ++w)
          puzzle.domains[a.vertex][w] &= a.labels[w];
    }
    const Domains allowed = puzzle.domains;
    solve(puzzle, allowed, open, demands, progress.part(0.4, 0.9));
    if (result_.outcome != Outcome::Complete) return std::move(result_);

    const LabelFilling filling(puzzle, puzzle.domains, example_.ground);
    result_.statistics.shares =
        sharesOf(classes_, countsOf(figuresOf(arrangement, filling, figures), figures.size()));
    if (options_.open.any()) {
      const CroppedFilling cropped(arrangement, filling, inner);
      result_.model = outline(arrangement, cropped, progress.part(0.9, 1));
    } else {
      result_.model = outline(arrangement, filling, progress.part(0.9, 1));
    }
    describe(result_.model, example_, looks_, options_.size);
    if (options_.jitter > 0) {
      jitterPlanes(result_.model, lattice_, inner, example_.ground, options_.jitter,
                   Random(options_.seed, stream::kFigureChoice).fork(9001));
    }
    result_.statistics.polygons = result_.model.polygons.size();
    return std::move(result_);
  }

 private:
  /// The box of all vertices: that of the result, and more where it is cut out of something longer.
  ExactBox outerWindow() const {
    ExactBox window = windowOf(lattice_, options_.size);
    for (int axis = 0; axis < 3; ++axis) {
      if (!options_.open[axis]) continue;
      window.low[axis] -= kMargin * lattice_.spacing[axis];
      window.high[axis] += kMargin * lattice_.spacing[axis];
    }
    return window;
  }
  /// The box of the result, with one empty spacing on the sides that are not open.
  ExactBox resultBox() const {
    ExactBox box = windowOf(lattice_, options_.size);
    for (int axis = 0; axis < 3; ++axis) {
      if (!options_.open[axis]) continue;
      box.low[axis] += lattice_.spacing[axis];
      box.high[axis] -= lattice_.spacing[axis];
    }
    return box;
  }

  Growth planGrowth(const Puzzle& puzzle) const {
    std::optional<Substance> ground;
    if (example_.ground) ground = example_.ground->substance;
    Growth growth = growthOf(puzzle, ground);
    growth.seeds = options_.groups;
    const double empty = result_.statistics.exampleShares[static_cast<int>(FigureClass::Empty)];
    growth.share = std::min(1.0, (1 - empty) * options_.density);
    return growth;
  }

  /// How often each figure is at an inner vertex of the lattice's planes around the example.
  std::vector<double> exampleCounts(const Centrals& centrals, const FigureSet& figures,
                                    const Progress& progress) {
    const PlaneSets planes =
        planesIn(lattice_, windowOf(lattice_, sizeInSpacings(lattice_, example_)));
    const Arrangement own(planes, centrals, options_.mostVertices, progress.part(0, 0.5));
    const SolidsFilling filling(own, example_, progress.part(0.5, 1));
    const std::vector<std::uint32_t> found = figuresOf(own, filling, figures);
    if (example_.ground) {
      grounded_ = !options_.floating.value_or(false);
      if (!options_.floating) {
        const Puzzle puzzle = makePuzzle(own, figures, example_.ground);
        grounded_ = !anyFloats(puzzle, found, example_.ground->substance);
      }
    }
    return countsOf(found, figures.size());
  }

  void noteSizes(const Puzzle& puzzle) {
    ContinuousStatistics& s = result_.statistics;
    s.directions = lattice_.normals.size();
    s.figures = puzzle.figures.size();
    s.vertices = puzzle.arrangement.vertices();
    s.freeVertices = vertices_.size();
    s.exampleShares = sharesOf(classes_, counts_);
    for (const VertexClass& c : puzzle.classes) {
      s.classes += c.labels() > 0;
      s.labels = std::max(s.labels, c.labels());
    }
  }

  void restrictThin(Puzzle& puzzle, std::span<const std::uint32_t> vertices) const {
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
      for (const std::uint32_t v : vertices) {
        const std::vector<Word>& keep = kept[puzzle.arrangement.kind(v)];
        for (std::size_t w = 0; w < keep.size(); ++w) puzzle.domains[v][w] &= keep[w];
      }
    }
  }

  /// The corners of the cell that a placed substance is in, and their labels that give it to it.
  std::vector<Allowed> allowedFor(const Puzzle& puzzle, const PlacedSubstance& placed) const {
    const Arrangement& a = puzzle.arrangement;
    // Off the center of its spacing, so that hardly a plane can go through it.
    const Vec3d share{0.5 + 0.000317, 0.5 + 0.000731, 0.5 + 0.001123};
    const Vec3d q = cast<double>(lattice_.origin) +
                    scaled(cast<double>(lattice_.spacing), cast<double>(placed.cell) + share);
    std::vector<int> slab;
    for (std::size_t f = 0; f < a.planes().normals.size(); ++f) {
      const std::vector<std::int64_t>& offsets = a.planes().offsets[f];
      const double level = dot(cast<double>(a.planes().normals[f]), q);
      const auto above = std::ranges::upper_bound(offsets, std::floor(level));
      slab.push_back(static_cast<int>(above - offsets.begin()) - 1);
    }
    std::vector<Allowed> corners;
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
      Allowed allowed{v, std::vector<Word>(static_cast<std::size_t>(c.words))};
      for (std::size_t l = 0; l < c.labels(); ++l) {
        if (std::ranges::find(placed.substances, c.cells(l)[cell]) != placed.substances.end())
          insert(allowed.labels, l);
      }
      corners.push_back(std::move(allowed));
    }
    return corners;
  }

  /// Adapts weights in this puzzle where it is small, else in a smaller one.
  void learn(const Puzzle& puzzle, const Domains& consistent, const Progress& progress) {
    ClassWeights& weights =
        classWeights_.emplace(classes_, counts_, options_.density, options_.objectSize);
    if (options_.learning == 0) return weights.forget();
    LearnOptions options{options_.learning, {}, growth_ ? &*growth_ : nullptr};
    if (grounded_) options.ground = example_.ground->substance;
    const Random random(options_.seed, stream::kFigureLearning);
    constexpr double kPilot = 6000;  // vertices
    const double factor = std::sqrt(kPilot / static_cast<double>(vertices_.size()));
    if (factor > 0.8)
      return learnWeights(weights, puzzle, consistent, vertices_, classes_, random, options,
                          progress);
    const Vec3i least = sizeInSpacings(lattice_, example_);
    Vec3i size = options_.size;
    for (int axis = 0; axis < 2; ++axis)
      size[axis] =
          std::min(size[axis], std::max(least[axis], static_cast<int>(size[axis] * factor)));
    const PlaneSets planes = planesIn(lattice_, windowOf(lattice_, size));
    const Arrangement small(planes, puzzle.arrangement.centrals(), options_.mostVertices);
    Puzzle pilot = makePuzzle(small, puzzle.figures, example_.ground);
    const std::vector<std::uint32_t> vertices = innerVertices(small);
    restrictThin(pilot, vertices);
    std::optional<Growth> growth;
    if (growth_) {
      growth = planGrowth(pilot);
      // As many groups on as much room.
      const double room = static_cast<double>(vertices.size()) / static_cast<double>(inner_.size());
      growth->seeds = std::max(1, static_cast<int>(std::lround(options_.groups * room)));
      options.growth = &*growth;
    }
    learnWeights(weights, pilot, pilot.domains, vertices, classes_, random, options, progress);
  }

  /// Has a half of the vertices stand for all, in the puzzle and where no demand counts.
  void restrictToHalf(Puzzle& puzzle, Domains& open) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!options_.mirror[axis]) continue;
      const Mirror& mirror = mirrors_.emplace_back(puzzle, axis);
      vertices_ = mirror.half(vertices_);
      mirror.restrict(vertices_, puzzle.domains);
      mirror.restrict(vertices_, open);
    }
  }
  /// Gives all other vertices the images of those that were searched.
  void completeImages(Domains& domains) const {
    for (std::size_t n = mirrors_.size(); n-- > 0;) {
      std::vector<std::uint32_t> half = inner_;
      for (std::size_t m = 0; m <= n; ++m) half = mirrors_[m].half(half);
      mirrors_[n].complete(half, domains);
    }
  }

  void solve(Puzzle& puzzle, const Domains& allowed, Domains& open,
             const std::vector<std::vector<Allowed>>& demands, const Progress& progress) {
    weights_.assign(puzzle.figures.size(), 1);
    Search::Marks marks(puzzle);
    Search search(puzzle, weights_, puzzle.domains, marks);
    if (!search.begin(vertices_, 1)) return explain(puzzle, open, demands);
    learn(puzzle, puzzle.domains, progress.part(0, 0.4));
    std::ranges::copy(classWeights_->weights(), weights_.begin());
    if (options_.mirror.any()) {
      restrictToHalf(puzzle, open);
      if (!search.begin(vertices_, 2)) return explain(puzzle, open, demands);
    }
    if (!options_.blocksOnly) {
      const Found found = makeWhole(puzzle, allowed, search, progress.part(0.4, 0.7));
      if (found == Found::Nothing) return explain(puzzle, open, demands);
      if (found == Found::All) return;
    }
    const bool blocks = options_.blocks && mirrors_.empty();
    const Outcome start = blocks ? startOfBlocks(puzzle) : decide(puzzle, true);
    if (start == Outcome::Impossible) return explain(puzzle, open, demands);
    if (start != Outcome::Complete) {
      result_.outcome = Outcome::Unfinished;
      result_.why =
          "no result within the budget, and none is proved impossible; try another `seed`, a "
          "smaller `size`, or a larger `budget`";
      return;
    }
    if (blocks) {
      makeBlocks(puzzle, progress.part(0.7, 1));
    } else {
      result_.statistics.whole = true;
    }
    tidy(puzzle, allowed, puzzle.domains);
  }

  /// Makes results in one pass until one has about the shares that are wanted, or the nearest one
  /// of a few; weights are adapted after each.
  /// The search, which has begun, looks at `weights_`, which stay where they are.
  Found makeWhole(Puzzle& puzzle, const Domains& allowed, Search& search,
                  const Progress& progress) {
    ContinuousStatistics& s = result_.statistics;
    const auto most = static_cast<std::int64_t>(vertices_.size()) / 10;
    const std::int64_t budget = options_.budget > 0 ? options_.budget
                                : growth_           ? 4 * kQuickGrowth
                                                    : 1000 + most;
    if (guide_) search.setGuide(&*guide_);
    // Where results are guided, they are as full as the guide says.
    const int wanted = guide_ || options_.learning == 0 ? 1 : kResults;
    std::optional<Domains> best;
    double nearest = 0;
    std::pair<std::int64_t, std::int64_t> pieces;  // of the best: floating ones, groups
    int made = 0, spent = 0, quick = budget > kQuickBudget ? kQuickAttempts : 0;
    // What is nearly empty, or far too full, is quickly made again.
    const auto enough = [&] { return made >= (nearest > kFar ? 3 * wanted : wanted); };
    while (!enough() && (quick > 0 || (made == 0 && spent < options_.attempts))) {
      search.again();
      const Random random = random_.fork(static_cast<std::uint64_t>(s.attempts++));
      const double share = 1.0 / (kQuickAttempts + options_.attempts + wanted);
      const Progress part =
          progress.part(std::min(1.0, share * (s.attempts - 1)), std::min(1.0, share * s.attempts));
      const std::int64_t failures = quick == 0 ? budget : growth_ ? kQuickGrowth : kQuickBudget;
      const Found found = growth_ ? search.grow(*growth_, random, failures, part)
                                  : search.run(random, failures, part);
      s.choices = search.counts().choices;
      s.failures = search.counts().failures;
      if (found == Found::Nothing) return found;
      if (found == Found::Spent) {
        quick > 0 ? --quick : ++spent;
        continue;
      }
      ++made;
      Domains labels = puzzle.domains;
      tidy(puzzle, allowed, labels);
      const Shares shares = sharesIn(puzzle, labels, inner_, classes_);
      const double distance = classWeights_->distance(shares);
      if (!best || distance < nearest) {
        nearest = distance;
        best = std::move(labels);
        pieces = {s.floating, s.groups};
      }
      if (nearest <= kNear) break;
      classWeights_->adapt(shares, inner_.size());
      std::ranges::copy(classWeights_->weights(), weights_.begin());
    }
    search.again();
    if (!best) return Found::Spent;
    puzzle.domains = std::move(*best);
    std::tie(s.floating, s.groups) = pieces;
    s.whole = true;
    return Found::All;
  }

  void makeBlocks(Puzzle& puzzle, const Progress& progress) {
    ContinuousStatistics& s = result_.statistics;
    Domains labels = start_;
    const BlockCounts counts = modifyInBlocks(puzzle, weights_, labels, random_,
                                              {.spacing = lattice_.spacing,
                                               .side = options_.block,
                                               .rounds = options_.rounds,
                                               .guide = guide_ ? &*guide_ : nullptr},
                                              progress);
    puzzle.domains = std::move(labels);
    s.blocks = counts.blocks;
    s.blocksKept = counts.kept;
    s.choices += counts.choices;
    s.failures += counts.failures;
  }

  /// Completes a result of the vertices that were searched, and takes from it what may not be.
  void tidy(const Puzzle& puzzle, const Domains& allowed, Domains& labels) {
    completeImages(labels);
    ContinuousStatistics& s = result_.statistics;
    if (grounded_) {
      s.floating = removeFloating(puzzle, allowed, inner_, example_.ground->substance, labels);
    }
    if (growth_) {
      s.groups = keepLargest(puzzle, allowed, inner_, *growth_, options_.groups, labels);
    }
  }

  /// The background where it is allowed, else what the exact solver finds near to it.
  Outcome startOfBlocks(const Puzzle& puzzle) {
    start_ = puzzle.domains;
    bool allowed = true;
    for (const std::uint32_t v : vertices_) {
      const auto label = static_cast<std::size_t>(puzzle.background[v]);
      allowed = allowed && contains(puzzle.domains[v], label);
      std::ranges::fill(start_[v], 0);
      insert(start_[v], label);
    }
    if (allowed) return Outcome::Complete;
    Puzzle copy = puzzle;
    const Outcome outcome = decide(copy, false);
    start_ = copy.domains;
    return outcome;
  }

  /// Solves all of a puzzle exactly, near to labels that are drawn, or to the background.
  Outcome decide(Puzzle& puzzle, bool drawn) {
    ++result_.statistics.exact;
    ExactSearch exact(puzzle, puzzle.domains, vertices_);
    for (const std::uint32_t v : vertices_) {
      auto label = static_cast<std::size_t>(puzzle.background[v]);
      if (drawn) {
        double sum = 0;
        const VertexClass& c = puzzle.classOf(v);
        forEach(puzzle.domains[v], [&](std::size_t l) { sum += weights_[c.figures[l]]; });
        double rest = sum * random_.uniform(v, 77);
        bool decided = false;
        forEach(puzzle.domains[v], [&](std::size_t l) {
          if (decided) return;
          label = l;
          rest -= weights_[c.figures[l]];
          decided = rest < 0;
        });
      }
      exact.prefer(v, label);
    }
    const Outcome outcome = exact.solve({}, kConflicts);
    if (outcome == Outcome::Complete) exact.take(puzzle.domains);
    return outcome;
  }

  /// Says which placed substances exclude each other: a smallest set of them, by leaving out one
  /// after the other.
  void explain(const Puzzle& puzzle, const Domains& open,
               const std::vector<std::vector<Allowed>>& demands) {
    result_.outcome = Outcome::Impossible;
    result_.why = "impossible: nothing meets what is required";
    Puzzle free{puzzle.arrangement, puzzle.figures, puzzle.classes, open, puzzle.background};
    Search::Marks marks(puzzle);
    Search search(free, weights_, free.domains, marks);
    if (!search.begin(vertices_, 1)) return;
    ++result_.statistics.exact;
    ExactSearch exact(free, free.domains, vertices_);
    std::vector<int> core;
    for (std::size_t d = 0; d < demands.size(); ++d) {
      core.push_back(exact.newDemand());
      for (const Allowed& a : demands[d]) {
        if (std::ranges::binary_search(vertices_, a.vertex))
          exact.addToDemand(core.back(), a.vertex, a.labels);
      }
    }
    if (exact.solve(core, kConflicts) != Outcome::Impossible) return;
    const auto keepUsed = [&] { std::erase_if(core, [&](int d) { return !exact.used(d); }); };
    keepUsed();
    for (std::size_t d = 0; d < core.size();) {
      std::vector<int> fewer;
      for (std::size_t n = 0; n < core.size(); ++n)
        if (n != d) fewer.push_back(core[n]);
      if (exact.solve(fewer, kConflicts) == Outcome::Impossible) {
        core = fewer;
        keepUsed();
      } else {
        ++d;
      }
    }
    result_.conflict = core;
    if (core.empty()) return;
    result_.why = core.size() == 1 ? "impossible: nothing meets this demand"
                                   : "impossible: these demands exclude each other";
  }

  static constexpr std::int64_t kConflicts = 300'000;
  /// Results of which the nearest to the wanted shares is taken, and how near is near enough.
  static constexpr int kResults = 4;
  static constexpr double kNear = 1.5, kFar = 4;
  /// Attempts of few failures before the long ones: most results need none, or a great many.
  static constexpr int kQuickAttempts = 12;
  static constexpr std::int64_t kQuickBudget = 200, kQuickGrowth = 400;
  /// Spacings beyond an open side: enough that its end has no influence on what is there.
  static constexpr std::int64_t kMargin = 3;

  const Solids& example_;
  const std::vector<Material>& looks_;
  const ContinuousOptions& options_;
  PlaneLattice lattice_;
  Random random_;
  std::vector<double> counts_;           // of figures in the example
  std::vector<FigureClass> classes_;     // of figures
  std::vector<std::uint32_t> inner_;     // vertices
  std::vector<std::uint32_t> vertices_;  // those that are searched: the inner ones, or half of them
  std::optional<Guide> guide_;
  std::optional<Growth> growth_;
  std::vector<Mirror> mirrors_;
  std::optional<ClassWeights> classWeights_;
  std::vector<double> weights_;  // of figures
  bool grounded_ = false;        // nothing may hang in the air
  Domains start_{0, 1};          // of blocks
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
