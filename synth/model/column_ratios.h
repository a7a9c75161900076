// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <string>
#include <vector>

#include "synth/model/patch_sources.h"

namespace exemplar {

/// How often what begins at each column of an example should occur in a result of another size, so
/// that as much is built for each column of the result as in the example.
///
/// Columns with labels that the example shows only along a side that the result has, too, as the
/// end of a ground, are expected once for each place along that side; all others share the rest.
///
/// Where labels are windows of a picture that overlap, a pixel near the picture's border is in
/// fewer windows than one further inside: the windows there stand for more of the picture, so that
/// colors keep their shares.
class ColumnRatios {
 public:
  /// `size`: of the result; `ends`: whether it has sides like the example's across x and y;
  /// `whole`: whether nothing runs over any side; `reach`: what a label shows of the cells after
  /// its own (`ModelOptions::reach`). The source must outlive it.
  ColumnRatios(const PatchSource& source, const Vec3i& size, const std::array<bool, 2>& ends,
               bool whole, const Vec3i& reach = {0, 0, 0});

  /// Of blocks of `wide` columns, for which there are `from` places in the example and `to` in the
  /// result: for each place of the example, x * from.y + y, how often its block should occur.
  ///
  /// A larger result has more places for its columns, since sides cut off fewer. What is built
  /// occurs as often as single columns do; the places that remain are for blocks of columns that
  /// are alike: ground. Where there are none, or things run over sides, all that is not for sides
  /// shares the places. O(columns of the example x their height).
  std::vector<double> of(const Vec3i& wide, const Vec3i& from, const Vec3i& to) const;

 private:
  struct Shares {
    std::vector<double> ratio;
    std::vector<int> others;    // places that are not for sides
    double left = 0, each = 0;  // of the result's places for all of those; for each
  };

  bool onRing(int axis, int at) const {
    return ends_[axis] && (at == 0 || at == source_->size[axis] - 1);
  }
  int column(int x, int y) const { return x * source_->size.y + y; }
  void findColumnsOfSides();
  Shares share(const Vec3i& wide, const Vec3i& from, const Vec3i& to) const;
  std::vector<double> standsFor(int axis, int wide, int from) const;
  std::vector<int> groundBlocks(const Vec3i& wide, const Vec3i& from) const;

  const PatchSource* source_;
  std::array<bool, 2> ends_;
  bool whole_;
  Vec3i reach_;
  std::vector<std::u16string> columns_;  // their labels
  std::vector<bool> ofSide_;             // of each column, whether it has a label of sides only
  double single_ = 0;                    // how often single columns occur that do not
};

}  // namespace exemplar
