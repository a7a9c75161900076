// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Meshes, fields, labels and heights as NumPy sees them.

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/error.h"
#include "engine/json.h"
#include "engine/output.h"
#include "maps/height_map_file.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_health.h"
#include "preview/render.h"
#include "python/shared.h"
#include "reconstruct/decimate.h"
#include "sdf/height_map.h"
#include "sdf/mesh_to_sdf.h"
#include "sdf/redistance.h"
#include "sdf/vdb_file.h"
#include "voxelize/label_file.h"
#include "voxelize/label_mesh.h"

namespace exemplar::python {
namespace {

template <class T>
using Dense = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// Rows of an array of numbers, with their shape after the first dimension checked.
template <class T>
std::size_t rowsOf(const Dense<T>& array, std::vector<py::ssize_t> shape, const char* name) {
  bool right = array.ndim() == static_cast<py::ssize_t>(shape.size()) + 1;
  for (std::size_t n = 0; right && n < shape.size(); ++n)
    right = array.shape(static_cast<py::ssize_t>(n) + 1) == shape[n];
  if (right) return static_cast<std::size_t>(array.shape(0));
  std::string text = "n";
  for (const py::ssize_t side : shape) text += " x " + std::to_string(side);
  throw InputError(std::string(name) + ": an array of " + text + " is wanted");
}

SignSource signOf(const std::string& text) {
  if (text == "auto") return SignSource::Automatic;
  if (text == "winding") return SignSource::WindingNumber;
  if (text == "parity") return SignSource::RayParity;
  if (text == "flood") return SignSource::Flood;
  throw InputError("`sign` " + text + ": expected auto, winding, parity or flood");
}

UpAxis upOf(const std::string& text) {
  if (text == "auto") return UpAxis::Default;
  if (text == "y") return UpAxis::Y;
  if (text == "z") return UpAxis::Z;
  throw InputError("`up` " + text + ": expected auto, y or z");
}

MeshNormals normalsOf(const std::string& text) {
  if (text == "crease") return MeshNormals::Crease;
  if (text == "smooth") return MeshNormals::Smooth;
  if (text == "none") return MeshNormals::None;
  throw InputError("`normals` " + text + ": expected crease, smooth or none");
}

std::shared_ptr<TriangleMesh> makeMesh(const Dense<double>& vertices,
                                       const Dense<std::int64_t>& faces,
                                       const std::optional<Dense<float>>& uvs,
                                       const std::optional<Dense<float>>& colors,
                                       const std::optional<Dense<std::uint32_t>>& faceMaterials,
                                       const py::list& materials) {
  auto mesh = std::make_shared<TriangleMesh>();
  const std::size_t n = rowsOf(vertices, {3}, "vertices"), m = rowsOf(faces, {3}, "faces");
  const double* p = vertices.data();
  for (std::size_t v = 0; v < n; ++v, p += 3) mesh->positions.push_back({p[0], p[1], p[2]});
  const std::int64_t* f = faces.data();
  for (std::size_t t = 0; t < m; ++t, f += 3) {
    for (int c = 0; c < 3; ++c) {
      if (f[c] < 0 || f[c] >= static_cast<std::int64_t>(n))
        throw InputError("faces: face " + std::to_string(t) + " names vertex " +
                         std::to_string(f[c]) + " of " + std::to_string(n));
    }
    mesh->triangles.push_back({static_cast<std::uint32_t>(f[0]), static_cast<std::uint32_t>(f[1]),
                               static_cast<std::uint32_t>(f[2])});
  }
  if (uvs) {
    if (rowsOf(*uvs, {3, 2}, "uvs") != m) throw InputError("uvs: one row a face is wanted");
    const float* u = uvs->data();
    for (std::size_t t = 0; t < m; ++t, u += 6)
      mesh->uvs.push_back({Vec2f{u[0], u[1]}, Vec2f{u[2], u[3]}, Vec2f{u[4], u[5]}});
  }
  if (colors) {
    if (rowsOf(*colors, {4}, "colors") != n) throw InputError("colors: one row a vertex is wanted");
    const float* c = colors->data();
    for (std::size_t v = 0; v < n; ++v, c += 4) mesh->colors.push_back({c[0], c[1], c[2], c[3]});
  }
  for (const py::handle& item : materials) {
    Material material;
    const py::dict of = py::reinterpret_borrow<py::dict>(item);
    if (of.contains("name")) material.name = of["name"].cast<std::string>();
    if (of.contains("color")) material.baseColor = of["color"].cast<std::array<float, 4>>();
    if (of.contains("metallic")) material.metallic = of["metallic"].cast<float>();
    if (of.contains("roughness")) material.roughness = of["roughness"].cast<float>();
    mesh->materials.push_back(std::move(material));
  }
  if (faceMaterials) {
    if (rowsOf(*faceMaterials, {}, "face_materials") != m)
      throw InputError("face_materials: one number a face is wanted");
    mesh->triangleMaterials.assign(faceMaterials->data(), faceMaterials->data() + m);
    const std::uint32_t most = m ? *std::ranges::max_element(mesh->triangleMaterials) : 0;
    while (mesh->materials.size() <= most) mesh->materials.emplace_back();
  }
  validate(*mesh, "mesh");
  return mesh;
}

py::list materialsOf(const TriangleMesh& mesh) {
  py::list list;
  for (const Material& material : mesh.materials) {
    py::dict of;
    of["name"] = material.name;
    of["color"] = material.baseColor;
    of["metallic"] = material.metallic;
    of["roughness"] = material.roughness;
    list.append(of);
  }
  return list;
}

py::array renderMesh(const TriangleMesh& mesh, int width, int height, const std::string& view,
                     int samples, const Waiting& waiting) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  options.view = viewFromName(view);
  options.samples = samples;
  const Image8 image =
      unlocked(waiting, [&](const Progress& progress) { return render(mesh, options, progress); });
  py::array_t<std::uint8_t> array({image.height, image.width, image.channels});
  std::copy(image.pixels.begin(), image.pixels.end(), array.mutable_data());
  return array;
}

void addMesh(py::module_& module) {
  using Class = py::class_<TriangleMesh, std::shared_ptr<TriangleMesh>>;
  Class mesh(module, "Mesh", "Triangles with materials, colors and texture coordinates.");
  mesh.def(py::init(&makeMesh), py::arg("vertices"), py::arg("faces"), py::kw_only(),
           py::arg("uvs") = py::none(), py::arg("colors") = py::none(),
           py::arg("face_materials") = py::none(), py::arg("materials") = py::list());
  const auto array = [&](const char* name, auto get, const char* meaning) {
    mesh.def_property_readonly(
        name,
        [get](const py::object& self) -> py::object {
          return get(self.cast<const TriangleMesh&>(), self);
        },
        meaning);
  };
  array(
      "vertices",
      [](const TriangleMesh& m, const py::object& o) -> py::object {
        return view(reinterpret_cast<const double*>(m.positions.data()),
                    {static_cast<py::ssize_t>(m.positions.size()), 3}, {24, 8}, o);
      },
      "n x 3 float64, z up; a view.");
  array(
      "faces",
      [](const TriangleMesh& m, const py::object& o) -> py::object {
        return view(reinterpret_cast<const std::uint32_t*>(m.triangles.data()),
                    {static_cast<py::ssize_t>(m.triangles.size()), 3}, {12, 4}, o);
      },
      "m x 3 uint32; a view.");
  array(
      "uvs",
      [](const TriangleMesh& m, const py::object& o) -> py::object {
        if (!m.hasUvs()) return py::none();
        return view(reinterpret_cast<const float*>(m.uvs.data()),
                    {static_cast<py::ssize_t>(m.uvs.size()), 3, 2}, {24, 8, 4}, o);
      },
      "m x 3 x 2 float32, a corner's texture coordinates, v up; a view, or None.");
  array(
      "colors",
      [](const TriangleMesh& m, const py::object& o) -> py::object {
        if (!m.hasColors()) return py::none();
        return view(reinterpret_cast<const float*>(m.colors.data()),
                    {static_cast<py::ssize_t>(m.colors.size()), 4}, {16, 4}, o);
      },
      "n x 4 float32, linear RGBA; a view, or None.");
  array(
      "face_materials",
      [](const TriangleMesh& m, const py::object& o) -> py::object {
        if (!m.hasMaterials()) return py::none();
        return view(m.triangleMaterials.data(),
                    {static_cast<py::ssize_t>(m.triangleMaterials.size())}, {4}, o);
      },
      "m uint32, numbers of `materials`; a view, or None.");
  array(
      "source_faces",
      [](const TriangleMesh& m, const py::object& o) -> py::object {
        if (m.sources.empty()) return py::none();
        constexpr auto s = static_cast<py::ssize_t>(sizeof(SourcePoint));
        return view(&m.sources.front()[0].triangle, {static_cast<py::ssize_t>(m.sources.size()), 3},
                    {3 * s, s}, o);
      },
      "m x 3 uint32: the example's triangle that each corner came from (`source=True`).");
  array(
      "source_weights",
      [](const TriangleMesh& m, const py::object& o) -> py::object {
        if (m.sources.empty()) return py::none();
        constexpr auto s = static_cast<py::ssize_t>(sizeof(SourcePoint));
        return view(m.sources.front()[0].weights.data(),
                    {static_cast<py::ssize_t>(m.sources.size()), 3, 2}, {3 * s, s, 4}, o);
      },
      "m x 3 x 2 float32: the weights of that triangle's first two corners.");
  mesh.def_property_readonly("materials", &materialsOf, "A dict for each: name, color, ...");
  mesh.def_property_readonly("bounds", [](const TriangleMesh& m) {
    const Box3d box = boundingBox(m);
    return py::make_tuple(tupleOf(box.min), tupleOf(box.max));
  });
  mesh.def(
      "health",
      [](const TriangleMesh& m) {
        const std::string text = unlocked(
            {}, [&](const Progress& progress) { return toJson(meshHealth(m, progress)).dump(); });
        return py::module_::import("json").attr("loads")(text);
      },
      "Whether it is closed, manifold, oriented, and counts of what is not so.");
  mesh.def(
      "decimate",
      [](const TriangleMesh& m, std::int64_t triangles, double error) {
        if (triangles < 0 || !(error >= 0))
          throw InputError("decimate: numbers from 0 on are wanted");
        return unlocked({}, [&](const Progress& progress) {
          auto copy = std::make_shared<TriangleMesh>(m);
          // To a number of triangles, however far the surface moves.
          const bool far = error == 0 && triangles > 0;
          decimate(*copy,
                   {.error = far ? std::numeric_limits<double>::infinity() : error,
                    .triangles = triangles},
                   progress);
          return copy;
        });
      },
      py::kw_only(), py::arg("triangles") = 0, py::arg("error") = 0.0,
      "A copy with merged triangles: down to a number, or within an error in world units. Of "
      "meshes without materials and colors; Result.mesh(triangles=...) keeps those.");
  mesh.def("_write", [](const TriangleMesh& m, const std::filesystem::path& path,
                        const std::string& up, const std::string& normals) {
    requireOutput(path, kMeshEndings);
    const MeshFileOptions options{.up = upOf(up), .normals = normalsOf(normals)};
    runUnlocked({}, [&](const Progress& progress) { writeMesh(path, m, options, progress); });
  });
  mesh.def("_render", [](const TriangleMesh& m, int width, int height, const std::string& from,
                         int samples, const py::object& progress) {
    return renderMesh(m, width, height, from, samples, {progress});
  });
  mesh.def("__repr__", [](const TriangleMesh& m) {
    return "<exemplar.Mesh of " + std::to_string(m.positions.size()) + " vertices and " +
           std::to_string(m.triangles.size()) + " faces>";
  });
  module.def("_read_mesh", [](const std::filesystem::path& path, const std::string& up) {
    return unlocked({}, [&](const Progress& progress) {
      return std::make_shared<TriangleMesh>(readMesh(path, {.up = upOf(up)}, progress));
    });
  });
}

void addField(py::module_& module) {
  using Class = py::class_<DistanceField, std::shared_ptr<DistanceField>>;
  Class field(module, "Field", "Signed distances at voxel centers, negative inside, world units.");
  field.def(py::init([](const py::array_t<float, py::array::forcecast>& values, double voxelSize,
                        const std::vector<double>& origin, double truncation) {
              if (!(voxelSize > 0) || !std::isfinite(voxelSize))
                throw InputError("voxel_size: a number above 0 is wanted");
              if (!(truncation > 0)) throw InputError("truncation: a number above 0 is wanted");
              auto made = std::make_shared<DistanceField>();
              made->values = gridOf<float>(values, "values");
              for (const float value : made->values.values())
                if (std::isnan(value)) throw InputError("values: some are not numbers (NaN)");
              made->voxelSize = voxelSize;
              made->origin = vectorOf(origin, "origin");
              made->truncation = static_cast<float>(truncation);
              return made;
            }),
            py::arg("values"), py::kw_only(), py::arg("voxel_size") = 1.0,
            py::arg("origin") = std::vector<double>{0, 0, 0},
            py::arg("truncation") = std::numeric_limits<double>::infinity());
  field.def_property_readonly(
      "values",
      [](const py::object& self) {
        return gridView(self.cast<const DistanceField&>().values, self);
      },
      "[x, y, z] float32 in Fortran's order: a view, read-only.");
  field.def_property_readonly("shape", [](const DistanceField& f) { return tupleOf(f.size()); });
  field.def_readonly("voxel_size", &DistanceField::voxelSize);
  field.def_property_readonly("origin", [](const DistanceField& f) { return tupleOf(f.origin); });
  field.def_readonly("truncation", &DistanceField::truncation);
  field.def(
      "write",
      [](const DistanceField& f, const std::filesystem::path& path, const py::object& wraps) {
        requireOutput(path, ".vdb");
        const Axes axes = axesOf(wraps, "wraps");
        runUnlocked(
            {}, [&](const Progress& progress) { writeVdb(path, f, {.wraps = axes}, progress); });
      },
      py::arg("path"), py::kw_only(), py::arg("wraps") = py::none(),
      "Writes a .vdb. wraps: axes (\"x,y\") along which copies of it tile, kept in the file.");
  field.def(
      "redistanced",
      [](const DistanceField& f) {
        return unlocked({}, [&](const Progress& progress) {
          return std::make_shared<DistanceField>(redistance(f, {}, progress));
        });
      },
      "Distances made anew from the zero.");
  field.def("__repr__", [](const DistanceField& f) {
    const Vec3i& n = f.size();
    return "<exemplar.Field of " + std::to_string(n.x) + " x " + std::to_string(n.y) + " x " +
           std::to_string(n.z) + " samples>";
  });
  module.def(
      "read_field",
      [](const std::filesystem::path& path) {
        return unlocked({}, [&](const Progress& progress) {
          return std::make_shared<DistanceField>(readVdb(path, {}, nullptr, progress));
        });
      },
      py::arg("path"), "The level set of a .vdb file.");
  module.def(
      "mesh_to_field",
      [](const TriangleMesh& mesh, int resolution, double voxelSize, int padding, double halfWidth,
         const std::string& sign) {
        if (resolution < 1 || resolution > 4096 || !(voxelSize >= 0) || padding < 0 ||
            padding > 1024 || !(halfWidth > 0))
          throw InputError(
              "mesh_to_field: resolution 1 to 4096, voxel_size from 0 on, padding 0 to "
              "1024 and half_width above 0 are wanted");
        const MeshToSdfOptions options{.voxelSize = voxelSize,
                                       .resolution = resolution,
                                       .padding = padding,
                                       .halfWidth = halfWidth,
                                       .sign = signOf(sign)};
        return unlocked({}, [&](const Progress& progress) {
          return std::make_shared<DistanceField>(meshToSdf(mesh, options, progress));
        });
      },
      py::arg("mesh"), py::kw_only(), py::arg("resolution") = 64, py::arg("voxel_size") = 0.0,
      py::arg("padding") = 4, py::arg("half_width") = 3.0, py::arg("sign") = "auto",
      "Signed distances of any mesh: closed, open, crossing itself or a soup. sign: auto, winding, "
      "parity or flood, how inside and outside are distinguished.");
}

void addLabels(py::module_& module) {
  using Class = py::class_<LabelGrid, std::shared_ptr<LabelGrid>>;
  Class grid(module, "LabelGrid", "A grid of labels.");
  grid.def(py::init([](const py::array_t<std::int64_t, py::array::forcecast>& labels,
                       const std::vector<std::string>& names,
                       const std::vector<std::array<float, 4>>& colors,
                       const std::vector<double>& cellSize, const std::vector<double>& origin) {
             const Array3D<std::int64_t> wide = gridOf<std::int64_t>(labels, "labels");
             auto made = std::make_shared<LabelGrid>();
             made->cells = Array3D<Label>(wide.size());
             std::int64_t most = 0;
             for (std::size_t c = 0; c < wide.count(); ++c) {
               const std::int64_t label = wide.values()[c];
               if (label < 0 || label >= kMostLabels)
                 throw InputError("labels: " + std::to_string(label) + " is not in 0..65535");
               most = std::max(most, label);
               made->cells.values()[c] = static_cast<Label>(label);
             }
             const auto count =
                 std::max({static_cast<std::size_t>(most) + 1, names.size(), colors.size()});
             if (count > static_cast<std::size_t>(kMostLabels))
               throw InputError("names: there may be 65,536 labels");
             for (std::size_t l = 0; l < count; ++l) {
               LabelLook look = l == 0 ? emptyLook() : LabelLook{};
               if (l > 0) look.color = distinctColor(static_cast<int>(l));
               if (l < names.size()) look.name = names[l];
               if (l < colors.size()) look.color = colors[l];
               made->labels.push_back(std::move(look));
             }
             made->cellSize = vectorOf(cellSize, "cell_size");
             made->origin = vectorOf(origin, "origin");
             validate(*made, "labels");
             return made;
           }),
           py::arg("labels"), py::kw_only(), py::arg("names") = std::vector<std::string>{},
           py::arg("colors") = std::vector<std::array<float, 4>>{},
           py::arg("cell_size") = std::vector<double>{1, 1, 1},
           py::arg("origin") = std::vector<double>{0, 0, 0});
  grid.def_property_readonly(
      "labels",
      [](const py::object& self) { return gridView(self.cast<const LabelGrid&>().cells, self); },
      "[x, y, z] uint16 in Fortran's order: a view, read-only. 0 is empty.");
  grid.def_property_readonly("shape", [](const LabelGrid& g) { return tupleOf(g.size()); });
  grid.def_property_readonly("names", [](const LabelGrid& g) {
    std::vector<std::string> names;
    for (const LabelLook& look : g.labels) names.push_back(look.name);
    return names;
  });
  grid.def_property_readonly("colors", [](const LabelGrid& g) {
    std::vector<std::array<float, 4>> colors;
    for (const LabelLook& look : g.labels) colors.push_back(look.color);
    return colors;
  });
  grid.def_property_readonly("cell_size", [](const LabelGrid& g) { return tupleOf(g.cellSize); });
  grid.def_property_readonly("origin", [](const LabelGrid& g) { return tupleOf(g.origin); });
  grid.def(
      "write",
      [](const LabelGrid& g, const std::filesystem::path& path) {
        requireOutput(path, kLabelEndings);
        runUnlocked({}, [&](const Progress& progress) { writeLabels(path, g, progress); });
      },
      py::arg("path"));
  grid.def(
      "to_mesh",
      [](const LabelGrid& g) {
        return unlocked({}, [&](const Progress& progress) {
          return std::make_shared<TriangleMesh>(labelMesh(g, {}, progress));
        });
      },
      "Boxes of the labels' colors.");
  grid.def("__repr__", [](const LabelGrid& g) {
    const Vec3i& n = g.size();
    return "<exemplar.LabelGrid of " + std::to_string(n.x) + " x " + std::to_string(n.y) + " x " +
           std::to_string(n.z) + " cells and " + std::to_string(g.labelCount()) + " labels>";
  });
  module.def(
      "read_labels",
      [](const std::filesystem::path& path) {
        return unlocked({}, [&](const Progress& progress) {
          return std::make_shared<LabelGrid>(readLabels(path, progress));
        });
      },
      py::arg("path"), "A grid of labels: .txt, .vox, .vdb, .png or .csv.");
}

void addHeights(py::module_& module) {
  using Class = py::class_<HeightMap, std::shared_ptr<HeightMap>>;
  Class map(module, "Heights", "Heights on a square grid, world units; rows from the north.");
  map.def(py::init([](const Dense<float>& heights, double cellSize) {
            if (heights.ndim() != 2 || heights.shape(0) < 2 || heights.shape(1) < 2)
              throw InputError("heights: an array of two dimensions is wanted, 2 or more a side");
            if (!(cellSize > 0)) throw InputError("cell_size: a number above 0 is wanted");
            auto made = std::make_shared<HeightMap>();
            made->heights =
                Grid<float>(static_cast<int>(heights.shape(1)), static_cast<int>(heights.shape(0)));
            made->cellSize = cellSize;
            made->cellSizeKnown = true;
            std::copy_n(heights.data(), heights.size(), made->heights.values().data());
            for (const float height : made->heights.values())
              if (std::isinf(height)) throw InputError("heights: some are infinite");
            return made;
          }),
          py::arg("heights"), py::kw_only(), py::arg("cell_size") = 1.0);
  map.def_property_readonly(
      "heights",
      [](const py::object& self) {
        const auto& m = self.cast<const HeightMap&>();
        return view(m.heights.values().data(), {m.height(), m.width()},
                    {4 * py::ssize_t{m.width()}, 4}, self);
      },
      "[row, column] float32: a view, read-only; NaN where there is no data.");
  map.def_readonly("cell_size", &HeightMap::cellSize);
  map.def(
      "write",
      [](const HeightMap& m, const std::filesystem::path& path) {
        requireOutput(path, kHeightMapEndings);
        runUnlocked({}, [&](const Progress& progress) { writeHeightMap(path, m, {}, progress); });
      },
      py::arg("path"));
  map.def("__repr__", [](const HeightMap& m) {
    return "<exemplar.Heights of " + std::to_string(m.width()) + " x " +
           std::to_string(m.height()) + " points>";
  });
  module.def(
      "read_heights",
      [](const std::filesystem::path& path) {
        return unlocked({}, [&](const Progress& progress) {
          return std::make_shared<HeightMap>(readHeightMap(path, {}, progress));
        });
      },
      py::arg("path"), "A height map: .png, .pgm or .asc.");
}

}  // namespace

void addGeometry(py::module_& module) {
  addMesh(module);
  addField(module);
  addLabels(module);
  addHeights(module);
}

}  // namespace exemplar::python
