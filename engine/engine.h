// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "engine/example.h"
#include "engine/request.h"
#include "engine/result.h"
#include "engine/setting.h"

/// Who makes more of an example. A new engine is a class here and a line in `engines`; the command,
/// `compare` and all that enters by this room then have it.
namespace exemplar {

class Engine {
 public:
  virtual ~Engine() = default;

  virtual std::string_view name() const = 0;
  /// One sentence: what it does, after whom.
  virtual std::string_view meaning() const = 0;
  /// What it works on, and makes.
  virtual Form form() const = 0;
  /// Whether it takes the example; of the right form, at least.
  virtual bool accepts(const Example& example) const { return example.form() == form(); }
  /// Its own settings, by which `Request::settings` is read.
  virtual std::span<const Setting> settings() const = 0;
  /// The keys of `requestSettings` that it honors beside `scale`, `size` and `seed`.
  virtual std::span<const std::string_view> honors() const = 0;
  /// Whether it takes several examples.
  virtual bool mixes() const { return false; }

  /// The size of the request's result, in samples or cells. Throws `InputError` where it cannot be.
  virtual Vec3i extentOf(std::span<const Example> examples, const Request& request) const = 0;

  /// Throws `InputError` for a request that it cannot honor whatever the examples hold, so that
  /// nothing has to be read to find out. `run` checks it, too.
  void check(const Request& request, std::size_t examples) const;

  /// Makes more of the examples. What cannot be is an outcome, never an empty result; `Cancelled`
  /// is one of them. Throws `InputError` for requests that it cannot honor.
  Result run(std::span<const Example> examples, const Request& request,
             const Progress& progress = {}) const;

 protected:
  /// What `check` finds wrong beyond keys and the texts of single settings.
  virtual void checkFurther(const Request&, std::size_t) const {}
  /// `run` without its checks; throws `Cancelled`.
  virtual Result synthesize(std::span<const Example> examples, const Request& request,
                            const Progress& progress) const = 0;
};

/// All engines: geometry, quilting, voting, blocks, model, continuous, layered, layered-volume,
/// terrain, surface.
std::span<const Engine* const> engines();
/// The engine of a name. Throws `InputError` naming all.
const Engine& engineNamed(std::string_view name);
/// The same for a source: layered of a volume of labels is layered-volume.
const Engine& engineNamed(std::string_view name, const Source& source);
/// The engine that a source asks for: model where it holds labels, continuous where it holds solids
/// between planes, terrain where it is a height map, else geometry.
const Engine& engineFor(const Source& source);
/// The same for a request's settings: surface where they name one that the example is laid `on`.
const Engine& engineFor(const Source& source, const Settings& settings);

/// Everything that can be set for an engine: of the request, of reading an example in its form, its
/// own, and of a result's surface.
std::vector<Setting> settingsOf(const Engine& engine);
/// Throws `InputError` for a setting that the engine does not have, naming the engines that do; for
/// one that is given twice though it does not repeat; and for a text that cannot be read.
void checkSettings(const Engine& engine, const Settings& settings);

}  // namespace exemplar
