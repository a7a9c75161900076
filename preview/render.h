// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/progress.h"
#include "core/vec.h"
#include "core/warnings.h"
#include "mesh/image.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// From where a picture is taken.
struct View {
  double azimuth = -0.61;   ///< radians, anticlockwise seen from above, 0 looks along +y
  double elevation = 0.52;  ///< radians above the horizon, -pi/2..pi/2
};

/// The view of a name: `iso` (the default), `front` (looks along +y), `back`, `left`,
/// `right` (seen from -x, from +x), `top`, `bottom`, or "AZ,EL" in degrees, as "-35,30". Throws
/// `InputError` listing the names for anything else.
View viewFromName(std::string_view name);

/// A rectangle of a picture, in pixels from its left and its top; it may reach beyond the picture.
struct Crop {
  int left = 0, top = 0, width = 0, height = 0;
};

struct RenderOptions {
  int width = 960, height = 720;  ///< pixels, 1..16384
  View view;
  /// Rays a pixel, 1..4096: paths of four (camera, key light, sky, key light seen from there). What
  /// noise remains is filtered out; the filter does less the more rays there are.
  int samples = 64;
  std::uint64_t seed = 0;  ///< of the noise; pictures of two seeds look the same

  /// What the camera holds, in place of the mesh's own vertices: pictures with frames of one size
  /// (see `frameOfSize`) and one view show their meshes at one scale.
  std::optional<Box3d> frame;
  /// What is taken of the picture in place of all of it; its sides 1..16384.
  std::optional<Crop> crop;
  double margin = 0.06;       ///< free share of the picture on each side, 0..0.45
  double fieldOfView = 0.52;  ///< radians across the picture's shorter side, 0.01..2.5

  double keyAzimuth = 0.95;   ///< of the key light, radians to the left of the camera, any finite
  double keyElevation = 0.9;  ///< radians above the horizon, 0.05..pi/2
  double keyRadius = 0.075;   ///< angular radius, radians: how soft shadows are, 0.001..0.5
  bool ground = true;         ///< a floor below the mesh (never drawn in views from below)

  /// Edges whose faces meet at less than this look smooth; radians, 0 (all facets) .. pi/2.
  double creaseAngle = 0.7;

  /// Receives a line for each texture that cannot be decoded; null drops the lines.
  Warnings* warnings = nullptr;
};

/// A shaded picture of a mesh (Embree): a soft key light from over the shoulder, sky light with
/// occlusion and one bounce, a ground plane that catches the shadow and is otherwise the light
/// background (`kBackground`), metallic-roughness materials with base color textures, vertex
/// colors, filmic tones, z up, the camera as near as holds the whole mesh. Both sides of a face
/// show; everything is opaque. A mesh without materials and colors is shown as warm gray clay.
///
/// Opaque sRGB, three channels. The same bytes at any number of threads (on one kind of machine:
/// Embree's kernels differ in the last bit between instruction sets). About 4 s on two cores for
/// the defaults and a third of a million triangles. Throws `InputError` for options out of range,
/// for a mesh that `validate` refuses and where memory does not suffice, and `Cancelled`. Materials
/// whose texture cannot be decoded show their base color.
Image8 render(const TriangleMesh& mesh, const RenderOptions& options = {},
              const Progress& progress = {});

/// A box of `size` on the same floor as `box` and centered over it: a frame to show `box` in.
Box3d frameOfSize(const Box3d& box, const Vec3d& size);

/// The color behind pictures, sRGB.
inline constexpr std::array<std::uint8_t, 3> kBackground = {240, 240, 241};

/// The color between and above the panels of a row, sRGB.
inline constexpr std::array<std::uint8_t, 3> kPage = {255, 255, 255};

/// How pictures are put in a row.
struct RowStyle {
  int gap = 0;           ///< pixels between them, >= 0
  bool onFloor = false;  ///< lower ones are at the bottom; else they are centered
  std::array<std::uint8_t, 3> behind = kBackground;  ///< where no picture is, sRGB
};

/// Pictures in a row from left to right. All have 3 channels. Throws `InputError` for none, for a
/// gap out of range, or where they would not fit.
Image8 sideBySide(std::span<const Image8> pictures, const RowStyle& style = {});

/// Meshes in a row at one scale and on one floor, each in a panel as wide and as high as what it
/// shows and a little free space; between and above panels is `kPage`. The row is as large as fits
/// into pictures of the size that `options` says, one for each mesh beside the others: that wide,
/// or that high where it would be higher. One mesh alone has a picture of that size. Throws as
/// `render` and `sideBySide` do.
Image8 renderSideBySide(std::span<const TriangleMesh> meshes, const RenderOptions& options,
                        const Progress& progress = {});

}  // namespace exemplar
