// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/optimize.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/memory.h"
#include "core/random.h"
#include "search/nearest_neighbor_field.h"
#include "synth/geometry/assembly.h"
#include "synth/geometry/bad_seams.h"
#include "synth/geometry/level_seams.h"
#include "synth/geometry/patch_vote.h"
#include "synth/geometry/pyramid.h"
#include "synth/geometry/repetition.h"
#include "synth/geometry/start.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kSearchStream = 0x0b72;
/// Above this many pairs of patches the search is by PatchMatch.
constexpr double kExactPairs = 3e6;
/// Iterations of PatchMatch: from random blocks, and from a field that is nearly right.
constexpr int kFirstIterations = 8, kIterations = 2;
/// Distance of neighbouring patches where the search is by PatchMatch.
constexpr int kStride = 2;

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
  search.iterations = search.start ? 2 : 5;
  reverse = nearestNeighborField({target}, {level.source}, search, progress);
  Array3D<float> weight(level.source.size(), 1.0f);
  for (std::size_t s = 0; s < reverse.distance.count(); ++s) {
    // Times alpha, which changes nothing, so that it stays a number for any alpha.
    weight[reverse.distance.ijk(s)] =
        static_cast<float>(std::max(1e-6, 1 / (1 + reverse.distance.values()[s] / alpha)));
  }
  return weight;
}

void check(std::span<const DistanceField* const> examples, const OptimizeOptions& options) {
  const auto fail = [](const std::string& what) { throw InputError(what); };
  if (examples.empty()) fail("there is no example");
  if (examples.size() > 255) fail("more than 255 examples");
  std::int64_t along = 0;
  for (const DistanceField* example : examples) {
    if (volume(example->size()) == 0) fail("the example has no samples");
    if (std::abs(example->voxelSize / examples[0]->voxelSize - 1) > 1e-3) {
      fail("the examples' voxels differ in size; sample them alike");
    }
    const Vec3i n = example->size();
    for (int axis = 0; axis < 3; ++axis) {
      if (n[axis] > 32767) fail("the example is longer than 32,767 samples");
    }
    along += options.rotations ? 2 * (n.x + n.y + 2) : n.x + 1;
  }
  if (along > 32767) fail("the examples are longer than 32,767 samples, turned and side by side");
  for (int axis = 0; axis < 3; ++axis) {
    if (options.size[axis] < 1) fail("the result's size must be at least 1 sample along each axis");
  }
  if (options.patch < 3 || options.patch > 15)
    fail("patch " + std::to_string(options.patch) + ": expected 3 to 15");
  if (options.levels && (*options.levels < 1 || *options.levels > 8)) {
    fail("levels " + std::to_string(*options.levels) + ": expected 1 to 8");
  }
  if (options.rounds < 1 || options.rounds > 100)
    fail("rounds " + std::to_string(options.rounds) + ": expected 1 to 100");
  if (!(options.truncation > 0)) fail("truncation must be above 0");
  if (!(options.completeness > 0)) fail("completeness must be above 0");
  if (options.kept && options.kept->size() != options.size)
    fail("what is kept is told for a result of another size");
  if (options.guide && options.guide->size() != options.size)
    fail("the guide is for a result of another size");
  if (!(options.guideWeight > 0)) fail("the guide's weight must be above 0");
  requireMemory(120.0 * static_cast<double>(volume(options.size)), "a result of this size",
                "use a lower resolution or a smaller scale");
}

/// Whether the result may start from large blocks of the example. What must be somewhere (kept,
/// guided) and examples that meet start from small ones, which are optimised on all levels; so does
/// what must meet its other side, unless it repeats. So does more of a ground that slopes: the ends
/// of large blocks of it would meet in cliffs.
bool takesLargeBlocks(const OptimizeOptions& options, const std::vector<SourcePart>& parts,
                      const DistanceField& example) {
  const Vec3i n = example.size();
  const bool larger = options.size.x > n.x || options.size.y > n.y;
  return parts.size() == 1 && !options.kept && !options.guide &&
         !(larger && isSlopingGround(example));
}

