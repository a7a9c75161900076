// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "engine/comparison.h"

/// How far the seeds of a compared engine are apart, whatever its results are.
namespace exemplar {

/// How far two results are apart, by their numbers: 0 for equal ones.
struct SeedDistance {
  double plain = 0, rolled = 0;  ///< and after the best move of one onto the other
};
/// The means over all pairs, and which seeds gave one result. `apart` is called for each a < b.
ComparedSeeds comparedSeeds(const std::string& engine, std::span<const std::uint64_t> seeds,
                            const std::function<SeedDistance(std::size_t a, std::size_t b)>& apart);

/// Says it in a comparison's JSON, and as a note of its page: they differ in so much `of`
/// something.
void addSeeds(const ComparedSeeds& seeds, const std::string& of,
              nlohmann::ordered_json& comparison);

}  // namespace exemplar
