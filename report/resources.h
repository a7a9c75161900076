// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string_view>

/// The parts of a page that are the same in every report, from `web/`, put in by the build.
namespace exemplar::resources {

std::string_view style();    ///< page.css
std::string_view script();   ///< the page's own scripts
std::string_view viewer();   ///< three.js and viewer.js, bundled; empty where it was built without
std::string_view license();  ///< of three.js; empty likewise

}  // namespace exemplar::resources
