// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/synth_control.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "apps/command.h"
#include "core/error.h"
#include "sdf/mesh_to_sdf.h"
#include "sdf/resample.h"
#include "sdf/vdb_file.h"
#include "synth/geometry/detail.h"

namespace exemplar {
namespace {

/// A mesh is sampled with this many voxels of air around it, to ask what is inside it.
constexpr int kRegionPadding = 2;

/// A solid to ask for what is inside: a mesh's, or a volume's.
DistanceField readRegion(const std::string& path, double voxelSize, const ExampleOptions& reading,
                         const Progress& progress) {
  if (isMeshFile(path)) {
    return meshToSdf(readMesh(path, reading.mesh),
                     {.voxelSize = voxelSize, .padding = kRegionPadding}, progress);
  }
  if (!path.ends_with(".vdb")) {
    throw InputError("--keep: " + path + " is neither a mesh nor a .vdb");
  }
  return readVdb(path);
}

Array3D<std::uint8_t> keptSamples(const std::string& path, const DistanceField& example,
                                  const Vec3i& size, const ExampleOptions& reading,
                                  const Progress& progress) {
  const DistanceField region = readRegion(path, example.voxelSize, reading, progress);
  const Box3d box = region.box();
  Array3D<std::uint8_t> kept(size);
  bool any = false;
  for (std::size_t s = 0; s < kept.count(); ++s) {
    const Vec3i p = kept.ijk(s);
    if (!example.values.contains(p)) continue;
    const Vec3d xyz = example.position(cast<double>(p));
    if (min(max(xyz, box.min), box.max) != xyz) continue;
    kept.values()[s] = sampleTrilinear(region, xyz) < 0;
    any = any || kept.values()[s];
  }
  if (!any) {
    throw InputError("--keep: no sample of the example lies inside " + path +
                     "; it must be a solid in the example's own coordinates");
  }
  return kept;
}

/// The guide, stretched to the result's box, in voxels of the result.
Array3D<float> guideDistances(const std::string& path, const Vec3i& size,
                              const ExampleOptions& reading, const Progress& progress) {
  ExampleOptions options = reading;
  options.padding = 0;
  const DistanceField field = loadExample(path, options, progress).field;
  double stretch = 0;
  Vec3d scale;
  for (int axis = 0; axis < 3; ++axis) {
    scale[axis] = static_cast<double>(field.size()[axis]) / size[axis];
    stretch += 1 / scale[axis] / 3;
  }
  Array3D<float> guide(size);
  for (std::size_t s = 0; s < guide.count(); ++s) {
    const Vec3d p = cast<double>(guide.ijk(s));
    Vec3d index;
    for (int axis = 0; axis < 3; ++axis) index[axis] = (p[axis] + 0.5) * scale[axis] - 0.5;
    guide.values()[s] = static_cast<float>(sampleTrilinear(field, field.position(index)) /
                                           field.voxelSize * stretch);
  }
  return guide;
}

}  // namespace

bool SynthControl::asksForOptimize() const {
  return stationary != "auto" || !periodic.empty() || !keep.empty() || !guide.empty() ||
         !with.empty() || rotations;
}

std::array<bool, 3> parseAxes(const std::string& text, const std::string& option) {
  std::array<bool, 3> axes{};
  if (text == "none") return axes;
  for (const char c : text) {
    if (c == ',' || c == ' ') continue;
    if (c < 'x' || c > 'z') {
      throw InputError(option + " " + text + ": expected axes such as xy or x,y,z, or none");
    }
    axes[c - 'x'] = true;
  }
  return axes;
}

std::string readableAxes(bool x, bool y, bool z) {
  std::string text;
  for (const auto& [on, name] : {std::pair{x, "x"}, std::pair{y, "y"}, std::pair{z, "z"}}) {
    if (on) text += std::string(text.empty() ? "" : ", ") + name;
  }
  return text.empty() ? "none" : text;
}

void addControlOptions(CLI::App& command, SynthControl& control) {
  command
      .add_option("--stationary", control.stationary,
                  "axes along which the example repeats itself, so that its parts may move along "
                  "them: xyz, xy, none, ..., or auto")
      ->capture_default_str();
  command.add_option("--periodic", control.periodic,
                     "axes along which copies of the result tile: x,y,z, xy, ...; its surface "
                     "is left open there, so that they join");
  command.add_option("--keep", control.keep,
                     "a solid (mesh or .vdb) in the example's coordinates: what is inside stays as "
                     "it is, and all else is made of it");
  command.add_option("--guide", control.guide,
                     "a volume, mesh or height map, stretched to the result's box, that says "
                     "coarsely where solid shall be");
  command.add_option("--with", control.with,
                     "another example, to mix with the first (may be repeated)");
  command.add_flag("--rotations", control.rotations,
                   "parts may be turned by quarter turns about z");
  command
      .add_option("--detail", control.detail,
                  "re-make the result at this many times the resolution, with the example's finer "
                  "detail (1)")
      ->check(CLI::Range(1, 16));
}

Examples::Examples(Example first, const SynthControl& control, const ExampleOptions& reading,
                   const Progress& progress) {
  all.push_back(std::move(first));
  const double voxel = all[0].field.voxelSize;
  for (const std::string& path : control.with) {
    Example example = loadExample(path, reading, progress);
    if (example.mesh) {
      const bool window = example.kind == ExampleKind::Scene;
      const Box3d box = window ? example.field.box() : boundingBox(*example.mesh);
      const int air = reading.padding.value_or(window                             ? 0
                                               : all[0].kind == ExampleKind::Mesh ? 4
                                                                                  : 0);
      example.field = meshToSdf(
          *example.mesh,
          {.voxelSize = voxel, .box = box, .padding = air, .halfWidth = kExampleHalfWidth},
          progress);
    } else if (std::abs(example.field.voxelSize / voxel - 1) > 1e-3) {
      throw InputError("--with: " + path + " has voxels of " +
                       std::to_string(example.field.voxelSize) + ", not of " +
                       std::to_string(voxel) + " as the first example; sample them alike");
    }
    all.push_back(std::move(example));
  }
}

std::vector<const DistanceField*> Examples::fields() const {
  std::vector<const DistanceField*> fields;
  for (const Example& example : all) fields.push_back(&example.field);
  return fields;
}

std::vector<ReconstructExample> Examples::views() const {
  std::vector<ReconstructExample> views;
  for (const Example& example : all) {
    views.push_back({example.field, example.mesh ? &*example.mesh : nullptr});
  }
  return views;
}

void Examples::refine(int factor, const ExampleOptions& reading, const Progress& progress) {
  for (Example& example : all) {
    const DistanceField coarse = example.field;
    DistanceField fine;
    if (example.mesh) {
      fine = meshToSdf(*example.mesh,
                       {.voxelSize = coarse.voxelSize / factor,
                        .box = coarse.box(),
                        .halfWidth = kExampleHalfWidth},
                       progress);
    } else if (example.kind == ExampleKind::HeightMap) {
      ExampleOptions finer = reading;
      const Vec3i n = coarse.size();
      finer.resolution = factor * std::max({n.x, n.y, n.z});
      fine = loadExample(example.path, finer, progress).field;
    } else {
      throw InputError(
          "--detail: " + example.path.string() +
          " is a volume, which has no finer samples; give the mesh that it was made of");
    }
    example.field =
        fine.size() == coarse.size() * factor ? fine : sampledFinely(fine, coarse, factor);
  }
}

OptimizeOptions optimizeOptions(const SynthControl& control, const Examples& examples,
                                const Vec3i& size, const ExampleOptions& reading,
                                const Progress& progress) {
  OptimizeOptions options;
  options.size = size;
  if (control.stationary != "auto") {
    const auto axes = parseAxes(control.stationary, "--stationary");
    options.stationary = StationaryAxes{axes[0], axes[1], axes[2]};
  }
  const auto periodic = parseAxes(control.periodic, "--periodic");
  options.periodic = {periodic[0], periodic[1], periodic[2]};
  options.rotations = control.rotations;
  if (!control.keep.empty()) {
    options.kept = keptSamples(control.keep, examples.first().field, size, reading, progress);
  }
  if (!control.guide.empty()) {
    options.guide = guideDistances(control.guide, size, reading, progress);
  }
  return options;
}

}  // namespace exemplar
