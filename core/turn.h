// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cmath>

#include "core/vec.h"

namespace exemplar {

/// A turn about a vertical axis: anticlockwise, seen from above, by `angle` radians about the line
/// through `about`. What it leaves as it is, it leaves to the bit.
class Turn {
 public:
  Turn() = default;
  Turn(double angle, const Vec3d& about)
      : angle_(angle), about_(about), cos_(std::cos(angle)), sin_(std::sin(angle)) {}

  bool none() const { return angle_ == 0; }
  double angle() const { return angle_; }
  const Vec3d& about() const { return about_; }
  Turn back() const { return {-angle_, about_}; }

  Vec3d operator()(const Vec3d& p) const {
    if (none()) return p;
    const Vec3d d = direction(p - about_);
    return {about_.x + d.x, about_.y + d.y, p.z};
  }
  Vec3d direction(const Vec3d& d) const {
    return {cos_ * d.x - sin_ * d.y, sin_ * d.x + cos_ * d.y, d.z};
  }

 private:
  double angle_ = 0;
  Vec3d about_{};
  double cos_ = 1, sin_ = 0;
};

}  // namespace exemplar
