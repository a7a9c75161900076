// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/voting/voting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/error.h"
#include "core/random.h"
#include "search/nearest_neighbor_field.h"
#include "synth/geometry/patches/patch_vote.h"
#include "synth/geometry/pyramid/place_window.h"
#include "synth/geometry/pyramid/pyramid.h"
#include "synth/geometry/seams/assembly.h"
#include "synth/geometry/seams/level_seams.h"
#include "synth/geometry/stationary.h"
#include "synth/geometry/voting/random_blocks.h"

namespace exemplar {
namespace {

/// Above this many pairs of patches the search is by PatchMatch.
constexpr double kExactPairs = 3e6;
/// Iterations of PatchMatch: from random blocks, and from a field that is nearly right; for the
/// completeness term, from nothing and from the field of the round before.
constexpr int kFirstIterations = 8, kIterations = 2;
constexpr int kFirstReverseIterations = 5, kReverseIterations = 2;
/// Distance of neighboring patches where the search is by PatchMatch, samples.
constexpr int kStride = 2;
/// A mix is made again, with other borders, while an example's share of the surface is off by more
/// than this, at most so many times in all.
constexpr double kMixOff = 0.05;
constexpr int kMixes = 3;
/// Share of the work that the levels take, about; the assembly takes the rest.
constexpr double kLevelsDone = 0.8;

PyramidOptions pyramidOptions(const VotingOptions& options) {
  PyramidOptions pyramid{options.size, options.patch, kStride, options.truncation,
                         options.periodic};
  if (options.kept) {
    pyramid.kept = &*options.kept;
    pyramid.keptOffsets = options.keptOffsets;
  }
  if (options.guide) pyramid.guide = &*options.guide;
  return pyramid;
}

void check(std::span<const DistanceField* const> examples, const VotingOptions& options) {
  const auto fail = [](const std::string& what) { throw InputError(what); };
  checkPyramid(examples, options.rotations, pyramidOptions(options), options.levels);
  if (options.rounds < 1 || options.rounds > 100)
    fail("`rounds` " + std::to_string(options.rounds) + ": expected 1 to 100");
  if (!(options.completeness > 0)) fail("`completeness` must be above 0");
  if (options.kept && options.kept->size() != options.size)
    fail("what is kept is given for a result of another size");
  if (options.kept && !options.keptOffsets.empty()) {
    for (const std::uint8_t kept : options.kept->values())
      if (kept > options.keptOffsets.size()) fail("what is kept has no offset");
  }
  if (options.guide && options.guide->size() != options.size)
    fail("the guide is for a result of another size");
  if (!options.start.empty()) {
    const int shrink = options.levels ? 1 << (*options.levels - 1) : 0;
    Vec3i coarsest;
    for (int axis = 0; axis < 3 && shrink > 0; ++axis)
      coarsest[axis] = (options.size[axis] + shrink - 1) / shrink;
    if (options.start.size() != coarsest || examples.size() > 1 || options.rotations)
      fail("the start is for a result of another size, or of other `levels` or examples");
  }
  if (!(options.guideWeight > 0)) fail("the guide's weight must be above 0");
}

Channels channels(const Array3D<float>& values, const Array3D<float>& guide) {
  if (guide.empty()) return {values};
  return {values, guide};
}

/// The completeness term: how welcome each position of the source is, 1 / (alpha + the distance of
/// its patch to the nearest in the target). `reverse`, the field that this is found by, is kept
/// from round to round.
Array3D<float> welcome(const PyramidLevel& level, const Array3D<float>& target, double alpha,
                       NearestNeighborFieldOptions search, NearestNeighborField& reverse,
                       const Progress& progress) {
  const NearestNeighborField previous = std::move(reverse);
  search.method = NeighborMethod::PatchMatch;
  search.stride = {1, 1, 1};
  search.sourceWeight = nullptr;
  search.allowed = nullptr;
  search.places = {};
  search.placeOf = nullptr;
  search.start = previous.position.empty() ? nullptr : &previous;
  search.iterations = search.start ? kReverseIterations : kFirstReverseIterations;
  reverse = nearestNeighborField({target}, {level.source.values}, search, progress);
  progress.check();
  Array3D<float> weight(level.source.values.size(), 1.0f);
  parallelForEachCell(reverse.distance.size(), [&](const Vec3i& p) {
    // Times alpha, which changes nothing, so that it stays a number for any alpha.
    weight[p] = static_cast<float>(std::max(1e-6, 1 / (1 + reverse.distance[p] / alpha)));
  });
  return weight;
}

/// Whether there is both solid and air in what is kept; air within a voxel of the surface does not
/// count, for the region may be the solid itself, sampled a little differently.
bool keepsSurface(const DistanceField& example, const Array3D<std::uint8_t>& kept) {
  bool solid = false, air = false;
  forEachCell(kept.size(), [&](const Vec3i& p) {
    if (!kept[p]) return;
    const float v = example.values[p];
    solid = solid || v < 0;
    air = air || v > static_cast<float>(example.voxelSize);
  });
  return solid && air;
}

/// What is kept, as samples of the first example; empty where nothing is.
Array3D<std::uint8_t> keptOfExample(const DistanceField& example, const VotingOptions& options) {
  if (!options.kept) return {};
  Array3D<std::uint8_t> kept(example.size());
  forEachCell(options.size, [&](const Vec3i& p) {
    const std::uint8_t block = (*options.kept)[p];
    if (!block) return;
    const Vec3i from = options.keptOffsets.empty() ? p : p - options.keptOffsets[block - 1U];
    if (kept.contains(from)) kept[from] = 1;
  });
  return kept;
}

/// Whether a result of `size` is longer along an axis along which the example ends in air.
bool hasFartherEnd(const DistanceField& example, const Vec3i& size) {
  const Vec3i n = example.size();
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] <= n[axis]) continue;
    for (const int layer : {0, n[axis] - 1}) {
      CellBox side = CellBox::of(n);
      side.begin[axis] = layer;
      side.end[axis] = layer + 1;
      bool air = true;
      forEachCell(side, [&](const Vec3i& p) { air = air && example.values[p] > 0; });
      if (air) return true;
    }
  }
  return false;
}

