// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>

#include "core/origin.h"
#include "core/progress.h"
#include "measure/collapse.h"
#include "measure/likeness.h"
#include "measure/novelty.h"
#include "measure/seams.h"
#include "mesh/mesh_health.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// What is known of a result beside its field.
struct MeasureInput {
  const Origins* origins = nullptr;    ///< where its samples came from
  const TriangleMesh* mesh = nullptr;  ///< its surface
};

struct MeasureOptions {
  LikenessOptions likeness;
  int exampleIndex = 0;  ///< the number that the example has in the origins
};

/// Every figure of one result against its example.
struct Measures {
  Likeness likeness;
  Novelty novelty;
  Seams seams;
  std::optional<MeshHealth> mesh;  ///< where there is a mesh
  CollapseSigns signs;             ///< what `collapse` was judged by
  Collapse collapse = Collapse::None;
};

/// Measures `result` against `example`: likeness, novelty and seams from the fields, more of the
/// latter two from origins, mesh health from a mesh. At 128³ about two seconds on two cores, and as
/// long as `meshHealth` takes. The same bytes at any number of threads. Throws `InputError` where
/// inputs do not fit together, and `Cancelled`.
Measures measure(const DistanceField& example, const DistanceField& result,
                 const MeasureInput& input = {}, const MeasureOptions& options = {},
                 const Progress& progress = {});

}  // namespace exemplar
