// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/quilting/quilting.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/error.h"
#include "core/parallel.h"
#include "synth/geometry/patches/seam_repair.h"
#include "synth/geometry/pyramid/place_window.h"
#include "synth/geometry/pyramid/pyramid.h"
#include "synth/geometry/quilting/halves.h"
#include "synth/geometry/quilting/quilt.h"
#include "synth/geometry/quilting/repetition.h"
#include "synth/geometry/quilting/sloping_ground.h"
#include "synth/geometry/seams/assembly.h"
#include "synth/geometry/seams/level_seams.h"
#include "synth/geometry/stationary.h"

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// A quilt is made where the example has at most this many samples along its longest side.
constexpr int kQuiltSide = 40;
/// A repetition is stretched, so that a result holds a whole number of it, where what is an example
/// apart moves by no more than this, samples of the coarsest level.
constexpr double kStretch = 0.75;
/// Distance of neighboring patches of a repair, samples.
constexpr int kStride = 2;
/// Shares of the work that the start, the levels and the assembly take, about.
constexpr double kStartDone = 0.3, kLevelsDone = 0.5;

PyramidOptions pyramidOptions(const QuiltingOptions& options) {
  return {options.size, options.patch, kStride, options.truncation, options.periodic};
}

void check(const DistanceField& example, const QuiltingOptions& options) {
  const DistanceField* examples[] = {&example};
  checkPyramid(examples, false, pyramidOptions(options), options.levels);
  if (options.rounds < 1 || options.rounds > 100)
    throw InputError("`rounds` " + std::to_string(options.rounds) + ": expected 1 to 100");
}

int quiltLevels(const DistanceField& example, const QuiltingOptions& options) {
  const Vec3i n = example.size();
  const int longest = std::max({n.x, n.y, n.z});
  int levels = 1;
  while (levels < 8 && (longest >> (levels - 1)) > kQuiltSide) ++levels;
  return options.levels.value_or(levels);
}

/// The steps after which a level's example nearly repeats. Where the result is to continue at its
/// other side it must hold a whole number of them: else nothing repeats.
Repetition repetitionOf(const PyramidLevel& level) {
  const CellBox part = level.source.parts[0];
  Array3D<float> example(part.size());
  forEachCell(example.size(),
              [&](const Vec3i& p) { example[p] = level.source.values[p + part.begin]; });
  Repetition repetition = findRepetition(example);
  for (int axis = 0; axis < 3; ++axis) {
    if (!level.target.periodic[axis]) continue;
    const int length = level.target.size[axis], apart = part.size()[axis];
    if (!repetition.stretch(axis, length, apart, kStretch)) return {};
  }
  return repetition;
}

/// Brings pieces back to the lattice of what repeats: half a coarse sample that they were off is a
/// whole one on the next level. Does nothing where nothing repeats.
void snapToRepetition(const PyramidLevel& level, const Repetition& repetition,
                      PyramidSources& sources) {
  if (!repetition.any()) return;
  const Vec3i inPlace = level.inPlace();
  parallelForEachCell(sources.size(), [&](const Vec3i& p) {
    const Vec3i step = repetition.nearest(sources[p] - p - inPlace);
    sources[p] = level.source.values.clamped(p + inPlace + step);
  });
}

/// A result on its way from the coarsest level to the finest.
class Quilting {
 public:
  Quilting(const DistanceField& example, const QuiltingOptions& options)
      : options_(options),
        example_(example),
        stationary_(options.stationary.value_or(findStationaryAxes(example))),
        air_(static_cast<float>(options.truncation)),
        parts_{{example, 0, 0, {}}},
        pyramid_(pyramidOptions(options)) {}

  SynthesisResult run(const Progress& progress) {
    const bool same = options_.size == example_.size() && !options_.periodic.any();
    const Progress starting = progress.part(0, kStartDone);
    if (!same || !startFromHalves(starting)) startFromQuilt(same, starting);

    const Progress levels = progress.part(kStartDone, kLevelsDone);
    for (int l = levels_ - 1; l >= 0; --l) {
      if (l < levels_ - 1) refine(l);
      show();
      cut(l, levelProgress(levels, l, levels_));
    }
    SynthesisResult result = assemble(parts_, level_, sources_, target_, options_.size, nullptr,
                                      progress.part(kLevelsDone, 1));
    result.matches = matches_;
    return result;
  }

 private:
  std::string stage(int l) const {
    return "quilting, level " + std::to_string(levels_ - l) + " of " + std::to_string(levels_);
  }

