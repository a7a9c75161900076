// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

#include "engine/request.h"
#include "synth/model/synthesize.h"
#include "voxelize/adjacency.h"

/// Requests of model synthesis as they are written: by labels' numbers and names, in files.
namespace exemplar {

/// The settings of model synthesis as they are written; what names labels or files is read once the
/// example is known.
struct ModelSettings {
  ModelOptions options;
  std::vector<std::string> side, weight, weightMap, count, connect;
  std::vector<std::string> mirroredX, mirroredY, turned, offset;
  Axes mirror;
  std::optional<int> frames;
  std::string mask;
};
const SettingTable<ModelSettings>& modelSettings();
/// Throws `InputError` for what cannot be read whatever labels the example has, and for files that
/// are not there.
void checkTexts(const ModelSettings& settings);

/// "3,wall,7": numbers or names of labels, or parts of names: a name may stand for several, and so
/// may "roof" or "concrete" for all whose names are like "roof 12, concrete", and "roof+concrete"
/// for those that are both. Throws `InputError` naming `what` and which labels there are.
std::vector<Label> parseLabels(const std::string& text, const LabelGrid& grid,
                               const std::string& what);

/// Everything that the request asks of model synthesis of the example.
ModelOptions modelOptions(const Request& request, const ModelSettings& settings,
                          const Example& example);

/// The examples' grids, and after them those of pictures that count mirrored or turned, too.
std::vector<LabelGrid> modelGrids(std::span<const Example> examples);
/// Origins in what `modelGrids` gives as origins in the examples.
void originsInExamples(std::span<const Example> examples, Origins& origins);

/// Which labels may be neighbors: as counted in the examples, or, where blocks of a field overlap,
/// as they agree. Throws `InputError` for settings that do not go together with the latter.
Adjacency adjacencyOf(std::span<const Example> examples, const AdjacencyOptions& options = {});
/// How the settings say that the examples are read.
AdjacencyOptions adjacencyOptions(const ModelSettings& settings);

/// The axes, x and y, along which a picture, or a map of tiles, has two different ends: what it
/// shows at one of them and what it shows at the other (colors, tiles) have nothing in common, as
/// earth and sky have, and nothing says that they are joined, mirrored or turned. The result then
/// begins and ends there as it does.
Axes directedAxes(const Example& example);

/// The axes, x and y, at whose sides the example's labels cut objects off: what is at a side there,
/// beside what is most frequent at its height, occurs further inside, too. Pictures and fields have
/// none; their sides have rules of their own.
Axes cutAtSides(const Example& example);

/// Cells of a result that is as large as the example: the example's own, but where blocks overlap.
Vec3i cellsOfExample(const Example& example);

}  // namespace exemplar
