// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/array3d.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// The averages of the cells of `factor`³ samples (Lagae 2004, section 4.1: "complete subsampled
/// distance field pyramid ... by averaging the samples"). A last cell that reaches beyond the field
/// averages the samples that are there. The result's voxels are `factor` times as large.
DistanceField blockAverage(const DistanceField& field, int factor);

/// The field at a world position, trilinear between samples and constant beyond the outer ones.
float sampleTrilinear(const DistanceField& field, const Vec3d& xyz);

/// Values between samples by cubic convolution along each axis (Keys: "Cubic convolution
/// interpolation for digital image processing", IEEE Transactions on Acoustics, Speech, and Signal
/// Processing 29(6), 1981, doi:10.1109/TASSP.1981.1163711, with a = -1/2): exact where the values
/// are quadratic. Trilinear ones make what is thin thinner: wires 3.5 samples thick by a
/// fifteenth. `at` in samples; constant beyond the outer ones. 64 samples are read.
double cubicAt(const Array3D<float>& values, const Vec3d& at);
/// The same of a field at a world position.
float sampleCubic(const DistanceField& field, const Vec3d& xyz);

/// A field in 256 levels (Lagae 2004, section 4.1): level 0 is `low`, level 255 is `high`.
struct QuantizedField {
  Array3D<std::uint8_t> levels;
  float low = -1, high = 1;  ///< world units

  float value(std::uint8_t level) const { return low + (high - low) * (level / 255.0f); }
};

/// Rounds to the nearest of 256 levels between -`range` and `range` (world units, > 0); values
/// beyond are clamped. The error inside the range is at most `range` / 255.
QuantizedField quantize(const DistanceField& field, float range);

}  // namespace exemplar
