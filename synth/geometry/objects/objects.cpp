// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/objects/objects.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/parallel.h"
#include "core/random.h"
#include "sdf/resample.h"
#include "synth/geometry/objects/growth.h"
#include "synth/geometry/objects/loose_parts.h"
#include "synth/geometry/objects/part_exchange.h"
#include "synth/geometry/objects/slice_path.h"
#include "synth/geometry/pyramid/pyramid.h"
#include "synth/geometry/seams/assembly.h"
#include "synth/geometry/seams/level_seams.h"
#include "synth/geometry/seams/regions.h"

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// Where an object docks onto itself is found on a grid of at most so many slices.
constexpr int kMostSlices = 128;
/// Parts are exchanged on a grid of at most so many samples.
constexpr std::int64_t kMostSamples = 1 << 20;
/// How much of the object's height its foot is.
constexpr double kFoot = 0.12;
/// An object is extended where the joints cost no more than this on the mean.
constexpr double kDocks = 0.15;
/// The same beside what is kept, where voting would leave a groove.
constexpr double kDocksKept = 0.25;
/// How far parts are moved at first, of the object's length, and what it costs that they are not
/// (`variedPath`); by how much more each time, how often, and how many ways are tried each time.
constexpr double kMotion = 0.03, kPull = 80, kFarther = 1.2, kHarder = 1.6;
constexpr int kRises = 7;
constexpr int kDraws = 4;
/// How much more or less of solid a variation may have, of the example's.
constexpr double kSolid = 0.06;
/// A variation is compared with the example at every third sample along each axis, wherever that is
/// laid within four samples.
constexpr int kStride = 3;
/// What it costs that a variation is not new at all, in misfits of joints.
constexpr double kOld = 2;
/// Joints move by up to this much to where both sides agree best, samples.
constexpr int kJointReach = 6;
/// Shares of the work.
constexpr double kPathsDone = 0.2, kCutDone = 0.4;

/// One axis: where the object docks onto itself, on a grid `shrink` times as coarse.
struct Axis {
  SliceDocking docking;
  int shrink, length;

  /// A path over samples from one over coarse slices.
  SlicePath fine(SlicePath coarse, int made) const {
    if (shrink == 1 || coarse.source.empty()) return coarse;
    SlicePath path = coarse;
    path.source.resize(static_cast<std::size_t>(made));
    for (int i = 0; i < made; ++i) {
      const auto at = std::min(static_cast<std::size_t>(i / shrink), coarse.source.size() - 1);
      path.source[static_cast<std::size_t>(i)] =
          std::min(length - 1, coarse.source[at] * shrink + i % shrink);
    }
    return path;
  }
  /// The same of places between slices.
  std::vector<double> fine(const std::vector<double>& coarse, int made) const {
    std::vector<double> path(static_cast<std::size_t>(made));
    const int last = static_cast<int>(coarse.size()) - 1;
    for (int i = 0; i < made; ++i) {
      const double at = std::clamp<double>((i + 0.5) / shrink - 0.5, 0, last);
      const int before = std::min(static_cast<int>(at), std::max(0, last - 1));
      const double place =
          std::lerp(coarse[static_cast<std::size_t>(before)],
                    coarse[static_cast<std::size_t>(std::min(before + 1, last))], at - before);
      path[static_cast<std::size_t>(i)] = (place + 0.5) * shrink - 0.5;
    }
    return path;
  }
};

class Objects {
 public:
  Objects(const DistanceField& example, const ObjectOptions& options)
      : options_(options),
        example_(example.size()),
        parts_{{example, 0, 0, {}}},
        level_(makeLevel(parts_, 0, pyramidOptions(options))) {}

