// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/jitter.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"

namespace exemplar::continuous {
namespace {

constexpr std::int64_t kFiner = 16;

/// Whether a plane is a side of a window, or the ground.
bool stays(const ExactPlane& plane, const ExactBox& window, const std::optional<Ground>& ground) {
  for (int axis = 0; axis < 3; ++axis) {
    Vec3l unit;
    unit[axis] = 1;
    if (plane.normal != unit) continue;
    return plane.offset == window.low[axis] || plane.offset == window.high[axis] ||
           (axis == 2 && ground && plane.offset == ground->height);
  }
  return false;
}

}  // namespace

void jitterPlanes(PolygonModel& model, const PlaneLattice& lattice, const ExactBox& window,
                  const std::optional<Ground>& ground, double amount, const Random& random) {
  if (lattice.normals.size() != 3) {
    throw InputError("`jitter`: the example has faces of " +
                     std::to_string(lattice.normals.size()) +
                     " directions, and only planes of three can be moved freely");
  }
  std::vector<std::vector<ExactPlane>> at(model.points.size());
  for (Polygon& polygon : model.polygons) {
    ExactPlane& plane = polygon.plane;
    const bool fixed = stays(plane, window, ground);
    const int family = lattice.familyOf(plane.normal);
    const auto index = static_cast<std::uint64_t>(plane.offset + (std::int64_t{1} << 40));
    plane.offset *= kFiner;
    if (!fixed && family >= 0) {
      // Less than half a step each way, so that neighbors keep their order.
      const double share = random.uniform(index, static_cast<std::uint32_t>(family)) - 0.5;
      const auto step =
          static_cast<double>(lattice.steps[static_cast<std::size_t>(family)] * kFiner);
      plane.offset += static_cast<std::int64_t>(std::trunc(share * amount * 0.9 * step));
    }
    for (const std::vector<std::uint32_t>& loop : polygon.loops)
      for (const std::uint32_t p : loop) at[p].push_back(plane);
  }
  for (std::size_t p = 0; p < at.size(); ++p) {
    makeDistinct(at[p]);
    const std::vector<ExactPlane>& planes = at[p];
    if (planes.size() < 3 || !meet(planes[0], planes[1], planes[2], model.points[p]))
      throw InputError("`jitter`: the result is too large for a grid that is 16 times as fine");
  }
  model.unit /= static_cast<double>(kFiner);
}

}  // namespace exemplar::continuous
