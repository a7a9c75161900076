// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "core/vec.h"
#include "voxelize/label_grid.h"

namespace exemplar {

/// How a result repeats itself (thesis, section 3.5.2). The axes and planes of symmetry go through
/// the middle of the grid.
struct ModelSymmetry {
  bool mirrorX = false;   ///< left and right of the middle plane across x are mirror images
  bool mirrorY = false;   ///< front and back of the middle plane across y are mirror images
  int turns = 1;          ///< 1, 2 or 4: alike after a half or a quarter turn about z
  Vec3i copies{1, 1, 1};  ///< equal parts along each axis; each divides the size there

  /// What each label becomes when mirrored across x or y, or turned a quarter counterclockwise; a
  /// label whose entry is not a label has no image and does not occur where it would need one.
  /// Empty: each label is its own image.
  std::vector<Label> mirroredX, mirroredY, turned;

  bool any() const { return mirrorX || mirrorY || turns > 1 || copies != Vec3i{1, 1, 1}; }
};

/// The symmetries of a grid as maps of cells, with what they make of labels; element 0 is the
/// identity. Copies are translations: they come on top of the elements and leave labels alone.
class SymmetryGroup {
 public:
  static constexpr Label kNoImage = 0xFFFF;

  SymmetryGroup() = default;
  /// Throws `InputError` where the size or the label tables do not suit the symmetry.
  SymmetryGroup(const ModelSymmetry& symmetry, const Vec3i& size, int labels);

  int elements() const { return static_cast<int>(elements_.size()); }
  /// Where element `e` takes a cell, and an offset between cells.
  Vec3i moved(int e, const Vec3i& cell) const;
  Vec3i turned(int e, const Vec3i& offset) const;
  /// What element `e` makes of a label, or `kNoImage`.
  Label image(int e, Label label) const { return e == 0 ? label : elements_[e].labels[label]; }

 private:
  /// x' = xx x + xy y, y' = yx x + yy y about the middle.
  struct Element {
    int xx = 1, xy = 0, yx = 0, yy = 1;
    std::vector<Label> labels;  // empty for the identity
    bool sameMap(const Element& o) const {
      return xx == o.xx && xy == o.xy && yx == o.yx && yy == o.yy;
    }
  };

  Vec3i size_{1, 1, 1};
  std::vector<Element> elements_{Element{}};
};

}  // namespace exemplar
