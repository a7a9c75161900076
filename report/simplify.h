// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "mesh/triangle_mesh.h"

namespace exemplar {

/// A mesh of at most `triangles` triangles (>= 1) that looks like `mesh`, whatever it is, for
/// pictures only; attributes are lost. Its vertices are some of the mesh's own.
///
/// Edges are collapsed by quadric errors (Garland and Heckbert, "Surface simplification using
/// quadric error metrics", 1997) as meshoptimizer does it, once vertices at the same place have
/// been joined. A mesh of so many parts that few triangles would be left to each (a soup whose
/// triangles share nothing) is simplified by meshoptimizer's grid of cells, each of which keeps one
/// vertex. An estimated second a million triangles, by one thread; deterministic.
TriangleMesh simplified(const TriangleMesh& mesh, std::int64_t triangles);

}  // namespace exemplar
