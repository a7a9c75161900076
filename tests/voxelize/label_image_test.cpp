// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/label_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "core/cells.h"
#include "core/error.h"
#include "core/random.h"
#include "tests/voxelize/error_of.h"
#include "tests/voxelize/hears_cancellation.h"

namespace exemplar {
namespace {

using test::errorOf;
using testing::HasSubstr;

/// RGBA pixels drawn from four colors, one of them transparent.
Image8 randomImage(int width, int height, std::uint64_t seed) {
  const std::array<std::uint8_t, 4> colors[] = {
      {0, 0, 0, 255}, {255, 0, 0, 255}, {10, 20, 30, 255}, {0, 0, 0, 0}};
  const Random random(seed, 0x1a6e);
  Image8 image{width, height, 4, {}};
  for (int n = 0; n < width * height; ++n) {
    for (const std::uint8_t c : colors[random.below(4, n)]) image.pixels.push_back(c);
  }
  return image;
}

TEST(LabelsFromImage, EachColorIsALabelAndYIsUp) {
  // From the top: red, green / green, transparent.
  const Image8 image{2, 2, 4, {255, 0, 0, 255, 0, 255, 0, 255, 0, 255, 0, 255, 9, 9, 9, 0}};
  const LabelGrid grid = labelsFromImage(image, "f").grid;
  EXPECT_EQ(grid.size(), (Vec3i{2, 2, 1}));
  EXPECT_EQ(grid.labelCount(), 3);
  EXPECT_EQ(grid.cells(0, 1, 0), 0);
  EXPECT_EQ(grid.cells(1, 1, 0), 1);
  EXPECT_EQ(grid.cells(0, 0, 0), 1);
  EXPECT_EQ(grid.cells(1, 0, 0), 2);
  EXPECT_EQ(grid.labels[0].color, (std::array<float, 4>{1, 0, 0, 1}));
  EXPECT_TRUE(isEmpty(grid.labels[2]));
}

TEST(LabelsFromImage, PicturesOfAnyChannelsAgree) {
  const Image8 gray{2, 1, 1, {7, 200}};
  const Image8 rgb{2, 1, 3, {7, 7, 7, 200, 200, 200}};
  EXPECT_EQ(labelsFromImage(gray, "f").grid.labels[1].color,
            labelsFromImage(rgb, "f").grid.labels[1].color);
}

TEST(LabelsFromImage, PiecesArePutBackAsTheyWere) {
  const Image8 image = randomImage(12, 8, 1);
  for (const int piece : {1, 2, 4}) {
    const ImageLabels labels = labelsFromImage(image, "f", {.piece = piece});
    EXPECT_EQ(labels.grid.size(), (Vec3i{12 / piece, 8 / piece, 1}));
    EXPECT_EQ(imageFromLabels(labels.grid, labels).pixels, image.pixels) << piece;
  }
}

TEST(LabelsFromImage, PiecesThatOverlapArePutBackAsTheyWere) {
  const Image8 image = randomImage(11, 7, 2);
  for (const int piece : {1, 2, 3}) {
    const ImageLabels labels = labelsFromImage(image, "f", {.piece = piece, .overlap = true});
    EXPECT_EQ(labels.grid.size(), (Vec3i{12 - piece, 8 - piece, 1}));
    EXPECT_EQ(imageFromLabels(labels.grid, labels).pixels, image.pixels) << piece;
  }
}

TEST(LabelsFromImage, APeriodicPictureHasAPieceAtEveryPixel) {
  const Image8 image = randomImage(7, 5, 4);
  const ImageLabels labels =
      labelsFromImage(image, "f", {.piece = 3, .overlap = true, .periodic = {true, true, false}});
  EXPECT_EQ(labels.grid.size(), (Vec3i{7, 5, 1}));
  // Its period is itself; rolled by some cells it is the picture rolled.
  EXPECT_EQ(imageFromLabels(labels.grid, labels, {}, {true, true, false}).pixels, image.pixels);
  LabelGrid rolled = labels.grid;
  forEachCell(rolled.size(), [&](const Vec3i& p) {
    rolled.cells[p] = labels.grid.cells((p.x + 3) % 7, (p.y + 2) % 5, 0);
  });
  const Image8 back = imageFromLabels(rolled, labels, {}, {true, true, false});
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) {
      const auto* there = image.at((x + 3) % 7, (y + 5 - 2) % 5);
      EXPECT_TRUE(std::equal(there, there + 4, back.at(x, y))) << x << ", " << y;
    }
  }
  EXPECT_THAT(errorOf([&] {
                (void)labelsFromImage(image, "f", {.piece = 2, .periodic = {true, false, false}});
              }),
              HasSubstr("not whole pieces"));
}

