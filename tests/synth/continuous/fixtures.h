// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

#include "synth/continuous/solid_scene.h"

/// Small examples with known numbers of figures.
namespace exemplar::continuous {

struct Fixture {
  const char* name;
  std::size_t figures;  ///< in the closed set
  const char* text;
};

inline const std::vector<Fixture>& fixtures() {
  static const std::vector<Fixture> all{
      {"cube", 28, R"(
kind = "solids"
[[part]]
substance = "brick"
box = [0, 0, 0, 2, 2, 2]
)"},
      {"l-block", 31, R"(
kind = "solids"
[[part]]
substance = "brick"
box = [0, 0, 0, 4, 2, 2]
[[part]]
substance = "brick"
box = [0, 0, 0, 2, 4, 2]
)"},
      {"tetrahedron", 16, R"(
kind = "solids"
[[part]]
substance = "brick"
points = [[0, 0, 0], [2, 2, 0], [2, 0, 2], [0, 2, 2]]
)"},
      {"pyramid", 20, R"(
kind = "solids"
[[part]]
substance = "brick"
points = [[0, 0, 0], [4, 0, 0], [0, 4, 0], [4, 4, 0], [2, 2, 2]]
)"},
      {"gabled", 36, R"(
kind = "solids"
ground = { height = 0, substance = "grass" }
[[part]]
substance = "brick"
box = [0, 0, 0, 4, 6, 2]
[[part]]
substance = "brick"
points = [[0, 0, 2], [4, 0, 2], [0, 6, 2], [4, 6, 2], [2, 0, 4], [2, 6, 4]]
)"},
      {"cross-gabled", 55, R"(
kind = "solids"
ground = { height = 0, substance = "grass" }
[[part]]
substance = "brick"
box = [0, -4, 0, 4, 8, 2]
[[part]]
substance = "brick"
points = [[0, -4, 2], [4, -4, 2], [0, 8, 2], [4, 8, 2], [2, -4, 4], [2, 8, 4]]
[[part]]
substance = "brick"
box = [2, 0, 0, 8, 4, 2]
[[part]]
substance = "brick"
points = [[2, 0, 2], [2, 4, 2], [8, 0, 2], [8, 4, 2], [2, 2, 4], [8, 2, 4]]
)"},
      {"arch", 39, R"(
kind = "solids"
ground = { height = 0, substance = "grass" }
[[part]]
substance = "stone"
box = [0, 0, 0, 6, 2, 4]
[[part]]
substance = "air"
box = [2, 0, 0, 4, 2, 2]
)"},
      {"pentagon", 36, R"(
kind = "solids"
ground = { height = 0, substance = "grass" }
[[part]]
substance = "stone"
planes = [[0, -1, 0, 4], [19, -6, 0, 80], [-19, -6, 0, 80], [3, 4, 0, 20], [-3, 4, 0, 20],
          [0, 0, 1, 4], [0, 0, -1, 0]]
)"},
  };
  return all;
}

inline const Fixture& fixture(const std::string& name) {
  for (const Fixture& f : fixtures())
    if (name == f.name) return f;
  throw std::logic_error("no fixture " + name);
}

inline Solids solidsOf(const std::string& name) {
  return readSolidScene(fixture(name).text, name).solids;
}

}  // namespace exemplar::continuous
