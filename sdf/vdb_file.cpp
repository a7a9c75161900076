// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/vdb_file.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "core/cells.h"
#include "core/error.h"
#include "core/loop_progress.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "sdf/openvdb_ready.h"
#include "sdf/redistance.h"
#include "sdf/vdb_grids.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;
using openvdb::Coord;
using openvdb::CoordBBox;

// Metadata of ours: the field's truncation, which a full field's background does not give, and 1
// for each axis along which the field is periodic; and how many times as large the file is.
constexpr const char* kTruncation = "exemplar_truncation";
constexpr const char* kWraps = "exemplar_wraps";
constexpr const char* kUnit = "exemplar_unit";
constexpr const char* kScale = "exemplar_scale";  // of origins
constexpr const char* kYUp = "exemplar_y_up";     // there where it is so

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what);
}

// Calls `use` with the grids of a file.
template <class Result>
Result withGrids(const fs::path& path,
                 const std::function<Result(const openvdb::GridPtrVec&)>& use) {
  Result result;
  withVdbGrids(path, [&](const openvdb::GridPtrVec& grids) { result = use(grids); });
  return result;
}

template <class Grid>
typename Grid::Ptr firstGrid(const openvdb::GridPtrVec& grids, const std::string& name) {
  for (const auto& grid : grids) {
    if (auto found = openvdb::gridPtrCast<Grid>(grid);
        found && (name.empty() || grid->getName() == name))
      return found;
  }
  return nullptr;
}

// The box that samples are read from: ours where the file has it, else that of the active voxels.
CoordBBox sampleBox(const openvdb::GridBase& grid, const fs::path& path) {
  const CoordBBox box = statedBox(grid, path);
  double bytes = 4;
  for (int axis = 0; axis < 3; ++axis)
    bytes *= double(box.max()[axis]) - double(box.min()[axis]) + 1;
  requireMemory(bytes * 3, path.string() + ": its active box as dense samples",
                "write the grid with a smaller active region or larger voxels");
  for (int axis = 0; axis < 3; ++axis)
    if (double(box.max()[axis]) - double(box.min()[axis]) > std::numeric_limits<int>::max() - 4.0)
      fail(path, "its active box is too long to sample densely");
  return box;
}

// How many times as large a field is written: OpenVDB refuses transforms whose determinant is below
// 3e-15.
double unitFor(double voxelSize) {
  double unit = 1;
  while (voxelSize * unit < 2e-5 && unit < 1e300) unit *= 1000;
  return unit;
}

double unitOf(const openvdb::GridBase& grid) {
  const auto stated = grid.getMetadata<openvdb::DoubleMetadata>(kUnit);
  return stated && stated->value() > 0 && std::isfinite(stated->value()) ? stated->value() : 1;
}

struct Placement {
  double voxelSize;
  Vec3d origin;  // of the box's first sample
  Turn turn;     // from there to where it is in the file
  bool lies;     // its samples have y up, too: index j is height, and k runs along -y
};

// Grids that are turned about the vertical are refused unless `turns`. `yUp`: in the file.
Placement placement(const openvdb::GridBase& grid, const CoordBBox& box, bool turns, bool yUp,
                    const fs::path& path) {
  const auto& transform = grid.transform();
  const auto stood = [&](const openvdb::Vec3d& v) {
    return yUp ? openvdb::Vec3d(v[0], 0 - v[2], v[1]) : v;
  };
  // Differences of positions far from the origin would be less exact.
  const auto step = [&](int x, int y, int z) {
    return transform.isLinear() ? stood(transform.baseMap()->applyJacobian(openvdb::Vec3d(x, y, z)))
                                : openvdb::Vec3d(0);
  };
  const openvdb::Vec3d dx = step(1, 0, 0);
  const bool lies = yUp && step(0, 1, 0)[2] > std::abs(step(0, 1, 0)[1]);
  const openvdb::Vec3d dy = lies ? -step(0, 0, 1) : step(0, 1, 0);
  const openvdb::Vec3d dz = lies ? step(0, 1, 0) : step(0, 0, 1);
  const double h = std::hypot(dx[0], dx[1]), tolerance = 1e-5 * std::abs(h);
  const bool turned = turns && !(std::abs(dx[1]) <= tolerance && dx[0] > 0);
  const double c = turned ? dx[0] : h, s = turned ? dx[1] : 0;
  const bool cubes = transform.isLinear() && h > 0 && std::isfinite(h) &&
                     (dx - openvdb::Vec3d(c, s, 0)).length() <= tolerance &&
                     (dy - openvdb::Vec3d(-s, c, 0)).length() <= tolerance &&
                     (dz - openvdb::Vec3d(0, 0, h)).length() <= tolerance;
  Coord corner = box.min();
  if (lies) corner.z() = box.max().z();
  const openvdb::Vec3d first = stood(transform.indexToWorld(corner));
  if (!cubes || !std::isfinite(first.length()))
    fail(path, "the voxels of the grid \"" + grid.getName() + "\" are no " +
                   (turns ? "upright" : "axis-aligned") +
                   " cubes; resample it to a uniform voxel size" +
                   (yUp ? "" : ", or, where its y axis is up, say so (`up` y)"));
  const double unit = unitOf(grid);
  const Vec3d origin = Vec3d{first[0], first[1], first[2]} / unit;
  return {(turned ? h : dx[0]) / unit, origin, turned ? Turn(std::atan2(s, c), origin) : Turn(),
          lies};
}

