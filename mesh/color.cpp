// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace exemplar {
namespace {

struct Tables {
  std::array<float, 256> linear;     // of each sample
  std::array<float, 255> threshold;  // between sample c and c + 1
};

const Tables& tables() {
  static const Tables made = [] {
    Tables t;
    for (int c = 0; c < 256; ++c) t.linear[c] = static_cast<float>(srgbToLinear(c / 255.0));
    for (int c = 0; c < 255; ++c) {
      t.threshold[c] = static_cast<float>(srgbToLinear((c + 0.5) / 255.0));
    }
    return t;
  }();
  return made;
}

}  // namespace

double srgbToLinear(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

double linearToSrgb(double linear) {
  return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

float srgb8ToLinear(std::uint8_t srgb) { return tables().linear[srgb]; }

std::uint8_t linearToSrgb8(float linear) {
  const auto& threshold = tables().threshold;
  return static_cast<std::uint8_t>(std::upper_bound(threshold.begin(), threshold.end(), linear) -
                                   threshold.begin());
}

}  // namespace exemplar
