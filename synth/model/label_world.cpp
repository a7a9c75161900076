// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/label_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/cells.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/random.h"
#include "synth/model/anneal.h"
#include "synth/model/catalog.h"
#include "synth/model/patch_alignment.h"
#include "synth/model/patch_move.h"

namespace exemplar {
namespace {

/// Columns along each side of the labeling that a world begins with.
constexpr int kStart = 96;
/// Places of it that are looked at for a window, and how many of these are tried.
constexpr int kPlaces = 24, kTries = 3;
/// How far within the free columns of a window its place begins: where none can be put in, further.
constexpr std::array<int, 3> kInner{2, 5, 9};
/// How far rims around its conflicts reach, at first and at most.
constexpr int kRim = 2, kWidestRim = 9;
/// The share of the request's moves that are made in each phase, and how hot the first ones are.
constexpr double kMoves = 1.0 / 16, kHot = 4;

/// A number for each window of each phase: two coordinates of 31 bits, which is more than tiles
/// reach.
std::uint64_t numberOf(const PlanePoint& window) {
  return (static_cast<std::uint64_t>(window.x) & 0x7fffffff) << 31 |
         (static_cast<std::uint64_t>(window.y) & 0x7fffffff);
}

std::vector<double> sharesOf(std::span<const LabelGrid> grids, int labels) {
  std::vector<double> shares(static_cast<std::size_t>(labels), 0);
  double all = 0;
  for (const LabelGrid& grid : grids) {
    for (const Label label : grid.cells.values()) shares[label] += 1;
    all += static_cast<double>(grid.cells.count());
  }
  for (double& share : shares) share /= all;
  return shares;
}

/// How far apart cells along x or y are at most of which a rule speaks.
int reachOf(const Adjacency& adjacency) {
  int reach = 1;
  for (const PairRule& rule : adjacency.rules)
    reach = std::max({reach, std::abs(rule.offset.x), std::abs(rule.offset.y)});
  return reach;
}

/// The request of a window: free along x and y, where the rim says what fits.
ModelOptions windowOptions(ModelOptions options, int side) {
  options.size.x = options.size.y = side;
  for (int s = 0; s < 4; ++s) options.sides[s] = {SideRule::Kind::Free, {}};
  return options;
}

}  // namespace

void requireLocal(const ModelOptions& o) {
  const auto refuse = [](const std::string& key, const std::string& why) {
    throw InputError("`" + key + "`: " + why + "; leave it out");
  };
  const std::string whole = "speaks of a whole result, and a world has no end";
  if (!o.counts.empty()) refuse("count", whole);
  if (!o.connected.empty()) refuse("connect", whole);
  const ModelSymmetry& symmetry = o.symmetry;
  if (symmetry.mirrorX || symmetry.mirrorY) refuse("mirror", whole);
  if (symmetry.turns > 1) refuse("turns", whole);
  if (symmetry.any()) refuse("copies", whole);
  if (o.periodic.any()) refuse("periodic", "a world does not repeat");
  if (o.frames > 1 || o.loop) refuse("frames", "a world does not change over time");
  if (o.metropolis) refuse("metropolis", "windows of a world are not modified so");
  if (!o.pins.empty()) refuse("pin", "a world has no decided cells yet");
  if (!o.mask.empty()) refuse("mask", "is as large as a result, and a world has no end");
  if (!o.weightMaps.empty())
    refuse("weight-map", "is as large as a result, and a world has no end");
}

double shareDifference(const LabelGrid& grid, std::span<const LabelGrid> examples) {
  const int labels = examples.front().labelCount();
  const std::vector<double> here = sharesOf({&grid, 1}, labels), there = sharesOf(examples, labels);
  double sum = 0;
  for (std::size_t label = 0; label < here.size(); ++label)
    sum += std::abs(here[label] - there[label]);
  return sum / 2;
}

ModelResult labelWorldStart(std::span<const LabelGrid> examples, const Adjacency& adjacency,
                            const ModelOptions& options, const Progress& progress) {
  requireLocal(options);
  for (int axis = 0; axis < 2; ++axis) {
    if (adjacency.rules[axis].pairs.empty())
      throw InputError(std::string("the example is one cell thick along ") + "xy"[axis] +
                       ", and nothing says how a world goes on there");
  }
  ModelOptions request = options;
  request.size.x = request.size.y = kStart;
  request.periodic.x = request.periodic.y = true;
  request.seed = Random(options.seed, stream::kWorldStart).bits(0);
  ModelResult best;
  double least = 2;
  // With sides that count as free model synthesis begins with a labeling of its own.
  for (const SideRule::Kind kind : {SideRule::Kind::Example, SideRule::Kind::Free}) {
    for (int s = 0; s < 4; ++s) request.sides[s] = {kind, {}};
    const bool first = kind == SideRule::Kind::Example;
    ModelResult made = synthesizeModel(examples, adjacency, request,
                                       first ? progress.part(0, 0.5) : progress.part(0.5, 1));
    if (made.outcome != Outcome::Complete) {
      if (first) best = std::move(made);
      continue;
    }
    const double difference = shareDifference(made.grid(), examples);
    if (difference >= least) continue;
    least = difference;
    best = std::move(made);
  }
  return best;
}

struct LabelWorld::State {
  State(std::vector<LabelGrid> grids, Adjacency rules, const ModelOptions& request, LabelGrid begin,
        const WindowLattice& windows, WindowCache& cache);

