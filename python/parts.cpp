// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What is done to fields and meshes on the way from an example to a result, by itself.

#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <optional>

#include "engine/height_mesh.h"
#include "python/shared.h"
#include "reconstruct/field_to_mesh.h"
#include "reconstruct/smooth.h"
#include "reconstruct/transfer.h"
#include "sdf/height_map.h"
#include "sdf/redistance.h"
#include "sdf/resample.h"

namespace exemplar::python {
namespace {

using SharedMesh = std::shared_ptr<TriangleMesh>;
using SharedField = std::shared_ptr<DistanceField>;

SharedMesh contour(const DistanceField& field, bool close, const py::object& wraps,
                   double smallest) {
  const FieldToMeshOptions options{
      .close = close, .wraps = axesOf(wraps, "wraps"), .smallestPiece = smallest};
  return unlocked({}, [&](const Progress& progress) {
    return std::make_shared<TriangleMesh>(fieldToMesh(field, options, progress));
  });
}

SharedMesh smoothed(const TriangleMesh& mesh, int iterations, double strength, double most,
                    bool keepVolume) {
  return unlocked({}, [&](const Progress& progress) {
    auto copy = std::make_shared<TriangleMesh>(mesh);
    smooth(*copy,
           {.iterations = iterations, .strength = strength, .most = most, .keepVolume = keepVolume},
           progress);
    return copy;
  });
}

TextureTransfer texturesOf(const std::string& name) {
  if (name == "auto") return TextureTransfer::Automatic;
  if (name == "coordinates") return TextureTransfer::Coordinates;
  if (name == "vertex_colors") return TextureTransfer::VertexColors;
  if (name == "drop") return TextureTransfer::Drop;
  throw InputError("`textures` " + name + ": expected auto, coordinates, vertex_colors or drop");
}

SharedMesh transferred(const TriangleMesh& mesh, const std::shared_ptr<Made>& made,
                       const std::string& textures, double blend, bool source) {
  if (made->result.form() != Form::Field || made->result.origins.empty())
    throw InputError("transfer: only results of distance fields know where they came from");
  const TransferOptions options{.textures = texturesOf(textures),
                                .blend = blend,
                                .map = made->result.originMap.get(),
                                .sources = source};
  return unlocked({}, [&](const Progress& progress) {
    std::vector<ExampleView> examples;
    for (const Example& example : made->examples) {
      if (!example.mesh)
        throw InputError("transfer: the example " + example.name() + " has no triangles");
      examples.push_back({*example.mesh, example.field()});
    }
    auto copy = std::make_shared<TriangleMesh>(mesh);
    transferAppearance(*copy, made->result.field(), made->result.origins, examples, options,
                       progress);
    return copy;
  });
}

py::array sampledAt(const DistanceField& field,
                    const py::array_t<double, py::array::c_style | py::array::forcecast>& points) {
  if (points.ndim() != 2 || points.shape(1) != 3)
    throw InputError("points: an array of n x 3 is wanted");
  py::array_t<float> values(points.shape(0));
  const double* p = points.data();
  float* value = values.mutable_data();
  runUnlocked({}, [&](const Progress& progress) {
    for (py::ssize_t n = 0; n < points.shape(0); ++n, p += 3) {
      if (n % 65536 == 0) progress.check();
      value[n] = std::isfinite(p[0] + p[1] + p[2]) ? sampleTrilinear(field, {p[0], p[1], p[2]})
                                                   : std::numeric_limits<float>::quiet_NaN();
    }
  });
  return values;
}

void addFieldParts(py::module_& module) {
  auto field = py::reinterpret_borrow<py::class_<DistanceField, SharedField>>(module.attr("Field"));
  field.def("to_mesh", &contour, py::kw_only(), py::arg("close") = true,
            py::arg("wraps") = py::none(), py::arg("smallest_piece") = 8.0,
            "Its zero as a closed, manifold mesh. close: flat where the box cuts it. wraps: axes "
            "(\"x,y\") along which copies join, where it stays open. smallest_piece: voxels below "
            "which closed parts are dropped.");
  field.def("sample", &sampledAt, py::arg("points"),
            "Its values at world points, n x 3: trilinear, constant beyond the outer samples, NaN "
            "where a coordinate is not finite.");
  module.def("field_to_mesh", &contour, py::arg("field"), py::kw_only(), py::arg("close") = true,
             py::arg("wraps") = py::none(), py::arg("smallest_piece") = 8.0, "`Field.to_mesh`.");
  module.def("sample", &sampledAt, py::arg("field"), py::arg("points"), "`Field.sample`.");
  module.def(
      "redistance",
      [](const DistanceField& f, double halfWidth) {
        return unlocked({}, [&](const Progress& progress) {
          return std::make_shared<DistanceField>(redistance(f, {.halfWidth = halfWidth}, progress));
        });
      },
      py::arg("field"), py::kw_only(), py::arg("half_width") = 3.0,
      "True distances to the field's zero, exact up to half_width voxels and then clamped.");
  module.def(
      "block_average",
      [](const DistanceField& f, int factor) {
        if (factor < 1 || factor > 4096) throw InputError("factor: 1 to 4096 is wanted");
        return unlocked({}, [&](const Progress& progress) {
          progress.check();
          return std::make_shared<DistanceField>(blockAverage(f, factor));
        });
      },
      py::arg("field"), py::arg("factor"),
      "A field of voxels factor times as large: the means of factor ** 3 samples.");
}

void addMeshParts(py::module_& module) {
  auto mesh = py::reinterpret_borrow<py::class_<TriangleMesh, SharedMesh>>(module.attr("Mesh"));
  mesh.def("smooth", &smoothed, py::kw_only(), py::arg("iterations") = 10,
           py::arg("strength") = 0.5, py::arg("most") = std::numeric_limits<double>::infinity(),
           py::arg("keep_volume") = true,
           "A copy smoothed without shrinking (Taubin 1995). No vertex moves farther than most, "
           "world units.");
  module.def("_transfer", &transferred);
}

void addHeightParts(py::module_& module) {
  auto map = py::reinterpret_borrow<py::class_<HeightMap, std::shared_ptr<HeightMap>>>(
      module.attr("Heights"));
  map.def(
      "to_field",
      [](const HeightMap& m, int resolution, double voxelSize, int air, int ground,
         double halfWidth) {
        const HeightMapToSdfOptions options{voxelSize, resolution, air, ground, halfWidth};
        return unlocked({}, [&](const Progress& progress) {
          return std::make_shared<DistanceField>(heightMapToSdf(m, options, progress));
        });
      },
      py::kw_only(), py::arg("resolution") = 64, py::arg("voxel_size") = 0.0, py::arg("air") = 4,
      py::arg("ground") = 4, py::arg("half_width") = 3.0,
      "The signed distance of the ground below it, a Field.");
  map.def(
      "to_mesh",
      [](const HeightMap& m) {
        return unlocked({}, [&](const Progress& progress) {
          return std::make_shared<TriangleMesh>(meshOfHeights(m, progress));
        });
      },
      "Two triangles between each four points, open at its border.");
  map.def_static(
      "from_field",
      [](const DistanceField& f) {
        return unlocked({}, [&](const Progress& progress) {
          return std::make_shared<HeightMap>(sdfToHeightMap(f, progress));
        });
      },
      py::arg("field"), "The height of the topmost surface in each column of a field.");
}

}  // namespace

void addParts(py::module_& module) {
  addFieldParts(module);
  addMeshParts(module);
  addHeightParts(module);
}

}  // namespace exemplar::python
