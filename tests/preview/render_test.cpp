// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/render.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "mesh/primitives.h"
#include "tests/preview/panels.h"
#include "tests/progress_checks.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

RenderOptions quick(const std::string& view = "iso") {
  RenderOptions options;
  options.width = 160;
  options.height = 120;
  options.samples = 8;
  options.view = viewFromName(view);
  return options;
}

bool isBackground(const Image8& image, int x, int y) {
  for (int c = 0; c < 3; ++c) {
    // Noise and the far ground's shade move the background by a few steps.
    if (std::abs(image.at(x, y)[c] - kBackground[c]) > 6) return false;
  }
  return true;
}

int luminance(const Image8& image, int x, int y) {
  const std::uint8_t* p = image.at(x, y);
  return (p[0] * 2 + p[1] * 5 + p[2]) / 8;
}

TEST(Render, ATextureThatCannotBeDecodedIsAWarning) {
  TriangleMesh box = makeBox({{-1, -1, -1}, {1, 1, 1}});
  setMaterial(box, {.baseColor = {0.9f, 0.1f, 0.1f, 1}});
  box.uvs.assign(box.triangles.size(), {Vec2f{0, 0}, {1, 0}, {0, 1}});
  const Image8 plain = render(box, quick());
  box.materials[0].baseColorTexture = 0;
  box.textures = {{"brick.png", "image/png", "\x89PNG\r\n\x1a\n and no more"},
                  {"unused.png", "image/png", "nothing"}};
  RenderOptions options = quick();
  Warnings warnings;
  options.warnings = &warnings;
  EXPECT_EQ(render(box, options).pixels, plain.pixels) << "its base color alone";
  ASSERT_EQ(warnings.size(), 1u) << "what no triangle has is not decoded";
  EXPECT_THAT(warnings[0], ::testing::HasSubstr("brick.png"));
  EXPECT_EQ(render(box, quick()).pixels, plain.pixels) << "and without anyone to read it";
}

TEST(Render, HoldsTheMeshAndLeavesTheBorderFree) {
  for (const char* view : {"iso", "front", "back", "left", "right", "-70,10", "20,80"}) {
    for (const Vec3d& size : {Vec3d{8, 8, 1}, Vec3d{1, 1, 8}, Vec3d{1, 1, 1}}) {
      RenderOptions options = quick(view);
      options.ground = false;
      const Image8 image = render(makeBox({size * -0.5, size * 0.5}), options);
      ASSERT_EQ(image.width, options.width);
      ASSERT_EQ(image.channels, 3);
      int covered = 0;
      for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) covered += !isBackground(image, x, y);
      }
      EXPECT_GT(covered, 500) << view;
      for (int x = 0; x < image.width; ++x) {
        EXPECT_TRUE(isBackground(image, x, 0) && isBackground(image, x, image.height - 1)) << view;
      }
      for (int y = 0; y < image.height; ++y) {
        EXPECT_TRUE(isBackground(image, 0, y) && isBackground(image, image.width - 1, y)) << view;
      }
    }
  }
}

TEST(Render, ASphereIsRound) {
  RenderOptions options = quick("front");
  options.ground = false;
  const Image8 image = render(makeSphere({0, 0, 0}, 1, 12), options);
  int left = image.width, right = -1, top = image.height, bottom = -1;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (isBackground(image, x, y)) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  // The silhouette's edge falls on a pixel or its neighbor on each side.
  EXPECT_NEAR(right - left, bottom - top, 3);
  EXPECT_NEAR(right + left, image.width - 1, 3);
}

TEST(Render, ShowsMaterialsAndVertexColors) {
  TriangleMesh red = makeSphere({0, 0, 0}, 1, 8);
  setMaterial(red, {.name = "red", .baseColor = {0.8f, 0.05f, 0.05f, 1}});
  const Image8 byMaterial = render(red, quick());
  TriangleMesh green = makeSphere({0, 0, 0}, 1, 8);
  green.colors.assign(green.positions.size(), {0.05f, 0.6f, 0.05f, 1});
  const Image8 byColor = render(green, quick());
  const std::uint8_t* p = byMaterial.at(80, 60);
  EXPECT_GT(p[0], p[1] + 40);
  EXPECT_GT(p[0], p[2] + 40);
  const std::uint8_t* q = byColor.at(80, 60);
  EXPECT_GT(q[1], q[0] + 40);
  EXPECT_GT(q[1], q[2] + 40);
}

