// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/camera.h"

#include <gtest/gtest.h>

#include "mesh/primitives.h"

namespace exemplar {
namespace {

TEST(PictureCamera, TellsWhereThePictureShowsAPoint) {
  // A black ball among white ones that span the picture: the mean place of its pixels.
  TriangleMesh mesh = makeSphere({7, 4, 3}, 0.6);
  mesh.materials = {{"black", {0, 0, 0, 1}}, {"white", {1, 1, 1, 1}}};
  mesh.materials[0].roughness = mesh.materials[1].roughness = 1;
  mesh.triangleMaterials.assign(mesh.triangles.size(), 0);
  for (const Vec3d& center : {Vec3d{0, 0, 0}, {9, -2, 0}, {-3, 8, 1}, {8, 9, 0}}) {
    TriangleMesh white = makeSphere(center, 1);
    white.materials = {mesh.materials[1]};
    white.triangleMaterials.assign(white.triangles.size(), 0);
    append(mesh, white);
  }
  RenderOptions options;
  options.width = 200;
  options.height = 150;
  options.samples = 16;
  options.ground = false;
  for (const char* view : {"iso", "20,60", "top"}) {
    SCOPED_TRACE(view);
    options.view = viewFromName(view);
    const Image8 image = render(mesh, options);
    double x = 0, y = 0, count = 0;
    for (int row = 0; row < image.height; ++row)
      for (int column = 0; column < image.width; ++column) {
        const std::uint8_t* pixel = image.at(column, row);
        if (pixel[0] + pixel[1] + pixel[2] > 3 * 60) continue;
        x += column + 0.5, y += row + 0.5, ++count;
      }
    ASSERT_GT(count, 20);
    const auto at = pictureOf(pictureCamera(mesh, options), {7, 4, 3});
    ASSERT_TRUE(at);
    // Its highlight and what others hide move the mean by less than its radius of some 9 pixels.
    EXPECT_NEAR((*at)[0] * 200, x / count, 3);
    EXPECT_NEAR((*at)[1] * 150, y / count, 3);
  }
}

TEST(PictureCamera, HasNothingBehindIt) {
  const Camera camera = pictureCamera(makeSphere({0, 0, 0}, 1), {});
  EXPECT_FALSE(pictureOf(camera, camera.position - camera.forward));
}

}  // namespace
}  // namespace exemplar
