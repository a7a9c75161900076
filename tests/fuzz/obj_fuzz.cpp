// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "fuzz_reader.h"
#include "mesh/across_formats.h"
#include "mesh/mesh_formats.h"

namespace {
void read(std::string_view bytes) {
  // The file serves as its own material library, and as a picture where it begins like one.
  exemplar::Warnings warnings;
  const exemplar::MeshSource source{
      .name = "f.obj",
      .sibling = [&](const std::string&) { return std::string(bytes); },
      .warnings = &warnings};
  const exemplar::TriangleMesh mesh = exemplar::parseObj(bytes, source);
  exemplar::validate(mesh, "f.obj");
  // Whatever was read can be written, with its materials as they came and as the other kind's.
  exemplar::formatGlb(mesh, true);
  exemplar::formatObj(mesh, "f", true);
  exemplar::lostIn(".glb", mesh);
  exemplar::lostIn(".obj", mesh);
}
}  // namespace

EXEMPLAR_FUZZ_READER(read)
