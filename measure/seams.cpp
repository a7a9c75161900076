// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/seams.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/cells.h"
#include "core/loop_progress.h"
#include "core/parallel.h"
#include "measure/novelty.h"
#include "measure/same_voxels.h"

namespace exemplar {
namespace {

constexpr double kBand = 3;  // voxels
constexpr std::size_t kLayers = 4;

struct Mean {
  double sum = 0;
  std::int64_t count = 0;

  void add(double value) {
    sum += value;
    ++count;
  }
  Mean& operator+=(const Mean& o) {
    sum += o.sum;
    count += o.count;
    return *this;
  }
  double value() const { return count == 0 ? 0 : sum / static_cast<double>(count); }
};

struct Means {
  Mean all, near;
  std::int64_t faces = 0;

  Means& operator+=(const Means& o) {
    all += o.all;
    near += o.near;
    faces += o.faces;
    return *this;
  }
};

/// A field in voxels, cut off at `truncation` voxels.
class InVoxels {
 public:
  InVoxels(const DistanceField& field, double truncation)
      : field_(field), truncation_(truncation) {}

  const Vec3i& size() const { return field_.size(); }
  bool contains(const Vec3i& p) const { return field_.values.contains(p); }
  double operator()(const Vec3i& p) const {
    return std::clamp(field_.values[p] / field_.voxelSize, -truncation_, truncation_);
  }

 private:
  const DistanceField& field_;
  double truncation_;
};

Vec3i unit(int axis) {
  Vec3i step{};
  step[axis] = 1;
  return step;
}

/// Calls `body(ijk, partial)` for all samples, layer by layer; the partial sums in order.
template <class Sum, class Body>
Sum sumOverSamples(const Vec3i& n, const Progress& progress, const Body& body) {
  LoopProgress layers(progress, "measuring seams", static_cast<std::size_t>(n.z));
  return parallelSum<Sum>(0, n.z, kLayers, [&](std::size_t begin, std::size_t end) {
    Sum sum{};
    for (int k = static_cast<int>(begin); k < static_cast<int>(end); ++k) {
      forEachCell(CellBox{{0, 0, k}, {n.x, n.y, k + 1}}, [&](const Vec3i& p) { body(p, sum); });
      layers.advance();
    }
    return sum;
  });
}

std::optional<double> eikonalResidual(const InVoxels& phi, double band, const Progress& progress) {
  const Vec3i n = phi.size();
  const Mean mean = sumOverSamples<Mean>(n, progress, [&](const Vec3i& p, Mean& sum) {
    if (p.x < 1 || p.y < 1 || p.z < 1 || p.x > n.x - 2 || p.y > n.y - 2 || p.z > n.z - 2) return;
    if (!(std::abs(phi(p)) < band)) return;
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double slope = (phi(p + unit(axis)) - phi(p - unit(axis))) / 2;
      square += slope * slope;
    }
    sum.add(std::abs(std::sqrt(square) - 1));
  });
  if (mean.count == 0) return std::nullopt;
  return mean.value();
}

/// The example's own second differences.
Means secondDifferences(const InVoxels& phi, const Progress& progress) {
  const Vec3i n = phi.size();
  return sumOverSamples<Means>(n, progress, [&](const Vec3i& p, Means& sum) {
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] < 1 || p[axis] > n[axis] - 2) continue;
      const double difference = std::abs(phi(p - unit(axis)) - 2 * phi(p) + phi(p + unit(axis)));
      sum.all.add(difference);
      if (std::abs(phi(p)) < kBand) sum.near.add(difference);
    }
  });
}

/// The jump at the face between `a` and the sample one `step` on, where the source changes there
/// and the example says what should follow.
std::optional<double> jumpAt(const InVoxels& example, const InVoxels& result,
                             const Origins& origins, int exampleIndex, const Vec3i& a,
                             const Vec3i& step) {
  const Vec3i b = a + step;
  const Origin &oa = origins[a], &ob = origins[b];
  if (continues(oa, ob, step)) return std::nullopt;
  const double slope = result(a) - result(b);
  Mean jump;
  if (const Vec3i on = oa.cell() + turnedBack(step, oa);
      oa.example == exampleIndex && example.contains(on))
    jump.add(std::abs(slope - (example(oa.cell()) - example(on))));
  if (const Vec3i back = ob.cell() - turnedBack(step, ob);
      ob.example == exampleIndex && example.contains(back))
    jump.add(std::abs(slope - (example(back) - example(ob.cell()))));
  if (jump.count == 0) return std::nullopt;
  return jump.value();
}