/// The examples, turned in all ways that are asked for. Of the first only what is kept may be
/// copied, unless that has no surface, or the result has a farther end, which must come from
/// somewhere.
std::vector<SourcePart> sourceParts(std::span<const DistanceField* const> examples,
                                    const VotingOptions& options) {
  std::vector<SourcePart> parts;
  for (std::size_t e = 0; e < examples.size(); ++e) {
    Array3D<std::uint8_t> usable;
    if (e == 0 && options.kept && !hasFartherEnd(*examples[0], options.size)) {
      usable = keptOfExample(*examples[0], options);
      if (!keepsSurface(*examples[0], usable)) usable = {};
    }
    for (int turns = 0; turns < (options.rotations ? 4 : 1); ++turns) {
      parts.push_back({turnedField(*examples[e], turns), static_cast<int>(e), turns,
                       usable.empty() ? usable : turnedGrid(usable, turns)});
    }
  }
  return parts;
}

/// Along which axes all examples are stationary, the first as far as it is kept.
Axes findStationary(std::span<const DistanceField* const> examples, const VotingOptions& options) {
  if (options.stationary) return *options.stationary;
  const Array3D<std::uint8_t> kept = keptOfExample(*examples[0], options);
  return stationaryAxes(examples, kept.empty() ? nullptr : &kept);
}

/// A result on its way from the coarsest level to the finest.
class Voting {
 public:
  Voting(std::span<const DistanceField* const> examples, const VotingOptions& options)
      : options_(options),
        stationary_(findStationary(examples, options)),
        air_(static_cast<float>(options.truncation)),
        parts_(sourceParts(examples, options)),
        pyramid_(pyramidOptions(options)),
        levels_(options.levels.value_or(randomBlockLevels(*examples[0]))) {
    if (examples.size() > 1)
      // Side by side; on top of each other only where height makes no difference.
      regions_.emplace(examples, options.mix, options.size, Axes{true, true, stationary_.z},
                       options.periodic, options.seed);
    if (options.rotations && !(stationary_.x && stationary_.y)) {
      throw InputError(
          "`rotations` need an example that is stationary along x and y; say that it is one "
          "(`stationary` xy or xyz), or do not turn");
    }
  }

  SynthesisResult run(const Progress& progress) {
    if (!regions_) return make(progress);
    SynthesisResult best;
    double least = std::numeric_limits<double>::infinity();
    for (int attempt = 0; attempt < kMixes && least > kMixOff; ++attempt) {
      SynthesisResult made =
          make(progress.part(static_cast<double>(attempt) / kMixes, (attempt + 1.0) / kMixes));
      const double off = regions_->correct(surfaceShares(made));
      if (off >= least) continue;
      least = off;
      best = std::move(made);
    }
    best.matches = matches_;
    return best;
  }

