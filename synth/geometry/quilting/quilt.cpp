// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/quilting/quilt.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/parallel.h"
#include "core/random.h"

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// Distances count up to here, in voxels of the level: the surface, not what is far from it.
constexpr float kLimit = 2;
/// What a sample beside the example's box costs, voxels: its seam will have to go elsewhere.
constexpr double kBesideBox = 0.5;
/// A block is compared at about this many samples, and where it has more places to come from than
/// kPlaces (a quilt on a fine level), at as many fewer, but at least kFewest.
constexpr std::size_t kCompared = 4096, kPlaces = 40000, kFewest = 64;
/// Offsets this near, of the example's longest side, count as the same.
constexpr double kSameOffset = 1.0 / 16;
/// How much of a result of the example's own size counts as in place already before it is begun.
constexpr double kInPlace = 0.5;
/// How much longer than the example a result is, from which its blocks may be longer, too.
constexpr double kLonger = 1.5;
/// An offset within half a sample of a step is aligned: there is one, or there are two.
constexpr double kAligned = 0.501;
/// Where blocks as long as the example have no aligned offset, they take the nearest up to here,
/// samples.
constexpr double kFarOff = 3;
/// A period that the example is short of by so small a share of it counts as whole.
constexpr double kNearlyWhole = 0.1;
/// How `variety` rises, and how often.
constexpr double kMoreVariety = 1.5;
constexpr int kRises = 4;
/// How many quilts are made to keep the best of, and what it costs one that none of the example's
/// surface is in it, in voxels.
constexpr int kDraws = 4;
constexpr double kUnused = 2;
/// What random numbers are drawn for: a row's phase, and which of the good places a block takes.
constexpr std::uint32_t kPhase = 0, kDraw = 1;

int longestSide(const Vec3i& size) { return std::max({size.x, size.y, size.z}); }

class Quilt {
 public:
  Quilt(const PyramidLevel& level, const QuiltOptions& options, double variety, int attempt)
      : level_(level),
        options_(options),
        variety_(variety),
        random_(Random(options.seed, stream::kQuilt).fork(static_cast<std::uint64_t>(attempt))),
        example_(level.source.framed(0).size()),
        size_(level.target.framed()),
        near_(std::max(1, static_cast<int>(std::lround(longestSide(level.source.parts[0].size()) *
                                                       kSameOffset)))),
        sources_(size_),
        shown_(size_),
        placed_(size_),
        use_(level.source.values.size()) {
    low_ = {0, 0, 0};
    high_ = size_;
    for (int axis = 0; axis < 3; ++axis) {
      if (level.target.periodic[axis]) {
        low_[axis] = level.target.margin.before[axis];
        high_[axis] = low_[axis] + level.target.size[axis];
      }
      const int n = level.source.parts[0].size()[axis];
      const bool longer = level.target.size[axis] >= kLonger * n;
      const double share = longer ? options.longBlock : options.block;
      const int side = static_cast<int>(std::lround(n * share));
      block_[axis] = std::max(2, std::min(side, n - options.repetition.cell()[axis]));
      period_[axis] = options.repetition.periodAlong(axis);
      if (period_[axis] > 0) {
        const double room = longer ? n : n * options.block;
        periods_[axis] = std::max(1, static_cast<int>(room / period_[axis] + kNearlyWhole));
      }
      overlap_[axis] =
          std::max(1, static_cast<int>(std::lround(n * std::min(options.overlap, 1 - share))));
    }
    if (level.target.size == level.source.parts[0].size()) {
      used_.emplace_back(Vec3i{0, 0, 0}, kInPlace * static_cast<double>(volume(size_)));
    }
    const Vec3i end = level.target.margin.before + level.target.size;
    parallelForEachCell(size_, [&](const Vec3i& p) {
      bool frame = false;
      for (int axis = 0; axis < 3; ++axis) {
        frame = frame ||
                (!level.target.periodic[axis] && p[axis] < level.target.margin.before[axis]) ||
                (level.source.air.after[axis] > 0 && p[axis] >= end[axis]);
      }
      if (!frame) return;
      shown_[p] = kLimit;
      placed_[p] = 1;
    });
  }

