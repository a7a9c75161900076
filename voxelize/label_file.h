// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/progress.h"
#include "voxelize/label_grid.h"

namespace exemplar {

/// Whether the path's ending names a file that holds labels and nothing else: `.txt`, `.vox`,
/// `.tmx` or
/// `.csv`.
/// (`.vdb` and pictures may hold labels, too: `readLabels` tries.)
bool isLabelFile(const std::filesystem::path& path);

/// Reads a grid of labels by the path's ending.
///
/// `.txt`: the text format of Merrell's model synthesis tool (see `parseLabelText`). `.vox`:
/// MagicaVoxel (see `parseVox`). `.vdb`: the first grid of 32-bit integers. `.png .jpg .jpeg`: a
/// flat grid, one label for each color, x to the right and y up; transparent pixels are empty.
/// `.tmx .csv`: a map of tiles (see `readTiledMap`).
///
/// Throws `InputError` naming the file, and the line in text, for anything malformed.
LabelGrid readLabels(const std::filesystem::path& path, const Progress& progress = {});

/// Writes a grid in the format of the path's ending, whole or not at all: `.txt` (labels, names and
/// object lines), `.vox` (colors, 8 bits sRGB; at most 255 labels that are not empty), `.vdb` (a
/// grid of 32-bit integers; everything, losslessly) `.png` (flat grids; colors) or
/// `.csv` (flat grids; numbers, -1 where empty). The same grid
/// gives the same bytes. Throws `InputError` for what the format cannot hold.
void writeLabels(const std::filesystem::path& path, const LabelGrid& grid,
                 const Progress& progress = {});

/// The endings that `writeLabels` knows.
inline constexpr const char* kLabelEndings = ".txt .vox .vdb .png .csv";

// The formats in memory. `name` is what errors call the file.

/// The reference tool's text: three lines of free text, `X Y Z`, a blank line, then Z layers from
/// the bottom of X lines with Y labels each: cell (x, y, z) is number (z X + x) Y + y. How the
/// numbers are spread over lines does not matter. An optional section `<Objects>` names the scene
/// and, for each label from 1 on, gives a line of text, lines that begin with `$`, and a line `#`.
/// Label 0 is empty; the others get `distinctColor`s.
LabelGrid parseLabelText(std::string_view bytes, const std::string& name,
                         const Progress& progress = {});
std::string formatLabelText(const LabelGrid& grid, const Progress& progress = {});

/// MagicaVoxel's `.vox`, versions 150 and 200. Label 0 is empty, 1.. are the palette's colors that
/// are used, in its order, named by their numbers. The models that the scene graph shows are merged
/// with their translations and rotations, later ones over earlier ones; without a scene graph the
/// first model counts. Models longer than 256 cells are written as several with a scene graph, so
/// that what is written reads back the same.
LabelGrid parseVox(std::string_view bytes, const std::string& name);
std::string formatVox(const LabelGrid& grid, const std::string& name,
                      const Progress& progress = {});

/// Grids of labels in OpenVDB files: an Int32 grid "label" whose voxel (i, j, k) is cell (i, j, k),
/// with the looks as metadata. Foreign files may have any labels from 0 to 65535; their box is that
/// of the active voxels.
LabelGrid readLabelsVdb(const std::filesystem::path& path, const Progress& progress = {});
void writeLabelsVdb(const std::filesystem::path& path, const LabelGrid& grid,
                    const Progress& progress = {});

}  // namespace exemplar
