// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/height_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/loop_progress.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "sdf/sample_distances.h"

namespace exemplar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void check(const HeightMap& map) {
  if (map.width() < 2 || map.height() < 2)
    throw InputError("a height map needs at least 2 x 2 points");
  if (!(map.cellSize > 0 && map.cellSize < kInfinity))
    throw InputError("the height map's `cellSize` is " + std::to_string(map.cellSize) +
                     "; it must be > 0");
  for (const float h : map.heights.values())
    if (!std::isfinite(h)) throw InputError("the height map holds a height that is not finite");
}

void checkOptions(const HeightMapToSdfOptions& o) {
  const auto refuse = [](const std::string& what) { throw InputError(what); };
  if (!(o.voxelSize >= 0 && o.voxelSize < kInfinity))
    refuse("`voxelSize` is " + std::to_string(o.voxelSize) +
           "; it must be > 0, or 0 to use `resolution`");
  if (o.voxelSize == 0 && (o.resolution < 1 || o.resolution > 4096))
    refuse("`resolution` is " + std::to_string(o.resolution) + "; it must be 1..4096");
  if (o.air < 0 || o.ground < 0) refuse("`air` and `ground` must be >= 0 voxels");
  if (!(o.halfWidth > 0))
    refuse("`halfWidth` is " + std::to_string(o.halfWidth) + "; it must be > 0 voxels");
}

// The heights as a surface: points (c, r) from the smallest y, any integers c and r, mirrored at
// the border without repeating it. Each cell is cut along the diagonal whose ends differ less.
struct Surface {
  int columns, rows;
  double cellX, cellY;
  std::vector<float> heights;

  static int mirrored(int i, int n) {
    const int period = 2 * (n - 1);
    const int m = ((i % period) + period) % period;
    return m < n ? m : period - m;
  }
  double height(int c, int r) const {
    return heights[static_cast<std::size_t>(mirrored(r, rows)) * columns + mirrored(c, columns)];
  }
  // The two triangles of the cell from (c, r) to (c + 1, r + 1), front upwards.
  std::array<Corners, 2> cell(int c, int r) const {
    const auto point = [&](int a, int b) { return Vec3d{a * cellX, b * cellY, height(a, b)}; };
    const Vec3d p00 = point(c, r), p10 = point(c + 1, r), p01 = point(c, r + 1),
                p11 = point(c + 1, r + 1);
    if (std::abs(p00.z - p11.z) <= std::abs(p10.z - p01.z))
      return {{{p00, p10, p11}, {p00, p11, p01}}};
    return {{{p00, p10, p01}, {p10, p11, p01}}};
  }
  // The surface's height above a point.
  double heightAt(double x, double y) const {
    const double u = x / cellX, v = y / cellY;
    const int c = static_cast<int>(std::floor(u)), r = static_cast<int>(std::floor(v));
    const double s = u - c, t = v - r;
    const double h00 = height(c, r), h10 = height(c + 1, r), h01 = height(c, r + 1),
                 h11 = height(c + 1, r + 1);
    if (std::abs(h00 - h11) <= std::abs(h10 - h01))
      return s >= t ? h00 + (h10 - h00) * s + (h11 - h10) * t
                    : h00 + (h11 - h01) * s + (h01 - h00) * t;
    return s + t <= 1 ? h00 + (h10 - h00) * s + (h01 - h00) * t
                      : h11 + (h01 - h11) * (1 - s) + (h10 - h11) * (1 - t);
  }
};

// The map as a surface with at most four points a voxel along an axis: averages over as many points
// as leave two or more, at the averages' places stretched back to the map's sides.
Surface surfaceOf(const HeightMap& map, double voxelSize) {
  const int factor = map.cellSize * 4 < voxelSize
                         ? static_cast<int>(std::min(voxelSize / (map.cellSize * 2), 1e9))
                         : 1;
  const auto parts = [&](int n) { return std::max(2, n / factor); };
  Surface surface;
  surface.columns = parts(map.width());
  surface.rows = parts(map.height());
  surface.cellX = map.cellSize * (map.width() - 1) / (surface.columns - 1);
  surface.cellY = map.cellSize * (map.height() - 1) / (surface.rows - 1);
  surface.heights.resize(static_cast<std::size_t>(surface.columns) * surface.rows);
  const auto first = [](std::int64_t part, std::int64_t partCount, std::int64_t n) {
    return static_cast<int>(part * n / partCount);
  };
  for (int r = 0; r < surface.rows; ++r)
    for (int c = 0; c < surface.columns; ++c) {
      double sum = 0;
      const int c0 = first(c, surface.columns, map.width()),
                c1 = first(c + 1, surface.columns, map.width());
      const int r0 = first(r, surface.rows, map.height()),
                r1 = first(r + 1, surface.rows, map.height());
      for (int b = r0; b < r1; ++b)
        for (int a = c0; a < c1; ++a) sum += map.at(a, map.height() - 1 - b);
      surface.heights[static_cast<std::size_t>(r) * surface.columns + c] =
          static_cast<float>(sum / (static_cast<double>(c1 - c0) * (r1 - r0)));
    }
  return surface;
}

}  // namespace

