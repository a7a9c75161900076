// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/memory.h"
#include "preview/camera.h"
#include "preview/render.h"

namespace exemplar {

Image8 sideBySide(std::span<const Image8> pictures, int gap) {
  if (pictures.empty()) throw InputError("no pictures to put side by side");
  if (gap < 0)
    throw InputError("the gap between pictures is " + std::to_string(gap) +
                     "; it must be 0 or more pixels");
  std::int64_t width =
      static_cast<std::int64_t>(gap) * static_cast<std::int64_t>(pictures.size() - 1);
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
  for (std::size_t p = 0; p < row.pixels.size(); ++p) row.pixels[p] = kBackground[p % 3];
  int left = 0;
  for (const Image8& picture : pictures) {
    const int top = (height - picture.height) / 2;
    for (int y = 0; y < picture.height; ++y)
      std::copy_n(picture.at(0, y), static_cast<std::size_t>(picture.width) * 3,
                  row.at(left, top + y));
    left += picture.width + gap;
  }
  return row;
}

namespace {

/// The free space around what a panel shows, of the row's height.
constexpr double kFree = 0.04;

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

/// The pictures of the meshes, framed alike, enlarged to fill the row, and what is taken of each.
std::vector<RenderOptions> panels(std::span<const TriangleMesh> meshes,
                                  const RenderOptions& options) {
  Vec3d size{};
  for (const TriangleMesh& mesh : meshes) size = max(size, boundingBox(mesh).size());
  std::vector<RenderOptions> panels;
  std::vector<Extent2> extents;
  double wide = 0, top = 1e300, bottom = -1e300;
  for (const TriangleMesh& mesh : meshes) {
    RenderOptions panel = options;
    panel.frame = frameOfSize(boundingBox(mesh), size);
    const Extent2 extent = extentOf(mesh, panel);
    wide += extent.right - extent.left;
    top = std::min(top, extent.top);
    bottom = std::max(bottom, extent.bottom);
    panels.push_back(panel);
    extents.push_back(extent);
  }
  const auto count = static_cast<double>(meshes.size());
  const double free = kFree * options.height;
  const double zoom = std::min({(count * options.width - 2 * count * free) / (wide * options.width),
                                (options.height - 2 * free) / ((bottom - top) * options.height),
                                16384.0 / std::max(options.width, options.height)});
  for (std::size_t p = 0; p < panels.size(); ++p) {
    RenderOptions& panel = panels[p];
    panel.width = std::max(1, static_cast<int>(zoom * options.width));
    panel.height = std::max(1, static_cast<int>(zoom * options.height));
    const Extent2& extent = extents[p];
    Crop crop;
    crop.left = static_cast<int>(std::floor(extent.left * panel.width - free));
    crop.top = static_cast<int>(std::floor(top * panel.height - free));
    crop.width = static_cast<int>(std::floor(extent.right * panel.width + free)) - crop.left;
    crop.height = static_cast<int>(std::floor(bottom * panel.height + free)) - crop.top;
    crop.width = std::clamp(crop.width, 1, 16384);
    crop.height = std::clamp(crop.height, 1, 16384);
    panel.crop = crop;
  }
  return panels;
}

/// Lets a panel's free columns, left and right, pass into the background, so that a shadow that
/// reaches beyond the panel does not end at a line.
void fadeSides(Image8& panel, int columns) {
  for (int y = 0; y < panel.height; ++y) {
    for (int x = 0; x < panel.width; ++x) {
      const int side = std::min(x, panel.width - 1 - x);
      if (side >= columns) continue;
      const double t = (side + 0.5) / columns, weight = t * t * (3 - 2 * t);
      std::uint8_t* pixel = panel.at(x, y);
      for (int c = 0; c < 3; ++c)
        pixel[c] = static_cast<std::uint8_t>(
            std::lround(kBackground[c] + weight * (pixel[c] - kBackground[c])));
    }
  }
}

}  // namespace

Image8 renderSideBySide(std::span<const TriangleMesh> meshes, const RenderOptions& options,
                        const Progress& progress) {
  if (meshes.size() == 1) return render(meshes.front(), options, progress);
  for (const TriangleMesh& mesh : meshes) validate(mesh, "render");
  const std::vector<RenderOptions> shown = panels(meshes, options);
  std::vector<Image8> images;
  const auto count = static_cast<double>(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const auto n = static_cast<double>(m);
    images.push_back(render(meshes[m], shown[m], progress.part(n / count, (n + 1) / count)));
    fadeSides(images.back(), static_cast<int>(kFree * options.height));
  }
  return sideBySide(images);
}

}  // namespace exemplar
