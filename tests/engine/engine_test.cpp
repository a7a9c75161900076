// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tbb/task_arena.h>

#include <cmath>
#include <numbers>
#include <set>

#include "core/error.h"
#include "engine/comparison.h"
#include "engine/engines.h"
#include "engine/measured.h"
#include "engine/realize.h"
#include "mesh/primitives.h"
#include "tests/engine/examples.h"
#include "voxelize/violations.h"

namespace exemplar {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Result runOn(const Engine& engine, const Example& example, const Request& request) {
  return engine.run({&example, 1}, request);
}

/// A picture of bright discs on dark ground.
Example discs() {
  MapLayer picture{"color", {Grid<float>(40, 36)}, 8};
  Grid<float>& plane = picture.planes.front();
  for (int y = 0; y < 36; ++y)
    for (int x = 0; x < 40; ++x)
      plane(x, y) = (x % 13 - 6) * (x % 13 - 6) + (y % 12 - 6) * (y % 12 - 6) < 17 ? 0.9f : 0.1f;
  Example example;
  example.source = "discs.png";
  example.reading.form = Form::Map;
  example.kind = SourceKind::Picture;
  Map map;
  map.layers.push_back(std::move(picture));
  example.data = std::move(map);
  return example;
}

/// A volume of labels: ore within stone.
LabelGrid ore() {
  LabelGrid grid;
  grid.cells = Array3D<Label>({20, 18, 16}, 0);
  grid.labels.resize(3);
  for (int label = 0; label < 3; ++label) grid.labels[label].color = distinctColor(label);
  for (std::size_t c = 0; c < grid.cells.count(); ++c) {
    const Vec3d p = cast<double>(grid.cells.ijk(c));
    const double waves = std::sin(0.8 * p.x) + std::sin(0.7 * p.y + 1) + std::sin(0.9 * p.z);
    grid.cells.values()[c] = static_cast<Label>((waves > 0) + (waves > 1.2));
  }
  return grid;
}

/// Waves of two directions.
HeightMap waves(int width, int height) {
  HeightMap map{Grid<float>(width, height), 2};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      map.heights(x, y) =
          static_cast<float>(10 * std::sin(0.2 * x) + 7 * std::sin(0.3 * y + 1) + 0.1 * x);
    }
  }
  return map;
}

Example exampleFor(const Engine& engine) {
  if (engine.form() == Form::Heights)
    return readExample(Source::of(waves(50, 44)), {.form = Form::Heights});
  if (engine.form() == Form::Map) return discs();
  if (engine.name() == "layered-volume") return readExample(Source::of(ore()));
  if (engine.form() == Form::Polygons)
    return readExample(Source::of(boxes()), {.form = Form::Polygons});
  return readExample(engine.form() == Form::Field ? Source::of(bumps()) : Source::of(rings()));
}

/// A small request that an engine answers quickly.
Request smallRequest(const Engine& engine, std::uint64_t seed = 0) {
  Request request;
  request.extent.size = engine.form() == Form::Field     ? Vec3i{36, 30, 12}
                        : engine.form() == Form::Labels  ? Vec3i{14, 12, 1}
                        : engine.form() == Form::Map     ? Vec3i{48, 40, 1}
                        : engine.form() == Form::Heights ? Vec3i{72, 60, 1}
                                                         : Vec3i{20, 10, 4};
  request.seed = seed;
  if (engine.name() == "surface") {
    request.extent = {};
    request.on = Source::of(makeSphere({0, 0, 0}, 12, 6));
    request.settings = {{"span", "24"}};
  }
  if (engine.name() == "layered-volume") request.extent.size = Vec3i{24, 20, 18};
  if (engine.name() == "blocks") request.settings = {{"block", "8"}};
  if (engine.form() == Form::Map) request.settings = {{"layers", "2"}, {"neighborhood", "5"}};
  return request;
}

