// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/image.h"
#include "mesh/jpeg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "core/file.h"
#include "core/random.h"
#include "mesh_samples.h"

namespace exemplar {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Pictures made by another encoder (Python's zlib).
const char* const kGrayOneBit =
    "89504e470d0a1a0a0000000d4948445200000005000000020100000000b8112bf00000000c4944415478da63"
    "d8c0e00100025c00f9a9919a0a0000000049454e44ae426082";
const char* const kPaletteTwoBits =
    "89504e470d0a1a0a0000000d4948445200000003000000010203000000668efc2700000009504c54450a141e"
    "28323c46505a16ac84740000000274524e5300809b2b4e180000000a4944415478da63900000001a00198000"
    "8ebb0000000049454e44ae426082";
const char* const kGraySixteenBits =
    "89504e470d0a1a0a0000000d4948445200000002000000021000000000074d8ebb000000104944415478da63"
    "6060606004c2ffff010311020132e60cf00000000049454e44ae426082";
const char* const kInterlaced =
    "89504e470d0a1a0a0000000d4948445200000003000000030802000001ae4d127e000000214944415478da0d"
    "c6311100000c8340368c2236b2da817b00d9c7dca4df5eb25c1e6b560748e9fb4f320000000049454e44ae42"
    "6082";
const char* const kHundredThousandSquared =
    "89504e470d0a1a0a0000000d49484452000186a0000186a008000000008d3954140000000b4944415478da63"
    "6064020000070004e5ed94cf0000000049454e44ae426082";
// 16 x 16, progressive: its left half is (250, 10, 20), its right half (20, 30, 240).
const char* const kProgressiveJpeg =
    "ffd8ffe000104a46494600010100000100010000ffdb0043000d090a0b0a080d0b0a0b0e0e0d0f1320151312"
    "1213271c1e17202e2931302e292d2c333a4a3e333646372c2d405741464c4e525352323e5a615a50604a5152"
    "4fffdb0043010e0e0e131113261515264f352d354f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f"
    "4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4fffc200110800100010030111000211010311"
    "01ffc40014000100000000000000000000000000000004ffc400150101010000000000000000000000000000"
    "0604ffda000c030100021003100000010ca88aa0b28ba92a82dfffc400141001000000000000000000000000"
    "00000020ffda00080101000105021fffc40014110100000000000000000000000000000020ffda0008010301"
    "013f011fffc40014110100000000000000000000000000000020ffda0008010201013f011fffc40014100100"
    "000000000000000000000000000020ffda0008010100063f021fffc400141001000000000000000000000000"
    "00000020ffda0008010100013f211fffda000c030100020003000000101c7fffc40014110100000000000000"
    "000000000000000020ffda0008010301013f101fffc40014110100000000000000000000000000000020ffda"
    "0008010201013f101fffc40014100100000000000000000000000000000020ffda0008010100013f101fffd9";

template <class Sample>
Image<Sample> noise(int width, int height, int channels) {
  Image<Sample> image{width, height, channels, {}};
  const Random random(3);
  for (int i = 0; i < width * height * channels; ++i) {
    image.pixels.push_back(static_cast<Sample>(random.bits(static_cast<std::uint64_t>(i))));
  }
  return image;
}

std::string complaint(const std::string& bytes) {
  try {
    decodeImage(bytes, "it");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(WritePng, SixteenBitsComeBackAsTheyWere) {
  const TestFolder folder("png16");
  for (int channels = 1; channels <= 4; ++channels) {
    const Image16 image = noise<std::uint16_t>(7, 5, channels);
    writePng(folder / "f.png", image);
    const Image16 read = readPng16(folder / "f.png");
    EXPECT_EQ(read.width, 7);
    EXPECT_EQ(read.height, 5);
    EXPECT_EQ(read.channels, channels);
    EXPECT_EQ(read.pixels, image.pixels);
  }
}

TEST(WritePng, EightBitsComeBackAsTheyWereAndSpreadOverSixteen) {
  const TestFolder folder("png8");
  for (int channels = 1; channels <= 4; ++channels) {
    const Image8 image = noise<std::uint8_t>(5, 7, channels);
    writePng(folder / "f.png", image);
    const Image8 read = decodeImage(readFile(folder / "f.png"), "f");
    EXPECT_EQ(read.channels, channels);
    EXPECT_EQ(read.pixels, image.pixels);
    const Image16 wide = readPng16(folder / "f.png");
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      ASSERT_EQ(wide.pixels[i], 257 * image.pixels[i]);
    }
  }
}

TEST(WritePng, GivesTheSameBytesEachTimeAndNoFileWhereThereIsNoFolder) {
  const TestFolder folder("png_bytes");
  const Image8 image = noise<std::uint8_t>(9, 9, 3);
  writePng(folder / "a.png", image);
  writePng(folder / "b.png", image);
  EXPECT_EQ(readFile(folder / "a.png"), readFile(folder / "b.png"));
  EXPECT_THROW(writePng(folder / "none/a.png", image), InputError);
}

TEST(DecodeImage, UnpacksOneBitGray) {
  const Image8 image = decodeImage(fromHex(kGrayOneBit), "it");
  EXPECT_EQ(image.channels, 1);
  EXPECT_THAT(image.pixels, ElementsAre(255, 0, 255, 255, 0, 0, 255, 0, 0, 255));
}

TEST(DecodeImage, UnpacksPalettesWithTransparency) {
  const Image8 image = decodeImage(fromHex(kPaletteTwoBits), "it");
  EXPECT_EQ(image.channels, 4);
  EXPECT_THAT(image.pixels, ElementsAre(10, 20, 30, 0, 40, 50, 60, 128, 70, 80, 90, 255));
}

TEST(DecodeImage, UndoesInterlacing) {
  const Image8 image = decodeImage(fromHex(kInterlaced), "it");
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) {
      EXPECT_EQ(image.at(x, y)[0], 100 * x);
      EXPECT_EQ(image.at(x, y)[1], 100 * y);
    }
  }
}

TEST(EncodeJpeg, IsReadAgainAsTheSamePicture) {
  Image8 image{40, 30, 3, {}};
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      for (const int value : {6 * x, 8 * y, 128})
        image.pixels.push_back(static_cast<std::uint8_t>(value));
  const std::string bytes = encodeJpeg(image, 95);
  EXPECT_EQ(bytes, encodeJpeg(image, 95));
  const Image8 again = decodeImage(bytes, "it");
  ASSERT_EQ(again.width, 40);
  ASSERT_EQ(again.height, 30);
  ASSERT_EQ(again.channels, 3);
  // A smooth picture at quality 95: steps of quantization are a few grays.
  for (std::size_t n = 0; n < image.pixels.size(); ++n)
    ASSERT_NEAR(image.pixels[n], again.pixels[n], 8) << n;
  EXPECT_LT(encodeJpeg(image, 30).size(), bytes.size());

  EXPECT_EQ(decodeImage(encodeJpeg({2, 1, 1, {10, 200}}), "it").channels, 1);
  EXPECT_THROW(encodeJpeg({0, 1, 3, {}}), InputError);
  EXPECT_THROW(encodeJpeg({1, 1, 4, {1, 2, 3, 4}}), InputError);
}

TEST(DecodeImage, ReadsJpegs) {
  const Image8 gray = decodeImage(tinyJpeg(), "it");
  EXPECT_EQ(gray.width, 8);
  EXPECT_EQ(gray.channels, 1);
  for (const std::uint8_t p : gray.pixels) EXPECT_NEAR(p, 200, 4);
  const Image8 color = decodeImage(fromHex(kProgressiveJpeg), "it");
  EXPECT_EQ(color.width, 16);
  EXPECT_EQ(color.channels, 3);
  for (int x = 0; x < 16; ++x) {
    const int left[] = {250, 10, 20}, right[] = {20, 30, 240};
    // At quality 60 a whole block of one color is off by a few levels.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(color.at(x, 9)[c], x < 8 ? left[c] : right[c], 8);
  }
}

TEST(ReadPng16, ReadsBigEndianSamples) {
  const TestFolder folder("png_known");
  writeFile(folder / "f.png", fromHex(kGraySixteenBits));
  EXPECT_THAT(readPng16(folder / "f.png").pixels, ElementsAre(0, 1, 256, 65535));
}

TEST(ReadPng16, RefusesOtherFiles) {
  const TestFolder folder("png_not");
  writeFile(folder / "f.png", tinyJpeg());
  EXPECT_THROW(readPng16(folder / "f.png"), InputError);
  EXPECT_THROW(readPng16(folder / "none.png"), InputError);
}

TEST(DecodeImage, RefusesWhatIsNotWhole) {
  EXPECT_THAT(complaint("GIF89a"), HasSubstr("it: neither a PNG nor a JPEG"));
  std::string flipped = fromHex(kGraySixteenBits);
  flipped[45] = static_cast<char>(flipped[45] ^ 1);
  EXPECT_THAT(complaint(flipped), HasSubstr("it: not a whole PNG"));
  for (const std::string& whole : {fromHex(kInterlaced), tinyJpeg(), fromHex(kProgressiveJpeg)}) {
    EXPECT_EQ(complaint(whole), "");
    // A JPEG may do without its last two bytes, the end marker.
    for (std::size_t length = 0; length + 2 < whole.size(); ++length) {
      EXPECT_NE(complaint(whole.substr(0, length)), "") << length << " of " << whole.size();
    }
  }
}

TEST(DecodeImage, RefusesAPictureThatItsBytesCannotHold) {
  EXPECT_THAT(complaint(fromHex(kHundredThousandSquared)),
              HasSubstr("68 bytes cannot hold 100000 x 100000 pixels"));
  std::string wide = tinyJpeg();
  const std::size_t frame = wide.find("\xff\xc0");
  for (int i = 5; i < 9; ++i) wide[frame + i] = '\x7f';  // 32639 x 32639
  EXPECT_THAT(complaint(wide), HasSubstr("cannot hold 32639 x 32639 pixels"));
}

TEST(DecodeImage, ReadsARealTexture) {
  const std::filesystem::path path =
      std::filesystem::path(EXEMPLAR_SOURCE_DIR) / "../shared/data/rock/rock_Rock020_1K_Color.jpg";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no real inputs beside the repository";
  const Image8 image = decodeImage(readFile(path), path.string());
  EXPECT_EQ(image.width, 1024);
  EXPECT_EQ(image.channels, 3);
}

}  // namespace
}  // namespace exemplar
