// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/array3d.h"
#include "core/axes.h"
#include "core/error.h"
#include "core/origin.h"
#include "core/progress.h"
#include "core/vec.h"
#include "engine/example.h"
#include "engine/result.h"
#include "engine/setting.h"
#include "engine/source.h"

/// What the parts of the Python module share: work without the interpreter's lock, and arrays that
/// are views of C++ memory.
namespace exemplar::python {

namespace py = pybind11;

/// An example or a result as Python holds it: shared, never changed.
using SharedExample = std::shared_ptr<const Example>;

/// A result with its examples.
struct Made {
  Result result;
  std::vector<Example> examples;
  ReadOptions reading;

  std::span<const Example> all() const { return examples; }
};

/// What hears of the progress, a Python callable or None: `progress(stage, fraction)`. False stops
/// the work.
struct Waiting {
  py::object progress = py::none();
  int threads = 0;  ///< 0: all cores
};

/// Does the work on a thread of its own, without the interpreter's lock. The caller's thread wakes
/// every 50 ms to hear signals (Ctrl-C) and to report; what it throws then, or false from
/// `waiting.progress`, stops the work. Throws what the work threw.
void runUnlocked(const Waiting& waiting, const std::function<void(const Progress&)>& work);

template <class Make>
auto unlocked(const Waiting& waiting, const Make& make) {
  using Product = decltype(make(Progress{}));
  std::unique_ptr<Product> made;
  runUnlocked(waiting,
              [&](const Progress& progress) { made = std::make_unique<Product>(make(progress)); });
  return std::move(*made);
}

/// A read-only array on the owner's memory, which lives as long as the array does. Strides in
/// bytes.
template <class T>
py::array view(const T* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
               const py::object& owner) {
  py::array_t<T> array(std::move(shape), std::move(strides), data, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// A read-only view of a grid as [x, y, z]: x is fastest, Fortran's order.
template <class T>
py::array gridView(const Array3D<T>& grid, const py::object& owner) {
  const Vec3i& n = grid.size();
  const auto size = static_cast<py::ssize_t>(sizeof(T));
  return view(grid.data(), {n.x, n.y, n.z}, {size, size * n.x, size * n.x * n.y}, owner);
}

/// A grid with a copy of an array of three dimensions, any strides. Throws `InputError`.
template <class T>
Array3D<T> gridOf(const py::array_t<T, py::array::forcecast>& array, const std::string& name) {
  if (array.ndim() != 3) throw InputError(name + ": an array of three dimensions is wanted");
  const auto values = array.template unchecked<3>();
  for (int axis = 0; axis < 3; ++axis) {
    if (array.shape(axis) < 1 || array.shape(axis) > 32767)
      throw InputError(name + ": each side has to have 1 to 32,767 samples");
  }
  Array3D<T> grid({static_cast<int>(array.shape(0)), static_cast<int>(array.shape(1)),
                   static_cast<int>(array.shape(2))});
  for (int k = 0; k < grid.size().z; ++k)
    for (int j = 0; j < grid.size().y; ++j)
      for (int i = 0; i < grid.size().x; ++i) grid(i, j, k) = values(i, j, k);
  return grid;
}

Vec3d vectorOf(const std::vector<double>& values, const std::string& name);
/// Three whole numbers, or one for all three.
Vec3i sidesOf(const py::object& given, const std::string& name);
/// "x,y", or a sequence of three truth values.
Axes axesOf(const py::object& given, const std::string& name);
/// Origins as `Result.origins` has them, of the first example and not turned; empty for None.
Origins originsOf(const py::object& given);
/// A path, or what is in memory.
Source sourceOf(const py::object& given);
/// The dicts and lists of JSON.
py::object loaded(const std::string& json);
inline py::tuple tupleOf(const Vec3d& v) { return py::make_tuple(v.x, v.y, v.z); }
inline py::tuple tupleOf(const Vec3i& v) { return py::make_tuple(v.x, v.y, v.z); }

/// Keys and texts, as Python made them of keyword arguments.
using Given = std::vector<std::pair<std::string, std::string>>;
Settings settingsOf(const Given& given);

/// A message of the library as Python spells settings: `field_block`.
std::string spelledAsKeywords(const std::string& message);

void addGeometry(py::module_& module);  ///< Mesh, Field, LabelGrid, Heights
void addParts(py::module_& module);     ///< what is done to fields and meshes: rooms by themselves
void addLabelParts(py::module_& module);  ///< the same of labels: pieces, adjacency, violations
void addSearch(py::module_& module);      ///< BlockIndex, nearest-neighbor fields
void addEngine(py::module_& module);      ///< Example, Result, synthesize, settings
void addWorld(py::module_& module);       ///< World

}  // namespace exemplar::python
