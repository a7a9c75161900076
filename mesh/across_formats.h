// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace exemplar {

/// A map of a glTF material that a `.mtl` has a key for.
struct CarriedMap {
  const char* key;              ///< "norm" or "map_Ke"
  std::size_t picture;          ///< of `Material::pictures`
  std::optional<Vec3f> factor;  ///< what multiplies it, where that goes to a line of its own
};
/// The maps of a material that came from glTF and that go to a `.mtl`: PNG and JPEG ones, looked up
/// as they are.
std::vector<CarriedMap> gltfMapsOfMtl(const Material& material);

/// What a mesh has and a file with this ending (".obj") cannot hold, in the words of the file that
/// it came from ("normalTexture", "doubleSided", "map_Bump", "texture coordinates"); each once, of
/// materials that triangles use.
std::vector<std::string> lostIn(const std::string& ending, const TriangleMesh& mesh);

}  // namespace exemplar