TEST(ImageAdjacency, PiecesThatAgreeInWhatTheyShareAreNeighbors) {
  int more = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const Image8 image = randomImage(12, 10, 20 + trial);
    ImageLabels labels = labelsFromImage(image, "f", {.piece = 2 + trial % 2, .overlap = true});
    const int side = labels.options.piece;
    const Adjacency adjacency = imageAdjacency({&labels.grid, 1}, labels);
    const Adjacency seen = findAdjacency(labels.grid);
    for (int axis = 0; axis < 2; ++axis) {
      for (int a = 0; a < adjacency.labelCount; ++a) {
        for (int b = 0; b < adjacency.labelCount; ++b) {
          // Pixels of b lie one to the right of, or one above, those of a.
          bool agree = true;
          for (int y = axis; y < side; ++y) {
            for (int x = 0; x + 1 - axis < side; ++x) {
              const auto* p = labels.pieces[a].at(axis == 0 ? x + 1 : x, axis == 0 ? y : y - 1);
              const auto* q = labels.pieces[b].at(x, y);
              agree = agree && std::equal(p, p + 4, q);
            }
          }
          const Label first = static_cast<Label>(a), second = static_cast<Label>(b);
          ASSERT_EQ(adjacency.rules[axis].allows(first, second), agree);
          if (seen.rules[axis].allows(first, second)) {
            EXPECT_EQ(adjacency.rules[axis].count(first, second),
                      seen.rules[axis].count(first, second));
          } else {
            more += agree;
          }
        }
      }
    }
    labels.options.seen = true;
    EXPECT_EQ(imageAdjacency({&labels.grid, 1}, labels).rules[0].pairs, seen.rules[0].pairs);
  }
  EXPECT_GT(more, 0) << "pictures do not show all that agree";
}

/// The picture mirrored left and right, or turned a quarter counterclockwise.
Image8 mirrored(const Image8& image) {
  Image8 other = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      std::copy_n(image.at(x, y), image.channels, other.at(image.width - 1 - x, y));
  return other;
}
Image8 quarterTurned(const Image8& image) {
  Image8 other{image.height, image.width, image.channels, image.pixels};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      std::copy_n(image.at(x, y), image.channels, other.at(y, image.width - 1 - x));
  return other;
}

TEST(LabelsFromImage, TurnedGridsAreThoseOfTheTurnedPictures) {
  for (const bool overlap : {true, false}) {
    const Image8 image = randomImage(overlap ? 9 : 8, overlap ? 7 : 6, 3);
    const ImageLabels labels =
        labelsFromImage(image, "f", {.piece = 2, .overlap = overlap, .symmetry = 8});
    ASSERT_EQ(labels.turned.size(), 7u);
    const auto drawn = [&](const LabelGrid& grid) { return imageFromLabels(grid, labels).pixels; };
    const auto pixels = [&](const Image8& picture) {
      return drawn(labelsFromImage(picture, "f", {.piece = 2, .overlap = overlap}).grid).size();
    };
    Image8 turned = image;
    const auto text = [](const std::vector<std::uint8_t>& bytes) {
      return std::string(bytes.begin(), bytes.end());
    };
    std::set<std::string> all{text(drawn(labels.grid))};
    for (int v = 1; v < 8; ++v) {
      if (v % 2 == 0) turned = quarterTurned(turned);
      const Image8 wanted = v % 2 == 1 ? mirrored(turned) : turned;
      const ImageLabels::Turned& found = labels.turned[v - 1];
      EXPECT_EQ(pixels(wanted), drawn(found.grid).size());
      const Image8 shown = imageFromLabels(found.grid, labels);
      ASSERT_EQ(shown.width, wanted.width);
      for (int y = 0; y < wanted.height; ++y)
        for (int x = 0; x < wanted.width; ++x)
          for (int c = 0; c < 3; ++c) ASSERT_EQ(shown.at(x, y)[c], wanted.at(x, y)[c]);
      all.insert(text(shown.pixels));
      EXPECT_EQ(found.upright, v < 2);
      // What is at a cell comes from where it says.
      forEachCell(found.grid.size(),
                  [&](const Vec3i& p) { EXPECT_TRUE(labels.grid.cells.contains(found.from[p])); });
    }
    EXPECT_EQ(all.size(), 8u);
  }
}

