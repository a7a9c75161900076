// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/array3d.h"
#include "core/origin.h"
#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "preview/baked_light.h"
#include "preview/render.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// A surface to be shown in a page, and what is known of where it came from. What is borrowed
/// outlives the call.
struct ViewSource {
  const TriangleMesh& mesh;
  /// The field that it is the surface of, and the origins of its samples, both or neither; with
  /// them the example whose samples origins name. An example itself has `example` alone: each of
  /// its points came from where it is.
  const DistanceField* field = nullptr;
  const Origins* origins = nullptr;
  const DistanceField* example = nullptr;
  const Array3D<float>* jumps = nullptr;  ///< `seamJumps` of the field, one for each sample
  int exampleIndex = 0;                   ///< the number that `example` has in the origins
};

struct ViewOptions {
  std::int64_t triangles =
      100000;             ///< a surface of more is simplified to at most this many; >= 1000
  int rays = 48;          ///< of baked light towards the sky, 1..4096
  RenderOptions picture;  ///< the picture that the view should look like
};

/// A corner as a view keeps it: 20 bytes before compression.
struct ViewVertex {
  std::array<std::uint16_t, 3> position{};   ///< 0..65535 along each side of the view's box
  std::array<std::int8_t, 2> normal{};       ///< octahedral (`octahedral`), times 127
  std::array<std::uint8_t, 3> color{};       ///< sRGB
  std::uint8_t metallic = 0, roughness = 0;  ///< times 255
  std::uint8_t glow = 0;                     ///< light of its own in units of its color, times 255
  BakedLight light;
  /// Where in the example's box it came from, 1..255 along each side; all 0: not known.
  std::array<std::uint8_t, 3> source{};
  std::uint8_t jump = 0;  ///< the seam's jump there, voxels times `kJumpSteps`, 255 and more as 255

  static constexpr double kJumpSteps = 32;
  bool operator==(const ViewVertex&) const = default;
};

/// The shadow on the floor below a surface: what share of the open floor's light arrives.
struct ViewFloor {
  static constexpr int kSide = 96;  ///< points along each side
  Box3d box;                        ///< world; flat, at the surface's lowest point
  std::vector<std::uint8_t> light;  ///< kSide rows of kSide points from the lowest y; times 255
};

/// A surface as a page shows it: few triangles, each corner with its looks.
struct ViewMesh {
  Box3d box;  ///< world
  ViewFloor floor;
  std::vector<ViewVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::int64_t ofTriangles = 0;  ///< that the surface had before it was simplified, where it was
};

/// Makes a view of a surface: simplifies it (`simplified`), takes each corner's looks from the
/// nearest place of the full surface, bakes light, and gives each corner its source and seam jump.
/// Where materials, sources or normals change at a vertex there are several corners, so that
/// borders stay sharp.
///
/// O(n log n) for n triangles. The same bytes at any number of threads (on one kind of machine, as
/// `render`). Throws `InputError` for options out of range, a mesh that `validate` refuses, and
/// origins that do not fit, and `Cancelled`.
ViewMesh makeViewMesh(const ViewSource& source, const ViewOptions& options = {},
                      const Progress& progress = {});

/// A view as the bytes that a page holds, deflated: for each corner's member a plane of bytes
/// (words: the low bytes' before the high ones'), each value as its difference to the corner
/// before, words zigzag-coded; then for each triangle corner, as a variable-length number of 7 bits
/// a byte, how far it lies below the highest index so far plus one; then the floor's light, as
/// differences.
std::string packViewMesh(const ViewMesh& view);

/// A unit vector on the octahedron's two coordinates, -1..1 each (Cigolle et al., "A survey of
/// efficient representations for independent unit vectors", JCGT 3(2), 2014).
std::array<double, 2> octahedral(const Vec3d& direction);

}  // namespace exemplar