TEST(Engines, AreFoundByNameAndByWhatTheExampleIs) {
  std::set<std::string_view> names;
  for (const Engine* engine : engines()) {
    EXPECT_TRUE(names.insert(engine->name()).second);
    EXPECT_EQ(&engineNamed(engine->name()), engine);
  }
  EXPECT_EQ(engineFor(Source::of(rings())).name(), "model");
  EXPECT_EQ(engineFor(Source::of(boxes())).name(), "geometry");
  EXPECT_EQ(engineFor("castle.png").name(), "terrain");
  EXPECT_EQ(engineFor(Source::of(waves(20, 20))).name(), "terrain");
  EXPECT_THAT([] { engineNamed("best"); },
              ThrowsMessage<InputError>(HasSubstr(
                  "expected geometry, quilting, voting, blocks, model, continuous, layered, "
                  "layered-volume, terrain or surface")));
}

TEST(Engines, EveryOneMakesWhatItIsAskedForWithOriginsOfTheExample) {
  for (const Engine* engine : engines()) {
    SCOPED_TRACE(engine->name());
    const Example example = exampleFor(*engine);
    const Request request = smallRequest(*engine);
    const Result result = runOn(*engine, example, request);
    ASSERT_EQ(result.outcome, Outcome::Complete) << result.why;
    EXPECT_EQ(result.engine, engine->name());
    if (engine->name() == "surface") {
      // It is bent, so that samples are mixed; whatever it is, it is solid around the ball.
      EXPECT_TRUE(result.originMap);
      EXPECT_TRUE(realize(result, {&example, 1}).health.closed());
      const Vec3i about = engine->extentOf({&example, 1}, request);
      EXPECT_LT(std::abs(about.x - result.field().size().x), 12);
      continue;
    }
    EXPECT_EQ(engine->extentOf({&example, 1}, request), *request.extent.size);
    if (engine->form() == Form::Polygons) {
      EXPECT_EQ(result.polygons().size, *request.extent.size);
      EXPECT_FALSE(result.polygons().polygons.empty());
    } else if (engine->form() == Form::Map) {
      EXPECT_EQ(result.map().width(), 48);
      EXPECT_EQ(result.map().height(), 40);
      EXPECT_NEAR(areaOf(layerShape(*result.layers, 2)),
                  areaOf(layerShape(*result.exampleLayers, 2)), 1e-3);
      EXPECT_THROW(realize(result, {&example, 1}), InputError);
      continue;
    } else if (engine->form() == Form::Heights) {
      EXPECT_EQ(result.heights().width(), 72);
      EXPECT_EQ(result.heights().height(), 60);
      EXPECT_EQ(result.heights().cellSize, 2);
      ASSERT_EQ(result.heightOrigins.count(), result.heights().heights.count());
      for (const HeightOrigin& origin : result.heightOrigins.values())
        ASSERT_TRUE(origin.x >= 0 && origin.x < 50 && origin.y >= 0 && origin.y < 44);
      EXPECT_TRUE(realize(result, {&example, 1}).health.manifold());
      continue;
    } else {
      ASSERT_EQ(result.origins.size(), *request.extent.size);
    }
    for (std::size_t s = 0; s < result.origins.count(); ++s) {
      const Vec3i from = result.origins.values()[s].cell();
      if (engine->form() == Form::Field) {
        ASSERT_EQ(result.field().values.values()[s] < 0, example.field().values[from] < 0);
      } else {
        ASSERT_EQ(result.labels().cells.values()[s], example.labels().cells[from]);
      }
    }
    const Surface surface = realize(result, {&example, 1});
    EXPECT_TRUE(surface.health.closed());
    EXPECT_EQ(measure(result, {&example, 1}, &surface.mesh).has_value(),
              engine->form() == Form::Field);
  }
}