TEST(Render, TheGroundCatchesAShadow) {
  TriangleMesh mesh = makeSphere({0, 0, 0}, 1, 8);
  RenderOptions options = quick();
  const Image8 with = render(mesh, options);
  options.ground = false;
  const Image8 without = render(mesh, options);
  int darkest = 255, darkestWithout = 255;
  for (int y = 0; y < with.height; ++y) {
    for (int x = 0; x < with.width; ++x) {
      // Only where there is no sphere.
      if (!isBackground(without, x, y)) continue;
      darkest = std::min(darkest, luminance(with, x, y));
      darkestWithout = std::min(darkestWithout, luminance(without, x, y));
    }
  }
  EXPECT_LT(darkest, darkestWithout - 40);
}

TEST(Render, IsTheSameBytesAtOneAndEightThreads) {
  const TriangleMesh mesh = makeTorus({0, 0, 0}, {0, 0, 1}, 1, 0.4, 24, 12);
  testing::expectSameAtAnyThreads([&] { return render(mesh, quick()).pixels; });
}

TEST(Render, OpenFlatTinyAndHugeMeshesAreShown) {
  TriangleMesh triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  triangle.triangles = {{0, 1, 2}};
  for (const double scale : {1e-6, 1.0, 1e6}) {
    TriangleMesh mesh = triangle;
    for (Vec3d& p : mesh.positions) p *= scale;
    const Image8 image = render(mesh, quick());
    int covered = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) covered += !isBackground(image, x, y);
    }
    EXPECT_GT(covered, 300) << scale;
  }
}

TEST(Render, ReportsAndStops) {
  const TriangleMesh mesh = makeSphere({0, 0, 0}, 1);
  testing::expectReportsAndStops(
      10, [&](const Progress& progress) { return render(mesh, quick(), progress); });
}

TEST(Render, RefusesWhatIsOutOfRange) {
  const TriangleMesh mesh = makeSphere({0, 0, 0}, 1);
  const auto refused = [&](auto change) {
    RenderOptions options = quick();
    change(options);
    EXPECT_THROW(render(mesh, options), InputError);
  };
  refused([](RenderOptions& o) { o.width = 0; });
  refused([](RenderOptions& o) { o.height = 20000; });
  refused([](RenderOptions& o) { o.samples = 0; });
  refused([](RenderOptions& o) { o.view.elevation = 2; });
  EXPECT_THROW(render(TriangleMesh{}, quick()), InputError);
}

TEST(ViewFromName, KnowsNamesAndAnglesAndSaysSo) {
  EXPECT_NEAR(viewFromName("90,45").azimuth, 1.5707963, 1e-6);
  EXPECT_NEAR(viewFromName("90,45").elevation, 0.7853982, 1e-6);
  EXPECT_NEAR(viewFromName("top").elevation, 1.5707963, 1e-3);
  for (const char* bad : {"", "sideways", "1", "1,2,3", "nan,0", "0,91"}) {
    EXPECT_THROW((void)viewFromName(bad), InputError) << bad;
  }
  try {
    (void)viewFromName("sideways");
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("front"));
  }
}

TEST(SideBySide, PutsPicturesInARow) {
  Image8 a{2, 2, 3, std::vector<std::uint8_t>(12, 10)},
      b{3, 4, 3, std::vector<std::uint8_t>(36, 20)};
  const std::vector<Image8> both{a, b};
  const Image8 row = sideBySide(both, {.gap = 1});
  const Image8 standing = sideBySide(both, {.onFloor = true, .behind = kPage});
  EXPECT_EQ(standing.at(0, 1)[0], kPage[0]);
  EXPECT_EQ(standing.at(0, 2)[0], 10);
  EXPECT_EQ(row.width, 6);
  EXPECT_EQ(row.height, 4);
  EXPECT_EQ(row.at(0, 1)[0], 10);
  EXPECT_EQ(row.at(0, 0)[0], kBackground[0]);
  EXPECT_EQ(row.at(2, 2)[0], kBackground[0]);
  EXPECT_EQ(row.at(5, 3)[0], 20);
  EXPECT_THROW(sideBySide({}), InputError);
}

