// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/report.h"

#include <utility>

#include "apps/command.h"
#include "apps/json.h"
#include "core/file.h"
#include "core/memory.h"
#include "measure/seams.h"
#include "preview/baked_light.h"

namespace exemplar {

Json reportHead(const std::string& kind, const std::filesystem::path& example,
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

void describeField(Json& report, const DistanceField& example) {
  report["example"]["samples"] = toJson(example.size());
  report["voxel_size"] = example.voxelSize;
}

std::string exampleView(const TriangleMesh& mesh, const DistanceField* field,
                        const RenderOptions& picture, std::int64_t triangles,
                        const Progress& progress) {
  if (!reportsTurn()) return {};
  ViewSource source{mesh};
  source.example = field;
  const ViewMesh view =
      makeViewMesh(source, {.triangles = triangles, .picture = picture}, progress);
  return progress.cancelled() ? std::string() : viewPart(view);
}

ResultParts resultParts(const TriangleMesh& mesh, const DistanceField* example,
                        const DistanceField* field, const Origins* origins,
                        const RenderOptions& picture, std::int64_t triangles,
                        const Progress& progress) {
  ResultParts parts;
  ViewSource source{mesh};
  Array3D<float> jumps;
  if (example && field && origins) {
    jumps = seamJumps(*example, *field, *origins);
    parts.camera = pictureCamera(mesh, picture);
    parts.marks = findMarks(*example, *field, *origins, jumps, *parts.camera);
    source.field = field;
    source.origins = origins;
    source.example = example;
    source.jumps = &jumps;
  }
  if (!reportsTurn() || progress.cancelled()) return parts;
  const ViewMesh view =
      makeViewMesh(source, {.triangles = triangles, .picture = picture}, progress);
  if (!progress.cancelled()) parts.view = viewPart(view);
  return parts;
}

void writeResultReport(const ResultReport& report, Json run, const RenderOptions& picture,
                       const Progress& progress) {
  Json head = reportHead("result", report.example, report.description, picture);
  if (report.exampleField) describeField(head, *report.exampleField);
  head["has_origins"] = report.origins != nullptr;
  head["figures"] = Json::array();
  ReportPage page;
  page.addPicture("example", render(report.exampleMesh, picture, progress));
  if (progress.cancelled()) return;
  page.addPicture("result", render(report.mesh, picture, progress));
  if (progress.cancelled()) return;
  if (std::string view =
          exampleView(report.exampleMesh, report.exampleField, picture, kFewViews, progress);
      !view.empty())
    page.addView("example", std::move(view));
  ResultParts parts = resultParts(report.mesh, report.exampleField, report.field, report.origins,
                                  picture, kFewViews, progress);
  if (progress.cancelled()) return;
  if (!parts.view.empty()) page.addView("result", std::move(parts.view));
  run["status"] = "complete";
  run["view"] = run["picture"] = "result";
  if (report.origins) run["marks"] = toJson(parts.marks);
  if (report.field) run["samples"] = toJson(report.field->size());
  for (const Figure& figure : figures(Measures{}))
    head["figures"].push_back(
        {{"group", figure.group}, {"key", figure.key}, {"meaning", figure.meaning}});
  head["runs"].push_back(std::move(run));
  requireMemory(3.0 * static_cast<double>(page.bytes()), report.page.string(),
                "leave --report out");
  writeFile(report.page, page.html(head));
}

void writeLabelReport(const std::filesystem::path& page, const LabelExample& example,
                      const ExampleOptions& reading, const LabelGrid& grid, Json run,
                      const RenderOptions& picture, const Progress& progress) {
  const TriangleMesh whole = example.field || example.pieces
                                 ? loadForPicture(example.path, reading, progress)
                                 : labelsToMesh(example.grid, example);
  const TriangleMesh mesh = labelsToMesh(grid, example);
  ResultReport report{page, example.path, example.description, whole, mesh};
  PlacedBlocks placed;
  if (example.field) {
    const Example& source = example.field->example;
    placed = placeBlocks(source.field, example.field->blocks, grid.cells);
    report.exampleField = &source.field;
    report.field = &placed.field;
    report.origins = &placed.origins;
    MeasureInput input;
    input.origins = &placed.origins;
    input.mesh = &mesh;
    run["figures"] = toJson(figures(measure(source.field, placed.field, input, {}, progress)));
  }
  writeResultReport(report, std::move(run), picture, progress);
}

}  // namespace exemplar
