// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/planes.h"

#include <algorithm>
#include <array>

#include "core/error.h"

namespace exemplar::continuous {
namespace {

constexpr std::array<Vec3l, 3> kAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Where an example has no two parallel planes: the common measure of its corners.
std::int64_t measureOfCorners(const Solids& solids) {
  std::int64_t measure = 0;
  std::optional<Vec3l> first;
  for (const ExactPoint& p : candidatePoints(solids)) {
    if (p.d != 1) continue;
    if (!first) first = p.n;
    measure = std::gcd(measure, gcd(p.n - *first));
  }
  return measure;
}

}  // namespace

int PlaneLattice::familyOf(const Vec3l& normal) const {
  const auto found = std::ranges::find(normals, normal);
  return found == normals.end() ? -1 : static_cast<int>(found - normals.begin());
}

PlaneLattice latticeOf(const Solids& solids, std::optional<std::int64_t> spacing) {
  const std::vector<ExactPlane> planes = planesOf(solids);
  PlaneLattice lattice;
  lattice.normals = normalsOf(planes);
  lattice.phases.resize(lattice.normals.size());
  lattice.steps.assign(lattice.normals.size(), 0);
  // Sorted by normal, then offset: the first of a normal is its lowest.
  for (std::size_t p = 0, family = 0; p < planes.size(); ++p) {
    if (p > 0 && planes[p].normal != planes[p - 1].normal) ++family;
    if (p == 0 || planes[p].normal != planes[p - 1].normal)
      lattice.phases[family] = planes[p].offset;
    lattice.steps[family] =
        std::gcd(lattice.steps[family], planes[p].offset - lattice.phases[family]);
  }
  std::int64_t usual = 0;
  for (const Vec3l& axis : kAxes)
    if (const int f = lattice.familyOf(axis); f >= 0) usual = std::gcd(usual, lattice.steps[f]);
  for (std::size_t f = 0; usual == 0 && f < lattice.steps.size(); ++f)
    if (lattice.steps[f] > 0) usual = lattice.steps[f];
  if (usual == 0) usual = measureOfCorners(solids);
  if (usual == 0) usual = 1;
  for (std::int64_t& step : lattice.steps) {
    if (step == 0) step = spacing.value_or(usual);
    if (spacing) step = std::gcd(step, *spacing);
  }
  const ExactBox box = boxOf(solids);
  for (int axis = 0; axis < 3; ++axis) {
    const int f = lattice.familyOf(kAxes[axis]);
    lattice.spacing[axis] = f >= 0 ? lattice.steps[f] : spacing.value_or(usual);
    const std::int64_t phase = f >= 0 ? lattice.phases[f] : box.low[axis];
    const std::int64_t step = lattice.spacing[axis];
    lattice.origin[axis] = phase + floorDivide(box.low[axis] - phase, step) * step;
  }
  if (solids.ground) lattice.origin.z = solids.ground->height;
  return lattice;
}

Vec3i sizeInSpacings(const PlaneLattice& lattice, const Solids& solids) {
  const ExactBox box = boxOf(solids);
  Vec3i size;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t length = box.high[axis] - lattice.origin[axis];
    size[axis] =
        static_cast<int>(std::max<std::int64_t>(1, -floorDivide(-length, lattice.spacing[axis])));
  }
  return size;
}

ExactBox windowOf(const PlaneLattice& lattice, const Vec3i& size) {
  ExactBox window;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t step = lattice.spacing[axis];
    window.low[axis] = lattice.origin[axis] - step;
    window.high[axis] = lattice.origin[axis] + (size[axis] + 1) * step;
  }
  return window;
}

PlaneSets planesIn(const PlaneLattice& lattice, const ExactBox& window) {
  return planesIn(lattice, window, window);
}

PlaneSets planesIn(const PlaneLattice& lattice, const ExactBox& window, const ExactBox& inner) {
  for (int axis = 0; axis < 3; ++axis) {
    if (window.low[axis] < -kMostCoordinate || window.high[axis] > kMostCoordinate) {
      throw InputError("the result would reach beyond " + std::to_string(kMostCoordinate) +
                       " units of the grid; use a smaller `scale` or a larger `unit`");
    }
  }
  PlaneSets sets{window, lattice.normals, {}, lattice.normals.size()};
  for (std::size_t f = 0; f < lattice.normals.size(); ++f) {
    std::int64_t low = 0, high = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t n = lattice.normals[f][axis];
      low += std::min(n * window.low[axis], n * window.high[axis]);
      high += std::max(n * window.low[axis], n * window.high[axis]);
    }
    const std::int64_t phase = lattice.phases[f], step = lattice.steps[f];
    std::vector<std::int64_t> offsets;
    for (std::int64_t c = phase - floorDivide(phase - low, step) * step; c <= high; c += step)
      offsets.push_back(c);
    sets.offsets.push_back(std::move(offsets));
  }
  for (int axis = 0; axis < 3; ++axis) {
    auto found = std::ranges::find(sets.normals, kAxes[axis]);
    if (found == sets.normals.end()) {
      sets.normals.push_back(kAxes[axis]);
      sets.offsets.emplace_back();
      found = sets.normals.end() - 1;
    }
    auto& offsets = sets.offsets[static_cast<std::size_t>(found - sets.normals.begin())];
    for (const ExactBox& box : {window, inner}) {
      offsets.push_back(box.low[axis]);
      offsets.push_back(box.high[axis]);
    }
    std::ranges::sort(offsets);
    offsets.erase(std::unique(offsets.begin(), offsets.end()), offsets.end());
  }
  if (sets.normals.size() > kMostFamilies) {
    throw InputError("the example's faces and the sides of the result have " +
                     std::to_string(sets.normals.size()) + " directions, and at most " +
                     std::to_string(kMostFamilies) + " can be handled; use fewer planes");
  }
  return sets;
}

}  // namespace exemplar::continuous
