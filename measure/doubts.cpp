// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/doubts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "measure/example_nature.h"

namespace exemplar {
namespace {

constexpr double kMoved = 0.1, kFloating = 0.005, kOccupancy = 0.15, kOpen = 0.005;
constexpr double kRepeated = 0.25, kRepeatedMean = 1.5;
constexpr double kSliced = 0.02, kSlicedOfFlat = 0.15;

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, 100 * share < 9.95 ? "%.1f %%" : "%.0f %%", 100 * share);
  return text;
}

/// Of how many voxels a shift is, the shorter way around.
Vec3i shortest(const Vec3i& shift, const Vec3i& size) {
  Vec3i way = shift;
  for (int axis = 0; axis < 3; ++axis)
    if (2 * way[axis] > size[axis]) way[axis] -= size[axis];
  return way;
}

bool isMoved(const DoubtSigns& s) {
  if (s.rolled.distance >= kMoved) return false;
  bool moved = false, unfair = false;
  for (int axis = 0; axis < 3; ++axis) {
    const bool along = s.rolled.shift[axis] != 0 || s.resultSize[axis] > s.exampleSize[axis];
    moved = moved || along;
    unfair = unfair || (along && !s.rollingIsFair[axis]);
  }
  return unfair || !moved;
}

/// How many examples there is room for in the result's box.
double roomFor(const DoubtSigns& s) {
  return std::max(1.0, static_cast<double>(volume(s.resultSize)) /
                           static_cast<double>(std::max<std::int64_t>(1, volume(s.exampleSize))));
}

double piecesExpected(const DoubtSigns& s) {
  const double expected = static_cast<double>(s.wholeness.examplePieces) * roomFor(s);
  return s.wholeness.examplePieces > 1 ? 1.5 * expected + 2 : expected;
}

}  // namespace

std::string doubtName(Doubt doubt) {
  switch (doubt) {
    case Doubt::Moved:
      return "moved";
    case Doubt::Pieces:
      return "pieces";
    case Doubt::Floating:
      return "floating";
    case Doubt::Repeated:
      return "repeated";
    case Doubt::Occupancy:
      return "occupancy";
    case Doubt::Sliced:
      return "sliced";
    case Doubt::Open:
      break;
  }
  return "open";
}

DoubtSigns doubtSigns(const Occupancy& example, const Occupancy& result, const Progress& progress) {
  DoubtSigns signs;
  const ExampleNature nature = natureOf(example);
  const Integrity before = integrityOf(example, nature, progress.part(0, 0.1));
  signs.wholeness = compareWholeness(before, integrityOf(result, nature, progress.part(0.1, 0.4)));
  signs.rolled = rolledDistance(example, result, {}, progress.part(0.4, 0.9));
  signs.landmarks = countLandmarks(example, result, {}, progress.part(0.9, 1));
  signs.rollingIsFair = nature.fillsEvenly;
  signs.exampleSize = example.size();
  signs.resultSize = result.size();
  signs.exampleOccupancy = solidFraction(example);
  signs.resultOccupancy = solidFraction(result);
  return signs;
}

std::vector<Doubt> doubtsOf(const DoubtSigns& s) {
  const Wholeness& w = s.wholeness;
  std::vector<Doubt> doubts;
  // Empty and solid results are `Collapse`'s.
  if (s.exampleOccupancy <= 0 || s.resultOccupancy <= 0) return doubts;
  if (isMoved(s)) doubts.push_back(Doubt::Moved);
  if (static_cast<double>(w.pieces) > piecesExpected(s)) doubts.push_back(Doubt::Pieces);
  if (w.floatingShare > w.exampleFloatingShare + kFloating &&
      w.floatingShare > 1.5 * w.exampleFloatingShare)
    doubts.push_back(Doubt::Floating);
  // A tiling, or a material that fills its box, has its parts as often as it is large.
  const bool material = s.rollingIsFair.x && s.rollingIsFair.y;
  const bool moved = !doubts.empty() && doubts.front() == Doubt::Moved;
  if (!material && !moved && s.landmarks.repeated() > kRepeated &&
      s.landmarks.mean() > kRepeatedMean * s.landmarks.allowed)
    doubts.push_back(Doubt::Repeated);
  const double ratio = s.resultOccupancy / s.exampleOccupancy;
  if (std::abs(ratio - 1) > kOccupancy) doubts.push_back(Doubt::Occupancy);
  if (w.slicedShare > std::max(kSliced, kSlicedOfFlat * w.exampleFlatShare))
    doubts.push_back(Doubt::Sliced);
  if (w.openShare > kOpen) doubts.push_back(Doubt::Open);
  return doubts;
}

std::string doubtSentence(Doubt doubt, const DoubtSigns& s) {
  const Wholeness& w = s.wholeness;
  switch (doubt) {
    case Doubt::Moved: {
      const std::string but =
          s.rolled.distance > 0 ? " but for " + percent(s.rolled.distance) + " of the solid" : "";
      if (s.rolled.windows > 1) return "the result is the example repeated" + but;
      const Vec3i way = shortest(s.rolled.shift, s.exampleSize);
      if (way == Vec3i{}) return "the result is the example itself" + but;
      return "the result is the example moved by " + std::to_string(way.x) + ", " +
             std::to_string(way.y) + " and " + std::to_string(way.z) + " voxels" + but;
    }
    case Doubt::Pieces:
      return "the result falls into " + std::to_string(w.pieces) + " pieces, the example into " +
             std::to_string(w.examplePieces);
    case Doubt::Floating:
      return percent(w.floatingShare) + " of the result's solid has nothing under it" +
             (w.exampleFloatingShare > 0.0005
                  ? ", of the example's " + percent(w.exampleFloatingShare)
                  : "");
    case Doubt::Repeated: {
      char mean[32];
      std::snprintf(mean, sizeof mean, "%.1f", s.landmarks.mean());
      return "what the example has only once is in the result " + std::string(mean) +
             " times on the mean, and up to " + std::to_string(s.landmarks.most()) + " times";
    }
    case Doubt::Occupancy:
      return "the result is " + percent(s.resultOccupancy) + " solid, the example " +
             percent(s.exampleOccupancy);
    case Doubt::Sliced:
      return percent(w.slicedShare) + " of the result's surface is flat and faces a direction in " +
             "which the example has less of it, as if sliced";
    case Doubt::Open:
      break;
  }
  return "the box cuts " + percent(w.openShare) +
         " of the result's surface, where the example ends in air";
}

}  // namespace exemplar
