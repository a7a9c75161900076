// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/page.h"

#include <algorithm>
#include <utility>

#include "core/file.h"
#include "core/memory.h"
#include "engine/json.h"
#include "measure/seams.h"
#include "mesh/footprint.h"
#include "preview/baked_light.h"

namespace exemplar {

RenderOptions straightPicture(RenderOptions picture, const Turn& turn) {
  picture.view.azimuth -= turn.angle();
  return picture;
}

namespace {

/// Without marks, pictures are what is seen where surfaces cannot turn: small ones, with few rays,
/// will do, in place of minutes of light for a result made in a moment.
constexpr int kPosterWidth = 400, kPosterSamples = 16, kPosterRays = 14;

RenderOptions poster(RenderOptions picture) {
  picture.samples = std::min(picture.samples, kPosterSamples);
  if (picture.width > kPosterWidth) {
    picture.height = std::max(1, picture.height * kPosterWidth / picture.width);
    picture.width = kPosterWidth;
  }
  return picture;
}

}  // namespace

Json pageHead(const std::string& kind, const std::filesystem::path& example,
              const std::string& description, const RenderOptions& picture) {
  return {{"kind", kind},
          {"title", example.stem().string()},
          {"description", example.string() + ": " + description},
          {"version", EXEMPLAR_VERSION},
          {"example", {{"view", "example"}, {"picture", "example"}}},
          {"camera",
           {{"azimuth", picture.view.azimuth},
            {"elevation", picture.view.elevation},
            {"fieldOfView", picture.fieldOfView},
            {"margin", picture.margin},
            {"key", toJson(keyDirection(picture))}}},
          {"runs", Json::array()}};
}

std::string exampleView(const TriangleMesh& mesh, const DistanceField* field,
                        const RenderOptions& picture, std::int64_t triangles,
                        const Progress& progress) {
  if (!reportsTurn()) return {};
  ViewSource source{mesh};
  source.example = field;
  ViewOptions options{.triangles = triangles, .picture = picture};
  if (!field) options.rays = kPosterRays;
  return viewPart(makeViewMesh(source, options, progress));
}

PageParts pageParts(const TriangleMesh& mesh, const DistanceField* example,
                    const DistanceField* field, const Origins* origins,
                    const RenderOptions& picture, std::int64_t triangles,
                    const Progress& progress) {
  PageParts parts;
  ViewSource source{mesh};
  Array3D<float> jumps;
  if (example && field && origins) {
    jumps = seamJumps(*example, *field, *origins, 0, progress.part(0, 0.15));
    parts.camera = pictureCamera(mesh, picture);
    parts.marks = findMarks(*example, *field, *origins, jumps, *parts.camera, {}, 0,
                            progress.part(0.15, 0.3));
    source.field = field;
    source.origins = origins;
    source.example = example;
    source.jumps = &jumps;
  }
  if (!reportsTurn()) return parts;
  ViewOptions options{.triangles = triangles, .picture = picture};
  if (!field) options.rays = kPosterRays;
  parts.view = viewPart(makeViewMesh(source, options, progress.part(0.3, 1)));
  return parts;
}

void writePage(const ResultPage& given, Json run, const RenderOptions& asItLies,
               const Progress& progress) {
  // All is shown straight, as the fields are, by a camera that stands elsewhere.
  TriangleMesh straight[2];
  if (!given.turn.none()) {
    straight[0] = given.exampleMesh;
    straight[1] = given.mesh;
    for (TriangleMesh& mesh : straight) turn(mesh, given.turn.back());
  }
  const ResultPage result{given.page,
                          given.example,
                          given.description,
                          given.turn.none() ? given.exampleMesh : straight[0],
                          given.turn.none() ? given.mesh : straight[1],
                          given.exampleField,
                          given.field,
                          given.origins,
                          {}};
  const RenderOptions picture = straightPicture(asItLies, given.turn);
  Json head = pageHead("result", result.example, result.description, picture);
  if (result.exampleField) {
    head["example"]["samples"] = toJson(result.exampleField->size());
    head["voxel_size"] = result.exampleField->voxelSize;
  }
  head["has_origins"] = result.origins != nullptr;
  ReportPage page;
  const bool small = reportsTurn() && !result.field;
  const RenderOptions shown = small ? poster(picture) : picture;
  page.addPicture("example", render(result.exampleMesh, shown, progress.part(0, 0.2)));
  page.addPicture("result", render(result.mesh, shown, progress.part(0.2, 0.4)));
  if (std::string view = exampleView(result.exampleMesh, result.exampleField, picture, kFewViews,
                                     progress.part(0.4, 0.7));
      !view.empty())
    page.addView("example", std::move(view));
  PageParts parts = pageParts(result.mesh, result.exampleField, result.field, result.origins,
                              picture, kFewViews, progress.part(0.7, 1));
  if (!parts.view.empty()) page.addView("result", std::move(parts.view));
  run["status"] = "complete";
  run["view"] = run["picture"] = "result";
  if (result.origins) run["marks"] = toJson(parts.marks);
  if (result.field) run["samples"] = toJson(result.field->size());
  head["figures"] = figureMeanings();
  head["runs"].push_back(std::move(run));
  requireMemory(3.0 * static_cast<double>(page.bytes()), result.page.string(),
                "leave the report out");
  writeFile(result.page, page.html(head));
}

}  // namespace exemplar
