// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/gradient_direction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "synth/terrain/height_origin.h"

namespace exemplar {
namespace {

/// Turns keep a terrain's direction where they change the tensor of its gradients by no more than
/// this share: up to about 1.8 between its axes.
constexpr double kTurnTolerance = 0.4;

/// The sums of products of gradients.
struct GradientTensor {
  double xx = 0, xy = 0, yy = 0;
};

GradientTensor gradientTensor(std::span<const Grid<float>> examples) {
  GradientTensor t;
  for (const Grid<float>& h : examples) {
    for (int y = 0; y + 1 < h.height(); ++y) {
      for (int x = 0; x + 1 < h.width(); ++x) {
        const double dx = h(x + 1, y) - h(x, y), dy = h(x, y + 1) - h(x, y);
        if (std::isnan(dx) || std::isnan(dy)) continue;
        t.xx += dx * dx;
        t.xy += dx * dy;
        t.yy += dy * dy;
      }
    }
  }
  return t;
}

}  // namespace

std::vector<int> turnsOf(std::span<const Grid<float>> examples) {
  const auto [xx, xy, yy] = gradientTensor(examples);
  std::vector<int> turns;
  for (int turn = 0; turn < 8; ++turn) {
    // What the products become where gradients turn along.
    const Pixel ex = turnedStep({1, 0}, turn), ey = turnedStep({0, 1}, turn);
    const double tx = ex.x * ex.x * xx + 2 * ex.x * ey.x * xy + ey.x * ey.x * yy;
    const double txy = ex.x * ex.y * xx + (ex.x * ey.y + ey.x * ex.y) * xy + ey.x * ey.y * yy;
    const double ty = ex.y * ex.y * xx + 2 * ex.y * ey.y * xy + ey.y * ey.y * yy;
    const double change =
        std::sqrt((tx - xx) * (tx - xx) + 2 * (txy - xy) * (txy - xy) + (ty - yy) * (ty - yy));
    if (change <= kTurnTolerance * (xx + yy)) turns.push_back(turn);
  }
  return turns;
}

double greatestTurn(std::span<const Grid<float>> examples) {
  const auto [xx, xy, yy] = gradientTensor(examples);
  // A turn by an angle changes the tensor by sqrt(2) times its sine and the difference of the axes.
  const double difference = std::hypot(xx - yy, 2 * xy);
  const double sine = kTurnTolerance * (xx + yy) / std::numbers::sqrt2;
  const double most = std::numbers::pi / 4;
  return sine < difference ? std::min(most, std::asin(sine / difference)) : most;
}

}  // namespace exemplar
