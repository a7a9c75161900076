// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace exemplar {

// OpenVDB takes memory of the sizes that a file states for its names and its metadata before it
// reads them: up to 4 GB for a number of 4 bytes. So they are looked at first, as it comes to them.

/// Whether the sizes in a .vdb file's own metadata lie within the file. Files older than OpenVDB's
/// first release (version 220, 2012) are not sound. Costs O(metadata).
bool hasSoundMetadata(std::string_view bytes);

/// Whether the sizes in the names and the metadata of a grid that begins at byte `at` lie within
/// the file, and it has room for at least the grid's header. Costs O(metadata).
bool hasSoundGridMetadata(std::string_view bytes, std::size_t at);

/// Whether so many grids can be in a file of so many bytes at all.
bool canHoldGrids(std::string_view bytes, std::int64_t count);

}  // namespace exemplar
