// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace exemplar {

/// A connected part of a surface that came in one piece, with one material.
struct MaterialPiece {
  std::uint32_t material = 0;
  double weight = 0;  ///< what it costs to give it any other material, >= 0
};

/// Where two pieces meet.
struct MaterialJoint {
  std::uint32_t a = 0, b = 0;
  double length = 0;  ///< of the line along which they meet, >= 0
  double cost = 0;    ///< of a change of material along it, >= 0
};

/// Chooses the pieces' materials, so that materials change where that costs little: the sum of the
/// weights of pieces with another material than their own, and of the costs of joints between
/// different materials, is made small (a Potts model). First single pieces take the material of a
/// neighbor, then what has grown together (joints with at least half of their length as cost) is
/// moved as one, as long as that lowers the sum.
///
/// Greedy: each step lowers the sum, the least possible sum is not promised. Sequential, about
/// O(joints) for each of some rounds; a function of its arguments alone.
std::vector<std::uint32_t> settleMaterials(std::span<const MaterialPiece> pieces,
                                           std::span<const MaterialJoint> joints);

}  // namespace exemplar
