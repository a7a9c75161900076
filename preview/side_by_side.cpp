// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/memory.h"
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

Image8 renderSideBySide(std::span<const TriangleMesh> meshes, const RenderOptions& options,
                        const Progress& progress) {
  Vec3d size{};
  for (const TriangleMesh& mesh : meshes) size = max(size, boundingBox(mesh).size());
  std::vector<Image8> images;
  const auto count = static_cast<double>(meshes.size());
  for (const TriangleMesh& mesh : meshes) {
    RenderOptions framed = options;
    framed.frame = frameOfSize(boundingBox(mesh), size);
    const auto n = static_cast<double>(images.size());
    images.push_back(render(mesh, framed, progress.part(n / count, (n + 1) / count)));
  }
  return images.size() == 1 ? images.front() : sideBySide(images);
}

}  // namespace exemplar
