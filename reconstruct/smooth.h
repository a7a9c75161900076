// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/origin.h"
#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"

namespace exemplar {

struct SmoothOptions {
  /// Pairs of a shrinking and a growing step; 0..10000. Detail of about 2 edge lengths is gone
  /// after 5, of 4 after 20.
  int iterations = 10;
  /// How far the shrinking step goes towards the neighbors, 0..0.6; the growing one undoes it for
  /// everything longer than about ten edges.
  double strength = 0.5;
  /// How much of each step every vertex takes, 0..1: one value a vertex, or none for all of it.
  std::vector<float> weights;
  /// No vertex moves farther than this, world units, >= 0: the neighbors of a large triangle's
  /// corners are far away.
  double most = std::numeric_limits<double>::infinity();
  /// Moves vertices along their normals afterwards until every closed part encloses what it did.
  bool keepVolume = true;
  /// Vertices in the faces of this box stay in them.
  std::optional<Box3d> box;
};

/// Smooths a surface without shrinking it: Taubin's lambda | mu filter ("A signal processing
/// approach to fair surface design", SIGGRAPH 1995, doi:10.1145/218380.218473, section 3) with
/// uniform weights over OpenMesh's one-rings, then a shift along the normals that restores each
/// closed part's volume to within 1e-3 of it.
///
/// Open rims are smoothed along themselves only. Vertices where sheets touch (several fans) keep
/// one place. Connectivity and attributes stay. O(iterations n). The same bytes at any number of
/// threads. Throws `InputError` for options out of range, and `Cancelled`.
void smooth(TriangleMesh& mesh, const SmoothOptions& options = {}, const Progress& progress = {});

/// Weights for `smooth` that act where copied parts meet: 1 at a vertex whose surrounding samples
/// come from different places of the example, falling to 0 at `width` voxels (> 0) from such a
/// seam. Everything else keeps the example's detail.
std::vector<float> seamWeights(const TriangleMesh& mesh, const DistanceField& field,
                               const Origins& origins, double width = 2,
                               const Progress& progress = {});

}  // namespace exemplar
