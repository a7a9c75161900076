// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/doubts.h"

#include <algorithm>
#include <string>

#include "measure/occupancy.h"

namespace exemplar {

std::string remedyOf(Doubt doubt) {
  switch (doubt) {
    case Doubt::Moved:
      return "try another `seed`, a larger `scale`, or other axes (`stationary`)";
    case Doubt::Pieces:
    case Doubt::Floating:
      return "try another `seed`, or let parts move along fewer axes (`stationary`)";
    case Doubt::Repeated:
      return "try another `seed`, or a smaller `scale`";
    case Doubt::Occupancy:
      return "try another `seed`, or another `scale`";
    case Doubt::Sliced:
      return "try another `seed`, or let parts move along fewer axes (`stationary`)";
    case Doubt::Open:
      break;
  }
  return "try another `seed`, or more air around the example (`padding`)";
}

void addDoubts(std::span<const Example> examples, const Request& request, Result& result,
               const Progress& progress) {
  if (examples.size() != 1 || request.guide || request.decided.keep) return;
  const DoubtSigns signs =
      doubtSigns(Occupancy(examples.front().field()), Occupancy(result.field()), progress);
  result.statistics.emplace_back("distance_to_rolled_example", signs.rolled.distance);
  result.statistics.emplace_back("pieces", signs.wholeness.pieces);
  result.statistics.emplace_back("pieces_example", signs.wholeness.examplePieces);
  result.statistics.emplace_back("floating", signs.wholeness.floatingShare);
  result.statistics.emplace_back("landmarks_repeated", signs.landmarks.repeated());
  result.statistics.emplace_back("sliced", signs.wholeness.slicedShare);
  // Geometry synthesis of an object says so itself, and why.
  const bool nearlySaid = std::ranges::any_of(result.warnings, [](const std::string& warning) {
    return warning.starts_with("the result is nearly the example");
  });
  // Of an object that is made longer, what is flat along it becomes more of the surface.
  const bool extended = examples.front().field().size() != result.field().size() &&
                        std::ranges::any_of(result.statistics, [](const auto& statistic) {
                          return statistic.first == "parts_exchanged";
                        });
  for (const Doubt doubt : doubtsOf(signs)) {
    if (doubt == Doubt::Sliced && extended) continue;
    if (doubt == Doubt::Moved && nearlySaid) continue;
    // Copies that were asked for.
    if (doubt == Doubt::Repeated && examples.front().reading.scatter) continue;
    // What leaves a result that tiles at one side goes on at the other.
    const bool aroundTheBox = doubt == Doubt::Open || doubt == Doubt::Pieces;
    if (request.periodic.any() && aroundTheBox) continue;
    result.warnings.push_back(doubtSentence(doubt, signs) + "; " + remedyOf(doubt));
  }
}

}  // namespace exemplar
