// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/piece_library.h"

#include <cmath>
#include <utility>

#include "core/file.h"
#include "mesh/mesh_formats.h"

namespace exemplar {

std::vector<PieceForm> pieceForms(const ModelPieces& pieces) {
  const std::size_t labels = pieces.grid.labels.size();
  std::vector<PieceForm> forms(labels);
  std::vector<char> known(labels, 0);
  const auto image = [](const std::vector<Label>& of, Label label) {
    return label < of.size() ? of[label] : ModelPieces::kNone;
  };
  for (std::size_t l = 0; l < labels; ++l) {
    if (known[l]) continue;
    const auto shape = static_cast<Label>(l);
    for (const bool mirrored : {false, true}) {
      Label label = mirrored ? image(pieces.mirroredX, shape) : shape;
      for (int turns = 0; turns < 4 && label != ModelPieces::kNone; ++turns) {
        if (!known[label]) {
          known[label] = 1;
          forms[label] = {shape, mirrored, turns};
        }
        label = image(pieces.turned, label);
      }
    }
  }
  return forms;
}

std::string pieceName(const ModelPieces& pieces, Label label) {
  std::string name;
  for (const char c : pieces.grid.labels[label].name) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    if (plain || (!name.empty() && name.back() != '_')) name += plain ? c : '_';
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name.empty() ? "piece_" + std::to_string(label) : name;
}

std::size_t writePieceLibrary(const std::filesystem::path& path, const ModelPieces& pieces,
                              const Progress& progress) {
  const std::vector<PieceForm> forms = pieceForms(pieces);
  const Vec3d& cell = pieces.grid.cellSize;
  TriangleMesh mesh = pieces.mesh;
  for (Vec3d& p : mesh.positions) p = p - cell * 0.5;
  MeshInstances instances;
  instances.first = pieces.first;
  std::vector<std::uint32_t> shapes;
  for (std::uint32_t label = 0; label < forms.size(); ++label) {
    instances.names.push_back(pieceName(pieces, static_cast<Label>(label)));
    if (forms[label].shape == label && pieces.first[label] != pieces.first[label + 1])
      shapes.push_back(label);
  }
  // In a square, half a cell apart.
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(double(shapes.size()))));
  for (std::size_t n = 0; n < shapes.size(); ++n) {
    const Vec3d place{1.5 * cell.x * double(n % side), 1.5 * cell.y * double(n / side), 0};
    instances.placements.push_back({shapes[n], place});
  }
  progress.report("writing pieces", 0);
  writeFile(path, formatGlb(mesh, instances, /*yUp=*/true), progress.part(0.5, 1));
  return shapes.size();
}

}  // namespace exemplar
