// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/label_file.h"

#include "core/error.h"
#include "core/file.h"
#include "voxelize/label_image.h"
#include "voxelize/tiled_map.h"

namespace exemplar {

bool isLabelFile(const std::filesystem::path& path) {
  const std::string ending = lowerExtension(path);
  return ending == ".txt" || ending == ".vox" || isTiledFile(path);
}

LabelGrid readLabels(const std::filesystem::path& path, const Progress& progress) {
  const std::string ending = lowerExtension(path), name = path.string();
  if (ending == ".txt") return parseLabelText(readFile(path), name, progress);
  if (ending == ".vox") return parseVox(readFile(path), name);
  if (ending == ".vdb") return readLabelsVdb(path, progress);
  if (ending == ".png" || ending == ".jpg" || ending == ".jpeg") {
    return labelsFromImage(decodeImage(readFile(path), name), name, {}, progress).grid;
  }
  if (isTiledFile(path)) return readTiledMap(path, progress).grid;
  throw InputError(name + ": not a kind of label grid; use .txt .vox .vdb .png .jpg .tmx or .csv");
}

void writeLabels(const std::filesystem::path& path, const LabelGrid& grid,
                 const Progress& progress) {
  const std::string ending = lowerExtension(path), name = path.string();
  validate(grid, name);
  if (ending == ".txt") return writeFile(path, formatLabelText(grid, progress));
  if (ending == ".vox") return writeFile(path, formatVox(grid, name, progress));
  if (ending == ".vdb") return writeLabelsVdb(path, grid, progress);
  if (ending == ".csv") return writeLabelRows(path, grid, progress);
  if (ending == ".tmx")
    throw InputError(name + ": a .tmx is written of an example that is one; write a .csv");
  if (ending == ".png") return writePng(path, imageFromLabels(grid, progress));
  throw InputError(name + ": cannot write labels to this kind of file; use one of " +
                   kLabelEndings);
}

}  // namespace exemplar
