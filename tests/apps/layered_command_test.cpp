// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

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
      runExemplar(kSynth + "--layers-from l_example.png --paint l.png --paint-levels 0 -o p.png",
                  folder.path());
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
        {"-o o.png --paint-levels 2", "has no effect without --paint"},
        {"-o o.png --inpaint h.png", "the result has the example's size; leave out --size"},
        {"-o o.png --coherence 2", "only --texture classic has it"},
        {"-o o.png --texture classic --evenness 2", "only --texture patches has it"},
        {"-o o.png --regions --joint", "is of layers on each other"},
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

TEST(LayeredCommand, FillsTheWhiteOfAPictureAndNothingElse) {
  const TestFolder folder;
  writePictures(folder);
  const auto mask = [&](const char* name, int width, int left, int right) {
    Image8 image{width, 40, 1, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * 40)};
    for (int y = 10; y < 20; ++y)
      for (int x = left; x < right; ++x) *image.at(x, y) = 255;
    writePng(folder / name, image);
  };
  mask("hole.png", 48, 18, 30);
  mask("none.png", 48, 0, 0);
  mask("narrow.png", 40, 18, 30);
  writePng(folder / "all.png", Image8{48, 40, 1, std::vector<std::uint8_t>(48 * 40, 255)});
  const std::string synth = "synth e.png --engine layered --layers 2 --neighborhood 5 -o o.png ";
  for (const auto& [arguments, says] :
       {std::pair{"--inpaint none.png", "none.png: nothing is white"},
        {"--inpaint all.png", "all.png: all is white"},
        {"--inpaint narrow.png", "narrow.png: 40 x 40 pixels; e.png has 48 x 40 pixels"},
        {"--inpaint e.png", "e.png: has colors; what is to be filled is said in black and white"},
        {"--inpaint hole.png --paint h.png", "give one of the two"}}) {
    const auto run = runExemplar(synth + arguments, folder.path());
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_THAT(run.err, HasSubstr(says));
  }
  const auto run = runExemplar(synth + "--inpaint hole.png", folder.path());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err.find("has grays"), std::string::npos) << run.err;
  const Image8 was = decodeImage(readFile(folder / "e.png"), "e.png");
  const Image8 is = decodeImage(readFile(folder / "o.png"), "o.png");
  ASSERT_EQ(is.width, 48);
  ASSERT_EQ(is.height, 40);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 48; ++x) {
      if (x >= 18 && x < 30 && y >= 10 && y < 20) continue;
      for (int c = 0; c < 3; ++c) ASSERT_EQ(is.at(x, y)[c], was.at(x, y)[c]);
    }
  }
}

TEST(LayeredCommand, RefusesLayerMapsThatAreNone) {
  const TestFolder folder;
  writePictures(folder);
  Image<std::uint16_t> deep{48, 40, 1, {}};
  for (int p = 0; p < 48 * 40; ++p) deep.pixels.push_back(static_cast<std::uint16_t>(p));
  writePng(folder / "deep.png", deep);
  writePng(folder / "gray.png", Image8{64, 56, 1, std::vector<std::uint8_t>(64 * 56, 100)});
  for (const auto& [arguments, says] :
       {std::pair{"-o o.png --layers-from deep.png", "deep.png: has grays of 16 bits"},
        {"-o o.png --paint gray.png", "gray.png: no layer has the gray 100; they are 0, 255"}}) {
    const auto run = runExemplar(kSynth + arguments, folder.path());
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_THAT(run.err, HasSubstr(says));
  }
}

