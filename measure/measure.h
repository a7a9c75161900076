// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/origin.h"
#include "core/progress.h"
#include "measure/collapse.h"
#include "measure/doubts.h"
#include "measure/landmarks.h"
#include "measure/likeness.h"
#include "measure/multiscale_distance.h"
#include "measure/novelty.h"
#include "measure/seams.h"
#include "measure/wholeness.h"
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

/// Where a result is between a copy and something else altogether.
enum class Frontier {
  NewAndAlike,  ///< what is wanted
  Copied,       ///< alike, and not new: the example itself, at rest or moved
  Strange,      ///< new, and not alike
  Neither,      ///< spoiled
};
/// "new_and_alike", "copied", "strange", "neither".
std::string frontierName(Frontier frontier);

/// New from this distance to the rolled example up.
inline constexpr double kNew = 0.2;
/// Alike up to this many floors of the multi-scale distance; the less for a material that fills its
/// box evenly along all level axes, for its halves are fresh samples of it.
inline constexpr double kAlike = 2, kAlikeMaterial = 1.5;

/// Every figure of one result against its example.
struct Measures {
  Likeness likeness;
  std::optional<MultiscaleDistance> multiscale;
  Wholeness wholeness;
  Landmarks landmarks;
  Novelty novelty;
  std::optional<Frontier> frontier;  ///< where there is a multi-scale distance
  Seams seams;
  std::optional<MeshHealth> mesh;  ///< where there is a mesh
  CollapseSigns signs;             ///< what `collapse` was judged by
  Collapse collapse = Collapse::None;
  std::vector<Doubt> doubts;
};

/// Measures `result` against `example`: likeness, wholeness, novelty and seams from the fields,
/// more of the latter two from origins, mesh health from a mesh. At 128³ about three seconds on two
/// cores, and as long as `meshHealth` takes. The same bytes at any number of threads. Throws
/// `InputError` where inputs do not fit together, and `Cancelled`.
Measures measure(const DistanceField& example, const DistanceField& result,
                 const MeasureInput& input = {}, const MeasureOptions& options = {},
                 const Progress& progress = {});

}  // namespace exemplar
