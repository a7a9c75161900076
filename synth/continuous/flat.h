// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>

#include "core/warnings.h"
#include "mesh/svg_file.h"
#include "synth/continuous/polygons.h"
#include "synth/continuous/solid_scene.h"

/// Shapes of the plane, which are prisms here: P. Merrell and D. Manocha, "Continuous Model
/// Synthesis" (2008), explain their algorithm on them.
namespace exemplar::continuous {

/// A drawing as a scene: each shape becomes a prism of its material, whose corners are snapped to
/// a grid of `unit` (by default the common measure of all coordinates); what is white is air.
/// Throws `InputError` (beginning with `name`) where corners fit no grid of at most 4,096 units a
/// side, or sides are steeper than normals allow.
SolidScene solidsOfDrawing(const Drawing& drawing, const std::string& name,
                           std::optional<double> unit = {}, Warnings* warnings = nullptr);

/// The shapes of a flat model: the upper ends of its prisms. Throws `InputError` for other models.
Drawing drawingOf(const PolygonModel& model);

}  // namespace exemplar::continuous
