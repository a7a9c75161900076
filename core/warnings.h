// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/text.h"

namespace exemplar {

/// What was left out or taken otherwise than a file says, and what the file's user should know: one
/// line each, which begins with the file's name ("wall.glb: a texture ... is left out").
///
/// Functions that can warn take a `Warnings*` in their options; null drops the lines.
using Warnings = std::vector<std::string>;

/// Adds a line to `warnings` unless it is null or has that line already.
inline void warn(Warnings* warnings, std::string line) {
  if (!warnings) return;
  line = oneLine(std::move(line));
  if (std::find(warnings->begin(), warnings->end(), line) == warnings->end())
    warnings->push_back(std::move(line));
}

}  // namespace exemplar
