// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/mesh_to_sdf.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "sdf/narrow_band.h"
#include "sdf/triangle_tree.h"

namespace exemplar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string text(double x) {
  std::ostringstream out;
  out << x;
  return out.str();
}

// Where the samples stand.
struct Frame {
  Vec3d origin;
  double voxelSize;
  Vec3i size;

  Vec3d index(const Vec3d& xyz) const { return (xyz - origin) / voxelSize; }
};

Frame frameFor(const TriangleMesh& mesh, const MeshToSdfOptions& options) {
  if (!(options.voxelSize >= 0 && options.voxelSize < kInfinity))
    throw InputError("voxelSize is " + text(options.voxelSize) +
                     "; it must be > 0, or 0 to use the resolution");
  if (options.voxelSize == 0 && (options.resolution < 1 || options.resolution > 4096))
    throw InputError("resolution is " + std::to_string(options.resolution) +
                     "; it must be 1..4096");
  if (options.padding < 0)
    throw InputError("padding is " + std::to_string(options.padding) + "; it must be >= 0 voxels");
  if (!(options.halfWidth > 0))
    throw InputError("halfWidth is " + text(options.halfWidth) + "; it must be > 0 voxels");
  const Box3d box = options.box ? *options.box : boundingBox(mesh);
  if (box.empty() || !isFinite(box.min) || !isFinite(box.max))
    throw InputError(options.box ? "the box to sample is empty or not finite"
                                 : "the mesh has no triangles: there is nothing to sample");
  const Vec3d side = box.size();
  const double longest = std::max({side.x, side.y, side.z});
  const double h = options.voxelSize > 0 ? options.voxelSize : longest / options.resolution;
  if (!(h > 0)) throw InputError("the box to sample is a single point; give it an extent");
  Vec3d size{};
  for (int axis = 0; axis < 3; ++axis) {
    // Sides that are multiples of the voxel but for rounding are taken as such.
    size[axis] = std::max(1.0, std::ceil(side[axis] / h - 1e-6)) + 2.0 * options.padding;
  }
  requireMemory(size.x * size.y * size.z * 12,
                "a distance field of " + text(size.x) + " x " + text(size.y) + " x " +
                    text(size.z) + " samples",
                "use a lower resolution or a larger voxel size");
  const double start = h * (0.5 - options.padding);
  return {box.min + Vec3d{start, start, start}, h, cast<int>(size)};
}

// Calls body(low, high) for each block of the samples, in parallel: [low, high), at most 8 a side.
template <class Body>
void forBlocks(const Vec3i& size, const Body& body) {
  constexpr int kSide = 8;
  const Vec3i blocks{(size.x + kSide - 1) / kSide, (size.y + kSide - 1) / kSide,
                     (size.z + kSide - 1) / kSide};
  parallelFor(0, static_cast<std::size_t>(volume(blocks)), 1, [&](std::size_t b0, std::size_t b1) {
    for (std::size_t b = b0; b < b1; ++b) {
      const std::size_t nx = blocks.x, ny = blocks.y;
      const Vec3i low = Vec3i{static_cast<int>(b % nx), static_cast<int>(b / nx % ny),
                              static_cast<int>(b / (nx * ny))} *
                        kSide;
      body(low, min(low + Vec3i{kSide, kSide, kSide}, size));
    }
  });
}

// Visits the samples of a block to and fro, so that each one is next to the one before.
template <class Visit>
void serpentine(const Vec3i& low, const Vec3i& high, const Visit& visit) {
  bool backJ = false, backI = false;
  for (int k = low.z; k < high.z; ++k, backJ = !backJ)
    for (int b = low.y; b < high.y; ++b, backI = !backI) {
      const int j = backJ ? high.y - 1 - (b - low.y) : b;
      for (int a = low.x; a < high.x; ++a) visit(Vec3i{backI ? high.x - 1 - (a - low.x) : a, j, k});
    }
}

// The distance of each sample from the surface in voxels, exact up to `limit`.
void measureDistances(const TriangleTree& surface, double limit, Array3D<float>& distances) {
  forBlocks(distances.size(), [&](const Vec3i& low, const Vec3i& high) {
    const Vec3d middle = (cast<double>(low) + cast<double>(high) - Vec3d{1, 1, 1}) * 0.5;
    const double radius = length(middle - cast<double>(low));
    if (limit < kInfinity && surface.distance(middle, limit + radius) >= limit + radius) {
      for (int k = low.z; k < high.z; ++k)
        for (int j = low.y; j < high.y; ++j)
          for (int i = low.x; i < high.x; ++i) distances(i, j, k) = static_cast<float>(limit);
      return;
    }
    // A step of one voxel changes the distance by at most one: a tight bound to search within.
    double bound = kInfinity;
    serpentine(low, high, [&](const Vec3i& ijk) {
      const double d = surface.distance(cast<double>(ijk), std::min(limit, bound));
      distances[ijk] = static_cast<float>(d);
      bound = d < limit ? d + 1.0001 : kInfinity;
    });
  });
}

}  // namespace

DistanceField meshToSdf(const TriangleMesh& mesh, const MeshToSdfOptions& options,
                        const Progress& progress) {
  validate(mesh, "mesh");
  const Frame frame = frameFor(mesh, options);
  std::vector<Corners> triangles(mesh.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) triangles[t][c] = frame.index(mesh.positions[mesh.triangles[t][c]]);
  const TriangleTree tree(std::move(triangles));
  Array3D<float> values(frame.size);
  progress.report("distance", 0);
  // Signs need to see two voxels far.
  measureDistances(tree, std::max(options.halfWidth, 2.0), values);
  progress.report("sign", 0.5);
  forBlocks(frame.size, [&](const Vec3i& low, const Vec3i& high) {
    double before = -kInfinity;
    bool inside = false;
    serpentine(low, high, [&](const Vec3i& ijk) {
      float& value = values[ijk];
      // The surface crosses the step from the sample before only if both are near.
      if (before + value <= 1.5) inside = std::abs(tree.windingNumber(cast<double>(ijk))) > 0.5;
      before = value;
      const double d = std::min<double>(value, options.halfWidth) * frame.voxelSize;
      value = static_cast<float>(inside ? -d : d);
    });
  });
  progress.report("sign", 1);
  return {std::move(values), frame.voxelSize, frame.origin,
          static_cast<float>(options.halfWidth * frame.voxelSize)};
}

}  // namespace exemplar
