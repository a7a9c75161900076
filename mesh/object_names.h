// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace exemplar {

/// Numbers the objects of a file while its triangles are read. Number 0 has no name.
class ObjectNames {
 public:
  std::uint32_t numberOf(const std::string& name) {
    const auto [found, added] = numbers_.try_emplace(name, numbers_.size());
    if (added) names_.push_back(name);
    return static_cast<std::uint32_t>(found->second);
  }

  /// Gives the mesh its names, or takes the numbers of its triangles away where all are one
  /// object's.
  void moveTo(TriangleMesh& mesh) {
    const auto& of = mesh.triangleObjects;
    if (std::ranges::all_of(of, [&](std::uint32_t number) { return number == of.front(); })) {
      mesh.triangleObjects.clear();
    } else {
      mesh.objects = std::move(names_);
    }
  }

 private:
  std::map<std::string, std::size_t> numbers_{{"", 0}};
  std::vector<std::string> names_{""};
};

}  // namespace exemplar
