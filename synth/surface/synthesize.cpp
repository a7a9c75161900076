// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/synthesize.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "core/error.h"
#include "synth/surface/sheet_seams.h"
#include "synth/surface/surface_origins.h"

namespace exemplar::surface {
namespace {

/// Edges of the sheet, and the largest radius of a map, of the example's shorter side.
constexpr double kEdge = 1.5, kRadius = 0.3;
/// Maps are no smaller than so many samples, or so many periods, for the sake of stretch.
constexpr double kLeastRadius = 12, kLeastPeriods = 1.5;
constexpr double kDefaultSpan = 0.25;
/// Sizes change by no more than a factor e^this over the largest radius of a map.
constexpr double kSizeChange = 0.2;
/// Height times curvature above which the example does not fit.
constexpr double kSteep = 0.8;

/// Seconds since the last time it was asked.
class Lap {
 public:
  double operator()() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

void check(const SurfaceOptions& options) {
  if (options.span && !(*options.span > 0)) throw InputError("`span` must be above 0");
  if (!(options.height >= 0.05 && options.height <= 20))
    throw InputError("`height` must be 0.05 to 20");
  if (!(options.stretch >= 1.02 && options.stretch <= 2))
    throw InputError("`stretch` must be 1.02 to 2");
  if (options.symmetry && *options.symmetry != 1 && *options.symmetry != 2 &&
      *options.symmetry != 4 && *options.symmetry != 6)
    throw InputError("`turns` " + std::to_string(*options.symmetry) + ": expected 1, 2, 4 or 6");
}

/// The value above which `share` of the area is.
double areaQuantile(std::vector<std::pair<double, double>> values, double share) {
  std::sort(values.begin(), values.end());
  double total = 0, sum = 0;
  for (const auto& [value, area] : values) total += area;
  for (const auto& [value, area] : values) {
    sum += area;
    if (sum >= share * total) return value;
  }
  return values.empty() ? 1 : values.back().first;
}

/// The median of what placements that met others disagreed with them.
double medianDisagreement(const Placements& placements) {
  std::vector<double> all;
  for (const Placement& p : placements.all)
    if (p.met) all.push_back(p.disagreement);
  if (all.empty()) return 0;
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

void setPlacements(const Placements& placements, const std::vector<StretchShare>& shares,
                   SurfaceFigures& figures) {
  figures.placements = static_cast<std::int64_t>(placements.all.size());
  figures.disagreement = medianDisagreement(placements);
  std::vector<std::pair<double, double>> least, most;
  for (const StretchShare& s : shares) {
    least.emplace_back(s.least, s.area);
    most.emplace_back(s.most, s.area);
  }
  figures.stretch05 = areaQuantile(std::move(least), 0.05);
  figures.stretch95 = areaQuantile(std::move(most), 0.95);
}

/// The share of the area where an edge's normals turn too much for what is `height` above it.
double steepShare(const Sheet& sheet, double height) {
  double steep = 0;
  for (std::uint32_t v = 0; v < sheet.positions.size(); ++v) {
    double most = 0;
    for (const Sheet::Link& link : sheet.links(v)) {
      const Vec3d turn = sheet.nodeNormals[link.node] - sheet.nodeNormals[v];
      most = std::max(most, length(turn) / sheet.edges[link.edge].length);
    }
    if (most * height * sheet.sizes[v] > kSteep) steep += sheet.areas[v];
  }
  return steep / sheet.area;
}

/// The field's guidance: strokes, a direction, or none. The field is that of the example's x, a
/// quarter turn before its y.
std::optional<Guidance> guidanceOf(const Sheet& sheet, const SurfaceOptions& options,
                                   const SurfaceFigures& example, double span, double sample) {
  // Bark and the like: neither way of its y is another, and nothing else says how it lies.
  const bool hasGrain = example.symmetry == 2 && example.periods == 0;
  std::optional<Guidance> guidance;
  if (!options.strokes.empty()) {
    guidance = alongStrokes(sheet, options.strokes, 2 * sample, span / 4);
    if (std::ranges::all_of(guidance->confidence, [](double c) { return c == 0; }))
      throw InputError(
          "`strokes`: no line runs on the surface; its lines must be in the surface's "
          "own coordinates");
  } else if (options.leastCurvature || (hasGrain && !options.along && !options.smoothest)) {
    guidance = alongLeastCurvature(sheet, span / 4);
  } else if (options.along || (example.symmetry == 1 && !options.smoothest)) {
    guidance = along(sheet, options.along.value_or(Vec3d{0, 0, 1}), span / 4);
  }
  if (guidance)
    for (double& angle : guidance->angle) angle -= std::numbers::pi / 2;
  return guidance;
}

/// The length of the example's longest side on the surface.
double spanOf(const TriangleMesh& on, const SurfaceOptions& options) {
  const double diagonal = length(boundingBox(on).size());
  if (!(diagonal > 0)) throw InputError("`on`: the surface has no extent");
  return options.span.value_or(kDefaultSpan * diagonal);
}

/// What is below the example; an open surface has no inside for it.
Base baseOf(const Slab& slab, bool closed, const SurfaceOptions& options) {
  const Base base = options.base.value_or(slab.grounded() && closed ? Base::Under : Base::None);
  if (base != Base::None && !closed && !options.body)
    throw InputError(
        "`base`: the surface is open, so that it has no inside; close it, or use none");
  return base;
}

/// How large the parts are that are laid out flat.
LocalMapOptions mappingOf(const Slab& slab, const Lattice& lattice, const SurfaceOptions& options,
                          double sample) {
  LocalMapOptions mapping;
  mapping.sample = sample;
  mapping.stretch = options.stretch;
  mapping.shrink = 1 / options.stretch;
  const double shorter = std::min(slab.size().x, slab.size().y);
  double period = lattice.periods > 0 ? length(lattice.first) : 0;
  if (lattice.periods > 1) period = std::max(period, length(lattice.second));
  mapping.radius = std::max(kRadius * shorter, std::min(kLeastRadius, 0.45 * shorter));
  mapping.leastRadius = std::min(mapping.radius, std::max(kLeastRadius, kLeastPeriods * period));
  return mapping;
}

/// The closed surface whose inside is the base, and how its points are found.
struct OwnBody {
  Sheet sheet;
  FootFinder feet;

  explicit OwnBody(const TriangleMesh& mesh, const Progress& progress)
      : sheet(makeSheet(mesh, {.edge = std::numeric_limits<double>::infinity()},
                        progress.part(0, 0.5))),
        feet(sheet, progress.part(0.5, 1)) {
    if (!sheet.closed())
      throw InputError(
          "`base`: the surface is open, so that it has no inside; close it, or use none");
  }
};

void setField(const Sheet& sheet, const DirectionField& field, SurfaceFigures& figures) {
  figures.singularities = static_cast<std::int64_t>(field.singularities.size());
  for (const Singularity& s : field.singularities)
    figures.singularPlaces.push_back(sheet.positions[sheet.triangles[s.triangle][0]]);
}

void setSeams(const Sheet& sheet, const SheetSeams& seams, SurfaceFigures& figures) {
  figures.seamShare =
      static_cast<double>(seams.seamEdges) / static_cast<double>(sheet.edges.size());
  if (seams.before > 0)
    figures.seamCost = static_cast<double>(seams.after) / static_cast<double>(seams.before);
}

}  // namespace

SurfaceResult synthesizeOnSurface(const DistanceField& example, const TriangleMesh& on,
                                  const SurfaceOptions& options, const Progress& progress) {
  check(options);
  SurfaceResult result;
  SurfaceFigures& figures = result.figures;
  Lap lap;
  const auto stage = [&](const char* name) { figures.seconds.emplace_back(name, lap()); };

  const Slab slab(example);
  Lattice lattice = latticeOf(options.repetition);
  const SlabSymmetry symmetry = findSymmetry(slab, lattice, options.symmetry);
  const double span = spanOf(on, options);
  const double sample = span / std::max({slab.size().x, slab.size().y, slab.size().z});
  figures.symmetry = symmetry.turns;
  figures.periods = lattice.periods;
  stage("example");

  const LocalMapOptions mapping = mappingOf(slab, lattice, options, sample);
  const auto ofSheet = std::make_shared<Sheet>(
      makeSheet(on, {.edge = kEdge * sample, .sizes = options.sizes}, progress.part(0, 0.1)));
  if (!options.sizes.empty()) evenSizes(*ofSheet, kSizeChange / (mapping.radius * sample));
  const Sheet& sheet = *ofSheet;
  figures.nodes = static_cast<std::int64_t>(sheet.positions.size());
  figures.closed = sheet.closed();
  figures.base = baseOf(slab, figures.closed, options);
  stage("sheet");

  const std::optional<Guidance> guidance = guidanceOf(sheet, options, figures, span, sample);
  const DirectionField field = smoothestField(
      sheet, symmetry.turns, guidance ? &*guidance : nullptr, progress.part(0.1, 0.2));
  setField(sheet, field, figures);
  stage("field");

  const Coordinates coordinates = integrate(sheet, field, lattice, sample, progress.part(0.2, 0.4));
  figures.dislocations = static_cast<std::int64_t>(coordinates.dislocations.size());
  stage("stripes");

  const LocalMapper mapper(sheet, coordinates, mapping);
  std::vector<StretchShare> stretch;
  Placements placements = place(mapper, slab, {.seed = options.seed, .symmetry = symmetry},
                                &stretch, progress.part(0.4, 0.6));
  setPlacements(placements, stretch, figures);
  stage("placements");

  setSeams(sheet, cutSeams(sheet, slab, placements, {}, progress.part(0.6, 0.75)), figures);
  stage("seams");

  const double height = (slab.top() - slab.low()) * options.height * sample;
  const bool standing = figures.base != Base::None || slab.grounded();
  figures.steepShare = steepShare(sheet, standing ? height : height / 2);
  const auto feet = std::make_shared<const FootFinder>(sheet, progress.part(0.75, 0.78));
  const auto content = std::make_shared<const SheetContent>(mapper, placements);
  std::optional<OwnBody> own;
  std::optional<Body> body;
  if (options.body && figures.base != Base::None) {
    own.emplace(*options.body, progress.part(0.78, 0.8));
    body.emplace(own->sheet, own->feet);
  }
  Band band = fillBand(sheet, *feet, *content, placements, slab, symmetry.turns,
                       {.sample = sample,
                        .voxel = sample * *std::ranges::min_element(sheet.sizes),
                        .base = figures.base,
                        .height = options.height,
                        .body = body ? &*body : nullptr},
                       progress.part(body ? 0.8 : 0.78, 1));
  figures.bandSamples = band.samples;
  stage("band");

  if (options.patches > 0) {
    const UnrollOptions unrolling{.patches = options.patches,
                                  .layers = slab.size().z,
                                  .sample = sample,
                                  .zero = band.zero,
                                  .height = options.height,
                                  .seed = options.seed};
    result.unrolled = unroll(sheet, field, coordinates.dislocations, band.field, unrolling);
    stage("unrolling");
  }
  result.field = std::move(band.field);
  result.origins = std::move(band.origins);
  result.originMap = std::make_shared<const SurfaceOrigins>(
      ofSheet, feet, content,
      SurfaceOrigins::Scale{sample, options.height, band.zero, 1.5 * band.limit});
  return result;
}

}  // namespace exemplar::surface
