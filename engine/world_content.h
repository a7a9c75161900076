// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/outcome.h"
#include "core/progress.h"
#include "engine/engine.h"
#include "engine/world_file.h"
#include "world/phased_plane.h"

namespace exemplar {

/// What a world is made of, by its engine: `World` asks it for what lies in a box of the plane.
class WorldContent {
 public:
  virtual ~WorldContent() = default;

  /// What a world begins with.
  struct Start {
    Outcome outcome = Outcome::Complete;
    std::string why;
    /// Lines for people: a label and a text.
    std::vector<std::pair<std::string, std::string>> notes;
    std::vector<std::string> warnings;
  };
  /// Makes that, and writes it to the world's folder of its example. `name` is the example's.
  virtual Start makeStart(const std::filesystem::path& folder, const std::string& name,
                          const Progress& progress) = 0;
  /// Reads it from there. Throws `InputError` where it cannot be this world's.
  virtual void readStart(const std::filesystem::path& folder, const Progress& progress) = 0;
  virtual std::uint64_t startHash() const = 0;
  /// Everything from then on is a function of the plane's box; `cache` must outlive this.
  virtual void begin(WindowCache& cache, const Progress& progress) = 0;

  /// Of how many columns neighboring tiles both have a copy: a file of heights ends with the first
  /// ones of the next.
  virtual int shared() const { return 0; }
  /// What lies in a box, as if it began where the example does. Thread-safe.
  virtual Result region(const PlaneBox& box, const Progress& progress) const = 0;
  /// The `part` of a region of `box`.
  virtual Result partOf(const Result& region, const PlaneBox& box, const PlaneBox& part) const = 0;
};

/// Reads what is asked of the engine. Sets `file.height` where it is 0: the example's.
std::unique_ptr<WorldContent> labelWorldContent(std::span<const Example> examples, WorldFile& file,
                                                const Request& request);
std::unique_ptr<WorldContent> heightWorldContent(std::span<const Example> examples, WorldFile& file,
                                                 const Request& request);

/// A hash of what a result holds.
std::uint64_t contentHashOf(const LabelGrid& grid);
std::uint64_t contentHashOf(const Grid<float>& heights);

}  // namespace exemplar
