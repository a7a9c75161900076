// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/axes.h"
#include "core/progress.h"
#include "measure/landmarks.h"
#include "measure/occupancy.h"
#include "measure/rolled_distance.h"
#include "measure/wholeness.h"

/// What people should be warned of in a result, by figures that take little time.
namespace exemplar {

enum class Doubt {
  Moved,      ///< it is the example, at rest, moved or tiled
  Pieces,     ///< it fell into more pieces
  Floating,   ///< parts have nothing under them
  Repeated,   ///< what the example has only once is there again and again
  Occupancy,  ///< it is fuller or emptier
  Sliced,     ///< flat cuts that the example does not have
  Open,       ///< the box cuts it where the example ends in air
};
inline constexpr std::array kDoubts{Doubt::Moved,    Doubt::Pieces,    Doubt::Floating,
                                    Doubt::Repeated, Doubt::Occupancy, Doubt::Sliced,
                                    Doubt::Open};
/// "moved", "pieces", ..., as in JSON.
std::string doubtName(Doubt doubt);

/// What is known of a result.
struct DoubtSigns {
  Wholeness wholeness;
  RolledDistance rolled;
  Axes rollingIsFair;
  Landmarks landmarks;
  Vec3i exampleSize{}, resultSize{};
  double exampleOccupancy = 0, resultOccupancy = 0;  ///< solid shares, 0..1
};
/// Throws `Cancelled`.
DoubtSigns doubtSigns(const Occupancy& example, const Occupancy& result,
                      const Progress& progress = {});

/// Those that there is reason for, in the order of `kDoubts`:
///
/// - Moved: less than a tenth (1 - IoU) from the rolled example, and moved along an axis along
/// which
///   that is not fair, or not at all, or repeated along such an axis.
/// - Pieces: more than as many as the example would have in a box of that size, and half as many
/// and
///   two more besides where the example has several.
/// - Floating: half a percent of the solid more than in the example.
/// - Occupancy: the solid share differs by more than 15 %.
/// - Sliced: 2 % of the surface more is flat, and 15 % more than the example's flat share.
/// - Open: half a percent of the surface.
std::vector<Doubt> doubtsOf(const DoubtSigns& signs);

/// One sentence, by the figures that show it, without a period.
std::string doubtSentence(Doubt doubt, const DoubtSigns& signs);

}  // namespace exemplar