TEST(SideBySide, MeshesFillTheirPanelsAtOneScaleOnOneFloor) {
  RenderOptions options = quick("front");
  options.ground = false;
  options.samples = 32;
  const std::vector<TriangleMesh> meshes{makeBox({{0, 0, 0}, {2, 0.01, 1}}),
                                         makeBox({{5, 5, 5}, {9, 5.01, 7}})};
  const Image8 row = renderSideBySide(meshes, options);
  EXPECT_LE(row.width, 2 * options.width);
  EXPECT_LE(row.height, options.height);
  EXPECT_TRUE(row.width >= 2 * options.width - 3 || row.height >= options.height - 3) << row.width;
  const std::vector<Panel> panels = panelsOf(row);
  ASSERT_EQ(panels.size(), 2u);
  EXPECT_NEAR(panels[1].shown.width, 2 * panels[0].shown.width, 4) << "one scale";
  for (const Panel& panel : panels) {
    EXPECT_GT(panel.filled(), 0.7);
    EXPECT_EQ(panel.at.top + panel.at.height, row.height);
  }
  const auto floorOf = [](const Panel& panel) { return panel.shown.top + panel.shown.height; };
  EXPECT_NEAR(floorOf(panels[0]), floorOf(panels[1]), 2);
}

TEST(SideBySide, LongThinAndSmallOnesFillTheirPanelsToo) {
  const std::vector<TriangleMesh> meshes{makeBox({{0, 0, 0}, {20, 1, 1}}), makeSphere({0, 0, 0}, 1),
                                         makeBox({{0, 0, 0}, {1, 1, 12}})};
  RenderOptions options = quick();
  options.width = 320;
  options.height = 240;
  const std::vector<Panel> panels = panelsOf(renderSideBySide(meshes, options));
  ASSERT_EQ(panels.size(), 3u);
  for (const Panel& panel : panels) EXPECT_GT(panel.filled(), 0.6);
}

TEST(SideBySide, APanelThatIsNotFilledIsFound) {
  Image8 loose{100, 60, 3, std::vector<std::uint8_t>(18000, kBackground[0])};
  for (int y = 20; y < 50; ++y)
    for (int x = 10; x < 70; ++x) loose.at(x, y)[1] = 30;
  const std::vector<Image8> two{loose, Image8{10, 20, 3, std::vector<std::uint8_t>(600, 0)}};
  const std::vector<Panel> panels =
      panelsOf(sideBySide(two, {.gap = 4, .onFloor = true, .behind = kPage}));
  ASSERT_EQ(panels.size(), 2u);
  EXPECT_DOUBLE_EQ(panels[0].filled(), 0.3);
  EXPECT_EQ(panels[1].at.left, 104);
  EXPECT_EQ(panels[1].at.top, 40);
}

TEST(SideBySide, OneMeshAloneHasThePictureThatItHadWithoutTheRow) {
  const std::vector<TriangleMesh> one{makeBox({{0, 0, 0}, {2, 1, 1}})};
  EXPECT_EQ(renderSideBySide(one, quick()).pixels, render(one[0], quick()).pixels);
}

TEST(Render, ACropIsThatPartOfThePicture) {
  const TriangleMesh box = makeBox({{0, 0, 0}, {2, 1, 1}});
  RenderOptions options = quick();
  options.samples = 64;
  const Image8 whole = render(box, options);
  options.crop = Crop{40, 30, 64, 50};
  const Image8 part = render(box, options);
  ASSERT_EQ(part.width, 64);
  ASSERT_EQ(part.height, 50);
  double apart = 0;
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x)
      apart += std::abs(luminance(part, x, y) - luminance(whole, x + 40, y + 30));
  }
  EXPECT_LT(apart / (64 * 50), 3) << "but for the noise";
}

}  // namespace
}  // namespace exemplar
