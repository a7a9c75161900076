// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/field_control.h"

#include <algorithm>
#include <cmath>

#include "core/cells.h"
#include "core/error.h"
#include "engine/words.h"
#include "maps/map.h"
#include "sdf/mesh_to_sdf.h"
#include "sdf/resample.h"

namespace exemplar {
namespace {

/// A mesh is sampled with this many voxels of air around it, to ask what is inside it.
constexpr int kRegionPadding = 2;

bool isPicture(const Source& source) {
  const SourceKind kind = sourceKind(source);
  return kind == SourceKind::Picture ||
         (kind == SourceKind::HeightMap && !source.inMemory<HeightMap>());
}

/// A solid to ask for what is inside: a mesh's, or a volume's, and from there to where it lies.
struct Region {
  DistanceField field;
  Turn turn;
};
Region readRegion(const Source& source, double voxelSize, const ReadOptions& reading,
                  const Progress& progress) {
  Region region;
  requireKeep(source);
  switch (sourceKind(source)) {
    case SourceKind::Mesh:
      region.field = meshToSdf(readTriangles(source, reading.mesh),
                               {.voxelSize = voxelSize, .padding = kRegionPadding}, progress);
      return region;
    default:
      region.field =
          readDistances(source, {.turn = &region.turn, .yUp = reading.mesh.up == UpAxis::Y});
      return region;
  }
}

/// A gray picture, seen from above, over a box of this size: its first row is the farthest in y.
Array3D<float> grays(const Source& source, const Vec3i& size) {
  const MapLayer layer = source.inMemory<std::string>()
                             ? decodeMapLayer(*source.inMemory<std::string>(), source.name(), "mix")
                             : readMapLayer(source.path(), "mix");
  const auto width = layer.planes.front().width(), height = layer.planes.front().height();
  Array3D<float> map(size);
  parallelForEachCell(size, [&](const Vec3i& p) {
    const auto along = [](int i, int n, int pixels) {
      return std::min(pixels - 1, static_cast<int>((i + 0.5) * pixels / n));
    };
    const int column = along(p.x, size.x, width), row = height - 1 - along(p.y, size.y, height);
    float gray = 0;
    for (const Grid<float>& plane : layer.planes) gray += plane(column, row);
    map[p] = std::clamp(gray / static_cast<float>(layer.planes.size()), 0.0f, 1.0f);
  });
  return map;
}

}  // namespace

void requireKeep(const Source& source) {
  requireThere(source);
  const SourceKind kind = sourceKind(source);
  if (kind != SourceKind::Mesh && kind != SourceKind::Volume)
    throw InputError("`keep`: " + source.name() + " is neither a mesh nor a .vdb");
}

void requireGuide(const Source& source) {
  requireThere(source);
  const SourceKind kind = sourceKind(source);
  if (kind == SourceKind::Labels || kind == SourceKind::Picture)
    throw InputError("`guide`: " + source.name() + " is neither a mesh, a volume nor a height map");
}

void requireMixMap(const Source& source) {
  requireThere(source);
  const SourceKind kind = sourceKind(source);
  if (kind != SourceKind::Volume && !isPicture(source))
    throw InputError("`mix-map`: " + source.name() + " is neither a picture nor a .vdb");
}

Array3D<std::uint8_t> keptSamples(const Source& source, const Example& in,
                                  const ReadOptions& reading, const Progress& progress) {
  const DistanceField& example = in.field();
  const Region region = readRegion(source, example.voxelSize, reading, progress);
  const Box3d box = region.field.box();
  const Turn back = region.turn.back();
  Array3D<std::uint8_t> kept(example.size());
  bool any = false;
  forEachCell(kept.size(), [&](const Vec3i& p) {
    const Vec3d xyz = back(in.turn(example.position(cast<double>(p))));
    if (!box.contains(xyz)) return;
    kept[p] = sampleTrilinear(region.field, xyz) < 0;
    any = any || kept[p];
  });
  if (!any) {
    throw InputError("`keep`: no sample of the example is inside " + source.name() +
                     "; it must be a solid in the example's own coordinates");
  }
  return kept;
}

Array3D<float> guideDistances(const Source& source, const Vec3i& size, const ReadOptions& reading,
                              const Progress& progress) {
  ReadOptions options = reading;
  options.form = Form::Field;
  options.holdDetail = options.scatter = false;
  options.wanted.reset();
  options.padding = 0;
  const Example guideExample = readExample(source, options, progress);
  const DistanceField& field = guideExample.field();
  double stretch = 0;
  Vec3d scale;
  for (int axis = 0; axis < 3; ++axis) {
    scale[axis] = static_cast<double>(field.size()[axis]) / size[axis];
    stretch += 1 / scale[axis] / 3;
  }
  Array3D<float> guide(size);
  parallelForEachCell(size, [&](const Vec3i& cell) {
    const Vec3d p = cast<double>(cell);
    Vec3d index;
    for (int axis = 0; axis < 3; ++axis) index[axis] = (p[axis] + 0.5) * scale[axis] - 0.5;
    guide[cell] = static_cast<float>(sampleTrilinear(field, field.position(index)) /
                                     field.voxelSize * stretch);
  });
  return guide;
}

Array3D<float> mixMap(const Source& source, const Vec3i& size, const ReadOptions& reading,
                      const Progress& progress) {
  requireMixMap(source);
  if (isPicture(source)) return grays(source, size);
  Array3D<float> map = guideDistances(source, size, reading, progress);
  for (float& v : map.values()) v = v < 0 ? 1.0f : 0.0f;
  return map;
}

std::vector<double> mixShares(const std::string& text, std::size_t examples) {
  if (text.empty()) return {};
  const std::string what = "`mix` " + text;
  if (examples < 2) throw InputError(what + ": there is no second example to mix with the first");
  std::vector<double> shares{1};
  for (const std::string& word : split(text, ',')) {
    const double share = parseNumber(word, what);
    if (!(share >= 0 && share <= 1)) throw InputError(what + ": expected shares of 0 to 1");
    shares.push_back(share);
    shares.front() -= share;
  }
  if (shares.size() != examples) {
    throw InputError(what + ": expected " + std::to_string(examples - 1) +
                     (examples == 2 ? " share, the second example's"
                                    : " shares, of all examples but the first"));
  }
  if (shares.front() < -1e-9) throw InputError(what + ": the shares are more than 1 together");
  shares.front() = std::max(0.0, shares.front());
  return shares;
}

}  // namespace exemplar
