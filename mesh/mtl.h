// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/warnings.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// A map of a material, and the picture that it names.
struct MtlMap {
  std::string key;                     ///< in lower case: "map_kd"
  std::string file;                    ///< as the line has it
  UvTransform transform;               ///< from its options `-s` and `-o`
  std::optional<std::size_t> picture;  ///< where the lines are a material's source: its number
};

/// A material of a `.mtl` file.
struct MtlMaterial {
  Material material;          ///< without textures; its emission is none where a map has it
  std::string baseColorFile;  ///< the picture of `map_Kd`; empty for none
  std::vector<MtlMap> maps;   ///< all maps, the base color's among them
  Vec3f light{};              ///< `Ke`, with a map or without one
  /// What it says, a line each, as in the file but for lines that cannot be read. In place of a
  /// picture's name is '\x7f' and the number of the map.
  std::string lines;
};

/// Reads a Wavefront material library, with the physically based extensions (`Pr`, `Pm`) that
/// Blender and others write. `Kd`, `Ke` are linear, as Blender takes them; where there is no `Pr`,
/// the roughness follows from `Ns` as 1 - sqrt(Ns / 1000), Blender's reading of it. `map_Kd`
/// multiplies `Kd`; of the options before its file name, scale and offset are read. Keys may have
/// any capitals. Colors far above 1 are out of 255. A line that cannot be read is left out, and a
/// warning names it.
std::vector<MtlMaterial> parseMtl(std::string_view bytes, const std::string& name,
                                  Warnings* warnings = nullptr);

/// The same of the lines of a material's source.
MtlMaterial parseMtlSource(const MaterialSource& source);

/// The lines of a material with the numbers of pictures in place of those of maps, which are `maps`
/// in order; the line of a map whose number is empty is left out.
std::string withPictureNumbers(const std::string& lines, const std::vector<std::string>& maps);

/// The lines that a material's members alone would give, its texture as picture 0: a source that
/// says no more need not be kept.
std::string plainMtlLines(const Material& material);

/// What a `.mtl` that is written says of a material.
struct MtlEntry {
  Material material;                      ///< its name is fit for a file and unique
  std::vector<std::string> pictureFiles;  ///< of each of `material.pictures`; empty: left out
  std::string baseColorFile;              ///< empty for none
};

/// Writes materials: those that came from a `.mtl` as they came, with new names for pictures;
/// others so that `parseMtl` gives back the same numbers, and, of those that came from glTF, the
/// maps of normals (`norm`) and of light (`map_Ke`).
std::string formatMtl(const std::vector<MtlEntry>& materials);

}  // namespace exemplar
