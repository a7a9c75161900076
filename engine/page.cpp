// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/page.h"

#include <utility>

#include "core/file.h"
#include "core/memory.h"
#include "engine/json.h"
#include "measure/seams.h"
#include "preview/baked_light.h"

namespace exemplar {

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
  return viewPart(makeViewMesh(source, {.triangles = triangles, .picture = picture}, progress));
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
  parts.view = viewPart(
      makeViewMesh(source, {.triangles = triangles, .picture = picture}, progress.part(0.3, 1)));
  return parts;
}

void writePage(const ResultPage& result, Json run, const RenderOptions& picture,
               const Progress& progress) {
  Json head = pageHead("result", result.example, result.description, picture);
  if (result.exampleField) {
    head["example"]["samples"] = toJson(result.exampleField->size());
    head["voxel_size"] = result.exampleField->voxelSize;
  }
  head["has_origins"] = result.origins != nullptr;
  ReportPage page;
  page.addPicture("example", render(result.exampleMesh, picture, progress.part(0, 0.2)));
  page.addPicture("result", render(result.mesh, picture, progress.part(0.2, 0.4)));
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
