// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/vec.h"
#include "mesh/triangle_mesh.h"
#include "preview/render.h"

namespace exemplar {

/// A pinhole camera: picture point (x, y), both -1..1 with y up, looks along
/// forward + x tanX right + y tanY up from `position`.
struct Camera {
  Vec3d position;
  Vec3d right, up, forward;  ///< orthonormal
  double tanX = 0, tanY = 0;
};

/// Finds the nearest camera of a given direction that shows all points within the
/// picture less its margins, with what they take up in its middle. Exact, not iterative.
class CameraFit {
 public:
  /// Reads width, height, view, margin and fieldOfView.
  explicit CameraFit(const RenderOptions& options);

  void add(const Vec3d& point);

  /// For at least one point. `minimumDepth` > 0 is the least distance along `forward` between the
  /// camera and each point (for points that coincide).
  Camera camera(double minimumDepth) const;

 private:
  Camera axes_;  // position unset
  double freeX_, freeY_;
  double lowX_, highX_, lowY_, highY_, nearest_;
};

/// Calls `hold` for every point that a picture of `mesh` must show: the frame's corners, or the
/// vertices of triangles.
template <class Hold>
void forEachHeldPoint(const TriangleMesh& mesh, const RenderOptions& options, const Hold& hold) {
  if (options.frame) {
    const Box3d& b = *options.frame;
    for (int corner = 0; corner < 8; ++corner)
      hold({(corner & 1 ? b.max : b.min).x, (corner & 2 ? b.max : b.min).y,
            (corner & 4 ? b.max : b.min).z});
  } else {
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t v : triangle) hold(mesh.positions[v]);
  }
}

/// The camera of the picture that `render` takes of `mesh`, in world units: where a point of the
/// scene is in the picture. Throws `InputError` for a mesh that `validate` refuses.
Camera pictureCamera(const TriangleMesh& mesh, const RenderOptions& options);

/// Where a picture shows a point: 0..1 from its left and from its top where it is within. Nothing
/// for a point that is not in front of the camera.
std::optional<std::array<double, 2>> pictureOf(const Camera& camera, const Vec3d& point);

}  // namespace exemplar
