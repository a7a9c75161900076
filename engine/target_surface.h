// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include "core/progress.h"
#include "core/warnings.h"
#include "engine/source.h"
#include "mesh/mesh_file.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// A surface that an example can be laid on: read, with equal positions joined, cut into manifold
/// sheets where it is none, and turned where a closed one is inside out. What was done about it
/// goes to `warnings`. Vertex colors stay. With a `cover`, the part of it that `coveredPart`
/// leaves. Throws `InputError` naming the source, and `Cancelled`.
TriangleMesh targetSurface(const Source& source, const MeshFileOptions& options,
                           const std::string& cover = "", Warnings* warnings = nullptr,
                           const Progress& progress = {});

}  // namespace exemplar
