// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "core/vec.h"
#include "mesh/triangle_mesh.h"
#include "preview/render.h"

namespace exemplar {

/// A point whose light is asked for.
struct LightProbe {
  Vec3d position;  ///< on the surface, world units
  Vec3f normal;    ///< unit, outward; zero counts as straight up
};

/// What of the studio's light (`render`) reaches a point; 0 nothing .. 255 all of it.
struct BakedLight {
  std::uint8_t sky = 255;  ///< of the sky's, weighted by the cosine to the normal
  std::uint8_t key = 255;  ///< of the key light's disc, whichever way the surface faces
  bool operator==(const BakedLight&) const = default;
};

struct BakeOptions {
  int rays = 64;           ///< towards the sky from each point, 1..4096
  int keyRays = 8;         ///< towards the key light, 1..4096
  RenderOptions picture;   ///< read for the view, the key light and the ground
  std::uint64_t seed = 0;  ///< of the noise
};

/// Light that was gathered beforehand, so that a viewer without a ray tracer can show `mesh` nearly
/// as a picture of it does: the key light is where it was for the picture and does not move
/// with the viewer. Rays that meet the floor count as half open: it is lit itself.
///
/// The same values at any number of threads (on one kind of machine, as `render`). Some
/// microseconds a point. Throws `InputError` for numbers of rays out of range and for a mesh that
/// `validate` refuses, and `Cancelled`.
std::vector<BakedLight> bakeLight(const TriangleMesh& mesh, std::span<const LightProbe> probes,
                                  const BakeOptions& options = {}, const Progress& progress = {});

/// The unit vector from the scene to the key light of a picture.
Vec3d keyDirection(const RenderOptions& picture);

}  // namespace exemplar