  void makeCoarsest(int levels) {
    levels_ = levels;
    level_ = makeLevel(parts_, levels - 1, pyramid_);
  }

  /// The example's halves exchanged, their joints cut: on the finest level, for a single joint
  /// needs no coarser ones. False where no axis allows it.
  bool startFromHalves(const Progress& progress) {
    makeCoarsest(options_.levels.value_or(1));
    HalvesOptions halves;
    halves.seed = options_.seed;
    halves.stationary = stationary_;
    halves.divide = true;
    halves.window = std::max(2, halves.window >> (levels_ - 1));
    halves.cut = [&](PyramidSources& sources, const Progress& cutting) {
      cutJoints(level_, shownBy(sources), halves.window, sources, cutting);
    };
    sources_ = exchangedHalves(level_, halves, progress);
    fromHalves_ = !sources_.empty();
    return fromHalves_;
  }

  /// Large blocks, their joints cut, on the lattice of what repeats.
  void startFromQuilt(bool same, const Progress& progress) {
    makeCoarsest(quiltLevels(example_, options_));
    // What keeps its size would stay on the lattice by staying where it is, which makes a copy.
    if (!same) repetition_ = repetitionOf(level_);
    if (options_.periodic.any() && !repetition_.any()) {
      throw InputError("`periodic` " + readableAxes(options_.periodic) +
                       ": the example does not repeat along these axes, nearly as often as the "
                       "result is long; synthesize by voting, or choose another size");
    }
    progress.report(stage(levels_ - 1), 0);
    QuiltOptions quilting;
    quilting.seed = options_.seed;
    quilting.window = blockWindow(level_, stationary_, options_.inPlace);
    quilting.repetition = repetition_;
    quilting.cut = [&](PyramidSources& sources, const Progress& cutting) {
      cutSeams(level_, shownBy(sources), sources, cutting);
    };
    sources_ = quilt(level_, quilting, progress);
  }

  Array3D<float> shownBy(const PyramidSources& sources) const {
    Array3D<float> target = gather(level_, sources);
    pinTarget(level_, air_, target);
    return target;
  }

  /// Goes on to the next finer level.
  void refine(int l) {
    PyramidLevel finer = makeLevel(parts_, l, pyramid_);
    sources_ = refineSources(level_, sources_, finer);
    repetition_ = repetition_.refined(2);
    snapToRepetition(finer, repetition_, sources_);
    level_ = std::move(finer);
  }

  /// Makes the target what the sources show.
  void show() {
    pinSources(level_, sources_);
    target_ = shownBy(sources_);
  }

  /// Cuts a level's seams, but for the finest, whose cut is the assembly's; there those that show
  /// are repaired.
  void cut(int l, const Progress& progress) {
    progress.report(stage(l), 0);
    if (l > 0 || (levels_ == 1 && !fromHalves_)) {
      cutSeams(level_, target_, sources_, progress.part(0, l > 0 ? 1 : 0.5));
      show();
    }
    if (l > 0) return;
    SeamRepairOptions repair;
    repair.seed = options_.seed;
    repair.rounds = options_.rounds;
    repair.stride = kStride;
    repair.window = patchWindow(level_, stationary_, options_.inPlace);
    repair.truncation = air_;
    matches_ += repairSeams(level_, repair, sources_, target_, progress.part(0.5, 1));
  }

  const QuiltingOptions& options_;
  const DistanceField& example_;
  Axes stationary_;
  float air_;
  std::vector<SourcePart> parts_;
  PyramidOptions pyramid_;

  bool fromHalves_ = false;
  int levels_ = 1;
  std::int64_t matches_ = 0;
  PyramidLevel level_;
  PyramidSources sources_;
  Array3D<float> target_;
  Repetition repetition_;
};

}  // namespace

SynthesisResult synthesizeByQuilting(const DistanceField& example, const QuiltingOptions& options,
                                     const Progress& progress) {
  check(example, options);
  return Quilting(example, options).run(progress);
}

bool suitsQuilting(const DistanceField& example, const QuiltingOptions& options) {
  check(example, options);
  const bool larger = options.size.x > example.size().x || options.size.y > example.size().y;
  if (larger && isSlopingGround(example)) return false;
  if (!options.periodic.any()) return true;
  const std::vector<SourcePart> parts{{example, 0, 0, {}}};
  const int coarsest = quiltLevels(example, options) - 1;
  return repetitionOf(makeLevel(parts, coarsest, pyramidOptions(options))).any();
}

}  // namespace exemplar