TEST(LayeredCommand, SaysWhichPicturesCannotBeLayered) {
  const TestFolder folder;
  writePictures(folder);
  writePng(folder / "small.png",
           Image8{5, 4, 1, std::vector<std::uint8_t>{0, 9, 0, 9, 0, 9, 0, 9, 0, 9,
                                                     0, 9, 0, 9, 0, 9, 0, 9, 0, 9}});
  writePng(folder / "narrow.png", Image8{40, 40, 1, std::vector<std::uint8_t>(40 * 40, 3)});
  const std::string files = folder.files();
  for (const auto& [arguments, says] :
       {std::pair{"h.png --layers 3", "--layers 3: the example has 2 colors"},
        {"small.png --layers 2", "the example is 4 cells wide, and patches of 5 cells"},
        {"e.png --channel height=narrow.png", "narrow.png: 40 x 40 pixels, and e.png has 48 x 40"},
        {"e.png --kind heights", "e.png is colored; heights are gray"},
        {"e.png --layers 9", "--layers 9: expected 2 to 8"},
        {"e.png --layers-from narrow.png", "narrow.png: 40 x 40 pixels; it must have the size of"},
        {"h.png --layers-from none.png", "none.png"}}) {
    SCOPED_TRACE(arguments);
    const auto run = runExemplar("synth " + std::string(arguments) + " --engine layered -o o.png",
                                 folder.path());
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_THAT(run.err, HasSubstr(says));
    // One line, after those of progress.
    const std::size_t error = run.err.find("exemplar: ");
    ASSERT_NE(error, std::string::npos);
    EXPECT_EQ(run.err.find('\n', error), run.err.size() - 1) << run.err;
    EXPECT_EQ(folder.files(), files);
  }
}

TEST(LayeredCommand, DropsOpacityAndSaysSoAndKeepsSixteenBits) {
  const TestFolder folder;
  Image8 clear{40, 40, 4, {}}, opaque{40, 40, 3, {}};
  Image<std::uint16_t> deep{40, 40, 1, {}};
  for (int p = 0; p < 40 * 40; ++p) {
    const bool disc = p % 40 / 8 % 2 != p / 40 / 8 % 2;
    const auto at = static_cast<std::uint8_t>(p * 7 % 16);
    for (const int c : {disc ? 200 : 30, 80 + at, 60}) {
      opaque.pixels.push_back(static_cast<std::uint8_t>(c));
      clear.pixels.push_back(static_cast<std::uint8_t>(c));
    }
    clear.pixels.push_back(static_cast<std::uint8_t>(100 + at));
    deep.pixels.push_back(static_cast<std::uint16_t>((disc ? 40001 : 9002) + 3 * at));
  }
  writePng(folder / "clear.png", clear);
  writePng(folder / "opaque.png", opaque);
  writePng(folder / "deep.png", deep);
  const std::string rest =
      " --engine layered --layers 2 --neighborhood 5 --texture-rounds 1 --size 40,40,1 -o ";
  const auto run = runExemplar("synth clear.png" + rest + "a.png", folder.path());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("clear.png: opacity is not synthesized and was dropped"));
  ASSERT_EQ(runExemplar("synth opaque.png" + rest + "b.png", folder.path()).status, 0);
  EXPECT_EQ(readFile(folder / "a.png"), readFile(folder / "b.png"));
  // Sixteen bits stay: every value is one of the example's.
  ASSERT_EQ(runExemplar("synth deep.png --kind texture" + rest + "c.png", folder.path()).status, 0);
  const std::set<std::uint16_t> known(deep.pixels.begin(), deep.pixels.end());
  const auto made = decodePng16(readFile(folder / "c.png"), "c.png");
  for (const std::uint16_t value : made.pixels) ASSERT_TRUE(known.contains(value)) << value;
}

/// A picture of 24 x 24 pixels of two bits, whose four colors are in a palette.
const char* const kPalette =
    "89504e470d0a1a0a0000000d49484452000000180000001802030000009d19d56b0000000c504c54451e503c"
    "26543cc85a3cc05640ab825e7d000000234944415478da631094de0d440c0c5cab40081f6ff74641206258b5"
    "0084f0f2686026002ce434990c85c3180000000049454e44ae426082";
constexpr std::uint8_t kPaletteColors[4][3] = {
    {30, 80, 60}, {38, 84, 60}, {200, 90, 60}, {192, 86, 64}};

TEST(LayeredCommand, TakesPalettesAsTheirColors) {
  const TestFolder folder;
  std::string bytes;
  for (const char* digit = kPalette; *digit != 0; digit += 2)
    bytes.push_back(static_cast<char>(std::stoi(std::string(digit, 2), nullptr, 16)));
  writeFile(folder / "palette.png", bytes);
  Image8 plain{24, 24, 3, {}};
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x)
      for (const std::uint8_t c : kPaletteColors[(x / 6 + y / 6) % 2 * 2 + (x * y + x) % 2])
        plain.pixels.push_back(c);
  writePng(folder / "plain.png", plain);
  for (const std::string name : {"palette", "plain"}) {
    const auto run = runExemplar("synth " + name +
                                     ".png --engine layered --layers 2 --neighborhood 5 "
                                     "--texture-rounds 1 --size 24,24,1 -o " +
                                     name + "_more.png",
                                 folder.path());
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err.find("warning"), std::string::npos) << run.err;  // nothing is lost
  }
  EXPECT_EQ(readFile(folder / "palette_more.png"), readFile(folder / "plain_more.png"));
}

