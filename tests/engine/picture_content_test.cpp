// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What pictures of many kinds become: made here, and synthesized as windows of 3 x 3 pixels.

#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "core/random.h"
#include "engine/engines.h"
#include "voxelize/label_image.h"

namespace exemplar {
namespace {

/// A picture drawn with letters, the top row first.
using Rows = std::vector<std::string>;

Rows filled(int width, int height, char letter) {
  return Rows(static_cast<std::size_t>(height),
              std::string(static_cast<std::size_t>(width), letter));
}
void box(Rows& rows, int x, int y, int width, int height, char letter) {
  for (int j = y; j < y + height && j < static_cast<int>(rows.size()); ++j) {
    for (int i = x; i < x + width && i < static_cast<int>(rows[j].size()); ++i) rows[j][i] = letter;
  }
}
/// The rim of a box, one pixel wide.
void frame(Rows& rows, int x, int y, int width, int height, char letter) {
  box(rows, x, y, width, 1, letter);
  box(rows, x, y + height - 1, width, 1, letter);
  box(rows, x, y, 1, height, letter);
  box(rows, x + width - 1, y, 1, height, letter);
}

/// Ways one pixel wide between walls as wide, all of them connected.
Rows maze() {
  constexpr int kCells = 9;
  Rows rows = filled(2 * kCells + 1, 2 * kCells + 1, '#');
  const Random random(3, 1);
  std::uint64_t draw = 0;
  std::vector<Vec3i> path{{0, 0, 0}};
  rows[1][1] = '.';
  while (!path.empty()) {
    const Vec3i here = path.back();
    std::vector<Vec3i> steps;
    for (const Vec3i& step : {Vec3i{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}) {
      const Vec3i there = here + step;
      const bool inside = there.x >= 0 && there.y >= 0 && there.x < kCells && there.y < kCells;
      if (inside && rows[2 * there.y + 1][2 * there.x + 1] == '#') steps.push_back(step);
    }
    if (steps.empty()) {
      path.pop_back();
      continue;
    }
    const Vec3i step = steps[random.below(static_cast<std::uint32_t>(steps.size()), draw++)];
    rows[2 * here.y + 1 + step.y][2 * here.x + 1 + step.x] = '.';
    path.push_back(here + step);
    rows[2 * path.back().y + 1][2 * path.back().x + 1] = '.';
  }
  return rows;
}

/// Closed lines on the ground: each a rectangle's left, top, width and height.
Rows frames(int width, int height, const std::vector<std::array<int, 4>>& lines) {
  Rows rows = filled(width, height, '.');
  for (const auto& [x, y, wide, high] : lines) frame(rows, x, y, wide, high, 'b');
  return rows;
}

/// Closed lines that cross each other.
Rows knots() {
  return frames(26, 24, {{3, 3, 9, 7}, {7, 6, 8, 9}, {15, 12, 7, 7}, {4, 15, 6, 5}, {18, 3, 5, 6}});
}

Rows skyline() {
  Rows rows = filled(34, 24, 's');
  const int heights[] = {9, 14, 7, 17, 11, 13};
  for (int n = 0; n < 6; ++n) {
    const int x = 1 + 5 * n + n / 2, top = 22 - heights[n];
    box(rows, x, top, 4, heights[n], 't');
    for (int y = top + 1; y < 21; y += 2) rows[y][x + 1] = 'y';
  }
  box(rows, 0, 22, 34, 2, 'o');
  return rows;
}

Rows flowers() {
  Rows rows = filled(28, 18, 's');
  box(rows, 0, 14, 28, 4, 'o');
  const int heights[] = {5, 8, 6, 9, 4};
  for (int n = 0; n < 5; ++n) {
    const int x = 3 + 5 * n, top = 13 - heights[n];
    box(rows, x, top + 1, 1, heights[n], 'g');
    rows[top][x] = n % 2 ? 'r' : 'y';
  }
  return rows;
}

Rows circuit() {
  Rows rows = filled(26, 26, 'g');
  for (const auto& [x, y] : {std::pair{3, 3}, {15, 5}, {6, 15}, {17, 17}}) {
    box(rows, x, y, 5, 4, 'k');
    for (const int pin : {0, 2, 4}) rows[y - 1][x + pin] = rows[y + 4][x + pin] = 'y';
  }
  box(rows, 5, 8, 1, 3, 'y');
  box(rows, 5, 10, 4, 1, 'y');
  box(rows, 8, 10, 1, 4, 'y');
  box(rows, 17, 10, 1, 3, 'y');
  box(rows, 17, 12, 3, 1, 'y');
  box(rows, 19, 12, 1, 4, 'y');
  return rows;
}

Rows bricks() {
  Rows rows = filled(24, 18, 'r');
  for (int y = 0; y < 18; ++y) {
    if (y % 3 == 2) box(rows, 0, y, 24, 1, '.');
    for (int x = 5 - y / 3 % 2 * 3; x < 24; x += 6) rows[y][x] = '.';
  }
  return rows;
}

Rows cave() {
  Rows rows = filled(26, 26, '.');
  const Random random(5, 1);
  for (int y = 0; y < 26; ++y) {
    for (int x = 0; x < 26; ++x)
      if (random.uniform(static_cast<std::uint64_t>(26 * y + x)) < 0.46) rows[y][x] = '#';
  }
  for (int round = 0; round < 4; ++round) {
    const Rows before = rows;
    for (int y = 0; y < 26; ++y) {
      for (int x = 0; x < 26; ++x) {
        int walls = 0;
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i)
            walls += before[(y + j + 26) % 26][(x + i + 26) % 26] == '#';
        rows[y][x] = walls >= 5 ? '#' : '.';
      }
    }
  }
  return rows;
}

Rows platforms() {
  Rows rows = filled(32, 16, 's');
  for (int x = 0; x < 32; ++x) {
    const int height = 3 + x / 8 % 3;
    box(rows, x, 16 - height, 1, height, 'o');
    rows[15 - height][x] = 'g';
  }
  box(rows, 4, 7, 4, 1, 'r');
  box(rows, 14, 5, 5, 1, 'r');
  box(rows, 22, 6, 3, 1, 'r');
  return rows;
}

Rows rings() {
  return frames(22, 20,
                {{2, 2, 5, 4}, {10, 3, 4, 4}, {3, 10, 4, 6}, {10, 11, 7, 4}, {17, 5, 3, 3}});
}

/// Flowers with much around them: most windows of the border show none.
Rows dots() {
  Rows rows = filled(12, 12, '.');
  for (const auto& [x, y] : {std::pair{3, 3}, {8, 5}, {4, 8}}) {
    box(rows, x - 1, y, 3, 1, 'y');
    box(rows, x, y - 1, 1, 3, 'y');
    rows[y][x] = 'r';
  }
  return rows;
}

/// A shore that winds, water on its left.
Rows coast() {
  Rows rows = filled(28, 24, 'b');
  for (int y = 0; y < 24; ++y) {
    const int at = 9 + (y / 3 % 4 == 3 ? 1 : y / 3 % 4);
    box(rows, at, y, 3, 1, 'y');
    box(rows, at + 3, y, 28, 1, 'g');
  }
  return rows;
}

Rows chessWithCracks() {
  Rows rows = filled(24, 24, '.');
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x)
      if ((x / 3 + y / 3) % 2) rows[y][x] = '#';
  }
  for (const auto& [x, y] : {std::pair{4, 4}, {13, 7}, {19, 16}, {7, 19}}) rows[y][x] = 'r';
  return rows;
}

