// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "engine/setting.h"

/// The file that says what a world is, `world.json`.
namespace exemplar {

/// All that decides a world's bytes, and what shows machines that make others.
struct WorldFile {
  static constexpr int kFormat = 1;

  std::string engine;
  std::uint64_t seed = 0;
  int tile = 72;                  ///< columns along each side of a tile, 8..4096
  int window = 36;                ///< columns from window to window, 12..1024
  int height = 0;                 ///< cells; 1 of heights
  Settings settings;              ///< of reading the example, and of the engine
  std::string example;            ///< its file, in the folder `example` of the world's
  std::uint64_t exampleHash = 0;  ///< of that file's bytes
  std::uint64_t startHash = 0;    ///< of what the world begins with
  std::string program;            ///< the version that made it

  std::string fingerprint;   ///< of the machine that made it: `machineFingerprint`
  std::uint64_t canary = 0;  ///< hash of tile 0,0

  /// A hash of all but the last two: two worlds with one id have the same tiles.
  std::uint64_t id() const;
};

std::filesystem::path worldFilePath(const std::filesystem::path& world);
/// Throws `InputError` where the folder is no world, or one of a later format.
WorldFile readWorldFile(const std::filesystem::path& world);
void writeWorldFile(const std::filesystem::path& world, const WorldFile& file);

/// What may make a difference to bytes: the program's version and compiler, the C library, what the
/// processor can do.
std::string machineFingerprint();

}  // namespace exemplar
