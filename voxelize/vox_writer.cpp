// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>

#include "core/error.h"
#include "mesh/color.h"
#include "voxelize/label_file.h"

namespace exemplar {
namespace {

constexpr int kModelSide = 256;
constexpr int kMostColors = 255;

void appendInt(std::string& out, std::int64_t value) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 255);
}

void appendText(std::string& out, const std::string& text) {
  appendInt(out, static_cast<std::int64_t>(text.size()));
  out += text;
}

std::string chunk(const char* id, const std::string& content, const std::string& children = "") {
  std::string out(id, 4);
  appendInt(out, static_cast<std::int64_t>(content.size()));
  appendInt(out, static_cast<std::int64_t>(children.size()));
  return out + content + children;
}

/// The palette's color of each label: itself where the numbers suffice, else those that cells have
/// from 1 on; 0 for what is empty.
std::vector<int> colorsOf(const LabelGrid& grid, const std::string& name) {
  std::vector<int> color(grid.labels.size(), 0);
  if (grid.labels.size() <= kMostColors + 1 && !grid.labels.empty() && isEmpty(grid.labels[0])) {
    for (std::size_t label = 1; label < grid.labels.size(); ++label) {
      color[label] = isEmpty(grid.labels[label]) ? 0 : static_cast<int>(label);
    }
    return color;
  }
  std::vector<bool> used(grid.labels.size(), false);
  for (const Label label : grid.cells.values()) used[label] = true;
  int next = 0;
  for (std::size_t label = 0; label < grid.labels.size(); ++label) {
    if (used[label] && !isEmpty(grid.labels[label])) color[label] = ++next;
  }
  if (next > kMostColors) {
    throw InputError(name + ": the grid has " + std::to_string(next) +
                     " labels that are not empty, and a .vox has 255 colors; write a .txt or .vdb");
  }
  return color;
}

/// The chunks of one model: the cells from `low` to below `high`.
std::string modelChunks(const LabelGrid& grid, const std::vector<int>& colors, const Vec3i& low,
                        const Vec3i& high) {
  std::string size;
  for (int axis = 0; axis < 3; ++axis) appendInt(size, high[axis] - low[axis]);
  std::string voxels;
  for (int k = low.z; k < high.z; ++k) {
    for (int j = low.y; j < high.y; ++j) {
      for (int i = low.x; i < high.x; ++i) {
        const int color = colors[grid.cells(i, j, k)];
        if (color == 0) continue;
        for (const int c : {i - low.x, j - low.y, k - low.z, color}) {
          voxels += static_cast<char>(c);
        }
      }
    }
  }
  std::string content;
  appendInt(content, static_cast<std::int64_t>(voxels.size() / 4));
  return chunk("SIZE", size) + chunk("XYZI", content + voxels);
}

std::string transformChunk(int id, int child, int layer, const std::string& translation) {
  std::string content;
  appendInt(content, id);
  appendInt(content, 0);  // no attributes
  appendInt(content, child);
  appendInt(content, -1);
  appendInt(content, layer);
  appendInt(content, 1);  // one frame
  appendInt(content, translation.empty() ? 0 : 1);
  if (!translation.empty()) {
    appendText(content, "_t");
    appendText(content, translation);
  }
  return chunk("nTRN", content);
}

/// A scene of the models that start at `corners`, each with its middle where it belongs.
std::string sceneChunks(const Vec3i& size, const std::vector<Vec3i>& corners) {
  std::string group;
  appendInt(group, 1);
  appendInt(group, 0);
  appendInt(group, static_cast<std::int64_t>(corners.size()));
  std::string parts;
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const int id = static_cast<int>(2 + 2 * n);
    appendInt(group, id);
    std::string translation;
    for (int axis = 0; axis < 3; ++axis) {
      const int low = corners[n][axis], high = std::min(low + kModelSide, size[axis]);
      // The scene rests on the ground, around the origin.
      const int shift = axis == 2 ? 0 : size[axis] / 2;
      translation += (axis ? " " : "") + std::to_string(low + (high - low) / 2 - shift);
    }
    parts += transformChunk(id, id + 1, 0, translation);
    std::string shape;
    appendInt(shape, id + 1);
    appendInt(shape, 0);
    appendInt(shape, 1);
    appendInt(shape, static_cast<std::int64_t>(n));
    appendInt(shape, 0);
    parts += chunk("nSHP", shape);
  }
  return transformChunk(0, 1, -1, "") + chunk("nGRP", group) + parts;
}

std::string paletteChunk(const LabelGrid& grid, const std::vector<int>& colors) {
  std::string content(4 * 256, '\0');
  for (std::size_t label = 0; label < grid.labels.size(); ++label) {
    if (colors[label] == 0) continue;
    char* entry = &content[4 * (static_cast<std::size_t>(colors[label]) - 1)];
    for (int c = 0; c < 3; ++c) {
      entry[c] = static_cast<char>(linearToSrgb8(grid.labels[label].color[c]));
    }
    entry[3] = '\xff';
  }
  return chunk("RGBA", content);
}

}  // namespace

std::string formatVox(const LabelGrid& grid, const std::string& name, const Progress& progress) {
  const std::vector<int> colors = colorsOf(grid, name);
  const Vec3i size = grid.size();
  std::vector<Vec3i> corners;
  std::string children;
  for (int k = 0; k < size.z; k += kModelSide) {
    for (int j = 0; j < size.y; j += kModelSide) {
      for (int i = 0; i < size.x; i += kModelSide) {
        progress.report("writing labels", static_cast<double>(k) / size.z);
        const Vec3i low{i, j, k};
        corners.push_back(low);
        children += modelChunks(grid, colors, low,
                                min(low + Vec3i{kModelSide, kModelSide, kModelSide}, size));
      }
    }
  }
  if (corners.size() > 1) children += sceneChunks(size, corners);
  children += paletteChunk(grid, colors);
  if (children.size() > 0x7fffffff) {
    throw InputError(name + ": the grid is too large for a .vox; write a .vdb");
  }
  std::string out = "VOX ";
  appendInt(out, 150);
  return out + chunk("MAIN", "", children);
}

}  // namespace exemplar