Image8 imageOf(const Rows& rows) {
  static const std::map<char, std::array<std::uint8_t, 3>> colors{
      {'.', {240, 240, 235}}, {'#', {40, 40, 50}},   {'r', {200, 60, 50}}, {'g', {70, 150, 70}},
      {'b', {60, 90, 190}},   {'y', {230, 200, 60}}, {'o', {150, 90, 40}}, {'s', {130, 190, 240}},
      {'k', {10, 10, 10}},    {'t', {110, 110, 110}}};
  Image8 image{static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), 3, {}};
  for (const std::string& row : rows) {
    for (const char letter : row)
      image.pixels.insert(image.pixels.end(), colors.at(letter).begin(), colors.at(letter).end());
  }
  return image;
}

using Color = std::array<std::uint8_t, 3>;
Color colorAt(const Image8& image, int x, int y) {
  const std::uint8_t* pixel = image.at(x, y);
  return {pixel[0], pixel[1], pixel[2]};
}

std::map<Color, double> shares(const Image8& image) {
  std::map<Color, double> shares;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      shares[colorAt(image, x, y)] += 1.0 / (image.width * image.height);
  return shares;
}

std::set<std::vector<Color>> windows(const Image8& image) {
  std::set<std::vector<Color>> all;
  for (int y = 0; y + 3 <= image.height; ++y) {
    for (int x = 0; x + 3 <= image.width; ++x) {
      std::vector<Color> window;
      for (int k = 0; k < 9; ++k) window.push_back(colorAt(image, x + k % 3, y + k / 3));
      all.insert(window);
    }
  }
  return all;
}

