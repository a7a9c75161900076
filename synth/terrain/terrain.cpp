// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/terrain.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "maps/height_map.h"
#include "synth/terrain/bent_heights.h"
#include "synth/terrain/gradient_direction.h"
#include "synth/terrain/gradient_domain.h"
#include "synth/terrain/height_patches.h"
#include "synth/terrain/height_pieces.h"
#include "synth/terrain/height_pyramid.h"
#include "synth/terrain/outlets.h"
#include "synth/terrain/standing_water.h"
#include "synth/terrain/terrain_sources.h"

namespace exemplar {
namespace {

/// Rounds there, where the layout is found.
constexpr int kCoarsestRounds = 8;
/// What the height at which a patch lies counts, where the layout is found and after.
constexpr double kCoarsestLevel = 0.3, kFinerLevel = 0.05;
/// Patches are looked for everywhere while this many comparisons suffice for a round.
constexpr double kMostComparisons = 2.5e6;
/// Over how many samples heights follow the steps of their pieces rather than the vote.
constexpr double kStepReach = 16;
/// By how much detail is strengthened at most.
constexpr double kMostStrength = 1.5;
/// Where outlets are given, the coarse resolutions down to this one are made up to so many times,
/// until what is cut there is, on average, no more than this share of the examples' relief.
constexpr int kLayoutLevel = 2, kLayouts = 4;
constexpr double kShallowCuts = 0.0006;
/// How far hollows are filled before an outlet is cut: little while finer resolutions still give
/// the cut its valley, by half at the end.
constexpr double kFillBefore = 0.2, kFillAtLast = 0.5;
/// The least lakes of a result, samples.
constexpr std::size_t kLeastLake = 24;

template <class Body>
void forRows(int height, const Body& body) {
  parallelFor(0, static_cast<std::size_t>(height), 8, [&](std::size_t y0, std::size_t y1) {
    for (std::size_t y = y0; y < y1; ++y) body(static_cast<int>(y));
  });
}

/// What is known of the result on a resolution.
struct LevelControl {
  Grid<float> guide, guideWeight, given, hold;
  Grid<std::uint8_t> held;     ///< 1 where nothing changes
  Grid<std::uint8_t> outlets;  ///< 1 where water leaves; empty: at the border
};

class Synthesis {
 public:
  Synthesis(const TerrainSources& sources, const TerrainSynthesisOptions& options)
      : options_(options),
        examples_(sources.examples),
        levels_(sources.levels),
        fall_(sources.fall),
        hollows_(sources.hollows),
        turns_(sources.turns),
        pyramid_(sources.pyramid),
        guided_(!options.control.guide.empty()),
        seed_(options.seed) {
    // A guide has heights of its own.
    if (!guided_) seaLevel_ = seaLevelOf(pyramid_.front());
    guideLevel_ = options.control.guideLevel < 0
                      ? levels_ - 1
                      : std::min(options.control.guideLevel, levels_ - 1);
    prepareControl();
  }

  SynthesizedTerrain run(const Progress& progress) {
    SynthesizedTerrain made;
    made.levels = levels_;
    made.turns = turns_;
    Grid<float> heights;
    Grid<HeightOrigin> origins;
    double all = 0, done = 0;
    for (int l = 0; l < levels_; ++l) all += std::pow(0.25, l);
    int l = levels_ - 1;
    if (!options_.control.outlets.empty() && levels_ > kLayoutLevel) {
      layOut(heights, origins, made, progress);
      l = kLayoutLevel - 1;
    }
    for (; l >= 0; --l) {
      const double share = std::pow(0.25, l) / all;
      makeLevel(l, heights, origins, made, progress.part(done, std::min(1.0, done + share)));
      done += share;
    }
    made.heights = std::move(heights);
    made.origins = std::move(origins);
    return made;
  }

 private:
  Pixel sizeAt(int l) const {
    Pixel size{options_.width, options_.height};
    for (int n = 0; n < l; ++n) size = {(size.x + 1) / 2, (size.y + 1) / 2};
    return size;
  }

