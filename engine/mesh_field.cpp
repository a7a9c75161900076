// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/mesh_field.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "engine/words.h"
#include "mesh/footprint.h"
#include "sdf/box_ends.h"
#include "sdf/box_openings.h"
#include "sdf/detail_size.h"

namespace exemplar {
namespace {

constexpr int kDefaultResolution = 64;
constexpr int kDefaultPadding = 4;
/// A mesh thinner than this part of its length, seen from above, is a panel: it is not doubled
/// across its thickness.
constexpr double kPanelThinness = 1.0 / 3;
/// A mesh at least this many times as long as wide is laid along the axis that becomes longer.
constexpr double kLong = 1.5;

/// The solid that a mesh shows: closed in its box's faces, whose vertices are exactly there.
TriangleMesh solidOf(const TriangleMesh& mesh, const Axes& cut, const Progress& progress) {
  progress.check();
  TriangleMesh solid;
  solid.positions = mesh.positions;
  solid.triangles = mesh.triangles;
  const Box3d box = boundingBox(mesh);
  const Vec3d size = box.size();
  const double near = kInBoxFace * std::max({size.x, size.y, size.z});
  for (Vec3d& p : solid.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!cut[axis]) continue;
      if (p[axis] - box.min[axis] <= near) p[axis] = box.min[axis];
      if (box.max[axis] - p[axis] <= near) p[axis] = box.max[axis];
    }
  }
  progress.check();
  append(solid, boxOpenings(solid));
  progress.check();
  return solid;
}

/// Whether `x` or `y` becomes longer than the other; 2 where neither does.
int longerAxis(const Extent& wanted) {
  if (wanted.scale) {
    const Vec3d& scale = *wanted.scale;
    if (scale.x > 1 && scale.x > scale.y) return 0;
    if (scale.y > 1 && scale.y > scale.x) return 1;
  } else if (wanted.size) {
    const Vec3d size = cast<double>(*wanted.size);
    if (size.x > kLong * size.y) return 0;
    if (size.y > kLong * size.x) return 1;
  }
  return 2;
}

std::string degrees(double angle) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f degrees", std::abs(angle) * 180 / std::numbers::pi);
  return text;
}

/// Turns a mesh straight that lies turned against its box, and says so.
void straighten(TriangleMesh& mesh, Example& example, const Progress& progress) {
  if (!example.reading.wanted || example.reading.align == Align::None) return;
  const Footprint footprint = footprintOf(mesh, progress);
  if (footprint.straight) return;
  const int longer = longerAxis(*example.reading.wanted);
  const bool isLong = std::max(footprint.along, footprint.across) >
                      kLong * std::min(footprint.along, footprint.across);
  int side = footprint.along >= footprint.across ? 0 : 1;  // where the long side comes to lie
  double angle = -footprint.angle;
  const bool between = std::abs(footprint.angle) > 44 * std::numbers::pi / 180;
  if (isLong && side != (longer == 2 && between ? 0 : longer) && (longer < 2 || between)) {
    angle += (angle < 0 ? 1 : -1) * std::numbers::pi / 2;
    side = 1 - side;
  }
  const Vec3d about = boundingBox(mesh).center();
  turn(mesh, Turn(angle, about));
  example.turn = Turn(-angle, about);
  example.warnings.push_back(
      example.name() + ": lies turned by " + degrees(angle) +
      " against its box; it is turned straight" +
      (isLong ? std::string(", its long side along ") + (side == 0 ? "x" : "y") : std::string()) +
      ", and the result turned back (`align` none leaves it)");
}

/// So large a voxel that the field, its air included, has `resolution` samples along its longest
/// side.
double voxelFor(const Vec3d& side, const Padding& padding, int resolution) {
  double voxel = 0;
  for (int axis = 0; axis < 3; ++axis)
    voxel = std::max(voxel, side[axis] / std::max(1, resolution - 2 * padding[axis]));
  return voxel;
}

/// What holds detail: this many voxels through what is thinnest, but for what rounding takes.
constexpr double kVoxelsOfDetail = 2 * 0.999;
/// How many samples an example and its result may have together where the resolution follows from
/// the detail: about 1.5 GB.
constexpr double kMostSamples = 16e6;
constexpr int kMostResolution = 4096;

/// The samples along the longest side, with air, at which a voxel is no larger than `voxel`.
double resolutionFor(const Vec3d& side, const Padding& padding, double voxel) {
  double most = 0;
  for (int axis = 0; axis < 3; ++axis)
    most = std::max(most, std::ceil(side[axis] / voxel - 1e-6) + 2.0 * padding[axis]);
  return most;
}

/// The most samples along the longest side with which an example and its result stay affordable.
int affordableResolution(const Example& example, const Vec3d& side, const Padding& padding) {
  const Extent wanted = example.reading.wanted.value_or(Extent{});
  const auto samples = [&](int resolution) {
    const double voxel = voxelFor(side, padding, resolution);
    double count = 1, larger = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double n = std::ceil(side[axis] / voxel - 1e-6) + 2.0 * padding[axis];
      count *= n;
      larger *=
          wanted.size ? (*wanted.size)[axis] : n * wanted.scale.value_or(example.hints.scale)[axis];
    }
    return count + (example.reading.wanted ? larger : 0);
  };
  int low = kDefaultResolution, high = kMostResolution;
  while (low < high) {
    const int middle = (low + high + 1) / 2;
    if (samples(middle) <= kMostSamples) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  return low;
}

/// "parts of 0.06", "gaps of 0.04": whichever is finer.
std::string readableDetail(const DetailSize& detail) {
  char text[64];
  const bool gap = detail.gap < detail.thickness;
  std::snprintf(text, sizeof text, "%s of %.3g", gap ? "gaps" : "parts",
                std::min(detail.gap, detail.thickness));
  return text;
}