/// Multiplies the prices of each example's patches, so that one that is used more than its share
/// becomes dearer: examples that do not go together would else drive each other out.
void balanceExamples(const PyramidLevel& level, const std::vector<SourcePart>& parts,
                     const NearestNeighborField& field, Array3D<float>& weight) {
  const int examples = parts.back().example + 1;
  std::vector<double> used(examples);
  for (const Vec3i& p : field.position.values()) ++used[parts[level.partOf(p)].example];
  const double share = static_cast<double>(field.position.count()) / examples;
  if (weight.empty()) weight = Array3D<float>(level.source.size(), 1.0f);
  for (std::size_t s = 0; s < weight.count(); ++s) {
    const double use = used[parts[level.partOf(weight.ijk(s))].example] / share;
    weight.values()[s] *= static_cast<float>(std::clamp(use * use, 0.1, 10.0));
  }
}

/// Whether there is both solid and air in what is kept; air within a voxel of the surface does not
/// count, for the region may be the solid itself, sampled a little differently.
bool keepsSurface(const DistanceField& example, const Array3D<std::uint8_t>& kept) {
  bool solid = false, air = false;
  for (std::size_t s = 0; s < kept.count(); ++s) {
    if (!kept.values()[s]) continue;
    const float v = example.values[kept.ijk(s)];
    solid = solid || v < 0;
    air = air || v > static_cast<float>(example.voxelSize);
  }
  return solid && air;
}

/// The examples, turned in all ways that are asked for. Where a part of the first with its surface
/// is kept, that is all that is copied of it.
std::vector<SourcePart> sourceParts(std::span<const DistanceField* const> examples,
                                    const OptimizeOptions& options) {
  std::vector<SourcePart> parts;
  for (std::size_t e = 0; e < examples.size(); ++e) {
    DistanceField mask = *examples[e];
    const bool masked = e == 0 && options.kept && keepsSurface(*examples[0], *options.kept);
    if (masked) {
      for (std::size_t s = 0; s < mask.values.count(); ++s) {
        const Vec3i p = mask.values.ijk(s);
        mask.values.values()[s] = options.kept->contains(p) && (*options.kept)[p] ? 1 : 0;
      }
    }
    for (int turns = 0; turns < (options.rotations ? 4 : 1); ++turns) {
      SourcePart part{turnedField(*examples[e], turns), static_cast<int>(e), turns, {}};
      if (masked) {
        const DistanceField usable = turnedField(mask, turns);
        part.usable = Array3D<std::uint8_t>(usable.size());
        for (std::size_t s = 0; s < usable.values.count(); ++s) {
          part.usable.values()[s] = usable.values.values()[s] != 0;
        }
      }
      parts.push_back(std::move(part));
    }
  }
  return parts;
}

/// A result on its way from the coarsest level to the finest.
class Optimization {
 public:
  Optimization(std::span<const DistanceField* const> examples, const OptimizeOptions& options)
      : options_(options),
        example_(*examples[0]),
        stationary_(stationaryAxes(examples, options)),
        air_(static_cast<float>(options.truncation)),
        parts_(sourceParts(examples, options)),
        pyramid_{options.size, options.patch, kStride, options.truncation, options.periodic} {
    if (options.rotations && !(stationary_.x && stationary_.y)) {
      throw InputError(
          "turning parts needs an example that is stationary along x and y; say that it is one "
          "(--stationary xy or xyz), or do not turn");
    }
    if (options.kept) pyramid_.kept = &*options.kept;
    if (options.guide) pyramid_.guide = &*options.guide;
  }

  SynthesisResult run(const Progress& progress) {
    begin(progress);
    for (int l = levels_ - 1; l >= 0; --l) {
      if (l < levels_ - 1) refine(l);
      show();
      const bool done = start_ == Start::Blocks ? optimize(l, progress) : cut(l, progress);
      if (!done || progress.cancelled()) {
        SynthesisResult result;
        result.status = SynthesisStatus::Cancelled;
        result.matches = matches_;
        return result;
      }
    }
    SynthesisResult result =
        assemble(parts_, level_, sources_, target_, options_.size, pyramid_.kept, progress);
    result.matches = matches_;
    return result;
  }

