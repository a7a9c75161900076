// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <string_view>

#include "core/progress.h"
#include "voxelize/label_grid.h"

namespace exemplar {

/// Whether the text of a scene file is one of a volume of labels (`kind = "volume"`).
bool isVolumeScene(std::string_view text);

/// Makes a volume of labels from a scene file: layers, each inside the one before it, cut out of
/// noise. The file says `size` ([64, 64, 64] cells), `seed`, and for each `[[layer]]`, bottom up:
///
/// - `name`, and `color` ("#rrggbb"; without one it is empty, as air is);
/// - `share`, 0..1: how much of the layer below it takes (the first takes all);
/// - `feature`, cells, 1..1024: the size of its larger shapes; `octaves`, 1..8, of finer noise;
/// - `within`, cells: only so near the surface of the layer below, by steps along the axes; 0:
///   anywhere;
/// - `up`, 0..1: how much it prefers what lies open from above.
///
/// The same text gives the same grid. `name` is what errors call it. Throws `InputError` naming the
/// line, and `Cancelled`.
LabelGrid readVolumeScene(std::string_view text, const std::string& name,
                          const Progress& progress = {});

}  // namespace exemplar
