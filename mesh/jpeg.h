// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <string_view>

#include "mesh/image.h"

namespace exemplar {

/// A JPEG file in memory as gray or RGB. Throws `InputError`, with `name` in front, for anything
/// that libjpeg cannot make whole sense of, for CMYK, and for a truncated file.
Image8 decodeJpeg(std::string_view bytes, const std::string& name);

/// A gray or RGB picture as a JPEG file; `quality` 1..100, color at full resolution. The same
/// pixels give the same bytes (of one version of libjpeg). Throws `InputError` for an empty
/// picture, other channels, or more than 65,500 pixels a side.
std::string encodeJpeg(const Image8& image, int quality = 88);

}  // namespace exemplar
