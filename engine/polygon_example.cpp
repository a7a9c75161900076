// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Examples as solids between planes.

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "engine/example_forms.h"
#include "engine/words.h"
#include "synth/continuous/snap.h"
#include "synth/continuous/synthesize.h"

namespace exemplar {
namespace {

using continuous::Solids;

/// A mesh, snapped: its materials are the looks of its solids.
void takeMesh(Example& example, const Progress& progress) {
  MeshFileOptions file = example.reading.mesh;
  file.warnings = &example.warnings;
  TriangleMesh mesh = readTriangles(example.source, file, progress.part(0, 0.3));
  Warnings warnings;
  const continuous::SnapOptions options{.unit = example.reading.unit,
                                        .tolerance = example.reading.snap,
                                        .ground = example.reading.ground,
                                        .warnings = &warnings};
  continuous::SnapReport report;
  continuous::SolidScene scene;
  try {
    scene.solids = continuous::snapMesh(mesh, options, &report, progress.part(0.3, 0.7));
  } catch (const InputError& error) {
    throw InputError(example.name() + ": " + error.what());
  }
  for (const std::string& warning : warnings)
    example.warnings.push_back(example.name() + ": " + warning);
  scene.name = example.name();
  for (const std::string& name : scene.solids.substances) {
    Material look;
    for (const Material& material : mesh.materials)
      if (material.name == name) look = material;
    look.name = name;
    look.baseColorTexture.reset();
    if (name == "ground" && example.reading.ground) look.baseColor = {0.25f, 0.32f, 0.16f, 1};
    scene.looks.push_back(std::move(look));
  }
  example.description = "mesh of " + counted(static_cast<std::size_t>(report.shells), "solid") +
                        ", moved by at most " + numberText(report.moved) + " to a grid of " +
                        numberText(scene.solids.unit);
  example.mesh = std::move(mesh);
  example.solids = std::move(scene);
}

}  // namespace

void readAsPolygons(Example& example, const Progress& progress) {
  if (example.kind == SourceKind::Mesh) {
    takeMesh(example, progress.part(0, 0.7));
  } else if (example.kind == SourceKind::Solids) {
    example.solids = readSolids(example.source);
    example.description = "scene of solids";
  } else {
    throw InputError(example.name() +
                     ": the engine continuous takes closed meshes and scenes of solids; try the "
                     "engine geometry");
  }
  const continuous::SolidScene& scene = *example.solids;
  continuous::PolygonModel model;
  try {
    model = continuous::polygonsOf(scene.solids, scene.looks, progress.part(0.7, 1));
  } catch (const InputError& error) {
    throw InputError(example.name() + ": " + error.what());
  }
  if (!example.mesh) example.mesh = continuous::triangulate(model);
  example.hints.scale = scene.scale;
  example.description +=
      ", " + withThousands(static_cast<long long>(model.polygons.size())) + " faces of " +
      counted(continuous::normalsOf(continuous::planesOf(scene.solids)).size(), "direction");
  example.data = std::move(model);
}

}  // namespace exemplar
