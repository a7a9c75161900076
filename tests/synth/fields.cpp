// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "tests/synth/fields.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "core/random.h"

namespace exemplar::testing {
namespace {

constexpr float kTruncation = 8;

DistanceField fill(const Vec3i& size, const std::function<double(const Vec3i&)>& distance) {
  DistanceField field;
  field.values = Array3D<float>(size);
  field.truncation = kTruncation;
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    field.values.values()[s] =
        std::clamp(static_cast<float>(distance(field.values.ijk(s))), -kTruncation, kTruncation);
  }
  return field;
}

}  // namespace

DistanceField balls(const Vec3i& size, double radius, std::uint64_t seed) {
  const Random random(seed);
  std::vector<Vec3d> centers;
  for (int n = 0; n < 20000; ++n) {
    Vec3d center;
    for (int axis = 0; axis < 3; ++axis) {
      center[axis] = random.uniform(-radius, size[axis] + radius, n, 2 * axis);
    }
    const bool free = std::none_of(centers.begin(), centers.end(), [&](const Vec3d& other) {
      return length(center - other) < 2 * radius + 1;
    });
    if (free) centers.push_back(center);
  }
  return fill(size, [&](const Vec3i& p) {
    double distance = kTruncation;
    for (const Vec3d& center : centers) {
      distance = std::min(distance, length(cast<double>(p) - center) - radius);
    }
    return distance;
  });
}

DistanceField ground(const Vec3i& size, std::uint64_t seed) {
  const Random random(seed);
  const double a = random.uniform(0, 6, 0), b = random.uniform(0, 6, 1);
  return fill(size, [&](const Vec3i& p) {
    return p.z - 0.4 * size.z -
           0.1 * size.z * (std::sin(p.x * 0.43 + a) + std::cos(p.y * 0.31 + b));
  });
}

DistanceField waves(const Vec3i& size, int period) {
  const auto wave = [&](int p) { return std::sin(p % period * 2 * 3.14159265358979 / period); };
  return fill(size, [&](const Vec3i& p) {
    return period / 12.0 * (wave(p.x) + wave(p.y + 1) + wave(p.z + 2));
  });
}

DistanceField lattice(const Vec3i& size, const std::array<Vec3d, 3>& steps, double radius,
                      double jitter) {
  constexpr int kReach = 8, kSide = 2 * kReach + 1;
  const Random random(7, 7);
  std::vector<Vec3d> centers;
  for (int n = 0; n < kSide * kSide * kSide; ++n) {
    Vec3d at = cast<double>(size) * 0.5;
    at += steps[0] * (n % kSide - kReach) + steps[1] * (n / kSide % kSide - kReach);
    at += steps[2] * (n / kSide / kSide - kReach);
    for (int axis = 0; axis < 3; ++axis) at[axis] += jitter * random.uniform(-1, 1, n, axis);
    centers.push_back(at);
  }
  return fill(size, [&](const Vec3i& p) {
    double nearest = 1e9;
    for (const Vec3d& c : centers) nearest = std::min(nearest, length(cast<double>(p) - c));
    return nearest - radius;
  });
}

DistanceField constant(const Vec3i& size, float value) {
  return fill(size, [&](const Vec3i&) { return value; });
}

PyramidLevel levelOf(const DistanceField& example, const Vec3i& size) {
  PyramidOptions options;
  options.size = size;
  const std::vector<SourcePart> parts{{example, 0, 0, {}}};
  return makeLevel(parts, 0, options);
}

std::int64_t samplesNotCopied(const DistanceField& example, const SynthesisResult& result) {
  if (result.origins.size() != result.field.size()) return volume(result.field.size());
  std::int64_t wrong = 0;
  for (std::size_t s = 0; s < result.origins.count(); ++s) {
    const Vec3i cell = result.origins.values()[s].cell();
    wrong +=
        !example.values.contains(cell) || example.values[cell] != result.field.values.values()[s];
  }
  return wrong;
}

double brokenFaces(const DistanceField& example, const DistanceField& field, const Origins& origins,
                   float tolerance) {
  std::int64_t broken = 0, faces = 0;
  for (std::size_t s = 0; s < origins.count(); ++s) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i next = origins.ijk(s), cell = origins.values()[s].cell();
      ++next[axis];
      ++cell[axis];
      if (!origins.contains(next) || !example.values.contains(cell)) continue;
      ++faces;
      broken += std::abs(example.values[cell] - field.values[next]) > tolerance;
    }
  }
  return faces == 0 ? 0 : static_cast<double>(broken) / static_cast<double>(faces);
}

void withThreads(int threads, const std::function<void()>& work) {
  tbb::task_arena(threads).execute(work);
}

}  // namespace exemplar::testing
