// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/volume_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/cells.h"
#include "core/error.h"
#include "core/file.h"

namespace exemplar {
namespace {

constexpr const char* kLayers =
    "kind = \"volume\"\nsize = [24, 20, 22]\nseed = 4\n"
    "[[layer]]\nname = \"air\"\n"
    "[[layer]]\nname = \"stone\"\ncolor = \"#808080\"\nshare = 0.5\nfeature = 10\n"
    "[[layer]]\nname = \"moss\"\ncolor = \"#40a040\"\nshare = 0.2\nwithin = 2\nup = 1\n";

TEST(VolumeScene, CutsEachLayerOutOfTheOneBelow) {
  EXPECT_TRUE(isVolumeScene(kLayers));
  EXPECT_FALSE(isVolumeScene("kind = \"city\"\n"));
  const LabelGrid grid = readVolumeScene(kLayers, "layers");
  EXPECT_EQ(grid.size(), (Vec3i{24, 20, 22}));
  ASSERT_EQ(grid.labelCount(), 3);
  EXPECT_TRUE(isEmpty(grid.labels[0]));
  EXPECT_EQ(grid.labels[2].name, "moss");
  const auto count = [&](Label label) { return std::ranges::count(grid.cells.values(), label); };
  const std::int64_t cells = volume(grid.size());
  EXPECT_EQ(count(0), cells / 2);
  EXPECT_EQ(count(2), std::llround(0.2 * static_cast<double>(cells / 2)));
  // Moss is near the surface, and more often open above than below.
  std::int64_t above = 0, below = 0;
  forEachCell(grid.size(), [&](const Vec3i& p) {
    if (grid.cells[p] != 2) return;
    bool near = false;
    for (int dz = -2; dz <= 2; ++dz)
      for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
          const Vec3i q = p + Vec3i{dx, dy, dz};
          near |= grid.cells.contains(q) && grid.cells[q] == 0;
        }
    EXPECT_TRUE(near);
    const Vec3i up{0, 0, 1};
    above += grid.cells.contains(p + up) && grid.cells[p + up] == 0;
    below += grid.cells.contains(p - up) && grid.cells[p - up] == 0;
  });
  EXPECT_GT(above, 2 * below);
}

TEST(VolumeScene, IsTheSameForTheSameText) {
  EXPECT_EQ(readVolumeScene(kLayers, "a").cells, readVolumeScene(kLayers, "b").cells);
}

TEST(VolumeScene, SaysWhatIsWrongWithAFile) {
  const auto error = [](const std::string& text) {
    try {
      readVolumeScene(text, "s.toml");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const std::string start = "kind = \"volume\"\n[[layer]]\n[[layer]]\n";
  EXPECT_EQ(error("kind = \"volume\"\n"), "s.toml: a volume needs two [[layer]]s or more");
  EXPECT_EQ(error(start + "share = 2\n"), "s.toml:4: 'share' must be a number from 0 to 1");
  EXPECT_EQ(error(start + "color = \"red\"\n"), "s.toml:4: 'color' must be \"#rrggbb\"");
  EXPECT_EQ(error(start + "shade = 1\n"), "s.toml:4: unknown key 'shade'");
  EXPECT_EQ(error("kind = \"volume\"\nsize = [4, 4]\n"),
            "s.toml:2: 'size' must be three numbers of cells");
  EXPECT_THAT(error("kind = \"volume\"\nsize = ["), ::testing::HasSubstr("s.toml:2: "));
}

TEST(BundledVolumes, ShowEveryLayer) {
  for (const char* name : {"minerals", "lichen"}) {
    const std::string path = std::string(EXEMPLAR_SOURCE_DIR) + "/scenes/" + name + ".toml";
    const LabelGrid grid = readVolumeScene(readFile(path), name);
    EXPECT_EQ(grid.size(), (Vec3i{64, 64, 64}));
    for (Label label = 0; label < grid.labelCount(); ++label)
      EXPECT_GT(std::ranges::count(grid.cells.values(), label), 1000) << name << label;
  }
}

}  // namespace
}  // namespace exemplar
