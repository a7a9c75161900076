// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

/// What synthesis and the figures of `measure/` have to agree on. Synthesis knows the ruler that it
/// is measured by: a change here changes both.
namespace exemplar {

/// Side of the windows by which likeness is measured, cells. Synthesis keeps windows of this size
/// whole where the halves of an example meet.
inline constexpr int kLikenessWindow = 11;

/// Contacts thinner than this do not join two bodies, voxels: pieces are told apart this far below
/// the surface where they would otherwise be one.
inline constexpr double kContactDepth = 0.5;
/// The share of an example's solid that must lie in whole pieces for them to be the measure of what
/// is a broken one.
inline constexpr double kMostlyWhole = 0.25;
/// A piece is broken if it has less than this share of the samples of the example's smallest.
inline constexpr double kBrokenShare = 0.5;

}  // namespace exemplar
