// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace exemplar {

/// What this command was built of, for people: a line each for the version, the commit where it is
/// known, the libraries with the versions that it was built with, and the arithmetic of this
/// machine. The first line is "exemplar 0.1.0".
std::string versionText();
/// The same as JSON, for programs: `version`, `commit`, `protocol` (docs/progress.md), `libraries`
/// (versions by name), `compiler`, `arithmetic`, `platform`.
std::string versionJson();

}  // namespace exemplar