// Samples whose y axis is up with their z axis up.
Array3D<float> stoodUp(const Array3D<float>& lying) {
  const Vec3i n = lying.size();
  Array3D<float> values({n.x, n.z, n.y});
  forEachCell(values.size(), [&](const Vec3i& p) { values[p] = lying(p.x, p.z, n.z - 1 - p.y); });
  return values;
}

Vec3i sizeOf(const CoordBBox& box) {
  const Coord dim = box.dim();
  return {dim.x(), dim.y(), dim.z()};
}

// Samples of a box of a grid, x fastest.
template <class T, class Grid, class Convert>
Array3D<T> readDense(const Grid& grid, const CoordBBox& box, const Progress& progress,
                     const Convert& convert) {
  Array3D<T> values(sizeOf(box));
  const Vec3i size = values.size();
  LoopProgress layers(progress, "reading the volume", static_cast<std::size_t>(size.z));
  parallelFor(0, static_cast<std::size_t>(size.z), 1, [&](std::size_t k0, std::size_t k1) {
    const auto accessor = grid.getConstUnsafeAccessor();
    for (auto k = static_cast<int>(k0); k < static_cast<int>(k1); ++k) {
      forEachCell(CellBox{{0, 0, k}, {size.x, size.y, k + 1}}, [&](const Vec3i& p) {
        values[p] = convert(accessor.getValue(box.min().offsetBy(p.x, p.y, p.z)));
      });
      layers.advance();
    }
  });
  return values;
}

// The values as signed distances: as they are, or, for a fog volume, measured from its 0.5.
template <class Grid>
DistanceField fieldFrom(const Grid& grid, const fs::path& path, const ReadVdbOptions& options,
                        const Progress& progress) {
  const auto gridClass = grid.getGridClass();
  CoordBBox box = sampleBox(grid, path);
  // A density's active voxels may end right at its surface.
  if (gridClass != openvdb::GRID_LEVEL_SET) box.expand(1);
  const bool yUp = options.yUp || grid[kYUp];
  const Placement place = placement(grid, box, options.turn != nullptr, yUp, path);
  if (options.turn) *options.turn = place.turn;
  DistanceField field;
  field.voxelSize = place.voxelSize;
  field.origin = place.origin;
  field.values = readDense<float>(grid, box, progress.part(0, 0.5),
                                  [](auto v) { return static_cast<float>(v); });
  if (place.lies) field.values = stoodUp(field.values);
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (const float v : field.values.values()) {
    if (!std::isfinite(v))
      fail(path, "the grid \"" + grid.getName() + "\" holds NaN or infinite values");
    low = std::min(low, v);
    high = std::max(high, v);
  }
  // Files of unknown class: distances have both signs, densities are never negative.
  const bool fog =
      gridClass == openvdb::GRID_FOG_VOLUME || (gridClass != openvdb::GRID_LEVEL_SET && low >= 0);
  if (fog) {
    for (float& v : field.values.values()) v = 0.5f - v;
    return redistance(field, {}, progress.part(0.5, 1));
  }
  float background = static_cast<float>(std::abs(grid.background()));
  if (const double unit = unitOf(grid); unit != 1) {
    const auto scaled = [&](float v) { return static_cast<float>(v / unit); };
    for (float& v : field.values.values()) v = scaled(v);
    low = scaled(low);
    high = scaled(high);
    background = scaled(background);
  }
  field.truncation = std::max({background, -low, high});
  if (const auto stated = grid.template getMetadata<openvdb::FloatMetadata>(kTruncation);
      stated && stated->value() >= field.truncation) {
    field.truncation = stated->value();
  }
  return field;
}

