// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/narrow_band.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>

#include "core/parallel.h"

namespace exemplar {
namespace {

// The mesh as OpenVDB's mesh to volume asks for it.
struct Adapter {
  std::span<const Corners> triangles;

  std::size_t polygonCount() const { return triangles.size(); }
  std::size_t pointCount() const { return triangles.size() * 3; }
  std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t n, std::size_t v, openvdb::Vec3d& p) const {
    const Vec3d& corner = triangles[n][v];
    p = {corner.x, corner.y, corner.z};
  }
};

// Calls set(index, value) for every sample of a box from (0, 0, 0) with the grid's value there.
template <class Set>
void readDense(const openvdb::FloatGrid& grid, const Vec3i& size, const Set& set) {
  parallelFor(0, static_cast<std::size_t>(size.z), 1, [&](std::size_t k0, std::size_t k1) {
    const auto accessor = grid.getConstUnsafeAccessor();
    for (auto k = static_cast<int>(k0); k < static_cast<int>(k1); ++k)
      for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i) set(Vec3i{i, j, k}, accessor.getValue({i, j, k}));
  });
}

}  // namespace

void lowerToDistance(std::span<const Corners> triangles, double halfWidth,
                     Array3D<float>& distances) {
  if (triangles.empty()) return;
  // Unsigned bands narrower than about a voxel come out with holes; more is cut off again below.
  const auto width = static_cast<float>(std::max(halfWidth, 2.0) + 0.01);
  const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      Adapter{triangles}, openvdb::math::Transform(), width, width,
      openvdb::tools::UNSIGNED_DISTANCE_FIELD);
  readDense(*grid, distances.size(), [&](const Vec3i& ijk, float d) {
    if (d < halfWidth) distances[ijk] = std::min(distances[ijk], d);
  });
}

Array3D<std::uint8_t> floodedInside(std::span<const Corners> triangles, const Vec3i& size) {
  Array3D<std::uint8_t> inside(size);
  if (triangles.empty()) return inside;
  const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      Adapter{triangles}, openvdb::math::Transform(), 2.0f, 2.0f,
      openvdb::tools::DISABLE_RENORMALIZATION);
  readDense(*grid, size, [&](const Vec3i& ijk, float d) { inside[ijk] = d < 0; });
  return inside;
}

}  // namespace exemplar
