// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/warnings.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// A material of a `.mtl` file, which names its picture by a file name (empty for none).
struct MtlMaterial {
  Material material;
  std::string baseColorFile;
  /// The keys of further maps that it has ("map_Bump"), which `Material` cannot hold. A map of the
  /// emission takes the emission along, which without it would light the whole surface.
  std::vector<std::string> otherMaps = {};
};

/// Reads a Wavefront material library, with the physically based extensions (`Pr`, `Pm`) that
/// Blender and others write. `Kd`, `Ke` are linear, as Blender takes them; where there is no `Pr`,
/// the roughness follows from `Ns` as 1 - sqrt(Ns / 1000), Blender's reading of it. `map_Kd`
/// multiplies `Kd`; options before its file name are skipped. Keys may have any capitals. Colors
/// far above 1 are out of 255. A line that cannot be read is left out, and a warning names it.
std::vector<MtlMaterial> parseMtl(std::string_view bytes, const std::string& name,
                                  Warnings* warnings = nullptr);

/// Writes one so that `parseMtl` gives back the same numbers. `materials[i].material.name` must be
/// fit for a file and unique.
std::string formatMtl(const std::vector<MtlMaterial>& materials);

}  // namespace exemplar
