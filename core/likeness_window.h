// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

/// The window that likeness is measured by. `measure/` compares a result with its example window by
/// window (LP-dense and coverage, `measure/patch_likeness.h`), and `synth/geometry` knows that
/// window: it keeps parts whole that are at least as long. Both take these numbers from here, so
/// that they cannot drift apart; `docs/measures.md` says what it means for the figures.
namespace exemplar {

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

}  // namespace exemplar
