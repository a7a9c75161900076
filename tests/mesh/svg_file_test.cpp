// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/svg_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/temporary_files.h"

namespace exemplar {
namespace {

using testing::HasSubstr;

TEST(ReadDrawing, ReadsPolygonsRectanglesAndPaths) {
  Warnings warnings;
  const Drawing drawing = readDrawing(R"svg(<?xml version="1.0"?>
<!-- <polygon points="0,0 9,9 0,9"/> is no shape -->
<svg xmlns="http://www.w3.org/2000/svg">
  <defs><rect width="5" height="5"/></defs>
  <g fill="#102030">
    <polygon points="0,0 4,0 4,-3"/>
    <rect x="1" y="2" width="3" height="4" style="stroke:red; fill: rgb(255, 0, 9)"/>
  </g>
  <path data-material="wall" fill="red" d="M0 0h8v8H0zm2 2 l4,0 0,4-4,0 z"/>
  <rect width="3" height="3" fill="none"/>
  <text x="0" y="0">a &gt; b</text>
</svg>)svg",
                                      "test.svg", &warnings);
  ASSERT_EQ(drawing.shapes.size(), 3u);
  using Loop = std::vector<std::array<double, 2>>;
  EXPECT_EQ(drawing.shapes[0].material, "#102030");
  EXPECT_EQ(drawing.shapes[0].loops[0], (Loop{{0, 0}, {4, 0}, {4, 3}}));
  EXPECT_EQ(drawing.shapes[1].color, (std::array<std::uint8_t, 3>{255, 0, 9}));
  EXPECT_EQ(drawing.shapes[1].loops[0], (Loop{{1, -2}, {4, -2}, {4, -6}, {1, -6}}));
  EXPECT_EQ(drawing.shapes[2].material, "wall");
  ASSERT_EQ(drawing.shapes[2].loops.size(), 2u);
  EXPECT_EQ(drawing.shapes[2].loops[1], (Loop{{2, -2}, {6, -2}, {6, -6}, {2, -6}}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("2 elements"));
}

TEST(ReadDrawing, SaysWhatCannotBeRead) {
  const auto message = [](const std::string& body) {
    return test::inputError([&] { readDrawing("<svg>\n" + body + "</svg>", "a.svg"); });
  };
  EXPECT_THAT(message(""), HasSubstr("no filled polygon"));
  EXPECT_THAT(message("<path d='M0 0 C1 1 2 2 3 3z'/>"), HasSubstr("curve"));
  EXPECT_THAT(message("<circle r='3'/>"), HasSubstr("straight"));
  EXPECT_THAT(message("<polygon points='0 0 1 0 1'/>"), HasSubstr("a.svg:2"));
  EXPECT_THAT(message("<g transform='scale(2)'><rect width='1' height='1'/></g>"),
              HasSubstr("flatten"));
  EXPECT_THAT(message("<rect width='1' height='1' fill='octarine'/>"), HasSubstr("octarine"));
  EXPECT_THAT(message("<rect width='1' height='1'"), HasSubstr("no value"));
  EXPECT_THAT(message("<rect width=1 height='1'/>"), HasSubstr("quotes"));
  EXPECT_THAT(message("<rect width='1e40' height='1'/>"), HasSubstr("not a number"));
  EXPECT_THAT(test::inputError([] { readDrawing("nothing", "a.svg"); }), HasSubstr("no <svg>"));
}

TEST(DrawingText, ReadsBackAsWhatItWas) {
  Drawing drawing;
  drawing.shapes.push_back({"a \"b\" & <c>", {10, 200, 30}, {{{0, 0}, {2.5, 0}, {2.5, 7}}}});
  drawing.shapes.push_back(
      {"wall", {1, 2, 3}, {{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{3, 3}, {3, 6}, {6, 6}, {6, 3}}}});
  Warnings warnings;
  const Drawing read = readDrawing(drawingText(drawing), "b.svg", &warnings);
  ASSERT_EQ(read.shapes.size(), 2u);
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_EQ(read.shapes[s].color, drawing.shapes[s].color);
    EXPECT_EQ(read.shapes[s].loops, drawing.shapes[s].loops);
  }
  EXPECT_EQ(read.shapes[1].material, "wall");
}

}  // namespace
}  // namespace exemplar
