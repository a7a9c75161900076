// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/objects/part_exchange.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/cells.h"
#include "core/parallel.h"
#include "core/random.h"
#include "synth/geometry/seams/regions.h"

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// Distances count up to here, voxels.
constexpr float kLimit = 1.5F;
/// Two places agree that differ by no more than this, voxels, all around as far as kBorder samples.
constexpr float kAgree = 0.5F;
constexpr int kBorder = 1;
/// Offsets that are tried, and for each how many places are compared with one of the surface, by
/// patches of this reach.
constexpr int kOffsets = 80, kPlaces = 48, kPatch = 3;
/// Offsets are at least this long, of the object's longest side.
constexpr double kShortest = 1.0 / 16;
/// A part must change at least this share of the solid, and at most the second.
constexpr double kLeastChange = 0.004, kMostChange = 0.35;
/// How much more or less of solid there may be, of the example's.
constexpr double kSolid = 0.05;
/// How much of the object's height its foot is, and by how many samples its extent may shrink.
constexpr double kFoot = 0.12;
constexpr int kShrink = 2;

/// What random numbers are drawn for.
constexpr std::uint32_t kHere = 0, kThere = 1, kPart = 2;

class Exchange {
 public:
  Exchange(const DistanceField& example, const PartExchangeOptions& options)
      : options_(options), random_(options.seed, stream::kParts), example_(example.size()) {
    const auto voxel = static_cast<float>(example.voxelSize);
    parallelFor(0, example_.count(), 1 << 14, [&](std::size_t from, std::size_t to) {
      for (std::size_t s = from; s < to; ++s) {
        example_.values()[s] = std::clamp(example.values.values()[s] / voxel, -kLimit, kLimit);
      }
    });
    box_ = {example_.size(), {0, 0, 0}};
    forEachCell(example_.size(), [&](const Vec3i& p) {
      const float value = example_[p];
      if (std::abs(value) < 1) surface_.push_back(p);
      if (!(value < 0)) return;
      ++solid_;
      box_.begin = min(box_.begin, p);
      box_.end = max(box_.end, p + Vec3i{1, 1, 1});
    });
    shown_ = example_;
    pieces_ = piecesOf(shown_);
    found_.offsets = Array3D<Vec3i>(example_.size());
    found_.changed = Array3D<std::uint8_t>(example_.size());
    made_ = solid_;
  }

  PartExchange run(const Progress& progress) {
    for (int attempt = 0; attempt < kOffsets && !surface_.empty(); ++attempt) {
      progress.check();
      progress.report("exchanging parts", static_cast<double>(attempt) / kOffsets);
      if (found_.distance >= options_.novelty) break;
      const std::optional<Vec3i> offset = drawOffset(static_cast<std::uint64_t>(attempt));
      if (offset) exchange(*offset, static_cast<std::uint64_t>(attempt));
    }
    return std::move(found_);
  }

 private:
  float at(const Vec3i& p) const { return example_.contains(p) ? example_[p] : kLimit; }

  static std::uint32_t piecesOf(const Array3D<float>& values) {
    return countPieces(values.size(), [&](const Vec3i& p) { return values[p] < 0; });
  }

  /// From a place of the surface to the one that looks most like it of some others, far enough off.
  std::optional<Vec3i> drawOffset(std::uint64_t attempt) const {
    const Vec3i extent = box_.end - box_.begin;
    const double shortest = std::max(2.0, kShortest * std::max({extent.x, extent.y, extent.z}));
    const auto count = static_cast<std::uint32_t>(surface_.size());
    const Vec3i here = surface_[random_.below(count, attempt, kHere)];
    std::optional<Vec3i> best;
    float least = kAgree;
    for (int place = 0; place < kPlaces; ++place) {
      const std::uint64_t draw = attempt * kPlaces + static_cast<std::uint64_t>(place);
      const Vec3i offset = surface_[random_.below(count, draw, kThere)] - here;
      if (std::hypot(offset.x, offset.y, offset.z) < shortest) continue;
      float sum = 0;
      int samples = 0;
      forEachCell(CellBox{here, here + Vec3i{1, 1, 1}}.grown(kPatch), [&](const Vec3i& p) {
        sum += std::abs(at(p) - at(p + offset));
        ++samples;
      });
      const float difference = sum / static_cast<float>(samples);
      if (difference >= least) continue;
      least = difference;
      best = offset;
    }
    return best;
  }