  ObjectResult run(const Progress& progress) {
    progress.report("finding where the object docks onto itself", 0);
    findDocking(progress.part(0, kPathsDone / 4));
    chooseGrowth();
    if (options_.kept && !isFitted()) return std::move(result_);
    if (isGrown()) return grown(progress.part(kPathsDone / 4, 1));
    exchange(progress.part(kPathsDone / 4, kPathsDone / 2));
    layOut(progress.part(kPathsDone / 2, kPathsDone));
    Array3D<float> target = shown();
    progress.check();
    cutJoints(level_, target, kJointReach, sources_, progress.part(kPathsDone, kCutDone), &fixed_);
    pinSources(level_, sources_);
    progress.check();
    target = shown();
    const Array3D<std::uint8_t> fixed = withoutMargins(level_, fixed_);
    result_.made = assemble(parts_, level_, sources_, target, options_.size, &fixed,
                            progress.part(kCutDone, 1), !options_.kept);
    return std::move(result_);
  }

 private:
  static PyramidOptions pyramidOptions(const ObjectOptions& options) {
    PyramidOptions pyramid;
    pyramid.size = options.size;
    pyramid.truncation = options.truncation;
    return pyramid;
  }

  bool isGrown() const {
    return std::ranges::find(result_.growth, Growth::Grown) != result_.growth.end();
  }