  /// Which samples of half the resolution hold one that is marked.
  static Grid<std::uint8_t> anyOf(const Grid<std::uint8_t>& marks) {
    Grid<std::uint8_t> half((marks.width() + 1) / 2, (marks.height() + 1) / 2);
    for (int y = 0; y < marks.height(); ++y)
      for (int x = 0; x < marks.width(); ++x) half(x / 2, y / 2) |= marks(x, y);
    return half;
  }

  void prepareControl() {
    const TerrainControl& given = options_.control;
    controls_.resize(static_cast<std::size_t>(levels_));
    for (int l = 0; l < levels_; ++l) {
      LevelControl& control = controls_[static_cast<std::size_t>(l)];
      const Pixel size = sizeAt(l);
      if (!given.guide.empty() && l >= guideLevel_)
        control.guide = stretched(given.guide, size.x, size.y);
      if (!given.guideWeight.empty() && l >= guideLevel_)
        control.guideWeight = stretched(given.guideWeight, size.x, size.y);
      if (!given.outlets.empty())
        control.outlets =
            l == 0 ? given.outlets : anyOf(controls_[static_cast<std::size_t>(l - 1)].outlets);
      if (given.hold.empty()) continue;
      if (l == 0) {
        control.given = given.given;
        control.hold = given.hold;
      } else {
        const LevelControl& finer = controls_[static_cast<std::size_t>(l - 1)];
        control.given = coarser(finer.given, finer.hold);
        control.hold = coarser(finer.hold);
      }
      // Without outlets of their own, coarse resolutions lead water through what is held.
      if (l == 0 || !given.outlets.empty()) {
        control.held = Grid<std::uint8_t>(size.x, size.y);
        for (std::size_t s = 0; s < control.held.count(); ++s)
          control.held[s] = control.hold[s] >= 1;
      }
    }
  }

  /// Makes the coarse resolutions several times over, and keeps what needs the least cuts to lead
  /// its water to given outlets. Where all need many, a layout like that of the given heights,
  /// whose water runs there, is one of them.
  void layOut(Grid<float>& heights, Grid<HeightOrigin>& origins, SynthesizedTerrain& made,
              const Progress& progress) {
    const double few = kShallowCuts * relief();
    double best = std::numeric_limits<double>::infinity();
    const auto attempt = [&](int number) {
      seed_ = number == 0 ? options_.seed
                          : Random(options_.seed, stream::kTerrainStart)
                                .fork(static_cast<std::uint64_t>(number))
                                .bits(0);
      Grid<float> some;
      Grid<HeightOrigin> from;
      for (int l = levels_ - 1; l >= kLayoutLevel; --l)
        makeLevel(l, some, from, made, progress.part(0, 0));
      if (made.meanCut >= best) return false;
      best = made.meanCut;
      heights = std::move(some);
      origins = std::move(from);
      return true;
    };
    for (int n = 0; n < kLayouts && best > few; ++n) attempt(n);
    if (best <= few || guided_ || options_.control.given.empty()) return;
    Grid<float> known = options_.control.given;
    for (int l = 0; l < guideLevel_; ++l) known = coarser(known);
    Grid<float>& guide = controls_[static_cast<std::size_t>(guideLevel_)].guide;
    guide = std::move(known);
    guided_ = attempt(kLayouts);
    if (!guided_) guide = {};
  }

