// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/given_normals.h"

#include <string>

#include "core/error.h"
#include "core/file.h"
#include "mesh/mesh_formats.h"

namespace exemplar {

void writeMeshWithNormals(const std::filesystem::path& path, const TriangleMesh& mesh,
                          std::span<const Vec3f> normals, const MeshFileOptions& options,
                          const Progress& progress) {
  const std::string ending = lowerExtension(path);
  if (ending != ".glb" && ending != ".gltf")
    throw InputError(path.string() + ": normals are given to .glb and .gltf alone");
  if (normals.size() != mesh.positions.size())
    throw InputError(path.string() + ": " + std::to_string(normals.size()) + " normals for " +
                     std::to_string(mesh.positions.size()) + " vertices");
  validate(mesh, path.string());
  const bool yUp = options.up != UpAxis::Z;
  const Progress formatting = progress.part(0, 0.8);
  writeFile(path,
            ending == ".glb" ? formatGlb(mesh, yUp, options.normals, formatting, normals)
                             : formatGltf(mesh, yUp, options.normals, formatting, normals),
            progress.part(0.8, 1));
}

}  // namespace exemplar
