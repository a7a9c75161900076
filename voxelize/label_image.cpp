// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/label_image.h"

#include <algorithm>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/error.h"
#include "core/memory.h"
#include "mesh/color.h"

namespace exemplar {
namespace {

using Rgba = std::array<std::uint8_t, 4>;

Rgba pixelAt(const Image8& image, int x, int y) {
  const std::uint8_t* p = image.at(x, y);
  const bool gray = image.channels < 3;
  const std::uint8_t alpha = image.channels == 2 ? p[1] : image.channels == 4 ? p[3] : 255;
  if (alpha == 0) return {0, 0, 0, 0};  // whatever lies beneath is not seen
  return gray ? Rgba{p[0], p[0], p[0], alpha} : Rgba{p[0], p[1], p[2], alpha};
}

/// The piece whose top left pixel is (x, y); beyond its end the picture begins again.
Image8 pieceAt(const Image8& image, int x, int y, int side) {
  Image8 piece{side, side, 4, {}};
  piece.pixels.reserve(static_cast<std::size_t>(side) * side * 4);
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const int i = (x + column) % image.width, j = (y + row + image.height) % image.height;
      for (const std::uint8_t c : pixelAt(image, i, j)) piece.pixels.push_back(c);
    }
  }
  return piece;
}

/// The mean of what is seen of a piece, or its lower left pixel.
std::array<float, 4> colorOf(const Image8& piece, bool lowerLeft) {
  std::array<float, 4> color{};
  double weight = 0, sum[3] = {};
  for (int y = lowerLeft ? piece.height - 1 : 0; y < piece.height; ++y) {
    for (int x = 0; x < (lowerLeft ? 1 : piece.width); ++x) {
      const std::uint8_t* p = piece.at(x, y);
      weight += p[3];
      for (int c = 0; c < 3; ++c) sum[c] += double{srgb8ToLinear(p[c])} * p[3];
    }
  }
  const int pixels = lowerLeft ? 1 : piece.width * piece.height;
  for (int c = 0; c < 3 && weight > 0; ++c) color[c] = static_cast<float>(sum[c] / weight);
  color[3] = static_cast<float>(weight / (255.0 * pixels));
  return color;
}

/// Where variant `v` of a picture (mirrored if odd, after v / 2 quarter turns counterclockwise) has
/// what is at `p` of a grid of size `n`, y upwards; `n` becomes the variant's size.
Vec3i turnedCell(int v, Vec3i p, Vec3i& n) {
  for (int turn = 0; turn < v / 2; ++turn) {
    p = {n.y - 1 - p.y, p.x, p.z};
    std::swap(n.x, n.y);
  }
  if (v % 2 == 1) p.x = n.x - 1 - p.x;
  return p;
}

Image8 turnedPiece(int v, const Image8& piece) {
  Image8 turned = piece;
  const int side = piece.width;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      Vec3i n{side, side, 1};
      const Vec3i q = turnedCell(v, {x, side - 1 - y, 0}, n);
      std::copy_n(piece.at(x, y), 4, turned.at(q.x, side - 1 - q.y));
    }
  }
  return turned;
}

void requireFlat(const LabelGrid& grid) {
  if (grid.size().z != 1) {
    throw InputError("the grid has " + std::to_string(grid.size().z) +
                     " layers, and a picture has one; write a .txt, .vox or .vdb");
  }
}

}  // namespace