double finest(const DetailSize& detail) { return std::min(detail.gap, detail.thickness); }

/// As many samples as the detail needs, and no fewer than usual.
int resolutionForDetail(const Example& example, const DetailSize& detail, const Vec3d& side,
                        const Padding& padding) {
  const double needed = resolutionFor(side, padding, finest(detail) / kVoxelsOfDetail);
  return static_cast<int>(std::clamp(needed, double{kDefaultResolution},
                                     1.0 * affordableResolution(example, side, padding)));
}

/// Warns of detail that the samples do not hold.
void sayDetail(const DetailSize& detail, const Vec3d& side, const Padding& padding, double voxel,
               int resolution, Example& example) {
  const double voxels = finest(detail) / voxel;
  if (!(voxels < kVoxelsOfDetail * (1 - 1e-6))) return;
  const double needed = resolutionFor(side, padding, finest(detail) / kVoxelsOfDetail);
  char wide[32];
  std::snprintf(wide, sizeof wide, "%.2g", voxels);
  const std::string would =
      needed <= kMostResolution ? "`resolution` " + numberText(needed) : "no `resolution`";
  std::string text = example.name() + ": " + readableDetail(detail) + " are " + wide +
                     " samples wide and come out in pieces or not at all; " + would +
                     " would hold them";
  if (example.reading.holdDetail) {
    text += ", auto takes " + std::to_string(resolution) +
            ", the most that an example and its result may need of memory";
  } else if (needed <= kMostResolution) {
    text += " (or auto)";
  }
  example.warnings.push_back(text);
}

/// Along which axes a result becomes longer than the example with its air.
Axes growing(const Example& example, const Vec3d& side, double voxel, const Padding& padding) {
  Axes axes;
  if (!example.reading.wanted) return axes;
  const Extent& wanted = *example.reading.wanted;
  for (int axis = 0; axis < 3; ++axis)
    axes[axis] = wanted.size ? (*wanted.size)[axis] >
                                   std::ceil(side[axis] / voxel - 1e-6) + 2.0 * padding[axis]
                             : wanted.scale.value_or(example.hints.scale)[axis] > 1;
  return axes;
}

struct Sampling {
  double voxelSize;
  Padding padding;
  Axes cut;
  int resolution;
};

DistanceField sample(const TriangleMesh& solid, const Sampling& how, const Progress& progress) {
  return meshToSdf(solid,
                   {.voxelSize = how.voxelSize,
                    .padding = how.padding,
                    .halfWidth = kExampleHalfWidth,
                    .cutByBox = how.cut},
                   progress);
}

}  // namespace

void sampleMesh(TriangleMesh mesh, Example& example, const Progress& progress) {
  const ReadOptions& options = example.reading;
  progress.check();
  straighten(mesh, example, progress);
  const Vec3d side = boundingBox(mesh).size();
  if (side.x < kPanelThinness * side.y) example.hints.scale.x = 1;
  if (side.y < kPanelThinness * side.x) example.hints.scale.y = 1;

  const bool looks = options.wanted || options.holdDetail;
  const DetailSize detail =
      looks ? detailSize(solidOf(mesh, {}, progress), progress.part(0, 0.2)) : DetailSize{};
  const Progress rest = progress.part(looks ? 0.2 : 0, 1);
  const auto sampling = [&](const Axes& cut) {
    Sampling how;
    how.padding = options.padding.value_or(kDefaultPadding);
    for (int axis = 0; axis < 3; ++axis)
      if (cut[axis]) how.padding[axis] = 0;
    how.resolution = options.holdDetail ? resolutionForDetail(example, detail, side, how.padding)
                                        : options.resolution.value_or(kDefaultResolution);
    how.voxelSize = voxelFor(side, how.padding, how.resolution);
    how.cut = cut;
    return how;
  };
  Sampling how = sampling({});
  Axes cut = options.scatter ? Axes{} : growing(example, side, how.voxelSize, how.padding);
  for (int axis = 0; axis < 3; ++axis)
    cut[axis] = cut[axis] && (!options.padding || (*options.padding)[axis] == 0);
  // Most that can go on do, so that is tried first.
  how = sampling(cut);
  DistanceField field = sample(solidOf(mesh, cut, rest), how, rest.part(0, cut.any() ? 0.5 : 1));
  Axes goesOn = cut;
  for (int axis = 0; axis < 3; ++axis) goesOn[axis] = cut[axis] && looksCut(field, axis);
  if (goesOn != cut) {
    how = sampling(goesOn);
    field = sample(solidOf(mesh, goesOn, rest), how, rest.part(0.5, 1));
  }
  example.goesOn = goesOn;
  example.padding = how.padding;
  example.data = std::move(field);
  if (looks) sayDetail(detail, side, how.padding, how.voxelSize, how.resolution, example);
  example.description =
      "mesh of " + withThousands(static_cast<long long>(mesh.triangles.size())) + " triangles" +
      (goesOn.any() ? ", going on along " + readableAxes(goesOn) + "," : std::string());
  example.mesh = std::move(mesh);
}

DistanceField sampledMesh(const Example& example, double voxelSize, const Box3d& box,
                          const Padding& padding, const Progress& progress) {
  const bool object = example.kind == SourceKind::Mesh;
  return meshToSdf(object ? solidOf(*example.mesh, example.goesOn, progress) : *example.mesh,
                   {.voxelSize = voxelSize,
                    .box = box,
                    .padding = padding,
                    .halfWidth = kExampleHalfWidth,
                    .cutByBox = example.goesOn},
                   progress);
}

}  // namespace exemplar
