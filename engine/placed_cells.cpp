// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/placed_cells.h"

#include <vector>

#include "core/cells.h"
#include "core/json_text.h"
#include "engine/json.h"
#include "voxelize/piece_library.h"

namespace exemplar {
namespace {

/// Whether something is placed where a label is: a mesh of the library, or what is not empty.
bool isPlaced(Label label, const LabelGrid& grid, const ModelPieces* pieces) {
  if (pieces) return pieces->first[label] != pieces->first[label + 1];
  return !isEmpty(grid.labels[label]);
}

}  // namespace

std::string placedCellsJson(const LabelGrid& grid, const ModelPieces* pieces) {
  std::vector<int> numbers(grid.labels.size(), -1);
  Json named = Json::array();
  std::vector<PieceForm> forms;
  if (pieces) forms = pieceForms(*pieces);
  for (std::size_t l = 0; l < grid.labels.size(); ++l) {
    const auto label = static_cast<Label>(l);
    if (!isPlaced(label, grid, pieces)) continue;
    numbers[l] = static_cast<int>(named.size());
    if (pieces) {
      named.push_back({{"name", pieceName(*pieces, forms[l].shape)},
                       {"turns", forms[l].turns},
                       {"mirror", forms[l].mirrored}});
    } else {
      named.push_back({{"name", grid.labels[l].name}, {"color", grid.labels[l].color}});
    }
  }
  Json cells = Json::array();
  for (const Label label : grid.cells.values()) cells.push_back(numbers[label]);
  const Json json{{"size", toJson(grid.size())},
                  {"cell_size", toJson(grid.cellSize)},
                  {"origin", toJson(grid.origin)},
                  {"pieces", std::move(named)},
                  {"cells", std::move(cells)}};
  return jsonText(json) + "\n";
}

std::string placedCellsCsv(const LabelGrid& grid, const ModelPieces& pieces) {
  const std::vector<PieceForm> forms = pieceForms(pieces);
  std::string text = "x,y,z,piece,turns,mirror\n";
  forEachCell(grid.size(), [&](const Vec3i& p) {
    const Label label = grid.cells[p];
    if (!isPlaced(label, grid, &pieces)) return;
    const PieceForm& form = forms[label];
    text += std::to_string(p.x) + "," + std::to_string(p.y) + "," + std::to_string(p.z) + "," +
            pieceName(pieces, form.shape) + "," + std::to_string(form.turns) + "," +
            (form.mirrored ? "1" : "0") + "\n";
  });
  return text;
}

}  // namespace exemplar
