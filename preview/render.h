// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/progress.h"
#include "core/vec.h"
#include "mesh/image.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// From where a picture is taken.
struct View {
  double azimuth = -0.61;   ///< radians, anticlockwise seen from above, 0 looks along +y
  double elevation = 0.52;  ///< radians above the horizon, -pi/2..pi/2
};

struct RenderOptions {
  int width = 960, height = 720;  ///< pixels, 1..16384
  View view;
  int samples = 64;               ///< rays a pixel, 1..4096
  std::uint64_t seed = 0;
};

/// A shaded picture of a mesh (Embree): a soft key light from over the shoulder, sky light with
/// occlusion, a ground plane that catches the shadow, materials and vertex colours, filmic tones, z
/// up, the camera far enough to hold the whole mesh. Opaque sRGB. The same bytes at any number of
/// threads. Throws `InputError` for options out of range.
Image8 render(const TriangleMesh& mesh, const RenderOptions& options = {},
              const Progress& progress = {});

}  // namespace exemplar
