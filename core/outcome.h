// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string_view>

namespace exemplar {

/// How a synthesis ended: one vocabulary for every engine.
enum class Outcome {
  Complete,    ///< there is a result, and it meets the request
  Impossible,  ///< proved: nothing meets the request
  Unfinished,  ///< the budget was spent and nothing is proved; there is no result
  Cancelled,   ///< by the caller; there is no result
};

/// "complete", "impossible", "unfinished", "cancelled".
constexpr std::string_view outcomeName(Outcome outcome) {
  switch (outcome) {
    case Outcome::Complete:
      return "complete";
    case Outcome::Impossible:
      return "impossible";
    case Outcome::Unfinished:
      return "unfinished";
    default:
      return "cancelled";
  }
}

}  // namespace exemplar