 private:
  enum class Start { Halves, Quilt, Blocks };

  std::string stage(int l) const {
    return "optimising, level " + std::to_string(levels_ - l) + " of " + std::to_string(levels_);
  }

  /// Chooses how to start, makes the coarsest level, and where its samples come from.
  void begin(const Progress& progress) {
    const bool large = takesLargeBlocks(options_, parts_, example_);
    const bool same = options_.size == example_.size() && !options_.periodic.any();
    if (large && same) {
      // One joint is not looked for on coarser levels.
      levels_ = options_.levels.value_or(1);
      level_ = makeLevel(parts_, levels_ - 1, pyramid_);
      sources_ = startFromHalves(level_, levels_ - 1, stationary_, options_.seed, air_, progress);
      start_ = Start::Halves;
      if (!sources_.empty()) return;
    }
    if (large) {
      levels_ = options_.levels.value_or(quiltLevels(example_));
      level_ = makeLevel(parts_, levels_ - 1, pyramid_);
      // What keeps its size would keep in step by staying where it is, which makes a copy.
      if (!same) repetition_ = repetitionOf(level_);
    }
    if (large && (repetition_.any() || !options_.periodic.any())) {
      progress.report(stage(levels_ - 1), 0);
      sources_ = startFromQuilt(level_, stationary_, repetition_, options_.seed, air_, progress);
      start_ = Start::Quilt;
      return;
    }
    levels_ = options_.levels.value_or(randomStartLevels(example_));
    level_ = makeLevel(parts_, levels_ - 1, pyramid_);
    sources_ = startFromRandomBlocks(level_, stationary_, options_.seed);
    start_ = Start::Blocks;
  }

  /// Goes on to the next finer level.
  void refine(int l) {
    PyramidLevel finer = makeLevel(parts_, l, pyramid_);
    sources_ = refineSources(level_, sources_, finer);
    repetition_ = repetition_.refined(2);
    keepInStep(finer, repetition_, sources_);
    level_ = std::move(finer);
  }

  /// Makes the target what the sources show.
  void show() {
    pinSources(level_, sources_);
    target_ = gather(level_, sources_);
    pinTarget(level_, air_, target_);
  }

  /// A level of large blocks: their seams are cut, and on the finest level those that show
  /// repaired.
  bool cut(int l, const Progress& progress) {
    progress.report(stage(l), 0);
    if (l > 0 || (levels_ == 1 && start_ == Start::Quilt)) {
      cutSeams(level_, target_, sources_, progress);
      show();
    }
    if (l > 0 || progress.cancelled()) return true;
    RepairOptions repair;
    repair.seed = options_.seed;
    repair.rounds = (options_.rounds + 5) / 6;
    repair.stride = kStride;
    repair.window = patchWindow(level_, stationary_);
    repair.truncation = air_;
    matches_ += repairSeams(level_, repair, sources_, target_, progress);
    return true;
  }

  /// How a level's patches are searched for.
  NearestNeighborFieldOptions searchOf(bool guided) const {
    NearestNeighborFieldOptions search;
    search.patch = level_.patch;
    for (int axis = 0; axis < 3; ++axis) {
      // A guide says where things are, and parts side by side have no common place along x, nor
      // along axes on which they differ in size.
      bool free = stationary_[axis] || guided || options_.kept || (axis == 0 && parts_.size() > 1);
      for (const Vec3i& part : level_.partSize) {
        free = free || part[axis] != level_.partSize[0][axis];
      }
      search.window[axis] = free ? -1 : placeWindow(level_, axis);
    }
    if (!level_.allowed.empty()) search.allowed = &level_.allowed;
    const Vec3i places = level_.source.size() - level_.patch + Vec3i{1, 1, 1};
    const bool exact =
        static_cast<double>(volume(level_.framedTarget())) * static_cast<double>(volume(places)) <
        kExactPairs;
    search.method = exact ? NeighborMethod::Exact : NeighborMethod::PatchMatch;
    search.stride = exact ? Vec3i{1, 1, 1} : min(Vec3i{kStride, kStride, kStride}, level_.patch);
    return search;
  }

