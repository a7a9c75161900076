// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/voting/voting.h"

#include <algorithm>
#include <cmath>
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
/// How much dearer or cheaper the patches of an example may become that is used more or less than
/// its share.
constexpr double kBalance = 10;
/// Share of the work that the levels take, about; the assembly takes the rest.
constexpr double kLevelsDone = 0.8;

PyramidOptions pyramidOptions(const VotingOptions& options) {
  PyramidOptions pyramid{options.size, options.patch, kStride, options.truncation,
                         options.periodic};
  if (options.kept) pyramid.kept = &*options.kept;
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
  if (options.guide && options.guide->size() != options.size)
    fail("the guide is for a result of another size");
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

/// Multiplies the prices of each example's patches, so that one that is used more than its share
/// becomes dearer: examples that do not go together would otherwise drive each other out.
void balanceExamples(const PyramidLevel& level, const std::vector<SourcePart>& parts,
                     const NearestNeighborField& field, Array3D<float>& weight) {
  const int examples = parts.back().example + 1;
  std::vector<double> used(examples);
  for (const Vec3i& p : field.position.values()) ++used[parts[level.source.partOf(p)].example];
  const double share = static_cast<double>(field.position.count()) / examples;
  if (weight.empty()) weight = Array3D<float>(level.source.values.size(), 1.0f);
  parallelForEachCell(weight.size(), [&](const Vec3i& p) {
    const double use = used[parts[level.source.partOf(p)].example] / share;
    weight[p] *= static_cast<float>(std::clamp(use * use, 1 / kBalance, kBalance));
  });
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

/// The examples, turned in all ways that are asked for. Where a part of the first with its surface
/// is kept, that is all that is copied of it.
std::vector<SourcePart> sourceParts(std::span<const DistanceField* const> examples,
                                    const VotingOptions& options) {
  std::vector<SourcePart> parts;
  for (std::size_t e = 0; e < examples.size(); ++e) {
    Array3D<std::uint8_t> usable;
    if (e == 0 && options.kept && keepsSurface(*examples[0], *options.kept)) {
      usable = Array3D<std::uint8_t>(examples[0]->size());
      forEachCell(usable.size(), [&](const Vec3i& p) {
        usable[p] = options.kept->contains(p) && (*options.kept)[p] ? 1 : 0;
      });
    }
    for (int turns = 0; turns < (options.rotations ? 4 : 1); ++turns) {
      parts.push_back({turnedField(*examples[e], turns), static_cast<int>(e), turns,
                       usable.empty() ? usable : turnedGrid(usable, turns)});
    }
  }
  return parts;
}

/// A result on its way from the coarsest level to the finest.
class Voting {
 public:
  Voting(std::span<const DistanceField* const> examples, const VotingOptions& options)
      : options_(options),
        stationary_(options.stationary
                        ? *options.stationary
                        : stationaryAxes(examples, options.kept ? &*options.kept : nullptr)),
        air_(static_cast<float>(options.truncation)),
        parts_(sourceParts(examples, options)),
        pyramid_(pyramidOptions(options)),
        levels_(options.levels.value_or(randomBlockLevels(*examples[0]))) {
    if (options.rotations && !(stationary_.x && stationary_.y)) {
      throw InputError(
          "`rotations` need an example that is stationary along x and y; say that it is one "
          "(`stationary` xy or xyz), or do not turn");
    }
  }

  SynthesisResult run(const Progress& progress) {
    const Progress levels = progress.part(0, kLevelsDone);
    for (int l = levels_ - 1; l >= 0; --l) {
      PyramidLevel level = makeLevel(parts_, l, pyramid_);
      sources_ = l == levels_ - 1 ? randomBlocks(level, stationary_, options_.seed)
                                  : refineSources(level_, sources_, level);
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

 private:
  std::string stage(int l) const {
    return "voting, level " + std::to_string(levels_ - l) + " of " + std::to_string(levels_);
  }

  /// How a level's patches are searched for.
  NearestNeighborFieldOptions searchOf(bool guided) const {
    const LevelSource& source = level_.source;
    NearestNeighborFieldOptions search;
    search.patch = level_.patch;
    for (int axis = 0; axis < 3; ++axis) {
      // A guide says where things are, and parts side by side have no common place along x, nor
      // along axes on which they differ in size.
      bool free = stationary_[axis] || guided || options_.kept || (axis == 0 && parts_.size() > 1);
      for (const CellBox& part : source.parts) {
        free = free || part.size()[axis] != source.parts[0].size()[axis];
      }
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
      if (parts_.back().example > 0 && l > 0) {
        if (!search.sourceWeight) weight = {};
        balanceExamples(level_, parts_, previous, weight);
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
      if (!examples[0]->values.contains(p)) (*given.kept)[p] = 0;
    });
  }
  return Voting(examples, given).run(progress);
}

}  // namespace exemplar
