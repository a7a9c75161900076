// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "mesh/image.h"

namespace exemplar {

/// Pictures of one size as an animation that repeats for ever (GIF 89a), each shown for
/// `centiseconds` (2..65535). Up to 256 colors all in all are kept exactly; more are brought to a
/// fixed palette of 6 x 7 x 6 levels by ordered dithering. Opacity is left out. The same pictures
/// give the same bytes. Throws `InputError` for no pictures, pictures of different sizes, or sides
/// longer than 65,535.
std::string formatGif(std::span<const Image8> pictures, int centiseconds = 8);

/// Writes it, whole or not at all.
void writeGif(const std::filesystem::path& path, std::span<const Image8> pictures,
              int centiseconds = 8);

}  // namespace exemplar
