// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/pull.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/cells.h"
#include "core/error.h"
#include "sdf/dilate.h"

namespace exemplar {
namespace {

/// How many voxels a triangle counts as farther that faces the opposite way.
constexpr double kFacingCost = 1;
/// The difference of cost, in voxels, that lowers a match's weight to 1/e.
constexpr double kCostScale = 0.35;
/// Matches this many voxels worse than the best have no weight to speak of.
constexpr double kWorse = 1;
/// The samples that have one of another motion at most `reach` samples away along each axis.
Array3D<std::uint8_t> nearOtherMotions(const Origins& origins, int reach) {
  Array3D<std::uint8_t> marks(origins.size());
  parallelForEachCell(origins.size(), [&](const Vec3i& p) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i step{};
      step[axis] = 1;
      marks[p] |= origins.contains(p + step) && !continues(origins[p], origins[p + step], step);
    }
  });
  return dilated(std::move(marks), reach);
}

}  // namespace

void checkOrigins(const DistanceField& field, const Origins& origins,
                  std::span<const ExampleView> examples) {
  if (origins.size() != field.size()) {
    throw InputError("the origins are not of the field's size; use those of the same synthesis");
  }
  for (const Origin& o : origins.values()) {
    if (o.example >= examples.size()) {
      throw InputError("the origins name example " + std::to_string(o.example + 1) + " and " +
                       std::to_string(examples.size()) + (examples.size() == 1 ? " is" : " are") +
                       " given; give all examples, in the order of the synthesis");
    }
  }
}

OriginPullView::OriginPullView(const DistanceField& field, const Origins& origins,
                               std::span<const ExampleView> examples, double blend,
                               const OriginMap* map, const Progress& progress)
    : field_(field), origins_(origins), examples_(examples), map_(map), reach_(blend + 0.5) {
  if (!(blend >= 0.5 && blend <= 4)) {
    throw InputError("`blend` is " + std::to_string(blend) + "; it must be 0.5..4 voxels");
  }
  checkOrigins(field, origins, examples);
  surfaces_.reserve(examples.size());
  for (const ExampleView& example : examples) {
    surfaces_.emplace_back(example.mesh, progress);
  }
  if (map_) return;
  // A mark lies at the lower end of its step: one sample more to be seen from the upper end.
  mixed_ = nearOtherMotions(origins, static_cast<int>(std::ceil(reach_)) + 1);
}

std::optional<Match> OriginPullView::nearest(const OriginMotion& motion, const Vec3d& index,
                                             const Vec3d& normal, double radius,
                                             std::span<const std::uint32_t> groups,
                                             std::uint32_t group) const {
  const DistanceField& exampleField = examples_[motion.example].field;
  const double voxel = exampleField.voxelSize;
  const ExampleSurface& surface = surfaces_[motion.example];
  Vec3d point, facing;
  if (map_) {
    const auto place =
        map_->place(static_cast<std::uint32_t>(motion.shift.x), field_.position(index));
    if (!place) return std::nullopt;
    point = exampleField.position(place->index);
    facing = normalized(place->direction(normal));
  } else {
    point = exampleField.position(motion.toExample(index));
    facing = motion.directionToExample(normal);
  }
  const auto found =
      surface.closest(point, {.radius = radius * voxel,
                              .facing = facing,
                              .facingCost = normal == Vec3d{} ? 0 : kFacingCost * voxel,
                              .groups = groups,
                              .group = group});
  if (!found) return std::nullopt;
  Match match;
  match.motion = motion;
  match.point = *found;
  match.cost = found->distance / voxel;
  if (!(normal == Vec3d{})) {
    match.cost += kFacingCost * (1 - dot(surface.normal(found->triangle), facing)) / 2;
  }
  return match;
}

std::optional<Match> OriginPullView::matchUnder(const OriginMotion& motion, const Vec3d& position,
                                                const Vec3d& normal,
                                                std::span<const std::uint32_t> groups,
                                                std::uint32_t group, double radius) const {
  return nearest(motion, field_.index(position), normal, radius, groups, group);
}