  void makeLevel(int l, Grid<float>& heights, Grid<HeightOrigin>& origins, SynthesizedTerrain& made,
                 const Progress& progress) {
    const HeightLevel& level = pyramid_[static_cast<std::size_t>(l)];
    LevelControl& control = controls_[static_cast<std::size_t>(l)];
    const Pixel size = sizeAt(l);
    const bool coarsest = l + 1 == levels_;
    HeightField field(size.x, size.y,
                      {.level = coarsest ? kCoarsestLevel : kFinerLevel,
                       .turns = turns_,
                       .wrapsX = options_.wrapsX,
                       .wrapsY = options_.wrapsY});
    HeightPieces pieces;
    if (coarsest) {
      begin(field, level);
      origins = field.origins(progress);
      heights = copied(level, origins);
    } else {
      pieces =
          choosePieces(pyramid_[static_cast<std::size_t>(l + 1)].sources, heights, origins, size,
                       {.size = options_.piece,
                        .sources = level.sources.size(),
                        .meanCost = kFinerLevel,
                        .seed = seed_,
                        .level = static_cast<std::uint64_t>(l),
                        .turns = turns_,
                        .wrapsX = options_.wrapsX,
                        .wrapsY = options_.wrapsY},
                       progress);
      field.begin(pieces, level.sources);
      origins = field.origins(progress);
      heights = refined(heights, origins, level);
    }
    steer(l, heights);
    const std::string stage =
        "matching, resolution " + std::to_string(levels_ - l) + " of " + std::to_string(levels_);
    const int rounds = coarsest ? std::max(kCoarsestRounds, options_.rounds) : options_.rounds;
    for (int round = 0; round < rounds; ++round) {
      progress.report(stage, 0.75 * round / rounds);
      match(field, level, l, round, heights, progress);
      if (round + 1 == rounds) break;
      heights = field.vote(level.sources, heights, progress);
      if (coarsest) spread(level, heights);
      steer(l, heights);
      // On the finest resolution, once at the end.
      if (l > 0) {
        const WaterBodies water =
            hasWater(level) ? settled(l, heights, field.origins(progress)) : WaterBodies{};
        cut(l, heights, kFillBefore, water, made, progress);
      }
    }
    origins = field.origins(progress);
    heights = field.vote(level.sources, heights, progress);
    progress.report("joining pieces", 0.75);
    followSteps(heights, stepsOf(level, control, origins), control.hold,
                {.screen = 1 / (kStepReach * kStepReach),
                 .wrapsX = options_.wrapsX,
                 .wrapsY = options_.wrapsY},
                progress.part(0.75, 0.9));
    if (!coarsest) strengthen(level, heights);
    steer(l, heights);
    progress.report("letting water run", 0.9);
    const WaterBodies water = hasWater(level) ? settled(l, heights, origins) : WaterBodies{};
    const bool guided = l == guideLevel_ && !control.guide.empty();
    const Grid<float> before = guided ? heights : Grid<float>{};
    cut(l, heights, l > 0 ? kFillBefore : kFillAtLast, water, made, progress);
    // Finer resolutions follow the guide with its outlets, or they would close them again.
    for (std::size_t s = 0; s < before.count(); ++s)
      control.guide[s] -= std::max(0.0f, before[s] - heights[s]);
  }

  double relief() const {
    double most = 0;
    for (std::size_t e = 0; e < examples_; ++e) {
      if (const auto range = rangeOf(pyramid_.front().sources[e].heights))
        most = std::max(most, range->relief());
    }
    return most;
  }

  /// Gives the layout the examples' heights: each sample becomes what has its rank there. Cuts and
  /// votes draw them together.
  void spread(const HeightLevel& level, Grid<float>& heights) const {
    // What is known of the result has heights of its own.
    const bool guidedEverywhere = guided_ && options_.control.guideWeight.empty();
    if (guidedEverywhere || !options_.control.hold.empty()) return;
    std::vector<float> wanted;
    for (std::size_t e = 0; e < examples_; ++e) {
      std::ranges::copy_if(level.sources[e].heights.values(), std::back_inserter(wanted),
                           [](float h) { return !std::isnan(h); });
    }
    std::ranges::sort(wanted);
    std::vector<std::uint32_t> order(heights.count());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(
        order, [&](std::uint32_t a, std::uint32_t b) { return heights[a] < heights[b]; });
    for (std::size_t n = 0; n < order.size(); ++n)
      heights[order[n]] = wanted[(2 * n + 1) * wanted.size() / (2 * order.size())];
  }

  static bool hasWater(const HeightLevel& level) { return !level.water.empty(); }

  static std::optional<float> seaLevelOf(const HeightLevel& finest) {
    for (std::size_t e = 0; e < finest.water.size(); ++e) {
      for (std::size_t s = 0; s < finest.water[e].count(); ++s)
        if (finest.water[e][s] == kSea) return finest.sources[e].heights[s];
    }
    return std::nullopt;
  }

