// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/warnings.h"

/// Drawings of flat shapes: .svg files.
namespace exemplar {

/// A filled shape: polygons by the even-odd rule. y points up.
struct DrawnShape {
  std::string material;               ///< its name, or its color's ("#a05040")
  std::array<std::uint8_t, 3> color;  ///< sRGB
  std::vector<std::vector<std::array<double, 2>>> loops;
};

/// Shapes, later ones over earlier ones.
struct Drawing {
  std::vector<DrawnShape> shapes;
};

/// Whether a name ends in .svg.
bool isDrawingFile(const std::filesystem::path& path);

/// Reads the filled <polygon>, <rect> and <path> elements of an .svg; `name` is for messages. The
/// material is the attribute `data-material`, else the color. Throws `InputError` for what is not
/// made of straight lines (curves, circles) and for transformations; texts and lines without a
/// fill are left out, with a warning.
Drawing readDrawing(std::string_view text, const std::string& name, Warnings* warnings = nullptr);

/// A drawing as .svg text: a <path> for each shape with its material as `data-material` and
/// <title>, and a legend with the names of materials below.
std::string drawingText(const Drawing& drawing);

}  // namespace exemplar