  /// A level of small blocks: rounds of matches and votes of all patches. False when cancelled.
  bool optimize(int l, const Progress& progress) {
    const bool coarse = l > 0 || levels_ == 1;
    const bool guided = !level_.guideTarget.empty() && coarse;
    Array3D<float> guideSource, guideTarget;
    if (guided) {
      const auto weight = static_cast<float>(std::sqrt(options_.guideWeight));
      guideSource = level_.guideSource;
      guideTarget = level_.guideTarget;
      for (float& v : guideSource.values()) v *= weight;
      for (float& v : guideTarget.values()) v *= weight;
    }
    NearestNeighborFieldOptions search = searchOf(guided);

    // The finest level only has detail to add, and most of the work.
    const int rounds = l > 0 ? options_.rounds : (2 * options_.rounds + 2) / 3;
    NearestNeighborField field, reverse;
    Array3D<float> weight;
    for (int round = 0; round < rounds; ++round) {
      progress.report(stage(l), static_cast<double>(round) / rounds);
      search.seed = Random(options_.seed, kSearchStream).bits(l, round);
      search.iterations = round == 0 && l == levels_ - 1 ? kFirstIterations : kIterations;
      const NearestNeighborField previous =
          round == 0 ? fieldOf(level_, sources_, search.stride) : std::move(field);
      search.start = &previous;
      if (std::isfinite(options_.completeness) && coarse) {
        weight = welcome(level_, target_, options_.completeness, search, reverse, progress);
        search.sourceWeight = &weight;
      }
      if (parts_.back().example > 0 && l > 0) {
        if (!search.sourceWeight) weight = {};
        balanceExamples(level_, parts_, previous, weight);
        search.sourceWeight = &weight;
      }
      field = nearestNeighborField(channels(level_.source, guideSource),
                                   channels(target_, guideTarget), search, progress);
      if (progress.cancelled()) return false;
      matches_ += volume(field.position.size());
      target_ = vote(level_, field, level_.framedTarget());
      pinTarget(level_, air_, target_);
    }
    sources_ = plurality(level_, field, level_.framedTarget());
    pinSources(level_, sources_);
    if (l > 0) cutSeams(level_, target_, sources_, progress);
    return true;
  }

  const OptimizeOptions& options_;
  const DistanceField& example_;
  StationaryAxes stationary_;
  float air_;
  std::vector<SourcePart> parts_;
  PyramidOptions pyramid_;

  Start start_ = Start::Blocks;
  int levels_ = 1;
  std::int64_t matches_ = 0;
  PyramidLevel level_;
  PyramidSources sources_;
  Array3D<float> target_;
  Repetition repetition_;
};

}  // namespace

StationaryAxes stationaryAxes(std::span<const DistanceField* const> examples,
                              const OptimizeOptions& options) {
  if (options.stationary) return *options.stationary;
  StationaryAxes all;
  for (const DistanceField* example : examples) {
    const bool masked = example == examples[0] && options.kept;
    const StationaryAxes axes = findStationaryAxes(*example, masked ? &*options.kept : nullptr);
    all = {all.x && axes.x, all.y && axes.y, all.z && axes.z};
  }
  return all;
}

SynthesisResult synthesizeOptimized(const DistanceField& example, const OptimizeOptions& options,
                                    const Progress& progress) {
  const DistanceField* examples[] = {&example};
  return synthesizeOptimized(examples, options, progress);
}

SynthesisResult synthesizeOptimized(std::span<const DistanceField* const> examples,
                                    const OptimizeOptions& options, const Progress& progress) {
  check(examples, options);
  OptimizeOptions given = options;
  if (given.kept) {
    // Only what the first example holds can be kept.
    for (std::size_t s = 0; s < given.kept->count(); ++s) {
      if (!examples[0]->values.contains(given.kept->ijk(s))) given.kept->values()[s] = 0;
    }
  }
  return Optimization(examples, given).run(progress);
}

}  // namespace exemplar