  PyramidSources run(const Progress& progress) {
    std::uint64_t row = 0, block = 0;
    const std::vector<int> z = joints(2, row++);
    for (std::size_t k = 0; k + 1 < z.size(); ++k) {
      const std::vector<int> y = joints(1, row++);
      for (std::size_t j = 0; j + 1 < y.size(); ++j) {
        const std::vector<int> x = joints(0, row++);
        for (std::size_t i = 0; i + 1 < x.size(); ++i) {
          progress.check();
          place({x[i], y[j], z[k]}, {x[i + 1], y[j + 1], z[k + 1]}, block++);
        }
      }
    }
    return std::move(sources_);
  }

  /// The mean over blocks of how much each disagrees with what was there before, in voxels.
  double disagreement() const { return disagreement_ / static_cast<double>(blocks_); }

  /// The share of the example's surface samples that are nowhere in the result.
  double unused() const {
    std::int64_t unused = 0, all = 0;
    for (std::size_t s = 0; s < use_.count(); ++s) {
      if (std::abs(level_.source.values.values()[s]) >= 1) continue;
      ++all;
      unused += use_.values()[s] == 0;
    }
    return all == 0 ? 0 : static_cast<double>(unused) / static_cast<double>(all);
  }

 private:
  /// Where a row's blocks begin and end along an axis: from a random phase.
  std::vector<int> joints(int axis, std::uint64_t row) const {
    return period_[axis] > 0 ? jointsOnPeriods(axis, row) : jointsAnywhere(axis, row);
  }

  /// Blocks of as many whole periods as they have room for.
  std::vector<int> jointsOnPeriods(int axis, std::uint64_t row) const {
    const auto periods = static_cast<std::uint32_t>(periods_[axis]);
    std::vector<int> joints{low_[axis]};
    double next = low_[axis] + period_[axis] * (1 + random_.below(periods, row, kPhase));
    for (; next < high_[axis] - 1; next += period_[axis] * periods) {
      joints.push_back(static_cast<int>(std::lround(next)));
    }
    joints.push_back(high_[axis]);
    return joints;
  }

  /// Blocks of one length, none very thin.
  std::vector<int> jointsAnywhere(int axis, std::uint64_t row) const {
    const int length = size_[axis], side = block_[axis];
    std::vector<int> joints{0};
    if (length > side) {
      int next = 1 + static_cast<int>(random_.below(static_cast<std::uint32_t>(side), row, kPhase));
      if (next < side / 3) next += side;
      for (; length - next >= std::max(1, side / 3); next += side) joints.push_back(next);
    }
    joints.push_back(length);
    // The first and the last may be longer than the example, or leave it no room to be aligned: the
    // rest becomes a block of its own, at the result's side.
    const int longest = std::max(1, example_[axis] - options_.repetition.cell()[axis]);
    for (std::size_t n = 1; n < joints.size(); ++n) {
      const int first = joints[n - 1], over = joints[n] - first - longest;
      if (over <= 0) continue;
      const int joint = n == 1 && over < longest ? over : first + longest;
      joints.insert(joints.begin() + static_cast<std::ptrdiff_t>(n), joint);
    }
    return joints;
  }

  struct Known {
    Vec3i p;
    float value;
  };
  /// What is placed in and around a block: about kCompared samples of it.
  std::vector<Known> knownAround(const Vec3i& first, const Vec3i& end, std::size_t places) const {
    const std::size_t compared = std::max(kFewest, kCompared * kPlaces / std::max(kPlaces, places));
    const Vec3i low = max(first - overlap_, Vec3i{0, 0, 0}), high = min(end + overlap_, size_);
    std::vector<Known> known;
    forEachCell(CellBox{low, high}, [&](const Vec3i& p) {
      if (placed_[p]) known.push_back({p, shown_[p]});
    });
    if (known.size() <= compared) return known;
    std::vector<Known> some;
    for (std::size_t n = 0; n < compared; ++n) {
      some.push_back(known[n * known.size() / compared]);
    }
    return some;
  }

