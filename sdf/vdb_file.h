// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/axes.h"
#include "core/origin.h"
#include "core/progress.h"
#include "core/turn.h"
#include "core/warnings.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// Writes a field as one float grid "surface" of class level set (`.vdb`), world transform
/// included, as Blender, Houdini and `vdb_print` read it. Samples outside ±truncation become
/// background tiles. Whole or not at all. OpenVDB has no voxels below 0.00001:
/// smaller ones are written 1,000 (or 1,000,000, ...) times as large, millimeters for meters, which
/// the file records and `readVdb` takes back. Throws `InputError` naming the file, and `Cancelled`.
struct WriteVdbOptions {
  /// The axes along which the field is periodic, its last sample beside its first; the file records
  /// them.
  Axes wraps;
  Turn turn;  ///< takes the field to where it is in the file, whose transform says so
  /// The file's y axis is up, as in Houdini; the file records it, and only its transform differs.
  bool yUp = false;
};
void writeVdb(const std::filesystem::path& path, const DistanceField& field,
              const WriteVdbOptions& options = {}, const Progress& progress = {});

struct ReadVdbOptions {
  std::string grid;              ///< the name of the grid to read; empty: see `readVdb`
  Warnings* warnings = nullptr;  ///< which grids are left out where the file has several
  /// Receives how the grid lies turned about the vertical against the field; where it is null, such
  /// grids are refused.
  Turn* turn = nullptr;
  /// The file's y axis is up: it is stood up, its z axis becoming -y. Those that record it
  /// (`writeVdb`) need no saying.
  bool yUp = false;
};

/// Reads a grid of floats or doubles of a `.vdb` (a level set, or a fog volume whose 0.5 becomes
/// the surface) as a dense field over its active box: the one that the options name, else the first
/// level set, else the first one named "density", else the first. Voxels must be cubes. Throws
/// `InputError` naming the file, and `Cancelled`. `wraps` receives the axes that `writeVdb`
/// recorded, none for files of other programs.
DistanceField readVdb(const std::filesystem::path& path, const ReadVdbOptions& options = {},
                      Axes* wraps = nullptr, const Progress& progress = {});

/// Origins as an int32 vector grid "origin" (example cell i, j, k) and an int32 grid "source"
/// (example and quarter turns) on the transform of `field`, and back.
struct OriginsVdbOptions {
  Turn turn;  ///< as that of `writeVdb`
  /// How large the result was asked to be, in sizes of the example, which decides how an example is
  /// read; `readOriginsScale` finds it again.
  std::optional<Vec3d> scale;
};
void writeOriginsVdb(const std::filesystem::path& path, const Origins& origins,
                     const DistanceField& field, const OriginsVdbOptions& options = {},
                     const Progress& progress = {});
std::optional<Vec3d> readOriginsScale(const std::filesystem::path& path);
Origins readOriginsVdb(const std::filesystem::path& path, const Progress& progress = {});

}  // namespace exemplar