template <class Grid>
void place(Grid& grid, const DistanceField& field, const Turn& turn, bool yUp) {
  const Vec3i size = field.size();
  const double unit = unitFor(field.voxelSize), voxel = field.voxelSize * unit;
  const auto inFile = [&](const Vec3d& v) { return yUp ? Vec3d{v.x, v.z, 0 - v.y} : v; };
  const Vec3d origin = inFile(turn(field.origin) * unit);
  auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  if (!turn.none() || yUp) {
    const Vec3d x = inFile(turn.direction({voxel, 0, 0})),
                y = inFile(turn.direction({0, voxel, 0})), z = inFile({0, 0, voxel});
    transform = openvdb::math::Transform::createLinearTransform(
        openvdb::Mat4R(x.x, x.y, x.z, 0., y.x, y.y, y.z, 0., z.x, z.y, z.z, 0., 0., 0., 0., 1.));
  }
  transform->postTranslate({origin.x, origin.y, origin.z});
  if (yUp) grid.insertMeta(kYUp, openvdb::BoolMetadata(true));
  if (unit != 1) grid.insertMeta(kUnit, openvdb::DoubleMetadata(unit));
  grid.setTransform(transform);
  stateBox(grid, size);
  grid.setCreator("exemplar");
}

Axes wrapsOf(const openvdb::GridBase& grid) {
  const auto stated = grid.getMetadata<openvdb::Vec3IMetadata>(kWraps);
  if (!stated) return {};
  const openvdb::Vec3i& v = stated->value();
  return {v[0] != 0, v[1] != 0, v[2] != 0};
}

void requireSamples(const fs::path& path, std::size_t count) {
  if (count == 0) fail(path, "cannot be written: the field has no samples");
}

std::string named(const openvdb::GridBase& grid) {
  return "\"" + grid.getName() + "\" (" + grid.valueType() + ")";
}

// The grid to read as distances: of floats or doubles.
openvdb::GridBase::Ptr chooseGrid(const fs::path& path, const openvdb::GridPtrVec& grids,
                                  const ReadVdbOptions& options) {
  openvdb::GridBase::Ptr chosen;
  int best = -1;
  for (const auto& grid : grids) {
    const bool isFloat = grid->isType<openvdb::FloatGrid>();
    if (!isFloat && !grid->isType<openvdb::DoubleGrid>()) continue;
    if (!options.grid.empty() && grid->getName() != options.grid) continue;
    const int rank = (grid->getGridClass() == openvdb::GRID_LEVEL_SET ? 4 : 0) +
                     (grid->getName() == "density" ? 2 : 0) + (isFloat ? 1 : 0);
    if (rank <= best) continue;
    best = rank;
    chosen = grid;
  }
  std::string names;
  for (const auto& grid : grids)
    if (grid != chosen) names += (names.empty() ? "" : ", ") + named(*grid);
  if (!chosen) {
    fail(path, "holds no grid of floats" +
                   (options.grid.empty() ? std::string() : " named \"" + options.grid + "\"") +
                   (names.empty() ? std::string() : "; it has " + names));
  }
  if (!names.empty() && options.grid.empty()) {
    warn(options.warnings, path.string() + ": the grid " + named(*chosen) +
                               " is read, others are left out: " + names +
                               "; `grid` chooses one by its name");
  }
  return chosen;
}

}  // namespace

void writeVdb(const fs::path& path, const DistanceField& field, const WriteVdbOptions& options,
              const Progress& progress) {
  requireSamples(path, field.values.count());
  progress.report("packing the volume", 0);
  openvdbReady();
  const auto unit = static_cast<float>(unitFor(field.voxelSize));
  float background = field.truncation;
  if (!std::isfinite(background)) {
    background = 0;
    for (const float v : field.values.values()) background = std::max(background, std::abs(v));
    background = std::max(background, static_cast<float>(field.voxelSize));
  }
  background *= unit;
  const auto grid = openvdb::FloatGrid::create(background);
  grid->setName("surface");
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  place(*grid, field, options.turn, options.yUp);
  grid->insertMeta(kTruncation, openvdb::FloatMetadata(field.truncation));
  if (const Axes& wraps = options.wraps; wraps.any()) {
    grid->insertMeta(kWraps, openvdb::Vec3IMetadata({wraps.x, wraps.y, wraps.z}));
  }
  const Vec3i size = field.size();
  Array3D<float> scaled;
  if (unit != 1) {
    scaled = field.values;
    for (float& v : scaled.values()) v *= unit;
  }
  // The view is only read, but OpenVDB has none of constant samples.
  const openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(
      CoordBBox({0, 0, 0}, {size.x - 1, size.y - 1, size.z - 1}),
      const_cast<float*>(unit != 1 ? scaled.data() : field.values.data()));
  openvdb::tools::copyFromDense(dense, *grid, 0.0f);
  progress.report("packing the volume", 0.3);
  for (auto leaf = grid->tree().beginLeaf(); leaf; ++leaf) {
    progress.check();
    for (auto v = leaf->beginValueOn(); v; ++v) {
      if (std::abs(*v) >= background && std::isfinite(field.truncation)) v.setValueOff();
    }
  }
  openvdb::tools::pruneLevelSet(grid->tree());
  writeVdbGrids(path, {grid}, progress.part(0.5, 1));
}

