// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <string_view>

namespace exemplar {

/// A choice among the axes x, y and z: along which a result tiles, an example is stationary, a
/// volume wraps around.
struct Axes {
  bool x = false, y = false, z = false;

  constexpr bool& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr bool operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

  constexpr bool any() const { return x || y || z; }
  constexpr bool all() const { return x && y && z; }
  constexpr bool operator==(const Axes&) const = default;

  static constexpr Axes none() { return {}; }
  static constexpr Axes every() { return {true, true, true}; }

  friend constexpr Axes operator&(const Axes& a, const Axes& b) {
    return {a.x && b.x, a.y && b.y, a.z && b.z};
  }
};

/// Reads "x,y", "xy" or "none"; an empty text is none, too. Throws `InputError` beginning with
/// `what` ("`periodic` xq") for anything else.
Axes parseAxes(std::string_view text, const std::string& what);

/// "x, y"; "none" where there are none.
std::string readableAxes(const Axes& axes);

}  // namespace exemplar
