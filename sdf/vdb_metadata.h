// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string_view>

namespace exemplar {

/// Whether the sizes that a .vdb file states for its names and its metadata lie within the file.
/// OpenVDB takes memory of such a size before it reads, up to 4 GB of it. Looks at the file's
/// metadata, and at each grid's as far as the file says where grids end. Files older than OpenVDB's
/// first release (version 220, 2012) are not sound. Costs O(metadata).
bool hasSoundMetadata(std::string_view bytes);

}  // namespace exemplar
