// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <string>

#include "core/progress.h"
#include "engine/example.h"
#include "engine/request.h"
#include "engine/result.h"
#include "measure/doubts.h"

namespace exemplar {

/// Adds to a complete result of one example what is doubtful about it, with the settings that may
/// help, as warnings, and the figures by which that was found as statistics. Nothing for results of
/// several examples, of a guide, or of what was kept: they are meant to be otherwise. A hundredth
/// of the time that geometry synthesis takes. Throws `Cancelled`.
void addDoubts(std::span<const Example> examples, const Request& request, Result& result,
               const Progress& progress = {});

/// What may help: a clause that names settings.
std::string remedyOf(Doubt doubt);

}  // namespace exemplar
