// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>

namespace exemplar {

/// The ways in which synthesis fails without saying so: each of them scores well somewhere.
enum class Collapse {
  None,
  AllEmpty,  ///< the surface is gone, and so is the solid
  AllSolid,  ///< the surface is gone, and the empty space with it
  Repeated,  ///< one part of the example is repeated, the rest does not appear
};

/// What is known of a result; what is absent takes no part.
struct CollapseSigns {
  double exampleOccupancy = 0, resultOccupancy = 0;  ///< solid shares, 0..1
  double exampleSurface = 0, resultSurface = 0;      ///< area densities, any one unit
  std::optional<double> usedShare;                   ///< of the example's surface (`Novelty`)
  std::optional<double> likeness, coverage;          ///< LP-dense and coverage
};

struct CollapseOptions {
  double vanished =
      0.1;  ///< a share of the example's solid, space or surface that counts as gone; 0..1
  double repeated = 0.06;  ///< a share of the example's surface that counts as one part; 0..1
};

/// Which collapse it is, if any. Empty or solid where the result has less than a tenth of the
/// example's solid or empty share, or (the nearer of the two) of its surface. Repeated where the
/// sources amount to less than one part in sixteen of the example's surface, unless half of the
/// example is covered all the same (an example that repeats itself loses nothing by it); and,
/// without origins, where the result is like the example and covers less than a quarter of it.
///
/// An example that is itself empty, solid or without surface cannot collapse in that way.
Collapse detectCollapse(const CollapseSigns& signs, const CollapseOptions& options = {});

/// "all_empty", as in JSON; "none" for none.
std::string collapseName(Collapse collapse);

/// One sentence for a warning: what is wrong, by the figures that show it. Empty for none.
std::string collapseSentence(Collapse collapse, const CollapseSigns& signs);

}  // namespace exemplar
