// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/axes.h"
#include "engine/example.h"
#include "engine/setting.h"

/// What is wanted of an engine.
namespace exemplar {

/// A cell that must have one of some labels.
struct Pin {
  Vec3i cell;
  std::string labels;  ///< numbers or names: "3", "wall,tower"
  int frame = 0;
};

/// What is decided before an engine begins.
struct Decided {
  /// Field: a solid (mesh or volume) in the example's coordinates. What is inside stays as it is in
  /// the example, to the bit, and where it is in space (with both ends kept, the low one); a larger
  /// result goes on from there to the other side. Heights: a gray picture, in which that is white.
  std::optional<Source> keep;
  /// Labels: cells that are decided.
  std::vector<Pin> pins;
};

/// A request: how much, from which seed, and what is special about it. The same request of the same
/// examples has the same result, to the byte, at any number of threads.
struct Request {
  Extent extent;
  std::uint64_t seed = 0;
  Axes periodic;  ///< along which copies of the result tile
  Decided decided;
  /// Field: a volume, mesh or height map, stretched to the result's box, that says coarsely where
  /// solid should be; Heights: rough heights, or a file of ridges and valleys.
  std::optional<Source> guide;
  /// Field, of several examples: where each is wanted. A gray picture seen from above (black the
  /// first, white the last) or a volume (inside its solid the last).
  std::optional<Source> mixMap;
  /// Field: a mesh that the example, which lies flat, is laid on.
  std::optional<Source> on;
  ReadOptions reading;  ///< how what is kept, the guide and the surface are read
  /// The engine's own settings (`Engine::settings`), by their keys.
  Settings settings;
};

/// The settings that every request has (`scale`, `size`, `seed`) and those that some engines have
/// (`periodic`, `keep`, `guide`, `mix-map`, `on`, `pin`), which `requestOf` reads.
std::span<const Setting> requestSettings();

/// The request that settings stand for: those of `requestSettings` are read, all others are passed
/// on to the engine. Throws `InputError` naming the setting that cannot be read.
Request requestOf(const Settings& settings, const ReadOptions& reading = {});

/// The size of a result: of `example` in `unit` ("samples"), scaled as the request says. Throws
/// `InputError` unless each side has 1 to 32,767 of them.
Vec3i resultSize(const Request& request, const Vec3i& example, const Vec3d& usualScale,
                 const std::string& unit);
Vec3i scaledSize(const Vec3i& size, const Vec3d& scale, const std::string& unit);

}  // namespace exemplar