TEST(Engines, GiveTheSameBytesAtOneAndEightThreads) {
  for (const Engine* engine : engines()) {
    SCOPED_TRACE(engine->name());
    const Example example = exampleFor(*engine);
    Result one, eight;
    tbb::task_arena(1).execute([&] { one = runOn(*engine, example, smallRequest(*engine, 5)); });
    tbb::task_arena(8).execute([&] { eight = runOn(*engine, example, smallRequest(*engine, 5)); });
    EXPECT_EQ(one.origins, eight.origins);
    if (engine->form() == Form::Field) {
      EXPECT_EQ(one.field().values, eight.field().values);
    } else if (engine->form() == Form::Polygons) {
      EXPECT_EQ(one.polygons().points, eight.polygons().points);
      EXPECT_EQ(one.polygons().polygons.size(), eight.polygons().polygons.size());
    } else if (engine->form() == Form::Map) {
      EXPECT_EQ(one.map().layers[0].planes, eight.map().layers[0].planes);
      EXPECT_EQ(*one.layers, *eight.layers);
    } else if (engine->form() == Form::Heights) {
      EXPECT_EQ(one.heights().heights, eight.heights().heights);
      EXPECT_EQ(one.heightOrigins, eight.heightOrigins);
    } else {
      EXPECT_EQ(one.labels().cells, eight.labels().cells);
    }
  }
}

TEST(Engines, WhatAnEngineDoesNotHaveIsRefusedNamingThoseThatDo) {
  const Example example = readExample(Source::of(bumps()));
  Request request = smallRequest(geometryEngine());
  request.settings = {{"seeding", "masked"}};
  EXPECT_THAT([&] { runOn(geometryEngine(), example, request); },
              ThrowsMessage<InputError>(
                  HasSubstr("`seeding`: the engine geometry has no such setting; blocks has")));
  request.settings = {{"patch", "99"}};
  EXPECT_THAT([&] { runOn(geometryEngine(), example, request); },
              ThrowsMessage<InputError>(HasSubstr("`patch` 99: expected 3 to 15")));
  request.settings = {};
  request.periodic = {true, false, false};
  EXPECT_THAT([&] { runOn(blocksEngine(), example, request); },
              ThrowsMessage<InputError>(HasSubstr(
                  "the engine blocks has no such setting; geometry, quilting, voting, model and "
                  "terrain")));
  EXPECT_THAT(
      [] {
        checkSettings(modelEngine(), {{"unheard-of", "1"}});
      },
      ThrowsMessage<InputError>(HasSubstr("no engine has it")));
  EXPECT_THAT(
      [] {
        checkSettings(modelEngine(), {{"rounds", "1"}, {"rounds", "2"}});
      },
      ThrowsMessage<InputError>(HasSubstr("given more than once")));
  EXPECT_NO_THROW(checkSettings(modelEngine(), {{"weight", "1=2"}, {"weight", "3=2"}}));
}

TEST(Engines, RefuseExamplesOfTheWrongFormAndNumber) {
  const Example labels = readExample(Source::of(rings())), field = readExample(Source::of(bumps()));
  EXPECT_THAT([&] { runOn(geometryEngine(), labels, {}); },
              ThrowsMessage<InputError>(HasSubstr("does not take this kind of example")));
  const Example two[] = {field, field};
  EXPECT_THAT([&] { blocksEngine().run(two, smallRequest(blocksEngine())); },
              ThrowsMessage<InputError>(HasSubstr("takes one example, not 2")));
}

TEST(Engines, CancellationIsAnOutcome) {
  std::atomic<bool> cancel = true;
  for (const Engine* engine : engines()) {
    const Example example = exampleFor(*engine);
    const Result result = engine->run({&example, 1}, smallRequest(*engine), Progress({}, &cancel));
    EXPECT_EQ(result.outcome, Outcome::Cancelled) << engine->name();
  }
}

TEST(Engines, ReportOneMonotoneFraction) {
  for (const Engine* engine : engines()) {
    const Example example = exampleFor(*engine);
    double last = 0;
    std::set<std::string> stages;
    engine->run({&example, 1}, smallRequest(*engine),
                Progress([&](std::string_view stage, double fraction) {
                  EXPECT_GE(fraction, last) << engine->name() << ", " << stage;
                  EXPECT_LE(fraction, 1);
                  last = fraction;
                  stages.emplace(stage);
                }));
    EXPECT_FALSE(stages.empty()) << engine->name();
  }
}

