// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

/// What synthesis and the figures of `measure/` have to agree on. Synthesis knows the ruler that it
/// is measured by: a change here changes both.
namespace exemplar {

// Likeness is measured window by window (`measure/patch_likeness.h`); synthesis keeps parts whole
// that are at least as long.

/// The side of a window, in cells: 11³ cells are compared. After Wu and Zheng ("Learning to
/// generate 3D shapes from a single example", ACM Transactions on Graphics 41(6), 2022,
/// doi:10.1145/3550454.3555480) and the evaluation in their program.
inline constexpr int kLikenessWindow = 11;

/// The side of a window's core, in cells: a window counts where its core is partly solid and partly
/// empty.
inline constexpr int kLikenessCore = 3;

/// The step between the windows that are looked up, in cells.
inline constexpr int kLikenessStride = 5;

/// The intersection over union above which two windows are alike. A flat surface through the middle
/// of a window is no longer alike when it moves by (1 - 0.95) / 0.95 x 11 / 2 = 0.29 voxels.
inline constexpr double kLikenessThreshold = 0.95;

// Broken pieces.

/// Contacts thinner than this do not join two bodies, voxels: pieces are separated this far below
/// the surface where they would otherwise be one.
inline constexpr double kContactDepth = 0.5;
/// The share of an example's solid that must lie in whole pieces for them to be the measure of what
/// is a broken one.
inline constexpr double kMostlyWhole = 0.25;
/// A piece is broken if it has less than this share of the samples of the example's smallest.
inline constexpr double kBrokenShare = 0.5;

}  // namespace exemplar
