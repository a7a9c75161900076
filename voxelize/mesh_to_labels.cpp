// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/mesh_to_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "core/cells.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "core/stoppable.h"
#include "sdf/ray_parity.h"
#include "sdf/solid_test.h"
#include "sdf/triangle_soup.h"
#include "sdf/triangle_tree.h"
#include "voxelize/cell_cut.h"
#include "voxelize/material_color.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kNoMaterial = 0xffffffff;
constexpr const char* kInsideStage = "finding what is inside";

/// The mesh in cells from the grid's corner.
TriangleMesh inCells(const TriangleMesh& mesh, const LabelGrid& grid) {
  TriangleMesh result;
  result.triangles = mesh.triangles;
  result.positions.reserve(mesh.positions.size());
  for (const Vec3d& p : mesh.positions) {
    Vec3d q = p - grid.origin;
    for (int axis = 0; axis < 3; ++axis) q[axis] /= grid.cellSize[axis];
    result.positions.push_back(q);
  }
  return result;
}

std::uint32_t materialOf(const TriangleMesh& mesh, std::size_t triangle) {
  return mesh.hasMaterials() ? mesh.triangleMaterials[triangle] : 0;
}

/// The material with most area among a cell's parts; of equal ones the first.
std::uint32_t mostSeen(const TriangleMesh& mesh, const CellCut& cut, std::size_t cell,
                       std::vector<std::pair<std::uint32_t, double>>& areas) {
  areas.clear();
  for (std::uint32_t n = cut.first[cell]; n < cut.first[cell + 1]; ++n) {
    const CutPolygon& polygon = cut.polygons[n];
    const std::uint32_t material = materialOf(mesh, polygon.triangle);
    auto found = std::find_if(areas.begin(), areas.end(),
                              [&](const auto& entry) { return entry.first == material; });
    if (found == areas.end()) found = areas.insert(areas.end(), {material, 0.0});
    found->second += length(areaNormal(cut, polygon));
  }
  std::uint32_t best = kNoMaterial;
  double most = -1;
  for (const auto& [material, area] : areas) {
    if (area > most || (area == most && material < best)) {
      best = material;
      most = area;
    }
  }
  return best;
}

void checkOptions(const MeshToLabelsOptions& options) {
  if (options.resolution < 1 || options.resolution > 4096) {
    throw InputError("`resolution` " + std::to_string(options.resolution) +
                     ": must be 1 to 4096 cells");
  }
  if (options.air < 0 || options.air > 1024) {
    throw InputError("`air` " + std::to_string(options.air) + ": must be 0 to 1024 cells");
  }
}

}  // namespace

LabelGrid gridOver(const Box3d& box, const Vec3d& cellSize, int air, double slack,
                   const Progress& progress) {
  LabelGrid grid;
  Vec3i size;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(cellSize[axis] > 0) || !std::isfinite(cellSize[axis])) {
      throw InputError("`cell` " + std::to_string(cellSize[axis]) + ": must be a positive number");
    }
    const double cells = std::max(1.0, std::ceil(box.size()[axis] / cellSize[axis] - slack)) +
                         (axis == 2 ? 1.0 : 2.0) * air;
    if (!(cells <= std::numeric_limits<std::int16_t>::max())) {
      throw InputError("the grid would be longer than 32,767 cells; use a larger `cell`");
    }
    size[axis] = static_cast<int>(cells);
    grid.origin[axis] = box.min[axis] - (axis == 2 ? 0 : air) * cellSize[axis];
  }
  if (volume(size) > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("the grid would have more than 4,294,967,295 cells; use a larger `cell`");
  }
  grid.cellSize = cellSize;
  requireMemory(16.0 * static_cast<double>(volume(size)), "the grid of cells",
                "use a larger `cell`");
  grid.cells = Array3D<Label>::of(size, filled<HugeVector<Label>>(volume(size), 0, progress));
  grid.labels.push_back(emptyLook());
  return grid;
}

