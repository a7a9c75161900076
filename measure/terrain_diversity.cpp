// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/terrain_diversity.h"

#include <algorithm>
#include <cmath>

#include "core/array3d.h"
#include "core/fourier.h"
#include "maps/halved.h"
#include "measure/terrain_copies.h"
#include "measure/turned_copies.h"

namespace exemplar {
namespace {

/// The shape on a square, in one of eight orientations.
Array3D<float> onSquare(const Grid<float>& shape, int side, int orientation) {
  Array3D<float> square({side, side, 1});
  const auto at = [&](int c, bool back) { return back ? side - 1 - c : c; };
  for (int y = 0; y < shape.height(); ++y) {
    for (int x = 0; x < shape.width(); ++x) {
      const int u = at(x, orientation & 1), v = at(y, orientation & 2);
      square((orientation & 4) ? v : u, (orientation & 4) ? u : v, 0) = shape(x, y);
    }
  }
  return square;
}

}  // namespace

TerrainLayout::TerrainLayout(const Grid<float>& heights) {
  const Grid<float> coarse = layoutOf(heights, layoutHalvings(heights));
  shape_ = smoothed3x3(laplacian(coarse));
  double sum = 0, count = 0, squares = 0;
  for (const float v : shape_.values()) {
    if (std::isnan(v)) continue;
    sum += v;
    ++count;
  }
  for (float& v : shape_.values()) {
    v = std::isnan(v) ? 0 : static_cast<float>(v - sum / count);
    squares += double{v} * v;
  }
  // What is left of one height by rounding is no shape.
  double largest = 0;
  for (const float h : coarse.values())
    if (!std::isnan(h)) largest = std::max(largest, std::abs(double{h}));
  const double length = std::sqrt(squares);
  const bool none = !(length > 1e-6 * largest);
  for (float& v : shape_.values()) v = none ? 0 : static_cast<float>(v / length);
}

TerrainDistance distanceBetween(const TerrainLayout& a, const TerrainLayout& b,
                                const Progress& progress) {
  if (!a.shape().sameSize(b.shape())) return {1, 1};
  double plain = 0;
  for (std::size_t s = 0; s < a.shape().count(); ++s) plain += double{a.shape()[s]} * b.shape()[s];
  const int side = quickLength(std::max(a.shape().width(), a.shape().height()));
  const bool square = a.shape().width() == a.shape().height();
  const Array3D<float> fixed = onSquare(a.shape(), square ? a.shape().width() : side, 0);
  double best = plain;
  for (int orientation = 0; orientation < 8; ++orientation) {
    const Array3D<float> turned = onSquare(b.shape(), fixed.size().x, orientation);
    const Array3D<float> found = circularCorrelation(fixed, turned, progress);
    for (const float value : found.values()) best = std::max(best, double{value});
  }
  return {1 - plain, std::max(0.0, 1 - best)};
}

}  // namespace exemplar