ImageLabels labelsFromImage(const Image8& image, const std::string& name,
                            const ImageLabelsOptions& options, const Progress& progress) {
  const int side = options.piece;
  if (side < 1 || side > 256) {
    throw InputError("`piece` " + std::to_string(side) + ": must be 1 to 256 pixels a side");
  }
  if (image.width < side || image.height < side) {
    throw InputError(name + ": the picture of " + std::to_string(image.width) + " x " +
                     std::to_string(image.height) +
                     " pixels is smaller than one piece; `piece` is " + std::to_string(side));
  }
  const int step = options.overlap ? 1 : side;
  if (options.symmetry != 1 && options.symmetry != 2 && options.symmetry != 4 &&
      options.symmetry != 8) {
    throw InputError("`symmetry` " + std::to_string(options.symmetry) + ": must be 1, 2, 4 or 8");
  }
  if (options.symmetry > 2 && options.periodic.x != options.periodic.y) {
    throw InputError(name + ": `symmetry` " + std::to_string(options.symmetry) +
                     " turns the picture, so `example-periodic` must be xy or none");
  }
  if (options.periodic.z)
    throw InputError(name + ": `example-periodic`: a picture has the axes x and y");
  const auto along = [&](int pixels, bool periodic) {
    if (!periodic) return (pixels - side) / step + 1;
    if (pixels % step == 0) return pixels / step;
    throw InputError(name + ": `example-periodic`: the picture of " + std::to_string(image.width) +
                     " x " + std::to_string(image.height) + " pixels is not whole pieces of " +
                     std::to_string(side) + " long, so it cannot go on from its end");
  };
  const Vec3i size{along(image.width, options.periodic.x), along(image.height, options.periodic.y),
                   1};
  requireMemory(static_cast<double>(volume(size)) * (2 + (side > 1 ? 4.0 * side * side : 0)),
                name + ": its pieces", "use a smaller picture or a smaller `piece`");
  ImageLabels result;
  result.options = options;
  result.grid.cells = Array3D<Label>(size);
  std::unordered_map<std::string, Label> known;
  const auto labelOf = [&](Image8 piece) {
    auto [found, isNew] =
        known.try_emplace(std::string(piece.pixels.begin(), piece.pixels.end()), Label{});
    if (!isNew) return found->second;
    if (result.pieces.size() == static_cast<std::size_t>(kMostLabels)) {
      throw InputError(name + ": the picture has more than " + std::to_string(kMostLabels) +
                       " different pieces; use fewer colors or a smaller `piece`");
    }
    found->second = static_cast<Label>(result.pieces.size());
    result.grid.labels.emplace_back().color = colorOf(piece, options.overlap);
    result.pieces.push_back(std::move(piece));
    return found->second;
  };
  for (int row = 0; row < size.y; ++row) {
    progress.report("cutting the picture into pieces", static_cast<double>(row) / size.y);
    for (int column = 0; column < size.x; ++column) {
      // The lowest row of cells is the picture's last; what is left over lies at its top.
      const int y = size.y - 1 - row;
      result.grid.cells(column, y, 0) =
          labelOf(pieceAt(image, column * step, image.height - side - y * step, side));
    }
  }
  for (int v = 1; v < options.symmetry; ++v) {
    progress.check();
    ImageLabels::Turned& turned = result.turned.emplace_back();
    turned.upright = v < 2;
    Vec3i n = size;
    turnedCell(v, {}, n);
    turned.grid.cells = Array3D<Label>(n);
    turned.from = Array3D<Vec3i>(n);
    std::vector<std::optional<Label>> images(result.pieces.size());
    forEachCell(size, [&](const Vec3i& p) {
      Vec3i unused = size;
      const Vec3i q = turnedCell(v, p, unused);
      const Label label = result.grid.cells[p];
      if (!images[label]) images[label] = labelOf(turnedPiece(v, result.pieces[label]));
      turned.grid.cells[q] = *images[label];
      turned.from[q] = p;
    });
  }
  for (ImageLabels::Turned& turned : result.turned) turned.grid.labels = result.grid.labels;
  return result;
}