  /// Where what is shown and what lies over it disagree, or would within the border.
  Array3D<std::uint8_t> disagreement(const Vec3i& offset) const {
    const Vec3i n = example_.size();
    Array3D<std::uint8_t> mask(n);
    parallelForEachCell(
        n, [&](const Vec3i& p) { mask[p] = std::abs(shown_[p] - at(p + offset)) > kAgree; });
    for (int step = 0; step < kBorder; ++step) {
      const Array3D<std::uint8_t> before = mask;
      parallelForEachCell(n, [&](const Vec3i& p) {
        if (before[p]) return;
        for (const Vec3i& d : kFaceSteps) {
          const Vec3i q = p + d;
          if (before.contains(q) && before[q]) mask[p] = 1;
        }
      });
    }
    return mask;
  }

  struct Part {
    std::int64_t changed = 0, gained = 0;
    bool allowed = true;
  };

  void exchange(const Vec3i& offset, std::uint64_t attempt) {
    const Array3D<std::uint8_t> mask = disagreement(offset);
    const Regions regions = findRegions(mask.size(), [&](const Vec3i& p) { return mask[p] != 0; });
    std::vector<Part> parts(regions.count);
    const int foot =
        box_.begin.z +
        std::max(1, static_cast<int>(std::lround((box_.end.z - box_.begin.z) * kFoot)));
    const CellBox extent = box_;
    regions.forEachRun([&](const Regions::Run& run, Vec3i p) {
      Part& part = parts[run.region];
      if (!mask[p]) {
        part.allowed = false;
        return;
      }
      for (; p.x < run.end; ++p.x) {
        const bool here = shown_[p] < 0, there = at(p + offset) < 0;
        if (here == there) continue;
        ++part.changed;
        part.gained += there ? 1 : -1;
        if (p.z < foot || (there && !extent.contains(p))) part.allowed = false;
      }
    });
    for (std::uint32_t n = 0; n < regions.count; ++n) {
      const Part& part = parts[n];
      const double changed = static_cast<double>(part.changed) / static_cast<double>(solid_);
      if (!part.allowed || changed < kLeastChange || changed > kMostChange) continue;
      if (random_.uniform(attempt * 4096 + n, kPart) < 0.25) continue;
      const double before = std::abs(static_cast<double>(made_) / static_cast<double>(solid_) - 1);
      const double after =
          std::abs(static_cast<double>(made_ + part.gained) / static_cast<double>(solid_) - 1);
      if (after > kSolid && after >= before) continue;
      take(regions, n, offset, part);
      if (found_.distance >= options_.novelty) return;
    }
  }

  /// Replaces a part, unless the object would fall apart or shrink.
  void take(const Regions& regions, std::uint32_t number, const Vec3i& offset, const Part& part) {
    const Array3D<float> before = shown_;
    regions.forEachRun([&](const Regions::Run& run, Vec3i p) {
      if (run.region != number) return;
      for (; p.x < run.end; ++p.x) shown_[p] = at(p + offset);
    });
    CellBox box{example_.size(), {0, 0, 0}};
    std::int64_t both = 0, either = 0;
    forEachCell(example_.size(), [&](const Vec3i& p) {
      const bool here = shown_[p] < 0, there = example_[p] < 0;
      both += here && there;
      either += here || there;
      if (!here) return;
      box.begin = min(box.begin, p);
      box.end = max(box.end, p + Vec3i{1, 1, 1});
    });
    const double distance = 1 - static_cast<double>(both) / static_cast<double>(either);
    bool keeps = distance > found_.distance;
    for (int axis = 0; axis < 3; ++axis) {
      keeps = keeps && box.begin[axis] <= box_.begin[axis] + kShrink &&
              box.end[axis] >= box_.end[axis] - kShrink;
    }
    if (!keeps || piecesOf(shown_) > pieces_) {
      shown_ = before;
      return;
    }
    regions.forEachRun([&](const Regions::Run& run, Vec3i p) {
      if (run.region != number) return;
      for (; p.x < run.end; ++p.x) {
        found_.offsets[p] = offset;
        found_.changed[p] = std::abs(shown_[p] - before[p]) > kAgree;
      }
    });
    made_ += part.gained;
    found_.distance = distance;
    ++found_.parts;
  }

  const PartExchangeOptions& options_;
  Random random_;
  Array3D<float> example_, shown_;  // voxels
  std::vector<Vec3i> surface_;
  CellBox box_;  // of what is solid
  std::int64_t solid_ = 0, made_ = 0;
  std::uint32_t pieces_ = 0;
  PartExchange found_;
};

}  // namespace

PartExchange exchangeParts(const DistanceField& example, const PartExchangeOptions& options,
                           const Progress& progress) {
  return Exchange(example, options).run(progress);
}

}  // namespace exemplar