Means meanJumps(const InVoxels& example, const InVoxels& result, const Origins& origins,
                int exampleIndex, const Progress& progress) {
  return sumOverSamples<Means>(result.size(), progress, [&](const Vec3i& a, Means& sum) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3i b = a + unit(axis);
      if (!result.contains(b)) continue;
      ++sum.faces;
      const std::optional<double> jump =
          jumpAt(example, result, origins, exampleIndex, a, unit(axis));
      if (!jump) continue;
      sum.all.add(*jump);
      if (std::abs(result(a)) < kBand || std::abs(result(b)) < kBand) sum.near.add(*jump);
    }
  });
}

std::optional<double> ratio(double value, double reference) {
  if (reference == 0) return std::nullopt;
  return value / reference;
}

double truncationVoxels(const DistanceField& field) {
  return field.truncation > 0 ? field.truncation / field.voxelSize
                              : std::numeric_limits<double>::infinity();
}

}  // namespace

Seams measureSeams(const DistanceField& example, const DistanceField& result,
                   const Origins* origins, int exampleIndex, const Progress& progress) {
  requireSameVoxels(example, result);
  const double truncation = std::min(truncationVoxels(example), truncationVoxels(result));
  const InVoxels e(example, truncation), r(result, truncation);
  const double band = std::min(kBand, truncation - 1);

  Seams seams;
  seams.eikonalResidual = eikonalResidual(r, band, progress.part(0, 0.2));
  seams.exampleEikonalResidual = eikonalResidual(e, band, progress.part(0.2, 0.3));
  if (!origins) return seams;

  requireOriginsFit(*origins, example, result, exampleIndex);
  const Means own = secondDifferences(e, progress.part(0.3, 0.4));
  const Means jumps = meanJumps(e, r, *origins, exampleIndex, progress.part(0.4, 1));
  seams.seamShare = jumps.faces == 0
                        ? 0
                        : static_cast<double>(jumps.all.count) / static_cast<double>(jumps.faces);
  seams.jump = jumps.all.value();
  seams.jumpRatio = ratio(jumps.all.value(), own.all.value());
  seams.nearJump = jumps.near.value();
  seams.nearJumpRatio = ratio(jumps.near.value(), own.near.value());
  return seams;
}

Array3D<float> seamJumps(const DistanceField& example, const DistanceField& result,
                         const Origins& origins, int exampleIndex, const Progress& progress) {
  requireSameVoxels(example, result);
  requireOriginsFit(origins, example, result, exampleIndex);
  const double truncation = std::min(truncationVoxels(example), truncationVoxels(result));
  const InVoxels e(example, truncation), r(result, truncation);
  Array3D<float> jumps(result.size());
  const Vec3i n = result.size();
  LoopProgress layers(progress, "measuring seams", static_cast<std::size_t>(n.z));
  parallelFor(0, n.z, kLayers, [&](std::size_t begin, std::size_t end) {
    for (int k = static_cast<int>(begin); k < static_cast<int>(end); ++k) {
      forEachCell(CellBox{{0, 0, k}, {n.x, n.y, k + 1}}, [&](const Vec3i& a) {
        double most = 0;
        for (int axis = 0; axis < 3; ++axis) {
          const Vec3i step = unit(axis);
          if (r.contains(a + step))
            most = std::max(most, jumpAt(e, r, origins, exampleIndex, a, step).value_or(0));
          if (r.contains(a - step))
            most = std::max(most, jumpAt(e, r, origins, exampleIndex, a - step, step).value_or(0));
        }
        jumps[a] = static_cast<float>(most);
      });
      layers.advance();
    }
  });
  return jumps;
}

}  // namespace exemplar