Array3D<std::uint8_t> cellsInside(const TriangleMesh& mesh, const LabelGrid& grid,
                                  const Progress& progress) {
  progress.report(kInsideStage, 0);
  const Vec3i size = grid.size();
  auto inside = Array3D<std::uint8_t>::of(
      size, filled<HugeVector<std::uint8_t>>(grid.cells.count(), 0, progress));
  const TriangleSoup soup = makeSoup(inCells(mesh, grid), {0, 0, 0}, 1, progress.part(0, 0.2));
  if (soup.triangles.empty()) return inside;
  // The signs of `meshToSdf` without its distances.
  std::optional<ParityTest> parity;
  std::optional<SolidTest> solid;
  if (soup.even && !soup.closed) {
    parity.emplace(soup);
  } else {
    solid.emplace(soup, std::make_shared<const TriangleTree>(cornersOf(soup), progress), progress);
  }
  progress.report(kInsideStage, 0.3);
  // Cells of a block are near each other, which makes winding numbers quick.
  constexpr int kBlock = 8;
  const Vec3i blocks{(size.x + kBlock - 1) / kBlock, (size.y + kBlock - 1) / kBlock,
                     (size.z + kBlock - 1) / kBlock};
  const Array3D<char> order(blocks);
  parallelFor(0, order.count(), 1, [&](std::size_t begin, std::size_t end) {
    std::vector<Vec3d> points;
    std::vector<Vec3i> cells;
    std::vector<std::uint8_t> result;
    for (std::size_t b = begin; b < end; ++b) {
      progress.check();
      const Vec3i low = order.ijk(b) * kBlock;
      const Vec3i high = min(low + Vec3i{kBlock, kBlock, kBlock}, size);
      points.clear();
      cells.clear();
      forEachCell(CellBox{low, high}, [&](const Vec3i& cell) {
        cells.push_back(cell);
        points.push_back(cast<double>(cell) + Vec3d{0.5, 0.5, 0.5});
      });
      result.assign(points.size(), 0);
      if (parity) {
        parity->inside(points, result);
      } else {
        solid->inside(points, result);
      }
      for (std::size_t n = 0; n < cells.size(); ++n) inside[cells[n]] = result[n];
    }
  });
  return inside;
}

LabelGrid meshToLabels(const TriangleMesh& mesh, const MeshToLabelsOptions& options,
                       const Progress& progress) {
  validate(mesh, "the mesh");
  checkOptions(options);
  const Box3d box = options.box.value_or(boundingBox(mesh));
  Vec3d cellSize = options.cellSize;
  if (cellSize == Vec3d{}) {
    const double side = std::max({box.size().x, box.size().y, box.size().z}) / options.resolution;
    cellSize = {side, side, side};
  }
  LabelGrid grid = gridOver(box, cellSize, options.air, kCutTolerance, progress);
  auto material = filled<HugeVector<std::uint32_t>>(grid.cells.count(), kNoMaterial, progress);

  if (options.fill != VoxelFill::Solid) {
    const CellCut cut = cutAlongCells(mesh, grid.origin, grid.cellSize, grid.size(), kCutTolerance,
                                      progress.part(0, 0.35));
    progress.report("finding the materials of cells", 0.35);
    parallelFor(0, grid.cells.count(), 4096, [&](std::size_t begin, std::size_t end) {
      progress.check();
      std::vector<std::pair<std::uint32_t, double>> areas;
      for (std::size_t c = begin; c < end; ++c) material[c] = mostSeen(mesh, cut, c, areas);
    });
  }
  if (options.fill != VoxelFill::Surface) {
    const Array3D<std::uint8_t> inside = cellsInside(mesh, grid, progress.part(0.4, 0.8));
    progress.report("coloring what is inside", 0.8);
    std::vector<Corners> corners;
    for (const auto& [a, b, c] : mesh.triangles) {
      corners.push_back({mesh.positions[a], mesh.positions[b], mesh.positions[c]});
    }
    const TriangleTree tree(std::move(corners), progress);
    parallelFor(0, grid.cells.count(), 1024, [&](std::size_t begin, std::size_t end) {
      progress.check();
      for (std::size_t c = begin; c < end; ++c) {
        if (!inside.values()[c] || material[c] != kNoMaterial) continue;
        const Vec3d center =
            grid.origin +
            scaled(cast<double>(grid.cells.ijk(c)) + Vec3d{0.5, 0.5, 0.5}, grid.cellSize);
        std::uint32_t near = TriangleTree::kNone;
        tree.distance(center, std::numeric_limits<double>::infinity(), near);
        material[c] = near == TriangleTree::kNone ? 0 : materialOf(mesh, near);
      }
    });
  }

  // Labels for the materials that are there, in their order.
  const std::size_t materials = mesh.hasMaterials() ? mesh.materials.size() : 1;
  const std::vector<std::array<float, 4>> colors = materialColors(mesh);
  std::vector<Label> labelOf(materials, 0);
  std::vector<bool> used(materials, false);
  for (std::size_t c = 0; c < material.size(); ++c) {
    if (looksUp(c)) progress.check();
    if (material[c] != kNoMaterial) used[material[c]] = true;
  }
  for (std::size_t m = 0; m < materials; ++m) {
    if (!used[m]) continue;
    if (grid.labelCount() == kMostLabels) {
      throw InputError("the mesh shows more than " + std::to_string(kMostLabels - 1) +
                       " materials, one for each label there can be; use fewer");
    }
    labelOf[m] = static_cast<Label>(grid.labels.size());
    LabelLook& look = grid.labels.emplace_back();
    look.name = "solid";
    if (mesh.hasMaterials()) {
      look.name = mesh.materials[m].name;
      look.color = colors[m];
      // Glass is not air.
      look.color[3] = std::max(look.color[3], 1.0f / 255);
    }
  }
  for (std::size_t c = 0; c < material.size(); ++c) {
    if (looksUp(c)) progress.check();
    if (material[c] != kNoMaterial) grid.cells.values()[c] = labelOf[material[c]];
  }
  return grid;
}

}  // namespace exemplar
