// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/array3d.h"
#include "core/origin.h"
#include "core/progress.h"
#include "sdf/distance_field.h"

namespace exemplar {

struct EvenSeamsOptions {
  int reach = 6;    ///< how far from a seam samples may change, in steps; 0..254: 0 for not at all
  int blends = 20;  ///< rounds in the gradient domain; >= 0
  int rounds = 4;   ///< of relaxation to slope 1, half a voxel each; >= 0
  /// Samples of the result that stay as copied, where not 0: of its size, or none.
  const Array3D<std::uint8_t>* fixed = nullptr;
  /// Samples of the example that may be read, where not 0: of its size, or none for all.
  const Array3D<std::uint8_t>* usable = nullptr;
};

/// The field that origins (example 0, no turns) copy from `example`, with the steps between copied
/// pieces evened out, so that it is nearly a distance across seams too.
///
/// Near seams the field is first given the slopes of its sources, as nearly as one field can have
/// them all: over-relaxed rounds on Poisson's equation, at a seam with the mean of both sides'
/// slopes (Perez, Gangnet, Blake: "Poisson image editing", SIGGRAPH 2003,
/// doi:10.1145/882262.882269, section 2; the rounds of Young: "Iterative methods for solving
/// partial difference equations of elliptic type", Trans. AMS 76, 1954). A sample keeps its sign,
/// so that nothing thin is rounded off and which samples are solid does not change: the surface
/// moves between samples only. Then, within 4 voxels of the surface, it is relaxed to slope 1 with
/// its zero set held in place (Russo, Smereka: "A remark on computing distance functions", J.
/// Comput. Phys. 163(1), 2000, doi:10.1006/jcph.2000.6553, sections 2-3); farther out, where
/// sources of different places disagree most, the slopes that they have in common are the better.
///
/// Samples more than `reach` steps from every seam are the example's to the bit, and the others
/// keep their sign. Where no surface is near any seam nothing is relaxed. O(samples + samples near
/// seams x rounds). The same bytes at any number of threads. Throws `Cancelled`.
DistanceField evenSeams(const DistanceField& example, const Origins& origins,
                        const EvenSeamsOptions& options = {}, const Progress& progress = {});

}  // namespace exemplar
