// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/origin.h"
#include "core/progress.h"
#include "core/turn.h"
#include "mesh/triangle_mesh.h"
#include "preview/render.h"
#include "report/page.h"
#include "sdf/distance_field.h"

/// Pages that show an example and results of it (`report/`).
namespace exemplar {

/// What every page says first; `kind` is "comparison" or "result". Runs are added to `runs`.
nlohmann::ordered_json pageHead(const std::string& kind, const std::filesystem::path& example,
                                const std::string& description, const RenderOptions& picture);

/// How pictures are taken of what was turned straight, so that it looks as it lies: `turn` takes it
/// back.
RenderOptions straightPicture(RenderOptions picture, const Turn& turn);

/// A result as pages show it: the surface to turn, and marks where it has origins.
struct PageParts {
  std::string view;              ///< for `ReportPage::addView`; empty where pages show pictures
  std::vector<Mark> marks;       ///< of what shows that it was put together
  std::optional<Camera> camera;  ///< of its picture
};

/// Triangles of a view where a page holds two of them, and where it holds one for each run.
inline constexpr std::int64_t kFewViews = 250000, kManyViews = 90000;

/// The view of an example, colored by where it is itself; empty where pages show pictures.
/// `field` may be null.
std::string exampleView(const TriangleMesh& mesh, const DistanceField* field,
                        const RenderOptions& picture, std::int64_t triangles,
                        const Progress& progress);

/// The view and marks of a result. Without `example`, `field` and `origins` only what the mesh
/// shows.
PageParts pageParts(const TriangleMesh& mesh, const DistanceField* example,
                    const DistanceField* field, const Origins* origins,
                    const RenderOptions& picture, std::int64_t triangles, const Progress& progress);

/// One result beside its example.
struct ResultPage {
  std::filesystem::path page;     ///< where to write it
  std::filesystem::path example;  ///< the example's file
  std::string description;        ///< of the example, for people
  const TriangleMesh& exampleMesh;
  const TriangleMesh& mesh;  ///< of the result; both as they lie in files
  /// What figures and marks are taken from, where there is any.
  const DistanceField* exampleField = nullptr;
  const DistanceField* field = nullptr;
  const Origins* origins = nullptr;
  Turn turn;  ///< from the fields to where the meshes lie
};

/// Writes a page of one result, whole or not at all. `run` is what is known of it ("engine",
/// "seed", "figures", ...). Throws `InputError` and `Cancelled`.
void writePage(const ResultPage& page, nlohmann::ordered_json run, const RenderOptions& picture,
               const Progress& progress);

}  // namespace exemplar
