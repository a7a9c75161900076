// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Geometry synthesis on a surface: from a field and triangles to a field around them.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "engine/engines.h"
#include "engine/painted_surface.h"
#include "engine/target_surface.h"
#include "engine/words.h"
#include "measure/surface_likeness.h"
#include "synth/geometry/quilting/repetition.h"
#include "synth/surface/synthesize.h"

namespace exemplar {
namespace {

using surface::Base;

/// Which way the example's y goes.
enum class Along { Auto, None, Curvature, X, Y, Z };

struct EngineOptions {
  surface::SurfaceOptions surface;
  Along along = Along::Auto;
  Base base = Base::None;
  bool baseGiven = false;
  /// Whether the result has the inside of a surface that the example covers a part of.
  bool hasBody() const { return baseGiven && base != Base::None; }
  std::string strokes, cover, sizeMap;
  bool likeness = false;
};

const SettingTable<EngineOptions>& table() {
  using O = EngineOptions;
  static const SettingTable<O> settings{
      settingRow<O>(
          "span", [](O & o) -> auto& { return o.surface.span; },
          "length of the example's longest side on the surface, in the surface's units", kAboveZero,
          "", "a quarter of the diagonal of the surface's box"),
      [] {
        SettingTable<O>::Row row = choiceRow<O, Base>(
            "base", &O::base,
            "what is below the example: nothing, the inside of the surface, or the inside with the "
            "example's air cut out of it",
            {{"none", Base::None}, {"under", Base::Under}, {"carve", Base::Carve}},
            "under where the example has ground and the surface is closed, else none");
        const auto write = row.write;
        row.write = [write](const Setting& s, const std::string& text, O& o) {
          write(s, text, o);
          o.baseGiven = true;
        };
        return row;
      }(),
      settingRow<O>("height", [](O & o) -> auto& { return o.surface.height; },
                    "height of the example over the surface, of its own", {0.05, 20}),
      choiceRow<O, Along>(
          "along", &O::along,
          "the direction that the example's y follows on the surface; curvature: "
          "where it bends least, as along a limb; none: the smoothest that there is",
          {{"auto", Along::Auto},
           {"none", Along::None},
           {"curvature", Along::Curvature},
           {"x", Along::X},
           {"y", Along::Y},
           {"z", Along::Z}},
          "auto: z where the example may not be turned, curvature where it may be turned "
          "by half and does not repeat, else none"),
      settingRow<O>("strokes", &O::strokes,
                    "a .obj with lines on the surface that the example's y follows"),
      settingRow<O>("cover", &O::cover,
                    "what of the surface the example covers: the name of a material there, or red, "
                    "green, blue or alpha, where that channel of its vertex colors is at least one "
                    "half; with a `base` the rest is in the result as it is"),
      settingRow<O>("size-map", &O::sizeMap,
                    "the channel of the surface's vertex colors (red, green, blue or alpha) that "
                    "says how large the example is there: 0 half its size, 1 twice"),
      settingRow<O>(
          "turns", [](O & o) -> auto& { return o.surface.symmetry; },
          "how often the example may be turned within once around: 1, 2, 4 or 6", {1, 6}, "",
          "found from the example"),
      settingRow<O>(
          "stretch", [](O & o) -> auto& { return o.surface.stretch; },
          "how much nearly all of a copied part may be stretched; less makes parts smaller",
          {1.02, 2}),
      settingRow<O>("likeness", &O::likeness,
                    "also measure how alike pieces of the result, laid flat again, are to the "
                    "example")};
  return settings;
}

const char* baseName(Base base) {
  return base == Base::None ? "none" : base == Base::Under ? "under" : "carve";
}

std::string percent(double share) {
  return std::to_string(static_cast<int>(std::lround(100 * share))) + " %";
}

void report(const surface::SurfaceFigures& f, Result& result) {
  Statistics& s = result.statistics;
  s.emplace_back("nodes", f.nodes);
  s.emplace_back("symmetry", std::int64_t{f.symmetry});
  s.emplace_back("periods", std::int64_t{f.periods});
  s.emplace_back("singularities", f.singularities);
  s.emplace_back("dislocations", f.dislocations);
  s.emplace_back("placements", f.placements);
  s.emplace_back("placement_disagreement", f.disagreement);
  s.emplace_back("stretch_p05", f.stretch05);
  s.emplace_back("stretch_p95", f.stretch95);
  s.emplace_back("seam_share", f.seamShare);
  s.emplace_back("seam_cost_after_cuts", f.seamCost);
  s.emplace_back("height_times_curvature_share", f.steepShare);
  s.emplace_back("band_samples", f.bandSamples);
  s.emplace_back("base", std::string(baseName(f.base)));
  for (const auto& [stage, seconds] : f.seconds) s.emplace_back("seconds_" + stage, seconds);
  std::string text = withThousands(f.placements) + " placements on " + withThousands(f.nodes) +
                     " nodes, " + withThousands(f.singularities) + " singularities";
  if (f.periods > 0) text += ", " + withThousands(f.dislocations) + " places where a row ends";
  result.notes.emplace_back("surface", text);
  constexpr double kManySteep = 0.05;
  if (f.steepShare > kManySteep)
    result.warnings.push_back(
        "on " + percent(f.steepShare) +
        " of the surface the example is too high for how much the surface bends: it is cut in "
        "folds and drawn apart on ridges; a smaller `span` or `height` would fit");
}

/// Figures of the result's pieces, laid flat again.
void addLikeness(const surface::SurfaceResult& made, const Array3D<float>& example, Result& result,
                 const Progress& progress) {
  if (made.unrolled.patches.empty()) {
    result.warnings.push_back(
        "`likeness`: no piece of the surface is large and smooth enough to be laid flat, so there "
        "are no figures");
    return;
  }
  const int turns = made.figures.symmetry == 6 ? 2 : made.figures.symmetry;
  const SurfaceLikeness likeness =
      surfaceLikeness(made.unrolled.patches, made.unrolled.perSample, example, turns, progress);
  result.statistics.emplace_back("lp_dense", likeness.likeness);
  result.statistics.emplace_back("coverage", likeness.coverage);
  result.statistics.emplace_back("mean_iou", likeness.meanIou);
  result.statistics.emplace_back("windows", likeness.windows);
  result.statistics.emplace_back("skipped_patches", made.unrolled.skipped);
}

/// The lines of an .obj as polylines, its axes taken as a mesh's are.
std::vector<std::vector<Vec3d>> readStrokes(const std::string& path, UpAxis up) {
  const std::string text = readFile(path);
  std::vector<Vec3d> points;
  std::vector<std::vector<Vec3d>> lines;
  std::istringstream rows(text);
  for (std::string row; std::getline(rows, row);) {
    std::istringstream words(row);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Vec3d p;
      if (!(words >> p.x >> p.y >> p.z) || !isFinite(p))
        throw InputError("`strokes` " + path + ": a vertex has no three numbers");
      points.push_back(up == UpAxis::Z ? p : Vec3d{p.x, -p.z, p.y});
    } else if (kind == "l") {
      std::vector<Vec3d> line;
      for (std::string word; words >> word;) {
        const long n = std::strtol(word.c_str(), nullptr, 10);
        const long at = n < 0 ? static_cast<long>(points.size()) + n : n - 1;
        if (at < 0 || at >= static_cast<long>(points.size()))
          throw InputError("`strokes` " + path + ": a line names vertex " + word +
                           ", which is not there");
        line.push_back(points[static_cast<std::size_t>(at)]);
      }
      if (line.size() > 1) lines.push_back(std::move(line));
    }
  }
  if (lines.empty()) throw InputError("`strokes` " + path + ": there are no lines (l ...) in it");
  return lines;
}

class SurfaceEngine final : public Engine {
 public:
  std::string_view name() const override { return "surface"; }
  std::string_view meaning() const override {
    return "an example that lies flat, laid on a surface of any shape (after Lagae, Dumont, Dutré "
           "2004, section 7)";
  }
  Form form() const override { return Form::Field; }
  std::span<const Setting> settings() const override { return table().settings(); }
  std::span<const std::string_view> honors() const override {
    static constexpr std::string_view keys[] = {"on"};
    return keys;
  }
  /// About: what is higher than the surface's box by the example's height on all sides.
  Vec3i extentOf(std::span<const Example> examples, const Request& request) const override {
    EngineOptions options;
    table().apply(request.settings, options);
    const TriangleMesh on = readTriangles(*request.on, request.reading.mesh);
    Vec3d box = boundingBox(on).size(), covered = box;
    if (!options.cover.empty()) {
      covered = boundingBox(coveredPart(on, options.cover, request.on->name())).size();
      if (!options.hasBody()) box = covered;
    }
    const Vec3i& example = examples.front().field().size();
    const double longest = std::max({example.x, example.y, example.z});
    double sample = options.surface.span.value_or(length(covered) / 4) / longest;
    if (!options.sizeMap.empty())
      sample *= std::ranges::min(paintedSizes(on, options.sizeMap, request.on->name()));
    Vec3i size;
    for (int axis = 0; axis < 3; ++axis) {
      const double n = std::ceil(box[axis] / sample + 2 * options.surface.height * example.z);
      if (!(n <= 32767))
        throw InputError("the result would be " + numberText(n) +
                         " samples long, more than 32,767; use a larger `span`");
      size[axis] = static_cast<int>(n);
    }
    return size;
  }