void OriginPullView::match(const Vec3d& position, const Vec3d& normal, Matches& out,
                           double radius) const {
  if (map_) return matchMapped(position, normal, out, radius);
  const Vec3d at = field_.index(position);
  Vec3d center;
  Vec3i low, high;
  for (int a = 0; a < 3; ++a) {
    center[a] = std::clamp(at[a], 0.0, origins_.size()[a] - 1.0);
    low[a] = std::max(0, static_cast<int>(std::ceil(center[a] - reach_)));
    high[a] = std::min(origins_.size()[a] - 1, static_cast<int>(std::floor(center[a] + reach_)));
  }
  const Vec3i middle{static_cast<int>(center.x), static_cast<int>(center.y),
                     static_cast<int>(center.z)};
  if (!mixed_[middle]) {
    const auto match = nearest(motionAt(origins_, middle), at, normal, radius, {}, 0);
    out.count = 0;
    if (!match) return;
    out.match[out.count] = *match;
    out.match[out.count++].weight = 1;
    return;
  }
  // The samples' motions with the sum of their tent weights, in order of appearance.
  std::array<std::pair<OriginMotion, double>, 64> votes;
  int voteCount = 0;
  for (int k = low.z; k <= high.z; ++k) {
    const double wz = reach_ - std::abs(k - center.z);
    for (int j = low.y; j <= high.y; ++j) {
      const double wyz = wz * (reach_ - std::abs(j - center.y));
      for (int i = low.x; i <= high.x; ++i) {
        const double weight = wyz * (reach_ - std::abs(i - center.x));
        if (weight <= 0) continue;
        const OriginMotion motion = motionAt(origins_, {i, j, k});
        int n = 0;
        while (n < voteCount && !(votes[n].first == motion)) ++n;
        if (n < voteCount) {
          votes[n].second += weight;
        } else if (voteCount < static_cast<int>(votes.size())) {
          votes[voteCount++] = {motion, weight};
        }
      }
    }
  }
  std::stable_sort(votes.begin(), votes.begin() + voteCount,
                   [](const auto& a, const auto& b) { return a.second > b.second; });

  out.count = 0;
  double best = std::numeric_limits<double>::infinity();
  for (int n = 0; n < std::min(voteCount, Matches::kMost); ++n) {
    const auto match = nearest(votes[n].first, at, normal, std::min(best + kWorse, radius), {}, 0);
    if (!match) continue;
    best = std::min(best, match->cost);
    out.match[out.count] = *match;
    out.match[out.count++].weight = votes[n].second;
  }
  weigh(out, best);
}

void OriginPullView::weigh(Matches& matches, double best) {
  double sum = 0;
  for (int n = 0; n < matches.count; ++n) {
    const double worse = (matches.match[n].cost - best) / kCostScale;
    matches.match[n].weight *= std::exp(-worse * worse);
    sum += matches.match[n].weight;
  }
  for (int n = 0; n < matches.count; ++n) matches.match[n].weight /= sum;
  std::stable_sort(matches.match.begin(), matches.match.begin() + matches.count,
                   [](const Match& a, const Match& b) { return a.weight > b.weight; });
}

void OriginPullView::matchMapped(const Vec3d& position, const Vec3d& normal, Matches& out,
                                 double radius) const {
  std::vector<OriginMap::Candidate> parts;
  map_->candidates(position, parts);
  out.count = 0;
  double best = std::numeric_limits<double>::infinity();
  for (const OriginMap::Candidate& part : parts) {
    if (out.count == Matches::kMost) break;
    OriginMotion motion;
    motion.shift.x = static_cast<int>(part.part);
    const auto match =
        nearest(motion, field_.index(position), normal, std::min(best + kWorse, radius), {}, 0);
    if (!match) continue;
    best = std::min(best, match->cost);
    out.match[out.count] = *match;
    out.match[out.count++].weight = part.weight;
  }
  weigh(out, best);
}

}  // namespace exemplar
