// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <cmath>

#include "apps/command.h"
#include "core/error.h"
#include "core/file.h"
#include "mesh/scene.h"
#include "reconstruct/field_to_mesh.h"
#include "reconstruct/transfer.h"
#include "voxelize/label_file.h"
#include "voxelize/label_mesh.h"

namespace exemplar {
namespace {

/// Origins of a field that is its own example: every sample comes from itself.
Origins identityOrigins(const Vec3i& size) {
  Origins origins(size);
  for (std::size_t n = 0; n < origins.count(); ++n) origins.values()[n] = Origin(origins.ijk(n));
  return origins;
}

}  // namespace

TriangleMesh loadForPicture(const std::filesystem::path& path, const ExampleOptions& options,
                            const Progress& progress) {
  if (isMeshFile(path)) return readMesh(path, options.mesh);
  if (isLabelFile(path)) {
    const TriangleMesh mesh = labelMesh(readLabels(path), {.closedLabels = false});
    if (mesh.triangles.empty()) throw InputError(path.string() + ": all of its cells are empty");
    return mesh;
  }
  // A scene of model pieces is shown as it is, not as what a distance field leaves of it.
  if (lowerExtension(path) == ".toml" && isPieceScene(path)) return readScene(path).mesh;
  const Example example = loadExample(path, options, progress);
  TriangleMesh mesh = fieldToMesh(example.field);
  if (example.mesh) {
    transferAppearance(mesh, example.field, identityOrigins(example.field.size()), *example.mesh,
                       example.field);
  }
  return mesh;
}

Image8 renderSideBySide(const std::vector<TriangleMesh>& meshes, const RenderOptions& options,
                        const Progress& progress) {
  // One scale for all: each is framed by a box of the largest one's size about its own centre.
  Vec3d size{};
  for (const TriangleMesh& mesh : meshes) size = max(size, boundingBox(mesh).size());
  std::vector<Image8> images;
  for (const TriangleMesh& mesh : meshes) {
    RenderOptions framed = options;
    framed.frame = frameOfSize(boundingBox(mesh), size);
    images.push_back(render(mesh, framed, progress));
    if (progress.cancelled()) return images.front();
  }
  return images.size() == 1 ? images.front() : sideBySide(images);
}

}  // namespace exemplar
