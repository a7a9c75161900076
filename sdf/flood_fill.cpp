// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/flood_fill.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include <string>

#include "core/memory.h"
#include "core/parallel.h"

namespace exemplar {
namespace {

// How OpenVDB learns that it should stop.
struct Interrupter : openvdb::util::NullInterrupter {
  explicit Interrupter(const Progress& p) : progress(p) {}
  bool wasInterrupted(int = -1) override { return progress.cancelled(); }

  Progress progress;
};

// The mesh as OpenVDB's mesh to volume wants it.
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

}  // namespace

Array3D<std::uint8_t> floodedInside(std::span<const Corners> triangles, const Vec3i& size,
                                    const Progress& progress) {
  Array3D<std::uint8_t> inside(size);
  if (triangles.empty()) return inside;
  double area = 0;
  for (const Corners& t : triangles) area += length(cross(t[1] - t[0], t[2] - t[0])) / 2;
  constexpr double kBytesPerVoxelArea = 150;  // measured: 90 to 130
  requireMemory(area * kBytesPerVoxelArea,
                "flooding a surface of " + std::to_string(area) + " voxels",
                "use a larger voxel size or another source of signs");
  Interrupter interrupter(progress);
  const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      interrupter, Adapter{triangles}, openvdb::math::Transform(), 2.0f, 2.0f,
      openvdb::tools::DISABLE_RENORMALIZATION);
  progress.check();
  parallelFor(0, static_cast<std::size_t>(size.z), 1, [&](std::size_t k0, std::size_t k1) {
    const auto accessor = grid->getConstUnsafeAccessor();
    for (auto k = static_cast<int>(k0); k < static_cast<int>(k1); ++k)
      for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i) inside(i, j, k) = accessor.getValue({i, j, k}) < 0;
  });
  return inside;
}

}  // namespace exemplar
