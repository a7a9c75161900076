// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/engine.h"

#include <algorithm>

#include "core/error.h"
#include "engine/doubts.h"
#include "engine/engines.h"
#include "engine/realize.h"
#include "engine/words.h"

namespace exemplar {
namespace {

/// What every engine honors of a request.
constexpr std::string_view kAlways[] = {"scale", "size", "seed"};

bool honors(const Engine& engine, std::string_view key) {
  return std::ranges::find(kAlways, key) != std::end(kAlways) ||
         std::ranges::find(engine.honors(), key) != engine.honors().end();
}

[[noreturn]] void refuse(const Engine& engine, const std::string& key) {
  std::vector<std::string> having;
  for (const Engine* other : engines()) {
    for (const Setting& setting : settingsOf(*other)) {
      if (setting.key == key) {
        having.emplace_back(other->name());
        break;
      }
    }
  }
  const std::string what =
      "`" + key + "`: the engine " + std::string(engine.name()) + " has no such setting";
  if (having.empty()) throw InputError(what + "; no engine has it");
  throw InputError(what + "; " + joined(having, "and") + (having.size() == 1 ? " has" : " have"));
}

/// Refuses what a request asks of an engine that does not honor it.
void checkRequest(const Engine& engine, const Request& request) {
  if (request.periodic.any() && !honors(engine, "periodic")) refuse(engine, "periodic");
  if (request.decided.keep && !honors(engine, "keep")) refuse(engine, "keep");
  if (!request.decided.pins.empty() && !honors(engine, "pin")) refuse(engine, "pin");
  if (request.guide && !honors(engine, "guide")) refuse(engine, "guide");
  if (request.mixMap && !honors(engine, "mix-map")) refuse(engine, "mix-map");
  if (request.on && !honors(engine, "on")) refuse(engine, "on");
  for (const auto& [key, text] : request.settings.given()) {
    const auto found = std::ranges::find(engine.settings(), key, &Setting::key);
    if (found == engine.settings().end()) refuse(engine, key);
    checkSetting(*found, text);
  }
}

}  // namespace

void Engine::check(const Request& request, std::size_t examples) const {
  checkRequest(*this, request);
  if (examples == 0) throw InputError("there is no example");
  if (examples > 1 && !mixes()) {
    throw InputError("the engine " + std::string(name()) + " takes one example, not " +
                     std::to_string(examples));
  }
  checkFurther(request, examples);
}

/// The share of the work that is done when a result is looked at for what is doubtful about it.
constexpr double kUntilDoubts = 0.98;

Result Engine::run(std::span<const Example> examples, const Request& request,
                   const Progress& progress) const {
  check(request, examples.size());
  for (const Example& example : examples) {
    if (!accepts(example)) {
      throw InputError(example.name() + ": the engine " + std::string(name()) +
                       " does not take this kind of example");
    }
  }
  Result result;
  try {
    result = synthesize(examples, request, progress.part(0, kUntilDoubts));
    // An engine that had another make the result leaves the doubts to that.
    if (result.form() == Form::Field && result.outcome == Outcome::Complete &&
        result.engine.empty() && !result.originMap)
      addDoubts(examples, request, result, progress.part(kUntilDoubts, 1));
  } catch (const Cancelled&) {
    result.outcome = Outcome::Cancelled;
    result.why = "cancelled";
  }
  result.engine = name();
  result.seed = request.seed;
  result.periodic = request.periodic;
  return result;
}

std::span<const Engine* const> engines() {
  static const Engine* const all[] = {
      &geometryEngine(), &quiltingEngine(),   &votingEngine(),  &blocksEngine(),
      &modelEngine(),    &continuousEngine(), &layeredEngine(), &layeredVolumeEngine(),
      &terrainEngine(),  &surfaceEngine()};
  return all;
}

const Engine& engineNamed(std::string_view name) {
  std::vector<std::string> names;
  for (const Engine* engine : engines()) {
    if (engine->name() == name) return *engine;
    names.emplace_back(engine->name());
  }
  throw InputError("`engine` " + std::string(name) + ": expected " + joined(names, "or"));
}

const Engine& engineNamed(std::string_view name, const Source& source) {
  const Engine& engine = engineNamed(name);
  const bool isPicture = &engine == &layeredEngine();
  return isPicture && sourceKind(source) == SourceKind::Labels ? layeredVolumeEngine() : engine;
}

const Engine& engineFor(const Source& source) {
  switch (sourceKind(source)) {
    case SourceKind::Labels:
    case SourceKind::Pieces:
    case SourceKind::Picture:
      return modelEngine();
    case SourceKind::Solids:
      return continuousEngine();
    case SourceKind::HeightMap:
      return terrainEngine();
    default:
      return geometryEngine();
  }
}

const Engine& engineFor(const Source& source, const Settings& settings) {
  return settings.has("on") ? surfaceEngine() : engineFor(source);
}

std::vector<Setting> settingsOf(const Engine& engine) {
  std::vector<Setting> all;
  const auto add = [&](std::span<const Setting> settings) {
    all.insert(all.end(), settings.begin(), settings.end());
  };
  for (const Setting& setting : requestSettings())
    if (honors(engine, setting.key)) all.push_back(setting);
  add(engine.settings());
  add(readingSettings(engine.form()).settings());
  add(surfaceSettings(engine.form()).settings());
  return all;
}

void checkSettings(const Engine& engine, const Settings& settings) {
  const std::vector<Setting> all = settingsOf(engine);
  for (const auto& [key, text] : settings.given()) {
    const auto found = std::ranges::find(all, key, &Setting::key);
    if (found == all.end()) refuse(engine, key);
    if (!found->repeats && settings.texts(key).size() > 1)
      throw InputError("`" + key + "`: given more than once");
    checkSetting(*found, text);
  }
}

}  // namespace exemplar
