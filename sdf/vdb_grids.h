// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <openvdb/openvdb.h>

#include <filesystem>
#include <functional>

#include "core/progress.h"
#include "core/vec.h"

namespace exemplar {

// OpenVDB files as grids of OpenVDB's own, for what reads and writes grids of one kind. Slow to
// compile: include it in few sources.

/// Writes grids to a file, whole or not at all. The same grids give the same bytes: a hash of the
/// content replaces the random id that OpenVDB gives each file. Throws `InputError` and
/// `Cancelled`.
void writeVdbGrids(const std::filesystem::path& path, const openvdb::GridCPtrVec& grids,
                   const Progress& progress = {});

/// Calls `use` with the grids of a file. Whatever OpenVDB throws, within `use` too, becomes an
/// `InputError` naming the file; `Cancelled` passes.
void withVdbGrids(const std::filesystem::path& path,
                  const std::function<void(const openvdb::GridPtrVec&)>& use);

/// The box that a grid covers, both ends included: the one that `stateBox` wrote where the file
/// has it and all active voxels lie within, else that of the active voxels. Throws `InputError`
/// naming the file where that is empty.
openvdb::math::CoordBBox statedBox(const openvdb::GridBase& grid,
                                   const std::filesystem::path& path);

/// States that a grid is a box of `size` from (0, 0, 0), also where it ends in background.
void stateBox(openvdb::GridBase& grid, const Vec3i& size);

}  // namespace exemplar