TEST(LabelsFromImage, TurnedPiecesAreFurtherExamplesOfNeighbors) {
  const ImageLabels labels =
      labelsFromImage(randomImage(8, 8, 2), "f", {.piece = 2, .overlap = true, .symmetry = 8});
  std::vector<LabelGrid> grids{labels.grid};
  for (const ImageLabels::Turned& t : labels.turned) grids.push_back(t.grid);
  const Adjacency alone = imageAdjacency({&grids[0], 1}, labels);
  const Adjacency all = imageAdjacency(grids, labels);
  double one = 0, eight = 0;
  for (const double f : alone.frequency) one += f;
  for (const double f : all.frequency) eight += f;
  EXPECT_EQ(eight, 8 * one);
}

TEST(LabelsFromImage, RefusesOtherSymmetries) {
  const Image8 image = randomImage(8, 8, 2);
  for (const int symmetry : {0, 3, 5, 16})
    EXPECT_THROW(labelsFromImage(image, "f", {.piece = 2, .symmetry = symmetry}), InputError);
  EXPECT_THROW(
      labelsFromImage(image, "f", {.piece = 2, .periodic = {true, false, false}, .symmetry = 4}),
      InputError);
}

TEST(LabelsFromImage, LeftOverPixelsLieAtTheTopAndRight) {
  const Image8 image = randomImage(5, 5, 3);
  const ImageLabels labels = labelsFromImage(image, "f", {.piece = 2});
  const Image8 back = imageFromLabels(labels.grid, labels);
  ASSERT_EQ(back.width, 4);
  ASSERT_EQ(back.height, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      EXPECT_TRUE(std::equal(back.at(x, y), back.at(x, y) + 4, image.at(x, y + 1)));
    }
  }
}

TEST(LabelsFromImage, ColorsOfAGridMakeItsPicture) {
  const Image8 image = randomImage(6, 4, 4);
  EXPECT_EQ(imageFromLabels(labelsFromImage(image, "f").grid).pixels, image.pixels);
}

TEST(LabelsFromImage, BadInputIsRefused) {
  const Image8 image = randomImage(6, 4, 4);
  const auto error = [](const Image8& picture, const ImageLabelsOptions& options) {
    return test::errorOf([&] { return labelsFromImage(picture, "f", options); });
  };
  EXPECT_THAT(error(image, {.piece = 5}), HasSubstr("f: the picture of 6 x 4 pixels is smaller"));
  EXPECT_THAT(error(image, {.piece = 0}), HasSubstr("`piece` 0: must be 1 to 256 pixels"));
  EXPECT_THAT(error(image, {.piece = 257}), HasSubstr("`piece` 257"));
  ImageLabels labels = labelsFromImage(image, "f");
  labels.grid.cells(0, 0, 0) = 77;
  EXPECT_THAT(test::errorOf([&] { return imageFromLabels(labels.grid, labels); }),
              HasSubstr("label 77"));
  LabelGrid deep = labels.grid;
  deep.cells = Array3D<Label>({2, 2, 2});
  EXPECT_THAT(test::errorOf([&] { return imageFromLabels(deep); }), HasSubstr("2 layers"));
  Image8 many{300, 300, 4, {}};
  for (int n = 0; n < 90000; ++n) {
    for (const int c : {n & 255, n >> 8 & 255, n >> 16, 255}) many.pixels.push_back(c);
  }
  EXPECT_THAT(error(many, {}), HasSubstr("more than 65536 different pieces"));
}

TEST(LabelsFromImage, HearsCancellation) {
  const Image8 image = randomImage(6, 4, 4);
  test::expectHearsCancellation(
      [&](const Progress& p) { (void)labelsFromImage(image, "f", {}, p); });
  const ImageLabels labels = labelsFromImage(image, "f");
  test::expectHearsCancellation(
      [&](const Progress& p) { (void)imageFromLabels(labels.grid, labels, p); });
  test::expectHearsCancellation([&](const Progress& p) { (void)imageFromLabels(labels.grid, p); });
}

}  // namespace
}  // namespace exemplar
