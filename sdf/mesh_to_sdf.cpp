// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/mesh_to_sdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "sdf/flood_fill.h"
#include "sdf/opening_caps.h"
#include "sdf/ray_parity.h"
#include "sdf/sample_distances.h"
#include "sdf/solid_surface.h"
#include "sdf/triangle_soup.h"
#include "sdf/triangle_tree.h"

namespace exemplar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string text(double x) {
  std::ostringstream out;
  out << x;
  return out.str();
}

// Where the samples are.
struct Frame {
  Vec3d origin;
  double voxelSize;
  Vec3i size;
  Axes cut;   // the box cuts the mesh along these,
  Vec3d end;  // and ends there, as an index

  Vec3d index(const Vec3d& xyz) const { return (xyz - origin) / voxelSize; }
};

Frame frameFor(const TriangleMesh& mesh, const MeshToSdfOptions& options) {
  if (!(options.voxelSize >= 0 && options.voxelSize < kInfinity))
    throw InputError("`voxelSize` is " + text(options.voxelSize) +
                     "; it must be > 0, or 0 to use `resolution`");
  if (options.voxelSize == 0 && (options.resolution < 1 || options.resolution > 4096))
    throw InputError("`resolution` is " + std::to_string(options.resolution) +
                     "; it must be 1..4096");
  for (int axis = 0; axis < 3; ++axis) {
    const int padding = options.padding[axis];
    if (padding < 0)
      throw InputError("`padding` is " + std::to_string(padding) + "; it must be >= 0 voxels");
    if (options.cutByBox[axis] && padding > 0)
      throw InputError("`cutByBox` is on and `padding` is " + std::to_string(padding) +
                       "; what lies beyond a cut is unknown: `padding` must be 0");
  }
  if (!(options.halfWidth > 0))
    throw InputError("`halfWidth` is " + text(options.halfWidth) + "; it must be > 0 voxels");
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
    const double voxels = options.cutByBox[axis] ? std::floor(side[axis] / h + 1e-6)
                                                 : std::ceil(side[axis] / h - 1e-6);
    size[axis] = std::max(1.0, voxels) + 2.0 * options.padding[axis];
  }
  requireMemory(size.x * size.y * size.z * 12,
                "a distance field of " + text(size.x) + " x " + text(size.y) + " x " +
                    text(size.z) + " samples",
                "use a lower `resolution` or a larger `voxelSize`");
  const Vec3d start = Vec3d{0.5, 0.5, 0.5} - cast<double>(options.padding);
  const Vec3d origin = box.min + start * h;
  return {origin, h, cast<int>(size), options.cutByBox, (box.max - origin) / h};
}

// The samples' distances in voxels from `surface`, up to `limit`. Where nothing bounds a solid
// (sheets without thickness alone) and no limit is set, the distance is that to the far end of the
// box.
void measure(const TriangleTree& surface, double limit, Array3D<float>& distances,
             const Progress& progress) {
  if (surface.count() == 0) limit = std::min(limit, length(cast<double>(distances.size())));
  sampleDistances(surface, limit, {}, distances, progress);
}

// What is left of triangles (in voxels, samples at whole numbers) without those in the box's faces
// across some axes, or beyond and parallel to them.
std::vector<Corners> withoutCuts(std::vector<Corners> triangles, const Frame& frame) {
  constexpr double kInFace = 1e-3;  // voxels: files round positions
  const auto isCut = [&](const Corners& t) {
    const Vec3d low = min(min(t[0], t[1]), t[2]), high = max(max(t[0], t[1]), t[2]);
    for (int axis = 0; axis < 3; ++axis)
      if (frame.cut[axis] && high[axis] - low[axis] < kInFace &&
          (high[axis] < -0.5 + kInFace || low[axis] > frame.end[axis] - kInFace))
        return true;
    return false;
  };
  std::erase_if(triangles, isCut);
  return triangles;
}

// Sets `inside` from a test whose answer only changes across the surface that `distances` (exact
// up to 2 voxels) are measured from. The test is slow, so few samples of each block are tested: one
// of each set that is connected by steps that nothing crosses, the farthest from the surface.
void spreadSigns(const ParityTest& test, const Array3D<float>& distances,
                 Array3D<std::uint8_t>& inside, const Progress& progress) {
  // A surface that crosses the step from one sample to the next is as near to both together as
  // the step is long. Half a voxel on top covers what cutting crossing triangles into pieces may
  // have lost.
  constexpr float kApart = 1.5f;
  const auto spread = [&](const Vec3i& low, const Vec3i& high) {
    const Vec3i n = high - low;
    const int count = n.x * n.y * n.z;
    std::array<float, 64> distance;
    std::array<int, 64> leader;
    const auto leaderOf = [&](int s) {
      while (leader[s] != s) s = leader[s] = leader[leader[s]];
      return s;
    };
    const auto join = [&](int s, int t) {
      if (!(distance[s] + distance[t] > kApart)) return;
      s = leaderOf(s);
      t = leaderOf(t);
      if (distance[s] < distance[t]) std::swap(s, t);
      leader[t] = s;
    };
    int s = 0;
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i, ++s) {
          distance[s] = distances(low.x + i, low.y + j, low.z + k);
          leader[s] = s;
          if (i > 0) join(s - 1, s);
          if (j > 0) join(s - n.x, s);
          if (k > 0) join(s - n.x * n.y, s);
        }
    std::array<Vec3d, 64> points;
    std::array<int, 64> place;  // of a leader among the points
    std::array<std::uint8_t, 64> in;
    std::size_t asked = 0;
    for (s = 0; s < count; ++s) {
      if (leader[s] != s) continue;
      const Vec3i ijk = low + Vec3i{s % n.x, s / n.x % n.y, s / (n.x * n.y)};
      place[s] = static_cast<int>(asked);
      points[asked++] = cast<double>(ijk);
    }
    test.inside({points.data(), asked}, {in.data(), asked});
    s = 0;
    for (int k = low.z; k < high.z; ++k)
      for (int j = low.y; j < high.y; ++j)
        for (int i = low.x; i < high.x; ++i, ++s) inside(i, j, k) = in[place[leaderOf(s)]];
  };
  forBlocks(distances.size(), 4, progress, "finding signs", spread);
}