/// Of the pixels that differ from the one above and the one beside, the share that goes on
/// diagonally both ways: streaks.
double streaks(const Image8& image) {
  int edges = 0, streaks = 0;
  for (int y = 1; y + 1 < image.height; ++y) {
    for (int x = 1; x + 1 < image.width; ++x) {
      const Color here = colorAt(image, x, y);
      if (here == colorAt(image, x, y - 1) || here == colorAt(image, x - 1, y)) continue;
      ++edges;
      const auto same = [&](int i, int j) { return colorAt(image, x + i, y + j) == here; };
      streaks += (same(-1, -1) && same(1, 1)) || (same(-1, 1) && same(1, -1));
    }
  }
  return edges > 0 ? double(streaks) / edges : 0;
}

struct Kind {
  const char* name;
  Rows (*draw)();
  Axes directed;  // along which the picture has two different ends
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

class PictureContent : public testing::TestWithParam<Kind> {};

TEST_P(PictureContent, IsThePicturesKind) {
  const Image8 picture = imageOf(GetParam().draw());
  ImageLabels labels = labelsFromImage(picture, "p.png", {.piece = 3, .overlap = true});
  Example example;
  example.source = "p.png";
  example.kind = SourceKind::Picture;
  example.reading.form = Form::Labels;
  example.data = labels.grid;
  example.content = labels;
  const std::map<Color, double> wanted = shares(picture);
  for (const std::uint64_t seed : {1, 2}) {
    Request request;
    // Where there is one horizon a picture of another height has other shares.
    const Axes directed = GetParam().directed;
    request.extent.size =
        Vec3i{directed.x ? picture.width - 2 : 46, directed.y ? picture.height - 2 : 46, 1};
    request.seed = seed;
    const Result result = modelEngine().run({&example, 1}, request);
    ASSERT_EQ(result.outcome, Outcome::Complete);
    const Image8 made = imageFromLabels(result.labels(), labels);
    const auto known = windows(picture);
    for (const auto& window : windows(made)) EXPECT_TRUE(known.contains(window));
    // Half the sum of the differences: a color that fills what another one should is twice in it.
    std::map<Color, double> found = shares(made);
    double difference = 0;
    for (const auto& [color, share] : wanted) difference += std::abs(found[color] - share) / 2;
    // A single shore or horizon may stand two columns of 28 further on.
    EXPECT_LE(difference, directed.any() ? 0.1 : 0.08) << seed;
    for (const auto& [color, share] : wanted) {
      if (share > 0.03) {  // lines, which are the rarest, least exactly
        EXPECT_NEAR(found[color] / share, 1, 0.3) << seed;
      }
    }
    EXPECT_LE(streaks(made), streaks(picture) + 0.15) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, PictureContent,
                         testing::Values(Kind{"maze", maze, {}}, Kind{"knots", knots, {}},
                                         Kind{"skyline", skyline, {false, true, false}},
                                         Kind{"flowers", flowers, {false, true, false}},
                                         Kind{"circuit", circuit, {}}, Kind{"bricks", bricks, {}},
                                         Kind{"cave", cave, {}},
                                         Kind{"platforms", platforms, {false, true, false}},
                                         Kind{"rings", rings, {}}, Kind{"dots", dots, {}},
                                         Kind{"coast", coast, {true, false, false}},
                                         Kind{"chess", chessWithCracks, {}}),
                         [](const auto& kind) { return std::string(kind.param.name); });

TEST(PictureEnds, AreFreeWhereNothingFits) {
  // Rows in pairs: 7 of them cannot begin with one kind and end with the other.
  Rows rows = filled(12, 8, 'b');
  for (int y = 0; y < 8; y += 2) box(rows, 0, y, 12, 1, 'y');
  ImageLabels labels = labelsFromImage(imageOf(rows), "p.png", {});
  Example example;
  example.source = "p.png";
  example.kind = SourceKind::Picture;
  example.reading.form = Form::Labels;
  example.data = labels.grid;
  example.content = labels;
  for (const int height : {7, 10}) {
    Request request;
    request.extent.size = Vec3i{9, height, 1};
    const Result result = modelEngine().run({&example, 1}, request);
    ASSERT_EQ(result.outcome, Outcome::Complete) << height;
    const Array3D<Label>& cells = result.labels().cells;
    EXPECT_EQ(cells(0, 0, 0) != cells(0, height - 1, 0), height % 2 == 0);
  }
}

}  // namespace
}  // namespace exemplar
