// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include "core/random.h"
#include "voxelize/label_grid.h"

namespace exemplar {

/// A grid of random labels from 0 (empty) to `labels` - 1, in colors that 8 bits hold.
inline LabelGrid randomGrid(const Vec3i& size, int labels, std::uint64_t seed) {
  const Random random(seed, 0x1ab3);
  LabelGrid grid;
  grid.cells = Array3D<Label>(size);
  for (std::size_t n = 0; n < grid.cells.count(); ++n) {
    grid.cells.values()[n] = static_cast<Label>(random.below(labels, n));
  }
  grid.labels.push_back(emptyLook());
  for (int label = 1; label < labels; ++label) {
    LabelLook& look = grid.labels.emplace_back();
    look.name = "piece " + std::to_string(label);
    look.color = distinctColor(label);
  }
  return grid;
}

/// The start of a .vox file, its chunks by hand: the helpers of tests that must not trust the
/// writer.
inline std::string little(std::int64_t value) {
  std::string out;
  for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 255);
  return out;
}
inline std::string voxString(const std::string& text) {
  return little(static_cast<std::int64_t>(text.size())) + text;
}
inline std::string voxChunk(const std::string& id, const std::string& content) {
  return id + little(static_cast<std::int64_t>(content.size())) + little(0) + content;
}
inline std::string voxFile(const std::string& chunks) {
  return "VOX " + little(150) + "MAIN" + little(0) +
         little(static_cast<std::int64_t>(chunks.size())) + chunks;
}
/// A model of `size` whose voxels are four bytes each: x, y, z, color.
inline std::string voxModel(const Vec3i& size, const std::string& voxels) {
  return voxChunk("SIZE", little(size.x) + little(size.y) + little(size.z)) +
         voxChunk("XYZI", little(static_cast<std::int64_t>(voxels.size() / 4)) + voxels);
}
inline std::string voxTransform(int id, int child, const std::string& turn,
                                const std::string& shift) {
  std::string frame = little(!turn.empty() + !shift.empty());
  if (!turn.empty()) frame += voxString("_r") + voxString(turn);
  if (!shift.empty()) frame += voxString("_t") + voxString(shift);
  return voxChunk(
      "nTRN", little(id) + little(0) + little(child) + little(-1) + little(-1) + little(1) + frame);
}
inline std::string voxShape(int id, int model) {
  return voxChunk("nSHP", little(id) + little(0) + little(1) + little(model) + little(0));
}
inline std::string voxGroup(int id, std::initializer_list<int> children) {
  std::string content = little(id) + little(0) + little(static_cast<std::int64_t>(children.size()));
  for (const int child : children) content += little(child);
  return voxChunk("nGRP", content);
}

}  // namespace exemplar