TEST(ModelEngine, AnImpossibleRequestNamesThePinsThatExcludeEachOther) {
  const Example example = readExample(Source::of(rings()));
  Request request = smallRequest(modelEngine());
  request.decided.pins = {{{1, 1, 0}, "0"}, {{4, 4, 0}, "corner"}, {{5, 4, 0}, "corner"}};
  const Result result = runOn(modelEngine(), example, request);
  ASSERT_EQ(result.outcome, Outcome::Impossible);
  ASSERT_TRUE(result.conflict);
  EXPECT_EQ(result.conflict->pins, (std::vector<int>{1, 2}));
  EXPECT_THAT(result.why, HasSubstr("impossible"));
}

TEST(ModelEngine, KeepsTheExamplesAdjacenciesAndPins) {
  const Example example = readExample(Source::of(rings()));
  Request request = smallRequest(modelEngine(), 3);
  request.decided.pins = {{{4, 4, 0}, "corner"}};
  const Result result = runOn(modelEngine(), example, request);
  ASSERT_EQ(result.outcome, Outcome::Complete);
  EXPECT_EQ(result.labels().cells(4, 4, 0), 5);
  EXPECT_EQ(findViolations(result.labels(), example.labels()).count, 0);
}

TEST(GeometryEngine, IsQuiltingForAPlainExampleAndVotingForWhatIsKept) {
  const Example example = readExample(Source::of(bumps()));
  const auto method = [&](const Request& request) {
    for (const auto& [key, value] : runOn(geometryEngine(), example, request).statistics)
      if (key == "method") return std::get<std::string>(value);
    return std::string();
  };
  Request request = smallRequest(geometryEngine());
  EXPECT_EQ(method(request), "quilting");
  request.settings = {{"completeness", "0.3"}};
  EXPECT_EQ(method(request), "voting");
  request.settings = {};
  DistanceField half = bumps();
  for (std::size_t s = 0; s < half.values.count(); ++s)
    half.values.values()[s] = half.values.ijk(s).x < 12 ? -1.0f : 1.0f;
  request.decided.keep = Source::of(half);
  EXPECT_EQ(method(request), "voting");
}

TEST(GeometryEngine, WhatIsKeptIsTheExamplesToTheBit) {
  const Example example = readExample(Source::of(bumps()));
  DistanceField half = bumps();
  for (std::size_t s = 0; s < half.values.count(); ++s)
    half.values.values()[s] = half.values.ijk(s).x < 12 ? -1.0f : 1.0f;
  Request request = smallRequest(geometryEngine());
  request.decided.keep = Source::of(half);
  const Result result = runOn(geometryEngine(), example, request);
  forEachCell(Vec3i{12, 24, 12}, [&](const Vec3i& p) {
    ASSERT_EQ(result.field().values[p], example.field().values[p]);
  });
  half.values = Array3D<float>(half.values.size(), 1.0f);
  request.decided.keep = Source::of(half);
  EXPECT_THAT([&] { runOn(geometryEngine(), example, request); },
              ThrowsMessage<InputError>(HasSubstr("`keep`: no sample of the example is inside")));
}

TEST(Engines, RefuseSettingsThatWouldDoNothing) {
  const Example field = readExample(Source::of(bumps())), labels = readExample(Source::of(rings()));
  Request request = smallRequest(geometryEngine());
  request.settings = {{"guide-weight", "3"}};
  EXPECT_THAT([&] { runOn(geometryEngine(), field, request); },
              ThrowsMessage<InputError>(HasSubstr("there is no `guide` to weigh")));
  request = smallRequest(modelEngine());
  request.settings = {{"method", "whole"}, {"block", "5"}};
  EXPECT_THAT([&] { runOn(modelEngine(), labels, request); },
              ThrowsMessage<InputError>(HasSubstr("`block`: `method` whole has no blocks")));
  request.settings = {{"mirrored-x", "5=7"}};
  EXPECT_THAT([&] { runOn(modelEngine(), labels, request); },
              ThrowsMessage<InputError>(HasSubstr("has no effect without `mirror` x")));
}

TEST(BlocksEngine, EverySearchGivesTheSameResult) {
  const Example example = readExample(Source::of(bumps()));
  Request request = smallRequest(blocksEngine(), 2);
  const Result index = runOn(blocksEngine(), example, request);
  for (const char* search : {"tree", "scan"}) {
    request.settings.set("search", search);
    EXPECT_EQ(runOn(blocksEngine(), example, request).origins, index.origins) << search;
  }
}