  void make(int phase, const PlanePoint& window, std::span<Label> columns,
            const Progress& progress) const;
  std::optional<LabelSets> within(std::span<const Label> labels) const;
  void lay(const LabelSets& base, const Random& random, std::vector<Label>& labels,
           const Progress& progress) const;

  std::vector<LabelGrid> examples;
  Adjacency adjacency;
  LabelGrid start;
  WindowLattice lattice;
  int side;  // of a window with its rim, columns
  ModelOptions options;
  ModelProblem problem;  // of any window
  LabelSets base;        // what may be in it, whatever its rim is
  LabelChooser chooser;
  PatchGoal goal;
  std::vector<PatchSource> places;  // the start, and so much more that every window is in it
  PatchAlignments alignments;
  PhasedPlane plane;
};

LabelWorld::State::State(std::vector<LabelGrid> grids, Adjacency rules, const ModelOptions& request,
                         LabelGrid begin, const WindowLattice& windows, WindowCache& cache)
    : examples(std::move(grids)),
      adjacency(std::move(rules)),
      start(std::move(begin)),
      lattice(windows),
      side(windows.pitch + windows.separator),
      options(windowOptions(request, side)),
      problem(adjacency, options),
      base(problem.domains(problem.demands())),
      chooser(problem, examples),
      goal(problem, examples),
      places([&] {
        LabelGrid unrolled = start;
        const Vec3i n = start.size();
        unrolled.cells = Array3D<Label>({n.x + side, n.y + side, n.z}, 0);
        forEachCell(unrolled.size(), [&](const Vec3i& p) {
          unrolled.cells[p] = start.cells[{p.x % n.x, p.y % n.y, p.z}];
        });
        return patchSources(problem, {&unrolled, 1});
      }()),
      alignments(problem, places),
      plane(lattice,
            {static_cast<std::size_t>(options.size.z) * sizeof(Label),
             [this](const PlaneBox& box, std::span<char> columns) {
               const Vec3i n = start.size();
               char* to = columns.data();
               for (std::int64_t x = box.begin.x; x < box.end.x; ++x) {
                 for (std::int64_t y = box.begin.y; y < box.end.y; ++y) {
                   const int i = static_cast<int>(x - floorDivide(x, n.x) * n.x);
                   const int j = static_cast<int>(y - floorDivide(y, n.y) * n.y);
                   for (int k = 0; k < n.z; ++k, to += sizeof(Label))
                     std::memcpy(to, &start.cells[{i, j, k}], sizeof(Label));
                 }
               }
             },
             [this](int phase, const PlanePoint& window, const PlaneBox&, std::span<char> columns,
                    const Progress& progress) {
               std::vector<Label> labels(columns.size() / sizeof(Label));
               std::memcpy(labels.data(), columns.data(), columns.size());
               make(phase, window, labels, progress);
               std::memcpy(columns.data(), labels.data(), columns.size());
             }},
            cache) {
  Catalog catalog(problem.network());
  for (int c = 0; c < problem.network().cells; ++c) catalog.setDomain(c, base[c]);
  if (!catalog.propagateAll({})) throw InputError("the example's labels do not fit a world");
  for (int c = 0; c < problem.network().cells; ++c)
    std::copy(catalog.domain(c).begin(), catalog.domain(c).end(), base[c].begin());
}

/// What may be in a window whose rim stays as it is; nothing where the labels do not fit, which
/// cannot be.
std::optional<LabelSets> LabelWorld::State::within(std::span<const Label> labels) const {
  const int rim = lattice.separator;
  Catalog catalog(problem.network());
  for (int c = 0; c < problem.network().cells; ++c) catalog.setDomain(c, base[c]);
  std::vector<LabelWord> one(static_cast<std::size_t>(base.words()));
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      if (x >= rim && y >= rim && x < side - rim && y < side - rim) continue;
      for (int z = 0; z < options.size.z; ++z) {
        const int cell = problem.cell(problem.position({x, y, z}));
        if (!containsLabel(base[cell], labels[cell])) return std::nullopt;
        std::fill(one.begin(), one.end(), 0);
        addLabel(one, labels[cell]);
        catalog.setDomain(cell, one);
        catalog.touch(cell);
      }
    }
  }
  if (!catalog.propagate()) return std::nullopt;
  LabelSets sets(problem.network().labels, static_cast<std::size_t>(problem.network().cells));
  for (int c = 0; c < problem.network().cells; ++c)
    std::copy(catalog.domain(c).begin(), catalog.domain(c).end(), sets[c].begin());
  return sets;
}

