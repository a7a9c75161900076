// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/axes.h"

#include "core/error.h"

namespace exemplar {

Axes parseAxes(std::string_view text, const std::string& what) {
  Axes axes;
  if (text == "none") return axes;
  for (const char c : text) {
    if (c == ',' || c == ' ') continue;
    if (c < 'x' || c > 'z') {
      throw InputError(what + ": expected axes such as xy or x,y,z, or none");
    }
    axes[c - 'x'] = true;
  }
  return axes;
}

std::string readableAxes(const Axes& axes) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    if (!axes[axis]) continue;
    if (!text.empty()) text += ", ";
    text += "xyz"[axis];
  }
  return text.empty() ? "none" : text;
}

}  // namespace exemplar
