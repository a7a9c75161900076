// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/symmetry.h"

#include <numeric>
#include <string>

#include "core/error.h"

namespace exemplar {
namespace {

/// A label table of the request, completed: the identity where it is empty.
std::vector<Label> completed(const std::vector<Label>& table, int labels, const char* name) {
  std::vector<Label> images(labels);
  if (table.empty()) {
    std::iota(images.begin(), images.end(), Label{0});
    return images;
  }
  if (static_cast<int>(table.size()) != labels) {
    throw InputError("`" + std::string(name) + "`: the table has " + std::to_string(table.size()) +
                     " entries and the example has " + std::to_string(labels) + " labels");
  }
  for (int b = 0; b < labels; ++b) {
    images[b] = table[b] < labels ? table[b] : SymmetryGroup::kNoImage;
  }
  return images;
}

std::vector<Label> composed(const std::vector<Label>& second, const std::vector<Label>& first) {
  std::vector<Label> both(first.size());
  for (std::size_t b = 0; b < first.size(); ++b) {
    both[b] = first[b] == SymmetryGroup::kNoImage ? SymmetryGroup::kNoImage : second[first[b]];
  }
  return both;
}

}  // namespace

SymmetryGroup::SymmetryGroup(const ModelSymmetry& symmetry, const Vec3i& size, int labels)
    : size_(size) {
  if (symmetry.turns != 1 && symmetry.turns != 2 && symmetry.turns != 4) {
    throw InputError("`turns` " + std::to_string(symmetry.turns) + ": must be 1, 2 or 4");
  }
  if (symmetry.turns == 4 && size.x != size.y) {
    throw InputError(
        "`turns` 4: a result that is the same after quarter turns must be as wide as "
        "deep, not " +
        std::to_string(size.x) + " x " + std::to_string(size.y) + "; change `size`");
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (symmetry.copies[axis] < 1 || size[axis] % symmetry.copies[axis] != 0) {
      throw InputError("`copies` " + std::to_string(symmetry.copies[axis]) +
                       ": they do not divide the size of " + std::to_string(size[axis]) + " cells");
    }
  }

  std::vector<Element> generators;
  if (symmetry.mirrorX) {
    generators.push_back({-1, 0, 0, 1, completed(symmetry.mirroredX, labels, "mirrored-x")});
  }
  if (symmetry.mirrorY) {
    generators.push_back({1, 0, 0, -1, completed(symmetry.mirroredY, labels, "mirrored-y")});
  }
  if (symmetry.turns > 1) {
    Element turn{0, -1, 1, 0, completed(symmetry.turned, labels, "turned")};
    if (symmetry.turns == 2) turn = {-1, 0, 0, -1, composed(turn.labels, turn.labels)};
    generators.push_back(turn);
  }
  if (generators.empty()) return;

  elements_[0].labels.resize(labels);
  std::iota(elements_[0].labels.begin(), elements_[0].labels.end(), Label{0});
  for (std::size_t at = 0; at < elements_.size(); ++at) {
    for (const Element& g : generators) {
      const Element e = elements_[at];
      const Element next{g.xx * e.xx + g.xy * e.yx, g.xx * e.xy + g.xy * e.yy,
                         g.yx * e.xx + g.yy * e.yx, g.yx * e.xy + g.yy * e.yy,
                         composed(g.labels, e.labels)};
      bool known = false;
      for (Element& other : elements_) {
        if (!other.sameMap(next)) continue;
        known = true;
        for (int b = 0; b < labels; ++b) {
          if (next.labels[b] == kNoImage) continue;
          if (other.labels[b] == kNoImage || other.labels[b] == next.labels[b]) continue;
          throw InputError(
              "`mirrored-x`, `mirrored-y` and `turned` contradict each other at label " +
              std::to_string(b));
        }
      }
      if (!known) elements_.push_back(next);
    }
  }
}

Vec3i SymmetryGroup::turned(int e, const Vec3i& d) const {
  const Element& m = elements_[e];
  return {m.xx * d.x + m.xy * d.y, m.yx * d.x + m.yy * d.y, d.z};
}

Vec3i SymmetryGroup::moved(int e, const Vec3i& cell) const {
  // Twice the position relative to the middle is an integer.
  const Vec3i twice{2 * cell.x + 1 - size_.x, 2 * cell.y + 1 - size_.y, cell.z};
  const Vec3i there = turned(e, twice);
  return {(there.x + size_.x - 1) / 2, (there.y + size_.y - 1) / 2, cell.z};
}

}  // namespace exemplar