/// Puts another place of the start into a window.
void LabelWorld::State::lay(const LabelSets& sets, const Random& random, std::vector<Label>& labels,
                            const Progress& progress) const {
  PatchMove::Window window{{side / 2, side / 2, 0}, 0, side / 2 + 1};
  const Vec3i& c = window.center;
  const auto inner = [&](int by) {
    return CellBox{Vec3i{by, by, 0} - c, Vec3i{side - by, side - by, options.size.z} - c};
  };
  struct Place {
    double agrees;
    PatchMove::Alignment alignment;
  };
  Draws draws(random, 0);
  std::vector<Place> list;
  const Vec3i n = start.size();
  for (int i = 0; i < kPlaces; ++i) {
    PatchMove::Alignment a;
    a.cell = Vec3i{draws.below(n.x), draws.below(n.y), 0} + c;
    list.push_back(
        {alignments.agreement(window, a, inner(lattice.separator + kInner[0]), labels), a});
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Place& a, const Place& b) { return a.agrees > b.agrees; });
  PatchMove move(problem, sets, chooser, places);
  std::vector<PatchMove::Before> before;
  std::uint64_t attempt = 1;
  for (const int by : kInner) {
    PatchMove::Patch patch;
    patch.core = inner(lattice.separator + by);
    if (patch.core.empty()) return;
    patch.grown = inner(0);
    patch.rim = kRim;
    patch.widestRim = kWidestRim;
    patch.mostConflicts = patch.mostChanged = patch.mostImplied = 1 << 20;
    patch.mostInRim = 6000;
    patch.rimConflicts = 60;
    for (int i = 0; i < kTries; ++i) {
      const auto outcome = move.make(
          window, list[i].alignment, patch, random.fork(attempt++), labels, before,
          [] { return true; }, progress);
      if (outcome == PatchMove::Outcome::Made) return;
    }
  }
}

void LabelWorld::State::make(int phase, const PlanePoint& window, std::span<Label> columns,
                             const Progress& progress) const {
  std::vector<Label> labels(columns.begin(), columns.end());
  const std::optional<LabelSets> sets = within(labels);
  if (!sets) return;  // it fits as it is
  const Random random = Random(options.seed, stream::kWorldWindows)
                            .fork(static_cast<std::uint64_t>(phase))
                            .fork(numberOf(window));
  if (phase < WindowLattice::phases) lay(*sets, random, labels, progress);
  // Windows are many and small: they hear of cancellation, and report nothing.
  const Progress hearing([&](std::string_view, double) { progress.check(); });
  ModelStatistics statistics;
  const AnnealSchedule schedule{
      .moves = options.moves * kMoves, .hot = kHot, .looks = 16, .shift = 16};
  annealPatches(problem, *sets, chooser, goal, random.bits(0), labels, schedule, statistics,
                hearing);
  std::copy(labels.begin(), labels.end(), columns.begin());
}

LabelWorld::LabelWorld(std::vector<LabelGrid> examples, Adjacency adjacency,
                       const ModelOptions& options, LabelGrid start, const WindowLattice& lattice,
                       WindowCache& cache) {
  requireLocal(options);
  WindowLattice own = lattice;
  own.separator = std::max(own.separator, reachOf(adjacency));
  if (own.pitch < 3 * (own.separator + 1))
    throw InputError("`window`: must be at least " + std::to_string(3 * (own.separator + 1)) +
                     " columns for rules that reach " + std::to_string(own.separator));
  state_ = std::make_unique<State>(std::move(examples), std::move(adjacency), options,
                                   std::move(start), own, cache);
}

LabelWorld::~LabelWorld() = default;

LabelGrid LabelWorld::region(const PlaneBox& box, const Progress& progress) const {
  const int z = state_->options.size.z;
  requireMemory(static_cast<double>(box.columns()) * z * 3 * sizeof(Label),
                "a region of " + std::to_string(box.size(0)) + " x " + std::to_string(box.size(1)) +
                    " columns",
                "make fewer tiles at once");
  const std::string columns = state_->plane.columns(box, progress);
  const LabelGrid& example = state_->examples.front();
  LabelGrid grid;
  grid.labels = example.labels;
  grid.cellSize = example.cellSize;
  grid.origin = example.origin;
  grid.name = example.name;
  const Vec3i size{static_cast<int>(box.size(0)), static_cast<int>(box.size(1)), z};
  grid.cells = Array3D<Label>(size, 0);
  const char* from = columns.data();
  for (int x = 0; x < size.x; ++x)
    for (int y = 0; y < size.y; ++y)
      for (int k = 0; k < z; ++k, from += sizeof(Label))
        std::memcpy(&grid.cells[{x, y, k}], from, sizeof(Label));
  return grid;
}

}  // namespace exemplar
