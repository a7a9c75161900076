// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

namespace exemplar {

/// Makes OpenVDB know its grid types; every function that reads, writes or makes grids calls it
/// first. Cheap after the first time; any thread may call it.
void openvdbReady();

}  // namespace exemplar
