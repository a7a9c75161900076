// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace exemplar {

/// One color for each material of a mesh (or for the default one, where it has none), linear RGB
/// and opacity: its base color, times the mean of its texture where that can be decoded.
std::vector<std::array<float, 4>> materialColors(const TriangleMesh& mesh);

}  // namespace exemplar