  /// Where in the source a block may begin: low and high, inclusive.
  std::pair<Vec3i, Vec3i> places(const Vec3i& first, const Vec3i& end) const {
    Vec3i low, high;
    for (int axis = 0; axis < 3; ++axis) {
      const int length = end[axis] - first[axis];
      low[axis] = 0;
      high[axis] = std::max(0, example_[axis] - length);
      if (options_.window[axis] < 0) continue;
      const double inside = (first[axis] + end[axis]) / 2.0 - level_.target.margin.before[axis];
      const double middle = level_.source.parts[0].begin[axis] +
                            inside * level_.source.parts[0].size()[axis] / level_.target.size[axis];
      const int place = static_cast<int>(std::lround(middle - length / 2.0));
      high[axis] = std::clamp(place + options_.window[axis], 0, high[axis]);
      low[axis] = std::clamp(place - options_.window[axis], 0, high[axis]);
    }
    return {low, high};
  }

  double disagreementAt(const std::vector<Known>& known, const Vec3i& offset) const {
    double sum = 0;
    for (const Known& sample : known) {
      const Vec3i q = sample.p + offset;
      sum += level_.source.values.contains(q)
                 ? std::abs(std::clamp(level_.source.values[q], -kLimit, kLimit) - sample.value)
                 : kBesideBox;
    }
    return known.empty() ? 0 : sum / static_cast<double>(known.size());
  }

  /// How often the source of a block was used, over how often each part must be on average.
  double useOf(const Vec3i& first, const Vec3i& end, const Vec3i& offset) const {
    double used = 0, count = 0;
    int step = 2;
    while (volume(end - first) > static_cast<std::int64_t>(kCompared) * step * step * step) ++step;
    for (int k = first.z; k < end.z; k += step) {
      for (int j = first.y; j < end.y; j += step) {
        for (int i = first.x; i < end.x; i += step) {
          used += use_[use_.clamped(Vec3i{i, j, k} + offset)];
          ++count;
        }
      }
    }
    const double share = static_cast<double>(made_) / static_cast<double>(use_.count());
    return used / count / std::max(0.5, share);
  }

  /// The share of the result that has this offset, or nearly.
  double shareOf(const Vec3i& offset) const {
    double samples = 0;
    for (const auto& [other, count] : used_) {
      const Vec3i d = offset - other;
      if (std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) <= near_) samples += count;
    }
    return samples / static_cast<double>(volume(size_));
  }

  /// Which of `count` offsets are steps of the repetition, as nearly as any is; all where nothing
  /// repeats.
  template <class Offset>
  std::vector<std::size_t> aligned(std::size_t count, const Offset& offset) const {
    std::vector<std::size_t> all(count), choice;
    std::iota(all.begin(), all.end(), std::size_t{0});
    if (!options_.repetition.any()) return all;
    for (double tolerance = kAligned; tolerance < kFarOff; tolerance += 0.5) {
      for (const std::size_t n : all) {
        const Vec3i step = offset(n) - level_.inPlace();
        if (options_.repetition.holds(step, tolerance)) choice.push_back(n);
      }
      if (!choice.empty()) return choice;
    }
    return all;
  }

  /// Notes what a sample shows, and at the result's other side as well where it continues there.
  void show(const Vec3i& p, float value) {
    for (int image = 0; image < 27; ++image) {
      const Vec3i side = Vec3i{image % 3, image / 3 % 3, image / 9} - Vec3i{1, 1, 1};
      Vec3i at = p;
      bool there = true;
      for (int axis = 0; axis < 3; ++axis) {
        there = there && (side[axis] == 0 || level_.target.periodic[axis]);
        at[axis] += side[axis] * level_.target.size[axis];
      }
      if (!there || !shown_.contains(at)) continue;
      shown_[at] = value;
      placed_[at] = 1;
    }
  }

  void place(const Vec3i& first, const Vec3i& end, std::uint64_t block) {
    const auto [low, high] = places(first, end);
    const Array3D<std::uint8_t> box(high - low + Vec3i{1, 1, 1});
    const std::vector<Known> known = knownAround(first, end, box.count());
    const auto offset = [&, low = low](std::size_t n) { return box.ijk(n) + low - first; };
    const std::vector<std::size_t> choice = aligned(box.count(), offset);
    std::vector<double> cost(choice.size());
    parallelFor(0, cost.size(), 16, [&](std::size_t from, std::size_t to) {
      for (std::size_t n = from; n < to; ++n) {
        const Vec3i d = offset(choice[n]);
        cost[n] =
            disagreementAt(known, d) + options_.use * useOf(first, end, d) + variety_ * shareOf(d);
      }
    });
    const double limit = *std::min_element(cost.begin(), cost.end()) * (1 + options_.slack) + 1e-6;
    std::vector<std::size_t> good;
    for (std::size_t n = 0; n < cost.size(); ++n) {
      if (cost[n] <= limit) good.push_back(choice[n]);
    }
    const Vec3i d =
        offset(good[random_.below(static_cast<std::uint32_t>(good.size()), block, kDraw)]);
    used_.emplace_back(d, static_cast<double>(volume(end - first)));
    disagreement_ += disagreementAt(known, d);
    ++blocks_;
    forEachCell(CellBox{first, end}, [&, d = d](const Vec3i& p) {
      const Vec3i q = level_.source.values.clamped(p + d);
      sources_[p] = q;
      if (placed_[p]) return;
      use_[q] += 1;
      ++made_;
      show(p, std::clamp(level_.source.values[q], -kLimit, kLimit));
    });
  }

  const PyramidLevel& level_;
  const QuiltOptions& options_;
  double variety_;
  Random random_;
  Vec3i example_, size_, block_, overlap_;
  Vec3i low_, high_;  // of what blocks are laid on: all but the margins of periodic axes
  Vec3d period_;      // along each axis; 0: none
  Vec3i periods_;     // of a block
  int near_;
  PyramidSources sources_;
  Array3D<float> shown_;
  Array3D<std::uint8_t> placed_;
  Array3D<float> use_;
  std::size_t made_ = 0, blocks_ = 0;
  double disagreement_ = 0;
  std::vector<std::pair<Vec3i, double>> used_;  // offsets, and for how many samples
};

}  // namespace

