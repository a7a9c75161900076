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
#include "synth/geometry/bad_seams.h"
#include "synth/geometry/broken_pieces.h"
#include "synth/geometry/even_seams.h"
#include "synth/geometry/patch_vote.h"
#include "synth/geometry/pyramid.h"
#include "synth/geometry/quilt.h"
#include "synth/geometry/rearrange.h"
#include "synth/geometry/repetition.h"
#include "synth/geometry/seams.h"
#include "synth/geometry/source_sheet.h"
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
/// Seams whose two sides differ by more than this, in voxels, are optimised away.
constexpr double kBadSeam = 2;
/// Seams of the coarser levels see distances up to here, in voxels: one through air or through
/// solid is free.
constexpr float kSeamTruncation = 4;
/// Seams of the coarser levels, where a few samples reach far: pieces grow into large ones.
constexpr SeamOptions kCoarseSeams{.reach = 16, .length = 0.05};
/// Those of the result: many small steps rather than a few that show. What is copied is near
/// enough to what was wanted.
constexpr SeamOptions kFineSeams{.fidelity = 0, .length = 0.005, .slope = 2, .squared = true};
/// A repetition is stretched, so that a result holds a whole number of it, where what is an example
/// apart moves by no more than this, samples of the coarsest level.
constexpr double kStretch = 0.75;
/// How far beyond its box a periodic result's seams are evened out with it, in voxels.
constexpr int kWrapMargin = 12;