// The solid of a soup with openings, or with crossings too dense to be cut finely: its sign has to
// be asked everywhere, and where it changes off the triangles, the caps are part of the surface.
void measureOpen(const SolidTest& solid, std::vector<Corners> triangles, bool fine, double limit,
                 Array3D<float>& distances, Array3D<std::uint8_t>& inside,
                 const Progress& progress) {
  // Caps beside the box count as well, as far as they matter to most bands.
  constexpr double kBeside = 4;
  const int pad = 1 + static_cast<int>(std::ceil(std::min(limit, kBeside)));
  const Vec3i low{-pad, -pad, -pad};
  const Vec3i size = distances.size() - low * 2;
  Array3D<std::uint8_t> in(size);
  solid.mark(low, in, progress.part(0, 0.4));
  {
    Array3D<float> near(size);
    sampleDistances(TriangleTree(triangles, progress, TriangleTree::For::Distances), 2, low, near,
                    progress.part(0.4, 0.6));
    const std::vector<Corners> caps =
        openingCaps(solid, low, in, near, fine, progress.part(0.6, 0.7));
    triangles.insert(triangles.end(), caps.begin(), caps.end());
  }
  parallelForEachCell(inside.size(), [&](const Vec3i& ijk) { inside[ijk] = in[ijk - low]; });
  measure(TriangleTree(std::move(triangles), progress, TriangleTree::For::Distances), limit,
          distances, progress.part(0.7, 1));
}

}  // namespace

DistanceField meshToSdf(const TriangleMesh& mesh, const MeshToSdfOptions& options,
                        const Progress& progress) {
  validate(mesh, "mesh");
  const Frame frame = frameFor(mesh, options);
  const TriangleSoup soup = makeSoup(mesh, frame.origin, frame.voxelSize, progress.part(0, 0.1));
  SignSource source = options.sign;
  if (source == SignSource::Automatic) {
    source = soup.even && !soup.closed ? SignSource::RayParity : SignSource::WindingNumber;
  }

  Array3D<float> distances(frame.size);
  Array3D<std::uint8_t> inside(frame.size);
  const double limit = std::max(options.halfWidth, 2.0);  // signs look 2 voxels far
  progress.report("finding the surface", 0.1);
  // What is closed needs no winding numbers.
  const auto tree = std::make_shared<const TriangleTree>(
      cornersOf(soup), progress,
      soup.closed ? TriangleTree::For::Distances : TriangleTree::For::Everything);
  if (source == SignSource::WindingNumber) {
    const SolidTest solid(soup, tree, progress);
    BoundingSurface surface =
        boundingTriangles(soup, *tree, solid, frame.size, limit + 4, progress.part(0.15, 0.4));
    std::vector<Corners> bounding = std::move(surface.triangles);
    if (options.cutByBox.any()) bounding = withoutCuts(std::move(bounding), frame);
    progress.report("measuring distances", 0.4);
    if (!soup.closed || !surface.fine) {
      measureOpen(solid, std::move(bounding), surface.fine, limit, distances, inside,
                  progress.part(0.4, 1));
    } else {
      if (bounding == tree->triangles()) {
        measure(*tree, limit, distances, progress.part(0.4, 0.9));
      } else {
        measure(TriangleTree(std::move(bounding), progress, TriangleTree::For::Distances), limit,
                distances, progress.part(0.4, 0.9));
      }
      solid.mark({}, inside, progress.part(0.9, 1));
    }
  } else {
    if (source == SignSource::Flood) {
      progress.report("finding signs", 0.2);
      inside = floodedInside(tree->triangles(), frame.size, progress);
    }
    const Progress measuring = progress.part(0.4, 0.8);
    if (options.cutByBox.any()) {
      measure(TriangleTree(withoutCuts(tree->triangles(), frame), progress), limit, distances,
              measuring);
    } else {
      measure(*tree, limit, distances, measuring);
    }
    if (source == SignSource::RayParity) {
      spreadSigns(ParityTest(soup), distances, inside, progress.part(0.8, 1));
    }
  }

  const auto values = distances.values();
  const auto signs = inside.values();
  parallelFor(0, values.size(), 1 << 14, [&](std::size_t b, std::size_t e) {
    for (std::size_t s = b; s < e; ++s) {
      const double d = std::min<double>(values[s], options.halfWidth) * frame.voxelSize;
      values[s] = static_cast<float>(signs[s] ? -d : d);
    }
  });
  progress.report("measuring distances", 1);
  return {std::move(distances), frame.voxelSize, frame.origin,
          static_cast<float>(options.halfWidth * frame.voxelSize)};
}

}  // namespace exemplar
