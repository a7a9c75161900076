// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/memory.h"
#include "preview/camera.h"
#include "preview/render.h"

namespace exemplar {

Image8 sideBySide(std::span<const Image8> pictures, const RowStyle& style) {
  if (pictures.empty()) throw InputError("no pictures to put side by side");
  if (style.gap < 0)
    throw InputError("the gap between pictures is " + std::to_string(style.gap) +
                     "; it must be 0 or more pixels");
  std::int64_t width =
      static_cast<std::int64_t>(style.gap) * static_cast<std::int64_t>(pictures.size() - 1);
  int height = 0;
  for (const Image8& picture : pictures) {
    if (picture.channels != 3 || picture.width < 1 || picture.height < 1)
      throw InputError("pictures put side by side must have 3 channels and at least one pixel");
    width += picture.width;
    height = std::max(height, picture.height);
  }
  constexpr std::int64_t kLongest = 1 << 20;
  if (width > kLongest)
    throw InputError("pictures side by side would be " + std::to_string(width) +
                     " pixels wide; at most " + std::to_string(kLongest) + " are possible");
  requireMemory(3.0 * static_cast<double>(width) * height, "the pictures side by side",
                "make them smaller");

  Image8 row{static_cast<int>(width), height, 3, {}};
  row.pixels.resize(static_cast<std::size_t>(width) * height * 3);
  for (std::size_t p = 0; p < row.pixels.size(); ++p) row.pixels[p] = style.behind[p % 3];
  int left = 0;
  for (const Image8& picture : pictures) {
    const int top = (height - picture.height) / (style.onFloor ? 1 : 2);
    for (int y = 0; y < picture.height; ++y)
      std::copy_n(picture.at(0, y), static_cast<std::size_t>(picture.width) * 3,
                  row.at(left, top + y));
    left += picture.width + style.gap;
  }
  return row;
}

namespace {

/// The free space around what a panel shows, of the square root of its area: a panel is filled to
/// four fifths, and one of thirty times its height to three.
constexpr double kFree = 0.05;

/// The gap between panels, of the row's height.
constexpr double kGap = 0.02;

/// What a mesh takes up of a picture: from its left and from its top, of its sides.
struct Extent2 {
  double left = 1e300, right = -1e300, top = 1e300, bottom = -1e300;
};

Extent2 extentOf(const TriangleMesh& mesh, const RenderOptions& options) {
  const Camera camera = pictureCamera(mesh, options);
  Extent2 extent;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      const auto at = pictureOf(camera, mesh.positions[v]);
      if (!at) continue;
      extent.left = std::min(extent.left, (*at)[0]);
      extent.right = std::max(extent.right, (*at)[0]);
      extent.top = std::min(extent.top, (*at)[1]);
      extent.bottom = std::max(extent.bottom, (*at)[1]);
    }
  }
  return extent;
}

/// A panel before it is enlarged: its picture, and what it shows of that, in pixels.
struct Panel {
  RenderOptions picture;
  Extent2 shown;
  double free = 0;  ///< around it, but for below

  double width() const { return shown.right - shown.left + 2 * free; }
  double heightAbove() const { return shown.bottom - shown.top + free; }
};

Panel panelOf(const TriangleMesh& mesh, const Vec3d& frame, const RenderOptions& options) {
  Panel panel{options, {}};
  panel.picture.frame = frameOfSize(boundingBox(mesh), frame);
  panel.shown = extentOf(mesh, panel.picture);
  panel.shown.left *= options.width, panel.shown.right *= options.width;
  panel.shown.top *= options.height, panel.shown.bottom *= options.height;
  panel.free = kFree * std::sqrt((panel.shown.right - panel.shown.left) *
                                 (panel.shown.bottom - panel.shown.top));
  return panel;
}

/// The pictures of the meshes, framed alike, enlarged to fill the row, and what is taken of each.
std::vector<RenderOptions> panels(std::span<const TriangleMesh> meshes, int gap,
                                  const RenderOptions& options) {
  Vec3d frame{};
  for (const TriangleMesh& mesh : meshes) frame = max(frame, boundingBox(mesh).size());
  std::vector<Panel> panels;
  double wide = 0, high = 0, below = 1e300;
  for (const TriangleMesh& mesh : meshes) {
    panels.push_back(panelOf(mesh, frame, options));
    wide += panels.back().width();
    high = std::max(high, panels.back().heightAbove());
    below = std::min(below, panels.back().free);  // as much for all, who stand on one floor
  }
  const auto count = static_cast<double>(meshes.size());
  const double zoom =
      std::min({(count * options.width - (count - 1) * gap) / wide, options.height / (high + below),
                16384.0 / std::max(options.width, options.height)});
  std::vector<RenderOptions> pictures;
  for (Panel& panel : panels) {
    panel.picture.width = std::max(1, static_cast<int>(zoom * options.width));
    panel.picture.height = std::max(1, static_cast<int>(zoom * options.height));
    Crop crop;
    crop.left = static_cast<int>(std::floor(zoom * (panel.shown.left - panel.free)));
    crop.top = static_cast<int>(std::floor(zoom * (panel.shown.top - panel.free)));
    crop.width = std::clamp(static_cast<int>(zoom * panel.width()), 1, 16384);
    crop.height = std::clamp(static_cast<int>(zoom * (panel.heightAbove() + below)), 1, 16384);
    panel.picture.crop = crop;
    pictures.push_back(panel.picture);
  }
  return pictures;
}

}  // namespace

Image8 renderSideBySide(std::span<const TriangleMesh> meshes, const RenderOptions& options,
                        const Progress& progress) {
  if (meshes.size() == 1) return render(meshes.front(), options, progress);
  for (const TriangleMesh& mesh : meshes) validate(mesh, "render");
  const int gap = std::max(2, static_cast<int>(std::lround(kGap * options.height)));
  const std::vector<RenderOptions> shown = panels(meshes, gap, options);
  std::vector<Image8> images;
  const auto count = static_cast<double>(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const auto n = static_cast<double>(m);
    images.push_back(render(meshes[m], shown[m], progress.part(n / count, (n + 1) / count)));
  }
  return sideBySide(images, {.gap = gap, .onFloor = true, .behind = kPage});
}

}  // namespace exemplar
