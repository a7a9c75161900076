// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>

#include "core/progress.h"
#include "core/warnings.h"
#include "engine/source.h"
#include "mesh/mesh_file.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

struct TargetSurface {
  TriangleMesh surface;
  std::optional<TriangleMesh> body;  ///< the whole of which `surface` is a part, where asked for
};

/// A surface that an example can be laid on: read, with equal positions joined, cut into manifold
/// sheets where it is none, and turned where a closed one is inside out. What was done about it
/// goes to `warnings`. Vertex colors stay. With a `cover`, the part of it that `coveredPart`
/// leaves, and the whole, too, where `withBody` is set. Throws `InputError` naming the source, and
/// `Cancelled`.
TargetSurface targetSurface(const Source& source, const MeshFileOptions& options,
                            const std::string& cover = "", bool withBody = false,
                            Warnings* warnings = nullptr, const Progress& progress = {});

}  // namespace exemplar