PyramidSources quilt(const PyramidLevel& level, const QuiltOptions& options,
                     const Progress& progress) {
  const bool same = level.target.size == level.source.parts[0].size();
  double variety = options.variety, farthest = -1;
  PyramidSources last;
  for (int rise = 0; rise < kRises; ++rise, variety *= kMoreVariety) {
    double least = std::numeric_limits<double>::infinity();
    PyramidSources best;
    for (int draw = 0; draw < kDraws; ++draw) {
      Quilt attempt(level, options, variety, rise * kDraws + draw);
      // Each rise is as likely as not the last: it gets half of what is left to report.
      const double before = 1 - std::ldexp(1, -rise), share = std::ldexp(0.5 / kDraws, -rise);
      const Progress drawing = progress.part(before + draw * share, before + (draw + 1) * share);
      drawing.report("laying blocks", 0);
      PyramidSources sources = attempt.run(drawing);
      if (same && options.cut) options.cut(sources, drawing.part(0.5, 1));
      const double distance = same ? distanceToSource(level, sources, kCopyReach) : 1;
      if (distance > farthest && best.empty()) last = sources;
      farthest = std::max(farthest, distance);
      if (distance < options.novelty) continue;
      const double score = attempt.disagreement() + kUnused * attempt.unused();
      if (score >= least) continue;
      least = score;
      best = std::move(sources);
    }
    if (!best.empty()) return best;
  }
  return last;
}

double distanceToSource(const PyramidLevel& level, const PyramidSources& sources, int reach) {
  if (level.target.size != level.source.parts[0].size()) return 1;
  const Array3D<float>& source = level.source.values;
  const int side = 2 * reach + 1;
  std::vector<double> distance(static_cast<std::size_t>(side) * side * side);
  parallelFor(0, distance.size(), 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t m = from; m < to; ++m) {
      const int at = static_cast<int>(m);
      const Vec3i shift =
          Vec3i{at % side, at / side % side, at / side / side} - Vec3i{reach, reach, reach};
      std::int64_t both = 0, either = 0;
      forEachCell(sources.size(), [&](const Vec3i& p) {
        const Vec3i q = p + shift;
        if (!source.contains(q)) return;
        const bool here = source[sources[p]] < 0, there = source[q] < 0;
        both += here && there;
        either += here || there;
      });
      distance[m] = either == 0 ? 0 : 1 - static_cast<double>(both) / static_cast<double>(either);
    }
  });
  return *std::min_element(distance.begin(), distance.end());
}

}  // namespace exemplar
