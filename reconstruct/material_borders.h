// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "mesh/triangle_mesh.h"

namespace exemplar {

/// Gives triangles with two neighbours of one other material that material, `rounds` times: single
/// triangles and teeth along the border between two materials go. Stripes that are two triangles
/// wide stay. O(rounds n); the same at any number of threads.
void cleanMaterialBorders(TriangleMesh& mesh, int rounds);

/// Draws the vertices along borders between two materials into line, by at most `most` world units
/// and along the surface only. Vertices where more than two materials meet, where the surface has
/// a crease and on open rims stay, and no triangle turns over.
void straightenMaterialBorders(TriangleMesh& mesh, double most);

}  // namespace exemplar