  WaterBodies settled(int l, Grid<float>& heights, const Grid<HeightOrigin>& origins) const {
    return settleWater(heights, origins, pyramid_[static_cast<std::size_t>(l)].water, seaLevel_,
                       controls_[static_cast<std::size_t>(l)].held,
                       std::max<std::size_t>(4, kLeastLake >> (2 * l)),
                       (options_.wrapsX && options_.wrapsY) || !options_.control.outlets.empty());
  }

  void match(HeightField& field, const HeightLevel& level, int l, int round,
             const Grid<float>& heights, const Progress& progress) const {
    double places = 0;
    for (const HeightSource& source : level.sources) places += static_cast<double>(source.places);
    const double comparisons =
        places * static_cast<double>(turns_.size() * field.matches().count());
    const bool coarsest = l + 1 == levels_;
    // Layouts towards given outlets are made several times over.
    if (coarsest && comparisons <= kMostComparisons && options_.control.outlets.empty()) {
      field.searchAll(level.sources, heights, progress);
    } else {
      field.search(level.sources, heights, seed_, static_cast<std::uint64_t>(100 * l + round),
                   coarsest ? 24 : 4, progress);
    }
  }

  /// Large regions of the examples, from places at random.
  void begin(HeightField& field, const HeightLevel& level) const {
    const Random random(seed_, stream::kTerrainStart);
    const Grid<float>& first = level.sources.front().heights;
    const int cell = std::max(kHeightPatch, std::min(first.width(), first.height()) / 2);
    const int across = sizeAt(levels_ - 1).x / cell + 4;
    for (int row = 0; row < field.rows(); ++row) {
      for (int column = 0; column < field.columns(); ++column) {
        const Pixel at = field.place(column, row);
        // The nearest of the cells' middles, one at random in each.
        double nearest = std::numeric_limits<double>::infinity();
        std::uint64_t chosen = 0;
        Pixel middle;
        for (int cy = at.y / cell - 1; cy <= at.y / cell + 1; ++cy) {
          for (int cx = at.x / cell - 1; cx <= at.x / cell + 1; ++cx) {
            const auto key = static_cast<std::uint64_t>((cy + 1) * across + cx + 1);
            const double mx = (cx + random.uniform(key, 0)) * cell;
            const double my = (cy + random.uniform(key, 1)) * cell;
            const double distance = std::hypot(at.x - mx, at.y - my);
            if (distance >= nearest) continue;
            nearest = distance;
            chosen = key;
            middle = {static_cast<int>(mx), static_cast<int>(my)};
          }
        }
        HeightMatch match;
        match.example = static_cast<std::uint8_t>(
            random.below(static_cast<std::uint32_t>(level.sources.size()), chosen, 2));
        match.turn = static_cast<std::uint8_t>(
            turns_[random.below(static_cast<std::uint32_t>(turns_.size()), chosen, 3)]);
        const Grid<float>& from = level.sources[match.example].heights;
        const int mostX = from.width() - kHeightPatch, mostY = from.height() - kHeightPatch;
        const Pixel back = turnedStep({at.x - middle.x, at.y - middle.y}, turnedBackBy(match.turn));
        const int x = static_cast<int>(mostX * random.uniform(0.25, 0.75, chosen, 4)) + back.x;
        const int y = static_cast<int>(mostY * random.uniform(0.25, 0.75, chosen, 5)) + back.y;
        match.x = static_cast<std::int16_t>(std::clamp(x, 0, mostX));
        match.y = static_cast<std::int16_t>(std::clamp(y, 0, mostY));
        field.matches()(column, row) = match;
      }
    }
    field.leaveHoles(level.sources);
  }

  static Grid<float> copied(const HeightLevel& level, const Grid<HeightOrigin>& origins) {
    Grid<float> heights(origins.width(), origins.height());
    for (std::size_t s = 0; s < heights.count(); ++s)
      heights[s] = level.sources[origins[s].example].heights(origins[s].x, origins[s].y);
    return heights;
  }

  /// At twice the resolution: the heights between the coarse ones, with the detail that the
  /// examples have at the origins.
  Grid<float> refined(const Grid<float>& half, const Grid<HeightOrigin>& origins,
                      const HeightLevel& level) const {
    Grid<float> fine(origins.width(), origins.height());
    forRows(fine.height(), [&](int y) {
      for (int x = 0; x < fine.width(); ++x) {
        const HeightOrigin& origin = origins(x, y);
        fine(x, y) = between(half, x, y, options_.wrapsX, options_.wrapsY) +
                     level.details[origin.example](origin.x, origin.y);
      }
    });
    return fine;
  }

