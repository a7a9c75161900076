// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <string_view>

#include "core/origin.h"
#include "core/progress.h"
#include "sdf/distance_field.h"
#include "synth/geometry/pyramid/pyramid.h"
#include "synth/geometry/synthesize.h"

/// Examples made from formulas, voxels of length 1, and checks of what every engine promises.
namespace exemplar::testing {

/// The distance to equal balls thrown at random that do not touch, clamped to ±8.
DistanceField balls(const Vec3i& size, double radius, std::uint64_t seed);

/// The vertical distance to a rolling ground at about 0.4 of the height, clamped to ±8.
DistanceField ground(const Vec3i& size, std::uint64_t seed);

/// A field that repeats exactly after `period` samples along each axis, values about ±period / 4.
DistanceField waves(const Vec3i& size, int period);

/// Balls at all sums of whole multiples of three steps, each out of place by up to `jitter`.
DistanceField lattice(const Vec3i& size, const std::array<Vec3d, 3>& steps, double radius,
                      double jitter);

/// One value everywhere.
DistanceField constant(const Vec3i& size, float value);

/// The finest level of a result of this size from one example, not turned.
PyramidLevel levelOf(const DistanceField& example, const Vec3i& size);

/// The number of samples that are not what the example has at their origins, or have an origin that
/// is not a cell of it.
std::int64_t samplesNotCopied(const DistanceField& example, const SynthesisResult& result);

/// The share of faces across which the result does not continue as its example does, by more than
/// `tolerance`; of those whose origin has a neighbor in the example.
double brokenFaces(const DistanceField& example, const DistanceField& field, const Origins& origins,
                   float tolerance);

/// Runs `work` with exactly this many threads.
void withThreads(int threads, const std::function<void()>& work);

/// Asks for an end once `stage` (any, if empty) is reported for the `reports`-th time.
class CancelAfter {
 public:
  explicit CancelAfter(int reports, std::string_view stage = {}) : left_(reports), stage_(stage) {}
  Progress progress() {
    return Progress(
        [this](std::string_view stage, double) {
          if (stage.find(stage_) != std::string_view::npos && --left_ == 0) cancel_ = true;
        },
        &cancel_);
  }
  bool happened() const { return cancel_; }

 private:
  std::atomic<int> left_;
  std::string_view stage_;
  std::atomic<bool> cancel_ = false;
};

}  // namespace exemplar::testing
