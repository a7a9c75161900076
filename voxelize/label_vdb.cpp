// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

#include "core/cells.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/text.h"
#include "core/text_scanner.h"
#include "sdf/openvdb_ready.h"
#include "sdf/vdb_grids.h"
#include "voxelize/label_file.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;
using openvdb::Coord;
using openvdb::CoordBBox;

// Metadata of ours: a line for each label, "R G B OPACITY NAME", with a line "$..." for each of its
// objects.
constexpr const char* kLooks = "exemplar_labels";
constexpr const char* kScene = "exemplar_scene";

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what);
}

std::string looksText(const LabelGrid& grid) {
  std::string text;
  char number[32];
  for (const LabelLook& look : grid.labels) {
    for (const float c : look.color) {
      // The shortest text that is the same number again.
      text.append(number, std::to_chars(number, number + sizeof number, c).ptr);
      text += ' ';
    }
    text += oneLine(look.name) + "\n";
    for (const std::string& object : look.objects) {
      text += (object.starts_with('$') ? "" : "$") + oneLine(object) + "\n";
    }
  }
  return text;
}

std::vector<LabelLook> looksFromText(const std::string& text, const std::string& name) {
  std::vector<LabelLook> looks;
  TextScanner scan(text, name + " (its metadata " + kLooks + ")");
  while (scan.nextLine()) {
    if (scan.peek() == '$' && !looks.empty()) {
      looks.back().objects.emplace_back(scan.rest());
      continue;
    }
    LabelLook& look = looks.emplace_back();
    for (float& c : look.color) {
      const double value = scan.number("a label's color");
      if (!(value >= 0 && value <= 1)) scan.fail("a label's color is not 0 to 1");
      c = static_cast<float>(value);
    }
    look.name = std::string(scan.rest());
    if (looks.size() > static_cast<std::size_t>(kMostLabels)) scan.fail("too many labels");
  }
  return looks;
}

CoordBBox boxOf(const openvdb::Int32Grid& grid, const fs::path& path) {
  const CoordBBox box = statedBox(grid, path);
  double cells = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double side = double(box.max()[axis]) - double(box.min()[axis]) + 1;
    if (side > std::numeric_limits<std::int16_t>::max()) {
      fail(path, "its box of cells is longer than 32767");
    }
    cells *= side;
  }
  requireMemory(2 * cells, path.string() + ": its box as dense cells",
                "write the grid with a smaller active region");
  return box;
}

/// Cell size and the lowest corner of the first cell; voxels are at cells' centers.
void readPlace(const openvdb::Int32Grid& grid, const CoordBBox& box, LabelGrid& result,
               const fs::path& path) {
  const auto& transform = grid.transform();
  const openvdb::Vec3d zero = transform.indexToWorld(openvdb::Vec3d(0, 0, 0));
  for (int axis = 0; axis < 3; ++axis) {
    openvdb::Vec3d along(0, 0, 0);
    along[axis] = 1;
    const openvdb::Vec3d step = transform.indexToWorld(along) - zero;
    const double size = step[axis];
    double off = 0;
    for (int other = 0; other < 3; ++other) off += other == axis ? 0 : std::abs(step[other]);
    if (!transform.isLinear() || !(size > 0) || !std::isfinite(size) || !(off <= 1e-6 * size)) {
      fail(path, "the voxels of the grid \"" + grid.getName() + "\" are no axis-aligned boxes");
    }
    result.cellSize[axis] = size;
    result.origin[axis] = zero[axis] + (box.min()[axis] - 0.5) * size;
  }
}

}  // namespace

LabelGrid readLabelsVdb(const fs::path& path, const Progress& progress) {
  openvdb::Int32Grid::Ptr grid;
  withVdbGrids(path, [&](const openvdb::GridPtrVec& grids) {
    for (const auto& candidate : grids) {
      if (!grid) grid = openvdb::gridPtrCast<openvdb::Int32Grid>(candidate);
    }
  });
  if (!grid) fail(path, "holds no labels: it has no grid of 32-bit integers");
  LabelGrid result;
  const CoordBBox box = boxOf(*grid, path);
  readPlace(*grid, box, result, path);
  if (const auto looks = grid->getMetadata<openvdb::StringMetadata>(kLooks)) {
    result.labels = looksFromText(looks->value(), path.string());
  }
  if (const auto scene = grid->getMetadata<openvdb::StringMetadata>(kScene)) {
    result.name = scene->value();
  }
  const Coord size = box.dim();
  result.cells = Array3D<Label>({size.x(), size.y(), size.z()});
  const auto accessor = grid->getConstAccessor();
  const double layers = result.size().z;
  forEachCell(result.size(), [&](const Vec3i& at) {
    if (at.x == 0 && at.y == 0) progress.report("reading labels", at.z / layers);
    const int label = accessor.getValue(box.min().offsetBy(at.x, at.y, at.z));
    if (label < 0 || label >= kMostLabels) {
      fail(path, "a label should be 0 to 65535, not " + std::to_string(label));
    }
    result.cells[at] = static_cast<Label>(label);
  });
  const auto cells = result.cells.values();
  const std::size_t needed = std::size_t{1} + *std::max_element(cells.begin(), cells.end());
  for (std::size_t label = result.labels.size(); label < needed; ++label) {
    LabelLook look;
    look.color = distinctColor(static_cast<int>(label));
    result.labels.push_back(label == 0 ? emptyLook() : look);
  }
  return result;
}

void writeLabelsVdb(const fs::path& path, const LabelGrid& grid, const Progress& progress) {
  openvdbReady();
  const auto out = openvdb::Int32Grid::create(0);
  out->setName("label");
  out->setCreator("exemplar");
  const Vec3d s = grid.cellSize, o = grid.origin + s * 0.5;
  const auto transform = openvdb::math::Transform::createLinearTransform();
  transform->postScale(openvdb::Vec3d(s.x, s.y, s.z));
  transform->postTranslate(openvdb::Vec3d(o.x, o.y, o.z));
  out->setTransform(transform);
  const Vec3i size = grid.size();
  stateBox(*out, size);
  out->insertMeta(kLooks, openvdb::StringMetadata(looksText(grid)));
  if (!grid.name.empty()) out->insertMeta(kScene, openvdb::StringMetadata(grid.name));
  auto accessor = out->getAccessor();
  forEachCell(size, [&](const Vec3i& at) {
    if (at.x == 0 && at.y == 0) progress.report("writing labels", double(at.z) / size.z);
    const Label label = grid.cells[at];
    if (label != 0) accessor.setValue(Coord(at.x, at.y, at.z), label);
  });
  writeVdbGrids(path, {out});
}

}  // namespace exemplar