  /// The object grown along axes along which it does not dock onto itself.
  ObjectResult grown(const Progress& progress) {
    GrowthOptions growing;
    growing.seed = options_.seed;
    growing.truncation = options_.truncation;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (result_.growth[a] != Growth::Fitted) {
        // Where it stays as long, nothing is stretched.
        const Axis& along = axes_[a];
        growing.places[a] =
            along.fine(stretchedPath(along.docking, coarse(axis), draw(axis)), options_.size[axis]);
      } else {
        const std::vector<int> whole = path(axis);
        growing.places[a].assign(whole.begin(), whole.end());
      }
    }
    result_.made = growObject(parts_[0].field, growing, progress);
    return std::move(result_);
  }

  /// Slices of the docking's grid of a result.
  int coarse(int axis) const {
    const int shrink = axes_[static_cast<std::size_t>(axis)].shrink;
    return (options_.size[axis] + shrink - 1) / shrink;
  }
  std::uint64_t draw(int axis) const {
    return Random(options_.seed, stream::kSlices).bits(static_cast<std::uint64_t>(axis));
  }

  bool same() const { return options_.size == example_; }

  void findDocking(const Progress& progress) {
    const int longest = std::max({example_.x, example_.y, example_.z});
    int shrink = 1;
    while (longest / shrink > kMostSlices) shrink *= 2;
    const DistanceField coarse =
        shrink == 1 ? parts_[0].field : blockAverage(parts_[0].field, shrink);
    for (int axis = 0; axis < 3; ++axis) {
      axes_.push_back({SliceDocking(coarse, axis, progress), shrink, example_[axis]});
    }
  }

  /// Whether the object is made longer or shorter in its own structure wherever it has to be.
  bool isFitted() const {
    for (int axis = 0; axis < 3; ++axis) {
      const bool fitted = result_.growth[static_cast<std::size_t>(axis)] == Growth::Fitted;
      if (options_.size[axis] != example_[axis] && !(fitted && docks(axis))) return false;
    }
    return true;
  }
  /// Whether the joints of a path cost little enough.
  bool docks(int axis) const {
    const SlicePath path = fitted(axis);
    return !path.source.empty() && path.meanCost <= (options_.kept ? kDocksKept : kDocks);
  }

  /// Whether an object that stands on one foot would stand on several.
  bool splitsFoot(int axis) const {
    if (axis == 2) return false;
    const Array3D<float>& values = parts_[0].field.values;
    const SliceDocking& upward = axes_[2].docking;
    const int shrink = axes_[2].shrink, bottom = upward.solidBegin() * shrink;
    const int height = (upward.solidEnd() - upward.solidBegin()) * shrink;
    const int top =
        std::min(example_.z, bottom + 1 + static_cast<int>(std::lround(height * kFoot)));
    Array3D<std::uint8_t> foot({example_.x, example_.y, 1});
    forEachCell({{0, 0, bottom}, {example_.x, example_.y, top}}, [&](const Vec3i& p) {
      if (values[p] < 0) foot(p.x, p.y, 0) = 1;
    });
    const auto pieces = [](const Array3D<std::uint8_t>& mask) {
      return countPieces(mask.size(), [&](const Vec3i& p) { return mask[p] != 0; });
    };
    if (pieces(foot) != 1) return false;
    const std::vector<int> along = fitted(axis).source;
    Vec3i size = foot.size();
    size[axis] = static_cast<int>(along.size());
    Array3D<std::uint8_t> longer(size);
    forEachCell(size, [&](const Vec3i& p) {
      Vec3i from = p;
      from[axis] = along[static_cast<std::size_t>(p[axis])];
      longer[p] = foot[from];
    });
    return pieces(longer) > 1;
  }

  /// Exchanges parts, on a grid that is small enough.
  void exchange(const Progress& progress) {
    if (options_.kept) {
      exchange_ = {Array3D<Vec3i>({1, 1, 1}), Array3D<std::uint8_t>({1, 1, 1})};
      return;
    }
    int shrink = 1;
    while (volume(example_) / (static_cast<std::int64_t>(shrink) * shrink * shrink) > kMostSamples)
      shrink *= 2;
    const DistanceField coarse =
        shrink == 1 ? parts_[0].field : blockAverage(parts_[0].field, shrink);
    PartExchangeOptions exchanging;
    exchanging.novelty = options_.novelty;
    exchanging.seed = Random(options_.seed, stream::kParts).bits(0);
    exchange_ = exchangeParts(coarse, exchanging, progress);
    exchangeShrink_ = shrink;
    result_.parts = exchange_.parts;
    result_.partDistance = exchange_.distance;
  }

  void chooseGrowth() {
    for (int axis = 0; axis < 3; ++axis) {
      Growth& growth = result_.growth[static_cast<std::size_t>(axis)];
      const int length = options_.size[axis];
      growth = Growth::Varied;
      if (length == example_[axis]) continue;
      const bool fits = docks(axis) && (options_.kept || !splitsFoot(axis));
      growth = fits || length < example_[axis] ? Growth::Fitted : Growth::Grown;
    }
  }

  SlicePath fitted(int axis) const {
    const Axis& along = axes_[static_cast<std::size_t>(axis)];
    std::vector<SliceRange> held;
    if (options_.kept) held = keptRanges(*options_.kept, axis);
    for (SliceRange& range : held) {
      range.begin /= along.shrink;
      range.end = (range.end + along.shrink - 1) / along.shrink;
    }
    return along.fine(fittedPath(along.docking, coarse(axis), draw(axis), held),
                      options_.size[axis]);
  }

  SlicePath varied(int axis) const {
    const Axis& along = axes_[static_cast<std::size_t>(axis)];
    const std::uint64_t draw =
        Random(options_.seed, stream::kSlices)
            .bits(static_cast<std::uint64_t>(axis + 3), static_cast<std::uint32_t>(draw_));
    const double solid = along.docking.solidEnd() - along.docking.solidBegin();
    return along.fine(variedPath(along.docking, motion_ * solid, pull_, draw), along.length);
  }

  /// Which sample of the example each sample along an axis is.
  std::vector<int> path(int axis) {
    const Growth growth = result_.growth[static_cast<std::size_t>(axis)];
    if (options_.kept && growth != Growth::Fitted) {
      std::vector<int> unchanged(static_cast<std::size_t>(example_[axis]));
      std::iota(unchanged.begin(), unchanged.end(), 0);
      return unchanged;
    }
    SlicePath found = growth == Growth::Fitted ? fitted(axis) : varied(axis);
    misfit_ += found.joints * found.meanCost;
    if (!found.source.empty()) return found.source;
    // Too short for a path: what is in the middle goes.
    std::vector<int> cropped(static_cast<std::size_t>(options_.size[axis]));
    for (std::size_t i = 0; i < cropped.size(); ++i) {
      const int at = static_cast<int>(i), left = static_cast<int>(cropped.size() - i);
      cropped[i] = at < left ? at : example_[axis] - left;
    }
    return cropped;
  }

  /// Where along each axis the first slice that is kept has gone.
  void findKeptOffset(const std::array<std::vector<int>, 3>& paths) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<SliceRange> held = keptRanges(*options_.kept, axis);
      const std::vector<int>& path = paths[static_cast<std::size_t>(axis)];
      if (held.empty()) continue;
      // The last slice of a range: at the first one, air may be repeated.
      const int last = held.front().end - 1;
      const auto at = std::find(path.begin(), path.end(), last);
      if (at != path.end()) result_.keptOffset[axis] = static_cast<int>(at - path.begin()) - last;
    }
  }

  /// Lays the object out.
  void lay(const Progress& progress) {
    sources_ = PyramidSources(level_.target.framed());
    fixed_ = Array3D<std::uint8_t>(sources_.size());
    const Vec3i before = level_.target.margin.before, first = level_.source.parts[0].begin;
    misfit_ = 0;
    progress.check();
    std::array<std::vector<int>, 3> paths;
    for (int axis = 0; axis < 3; ++axis) paths[static_cast<std::size_t>(axis)] = path(axis);
    if (options_.kept) findKeptOffset(paths);
    parallelForEachCell(CellBox{Vec3i{} - before, sources_.size() - before}, [&](const Vec3i& p) {
      Vec3i from;
      for (int axis = 0; axis < 3; ++axis) {
        const std::vector<int>& along = paths[static_cast<std::size_t>(axis)];
        const int inside = std::clamp(p[axis], 0, static_cast<int>(along.size()) - 1);
        from[axis] = along[static_cast<std::size_t>(inside)] + p[axis] - inside;
      }
      const Vec3i cell = exchange_.offsets.clamped(
          {from.x / exchangeShrink_, from.y / exchangeShrink_, from.z / exchangeShrink_});
      const Vec3i origin = from + exchange_.offsets[cell] * exchangeShrink_ + first;
      sources_[p + before] = level_.source.values.clamped(origin);
      fixed_[p + before] = options_.kept ? options_.kept->contains(from) && (*options_.kept)[from]
                                         : exchange_.changed[cell];
    });
  }

  /// How a layout of the example's own size compares with it.
  struct Comparison {
    double distance = 1;  ///< 1 - IoU, wherever the example is laid nearby
    double solid = 1;     ///< of the result, over the example's
  };
  Comparison compared() const {
    const Array3D<float>& source = level_.source.values;
    std::vector<std::pair<Vec3i, bool>> samples;
    std::int64_t here = 0, there = 0;
    const Vec3i n = sources_.size();
    for (int k = 0; k < n.z; k += kStride) {
      for (int j = 0; j < n.y; j += kStride) {
        for (int i = 0; i < n.x; i += kStride) {
          const Vec3i p{i, j, k};
          const bool solid = source[sources_[p]] < 0;
          here += solid;
          there += source[p] < 0;
          samples.emplace_back(p, solid);
        }
      }
    }
    constexpr int kShifts[] = {0, -1, 1, -2, 2, -4, 4};
    constexpr int kCount = std::size(kShifts);
    std::vector<double> distance(static_cast<std::size_t>(kCount) * kCount * kCount);
    parallelFor(0, distance.size(), 1, [&](std::size_t from, std::size_t to) {
      for (std::size_t m = from; m < to; ++m) {
        const int at = static_cast<int>(m);
        const Vec3i shift{kShifts[at % kCount], kShifts[at / kCount % kCount],
                          kShifts[at / kCount / kCount]};
        std::int64_t both = 0, either = 0;
        for (const auto& [p, solid] : samples) {
          const Vec3i q = p + shift;
          const bool example = source.contains(q) && source[q] < 0;
          both += solid && example;
          either += solid || example;
        }
        distance[m] =
            1 - static_cast<double>(both) / static_cast<double>(std::max<std::int64_t>(1, either));
      }
    });
    return {*std::min_element(distance.begin(), distance.end()),
            static_cast<double>(here) / static_cast<double>(std::max<std::int64_t>(1, there))};
  }

  /// Parts are moved as little as it takes to be new, in the way that tears least.
  void layOut(const Progress& progress) {
    if (!same()) {
      lay(progress);
      return;
    }
    PyramidSources best;
    Array3D<std::uint8_t> fixed;
    double least = 0;
    bool found = false;
    for (int rise = 0; rise < kRises && !found; ++rise) {
      for (draw_ = 0; draw_ < kDraws; ++draw_) {
        lay(progress);
        const Comparison comparison = compared();
        const double uneven = std::abs(comparison.solid - 1) / kSolid;
        const double old = std::max(0.0, 1 - comparison.distance / options_.novelty);
        const bool good = old <= 0 && uneven <= 1;
        const double score = misfit_ + kOld * old + std::max(0.0, uneven - 1);
        if (!best.empty() && (found ? !good || score >= least : !good && score >= least)) continue;
        found = found || good;
        least = score;
        best = sources_;
        fixed = fixed_;
        result_.distance = comparison.distance;
      }
      motion_ *= kFarther;
      pull_ *= kHarder;
    }
    sources_ = std::move(best);
    fixed_ = std::move(fixed);
  }

  Array3D<float> shown() const {
    Array3D<float> target = gather(level_, sources_);
    pinTarget(level_, static_cast<float>(options_.truncation), target);
    return target;
  }

  const ObjectOptions& options_;
  Vec3i example_;
  std::vector<SourcePart> parts_;
  PyramidLevel level_;
  std::vector<Axis> axes_;
  PartExchange exchange_;
  int exchangeShrink_ = 1;
  double motion_ = kMotion, pull_ = kPull;
  int draw_ = 0;
  double misfit_ = 0;  ///< of all joints laid out
  PyramidSources sources_;
  Array3D<std::uint8_t> fixed_;  ///< samples where parts were exchanged
  ObjectResult result_;
};

