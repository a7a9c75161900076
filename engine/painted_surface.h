// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace exemplar {

// What materials and vertex colors of a surface say of an example that is laid on it.

/// The part of a mesh that `cover` names: triangles of the material of that name; or, for "red",
/// "green", "blue" or "alpha" where no material is called so, where that channel of the vertex
/// colors, linear between vertices, is at least one half: triangles are cut there. Triangles on
/// both sides of a cut, or of its edge, have equal corners. `name` is what errors call the mesh.
/// Throws `InputError` where there is no such material or channel, or nothing is left.
TriangleMesh coveredPart(const TriangleMesh& mesh, const std::string& cover,
                         const std::string& name);

/// How large an example is to be at each vertex: from one half of its own size, where a channel of
/// the vertex colors is 0, to twice, where it is 1. `channel` and `name` as above. Throws
/// `InputError` where there are no colors.
std::vector<double> paintedSizes(const TriangleMesh& mesh, const std::string& channel,
                                 const std::string& name);

}  // namespace exemplar