 private:
  /// Each example's share of a result's surface.
  std::vector<double> surfaceShares(const SynthesisResult& made) const {
    std::vector<double> shares(parts_.size() / static_cast<std::size_t>(turns()));
    double all = 0;
    const Array3D<float>& values = made.field.values;
    forEachCell(values.size(), [&](const Vec3i& p) {
      for (int axis = 0; axis < 3; ++axis) {
        Vec3i q = p;
        if (++q[axis] >= values.size()[axis] || (values[p] < 0) == (values[q] < 0)) continue;
        shares[made.origins[values[p] < 0 ? p : q].example] += 1;
        all += 1;
      }
    });
    for (double& share : shares) share /= std::max(1.0, all);
    return shares;
  }

  SynthesisResult make(const Progress& progress) {
    const Progress levels = progress.part(0, kLevelsDone);
    for (int l = levels_ - 1; l >= 0; --l) {
      PyramidLevel level = makeLevel(parts_, l, pyramid_);
      sources_ = l == levels_ - 1 ? firstSources(level) : refineSources(level_, sources_, level);
      level_ = std::move(level);
      pinSources(level_, sources_);
      target_ = gather(level_, sources_);
      pinTarget(level_, air_, target_);
      matchAndVote(l, levelProgress(levels, l, levels_));
    }
    SynthesisResult result = assemble(parts_, level_, sources_, target_, options_.size,
                                      pyramid_.kept, progress.part(kLevelsDone, 1));
    result.matches = matches_;
    return result;
  }

  std::string stage(int l) const {
    return "voting, level " + std::to_string(levels_ - l) + " of " + std::to_string(levels_);
  }

  /// The number of turned parts that each example has.
  int turns() const { return options_.rotations ? 4 : 1; }

  /// The example that is wanted around a sample of a level's target, its margins included.
  int exampleAt(const PyramidLevel& level, int l, const Vec3i& p) const {
    const Vec3i inside = level.target.wrapped(p);
    if (!level.target.kept.empty() && level.target.kept[inside]) return 0;
    Vec3d place;
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = std::ldexp(inside[axis] - level.target.margin.before[axis] + 0.5, l) - 0.5;
    return regions_->at(place);
  }

  bool isStarted() const { return !options_.start.empty(); }

  /// What `start` says, and around it what lies around the example.
  PyramidSources startSources(const PyramidLevel& level) const {
    PyramidSources sources(level.target.framed());
    parallelForEachCell(sources.size(), [&](const Vec3i& p) {
      const Vec3i at = p - level.target.margin.before, inside = options_.start.clamped(at);
      const Vec3i cell = options_.start[inside] + at - inside + level.source.parts[0].begin;
      sources[p] = level.source.values.clamped(cell);
    });
    return sources;
  }

  PyramidSources firstSources(const PyramidLevel& level) const {
    if (isStarted()) return startSources(level);
    const auto count = static_cast<std::uint32_t>(turns());
    return randomBlocks(level, stationary_, options_.seed, [&](const Vec3i& p) -> PartRange {
      if (!regions_) return {0, count};
      return {count * static_cast<std::uint32_t>(exampleAt(level, levels_ - 1, p)), count};
    });
  }

  /// Where the patches of each example begin in the source.
  std::vector<CellBox> findPlaces() const {
    const LevelSource& source = level_.source;
    std::vector<CellBox> places;
    for (std::size_t part = 0; part < parts_.size(); part += static_cast<std::size_t>(turns())) {
      CellBox place = source.framed(part);
      for (std::size_t turned = part + 1; turned < part + static_cast<std::size_t>(turns());
           ++turned)
        place.end = max(place.end, source.framed(turned).end);
      place.end = place.end - level_.patch + Vec3i{1, 1, 1};
      places.push_back(place);
    }
    return places;
  }

  /// Which example each patch is of, by its middle.
  Array3D<std::uint16_t> findPlaceOf(int l, const Vec3i& stride) const {
    const Vec3i last = level_.target.framed() - level_.patch;
    const Vec3i half{level_.patch.x / 2, level_.patch.y / 2, level_.patch.z / 2};
    Array3D<std::uint16_t> placeOf(
        {last.x / stride.x + 1, last.y / stride.y + 1, last.z / stride.z + 1});
    parallelForEachCell(placeOf.size(), [&](const Vec3i& p) {
      placeOf[p] = static_cast<std::uint16_t>(exampleAt(level_, l, scaled(p, stride) + half));
    });
    return placeOf;
  }