TEST(WithDetail, MultipliesTheSamplesAndKeepsTheSolid) {
  const Example coarse = readExample(Source::of(boxes()), {.resolution = 20});
  Request request;
  request.extent.scale = Vec3d{1.5, 1, 1};
  const Result result = runOn(votingEngine(), coarse, request);
  const std::vector<Example> finer = refined({&coarse, 1}, 2);
  const Result detailed = withDetail(result, finer, 2);
  EXPECT_EQ(detailed.field().size(), result.field().size() * 2);
  EXPECT_EQ(detailed.origins.size(), detailed.field().size());
  EXPECT_TRUE(realize(detailed, finer).health.closed());
}

TEST(ParseComparedEngine, TakesTheSettingsThatSynthTakes) {
  EXPECT_EQ(parseComparedEngine("optimize").engine, &geometryEngine());
  const ComparedEngine model = parseComparedEngine("model:field-block=12:rounds=2");
  EXPECT_EQ(model.settings.text("field-block"), "12");
  for (const auto& [text, says] : std::vector<std::pair<std::string, std::string>>{
           {"best", "expected geometry"},
           {"blocks:", "NAME:KEY=VALUE"},
           {"blocks:patch=7", "the engine blocks has no such setting"},
           {"blocks:block=x", "`block` x: expected 2 to 256 samples"},
           {"model:tolerance=1", "is the same for all engines"},
           {"blocks:seed=1", "is the same for all engines"}}) {
    const auto parse = [&written = text] { parseComparedEngine(written); };
    EXPECT_THAT(parse, ThrowsMessage<InputError>(HasSubstr(says))) << text;
  }
}

constexpr const char* kCubes =
    "kind = \"solids\"\nground = { height = 0, substance = \"grass\" }\n"
    "[[part]]\nsubstance = \"brick\"\nbox = [0, 0, 0, 2, 2, 2]\n";

TEST(ContinuousEngine, TakesScenesOfSolidsAndClosedMeshes) {
  const Source scene = Source::ofBytes(kCubes, "cubes.toml");
  EXPECT_EQ(sourceKind(scene), SourceKind::Solids);
  EXPECT_EQ(engineFor(scene).name(), "continuous");
  const Example cubes = readExample(scene);
  EXPECT_EQ(cubes.form(), Form::Polygons);
  EXPECT_TRUE(
      realize(runOn(continuousEngine(), cubes, smallRequest(continuousEngine())), {&cubes, 1})
          .health.closed());
  // The same scene as distances, for the other engines.
  EXPECT_EQ(readExample(scene, {.form = Form::Field, .resolution = 16}).form(), Form::Field);
  EXPECT_THAT([] { readExample(Source::of(rings()), {.form = Form::Polygons}); },
              ThrowsMessage<InputError>(HasSubstr("takes closed meshes and scenes of solids")));
  TriangleMesh ball = makeSphere({0, 0, 0}, 1);
  EXPECT_THAT([&] { readExample(Source::of(ball), {.form = Form::Polygons}); },
              ThrowsMessage<InputError>(HasSubstr("directions (at most")));
}

TEST(ContinuousEngine, PinsAndThinMaterialsAreNamedByTheExample) {
  const Example cubes = readExample(Source::ofBytes(kCubes, "cubes.toml"));
  Request request = smallRequest(continuousEngine());
  request.extent.size = Vec3i{8, 8, 3};
  request.settings = {{"thin", "brick=x"}};
  request.decided.pins = {{{2, 2, 0}, "brick"}, {{3, 2, 0}, "brick"}};
  const Result result = runOn(continuousEngine(), cubes, request);
  ASSERT_EQ(result.outcome, Outcome::Impossible);
  EXPECT_EQ(result.conflict->pins, (std::vector<int>{0, 1}));
  EXPECT_THAT(result.why, HasSubstr("`pin` 2,2,0=brick and `pin` 3,2,0=brick"));
  request.settings = {{"thin", "stone=x"}};
  EXPECT_THAT([&] { runOn(continuousEngine(), cubes, request); },
              ThrowsMessage<InputError>(HasSubstr("there is no material stone")));
  request.settings = {};
  request.decided.pins = {{{9, 2, 0}, "brick"}};
  EXPECT_THAT([&] { runOn(continuousEngine(), cubes, request); },
              ThrowsMessage<InputError>(HasSubstr("outside of the result's 8 x 8 x 3")));
}

