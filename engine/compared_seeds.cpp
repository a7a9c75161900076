// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/compared_seeds.h"

#include <algorithm>
#include <cstdio>

#include "engine/json.h"

namespace exemplar {
namespace {

/// Results that are less than this apart after the best move are one, moved.
constexpr double kSameResult = 0.1;

std::string twoDigits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

}  // namespace

ComparedSeeds comparedSeeds(
    const std::string& engine, std::span<const std::uint64_t> seeds,
    const std::function<SeedDistance(std::size_t a, std::size_t b)>& apart) {
  ComparedSeeds compared;
  compared.engine = engine;
  compared.results = static_cast<int>(seeds.size());
  const double pairs = std::max(1.0, static_cast<double>(seeds.size() * (seeds.size() - 1)) / 2);
  for (std::size_t a = 0; a < seeds.size(); ++a) {
    for (std::size_t b = a + 1; b < seeds.size(); ++b) {
      const SeedDistance distance = apart(a, b);
      compared.diversity += distance.plain / pairs;
      compared.rolledDiversity += distance.rolled / pairs;
      if (distance.rolled < kSameResult) compared.equal.emplace_back(seeds[a], seeds[b]);
    }
  }
  return compared;
}

void addSeeds(const ComparedSeeds& seeds, const std::string& of, Json& comparison) {
  Json equal = Json::array();
  for (const auto& [a, b] : seeds.equal) equal.push_back({a, b});
  comparison["seeds"].push_back({{"engine", seeds.engine},
                                 {"results", seeds.results},
                                 {"diversity", seeds.diversity},
                                 {"rolled_diversity", seeds.rolledDiversity},
                                 {"equal", equal}});
  std::string note = seeds.engine + ": seeds differ in " + twoDigits(seeds.diversity) + " of " +
                     of + " (Div), " + twoDigits(seeds.rolledDiversity) +
                     " after the best roll of one onto the other.";
  for (const auto& [a, b] : seeds.equal)
    note += " Seeds " + std::to_string(a) + " and " + std::to_string(b) + " gave one result.";
  comparison["notes"].push_back(note);
}

}  // namespace exemplar