DistanceField heightMapToSdf(const HeightMap& map, const HeightMapToSdfOptions& options,
                             const Progress& progress) {
  check(map);
  checkOptions(options);
  const auto [lowest, highest] = std::ranges::minmax_element(map.heights.values());
  const double relief = double{*highest} - *lowest;
  const Vec3d side{map.cellSize * (map.width() - 1), map.cellSize * (map.height() - 1), relief};
  // Along z the air and the ground take their share of the samples.
  const int spare = options.air + options.ground;
  double h = options.voxelSize;
  if (h == 0) {
    h = std::max(side.x, side.y) / options.resolution;
    if (options.resolution > spare) h = std::max(h, relief / (options.resolution - spare));
  }
  Vec3d size{};
  for (int axis = 0; axis < 3; ++axis) size[axis] = std::max(1.0, std::ceil(side[axis] / h - 1e-6));
  size.z += spare;
  requireMemory(size.x * size.y * size.z * 8,
                "a distance field of " + std::to_string(size.x) + " x " + std::to_string(size.y) +
                    " x " + std::to_string(size.z) + " samples",
                "use a lower `resolution` or a larger `voxelSize`");
  DistanceField field;
  field.values = Array3D<float>(cast<int>(size));
  field.voxelSize = h;
  field.origin = {h / 2, h / 2, *lowest - (options.ground - 0.5) * h};
  field.truncation = static_cast<float>(options.halfWidth * h);

  progress.report("reading the height map", 0);
  // No sample is farther from the surface than from the point straight above or below it, so
  // what is farther away than that to the side cannot be nearest.
  const Surface surface = surfaceOf(map, h);
  const double height = size.z * h;
  const double margin = std::min(options.halfWidth * h, height) + h;
  const int marginX = static_cast<int>(std::ceil(margin / surface.cellX));
  const int marginY = static_cast<int>(std::ceil(margin / surface.cellY));
  const int endX = static_cast<int>(std::ceil(size.x * h / surface.cellX)) + marginX;
  const int endY = static_cast<int>(std::ceil(size.y * h / surface.cellY)) + marginY;
  std::vector<Corners> triangles;
  triangles.reserve(2 * static_cast<std::size_t>(endX + marginX) * (endY + marginY));
  for (int r = -marginY; r < endY; ++r) {
    progress.check();
    for (int c = -marginX; c < endX; ++c)
      for (Corners t : surface.cell(c, r)) {
        for (Vec3d& corner : t) corner = field.index(corner);
        triangles.push_back(t);
      }
  }
  progress.report("finding the surface", 0.1);
  const TriangleTree tree(std::move(triangles), progress);
  sampleDistances(tree, options.halfWidth, {}, field.values, progress.part(0.2, 0.95));

  const Vec3i n = field.size();
  parallelFor(0, static_cast<std::size_t>(n.y), 1, [&](std::size_t j0, std::size_t j1) {
    for (auto j = static_cast<int>(j0); j < static_cast<int>(j1); ++j) {
      progress.check();
      for (int i = 0; i < n.x; ++i) {
        const Vec3d foot = field.position({double(i), double(j), 0});
        const double top = surface.heightAt(foot.x, foot.y);
        for (int k = 0; k < n.z; ++k) {
          float& v = field.values(i, j, k);
          const auto d = static_cast<float>(v * h);
          v = foot.z + k * h < top ? -d : d;
        }
      }
    }
  });
  progress.report("measuring distances", 1);
  return field;
}

HeightMap sdfToHeightMap(const DistanceField& field, const Progress& progress) {
  const Vec3i n = field.size();
  HeightMap map;
  map.heights = Grid<float>(n.x, n.y);
  map.cellSize = field.voxelSize;
  map.cellSizeKnown = true;
  const Box3d box = field.box();
  progress.report("finding heights", 0);
  LoopProgress rows(progress, "finding heights", static_cast<std::size_t>(n.y));
  const auto findRow = [&](int j) {
    for (int i = 0; i < n.x; ++i) {
      double height = box.min.z;
      int k = n.z - 1;
      while (k >= 0 && !(field.values(i, j, k) < 0)) --k;
      if (k == n.z - 1) {
        height = box.max.z;
      } else if (k >= 0) {
        const double inside = field.values(i, j, k), outside = field.values(i, j, k + 1);
        height = field.origin.z + (k + inside / (inside - outside)) * field.voxelSize;
      }
      map.heights(i, n.y - 1 - j) = static_cast<float>(height);
    }
  };
  parallelFor(0, static_cast<std::size_t>(n.y), 1, [&](std::size_t j0, std::size_t j1) {
    for (std::size_t j = j0; j < j1; ++j) {
      findRow(static_cast<int>(j));
      rows.advance();
    }
  });
  progress.report("finding heights", 1);
  return map;
}

}  // namespace exemplar
