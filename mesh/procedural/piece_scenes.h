// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "mesh/procedural/processes.h"

namespace exemplar {

// Scenes made of model pieces, of the kinds that model synthesis was published with (Merrell, thesis,
// section 3.4): designed by hand on a grid of unit cubes, whole walls, roofs and roads wherever the
// grid cuts them. Each fills its box exactly; the bottom layer stands on the ground, the top layer
// is air. They have no random parts: `seed` and `extent` do not apply.

ProcessSample makeCastle();   ///< walls, gates, towers, stairs and a keep (figure 3.18)
ProcessSample makeCity();     ///< streets with crossings, cars, lamps, houses, at night (figure 3.20)
ProcessSample makeCanyon();   ///< stepped rock with a river, ledges, bridges (figure 3.21)
ProcessSample makeCluster();  ///< long halls with gables, buttresses and spires (figure 3.17)
ProcessSample makePaths();    ///< paths on arches, stairs and bridges in the air (figure 3.19)
ProcessSample makeGears();    ///< wheels that mesh, on shafts, with belts (figure 3.23)
ProcessSample makeForest();   ///< trees of several kinds, undergrowth (figure 3.22)
ProcessSample makeLibrary();  ///< rooms with shelves, tables, stairs, galleries (figure 3.24)

}  // namespace exemplar