Adjacency imageAdjacency(std::span<const LabelGrid> grids, const ImageLabels& labels,
                         const AdjacencyOptions& options, const Progress& progress) {
  Adjacency adjacency = findAdjacency(grids, options, progress);
  const int side = labels.options.piece;
  if (!labels.options.overlap || labels.options.seen || side < 2) return adjacency;
  // Without its first or last column, or row: what a piece shares with the next one.
  const auto shared = [&](const Image8& piece, int axis, bool last) {
    const int x0 = axis == 0 && last ? 1 : 0, x1 = axis == 0 && !last ? side - 1 : side;
    // Rows come from the top.
    const int y0 = axis == 1 && !last ? 1 : 0, y1 = axis == 1 && last ? side - 1 : side;
    std::string pixels;
    for (int y = y0; y < y1; ++y) {
      const auto* row = piece.at(x0, y);
      pixels.append(row, row + 4 * static_cast<std::ptrdiff_t>(x1 - x0));
    }
    return pixels;
  };
  for (PairRule& rule : adjacency.rules) {
    const CellOffset& o = rule.offset;
    const int axis = o == CellOffset{1, 0, 0} ? 0 : o == CellOffset{0, 1, 0} ? 1 : 2;
    if (axis == 2) continue;
    std::unordered_map<std::string, std::vector<Label>> beginning;
    for (std::size_t b = 0; b < labels.pieces.size(); ++b)
      beginning[shared(labels.pieces[b], axis, false)].push_back(static_cast<Label>(b));
    std::vector<LabelPair> pairs;
    double count = 0;
    for (std::size_t a = 0; a < labels.pieces.size(); ++a) {
      if (a % 256 == 0) progress.check();
      const auto next = beginning.find(shared(labels.pieces[a], axis, true));
      if (next == beginning.end()) continue;
      count += static_cast<double>(next->second.size());
      requireMemory(count * sizeof(LabelPair), "the pairs of pieces that agree",
                    "use a larger `piece`");
      for (const Label b : next->second) {
        const Label first = static_cast<Label>(a);
        pairs.push_back({first, b, std::max<std::int64_t>(1, rule.count(first, b))});
      }
    }
    rule.pairs = std::move(pairs);
  }
  return adjacency;
}

Image8 imageFromLabels(const LabelGrid& grid, const ImageLabels& labels, const Progress& progress,
                       const Axes& periodic) {
  requireFlat(grid);
  const Vec3i size = grid.size();
  const int side = labels.options.piece, step = labels.options.overlap ? 1 : side;
  const double width = (size.x - 1.0) * step + (periodic.x ? step : side);
  const double height = (size.y - 1.0) * step + (periodic.y ? step : side);
  requireMemory(4 * width * height, "the picture", "use a smaller `size`");
  Image8 image{static_cast<int>(width), static_cast<int>(height), 4, {}};
  image.pixels.resize(static_cast<std::size_t>(image.width) * image.height * 4);
  // Pieces that overlap cover what earlier ones laid, all but their lower left pixels.
  for (int y = 0; y < size.y; ++y) {
    progress.report("laying pieces of the picture", static_cast<double>(y) / size.y);
    for (int x = 0; x < size.x; ++x) {
      const Label label = grid.cells(x, y, 0);
      if (label >= labels.pieces.size()) {
        throw InputError("label " + std::to_string(label) +
                         " is in the grid and no piece of the picture has it");
      }
      const Image8& piece = labels.pieces[label];
      for (int row = 0; row < side; ++row) {
        const int j = image.height - side - y * step + row;
        for (int column = 0; column < side; ++column) {
          std::copy_n(piece.at(column, row), 4,
                      image.at((x * step + column) % image.width,
                               ((j % image.height) + image.height) % image.height));
        }
      }
    }
  }
  return image;
}

Image8 imageFromLabels(const LabelGrid& grid, const Progress& progress) {
  requireFlat(grid);
  Image8 image{grid.size().x, grid.size().y, 4, {}};
  image.pixels.reserve(static_cast<std::size_t>(image.width) * image.height * 4);
  for (int y = image.height - 1; y >= 0; --y) {
    progress.report("coloring the picture", 1 - (y + 1.0) / image.height);
    for (int x = 0; x < image.width; ++x) {
      const auto& color = grid.labels[grid.cells(x, y, 0)].color;
      for (int c = 0; c < 3; ++c) image.pixels.push_back(linearToSrgb8(color[c]));
      image.pixels.push_back(static_cast<std::uint8_t>(color[3] * 255 + 0.5f));
    }
  }
  return image;
}

}  // namespace exemplar
