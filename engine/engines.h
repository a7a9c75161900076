// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "engine/engine.h"

/// The engines there are.
namespace exemplar {

/// Geometry synthesis: `quiltingEngine` where the example and the request suit it, else
/// `votingEngine`.
const Engine& geometryEngine();
/// Large pieces of the example joined by cuts (`synth/geometry/quilting`).
const Engine& quiltingEngine();
/// Patches matched and voted, coarse to fine (`synth/geometry/voting`).
const Engine& votingEngine();
/// Best-matching blocks (Lagae, Dumont, Dutré 2004; `synth/geometry/blocks.h`).
const Engine& blocksEngine();
/// Model synthesis (Merrell 2007, 2009; `synth/model`).
const Engine& modelEngine();
/// Continuous model synthesis (Merrell and Manocha 2008; `synth/continuous`).
const Engine& continuousEngine();
/// Layered shape synthesis (Rosenberger, Cohen-Or, Lischinski 2009; `synth/layered`), of pictures
/// and of volumes.
const Engine& layeredEngine();
const Engine& layeredVolumeEngine();
/// Terrain synthesis (`synth/terrain`).
const Engine& terrainEngine();
/// An example laid on a surface (`synth/surface`).
const Engine& surfaceEngine();

}  // namespace exemplar
