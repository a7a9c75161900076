// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Examples, requests and results: the front door as Python enters it.

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <span>

#include "core/error.h"
#include "engine/engine.h"
#include "engine/json.h"
#include "engine/measured.h"
#include "engine/output.h"
#include "engine/page.h"
#include "engine/realize.h"
#include "mesh/scene.h"
#include "python/shared.h"
#include "sdf/vdb_file.h"

namespace exemplar::python {
namespace {

Extent extentOf(const Given& given) { return requestOf(settingsOf(given)).extent; }

bool same(const std::optional<Extent>& a, const Extent& b) {
  return a && a->scale == b.scale && a->size == b.size;
}

/// The form that settings of reading are for: an engine's, or the source's own.
const Engine& engineOf(const std::string& name, const Source& source) {
  return name.empty() || name == "auto" ? engineFor(source) : engineNamed(name, source);
}

ReadOptions readingOf(const Settings& settings, Form form) {
  ReadOptions options;
  options.form = form;
  readingSettings(form).apply(settings, options);
  checkReading(options);
  return options;
}

SharedExample readOne(const py::object& given, const std::string& engine, const Given& settings,
                      const Given& extent, const Waiting& waiting) {
  const Source source = sourceOf(given);
  requireThere(source);
  const Form form = engineOf(engine, source).form();
  ReadOptions reading = readingOf(settingsOf(settings), form);
  if (form == Form::Field) reading.wanted = extentOf(extent);
  return unlocked(waiting, [&](const Progress& progress) {
    return std::make_shared<const Example>(readExample(source, reading, progress));
  });
}

using SharedMade = std::shared_ptr<const Made>;

SharedMade synthesizeAll(const std::vector<SharedExample>& given, const std::string& engineName,
                         const Given& texts, const py::object& keep, const py::object& guide,
                         const py::object& on, int detail, const Waiting& waiting) {
  if (given.empty()) throw InputError("synthesize: an example is wanted");
  Settings settings = settingsOf(texts);
  const Engine& engine = engineName.empty() || engineName == "auto"
                             ? engineFor(given.front()->source, settings)
                             : engineNamed(engineName);
  checkSettings(engine, settings);
  Request request = requestOf(settings);
  if (!keep.is_none()) request.decided.keep = sourceOf(keep);
  if (!guide.is_none()) request.guide = sourceOf(guide);
  if (!on.is_none()) request.on = sourceOf(on);
  request.reading = given.front()->reading;
  engine.check(request, given.size());
  if (detail < 1 || detail > 16) throw InputError("`detail`: 1 to 16 is wanted");
  return unlocked(waiting, [&](const Progress& progress) {
    auto made = std::make_shared<Made>();
    // A mesh is read for the size of what is made of it, and fields share the first one's voxels.
    const Form form = engine.form();
    bool fits = given.size() == 1 && given.front()->form() == form;
    if (form == Form::Field && given.front()->kind == SourceKind::Mesh)
      fits = fits && same(given.front()->reading.wanted, request.extent);
    if (fits) {
      made->examples = {*given.front()};
    } else {
      std::vector<Source> sources;
      for (const SharedExample& example : given) sources.push_back(example->source);
      ReadOptions reading = given.front()->form() == form ? given.front()->reading : ReadOptions{};
      reading.form = form;
      if (form == Form::Field) reading.wanted = request.extent;
      made->examples = readExamples(sources, reading, progress.part(0, 0.2));
    }
    made->reading = made->examples.front().reading;
    made->result = engine.run(made->examples, request, progress.part(0.2, detail > 1 ? 0.7 : 1));
    if (made->result.outcome == Outcome::Cancelled) throw Cancelled();
    if (detail > 1 && made->result.outcome == Outcome::Complete) {
      made->examples = refined(made->examples, detail, progress.part(0.7, 0.85));
      made->result = withDetail(made->result, made->examples, detail, progress.part(0.85, 1));
    }
    return SharedMade(std::move(made));
  });
}

std::string textOf(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

SurfaceOptions surfaceOf(const Made& made, const Given& given) {
  SurfaceOptions options;
  const SettingTable<SurfaceOptions>& table = surfaceSettings(made.result.form());
  const Settings settings = settingsOf(given);
  for (const auto& [key, text] : settings.given()) {
    bool known = false;
    for (const Setting& setting : table.settings()) known = known || setting.key == key;
    if (!known || key == "detail" || key == "lods")
      throw InputError("`" + key + "`: the surface of this result has no such setting");
  }
  table.apply(settings, options);
  requireSurface(options, made.all());
  return options;
}

std::shared_ptr<TriangleMesh> meshOf(const Made& made, const Given& given, const Waiting& waiting) {
  const SurfaceOptions options = surfaceOf(made, given);
  return unlocked(waiting, [&](const Progress& progress) {
    Surface surface = realize(made.result, made.all(), options, progress);
    return std::make_shared<TriangleMesh>(std::move(surface.mesh));
  });
}

/// Writes the result by the path's ending; `origins`, too, where that is not empty.
std::vector<std::string> saveTo(const Made& made, const std::filesystem::path& path,
                                const std::filesystem::path& origins, const Given& given,
                                const Waiting& waiting) {
  requireOutput(path, outputEndings(made.result.form()));
  requireOutputKind(path, !made.result.laterFrames.empty(), false);
  if (!origins.empty()) {
    requireOutput(origins, ".vdb");
    if (made.result.form() != Form::Field)
      throw InputError("origins: only results of distance fields have them");
  }
  const SurfaceOptions options = surfaceOf(made, given);
  OutputOptions output{made.reading.mesh, false, {}, {}};
  return unlocked(waiting, [&](const Progress& progress) {
    std::optional<Surface> surface;
    if (needsSurface(path, made.result, output))
      surface = realize(made.result, made.all(), options, progress.part(0, 0.8));
    const Written written =
        writeResult(path, made.result, made.all(), surface ? &*surface : nullptr, output,
                    progress.part(0.8, 1));
    if (!origins.empty())
      writeOriginsVdb(origins, made.result.origins, made.result.field(),
                      {.turn = made.examples.front().turn, .scale = {}});
    return written.warnings;
  });
}

py::object measuresOf(const Made& made, const Waiting& waiting) {
  const Json json = unlocked(waiting, [&](const Progress& progress) {
    Json all = Json::object();
    if (const auto measures = measure(made.result, made.all(), nullptr, progress.part(0, 0.7)))
      all.update(toJson(figures(*measures)));
    if (const auto content = measureContent(made.result, made.all(), progress.part(0.7, 0.9)))
      all.update(toJson(figures(*content)));
    if (const auto terrain = measureTerrain(made.result, made.all(), progress.part(0.9, 1)))
      all.update(toJson(figures(*terrain)));
    return all;
  });
  return loaded(textOf(json));
}

/// Figures of something that is no `Result`, against an example.
py::object measuresOfOther(const SharedExample& example, const py::object& given,
                           const py::object& origins, const py::object& mesh,
                           const Waiting& waiting) {
  const Source result = sourceOf(given);
  requireThere(result);
  const bool labels = example->form() == Form::Labels;
  if (!labels && example->form() != Form::Field)
    throw InputError("measure: an example of distances or of labels is wanted, or a `Result`");
  Origins cells = originsOf(origins);
  std::optional<TriangleMesh> surface;
  if (!mesh.is_none()) surface = mesh.cast<const TriangleMesh&>();
  const Json json = unlocked(waiting, [&](const Progress& progress) {
    if (labels) return toJson(figures(measureContent(result, *example, progress)));
    Measured measured = readMeasured(result, {}, {}, *example, progress.part(0, 0.3));
    if (!cells.empty()) measured.origins = std::move(cells);
    if (surface) measured.mesh = std::move(surface);
    return toJson(figures(measure(measured, *example, progress.part(0.3, 1))));
  });
  return loaded(textOf(json));
}

/// The page of a result beside its example.
void reportTo(const Made& made, const std::filesystem::path& path, const Waiting& waiting) {
  requireOutput(path, ".html");
  const Example& example = made.examples.front();
  runUnlocked(waiting, [&](const Progress& progress) {
    const Surface surface = realize(made.result, made.all(), {}, progress.part(0, 0.3));
    Json run = {{"engine", made.result.engine}, {"seed", made.result.seed}};
    if (const auto measures =
            measure(made.result, made.all(), &surface.mesh, progress.part(0.3, 0.6)))
      run["figures"] = toJson(figures(*measures));
    if (const auto content = measureContent(made.result, made.all(), progress.part(0.6, 0.65)))
      run["figures"].update(toJson(figures(*content)));
    const TriangleMesh whole = pictured(example, progress.part(0.65, 0.7));
    const std::optional<SampledResult> samples = sampled(made.result, example);
    const auto* labeled = std::get_if<LabeledField>(&example.content);
    ResultPage page{path, example.source.path(), example.description, whole, surface.mesh};
    page.turn = example.turn;
    if (samples) {
      page.exampleField = labeled ? &labeled->field : &example.field();
      page.field = &samples->field;
      page.origins = &samples->origins;
    }
    writePage(page, std::move(run), {}, progress.part(0.7, 1));
  });
}

template <class T>
py::object part(const Representation& data, const T* from, const py::object& owner) {
  if (from == nullptr || !std::holds_alternative<T>(data)) return py::none();
  // Shares the memory of what it is a part of, which it keeps alive.
  return py::cast(from, py::return_value_policy::reference_internal, owner);
}

template <class Class, class Get>
void addData(Class& type, const Get& data) {
  const auto of = [&](const char* name, auto kind, const char* meaning) {
    using T = typename decltype(kind)::type;
    type.def_property_readonly(
        name,
        [data](const py::object& self) -> py::object {
          const Representation& all = data(self);
          return part<T>(all, std::get_if<T>(&all), self);
        },
        meaning);
  };
  of("field", std::type_identity<DistanceField>{}, "Its distances, or None.");
  of("labels", std::type_identity<LabelGrid>{}, "Its labels, or None.");
  of("heights", std::type_identity<HeightMap>{}, "Its heights, or None.");
}

py::list settingsList(const std::vector<Setting>& settings) {
  py::list list;
  for (const Setting& setting : settings) {
    py::dict of;
    of["key"] = setting.key;
    of["type"] = std::string(typeName(setting.type));
    of["meaning"] = setting.meaning;
    of["unit"] = setting.unit;
    of["least"] = setting.least;
    of["most"] = setting.most;
    of["choices"] = setting.choices;
    of["default"] = setting.byDefault;
    of["repeats"] = setting.repeats;
    list.append(of);
  }
  return list;
}

void addExample(py::module_& module) {
  py::class_<Example, std::shared_ptr<Example>> example(module, "_Example");
  addData(example, [](const py::object& self) -> const Representation& {
    return self.cast<const Example&>().data;
  });
  example.def_property_readonly("mesh", [](const py::object& self) -> py::object {
    const auto& e = self.cast<const Example&>();
    if (!e.mesh) return py::none();
    return py::cast(&*e.mesh, py::return_value_policy::reference_internal, self);
  });
  example.def_readonly("description", &Example::description);
  example.def_readonly("warnings", &Example::warnings);
  example.def_property_readonly("name", &Example::name);
  module.def("_read", [](const py::object& source, const std::string& engine, const Given& settings,
                         const Given& extent, const py::object& progress, int threads) {
    return std::const_pointer_cast<Example>(
        readOne(source, engine, settings, extent, {progress, threads}));
  });
  module.def("_pictured", [](const std::shared_ptr<Example>& of) {
    return unlocked({}, [&](const Progress& progress) {
      return std::make_shared<TriangleMesh>(pictured(*of, progress));
    });
  });
}

void addResult(py::module_& module) {
  py::class_<Made, std::shared_ptr<Made>> result(module, "_Result");
  addData(result, [](const py::object& self) -> const Representation& {
    return self.cast<const Made&>().result.data;
  });
  const auto originView = [&](const char* name, auto get) {
    result.def_property_readonly(name, [get](const py::object& self) -> py::object {
      const auto& made = self.cast<const Made&>();
      if (made.result.origins.empty()) return py::none();
      return get(made.result.origins, self);
    });
  };
  constexpr auto step = static_cast<py::ssize_t>(sizeof(Origin));
  static_assert(sizeof(Origin) == 8, "i, j, k are neighbors, and views stride over the rest");
  originView("origins", [](const Origins& o, const py::object& self) -> py::object {
    const Vec3i& n = o.size();
    return view(&o.data()->i, {n.x, n.y, n.z, 3}, {step, step * n.x, step * n.x * n.y, 2}, self);
  });
  originView("origin_example", [](const Origins& o, const py::object& self) -> py::object {
    const Vec3i& n = o.size();
    return view(&o.data()->example, {n.x, n.y, n.z}, {step, step * n.x, step * n.x * n.y}, self);
  });
  originView("origin_turns", [](const Origins& o, const py::object& self) -> py::object {
    const Vec3i& n = o.size();
    return view(&o.data()->turns, {n.x, n.y, n.z}, {step, step * n.x, step * n.x * n.y}, self);
  });
  result.def_property_readonly(
      "outcome", [](const Made& m) { return std::string(outcomeName(m.result.outcome)); });
  result.def_property_readonly("why",
                               [](const Made& m) { return spelledAsKeywords(m.result.why); });
  result.def_property_readonly("conflict", [](const Made& m) -> py::object {
    if (!m.result.conflict) return py::none();
    py::dict of;
    of["text"] = m.result.conflict->text;
    of["pins"] = m.result.conflict->pins;
    of["sides"] = m.result.conflict->sides;
    return of;
  });
  result.def_property_readonly("engine", [](const Made& m) { return m.result.engine; });
  result.def_property_readonly("seed", [](const Made& m) { return m.result.seed; });
  result.def_property_readonly(
      "statistics", [](const Made& m) { return loaded(textOf(toJson(m.result.statistics))); });
  result.def_property_readonly("notes", [](const Made& m) {
    py::dict of;
    for (const auto& [label, note] : m.result.notes) of[py::str(label)] = note;
    return of;
  });
  result.def_property_readonly("warnings", [](const Made& m) {
    std::vector<std::string> all;
    for (const auto* some : {&m.examples.front().warnings, &m.result.warnings})
      for (const std::string& warning : *some) all.push_back(spelledAsKeywords(warning));
    return all;
  });
  result.def_property_readonly("extent", [](const Made& m) { return readableExtent(m.result); });
  result.def("_mesh", [](const std::shared_ptr<Made>& m, const Given& settings,
                         const py::object& progress, int threads) {
    return meshOf(*m, settings, {progress, threads});
  });
  result.def("_save", [](const std::shared_ptr<Made>& m, const std::filesystem::path& path,
                         const std::filesystem::path& origins, const Given& settings,
                         const py::object& progress, int threads) {
    return saveTo(*m, path, origins, settings, {progress, threads});
  });
  result.def("_measure",
             [](const std::shared_ptr<Made>& m, const py::object& progress, int threads) {
               return measuresOf(*m, {progress, threads});
             });
  result.def("_report", [](const std::shared_ptr<Made>& m, const std::filesystem::path& path,
                           const py::object& progress, int threads) {
    reportTo(*m, path, {progress, threads});
  });
  result.def_property_readonly("frames", [](const py::object& self) {
    const auto& made = self.cast<const Made&>();
    py::list frames;
    if (made.result.form() != Form::Labels) return frames;
    const auto add = [&](const LabelGrid& grid) {
      frames.append(py::cast(&grid, py::return_value_policy::reference_internal, self));
    };
    add(made.result.labels());
    for (const LabelGrid& grid : made.result.laterFrames) add(grid);
    return frames;
  });
  result.def("_detail", [](const std::shared_ptr<Made>& m, int factor,
                           const std::vector<std::shared_ptr<Example>>& of,
                           const py::object& progress, int threads) {
    if (factor < 2 || factor > 16) throw InputError("detail: a factor of 2 to 16 is wanted");
    if (m->result.form() != Form::Field)
      throw InputError("detail: only results of distance fields have finer detail");
    return unlocked({progress, threads}, [&](const Progress& p) {
      auto finer = std::make_shared<Made>();
      finer->reading = m->reading;
      std::vector<Example> examples = m->examples;
      if (!of.empty()) {
        examples.clear();
        for (const auto& example : of) examples.push_back(*example);
      }
      finer->examples = refined(examples, factor, p.part(0, 0.4));
      finer->result = withDetail(m->result, finer->examples, factor, p.part(0.4, 1));
      return finer;
    });
  });
  module.def("_measure", [](const std::shared_ptr<Example>& example, const py::object& other,
                            const py::object& origins, const py::object& mesh,
                            const py::object& progress, int threads) {
    return measuresOfOther(example, other, origins, mesh, {progress, threads});
  });
  module.def("_synthesize",
             [](const std::vector<std::shared_ptr<Example>>& examples, const std::string& engine,
                const Given& settings, const py::object& keep, const py::object& guide,
                const py::object& on, int detail, const py::object& progress, int threads) {
               return std::const_pointer_cast<Made>(
                   synthesizeAll({examples.begin(), examples.end()}, engine, settings, keep, guide,
                                 on, detail, {progress, threads}));
             });
}

}  // namespace

Source sourceOf(const py::object& given) {
  if (py::isinstance<TriangleMesh>(given)) return Source::of(given.cast<const TriangleMesh&>());
  if (py::isinstance<DistanceField>(given)) return Source::of(given.cast<const DistanceField&>());
  if (py::isinstance<LabelGrid>(given)) return Source::of(given.cast<const LabelGrid&>());
  if (py::isinstance<HeightMap>(given)) return Source::of(given.cast<const HeightMap&>());
  return Source(given.cast<std::filesystem::path>());
}

py::object loaded(const std::string& json) {
  return py::module_::import("json").attr("loads")(json);
}

void addEngine(py::module_& module) {
  addExample(module);
  addResult(module);
  module.def("scenes", &bundledScenes, "The names of the bundled scenes.");
  module.def("_find_scene", &findScene);
  module.def(
      "engines",
      [] {
        py::dict of;
        for (const Engine* engine : engines())
          of[py::str(std::string(engine->name()))] = std::string(engine->meaning());
        return of;
      },
      "The engines by name, with what each does.");
  module.def("_settings", [](const std::string& engine) {
    return settingsList(settingsOf(engineNamed(engine)));
  });
  module.def("_reading_keys", [](const std::string& name) {
    std::vector<std::string> keys;
    for (const Setting& setting : readingSettings(engineNamed(name).form()).settings())
      keys.push_back(setting.key);
    return keys;
  });
  module.def("_surface_keys", [](const std::string& name) {
    std::vector<std::string> keys;
    for (const Setting& setting : surfaceSettings(engineNamed(name).form()).settings())
      keys.push_back(setting.key);
    return keys;
  });
  module.def("_engine_for", [](const py::object& source) {
    return std::string(engineFor(sourceOf(source)).name());
  });
}

}  // namespace exemplar::python
