// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/array3d.h"
#include "core/progress.h"

namespace exemplar {

/// The circular cross-correlation of two grids of one size: at `s`, the sum over all cells x of
/// a(x) b(x - s), indices wrapping around. How well `b`, rolled by `s`, lies on `a`, for all shifts
/// at once.
///
/// By the fast Fourier transform in single precision (Stockham's, of mixed radix: Van Loan,
/// "Computational frameworks for the fast Fourier transform", SIAM 1992, section 1.7), so errors
/// are about 1e-6 of |a| |b|: sum those that decide something again. Lengths whose only prime
/// factors are 2, 3 and 5 are quick; along an axis time grows with its largest prime factor. 24
/// bytes a cell; the same bytes at any number of threads. Throws `Cancelled`.
Array3D<float> circularCorrelation(const Array3D<float>& a, const Array3D<float>& b,
                                   const Progress& progress = {});

/// The least length, `n` or more, whose only prime factors are 2, 3 and 5.
int quickLength(int n);

}  // namespace exemplar