  /// How a level's patches are searched for.
  NearestNeighborFieldOptions searchOf(bool guided) const {
    const LevelSource& source = level_.source;
    NearestNeighborFieldOptions search;
    search.patch = level_.patch;
    for (int axis = 0; axis < 3; ++axis) {
      // A guide says where things are. Turned parts are only taken of what is stationary.
      const bool free = stationary_[axis] || guided || options_.kept || isStarted();
      search.window[axis] = free ? -1 : placeWindow(level_, axis);
    }
    if (!source.matchable.empty()) search.allowed = &source.matchable;
    const Vec3i places = source.values.size() - level_.patch + Vec3i{1, 1, 1};
    const bool exact =
        static_cast<double>(volume(level_.target.framed())) * static_cast<double>(volume(places)) <
        kExactPairs;
    search.method = exact ? NeighborMethod::Exact : NeighborMethod::PatchMatch;
    search.stride = exact ? Vec3i{1, 1, 1} : min(Vec3i{kStride, kStride, kStride}, level_.patch);
    return search;
  }

  /// The level's guide, weighted.
  LevelGuide weightedGuide() const {
    LevelGuide guide = level_.guide;
    const auto weight = static_cast<float>(std::sqrt(options_.guideWeight));
    for (float& v : guide.source.values()) v *= weight;
    for (float& v : guide.target.values()) v *= weight;
    return guide;
  }

  /// Rounds of matches and votes of all patches on a level, and its seams cut.
  void matchAndVote(int l, const Progress& progress) {
    const bool coarse = l > 0 || levels_ == 1;
    const bool guided = level_.guide.any() && coarse;
    const LevelGuide guide = guided ? weightedGuide() : LevelGuide{};
    NearestNeighborFieldOptions search = searchOf(guided);
    std::vector<CellBox> places;
    Array3D<std::uint16_t> placeOf;
    if (regions_) {
      places = findPlaces();
      placeOf = findPlaceOf(l, search.stride);
      search.places = places;
      search.placeOf = &placeOf;
    }

    // The finest level only has detail to add, and most of the work.
    const int rounds = l > 0 ? options_.rounds : (2 * options_.rounds + 2) / 3;
    const Progress voting = progress.part(0, l > 0 ? 0.8 : 1);
    NearestNeighborField field, reverse;
    Array3D<float> weight;
    for (int round = 0; round < rounds; ++round) {
      const Progress both =
          voting.part(static_cast<double>(round) / rounds, static_cast<double>(round + 1) / rounds);
      both.report(stage(l), 0);
      search.seed = Random(options_.seed, stream::kPatchSearch).bits(l, round);
      search.iterations = round == 0 && l == levels_ - 1 ? kFirstIterations : kIterations;
      const NearestNeighborField previous =
          round == 0 ? fieldOf(level_, sources_, search.stride) : std::move(field);
      search.start = &previous;
      const bool complete = std::isfinite(options_.completeness) && coarse;
      if (complete) {
        weight =
            welcome(level_, target_, options_.completeness, search, reverse, both.part(0, 0.5));
        search.sourceWeight = &weight;
      }
      field = nearestNeighborField(channels(level_.source.values, guide.source),
                                   channels(target_, guide.target), search,
                                   both.part(complete ? 0.5 : 0, 1));
      progress.check();
      matches_ += volume(field.position.size());
      target_ = vote(level_, field, level_.target.framed(), progress);
      pinTarget(level_, air_, target_);
    }
    sources_ = plurality(level_, field, level_.target.framed(), nullptr, progress);
    pinSources(level_, sources_);
    if (l > 0) cutSeams(level_, target_, sources_, progress.part(0.8, 1));
  }

  const VotingOptions& options_;
  Axes stationary_;
  float air_;
  std::vector<SourcePart> parts_;
  PyramidOptions pyramid_;
  int levels_;
  std::optional<ExampleRegions> regions_;  ///< of several examples

  std::int64_t matches_ = 0;
  PyramidLevel level_;
  PyramidSources sources_;
  Array3D<float> target_;
};

}  // namespace

SynthesisResult synthesizeByVoting(const DistanceField& example, const VotingOptions& options,
                                   const Progress& progress) {
  const DistanceField* examples[] = {&example};
  return synthesizeByVoting(examples, options, progress);
}

SynthesisResult synthesizeByVoting(std::span<const DistanceField* const> examples,
                                   const VotingOptions& options, const Progress& progress) {
  check(examples, options);
  VotingOptions given = options;
  if (given.kept) {
    // Only what the first example holds can be kept.
    forEachCell(given.kept->size(), [&](const Vec3i& p) {
      std::uint8_t& kept = (*given.kept)[p];
      const Vec3i offset =
          kept && !given.keptOffsets.empty() ? given.keptOffsets[kept - 1U] : Vec3i{0, 0, 0};
      if (!examples[0]->values.contains(p - offset)) kept = 0;
    });
  }
  return Voting(examples, given).run(progress);
}

}  // namespace exemplar