/// 1 - IoU of two fields of one size.
double distanceInPlace(const Array3D<float>& a, const Array3D<float>& b) {
  std::int64_t both = 0, either = 0;
  for (std::size_t s = 0; s < a.count(); ++s) {
    both += a.values()[s] < 0 && b.values()[s] < 0;
    either += a.values()[s] < 0 || b.values()[s] < 0;
  }
  return 1 - static_cast<double>(both) / static_cast<double>(std::max<std::int64_t>(1, either));
}

}  // namespace

bool isFreeStanding(const DistanceField& example) {
  const Vec3i n = example.size();
  bool solid = false, cut = false;
  forEachCell(n, [&](const Vec3i& p) {
    if (!(example.values[p] < 0)) return;
    solid = true;
    cut = cut || p.x == 0 || p.y == 0 || p.x == n.x - 1 || p.y == n.y - 1 || p.z == n.z - 1;
  });
  return solid && !cut;
}

ObjectResult synthesizeObject(const DistanceField& example, const ObjectOptions& options,
                              const Progress& progress) {
  const DistanceField* examples[] = {&example};
  PyramidOptions pyramid;
  pyramid.size = options.size;
  pyramid.truncation = options.truncation;
  checkPyramid(examples, false, pyramid, std::nullopt);
  if (!options.kept) {
    if (std::optional<StrewnParts> strewn =
            strewParts(example, {options.size, options.seed}, progress)) {
      ObjectResult result;
      result.strewn = strewn->parts;
      if (options.size == example.size())
        result.distance = distanceInPlace(example.values, strewn->made.field.values);
      result.made = std::move(strewn->made);
      return result;
    }
  }
  return Objects(example, options).run(progress);
}

}  // namespace exemplar