 protected:
  void checkFurther(const Request& request, std::size_t) const override {
    if (!request.on) throw InputError("the engine surface needs a surface; give `on`");
    requireThere(*request.on);
    if (request.extent.scale || request.extent.size)
      throw InputError(
          "`scale`, `size`: the surface says how large the result is; `span` says how large the "
          "example is on it");
    EngineOptions options;
    table().apply(request.settings, options);
    if (options.surface.symmetry == 3 || options.surface.symmetry == 5)
      throw InputError("`turns` " + std::to_string(*options.surface.symmetry) +
                       ": expected 1, 2, 4 or 6");
  }
  Result synthesize(std::span<const Example> examples, const Request& request,
                    const Progress& progress) const override {
    EngineOptions options;
    table().apply(request.settings, options);
    Result result;
    TargetSurface target =
        targetSurface(*request.on, request.reading.mesh, options.cover, options.hasBody(),
                      &result.warnings, progress.part(0, 0.05));
    const TriangleMesh& on = target.surface;
    surface::SurfaceOptions& surface = options.surface;
    surface.body = std::move(target.body);
    surface.seed = request.seed;
    if (!options.sizeMap.empty())
      surface.sizes = paintedSizes(on, options.sizeMap, request.on->name());
    if (!options.strokes.empty())
      surface.strokes = readStrokes(options.strokes, request.reading.mesh.up);
    if (options.baseGiven) surface.base = options.base;
    switch (options.along) {
      case Along::X:
        surface.along = Vec3d{1, 0, 0};
        break;
      case Along::Y:
        surface.along = Vec3d{0, 1, 0};
        break;
      case Along::Z:
        surface.along = Vec3d{0, 0, 1};
        break;
      case Along::Curvature:
        surface.leastCurvature = true;
        break;
      case Along::None:
        surface.smoothest = true;
        break;
      default:
        break;
    }
    const DistanceField& example = examples.front().field();
    Array3D<float> values = example.values;
    for (float& v : values.values()) v /= static_cast<float>(example.voxelSize);
    surface.repetition = findRepetition(values).basis;
    constexpr int kPatches = 60;
    if (options.likeness) surface.patches = kPatches;
    surface::SurfaceResult made = surface::synthesizeOnSurface(
        example, on, surface, progress.part(0.05, options.likeness ? 0.95 : 1));
    result.statistics = {{"example_samples", example.size()},
                         {"result_samples", made.field.size()},
                         {"voxel_size", made.field.voxelSize}};
    report(made.figures, result);
    if (options.likeness) addLikeness(made, values, result, progress.part(0.95, 1));
    result.data = std::move(made.field);
    result.origins = std::move(made.origins);
    result.originMap = std::move(made.originMap);
    return result;
  }
};

}  // namespace

const Engine& surfaceEngine() {
  static const SurfaceEngine engine;
  return engine;
}

}  // namespace exemplar