/// The field that a level's search starts from: each patch at where its middle comes from.
NearestNeighborField startField(const PyramidLevel& level, const PyramidSources& sources,
                                const Vec3i& stride) {
  NearestNeighborField field;
  const Vec3i last = sources.size() - level.patch;
  const Vec3i lastMatch = level.source.size() - level.patch;
  const Vec3i half{level.patch.x / 2, level.patch.y / 2, level.patch.z / 2};
  field.stride = stride;
  field.position =
      Array3D<Vec3i>({last.x / stride.x + 1, last.y / stride.y + 1, last.z / stride.z + 1});
  for (std::size_t s = 0; s < field.position.count(); ++s) {
    const Vec3i middle = scaled(field.position.ijk(s), stride) + half;
    field.position.values()[s] = max(Vec3i{0, 0, 0}, min(sources[middle] - half, lastMatch));
  }
  return field;
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

Array3D<float> clamped(Array3D<float> values, float limit) {
  for (float& v : values.values()) v = std::clamp(v, -limit, limit);
  return values;
}

/// Moves the seams of a result to where both sides agree best. Where it is periodic, again with
/// its faces in the middle; each time what is beside the outer faces stays, so that what was cut
/// there before does not change.
void refineAround(const Array3D<float>& source, const Array3D<float>& target,
                  const PeriodicAxes& periodic, SeamOptions options, Origins& origins,
                  const Progress& progress) {
  if (!periodic.any()) {
    refineSeams(source, target, origins, options, progress);
    return;
  }
  const Vec3i n = origins.size();
  Array3D<std::uint8_t> outer(n);
  for (std::size_t s = 0; s < outer.count(); ++s) {
    const Vec3i p = outer.ijk(s);
    for (int axis = 0; axis < 3; ++axis) {
      if (periodic[axis] && (p[axis] == 0 || p[axis] == n[axis] - 1)) outer.values()[s] = 1;
    }
  }
  const SeamOptions around = options;
  const Array3D<std::uint8_t> kept = options.fixed ? *options.fixed : Array3D<std::uint8_t>(n);
  Vec3i half{0, 0, 0};
  for (int axis = 0; axis < 3; ++axis) half[axis] = periodic[axis] ? n[axis] / 2 : 0;
  for (const Vec3i& shift : {Vec3i{0, 0, 0}, half}) {
    Array3D<std::uint8_t> fixed = rolled(kept, shift);
    for (std::size_t s = 0; s < fixed.count(); ++s) fixed.values()[s] |= outer.values()[s];
    options.fixed = &fixed;
    Array3D<std::uint8_t> air;
    if (around.air) {
      air = rolled(*around.air, shift);
      options.air = &air;
    }
    Origins moved = rolled(origins, shift);
    refineSeams(source, rolled(target, shift), moved, options, progress);
    origins = rolled(moved, Vec3i{0, 0, 0} - shift);
  }
}

/// Moves seams to where both sides agree best, and then whole pieces and the seams once more: what
/// a level starts with was found on a grid twice as coarse, and half of the offsets lie between.
void cutSeams(const PyramidLevel& level, const Array3D<float>& target, PyramidSources& sources,
              const Progress& progress) {
  const Array3D<float> source = clamped(level.source, kSeamTruncation);
  const bool inner = level.periodic.any();
  const auto cropped = [&](const auto& grid) { return inner ? withoutMargins(level, grid) : grid; };
  const PyramidSources within = cropped(sources);
  Origins origins(within.size());
  for (std::size_t s = 0; s < within.count(); ++s) {
    origins.values()[s] = Origin(within.values()[s]);
  }
  SeamOptions options = kCoarseSeams;
  Array3D<std::uint8_t> fixed;
  if (!level.kept.empty()) {
    fixed = cropped(level.kept);
    options.fixed = &fixed;
  }
  if (!level.usable.empty()) options.usable = &level.usable;
  const Array3D<std::uint8_t> air = level.airSamples();
  const Array3D<std::uint8_t> airWithin = air.empty() ? air : cropped(air);
  if (!air.empty()) options.air = &airWithin;
  refineAround(source, cropped(clamped(target, kSeamTruncation)), level.periodic, options, origins,
               progress);
  if (!progress.cancelled() && alignPieces(source, origins, 1, options) > 0) {
    Array3D<float> shown(origins.size());
    for (std::size_t s = 0; s < shown.count(); ++s) {
      shown.values()[s] = source[origins.values()[s].cell()];
    }
    refineAround(source, shown, level.periodic, options, origins, progress);
  }
  const Vec3i first = inner ? level.before : Vec3i{0, 0, 0};
  for (std::size_t s = 0; s < origins.count(); ++s) {
    sources[origins.ijk(s) + first] = origins.values()[s].cell();
  }
  pinSources(level, sources);
}

/// The steps after which a level's example, which is its only part, nearly repeats. Where the
/// result shall go on at its other side it must hold a whole number of them: else there are none.
Repetition repetitionOf(const PyramidLevel& level) {
  Array3D<float> example(level.partSize[0]);
  for (std::size_t s = 0; s < example.count(); ++s) {
    example.values()[s] = level.source[example.ijk(s) + level.first[0]];
  }
  Repetition repetition = findRepetition(example);
  for (int axis = 0; axis < 3; ++axis) {
    if (!level.periodic[axis]) continue;
    const int length = level.targetSize[axis], apart = level.partSize[0][axis];
    if (!repetition.stretch(axis, length, apart, kStretch)) return {};
  }
  return repetition;
}

/// Brings pieces back in step: half a coarse sample that they were off is a whole one now.
void keepInStep(const PyramidLevel& level, const Repetition& repetition, PyramidSources& sources) {
  if (!repetition.any()) return;
  for (std::size_t s = 0; s < sources.count(); ++s) {
    const Vec3i p = sources.ijk(s);
    const Vec3i step = repetition.nearest(sources.values()[s] - p - level.inPlace());
    sources.values()[s] = level.source.clamped(p + level.inPlace() + step);
  }
}

/// A level's start from large blocks, their joints cut.
PyramidSources startFromQuilt(const PyramidLevel& level, const StationaryAxes& stationary,
                              const Repetition& repetition, const OptimizeOptions& options,
                              const Progress& progress) {
  QuiltOptions quilting;
  quilting.seed = options.seed;
  quilting.window = blockWindow(level, stationary);
  quilting.repetition = repetition;
  quilting.cut = [&](PyramidSources& sources) {
    Array3D<float> target = gather(level, sources);
    pinTarget(level, static_cast<float>(options.truncation), target);
    cutSeams(level, target, sources, progress);
  };
  return quilt(level, quilting, progress);
}

/// A start of the example's own size from its halves, exchanged, on the level that is given; or
/// nothing. Its one joint is all that is cut.
PyramidSources startFromHalves(const PyramidLevel& level, int l, const StationaryAxes& stationary,
                               const OptimizeOptions& options, const Progress& progress) {
  RearrangeOptions rearranging;
  rearranging.seed = options.seed;
  rearranging.stationary = stationary;
  rearranging.window = std::max(2, rearranging.window >> l);
  const Array3D<float> source = clamped(level.source, kSeamTruncation);
  const Array3D<std::uint8_t> air = level.airSamples();
  SeamOptions seams = kCoarseSeams;
  seams.passes = 1;
  seams.reach = rearranging.window;
  if (!air.empty()) seams.air = &air;
  rearranging.cut = [&](PyramidSources& sources) {
    Origins origins(sources.size());
    for (std::size_t s = 0; s < sources.count(); ++s) {
      origins.values()[s] = Origin(sources.values()[s]);
    }
    Array3D<float> target = gather(level, sources);
    pinTarget(level, static_cast<float>(options.truncation), target);
    refineSeams(source, clamped(std::move(target), kSeamTruncation), origins, seams, progress);
    for (std::size_t s = 0; s < sources.count(); ++s) {
      sources.values()[s] = origins.values()[s].cell();
    }
  };
  return rearrange(level, rearranging, progress);
}

/// Optimises away the seams that show: patches that cover one are searched for and vote, and what
/// they cover takes their sources; all else stays as copied. Returns how many patches were searched
/// for.
std::int64_t repairSeams(const PyramidLevel& level, const StationaryAxes& stationary,
                         const OptimizeOptions& options, PyramidSources& sources,
                         Array3D<float>& target, const Progress& progress) {
  const Vec3i size = level.framedTarget();
  NearestNeighborFieldOptions search;
  search.patch = level.patch;
  search.method = NeighborMethod::PatchMatch;
  search.stride = min(Vec3i{kStride, kStride, kStride}, level.patch);
  search.iterations = kIterations;
  search.window = patchWindow(level, stationary);
  NearestNeighborField field = startField(level, sources, search.stride);
  const Array3D<std::uint8_t> wanted = patchesCovering(
      badSeams(level, sources, kBadSeam), level.patch, search.stride, field.position.size());
  const std::int64_t many = std::count(wanted.values().begin(), wanted.values().end(), 1);
  if (many == 0) return 0;
  search.wanted = &wanted;
  const int rounds = (options.rounds + 5) / 6;
  for (int round = 0; round < rounds; ++round) {
    search.seed = Random(options.seed, kSearchStream).bits(0, round);
    const NearestNeighborField previous = std::move(field);
    search.start = &previous;
    field = nearestNeighborField({level.source}, {target}, search, progress);
    if (!field.complete || progress.cancelled()) return many;
    target = vote(level, field, size);
    pinTarget(level, static_cast<float>(options.truncation), target);
  }
  const Array3D<std::uint8_t> changed = samplesCovered(wanted, level.patch, search.stride, size);
  const PyramidSources found = plurality(level, field, size);
  for (std::size_t s = 0; s < sources.count(); ++s) {
    if (changed.values()[s]) sources.values()[s] = found.values()[s];
  }
  return many * rounds;
}

/// The last steps: from where the finest level's samples come from to a field.
class Assembly {
 public:
  Assembly(const std::vector<SourcePart>& parts, const OptimizeOptions& options)
      : parts_(parts), options_(options), sheet_(parts) {}

  SynthesisResult run(const PyramidLevel& level, const PyramidSources& sources,
                      const Array3D<float>& target, const Progress& progress) {
    SynthesisResult result;
    progress.report("cutting seams", 0);
    Origins origins(options_.size);
    for (std::size_t s = 0; s < origins.count(); ++s) {
      const Vec3i cell = sources[origins.ijk(s) + level.before];
      const std::size_t part = level.partOf(cell);
      const Vec3i inside = parts_[part].field.values.clamped(cell - level.first[part]);
      origins.values()[s] = Origin(inside + Vec3i{sheet_.first[part], 0, 0});
    }
    Array3D<float> copied = sheet_.field.values;
    for (float& v : copied.values()) v /= static_cast<float>(sheet_.field.voxelSize);
    SeamOptions seams = kFineSeams;
    if (options_.kept) seams.fixed = &*options_.kept;
    if (!sheet_.usable.empty()) seams.usable = &sheet_.usable;
    Array3D<std::uint8_t> air = level.airSamples();
    if (!air.empty()) {
      air = withoutMargins(level, air);
      seams.air = &air;
    }
    alignPieces(copied, origins, 1, seams);
    refineAround(copied, withoutMargins(level, target), options_.periodic, seams, origins,
                 progress);
    if (progress.cancelled()) {
      result.status = SynthesisStatus::Cancelled;
      return result;
    }
    dropBrokenPieces(sheet_.field, origins, {seams.usable, seams.fixed});
    result.field = even(origins, seams);
    // What is thin may have come apart below the surface: that goes as well, and what little is
    // left after evening once more goes as it is copied.
    BrokenPiecesOptions pieces{seams.usable, seams.fixed, &result.field.values};
    if (dropBrokenPieces(sheet_.field, origins, pieces) > 0) {
      result.field = even(origins, seams);
      const Origins before = origins;
      dropBrokenPieces(sheet_.field, origins, pieces);
      for (std::size_t s = 0; s < origins.count(); ++s) {
        if (origins.values()[s] == before.values()[s]) continue;
        result.field.values.values()[s] = sheet_.field.values[origins.values()[s].cell()];
      }
    }
    result.origins = std::move(origins);
    for (Origin& origin : result.origins.values()) origin = sheet_.toExample(parts_, origin);
    return result;
  }

 private:
  DistanceField even(const Origins& origins, const SeamOptions& seams) const {
    EvenSeamsOptions options;
    options.fixed = seams.fixed;
    options.usable = seams.usable;
    if (!options_.periodic.any()) return evenSeams(sheet_.field, origins, options);
    // With a margin that shows what lies at the other side, cut off again.
    Vec3i margin{0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) {
      if (options_.periodic[axis]) margin[axis] = std::min(kWrapMargin, origins.size()[axis]);
    }
    const Vec3i n = origins.size();
    Origins around(n + margin * 2);
    Array3D<std::uint8_t> fixed;
    if (seams.fixed) {
      fixed = Array3D<std::uint8_t>(around.size());
      options.fixed = &fixed;
    }
    for (std::size_t s = 0; s < around.count(); ++s) {
      Vec3i p = around.ijk(s) - margin;
      for (int axis = 0; axis < 3; ++axis) p[axis] = (p[axis] + n[axis]) % n[axis];
      around.values()[s] = origins[p];
      if (seams.fixed) fixed.values()[s] = (*seams.fixed)[p];
    }
    DistanceField field = evenSeams(sheet_.field, around, options);
    Array3D<float> inner(n);
    for (std::size_t s = 0; s < inner.count(); ++s) {
      inner.values()[s] = field.values[inner.ijk(s) + margin];
    }
    field.values = std::move(inner);
    return field;
  }

  const std::vector<SourcePart>& parts_;
  const OptimizeOptions& options_;
  SourceSheet sheet_;
};

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
bool quilts(const OptimizeOptions& options, const std::vector<SourcePart>& parts,
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
  const StationaryAxes stationary = stationaryAxes(examples, given);
  if (options.rotations && !(stationary.x && stationary.y)) {
    throw InputError(
        "turning parts needs an example that is stationary along x and y; say that it is one "
        "(--stationary xy or xyz), or do not turn");
  }
  const std::vector<SourcePart> parts = sourceParts(examples, given);
  const float air = static_cast<float>(options.truncation);
  PyramidOptions pyramid{options.size, options.patch, kStride, options.truncation,
                         options.periodic};
  if (given.kept) pyramid.kept = &*given.kept;
  if (given.guide) pyramid.guide = &*given.guide;

  bool quilted = quilts(given, parts, *examples[0]);
  const bool same = options.size == examples[0]->size() && !options.periodic.any();
  // What keeps its size would keep in step by staying where it is, which makes a copy.
  Repetition repetition;
  if (quilted && !same) {
    const int coarsest = options.levels.value_or(quiltLevels(*examples[0])) - 1;
    repetition = repetitionOf(makeLevel(parts, coarsest, pyramid));
  }
  if (options.periodic.any() && !repetition.any()) quilted = false;
  int levels = options.levels.value_or(quilted ? quiltLevels(*examples[0])
                                               : randomStartLevels(*examples[0]));

  const auto levelStage = [&](int l) {
    return "optimising, level " + std::to_string(levels - l) + " of " + std::to_string(levels);
  };
  SynthesisResult result;
  PyramidLevel level;
  PyramidSources sources;
  if (quilted && same) {
    // One joint is not looked for on coarser levels.
    const int only = options.levels.value_or(1);
    level = makeLevel(parts, only - 1, pyramid);
    sources = startFromHalves(level, only - 1, stationary, options, progress);
    if (!sources.empty()) levels = only;
  }
  const bool halved = !sources.empty();
  progress.report(levelStage(levels - 1), 0);
  if (!halved) {
    level = makeLevel(parts, levels - 1, pyramid);
    sources = quilted ? startFromQuilt(level, stationary, repetition, options, progress)
                      : startFromRandomBlocks(level, stationary, options.seed);
  }
  Array3D<float> target;
  for (int l = levels - 1; l >= 0; --l) {
    if (l < levels - 1) {
      PyramidLevel finer = makeLevel(parts, l, pyramid);
      sources = refineSources(level, sources, finer);
      repetition = repetition.refined(2);
      keepInStep(finer, repetition, sources);
      level = std::move(finer);
    }
    pinSources(level, sources);
    const bool guided = !level.guideTarget.empty() && (l > 0 || levels == 1);
    target = gather(level, sources);
    pinTarget(level, air, target);
    if (quilted) {
      progress.report(levelStage(l), 0);
      if (l > 0 || (levels == 1 && !halved)) {
        cutSeams(level, target, sources, progress);
        target = gather(level, sources);
        pinTarget(level, air, target);
      }
      if (l == 0 && !progress.cancelled()) {
        result.matches = repairSeams(level, stationary, given, sources, target, progress);
      }
      if (progress.cancelled()) {
        result.status = SynthesisStatus::Cancelled;
        return result;
      }
      continue;
    }
    Array3D<float> guideSource, guideTarget;
    if (guided) {
      const auto weight = static_cast<float>(std::sqrt(options.guideWeight));
      guideSource = level.guideSource;
      guideTarget = level.guideTarget;
      for (float& v : guideSource.values()) v *= weight;
      for (float& v : guideTarget.values()) v *= weight;
    }

    NearestNeighborFieldOptions search;
    search.patch = level.patch;
    for (int axis = 0; axis < 3; ++axis) {
      // A guide says where things are, and parts side by side have no common place along x, nor
      // along axes on which they differ in size.
      bool free = stationary[axis] || guided || given.kept || (axis == 0 && parts.size() > 1);
      for (const Vec3i& part : level.partSize) free = free || part[axis] != level.partSize[0][axis];
      search.window[axis] = free ? -1 : placeWindow(level, axis);
    }
    if (!level.allowed.empty()) search.allowed = &level.allowed;
    const Vec3i size = level.framedTarget();
    const Vec3i places = level.source.size() - level.patch + Vec3i{1, 1, 1};
    const bool exact =
        static_cast<double>(volume(size)) * static_cast<double>(volume(places)) < kExactPairs;
    search.method = exact ? NeighborMethod::Exact : NeighborMethod::PatchMatch;
    search.stride = exact ? Vec3i{1, 1, 1} : min(Vec3i{kStride, kStride, kStride}, level.patch);

    // The finest level only has detail to add, and most of the work.
    const int rounds = l > 0 ? options.rounds : (2 * options.rounds + 2) / 3;
    NearestNeighborField field, reverse;
    Array3D<float> weight;
    for (int round = 0; round < rounds; ++round) {
      progress.report(levelStage(l), static_cast<double>(round) / rounds);
      search.seed = Random(options.seed, kSearchStream).bits(l, round);
      search.iterations = round == 0 && l == levels - 1 ? kFirstIterations : kIterations;
      const NearestNeighborField previous =
          round == 0 ? startField(level, sources, search.stride) : std::move(field);
      search.start = &previous;
      if (std::isfinite(options.completeness) && (l > 0 || levels == 1)) {
        weight = welcome(level, target, options.completeness, search, reverse, progress);
        if (!reverse.complete) {
          result.status = SynthesisStatus::Cancelled;
          break;
        }
        search.sourceWeight = &weight;
      }
      if (examples.size() > 1 && l > 0) {
        if (!search.sourceWeight) weight = {};
        balanceExamples(level, parts, previous, weight);
        search.sourceWeight = &weight;
      }
      field = nearestNeighborField(channels(level.source, guideSource),
                                   channels(target, guideTarget), search, progress);
      if (!field.complete || progress.cancelled()) {
        result.status = SynthesisStatus::Cancelled;
        break;
      }
      result.matches += volume(field.position.size());
      target = vote(level, field, size);
      pinTarget(level, air, target);
    }
    if (result.status == SynthesisStatus::Cancelled) return result;
    sources = plurality(level, field, size);
    pinSources(level, sources);
    if (l > 0) cutSeams(level, target, sources, progress);
  }
  const std::int64_t matches = result.matches;
  result = Assembly(parts, given).run(level, sources, target, progress);
  result.matches = matches;
  return result;
}

}  // namespace exemplar
