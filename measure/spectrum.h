// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "maps/grid.h"

namespace exemplar {

/// The discrete Fourier transform of `values` in place, without a factor; their number is a power
/// of two. O(n log n).
void fourierTransform(std::vector<std::complex<double>>& values);

/// How fast detail fades: the slope of the logarithm of the power of waves over the logarithm of
/// their number, from 4 waves a window to one of 4 cells; -3 to -4 for most land, 0 for white
/// noise. Power is the mean over directions (of equal steps of the logarithm) and over windows of
/// `side` x `side` cells (a power of two, >= 32) on a grid that begins at the first cell; from each
/// its plane is taken away, and what is left fades to its border (Hann). Nothing where no window
/// is without holes, or where all are flat. The same at any number of threads.
std::optional<double> spectrumSlope(const Grid<float>& heights, int side,
                                    const Progress& progress = {});

}  // namespace exemplar
