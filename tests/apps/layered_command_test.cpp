// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/file.h"
#include "mesh/image.h"
#include "tests/apps/run_command.h"

namespace exemplar {
namespace {

using testing::HasSubstr;

/// Discs on ground, in color, and which is which as a second picture.
void writePictures(const TestFolder& folder) {
  Image8 color{48, 40, 3, {}}, height{48, 40, 1, {}};
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 48; ++x) {
      const int dx = x % 16 - 8, dy = y % 13 - 6;
      const bool disc = dx * dx + dy * dy < 20;
      for (const int c : {disc ? 200 : 40, 90, 60 + (7 * x + 3 * y) % 5})
        color.pixels.push_back(static_cast<std::uint8_t>(c));
      height.pixels.push_back(disc ? 255 : 0);
    }
  }
  writePng(folder / "e.png", color);
  writePng(folder / "h.png", height);
}

const std::string kSynth =
    "synth e.png --engine layered --layers 2 --neighborhood 5 --size 64,56,1 ";

TEST(LayeredCommand, WritesAlignedPicturesAndLayersThatCanBeGivenBack) {
  const TestFolder folder;
  writePictures(folder);
  const auto run =
      runExemplar(kSynth + "--channel height=h.png -o o.png --write-layers l.png --stats s.json",
                  folder.path());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(folder.files(), "e.png h.png l.png l_example.png o.png o_height.png s.json");
  const auto stats = nlohmann::json::parse(readFile(folder / "s.json"));
  EXPECT_EQ(stats["layer_count"], 2);
  EXPECT_NEAR(stats["layers"]["layer2_area_error"].get<double>(), 0, 1e-3);
  const auto measured = runExemplar("measure l_example.png l.png --layers --json -", folder.path());
  ASSERT_EQ(measured.status, 0) << measured.err;
  EXPECT_EQ(nlohmann::json::parse(measured.out)["layers"], stats["layers"]);
  // The same layers, given back, are the same result.
  const auto again =
      runExemplar(kSynth + "--layers-from l_example.png --paint l.png -o p.png", folder.path());
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(readFile(folder / "p.png"), readFile(folder / "o.png"));
}

TEST(LayeredCommand, OverwritesNothingAndSaysWhatIsWrong) {
  const TestFolder folder;
  writePictures(folder);
  for (const auto& [arguments, says] :
       {std::pair{"-o e.png", "e.png: is read or written already"},
        {"-o o.png --write-layers o.png", "o.png: is read or written already"},
        {"-o o.png --channel height=h.png --preview o_height.png", "o_height.png: is read or"},
        {"-o h.png --channel height=h.png", "h.png: is read or written already"},
        {"-o o.png --layers-from h.png --write-layers h.png", "h.png: is read or written"},
        {"-o o.png --channel ../x=h.png", "a name is of letters"},
        {"-o o.png --channel color=h.png", "the name of the first picture"},
        {"-o o.png --paint h.png", "64 x 56, as --size says"},
        {"-o o.png --layers-from e.png", "a layer map is gray"},
        {"-o o.png --order 1,1", "expected each of 1 to 2 once"},
        {"-o o.png --orientations 3", "expected 1, 2, 4 or 8"},
        {"-o o.png --shape-patch 10", "expected an odd number"},
        {"-o o.obj", "use one of .png"},
        {"-o o.png --report r.html", "--report: a page shows surfaces"}}) {
    SCOPED_TRACE(arguments);
    const auto run = runExemplar(kSynth + arguments, folder.path());
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_THAT(run.err, HasSubstr(says));
    EXPECT_EQ(folder.files(), "e.png h.png");
  }
}

TEST(LayeredCommand, APictureOfOneColorHasNoLayers) {
  const TestFolder folder;
  writePng(folder / "e.png", Image8{32, 32, 3, std::vector<std::uint8_t>(3 * 32 * 32, 77)});
  const auto run = runExemplar(kSynth + "-o o.png", folder.path());
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_THAT(run.err, HasSubstr("fewer than 2 different regions"));
  EXPECT_EQ(folder.files(), "e.png");
}

}  // namespace
}  // namespace exemplar
