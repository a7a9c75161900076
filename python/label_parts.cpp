// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Meshes as labels and back, and what model synthesis knows of labels.

#include <pybind11/stl.h>

#include <array>
#include <optional>

#include "python/shared.h"
#include "voxelize/adjacency.h"
#include "voxelize/mesh_to_labels.h"
#include "voxelize/model_pieces.h"
#include "voxelize/violations.h"

namespace exemplar::python {
namespace {

using SharedGrid = std::shared_ptr<LabelGrid>;
using SharedPieces = std::shared_ptr<ModelPieces>;

VoxelFill fillOf(const std::string& name) {
  if (name == "solid") return VoxelFill::Solid;
  if (name == "surface") return VoxelFill::Surface;
  if (name == "both") return VoxelFill::Both;
  throw InputError("`fill` " + name + ": expected solid, surface or both");
}

/// Sides of a cell: one number, or three.
Vec3d cellOf(const py::object& given) {
  if (given.is_none()) return {0, 0, 0};
  const Vec3d cell = py::isinstance<py::float_>(given) || py::isinstance<py::int_>(given)
                         ? Vec3d{given.cast<double>(), given.cast<double>(), given.cast<double>()}
                         : vectorOf(given.cast<std::vector<double>>(), "cell");
  if (!(cell.x > 0 && cell.y > 0 && cell.z > 0))
    throw InputError("cell: numbers above 0 are wanted");
  return cell;
}

std::vector<CellOffset> offsetsOf(const std::vector<std::array<int, 3>>& given) {
  std::vector<CellOffset> offsets;
  for (const auto& o : given) offsets.push_back({o[0], o[1], o[2]});
  return offsets;
}

std::vector<LabelGrid> gridsOf(const py::object& given) {
  std::vector<LabelGrid> grids;
  if (py::isinstance<LabelGrid>(given)) {
    grids.push_back(given.cast<const LabelGrid&>());
  } else {
    for (const py::handle& one : given.cast<py::sequence>())
      grids.push_back(one.cast<const LabelGrid&>());
  }
  if (grids.empty()) throw InputError("examples: a LabelGrid, or a list of them, is wanted");
  return grids;
}

/// For each offset an array of rows (first, second, count).
py::dict adjacencyOf(const py::object& given, const py::object& periodic,
                     const std::vector<std::array<int, 3>>& offsets) {
  const std::vector<LabelGrid> grids = gridsOf(given);
  const AdjacencyOptions options{axesOf(periodic, "periodic"), offsetsOf(offsets)};
  const Adjacency found = unlocked(
      {}, [&](const Progress& progress) { return findAdjacency(grids, options, progress); });
  py::dict pairs;
  for (const PairRule& rule : found.rules) {
    if (rule.offset.t != 0) continue;
    py::array_t<std::int64_t> rows({static_cast<py::ssize_t>(rule.pairs.size()), py::ssize_t{3}});
    std::int64_t* row = rows.mutable_data();
    for (const LabelPair& pair : rule.pairs) {
      *row++ = pair.first;
      *row++ = pair.second;
      *row++ = pair.count;
    }
    pairs[py::make_tuple(rule.offset.x, rule.offset.y, rule.offset.z)] = rows;
  }
  return pairs;
}

py::dict violationsOf(const LabelGrid& result, const py::object& given, const py::object& periodic,
                      const py::object& examplePeriodic,
                      const std::vector<std::array<int, 3>>& offsets) {
  const std::vector<LabelGrid> examples = gridsOf(given);
  ViolationOptions options;
  options.adjacency = {axesOf(examplePeriodic, "example_periodic"), offsetsOf(offsets)};
  options.periodic = axesOf(periodic, "periodic");
  const AdjacencyViolations found = unlocked({}, [&](const Progress& progress) {
    return findViolations({&result, 1}, examples, options, progress);
  });
  py::list listed;
  for (const AdjacencyViolation& v : found.listed) {
    py::dict of;
    of["cell"] = tupleOf(v.cell);
    of["offset"] = py::make_tuple(v.offset.x, v.offset.y, v.offset.z);
    of["labels"] = py::make_tuple(v.first, v.second);
    listed.append(of);
  }
  py::dict all;
  all["pairs"] = found.pairs;
  all["count"] = found.count;
  all["listed"] = listed;
  return all;
}

void addPieces(py::module_& module) {
  py::class_<ModelPieces, SharedPieces> pieces(module, "Pieces",
                                               "A mesh cut into pieces along a grid of cells.");
  pieces.def_property_readonly(
      "labels",
      [](const py::object& self) {
        return py::cast(&self.cast<const ModelPieces&>().grid,
                        py::return_value_policy::reference_internal, self);
      },
      "The LabelGrid whose labels are what the mesh's cells hold; it shares the memory.");
  pieces.def(
      "assemble",
      [](const ModelPieces& p, const LabelGrid& labels) {
        return unlocked({}, [&](const Progress& progress) {
          return std::make_shared<TriangleMesh>(assemblePieces(labels, p, nullptr, progress));
        });
      },
      py::arg("labels"), "The mesh of a grid of these labels: each piece where its label is.");
  pieces.def("__repr__", [](const ModelPieces& p) {
    return "<exemplar.Pieces of " + std::to_string(p.grid.labelCount()) + " labels>";
  });
  module.def(
      "cut_pieces",
      [](const TriangleMesh& mesh, const py::object& cell, int air, double tolerance) {
        const ModelPiecesOptions options{
            .cellSize = cellOf(cell), .air = air, .tolerance = tolerance};
        if (cell.is_none()) throw InputError("cell: numbers above 0 are wanted");
        return unlocked({}, [&](const Progress& progress) {
          return std::make_shared<ModelPieces>(cutIntoPieces(mesh, options, progress));
        });
      },
      py::arg("mesh"), py::arg("cell"), py::kw_only(), py::arg("air") = 0,
      py::arg("tolerance") = 1e-4,
      "A mesh cut into `Pieces` along cells of the size cell, a number or three (Merrell 2007); "
      "air: empty cells added at its sides and above.");
}

}  // namespace

void addLabelParts(py::module_& module) {
  addPieces(module);
  module.def(
      "mesh_to_labels",
      [](const TriangleMesh& mesh, const py::object& cell, int resolution, int air,
         const std::string& fill) {
        const MeshToLabelsOptions options{
            .cellSize = cellOf(cell), .resolution = resolution, .air = air, .fill = fillOf(fill)};
        return unlocked({}, [&](const Progress& progress) {
          return std::make_shared<LabelGrid>(meshToLabels(mesh, options, progress));
        });
      },
      py::arg("mesh"), py::kw_only(), py::arg("cell") = py::none(), py::arg("resolution") = 64,
      py::arg("air") = 0, py::arg("fill") = "both",
      "A mesh as a LabelGrid of its materials, in cells of the size cell, or resolution along the "
      "longest side. fill: solid, surface or both.");
  module.def("adjacency", &adjacencyOf, py::arg("labels"), py::kw_only(),
             py::arg("periodic") = py::none(),
             py::arg("offsets") = std::vector<std::array<int, 3>>{},
             "Which labels are neighbors in a LabelGrid, or in several: a dict of offsets, each "
             "with an array of rows (first, second, count).");
  module.def("violations", &violationsOf, py::arg("result"), py::arg("examples"), py::kw_only(),
             py::arg("periodic") = py::none(), py::arg("example_periodic") = py::none(),
             py::arg("offsets") = std::vector<std::array<int, 3>>{},
             "The neighbors in a result that no example shows: a dict of pairs (looked at), count, "
             "and listed, the first hundred.");
}

}  // namespace exemplar::python
