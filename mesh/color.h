// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

namespace exemplar {

/// The sRGB transfer curve (IEC 61966-2-1) and its inverse, on 0..1. Pictures and the vertex
/// colors of .ply, .obj and .off files are sRGB; colors in memory and in .glb files are linear.
double srgbToLinear(double srgb);
double linearToSrgb(double linear);

/// An 8-bit sRGB sample as linear 0..1. `linearToSrgb8` of it is the sample again, exactly.
float srgb8ToLinear(std::uint8_t srgb);

/// The nearest 8-bit sRGB sample; what is outside 0..1 goes to the nearest end.
std::uint8_t linearToSrgb8(float linear);

}  // namespace exemplar
