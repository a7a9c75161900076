// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// The search for blocks, by itself.

#include <pybind11/stl.h>

#include <optional>

#include "python/shared.h"
#include "search/block_index.h"
#include "search/linear_scan.h"
#include "search/nearest_neighbor_field.h"

namespace exemplar::python {
namespace {

using Floats = py::array_t<float, py::array::forcecast>;
using Marks = py::array_t<bool, py::array::forcecast>;

/// A field's samples, or an array's.
Array3D<float> samplesOf(const py::object& given, const std::string& name) {
  if (py::isinstance<DistanceField>(given)) return given.cast<const DistanceField&>().values;
  return gridOf<float>(given.cast<Floats>(), name);
}

Array3D<std::uint8_t> marksOf(const Marks& given, const Vec3i& size, const std::string& name) {
  // NumPy's truth values are bytes that are 0 or 1.
  Array3D<std::uint8_t> marks =
      gridOf<std::uint8_t>(py::array_t<std::uint8_t, py::array::forcecast>(given), name);
  if (marks.size() != size) throw InputError(name + ": an array of the same size is wanted");
  return marks;
}

using Index = BlockIndex<float>;

std::shared_ptr<Index> makeIndex(const py::object& source, const py::object& block,
                                 const std::optional<Marks>& allowed) {
  Array3D<float> samples = samplesOf(source, "source");
  const Vec3i sides = sidesOf(block, "block");
  Array3D<std::uint8_t> places;
  BlockIndexOptions options;
  if (allowed) {
    places = marksOf(*allowed, samples.size(), "allowed");
    options.allowed = {&places};
  }
  return unlocked({}, [&](const Progress& progress) {
    return std::make_shared<Index>(std::move(samples), sides, options, progress);
  });
}

py::tuple matchIn(const Index& index, const py::object& query, const std::optional<Marks>& mask,
                  const std::string& method) {
  BlockQuery<float> block{samplesOf(query, "query"), {}};
  if (block.samples.size() != index.block())
    throw InputError("query: a block of the index's size is wanted");
  if (mask) block.known = marksOf(*mask, index.block(), "mask");
  if (method != "index" && method != "scan")
    throw InputError("`method` " + method + ": expected index or scan");
  const BlockMatch match = unlocked({}, [&](const Progress&) {
    return method == "index" ? index.findBest(block) : linearScan(index.source(0), block);
  });
  return py::make_tuple(tupleOf(match.position), match.distance);
}

py::tuple neighbors(const py::object& source, const py::object& target, const py::object& patch,
                    const py::object& stride, const std::string& method, std::uint64_t seed) {
  const Channels from{samplesOf(source, "source")}, to{samplesOf(target, "target")};
  NearestNeighborFieldOptions options;
  options.patch = sidesOf(patch, "patch");
  options.stride = sidesOf(stride, "stride");
  options.seed = seed;
  if (method == "patch_match") {
    options.method = NeighborMethod::PatchMatch;
  } else if (method != "exact") {
    throw InputError("`method` " + method + ": expected exact or patch_match");
  }
  // Owned by the arrays that show them.
  auto found = std::make_unique<NearestNeighborField>(unlocked({}, [&](const Progress& progress) {
    return nearestNeighborField(from, to, options, progress);
  }));
  const NearestNeighborField* const field = found.get();
  const py::capsule owner(found.release(),
                          [](void* memory) { delete static_cast<NearestNeighborField*>(memory); });
  constexpr auto step = static_cast<py::ssize_t>(sizeof(Vec3i));
  static_assert(sizeof(Vec3i) == 3 * sizeof(int));
  const Vec3i& n = field->position.size();
  return py::make_tuple(
      view(&field->position.data()->x, {n.x, n.y, n.z, 3},
           {step, step * n.x, step * n.x * n.y, static_cast<py::ssize_t>(sizeof(int))}, owner),
      gridView(field->distance, owner));
}

}  // namespace

void addSearch(py::module_& module) {
  py::class_<Index, std::shared_ptr<Index>> index(
      module, "BlockIndex",
      "An exact index of all blocks of one size in a Field or an array of three dimensions "
      "(docs/matching.md). block: samples along each side, a number or three. allowed: an array of "
      "truth values, at which first samples blocks may be found.");
  index.def(py::init(&makeIndex), py::arg("source"), py::arg("block"), py::kw_only(),
            py::arg("allowed") = py::none());
  index.def("match", &matchIn, py::arg("query"), py::arg("mask") = py::none(), py::kw_only(),
            py::arg("method") = "index",
            "The nearest block to a query of the block's size: its first sample (i, j, k), and the "
            "mean squared difference over the samples that count: all, or those of the mask. Ties "
            "go to the lowest index. method: index, or scan, which looks at every block and "
            "answers the same.");
  index.def_property_readonly("block", [](const Index& i) { return tupleOf(i.block()); });
  index.def_property_readonly("positions", &Index::positions, "Blocks that may be found.");
  index.def_property_readonly("bytes", &Index::bytes, "Memory that it takes beyond the source.");
  module.def("nearest_neighbor_field", &neighbors, py::arg("source"), py::arg("target"),
             py::kw_only(), py::arg("patch") = 7, py::arg("stride") = 1,
             py::arg("method") = "exact", py::arg("seed") = 0,
             "For each patch of the target its nearest patch of the source, Fields or arrays: "
             "first samples (nx, ny, nz, 3) int32 and mean squared differences. method: exact, or "
             "patch_match (Barnes et al. 2009), which seed is for.");
}

}  // namespace exemplar::python