TEST(SurfaceEngine, RefusesWhatDoesNotGoWithASurface) {
  const Example example = readExample(Source::of(bumps()));
  Request request;
  EXPECT_THAT([&] { runOn(surfaceEngine(), example, request); },
              ThrowsMessage<InputError>(HasSubstr("needs a surface; give `on`")));
  request.on = Source::of(makeSphere({0, 0, 0}, 12, 6));
  request.extent.scale = Vec3d{2, 2, 1};
  EXPECT_THAT([&] { runOn(surfaceEngine(), example, request); },
              ThrowsMessage<InputError>(HasSubstr("`span` says how large")));
  request.extent = {};
  request.settings = {{"turns", "3"}};
  EXPECT_THAT([&] { runOn(surfaceEngine(), example, request); },
              ThrowsMessage<InputError>(HasSubstr("expected 1, 2, 4 or 6")));
  EXPECT_EQ(engineFor(Source::of(bumps()), {{"on", "ball.obj"}}).name(), "surface");
  request.settings = {{"cover", "skin"}};
  EXPECT_THAT([&] { runOn(surfaceEngine(), example, request); },
              ThrowsMessage<InputError>(HasSubstr("neither named materials nor vertex colors")));
  request.settings = {};
  EXPECT_THAT([&] { runOn(geometryEngine(), example, request); },
              ThrowsMessage<InputError>(HasSubstr("`on`: the engine geometry has no such setting; "
                                                  "surface has")));
}

TEST(SurfaceEngine, CoversAPartOfABodyThatIsTurnedWithIt) {
  const Example example = readExample(Source::of(bumps()));
  TriangleMesh ball = makeSphere({0, 0, 0}, 12, 6);
  for (const Vec3d& p : ball.positions) ball.colors.push_back({p.z > 0 ? 1.0f : 0.0f, 0, 0, 1});
  for (auto& [a, b, c] : ball.triangles) std::swap(b, c);
  Request request;
  request.on = Source::of(ball);
  request.settings = {{"span", "24"}, {"cover", "red"}, {"base", "under"}};
  const Result result = runOn(surfaceEngine(), example, request);
  EXPECT_THAT(result.warnings, testing::Contains(HasSubstr("inside out")));
  const MeshHealth health = realize(result, {&example, 1}).health;
  EXPECT_TRUE(health.closed());
  EXPECT_GT(health.signedVolume, 4.0 / 3 * std::numbers::pi * 12 * 12 * 12);
}

TEST(SurfaceEngine, SaysWhatItDidAboutAnUnsoundSurface) {
  const Example example = readExample(Source::of(bumps()));
  Request request;
  request.settings = {{"span", "24"}};
  TriangleMesh ball = makeSphere({0, 0, 0}, 12, 6);
  request.on = Source::of(ball);
  const Result sound = runOn(surfaceEngine(), example, request);
  for (auto& [a, b, c] : ball.triangles) std::swap(b, c);
  request.on = Source::of(ball);
  const Result turned = runOn(surfaceEngine(), example, request);
  EXPECT_EQ(turned.warnings.size(), sound.warnings.size() + 1);
  EXPECT_THAT(turned.warnings[0], HasSubstr("inside out"));
  EXPECT_EQ(turned.field().values.count(), sound.field().values.count());
  // All faces twice, the other way round: nothing is enclosed.
  TriangleMesh flat;
  flat.positions = {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}};
  flat.triangles = {{0, 1, 2}, {0, 2, 1}};
  request.on = Source::of(flat);
  EXPECT_THAT([&] { runOn(surfaceEngine(), example, request); },
              ThrowsMessage<InputError>(HasSubstr("encloses nothing")));
}

}  // namespace
}  // namespace exemplar
