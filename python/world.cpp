// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Worlds: any tile of an example without end.

#include "engine/world.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>

#include "python/shared.h"

namespace exemplar::python {
namespace {

using SharedWorld = std::shared_ptr<World>;

std::shared_ptr<Made> madeOf(const World& world, Result result) {
  auto made = std::make_shared<Made>();
  made->examples.assign(world.examples().begin(), world.examples().end());
  made->reading = made->examples.front().reading;
  made->result = std::move(result);
  return made;
}

py::tuple create(const std::filesystem::path& folder, const py::object& example,
                 const std::string& engine, const Given& settings, const std::optional<int>& tile,
                 const std::optional<int>& window, const std::optional<int>& height,
                 const py::object& progress, int threads) {
  WorldRequest request{sourceOf(example),
                       engine == "auto" ? "" : engine,
                       settingsOf(settings),
                       tile,
                       window,
                       height};
  World::Created created = unlocked(
      {progress, threads}, [&](const Progress& p) { return World::create(folder, request, p); });
  std::vector<std::string> warnings;
  for (const std::string& warning : created.warnings)
    warnings.push_back(spelledAsKeywords(warning));
  py::object world = py::none();
  if (created.world) world = py::cast(std::make_shared<World>(std::move(*created.world)));
  return py::make_tuple(world, std::string(outcomeName(created.outcome)),
                        spelledAsKeywords(created.why), warnings);
}

}  // namespace

void addWorld(py::module_& module) {
  py::class_<World, SharedWorld> world(module, "_World");
  world.def("_tile", [](const SharedWorld& w, std::int64_t x, std::int64_t y,
                        const py::object& progress, int threads) {
    return unlocked({progress, threads}, [&](const Progress& p) {
      return madeOf(*w, w->tile({x, y}, p));
    });
  });
  world.def("_tiles", [](const SharedWorld& w, const std::array<std::int64_t, 4>& range,
                         const py::object& progress, int threads) {
    return unlocked({progress, threads}, [&](const Progress& p) {
      return madeOf(*w, w->tiles({{range[0], range[2]}, {range[1], range[3]}}, p));
    });
  });
  world.def_property_readonly("folder", [](const World& w) { return w.folder(); });
  world.def_property_readonly("engine", [](const World& w) { return w.file().engine; });
  world.def_property_readonly("seed", [](const World& w) { return w.file().seed; });
  world.def_property_readonly("tile_size", [](const World& w) { return w.file().tile; });
  world.def_property_readonly("height", [](const World& w) { return w.file().height; });
  module.def("_create_world", &create);
  module.def("_open_world", [](const std::filesystem::path& folder, bool cached) {
    return unlocked({}, [&](const Progress& progress) {
      return std::make_shared<World>(folder, cached, progress);
    });
  });
}

}  // namespace exemplar::python