TEST(LayeredCommand, RefusesMasksAndLayerMapsThatAreClearSomewhere) {
  const TestFolder folder;
  writePictures(folder);
  const auto clear = [&](const char* name, int width, int height) {
    Image8 image{width, height, 2, {}};
    for (int p = 0; p < width * height; ++p) {
      image.pixels.push_back(p % 7 < 3 ? 255 : 0);
      image.pixels.push_back(p % 5 == 0 ? 0 : 255);
    }
    writePng(folder / name, image);
  };
  clear("c.png", 48, 40);
  clear("p.png", 64, 56);
  const std::string synth = "synth e.png --engine layered --layers 2 --neighborhood 5 -o o.png ";
  for (const auto& [arguments, says] :
       {std::pair{"--inpaint c.png", "c.png: is clear in places"},
        {"--layers-from c.png", "c.png: is clear in places"},
        {"--size 64,56,1 --paint p.png", "p.png: is clear in places"}}) {
    const auto run = runExemplar(synth + arguments, folder.path());
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_THAT(run.err, HasSubstr(says));
  }
  EXPECT_EQ(folder.files(), "c.png e.png h.png p.png");
}

TEST(LayeredCommand, MakesVolumesOfLabels) {
  const TestFolder folder;
  writeFile(folder / "v.toml",
            "kind = \"volume\"\nsize = [20, 20, 20]\n[[layer]]\nname = \"air\"\n"
            "[[layer]]\nname = \"stone\"\ncolor = \"#808080\"\nshare = 0.5\nfeature = 8\n"
            "[[layer]]\nname = \"moss\"\ncolor = \"#40a040\"\nshare = 0.2\nwithin = 2\n");
  ASSERT_EQ(runExemplar("scene v.toml -o v.vdb", folder.path()).status, 0);
  const auto run = runExemplar(
      "synth v.vdb --engine layered --size 24,22,20 -o o.vdb --stats s.json", folder.path());
  ASSERT_EQ(run.status, 0) << run.err;
  const auto stats = nlohmann::json::parse(readFile(folder / "s.json"));
  EXPECT_EQ(stats["engine"], "layered-volume");
  EXPECT_EQ(stats["layer_count"], 3);
  EXPECT_NEAR(stats["layers"]["layer2_area_error"].get<double>(), 0, 1e-3);
  const auto measured = runExemplar("measure v.vdb o.vdb --layers --json -", folder.path());
  ASSERT_EQ(measured.status, 0) << measured.err;
  EXPECT_EQ(nlohmann::json::parse(measured.out)["layers"], stats["layers"]);
  for (const auto& [arguments, says] :
       {std::pair{"--order air,stone", "the label moss is in none of the layers"},
        {"--order air,stone+clay,moss", "there is no label clay"},
        {"--order air+stone+moss", "1 layer; 2 to 8 are made"},
        {"--size 20,20,1", "the result of a volume is a volume"}}) {
    SCOPED_TRACE(arguments);
    const auto wrong = runExemplar(
        "synth v.vdb --engine layered -o o.vox " + std::string(arguments), folder.path());
    EXPECT_EQ(wrong.status, 2) << wrong.err;
    EXPECT_THAT(wrong.err, HasSubstr(says));
  }
}

TEST(LayeredCommand, APictureOfOneColorHasNoLayers) {
  const TestFolder folder;
  writePng(folder / "e.png", Image8{32, 32, 3, std::vector<std::uint8_t>(3 * 32 * 32, 77)});
  const auto run = runExemplar(kSynth + "-o o.png", folder.path());
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_THAT(run.err, HasSubstr("the example has one color, and so no layers"));
  EXPECT_EQ(folder.files(), "e.png");
}

}  // namespace
}  // namespace exemplar