DistanceField readVdb(const fs::path& path, const ReadVdbOptions& options, Axes* wraps,
                      const Progress& progress) {
  progress.report("reading the volume", 0);
  DistanceField field = withGrids<DistanceField>(path, [&](const openvdb::GridPtrVec& grids) {
    const openvdb::GridBase::Ptr chosen = chooseGrid(path, grids, options);
    const auto read = [&](const auto& grid) {
      if (wraps) *wraps = wrapsOf(grid);
      return fieldFrom(grid, path, options, progress.part(0.3, 1));
    };
    if (const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(chosen)) return read(*grid);
    return read(*openvdb::gridPtrCast<openvdb::DoubleGrid>(chosen));
  });
  progress.report("reading the volume", 1);
  return field;
}

void writeOriginsVdb(const fs::path& path, const Origins& origins, const DistanceField& field,
                     const OriginsVdbOptions& options, const Progress& progress) {
  requireSamples(path, origins.count());
  openvdbReady();
  // Backgrounds that no cell has: every cell is an active voxel.
  const auto cells = openvdb::Vec3IGrid::create(openvdb::Vec3i(std::numeric_limits<int>::min()));
  const auto sources = openvdb::Int32Grid::create(-1);
  cells->setName("origin");
  sources->setName("source");
  place(*cells, field, options.turn, false);
  place(*sources, field, options.turn, false);
  if (options.scale) {
    const Vec3d& scale = *options.scale;
    cells->insertMeta(kScale, openvdb::Vec3DMetadata({scale.x, scale.y, scale.z}));
  }
  stateBox(*cells, origins.size());
  stateBox(*sources, origins.size());
  auto cell = cells->getAccessor();
  auto source = sources->getAccessor();
  const Vec3i size = origins.size();
  for (int k = 0; k < size.z; ++k) {
    progress.report("packing the origins", 0.5 * k / size.z);
    forEachCell(CellBox{{0, 0, k}, {size.x, size.y, k + 1}}, [&](const Vec3i& ijk) {
      const Origin& o = origins[ijk];
      const Coord at(ijk.x, ijk.y, ijk.z);
      cell.setValue(at, {o.i, o.j, o.k});
      source.setValue(at, o.example * 4 + o.turns);
    });
  }
  writeVdbGrids(path, {cells, sources}, progress.part(0.5, 1));
}

std::optional<Vec3d> readOriginsScale(const fs::path& path) {
  return withGrids<std::optional<Vec3d>>(
      path, [&](const openvdb::GridPtrVec& grids) -> std::optional<Vec3d> {
        const auto cells = firstGrid<openvdb::Vec3IGrid>(grids, "origin");
        if (!cells) return std::nullopt;
        const auto stated = cells->getMetadata<openvdb::Vec3DMetadata>(kScale);
        if (!stated) return std::nullopt;
        const openvdb::Vec3d& scale = stated->value();
        if (!(scale[0] > 0 && scale[1] > 0 && scale[2] > 0)) return std::nullopt;
        return Vec3d{scale[0], scale[1], scale[2]};
      });
}

Origins readOriginsVdb(const fs::path& path, const Progress& progress) {
  progress.report("reading the origins", 0);
  Origins read = withGrids<Origins>(path, [&](const openvdb::GridPtrVec& grids) {
    const auto cells = firstGrid<openvdb::Vec3IGrid>(grids, "origin");
    const auto sources = firstGrid<openvdb::Int32Grid>(grids, "source");
    if (!cells || !sources)
      fail(path, "holds no origins: the grids \"origin\" and \"source\" are missing");
    const CoordBBox box = sampleBox(*cells, path);
    if (sampleBox(*sources, path) != box)
      fail(path, "the grids \"origin\" and \"source\" differ in size");
    const auto ijk = readDense<openvdb::Vec3i>(*cells, box, progress.part(0.3, 0.7),
                                               [](const auto& v) { return v; });
    const auto from = readDense<int>(*sources, box, progress.part(0.7, 1), [](int v) { return v; });
    Origins origins(sizeOf(box));
    for (std::size_t s = 0; s < origins.count(); ++s) {
      const openvdb::Vec3i& c = ijk.values()[s];
      const int v = from.values()[s];
      const auto fits = [](int x) {
        return x >= 0 && x <= std::numeric_limits<std::int16_t>::max();
      };
      if (!fits(c[0]) || !fits(c[1]) || !fits(c[2]) || v < 0 || v >= 256 * 4)
        fail(path, "an origin is out of range; cells are 0..32767, sources 0..1023");
      origins.values()[s] = Origin({c[0], c[1], c[2]}, v / 4, v % 4);
    }
    return origins;
  });
  progress.report("reading the origins", 1);
  return read;
}

}  // namespace exemplar