  /// Votes and joins take some of the detail away: gives it the examples' strength.
  void strengthen(const HeightLevel& level, Grid<float>& heights) const {
    const Grid<float> half = coarser(heights);
    Grid<float> detail(heights.width(), heights.height());
    forRows(heights.height(), [&](int y) {
      for (int x = 0; x < heights.width(); ++x)
        detail(x, y) = heights(x, y) - between(half, x, y, options_.wrapsX, options_.wrapsY);
    });
    const double own = meanSquare({&detail, 1}),
                 wanted = meanSquare(std::span(level.details).first(examples_));
    if (!(own > 0)) return;
    const auto more =
        static_cast<float>(std::clamp(std::sqrt(wanted / own), 1.0, kMostStrength) - 1);
    for (std::size_t s = 0; s < heights.count(); ++s) heights[s] += more * detail[s];
  }

  static double meanSquare(std::span<const Grid<float>> grids) {
    double sum = 0, count = 0;
    for (const Grid<float>& grid : grids) {
      for (const float v : grid.values()) {
        if (std::isnan(v)) continue;
        sum += double{v} * v;
        ++count;
      }
    }
    return count > 0 ? sum / count : 0;
  }

  /// Toward the guide, and to what is given.
  void steer(int l, Grid<float>& heights) const {
    const auto follow = static_cast<float>(options_.control.follow);
    if (!controls_[static_cast<std::size_t>(guideLevel_)].guide.empty()) {
      // The difference on the guide's resolution, brought back.
      std::vector<Grid<float>> means;
      for (int n = l; n < guideLevel_; ++n)
        means.push_back(coarser(n == l ? heights : means.back()));
      const Grid<float>& at = means.empty() ? heights : means.back();
      const LevelControl& guided = controls_[static_cast<std::size_t>(std::max(l, guideLevel_))];
      Grid<float> change(at.width(), at.height());
      for (std::size_t s = 0; s < change.count(); ++s) {
        const float weight = guided.guideWeight.empty() ? 1 : guided.guideWeight[s];
        change[s] = follow * weight * (guided.guide[s] - at[s]);
      }
      for (int n = guideLevel_ - 1; n >= l; --n) {
        const Pixel size = sizeAt(n);
        Grid<float> finer(size.x, size.y);
        forRows(size.y, [&](int y) {
          for (int x = 0; x < size.x; ++x)
            finer(x, y) = between(change, x, y, options_.wrapsX, options_.wrapsY);
        });
        change = std::move(finer);
      }
      for (std::size_t s = 0; s < heights.count(); ++s) heights[s] += change[s];
    }
    const LevelControl& control = controls_[static_cast<std::size_t>(l)];
    for (std::size_t s = 0; s < control.hold.count(); ++s) {
      if (control.hold[s] >= 1) {
        heights[s] = control.given[s];
      } else if (control.hold[s] > 0) {
        heights[s] += control.hold[s] * (control.given[s] - heights[s]);
      }
    }
  }

