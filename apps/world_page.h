// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace exemplar {

/// The page that flies over a world (web/world.js), in one piece; it asks for tiles where it is.
std::string worldPage();

}  // namespace exemplar
