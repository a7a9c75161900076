// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/mesh_result.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "core/error.h"
#include "sdf/mesh_to_sdf.h"

namespace exemplar {
namespace {

constexpr double kSlack = 1e-2;           // voxels: files and contouring round positions
constexpr double kMostHalfWidth = 16;     // voxels
constexpr double kLongest = 2147483000.;  // samples, far above what fits in memory

/// The number of empty layers of samples after the last solid one, along each axis.
Vec3i airBeyond(const DistanceField& field) {
  Vec3i last{-1, -1, -1};
  for (std::size_t s = 0; s < field.values.count(); ++s)
    if (field.values.values()[s] < 0) last = max(last, field.values.ijk(s));
  return field.size() - last - Vec3i{1, 1, 1};
}

/// The box of the mesh in voxels, 0 being the low corner of the example's box.
Box3d inVoxels(const Box3d& box, const DistanceField& example) {
  const Vec3d low = example.box().min;
  return {(box.min - low) / example.voxelSize, (box.max - low) / example.voxelSize};
}

bool beginsWithin(const Box3d& content, const Vec3i& size) {
  for (int axis = 0; axis < 3; ++axis)
    if (content.min[axis] < -kSlack || content.min[axis] > size[axis]) return false;
  return true;
}

Vec3d guessedSize(const Box3d& content, const DistanceField& example) {
  const Vec3i air = airBeyond(example);
  Vec3d size = cast<double>(example.size());
  for (int axis = 0; axis < 3; ++axis) {
    const double end = content.max[axis];
    if (end <= size[axis] + kSlack) continue;
    const double solid = std::ceil(end - 0.5);  // layers up to the last one with a sample in it
    size[axis] = std::max(solid + air[axis], std::ceil(end - kSlack));
  }
  return size;
}

[[noreturn]] void failBeyond(const Box3d& content, const Vec3i& size) {
  std::ostringstream message;
  message << "the mesh lies at " << content.min.x << ", " << content.min.y << ", " << content.min.z
          << " to " << content.max.x << ", " << content.max.y << ", " << content.max.z
          << " voxels, beyond the box of " << size.x << " x " << size.y << " x " << size.z
          << " samples; give the size that the result was made with";
  throw InputError(message.str());
}

}  // namespace

DistanceField sampleMeshResult(const TriangleMesh& result, const DistanceField& example,
                               const MeshResultOptions& options, const Progress& progress) {
  if (example.values.empty())
    throw InputError("the example has no samples; give a field with at least one");
  const Box3d bounds = boundingBox(result);
  if (bounds.empty())
    throw InputError(
        "the result has no triangles, so nothing can be measured; give a mesh with at least one");
  const Box3d content = inVoxels(bounds, example);
  Vec3d first{}, size{};  // voxels
  if (options.size) {
    size = cast<double>(*options.size);
    for (int axis = 0; axis < 3; ++axis) {
      if (size[axis] < 1)
        throw InputError("the result's size is " + std::to_string((*options.size)[axis]) +
                         " samples along an axis; it must be 1 or more");
      if (content.min[axis] < -kSlack || content.max[axis] > size[axis] + kSlack)
        failBeyond(content, *options.size);
    }
  } else if (beginsWithin(content, example.size())) {
    size = guessedSize(content, example);
  } else {
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = std::floor(content.min[axis] + kSlack);
      size[axis] = std::max(1.0, std::ceil(content.max[axis] - kSlack) - first[axis]);
    }
  }
  if (std::max({size.x, size.y, size.z}) > kLongest)
    throw InputError(
        "the mesh is longer than 2,147,483,000 of the example's voxels; is it in the "
        "example's units?");
  const double h = example.voxelSize;
  const Vec3d low = example.box().min + first * h;
  return meshToSdf(result,
                   {.voxelSize = h,
                    .box = Box3d{low, low + size * h},
                    .halfWidth = std::clamp(example.truncation / h, 2.0, kMostHalfWidth),
                    .cutByBox = Axes::every()},
                   progress);
}

}  // namespace exemplar