  /// The steps that the examples take where samples came from; between pieces the mean of both
  /// sides' steps; where heights are held, theirs.
  HeightSteps2D stepsOf(const HeightLevel& level, const LevelControl& control,
                        const Grid<HeightOrigin>& origins) const {
    const int width = origins.width(), height = origins.height();
    HeightSteps2D steps{Grid<float>(width, height), Grid<float>(width, height)};
    const auto step = [&](std::size_t from, std::size_t to, Pixel by) {
      const HeightOrigin &a = origins[from], &b = origins[to];
      const Grid<float>& ofA = level.sources[a.example].heights;
      const Grid<float>& ofB = level.sources[b.example].heights;
      const HeightOrigin on = stepped(a, by);
      const float here = ofA(a.x, a.y), there = ofB(b.x, b.y);
      float taken = there - here;
      if (!(on == b)) {
        const HeightOrigin before = stepped(b, {-by.x, -by.y});
        float sum = 0, count = 0;
        if (ofA.contains(on.x, on.y) && !std::isnan(ofA(on.x, on.y)))
          sum += ofA(on.x, on.y) - here, count += 1;
        if (ofB.contains(before.x, before.y) && !std::isnan(ofB(before.x, before.y)))
          sum += there - ofB(before.x, before.y), count += 1;
        taken = count > 0 ? sum / count : 0.0f;
      }
      if (!control.hold.empty()) {
        const float hold = std::min(control.hold[from], control.hold[to]);
        if (hold > 0) taken += hold * (control.given[to] - control.given[from] - taken);
      }
      return taken;
    };
    forRows(height, [&](int y) {
      for (int x = 0; x < width; ++x) {
        const std::size_t here = origins.index(x, y);
        steps.right(x, y) = step(here, origins.index((x + 1) % width, y), {1, 0});
        steps.down(x, y) = step(here, origins.index(x, (y + 1) % height), {0, 1});
      }
    });
    return steps;
  }

  void cut(int l, Grid<float>& heights, double fill, const WaterBodies& water,
           SynthesizedTerrain& made, const Progress& progress) const {
    if (options_.keepsHollows) return;
    // Few and small ones are faults of a survey, more of them are what the land is like.
    const Hollows& hollows = hollows_[static_cast<std::size_t>(l)];
    const bool keeps = hollows_[0].share >= kNaturalHollows;
    const LevelControl& control = controls_[static_cast<std::size_t>(l)];
    const OutletsCut cut = cutOutlets(
        heights, control.held,
        {.fill = fill,
         .fall = std::ldexp(fall_, l) * l / std::max(1, levels_ - 1),
         .bank = pyramid_[static_cast<std::size_t>(l)].bank,
         .kept = keeps ? std::span<const double>(hollows.bySize) : std::span<const double>(),
         .outlets = control.outlets,
         .hold = control.outlets.empty() ? Grid<float>{} : control.hold,
         .wrapsX = options_.wrapsX,
         .wrapsY = options_.wrapsY},
        water.bodies.empty() ? nullptr : &water, progress);
    if (seaLevel_ && !water.bodies.empty()) {
      // Beds that end at the sea end at its level.
      const Grid<std::uint8_t>& held = controls_[static_cast<std::size_t>(l)].held;
      for (std::size_t s = 0; s < heights.count(); ++s)
        if (held.empty() || !held[s]) heights[s] = std::max(heights[s], *seaLevel_);
    }
    made.flooded = cut.flooded;
    made.outlets = cut.outlets;
    made.meanCut = cut.mean;
    made.deepestCut = cut.deepest;
  }

  const TerrainSynthesisOptions& options_;
  std::size_t examples_;
  int levels_;
  int guideLevel_ = 0;
  double fall_;
  const std::vector<Hollows>& hollows_;
  std::optional<float> seaLevel_;
  const std::vector<int>& turns_;
  const std::vector<HeightLevel>& pyramid_;
  std::vector<LevelControl> controls_;  // finest first
  bool guided_;
  std::uint64_t seed_;
};

}  // namespace

SynthesizedTerrain synthesizeTerrain(std::span<const Grid<float>> examples,
                                     const TerrainSynthesisOptions& options,
                                     const Progress& progress) {
  progress.report("reading the terrain", 0);
  const TerrainSources sources = terrainSources(examples, options, progress.part(0, 0.02));
  return Synthesis(sources, options).run(progress.part(0.02, 1));
}

TerrainSynthesizer::TerrainSynthesizer(std::span<const Grid<float>> examples,
                                       const TerrainSynthesisOptions& options,
                                       const Progress& progress)
    : options_(options),
      sources_(std::make_unique<TerrainSources>(terrainSources(examples, options, progress))) {}
TerrainSynthesizer::~TerrainSynthesizer() = default;

SynthesizedTerrain TerrainSynthesizer::make(std::uint64_t seed, const TerrainControl& control,
                                            const Progress& progress) const {
  TerrainSynthesisOptions options = options_;
  options.seed = seed;
  options.control = control;
  return Synthesis(*sources_, options).run(progress);
}

}  // namespace exemplar
